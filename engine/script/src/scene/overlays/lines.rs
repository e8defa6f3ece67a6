//! What a person changed by hand, as the line of a scene script that does the same.

use lightbench_world::Value;
use lightbench_world::glam::{DVec3, EulerRot, Quat, Vec3};

use super::super::tables;
use crate::math::from_degrees;
use crate::spelling::{spell_number, spell_text};

/// Methods by which scripts write a field more shortly than by its path, and the numbers that they
/// take.
const METHODS: [(&str, &str, f32); 4] = [
    ("transform.translation", "at", f32::INFINITY),
    ("transform.rotation", "turn", f32::INFINITY),
    ("transform.scale", "scale", f32::INFINITY),
    ("light.intensity", "intensity", 1e9),
];

/// The line of a scene script that gives a field of the entity of that name a value, as in
/// `entity("lamp").intensity(40.0);`. `None` for values that scripts can't spell.
#[must_use]
pub fn line(entity: &str, path: &str, value: &Value) -> Option<String> {
    let field = tables::field(path).ok()?;
    let spelled = match value {
        Value::Bool(on) => on.to_string(),
        Value::Int(whole) => whole.to_string(),
        Value::Float(number) => spell_single(*number),
        Value::Vec2(pair) => array(&pair.to_array()),
        Value::Vec3(color) if field.info.is_color() => call("rgb", *color),
        Value::Vec3(vector) => call("vec3", *vector),
        Value::Vec4(four) => array(&four.to_array()),
        Value::Quat(rotation) => {
            let degrees = degrees_of(*rotation).to_array().map(spell_number);
            format!("turn({})", degrees.join(", "))
        }
        Value::Text(text) => spell_text(text),
        Value::Mat3(_)
        | Value::Mat4(_)
        | Value::Entity(_)
        | Value::Mesh(_)
        | Value::Material(_)
        | Value::List(_)
        | Value::Map(_) => return None,
    };
    let entity = format!("entity({})", spell_text(entity));
    let fits = |most: f32| match value {
        Value::Float(number) => *number <= most,
        _ => true,
    };
    let method = METHODS.iter().find(|(known, ..)| *known == path);
    Some(match method {
        Some((_, method, most)) if fits(*most) => {
            // The numbers stand alone, without the call around them.
            let numbers = spelled
                .split_once('(')
                .map_or(spelled.as_str(), |(_, inside)| {
                    inside.strip_suffix(')').unwrap_or(inside)
                });
            format!("{entity}.{method}({numbers});")
        }
        _ => format!("{entity}.set({}, {spelled});", spell_text(path)),
    })
}

/// A rotation as degrees about x, y and z, as `turn` takes them.
#[must_use]
pub fn degrees_of(rotation: Quat) -> DVec3 {
    let (y, x, z) = rotation.as_dquat().to_euler(EulerRot::YXZ);
    DVec3::new(x.to_degrees(), y.to_degrees(), z.to_degrees())
}

/// The rotation that `turn` makes of degrees about x, y and z.
#[must_use]
pub fn rotation_of(degrees: DVec3) -> Quat {
    from_degrees(degrees).as_quat().normalize()
}

/// A number of 32 bits with as few digits as it takes to read back the same bits.
pub(crate) fn spell_single(number: f32) -> String {
    let short: f64 = number.to_string().parse().unwrap_or_default();
    // What scripts read has 64 bits, and is rounded once more.
    if short as f32 == number {
        spell_number(short)
    } else {
        spell_number(number.into())
    }
}

fn array(numbers: &[f32]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|n| spell_single(*n)).collect();
    format!("[{}]", numbers.join(", "))
}

fn call(name: &str, vector: Vec3) -> String {
    format!("{name}({})", spell_point(vector))
}

/// Three numbers as the arguments of a call.
pub(crate) fn spell_point(point: Vec3) -> String {
    point.to_array().map(spell_single).join(", ")
}
