//! One field of all entities of a selection at once.

use lightbench_world::glam::Vec3;
use lightbench_world::{Entity, Lane, Refused, Value, ValueType, WorldError};
use rhai::{Array, Dynamic};

use super::Selection;
use crate::api::{Api, Arguments, Mistake, not_finite, spell_call};
use crate::scene::columns::Column;
use crate::scene::data::{Data, Stage};
use crate::scene::fields::{self, field_argument, follow, missing};
use crate::scene::tables::Field;
use crate::scene::values::{expected, from_script};

const GET: &str = "Reads a field of all entities, named as in `get` of an entity. Numbers, vectors \
                   and colors come as a column, with one value for each entity in the selection's \
                   order; other values as an array.";
const SET: &str = "Writes a field of all entities, named as in `set` of an entity: a column or an \
                   array with one value for each entity in the selection's order, or one value for \
                   all. Nothing is written if one of the values does not fit.";

pub(super) fn register(api: &mut Api, stage: &Stage) {
    let read = stage.clone();
    api.method("get(field)", GET, move |selection: Selection, a| {
        let field = field_argument(a, 0)?;
        get(&mut read.lock(), &selection.0, field)
    });
    super::method(api, stage, "set(field, value)", SET, |data, entities, a| {
        let field = field_argument(a, 0)?;
        field.refuse_computed()?;
        set(data, entities, field, a)?;
        follow(data, field, entities)
    });
}

fn get(data: &mut Data, entities: &[Entity], field: &Field) -> Result<Dynamic, Mistake> {
    let refused = |refused: Refused| missing_of(data, entities, field, &refused);
    let world = &data.world;
    Ok(match field.info.value_type {
        ValueType::Float => {
            let numbers = world.gather(field.kind, field.index, entities, |n: f32| f64::from(n));
            Dynamic::from(Column::numbers(numbers.map_err(refused)?))
        }
        ValueType::Vec3 => {
            let vectors = world.gather(field.kind, field.index, entities, |v: Vec3| v.as_dvec3());
            Dynamic::from(Column::vectors(vectors.map_err(refused)?))
        }
        _ => {
            let values: Array = entities
                .iter()
                .map(|&entity| fields::get(data, entity, field))
                .collect::<Result<_, _>>()?;
            values.into()
        }
    })
}

fn set(data: &mut Data, entities: &[Entity], field: &Field, a: &Arguments) -> Result<(), Mistake> {
    let value = a.value(1);
    if let Some(column) = value.read_lock::<Column>() {
        return set_column(data, entities, field, &column);
    }
    let several = !matches!(field.info.value_type, ValueType::List(_));
    match value.read_lock::<Array>().filter(|_| several) {
        Some(array) => {
            same_count("array", array.len(), entities)?;
            // All are looked at before any is written.
            let mut values = Vec::with_capacity(array.len());
            for (index, item) in array.iter().enumerate() {
                let value = from_script(data, field, item, a);
                values.push(value.map_err(|mistake| at(index, mistake))?);
            }
            present(data, entities, field)?;
            let mut pairs = entities.iter().zip(&values);
            pairs.try_for_each(|(&entity, value)| fields::set(data, entity, field, value))
        }
        None => {
            let value = from_script(data, field, value, a)?;
            match value {
                Value::Float(number) => {
                    scatter(data, entities, field, &vec![number; entities.len()])
                }
                Value::Vec3(vector) => {
                    scatter(data, entities, field, &vec![vector; entities.len()])
                }
                value => {
                    present(data, entities, field)?;
                    let mut entities = entities.iter();
                    entities.try_for_each(|&entity| fields::set(data, entity, field, &value))
                }
            }
        }
    }
}

fn set_column(
    data: &mut Data,
    entities: &[Entity],
    field: &Field,
    column: &Column,
) -> Result<(), Mistake> {
    same_count("column", column.len(), entities)?;
    match (field.info.value_type, column) {
        (ValueType::Float, Column::Numbers(numbers)) => {
            let numbers: Vec<f32> = numbers.iter().map(|&number| number as f32).collect();
            finite(field, &numbers, |number| [number, 0.0, 0.0])?;
            scatter(data, entities, field, &numbers)
        }
        (ValueType::Vec3, Column::Vectors(vectors)) => {
            let vectors: Vec<Vec3> = vectors.iter().map(|v| v.as_vec3()).collect();
            finite(field, &vectors, |v| v.to_array())?;
            scatter(data, entities, field, &vectors)
        }
        (_, column) => Err(Mistake::new(format!(
            "`{}` must be {}, not a column of {}",
            field.path,
            expected(field.info),
            column.kind()
        ))),
    }
}

/// Refuses what a division by zero makes. The field's range is the world's to check.
fn finite<F: Copy>(
    field: &Field,
    values: &[F],
    numbers: impl Fn(F) -> [f32; 3],
) -> Result<(), Mistake> {
    // A loop without a way out is one that the processor takes several values at a time in.
    let all = |numbers: [f32; 3]| numbers.iter().fold(true, |all, n| all & n.is_finite());
    if values
        .iter()
        .fold(true, |so_far, &value| so_far & all(numbers(value)))
    {
        return Ok(());
    }
    for (index, &value) in values.iter().enumerate() {
        if let Some(&number) = numbers(value).iter().find(|number| !number.is_finite()) {
            let what = format!("value `[{index}]` for `{}`", field.path);
            return Err(not_finite(&what, f64::from(number)));
        }
    }
    Ok(())
}

fn scatter<F: Lane + Shown>(
    data: &mut Data,
    entities: &[Entity],
    field: &Field,
    values: &[F],
) -> Result<(), Mistake> {
    let written = data
        .world
        .scatter(field.kind, field.index, entities, values);
    written.map_err(|refused| match &refused.error {
        WorldError::BadValue { .. } => {
            let value = values.get(refused.index).map_or(String::new(), F::shown);
            at(
                refused.index,
                Mistake::new(format!(
                    "`{}` must be {}, not {value}",
                    field.path,
                    expected(field.info)
                )),
            )
        }
        _ => missing_of(data, entities, field, &refused),
    })
}

/// A value that a message can show.
trait Shown {
    fn shown(&self) -> String;
}

impl Shown for f32 {
    fn shown(&self) -> String {
        format!("the number {self}")
    }
}

impl Shown for Vec3 {
    fn shown(&self) -> String {
        format!("`{}`", spell_call("vec3", self.as_dvec3()))
    }
}

/// The mistake with the place of the value in its column or array.
fn at(index: usize, mistake: Mistake) -> Mistake {
    Mistake {
        message: format!("value `[{index}]`: {}", mistake.message),
        ..mistake
    }
}

fn same_count(what: &str, values: usize, entities: &[Entity]) -> Result<(), Mistake> {
    if values == entities.len() {
        return Ok(());
    }
    Err(Mistake::new(format!(
        "the {what} has {values} values, and the selection {} entities",
        entities.len()
    )))
}

/// Refuses a selection in which an entity lacks the component.
fn present(data: &Data, entities: &[Entity], field: &Field) -> Result<(), Mistake> {
    let lacks = |entity: &&Entity| !data.world.has_component(**entity, field.kind);
    match entities.iter().find(lacks) {
        Some(&entity) => Err(missing_in(data, entity, field)),
        None => Ok(()),
    }
}

fn missing_of(data: &Data, entities: &[Entity], field: &Field, refused: &Refused) -> Mistake {
    match entities.get(refused.index) {
        Some(&entity) => missing_in(data, entity, field),
        None => Mistake::new(refused.error.to_string()),
    }
}

/// The mistake of an entity of a selection that was removed or lacks a component.
fn missing_in(data: &Data, entity: Entity, field: &Field) -> Mistake {
    if data.world.contains(entity) {
        let hint = format!(
            "`.with(\"{}\")` keeps the entities that have one",
            field.component
        );
        return missing(data, entity, field).with_hint(hint);
    }
    Mistake::new("an entity of the selection was removed")
        .with_hint("ask for the selection again where entities come and go")
}
