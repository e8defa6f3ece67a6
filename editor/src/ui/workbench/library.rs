//! The pipelines and scenes that can be chosen.

use lightbench::assets::Task;
use lightbench::assets::files::Files;
use lightbench::script::{PipelineEntry, SceneEntry, list_pipelines, list_scenes};

use super::Wake;

/// What the selectors list. Reading it evaluates every pipeline file, so a thread does it.
#[derive(Default)]
pub struct Library {
    /// By name.
    pub pipelines: Vec<PipelineEntry>,
    /// By name.
    pub scenes: Vec<SceneEntry>,
    reading: Option<Task<Lists>>,
    again: bool,
}

type Lists = (
    Result<Vec<PipelineEntry>, String>,
    Result<Vec<SceneEntry>, String>,
);

impl Library {
    /// Reads the lists anew in the background.
    pub fn refresh(&mut self, files: &Files, wake: &Wake) {
        if self.reading.is_some() {
            self.again = true;
            return;
        }
        let (files, wake) = (files.clone(), wake.clone());
        self.reading = Task::start(move |_| {
            let lists = (
                list_pipelines(&files).map_err(|error| error.to_string()),
                list_scenes(&files).map_err(|error| error.to_string()),
            );
            wake();
            lists
        })
        .ok();
    }

    /// Takes in what was read. Returns what went wrong.
    pub fn poll(&mut self, files: &Files, wake: &Wake) -> Vec<String> {
        let Some(reading) = &self.reading else {
            return Vec::new();
        };
        let mut errors = Vec::new();
        match reading.poll() {
            Ok(None) => return errors,
            Ok(Some((pipelines, scenes))) => {
                match pipelines {
                    Ok(pipelines) => self.pipelines = pipelines,
                    Err(error) => errors.push(error),
                }
                match scenes {
                    Ok(scenes) => self.scenes = scenes,
                    Err(error) => errors.push(error),
                }
            }
            Err(lost) => errors.push(lost.to_string()),
        }
        self.reading = None;
        if std::mem::take(&mut self.again) {
            self.refresh(files, wake);
        }
        errors
    }

    /// Whether the lists are being read.
    pub fn is_busy(&self) -> bool {
        self.reading.is_some()
    }

    /// The title of a pipeline for people.
    pub fn pipeline_title<'a>(&'a self, name: &'a str) -> &'a str {
        let entry = self.pipelines.iter().find(|entry| entry.name == name);
        entry.map_or(name, |entry| entry.title.as_str())
    }

    /// A scene of the list.
    pub fn scene(&self, name: &str) -> Option<&SceneEntry> {
        self.scenes.iter().find(|entry| entry.name == name)
    }

    /// The pipeline that lies `by` places after another, around the ends.
    pub fn pipeline_beside(&self, name: &str, by: isize) -> Option<&str> {
        let count = self.pipelines.len();
        let at = self.pipelines.iter().position(|entry| entry.name == name);
        let at = match at {
            Some(at) => (at as isize + by).rem_euclid(count as isize) as usize,
            None => 0,
        };
        self.pipelines.get(at).map(|entry| entry.name.as_str())
    }
}
