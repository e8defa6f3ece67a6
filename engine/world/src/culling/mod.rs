//! Culling by brute force over arrays: every sphere against every plane, which
//! modern memory and processors do faster than a tree can be walked (Collin 2011,
//! "Culling the Battlefield: data oriented design in practice").

mod frustum;
mod spheres;

pub use frustum::{Frustum, Plane};
pub use spheres::{Spheres, cull_spheres};
