//! The world: entities and the columns of their components.

use crate::access::WriteSet;
use crate::bundle::FAMILY;
use crate::clock::Clock;
use crate::columns::Columns;
use crate::components::{ComponentKind, MeshRenderer, Name};
use crate::entity::{Entities, Entity};
use crate::error::WorldError;
use crate::reflect::Role;
use crate::sets::EntitySets;
use crate::settled::Settled;
use crate::stores::{Stored, Visitor, VisitorMut};
use crate::systems::SystemState;
use crate::ticks::Tick;

/// A set of entities with their components.
///
/// ```
/// use glam::Vec3;
/// use lightbench_world::{Light, Name, Transform, World};
///
/// let mut world = World::new();
/// let lamp = world.spawn();
/// world.insert(lamp, Name::new("lamp"))?;
/// world.insert(lamp, Transform::from_translation(Vec3::new(0.0, 3.0, 0.0)))?;
/// world.insert(lamp, Light { intensity: 40.0, ..Light::default() })?;
///
/// // All lights, as arrays.
/// for (light, power) in world.columns::<Light>().intensity().iter().enumerate() {
///     println!("light {light}: {power} W/sr");
/// }
/// world.despawn(lamp);
/// assert!(world.get::<Light>(lamp).is_none());
/// # Ok::<(), lightbench_world::WorldError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct World {
    pub(crate) entities: Entities,
    pub(crate) stores: Settled,
    pub(crate) clock: Clock,
    pub(crate) systems: SystemState,
    pub(crate) tags: EntitySets,
    pub(crate) groups: EntitySets,
}

impl World {
    /// A world without entities.
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates an entity without components.
    pub fn spawn(&mut self) -> Entity {
        self.settle();
        self.entities.spawn()
    }

    /// Takes the rows of removed entities out, so that their slots may be given
    /// out again.
    #[inline]
    pub(crate) fn settle(&mut self) {
        if self.stores.has_dead() {
            self.stores.get_mut();
        }
    }

    /// Removes an entity, its components and its descendants. False for a stale
    /// handle.
    ///
    /// The handle is stale at once. The rows are taken out when anybody next looks
    /// at a column, those of all removals until then together.
    pub fn despawn(&mut self, entity: Entity) -> bool {
        if !self.contains(entity) {
            return false;
        }
        if self.entities.components(entity) & FAMILY != 0 {
            self.unlink(entity);
            for descendant in self.descendants(entity) {
                self.free(descendant);
            }
        }
        self.free(entity);
        true
    }

    /// Whether the handle's entity exists.
    pub fn contains(&self, entity: Entity) -> bool {
        self.entities.contains(entity)
    }

    /// Number of entities.
    pub fn len(&self) -> usize {
        self.entities.len()
    }

    /// Whether there is no entity.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All entities in the order of their slots.
    pub fn entities(&self) -> impl Iterator<Item = Entity> + '_ {
        self.entities.iter()
    }

    /// Gives an entity a component, or overwrites the one that it has.
    ///
    /// # Errors
    /// [`WorldError::Stale`] for a stale handle, [`WorldError::Computed`] for a
    /// component that a system writes.
    pub fn insert<C: Stored>(&mut self, entity: Entity, row: C) -> Result<(), WorldError> {
        refuse_computed::<C>()?;
        self.insert_any(entity, row)
    }

    /// Like [`World::insert`], for computed components too.
    pub(crate) fn insert_any<C: Stored>(
        &mut self,
        entity: Entity,
        row: C,
    ) -> Result<(), WorldError> {
        let bits = self
            .entities
            .components_mut(entity)
            .ok_or(WorldError::Stale(entity))?;
        *bits |= C::BITS;
        let now = self.clock.now();
        if self.columns_mut::<C>().insert(entity, row) {
            C::push_follower(self.stores.get_mut(), entity, now);
        }
        Ok(())
    }

    /// Takes a component away from an entity. `None` if it had none, if the
    /// handle is stale, or if the component is one that a system writes.
    pub fn remove<C: Stored>(&mut self, entity: Entity) -> Option<C> {
        refuse_computed::<C>().ok()?;
        self.remove_any(entity)
    }

    /// Like [`World::remove`], for computed components too.
    pub(crate) fn remove_any<C: Stored>(&mut self, entity: Entity) -> Option<C> {
        let row = self.columns_mut::<C>().remove(entity)?;
        C::remove_follower(self.stores.get_mut(), entity, self.clock.now());
        if let Some(bits) = self.entities.components_mut(entity) {
            *bits &= !C::BITS;
        }
        if C::KIND == ComponentKind::Transform {
            // Its bounds stand at the origin now, and no matrix row tells so.
            self.columns_mut::<MeshRenderer>().mark(entity);
        }
        Some(row)
    }

    /// An entity's component by value. `None` if it has none or the handle is
    /// stale.
    #[inline]
    pub fn get<C: Stored>(&self, entity: Entity) -> Option<C> {
        self.columns::<C>().get(entity)
    }

    /// Overwrites a component that an entity has.
    ///
    /// # Errors
    /// [`WorldError::Stale`], [`WorldError::Computed`], or
    /// [`WorldError::Missing`] if the entity has no such component.
    pub fn set<C: Stored>(&mut self, entity: Entity, row: C) -> Result<(), WorldError> {
        refuse_computed::<C>()?;
        if !self.contains(entity) {
            return Err(WorldError::Stale(entity));
        }
        let columns = self.columns_mut::<C>();
        let position = columns.row_of(entity).ok_or(WorldError::Missing {
            entity,
            component: C::INFO.name,
        })?;
        columns.set_row(position, row);
        Ok(())
    }

    /// Whether an entity exists and has a component.
    #[inline]
    pub fn has<C: Stored>(&self, entity: Entity) -> bool {
        self.columns::<C>().row_of(entity).is_some()
    }

    /// All rows of one component.
    #[inline]
    pub fn columns<C: Stored>(&self) -> &Columns<C> {
        C::columns(self.stores.get())
    }

    /// All rows of one component, to write.
    #[inline]
    pub fn columns_mut<C: Stored>(&mut self) -> &mut Columns<C> {
        let now = self.clock.now();
        let columns = C::columns_mut(self.stores.get_mut());
        columns.set_now(now);
        columns
    }

    /// Lends some columns to write while the others are read, which a system that
    /// combines components needs. `W` is a tuple of the components to write; to
    /// the function the world shows no rows of those.
    ///
    /// ```
    /// # use lightbench_world::{Join, Transform, Velocity, World};
    /// # let mut world = World::new();
    /// # world.spawn_batch([(Transform::default(), Velocity::default())]);
    /// let mut moving = Join::<(Transform, Velocity), 2>::default();
    /// moving.update(&world);
    /// world.write::<(Transform,), _>(|world, (places,)| {
    ///     let places = places.slices_mut().translation;
    ///     let speeds = world.columns::<Velocity>().linear();
    ///     for run in moving.runs() {
    ///         for (place, speed) in places[run.rows(0)].iter_mut().zip(&speeds[run.rows(1)]) {
    ///             *place += *speed / 60.0;
    ///         }
    ///     }
    /// });
    /// ```
    pub fn write<W: WriteSet, T>(
        &mut self,
        function: impl FnOnce(&World, &mut W::Columns) -> T,
    ) -> T {
        let mut columns = W::take(self);
        let result = function(self, &mut columns);
        W::put(columns, self);
        result
    }

    /// Takes one component's columns out, so that they can be written while the
    /// others are read. They carry the present tick.
    pub(crate) fn take_columns<C: Stored>(&mut self) -> Columns<C> {
        let now = self.clock.now();
        let mut columns = std::mem::take(C::columns_mut(self.stores.get_mut()));
        columns.set_now(now);
        columns
    }

    /// Puts columns back that [`World::take_columns`] took out.
    pub(crate) fn put_columns<C: Stored>(&mut self, columns: Columns<C>) {
        *C::columns_mut(self.stores.get_mut()) = columns;
    }

    /// The first entity, in the order of slots, of this name.
    pub fn find(&self, name: &str) -> Option<Entity> {
        let names = self.columns::<Name>();
        let named = names.text().iter().zip(names.entities());
        named
            .filter(|(text, _)| *text == name)
            .map(|(_, &entity)| entity)
            .min()
    }

    /// Closes the current tick and returns it. Whatever is written afterwards
    /// counts as changed since then:
    ///
    /// ```
    /// # use lightbench_world::{Light, World};
    /// # let mut world = World::new();
    /// # let lamp = world.spawn();
    /// # world.insert(lamp, Light::default())?;
    /// let seen = world.observe();
    /// world.set(lamp, Light { intensity: 2.0, ..Light::default() })?;
    /// assert_eq!(world.columns::<Light>().changed_since(seen).count(), 1);
    /// # Ok::<(), lightbench_world::WorldError>(())
    /// ```
    pub fn observe(&self) -> Tick {
        self.clock.observe()
    }

    /// Gives back memory that no entity uses.
    pub fn shrink_to_fit(&mut self) {
        struct Shrink;
        impl VisitorMut for Shrink {
            fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
                columns.shrink_to_fit();
            }
        }
        self.entities.shrink_to_fit();
        self.stores.shrink_to_fit();
        self.stores.get_mut().visit_mut(&mut Shrink);
    }

    /// Bytes that the columns occupy, spare room and bookkeeping included.
    pub fn capacity_bytes(&self) -> usize {
        struct Sum(usize);
        impl Visitor for Sum {
            fn visit<C: Stored>(&mut self, columns: &Columns<C>) {
                self.0 += columns.capacity_bytes();
            }
        }
        let mut sum = Sum(self.entities.capacity_bytes() + self.stores.capacity_bytes());
        self.stores.get().visit(&mut sum);
        sum.0
    }
}

fn refuse_computed<C: Stored>() -> Result<(), WorldError> {
    match C::INFO.role {
        Role::Computed => Err(WorldError::Computed(C::INFO.name)),
        Role::Shown | Role::Hidden => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::components::{Light, MeshRenderer, Transform, WorldBounds, WorldMatrix};
    use glam::Vec3;

    fn at(x: f32) -> Transform {
        Transform::from_translation(Vec3::new(x, 0.0, 0.0))
    }

    #[test]
    fn rows_follow_their_entities_through_removals() {
        let mut world = World::new();
        let entities: Vec<_> = (0..10).map(|_| world.spawn()).collect();
        for (i, &entity) in entities.iter().enumerate() {
            world.insert(entity, at(i as f32)).unwrap();
        }
        assert!(world.despawn(entities[2]));
        assert_eq!(world.remove::<Transform>(entities[5]), Some(at(5.0)));
        for (i, &entity) in entities.iter().enumerate() {
            let expected = (i != 2 && i != 5).then(|| at(i as f32));
            assert_eq!(world.get::<Transform>(entity), expected);
        }
        let columns = world.columns::<Transform>();
        assert_eq!(columns.len(), 8);
        assert_eq!(columns.translation().len(), 8);
        assert_eq!(
            columns.entities(),
            world.columns::<WorldMatrix>().entities()
        );
    }

    #[test]
    fn stale_handles_are_refused_everywhere() {
        let mut world = World::new();
        let old = world.spawn();
        world.insert(old, at(1.0)).unwrap();
        world.despawn(old);
        let new = world.spawn();
        world.insert(new, at(2.0)).unwrap();
        assert_eq!(old.index(), new.index());
        assert!(!world.contains(old));
        assert!(!world.has::<Transform>(old));
        assert_eq!(world.get::<Transform>(old), None);
        assert_eq!(world.remove::<Transform>(old), None);
        assert_eq!(world.insert(old, at(3.0)), Err(WorldError::Stale(old)));
        assert_eq!(world.set(old, at(3.0)), Err(WorldError::Stale(old)));
        assert!(!world.despawn(old));
        assert_eq!(world.get::<Transform>(new), Some(at(2.0)));
    }

    #[test]
    fn computed_components_come_and_go_with_what_they_follow() {
        let mut world = World::new();
        let entity = world.spawn();
        let refused = Err(WorldError::Computed("WorldBounds"));
        assert_eq!(world.insert(entity, WorldBounds::default()), refused);
        world.insert(entity, MeshRenderer::default()).unwrap();
        assert!(world.has::<WorldBounds>(entity));
        assert_eq!(world.remove::<WorldBounds>(entity), None);
        world.remove::<MeshRenderer>(entity);
        assert!(!world.has::<WorldBounds>(entity));
    }

    #[test]
    fn setting_needs_the_component() {
        let mut world = World::new();
        let entity = world.spawn();
        let error = world.set(entity, Light::default()).unwrap_err();
        assert_eq!(error.to_string(), "entity #0.1 has no Light");
    }

    #[test]
    fn names_are_found_in_slot_order() {
        let mut world = World::new();
        let [a, b, c] = [world.spawn(), world.spawn(), world.spawn()];
        for entity in [c, b] {
            world.insert(entity, Name::new("twin")).unwrap();
        }
        world.insert(a, Name::new("other")).unwrap();
        assert_eq!(world.find("twin"), Some(b));
        assert_eq!(world.find("nobody"), None);
    }
}
