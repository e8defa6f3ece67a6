//! Experiments: `scripts/experiments/*.rhai` draw frames, look into them and say what they found.

mod bench;
mod checks;
mod frames;
mod images;
mod laboratory;
mod measuring;
mod options;
mod plots;
mod saying;
mod studies;
#[cfg(test)]
mod tests;

use std::time::Duration;

use lightbench_assets::Progress;
use lightbench_assets::cache::Reuse;
use lightbench_assets::files::Files;
use lightbench_render::inspect::{FirstInvalid, Part, PixelValue, Shown};
use lightbench_render::{PipelineDesc, Problems, TargetImage};

use crate::host::{Extras, Host, Variables, find};
use crate::limits::Limits;
use crate::log::LogLine;
use crate::names::Names;
use crate::parameters;
use crate::settings::Settings;
use bench::Bench;

pub use checks::{
    Bound, CheckFault, CheckScript, Data, Evidence, Examiner, Expected, Given, Told, check_names,
};
pub use laboratory::{
    Chart, ChartCurve, Cost, Laboratory, LaboratoryError, Shot, StudyRow, StudyTask, Task, TimeSpan,
};

/// The folder of the experiments.
pub const EXPERIMENTS: &str = "scripts/experiments";

/// An experiment may compute for a while: nobody waits for the next frame.
fn limits() -> Limits {
    Limits {
        operations: 1_000_000_000,
        load_time: Duration::from_secs(300),
        memory_bytes: 1 << 30,
        ..Limits::default()
    }
}

/// Runs an experiment to its end.
///
/// `name_or_path` is a name as in `compare_culling`, or a path from the project's folder. `settings`
/// gives values to the parameters that the file declares. Each line that the script prints goes to
/// `print` at once. What the laboratory does takes none of the script's time; `progress` stops the
/// script.
///
/// # Errors
/// What is wrong with the file, or what went wrong in it, with its place: also an assertion that
/// does not hold; and every setting that the experiment does not have.
pub fn run_experiment(
    files: &Files,
    name_or_path: &str,
    settings: &Settings,
    laboratory: Box<dyn Laboratory>,
    print: impl Fn(LogLine) + Send + Sync + 'static,
    progress: &Progress,
) -> Result<(), Problems> {
    let path = find(files, EXPERIMENTS, name_or_path)?;
    let limits = limits().in_project(files)?;
    let (host, bench) = host(files, &path, settings, laboratory, &limits);
    host.watch.stop_with(progress);
    host.log.pass_on(print);
    let ast = host.load(&path)?;
    host.run(&ast, &path, limits.load_time).map(drop)?;
    match bench.map(|bench| bench.undeclared(&path)) {
        Some(problems) if !problems.is_empty() => Err(Problems(problems)),
        _ => Ok(()),
    }
}

/// The names of everything that experiments can call.
#[must_use]
pub fn experiment_names() -> Names {
    let (files, settings) = (Files::shipped(), Settings::new());
    let (host, _) = host(&files, "", &settings, Box::new(Nobody), &limits());
    host.compiler.names.clone()
}

fn host(
    files: &Files,
    path: &str,
    settings: &Settings,
    laboratory: Box<dyn Laboratory>,
    limits: &Limits,
) -> (Host, Option<Bench>) {
    let (mut laboratory, mut made) = (Some(laboratory), None);
    let host = Host::new(
        files,
        limits,
        Extras {
            register: &mut |api, watch, _| {
                let Some(laboratory) = laboratory.take() else {
                    return;
                };
                let bench = Bench::new(laboratory, watch, files, settings);
                frames::register(api, &bench, path);
                images::register(api);
                measuring::register(api, &bench, path);
                studies::register(api, &bench, path);
                plots::register(api, &bench);
                saying::register(api);
                api.section("Parameters");
                let declaring = bench.clone();
                parameters::register(api, move |arguments| declaring.declare(arguments));
                made = Some(bench);
            },
            globals: Vec::new(),
            variables: Variables::default(),
            reuse: Reuse::default(),
        },
    );
    (host, made)
}

/// A laboratory for who only asks for names.
struct Nobody;

impl Nobody {
    fn refuse<T>() -> Result<T, LaboratoryError> {
        Err(LaboratoryError::Other("nothing can be drawn here".into()))
    }
}

impl Laboratory for Nobody {
    fn draw(&mut self, _: &Shot) -> Result<PipelineDesc, LaboratoryError> {
        Self::refuse()
    }

    fn target(
        &mut self,
        _: &Shot,
        _: usize,
        _: &str,
        _: Part,
    ) -> Result<TargetImage, LaboratoryError> {
        Self::refuse()
    }

    fn pixel(&mut self, _: &Shot, _: (u32, u32)) -> Result<Vec<PixelValue>, LaboratoryError> {
        Self::refuse()
    }

    fn first_invalid(&mut self, _: &Shot) -> Result<Option<FirstInvalid>, LaboratoryError> {
        Self::refuse()
    }

    fn measure(&mut self, _: &Task) -> Result<Vec<Cost>, LaboratoryError> {
        Self::refuse()
    }

    fn study(&mut self, _: &StudyTask) -> Result<Vec<StudyRow>, LaboratoryError> {
        Self::refuse()
    }

    fn compare(
        &self,
        _: &TargetImage,
        _: &TargetImage,
    ) -> Result<Vec<(&'static str, f64)>, LaboratoryError> {
        Self::refuse()
    }

    fn plot(&self, _: &Chart) -> Vec<u8> {
        Vec::new()
    }

    fn values(&mut self, _: &Shot, _: &str) -> Result<Vec<f64>, LaboratoryError> {
        Self::refuse()
    }

    fn encode(&self, _: &str, _: &TargetImage, _: Shown) -> Result<Vec<u8>, LaboratoryError> {
        Self::refuse()
    }
}
