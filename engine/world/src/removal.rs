//! Taking entities out of a world so that they can be put back as they were.
//!
//! What is put back has its handle again, its rows where they lay, its place among its siblings, its
//! tags and its group: whoever held the handle holds it still, and what is first of its kind is first
//! again.

use crate::columns::Columns;
use crate::components::{ComponentKind, Row};
use crate::entity::Entity;
use crate::merge::EntityMap;
use crate::reflect::Role;
use crate::stores::{Stored, Visitor, VisitorMut};
use crate::ticks::Tick;
use crate::world::World;

/// An entity that was taken out of a world. Made by [`World::take_out`].
#[derive(Clone, Debug, PartialEq)]
pub struct Removed {
    entity: Entity,
    rows: Vec<Row>,
    /// Where each row lay, those of computed components too.
    places: Vec<(ComponentKind, usize)>,
    parent: Option<Entity>,
    previous: Option<Entity>,
    tags: Vec<String>,
    group: Option<String>,
}

impl Removed {
    /// The handle that the entity had.
    pub fn entity(&self) -> Entity {
        self.entity
    }

    /// Follows entities that have other handles now.
    pub fn follow(&mut self, map: &EntityMap) {
        for handle in [&mut self.parent, &mut self.previous].into_iter().flatten() {
            *handle = map.get(*handle).unwrap_or(*handle);
        }
    }

    /// Its components.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }
}

impl World {
    /// Removes an entity and everything below it, as [`World::despawn`] does, and gives what
    /// [`World::put_back`] takes. Empty for a stale handle.
    ///
    /// ```
    /// # use lightbench_world::{Name, World};
    /// # let mut world = World::new();
    /// let lamp = world.spawn();
    /// world.insert(lamp, Name::new("lamp"))?;
    /// let removed = world.take_out(lamp);
    /// assert!(!world.contains(lamp));
    /// world.put_back(&removed);
    /// assert_eq!(world.get::<Name>(lamp), Some(Name::new("lamp")));
    /// # Ok::<(), lightbench_world::WorldError>(())
    /// ```
    pub fn take_out(&mut self, entity: Entity) -> Vec<Removed> {
        if !self.contains(entity) {
            return Vec::new();
        }
        let mut all = vec![entity];
        all.extend(self.descendants(entity));
        // From the last one on, so that each is without children when it goes.
        let removed = all.iter().rev().map(|&entity| {
            let removed = self.record(entity);
            self.despawn(entity);
            removed
        });
        removed.collect()
    }

    /// Removes an entity and everything below it as if it had never been there: the next entity in its
    /// slot gets its handle. Only for those whose handles nobody keeps.
    pub fn unmake(&mut self, entity: Entity) {
        for removed in self.take_out(entity) {
            self.entities.forget(removed.entity);
        }
    }

    /// Puts entities back that were taken out together, each with its handle, or with a new one where
    /// the slot has had other tenants since. Returns which is which.
    ///
    /// One whose parent is not there any more becomes a root.
    pub fn put_back(&mut self, removed: &[Removed]) -> EntityMap {
        let mut map = EntityMap::default();
        for one in removed.iter().rev() {
            self.settle();
            let entity = match self.entities.revive(one.entity) {
                true => one.entity,
                false => self.entities.spawn(),
            };
            map.add(one.entity, entity);
            for row in &one.rows {
                // No row of a computed component was kept, and the entity is there.
                let _inserted = row.clone().insert_into(self, entity);
            }
            for &(kind, row) in &one.places {
                self.move_row(entity, kind, row);
            }
            for tag in &one.tags {
                let _tagged = self.add_tag(entity, tag);
            }
            if let Some(group) = &one.group {
                let _grouped = self.set_group(entity, Some(group));
            }
            let known = |handle: Option<Entity>| handle.map(|old| map.get(old).unwrap_or(old));
            if let Some(parent) = known(one.parent).filter(|parent| self.contains(*parent)) {
                // A new leaf makes no cycle.
                let _placed = self.place_below(entity, Some(parent), known(one.previous));
            }
        }
        map
    }

    /// Takes a component away and tells where its row lay, for [`World::give_back`].
    pub fn take_row(&mut self, entity: Entity, kind: ComponentKind) -> Option<(Row, usize)> {
        if kind.info().role == Role::Computed {
            return None;
        }
        let (row, place) = self.row_at(entity, kind)?;
        kind.remove(self, entity).then_some((row, place))
    }

    /// Gives a component back that [`World::take_row`] has taken. Nothing happens where the entity is
    /// gone.
    pub fn give_back(&mut self, entity: Entity, (row, place): (Row, usize)) {
        let kinds: Vec<ComponentKind> = self.components_of(entity).collect();
        if row.insert_into(self, entity).is_err() {
            return;
        }
        let new: Vec<ComponentKind> = self
            .components_of(entity)
            .filter(|kind| !kinds.contains(kind))
            .collect();
        for kind in new {
            self.move_row(entity, kind, place);
        }
    }

    /// Copies of an entity's components, but for those that systems write.
    pub fn rows_of(&self, entity: Entity) -> Vec<Row> {
        let kinds = self.components_of(entity);
        let own = kinds.filter(|kind| kind.info().role != Role::Computed);
        own.filter_map(|kind| Some(self.row_at(entity, kind)?.0))
            .collect()
    }

    fn record(&self, entity: Entity) -> Removed {
        let mut rows = Vec::new();
        let mut places = Vec::new();
        for kind in self.components_of(entity) {
            let Some((row, place)) = self.row_at(entity, kind) else {
                continue;
            };
            if kind != ComponentKind::Family {
                places.push((kind, place));
            }
            if kind.info().role != Role::Computed {
                rows.push(row);
            }
        }
        Removed {
            entity,
            rows,
            places,
            parent: self.parent(entity),
            previous: self.previous_sibling(entity),
            tags: self.tags().of(entity).map(str::to_owned).collect(),
            group: self.group_of(entity).map(str::to_owned),
        }
    }

    fn row_at(&self, entity: Entity, kind: ComponentKind) -> Option<(Row, usize)> {
        struct Read {
            entity: Entity,
            found: Option<(Row, usize)>,
        }
        impl Visitor for Read {
            fn visit<C: Stored>(&mut self, columns: &Columns<C>) {
                let place = columns.row_of(self.entity);
                self.found = place.map(|place| (columns.row(place).into(), place));
            }
        }
        let mut read = Read {
            entity,
            found: None,
        };
        self.stores.get().visit_one(kind, &mut read);
        read.found
    }

    /// Changes the place of an entity's row with that of the row at a position.
    fn move_row(&mut self, entity: Entity, kind: ComponentKind, place: usize) {
        struct Swap {
            entity: Entity,
            place: usize,
            now: Tick,
        }
        impl VisitorMut for Swap {
            fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
                columns.set_now(self.now);
                columns.swap_to(self.entity, self.place);
            }
        }
        let mut swap = Swap {
            entity,
            place,
            now: self.clock.now(),
        };
        self.stores.get_mut().visit_one_mut(kind, &mut swap);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::systems::update_world_matrices;
    use crate::{Camera, Light, Name, Transform, Velocity, WorldMatrix};
    use glam::Vec3;

    fn world() -> (World, Vec<Entity>) {
        let mut world = World::new();
        let all: Vec<Entity> = (0..6).map(|_| world.spawn()).collect();
        for (i, &entity) in all.iter().enumerate() {
            let at = Transform::from_translation(Vec3::splat(i as f32));
            world.insert(entity, at).unwrap();
            world.insert(entity, Name::new(format!("n{i}"))).unwrap();
            world.insert(entity, Camera::default()).unwrap();
        }
        for child in [1, 2, 3] {
            world.set_parent(all[child], Some(all[0])).unwrap();
        }
        world.set_parent(all[4], Some(all[2])).unwrap();
        world.add_tag(all[2], "b").unwrap();
        world.add_tag(all[2], "a").unwrap();
        world.set_group(all[4], Some("east")).unwrap();
        (world, all)
    }

    /// Everything that can be seen of a world, orders included.
    fn seen(world: &World) -> String {
        let mut text = format!(
            "{:?} {:?}",
            world.columns::<Camera>().entities(),
            world.columns::<Transform>().entities()
        );
        assert_eq!(
            world.columns::<Transform>().entities(),
            world.columns::<WorldMatrix>().entities()
        );
        for entity in world.entities() {
            text += &format!(
                "\n{entity} {:?} {:?} {:?} {:?} {:?}",
                world.record(entity).rows,
                world.parent(entity),
                world.children(entity).collect::<Vec<_>>(),
                world.tags().of(entity).collect::<Vec<_>>(),
                world.group_of(entity),
            );
        }
        text
    }

    #[test]
    fn what_is_put_back_is_as_it_was_in_every_order() {
        for first in 0..6 {
            for second in 0..6 {
                let (mut world, all) = world();
                let before = seen(&world);
                let one = world.take_out(all[first]);
                assert!(!world.contains(all[first]));
                let between = seen(&world);
                let two = world.take_out(all[second]);
                world.put_back(&two);
                assert_eq!(seen(&world), between);
                world.put_back(&one);
                assert_eq!(seen(&world), before);
                update_world_matrices(&mut world);
                let deepest: WorldMatrix = world.get(all[4]).unwrap();
                assert_eq!(deepest.matrix.translation.x, 6.0, "0 + 2 + 4");
            }
        }
    }

    #[test]
    fn a_slot_that_has_another_tenant_stays_with_it() {
        let (mut world, all) = world();
        let removed = world.take_out(all[2]);
        let other = world.spawn();
        let map = world.put_back(&removed);
        let new = map.get(all[2]).unwrap();
        assert!(new != all[2] && !world.contains(all[2]) && world.contains(other));
        assert_eq!(world.parent(map.get(all[4]).unwrap()), Some(new));
        assert_eq!(
            world.children(all[0]).collect::<Vec<_>>(),
            [all[1], new, all[3]]
        );
        // Without its parent it stands alone.
        let removed = world.take_out(all[3]);
        world.despawn(all[0]);
        let map = world.put_back(&removed);
        assert_eq!(world.parent(map.get(all[3]).unwrap()), None);
        assert!(world.take_out(all[0]).is_empty());
    }

    #[test]
    fn what_was_unmade_leaves_slots_as_they_were() {
        let (mut world, all) = world();
        let removed = world.take_out(all[2]);
        let before = seen(&world);
        let made = [world.spawn(), world.spawn(), world.spawn()];
        world.set_parent(made[1], Some(made[0])).unwrap();
        world.insert(made[1], Light::default()).unwrap();
        world.unmake(made[2]);
        world.unmake(made[0]);
        assert_eq!(seen(&world), before);
        assert_eq!([world.spawn(), world.spawn()], [made[0], made[1]]);
        world.unmake(made[1]);
        world.unmake(made[0]);
        let map = world.put_back(&removed);
        assert_eq!(map.get(all[4]), Some(all[4]));
        assert!(world.contains(all[2]) && world.contains(all[4]));
    }

    #[test]
    fn a_component_comes_back_to_its_row() {
        let (mut world, all) = world();
        let before = seen(&world);
        for kind in [ComponentKind::Transform, ComponentKind::Camera] {
            let taken = world.take_row(all[1], kind).unwrap();
            assert!(!world.has_component(all[1], kind));
            world.give_back(all[1], taken);
            assert_eq!(seen(&world), before);
        }
        assert_eq!(world.take_row(all[1], ComponentKind::Velocity), None);
        assert_eq!(world.take_row(all[1], ComponentKind::WorldMatrix), None);
        world.insert(all[1], Velocity::default()).unwrap();
        assert!(world.take_row(all[1], ComponentKind::Velocity).is_some());
        world.insert(all[1], Light::default()).unwrap();
        let lamp = world.take_row(all[1], ComponentKind::Light).unwrap();
        world.despawn(all[1]);
        world.give_back(all[1], lamp);
        assert!(world.columns::<Light>().is_empty());
    }
}
