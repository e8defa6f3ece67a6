//! Culling by brute force over arrays: every bound against every plane, which
//! processors do faster than they can walk a tree (Collin 2011, "Culling the
//! Battlefield: data oriented design in practice").
//!
//! The loops are plain Rust that the compiler turns into vector instructions. It
//! does so several times, for several sets of instructions, and the widest one
//! that the processor has is chosen when the program runs. All of them do the same
//! operations in the same order, without fused multiplication, and so give the
//! same rows, down to the last bit.

mod boxes;
mod compact;
mod frustum;
mod spheres;
mod views;
mod volumes;

pub use boxes::{Boxes, cull_boxes};
pub use compact::{InstructionSet, instruction_set};
pub use frustum::{Frustum, Plane};
pub use spheres::{Spheres, cull_spheres, cull_spheres_with};
pub use views::Culler;
pub use volumes::{Ball, Cone, Volume};
