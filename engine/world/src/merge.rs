//! Whole worlds: putting one into another, and going back to an earlier state.

use crate::columns::Columns;
use crate::entity::Entity;
use crate::stores::{Stored, VisitorMut};
use crate::ticks::Tick;
use crate::world::World;

/// Which entity of one world became which of another.
#[derive(Clone, Debug, Default)]
pub struct EntityMap {
    /// Old and new handle, by the slot of the old one.
    pairs: Vec<(Entity, Entity)>,
}

impl EntityMap {
    /// The new handle of an entity; `None` if it was not copied.
    pub fn get(&self, old: Entity) -> Option<Entity> {
        let &(known, new) = self.pairs.get(old.index() as usize)?;
        (known == old && old != Entity::NONE).then_some(new)
    }

    /// Takes over what another one knows.
    pub fn extend(&mut self, other: &Self) {
        for &(old, new) in other.pairs.iter().filter(|(old, _)| *old != Entity::NONE) {
            self.add(old, new);
        }
    }

    /// Takes note of one more.
    pub(crate) fn add(&mut self, old: Entity, new: Entity) {
        let slot = old.index() as usize;
        if slot >= self.pairs.len() {
            self.pairs.resize(slot + 1, (Entity::NONE, Entity::NONE));
        }
        self.pairs[slot] = (old, new);
    }
}

/// The state of a world at one moment. Made by [`World::snapshot`].
#[derive(Clone, Debug)]
pub struct Snapshot(World);

impl World {
    /// Copies all entities of another world into this one: a prefab into a scene,
    /// once or many times. Trees, tags, groups and handles between the copied
    /// entities stay as they were, with new handles; a handle to an entity that
    /// the other world does not contain becomes [`Entity::NONE`].
    pub fn merge(&mut self, other: &World) -> EntityMap {
        self.settle();
        let mut map = EntityMap::default();
        self.entities.reserve(other.len());
        for old in other.entities.iter() {
            let bits = other.entities.components(old);
            let new = self.entities.spawn_with(bits);
            let slot = old.index() as usize;
            map.pairs.resize(slot, (Entity::NONE, Entity::NONE));
            map.pairs.push((old, new));
        }
        let now = self.clock.now();
        self.stores.get_mut().append(other.stores.get(), &map, now);
        self.tags.append(&other.tags, &map);
        self.groups.append(&other.groups, &map);
        map
    }

    /// A copy of everything that the world holds.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot(self.clone())
    }

    /// Makes everything as it was when the snapshot was taken; handles that were
    /// valid then are valid again, and later ones are not. All rows count as
    /// changed, so that observers of this world see the old state as news.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        struct MarkAll(Tick);
        impl VisitorMut for MarkAll {
            fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
                columns.set_now(self.0);
                columns.mark_all();
            }
        }
        let clock = std::mem::take(&mut self.clock);
        *self = snapshot.0.clone();
        self.clock = clock;
        self.systems = Default::default();
        self.stores
            .get_mut()
            .visit_mut(&mut MarkAll(self.clock.now()));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::systems::update_world_matrices;
    use crate::{Light, Name, Transform, WorldMatrix};
    use glam::Vec3;

    fn at(x: f32) -> Transform {
        Transform::from_translation(Vec3::new(x, 0.0, 0.0))
    }

    fn prefab() -> (World, Entity, Entity) {
        let mut world = World::new();
        let gone = world.spawn();
        let [root, lamp] = std::array::from_fn(|_| world.spawn());
        world.despawn(gone);
        world.insert(root, at(1.0)).unwrap();
        world.insert(root, Name::new("root")).unwrap();
        world.insert(lamp, at(2.0)).unwrap();
        world.insert(lamp, Light::default()).unwrap();
        world.set_parent(lamp, Some(root)).unwrap();
        world.add_tag(lamp, "lamp").unwrap();
        world.set_group(root, Some("east")).unwrap();
        (world, root, lamp)
    }

    #[test]
    fn a_prefab_can_be_put_in_twice() {
        let (prefab, root, lamp) = prefab();
        let mut scene = World::new();
        scene.spawn();
        let maps = [scene.merge(&prefab), scene.merge(&prefab)];
        assert_eq!(scene.len(), 5);
        for map in &maps {
            let (new_root, new_lamp) = (map.get(root).unwrap(), map.get(lamp).unwrap());
            assert_eq!(scene.parent(new_lamp), Some(new_root));
            assert_eq!(scene.children(new_root).collect::<Vec<_>>(), [new_lamp]);
            assert_eq!(scene.get::<Name>(new_root), Some(Name::new("root")));
            assert!(scene.tags().contains("lamp", new_lamp));
            assert_eq!(scene.group_of(new_root), Some("east"));
        }
        update_world_matrices(&mut scene);
        let matrix = scene.get::<WorldMatrix>(maps[1].get(lamp).unwrap());
        assert_eq!(matrix.unwrap().matrix.translation.x, 3.0);
        assert_eq!(scene.despawn_group("east"), 4);
        assert_eq!(scene.tags().members("lamp"), []);
        assert!(maps[0].get(Entity::NONE).is_none());
    }

    #[test]
    fn restoring_undoes_everything_and_tells_observers() {
        let (mut world, root, lamp) = prefab();
        update_world_matrices(&mut world);
        let snapshot = world.snapshot();
        world.despawn(lamp);
        let later = world.spawn();
        world.insert(later, at(9.0)).unwrap();
        world.set(root, at(5.0)).unwrap();
        update_world_matrices(&mut world);
        let seen = world.observe();

        world.restore(&snapshot);
        assert!(world.contains(lamp) && !world.contains(later));
        assert_eq!(world.get::<Transform>(root), Some(at(1.0)));
        assert_eq!(world.parent(lamp), Some(root));
        let columns = world.columns::<Transform>();
        assert_eq!(columns.changed_since(seen).count(), 2);
        world.set(root, at(7.0)).unwrap();
        update_world_matrices(&mut world);
        let matrix = world.get::<WorldMatrix>(lamp).unwrap().matrix;
        assert_eq!(matrix.translation.x, 9.0);
    }

    #[test]
    fn a_clone_lives_on_its_own() {
        let (mut world, root, _) = prefab();
        let copy = world.clone();
        world.despawn(root);
        assert!(copy.contains(root));
        assert_eq!(copy.len(), 2);
    }
}
