//! Components and fields of an entity by name.

use lightbench_world::{ComponentKind, Entity, Value, WorldError};
use rhai::{Array, Dynamic, Map};

use super::cameras;
use super::data::{Data, Stage};
use super::entities::{getter, method};
use super::tables::{self, Component, Field};
use super::values::{from_script, to_script};
use crate::api::{Api, Arguments, Mistake};

const SET: &str = "Writes a field by its name, as in `set(\"light.range\", 4)`: any field of any \
                   component that the entity has. Units and ranges are those of the component: \
                   angles are in radians. A field takes a number, `true` or `false`, a vec3, a \
                   color, a rotation, a text, the name of a choice, a mesh or a shape, a material, \
                   or a map of keys; numbers must be finite. What the engine computes can't be \
                   written.";
const GET: &str = "Reads a field by its name, as in `get(\"light.range\")`: any field of any \
                   component that the entity has, also of those that the engine computes. Units \
                   are those of the component: angles are in radians. A matrix is an array of \
                   rows, an entity that is none is `()`.";
const ADD: &str = "Gives the entity a component, with its default values unless `values` says \
                   more: a map of fields, as in `add(\"velocity\", #{ linear: vec3(0, 1, 0) })`. \
                   A component that it has keeps its other values.";

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.section("Components and fields by name");
    components(api, stage);
    for form in ["add(component)", "add(component, values)"] {
        method(api, stage, form, ADD, |data, entity, a| {
            let values = Values::of(data, a)?;
            values.add(data, entity)
        });
    }
    method(
        api,
        stage,
        "drop(component)",
        "Takes a component away from the entity. Nothing happens if it has none.",
        |data, entity, a| {
            let component = tables::component(&a.text(0)?)?;
            component.refuse_computed()?;
            drop_component(data, entity, component)
        },
    );
    let read = stage.clone();
    api.method("get(field)", GET, move |entity: Entity, a| {
        let field = field_argument(a, 0)?;
        get(&mut read.lock(), entity, field)
    });
    method(api, stage, "set(field, value)", SET, |data, entity, a| {
        let field = field_argument(a, 0)?;
        field.refuse_computed()?;
        let value = from_script(data, field, a.value(1), a)?;
        set(data, entity, field, &value)
    });
}

fn components(api: &mut Api, stage: &Stage) {
    getter(
        api,
        stage,
        "components",
        "The names of the components that the entity has, as an array of texts. Those that the \
         engine computes are among them.",
        |data, entity| {
            data.check(entity)?;
            let known = tables::components().iter();
            let names: Array = known
                .filter(|component| data.world.has_component(entity, component.kind))
                .map(|component| component.name.as_str().into())
                .collect();
            Ok(names)
        },
    );
    let asked = stage.clone();
    api.method(
        "has_component(name)",
        "Whether the entity has a component.",
        move |entity: Entity, a| {
            let component = tables::component(&a.text(0)?)?;
            let data = asked.lock();
            data.check(entity)?;
            Ok(data.world.has_component(entity, component.kind))
        },
    );
    api.method(
        "fields(component)",
        "The names of the fields of a component, as an array of texts: those that `get` and `set` \
         take behind the point. The entity need not have the component.",
        |_: Entity, a| {
            let component = tables::component(&a.text(0)?)?;
            let fields = component.kind.info().fields.iter();
            let names: Array = fields.map(|field| field.name.into()).collect();
            Ok(names)
        },
    );
}

/// The field that an argument names.
pub(super) fn field_argument(a: &Arguments, index: usize) -> Result<&'static Field, Mistake> {
    match a.value(index).read_lock::<rhai::ImmutableString>() {
        Some(path) => tables::field(&path),
        None => Err(a.wrong(index, "the name of a field, as in \"light.range\"")),
    }
}

/// A component with values for some of its fields, from the arguments of `add`.
pub(super) struct Values {
    component: &'static Component,
    fields: Vec<(&'static Field, Value)>,
}

impl Values {
    pub(super) fn of(data: &mut Data, a: &Arguments) -> Result<Self, Mistake> {
        let component = tables::component(&a.text(0)?)?;
        component.refuse_computed()?;
        let mut fields = Vec::new();
        if a.len() == 2 {
            let Some(values) = a.value(1).read_lock::<Map>() else {
                return Err(a.wrong(1, "a map of fields, as in `#{ range: 4 }`"));
            };
            for (name, value) in values.iter() {
                let field = tables::field_of(component, name)?;
                fields.push((field, from_script(data, field, value, a)?));
            }
        }
        Ok(Self { component, fields })
    }

    /// Gives an entity the component, or leaves it as it was.
    pub(super) fn add(&self, data: &mut Data, entity: Entity) -> Result<(), Mistake> {
        data.check(entity)?;
        let had = data.world.has_component(entity, self.component.kind);
        let name = self.component.kind.info().name;
        let added = data.world.insert_default(entity, name);
        added.map_err(|error| Mistake::new(error.to_string()))?;
        for (field, value) in &self.fields {
            // The values fit. Only a curve can turn out to be none.
            if let Err(mistake) = set(data, entity, field, value) {
                if !had {
                    drop_component(data, entity, self.component)?;
                }
                return Err(mistake);
            }
        }
        Ok(())
    }
}

/// Takes a component away.
pub(super) fn drop_component(
    data: &mut Data,
    entity: Entity,
    component: &Component,
) -> Result<(), Mistake> {
    data.check(entity)?;
    let name = component.kind.info().name;
    let removed = data.world.remove_named(entity, name);
    removed.map_err(|error| Mistake::new(error.to_string()))?;
    Ok(())
}

/// Reads one field.
pub(super) fn get(data: &mut Data, entity: Entity, field: &Field) -> Result<Dynamic, Mistake> {
    let value = data.world.field_at(entity, field.kind, field.index);
    match value {
        Some(value) => Ok(to_script(data, field.info, value)),
        None => Err(missing(data, entity, field)),
    }
}

/// Writes one field, with a value that fits it.
pub(super) fn set(
    data: &mut Data,
    entity: Entity,
    field: &Field,
    value: &Value,
) -> Result<(), Mistake> {
    let written = data
        .world
        .set_field_at(entity, field.kind, field.index, value);
    written.map_err(|error| match error {
        WorldError::BadValue { reason, .. } => Mistake::new(format!("`{}`: {reason}", field.path)),
        _ => missing(data, entity, field),
    })?;
    if let (ComponentKind::Name, Value::Text(name)) = (field.kind, value) {
        data.note_name(entity, name);
    }
    follow(data, field, &[entity])
}

/// Does what the typed calls do beside writing: what is turned to a point stays turned to it when it
/// moves, until its rotation is written; and a camera's near plane stays before its far plane.
pub(super) fn follow(data: &mut Data, field: &Field, entities: &[Entity]) -> Result<(), Mistake> {
    let turned = matches!(
        (field.kind, field.info.name),
        (
            ComponentKind::Transform | ComponentKind::RigidAnimation,
            "rotation"
        ) | (ComponentKind::Velocity, "angular")
    );
    for &entity in entities {
        if field.kind == ComponentKind::Camera {
            cameras::change(data, entity, |_| {})?;
        } else if data.aims.is_empty() {
            return Ok(());
        } else if turned {
            data.aims.remove(&entity);
        } else if field.kind == ComponentKind::Transform && data.aims.contains_key(&entity) {
            data.place(entity, |_| {})?;
        }
    }
    Ok(())
}

/// The mistake of an entity that lacks a component.
pub(super) fn missing(data: &Data, entity: Entity, field: &Field) -> Mistake {
    if let Err(removed) = data.check(entity) {
        return removed;
    }
    let name = &field.component;
    let mistake = Mistake::new(format!("{} has no `{name}`", data.called(entity)));
    match field.refuse_computed() {
        Ok(()) => mistake.with_hint(format!("`.add(\"{name}\")` gives it one")),
        Err(_) => mistake,
    }
}
