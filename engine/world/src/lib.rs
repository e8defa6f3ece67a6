//! The world of Lightbench: entities whose components are stored as a structure
//! of arrays, and the systems that run over them.
//!
//! A component type is a set of columns, one array a field. The translations of
//! all transforms lie side by side, so a job that needs only translations reads
//! nothing else. See [`World`] for an example.
//!
//! - [`components`]: every component, each declared once.
//! - [`Columns`]: the rows of one component, and which of them changed; [`Join`]:
//!   several components together.
//! - [`World`]: entities, trees, tags and groups; batches, merging and snapshots.
//! - [`Commands`] and [`Mailbox`]: changes and messages that wait for their time.
//! - [`systems`] and [`Schedule`]: world matrices, bounds and motion, in parallel
//!   where their declarations allow it.
//! - [`culling`]: which bounds a view shows or a light reaches.
//! - [`fields`], [`reflect`] and [`scene_file`]: components by name, and as text;
//!   [`World::gather`] and [`World::scatter`]: one field of many entities at once.
//! - [`layouts`]: the same jobs on other layouts, to measure the difference.

mod access;
mod batches;
mod bits;
mod bundle;
mod clock;
mod columns;
mod commands;
mod component_macro;
mod component_methods;
pub mod components;
pub mod culling;
pub mod curve;
mod entity;
mod error;
pub mod fields;
mod gather;
mod hierarchy;
pub mod layouts;
mod merge;
mod messages;
pub mod query;
pub mod reflect;
mod removal;
mod row_map;
pub mod scene_file;
pub mod schedule;
mod sets;
mod settled;
mod stores;
pub mod systems;
mod ticks;
mod value;
mod world;

pub use access::{ReadSet, WriteSet};
pub use batches::{BatchMarker, SliceSet};
pub use bundle::Bundle;
pub use columns::{Arrays, Columns, Component, Marker};
pub use commands::{Commands, Target};
pub use components::{
    Behaviour, Camera, ClipVolume, ComponentKind, Light, LightKind, MeshRenderer, Name,
    RigidAnimation, Row, Transform, Transform2d, Velocity, WorldBounds, WorldMatrix, WorldMatrix2d,
};
pub use curve::Curve;
pub use entity::Entity;
pub use error::WorldError;
pub use gather::{Lane, Refused};
pub use glam;
pub use hierarchy::Children;
pub use merge::{EntityMap, Snapshot};
pub use messages::{Mailbox, Outbox};
pub use query::Join;
pub use removal::Removed;
pub use row_map::RowOrder;
pub use schedule::{Schedule, SystemTime};
pub use sets::EntitySets;
pub use stores::Stored;
pub use systems::MeshBounds;
pub use ticks::Tick;
pub use value::{
    FieldSlice, FieldSliceMut, FieldType, MaterialId, MeshId, Parameters, Value, ValueType,
};
pub use world::World;
