//! `lightbench trace`: a picture by the path tracer, to compare those of pipelines with.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::assets::images::{save_exr, save_png};
use lightbench::lab::HdrImage;
use lightbench::lab::reference::output::{ToneCurve, shown};
use lightbench::lab::tracer::{Mode, Options, Sources, Strategy, TracedScene, trace};
use lightbench::render::View;

use super::arguments::{SceneArguments, Size};
use super::load;
use super::progress::{Bar, stop_on_ctrl_c};
use super::project;
use super::render::{Format, format_of};
use super::report::{Stopped, Usage, note, say, warn};

/// Each pixel takes some 60 bytes until the picture is done.
const MOST_PIXELS: u64 = 64_000_000;

/// Arguments of `lightbench trace`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench trace cornell_box --sources surfaces --samples 256 --out box.exr --out box.png
  lightbench trace atrium --mode direct --out direct.exr
  lightbench trace atrium --mode shadowed --size 1280x720 --out shadows.png
  lightbench trace many_lights --set lights=16 --depth 2 --seed 7 --out two.exr

Beside an EXR, which holds linear light, the variance of each of its values is written: of x.exr to
x.variance.exr. A PNG holds the picture through the tone curve of the pipelines. Ctrl-C stops and keeps
what is there. The same input gives the same picture, bit for bit, on any number of threads.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai or .scene file
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The picture to write; it ends in .exr or .png. May be given again
    #[arg(long, value_name = "FILE", required = true)]
    out: Vec<PathBuf>,
    /// Which light the picture shows
    #[arg(long, value_enum, default_value_t = ModeName::Full)]
    mode: ModeName,
    /// Paths through each pixel, in mode `full` [default: 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    samples: Option<u32>,
    /// Reflections that a path has at most, in mode `full`; 1 is direct light [default: no bound]
    #[arg(long, value_name = "N")]
    depth: Option<u32>,
    /// Another number, another noise, in mode `full` [default: 0]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// What lights surfaces in mode `full`; what shines is seen in any case [default: all]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "KINDS")]
    sources: Vec<Source>,
    /// How paths find the sky and surfaces that shine, in mode `full`: all ways have the same mean and
    /// differ in noise [default: both]
    #[arg(long, value_enum)]
    strategy: Option<StrategyName>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// Which frame, from 0; the scene takes 60 steps a second
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// Brightness of a PNG: each step doubles the light
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    exposure: f64,
    /// Tone curve of a PNG: hable, reinhard, hejl or linear
    #[arg(long, value_name = "NAME", default_value = "hable")]
    tone_curve: ToneCurve,
    #[command(flatten)]
    scene_arguments: SceneArguments,
}

/// Which light is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ModeName {
    /// What the pipelines draw: the light of all lamps on what is seen, without shadows
    Direct,
    /// The same with exact shadows
    Shadowed,
    /// Light along all paths, from surface to surface
    Full,
}

/// What lights surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Source {
    /// Point, spot and directional lights
    Lights,
    /// Ambient lights, as a sky
    Sky,
    /// Surfaces that emit
    Surfaces,
}

/// How it is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum StrategyName {
    /// They aim, and also meet them by chance
    Both,
    /// They aim alone
    Aim,
    /// They meet them by chance alone
    Scatter,
}

impl Arguments {
    fn options(&self) -> Result<Options, Usage> {
        let mode = match self.mode {
            ModeName::Direct => Mode::Direct,
            ModeName::Shadowed => Mode::Shadowed,
            ModeName::Full => Mode::Full,
        };
        if mode != Mode::Full {
            self.refuse_paths()?;
        }
        let Size { width, height } = self.size;
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(Usage(format!(
                "--size {width}x{height}: a traced picture has at most {} million pixels, as 8000x8000 \
                 has; choose a smaller one",
                MOST_PIXELS / 1_000_000
            )));
        }
        let default = Options::default();
        Ok(Options {
            size: self.size.into(),
            mode,
            samples: self.samples.unwrap_or(default.samples),
            depth: self.depth,
            seed: self.seed.unwrap_or(default.seed),
            sources: self.sources(),
            strategy: match self.strategy {
                None | Some(StrategyName::Both) => Strategy::Both,
                Some(StrategyName::Aim) => Strategy::Aim,
                Some(StrategyName::Scatter) => Strategy::Scatter,
            },
        })
    }

    /// Refuses what means nothing where no path is traced.
    fn refuse_paths(&self) -> Result<(), Usage> {
        let given = [
            ("--samples", self.samples.is_some()),
            ("--depth", self.depth.is_some()),
            ("--seed", self.seed.is_some()),
            ("--sources", !self.sources.is_empty()),
            ("--strategy", self.strategy.is_some()),
        ];
        match given.iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((name, _)) => Err(Usage(format!(
                "{name} belongs to paths, and the modes `direct` and `shadowed` follow none: they look \
                 once through the middle of each pixel; leave {name} out, or give `--mode full`"
            ))),
        }
    }

    fn sources(&self) -> Sources {
        if self.sources.is_empty() {
            return Sources::ALL;
        }
        let has = |source| self.sources.contains(&source);
        Sources {
            lights: has(Source::Lights),
            sky: has(Source::Sky),
            surfaces: has(Source::Surfaces),
        }
    }
}

/// Runs the command.
///
/// # Errors
/// A scene with mistakes, a file that can't be written, or Ctrl-C.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let options = arguments.options()?;
    for out in &arguments.out {
        format_of(out)?;
        project::writable(out)?;
    }
    let (name, given) = (&arguments.scene, &arguments.scene_arguments);
    let mut scene = load::moment(&mut files, name, given, arguments.frame)?;
    let view = View::from_world(&scene.world).unwrap_or_default();
    let traced_scene = TracedScene::new(&scene.world, &scene.assets);
    load::tell(&files, &mut scene);
    traced_scene.warnings().iter().for_each(warn);

    let progress = Progress::new();
    stop_on_ctrl_c(&progress);
    // It can't be cancelled yet.
    let _ = progress.begin("Tracing rays", 0.0);
    let bar = Bar::follow(&progress);
    let start = Instant::now();
    let traced = trace(&traced_scene, &view, &options, &progress);
    drop(bar);
    let traced = traced.map_err(|_| Stopped)?;
    let seconds = start.elapsed().as_secs_f64();
    note(format!(
        "{} triangles, {} lights; {} samples a pixel, {:.1} million rays in {seconds:.1} s",
        traced_scene.triangles(),
        traced_scene.lights(),
        traced.samples,
        traced.rays as f64 * 1e-6,
    ));
    if traced.unusable > 0 {
        warn(format!(
            "{} samples were no finite numbers and are left out",
            traced.unusable
        ));
    }
    for out in &arguments.out {
        if format_of(out)? == Format::Exr {
            write_exr(out, &traced.picture)?;
            let beside = out.with_extension("variance.exr");
            write_exr(&beside, &traced.variance)?;
            say(beside.display().to_string())?;
        } else {
            let picture = shown(&traced.picture, arguments.exposure, arguments.tone_curve);
            let bytes = picture.pixels.as_flattened();
            save_png(out, picture.width, picture.height, bytes)?;
        }
        say(out.display().to_string())?;
    }
    if traced.stopped {
        note("what was traced so far is written");
        return Err(Stopped.into());
    }
    Ok(())
}

fn write_exr(path: &Path, picture: &HdrImage) -> anyhow::Result<()> {
    let pixels = picture.pixels.as_flattened();
    Ok(save_exr(path, picture.width, picture.height, pixels)?)
}
