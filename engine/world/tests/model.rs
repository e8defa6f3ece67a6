//! The store against a model that cannot be wrong: a `HashMap` of rows.
//!
//! 200,000 random operations with a fresh seed by default, 10⁷ with
//! `LIGHTBENCH_SOAK=1`. A failure prints its seed; `LIGHTBENCH_SEED` repeats it.
#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet, HashMap};

use glam::Vec3;
use lightbench_world::{
    Entity, Light, MeshRenderer, Name, Stored, Tick, Transform, World, WorldBounds, WorldError,
    WorldMatrix,
};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// What an entity should have.
#[derive(Clone, Debug, Default, PartialEq)]
struct Model {
    transform: Option<Transform>,
    light: Option<Light>,
    name: Option<Name>,
    renderer: bool,
    parent: Option<Entity>,
    children: Vec<Entity>,
    tags: BTreeSet<&'static str>,
}

struct Pair {
    world: World,
    model: HashMap<Entity, Model>,
    /// Every handle that was ever given out, dead ones included.
    handles: Vec<Entity>,
    random: Pcg64,
    /// Lights written since the observation, by entity.
    seen: Tick,
    written: BTreeSet<Entity>,
}

const TAGS: [&str; 3] = ["lamp", "red", "east"];

impl Pair {
    fn new(seed: u64) -> Self {
        let world = World::new();
        Self {
            seen: world.observe(),
            world,
            model: HashMap::new(),
            handles: Vec::new(),
            random: Pcg64::seed_from_u64(seed),
            written: BTreeSet::new(),
        }
    }

    /// Any handle, more often a late one, often a stale one.
    fn handle(&mut self) -> Entity {
        let count = self.handles.len();
        match self.random.random_range(0..20) {
            0 => Entity::NONE,
            1 => Entity::from_bits(self.random.random()),
            2..10 if count > 0 => self.handles[self.random.random_range(0..count)],
            _ if count > 0 => {
                let first = count.saturating_sub(2_000);
                self.handles[self.random.random_range(first..count)]
            }
            _ => Entity::NONE,
        }
    }

    fn transform(&mut self) -> Transform {
        Transform::from_translation(Vec3::splat(self.random.random()))
    }

    fn light(&mut self) -> Light {
        Light {
            intensity: self.random.random(),
            ..Light::default()
        }
    }

    /// The model's entity and all below it, as the store removes them.
    fn remove_from_model(&mut self, entity: Entity) -> usize {
        let Some(gone) = self.model.remove(&entity) else {
            return 0;
        };
        if let Some(parent) = gone.parent.and_then(|parent| self.model.get_mut(&parent)) {
            parent.children.retain(|&child| child != entity);
        }
        let below: usize = gone
            .children
            .iter()
            .map(|&child| self.remove_from_model(child))
            .sum();
        1 + below
    }

    fn is_below(&self, entity: Entity, ancestor: Entity) -> bool {
        let mut current = Some(entity);
        while let Some(entity) = current {
            if entity == ancestor {
                return true;
            }
            current = self.model[&entity].parent;
        }
        false
    }

    fn step(&mut self) {
        let entity = self.handle();
        let alive = self.model.contains_key(&entity);
        assert_eq!(self.world.contains(entity), alive);
        match self.random.random_range(0..100) {
            0..16 => {
                let new = self.world.spawn();
                assert!(self.model.insert(new, Model::default()).is_none());
                self.handles.push(new);
            }
            16..18 => {
                let rows: Vec<_> = (0..self.random.random_range(0..200))
                    .map(|_| (self.transform(), MeshRenderer::default(), self.light()))
                    .collect();
                let spawned = self.world.spawn_batch(rows.iter().copied()).to_vec();
                assert_eq!(spawned.len(), rows.len());
                for (new, (transform, _, light)) in spawned.into_iter().zip(rows) {
                    let model = Model {
                        transform: Some(transform),
                        light: Some(light),
                        renderer: true,
                        ..Model::default()
                    };
                    assert!(self.model.insert(new, model).is_none());
                    self.handles.push(new);
                    self.written.insert(new);
                }
            }
            18..32 => {
                assert_eq!(self.world.despawn(entity), alive);
                self.remove_from_model(entity);
            }
            32..34 => {
                let batch: Vec<_> = (0..self.random.random_range(0..150))
                    .map(|_| self.handle())
                    .collect();
                let removed = self.world.despawn_batch(&batch);
                let expected: usize = batch.iter().map(|&e| self.remove_from_model(e)).sum();
                assert_eq!(removed, expected);
            }
            34..48 => {
                let row = self.transform();
                let result = self.world.insert(entity, row);
                self.refused_if_stale(entity, result);
                if let Some(model) = self.model.get_mut(&entity) {
                    model.transform = Some(row);
                }
            }
            48..56 => {
                let row = self.light();
                let result = self.world.insert(entity, row);
                self.refused_if_stale(entity, result);
                if let Some(model) = self.model.get_mut(&entity) {
                    model.light = Some(row);
                    self.written.insert(entity);
                }
            }
            56..60 => {
                let row = Name::new(self.random.random::<u16>().to_string());
                let result = self.world.insert(entity, row.clone());
                self.refused_if_stale(entity, result);
                if let Some(model) = self.model.get_mut(&entity) {
                    model.name = Some(row);
                }
            }
            60..64 => {
                let result = self.world.insert(entity, MeshRenderer::default());
                self.refused_if_stale(entity, result);
                if let Some(model) = self.model.get_mut(&entity) {
                    model.renderer = true;
                }
            }
            64..70 => {
                let expected = self.model.get_mut(&entity).and_then(|m| m.transform.take());
                assert_eq!(self.world.remove::<Transform>(entity), expected);
            }
            70..74 => {
                let expected = self.model.get_mut(&entity).and_then(|m| m.name.take());
                assert_eq!(self.world.remove::<Name>(entity), expected);
            }
            74..77 => {
                let expected = self.model.get_mut(&entity).and_then(|m| m.light.take());
                assert_eq!(self.world.remove::<Light>(entity), expected);
            }
            77..80 => {
                let model = self.model.get_mut(&entity);
                let had = model.is_some_and(|m| std::mem::take(&mut m.renderer));
                assert_eq!(self.world.remove::<MeshRenderer>(entity).is_some(), had);
            }
            80..90 => self.set_parent(entity),
            90..94 => {
                let tag = TAGS[self.random.random_range(0..TAGS.len())];
                let result = self.world.add_tag(entity, tag);
                self.refused_if_stale(entity, result);
                if let Some(model) = self.model.get_mut(&entity) {
                    model.tags.insert(tag);
                }
            }
            94..96 => {
                let tag = TAGS[self.random.random_range(0..TAGS.len())];
                let model = self.model.get_mut(&entity);
                let had = model.is_some_and(|m| m.tags.remove(tag));
                assert_eq!(self.world.remove_tag(entity, tag), had);
            }
            _ => {
                let row = self.light();
                let has = self.model.get(&entity).is_some_and(|m| m.light.is_some());
                assert_eq!(self.world.set(entity, row).is_ok(), has);
                if has && let Some(model) = self.model.get_mut(&entity) {
                    model.light = Some(row);
                    self.written.insert(entity);
                }
            }
        }
        self.compare(entity);
    }

    fn refused_if_stale(&self, entity: Entity, result: Result<(), WorldError>) {
        match self.model.contains_key(&entity) {
            true => assert_eq!(result, Ok(())),
            false => assert_eq!(result, Err(WorldError::Stale(entity))),
        }
    }

    fn set_parent(&mut self, child: Entity) {
        let parent = match self.random.random_range(0..4) {
            0 => None,
            _ => Some(self.handle()),
        };
        let result = self.world.set_parent(child, parent);
        let all_alive = [Some(child), parent]
            .into_iter()
            .flatten()
            .all(|entity| self.model.contains_key(&entity));
        if !all_alive {
            assert!(matches!(result, Err(WorldError::Stale(_))));
        } else if let Some(parent) = parent.filter(|&parent| self.is_below(parent, child)) {
            assert_eq!(result, Err(WorldError::Cycle { child, parent }));
        } else {
            assert_eq!(result, Ok(()));
            let old = self.model[&child].parent;
            if old != parent {
                if let Some(old) = old.and_then(|old| self.model.get_mut(&old)) {
                    old.children.retain(|&other| other != child);
                }
                if let Some(new) = parent.and_then(|parent| self.model.get_mut(&parent)) {
                    new.children.push(child);
                }
                self.model.get_mut(&child).unwrap().parent = parent;
            }
        }
    }

    /// One entity, seen through the world.
    fn compare(&self, entity: Entity) {
        let model = self.model.get(&entity).cloned().unwrap_or_default();
        let world = &self.world;
        assert_eq!(world.get::<Transform>(entity), model.transform);
        assert_eq!(world.has::<WorldMatrix>(entity), model.transform.is_some());
        assert_eq!(world.get::<Light>(entity), model.light);
        assert_eq!(world.get::<Name>(entity), model.name);
        assert_eq!(world.has::<MeshRenderer>(entity), model.renderer);
        assert_eq!(world.has::<WorldBounds>(entity), model.renderer);
        assert_eq!(world.parent(entity), model.parent);
        assert!(world.children(entity).eq(model.children.iter().copied()));
        assert!(
            world.tags().of(entity).eq(["east", "lamp", "red"]
                .into_iter()
                .filter(|tag| model.tags.contains(tag)))
        );
    }

    /// The columns themselves: as long as they should be, and each row's entity
    /// alive and pointing back.
    fn check_columns<C: Stored>(&self, has: impl Fn(&Model) -> bool) {
        let columns = self.world.columns::<C>();
        let expected = self.model.values().filter(|model| has(model)).count();
        assert_eq!(columns.len(), expected, "{}", C::INFO.name);
        for (row, &entity) in columns.entities().iter().enumerate() {
            assert!(self.world.contains(entity));
            assert_eq!(columns.row_of(entity), Some(row));
        }
    }

    fn check_all(&mut self) {
        assert_eq!(self.world.len(), self.model.len());
        let entities: BTreeSet<_> = self.world.entities().collect();
        let expected: BTreeSet<_> = self.model.keys().copied().collect();
        assert_eq!(entities, expected);
        self.check_columns::<Transform>(|model| model.transform.is_some());
        self.check_columns::<WorldMatrix>(|model| model.transform.is_some());
        self.check_columns::<Light>(|model| model.light.is_some());
        self.check_columns::<Name>(|model| model.name.is_some());
        self.check_columns::<MeshRenderer>(|model| model.renderer);
        assert_eq!(
            self.world.columns::<MeshRenderer>().entities(),
            self.world.columns::<WorldBounds>().entities()
        );
        let mut tagged = BTreeMap::new();
        for (&entity, model) in &self.model {
            for &tag in &model.tags {
                tagged
                    .entry(tag)
                    .or_insert_with(BTreeSet::new)
                    .insert(entity);
            }
        }
        for tag in TAGS {
            let members: BTreeSet<_> = self.world.tags().members(tag).iter().copied().collect();
            assert_eq!(members, tagged.remove(tag).unwrap_or_default());
        }
        for &entity in &self.handles {
            self.compare(entity);
        }
        // Whatever was written is reported, and so may be rows that moved.
        let lights = self.world.columns::<Light>();
        let changed: BTreeSet<_> = lights
            .changed_since(self.seen)
            .map(|row| lights.entities()[row])
            .collect();
        for &entity in &self.written {
            assert!(!self.world.has::<Light>(entity) || changed.contains(&entity));
        }
        self.seen = self.world.observe();
        self.written.clear();
    }
}

#[test]
fn random_operations_agree_with_a_map() {
    let seed = match std::env::var("LIGHTBENCH_SEED") {
        Ok(seed) => seed.parse().unwrap(),
        Err(_) => rand::random(),
    };
    let steps = match std::env::var("LIGHTBENCH_SOAK") {
        Ok(_) => 10_000_000,
        Err(_) => 200_000,
    };
    println!("LIGHTBENCH_SEED={seed}");
    let mut pair = Pair::new(seed);
    for step in 0..steps {
        pair.step();
        if step % (steps / 20) == 0 {
            pair.check_all();
            // Handles that nobody could still hold need not be checked for ever.
            let surplus = pair.handles.len().saturating_sub(50_000);
            pair.handles.drain(..surplus);
        }
    }
    pair.check_all();
}
