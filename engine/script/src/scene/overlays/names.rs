//! The names by which changes by hand are kept.

use std::collections::HashMap;

use lightbench_world::{Entity, Name};

use crate::scene::Scene;

impl Scene {
    /// The name by which what a person changes on an entity is kept.
    ///
    /// # Errors
    /// A sentence, where the entity can't be found by a name.
    pub fn keeps_by_name(&self, entity: Entity) -> Result<String, String> {
        let name: Option<Name> = self.world.get(entity);
        let Some(name) = name.filter(|name| !name.text.is_empty()) else {
            return Err(
                "what is changed by hand is kept by name, and this entity has none: give it one in \
                 the scene's script, as in `spawn(\"lamp\")`"
                    .to_owned(),
            );
        };
        if self.default_camera == Some(entity) {
            Err(
                "the scene's script makes no camera, so this one was made for it: make one there to \
                 change it, as in `camera(\"eye\")`"
                    .to_owned(),
            )
        } else if self.world.find(&name.text) == Some(entity) {
            Ok(name.text)
        } else {
            Err(format!(
                "what is changed by hand is kept by name, and another entity is called `{}` too: \
                 give each its own name in the scene's script",
                name.text
            ))
        }
    }

    /// The names by which what a person changes on entities is kept. All names are walked once, however
    /// many entities there are.
    ///
    /// # Errors
    /// As [`Scene::keeps_by_name`], for the first of them that can't be found by a name.
    pub fn keep_names(&self, entities: &[Entity]) -> Result<Vec<String>, String> {
        /// So many are looked for one by one.
        const FEW: usize = 4;
        if entities.len() <= FEW {
            return entities.iter().map(|e| self.keeps_by_name(*e)).collect();
        }
        let names = self.world.columns::<Name>();
        let mut first: HashMap<&str, Entity> = HashMap::with_capacity(names.len());
        for (text, entity) in names.text().iter().zip(names.entities()) {
            let known = first.entry(text).or_insert(*entity);
            *known = (*known).min(*entity);
        }
        let keep = |entity: &Entity| {
            let own = names.row_of(*entity).map(|row| &names.text()[row]);
            match own.filter(|own| first.get(own.as_str()) == Some(entity)) {
                Some(own) if !own.is_empty() && self.default_camera != Some(*entity) => {
                    Ok(own.clone())
                }
                // The sentence that says why not.
                _ => self.keeps_by_name(*entity),
            }
        };
        entities.iter().map(keep).collect()
    }
}
