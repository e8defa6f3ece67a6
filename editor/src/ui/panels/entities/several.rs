//! Fields of several entities together.

use lightbench::script::Scene;
use lightbench::script::overlays::{degrees_of, rotation_of};
use lightbench::world::glam::{DVec3, Vec2, Vec3, Vec4};
use lightbench::world::{ComponentKind, Entity, Value};

/// For more entities than these it is not looked whether values differ: that would take longer than a
/// frame.
pub const COMPARED: usize = 1000;

/// Degrees by which a person can't have turned something.
const TURN: f64 = 1e-3;

/// Whether entities have different values in a field.
pub fn differ(
    scene: &Scene,
    entities: &[Entity],
    kind: ComponentKind,
    field: usize,
    value: &Value,
) -> bool {
    let few = entities.len() <= COMPARED;
    let value_of = |entity: &Entity| scene.world.field_at(*entity, kind, field);
    few && entities
        .iter()
        .any(|entity| value_of(entity).as_ref() != Some(value))
}

/// What another entity gets where a person has changed a field from one value to another: the parts
/// that have changed. The others stay its own.
pub fn carried_over(from: &Value, to: &Value, own: &Value) -> Value {
    match (from, to, own) {
        (Value::Vec2(from), Value::Vec2(to), Value::Vec2(own)) => Value::Vec2(Vec2::from_array(
            mixed(from.to_array(), to.to_array(), own.to_array()),
        )),
        (Value::Vec3(from), Value::Vec3(to), Value::Vec3(own)) => Value::Vec3(Vec3::from_array(
            mixed(from.to_array(), to.to_array(), own.to_array()),
        )),
        (Value::Vec4(from), Value::Vec4(to), Value::Vec4(own)) => Value::Vec4(Vec4::from_array(
            mixed(from.to_array(), to.to_array(), own.to_array()),
        )),
        (Value::Quat(from), Value::Quat(to), Value::Quat(own)) => {
            let (from, to) = (degrees_of(*from).to_array(), degrees_of(*to).to_array());
            let mut degrees = degrees_of(*own).to_array();
            let mut turned = from.iter().zip(&to).map(|(a, b)| (a - b).abs() > TURN);
            let count = turned.clone().filter(|turned| *turned).count();
            if count != 1 {
                // Near the poles one turn is several angles.
                return Value::Quat(rotation_of(DVec3::from_array(to)));
            }
            if let Some(axis) = turned.position(|turned| turned) {
                degrees[axis] = to[axis];
            }
            Value::Quat(rotation_of(DVec3::from_array(degrees)))
        }
        _ => to.clone(),
    }
}

fn mixed<const N: usize>(from: [f32; N], to: [f32; N], own: [f32; N]) -> [f32; N] {
    std::array::from_fn(|part| match from[part] == to[part] {
        true => own[part],
        false => to[part],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_parts_that_changed_are_carried_over() {
        let vector = |x, y, z| Value::Vec3(Vec3::new(x, y, z));
        let (from, to) = (vector(1.0, 2.0, 3.0), vector(1.0, 5.0, 3.0));
        let own = vector(7.0, 8.0, 9.0);
        assert_eq!(carried_over(&from, &to, &own), vector(7.0, 5.0, 9.0));
        let number = Value::Float(4.0);
        let other = Value::Float(9.0);
        assert_eq!(carried_over(&Value::Float(1.0), &number, &other), number);

        let turned = |x, y, z| Value::Quat(rotation_of(DVec3::new(x, y, z)));
        let (from, to) = (turned(0.0, 10.0, 0.0), turned(0.0, 50.0, 0.0));
        let Value::Quat(got) = carried_over(&from, &to, &turned(20.0, 0.0, 30.0)) else {
            unreachable!("a rotation stays one");
        };
        let wanted = DVec3::new(20.0, 50.0, 30.0);
        assert!((degrees_of(got) - wanted).abs().max_element() < 1e-3);
    }
}
