//! Creating and removing many entities at once.

use crate::bits::{BitSet, Scratch};
use crate::columns::Columns;
use crate::components::{Family, Stores};
use crate::entity::Entity;
use crate::reflect::Role;
use crate::sets::{GROUPED, TAGGED};
use crate::stores::{Stored, VisitorMut};
use crate::ticks::Tick;
use crate::world::World;

/// Bundles that are split into their components at a time: they fit into the
/// fastest cache, from where each array takes its own.
const CHUNK: usize = 128;

/// Several components of one entity: a tuple of up to eight different ones.
pub trait Bundle: Sized {
    /// One vector for each component.
    type Rows: Default;
    /// The bits of all components.
    const BITS: u32;
    /// Makes room in all columns, and sets the tick that the rows will carry.
    fn prepare(stores: &mut Stores, additional: usize, now: Tick);
    /// Adds the components to their vectors.
    fn split(self, rows: &mut Self::Rows);
    /// Adds the rows of entities that have none yet, and empties the vectors.
    fn extend(rows: &mut Self::Rows, stores: &mut Stores, entities: &[Entity], now: Tick);
    /// The entities of the first component.
    fn entities(stores: &Stores) -> &[Entity];
}

macro_rules! bundle {
    ($first:ident $first_row:ident $first_rows:ident $(, $component:ident $row:ident $rows:ident)*) => {
        impl<$first: Stored, $($component: Stored),*> Bundle for ($first, $($component,)*) {
            type Rows = (Vec<$first>, $(Vec<$component>,)*);
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
            fn split(self, ($first_rows, $($rows,)*): &mut Self::Rows) {
                let ($first_row, $($row,)*) = self;
                $first_rows.push($first_row);
                $($rows.push($row);)*
            }
            fn extend(
                ($first_rows, $($rows,)*): &mut Self::Rows,
                stores: &mut Stores,
                entities: &[Entity],
                now: Tick,
            ) {
                extend($first_rows, stores, entities, now);
                $(extend($rows, stores, entities, now);)*
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

fn extend<C: Stored>(rows: &mut Vec<C>, stores: &mut Stores, entities: &[Entity], now: Tick) {
    C::columns_mut(stores).extend(entities, rows);
    C::extend_follower(stores, entities, now);
}

bundle!(A a rows_a);
bundle!(A a rows_a, B b rows_b);
bundle!(A a rows_a, B b rows_b, C c rows_c);
bundle!(A a rows_a, B b rows_b, C c rows_c, D d rows_d);
bundle!(A a rows_a, B b rows_b, C c rows_c, D d rows_d, E e rows_e);
bundle!(A a rows_a, B b rows_b, C c rows_c, D d rows_d, E e rows_e, F f rows_f);
bundle!(A a rows_a, B b rows_b, C c rows_c, D d rows_d, E e rows_e, F f rows_f, G g rows_g);
bundle!(A a rows_a, B b rows_b, C c rows_c, D d rows_d, E e rows_e, F f rows_f, G g rows_g, H h rows_h);

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
        self.entities.reserve(announced);
        B::prepare(&mut self.stores, announced, now);
        let before = B::entities(&self.stores).len();
        let mut rows = B::Rows::default();
        let mut spawned = Vec::with_capacity(CHUNK);
        for bundle in bundles {
            bundle.split(&mut rows);
            spawned.push(self.entities.spawn_with(B::BITS));
            if spawned.len() == CHUNK {
                B::extend(&mut rows, &mut self.stores, &spawned, now);
                spawned.clear();
            }
        }
        B::extend(&mut rows, &mut self.stores, &spawned, now);
        &B::entities(&self.stores)[before..]
    }

    /// Removes many entities with their components and descendants, column by
    /// column. Stale handles and repetitions are skipped. Returns how many
    /// entities were removed.
    pub fn despawn_batch(&mut self, entities: &[Entity]) -> usize {
        let mut slots = BitSet::default();
        slots.reset(self.entities.slots());
        let mut removed = 0;
        let mut present = 0;
        let mut free = |world: &mut Self, entity: Entity| {
            if let Some(bits) = world.entities.despawn(entity) {
                slots.insert(entity.index() as usize);
                removed += 1;
                present |= bits;
                world.leave_sets(entity, bits);
            }
        };
        for &entity in entities {
            if self.entities.components(entity) & FAMILY != 0 {
                self.unlink(entity);
                for descendant in self.descendants(entity) {
                    free(self, descendant);
                }
            }
            free(self, entity);
        }
        self.stores.visit_mut(&mut DiscardSlots {
            slots,
            present,
            now: self.clock.now(),
            scratch: Scratch::default(),
        });
        removed
    }

    /// Removes one entity's components and gives its slot back.
    pub(crate) fn free(&mut self, entity: Entity) {
        if let Some(components) = self.entities.despawn(entity) {
            self.stores.visit_mut(&mut Discard {
                entity,
                components,
                now: self.clock.now(),
            });
            self.leave_sets(entity, components);
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

/// The bit of entities that are in a tree.
pub(crate) const FAMILY: u32 = 1 << Family::KIND as u32;

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
    use super::*;
    use crate::{Light, MeshRenderer, Transform, WorldBounds, WorldMatrix};
    use glam::Vec3;

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
