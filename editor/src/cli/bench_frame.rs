//! `lightbench bench frame`: what the world costs before the first pass.

use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::measure::{MeasureOptions, Measurement, measure};
use lightbench::lab::statistics::Summary;
use lightbench::world::{Light, MeshRenderer};

use super::arguments::{GpuArguments, SceneArguments, Size};
use super::load::{self, Request, Stage};
use super::progress::Bar;
use super::report::say;

/// Arguments of `lightbench bench frame`.
#[derive(Args, Debug)]
pub struct FrameArguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a file
    #[arg(value_name = "SCENE", default_value = "many_lights")]
    scene: String,
    /// The pipeline for which frames are extracted
    #[arg(long, value_name = "PIPELINE", default_value = "deferred_shading")]
    pipeline: String,
    /// Frames measured, after some to warm up
    #[arg(
        long,
        value_name = "N",
        default_value_t = 120,
        value_parser = clap::value_parser!(u32).range(1..=100_000)
    )]
    frames: u32,
    /// Width and height in pixels; drawing is not part of what is measured
    #[arg(long, value_name = "WxH", default_value = "64x36")]
    size: Size,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Runs the command.
///
/// # Errors
/// Anything that keeps the scene from being loaded or drawn.
pub fn run(arguments: &FrameArguments, mut files: Files) -> anyhow::Result<()> {
    let progress = Progress::new();
    let request = Request {
        scene: &arguments.scene,
        arguments: &arguments.scene_arguments,
        pipelines: std::slice::from_ref(&arguments.pipeline),
        gpu: &arguments.gpu,
    };
    let Stage {
        mut renderer,
        mut scene,
        mut pipelines,
    } = load::stage(&mut files, &request, &progress)?;
    // The first moment is the one that the scene was loaded at: it is reached from nothing.
    let options = MeasureOptions {
        size: arguments.size.into(),
        warmup: 3,
        frames: arguments.frames + 1,
        ..MeasureOptions::default()
    };
    let bar = Bar::follow(&progress);
    let measured = measure(
        &mut renderer,
        &mut scene,
        &mut pipelines,
        options,
        &progress,
    );
    drop(bar);
    let measured = measured?;
    let objects = scene.world.columns::<MeshRenderer>().len();
    let lights = scene.world.columns::<Light>().len();
    say(format!(
        "{}: {} objects, {lights} lights, {} frames, CPU time of the thread, ms a frame\n{}",
        arguments.scene,
        objects,
        measured.frames - 1,
        table(&measured)
    ))
}

/// One line a system, then their sum without the script, which is no system.
fn table(measured: &Measurement) -> String {
    let mut text = format!("{:<16}{:>9}{:>9}\n", "", "median", "p95");
    let systems = measured.pipelines.iter().flat_map(|p| &p.systems);
    let mut frames: Vec<f64> = Vec::new();
    for system in systems {
        let times = system.thread_ms.get(1..).unwrap_or_default();
        text += &line(&system.name, times);
        if system.name != "script" {
            frames.resize(times.len().max(frames.len()), 0.0);
            frames
                .iter_mut()
                .zip(times)
                .for_each(|(sum, ms)| *sum += ms);
        }
    }
    text + line("without script", &frames).trim_end()
}

fn line(name: &str, times: &[f64]) -> String {
    let summary = Summary::of(times);
    let ms = |value: fn(Summary) -> f64| {
        summary.map_or_else(
            || "-".to_owned(),
            |summary| format!("{:.3}", value(summary)),
        )
    };
    format!("{name:<16}{:>9}{:>9}\n", ms(|s| s.median), ms(|s| s.p95))
}
