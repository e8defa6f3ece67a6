//! Scene files that hold a world instead of a script that makes one.
//!
//! The format is that of [`scene_file`]. What stands behind the `=` of a mesh, a material or a
//! texture is a call of the scenes' own language, bound by the same limits as a script:
//!
//! ```text
//! mesh "ball" = sphere(1).segments(32, 16)
//! texture "tiles" = tiles_texture().pieces(2)
//! material "floor" = material("floor").color(1.0, 1.0, 1.0).texture(texture("tiles"))
//! ```
//!
//! A script's `update` is not part of a saved scene; components that move entities are.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::hash::Hash;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use lightbench_assets::cache::Reuse;
use lightbench_assets::files::Files;
use lightbench_assets::{Assets, MaterialId, MeshId, Progress, TextureId};
use lightbench_render::{Place, Problem, Problems};
use lightbench_world::scene_file::{self, AssetNames, Definition, SceneError};
use lightbench_world::{ClipVolume, MeshRenderer, World};
use rhai::{Dynamic, Scope};

use super::Scene;
use super::data::Stage;
use super::load::host;
use super::materials::Material;
use super::recipes::{self, MeshRecipe, Recipes};
use super::script::OwnScript;
use super::shapes::{MeshHandle, Shape};
use super::shelf::{AssetId, Marks, Shelf};
use super::state::KeptState;
use super::textures::Pattern;
use crate::api::{Api, Mistake, spell_text};
use crate::host::Host;
use crate::limits::Limits;
use crate::settings::Settings;

/// How the names of scene files that hold a world end.
pub const EXTENSION: &str = "scene";

/// The textures that a file has defined, by name.
pub(super) type Textures = Arc<Mutex<HashMap<String, Pattern>>>;

/// Registers the function by which materials of a file name its textures.
pub(super) fn register(api: &mut Api, textures: &Textures) {
    let textures = Arc::clone(textures);
    api.function(
        "texture(name)",
        "A texture that the scene file has defined before. Scripts have no such file.",
        move |a| {
            let name = a.text(0)?;
            let textures = textures.lock().unwrap_or_else(PoisonError::into_inner);
            textures.get(&name).cloned().ok_or_else(|| {
                Mistake::new(format!("there is no texture `{name}`"))
                    .with_hint("a scene file defines its textures before its materials")
            })
        },
    );
}

/// Reads a file that holds a world.
pub(super) fn load(
    files: &Files,
    reuse: &Reuse,
    path: &str,
    settings: &Settings,
    progress: &Progress,
    limits: &Limits,
    kept: KeptState,
) -> Result<Scene, Problems> {
    let text = files.read_text(path);
    let text = text.map_err(|error| Problem::new(Place::file(path), error.to_string()))?;
    let (host, stage, textures) = host(files, reuse, settings, limits, progress, kept);
    host.watch.start(limits.load_time);
    let mut maker = Maker {
        host: &host,
        stage: &stage,
        textures,
        path,
        meshes: HashMap::new(),
        materials: HashMap::new(),
        defined: Vec::new(),
    };
    let world = scene_file::read(&text, &mut maker).map_err(|error| match error {
        SceneError::Text { line, message } => {
            Problem::new(Place::new(path, line as u32, 0), message).with_source(&text)
        }
        error => Problem::new(Place::file(path), error.to_string()),
    })?;
    if world.len() > limits.entities {
        let message = format!(
            "the scene has {} entities, and may not have more than {}",
            world.len(),
            limits.entities
        );
        return Err(Problem::new(Place::file(path), message).into());
    }
    let unused = maker.unused(&world);
    keep_unused(&stage, unused).map_err(|message| Problem::new(Place::file(path), message))?;
    stage.lock().world = world;
    let mut scene = Scene::new(path.to_owned(), host, stage, OwnScript::default());
    scene.finish()?;
    // The world stays as the file has it, bit for bit, until time passes.
    scene.refresh();
    Ok(scene)
}

/// Makes the assets of a file that is read.
struct Maker<'a> {
    host: &'a Host,
    stage: &'a Stage,
    textures: Textures,
    path: &'a str,
    meshes: HashMap<String, MeshId>,
    materials: HashMap<String, MaterialId>,
    /// Textures in the order of the file.
    defined: Vec<Pattern>,
}

/// What a file defines and nothing in it uses: it is written again.
struct Unused {
    assets: Vec<AssetId>,
    textures: Vec<Pattern>,
}

fn keep_unused(stage: &Stage, unused: Unused) -> Result<(), String> {
    let mut data = stage.lock();
    let mut assets = unused.assets;
    for texture in unused.textures.iter().filter(|one| one.is_unpainted()) {
        let id = texture
            .color(&mut data)
            .map_err(|mistake| mistake.message)?;
        assets.push(AssetId::Texture(id));
    }
    for id in assets {
        let marks = Marks {
            kept: true,
            gone: false,
        };
        data.shelf.mark(id, marks);
    }
    Ok(())
}

impl Maker<'_> {
    fn unused(self, world: &World) -> Unused {
        let (meshes, materials) = used(world);
        let own = self.meshes.into_values();
        let own = own.filter(|id| !meshes.contains(id)).map(AssetId::Mesh);
        let surfaces = self.materials.into_values();
        let surfaces = surfaces.filter(|id| !materials.contains(id));
        Unused {
            assets: own.chain(surfaces.map(AssetId::Material)).collect(),
            textures: self.defined,
        }
    }

    fn make(&self, recipe: &str) -> Result<Dynamic, String> {
        let engine = &self.host.engine;
        let made = engine
            .compile_expression(recipe)
            .map_err(|error| error.into())
            .and_then(|ast| engine.eval_ast_with_scope::<Dynamic>(&mut Scope::new(), &ast));
        made.map_err(|error| {
            let problem = self.host.compiler.explain(&error, self.path);
            match problem.hint {
                Some(hint) => format!("{}; {hint}", problem.message),
                None => problem.message,
            }
        })
    }
}

impl AssetNames for Maker<'_> {
    fn define(&mut self, kind: &str, name: &str, recipe: &str) -> Result<(), String> {
        let made = self.make(recipe)?;
        let wrong = || format!("this makes no {kind}");
        let new = match kind {
            "mesh" => {
                let mesh = if let Some(handle) = made.read_lock::<MeshHandle>() {
                    handle.0
                } else {
                    let shape = made.read_lock::<Shape>().ok_or_else(wrong)?;
                    let mesh = shape.mesh(&mut self.stage.lock());
                    mesh.map_err(|mistake| mistake.message)?
                };
                self.meshes.insert(name.to_owned(), mesh).is_none()
            }
            "material" => {
                let material = made.read_lock::<Material>().ok_or_else(wrong)?;
                let known = self.materials.insert(name.to_owned(), material.id);
                known.is_none()
            }
            _ => {
                let texture = made.read_lock::<Pattern>().ok_or_else(wrong)?;
                self.defined.push(texture.clone());
                let mut textures = self.textures.lock().unwrap_or_else(PoisonError::into_inner);
                textures.insert(name.to_owned(), texture.clone()).is_none()
            }
        };
        match new {
            true => Ok(()),
            false => Err(format!("the {kind} `{name}` is defined twice")),
        }
    }

    fn mesh_name(&self, _: MeshId) -> Option<String> {
        None
    }

    fn material_name(&self, _: MaterialId) -> Option<String> {
        None
    }

    fn mesh(&mut self, name: &str) -> Result<MeshId, String> {
        let known = self.meshes.get(name).copied();
        known.ok_or_else(|| format!("the file defines no mesh `{name}`"))
    }

    fn material(&mut self, name: &str) -> Result<MaterialId, String> {
        match self.materials.get(name) {
            Some(known) => Ok(*known),
            None if name == DEFAULT_MATERIAL => Ok(MaterialId(0)),
            None => Err(format!("the file defines no material `{name}`")),
        }
    }
}

/// The name of the material that is always there.
const DEFAULT_MATERIAL: &str = "default";

/// The meshes and materials that entities have.
pub(super) fn used(world: &World) -> (BTreeSet<MeshId>, BTreeSet<MaterialId>) {
    let renderers = world.columns::<MeshRenderer>();
    let volumes = world.columns::<ClipVolume>().mesh().iter();
    let meshes = renderers.mesh().iter().chain(volumes).copied().collect();
    let materials = renderers.material().iter().copied().collect();
    (meshes, materials)
}

/// The names and recipes of the assets that a world uses, and of those that are kept though it does
/// not.
struct Saved {
    definitions: Vec<Definition>,
    meshes: HashMap<MeshId, String>,
    materials: HashMap<MaterialId, String>,
}

impl Saved {
    fn new(
        world: &World,
        assets: &Assets,
        recipes: &Recipes,
        shelf: &Shelf,
    ) -> Result<Self, String> {
        let (mut used_meshes, mut used_materials) = used(world);
        let mut kept_textures = Vec::new();
        for id in shelf.kept() {
            match id {
                AssetId::Mesh(id) => _ = used_meshes.insert(id),
                AssetId::Material(id) => _ = used_materials.insert(id),
                AssetId::Texture(id) => kept_textures.push(id),
            }
        }
        let (meshes, mut definitions) = define(
            "mesh",
            used_meshes
                .iter()
                .filter_map(|&id| Some((id, &*assets.mesh(id)?.name))),
            |id| recipes.meshes.get(&id).map(MeshRecipe::spelled),
            "",
        )?;
        let surfaces = || {
            used_materials
                .iter()
                .filter(|id| id.0 != 0)
                .filter_map(|&id| Some((id, assets.material(id)?)))
        };
        // In the order in which they are painted when the file is read.
        let pictures = surfaces()
            .flat_map(|(_, surface)| [surface.base_color_texture, surface.normal_texture])
            .flatten()
            .chain(kept_textures);
        let mut seen = HashSet::new();
        let pictures: Vec<TextureId> = pictures.filter(|id| seen.insert(*id)).collect();
        // One recipe gives both the colours and the normals of a painted texture.
        let mut by_recipe: HashMap<&String, TextureId> = HashMap::new();
        let mut first = HashMap::new();
        for &id in &pictures {
            let same = recipes.textures.get(&id);
            let same = same.map_or(id, |recipe| *by_recipe.entry(recipe).or_insert(id));
            first.insert(id, same);
        }
        let (textures, textures_defined) = define(
            "texture",
            pictures
                .iter()
                .filter(|id| first.get(id) == Some(id))
                .filter_map(|&id| Some((id, &*assets.texture(id)?.name))),
            |id| recipes.textures.get(&id).cloned(),
            "",
        )?;
        definitions.extend(textures_defined);
        let texture_name = |id| {
            let name = textures.get(first.get(&id)?)?;
            Some(format!("texture({})", spell_text(name)))
        };
        let (mut materials, materials_defined) = define(
            "material",
            surfaces().map(|(id, surface)| (id, &*surface.name)),
            |id| recipes::material(assets.material(id)?, texture_name),
            DEFAULT_MATERIAL,
        )?;
        definitions.extend(materials_defined);
        materials.insert(MaterialId(0), DEFAULT_MATERIAL.to_owned());
        Ok(Self {
            definitions,
            meshes,
            materials,
        })
    }
}

/// Gives each asset a name of its own and its recipe. `taken` is a name that none may have.
fn define<'a, Id: Copy + Eq + Hash>(
    kind: &'static str,
    assets: impl Iterator<Item = (Id, &'a str)>,
    recipe: impl Fn(Id) -> Option<String>,
    taken: &str,
) -> Result<(HashMap<Id, String>, Vec<Definition>), String> {
    let mut names = HashMap::new();
    let mut known: BTreeSet<String> = BTreeSet::from([taken.to_owned()]);
    let mut definitions = Vec::new();
    for (id, asked) in assets {
        let mut name = asked.to_owned();
        let mut number = 2;
        while !known.insert(name.clone()) {
            name = format!("{asked} {number}");
            number += 1;
        }
        let recipe = recipe(id).ok_or_else(|| {
            format!(
                "the {kind} `{asked}` can't be saved: nothing is known of how it was made, because \
                 no call with plain values made it: it was painted by a function of the script, or \
                 set by the program"
            )
        })?;
        names.insert(id, name.clone());
        definitions.push(Definition { kind, name, recipe });
    }
    Ok((names, definitions))
}

impl AssetNames for Saved {
    fn definitions(&self) -> Vec<Definition> {
        self.definitions.clone()
    }

    fn mesh_name(&self, mesh: MeshId) -> Option<String> {
        self.meshes.get(&mesh).cloned()
    }

    fn material_name(&self, material: MaterialId) -> Option<String> {
        self.materials.get(&material).cloned()
    }

    fn mesh(&mut self, name: &str) -> Result<MeshId, String> {
        Err(format!("the mesh `{name}` is only written here"))
    }

    fn material(&mut self, name: &str) -> Result<MaterialId, String> {
        Err(format!("the material `{name}` is only written here"))
    }
}

impl Scene {
    /// The scene as the text of a file that [`load_scene`](crate::load_scene) reads. Entities that
    /// were never saved before get their numbers.
    ///
    /// # Errors
    /// An asset that no script made, because nobody could make it again.
    pub fn to_text(&mut self) -> Result<String, Problem> {
        let saved = self.saved()?;
        Ok(scene_file::write(&mut self.world, &saved))
    }

    /// Writes the scene to a file, which is complete or as it was before.
    ///
    /// # Errors
    /// As [`Scene::to_text`], or a file that can't be written.
    pub fn save(&mut self, path: &Path) -> Result<(), Problem> {
        let saved = self.saved()?;
        scene_file::save(path, &mut self.world, &saved)
            .map_err(|error| Problem::new(Place::file(self.path.as_str()), error.to_string()))
    }

    fn saved(&self) -> Result<Saved, Problem> {
        let data = self.stage.lock();
        Saved::new(&self.world, &self.assets, &data.recipes, &data.shelf)
            .map_err(|message| Problem::new(Place::file(self.path.as_str()), message))
    }
}
