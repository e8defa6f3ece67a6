//! Models from OBJ and glTF files.

use std::collections::HashMap;
use std::sync::Arc;

use lightbench_assets::gltf::{self, GltfScene};
use lightbench_assets::obj::{self, Model, ModelError, Options};
use lightbench_assets::{MaterialId, MeshId, Shared, Texture, TextureId};
use lightbench_world::{Entity, MeshRenderer, Transform};

use super::data::{Data, Stage};
use super::recipes::MeshRecipe;
use super::shapes::MeshHandle;
use crate::api::{Api, Arguments, Mistake, spell_number, spell_text};

/// Models that were read, by path and crease angle, so that a scene that uses one in several places
/// has one look at its files. An OBJ file has no nodes.
pub(super) type Models = HashMap<(String, u32), Arc<GltfScene>>;

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for form in [
        "model_mesh(path, number)",
        "model_mesh(path, number, crease)",
    ] {
        let stage = stage.clone();
        api.function(
            form,
            "One of the meshes of a model, counted from 0. `crease` is that of `load_obj`.",
            move |a| {
                let path = a.text(0)?;
                let number = a.whole(1, 0, i64::from(u32::MAX))? as usize;
                let options = match a.len() {
                    2 => Options::default(),
                    _ => crease(a, 2)?,
                };
                mesh(&mut stage.lock(), &path, number, &options).map(MeshHandle)
            },
        );
    }
    for form in ["load_obj(path)", "load_obj(path, crease)"] {
        let stage = stage.clone();
        api.function(
            form,
            "Reads a model with its materials and pictures, and makes an entity of it; each \
             material is a child. Faces that meet at more than `crease` degrees (60 unless told) \
             keep an edge where the file has no normals.",
            move |a| {
                let path = a.text(0)?;
                let options = match a.len() {
                    1 => Options::default(),
                    _ => crease(a, 1)?,
                };
                load_obj(&mut stage.lock(), a, &path, &options)
            },
        );
    }
    let loaded = stage.clone();
    api.function(
        "load_gltf(path)",
        "Reads a scene from a glTF file (.gltf or .glb) and makes an entity of it, with an entity \
         for each of its nodes below: meshes, materials, lights, animations, and cameras that are \
         not active.",
        move |a| {
            let path = a.text(0)?;
            load_gltf(&mut loaded.lock(), a, &path)
        },
    );
    let loaded = stage.clone();
    api.function(
        "load_model(path)",
        "Reads a model of any kind that is known by its ending: .obj, .gltf or .glb.",
        move |a| {
            let path = a.text(0)?;
            let data = &mut loaded.lock();
            if is_gltf(&path) {
                load_gltf(data, a, &path)
            } else {
                load_obj(data, a, &path, &Options::default())
            }
        },
    );
}

/// Whether a file's name ends as those of glTF files do.
fn is_gltf(path: &str) -> bool {
    let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
    ["gltf", "glb"]
        .iter()
        .any(|known| ending.eq_ignore_ascii_case(known))
}

fn crease(a: &Arguments, index: usize) -> Result<Options, Mistake> {
    let degrees = a.number_in(index, 0.0, 180.0)?;
    Ok(Options {
        crease_angle: degrees.to_radians() as f32,
    })
}

/// A model with its nodes, read once. Its time is not the script's.
fn read(data: &mut Data, path: &str, options: &Options) -> Result<Arc<GltfScene>, Mistake> {
    let key = (path.to_owned(), options.crease_angle.to_bits());
    if let Some(model) = data.models.get(&key) {
        return Ok(Arc::clone(model));
    }
    let watch = Arc::clone(&data.watch);
    let (files, reuse, progress) = (&data.files, &data.reuse, &data.progress);
    let read = watch.free_of_charge(|| match is_gltf(path) {
        true => gltf::load(files, reuse, path, progress),
        false => obj::load(files, reuse, path, options, progress).map(|model| GltfScene {
            model,
            nodes: Vec::new(),
        }),
    });
    let model = Arc::new(read.map_err(|error| match error {
        ModelError::Cancelled(_) => Mistake::new("the script was stopped"),
        error => Mistake::new(error.to_string()),
    })?);
    data.models.insert(key, Arc::clone(&model));
    Ok(model)
}

fn mesh(data: &mut Data, path: &str, number: usize, options: &Options) -> Result<MeshId, Mistake> {
    let model = &read(data, path, options)?.model;
    let Some((mesh, _)) = model.meshes.get(number) else {
        let count = model.meshes.len();
        return Err(missing(path, "meshes", count, number));
    };
    let id = data.add_mesh(mesh.clone())?;
    let recipe = mesh_recipe(path, number, options);
    data.recipes.meshes.insert(id, recipe);
    Ok(id)
}

/// One of the pictures of a model.
pub(super) fn texture(
    data: &mut Data,
    path: &str,
    number: usize,
) -> Result<Shared<Texture>, Mistake> {
    let model = &read(data, path, &Options::default())?.model;
    let found = model.textures.get(number).cloned();
    found.ok_or_else(|| missing(path, "pictures", model.textures.len(), number))
}

fn missing(path: &str, what: &str, count: usize, number: usize) -> Mistake {
    Mistake::new(format!(
        "`{path}` has {count} {what}, and number {number} is not among them"
    ))
    .with_hint("they are counted from 0")
}

fn mesh_recipe(path: &str, number: usize, options: &Options) -> MeshRecipe {
    let path = spell_text(path);
    if *options == Options::default() {
        return MeshRecipe::Calls(format!("model_mesh({path}, {number})"));
    }
    let degrees = spell_number(f64::from(options.crease_angle).to_degrees());
    MeshRecipe::Calls(format!("model_mesh({path}, {number}, {degrees})"))
}

/// Adds the model to the scene's assets with the recipes of its parts, and passes its warnings on.
fn add(
    data: &mut Data,
    a: &Arguments,
    path: &str,
    options: &Options,
    model: &Model,
) -> Result<Vec<(MeshId, MaterialId)>, Mistake> {
    for warning in &model.warnings {
        data.log.add(a.place(), warning.to_string());
    }
    data.count_triangles(model.triangle_count())?;
    let first = data.assets.textures().len();
    for number in 0..model.textures.len() {
        let recipe = format!("model_texture({}, {number})", spell_text(path));
        let id = TextureId((first + number) as u32);
        data.recipes.textures.insert(id, recipe);
    }
    let drawn = model.clone().add_to(&mut data.assets);
    for (number, (mesh, _)) in drawn.iter().enumerate() {
        let recipe = mesh_recipe(path, number, options);
        data.recipes.meshes.insert(*mesh, recipe);
    }
    Ok(drawn)
}

/// The name of a file without its folder and ending.
fn stem(data: &Data, path: &str) -> String {
    let shown = data.files.display(path);
    let name = shown.rsplit(['/', '\\']).next().unwrap_or(&shown);
    let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    name.to_owned()
}

fn draw(data: &mut Data, entity: Entity, drawn: (MeshId, MaterialId)) -> Result<(), Mistake> {
    let (mesh, material) = drawn;
    let renderer = MeshRenderer {
        mesh,
        material,
        visible: true,
    };
    data.insert(entity, renderer)
}

fn put_below(data: &mut Data, entity: Entity, parent: Entity) -> Result<(), Mistake> {
    let put = data.world.set_parent(entity, Some(parent));
    put.map_err(|error| Mistake::new(error.to_string()))
}

fn load_obj(
    data: &mut Data,
    a: &Arguments,
    path: &str,
    options: &Options,
) -> Result<Entity, Mistake> {
    let loaded = read(data, path, options)?;
    let drawn = add(data, a, path, options, &loaded.model)?;
    let name = stem(data, path);
    let root = data.spawn(&name)?;
    for (index, drawn) in drawn.into_iter().enumerate() {
        let part = data.spawn(&format!("{name} {}", index + 1))?;
        data.insert(part, Transform::default())?;
        draw(data, part, drawn)?;
        put_below(data, part, root)?;
    }
    Ok(root)
}

fn load_gltf(data: &mut Data, a: &Arguments, path: &str) -> Result<Entity, Mistake> {
    let loaded = read(data, path, &Options::default())?;
    let drawn = add(data, a, path, &Options::default(), &loaded.model)?;
    let nodes = &loaded.nodes;
    let name = stem(data, path);
    let root = data.spawn(&name)?;
    let mut entities: Vec<Entity> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let entity = data.spawn(&node.name)?;
        data.insert(entity, node.transform)?;
        let parent = node.parent.and_then(|place| entities.get(place));
        put_below(data, entity, parent.copied().unwrap_or(root))?;
        entities.push(entity);
        let parts = drawn.get(node.meshes.clone()).unwrap_or_default();
        match parts {
            // One mesh is the node's own; of several each gets an entity.
            [only] => draw(data, entity, *only)?,
            parts => {
                for (index, part) in parts.iter().enumerate() {
                    let below = data.spawn(&format!("{} {}", node.name, index + 1))?;
                    draw(data, below, *part)?;
                    put_below(data, below, entity)?;
                }
            }
        }
        if let Some(light) = node.light {
            data.insert(entity, light)?;
        }
        if let Some(camera) = node.camera {
            data.insert(entity, camera)?;
        }
        if let Some(animation) = node.animation.clone() {
            data.insert(entity, animation)?;
        }
    }
    Ok(root)
}
