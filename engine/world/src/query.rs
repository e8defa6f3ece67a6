//! Several components of the same entities, as runs of contiguous rows.
//!
//! Each component has its own order of rows. A [`Join`] finds the entities that
//! have all of them, walking the component with the fewest rows, and notes where
//! their rows lie side by side in every component. Work then goes run by run over
//! plain slices. The runs are kept until an order changes, so that a frame in
//! which nothing is created or removed pays nothing for the join.

use std::marker::PhantomData;
use std::ops::Range;

use crate::columns::Columns;
use crate::entity::Entity;
use crate::row_map::RowOrder;
use crate::stores::Stored;
use crate::world::World;

/// Entities whose rows lie side by side in each of `N` components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run<const N: usize> {
    first: [u32; N],
    len: u32,
}

impl<const N: usize> Run<N> {
    /// The rows in the component at a position of the join's tuple.
    ///
    /// # Panics
    /// If `component` is not below `N`.
    pub fn rows(&self, component: usize) -> Range<usize> {
        let first = self.first[component] as usize;
        first..first + self.len as usize
    }

    /// Number of entities.
    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// Whether there is none. Never true for a run of a join.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
}

/// Two to four components that are wanted together.
pub trait Joined<const N: usize> {
    /// Their columns.
    type Columns<'a>: Copy;
    /// The columns of a world.
    fn columns(world: &World) -> Self::Columns<'_>;
    /// The order of rows in each component.
    fn layouts(columns: Self::Columns<'_>) -> [RowOrder; N];
    /// The entities of each component.
    fn entities<'a>(columns: Self::Columns<'a>) -> [&'a [Entity]; N];
    /// The row of an entity in each component, if it has them all.
    fn rows(columns: Self::Columns<'_>, entity: Entity) -> Option<[u32; N]>;
}

macro_rules! joined {
    ($count:literal: $($component:ident $columns:ident),*) => {
        impl<$($component: Stored),*> Joined<$count> for ($($component,)*) {
            type Columns<'a> = ($(&'a Columns<$component>,)*);
            fn columns(world: &World) -> Self::Columns<'_> {
                ($(world.columns::<$component>(),)*)
            }
            fn layouts(($($columns,)*): Self::Columns<'_>) -> [RowOrder; $count] {
                [$($columns.layout()),*]
            }
            fn entities<'a>(($($columns,)*): Self::Columns<'a>) -> [&'a [Entity]; $count] {
                [$($columns.entities()),*]
            }
            #[inline]
            fn rows(($($columns,)*): Self::Columns<'_>, entity: Entity) -> Option<[u32; $count]> {
                Some([$($columns.row_of(entity)? as u32),*])
            }
        }
    };
}

joined!(2: A a, B b);
joined!(3: A a, B b, C c);
joined!(4: A a, B b, C c, D d);

/// The entities that have all components of a tuple, as runs of rows.
///
/// ```
/// # use lightbench_world::{Join, Light, Transform, World};
/// # let mut world = World::new();
/// # world.spawn_batch((0..9).map(|_| (Transform::default(), Light::default())));
/// let mut lights = Join::<(Light, Transform), 2>::default();
/// let mut power_above_ground = 0.0;
/// for run in lights.update(&world) {
///     let power = &world.columns::<Light>().intensity()[run.rows(0)];
///     let place = &world.columns::<Transform>().translation()[run.rows(1)];
///     for (power, place) in power.iter().zip(place) {
///         power_above_ground += if place.y >= 0.0 { *power } else { 0.0 };
///     }
/// }
/// assert_eq!(power_above_ground, 9.0);
/// ```
#[derive(Clone, Debug)]
pub struct Join<T: Joined<N>, const N: usize> {
    /// The orders for which the runs hold; none before the first update.
    layouts: Option<[RowOrder; N]>,
    runs: Vec<Run<N>>,
    components: PhantomData<fn() -> T>,
}

impl<T: Joined<N>, const N: usize> Default for Join<T, N> {
    fn default() -> Self {
        Self {
            layouts: None,
            runs: Vec::new(),
            components: PhantomData,
        }
    }
}

impl<T: Joined<N>, const N: usize> Join<T, N> {
    /// The runs as they are now, in the order of the smallest component's rows.
    pub fn update(&mut self, world: &World) -> &[Run<N>] {
        self.update_columns(T::columns(world))
    }

    /// Like [`Join::update`], for systems, which have columns and no world.
    pub fn update_columns(&mut self, columns: T::Columns<'_>) -> &[Run<N>] {
        let layouts = T::layouts(columns);
        if self.layouts != Some(layouts) {
            self.layouts = Some(layouts);
            self.runs.clear();
            find_runs::<T, N>(columns, &mut self.runs);
        }
        &self.runs
    }

    /// The runs of the last update.
    pub fn runs(&self) -> &[Run<N>] {
        &self.runs
    }
}

/// Extends the last run as long as every component's next row belongs to the next
/// entity, and starts a new one otherwise.
fn find_runs<T: Joined<N>, const N: usize>(columns: T::Columns<'_>, runs: &mut Vec<Run<N>>) {
    let entities = T::entities(columns);
    let Some(smallest) = entities.into_iter().min_by_key(|entities| entities.len()) else {
        return;
    };
    for &entity in smallest {
        if let Some(run) = runs.last_mut() {
            let goes_on = (0..N).all(|component| {
                let next = run.first[component] + run.len;
                entities[component].get(next as usize) == Some(&entity)
            });
            if goes_on {
                run.len += 1;
                continue;
            }
        }
        if let Some(first) = T::rows(columns, entity) {
            runs.push(Run { first, len: 1 });
        }
    }
}

impl World {
    /// The entities that have all components of a tuple, with their rows, in the
    /// order of the smallest component. For work that is done every frame a
    /// [`Join`] is faster.
    ///
    /// ```
    /// # use lightbench_world::{Light, Transform, World};
    /// # let mut world = World::new();
    /// # world.spawn_batch([(Light::default(), Transform::default())]);
    /// for (entity, [light, place]) in world.query::<(Light, Transform), 2>() {
    ///     let light = world.columns::<Light>().row(light as usize);
    ///     let place = world.columns::<Transform>().row(place as usize);
    ///     println!("{entity} shines with {} from {}", light.intensity, place.translation);
    /// }
    /// ```
    pub fn query<'a, T: Joined<N> + 'a, const N: usize>(
        &'a self,
    ) -> impl Iterator<Item = (Entity, [u32; N])> + 'a {
        let columns = T::columns(self);
        let entities = T::entities(columns);
        let smallest = entities.into_iter().min_by_key(|entities| entities.len());
        smallest
            .unwrap_or_default()
            .iter()
            .filter_map(move |&entity| Some((entity, T::rows(columns, entity)?)))
    }

    /// Sorts the rows of `B` so that entities that also have an `A` come first
    /// and in the order of `A`. If `B`'s entities all have an `A` and `A` has no
    /// others, or has them at its end, a join of both is a single run then.
    pub fn align<A: Stored, B: Stored>(&mut self) {
        let leader: &Columns<A> = A::columns(self.stores.get());
        let follower: &Columns<B> = B::columns(self.stores.get());
        let rank = |entity| leader.row_of(entity).unwrap_or(usize::MAX);
        let mut order: Vec<u32> = (0..follower.len() as u32).collect();
        order.sort_by_key(|&row| rank(follower.entities()[row as usize]));
        if !order.is_sorted() {
            self.columns_mut::<B>().reorder(&order);
            let now = self.clock.now();
            B::reorder_follower(self.stores.get_mut(), &order, now);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Camera, Light, MeshRenderer, Transform, WorldBounds};
    use rand::{Rng, SeedableRng};

    /// The entities of the runs, each checked to be the same in all components.
    fn members(world: &World, runs: &[Run<2>]) -> Vec<Entity> {
        let mut found = Vec::new();
        for run in runs {
            let lights = &world.columns::<Light>().entities()[run.rows(0)];
            let places = &world.columns::<Transform>().entities()[run.rows(1)];
            assert_eq!(lights, places);
            found.extend_from_slice(lights);
        }
        found.sort();
        found
    }

    #[test]
    fn runs_hold_exactly_the_entities_with_all_components() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(11);
        let mut world = World::new();
        let mut join = Join::<(Light, Transform), 2>::default();
        let mut entities = Vec::new();
        for _ in 0..2000 {
            let entity = match entities.get(random.random_range(0..400)) {
                Some(&entity) => entity,
                None => {
                    entities.push(world.spawn());
                    continue;
                }
            };
            match random.random_range(0..5) {
                0 => drop(world.insert(entity, Light::default())),
                1 => drop(world.insert(entity, Transform::default())),
                2 => drop(world.remove::<Light>(entity)),
                3 => drop(world.remove::<Transform>(entity)),
                _ => drop(world.insert(entity, Camera::default())),
            }
            let expected: Vec<_> = world
                .entities()
                .filter(|&e| world.has::<Light>(e) && world.has::<Transform>(e))
                .collect();
            assert_eq!(members(&world, join.update(&world)), expected);
            assert_eq!(
                world.query::<(Light, Transform), 2>().count(),
                expected.len()
            );
        }
    }

    #[test]
    fn aligned_components_join_in_one_run() {
        let mut world = World::new();
        let entities = world
            .spawn_batch((0..500).map(|_| (Transform::default(),)))
            .to_vec();
        for &entity in entities.iter().rev() {
            world.insert(entity, MeshRenderer::default()).unwrap();
        }
        let mut join = Join::<(Transform, MeshRenderer), 2>::default();
        assert_eq!(join.update(&world).len(), 500);
        world.align::<Transform, MeshRenderer>();
        assert_eq!(join.update(&world).len(), 1);
        assert_eq!(
            world.columns::<WorldBounds>().entities(),
            world.columns::<MeshRenderer>().entities()
        );
        for &entity in &entities {
            assert!(world.has::<MeshRenderer>(entity));
        }
    }
}
