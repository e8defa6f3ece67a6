//! World matrices: the product of an entity's transform with its ancestors'.

use glam::Affine3A;

use crate::components::{Family, Transform, WorldMatrix};
use crate::entity::Entity;
use crate::ticks::Tick;
use crate::world::World;

/// The tree as the system walks it, kept until the tree or the rows change.
#[derive(Clone, Debug, Default)]
pub(crate) struct MatrixState {
    seen: Tick,
    /// Order of the Transform rows and of the tree for which the plan holds.
    layout: (u64, Tick),
    /// Whether a row has an ancestor with a Transform. Empty if none has.
    has_parent: Vec<bool>,
    /// Rows with such an ancestor and the row of that ancestor, parents first:
    /// sorted by depth, and by row within one depth.
    links: Vec<Link>,
}

#[derive(Clone, Copy, Debug)]
struct Link {
    row: u32,
    parent: u32,
}

/// Writes the world matrix of every entity with a Transform whose own transform
/// or that of an ancestor has changed since the last call.
///
/// An ancestor without a Transform counts as one that does not move its
/// children.
pub fn update_world_matrices(world: &mut World) {
    let seen = world.systems.matrices.seen;
    let transforms = world.columns::<Transform>();
    let families = world.columns::<Family>();
    if !transforms.any_changed_since(seen) && !families.any_changed_since(seen) {
        return;
    }
    let mut state = std::mem::take(&mut world.systems.matrices);
    let replanned = state.plan(world);
    // The tick ends here, so that later writes are seen by the next call.
    let now = world.observe();
    let written = world.clock.now();

    let transforms = crate::stores::Stored::columns(&world.stores);
    let transforms: &crate::Columns<Transform> = transforms;
    let input = transforms.slices();
    let local = |row: usize| {
        Affine3A::from_scale_rotation_translation(
            input.scale[row],
            input.rotation[row],
            input.translation[row],
        )
    };
    let roots: Vec<usize> = transforms
        .changed_since(seen)
        .filter(|&row| !state.has_parent.get(row).is_some_and(|&has| has))
        .collect();
    let _ = written;
    let mut updates: Vec<(usize, Affine3A)> =
        roots.into_iter().map(|row| (row, local(row))).collect();

    // Depth by depth: a parent's matrix is final before its children read it.
    let matrices = world.columns::<WorldMatrix>().matrix();
    let mut fresh: Vec<Option<Affine3A>> = if state.links.is_empty() {
        Vec::new()
    } else {
        vec![None; matrices.len()]
    };
    if !state.links.is_empty() {
        for &(row, matrix) in &updates {
            fresh[row] = Some(matrix);
        }
        for link in &state.links {
            let (row, parent) = (link.row as usize, link.parent as usize);
            if replanned || fresh[parent].is_some() || transforms.row_changed_since(row, seen) {
                let matrix = fresh[parent].unwrap_or(matrices[parent]) * local(row);
                fresh[row] = Some(matrix);
                updates.push((row, matrix));
            }
        }
    }
    let columns = world.columns_mut::<WorldMatrix>();
    for (row, matrix) in updates {
        columns.set_row(row, WorldMatrix { matrix });
    }
    state.seen = now;
    world.systems.matrices = state;
}

impl MatrixState {
    /// Brings the plan up to date. True if it was made anew.
    fn plan(&mut self, world: &World) -> bool {
        let transforms = world.columns::<Transform>();
        let families = world.columns::<Family>();
        let tree_changed = families.any_changed_since(self.seen);
        if !tree_changed && (families.is_empty() || self.layout.0 == transforms.layout_version()) {
            return false;
        }
        self.layout.0 = transforms.layout_version();
        self.links.clear();
        self.has_parent.clear();
        if families.is_empty() {
            return true;
        }
        self.has_parent.resize(transforms.len(), false);

        // Breadth first from the roots of the tree. Each entry holds the row of
        // the nearest ancestor with a Transform.
        let slices = families.slices();
        let mut level: Vec<(Entity, Option<u32>)> = families
            .entities()
            .iter()
            .zip(slices.parent)
            .filter(|(_, parent)| **parent == Entity::NONE)
            .map(|(&entity, _)| (entity, None))
            .collect();
        let mut next = Vec::new();
        while !level.is_empty() {
            let first = self.links.len();
            for &(entity, above) in &level {
                let row = transforms.row_of(entity).map(|row| row as u32);
                if let (Some(row), Some(parent)) = (row, above) {
                    self.links.push(Link { row, parent });
                    self.has_parent[row as usize] = true;
                }
                next.extend(world.children(entity).map(|child| (child, row.or(above))));
            }
            self.links[first..].sort_unstable_by_key(|link| link.row);
            std::mem::swap(&mut level, &mut next);
            next.clear();
        }
        true
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use glam::{Quat, Vec3};

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
    }
}
