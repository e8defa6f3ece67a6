//! `lightbench bench pipelines`: what a frame costs as a parameter of the scene grows.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::curves::{Curves, Head, Sweep, SweepError, plot, sweep, table};
use lightbench::lab::files::write_atomically;
use lightbench::lab::measure::{MeasureError, MeasureOptions};
use lightbench::lab::report::format::significant;
use lightbench::lab::report::{Adapter, Machine};
use lightbench::render::{Gpu, Renderer};

use super::arguments::{GpuArguments, SceneArguments, Size};
use super::load::{self, Request};
use super::progress::{Bar, stop_on_ctrl_c};
use super::project;
use super::report::{self, Stopped, Usage, say, warn};
use super::study::plan::chosen;
use super::study::{now, scene_name, this_command};

/// Arguments of `lightbench bench pipelines`.
#[derive(Args, Debug)]
pub struct PipelinesArguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a file
    #[arg(value_name = "SCENE", default_value = "many_lights")]
    scene: String,
    /// A parameter of the scene and the values that it takes, in ascending order
    #[arg(
        long,
        value_name = "NAME=A,B,…",
        default_value = "lights=4,16,64,256,1024,4096"
    )]
    sweep: Values,
    /// The pipelines, separated by commas; without it, all that there are
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    pipelines: Vec<String>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// Frames measured at each point; six are the least for an interval
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Frames drawn before, which are not measured
    #[arg(long, value_name = "N", default_value_t = 1)]
    warmup: u32,
    /// A pipeline whose frame takes longer is not measured at larger values
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    patience: f64,
    /// The folder for NAME.csv and NAME.svg, after the parameter; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// `lights=4,16,64`.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Values {
    parameter: String,
    values: Vec<u32>,
}

impl FromStr for Values {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a sweep is written as a parameter and whole numbers in ascending order, as in \
                    lights=4,16,64";
        let (name, list) = text.split_once('=').ok_or(form)?;
        let values: Result<Vec<u32>, _> = list.split(',').map(|v| v.trim().parse()).collect();
        let values = values.map_err(|_| form)?;
        let name = name.trim();
        // The name becomes that of a file.
        let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if name.is_empty() || !plain || !values.is_sorted_by(|a, b| a < b) {
            return Err(form.to_owned());
        }
        Ok(Self {
            parameter: name.to_owned(),
            values,
        })
    }
}

/// Runs the command.
///
/// # Errors
/// Anything that keeps the curves from being measured or written.
pub fn run(arguments: &PipelinesArguments, mut files: Files) -> anyhow::Result<()> {
    let Values { parameter, values } = &arguments.sweep;
    let place = |extension: &str| arguments.out.join(parameter).with_extension(extension);
    project::writable(&place("csv"))?;
    let pipelines = chosen(&arguments.pipelines, &files)?;
    let request = Request {
        scene: &arguments.scene,
        arguments: &arguments.scene_arguments,
        pipelines: &pipelines,
        gpu: &arguments.gpu,
    };
    let scripts = load::scripts(&mut files, &request)?;
    if scripts.scene_settings.get(parameter).is_some() {
        return Err(Usage(format!(
            "`{parameter}` is swept, so --set can't give it a value"
        ))
        .into());
    }
    let wanted = Sweep {
        scene: scripts.scene.clone(),
        settings: scripts.scene_settings.clone(),
        parameter: parameter.clone(),
        values: values.clone(),
        pipelines: scripts.pipelines.clone(),
        options: MeasureOptions {
            size: arguments.size.into(),
            warmup: arguments.warmup,
            frames: arguments.frames,
            ..MeasureOptions::default()
        },
        patience: arguments.patience,
    };
    let mut renderer = Renderer::new(Gpu::open(&arguments.gpu.options())?);
    let progress = Progress::new();
    stop_on_ctrl_c(&progress);
    let bar = Bar::follow(&progress);
    let swept = sweep(&mut renderer, &files, &wanted, &progress);
    drop(bar);
    for warning in renderer.take_warnings() {
        warn(warning);
    }
    let swept = swept.map_err(|error| match error {
        SweepError::Cancelled(_) | SweepError::Measure(MeasureError::Cancelled(_)) => {
            Stopped.into()
        }
        SweepError::Problems(problems) => report::problems(&files, problems),
        SweepError::Measure(MeasureError::Script(problem)) => report::problems(&files, problem),
        other => anyhow::Error::from(other),
    })?;

    let settings = wanted.settings.iter();
    let curves = Curves {
        head: Head {
            scene: scene_name(&wanted.scene),
            settings: settings
                .map(|(name, value)| format!("{name}={value}"))
                .collect(),
            parameter: parameter.clone(),
            about: swept.about,
            machine: Machine::this(),
            adapter: Adapter::from(&renderer.gpu().summary),
            size: arguments.size.into(),
            frames: arguments.frames,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: this_command(),
            created: now(),
        },
        curves: swept.curves,
    };
    write_atomically(&place("csv"), table(&curves).as_bytes())?;
    write_atomically(&place("svg"), plot(&curves).as_bytes())?;
    print(&curves, values)?;
    say(format!(
        "{}\n{}",
        place("csv").display(),
        place("svg").display()
    ))
}

/// Medians in a small table: a row a pipeline, a column a value.
fn print(curves: &Curves, values: &[u32]) -> anyhow::Result<()> {
    let names = curves
        .curves
        .iter()
        .map(|curve| curve.pipeline.chars().count());
    let width = names
        .max()
        .unwrap_or(0)
        .max(curves.head.parameter.chars().count());
    let mut line = format!("{:<width$}", curves.head.parameter);
    values
        .iter()
        .for_each(|value| line += &format!("{value:>9}"));
    say(line)?;
    for curve in &curves.curves {
        let mut line = format!("{:<width$}", curve.pipeline);
        for value in values {
            let point = curve.points.iter().find(|point| point.at == *value);
            let time = point.and_then(|point| point.gpu);
            let time = time.map_or_else(|| "-".to_owned(), |time| significant(time.median));
            line += &format!("{time:>9}");
        }
        if let Some(end) = &curve.end {
            line += &format!("  {}", end.in_words());
        }
        say(line)?;
    }
    say(format!("Times are {}, ms.", curves.head.clock()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_sweep_is_a_name_and_ascending_numbers() {
        let read: Values = "lights=4, 16,64".parse().unwrap();
        assert_eq!(
            (read.parameter.as_str(), &read.values[..]),
            ("lights", &[4, 16, 64][..])
        );
        for text in [
            "",
            "lights",
            "lights=",
            "=4",
            "lights=4,4",
            "lights=9,4",
            "a/b=1",
            "l=1.5",
        ] {
            assert!(
                text.parse::<Values>().unwrap_err().contains("ascending"),
                "{text}"
            );
        }
    }
}
