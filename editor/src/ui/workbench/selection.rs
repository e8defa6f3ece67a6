//! Which entities are chosen.

use lightbench::script::Scene;
use lightbench::world::{Entity, Name};

/// One chosen entity. After a load it is found again by its name.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Chosen {
    entity: Entity,
    name: String,
}

/// The chosen entities, in the order in which they were chosen.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    chosen: Vec<Chosen>,
    swaps: u64,
}

impl Selection {
    /// The entities.
    pub fn entities(&self) -> impl DoubleEndedIterator<Item = Entity> + ExactSizeIterator {
        self.chosen.iter().map(|chosen| chosen.entity)
    }

    /// The one that was chosen last: its fields are shown.
    pub fn last(&self) -> Option<Entity> {
        self.chosen.last().map(|chosen| chosen.entity)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.chosen.is_empty()
    }

    /// Whether an entity is chosen.
    pub fn contains(&self, entity: Entity) -> bool {
        self.chosen.iter().any(|chosen| chosen.entity == entity)
    }

    /// Chooses none.
    pub fn clear(&mut self) {
        self.chosen.clear();
    }

    /// Chooses these alone.
    pub fn set(&mut self, scene: &Scene, entities: impl IntoIterator<Item = Entity>) {
        self.clear();
        self.add(scene, entities);
    }

    /// Chooses these too. One that is chosen already becomes the last.
    pub fn add(&mut self, scene: &Scene, entities: impl IntoIterator<Item = Entity>) {
        for entity in entities {
            self.chosen.retain(|chosen| chosen.entity != entity);
            let name: Option<Name> = scene.world.get(entity);
            self.chosen.push(Chosen {
                entity,
                name: name.map_or_else(String::new, |name| name.text),
            });
        }
    }

    /// Chooses an entity too, or no longer.
    pub fn toggle(&mut self, scene: &Scene, entity: Entity) {
        if self.contains(entity) {
            self.chosen.retain(|chosen| chosen.entity != entity);
        } else {
            self.add(scene, [entity]);
        }
    }

    /// Takes note of names that may have changed, and forgets what is gone.
    pub fn names_changed(&mut self, scene: &Scene) {
        let names = scene.world.columns::<Name>();
        self.chosen
            .retain(|chosen| scene.world.contains(chosen.entity));
        for chosen in &mut self.chosen {
            let row = names.row_of(chosen.entity);
            chosen.name = row.map_or_else(String::new, |row| names.text()[row].clone());
        }
    }

    /// Finds the entities again in a scene that may have been loaded anew; `swaps` counts loads.
    pub fn refresh(&mut self, scene: &Scene, swaps: u64) {
        if self.swaps != swaps {
            self.swaps = swaps;
            for chosen in &mut self.chosen {
                chosen.entity = scene.world.find(&chosen.name).unwrap_or(Entity::NONE);
            }
        }
        self.chosen
            .retain(|chosen| scene.world.contains(chosen.entity));
    }
}
