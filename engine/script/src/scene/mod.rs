//! Scene files: `scripts/scenes/*.rhai` build worlds and move them, `*.scene` hold them.

mod behaviours;
mod bounds;
mod cameras;
mod columns;
mod data;
mod entities;
mod faces;
mod fields;
mod input;
mod lights;
mod list;
mod materials;
mod models;
mod motion;
mod picking;
mod recipes;
mod reflection;
mod saved;
mod selection;
mod shapes;
mod state;
mod tables;
mod tags;
mod textures;
mod values;

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::cache::{Cache, Reuse};
use lightbench_assets::files::Files;
use lightbench_assets::{Assets, Progress};
use lightbench_render::{Place, Problem, Problems};
use lightbench_world::systems::{FrameSystems, update_computed};
use lightbench_world::{Behaviour, Camera, Entity, RigidAnimation, SystemTime, Velocity, World};
use rhai::{AST, Dynamic, EvalAltResult, Module, Scope};

use crate::host::{Extras, Host, find};
use crate::limits::Limits;
use crate::log::LogLine;
use crate::names::Names;
use crate::parameters::{self, SceneParameter, undeclared};
use crate::settings::{SettingValue, Settings};
use behaviours::{AtWork, Behaviours};
use data::Stage;
use saved::Textures;

pub use behaviours::{BEHAVIOURS, BehaviourInfo};
pub use input::SceneEvent;
pub use list::{SceneEntry, list_scenes};
pub use picking::Ray;
pub use saved::EXTENSION as SCENE_EXTENSION;

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
    /// Calls `update`, where the script has it.
    update: Option<AST>,
    behaviours: Behaviours,
    /// Whether an update failed; the script is not called again.
    stopped: bool,
    /// What moves and computes beside the script.
    systems: FrameSystems,
    /// What the script took in the last step.
    script_time: Option<SystemTime>,
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

/// Runs a scene file, or reads one that holds a world.
///
/// `name_or_path` is a name as in `atrium`, or a path from the project's folder; a path that ends
/// in `.scene` is that of a world. `settings` gives
/// values to the parameters that the file declares. Runs on the calling thread; give it one of its
/// own where a window must stay alive, and stop it through `progress`.
///
/// # Errors
/// What is wrong with the file, with its place; and every setting that the scene does not have.
pub fn load_scene(
    files: &Files,
    name_or_path: &str,
    settings: &Settings,
    progress: &Progress,
) -> Result<Scene, Problems> {
    let (cache, limits) = (Cache::default(), Limits::default());
    let scene = load_scene_within(files, name_or_path, settings, progress, &cache, &limits);
    // Nobody loads with this cache again.
    cache.clear();
    scene
}

/// [`load_scene`] with other limits, and with what earlier loads have made: the scene is the same as
/// without, and each mesh and texture that is the same as in an earlier one has the same revision.
///
/// # Errors
/// As [`load_scene`].
pub fn load_scene_within(
    files: &Files,
    name_or_path: &str,
    settings: &Settings,
    progress: &Progress,
    cache: &Cache,
    limits: &Limits,
) -> Result<Scene, Problems> {
    let read = Read::default();
    let files = &read.watch(files);
    let reuse = cache.begin();
    let path = find(files, SCENES, name_or_path)?;
    let name = path.rsplit('/').next().unwrap_or(&path);
    if progress.begin(format!("Running {name}"), 0.0).is_err() {
        let stopped = Problem::new(Place::file(path), "the script was stopped");
        return Err(stopped.into());
    }
    if path.ends_with(&format!(".{}", saved::EXTENSION)) {
        let mut scene = saved::load(files, &reuse, &path, settings, progress, limits)?;
        scene.read = read;
        return Ok(scene);
    }
    let (host, stage, _) = host(files, &reuse, settings, limits, progress);
    let ast = host.load(&path)?;
    let update = update_call(&host, &path)?;
    host.watch.start(limits.load_time);
    let module = Module::eval_ast_as_new(Scope::new(), &ast, &host.engine)
        .map_err(|error| host.compiler.explain(&error, &path))?;
    let mut scene = Scene::new(path, host, stage, update);
    scene.read = read;
    scene
        .host
        .engine
        .register_static_module(SCRIPT_MODULE, module.into());
    scene.finish()?;
    // What is animated stands where it is at the beginning.
    scene.run_systems(0.0, 0.0);
    scene.start_behaviours()?;
    Ok(scene)
}

/// The name under which the script's functions are called. No script can spell it.
const SCRIPT_MODULE: &str = "scene_script";

/// The names of everything that scene scripts can call.
#[must_use]
pub fn scene_names() -> Names {
    let (host, ..) = host(
        &Files::shipped(),
        &Reuse::default(),
        &Settings::new(),
        &Limits::default(),
        &Progress::new(),
    );
    host.compiler.names.clone()
}

fn host(
    files: &Files,
    reuse: &Reuse,
    settings: &Settings,
    limits: &Limits,
    progress: &Progress,
) -> (Host, Stage, Textures) {
    let mut stage = None;
    let at_work = AtWork::default();
    let defined = Textures::default();
    let host = Host::new(
        files,
        limits,
        Extras {
            register: &mut |api, watch, log| {
                watch.stop_with(progress);
                let made = Stage::new(files, reuse, settings, limits, watch, log, progress);
                made.lock().at_work = at_work.clone();
                api.section("Parameters");
                let stage_of_parameters = made.clone();
                parameters::register(api, move |arguments| {
                    let data = &mut *stage_of_parameters.lock();
                    let (parameters, settings) = match &mut data.starting {
                        Some(starting) => (&mut starting.parameters, &starting.settings),
                        None => (&mut data.parameters, &data.settings),
                    };
                    parameters::declare(parameters, settings, arguments)
                });
                api.section("Entities");
                entities::register(api, &made);
                api.section("Motion");
                motion::register(api, &made);
                api.section("Extent");
                bounds::register(api, &made);
                api.section("Shapes and meshes");
                shapes::register(api, &made);
                api.section("Textures");
                textures::register(api, &made);
                api.section("Saved scenes");
                saved::register(api, &defined);
                api.section("Materials");
                materials::register(api, &made);
                api.section("Models from files");
                models::register(api, &made);
                api.section("Lights");
                lights::register(api, &made);
                api.section("Cameras");
                cameras::register(api, &made);
                behaviours::register(api, &made);
                input::register(api, &made);
                picking::register(api, &made);
                api.section("State");
                state::register(api);
                fields::register(api, &made);
                tags::register(api, &made);
                selection::register(api, &made);
                columns::register(api, &made);
                stage = Some(made);
            },
            globals: vec![("state", Dynamic::from(state::State::default()))],
            variables: at_work.variables(),
            reuse: reuse.clone(),
        },
    );
    let stage = stage.unwrap_or_else(|| {
        let (watch, log) = (&host.watch, &host.log);
        Stage::new(files, reuse, settings, limits, watch, log, progress)
    });
    (host, stage, defined)
}

/// What calls the script's `update`, with as many arguments as it takes.
fn update_call(host: &Host, path: &str) -> Result<Option<AST>, Problem> {
    let Some(source) = host.compiler.sources.get(path) else {
        return Ok(None);
    };
    let Some(function) = source.functions.iter().find(|f| f.name == "update") else {
        return Ok(None);
    };
    let arguments = match function.arguments.len() {
        0 => "",
        1 => "time",
        2 => "time, dt",
        count => {
            let at = Place::new(path, function.line, function.column);
            let problem = Problem::new(at, format!("`update` takes {count} arguments"))
                .with_hint("it is written `fn update(time, dt) { … }`")
                .with_source(&source.text);
            return Err(problem);
        }
    };
    let mut scope = Scope::new();
    scope.push("time", 0.0_f64).push("dt", 0.0_f64);
    let call = format!("{SCRIPT_MODULE}::update({arguments})");
    // Without strictness: the module is registered after the script has run.
    host.compile_loosely(&scope, &call)
        .map(Some)
        .map_err(|error| Problem::new(Place::file(path), error))
}

impl Scene {
    fn new(path: String, host: Host, stage: Stage, update: Option<AST>) -> Self {
        let at_work = stage.lock().at_work.clone();
        Self {
            world: World::new(),
            assets: Assets::new(),
            parameters: Vec::new(),
            path,
            host,
            stage,
            read: Read::default(),
            update,
            behaviours: Behaviours::new(at_work),
            stopped: false,
            systems: FrameSystems::default(),
            script_time: None,
        }
    }

    /// Takes over what the script made, and checks that everything that was set has been used.
    fn finish(&mut self) -> Result<(), Problems> {
        let mut data = self.stage.lock();
        let has_camera = !data.world.columns::<Camera>().is_empty();
        if !has_camera && let Err(mistake) = cameras::add_default(&mut data) {
            return Err(Problem::new(Place::file(self.path.as_str()), mistake.message).into());
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
            .update
            .is_some()
            .then(|| SystemTime::of("script", || ()).0);
        Ok(())
    }

    /// Brings the scene to the next moment: calls the script's `update(time, dt)`, where it has
    /// one, and runs all systems of the world. `dt` is the step that ends at `time`, in seconds;
    /// the same steps give the same scene, however long they take.
    ///
    /// # Errors
    /// What went wrong in a script, once: after an error that script is not called again, what it had
    /// changed stays, and all others and the systems go on. Where several went wrong, the next steps
    /// tell of the others.
    pub fn update(&mut self, time: f64, dt: f64) -> Result<(), Problem> {
        let (took, result) = SystemTime::of("script", || {
            let result = self.call_update(time, dt);
            self.swap();
            let (host, stage) = (&mut self.host, &self.stage);
            self.behaviours.step(host, stage, time, dt);
            self.swap();
            result
        });
        let scripted = self.update.is_some() || !self.behaviours.is_empty();
        self.script_time = scripted.then_some(took);
        self.run_systems(time, dt);
        result?;
        self.behaviours.take_problem().map_or(Ok(()), Err)
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

    /// The behaviours of its entities, in the order in which they began.
    #[must_use]
    pub fn behaviours(&self) -> Vec<BehaviourInfo> {
        self.behaviours.list()
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

    /// Brings what the systems compute up to date with changes from outside, without letting time
    /// pass.
    pub fn refresh(&mut self) {
        update_computed(&mut self.world, self.assets.mesh_bounds());
    }

    /// What the script and each system took in the last step.
    pub fn system_times(&self) -> impl Iterator<Item = SystemTime> + '_ {
        self.script_time.iter().cloned().chain(self.systems.times())
    }

    fn call_update(&mut self, time: f64, dt: f64) -> Result<(), Problem> {
        let Some(call) = self.update.clone().filter(|_| !self.stopped) else {
            return Ok(());
        };
        self.swap();
        let mut scope = Scope::new();
        scope.push("time", time).push("dt", dt);
        let limit = self.host.compiler.limits.update_time;
        self.host.watch.start(limit);
        let result = self
            .host
            .engine
            .eval_ast_with_scope::<Dynamic>(&mut scope, &call);
        self.swap();
        match result {
            Ok(_) => Ok(()),
            Err(error) => {
                self.stopped = true;
                Err(self.explain_update(&error))
            }
        }
    }

    fn explain_update(&self, error: &EvalAltResult) -> Problem {
        let compiler = &self.host.compiler;
        let problem = compiler.explain(error, &self.path);
        // A limit that is hit inside knows only the place of the outermost call, which is ours.
        let inside = matches!(error, EvalAltResult::ErrorInFunctionCall(..));
        let source = compiler.sources.get(&self.path).unwrap_or_default();
        match source.functions.iter().find(|f| f.name == "update") {
            Some(function) if !inside => {
                let at = Place::new(self.path.as_str(), function.line, function.column);
                Problem {
                    place: at,
                    ..problem
                }
                .with_source(&source.text)
            }
            _ => problem,
        }
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
        self.update.is_some() && !self.stopped
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
mod reach_tests;
#[cfg(test)]
mod saved_tests;
#[cfg(test)]
mod tests;
