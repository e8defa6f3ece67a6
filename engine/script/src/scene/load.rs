//! Loading scenes: the engine for a scene's scripts, and the first run of its file.

use lightbench_assets::Progress;
use lightbench_assets::cache::{Cache, Reuse};
use lightbench_assets::files::Files;
use lightbench_render::{Place, Problem, Problems};
use rhai::{Dynamic, Module, Scope};

use super::behaviours::AtWork;
use super::data::Stage;
use super::saved::Textures;
use super::script::OwnScript;
use super::state::{KeptState, State};
use super::{
    Read, SCENES, Scene, behaviours, bounds, cameras, columns, curves, entities, fields, input,
    lights, materials, models, motion, picking, pipeline_choice, plots, saved, selection, shapes,
    state, tags, textures,
};
use crate::host::{Extras, Host, find};
use crate::limits::Limits;
use crate::names::Names;
use crate::parameters;
use crate::settings::Settings;

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
    let (cache, limits) = (Cache::default(), Limits::default().in_project(files)?);
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
    let nothing = KeptState::default();
    load_scene_again(
        files,
        name_or_path,
        settings,
        progress,
        cache,
        limits,
        nothing,
    )
}

/// [`load_scene_within`] with what the scripts of an earlier load asked to keep: [`Scene::kept`].
///
/// # Errors
/// As [`load_scene`].
pub fn load_scene_again(
    files: &Files,
    name_or_path: &str,
    settings: &Settings,
    progress: &Progress,
    cache: &Cache,
    limits: &Limits,
    kept: KeptState,
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
        let mut scene = saved::load(files, &reuse, &path, settings, progress, limits, kept)?;
        scene.read = read;
        return Ok(scene);
    }
    let (host, stage, _) = host(files, &reuse, settings, limits, progress, kept);
    let ast = host.load(&path)?;
    let script = OwnScript::find(&host, &path, SCRIPT_MODULE)?;
    host.watch.start(limits.load_time);
    let module = Module::eval_ast_as_new(Scope::new(), &ast, &host.engine)
        .map_err(|error| host.compiler.explain(&error, &path))?;
    let mut scene = Scene::new(path, host, stage, script);
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
        KeptState::default(),
    );
    host.compiler.names.clone()
}

pub(super) fn host(
    files: &Files,
    reuse: &Reuse,
    settings: &Settings,
    limits: &Limits,
    progress: &Progress,
    kept: KeptState,
) -> (Host, Stage, Textures) {
    let mut stage = None;
    let state = State::with(kept.scene);
    let mut kept = kept.behaviours;
    let at_work = AtWork::new(&state);
    let defined = Textures::default();
    let host = Host::new(
        files,
        limits,
        Extras {
            register: &mut |api, watch, log| {
                watch.stop_with(progress);
                let made = Stage::new(files, reuse, settings, limits, watch, log, progress);
                {
                    let data = &mut *made.lock();
                    data.at_work = at_work.clone();
                    data.kept = std::mem::take(&mut kept);
                    data.state = state.clone();
                }
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
                api.section("Curves");
                curves::register(api);
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
                api.section("The pipeline");
                pipeline_choice::register(api, &made);
                fields::register(api, &made);
                tags::register(api, &made);
                selection::register(api, &made);
                columns::register(api, &made);
                plots::register(api, &made);
                stage = Some(made);
            },
            globals: vec![("state", Dynamic::from(state.clone()))],
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
