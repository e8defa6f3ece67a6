//! A hanging cloth.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec4};

use super::flat::add_cells;
use super::{count, length};
use crate::Mesh;

/// A sheet that hangs down from the line y = 0 along x, in waves that deepen
/// towards its lower edge. It faces +z and has no thickness: draw it with a
/// two-sided material. Texture coordinates 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cloth {
    /// Along x.
    pub width: f32,
    /// From its upper edge to its lower one.
    pub height: f32,
    /// Waves across the width.
    pub waves: f32,
    /// Greatest distance from the plane z = 0 at the lower edge.
    pub depth: f32,
    /// How far the middle of the lower edge hangs below its ends.
    pub sag: f32,
    /// Makes each cloth wave in its own way.
    pub seed: u32,
    /// Cells across and down, 1 to 1024 each.
    pub segments: [u32; 2],
}

impl Default for Cloth {
    fn default() -> Self {
        Self {
            width: 1.6,
            height: 3.0,
            waves: 3.0,
            depth: 0.12,
            sag: 0.1,
            seed: 0,
            segments: [32, 32],
        }
    }
}

impl Cloth {
    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let [columns, rows] = self.segments.map(|segments| count(segments, 1));
        let mut mesh = Mesh::default().named("cloth");
        for row in 0..=rows {
            for column in 0..=columns {
                let x = column as f32 / columns as f32;
                let y = row as f32 / rows as f32;
                // Slopes from points so close that the sheet is flat between.
                let reach = 1e-3;
                let right = self.point(x + reach, y) - self.point(x - reach, y);
                let up = self.point(x, y + reach) - self.point(x, y - reach);
                let normal = right.cross(up).normalize_or(Vec3::Z);
                let tangent = right.reject_from_normalized(normal).normalize_or(Vec3::X);
                mesh.positions.push(self.point(x, y));
                mesh.normals.push(normal);
                mesh.tangents.push(Vec4::from((tangent, 1.0)));
                mesh.uvs.push(Vec2::new(x, 1.0 - y));
            }
        }
        add_cells(&mut mesh, 0, columns, rows);
        mesh
    }

    /// A point of the sheet, x to the right and y up, both 0 to 1.
    fn point(&self, x: f32, y: f32) -> Vec3 {
        let (width, height) = (length(self.width), length(self.height));
        let waves = length(self.waves);
        // Three phases from the golden ratio's multiples: different for every
        // seed, and never near each other for neighbouring ones.
        let phase = |n: u32| {
            let turns =
                f64::from(self.seed.wrapping_mul(3).wrapping_add(n)) * 0.618_033_988_749_895;
            turns.fract() as f32 * TAU
        };
        let down = 1.0 - y;
        let wave = 0.7 * (TAU * waves * x + phase(0) + 0.8 * down).sin()
            + 0.3 * (TAU * 1.7 * waves * x + phase(1) - 1.3 * down).sin();
        let sway = 0.15 * down * (TAU * 0.5 * x + phase(2)).sin();
        let depth = length(self.depth) * (0.15 + 0.85 * down) * (wave + sway) / 1.15;
        let sag = length(self.sag) * down * 4.0 * x * (1.0 - x);
        Vec3::new(width * (x - 0.5), -height * down - sag, depth)
    }
}
