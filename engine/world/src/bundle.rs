//! Creating and removing many entities at once.

use crate::columns::Columns;
use crate::components::{Family, Stores};
use crate::entity::Entity;
use crate::reflect::Role;
use crate::stores::{Stored, VisitorMut};
use crate::ticks::Tick;
use crate::world::World;

/// Several components of one entity: a tuple of up to eight different ones.
pub trait Bundle {
    /// The bits of all components.
    const BITS: u32;
    /// Makes room in all columns.
    fn reserve(stores: &mut Stores, additional: usize);
    /// Sets the tick that the rows will carry.
    fn set_now(stores: &mut Stores, now: Tick);
    /// Adds the rows of an entity that has none yet.
    fn push(self, stores: &mut Stores, entity: Entity, now: Tick);
}

macro_rules! bundle {
    ($($component:ident $row:ident),*) => {
        impl<$($component: Stored),*> Bundle for ($($component,)*) {
            const BITS: u32 = {
                let mut bits = 0;
                $(
                    assert!(bits & $component::BITS == 0, "a component stands twice in a bundle");
                    assert!(
                        !matches!($component::INFO.role, Role::Computed),
                        "a computed component cannot be given"
                    );
                    bits |= $component::BITS;
                )*
                bits
            };
            fn reserve(stores: &mut Stores, additional: usize) {
                $(
                    $component::columns_mut(stores).reserve(additional);
                    $component::reserve_follower(stores, additional);
                )*
            }
            fn set_now(stores: &mut Stores, now: Tick) {
                $($component::columns_mut(stores).set_now(now);)*
            }
            #[inline]
            fn push(self, stores: &mut Stores, entity: Entity, now: Tick) {
                let ($($row,)*) = self;
                $(
                    $component::columns_mut(stores).push(entity, $row);
                    $component::push_follower(stores, entity, now);
                )*
            }
        }
    };
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
    pub fn spawn_batch<B: Bundle>(&mut self, bundles: impl IntoIterator<Item = B>) -> Vec<Entity> {
        let bundles = bundles.into_iter();
        let announced = bundles.size_hint().0;
        let now = self.clock.now();
        self.entities.reserve(announced);
        B::reserve(&mut self.stores, announced);
        B::set_now(&mut self.stores, now);
        let mut spawned = Vec::with_capacity(announced);
        for bundle in bundles {
            let entity = self.entities.spawn_with(B::BITS);
            bundle.push(&mut self.stores, entity, now);
            spawned.push(entity);
        }
        spawned
    }

    /// Removes many entities with their components and descendants, column by
    /// column. Stale handles and repetitions are skipped. Returns how many
    /// entities were removed.
    pub fn despawn_batch(&mut self, entities: &[Entity]) -> usize {
        let mut removed: Vec<(Entity, u32)> = Vec::with_capacity(entities.len());
        let family = 1 << Family::KIND as u32;
        for &entity in entities {
            if self.entities.components(entity) & family != 0 {
                self.unlink(entity);
                for descendant in self.descendants(entity) {
                    let bits = self.entities.despawn(descendant);
                    removed.extend(bits.map(|bits| (descendant, bits)));
                }
            }
            let bits = self.entities.despawn(entity);
            removed.extend(bits.map(|bits| (entity, bits)));
        }
        self.free_all(&removed);
        removed.len()
    }

    /// Removes the rows of entities whose slots have been given back.
    pub(crate) fn free_all(&mut self, removed: &[(Entity, u32)]) {
        let mut remove = Remove {
            removed,
            present: removed.iter().fold(0, |all, (_, bits)| all | bits),
            now: self.clock.now(),
        };
        self.stores.visit_mut(&mut remove);
        for &(entity, bits) in removed {
            if bits & crate::sets::TAGGED != 0 {
                self.tags.forget(entity);
            }
            if bits & crate::sets::GROUPED != 0 {
                self.groups.forget(entity);
            }
        }
    }
}

struct Remove<'a> {
    removed: &'a [(Entity, u32)],
    present: u32,
    now: Tick,
}

impl VisitorMut for Remove<'_> {
    fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
        let bit = 1 << C::KIND as u32;
        if self.present & bit == 0 {
            return;
        }
        columns.set_now(self.now);
        for &(entity, bits) in self.removed {
            if bits & bit != 0 {
                columns.remove(entity);
            }
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
