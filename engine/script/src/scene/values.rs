//! The values of fields, in the types of scripts.

use lightbench_render::problem::suggestion;
use lightbench_world::glam::{DQuat, DVec3, Vec2, Vec4};
use lightbench_world::reflect::FieldInfo;
use lightbench_world::{Entity, Value, ValueType};
use rhai::{Array, Dynamic, ImmutableString, Map};

use super::data::Data;
use super::materials::Material;
use super::shapes::{self, MeshHandle};
use super::tables::Field;
use crate::api::{Arguments, Mistake, as_number, spell};
use crate::color::Color;
use crate::names::list;

/// The value of a field, as scripts have it.
pub(super) fn to_script(data: &mut Data, info: &FieldInfo, value: Value) -> Dynamic {
    match value {
        Value::Vec3(color) if info.is_color() => Dynamic::from(Color(color.as_dvec3())),
        value => any_to_script(data, value),
    }
}

fn any_to_script(data: &mut Data, value: Value) -> Dynamic {
    match value {
        Value::Bool(on) => on.into(),
        Value::Int(whole) => whole.into(),
        Value::Float(number) => f64::from(number).into(),
        Value::Vec2(pair) => numbers(&pair.to_array()),
        Value::Vec3(vector) => Dynamic::from(vector.as_dvec3()),
        Value::Vec4(four) => numbers(&four.to_array()),
        Value::Quat(rotation) => Dynamic::from(rotation.as_dquat()),
        Value::Mat3(matrix) => rows(&matrix.transpose().to_cols_array_2d()),
        Value::Mat4(matrix) => rows(&matrix.transpose().to_cols_array_2d()),
        Value::Text(text) => text.into(),
        Value::Entity(Entity::NONE) => Dynamic::UNIT,
        Value::Entity(entity) => Dynamic::from(entity),
        Value::Mesh(mesh) => Dynamic::from(MeshHandle(mesh)),
        Value::Material(id) => Dynamic::from(Material::of(data, id)),
        Value::List(items) => {
            let items: Array = items
                .into_iter()
                .map(|item| any_to_script(data, item))
                .collect();
            items.into()
        }
        Value::Map(entries) => {
            let entries: Map = entries
                .into_iter()
                .map(|(name, value)| (name.into(), any_to_script(data, value)))
                .collect();
            entries.into()
        }
    }
}

fn numbers(numbers: &[f32]) -> Dynamic {
    let numbers: Array = numbers.iter().map(|&n| f64::from(n).into()).collect();
    numbers.into()
}

fn rows<const N: usize>(matrix: &[[f32; N]; N]) -> Dynamic {
    let rows: Array = matrix.iter().map(|row| numbers(row)).collect();
    rows.into()
}

/// A script's value as that of a field.
///
/// # Errors
/// Another kind of value, or one outside the field's range: what the field takes and what it got.
pub(super) fn from_script(
    data: &mut Data,
    field: &Field,
    value: &Dynamic,
    a: &Arguments,
) -> Result<Value, Mistake> {
    let wrong = || refused(field, value, a);
    let converted = match field.info.value_type {
        ValueType::Mesh => Value::Mesh(shapes::mesh_of(data, value).ok_or_else(wrong)??),
        ValueType::Entity => match value.read_lock::<Entity>() {
            Some(entity) => {
                data.check(*entity)?;
                Value::Entity(*entity)
            }
            None if value.is_unit() => Value::Entity(Entity::NONE),
            None => return Err(wrong()),
        },
        kind => convert(kind, value).ok_or_else(wrong)?,
    };
    if in_range(field.info, &converted) {
        Ok(converted)
    } else {
        Err(wrong())
    }
}

/// A value of a kind that needs no look at the scene.
fn convert(kind: ValueType, value: &Dynamic) -> Option<Value> {
    let text = || Some(value.read_lock::<ImmutableString>()?.to_string());
    Some(match kind {
        ValueType::Bool => Value::Bool(value.as_bool().ok()?),
        ValueType::Int => {
            let number = as_number(value).filter(|number| number.fract() == 0.0)?;
            Value::Int(number as i64)
        }
        ValueType::Float => Value::Float(as_number(value)? as f32),
        ValueType::Vec2 => Value::Vec2(Vec2::from_array(array_of(value)?)),
        ValueType::Vec3 => match value.read_lock::<DVec3>() {
            Some(vector) => Value::Vec3(vector.as_vec3()),
            None => Value::Vec3(value.read_lock::<Color>()?.0.as_vec3()),
        },
        ValueType::Vec4 => Value::Vec4(Vec4::from_array(array_of(value)?)),
        ValueType::Quat => {
            let rotation = value.read_lock::<DQuat>()?.as_quat();
            let length = rotation.length();
            Value::Quat((length.is_finite() && length > 1e-6).then(|| rotation / length)?)
        }
        ValueType::Text => Value::Text(text()?),
        ValueType::Choice(names) => {
            Value::Text(text().filter(|text| names.contains(&text.as_str()))?)
        }
        ValueType::Material => Value::Material(value.read_lock::<Material>()?.id),
        ValueType::List(kind) => {
            let items = value.read_lock::<Array>()?;
            Value::List(
                items
                    .iter()
                    .map(|item| convert(*kind, item))
                    .collect::<Option<_>>()?,
            )
        }
        ValueType::Map => {
            let entries = value.read_lock::<Map>()?;
            let entry = |(name, value): (&rhai::Identifier, &Dynamic)| {
                Some((name.to_string(), by_itself(value)?))
            };
            Value::Map(entries.iter().map(entry).collect::<Option<_>>()?)
        }
        // Only computed components hold matrices; meshes and entities are looked up before.
        ValueType::Mat3 | ValueType::Mat4 | ValueType::Mesh | ValueType::Entity => return None,
    })
}

/// An entry of a map, whose type only the value itself tells.
fn by_itself(value: &Dynamic) -> Option<Value> {
    let kind = if value.is_bool() {
        ValueType::Bool
    } else if value.is_string() {
        ValueType::Text
    } else if value.is::<DVec3>() || value.is::<Color>() {
        ValueType::Vec3
    } else if value.is::<DQuat>() {
        ValueType::Quat
    } else if value.is_map() {
        ValueType::Map
    } else if let Some(items) = value.read_lock::<Array>() {
        let items: Option<Vec<Value>> = items.iter().map(by_itself).collect();
        return items.map(Value::List);
    } else {
        ValueType::Float
    };
    convert(kind, value)
}

fn array_of<const N: usize>(value: &Dynamic) -> Option<[f32; N]> {
    let items = value.read_lock::<Array>()?;
    let numbers: Option<Vec<f32>> = items
        .iter()
        .map(|item| as_number(item).map(|number| number as f32))
        .collect();
    numbers?.try_into().ok()
}

/// Whether all numbers of a value are finite and inside the field's range.
fn in_range(info: &FieldInfo, value: &Value) -> bool {
    let (least, greatest) = info.range;
    let fits = |number: &f32| number.is_finite() && (least..=greatest).contains(number);
    match value {
        Value::Float(number) => fits(number),
        Value::Int(whole) => fits(&(*whole as f32)),
        Value::Vec2(pair) => pair.to_array().iter().all(fits),
        Value::Vec3(vector) => vector.to_array().iter().all(fits),
        Value::Vec4(four) => four.to_array().iter().all(fits),
        _ => true,
    }
}

/// The mistake of a value that a field does not take.
pub(super) fn refused(field: &Field, value: &Dynamic, a: &Arguments) -> Mistake {
    let numbers = value.is::<DVec3>() || value.is::<Color>();
    let shown = match spell(value).filter(|_| numbers) {
        Some(spelled) => format!("`{spelled}`"),
        None => a.describe(value),
    };
    let mistake = Mistake::new(format!(
        "`{}` must be {}, not {shown}",
        field.path,
        expected(field.info)
    ));
    match field.info.value_type {
        ValueType::Choice(names) => {
            let text = value.clone().into_string().unwrap_or_default();
            match suggestion(&text, names.iter().copied()) {
                Some(hint) => mistake.with_hint(hint),
                None => mistake,
            }
        }
        ValueType::Quat => {
            mistake.with_hint("a rotation is made by `turn`, as in `turn(0, 90, 0)`")
        }
        ValueType::Float if field.info.unit == "rad" => {
            mistake.with_hint("`to_radians(…)` makes radians of degrees")
        }
        _ => mistake,
    }
}

/// What a field takes, in words.
pub(crate) fn expected(info: &FieldInfo) -> String {
    let what = match info.value_type {
        ValueType::Bool => "`true` or `false`",
        ValueType::Int => "a whole number",
        ValueType::Float => "a number",
        ValueType::Vec2 => "an array of two numbers",
        ValueType::Vec3 if info.is_color() => "a color",
        ValueType::Vec3 => "a vec3",
        ValueType::Vec4 => "an array of four numbers",
        ValueType::Quat => "a rotation",
        ValueType::Mat3 => "an array of three rows of three numbers",
        ValueType::Mat4 => "an array of four rows of four numbers",
        ValueType::Text => "a text",
        ValueType::Choice(names) => return list(names.iter().copied(), "or"),
        ValueType::Entity => "an entity, or `()` for none",
        ValueType::Mesh => "a mesh or a shape",
        ValueType::Material => "a material",
        ValueType::List(_) => "an array",
        ValueType::Map => return "a map, as `get` gives it".to_owned(),
    };
    let parts = match info.value_type {
        ValueType::Int | ValueType::Float => "",
        _ => "whose parts are ",
    };
    let range = match info.range {
        (f32::NEG_INFINITY, f32::INFINITY) => String::new(),
        (least, f32::INFINITY) if parts.is_empty() => format!(" of at least {least}"),
        (least, f32::INFINITY) => format!(" {parts}at least {least}"),
        (least, greatest) => format!(" {parts}from {least} to {greatest}"),
    };
    let unit = match info.unit {
        "" => String::new(),
        unit => format!(", in {unit}"),
    };
    format!("{what}{range}{unit}")
}
