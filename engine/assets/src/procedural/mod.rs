//! Meshes from parameters.
//!
//! All shapes have normals out of the solid, tangents, and texture coordinates
//! that are not mirrored. Texture coordinates are of one of two kinds:
//!
//! - *metres*: one unit of u and v is one metre on the surface, for building
//!   parts, whose stones should have one size everywhere;
//! - *0 to 1*: the picture covers the shape once.
//!
//! No argument can fail. Lengths that are negative or no number become 0, and
//! counts are brought into their ranges, of which [`MAX_SEGMENTS`] is the
//! greatest upper end.

mod arch;
mod arched_wall;
mod cloth;
mod column;
mod flat;
mod round;
mod sphere;
mod sweep;

pub use arch::Arch;
pub use arched_wall::ArchedWall;
pub use cloth::Cloth;
pub use column::Column;
pub use flat::{cuboid, plane};
pub use round::{cone, cylinder, torus};
pub use sphere::{icosphere, uv_sphere};
pub use sweep::{Profile, extrude, revolve};

/// The most segments along one direction of a shape.
pub const MAX_SEGMENTS: u32 = 1024;

/// A count in the range from `least` to [`MAX_SEGMENTS`].
fn count(count: u32, least: u32) -> u32 {
    count.clamp(least, MAX_SEGMENTS)
}

/// A length of 0 to 1,000,000 m.
fn length(length: f32) -> f32 {
    crate::clamped(length, 0.0, 1e6)
}

#[cfg(test)]
mod tests;
