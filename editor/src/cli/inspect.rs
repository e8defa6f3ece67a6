//! `lightbench inspect`: what the targets of a frame hold after each pass.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::{Files, write_atomic};
use lightbench::assets::images::save_png;
use lightbench::lab::capture::STEP;
use lightbench::lab::colormap::ColorMap;
use lightbench::lab::heatmap::heat_map_with_legend;
use lightbench::lab::inspect::{FrameInspector, Part};
use lightbench::lab::metrics::Plane;
use lightbench::lab::shown::{Shown, encode};
use lightbench::render::description::Slice;
use lightbench::render::heat_map::{self, HeatMap};
use lightbench::render::inspect::{Aspect, Unknown, find_pass, last_writer, part_in_words};
use lightbench::render::{PipelineDesc, TargetImage};

use super::arguments::{GpuArguments, SceneArguments, Size};
use super::load::{self, Request, Stage};
use super::project;
use super::report::{self, Usage, say, warn};

/// Arguments of `lightbench inspect`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench inspect atrium --target g_normal --out normals.exr
  lightbench inspect atrium --pass g_buffer --target hdr --channel r --range 0,4 --out emitted.png
  lightbench inspect atrium --pixel 320,180
  lightbench inspect my_scene.rhai --pipeline mine.rhai --find-nan
  lightbench inspect many_lights --pipeline tiled_forward --heat-map lights_evaluated --out heat.png

An EXR holds the values as they are. A PNG shows the range from black to white, or with
--false-colour in colours. Without --pass it is the last pass that writes the target.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai file
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The pipeline: a name, as in `lightbench list pipelines`, or the path of a .rhai file
    #[arg(long, value_name = "PIPELINE", default_value = "deferred_shading")]
    pipeline: String,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// Which frame, from 0; the scene takes 60 steps a second
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// The pass after which to look, by its name or its number from 0
    #[arg(long, value_name = "PASS")]
    pass: Option<String>,
    /// The target to write to a file
    #[arg(long, value_name = "TARGET", requires = "out")]
    target: Option<String>,
    /// Count how much work each pixel makes, and write that: overdraw, lights_evaluated,
    /// lights_reaching or lights_in_vain. A PNG has a legend below it
    #[arg(long, value_name = "WHAT", requires = "out", conflicts_with_all = ["target", "pixel", "find_nan"])]
    heat_map: Option<String>,
    /// The file; it ends in .png or .exr
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// A mip level of the target
    #[arg(long, value_name = "N", default_value_t = 0)]
    mip: u32,
    /// A layer of the target, a side of a cube, or a slice of a volume
    #[arg(long, value_name = "N", default_value_t = 0)]
    layer: u32,
    /// One sample of a target that has several; without it, their mean
    #[arg(long, value_name = "N")]
    sample: Option<u32>,
    /// The stencil of a depth target instead of its depth
    #[arg(long)]
    stencil: bool,
    /// One channel alone: r, g, b or a
    #[arg(long, value_name = "CHANNEL")]
    channel: Option<char>,
    /// What a PNG shows as black and as white; without it 0,1, and of a heat map from 0 to the
    /// largest count
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true)]
    range: Option<String>,
    /// Show one channel of a PNG in colours instead of greys
    #[arg(long, visible_alias = "false-color")]
    false_colour: bool,
    /// Print what each pass did to a pixel, counted from the upper left corner
    #[arg(long, value_name = "X,Y")]
    pixel: Option<String>,
    /// Name the first pass that leaves a value that is no number, or infinite
    #[arg(long)]
    find_nan: bool,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Runs the command.
///
/// # Errors
/// Anything that keeps the frame from being drawn, or a pass or target that is not there.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let pixel = arguments.pixel.as_deref().map(pair::<u32>).transpose()?;
    let range = arguments.range.as_deref().map(pair::<f32>).transpose()?;
    if arguments.out.is_some() && arguments.target.is_none() && arguments.heat_map.is_none() {
        return Err(Usage(
            "say what to write to --out: --target NAME or --heat-map WHAT".to_owned(),
        )
        .into());
    }
    if arguments.out.is_none() && pixel.is_none() && !arguments.find_nan {
        return Err(Usage(
            "say what to look at: --target NAME --out FILE, --heat-map WHAT --out FILE, --pixel X,Y or \
             --find-nan".to_owned(),
        )
        .into());
    }
    if let Some(out) = &arguments.out {
        project::writable(out)?;
    }
    if let Some([x, y]) = pixel
        && (x >= arguments.size.width || y >= arguments.size.height)
    {
        let Size { width, height } = arguments.size;
        return Err(Usage(format!(
            "--pixel {x},{y} lies outside the picture of {width} x {height}; pixels are counted from 0"
        ))
        .into());
    }
    let progress = Progress::new();
    let mut scene_arguments = arguments.scene_arguments.clone();
    if let Some(map) = &arguments.heat_map {
        let set = &mut scene_arguments.set;
        set.push(format!("pipeline.{}={map}", heat_map::PARAMETER));
    }
    let request = Request {
        scene: &arguments.scene,
        arguments: &scene_arguments,
        pipelines: std::slice::from_ref(&arguments.pipeline),
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
    for frame in 1..=arguments.frame {
        let time = f64::from(frame) * STEP;
        scene
            .update(time, STEP)
            .map_err(|problem| report::problems(&files, problem))?;
    }
    scene.refresh();
    load::tell(&files, &mut scene);
    let desc = pipeline.desc.clone();
    let pass = arguments.pass.as_deref();
    let unknown = |unknown: Unknown| Usage(unknown.to_string());
    let pass = pass.map(|pass| find_pass(&desc, pass).map_err(unknown));
    let pass = pass.transpose()?;

    let size = arguments.size.into();
    let mut inspector = FrameInspector::new(
        &mut renderer,
        &files,
        &mut scene,
        pipeline,
        size,
        arguments.frame,
    );
    if let (Some(target), Some(out)) = (&arguments.target, &arguments.out) {
        let pass = match pass {
            Some(pass) => pass,
            None => last_writer(&desc, target).map_err(unknown)?,
        };
        let part = Part {
            slice: Slice {
                mip: arguments.mip,
                layer: arguments.layer,
            },
            sample: arguments.sample,
            aspect: if arguments.stencil {
                Aspect::Stencil
            } else {
                Aspect::Main
            },
        };
        let image = inspector.target(pass, target, part)?;
        let shown = Shown {
            channel: arguments.channel.map(channel).transpose()?,
            range: range.unwrap_or([0.0, 1.0]),
            false_colour: arguments.false_colour,
        };
        save(&image, shown, out)?;
        say(out.display().to_string())?;
    }
    if let (Some(map), Some(out), Some(counts)) = (HeatMap::of(&desc), &arguments.out, &desc.hdr) {
        let image = inspector.target(desc.passes.len() - 1, &counts.name, Part::default())?;
        save_heat_map(map, &image, range.map(|[_, most]| most), out)?;
    }
    if let Some([x, y]) = pixel {
        print_history(&mut inspector, &desc, (x, y))?;
    }
    if arguments.find_nan {
        match inspector.first_invalid()? {
            None => say("every value that a pass writes is a finite number")?,
            Some(found) => say(format!(
                "the pass `{}` leaves {:?} in `{}`{} at {},{}; {} texels of it are no numbers",
                found.pass,
                found.value,
                found.place.target,
                part_in_words(found.place.slice, found.place.sample, Aspect::Main),
                found.place.first.0,
                found.place.first.1,
                found.place.texels
            ))?,
        }
    }
    drop(inspector);
    for warning in renderer.take_warnings() {
        warn(warning);
    }
    Ok(())
}

/// Two numbers with a comma between.
fn pair<T: std::str::FromStr>(text: &str) -> Result<[T; 2], Usage> {
    let parts = text.split_once(',').and_then(|(a, b)| {
        let (a, b) = (a.trim().parse().ok()?, b.trim().parse().ok()?);
        Some([a, b])
    });
    parts.ok_or_else(|| {
        Usage(format!(
            "`{text}`: write two numbers with a comma, as in 3,4"
        ))
    })
}

fn channel(letter: char) -> Result<usize, Usage> {
    "rgba"
        .find(letter)
        .ok_or_else(|| Usage(format!("--channel {letter}: write r, g, b or a")))
}

fn save(image: &TargetImage, shown: Shown, path: &Path) -> anyhow::Result<()> {
    let bytes = encode(&path.display().to_string(), image, shown)?;
    write_atomic(path, &bytes)?;
    Ok(())
}

/// Writes counts, and says how many there are.
fn save_heat_map(
    map: HeatMap,
    counts: &TargetImage,
    most: Option<f32>,
    path: &Path,
) -> anyhow::Result<()> {
    let values: Vec<f32> = counts.texels.iter().map(|texel| texel[0]).collect();
    let largest = values.iter().copied().fold(0.0, f32::max);
    let sum: f64 = values.iter().copied().map(f64::from).sum();
    if path.extension().is_some_and(|ending| ending == "exr") {
        let shown = Shown {
            channel: Some(0),
            ..Shown::default()
        };
        save(counts, shown, path)?;
    } else {
        let plane = Plane {
            width: counts.width as usize,
            height: counts.height as usize,
            values,
        };
        let scale = most.unwrap_or(largest).max(1.0);
        let picture = heat_map_with_legend(&plane, ColorMap::Viridis, scale);
        save_png(
            path,
            picture.width,
            picture.height,
            &picture.pixels.concat(),
        )?;
    }
    say(path.display().to_string())?;
    say(format!(
        "{}: {:.2} a pixel in the mean, {largest} at most",
        map.title(),
        sum / counts.texels.len().max(1) as f64
    ))
}

/// One line for each pass and what it wrote.
fn print_history(
    inspector: &mut FrameInspector<'_>,
    desc: &PipelineDesc,
    pixel: (u32, u32),
) -> anyhow::Result<()> {
    let lines: Vec<[String; 3]> = inspector
        .history(pixel)?
        .iter()
        .map(|value| {
            let after = value.after.in_words(value.channels);
            let change = match value.before.map(|before| before.in_words(value.channels)) {
                None => after,
                Some(before) if before == after => format!("{after}  (unchanged)"),
                Some(before) => format!("{before}  ->  {after}"),
            };
            let part = part_in_words(value.slice, value.sample, value.aspect);
            let pass = desc.passes[value.pass].name.clone();
            [pass, format!("{}{part}", value.target), change]
        })
        .collect();
    let width = |column: usize| lines.iter().map(|line| line[column].len()).max();
    let (pass_width, target_width) = (width(0).unwrap_or(0), width(1).unwrap_or(0));
    for [pass, target, change] in &lines {
        say(format!(
            "{pass:pass_width$}  {target:target_width$}  {change}"
        ))?;
    }
    Ok(())
}
