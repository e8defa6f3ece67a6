//! Entities: generational handles and the slots behind them.

use std::fmt;

/// A handle to one entity of one world.
///
/// The index names a slot and the generation says which tenant of that slot is
/// meant. A slot's generation changes whenever an entity is created or removed
/// there, so a handle to a removed entity never resolves to a later one.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Entity {
    index: u32,
    generation: u32,
}

impl Entity {
    /// A handle that no world ever contains.
    pub const NONE: Self = Self {
        index: u32::MAX,
        generation: 0,
    };

    /// The slot that the handle names.
    pub fn index(self) -> u32 {
        self.index
    }

    /// The tenant of the slot that the handle means. Odd for every handle that
    /// a world has given out.
    pub fn generation(self) -> u32 {
        self.generation
    }

    /// The handle as one number, for languages and files that hold no structs.
    pub fn to_bits(self) -> u64 {
        u64::from(self.generation) << 32 | u64::from(self.index)
    }

    /// The inverse of [`Entity::to_bits`]. Any number gives a handle; one that
    /// no world has given out is refused like a stale one.
    pub fn from_bits(bits: u64) -> Self {
        Self {
            index: bits as u32,
            generation: (bits >> 32) as u32,
        }
    }
}

impl Default for Entity {
    fn default() -> Self {
        Self::NONE
    }
}

impl fmt::Display for Entity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE {
            write!(f, "#none")
        } else {
            write!(f, "#{}.{}", self.index, self.generation)
        }
    }
}

impl fmt::Debug for Entity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// One slot: whose turn it is, and which components its tenant has.
#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    /// Odd while the slot is taken, even while it is free.
    generation: u32,
    /// One bit for each component type, so that a removal visits only those
    /// columns that hold a row.
    components: u32,
}

/// Gives out handles and knows which of them are alive.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entities {
    slots: Vec<Slot>,
    free: Vec<u32>,
    /// Slots whose generations are used up. They are never given out again.
    retired: usize,
}

impl Entities {
    /// Number of living entities.
    pub fn len(&self) -> usize {
        self.slots.len() - self.free.len() - self.retired
    }

    /// Number of slots, taken or not.
    pub fn slots(&self) -> usize {
        self.slots.len()
    }

    pub fn reserve(&mut self, additional: usize) {
        self.slots
            .reserve(additional.saturating_sub(self.free.len()));
    }

    pub fn shrink_to_fit(&mut self) {
        self.slots.shrink_to_fit();
        self.free.shrink_to_fit();
    }

    pub fn capacity_bytes(&self) -> usize {
        self.slots.capacity() * size_of::<Slot>() + self.free.capacity() * size_of::<u32>()
    }

    pub fn spawn(&mut self) -> Entity {
        self.spawn_with(0)
    }

    /// Takes a slot for an entity with these components.
    #[inline]
    pub fn spawn_with(&mut self, components: u32) -> Entity {
        let index = match self.free.pop() {
            Some(index) => index,
            None => {
                self.slots.push(Slot::default());
                (self.slots.len() - 1) as u32
            }
        };
        let slot = &mut self.slots[index as usize];
        slot.generation += 1;
        slot.components = components;
        Entity {
            index,
            generation: slot.generation,
        }
    }

    /// Frees the slot and returns the component bits of its tenant, or `None`
    /// for a stale handle.
    pub fn despawn(&mut self, entity: Entity) -> Option<u32> {
        if !self.contains(entity) {
            return None;
        }
        let slot = &mut self.slots[entity.index as usize];
        let components = std::mem::take(&mut slot.components);
        match slot.generation.checked_add(1) {
            Some(generation) => {
                slot.generation = generation;
                self.free.push(entity.index);
            }
            // The last generation is odd, and zero is even: the slot reads as
            // free, but it is not on the list and stays empty for good.
            None => {
                slot.generation = 0;
                self.retired += 1;
            }
        }
        Some(components)
    }

    /// Gives a removed entity its slot again. False if the slot has had another tenant since.
    pub fn revive(&mut self, entity: Entity) -> bool {
        let Some(slot) = self.slots.get_mut(entity.index as usize) else {
            return false;
        };
        // A slot that is retired reads zero and is not on the list.
        let is_next =
            entity.generation % 2 == 1 && entity.generation.checked_add(1) == Some(slot.generation);
        let place = self.free.iter().rposition(|&index| index == entity.index);
        let Some(place) = place.filter(|_| is_next) else {
            return false;
        };
        self.free.remove(place);
        slot.generation = entity.generation;
        slot.components = 0;
        true
    }

    /// Makes a slot that an entity has just been removed from as it was before it came: the next one
    /// there gets its handle.
    pub fn forget(&mut self, entity: Entity) {
        if let Some(slot) = self.slots.get_mut(entity.index as usize)
            && entity.generation % 2 == 1
            && slot.generation.checked_sub(1) == Some(entity.generation)
        {
            slot.generation = entity.generation - 1;
        }
    }

    pub fn contains(&self, entity: Entity) -> bool {
        entity.generation % 2 == 1
            && self
                .slots
                .get(entity.index as usize)
                .is_some_and(|slot| slot.generation == entity.generation)
    }

    /// Component bits of a living entity; none for a stale handle.
    pub fn components(&self, entity: Entity) -> u32 {
        if self.contains(entity) {
            self.slots[entity.index as usize].components
        } else {
            0
        }
    }

    /// Component bits of a living entity, to change them.
    pub fn components_mut(&mut self, entity: Entity) -> Option<&mut u32> {
        self.slots
            .get_mut(entity.index as usize)
            .filter(|slot| slot.generation == entity.generation && entity.generation % 2 == 1)
            .map(|slot| &mut slot.components)
    }

    /// All living entities in the order of their slots.
    pub fn iter(&self) -> impl Iterator<Item = Entity> + '_ {
        self.slots
            .iter()
            .enumerate()
            .filter(|(_, slot)| slot.generation % 2 == 1)
            .map(|(index, slot)| Entity {
                index: index as u32,
                generation: slot.generation,
            })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_reused_slot_refuses_the_old_handle() {
        let mut entities = Entities::default();
        let first = entities.spawn();
        assert!(entities.despawn(first).is_some());
        let second = entities.spawn();
        assert_eq!(first.index(), second.index());
        assert_ne!(first, second);
        assert!(!entities.contains(first));
        assert!(entities.contains(second));
        assert!(entities.despawn(first).is_none());
        assert_eq!(entities.len(), 1);
    }

    #[test]
    fn made_up_handles_are_refused() {
        let mut entities = Entities::default();
        let entity = entities.spawn();
        entities.despawn(entity);
        // Exactly the generation that the free slot holds.
        let forged = Entity {
            index: 0,
            generation: 2,
        };
        assert!(!entities.contains(forged));
        assert!(entities.components_mut(forged).is_none());
        assert!(!entities.contains(Entity::NONE));
    }

    #[test]
    fn a_slot_without_generations_left_is_retired() {
        let mut entities = Entities::default();
        entities.spawn();
        entities.slots[0].generation = u32::MAX;
        let last = Entity {
            index: 0,
            generation: u32::MAX,
        };
        assert!(entities.despawn(last).is_some());
        assert_eq!(entities.len(), 0);
        assert_eq!(entities.spawn().index(), 1);
        assert!(!entities.contains(last));
    }

    #[test]
    fn only_the_last_tenant_of_a_slot_comes_back() {
        let mut entities = Entities::default();
        let [first, other] = [entities.spawn(), entities.spawn()];
        assert!(!entities.revive(first), "it is there");
        entities.despawn(first);
        entities.despawn(other);
        // Whoever came and was forgotten leaves no trace.
        let guest = entities.spawn();
        assert_eq!(guest.index(), other.index());
        entities.despawn(guest);
        entities.forget(guest);
        assert!(!entities.contains(guest));
        assert_eq!(entities.spawn(), guest);
        entities.forget(guest);
        assert!(entities.contains(guest), "one that is there stays");
        entities.despawn(guest);
        entities.forget(guest);
        assert!(entities.revive(other));
        entities.despawn(other);
        assert!(entities.revive(first));
        assert!(entities.contains(first) && !entities.revive(first));
        assert_eq!(entities.spawn().index(), other.index());
        assert!(!entities.revive(other));
        assert!(!entities.revive(Entity::NONE));
        assert_eq!(entities.len(), 2);
    }

    #[test]
    fn bits_round_trip() {
        let mut entities = Entities::default();
        entities.spawn();
        let entity = entities.spawn();
        assert_eq!(Entity::from_bits(entity.to_bits()), entity);
        assert_eq!(entity.to_string(), "#1.1");
    }
}
