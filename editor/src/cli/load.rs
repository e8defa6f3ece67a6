//! From names to a scene and pipelines that can draw.

use std::thread;

use anyhow::{Context as _, anyhow};
use lightbench::assets::files::Files;
use lightbench::assets::{Assets, Progress};
use lightbench::lab::LdrImage;
use lightbench::lab::capture::STEP;
use lightbench::render::{Compiler, Gpu, Pipeline, PipelineDesc, Renderer, Variants, View};
use lightbench::script::{Scene, Settings, load_pipeline, load_scene};
use lightbench::world::{Light, LightKind, World};

use super::arguments::{GpuArguments, SceneArguments};
use super::progress::Bar;
use super::project;
use super::report::{self, Stopped, note};
use super::settings::Given;

/// What a command asks for.
pub struct Request<'a> {
    /// A scene's name or path.
    pub scene: &'a str,
    /// Its values and those of the pipelines.
    pub arguments: &'a SceneArguments,
    /// Names or paths of pipelines.
    pub pipelines: &'a [String],
    /// Which adapter draws.
    pub gpu: &'a GpuArguments,
}

/// Everything that a picture needs.
pub struct Stage {
    /// The device.
    pub renderer: Renderer,
    /// The scene, before its first step.
    pub scene: Scene,
    /// In the order of the request.
    pub pipelines: Vec<Pipeline>,
}

/// The scripts of a request and the values for each.
pub struct Scripts {
    /// What the scene's loader takes.
    pub scene: String,
    /// The scene's values.
    pub scene_settings: Settings,
    /// What the pipelines' loader takes, in the order of the request, with their values.
    pub pipelines: Vec<(String, Settings)>,
    /// The pipelines with those values.
    pub descriptions: Vec<PipelineDesc>,
    given: Given,
}

/// Reads the pipelines and tells whose parameter each `--set` means.
///
/// # Errors
/// A script or a model that is not there, a pipeline with mistakes, a value that nobody takes.
pub fn scripts(files: &mut Files, request: &Request) -> anyhow::Result<Scripts> {
    let mut paths = Vec::new();
    let mut defaults = Vec::new();
    for name in request.pipelines {
        let path = project::script(files, name)?;
        let desc = load_pipeline(files, &path, &Settings::new());
        defaults.push(desc.map_err(|problems| report::problems(files, problems))?);
        paths.push(path);
    }
    let names: Vec<&str> = defaults.iter().map(|desc| desc.name.as_str()).collect();
    let given = Given::read(&request.arguments.set, &names)?;
    let mut scene_settings = given.for_scene(&defaults);
    if let Some(model) = &request.arguments.model {
        let path = files
            .grant(model)
            .with_context(|| format!("--model {}", model.display()))?;
        scene_settings.set("model", path);
    }
    let mut pipelines = Vec::new();
    let mut descriptions = Vec::new();
    for (path, default) in paths.into_iter().zip(&defaults) {
        let settings = given.for_pipeline(default);
        let desc = load_pipeline(files, &path, &settings);
        descriptions.push(desc.map_err(|problems| report::problems(files, problems))?);
        pipelines.push((path, settings));
    }
    Ok(Scripts {
        scene: project::script(files, request.scene)?,
        scene_settings,
        pipelines,
        descriptions,
        given,
    })
}

/// Loads the scene on one thread while the device opens and the pipelines compile on another. What
/// draws other reflection models than the default one is compiled afterwards, for scenes that have
/// them or may yet make them: it is half of all that there is to compile.
///
/// # Errors
/// Mistakes in a script or a shader, a model that can't be read, no driver, or Ctrl-C.
pub fn stage(files: &mut Files, request: &Request, progress: &Progress) -> anyhow::Result<Stage> {
    let scripts = scripts(files, request)?;
    let files = &*files;
    let loading = Progress::new();
    super::progress::stop_on_ctrl_c(&loading);
    let bar = Bar::follow(&loading);
    let (scene, drawing) = thread::scope(|threads| {
        let scene =
            threads.spawn(|| load_scene(files, &scripts.scene, &scripts.scene_settings, &loading));
        let drawing = open(request.gpu).and_then(|(renderer, mut compiler)| {
            let variants = Variants::DEFAULT_MODEL;
            let pipelines = compile(&mut compiler, files, &scripts.descriptions, variants)?;
            Ok((renderer, compiler, pipelines))
        });
        if drawing.is_err() {
            // Nobody will see the scene.
            loading.cancel();
        }
        (scene.join(), drawing)
    });
    drop(bar);
    super::progress::stop_on_ctrl_c(progress);
    let (renderer, mut compiler, mut pipelines) = drawing?;
    let scene = scene.map_err(|_| anyhow!("loading the scene failed"))?;
    if loading.is_cancelled() {
        return Err(Stopped.into());
    }
    let mut scene = scene.map_err(|problems| {
        for near_miss in scripts.given.near_misses(&scripts.descriptions) {
            note(format!("note: {near_miss}"));
        }
        report::problems(files, problems)
    })?;
    let names = scene
        .parameters
        .iter()
        .map(|parameter| parameter.name.as_str());
    scripts.given.check_owners(&scripts.descriptions, names)?;
    tell(files, &mut scene);
    if scene.has_update() || scene.assets.reflection_models().has_others() {
        pipelines = compile(&mut compiler, files, &scripts.descriptions, Variants::ALL)?;
    }
    Ok(Stage {
        renderer,
        scene,
        pipelines,
    })
}

/// A scene as it stands at a frame, without a device.
///
/// # Errors
/// Mistakes in its script, or Ctrl-C.
pub fn moment(
    files: &mut Files,
    scene: &str,
    arguments: &SceneArguments,
    frame: u32,
) -> anyhow::Result<Scene> {
    let request = Request {
        scene,
        arguments,
        pipelines: &[],
        gpu: &GpuArguments::default(),
    };
    let scripts = scripts(files, &request)?;
    let files = &*files;
    let progress = Progress::new();
    super::progress::stop_on_ctrl_c(&progress);
    let bar = Bar::follow(&progress);
    let scene = load_scene(files, &scripts.scene, &scripts.scene_settings, &progress);
    drop(bar);
    if progress.is_cancelled() {
        return Err(Stopped.into());
    }
    let mut scene = scene.map_err(|problems| report::problems(files, problems))?;
    for frame in 1..=frame {
        let stepped = scene.update(f64::from(frame) * STEP, STEP);
        stepped.map_err(|problem| report::problems(files, problem))?;
    }
    scene.refresh();
    Ok(scene)
}

fn open(gpu: &GpuArguments) -> anyhow::Result<(Renderer, Compiler)> {
    let renderer = Renderer::new(Gpu::open(&gpu.options())?);
    let compiler = renderer.compiler();
    Ok((renderer, compiler))
}

fn compile(
    compiler: &mut Compiler,
    files: &Files,
    descriptions: &[PipelineDesc],
    variants: Variants,
) -> anyhow::Result<Vec<Pipeline>> {
    let pipelines = descriptions.iter().map(|desc| {
        compiler
            .compile_for(files, desc, variants)
            .map_err(|problems| report::problems(files, problems))
    });
    pipelines.collect()
}

/// Passes on what the scene's script printed, with the warnings of its models.
pub fn tell(files: &Files, scene: &mut Scene) {
    for line in scene.take_log() {
        note(format!(
            "{}: {}",
            report::known(files, &line.place),
            line.text
        ));
    }
}

/// A picture with a known answer: white ambient light of radiance ½ and nothing else, through the
/// linear curve.
///
/// # Errors
/// When the device can't draw it.
pub fn test_picture(gpu: Gpu) -> anyhow::Result<LdrImage> {
    let files = Files::shipped();
    let settings = Settings::new().with("tone_curve", "linear");
    let desc = load_pipeline(&files, "forward_single_pass", &settings)?;
    let mut renderer = Renderer::new(gpu);
    let mut pipeline = renderer.compiler().compile(&files, &desc)?;
    let mut world = World::new();
    let light = Light {
        kind: LightKind::Ambient,
        intensity: 0.5,
        ..Light::default()
    };
    let entity = world.spawn();
    world.insert(entity, lightbench::world::Transform::default())?;
    world.insert(entity, light)?;
    let (assets, view) = (Assets::new(), View::default());
    renderer.render(&mut world, &assets, &mut pipeline, &view, (16, 16), 0.0)?;
    let (width, height, bytes) = renderer.read_output(&pipeline)?;
    Ok(LdrImage::new(
        width,
        height,
        bytes.as_chunks::<4>().0.to_vec(),
    )?)
}
