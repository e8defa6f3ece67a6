//! Changes of assets as lines of a scene script that do the same to what is drawn.
//!
//! Scripts make materials and can't find one that is there already. So the line of a changed material makes it
//! anew, as it is now, and gives it to all that is drawn with it.

use lightbench_assets::MaterialId;
use lightbench_world::Entity;

use super::super::lines::find;
use super::super::{Inverse, Who};
use super::work::PART;
use super::{AssetEdit, naming};
use crate::scene::Scene;
use crate::scene::recipes;
use crate::scene::shelf::AssetId;
use crate::spelling::spell_text;

impl AssetEdit {
    /// The lines of a scene script that do the same, on a scene in which it was done. `inverse` takes it
    /// back.
    ///
    /// # Errors
    /// A sentence that says what to write in the scene's script instead, where scripts have no words for it.
    pub(in super::super) fn lines(
        &self,
        scene: &Scene,
        inverse: Option<&Inverse>,
    ) -> Result<String, String> {
        let lines = |all: Vec<Result<String, String>>| {
            let all: Result<Vec<String>, String> = all.into_iter().collect();
            all.map(|all| all.join("\n"))
        };
        match self {
            Self::NewMaterial { name, .. } => {
                let id = naming::find_material(&scene.assets, &named(name))?;
                Ok(format!("{};", scene.material_calls(id)?))
            }
            Self::RenameMaterial { name, .. } => scene.made_anew(&named(name)),
            Self::Paint { of, .. } => {
                let all = of.iter().map(|(who, _)| scene.made_anew(who));
                lines(all.collect())
            }
            Self::DeleteMaterial { .. } => {
                let drawn = match inverse {
                    Some(Inverse::Assets(inverse)) => inverse.drawn.as_slice(),
                    _ => &[],
                };
                if drawn.is_empty() {
                    return Err(
                        "nothing is drawn with it: leave out the call that makes it".to_owned()
                    );
                }
                let drawn: Vec<Entity> = drawn.iter().map(|(entity, _)| *entity).collect();
                let drawn = Who::of(&scene.world, &drawn);
                given(&scene.material_calls(MaterialId(0))?, &drawn)
            }
            Self::Dress { of, material } => {
                let Some(material) = material else {
                    return Err(
                        "the script itself gives these entities their material: leave out the \
                                lines that give them another one"
                            .to_owned(),
                    );
                };
                let id = naming::find_material(&scene.assets, material)?;
                given(&scene.material_calls(id)?, of)
            }
            Self::NewMesh { recipe } => Ok(match recipe.starts_with("model_mesh(") {
                true => format!("{recipe};"),
                false => format!("mesh({recipe});"),
            }),
            Self::Reshape { of, mesh } => {
                let Some(mesh) = mesh else {
                    return Err(
                        "the script itself gives these entities their mesh: leave out the lines \
                                that give them another one"
                            .to_owned(),
                    );
                };
                let id = naming::find_mesh(&scene.assets, mesh)?;
                let recipe = scene.stage.lock().recipes.meshes.get(&id).cloned();
                let recipe = recipe.ok_or_else(|| {
                    format!(
                        "the mesh {} was made by a function of the script, which has no call that could \
                         stand elsewhere: give it to them where the script makes it",
                        mesh.words()
                    )
                })?;
                let recipe = recipe.spelled();
                let each = of
                    .iter()
                    .map(|who| Ok(format!("{}.mesh({recipe});", found(who)?)));
                lines(each.collect())
            }
            Self::DeleteMesh { of } => Err(format!(
                "a script has no meshes that nothing is drawn with, but those that it makes: leave out \
                 the call that makes {}",
                of.words()
            )),
            Self::NewTexture { recipe } => Err(format!(
                "a script has no textures but those of its materials: write .texture({recipe}) behind the \
                 call that makes a material"
            )),
            Self::DeleteTexture { of } => Err(format!(
                "a script has no textures but those of its materials: leave out the call that makes {}",
                of.words()
            )),
            Self::AddModel {
                path, name, place, ..
            } => {
                let at = crate::scene::overlays::spell_point(place.translation);
                let prefix = spell_text(&format!("{name}{PART}"));
                let (path, name) = (spell_text(path), spell_text(name));
                // Its parts are called after it, as they are where a person adds it.
                Ok(format!(
                    "{{ let it = load_model({path}); it.name = {name}; it.at({at}); let parts = it.children; \
                     while !parts.is_empty() {{ let part = parts.pop(); parts += part.children; \
                     if part.name != \"\" {{ part.name = {prefix} + part.name; }} }} }}"
                ))
            }
        }
    }
}

fn named(name: &str) -> Who {
    Who {
        name: name.to_owned(),
        nth: 0,
    }
}

fn found(who: &Who) -> Result<String, String> {
    find(who).ok_or_else(|| {
        format!(
            "a script finds entities by a name of their own, and {} has none: give it one in the scene's \
             script",
            who.words()
        )
    })
}

/// A line that gives entities what calls make.
fn given(calls: &str, to: &[Who]) -> Result<String, String> {
    if to.is_empty() {
        return Ok(format!("{calls};"));
    }
    let each: Result<Vec<String>, String> = to
        .iter()
        .map(|who| Ok(format!(" {}.material(it);", found(who)?)))
        .collect();
    Ok(format!("{{ let it = {calls};{} }}", each?.concat()))
}

impl Scene {
    /// The calls that make a material as it is.
    fn material_calls(&self, id: MaterialId) -> Result<String, String> {
        let material = self.assets.material(id);
        let data = self.stage.lock();
        let texture = |id| data.recipes.textures.get(&id).cloned();
        let calls = material.and_then(|material| recipes::material(material, texture));
        calls.ok_or_else(|| {
            "a texture of this material was made by a function of the script, which has no call that could \
             stand elsewhere: change the material where the script makes it"
                .to_owned()
        })
    }

    fn drawn_with(&self, id: MaterialId) -> Vec<Who> {
        let users: Vec<Entity> = self.users(AssetId::Material(id));
        Who::of(&self.world, &users)
    }

    /// A line that makes a material anew and gives it to all that has it.
    fn made_anew(&self, who: &Who) -> Result<String, String> {
        let id = naming::find_material(&self.assets, who)?;
        given(&self.material_calls(id)?, &self.drawn_with(id))
    }
}
