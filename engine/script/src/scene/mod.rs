//! Scene files: `scripts/scenes/*.rhai` build worlds and move them, `*.scene` hold them.

mod behaviours;
mod bounds;
mod cameras;
mod columns;
pub mod console;
mod curves;
mod data;
mod entities;
mod faces;
mod fields;
mod handlers;
mod input;
mod lights;
mod list;
mod load;
mod materials;
mod models;
mod motion;
pub mod overlays;
mod picking;
mod pipeline_choice;
pub mod plots;
mod recipes;
mod reflection;
mod saved;
mod script;
mod selection;
mod shapes;
mod shelf;
mod snapshot;
mod state;
mod tables;
mod tags;
mod textures;
mod values;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::files::Files;
use lightbench_assets::{Assets, Progress};
use lightbench_render::{Place, Problem, Problems};
use lightbench_world::systems::{FrameSystems, update_computed};
use lightbench_world::{Behaviour, Camera, Entity, RigidAnimation, SystemTime, Velocity, World};
use rhai::Scope;

use crate::host::Host;
use crate::log::LogLine;
use crate::names::Names;
use crate::parameters::{SceneParameter, undeclared};
use crate::settings::SettingValue;
use behaviours::{Behaviours, Message};
use data::Stage;
use handlers::Event;
use overlays::LastListing;
use script::OwnScript;

pub use behaviours::{BEHAVIOURS, BehaviourInfo};
pub use input::SceneEvent;
pub use list::{SceneEntry, list_scenes};
pub use load::{load_scene, load_scene_again, load_scene_within, scene_names};
pub use picking::{Hit, Ray};
pub use pipeline_choice::PipelineChoice;
pub use saved::EXTENSION as SCENE_EXTENSION;
pub use snapshot::SceneSnapshot;
pub use state::KeptState;
pub(crate) use values::expected as field_takes;

/// The folder of the scene files.
pub const SCENES: &str = "scripts/scenes";

/// A world that a script made, and the script that moves it.
pub struct Scene {
    /// The entities.
    pub world: World,
    /// Their meshes, materials and textures.
    pub assets: Assets,
    /// What can be set from outside.
    pub parameters: Vec<SceneParameter>,
    /// The script's path.
    pub path: String,
    host: Host,
    stage: Stage,
    read: Read,
    /// The functions of the scene's own script.
    script: OwnScript,
    behaviours: Behaviours,
    /// What moves and computes beside the script.
    systems: FrameSystems,
    /// What the script took in the last step.
    script_time: Option<SystemTime>,
    /// Variables that lines of a console have declared.
    console: Scope<'static>,
    /// The camera that was made because the script made none.
    pub(crate) default_camera: Option<Entity>,
    last_listing: LastListing,
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Scene")
            .field("path", &self.path)
            .field("entities", &self.world.len())
            .field("parameters", &self.parameters)
            .finish_non_exhaustive()
    }
}

impl Scene {
    fn new(path: String, host: Host, stage: Stage, script: OwnScript) -> Self {
        let at_work = stage.lock().at_work.clone();
        Self {
            world: World::new(),
            assets: Assets::new(),
            parameters: Vec::new(),
            path,
            host,
            stage,
            read: Read::default(),
            script,
            behaviours: Behaviours::new(at_work),
            systems: FrameSystems::default(),
            script_time: None,
            console: Scope::new(),
            default_camera: None,
            last_listing: LastListing::default(),
        }
    }

    /// Takes over what the script made, and checks that everything that was set has been used.
    fn finish(&mut self) -> Result<(), Problems> {
        let mut data = self.stage.lock();
        let has_camera = !data.world.columns::<Camera>().is_empty();
        if !has_camera {
            let added = cameras::add_default(&mut data);
            self.default_camera = Some(added.map_err(|mistake| {
                Problem::new(Place::file(self.path.as_str()), mistake.message)
            })?);
        }
        let problems = undeclared("scene", &self.path, &data.parameters, &data.settings);
        if !problems.is_empty() {
            return Err(Problems(problems));
        }
        self.host.watch.loaded();
        data.reuse.finish();
        data.progress = Progress::new();
        self.parameters = data.parameters.clone();
        std::mem::swap(&mut self.world, &mut data.world);
        std::mem::swap(&mut self.assets, &mut data.assets);
        drop(data);
        // Listed from the start, and not called yet.
        self.script_time = self
            .script
            .runs()
            .then(|| SystemTime::of("script", || ()).0);
        Ok(())
    }

    /// Brings the scene to the next moment: tells the scripts what happened, calls the scene's
    /// `update(time, dt)` and those of its behaviours, where they have one, delivers messages, and runs
    /// all systems of the world. `dt` is the step that ends at `time`, in seconds;
    /// the same steps give the same scene, however long they take.
    ///
    /// # Errors
    /// What went wrong in a script, once: after an error that script is not called again, what it had
    /// changed stays, and all others and the systems go on. Where several went wrong, the next steps
    /// tell of the others.
    pub fn update(&mut self, time: f64, dt: f64) -> Result<(), Problem> {
        self.stage.lock().plots.set_time(time);
        let (took, result) = SystemTime::of("script", || {
            self.swap();
            let result = self.run_scripts(time, dt);
            self.swap();
            result
        });
        let scripted = self.script.runs() || !self.behaviours.is_empty();
        self.script_time = scripted.then_some(took);
        self.run_systems(time, dt);
        result?;
        self.behaviours.take_problem().map_or(Ok(()), Err)
    }

    /// Tells the scene's script and the behaviours what happened, updates them, and delivers messages.
    fn run_scripts(&mut self, time: f64, dt: f64) -> Result<(), Problem> {
        let happened: Vec<Event> = {
            let mut data = self.stage.lock();
            let happened = data.input.take().into_iter();
            happened.filter_map(|event| event.in_scene(&data)).collect()
        };
        let (host, stage, path) = (&mut self.host, &self.stage, &self.path);
        let mut result = Ok(());
        for event in &happened {
            result = result.and(self.script.call(host, path, event));
        }
        result = result.and(self.script.call(host, path, &Event::Update { time, dt }));
        self.behaviours.step(host, stage, &happened, time, dt);
        // What is sent while messages are delivered goes with the next step, so that two scripts that
        // answer each other do not hold it up.
        let messages = std::mem::take(&mut stage.lock().messages);
        for Message { to, name, value } in messages {
            let event = Event::Message(name, value);
            if to.is_none() {
                result = result.and(self.script.call(host, path, &event));
            }
            self.behaviours.deliver(host, stage, to, &event);
        }
        result
    }

    /// Starts the behaviours of a scene that was made.
    fn start_behaviours(&mut self) -> Result<(), Problems> {
        self.swap();
        self.behaviours.start_and_end(&mut self.host, &self.stage);
        self.swap();
        match self.behaviours.take_problem() {
            Some(problem) => Err(problem.into()),
            None => Ok(()),
        }
    }

    /// Tells the scene what happens outside; scripts hear of it in the next step.
    pub fn happen(&mut self, event: SceneEvent) {
        self.stage.lock().input.happen(event);
    }

    /// Whether its scripts hear keys: by a function `on_key`, or by asking which are down.
    #[must_use]
    pub fn hears_keys(&self) -> bool {
        self.script.hears_keys() || self.behaviours.hear_keys() || self.stage.lock().input.was_asked
    }

    /// The pipeline that its scripts have chosen since the last call.
    pub fn take_pipeline_choice(&mut self) -> Option<PipelineChoice> {
        self.stage.lock().chosen.new.take()
    }

    /// The behaviours of its entities, in the order in which they began.
    #[must_use]
    pub fn behaviours(&self) -> Vec<BehaviourInfo> {
        self.behaviours.list()
    }

    /// What its scripts keep for when it is loaded again, for [`load_scene_again`].
    #[must_use]
    pub fn kept(&self) -> KeptState {
        KeptState {
            scene: self.stage.lock().state.kept(),
            behaviours: self.behaviours.kept(&self.world),
        }
    }

    /// Sets a parameter of an entity's behaviour, which begins anew with the next step.
    ///
    /// # Errors
    /// A sentence, where there is no such behaviour or parameter, or the value does not fit.
    pub fn set_behaviour(
        &mut self,
        entity: Entity,
        name: &str,
        value: &SettingValue,
    ) -> Result<(), String> {
        self.swap();
        let done = self
            .behaviours
            .set_parameter(&mut self.stage.lock(), entity, name, value);
        self.swap();
        done
    }

    fn run_systems(&mut self, time: f64, dt: f64) {
        let meshes = self.assets.mesh_bounds();
        self.systems.run(&mut self.world, meshes, time, dt as f32);
    }

    /// The first visible triangle that a ray meets, whichever side it shows. Places are those of the
    /// last step.
    pub fn pick(&self, ray: Ray) -> Option<Hit> {
        self.pick_among(ray, |_| true)
    }

    /// The same among entities for which a question is answered with yes; the others are seen through.
    pub fn pick_among(&self, ray: Ray, counts: impl Fn(Entity) -> bool) -> Option<Hit> {
        picking::pick(&self.world, &self.assets, ray, counts)
    }

    /// Brings what the systems compute up to date with changes from outside, without letting time
    /// pass.
    pub fn refresh(&mut self) {
        update_computed(&mut self.world, self.assets.mesh_bounds());
    }

    /// What the script and each system took in the last step.
    pub fn system_times(&self) -> impl Iterator<Item = SystemTime> + '_ {
        self.script_time.iter().cloned().chain(self.systems.times())
    }

    /// Lends the world to the script's functions, and takes it back.
    fn swap(&mut self) {
        let mut data = self.stage.lock();
        std::mem::swap(&mut self.world, &mut data.world);
        std::mem::swap(&mut self.assets, &mut data.assets);
    }

    /// Whether the script moves the scene.
    #[must_use]
    pub fn has_update(&self) -> bool {
        self.script.runs()
    }

    /// Whether anything changes as time passes: by the script, or by a component.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.has_update()
            || !self.world.columns::<Behaviour>().is_empty()
            || !self.world.columns::<Velocity>().is_empty()
            || !self.world.columns::<RigidAnimation>().is_empty()
    }

    /// The camera that the view is drawn from: the first active one.
    #[must_use]
    pub fn camera(&self) -> Option<Entity> {
        let cameras = self.world.columns::<Camera>();
        let active = cameras.slices().active.iter().position(|active| *active);
        active.map(|row| cameras.entities()[row])
    }

    /// Lets in the folders that files of the program have let in since the scene was loaded: see
    /// [`Files::grant`].
    pub fn let_in(&mut self, folders: &[PathBuf]) {
        self.stage.lock().files.grant_again(folders);
    }

    /// Every file that the scene came from: scripts, models with the files that they name, and
    /// pictures. When one changes, the scene is to be loaded again.
    #[must_use]
    pub fn files(&self) -> Vec<String> {
        self.read.list()
    }

    /// Takes out what the script has printed since the last call, with warnings of its models.
    pub fn take_log(&mut self) -> Vec<LogLine> {
        self.host.log.take()
    }

    /// The names that the script can call.
    #[must_use]
    pub fn names(&self) -> &Names {
        &self.host.compiler.names
    }
}

/// The files that a scene has read.
#[derive(Clone, Default)]
struct Read(Arc<Mutex<BTreeSet<String>>>);

impl Read {
    /// A store whose reads are noted.
    fn watch(&self, files: &Files) -> Files {
        let noted = self.clone();
        files.observed(move |path, _| {
            noted.lock().insert(path.to_owned());
        })
    }

    fn list(&self) -> Vec<String> {
        self.lock().iter().cloned().collect()
    }

    fn lock(&self) -> MutexGuard<'_, BTreeSet<String>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A scene is made on one thread and used on another.
const _: fn() = || {
    fn assert_send<T: Send>() {}
    assert_send::<Scene>();
};

#[cfg(test)]
mod console_tests;
#[cfg(test)]
mod reach_tests;
#[cfg(test)]
mod saved_tests;
#[cfg(test)]
mod script_tests;
#[cfg(test)]
mod tests;
