//! What a scene script works on.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::cache::Reuse;
use lightbench_assets::files::Files;
use lightbench_assets::{Assets, MaterialId, Mesh, MeshId, Progress, Shared};
use lightbench_world::glam::Vec3;
use lightbench_world::{Entity, Name, Stored, Transform, World};

use super::behaviours::{AtWork, Message, Starting};
use super::input::Input;
use super::materials::Material;
use super::models::Models;
use super::pipeline_choice::Chosen;
use super::plots::Plots;
use super::recipes::Recipes;
use super::shelf::Shelf;
use super::state::{KeptBehaviour, State};
use crate::api::{Mistake, ScriptType};
use crate::limits::{Limits, Watch};
use crate::log::Log;
use crate::parameters::SceneParameter;
use crate::settings::Settings;

impl ScriptType for Entity {
    const NAME: &'static str = "entity";
}

/// Everything that the functions of a scene script read and write.
pub(super) struct Data {
    pub(super) world: World,
    pub(super) assets: Assets,
    pub(super) files: Files,
    /// What earlier loads have made.
    pub(super) reuse: Reuse,
    pub(super) settings: Settings,
    pub(super) parameters: Vec<SceneParameter>,
    pub(super) limits: Limits,
    pub(super) watch: Arc<Watch>,
    pub(super) log: Log,
    pub(super) progress: Progress,
    /// How the assets were made.
    pub(super) recipes: Recipes,
    /// Which assets count beside those that are used.
    pub(super) shelf: Shelf,
    /// Models that were read.
    pub(super) models: Models,
    /// What happens outside.
    pub(super) input: Input,
    /// The pipeline that scripts have chosen.
    pub(super) chosen: Chosen,
    /// What the scene's own script remembers.
    pub(super) state: State,
    /// What behaviours kept before, for those that begin now.
    pub(super) kept: Vec<KeptBehaviour>,
    /// Messages that behaviours will be told.
    pub(super) messages: Vec<Message>,
    /// Whose function is being called.
    pub(super) at_work: AtWork,
    /// The behaviour whose file is being run.
    pub(super) starting: Option<Starting>,
    /// Points that entities stay turned to when they move.
    pub(super) aims: HashMap<Entity, Vec3>,
    /// The materials that scripts hold, so that one that is asked for again is the same.
    pub(super) materials: HashMap<MaterialId, Material>,
    /// The entities in the order in which they were made.
    pub(super) made: Vec<Entity>,
    /// Names that were looked up or given. The world alone would search all names each time.
    pub(super) names: HashMap<String, Entity>,
    pub(super) triangles: usize,
    /// What scripts have plotted.
    pub(super) plots: Plots,
}

/// The data, shared by all functions of one scene's engine.
#[derive(Clone)]
pub(super) struct Stage(Arc<Mutex<Data>>);

impl Stage {
    pub(super) fn new(
        files: &Files,
        reuse: &Reuse,
        settings: &Settings,
        limits: &Limits,
        watch: &Arc<Watch>,
        log: &Log,
        progress: &Progress,
    ) -> Self {
        Self(Arc::new(Mutex::new(Data {
            world: World::new(),
            assets: Assets::new(),
            files: files.clone(),
            reuse: reuse.clone(),
            settings: settings.clone(),
            parameters: Vec::new(),
            limits: limits.clone(),
            watch: Arc::clone(watch),
            log: log.clone(),
            progress: progress.clone(),
            recipes: Recipes::default(),
            shelf: Shelf::default(),
            models: Models::default(),
            input: Input::default(),
            chosen: Chosen::default(),
            state: State::default(),
            kept: Vec::new(),
            messages: Vec::new(),
            at_work: AtWork::default(),
            starting: None,
            aims: HashMap::new(),
            materials: HashMap::new(),
            made: Vec::new(),
            names: HashMap::new(),
            triangles: 0,
            plots: Plots::default(),
        })))
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, Data> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Data {
    /// Makes an entity with a place, and a name unless that is empty.
    pub(super) fn spawn(&mut self, name: &str) -> Result<Entity, Mistake> {
        if self.world.len() >= self.limits.entities {
            return Err(Mistake::new(format!(
                "the scene has {} entities, and may not have more",
                self.limits.entities
            )));
        }
        let entity = self.world.spawn();
        self.insert(entity, Transform::default())?;
        if !name.is_empty() {
            self.insert(entity, Name::new(name))?;
            self.note_name(entity, name);
        }
        // Scripts that make and remove entities all the time must not fill the list.
        if self.made.len() > 1024 + 2 * self.world.len() {
            self.forget_removed();
        }
        self.made.push(entity);
        Ok(entity)
    }

    /// All entities in the order in which they were made. Those that no script made come last.
    pub(super) fn all(&mut self) -> Vec<Entity> {
        self.forget_removed();
        if self.made.len() < self.world.len() {
            let known: HashSet<Entity> = self.made.iter().copied().collect();
            let others = self
                .world
                .entities()
                .filter(|entity| !known.contains(entity));
            self.made.extend(others);
        }
        self.made.clone()
    }

    /// The state of a behaviour that begins: empty, or with what it kept before.
    pub(super) fn take_kept(&mut self, entity: Entity, script: &str) -> State {
        let name = self.world.get::<Name>(entity);
        let is_its = |kept: &KeptBehaviour| {
            let named = name.as_ref().is_some_and(|name| name.text == kept.entity);
            named && kept.script == script
        };
        match self.kept.iter().position(is_its) {
            Some(at) => State::with(self.kept.remove(at).entries),
            None => State::default(),
        }
    }

    fn forget_removed(&mut self) {
        let world = &self.world;
        self.made.retain(|&entity| world.contains(entity));
    }

    /// Takes note of a name that an entity was given. As in the world, the first of a name is found.
    pub(super) fn note_name(&mut self, entity: Entity, name: &str) {
        if self.find(name).is_none() {
            self.names.insert(name.to_owned(), entity);
        }
    }

    /// The entity of that name.
    pub(super) fn find(&mut self, name: &str) -> Option<Entity> {
        if let Some(&entity) = self.names.get(name) {
            let names = self.world.columns::<Name>();
            let row = names.row_of(entity);
            if row.is_some_and(|row| names.text()[row] == name) {
                return Some(entity);
            }
            self.names.remove(name);
            let found = self.world.find(name)?;
            self.names.insert(name.to_owned(), found);
            return Some(found);
        }
        None
    }

    /// The name of an entity for a message.
    pub(super) fn called(&self, entity: Entity) -> String {
        let name: Option<Name> = self.world.get(entity);
        match name {
            Some(name) => format!("the entity `{}`", name.text),
            None => "the entity".to_owned(),
        }
    }

    /// Gives an entity a component.
    pub(super) fn insert<C: Stored>(&mut self, entity: Entity, row: C) -> Result<(), Mistake> {
        self.world
            .insert(entity, row)
            .map_err(|error| self.refused(entity, &error.to_string()))
    }

    fn refused(&self, entity: Entity, reason: &str) -> Mistake {
        if self.world.contains(entity) {
            Mistake::new(reason)
        } else {
            Mistake::new("the entity was removed and can't be used any more")
        }
    }

    /// Refuses the handle of a removed entity.
    pub(super) fn check(&self, entity: Entity) -> Result<(), Mistake> {
        if self.world.contains(entity) {
            Ok(())
        } else {
            Err(self.refused(entity, ""))
        }
    }

    /// A component of an entity, or the mistake of asking for it.
    pub(super) fn get<C: Stored>(&self, entity: Entity, what: &str) -> Result<C, Mistake> {
        self.check(entity)?;
        self.world
            .get(entity)
            .ok_or_else(|| Mistake::new(format!("{} is no {what}", self.called(entity))))
    }

    /// The place of an entity.
    pub(super) fn transform(&self, entity: Entity) -> Result<Transform, Mistake> {
        self.check(entity)?;
        Ok(self.world.get(entity).unwrap_or_default())
    }

    /// Changes the place of an entity. One that is turned to a point stays turned to it.
    pub(super) fn place(
        &mut self,
        entity: Entity,
        change: impl FnOnce(&mut Transform),
    ) -> Result<(), Mistake> {
        let mut transform = self.transform(entity)?;
        change(&mut transform);
        if let Some(&aim) = self.aims.get(&entity) {
            transform.rotation =
                Transform::looking_at(transform.translation, aim, Vec3::Y).rotation;
        }
        self.insert(entity, transform)
    }

    /// Adds a mesh, if the scene may have as many triangles.
    pub(super) fn add_mesh(&mut self, mesh: Shared<Mesh>) -> Result<MeshId, Mistake> {
        self.count_triangles(mesh.triangle_count())?;
        Ok(self.assets.add_shared_mesh(mesh))
    }

    pub(super) fn count_triangles(&mut self, count: usize) -> Result<(), Mistake> {
        self.triangles += count;
        if self.triangles > self.limits.triangles {
            return Err(Mistake::new(format!(
                "the meshes of the scene have more than {} triangles together",
                self.limits.triangles
            )));
        }
        Ok(())
    }
}
