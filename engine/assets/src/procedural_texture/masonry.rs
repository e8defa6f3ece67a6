//! Pieces with joints: bricks and floor tiles.

use glam::{Vec2, Vec3};

use super::{Noise, Surface, normal_map, paint, smooth};
use crate::clamped;

/// A brick wall in running bond: each course is shifted by half a brick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brick {
    /// Pixels a side.
    pub size: u32,
    /// Bricks along a side of the picture.
    pub columns: u32,
    /// Courses up the picture; made even, so that the bond repeats.
    pub courses: u32,
    /// Width of the joints, as a share of a course's height, 0 to 0.9.
    pub joint: f32,
    /// Darkest and lightest brick.
    pub colors: [Vec3; 2],
    /// Of the mortar.
    pub mortar: Vec3,
    /// How deep the mortar lies, in shares of the picture's side.
    pub depth: f32,
    /// Another wall.
    pub seed: u32,
}

impl Default for Brick {
    fn default() -> Self {
        Self {
            size: 512,
            columns: 4,
            courses: 12,
            joint: 0.14,
            colors: [Vec3::new(0.24, 0.075, 0.045), Vec3::new(0.46, 0.17, 0.10)],
            mortar: Vec3::new(0.50, 0.47, 0.42),
            depth: 0.008,
            seed: 1,
        }
    }
}

/// A place on a wall of pieces.
struct Piece {
    column: u32,
    row: u32,
    /// Distance to the edge of the piece's cell, in shares of the picture.
    to_edge: f32,
}

impl Piece {
    /// The piece at a place, with rows shifted by `shift` of a piece in turn.
    fn at(place: Vec2, columns: u32, rows: u32, shift: f32) -> Self {
        let cells = Vec2::new(columns as f32, rows as f32);
        let y = place.y * cells.y;
        let row = (y as u32).min(rows - 1);
        let x = place.x * cells.x + if row % 2 == 1 { shift } else { 0.0 };
        let in_cell = Vec2::new(x.fract(), y - row as f32);
        let to_edge = in_cell.min(1.0 - in_cell) / cells;
        Self {
            column: x as u32 % columns,
            row,
            to_edge: to_edge.min_element(),
        }
    }

    /// 0 in the joint, 1 on the piece, with a rounded edge.
    fn rise(&self, half_joint: f32) -> f32 {
        if half_joint <= 0.0 {
            1.0
        } else {
            smooth(0.7 * half_joint, 1.5 * half_joint, self.to_edge)
        }
    }
}

impl Brick {
    /// Colours and normals.
    #[must_use]
    pub fn paint(&self) -> Surface {
        let columns = self.columns.clamp(1, 1024);
        let courses = self.courses.clamp(1, 1024).next_multiple_of(2);
        let half_joint = 0.5 * clamped(self.joint, 0.0, 0.9) / courses as f32;
        let rough = Noise::new(self.seed);
        let shade = Noise::new(self.seed.wrapping_add(101));
        let grain = |at: Vec2| rough.fractal(at, courses * 2, 4);
        let base_color = paint("brick", self.size, |at| {
            let piece = Piece::at(at, columns, courses, 0.5);
            let grain = grain(at);
            let tint = shade.cell(piece.column, piece.row) + 0.35 * grain;
            let brick = self.colors[0].lerp(self.colors[1], tint.clamp(0.0, 1.0));
            let mortar = self.mortar * (1.0 + 0.25 * grain).clamp(0.0, 1.2);
            mortar.lerp(brick, piece.rise(half_joint))
        });
        let normal = normal_map("brick normals", self.size, |at| {
            let piece = Piece::at(at, columns, courses, 0.5);
            self.depth * (piece.rise(half_joint) + 0.2 * grain(at))
        });
        Surface { base_color, normal }
    }
}

/// Square floor tiles of two kinds in turn, each a slab of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tiles {
    /// Pixels a side.
    pub size: u32,
    /// Tiles along a side, made even so that the pattern repeats.
    pub count: u32,
    /// Width of the joints, as a share of a tile, 0 to 0.9.
    pub joint: f32,
    /// Of the two kinds of tile.
    pub colors: [Vec3; 2],
    /// Of the joints.
    pub grout: Vec3,
    /// How much tiles of one kind differ, 0 to 1.
    pub variety: f32,
    /// How deep the joints are, in shares of the picture's side.
    pub depth: f32,
    /// Another floor.
    pub seed: u32,
}

impl Default for Tiles {
    fn default() -> Self {
        Self {
            size: 512,
            count: 4,
            joint: 0.035,
            colors: [Vec3::new(0.62, 0.57, 0.48), Vec3::new(0.28, 0.20, 0.16)],
            grout: Vec3::new(0.22, 0.20, 0.18),
            variety: 0.3,
            depth: 0.003,
            seed: 1,
        }
    }
}

impl Tiles {
    /// Colours and normals.
    #[must_use]
    pub fn paint(&self) -> Surface {
        let count = self.count.clamp(1, 1024).next_multiple_of(2);
        let half_joint = 0.5 * clamped(self.joint, 0.0, 0.9) / count as f32;
        let shade = Noise::new(self.seed);
        let clouds = Noise::new(self.seed.wrapping_add(101));
        let base_color = paint("tiles", self.size, |at| {
            let piece = Piece::at(at, count, count, 0.0);
            let own = shade.cell(piece.column, piece.row);
            // Each tile shows another part of the clouds.
            let moved = at + Vec2::new(own, own * 7.0).fract();
            let light = 0.6 * (own - 0.5) + 0.5 * clouds.fractal(moved, count * 2, 5);
            let tile = self.colors[(piece.column + piece.row) as usize % 2];
            let tile = tile * (1.0 + self.variety.clamp(0.0, 1.0) * light);
            self.grout.lerp(tile.min(Vec3::ONE), piece.rise(half_joint))
        });
        let normal = normal_map("tile normals", self.size, |at| {
            let piece = Piece::at(at, count, count, 0.0);
            // No tile lies quite level; the slant is cut off by its joints.
            let [slant_x, slant_y] =
                [7, 8].map(|n| shade.cell(piece.column + n * count, piece.row) - 0.5);
            let in_tile = (at * count as f32).fract() - 0.5;
            let slant = 0.3 * in_tile.dot(Vec2::new(slant_x, slant_y));
            self.depth * piece.rise(half_joint) * (1.0 + slant)
        });
        Surface { base_color, normal }
    }
}
