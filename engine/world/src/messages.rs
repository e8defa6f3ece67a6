//! Messages between entities.
//!
//! Components do not know each other; they leave messages. Senders write into
//! outboxes, one for each system or batch of rows, never one for each thread. A
//! delivery sorts everything by recipient and keeps, for one recipient, the order
//! of the outboxes and within them the order of sending. So what a recipient
//! reads does not depend on how many threads there were.

use crate::entity::Entity;
use crate::world::World;

/// Messages on their way, in the order of sending.
#[derive(Clone, Debug)]
pub struct Outbox<M> {
    messages: Vec<(Entity, M)>,
}

impl<M> Default for Outbox<M> {
    fn default() -> Self {
        Self {
            messages: Vec::new(),
        }
    }
}

impl<M> Outbox<M> {
    /// Leaves a message for an entity.
    pub fn send(&mut self, to: Entity, message: M) {
        self.messages.push((to, message));
    }
}

/// Outboxes and one inbox for each entity. All memory is reused from delivery to
/// delivery.
///
/// ```
/// # use lightbench_world::{Mailbox, World};
/// # let mut world = World::new();
/// # let lamp = world.spawn();
/// let mut mailbox = Mailbox::<f32>::default();
/// mailbox.outboxes(2)[1].send(lamp, 0.5);
/// mailbox.outboxes(2)[0].send(lamp, 0.25);
/// assert_eq!(mailbox.deliver(&world), 0);
/// assert_eq!(mailbox.received(lamp).collect::<Vec<_>>(), [&0.25, &0.5]);
/// ```
#[derive(Clone, Debug)]
pub struct Mailbox<M> {
    outboxes: Vec<Outbox<M>>,
    /// Delivered messages in the order of sending.
    delivered: Vec<(Entity, M)>,
    /// Positions in `delivered`, sorted by recipient.
    order: Vec<u32>,
    /// Where each slot's positions start in `order`; one more entry than slots.
    starts: Vec<u32>,
}

impl<M> Default for Mailbox<M> {
    fn default() -> Self {
        Self {
            outboxes: Vec::new(),
            delivered: Vec::new(),
            order: Vec::new(),
            starts: Vec::new(),
        }
    }
}

impl<M> Mailbox<M> {
    /// The first `count` outboxes. Give one to each batch, by the batch's number.
    pub fn outboxes(&mut self, count: usize) -> &mut [Outbox<M>] {
        if self.outboxes.len() < count {
            self.outboxes.resize_with(count, Outbox::default);
        }
        &mut self.outboxes[..count]
    }

    /// Replaces what was delivered before by what has been sent since. Messages
    /// to entities that do not exist (any more) are dropped; returns how many.
    pub fn deliver(&mut self, world: &World) -> usize {
        self.delivered.clear();
        let mut dropped = 0;
        let mut slots = 0;
        for outbox in &mut self.outboxes {
            for (to, message) in outbox.messages.drain(..) {
                if world.contains(to) {
                    slots = slots.max(to.index() as usize + 1);
                    self.delivered.push((to, message));
                } else {
                    dropped += 1;
                }
            }
        }
        self.sort(slots);
        dropped
    }

    /// A counting sort by slot. A slot has one living entity, so that the slot
    /// says who the recipient is.
    fn sort(&mut self, slots: usize) {
        self.starts.clear();
        self.starts.resize(slots + 1, 0);
        for (to, _) in &self.delivered {
            self.starts[to.index() as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        // From the last message to the first, each takes the last free place of
        // its slot. What is left in `starts` afterwards is where a slot starts.
        self.order.clear();
        self.order.resize(self.delivered.len(), 0);
        for (position, (to, _)) in self.delivered.iter().enumerate().rev() {
            let place = &mut self.starts[to.index() as usize];
            *place -= 1;
            self.order[*place as usize] = position as u32;
        }
    }

    /// The messages that an entity got with the last delivery.
    pub fn received(&self, entity: Entity) -> impl Iterator<Item = &M> + '_ {
        let slot = entity.index() as usize;
        let places = match (self.starts.get(slot), self.starts.get(slot + 1)) {
            (Some(&start), Some(&end)) => &self.order[start as usize..end as usize],
            _ => &[],
        };
        places
            .iter()
            .map(|&position| &self.delivered[position as usize])
            .filter(move |(to, _)| *to == entity)
            .map(|(_, message)| message)
    }

    /// All messages of the last delivery with their recipients, sorted by
    /// recipient.
    pub fn iter(&self) -> impl Iterator<Item = (Entity, &M)> + '_ {
        self.order.iter().map(|&position| {
            let (to, message) = &self.delivered[position as usize];
            (*to, message)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    #[test]
    fn order_does_not_depend_on_threads() {
        let mut world = World::new();
        let entities: Vec<_> = (0..1000).map(|_| world.spawn()).collect();
        let deliver = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let mut mailbox = Mailbox::<(usize, usize)>::default();
            let work = || {
                let batches = mailbox.outboxes(50).par_iter_mut().enumerate();
                batches.for_each(|(batch, outbox)| {
                    for i in 0..2000 {
                        outbox.send(entities[(batch * 131 + i * 17) % 1000], (batch, i));
                    }
                });
            };
            match pool {
                Ok(pool) => pool.install(work),
                Err(error) => panic!("no threads: {error}"),
            }
            assert_eq!(mailbox.deliver(&world), 0);
            let all: Vec<_> = mailbox.iter().map(|(to, message)| (to, *message)).collect();
            let each: Vec<_> = entities
                .iter()
                .flat_map(|&entity| mailbox.received(entity).map(move |m| (entity, *m)))
                .collect();
            assert_eq!(all, each);
            all
        };
        let expected = deliver(1);
        assert_eq!(expected.len(), 100_000);
        // Sorted by recipient, then by batch, then by the order of sending.
        assert!(expected.is_sorted_by_key(|(to, message)| (to.index(), *message)));
        for threads in [2, 3, 7] {
            assert_eq!(deliver(threads), expected);
        }
    }

    #[test]
    fn the_dead_get_nothing() {
        let mut world = World::new();
        let [old, other] = std::array::from_fn(|_| world.spawn());
        let mut mailbox = Mailbox::<u8>::default();
        mailbox.outboxes(1)[0].send(old, 1);
        mailbox.outboxes(1)[0].send(other, 2);
        world.despawn(old);
        let new = world.spawn();
        assert_eq!(mailbox.deliver(&world), 1);
        assert_eq!(mailbox.received(new).count(), 0);
        assert_eq!(mailbox.received(old).count(), 0);
        assert_eq!(mailbox.received(other).collect::<Vec<_>>(), [&2]);
        // Delivered once, read until the next delivery.
        mailbox.deliver(&world);
        assert_eq!(mailbox.received(other).count(), 0);
        assert_eq!(mailbox.received(Entity::NONE).count(), 0);
    }
}
