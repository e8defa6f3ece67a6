//! The columns of a world, from which removed entities disappear when somebody
//! looks.
//!
//! To take one row out of a dozen arrays costs a dozen cache misses. Removing an
//! entity therefore only makes its handle stale, which is one, and puts it on a
//! list. The first reader or writer after that finds all rows of the list gone:
//! they are taken out together, array by array in the order of memory, or one by
//! one where there are few.

use std::sync::{Mutex, OnceLock, PoisonError};

use crate::bits::{BitSet, Scratch};
use crate::columns::Columns;
use crate::components::Stores;
use crate::entity::Entity;
use crate::stores::{Stored, VisitorMut};
use crate::ticks::Tick;

/// Rows are taken out one by one if there are more slots than this for each: a
/// removal together walks a bit for every slot in every column.
const SPARSE: usize = 512;

/// All columns. Whoever gets them never sees a row of a removed entity.
#[derive(Debug)]
pub(crate) struct Settled {
    /// The columns, once no removal is outstanding.
    ready: OnceLock<Box<Stores>>,
    /// The columns while one is.
    waiting: Mutex<Option<Box<Stores>>>,
    /// Entities that were removed since the columns were last ready, with the
    /// bits of their components. They stay here until the next change, because a
    /// reader can settle the columns but not empty the list.
    dead: Vec<(Entity, u32)>,
    /// Number of slots that the handles come from.
    slots: usize,
    /// The tick of the latest removal.
    now: Tick,
}

impl Default for Settled {
    fn default() -> Self {
        Self::new(Box::default())
    }
}

impl Clone for Settled {
    fn clone(&self) -> Self {
        Self::new(Box::new(self.get().clone()))
    }
}

impl Settled {
    fn new(stores: Box<Stores>) -> Self {
        Self {
            ready: OnceLock::from(stores),
            waiting: Mutex::default(),
            dead: Vec::new(),
            slots: 0,
            now: Tick::START,
        }
    }

    /// The columns.
    #[inline]
    pub fn get(&self) -> &Stores {
        match self.ready.get() {
            Some(stores) => stores,
            None => self.settle(),
        }
    }

    /// The columns, to write.
    #[inline]
    pub fn get_mut(&mut self) -> &mut Stores {
        if !self.dead.is_empty() {
            self.get();
            self.dead.clear();
        }
        match self.ready.get_mut() {
            Some(stores) => stores,
            None => unreachable!("the columns wait only while the list has entries"),
        }
    }

    /// Whether a removal may be outstanding.
    pub fn has_dead(&self) -> bool {
        !self.dead.is_empty()
    }

    /// Takes note of a removed entity with its component bits.
    #[inline]
    pub fn bury(&mut self, entity: Entity, components: u32, slots: usize, now: Tick) {
        if let Some(stores) = self.ready.take() {
            // Whoever is still on the list has been taken out by a reader.
            self.dead.clear();
            let waiting = self.waiting.get_mut();
            *waiting.unwrap_or_else(PoisonError::into_inner) = Some(stores);
        }
        self.dead.push((entity, components));
        self.slots = slots;
        self.now = now;
    }

    #[cold]
    fn settle(&self) -> &Stores {
        self.ready.get_or_init(|| {
            let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
            let mut stores = waiting.take().unwrap_or_default();
            if self.dead.len() * SPARSE < self.slots {
                for &(entity, components) in &self.dead {
                    stores.visit_mut(&mut Discard {
                        entity,
                        components,
                        now: self.now,
                    });
                }
            } else {
                stores.visit_mut(&mut self.together());
            }
            stores
        })
    }

    fn together(&self) -> DiscardSlots {
        let mut slots = BitSet::default();
        slots.reset(self.slots);
        let mut present = 0;
        for (entity, components) in &self.dead {
            slots.insert(entity.index() as usize);
            present |= components;
        }
        DiscardSlots {
            slots,
            present,
            now: self.now,
            scratch: Scratch::default(),
        }
    }

    pub fn shrink_to_fit(&mut self) {
        self.get_mut();
        self.dead.shrink_to_fit();
    }

    /// Bytes of the list.
    pub fn capacity_bytes(&self) -> usize {
        self.dead.capacity() * size_of::<(Entity, u32)>()
    }
}

/// Drops the rows of one entity.
struct Discard {
    entity: Entity,
    components: u32,
    now: Tick,
}

impl VisitorMut for Discard {
    #[inline]
    fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
        if self.components & (1 << C::KIND as u32) != 0 {
            columns.set_now(self.now);
            columns.discard(self.entity);
        }
    }
}

/// Drops the rows of all entities of some slots.
struct DiscardSlots {
    slots: BitSet,
    present: u32,
    now: Tick,
    scratch: Scratch,
}

impl VisitorMut for DiscardSlots {
    fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
        if self.present & (1 << C::KIND as u32) != 0 {
            columns.set_now(self.now);
            columns.discard_slots(&self.slots, &mut self.scratch);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use crate::{Light, Transform, Velocity, World};
    use glam::Vec3;

    fn world(count: usize) -> World {
        let mut world = World::new();
        world.spawn_batch((0..count).map(|i| {
            let place = Transform::from_translation(Vec3::splat(i as f32));
            (place, Velocity::default())
        }));
        world
    }

    #[test]
    fn nobody_sees_a_removed_entity() {
        let mut world = world(2000);
        let entities: Vec<_> = world.entities().collect();
        for &entity in &entities[..1500] {
            assert!(world.despawn(entity));
            assert!(!world.despawn(entity));
            assert!(!world.contains(entity));
        }
        assert_eq!(world.len(), 500);
        assert_eq!(world.entities().count(), 500);
        // By a shared reference, from several threads at once.
        let world = &world;
        std::thread::scope(|threads| {
            for _ in 0..4 {
                threads.spawn(|| {
                    assert_eq!(world.columns::<Transform>().len(), 500);
                    assert_eq!(world.get::<Transform>(entities[3]), None);
                    assert_eq!(world.get_field(entities[3], "Velocity", "linear"), None);
                    let kept: Transform = world.get(entities[1700]).unwrap();
                    assert_eq!(kept.translation.x, 1700.0);
                    assert_eq!(world.query::<(Transform, Velocity), 2>().count(), 500);
                });
            }
        });
    }

    #[test]
    fn slots_are_used_again_only_when_their_rows_are_gone() {
        let mut world = world(1000);
        let entities: Vec<_> = world.entities().collect();
        for &entity in entities.iter().step_by(2) {
            world.despawn(entity);
        }
        let new = world
            .spawn_batch((0..500).map(|_| (Light::default(),)))
            .to_vec();
        assert!(new.iter().all(|entity| (entity.index() as usize) < 1000));
        assert!(new.iter().all(|&entity| !world.has::<Transform>(entity)));
        world.despawn(new[0]);
        let again = world.spawn();
        assert_eq!(again.index(), new[0].index());
        assert!(!world.has::<Light>(again));
    }

    #[test]
    fn reading_in_between_changes_nothing_that_counts() {
        let (mut read, mut unread) = (world(3000), world(3000));
        let entities: Vec<_> = read.entities().collect();
        for (i, &entity) in entities.iter().enumerate().filter(|(i, _)| i % 3 != 0) {
            read.despawn(entity);
            unread.despawn(entity);
            if i % 100 == 1 {
                assert!(!read.has::<Transform>(entity));
            }
        }
        assert!(read.entities().eq(unread.entities()));
        for entity in read.entities() {
            assert_eq!(read.get::<Transform>(entity), unread.get(entity));
        }
        assert_eq!(read.spawn(), unread.spawn());
    }

    #[test]
    fn observers_hear_of_rows_that_moved() {
        let mut world = world(10);
        let first = world.entities().next().unwrap();
        let seen = world.observe();
        world.despawn(first);
        let columns = world.columns::<Transform>();
        assert!(columns.any_changed_since(seen));
        assert_eq!(columns.changed_since(seen).collect::<Vec<_>>(), [0]);
        let seen = world.observe();
        assert_eq!(world.columns::<Transform>().changed_since(seen).count(), 0);
    }

    #[test]
    fn copies_and_snapshots_are_settled() {
        let mut world = world(100);
        let first = world.entities().next().unwrap();
        world.despawn(first);
        let snapshot = world.snapshot();
        let mut copy = world.clone();
        assert_eq!(copy.columns::<Transform>().len(), 99);
        copy.restore(&snapshot);
        assert_eq!(copy.columns::<Transform>().len(), 99);
        world.despawn(copy.entities().next().unwrap());
        assert_eq!(world.merge(&copy).get(first), None);
        assert_eq!(world.columns::<Velocity>().len(), 98 + 99);
    }
}
