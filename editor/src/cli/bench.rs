//! `lightbench bench`: the program measures itself.

use clap::{Args, Subcommand};
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::script::list_pipelines;
use lightbench::world::layouts;

use super::arguments::{GpuArguments, Size};
use super::bench_frame::{self, FrameArguments};
use super::bench_pipelines::{self, PipelinesArguments};
use super::progress::Bar;
use super::project;
use super::report::say;
use crate::ui::bench::{BenchOptions, reload, scene, swap};

/// Arguments of `lightbench bench`.
#[derive(Args, Debug)]
#[command(
    arg_required_else_help = true,
    after_help = "\
Examples:
  lightbench bench world
  lightbench bench world --objects 100000
  lightbench bench frame many_lights --set spheres=10000
  lightbench bench pipelines --pipelines forward_single_pass,tiled_deferred --out curves
  lightbench bench pipelines layers --sweep layers=1,2,4,8,16,32 --out curves
  lightbench bench reload --size 320x180 --edits 20
  lightbench bench scene atrium --edits 20
  lightbench bench swap --pipelines forward_single_pass,deferred_shading"
)]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Culls and moves objects in three memory layouts: columns, an array of structures, and boxed
    /// objects; says how fast each is and what holds it back
    World {
        /// How many objects; a million takes some seconds and 600 MB
        #[arg(
            long,
            value_name = "N",
            default_value_t = 1_000_000,
            value_parser = clap::value_parser!(u32).range(1..=10_000_000)
        )]
        objects: u32,
    },
    /// Moves a scene from frame to frame and says what each system, the extraction and the recording take
    Frame(FrameArguments),
    /// Measures what a frame costs as a parameter of the scene grows, and writes a table and a plot
    Pipelines(PipelinesArguments),
    /// Saves a shader again and again, and says how long it takes until the picture has changed
    Reload {
        /// The scene that is drawn, through deferred shading
        #[arg(long, value_name = "SCENE", default_value = "atrium")]
        scene: String,
        /// Width and height in pixels
        #[arg(long, value_name = "WxH", default_value = "640x360")]
        size: Size,
        /// How often the shader is saved
        #[arg(
            long,
            value_name = "N",
            default_value_t = 100,
            value_parser = clap::value_parser!(u32).range(1..=10_000)
        )]
        edits: u32,
        #[command(flatten)]
        gpu: GpuArguments,
    },
    /// Saves a scene's script again and again, and says how long it takes until the picture has
    /// changed, beside a load that reuses nothing
    Scene {
        /// The scene, drawn through deferred shading
        #[arg(value_name = "SCENE", default_value = "atrium")]
        scene: String,
        /// Width and height in pixels
        #[arg(long, value_name = "WxH", default_value = "640x360")]
        size: Size,
        /// How often the script is saved
        #[arg(
            long,
            value_name = "N",
            default_value_t = 50,
            value_parser = clap::value_parser!(u32).range(1..=10_000)
        )]
        edits: u32,
        #[command(flatten)]
        gpu: GpuArguments,
    },
    /// Swaps between pipelines, and says what a first visit and the way back cost
    Swap {
        /// The scene that is drawn
        #[arg(long, value_name = "SCENE", default_value = "atrium")]
        scene: String,
        /// Width and height in pixels
        #[arg(long, value_name = "WxH", default_value = "640x360")]
        size: Size,
        /// The pipelines in the order of the visits; without it, all
        #[arg(long, value_name = "A,B", value_delimiter = ',')]
        pipelines: Vec<String>,
        #[command(flatten)]
        gpu: GpuArguments,
    },
}

/// Runs the command.
///
/// # Errors
/// No driver, or a picture that does not change.
pub fn run(
    arguments: &Arguments,
    files: impl FnOnce() -> anyhow::Result<Files>,
) -> anyhow::Result<()> {
    match &arguments.what {
        What::World { objects } => {
            let report = layouts::measure(*objects as usize);
            say(report.to_string().trim_end())
        }
        What::Frame(arguments) => bench_frame::run(arguments, files()?),
        What::Pipelines(arguments) => bench_pipelines::run(arguments, files()?),
        What::Reload {
            scene,
            size,
            edits,
            gpu,
        } => {
            let options = BenchOptions {
                gpu: gpu.options(),
                scene: scene.clone(),
                size: (*size).into(),
            };
            let progress = Progress::new();
            let bar = Bar::follow(&progress);
            let times = reload::reload(&options, *edits as usize, |done| {
                // Only the bar listens.
                let _ = progress.begin("saving a shader", done as f32 / *edits as f32);
            });
            drop(bar);
            say(times?.to_string())
        }
        What::Scene {
            scene,
            size,
            edits,
            gpu,
        } => {
            let mut files = files()?;
            let options = BenchOptions {
                gpu: gpu.options(),
                scene: project::script(&mut files, scene)?,
                size: (*size).into(),
            };
            let progress = Progress::new();
            let bar = Bar::follow(&progress);
            let times = scene::scene(&options, &files, *edits as usize, |done| {
                let _ = progress.begin("saving a script", done as f32 / *edits as f32);
            });
            drop(bar);
            say(times?.to_string())
        }
        What::Swap {
            scene,
            size,
            pipelines,
            gpu,
        } => {
            let files = files()?;
            let options = BenchOptions {
                gpu: gpu.options(),
                scene: scene.clone(),
                size: (*size).into(),
            };
            let mut names = pipelines.clone();
            if names.is_empty() {
                names.extend(list_pipelines(&files)?.into_iter().map(|entry| entry.name));
            }
            let progress = Progress::new();
            let bar = Bar::follow(&progress);
            let times = swap::swap(&options, files, &names, |done| {
                let _ = progress.begin("visiting a pipeline", done as f32 / names.len() as f32);
            });
            drop(bar);
            say(times?.to_string())
        }
    }
}
