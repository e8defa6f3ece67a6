//! Entities by what they are called.

use std::collections::{HashMap, HashSet};

use lightbench_world::{Entity, Name, World};

use super::Who;

/// So many are looked for one by one; for more, all names are walked once.
const FEW: usize = 4;

/// The name of an entity; empty where it has none.
pub(super) fn named(world: &World, entity: Entity) -> String {
    let names = world.columns::<Name>();
    names
        .row_of(entity)
        .map_or_else(String::new, |row| names.text()[row].clone())
}

/// One entity.
pub(super) fn one(world: &World, who: &Who) -> Option<Entity> {
    all(world, std::slice::from_ref(who))[0]
}

/// Those that there are.
pub(super) fn found(world: &World, of: &[Who]) -> Vec<Entity> {
    all(world, of).into_iter().flatten().collect()
}

/// Entity for entity, those that there are.
pub(super) fn all(world: &World, of: &[Who]) -> Vec<Option<Entity>> {
    let simple = |who: &Who| who.nth == 0 && !who.name.is_empty();
    if of.len() <= FEW && of.iter().all(simple) {
        return of.iter().map(|who| world.find(&who.name)).collect();
    }
    let mut wanted: HashMap<&str, Vec<Entity>> = HashMap::new();
    for who in of {
        wanted.entry(&who.name).or_default();
    }
    let names = world.columns::<Name>();
    for entity in world.entities() {
        let name = names.row_of(entity).map_or("", |row| &names.text()[row]);
        if let Some(all) = wanted.get_mut(name) {
            all.push(entity);
        }
    }
    let get = |who: &Who| {
        wanted
            .get(who.name.as_str())?
            .get(who.nth as usize)
            .copied()
    };
    of.iter().map(get).collect()
}

impl Who {
    /// What to call entities of a world, in their order. Those that are not there are left out.
    #[must_use]
    pub fn of(world: &World, entities: &[Entity]) -> Vec<Self> {
        let chosen: HashSet<Entity> = entities.iter().copied().collect();
        let mut counts: HashMap<&str, u32> = HashMap::new();
        let mut known = HashMap::new();
        let names = world.columns::<Name>();
        for entity in world.entities() {
            let name = names
                .row_of(entity)
                .map_or("", |row| names.text()[row].as_str());
            let count = counts.entry(name).or_default();
            if chosen.contains(&entity) {
                let who = Self {
                    name: name.to_owned(),
                    nth: *count,
                };
                known.insert(entity, who);
            }
            *count += 1;
        }
        entities
            .iter()
            .filter_map(|entity| known.remove(entity))
            .collect()
    }

    /// The same without those that hang on others of them.
    #[must_use]
    pub fn topmost(world: &World, entities: &[Entity]) -> Vec<Self> {
        Self::of(world, &topmost(world, entities))
    }
}

/// Entities that hang on none of the others.
#[must_use]
pub fn topmost(world: &World, entities: &[Entity]) -> Vec<Entity> {
    let all: HashSet<Entity> = entities.iter().copied().collect();
    let above = |entity| std::iter::successors(world.parent(entity), |up| world.parent(*up));
    let entities = entities.iter().copied();
    entities
        .filter(|entity| !above(*entity).any(|above| all.contains(&above)))
        .collect()
}
