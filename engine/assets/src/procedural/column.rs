//! A column with base, shaft and capital.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Affine3A, Vec2, Vec3, Vec4};

use super::flat::{add_cells, cuboid};
use super::{Profile, count, length, revolve};
use crate::{Mesh, clamped};

/// A column on the ground y = 0, after the Tuscan order: a square plinth and a
/// round base, a shaft that swells (entasis), and a round capital under a
/// square slab. Texture coordinates in metres; around, a whole number of
/// metres, so that a picture of one metre closes.
///
/// Proportions follow Vignola, "Regola delli cinque ordini d'architettura"
/// (1562): with the radius at the foot as the module, base and capital are one
/// module high each, and the upper radius is four fifths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// From the ground to the top of the slab.
    pub height: f32,
    /// Of the shaft at its foot.
    pub radius: f32,
    /// Radius at the top of the shaft as a share of that at its foot, 0.1 to 1.
    pub taper: f32,
    /// Flutes around the shaft, 0 for a smooth one, to 64. Doric 20.
    pub flutes: u32,
    /// Segments around, 8 to 1024; with flutes, at least four for each.
    pub segments: u32,
    /// Rings along the shaft, 2 to 1024.
    pub rings: u32,
}

impl Default for Column {
    fn default() -> Self {
        Self {
            height: 4.0,
            radius: 0.28,
            taper: 0.8,
            flutes: 0,
            segments: 32,
            rings: 12,
        }
    }
}

impl Column {
    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let module = length(self.radius);
        let height = length(self.height).max(3.0 * module);
        let segments = count(self.segments, 8);
        let taper = clamped(self.taper, 0.1, 1.0);
        let (foot, neck) = (module, height - module);
        let round = |profile: &Profile| {
            let u = (TAU * module).round().max(1.0);
            revolve(profile, segments, Vec2::new(u, profile.length()))
        };

        let mut mesh = Mesh::default().named("column");
        let mut add = |part: &Mesh, y: f32| {
            mesh.append(part, Affine3A::from_translation(Vec3::Y * y));
        };
        let slab = |half: f32, thick: f32| cuboid(Vec3::new(2.0 * half, thick, 2.0 * half));
        add(&slab(1.375 * module, 0.5 * module), 0.25 * module);
        add(&round(&base_profile(module)), 0.0);
        add(&self.shaft(module, taper, foot, neck), 0.0);
        add(&round(&capital_profile(module, taper * module)), neck);
        add(&slab(1.2 * module, module / 3.0), height - module / 6.0);
        mesh
    }

    /// The shaft between two heights.
    fn shaft(&self, radius: f32, taper: f32, foot: f32, neck: f32) -> Mesh {
        let flutes = self.flutes.min(64);
        let rings = count(self.rings, 2);
        let facets = match flutes {
            0 => 1,
            flutes => flutes,
        };
        let steps = count(self.segments, 8)
            .div_ceil(facets)
            .max(if flutes > 0 { 4 } else { 1 });
        let shape = Shaft {
            radius,
            taper,
            height: neck - foot,
            // Vitruvius, "De architectura" IV.3.9: the hollow is a part of a
            // circle around the middle of a square on the flute's width.
            depth: if flutes > 0 {
                0.2 * TAU * radius / flutes as f32
            } else {
                0.0
            },
        };
        let around = (TAU * radius).round().max(1.0);
        let mut mesh = Mesh::default();
        for facet in 0..facets {
            let first = mesh.positions.len() as u32;
            for row in 0..=rings {
                for column in 0..=steps {
                    let across = column as f32 / steps as f32;
                    let turn = (facet as f32 + across) / facets as f32;
                    let (position, normal) =
                        shape.at(turn, across, facets, row as f32 / rings as f32);
                    let level = Vec3::Y.cross(normal).normalize_or(Vec3::X);
                    mesh.positions.push(position + Vec3::Y * foot);
                    mesh.normals.push(normal);
                    mesh.tangents.push(Vec4::from((level, 1.0)));
                    mesh.uvs
                        .push(Vec2::new(turn * around, shape.height - position.y));
                }
            }
            add_cells(&mut mesh, first, steps, rings);
        }
        mesh
    }
}

/// The surface of a shaft.
struct Shaft {
    radius: f32,
    taper: f32,
    height: f32,
    /// Of a flute, at the foot.
    depth: f32,
}

impl Shaft {
    /// Position and normal at a share of the turn, of the flute's width and of
    /// the height.
    fn at(&self, turn: f32, across: f32, facets: u32, rise: f32) -> (Vec3, Vec3) {
        // Entasis: straight and upright at the foot, then a part of a parabola,
        // steepest at the top.
        let shape = 1.0 - (1.0 - self.taper) * rise * rise;
        let shape_slope = -2.0 * (1.0 - self.taper) * rise / self.height.max(f32::MIN_POSITIVE);
        // Flutes run out at both ends within a twentieth of the height.
        let (ends, ends_slope) = run_out(rise, 0.05);
        let ends_slope = ends_slope / self.height.max(f32::MIN_POSITIVE);
        // Hollow from ridge to ridge, a parabola in the angle.
        let hollow = 4.0 * across * (1.0 - across);
        let hollow_slope = 4.0 * (1.0 - 2.0 * across) * facets as f32 / TAU;

        let radius = self.radius * shape - self.depth * shape * ends * hollow;
        let by_angle = -self.depth * shape * ends * hollow_slope;
        let by_height = self.radius * shape_slope
            - self.depth * hollow * (shape_slope * ends + shape * ends_slope);
        let angle = if turn == 1.0 { 0.0 } else { turn * TAU };
        let (sin, cos) = angle.sin_cos();
        // The cross product of both derivatives of (r cos, y, −r sin).
        let normal = Vec3::new(
            by_angle * sin + radius * cos,
            -radius * by_height,
            by_angle * cos - radius * sin,
        );
        let position = Vec3::new(radius * cos, rise * self.height, -radius * sin);
        (position, normal.normalize_or(Vec3::X))
    }
}

/// 1, falling smoothly to 0 at both ends within a margin; and its slope.
fn run_out(t: f32, margin: f32) -> (f32, f32) {
    let (near, sign) = if t < 0.5 { (t, 1.0) } else { (1.0 - t, -1.0) };
    let x = (near / margin).min(1.0);
    (x * x * (3.0 - 2.0 * x), sign * 6.0 * x * (1.0 - x) / margin)
}

/// Torus, fillet and the hollow that leads to the shaft.
fn base_profile(module: f32) -> Profile {
    let m = module;
    Profile::new()
        .line(Vec2::new(0.0, 0.5 * m), Vec2::new(1.17 * m, 0.5 * m))
        .arc(
            Vec2::new(1.17 * m, 0.7 * m),
            0.2 * m,
            -FRAC_PI_2,
            FRAC_PI_2,
            8,
        )
        .line(Vec2::new(1.17 * m, 0.9 * m), Vec2::new(1.1 * m, 0.9 * m))
        .arc(Vec2::new(1.1 * m, m), 0.1 * m, 1.5 * PI, PI, 5)
}

/// Ring below the neck, neck, fillet and the bulge (echinus) below the slab.
/// Heights from the top of the shaft.
fn capital_profile(module: f32, neck: f32) -> Profile {
    let m = module;
    let (ring, top) = (0.05 * m, 2.0 / 3.0 * m);
    let bulge = top - 0.42 * m;
    Profile::new()
        .line(Vec2::new(neck, 0.0), Vec2::new(neck + 0.03 * m, 0.0))
        .arc(
            Vec2::new(neck + 0.03 * m, ring),
            ring,
            -FRAC_PI_2,
            FRAC_PI_2,
            6,
        )
        .line(
            Vec2::new(neck + 0.03 * m, 2.0 * ring),
            Vec2::new(neck, 2.0 * ring),
        )
        .line(Vec2::new(neck, 2.0 * ring), Vec2::new(neck, 0.36 * m))
        .line(
            Vec2::new(neck, 0.36 * m),
            Vec2::new(neck + 0.06 * m, 0.36 * m),
        )
        .line(
            Vec2::new(neck + 0.06 * m, 0.36 * m),
            Vec2::new(neck + 0.06 * m, 0.42 * m),
        )
        .arc(Vec2::new(neck + 0.06 * m, top), bulge, -FRAC_PI_2, 0.0, 8)
        .line(Vec2::new(neck + 0.06 * m + bulge, top), Vec2::new(0.0, top))
}
