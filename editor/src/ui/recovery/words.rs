//! Changes by hand as JSON. Numbers of 32 bits are written with 64, which hold them exactly.

use lightbench::script::overlays::{Edit, KeptEdit, KeptField, KeptOverlays, NewKind, Who};
use lightbench::world::glam::{Quat, Vec2, Vec3, Vec4};
use lightbench::world::{ComponentKind, Transform, Value as Field};
use serde_json::{Value, json};

use super::asset_words::{asset_from, asset_to};

/// `None` where a value is of a kind that nobody can change by hand.
pub(super) fn overlays_to(kept: &KeptOverlays) -> Option<Value> {
    let edits = kept.edits.iter().map(|kept| {
        Some(json!({
            "edit": edit_to(&kept.edit),
            "fields": fields_to(&kept.fields)?,
            "greatest": kept.greatest,
        }))
    });
    Some(json!({
        "edits": edits.collect::<Option<Vec<Value>>>()?,
        "fields": fields_to(&kept.fields)?,
    }))
}

pub(super) fn overlays_from(value: &Value) -> Option<KeptOverlays> {
    let edits = value["edits"].as_array()?.iter().map(|kept| {
        Some(KeptEdit {
            edit: edit_from(&kept["edit"])?,
            fields: fields_from(&kept["fields"])?,
            greatest: whole(&kept["greatest"])?,
        })
    });
    Some(KeptOverlays {
        edits: edits.collect::<Option<_>>()?,
        fields: fields_from(&value["fields"])?,
    })
}

fn fields_to(fields: &[KeptField]) -> Option<Value> {
    let all = fields.iter();
    let all = all.map(|(entity, path, value)| Some(json!([entity, path, field_to(value)?])));
    all.collect()
}

fn fields_from(value: &Value) -> Option<Vec<KeptField>> {
    let all = value.as_array()?.iter();
    all.map(|one| Some((text(&one[0])?, text(&one[1])?, field_from(&one[2])?)))
        .collect()
}

pub(super) fn numbers(all: &[f32]) -> Value {
    all.iter().map(|number| f64::from(*number)).collect()
}

pub(super) fn array<const N: usize>(value: &Value) -> Option<[f32; N]> {
    let all = value.as_array()?;
    let numbers: Option<Vec<f32>> = all
        .iter()
        .map(|number| number.as_f64().map(|number| number as f32))
        .collect();
    numbers?.try_into().ok()
}

pub(super) fn text(value: &Value) -> Option<String> {
    value.as_str().map(str::to_owned)
}

pub(super) fn whole(value: &Value) -> Option<u32> {
    value.as_u64()?.try_into().ok()
}

fn field_to(value: &Field) -> Option<Value> {
    let (kind, value) = match value {
        Field::Bool(on) => ("bool", json!(on)),
        Field::Int(number) => ("int", json!(number)),
        Field::Float(number) => ("float", json!(f64::from(*number))),
        Field::Vec2(pair) => ("vec2", numbers(&pair.to_array())),
        Field::Vec3(vector) => ("vec3", numbers(&vector.to_array())),
        Field::Vec4(four) => ("vec4", numbers(&four.to_array())),
        Field::Quat(rotation) => ("quat", numbers(&rotation.to_array())),
        Field::Text(text) => ("text", json!(text)),
        _ => return None,
    };
    Some(json!({ kind: value }))
}

fn field_from(value: &Value) -> Option<Field> {
    let (kind, value) = value.as_object()?.iter().next()?;
    Some(match kind.as_str() {
        "bool" => Field::Bool(value.as_bool()?),
        "int" => Field::Int(value.as_i64()?),
        "float" => Field::Float(value.as_f64()? as f32),
        "vec2" => Field::Vec2(Vec2::from_array(array(value)?)),
        "vec3" => Field::Vec3(Vec3::from_array(array(value)?)),
        "vec4" => Field::Vec4(Vec4::from_array(array(value)?)),
        "quat" => Field::Quat(Quat::from_array(array(value)?)),
        "text" => Field::Text(text(value)?),
        _ => return None,
    })
}

pub(super) fn who_to(who: &Who) -> Value {
    json!([who.name, who.nth])
}

pub(super) fn who_from(value: &Value) -> Option<Who> {
    Some(Who {
        name: text(&value[0])?,
        nth: whole(&value[1])?,
    })
}

pub(super) fn maybe_to(who: Option<&Who>) -> Value {
    who.map_or(Value::Null, who_to)
}

/// `None` outside where there is something that is no name.
pub(super) fn maybe_from(value: &Value) -> Option<Option<Who>> {
    match value {
        Value::Null => Some(None),
        who => who_from(who).map(Some),
    }
}

pub(super) fn place_to(place: &Transform) -> Value {
    json!({
        "translation": numbers(&place.translation.to_array()),
        "rotation": numbers(&place.rotation.to_array()),
        "scale": numbers(&place.scale.to_array()),
    })
}

pub(super) fn place_from(value: &Value) -> Option<Transform> {
    Some(Transform {
        translation: Vec3::from_array(array(&value["translation"])?),
        rotation: Quat::from_array(array(&value["rotation"])?),
        scale: Vec3::from_array(array(&value["scale"])?),
    })
}

pub(super) fn all_to(of: &[Who]) -> Value {
    of.iter().map(who_to).collect()
}

pub(super) fn all_from(value: &Value) -> Option<Vec<Who>> {
    value.as_array()?.iter().map(who_from).collect()
}

fn edit_to(edit: &Edit) -> Value {
    match edit {
        Edit::Create {
            kind,
            name,
            number,
            place,
        } => json!({
            "do": "create",
            "kind": kind.name(),
            "name": name,
            "number": number,
            "place": place_to(place),
        }),
        Edit::Copy { of, names, number } => {
            json!({ "do": "copy", "of": all_to(of), "names": names, "number": number })
        }
        Edit::Delete { of } => json!({ "do": "delete", "of": all_to(of) }),
        Edit::Rename { of } => {
            let of: Value = of.iter().map(|(who, n)| json!([who_to(who), n])).collect();
            json!({ "do": "rename", "of": of })
        }
        Edit::Parent { of, to } => {
            json!({ "do": "parent", "of": all_to(of), "to": maybe_to(to.as_ref()) })
        }
        Edit::Add { of, component } => {
            json!({ "do": "add", "of": all_to(of), "component": component.info().name })
        }
        Edit::Drop { of, component } => {
            json!({ "do": "drop", "of": all_to(of), "component": component.info().name })
        }
        Edit::Tag { of, tag, on } => {
            json!({ "do": "tag", "of": all_to(of), "tag": tag, "on": on })
        }
        Edit::Assets(edit) => json!({ "do": "assets", "what": asset_to(edit) }),
    }
}

fn edit_from(value: &Value) -> Option<Edit> {
    let of = || all_from(&value["of"]);
    let component = || ComponentKind::from_name(value["component"].as_str()?);
    Some(match value["do"].as_str()? {
        "create" => {
            let kind = value["kind"].as_str()?;
            Edit::Create {
                kind: NewKind::ALL
                    .into_iter()
                    .find(|known| known.name() == kind)?,
                name: text(&value["name"])?,
                number: whole(&value["number"])?,
                place: place_from(&value["place"])?,
            }
        }
        "copy" => {
            let names = value["names"].as_array()?.iter();
            let names = names.map(|pair| Some((text(&pair[0])?, text(&pair[1])?)));
            Edit::Copy {
                of: of()?,
                names: names.collect::<Option<_>>()?,
                number: whole(&value["number"])?,
            }
        }
        "delete" => Edit::Delete { of: of()? },
        "rename" => {
            let all = value["of"].as_array()?.iter();
            let all = all.map(|pair| Some((who_from(&pair[0])?, text(&pair[1])?)));
            Edit::Rename {
                of: all.collect::<Option<_>>()?,
            }
        }
        "parent" => Edit::Parent {
            of: of()?,
            to: maybe_from(&value["to"])?,
        },
        "add" => Edit::Add {
            of: of()?,
            component: component()?,
        },
        "drop" => Edit::Drop {
            of: of()?,
            component: component()?,
        },
        "assets" => Edit::Assets(asset_from(&value["what"])?),
        "tag" => Edit::Tag {
            of: of()?,
            tag: text(&value["tag"])?,
            on: value["on"].as_bool()?,
        },
        _ => return None,
    })
}
