//! Doing a change of assets.

use std::collections::HashSet;

use lightbench_assets::{Material, MaterialId, MeshId, TextureId};
use lightbench_world::{Entity, MeshRenderer, Name};
use rhai::{Dynamic, Scope};

use super::super::edit::free_name;
use super::super::finding::named;
use super::super::work::{give_number, there};
use super::super::{Done, Inverse, Who};
use super::inverse::{AssetInverse, Painted, Part, rename};
use super::surface::{Picture, SurfaceField, SurfaceValue};
use super::{AssetEdit, naming, painted};
use crate::scene::Scene;
use crate::scene::data::Data;
use crate::scene::shapes::{MeshHandle, Shape};
use crate::scene::shelf::{AssetId, Marks};
use crate::scene::textures::Pattern;
use crate::spelling::spell_text;

/// Marks of what a person has added.
const KEPT: Marks = Marks {
    kept: true,
    gone: false,
};

/// Marks of what a person has removed.
const GONE: Marks = Marks {
    kept: false,
    gone: true,
};

/// Does a change and gives what takes it back. `before` are the changes before it.
///
/// # Errors
/// A sentence, where what it changes is not there.
pub(in super::super) fn perform(
    scene: &mut Scene,
    edit: &AssetEdit,
    before: &[Done],
) -> Result<Inverse, String> {
    if let AssetEdit::AddModel { .. } = edit {
        return add_model(scene, edit);
    }
    let inverse = match edit {
        AssetEdit::NewMaterial { name, like } => {
            let like = match like {
                Some(like) => {
                    let id = naming::find_material(&scene.assets, like)?;
                    scene.assets.material(id).cloned().unwrap_or_default()
                }
                None => Material::default(),
            };
            let name = name.clone();
            scene.on_data(|data| {
                let id = data.assets.add_material(Material { name, ..like });
                marked(data, AssetId::Material(id), KEPT)
            })
        }
        AssetEdit::RenameMaterial { of, name } => {
            let id = naming::find_material(&scene.assets, of)?;
            let old = of.name.clone();
            scene.on_data(|data| rename(data, id, name));
            AssetInverse {
                renamed: Some((id, old)),
                ..AssetInverse::default()
            }
        }
        AssetEdit::DeleteMaterial { of } => delete_materials(scene, of)?,
        AssetEdit::Paint { field, of } => paint(scene, *field, of, before)?,
        AssetEdit::Dress { of, material } => {
            let material = match material {
                Some(who) => Some(naming::find_material(&scene.assets, who)?),
                None => None,
            };
            let to = material.map(|material| MeshRenderer {
                material,
                ..MeshRenderer::default()
            });
            draw_with(scene, of, Part::Material, to, before)?
        }
        AssetEdit::Reshape { of, mesh } => {
            let mesh = match mesh {
                Some(who) => Some(naming::find_mesh(&scene.assets, who)?),
                None => None,
            };
            let to = mesh.map(|mesh| MeshRenderer {
                mesh,
                ..MeshRenderer::default()
            });
            draw_with(scene, of, Part::Mesh, to, before)?
        }
        AssetEdit::NewMesh { recipe } => {
            let id = mesh(scene, recipe)?;
            scene.on_data(|data| marked(data, AssetId::Mesh(id), KEPT))
        }
        AssetEdit::NewTexture { recipe } => {
            let id = texture(scene, recipe, false)?;
            scene.on_data(|data| marked(data, AssetId::Texture(id), KEPT))
        }
        AssetEdit::DeleteMesh { of } => {
            let id = naming::find_mesh(&scene.assets, of)?;
            scene.on_data(|data| marked(data, AssetId::Mesh(id), GONE))
        }
        AssetEdit::DeleteTexture { of } => {
            let id = naming::find_texture(&scene.assets, of)?;
            scene.on_data(|data| marked(data, AssetId::Texture(id), GONE))
        }
        AssetEdit::AddModel { .. } => AssetInverse::default(),
    };
    Ok(Inverse::Assets(Box::new(inverse)))
}

fn marked(data: &mut Data, id: AssetId, marks: Marks) -> AssetInverse {
    let before = data.shelf.marks(id);
    data.shelf.mark(id, marks);
    AssetInverse {
        marks: vec![(id, before)],
        ..AssetInverse::default()
    }
}

fn delete_materials(scene: &mut Scene, of: &[Who]) -> Result<AssetInverse, String> {
    let ids: Result<Vec<MaterialId>, String> = of
        .iter()
        .map(|who| naming::find_material(&scene.assets, who))
        .collect();
    let ids = ids?;
    let mut inverse = AssetInverse {
        part: Some(Part::Material),
        ..AssetInverse::default()
    };
    for id in ids {
        let users = scene.users(AssetId::Material(id));
        scene.on_data(|data| {
            inverse
                .marks
                .extend(marked(data, AssetId::Material(id), GONE).marks);
            for entity in users {
                give(
                    data,
                    entity,
                    Part::Material,
                    &MeshRenderer::default(),
                    &mut inverse,
                );
            }
        });
    }
    Ok(inverse)
}

/// Gives an entity another mesh or material, and takes note of what it had.
fn give(
    data: &mut Data,
    entity: Entity,
    part: Part,
    to: &MeshRenderer,
    inverse: &mut AssetInverse,
) {
    if let Some(before) = data.world.get::<MeshRenderer>(entity) {
        let mut after = before;
        part.copy(to, &mut after);
        // It was found just now.
        let _given = data.world.insert(entity, after);
        inverse.drawn.push((entity, before));
    }
}

/// What an entity was drawn with before all changes by hand.
fn drawn_first(before: &[Done], entity: Entity, part: Part) -> Option<MeshRenderer> {
    before.iter().find_map(|done| match &done.inverse {
        Some(Inverse::Assets(inverse)) if inverse.part == Some(part) => {
            let mut own = inverse.drawn.iter().filter(|(other, _)| *other == entity);
            own.next().map(|(_, before)| *before)
        }
        _ => None,
    })
}

fn draw_with(
    scene: &mut Scene,
    of: &[Who],
    part: Part,
    to: Option<MeshRenderer>,
    before: &[Done],
) -> Result<AssetInverse, String> {
    let mut entities = there(scene, of)?;
    entities.retain(|entity| scene.world.has::<MeshRenderer>(*entity));
    if entities.is_empty() {
        return Err("none of them is drawn: give it the component MeshRenderer first".to_owned());
    }
    let mut inverse = AssetInverse {
        part: Some(part),
        ..AssetInverse::default()
    };
    scene.on_data(|data| {
        for entity in entities {
            let to = to.or_else(|| drawn_first(before, entity, part));
            if let Some(to) = to {
                give(data, entity, part, &to, &mut inverse);
            }
        }
    });
    Ok(inverse)
}

fn paint(
    scene: &mut Scene,
    field: SurfaceField,
    of: &[(Who, Option<SurfaceValue>)],
    before: &[Done],
) -> Result<AssetInverse, String> {
    let mut all = Vec::with_capacity(of.len());
    for (who, value) in of {
        let id = naming::find_material(&scene.assets, who)?;
        let picture = match value {
            Some(SurfaceValue::Picture(picture)) => {
                resolve(scene, picture, field == SurfaceField::Normals)?
            }
            _ => None,
        };
        let now = scene.assets.material(id).cloned().unwrap_or_default();
        let wanted = value.as_ref().map(|value| {
            let mut wanted = now.clone();
            field.write(value, picture, &mut wanted);
            wanted
        });
        let to = wanted
            .as_ref()
            .or_else(|| painted::original(before, id, field));
        let mut material = now.clone();
        if let Some(to) = to {
            field.copy(to, &mut material);
        }
        // It was found just now.
        let _painted = scene.assets.replace_material(id, material);
        all.push(Painted {
            id,
            before: now,
            wanted,
        });
    }
    Ok(AssetInverse {
        painted: Some((field, all)),
        ..AssetInverse::default()
    })
}

fn resolve(
    scene: &mut Scene,
    picture: &Picture,
    normals: bool,
) -> Result<Option<TextureId>, String> {
    match picture {
        Picture::None => Ok(None),
        Picture::Made(recipe) => texture(scene, recipe, normals).map(Some),
        Picture::Known(who) => naming::find_texture(&scene.assets, who).map(Some),
    }
}

/// The texture that calls make, the same for the same calls.
fn texture(scene: &mut Scene, recipe: &str, normals: bool) -> Result<TextureId, String> {
    let known = scene.stage.lock().recipes.texture(recipe, normals);
    if let Some(known) = known {
        return Ok(known);
    }
    let made = scene.call(recipe)?;
    let pattern = made.try_cast::<Pattern>();
    let pattern = pattern.ok_or_else(|| format!("`{recipe}` makes no texture"))?;
    scene.on_data(|data| {
        let spelled = pattern.recipe();
        let known = spelled.and_then(|spelled| data.recipes.texture(&spelled, normals));
        let id = match (known, normals) {
            (Some(known), _) => Ok(known),
            (None, true) => pattern.normal(data),
            (None, false) => pattern.color(data),
        };
        id.map_err(|mistake| mistake.message)
    })
}

/// The mesh that calls make, the same for the same calls.
fn mesh(scene: &mut Scene, recipe: &str) -> Result<MeshId, String> {
    let made = scene.call(recipe)?;
    if let Some(handle) = made.read_lock::<MeshHandle>() {
        return Ok(handle.0);
    }
    let shape = made.try_cast::<Shape>();
    let shape = shape.ok_or_else(|| format!("`{recipe}` makes no mesh"))?;
    scene.on_data(|data| match shape.known_mesh(data) {
        Some(known) => Ok(known),
        None => shape.mesh(data).map_err(|mistake| mistake.message),
    })
}

/// What stands between the name of a model and that of a part.
pub(super) const PART: &str = ": ";

/// Whether a name is that of a part of a model.
pub(super) fn is_part_of(name: &str, model: &str) -> bool {
    let rest = name.strip_prefix(model);
    rest.is_some_and(|rest| rest.starts_with(PART))
}

fn add_model(scene: &mut Scene, edit: &AssetEdit) -> Result<Inverse, String> {
    let AssetEdit::AddModel {
        path,
        name,
        number,
        place,
    } = edit
    else {
        return Err("this adds no model".to_owned());
    };
    let root = scene.call(&format!("load_model({})", spell_text(path)))?;
    let root = root.try_cast::<Entity>();
    let root = root.ok_or_else(|| format!("`{path}` is no model"))?;
    scene.on_data(|data| {
        let below = data.world.descendants(root);
        let mut next = *number;
        let mut names = HashSet::new();
        for entity in std::iter::once(root).chain(below) {
            give_number(data, entity, next);
            next = next.saturating_add(1);
            let own = named(&data.world, entity);
            if entity != root && !own.is_empty() {
                // Names of their own, by which changes of them are kept.
                let part = free_name(&format!("{name}{PART}{own}"), &mut names);
                let _named = data.world.insert(entity, Name::new(&part));
                data.note_name(entity, &part);
            }
        }
        // It was made just now.
        let _named = data.world.insert(root, Name::new(name));
        data.note_name(root, name);
        let _placed = data.world.insert(root, *place);
    });
    Ok(Inverse::Made(vec![root]))
}

impl Scene {
    /// The value of an expression of the scene's own language. Where it has a mistake, nothing has
    /// changed.
    fn call(&mut self, expression: &str) -> Result<Dynamic, String> {
        let before = self.snapshot();
        self.swap();
        let host = &self.host;
        host.watch.start(host.compiler.limits.load_time);
        let made = host
            .engine
            .compile_expression(expression)
            .map_err(|error| error.into())
            .and_then(|ast| {
                let scope = &mut Scope::new();
                host.engine.eval_ast_with_scope::<Dynamic>(scope, &ast)
            });
        let made = made.map_err(|error| {
            let problem = host.compiler.explain(&error, &self.path);
            match problem.hint {
                Some(hint) => format!("{}; {hint}", problem.message),
                None => problem.message,
            }
        });
        self.swap();
        if made.is_err() {
            self.restore(&before);
        }
        made
    }
}
