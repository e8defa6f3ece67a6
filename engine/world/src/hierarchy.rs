//! Parents and children.
//!
//! Each entity in a tree holds links to its parent, its first and last child and
//! its neighbours among the siblings, so that linking and unlinking cost the
//! same however many children there are.

use crate::components::{Family, Transform, Transform2d};
use crate::entity::Entity;
use crate::error::WorldError;
use crate::world::World;

impl World {
    /// The parent of an entity. `None` for a root and for a stale handle.
    pub fn parent(&self, entity: Entity) -> Option<Entity> {
        let parent = self.family(entity).parent;
        (parent != Entity::NONE).then_some(parent)
    }

    /// The children of an entity in the order in which they were added.
    pub fn children(&self, entity: Entity) -> Children<'_> {
        Children {
            world: self,
            next: self.family(entity).first_child,
        }
    }

    /// All entities below an entity: children before their own children,
    /// without the entity itself.
    pub fn descendants(&self, entity: Entity) -> Vec<Entity> {
        let mut found: Vec<_> = self.children(entity).collect();
        let mut visited = 0;
        while let Some(&parent) = found.get(visited) {
            found.extend(self.children(parent));
            visited += 1;
        }
        found
    }

    /// Moves an entity below a parent, after its other children, or makes it a
    /// root. The entity's Transform stays as it is and now counts in the new
    /// parent's space.
    ///
    /// # Errors
    /// [`WorldError::Stale`] for either handle; [`WorldError::Cycle`] if the
    /// parent is the entity itself or lies below it. Nothing changes then.
    pub fn set_parent(&mut self, child: Entity, parent: Option<Entity>) -> Result<(), WorldError> {
        if self.contains(child) && self.parent(child) == parent {
            return Ok(());
        }
        let last = parent.map(|parent| self.family(parent).last_child);
        self.place_below(child, parent, last)
    }

    /// Like [`World::set_parent`], but at a place among the parent's children: after one of them, or
    /// before all where `after` is none of them.
    ///
    /// # Errors
    /// As [`World::set_parent`].
    pub fn place_below(
        &mut self,
        child: Entity,
        parent: Option<Entity>,
        after: Option<Entity>,
    ) -> Result<(), WorldError> {
        if let Some(stale) = [Some(child), parent]
            .into_iter()
            .flatten()
            .find(|&entity| !self.contains(entity))
        {
            return Err(WorldError::Stale(stale));
        }
        if let Some(parent) = parent
            && self.is_at_or_below(parent, child)
        {
            return Err(WorldError::Cycle { child, parent });
        }
        self.unlink(child);
        if let Some(parent) = parent {
            let is_sibling = |after: &Entity| self.parent(*after) == Some(parent);
            let after = after.filter(is_sibling).unwrap_or(Entity::NONE);
            self.link(child, parent, after);
        }
        self.columns_mut::<Transform>().mark(child);
        self.columns_mut::<Transform2d>().mark(child);
        Ok(())
    }

    /// The sibling before an entity. `None` for the first, for a root and for a stale handle.
    pub fn previous_sibling(&self, entity: Entity) -> Option<Entity> {
        let previous = self.family(entity).previous;
        (previous != Entity::NONE).then_some(previous)
    }

    /// Whether an entity is another one or one of its descendants.
    pub fn is_at_or_below(&self, entity: Entity, ancestor: Entity) -> bool {
        let mut current = Some(entity);
        while let Some(entity) = current {
            if entity == ancestor {
                return true;
            }
            current = self.parent(entity);
        }
        false
    }

    fn family(&self, entity: Entity) -> Family {
        self.get::<Family>(entity).unwrap_or_default()
    }

    /// Changes an entity's links. The row is created when the first link is, and
    /// removed with the last one.
    fn edit_family(&mut self, entity: Entity, edit: impl FnOnce(&mut Family)) {
        if entity == Entity::NONE {
            return;
        }
        let mut family = self.family(entity);
        edit(&mut family);
        if family == Family::default() {
            self.remove_any::<Family>(entity);
        } else {
            // Callers hold living entities only.
            let _living = self.insert_any(entity, family);
        }
    }

    /// Puts an entity below a parent, after one of its children or before all of them.
    fn link(&mut self, child: Entity, parent: Entity, previous: Entity) {
        let next = match previous {
            Entity::NONE => self.family(parent).first_child,
            previous => self.family(previous).next,
        };
        self.edit_family(child, |family| {
            family.parent = parent;
            family.previous = previous;
            family.next = next;
        });
        self.edit_family(previous, |family| family.next = child);
        self.edit_family(next, |family| family.previous = child);
        self.edit_family(parent, |family| {
            if next == Entity::NONE {
                family.last_child = child;
            }
            if previous == Entity::NONE {
                family.first_child = child;
            }
        });
    }

    /// Takes an entity out of its parent's children.
    pub(crate) fn unlink(&mut self, child: Entity) {
        let Family {
            parent,
            previous,
            next,
            ..
        } = self.family(child);
        self.edit_family(previous, |family| family.next = next);
        self.edit_family(next, |family| family.previous = previous);
        self.edit_family(parent, |family| {
            if family.first_child == child {
                family.first_child = next;
            }
            if family.last_child == child {
                family.last_child = previous;
            }
        });
        self.edit_family(child, |family| {
            family.parent = Entity::NONE;
            family.previous = Entity::NONE;
            family.next = Entity::NONE;
        });
    }
}

/// Walks the children of an entity. Made by [`World::children`].
#[derive(Clone, Debug)]
pub struct Children<'a> {
    world: &'a World,
    next: Entity,
}

impl Iterator for Children<'_> {
    type Item = Entity;

    fn next(&mut self) -> Option<Entity> {
        let child = self.next;
        if child == Entity::NONE {
            return None;
        }
        self.next = self.world.family(child).next;
        Some(child)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn children(world: &World, entity: Entity) -> Vec<Entity> {
        world.children(entity).collect()
    }

    #[test]
    fn children_keep_their_order_through_moves() {
        let mut world = World::new();
        let [a, b, c, d, e] = std::array::from_fn(|_| world.spawn());
        for child in [b, c, d] {
            world.set_parent(child, Some(a)).unwrap();
        }
        assert_eq!(children(&world, a), [b, c, d]);
        world.set_parent(c, Some(e)).unwrap();
        assert_eq!(children(&world, a), [b, d]);
        assert_eq!(world.parent(c), Some(e));
        world.set_parent(b, None).unwrap();
        assert_eq!(children(&world, a), [d]);
        assert_eq!(world.parent(b), None);
        world.set_parent(d, None).unwrap();
        assert_eq!(children(&world, a), []);
        assert!(!world.has::<Family>(a));
        assert!(!world.has::<Family>(d));
    }

    #[test]
    fn a_child_is_placed_among_its_siblings() {
        let mut world = World::new();
        let [a, b, c, d, e] = std::array::from_fn(|_| world.spawn());
        for child in [b, c] {
            world.set_parent(child, Some(a)).unwrap();
        }
        world.place_below(d, Some(a), Some(b)).unwrap();
        assert_eq!(children(&world, a), [b, d, c]);
        world.place_below(e, Some(a), None).unwrap();
        assert_eq!(children(&world, a), [e, b, d, c]);
        assert_eq!(world.previous_sibling(b), Some(e));
        assert_eq!(world.previous_sibling(e), None);
        world.place_below(e, Some(a), Some(c)).unwrap();
        world.place_below(b, Some(a), Some(b)).unwrap();
        assert_eq!(children(&world, a), [b, d, c, e]);
        assert_eq!(world.parent(e), Some(a));
        let cycle = world.place_below(a, Some(b), None);
        assert_eq!(
            cycle,
            Err(WorldError::Cycle {
                child: a,
                parent: b
            })
        );
    }

    #[test]
    fn cycles_are_refused_and_change_nothing() {
        let mut world = World::new();
        let [a, b, c] = std::array::from_fn(|_| world.spawn());
        world.set_parent(b, Some(a)).unwrap();
        world.set_parent(c, Some(b)).unwrap();
        for (child, parent) in [(a, a), (a, b), (a, c), (b, c)] {
            let error = world.set_parent(child, Some(parent)).unwrap_err();
            assert_eq!(error, WorldError::Cycle { child, parent });
        }
        assert_eq!(world.parent(a), None);
        assert_eq!(world.parent(b), Some(a));
        assert_eq!(world.parent(c), Some(b));
    }

    #[test]
    fn a_removal_takes_the_descendants_along() {
        let mut world = World::new();
        let [a, b, c, d] = std::array::from_fn(|_| world.spawn());
        world.set_parent(b, Some(a)).unwrap();
        world.set_parent(c, Some(b)).unwrap();
        world.set_parent(d, Some(a)).unwrap();
        assert!(world.despawn(b));
        assert!(!world.contains(c));
        assert_eq!(children(&world, a), [d]);
        assert_eq!(world.set_parent(d, Some(c)), Err(WorldError::Stale(c)));
        assert_eq!(world.len(), 2);
    }
}
