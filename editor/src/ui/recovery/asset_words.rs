//! Changes of materials, meshes and textures as JSON, as [`words`](super::words) has the others.

use lightbench::assets::Reflection;
use lightbench::script::overlays::{AssetEdit, Picture, SurfaceField, SurfaceValue, Who};
use lightbench::world::glam::Vec3;
use serde_json::{Value, json};

use super::words::{
    all_from, all_to, array, maybe_from, maybe_to, numbers, place_from, place_to, text, who_from,
    who_to, whole,
};

pub(super) fn asset_to(edit: &AssetEdit) -> Value {
    match edit {
        AssetEdit::NewMaterial { name, like } => {
            json!({ "asset": "new_material", "name": name, "like": maybe_to(like.as_ref()) })
        }
        AssetEdit::RenameMaterial { of, name } => {
            json!({ "asset": "rename_material", "of": who_to(of), "name": name })
        }
        AssetEdit::DeleteMaterial { of } => {
            json!({ "asset": "delete_material", "of": all_to(of) })
        }
        AssetEdit::Paint { field, of } => {
            let of = of.iter();
            let of: Value = of
                .map(|(who, value)| json!([who_to(who), value.as_ref().map(surface_to)]))
                .collect();
            json!({ "asset": "paint", "field": field.name(), "of": of })
        }
        AssetEdit::Dress { of, material } => {
            json!({ "asset": "dress", "of": all_to(of), "to": maybe_to(material.as_ref()) })
        }
        AssetEdit::NewMesh { recipe } => json!({ "asset": "new_mesh", "recipe": recipe }),
        AssetEdit::Reshape { of, mesh } => {
            json!({ "asset": "reshape", "of": all_to(of), "to": maybe_to(mesh.as_ref()) })
        }
        AssetEdit::DeleteMesh { of } => json!({ "asset": "delete_mesh", "of": who_to(of) }),
        AssetEdit::NewTexture { recipe } => json!({ "asset": "new_texture", "recipe": recipe }),
        AssetEdit::DeleteTexture { of } => json!({ "asset": "delete_texture", "of": who_to(of) }),
        AssetEdit::AddModel {
            path,
            name,
            number,
            place,
        } => json!({
            "asset": "add_model",
            "path": path,
            "name": name,
            "number": number,
            "place": place_to(place),
        }),
    }
}

pub(super) fn asset_from(value: &Value) -> Option<AssetEdit> {
    let of = || all_from(&value["of"]);
    let one = || who_from(&value["of"]);
    let name = || text(&value["name"]);
    let recipe = || text(&value["recipe"]);
    Some(match value["asset"].as_str()? {
        "new_material" => AssetEdit::NewMaterial {
            name: name()?,
            like: maybe_from(&value["like"])?,
        },
        "rename_material" => AssetEdit::RenameMaterial {
            of: one()?,
            name: name()?,
        },
        "delete_material" => AssetEdit::DeleteMaterial { of: of()? },
        "paint" => {
            let field = value["field"].as_str()?;
            let of = value["of"].as_array()?.iter();
            let of = of.map(|pair| {
                let value = match &pair[1] {
                    Value::Null => None,
                    value => Some(surface_from(value)?),
                };
                Some((who_from(&pair[0])?, value))
            });
            AssetEdit::Paint {
                field: SurfaceField::ALL
                    .into_iter()
                    .find(|known| known.name() == field)?,
                of: of.collect::<Option<Vec<(Who, Option<SurfaceValue>)>>>()?,
            }
        }
        "dress" => AssetEdit::Dress {
            of: of()?,
            material: maybe_from(&value["to"])?,
        },
        "new_mesh" => AssetEdit::NewMesh { recipe: recipe()? },
        "reshape" => AssetEdit::Reshape {
            of: of()?,
            mesh: maybe_from(&value["to"])?,
        },
        "delete_mesh" => AssetEdit::DeleteMesh { of: one()? },
        "new_texture" => AssetEdit::NewTexture { recipe: recipe()? },
        "delete_texture" => AssetEdit::DeleteTexture { of: one()? },
        "add_model" => AssetEdit::AddModel {
            path: text(&value["path"])?,
            name: name()?,
            number: whole(&value["number"])?,
            place: place_from(&value["place"])?,
        },
        _ => return None,
    })
}

fn surface_to(value: &SurfaceValue) -> Value {
    match value {
        SurfaceValue::Color(color) => json!({ "color": numbers(&color.to_array()) }),
        SurfaceValue::Picture(Picture::None) => json!({ "picture": null }),
        SurfaceValue::Picture(Picture::Made(call)) => json!({ "picture": call }),
        SurfaceValue::Picture(Picture::Known(who)) => json!({ "picture": who_to(who) }),
        SurfaceValue::Reflection(reflection) => {
            let parameters: &[f32] = match reflection {
                Reflection::BlinnPhong { power } | Reflection::Phong { power } => &[*power],
                Reflection::Beckmann { roughness } | Reflection::Ggx { roughness } => &[*roughness],
                Reflection::Ward { along, across } => &[*along, *across],
            };
            json!({ "reflection": reflection.model().name(), "parameters": numbers(parameters) })
        }
        SurfaceValue::Share(share) => json!({ "share": f64::from(*share) }),
        SurfaceValue::Cutoff(cutoff) => json!({ "cutoff": cutoff.map(f64::from) }),
        SurfaceValue::Switch(on) => json!({ "on": on }),
    }
}

fn surface_from(value: &Value) -> Option<SurfaceValue> {
    let number = |value: &Value| value.as_f64().map(|number| number as f32);
    let (kind, inner) = value
        .as_object()?
        .iter()
        .find(|(kind, _)| *kind != "parameters")?;
    Some(match kind.as_str() {
        "color" => SurfaceValue::Color(Vec3::from_array(array(inner)?)),
        "picture" => SurfaceValue::Picture(match inner {
            Value::Null => Picture::None,
            Value::String(call) => Picture::Made(call.clone()),
            who => Picture::Known(who_from(who)?),
        }),
        "reflection" => {
            let one = || array::<1>(&value["parameters"]).map(|[one]| one);
            SurfaceValue::Reflection(match inner.as_str()? {
                "blinn_phong" => Reflection::BlinnPhong { power: one()? },
                "phong" => Reflection::Phong { power: one()? },
                "beckmann" => Reflection::Beckmann { roughness: one()? },
                "ggx" => Reflection::Ggx { roughness: one()? },
                "ward" => {
                    let [along, across] = array(&value["parameters"])?;
                    Reflection::Ward { along, across }
                }
                _ => return None,
            })
        }
        "share" => SurfaceValue::Share(number(inner)?),
        "cutoff" => SurfaceValue::Cutoff(match inner {
            Value::Null => None,
            cutoff => Some(number(cutoff)?),
        }),
        "on" => SurfaceValue::Switch(inner.as_bool()?),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use lightbench::world::Transform;
    use lightbench::world::glam::Quat;

    #[test]
    fn every_change_reads_back_as_it_was() {
        let who = |name: &str| Who {
            name: name.to_owned(),
            nth: 2,
        };
        let reflections = [
            Reflection::BlinnPhong { power: 31.7 },
            Reflection::Phong { power: 0.1 },
            Reflection::Beckmann { roughness: 0.3 },
            Reflection::Ggx { roughness: 0.7 },
            Reflection::Ward {
                along: 0.1,
                across: 0.4,
            },
        ];
        let values = [
            SurfaceValue::Color(Vec3::new(0.1, 0.2, 0.3)),
            SurfaceValue::Picture(Picture::None),
            SurfaceValue::Picture(Picture::Made("picture(\"wall.png\")".to_owned())),
            SurfaceValue::Picture(Picture::Known(who("checks"))),
            SurfaceValue::Share(0.3),
            SurfaceValue::Cutoff(None),
            SurfaceValue::Cutoff(Some(0.6)),
            SurfaceValue::Switch(true),
        ];
        let values = values
            .into_iter()
            .chain(reflections.map(SurfaceValue::Reflection));
        let painted = values.map(|value| (who("paint"), Some(value)));
        let mut edits: Vec<AssetEdit> = SurfaceField::ALL
            .into_iter()
            .map(|field| AssetEdit::Paint {
                field,
                of: vec![(who("a"), None)],
            })
            .collect();
        edits.push(AssetEdit::Paint {
            field: SurfaceField::Color,
            of: painted.collect(),
        });
        for like in [None, Some(who("like"))] {
            edits.push(AssetEdit::NewMaterial {
                name: "new".to_owned(),
                like: like.clone(),
            });
            edits.push(AssetEdit::Dress {
                of: vec![who("a"), who("b")],
                material: like.clone(),
            });
            edits.push(AssetEdit::Reshape {
                of: vec![who("a")],
                mesh: like,
            });
        }
        edits.extend([
            AssetEdit::RenameMaterial {
                of: who("a"),
                name: "b".to_owned(),
            },
            AssetEdit::DeleteMaterial {
                of: vec![who("a"), who("b")],
            },
            AssetEdit::NewMesh {
                recipe: "sphere(0.5)".to_owned(),
            },
            AssetEdit::DeleteMesh { of: who("a") },
            AssetEdit::NewTexture {
                recipe: "picture(\"a.png\")".to_owned(),
            },
            AssetEdit::DeleteTexture { of: who("a") },
            AssetEdit::AddModel {
                path: "models/a.obj".to_owned(),
                name: "a".to_owned(),
                number: 7,
                place: Transform {
                    translation: Vec3::new(0.1, 0.2, 0.3),
                    rotation: Quat::from_rotation_y(0.3),
                    scale: Vec3::new(1.0, 2.0, 3.0),
                },
            },
        ]);
        for edit in edits {
            let text = asset_to(&edit).to_string();
            let value: Value = serde_json::from_str(&text).unwrap();
            assert_eq!(asset_from(&value), Some(edit), "{text}");
        }
    }
}
