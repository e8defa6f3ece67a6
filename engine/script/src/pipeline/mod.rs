//! Pipeline files: `scripts/pipelines/*.rhai` become [`PipelineDesc`]s.

mod buffers;
mod builder;
mod parameters;
mod passes;
mod targets;

use std::sync::Arc;
use std::time::Duration;

use lightbench_assets::cache::Reuse;
use lightbench_assets::files::{Files, Origin};
use lightbench_render::{PipelineDesc, Problem, Problems};
use rhai::AST;

use crate::host::{Extras, Host, Variables, find, stem_in};
use crate::limits::Limits;
use crate::names::Names;
use crate::settings::Settings;
use builder::Pipelines;

/// The folder of the pipeline files.
pub const PIPELINES: &str = "scripts/pipelines";

/// Evaluates a pipeline file.
///
/// `name_or_path` is a name as in `deferred_shading`, or a path from the project's folder.
/// `settings` gives values to the parameters that the file declares.
///
/// # Errors
/// Every mistake that the file makes, not only the first, each with its place; and every setting
/// that the pipeline does not have or that it refuses.
pub fn load_pipeline(
    files: &Files,
    name_or_path: &str,
    settings: &Settings,
) -> Result<PipelineDesc, Problems> {
    let limits = Limits::default().in_project(files)?;
    load_pipeline_within(files, name_or_path, settings, &limits)
}

/// [`load_pipeline`] with other limits.
///
/// # Errors
/// As [`load_pipeline`].
pub fn load_pipeline_within(
    files: &Files,
    name_or_path: &str,
    settings: &Settings,
    limits: &Limits,
) -> Result<PipelineDesc, Problems> {
    let path = find(files, PIPELINES, name_or_path)?;
    let workshop = Workshop::new(files, &path, settings, limits);
    workshop.run(workshop.host.load(&path))
}

/// What runs a pipeline file.
pub(crate) struct Workshop {
    host: Host,
    made: Pipelines,
    path: String,
    load_time: Duration,
}

impl Workshop {
    pub(crate) fn new(files: &Files, path: &str, settings: &Settings, limits: &Limits) -> Self {
        let made = Pipelines::new(path, settings);
        let host = Host::new(
            files,
            limits,
            Extras {
                register: &mut |api, _, _| builder::register(api, &made),
                globals: Vec::new(),
                variables: Variables::default(),
                reuse: Reuse::default(),
            },
        );
        Self {
            host,
            made,
            path: path.to_owned(),
            load_time: limits.load_time,
        }
    }

    /// The functions that a pipeline file can call.
    pub(crate) fn names(&self) -> &Names {
        &self.host.compiler.names
    }

    /// Runs a text as if it were the file.
    pub(crate) fn run_text(&self, text: &str) -> Result<PipelineDesc, Problems> {
        self.made.forget();
        self.run(self.host.compile(&self.path, text))
    }

    fn run(&self, compiled: Result<Arc<AST>, Problem>) -> Result<PipelineDesc, Problems> {
        let run = |ast: Arc<AST>| self.host.run(&ast, &self.path, self.load_time);
        self.made
            .finish(compiled.and_then(run), &self.host.compiler)
    }
}

/// A pipeline that can be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct PipelineEntry {
    /// Short name for the command line.
    pub name: String,
    /// Its file.
    pub path: String,
    /// Title for people; the name where the file has mistakes.
    pub title: String,
    /// What it trades and when to choose it.
    pub description: String,
    /// Which layer the file comes from.
    pub origin: Origin,
    /// The first mistake of a file that can't be loaded.
    pub problem: Option<Problem>,
}

/// All pipelines, those of the project over those of the program, by name.
///
/// A file with mistakes is listed too, with the first of them.
///
/// # Errors
/// A folder that can't be read.
pub fn list_pipelines(
    files: &Files,
) -> Result<Vec<PipelineEntry>, lightbench_assets::files::FileError> {
    let mut entries = Vec::new();
    for file in files.list(PIPELINES, "rhai")? {
        let Some(name) = stem_in(PIPELINES, &file.path).map(str::to_owned) else {
            continue;
        };
        let (title, description, problem) = match load_pipeline(files, &file.path, &Settings::new())
        {
            Ok(desc) => (desc.title, desc.description, None),
            Err(problems) => (name.clone(), String::new(), problems.0.into_iter().next()),
        };
        entries.push(PipelineEntry {
            name,
            path: file.path,
            title,
            description,
            origin: file.origin,
            problem,
        });
    }
    Ok(entries)
}

#[cfg(test)]
mod tests;
