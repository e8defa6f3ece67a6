//! What can go wrong when a world is asked for something.

use crate::entity::Entity;

/// A request that a world refuses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// The handle's entity has been removed, or never existed in this world.
    #[error("entity {0} does not exist in this world (any more)")]
    Stale(Entity),
    /// The component is written by a system and follows another one.
    #[error("{0} is computed by the engine and cannot be set or removed")]
    Computed(&'static str),
    /// The new parent is the entity itself or one of its descendants.
    #[error("{child} cannot become a child of {parent}: {parent} is {child} or lies below it")]
    Cycle {
        /// The entity that was to be moved.
        child: Entity,
        /// The parent that was asked for.
        parent: Entity,
    },
    /// No component has this name.
    #[error("there is no component `{0}`; there are {1}")]
    UnknownComponent(String, String),
    /// The entity lacks the component.
    #[error("entity {entity} has no {component}")]
    Missing {
        /// The entity that was asked.
        entity: Entity,
        /// The component that it lacks.
        component: &'static str,
    },
    /// The component has no field of this name.
    #[error("{component} has no field `{field}`; it has {known}")]
    UnknownField {
        /// The component that was asked.
        component: &'static str,
        /// The name that it does not know.
        field: String,
        /// The names that it knows, with commas.
        known: String,
    },
    /// The value does not fit the field.
    #[error("{component}.{field}: {reason}")]
    BadValue {
        /// The component that was to be written.
        component: &'static str,
        /// The field that was to be written.
        field: &'static str,
        /// What was expected and what came.
        reason: String,
    },
}
