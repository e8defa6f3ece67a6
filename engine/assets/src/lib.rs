//! Meshes, materials, images and the files they come from.
//!
//! This crate holds what a scene is made of before any of it reaches a GPU:
//!
//! - [`Assets`] is the table of all [`Mesh`]es, [`Material`]s and [`Texture`]s
//!   of a scene, with a revision per item, so that a renderer uploads only what
//!   changed.
//! - [`files`] is the one door to the disk: shipped data inside the program,
//!   covered by the files of a student's project.
//! - [`obj`], [`mod@gltf`] and [`images`] read what other programs made.
//! - [`watch`] tells when files change, and [`Task`] works on a thread of its own.
//! - [`procedural`] and [`procedural_texture`] make geometry and pictures from
//!   parameters.
//! - [`cache`] keeps what was made, so that a scene that is loaded again makes
//!   only what changed.
//!
//! A model is read on a thread of its own, while a window shows how far it is:
//!
//! ```
//! use lightbench_assets::{Assets, Task, cache::Reuse, files::Files, obj};
//!
//! # let folder = tempfile::tempdir()?;
//! # std::fs::write(folder.path().join("chair.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")?;
//! let files = Files::with_project(folder.path())?;
//! let task = Task::start(move |progress| {
//!     let reuse = Reuse::default();
//!     obj::load(&files, &reuse, "chair.obj", &obj::Options::default(), progress)
//! })?;
//! println!("{}, {:.0} %", task.progress().label(), 100.0 * task.progress().fraction());
//!
//! let model = task.wait()??;
//! for warning in &model.warnings {
//!     println!("{warning}");
//! }
//! let mut assets = Assets::new();
//! for (mesh, _material) in model.add_to(&mut assets) {
//!     println!("{:?}", assets.mesh_bounds()[mesh.0 as usize]);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Units are metres and radians, y is up, a triangle is seen from its front
//! when its corners run counter-clockwise, and colours are linear Rec. 709
//! unless a texture's format says sRGB. Texture coordinates have their origin
//! at the top left of the picture and v runs down, as the GPU samples them.

mod assets;
pub mod cache;
pub mod color;
mod digest;
pub mod files;
#[cfg(test)]
mod fuzz;
pub mod gltf;
pub mod images;
mod material;
mod mesh;
mod mips;
mod model_meshes;
pub mod obj;
pub mod procedural;
pub mod procedural_texture;
mod progress;
pub mod reflection;
mod rows;
mod smooth_groups;
mod tangents;
mod texture;
pub mod watch;

pub use assets::{AssetCounts, Assets, Entry, Shared, UnknownAsset};
pub use digest::Digest;
pub use lightbench_world::{MaterialId, MeshBounds, MeshId};
pub use material::Material;
pub use mesh::{Mesh, MeshError};
pub use progress::{Cancelled, Progress, Task, TaskLost};
pub use reflection::{Reflection, ReflectionModel, ReflectionModels};
pub use texture::{MAX_TEXTURE_SIZE, Texture, TextureError, TextureFormat, TextureId};

/// A value brought into a range; what is no number becomes its lower end.
fn clamped(value: f32, low: f32, high: f32) -> f32 {
    if value > low { value.min(high) } else { low }
}
