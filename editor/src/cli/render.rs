//! `lightbench render`: one picture.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::assets::images::{save_exr, save_png};
use lightbench::lab::capture::{Capture, CaptureError, CaptureOptions, capture, capture_through};
use lightbench::render::{Pipeline, Renderer};
use lightbench::script::Scene;

use super::arguments::{GpuArguments, SceneArguments, Size};
use super::load::{self, Request, Stage};
use super::progress::Bar;
use super::project;
use super::report::{self, Stopped, Usage, say, warn};
use crate::viewpoint::Viewpoint;
use crate::viewpoint::moment::{self, WayError};

/// Arguments of `lightbench render`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench render atrium --out atrium.png
  lightbench render many_lights --pipeline forward_single_pass --set lights=256 --out lights.png
  lightbench render showroom --model teapot.obj --size 800x600 --out teapot.png
  lightbench render my_scene.rhai --frame 120 --set pipeline.exposure=1 --out later.exr
  lightbench render --view 'lightbench-view-1 scene=atrium …' --out the_view.png

A PNG holds the picture as a display shows it. An EXR holds linear light before exposure and tone
curve. The same input gives the same picture, bit for bit, on the same driver.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai file
    #[arg(value_name = "SCENE", required_unless_present = "view")]
    scene: Option<String>,
    /// A view that the editor has copied, as one word: scene, pipeline, their values, camera, time and
    /// size. Draws the picture that was on the screen
    #[arg(long, value_name = "VIEW", conflicts_with_all = ["scene", "pipeline", "size", "frame", "set",
        "model"])]
    view: Option<Viewpoint>,
    /// The pipeline: a name, as in `lightbench list pipelines`, or the path of a .rhai file
    #[arg(long, value_name = "PIPELINE", default_value = "deferred_shading")]
    pipeline: String,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// Which frame, from 0; the scene takes 60 steps a second
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// The picture to write; it ends in .png or .exr
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// What a picture's file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// What a display shows.
    Png,
    /// Linear light.
    Exr,
}

/// Runs the command.
///
/// # Errors
/// Anything that keeps the picture from being drawn or written.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let format = format_of(&arguments.out)?;
    project::writable(&arguments.out)?;
    let progress = Progress::new();
    let of_view = arguments.view.as_ref().map(arguments_of);
    let (scene, pipeline, scene_arguments) = match (&arguments.view, &of_view) {
        (Some(view), Some(of_view)) => (view.scene.as_str(), &view.pipeline, of_view),
        _ => (
            arguments.scene.as_deref().unwrap_or_default(),
            &arguments.pipeline,
            &arguments.scene_arguments,
        ),
    };
    let request = Request {
        scene,
        arguments: scene_arguments,
        pipelines: std::slice::from_ref(pipeline),
        gpu: &arguments.gpu,
    };
    let Stage {
        mut renderer,
        mut scene,
        mut pipelines,
    } = load::stage(&mut files, &request, &progress)?;
    let pipeline = pipelines
        .first_mut()
        .ok_or_else(|| anyhow!("no pipeline was compiled"))?;
    if format == Format::Exr && pipeline.desc.hdr.is_none() {
        return Err(Usage(format!(
            "the pipeline `{}` names no linear target for an EXR: add `p.hdr(\"…\")` to it, or \
             write a .png",
            pipeline.desc.name
        ))
        .into());
    }
    let options = CaptureOptions {
        size: arguments.size.into(),
        frame: arguments.frame,
    };
    let bar = Bar::follow(&progress);
    let picture = match &arguments.view {
        Some(view) => capture_view(&mut renderer, &mut scene, pipeline, view, &progress)?,
        None => capture(&mut renderer, &mut scene, pipeline, options, &progress),
    };
    drop(bar);
    load::tell(&files, &mut scene);
    for warning in renderer.take_warnings() {
        warn(warning);
    }
    let picture = picture.map_err(|error| match error {
        CaptureError::Cancelled(_) => anyhow::Error::from(Stopped),
        CaptureError::Script(problem) => report::problems(&files, problem),
        other => other.into(),
    })?;
    save(&picture, format, &arguments.out)?;
    say(arguments.out.display().to_string())
}

/// What the command line would be for a view. A model that lies outside of the project is let in as
/// `--model` does.
fn arguments_of(view: &Viewpoint) -> SceneArguments {
    let model = view.scene_settings.get("model").map(ToString::to_string);
    let model = model.map(PathBuf::from).filter(|path| path.is_absolute());
    let mut sets = view.sets();
    if model.is_some() {
        sets.retain(|set| !set.starts_with("scene.model="));
    }
    SceneArguments { model, set: sets }
}

/// Takes the picture of a view.
fn capture_view(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    view: &Viewpoint,
    progress: &Progress,
) -> anyhow::Result<Result<Capture, CaptureError>> {
    let time = match moment::go(scene, view.time, progress) {
        Ok(time) => time,
        Err(WayError::Script(problem)) => return Ok(Err(CaptureError::Script(problem))),
        Err(WayError::Cancelled(stopped)) => return Ok(Err(stopped.into())),
    };
    let camera = view.camera.view(scene);
    let camera = camera.map_err(|error| Usage(format!("--view: {error}")))?;
    let picture = capture_through(renderer, scene, pipeline, &camera, view.size, time);
    Ok(picture.map_err(CaptureError::from))
}

/// The format that a file's name asks for.
///
/// # Errors
/// Another ending.
pub fn format_of(path: &Path) -> Result<Format, Usage> {
    let extension = path
        .extension()
        .map(|extension| extension.to_ascii_lowercase());
    match extension
        .as_deref()
        .and_then(|extension| extension.to_str())
    {
        Some("png") => Ok(Format::Png),
        Some("exr") => Ok(Format::Exr),
        _ => Err(Usage(format!(
            "--out {}: name a file that ends in .png or .exr",
            path.display()
        ))),
    }
}

fn save(picture: &Capture, format: Format, path: &Path) -> anyhow::Result<()> {
    match (format, &picture.hdr) {
        (Format::Exr, Some(hdr)) => {
            save_exr(path, hdr.width, hdr.height, hdr.pixels.as_flattened())?;
        }
        _ => {
            let output = &picture.output;
            save_png(
                path,
                output.width,
                output.height,
                output.pixels.as_flattened(),
            )?;
        }
    }
    Ok(())
}
