//! `lightbench compare`: pipelines measured on one scene.

use std::env;
use std::path::{Path, PathBuf};

use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::diff::DiffOptions;
use lightbench::lab::measure::{Inputs, MeasureError, MeasureOptions, Measurement, measure};
use lightbench::lab::report::analysis::{Analysis, samples};
use lightbench::lab::report::format::{bytes, milliseconds};
use lightbench::lab::report::summary::{clock_name, summarize};
use lightbench::lab::report::{Adapter, Comparison, Machine, Parameter, SCHEMA, write_report};
use lightbench::lab::statistics::Summary;
use lightbench::render::problem::suggestion;
use lightbench::script::list_pipelines;

use super::arguments::{GpuArguments, SceneArguments, Size};
use super::load::{self, Request, Stage};
use super::progress::Bar;
use super::project;
use super::report::{self, Stopped, Usage, say, warn};

/// Arguments of `lightbench compare`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench compare atrium --out report
  lightbench compare many_lights --pipelines forward_single_pass,deferred_shading \\
      --set lights=256 --size 1280x720 --frames 100 --out report
  lightbench compare atrium --pipelines deferred_shading,mine.rhai --set mine.samples=4 --out report

The report is one HTML file that needs nothing else, with the same numbers as JSON and CSV and the
pictures beside it. Ctrl-C ends the measurement early and keeps what was measured.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai file
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The pipelines, separated by commas; without it, all that there are
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    pipelines: Vec<String>,
    /// The pipeline whose picture the others are compared with; the first without it
    #[arg(long, value_name = "PIPELINE")]
    reference: Option<String>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// How many frames to measure of each pipeline; six are the least for an interval
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// How many frames to draw before, which are not measured
    #[arg(long, value_name = "N", default_value_t = 5)]
    warmup: u32,
    /// The folder for the report; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Runs the command.
///
/// # Errors
/// Anything that keeps the report from being made.
pub fn run(arguments: &Arguments, files: Files) -> anyhow::Result<()> {
    let report_file = arguments.out.join("report.html");
    project::writable(&report_file)?;
    let inputs = Inputs::new();
    let mut files = inputs.watch(&files);
    let pipelines = chosen(&arguments.pipelines, &files)?;
    let progress = Progress::new();
    let request = Request {
        scene: &arguments.scene,
        arguments: &arguments.scene_arguments,
        pipelines: &pipelines,
        gpu: &arguments.gpu,
    };
    let mut stage = load::stage(&mut files, &request, &progress)?;
    let reference = reference(arguments, &stage)?;

    let options = MeasureOptions {
        size: arguments.size.into(),
        warmup: arguments.warmup,
        frames: arguments.frames,
    };
    let bar = Bar::follow(&progress);
    let measured = measure(
        &mut stage.renderer,
        &mut stage.scene,
        &mut stage.pipelines,
        options,
        &progress,
    );
    drop(bar);
    load::tell(&files, &mut stage.scene);
    for warning in stage.renderer.take_warnings() {
        warn(warning);
    }
    let measured = measured.map_err(|error| match error {
        MeasureError::Cancelled(_) => anyhow::Error::from(Stopped),
        MeasureError::Script(problem) => report::problems(&files, problem),
        other => other.into(),
    })?;
    let stopped = measured.frames < arguments.frames;
    if stopped {
        warn(format!(
            "stopped after {} of {} frames; the report holds these",
            measured.frames, arguments.frames
        ));
    }

    let mut comparison = describe(arguments, &stage, reference, &measured);
    comparison.inputs = inputs.list(&files);
    comparison.pipelines = measured.pipelines;
    comparison.compare_pictures(|name| measured.linear.get(name), DiffOptions::default())?;
    write_report(&mut comparison, &arguments.out)?;
    print(&comparison)?;
    say(report_file.display().to_string())?;
    if stopped { Err(Stopped.into()) } else { Ok(()) }
}

/// The pipelines that were named, or all.
pub(super) fn chosen(named: &[String], files: &Files) -> anyhow::Result<Vec<String>> {
    let mut chosen: Vec<String> = Vec::new();
    for name in named.iter().map(|name| name.trim()) {
        if name.is_empty() {
            return Err(
                Usage("--pipelines has an empty name; write it as a,b,c".to_owned()).into(),
            );
        }
        if chosen.iter().any(|known| known == name) {
            return Err(Usage(format!("--pipelines names `{name}` twice")).into());
        }
        chosen.push(name.to_owned());
    }
    if chosen.is_empty() {
        let entries = list_pipelines(files)?.into_iter();
        chosen.extend(entries.filter(|e| e.problem.is_none()).map(|e| e.name));
    }
    Ok(chosen)
}

fn reference(arguments: &Arguments, stage: &Stage) -> Result<String, Usage> {
    let names = || {
        stage
            .pipelines
            .iter()
            .map(|pipeline| pipeline.desc.name.as_str())
    };
    let mut seen = std::collections::HashSet::new();
    if let Some(twice) = names().find(|name| !seen.insert(*name)) {
        return Err(Usage(format!(
            "two of the pipelines are called `{twice}`; rename one file"
        )));
    }
    let wanted = arguments.reference.as_deref().map(|wanted| {
        // A path means the pipeline that it declares.
        let stem = Path::new(wanted).file_stem().and_then(|stem| stem.to_str());
        stem.filter(|_| wanted.ends_with(".rhai")).unwrap_or(wanted)
    });
    match wanted {
        None => Ok(names().next().unwrap_or_default().to_owned()),
        Some(wanted) if names().any(|name| name == wanted) => Ok(wanted.to_owned()),
        Some(wanted) => {
            let hint = suggestion(wanted, names())
                .unwrap_or_else(|| "name one of those in --pipelines".to_owned());
            Err(Usage(format!(
                "--reference {wanted}: it is not measured; {hint}"
            )))
        }
    }
}

/// All of the report but its results.
fn describe(
    arguments: &Arguments,
    stage: &Stage,
    reference: String,
    measured: &Measurement,
) -> Comparison {
    let scene = scene_name(&stage.scene.path);
    let parameters = stage.scene.parameters.iter().map(|parameter| Parameter {
        name: parameter.name.clone(),
        value: parameter.value.to_string(),
    });
    Comparison {
        schema: SCHEMA,
        title: format!("{scene}: {} pipelines", measured.pipelines.len()),
        scene,
        command_line: this_command(),
        created: now(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        machine: Machine::this(),
        adapter: Adapter::from(&stage.renderer.gpu().summary),
        size: [arguments.size.width, arguments.size.height],
        frames: measured.frames,
        warmup_frames: arguments.warmup,
        processes: Vec::new(),
        reference,
        parameters: parameters.collect(),
        seeds: Vec::new(),
        inputs: Vec::new(),
        pipelines: Vec::new(),
        heat_map_scale: 1.0,
    }
}

/// A scene's name from its path.
pub(super) fn scene_name(path: &str) -> String {
    let file = path.rsplit('/').next().unwrap_or_default();
    file.strip_suffix(".rhai").unwrap_or(file).to_owned()
}

/// The time, RFC 3339.
pub(super) fn now() -> String {
    let now = jiff::Timestamp::now();
    now.strftime("%Y-%m-%dT%H:%M:%SZ").to_string()
}

/// The command that is running, as a POSIX shell takes it again.
pub(super) fn this_command() -> String {
    let arguments = env::args_os().skip(1);
    command_line(arguments.map(|a| a.to_string_lossy().into_owned()))
}

/// A command as a POSIX shell takes it again.
fn command_line(arguments: impl Iterator<Item = String>) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./,=:+@%".contains(c);
    let mut line = "lightbench".to_owned();
    for argument in arguments {
        line.push(' ');
        if !argument.is_empty() && argument.chars().all(plain) {
            line.push_str(&argument);
        } else {
            line.push_str(&format!("'{}'", argument.replace('\'', r"'\''")));
        }
    }
    line
}

/// The summary and a small table.
fn print(comparison: &Comparison) -> anyhow::Result<()> {
    let analysis = Analysis::of(comparison);
    for statement in summarize(comparison, &analysis) {
        say(statement.text)?;
    }
    say("")?;
    let clock = clock_name(comparison, analysis.clock);
    let names = comparison.pipelines.iter().map(|p| p.name.chars().count());
    let width = names.max().unwrap_or(0).max("pipeline".len());
    say(format!(
        "{:<width$}  {:>10}  {:>10}  {:>12}  {:>10}",
        "pipeline", "median", "p95", "targets", "FLIP mean"
    ))?;
    for pipeline in &comparison.pipelines {
        let times = Summary::of(samples(pipeline, analysis.clock));
        let time = |pick: fn(Summary) -> f64| {
            times.map_or_else(|| "n/a".to_owned(), |times| milliseconds(pick(times)))
        };
        let flip = match &pipeline.difference {
            Some(difference) => format!("{:.4}", difference.flip.mean),
            None => "reference".to_owned(),
        };
        say(format!(
            "{:<width$}  {:>10}  {:>10}  {:>12}  {:>10}",
            pipeline.name,
            time(|t| t.median),
            time(|t| t.p95),
            bytes(pipeline.target_bytes_total),
            flip
        ))?;
    }
    say(format!("Times are {clock} of a frame.\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_can_be_typed_again() {
        let words = ["compare", "a b", "--out", "práctica/x", "it's", ""].map(str::to_owned);
        assert_eq!(
            command_line(words.into_iter()),
            r"lightbench compare 'a b' --out práctica/x 'it'\''s' ''"
        );
    }
}
