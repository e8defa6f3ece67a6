//! Changes that wait until nobody iterates any more.
//!
//! A system or a script that walks over columns must not create or remove rows
//! meanwhile. It writes down what it wants instead, and the list is carried out
//! afterwards, in order. Several lists, one a thread or a system, are carried out
//! one after the other, so that the result does not depend on the threads.

use crate::components::{ComponentKind, Row};
use crate::entity::Entity;
use crate::stores::Stored;
use crate::world::World;

/// The entity that a command is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// One that exists.
    Entity(Entity),
    /// One that an earlier command of the same list creates.
    New(u32),
}

impl From<Entity> for Target {
    fn from(entity: Entity) -> Self {
        Self::Entity(entity)
    }
}

#[derive(Clone, Debug)]
enum Command {
    Spawn,
    Despawn(Target),
    Insert(Target, Row),
    Remove(Target, ComponentKind),
    SetParent(Target, Option<Target>),
    AddTag(Target, String),
}

/// A list of changes to a world.
///
/// ```
/// # use lightbench_world::{Commands, Light, Transform, World};
/// # let mut world = World::new();
/// # world.spawn_batch([(Light::default(),)]);
/// let mut commands = Commands::default();
/// for &entity in world.columns::<Light>().entities() {
///     let holder = commands.spawn();
///     commands.insert(holder, Transform::default());
///     commands.set_parent(entity, Some(holder));
/// }
/// assert_eq!(commands.apply(&mut world), 0);
/// assert_eq!(world.len(), 2);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Commands {
    commands: Vec<Command>,
    /// Entities that this list creates so far.
    spawns: u32,
    /// Their handles, while the list is being carried out.
    spawned: Vec<Entity>,
}

impl Commands {
    /// Creates an entity. The target serves the later commands of this list.
    pub fn spawn(&mut self) -> Target {
        self.commands.push(Command::Spawn);
        self.spawns += 1;
        Target::New(self.spawns - 1)
    }

    /// Removes an entity with its descendants.
    pub fn despawn(&mut self, target: impl Into<Target>) {
        self.commands.push(Command::Despawn(target.into()));
    }

    /// Gives an entity a component, or overwrites the one that it has.
    pub fn insert(&mut self, target: impl Into<Target>, row: impl Into<Row>) {
        self.commands
            .push(Command::Insert(target.into(), row.into()));
    }

    /// Takes a component away.
    pub fn remove<C: Stored>(&mut self, target: impl Into<Target>) {
        self.commands.push(Command::Remove(target.into(), C::KIND));
    }

    /// Moves an entity below a parent, or makes it a root.
    pub fn set_parent<P: Into<Target>>(&mut self, child: impl Into<Target>, parent: Option<P>) {
        self.commands
            .push(Command::SetParent(child.into(), parent.map(Into::into)));
    }

    /// Gives an entity a tag.
    pub fn add_tag(&mut self, target: impl Into<Target>, tag: &str) {
        self.commands
            .push(Command::AddTag(target.into(), tag.to_owned()));
    }

    /// Whether nothing is to be done.
    pub fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }

    /// Carries out all commands in order and empties the list, whose memory is
    /// kept. Commands that the world refuses change nothing: two systems may well
    /// remove the same entity. Returns how many those were.
    pub fn apply(&mut self, world: &mut World) -> usize {
        self.spawned.clear();
        let mut refused = 0;
        for command in self.commands.drain(..) {
            let entity = |target| match target {
                Target::Entity(entity) => entity,
                Target::New(index) => self
                    .spawned
                    .get(index as usize)
                    .copied()
                    .unwrap_or_default(),
            };
            let done = match command {
                Command::Spawn => {
                    self.spawned.push(world.spawn());
                    true
                }
                Command::Despawn(target) => world.despawn(entity(target)),
                Command::Insert(target, row) => row.insert_into(world, entity(target)).is_ok(),
                Command::Remove(target, kind) => kind.remove(world, entity(target)),
                Command::SetParent(child, parent) => {
                    world.set_parent(entity(child), parent.map(entity)).is_ok()
                }
                Command::AddTag(target, tag) => world.add_tag(entity(target), &tag).is_ok(),
            };
            refused += usize::from(!done);
        }
        self.spawns = 0;
        refused
    }

    /// The handle that a target got when the list was last carried out.
    pub fn entity(&self, target: Target) -> Option<Entity> {
        match target {
            Target::Entity(entity) => Some(entity),
            Target::New(index) => self.spawned.get(index as usize).copied(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Light, Transform};

    #[test]
    fn a_list_creates_links_and_removes() {
        let mut world = World::new();
        let old = world.spawn();
        world.insert(old, Light::default()).unwrap();
        let mut commands = Commands::default();
        let parent = commands.spawn();
        let child = commands.spawn();
        commands.insert(parent, Transform::default());
        commands.set_parent(child, Some(parent));
        commands.remove::<Light>(old);
        commands.add_tag(child, "new");
        assert_eq!(world.len(), 1);
        assert_eq!(commands.apply(&mut world), 0);
        let [parent, child] = [parent, child].map(|target| commands.entity(target).unwrap());
        assert_eq!(world.parent(child), Some(parent));
        assert!(world.has::<Transform>(parent));
        assert!(!world.has::<Light>(old));
        assert_eq!(world.tags().members("new"), [child]);

        commands.despawn(old);
        commands.despawn(old);
        commands.insert(old, Light::default());
        commands.set_parent(parent, Some(child));
        assert_eq!(commands.apply(&mut world), 3);
        assert_eq!(world.len(), 2);
        assert!(commands.is_empty());
    }

    #[test]
    fn targets_of_another_list_are_refused() {
        let mut world = World::new();
        let mut first = Commands::default();
        let mut target = first.spawn();
        for _ in 0..3 {
            target = first.spawn();
        }
        let mut second = Commands::default();
        second.spawn();
        second.insert(target, Light::default());
        assert_eq!(second.apply(&mut world), 1);
    }
}
