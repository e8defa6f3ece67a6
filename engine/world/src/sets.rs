//! Tags and groups: named sets of entities.
//!
//! An entity may carry many tags and belong to one group. Each set is a dense
//! list of its members, so that all entities with a tag are found without a
//! search, and adding and removing cost the same however many there are.

use std::collections::BTreeMap;

use crate::entity::Entity;
use crate::error::WorldError;
use crate::merge::EntityMap;
use crate::row_map::RowMap;
use crate::world::World;

/// Bits beside those of the components that say that an entity is in some set.
pub(crate) const TAGGED: u32 = 1 << 31;
pub(crate) const GROUPED: u32 = 1 << 30;

/// Sets of entities by name, in the order of the names.
#[derive(Clone, Debug, Default)]
pub struct EntitySets {
    sets: BTreeMap<String, RowMap>,
}

impl EntitySets {
    /// The members of a set, in no order that callers may rely on. Empty if
    /// nobody ever used the name.
    pub fn members(&self, name: &str) -> &[Entity] {
        self.sets.get(name).map_or(&[], RowMap::entities)
    }

    /// Whether an entity is in a set.
    pub fn contains(&self, name: &str, entity: Entity) -> bool {
        self.sets
            .get(name)
            .is_some_and(|set| set.row_of(entity).is_some())
    }

    /// The sets that an entity is in, in the order of their names.
    pub fn of(&self, entity: Entity) -> impl Iterator<Item = &str> + '_ {
        self.sets
            .iter()
            .filter(move |(_, set)| set.row_of(entity).is_some())
            .map(|(name, _)| name.as_str())
    }

    /// All sets that have members, in the order of their names.
    pub fn names(&self) -> impl Iterator<Item = &str> + '_ {
        self.sets
            .iter()
            .filter(|(_, set)| !set.entities().is_empty())
            .map(|(name, _)| name.as_str())
    }

    fn insert(&mut self, name: &str, entity: Entity) {
        if !self.sets.contains_key(name) {
            self.sets.insert(name.to_owned(), RowMap::default());
        }
        if let Some(set) = self.sets.get_mut(name)
            && set.row_of(entity).is_none()
        {
            set.push(entity);
        }
    }

    fn remove(&mut self, name: &str, entity: Entity) -> bool {
        self.sets
            .get_mut(name)
            .is_some_and(|set| set.swap_remove(entity).is_some())
    }

    /// Adds the copies of another world's members.
    pub(crate) fn append(&mut self, other: &Self, map: &EntityMap) {
        for (name, set) in &other.sets {
            for new in set.entities().iter().filter_map(|&old| map.get(old)) {
                self.insert(name, new);
            }
        }
    }

    /// Takes an entity out of every set.
    pub(crate) fn forget(&mut self, entity: Entity) {
        for set in self.sets.values_mut() {
            set.swap_remove(entity);
        }
    }
}

impl World {
    /// Gives an entity a tag, unless it has it.
    ///
    /// # Errors
    /// [`WorldError::Stale`] for a stale handle.
    pub fn add_tag(&mut self, entity: Entity, tag: &str) -> Result<(), WorldError> {
        let bits = self
            .entities
            .components_mut(entity)
            .ok_or(WorldError::Stale(entity))?;
        *bits |= TAGGED;
        self.tags.insert(tag, entity);
        Ok(())
    }

    /// Takes a tag away from an entity. False if it had none such.
    pub fn remove_tag(&mut self, entity: Entity, tag: &str) -> bool {
        self.tags.remove(tag, entity)
    }

    /// Puts an entity into a group, out of the one that it was in.
    ///
    /// # Errors
    /// [`WorldError::Stale`] for a stale handle.
    pub fn set_group(&mut self, entity: Entity, group: Option<&str>) -> Result<(), WorldError> {
        let bits = self
            .entities
            .components_mut(entity)
            .ok_or(WorldError::Stale(entity))?;
        if *bits & GROUPED != 0 {
            self.groups.forget(entity);
        }
        *bits &= !GROUPED;
        if let Some(group) = group {
            *bits |= GROUPED;
            self.groups.insert(group, entity);
        }
        Ok(())
    }

    /// The group that an entity is in.
    pub fn group_of(&self, entity: Entity) -> Option<&str> {
        self.groups.of(entity).next()
    }

    /// All tags with the entities that carry them.
    pub fn tags(&self) -> &EntitySets {
        &self.tags
    }

    /// All groups with their members.
    pub fn groups(&self) -> &EntitySets {
        &self.groups
    }

    /// Removes every entity of a group. Returns how many there were.
    pub fn despawn_group(&mut self, group: &str) -> usize {
        let members = self.groups.members(group).to_vec();
        self.despawn_batch(&members)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn an_entity_has_many_tags_and_one_group() {
        let mut world = World::new();
        let [a, b] = std::array::from_fn(|_| world.spawn());
        for (entity, tag) in [(a, "lamp"), (b, "lamp"), (a, "red"), (a, "red")] {
            world.add_tag(entity, tag).unwrap();
        }
        assert_eq!(world.tags().members("lamp"), [a, b]);
        assert_eq!(world.tags().of(a).collect::<Vec<_>>(), ["lamp", "red"]);
        assert!(world.remove_tag(a, "red"));
        assert!(!world.remove_tag(a, "red"));
        assert_eq!(world.tags().names().collect::<Vec<_>>(), ["lamp"]);

        world.set_group(a, Some("east")).unwrap();
        world.set_group(a, Some("west")).unwrap();
        world.set_group(b, Some("west")).unwrap();
        assert_eq!(world.group_of(a), Some("west"));
        assert_eq!(world.groups().names().collect::<Vec<_>>(), ["west"]);
        world.set_group(b, None).unwrap();
        assert_eq!(world.group_of(b), None);
        assert_eq!(world.despawn_group("west"), 1);
        assert!(!world.contains(a) && world.contains(b));
    }

    #[test]
    fn removed_entities_leave_their_sets() {
        let mut world = World::new();
        let entity = world.spawn();
        world.add_tag(entity, "lamp").unwrap();
        world.set_group(entity, Some("east")).unwrap();
        world.despawn(entity);
        let new = world.spawn();
        assert_eq!(new.index(), entity.index());
        assert!(world.tags().members("lamp").is_empty());
        assert!(!world.tags().contains("lamp", new));
        assert_eq!(world.group_of(new), None);
        assert_eq!(world.add_tag(entity, "x"), Err(WorldError::Stale(entity)));
    }
}
