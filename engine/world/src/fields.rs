//! Components and fields by name, for scene files, scripts and the editor.

use crate::columns::Columns;
use crate::components::ComponentKind;
use crate::entity::Entity;
use crate::error::WorldError;
use crate::reflect::{ComponentInfo, Role};
use crate::stores::{Stored, Visitor, VisitorMut};
use crate::value::Value;
use crate::world::World;

/// The descriptions of all components, in the order in which they are declared.
pub fn all_components() -> impl Iterator<Item = &'static ComponentInfo> {
    ComponentKind::ALL.iter().map(|kind| kind.info())
}

/// The component of this name.
///
/// # Errors
/// [`WorldError::UnknownComponent`], which lists the names that there are.
pub fn component_named(name: &str) -> Result<ComponentKind, WorldError> {
    ComponentKind::from_name(name).ok_or_else(|| {
        let known: Vec<_> = all_components()
            .filter(|info| !info.hidden())
            .map(|info| info.name)
            .collect();
        WorldError::UnknownComponent(name.to_owned(), known.join(", "))
    })
}

impl World {
    /// The components that an entity has, in the order in which they are
    /// declared. None for a stale handle.
    pub fn components_of(&self, entity: Entity) -> impl Iterator<Item = ComponentKind> + use<> {
        let bits = self.entities.components(entity);
        ComponentKind::ALL
            .iter()
            .copied()
            .filter(move |&kind| bits & (1 << kind as u32) != 0)
    }

    /// Whether an entity exists and has a component.
    pub fn has_component(&self, entity: Entity, kind: ComponentKind) -> bool {
        self.entities.components(entity) & (1 << kind as u32) != 0
    }

    /// One field of one component of an entity. `None` if any of the three does
    /// not exist.
    pub fn get_field(&self, entity: Entity, component: &str, field: &str) -> Option<Value> {
        let kind = ComponentKind::from_name(component)?;
        let (field, _) = kind.info().field(field)?;
        self.field_at(entity, kind, field)
    }

    /// Like [`World::get_field`], for those who have looked the names up already: the field by its
    /// position in the description.
    pub fn field_at(&self, entity: Entity, kind: ComponentKind, field: usize) -> Option<Value> {
        struct Get {
            entity: Entity,
            field: usize,
            value: Option<Value>,
        }
        impl Visitor for Get {
            fn visit<C: Stored>(&mut self, columns: &Columns<C>) {
                self.value = columns.field(self.entity, self.field);
            }
        }
        let mut get = Get {
            entity,
            field,
            value: None,
        };
        self.stores.get().visit_one(kind, &mut get);
        get.value
    }

    /// Writes one field of one component of an entity.
    ///
    /// # Errors
    /// The handle is stale, the component or field is unknown, computed or not
    /// there, or the value has the wrong kind or lies outside the field's range.
    pub fn set_field(
        &mut self,
        entity: Entity,
        component: &str,
        field: &str,
        value: &Value,
    ) -> Result<(), WorldError> {
        let (kind, field) = find_field(component, field)?;
        self.write_field(entity, kind, field, value, true)
    }

    /// Like [`World::set_field`], for those who have looked the names up already: the field by its
    /// position in the description.
    ///
    /// # Errors
    /// As [`World::set_field`].
    pub fn set_field_at(
        &mut self,
        entity: Entity,
        kind: ComponentKind,
        field: usize,
        value: &Value,
    ) -> Result<(), WorldError> {
        self.write_field(entity, kind, field, value, true)
    }

    /// Like [`World::set_field`], but also with numbers outside the field's range.
    pub(crate) fn set_field_unchecked(
        &mut self,
        entity: Entity,
        component: &str,
        field: &str,
        value: &Value,
    ) -> Result<(), WorldError> {
        let (kind, field) = find_field(component, field)?;
        self.write_field(entity, kind, field, value, false)
    }

    fn write_field(
        &mut self,
        entity: Entity,
        kind: ComponentKind,
        field: usize,
        value: &Value,
        check: bool,
    ) -> Result<(), WorldError> {
        let info = kind.info();
        if info.role == Role::Computed {
            return Err(WorldError::Computed(info.name));
        }
        if !self.contains(entity) {
            return Err(WorldError::Stale(entity));
        }
        let mut set = Set {
            entity,
            field,
            value,
            check,
            now: self.clock.now(),
            outcome: None,
        };
        self.stores.get_mut().visit_one_mut(kind, &mut set);
        match set.outcome {
            None => Err(WorldError::Missing {
                entity,
                component: info.name,
            }),
            Some(outcome) => outcome.map_err(|reason| WorldError::BadValue {
                component: info.name,
                field: info.fields.get(field).map_or("", |field| field.name),
                reason,
            }),
        }
    }

    /// Gives an entity a component with its default values, unless it has it.
    ///
    /// # Errors
    /// The handle is stale, or the component is unknown or computed.
    pub fn insert_default(&mut self, entity: Entity, component: &str) -> Result<(), WorldError> {
        let kind = component_named(component)?;
        let info = kind.info();
        if info.role == Role::Computed {
            return Err(WorldError::Computed(info.name));
        }
        if self.has_component(entity, kind) {
            return Ok(());
        }
        kind.insert_default(self, entity)
    }

    /// Takes a component away from an entity by name. False if it had none.
    ///
    /// # Errors
    /// The component is unknown or computed.
    pub fn remove_named(&mut self, entity: Entity, component: &str) -> Result<bool, WorldError> {
        let kind = component_named(component)?;
        if kind.info().role == Role::Computed {
            return Err(WorldError::Computed(kind.info().name));
        }
        Ok(kind.remove(self, entity))
    }
}

struct Set<'a> {
    entity: Entity,
    field: usize,
    value: &'a Value,
    check: bool,
    now: crate::ticks::Tick,
    /// `None` while the entity turns out to lack the component.
    outcome: Option<Result<(), String>>,
}

impl VisitorMut for Set<'_> {
    fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
        columns.set_now(self.now);
        self.outcome = columns
            .row_of(self.entity)
            .map(|row| columns.set_field(row, self.field, self.value, self.check));
    }
}

/// The component and the field of these names.
fn find_field(component: &str, field: &str) -> Result<(ComponentKind, usize), WorldError> {
    let kind = component_named(component)?;
    let info = kind.info();
    match info.field(field) {
        Some((index, _)) => Ok((kind, index)),
        None => Err(WorldError::UnknownField {
            component: info.name,
            field: field.to_owned(),
            known: field_names(info),
        }),
    }
}

fn field_names(info: &ComponentInfo) -> String {
    let names: Vec<_> = info.fields.iter().map(|field| field.name).collect();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::columns::Component;
    use crate::components::{Light, LightKind, Transform};
    use glam::Vec3;

    #[test]
    fn fields_are_read_and_written_by_name() {
        let mut world = World::new();
        let entity = world.spawn();
        world.insert(entity, Transform::default()).unwrap();
        let up = Value::Vec3(Vec3::Y);
        world
            .set_field(entity, "Transform", "translation", &up)
            .unwrap();
        assert_eq!(
            world.get_field(entity, "Transform", "translation"),
            Some(up)
        );
        assert_eq!(world.get::<Transform>(entity).unwrap().translation, Vec3::Y);
        assert_eq!(world.get_field(entity, "Light", "range"), None);
        world.insert_default(entity, "Light").unwrap();
        let spot = Value::Text("spot".to_owned());
        world.set_field(entity, "Light", "kind", &spot).unwrap();
        assert_eq!(world.get::<Light>(entity).unwrap().kind, LightKind::Spot);
        assert!(world.remove_named(entity, "Light").unwrap());
        assert!(!world.has::<Light>(entity));
    }

    #[test]
    fn refusals_say_what_would_do() {
        let mut world = World::new();
        let entity = world.spawn();
        world.insert(entity, Light::default()).unwrap();
        let mut set = |component, field, value| {
            world
                .set_field(entity, component, field, &value)
                .unwrap_err()
                .to_string()
        };
        assert_eq!(
            set("Light", "kind", Value::Text("laser".to_owned())),
            "Light.kind: `laser` is none of point, spot, directional, ambient"
        );
        assert_eq!(
            set("Light", "color", Value::Float(1.0)),
            "Light.color: expected three numbers, found a number"
        );
        assert_eq!(
            set("Light", "range", Value::Float(-1.0)),
            "Light.range: -1 is outside 0 to inf m"
        );
        assert_eq!(
            set("Light", "range", Value::Float(f32::NAN)),
            "Light.range: the value is not a number"
        );
        assert!(set("Lamp", "range", Value::Float(1.0)).contains("Transform, MeshRenderer, Light"));
        assert!(set("Light", "size", Value::Float(1.0)).contains("intensity, range"));
    }

    /// Only what the program acts upon is offered to people and scripts.
    #[test]
    fn components_without_effect_are_hidden() {
        let shown: Vec<_> = all_components()
            .filter(|info| !info.hidden())
            .map(|info| info.name)
            .collect();
        assert_eq!(
            shown,
            [
                "Transform",
                "MeshRenderer",
                "Light",
                "Camera",
                "Name",
                "Velocity",
                "RigidAnimation",
                "ClipVolume"
            ]
        );
    }

    #[test]
    fn every_component_describes_itself() {
        for info in all_components() {
            assert!(!info.doc.trim().is_empty(), "{}", info.name);
            for field in info.fields {
                assert!(!field.doc.trim().is_empty(), "{}.{}", info.name, field.name);
                assert!(field.range.0 < field.range.1);
                assert_eq!(field.is_color(), field.doc.contains("Rec. 709"));
            }
        }
        assert_eq!(Light::INFO.fields[2].name, "intensity");
        assert_eq!((Light::INFO.fields[2].default)(), Value::Float(1.0));
    }
}
