//! World matrices: the product of an entity's transform with its ancestors'.

use glam::{Affine2, Affine3A};

use crate::columns::Columns;
use crate::components::{Family, Transform, Transform2d, WorldMatrix, WorldMatrix2d};
use crate::entity::Entity;
use crate::row_map::RowOrder;
use crate::stores::Stored;
use crate::ticks::Tick;
use crate::world::World;

/// A transform that is relative to a parent, in space or in the plane.
trait Placed: Stored {
    /// The component that holds the product.
    type World: Stored;
    /// The map itself.
    type Matrix: Copy + PartialEq + Send + Sync;

    /// The map of one row to its parent's space.
    fn local(columns: &Columns<Self>, row: usize) -> Self::Matrix;
    /// First `inner`, then `outer`.
    fn compose(outer: &Self::Matrix, inner: &Self::Matrix) -> Self::Matrix;
    /// The array of the products.
    fn matrices<'a>(slices: SlicesMut<'a, Self::World>) -> &'a mut [Self::Matrix];
    /// What the last run left for the next one.
    fn state(world: &mut World) -> &mut MatrixState;
}

type SlicesMut<'a, C> = <<C as crate::Component>::Arrays as crate::Arrays>::SlicesMut<'a>;

impl Placed for Transform {
    type World = WorldMatrix;
    type Matrix = Affine3A;

    #[inline]
    fn local(columns: &Columns<Self>, row: usize) -> Affine3A {
        columns.row(row).matrix()
    }
    #[inline]
    fn compose(outer: &Affine3A, inner: &Affine3A) -> Affine3A {
        *outer * *inner
    }
    fn matrices<'a>(slices: SlicesMut<'a, WorldMatrix>) -> &'a mut [Affine3A] {
        slices.matrix
    }
    fn state(world: &mut World) -> &mut MatrixState {
        &mut world.systems.matrices
    }
}

impl Placed for Transform2d {
    type World = WorldMatrix2d;
    type Matrix = Affine2;

    #[inline]
    fn local(columns: &Columns<Self>, row: usize) -> Affine2 {
        columns.row(row).matrix()
    }
    #[inline]
    fn compose(outer: &Affine2, inner: &Affine2) -> Affine2 {
        *outer * *inner
    }
    fn matrices<'a>(slices: SlicesMut<'a, WorldMatrix2d>) -> &'a mut [Affine2] {
        slices.matrix
    }
    fn state(world: &mut World) -> &mut MatrixState {
        &mut world.systems.matrices_2d
    }
}

/// No row above: the transform's parent is the world.
const ROOT: u32 = u32::MAX;

/// The tree as the system walks it, kept until the tree or the rows change.
#[derive(Clone, Debug, Default)]
pub(crate) struct MatrixState {
    seen: Tick,
    /// Order of the transform's rows for which the plan holds.
    layout: Option<RowOrder>,
    /// For each row the row of the nearest ancestor with a transform, or `ROOT`.
    /// Empty if no row has such an ancestor.
    parents: Vec<u32>,
    /// All rows sorted by depth, and by row within one depth. Empty if the rows
    /// themselves have every parent before its children: they are walked as
    /// they lie then, which reads memory in order.
    order: Vec<u32>,
}

/// Writes the world matrix of every entity whose own transform or that of an
/// ancestor has changed since the last call, in space ([`Transform`]) and in the
/// plane of the screen ([`Transform2d`]).
///
/// An ancestor without a transform of the same kind counts as one that does not
/// move its children.
pub fn update_world_matrices(world: &mut World) {
    update::<Transform>(world);
    update::<Transform2d>(world);
}

fn update<P: Placed>(world: &mut World) {
    let seen = P::state(world).seen;
    let tree_changed = world.columns::<Family>().any_changed_since(seen);
    if !tree_changed && !world.columns::<P>().any_changed_since(seen) {
        return;
    }
    let mut state = std::mem::take(P::state(world));
    let replanned = state.plan::<P>(world, tree_changed);
    // The tick ends here: what is written from now on, by this run first of all,
    // carries a later one.
    state.seen = world.observe();
    let mut output = world.take_columns::<P::World>();
    if state.parents.is_empty() {
        update_flat::<P>(world.columns::<P>(), &mut output, seen);
    } else if !replanned && world.columns::<P>().all_changed_since(seen) {
        state.update_whole_tree::<P>(world.columns::<P>(), &mut output);
    } else {
        let since = if replanned { Tick::START } else { seen };
        state.update_tree::<P>(world.columns::<P>(), &mut output, since);
    }
    world.put_columns(output);
    *P::state(world) = state;
}

/// Without a tree every row stands alone, and the threads share them.
fn update_flat<P: Placed>(input: &Columns<P>, output: &mut Columns<P::World>, since: Tick) {
    output.par_batches(|first, slices, marker| {
        let matrices = P::matrices(slices);
        for row in input.changed_in(first..first + matrices.len(), since) {
            matrices[row - first] = P::local(input, row);
            marker.mark(row - first);
        }
    });
}

impl MatrixState {
    /// Every transform was written: nothing is asked row by row.
    fn update_whole_tree<P: Placed>(&self, input: &Columns<P>, output: &mut Columns<P::World>) {
        let matrices = P::matrices(output.slices_mut());
        let mut visit = |row: usize| {
            let local = P::local(input, row);
            let parent = self.parents[row];
            matrices[row] = if parent == ROOT {
                local
            } else {
                P::compose(&matrices[parent as usize], &local)
            };
        };
        if self.order.is_empty() {
            (0..self.parents.len()).for_each(visit);
        } else {
            self.order.iter().for_each(|&row| visit(row as usize));
        }
    }

    /// A parent's matrix is final before its children read it.
    fn update_tree<P: Placed>(
        &self,
        input: &Columns<P>,
        output: &mut Columns<P::World>,
        since: Tick,
    ) {
        let started = self.seen;
        let (slices, mut marker) = output.slices_and_marker();
        let matrices = P::matrices(slices);
        let mut visit = |row: usize| {
            let parent = self.parents[row];
            let has_parent = parent != ROOT;
            let changed = input.row_changed_since(row, since)
                || has_parent && marker.row_changed_since(parent as usize, started);
            if changed {
                let local = P::local(input, row);
                let matrix = if has_parent {
                    P::compose(&matrices[parent as usize], &local)
                } else {
                    local
                };
                // A new plan visits every row; those that stayed where they
                // were need not go to the GPU again.
                if matrices[row] != matrix {
                    matrices[row] = matrix;
                    marker.mark(row);
                }
            }
        };
        if self.order.is_empty() {
            (0..self.parents.len()).for_each(visit);
        } else {
            self.order.iter().for_each(|&row| visit(row as usize));
        }
    }

    /// Brings the plan up to date. True if it was made anew.
    fn plan<P: Placed>(&mut self, world: &World, tree_changed: bool) -> bool {
        let input = world.columns::<P>();
        let families = world.columns::<Family>();
        let moved = !families.is_empty() && self.layout != Some(input.layout());
        if !tree_changed && !moved {
            return false;
        }
        self.layout = Some(input.layout());
        self.parents.clear();
        self.order.clear();
        if families.is_empty() {
            return true;
        }
        self.parents.resize(input.len(), ROOT);

        // Breadth first from the roots of the tree. Each entry holds the row of
        // the nearest ancestor with a transform.
        let parent_of = families.parent().iter();
        let mut level: Vec<(Entity, u32)> = families
            .entities()
            .iter()
            .zip(parent_of)
            .filter(|(_, parent)| **parent == Entity::NONE)
            .map(|(&entity, _)| (entity, ROOT))
            .collect();
        let mut next = Vec::new();
        let mut below = Vec::new();
        let mut in_order = true;
        while !level.is_empty() {
            let first = below.len();
            for &(entity, above) in &level {
                let own = input.row_of(entity).map(|row| row as u32);
                if let Some(row) = own
                    && above != ROOT
                {
                    self.parents[row as usize] = above;
                    in_order &= above < row;
                    below.push(row);
                }
                let here = own.unwrap_or(above);
                next.extend(world.children(entity).map(|child| (child, here)));
            }
            below[first..].sort_unstable();
            std::mem::swap(&mut level, &mut next);
            next.clear();
        }
        if below.is_empty() {
            self.parents.clear();
        } else if !in_order {
            let rows = 0..self.parents.len() as u32;
            let roots = rows.filter(|&row| self.parents[row as usize] == ROOT);
            self.order.extend(roots);
            self.order.extend(below);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use glam::{Quat, Vec2, Vec3};

    fn matrix(world: &World, entity: Entity) -> Affine3A {
        world.get::<WorldMatrix>(entity).unwrap().matrix
    }

    /// The definition, computed anew from the top.
    fn expected(world: &World, entity: Entity) -> Affine3A {
        let above = world
            .parent(entity)
            .map_or(Affine3A::IDENTITY, |parent| expected(world, parent));
        match world.get::<Transform>(entity) {
            Some(transform) => above * transform.matrix(),
            None => above,
        }
    }

    fn check_all(world: &World) {
        for &entity in world.columns::<Transform>().entities() {
            let (found, expected) = (matrix(world, entity), expected(world, entity));
            assert!(
                found.abs_diff_eq(expected, 1e-4),
                "{entity}: {found:?} is not {expected:?}"
            );
        }
    }

    fn sample(i: usize) -> Transform {
        let i = i as f32;
        Transform {
            translation: Vec3::new(i.sin(), i.cos(), 0.3 * i.sin()),
            rotation: Quat::from_rotation_y(i),
            scale: Vec3::splat(0.9 + 0.1 * i.cos()),
        }
    }

    #[test]
    fn follows_every_kind_of_change() {
        let mut world = World::new();
        let entities: Vec<_> = (0..64).map(|_| world.spawn()).collect();
        // Children stand before their parents as often as after them.
        for (i, &entity) in entities.iter().enumerate().rev() {
            if i % 7 != 3 {
                world.insert(entity, sample(i)).unwrap();
            }
        }
        for i in 1..64 {
            let parent = entities[(i * 5 + 1) % i];
            world.set_parent(entities[i], Some(parent)).unwrap();
        }
        update_world_matrices(&mut world);
        check_all(&world);
        assert!(!world.systems.matrices.order.is_empty());

        world.set(entities[0], sample(100)).unwrap();
        update_world_matrices(&mut world);
        check_all(&world);

        world.set_parent(entities[20], None).unwrap();
        update_world_matrices(&mut world);
        check_all(&world);

        world.insert(entities[3], sample(7)).unwrap();
        update_world_matrices(&mut world);
        check_all(&world);

        world.remove::<Transform>(entities[1]);
        update_world_matrices(&mut world);
        check_all(&world);

        world.despawn(entities[2]);
        update_world_matrices(&mut world);
        check_all(&world);
    }

    #[test]
    fn rows_in_order_are_walked_as_they_lie() {
        let mut world = World::new();
        let mut parent = None;
        for i in 0..100 {
            let entity = world.spawn();
            world.insert(entity, sample(i)).unwrap();
            if i % 8 != 0 {
                world.set_parent(entity, parent).unwrap();
            }
            parent = Some(entity);
        }
        update_world_matrices(&mut world);
        check_all(&world);
        assert!(world.systems.matrices.order.is_empty());
    }

    #[test]
    fn a_tree_that_is_written_as_a_whole_is_whole() {
        let mut world = World::new();
        let entities: Vec<_> = (0..40).map(|_| world.spawn()).collect();
        for (i, &entity) in entities.iter().enumerate().rev() {
            world.insert(entity, sample(i)).unwrap();
        }
        for i in 1..40 {
            let parent = entities[(i * 5 + 1) % i];
            world.set_parent(entities[i], Some(parent)).unwrap();
        }
        update_world_matrices(&mut world);
        let seen = world.observe();
        for place in world.columns_mut::<Transform>().slices_mut().translation {
            *place += Vec3::Y;
        }
        update_world_matrices(&mut world);
        check_all(&world);
        assert_eq!(
            world.columns::<WorldMatrix>().changed_since(seen).count(),
            40
        );
        // What comes after is told row by row again.
        let seen = world.observe();
        world.set(entities[0], sample(77)).unwrap();
        world.set_parent(entities[39], None).unwrap();
        update_world_matrices(&mut world);
        check_all(&world);
        assert!(world.columns::<WorldMatrix>().changed_since(seen).count() > 1);
    }

    #[test]
    fn the_plane_has_its_own_tree() {
        let mut world = World::new();
        let [panel, label] = std::array::from_fn(|_| world.spawn());
        let place = |x, y, turn| Transform2d {
            translation: Vec2::new(x, y),
            rotation: turn,
            ..Transform2d::default()
        };
        world
            .insert(panel, place(100.0, 50.0, std::f32::consts::FRAC_PI_2))
            .unwrap();
        world.insert(label, place(10.0, 0.0, 0.0)).unwrap();
        world.insert(label, sample(3)).unwrap();
        world.set_parent(label, Some(panel)).unwrap();
        update_world_matrices(&mut world);
        let matrix = world.get::<WorldMatrix2d>(label).unwrap().matrix;
        let origin = matrix.transform_point2(Vec2::ZERO);
        assert!(origin.distance(Vec2::new(100.0, 60.0)) < 1e-4);
        check_all(&world);
    }

    #[test]
    fn only_changed_branches_are_written() {
        let mut world = World::new();
        let [a, b, c, d] = std::array::from_fn(|i| {
            let entity = world.spawn();
            world.insert(entity, sample(i)).unwrap();
            entity
        });
        world.set_parent(b, Some(a)).unwrap();
        world.set_parent(c, Some(b)).unwrap();
        update_world_matrices(&mut world);

        let written = |world: &World, seen| -> Vec<Entity> {
            let columns = world.columns::<WorldMatrix>();
            columns
                .changed_since(seen)
                .map(|row| columns.entities()[row])
                .collect()
        };
        let seen = world.observe();
        update_world_matrices(&mut world);
        assert_eq!(written(&world, seen), []);

        world.set(b, sample(9)).unwrap();
        update_world_matrices(&mut world);
        assert_eq!(written(&world, seen), [b, c]);

        let seen = world.observe();
        world.set(d, sample(9)).unwrap();
        update_world_matrices(&mut world);
        assert_eq!(written(&world, seen), [d]);

        // A new entity makes a new plan, and still nobody else's row is written.
        let seen = world.observe();
        let new = world.spawn();
        world.insert(new, sample(5)).unwrap();
        update_world_matrices(&mut world);
        assert_eq!(written(&world, seen), [new]);

        let seen = world.observe();
        world.set_parent(d, Some(c)).unwrap();
        update_world_matrices(&mut world);
        assert_eq!(written(&world, seen), [d]);
    }
}
