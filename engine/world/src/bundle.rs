//! Creating and removing many entities at once.

use std::marker::PhantomData;

use crate::components::{Family, Stores};
use crate::entity::Entity;
use crate::reflect::Role;
use crate::sets::{GROUPED, TAGGED};
use crate::stores::Stored;
use crate::ticks::Tick;
use crate::world::World;

/// Entities whose rows get their place in the maps at a time.
const CHUNK: usize = 128;

/// Several components of one entity: a tuple of up to eight different ones.
pub trait Bundle: Sized {
    /// The bits of all components.
    const BITS: u32;
    /// Makes room in all columns, and sets the tick that the rows will carry.
    fn prepare(stores: &mut Stores, additional: usize, now: Tick);
    /// Adds the fields to their arrays.
    fn push(self, stores: &mut Stores);
    /// Says whose rows the last ones are, as many as there are entities.
    fn assign(stores: &mut Stores, entities: &[Entity], now: Tick);
    /// The entities of the first component.
    fn entities(stores: &Stores) -> &[Entity];
}

macro_rules! bundle {
    ($first:ident $first_row:ident $(, $component:ident $row:ident)*) => {
        impl<$first: Stored, $($component: Stored),*> Bundle for ($first, $($component,)*) {
            const BITS: u32 = {
                let bits = add_bits::<$first>(0);
                $(let bits = add_bits::<$component>(bits);)*
                bits
            };
            fn prepare(stores: &mut Stores, additional: usize, now: Tick) {
                prepare::<$first>(stores, additional, now);
                $(prepare::<$component>(stores, additional, now);)*
            }
            #[inline]
            fn push(self, stores: &mut Stores) {
                let ($first_row, $($row,)*) = self;
                $first::columns_mut(stores).push_fields($first_row);
                $($component::columns_mut(stores).push_fields($row);)*
            }
            fn assign(stores: &mut Stores, entities: &[Entity], now: Tick) {
                assign::<$first>(stores, entities, now);
                $(assign::<$component>(stores, entities, now);)*
            }
            fn entities(stores: &Stores) -> &[Entity] {
                $first::columns(stores).entities()
            }
        }
    };
}

/// The bits of a bundle with one more component.
const fn add_bits<C: Stored>(bits: u32) -> u32 {
    assert!(bits & C::BITS == 0, "a component stands twice in a bundle");
    assert!(
        !matches!(C::INFO.role, Role::Computed),
        "a computed component cannot be given"
    );
    bits | C::BITS
}

fn prepare<C: Stored>(stores: &mut Stores, additional: usize, now: Tick) {
    let columns = C::columns_mut(stores);
    columns.reserve(additional);
    columns.set_now(now);
    C::reserve_follower(stores, additional);
}

fn assign<C: Stored>(stores: &mut Stores, entities: &[Entity], now: Tick) {
    C::columns_mut(stores).assign(entities);
    C::extend_follower(stores, entities, now);
}

bundle!(A a);
bundle!(A a, B b);
bundle!(A a, B b, C c);
bundle!(A a, B b, C c, D d);
bundle!(A a, B b, C c, D d, E e);
bundle!(A a, B b, C c, D d, E e, F f);
bundle!(A a, B b, C c, D d, E e, F f, G g);
bundle!(A a, B b, C c, D d, E e, F f, G g, H h);

impl World {
    /// Creates an entity for each bundle of components, and returns them in the
    /// same order. Room is made once, for as many as the iterator announces.
    ///
    /// ```
    /// # use lightbench_world::{Light, Transform, World};
    /// # let mut world = World::new();
    /// let lamps = world.spawn_batch((0..64).map(|i| {
    ///     let place = glam::Vec3::new(i as f32, 2.5, 0.0);
    ///     (Transform::from_translation(place), Light::default())
    /// }));
    /// assert_eq!(lamps.len(), 64);
    /// ```
    pub fn spawn_batch<B: Bundle>(&mut self, bundles: impl IntoIterator<Item = B>) -> &[Entity] {
        let bundles = bundles.into_iter();
        let announced = bundles.size_hint().0;
        let now = self.clock.now();
        let stores = self.stores.get_mut();
        self.entities.reserve(announced);
        B::prepare(stores, announced, now);
        let before = B::entities(stores).len();
        let mut open = OpenBatch::<B> {
            stores,
            spawned: Vec::with_capacity(CHUNK),
            now,
            bundles: PhantomData,
        };
        for bundle in bundles {
            open.spawned.push(self.entities.spawn_with(B::BITS));
            bundle.push(open.stores);
            if open.spawned.len() == CHUNK {
                open.assign();
            }
        }
        drop(open);
        &B::entities(self.stores.get())[before..]
    }

    /// Removes many entities with their components and descendants. Stale handles
    /// and repetitions are skipped. Returns how many entities were removed.
    pub fn despawn_batch(&mut self, entities: &[Entity]) -> usize {
        let before = self.len();
        for &entity in entities {
            self.despawn(entity);
        }
        before - self.len()
    }

    /// Makes an entity's handle stale and gives its slot back. Its rows go with
    /// the next look at the columns.
    #[inline]
    pub(crate) fn free(&mut self, entity: Entity) {
        if let Some(bits) = self.entities.despawn(entity) {
            if bits & !(TAGGED | GROUPED) != 0 {
                let (slots, now) = (self.entities.slots(), self.clock.now());
                self.stores.bury(entity, bits, slots, now);
            }
            self.leave_sets(entity, bits);
        }
    }

    /// Takes a removed entity out of its tags and its group.
    fn leave_sets(&mut self, entity: Entity, bits: u32) {
        if bits & TAGGED != 0 {
            self.tags.forget(entity);
        }
        if bits & GROUPED != 0 {
            self.groups.forget(entity);
        }
    }
}

/// Rows that were added and whose entities the maps do not know yet. They get to
/// know them even if the iterator of the bundles panics.
struct OpenBatch<'a, B: Bundle> {
    stores: &'a mut Stores,
    spawned: Vec<Entity>,
    now: Tick,
    bundles: PhantomData<B>,
}

impl<B: Bundle> OpenBatch<'_, B> {
    fn assign(&mut self) {
        B::assign(self.stores, &self.spawned, self.now);
        self.spawned.clear();
    }
}

impl<B: Bundle> Drop for OpenBatch<'_, B> {
    fn drop(&mut self) {
        self.assign();
    }
}

/// The bit of entities that are in a tree.
pub(crate) const FAMILY: u32 = 1 << Family::KIND as u32;

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Light, MeshRenderer, Transform, WorldBounds, WorldMatrix};
    use glam::Vec3;

    #[test]
    fn a_panic_between_bundles_leaves_a_sound_world() {
        let mut world = World::new();
        let spawning = std::panic::AssertUnwindSafe(|| {
            world.spawn_batch((0..300).map(|i| {
                assert!(i < 200, "on purpose");
                (Transform::from_translation(Vec3::splat(i as f32)),)
            }));
        });
        assert!(std::panic::catch_unwind(spawning).is_err());
        let columns = world.columns::<Transform>();
        assert_eq!((world.len(), columns.len()), (200, 200));
        assert_eq!(columns.translation().len(), 200);
        for entity in world.entities() {
            let place: Transform = world.get(entity).unwrap();
            assert_eq!(place.translation.x, entity.index() as f32);
        }
    }

    #[test]
    fn batches_do_what_single_calls_do() {
        let mut world = World::new();
        let first = world.spawn();
        world.despawn(first);
        let row = |i| Transform::from_translation(Vec3::splat(i as f32));
        let entities = world.spawn_batch((0..100).map(|i| (row(i), MeshRenderer::default())));
        let entities = entities.to_vec();
        assert_eq!(world.len(), 100);
        assert_eq!(world.columns::<WorldBounds>().len(), 100);
        assert_eq!(world.get::<Transform>(entities[40]), Some(row(40)));
        world.insert(entities[3], Light::default()).unwrap();
        world.set_parent(entities[50], Some(entities[4])).unwrap();

        let gone: Vec<_> = entities.iter().copied().step_by(2).collect();
        let twice = [gone.as_slice(), &gone, &[first]].concat();
        assert_eq!(world.despawn_batch(&twice), 50);
        assert_eq!(world.despawn_batch(&[entities[3]]), 1);
        assert_eq!(world.columns::<WorldMatrix>().len(), 49);
        assert!(world.columns::<Light>().is_empty());
        for (i, &entity) in entities.iter().enumerate() {
            let expected = (i % 2 == 1 && i != 3).then(|| row(i as i32));
            assert_eq!(world.get::<Transform>(entity), expected);
        }
    }
}
