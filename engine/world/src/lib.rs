//! The world of Lightbench: entities whose components are stored as a structure
//! of arrays, and the systems that run over them.
//!
//! A component type is a set of columns, one array a field. The translations of
//! all transforms lie side by side, so a job that needs only translations reads
//! nothing else. See [`World`] for an example.
//!
//! - [`components`]: every component, each declared once.
//! - [`Columns`]: the rows of one component, and which of them changed.
//! - [`systems`]: world matrices and bounds.
//! - [`culling`]: which bounds a view shows.
//! - [`fields`] and [`reflect`]: components by name.

mod clock;
mod columns;
mod component_macro;
mod component_methods;
pub mod components;
pub mod culling;
mod entity;
mod error;
pub mod fields;
mod hierarchy;
pub mod reflect;
mod row_map;
mod stores;
pub mod systems;
mod ticks;
mod value;
mod world;

pub use columns::{Arrays, Columns, Component, Marker};
pub use components::{
    Camera, ComponentKind, Light, LightKind, MeshRenderer, Name, Transform, WorldBounds,
    WorldMatrix,
};
pub use entity::Entity;
pub use error::WorldError;
pub use glam;
pub use hierarchy::Children;
pub use stores::Stored;
pub use systems::MeshBounds;
pub use ticks::Tick;
pub use value::{FieldType, MaterialId, MeshId, Value, ValueType};
pub use world::World;
