//! The shaders' formulas once more, on the CPU and in double precision where it matters.
//!
//! Each function is the twin of one in `shaders/lib/`; tests hold both to the same published
//! numbers and to each other.

pub mod brdf;
pub mod color;
pub mod g_buffer;
pub mod index_packing;
pub mod lighting;
pub mod normals;
pub mod output;
pub mod surface;
pub mod transform;
pub mod triangle;

pub use lighting::{Surface, evaluate_light, outgoing_radiance, reflected};
