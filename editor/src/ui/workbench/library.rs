//! The pipelines and scenes that can be chosen.

use std::collections::BTreeMap;

use lightbench::assets::Task;
use lightbench::assets::files::Files;
use lightbench::script::{PipelineEntry, SceneEntry, list_pipelines, list_scenes};

use super::Wake;

/// What the selectors list. Reading it evaluates every pipeline file, so a thread does it.
#[derive(Default)]
pub struct Library {
    /// By name.
    pub pipelines: Vec<PipelineEntry>,
    /// What each pipeline is for, by its name.
    purposes: BTreeMap<String, String>,
    /// By name.
    pub scenes: Vec<SceneEntry>,
    reading: Option<Task<Lists>>,
    again: bool,
}

type Lists = (
    Result<(Vec<PipelineEntry>, BTreeMap<String, String>), String>,
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
                list_pipelines(&files)
                    .map(|entries| {
                        let purposes = purposes(&files, &entries);
                        (entries, purposes)
                    })
                    .map_err(|error| error.to_string()),
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
                    Ok((pipelines, purposes)) => {
                        self.pipelines = pipelines;
                        self.purposes = purposes;
                    }
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

    /// What a pipeline is for: the first sentence of its file's header.
    pub fn purpose(&self, name: &str) -> &str {
        self.purposes.get(name).map_or("", String::as_str)
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

/// The first sentence of each pipeline's header, or what it says of itself where it has no header.
fn purposes(files: &Files, entries: &[PipelineEntry]) -> BTreeMap<String, String> {
    let purpose = |entry: &PipelineEntry| {
        let text = files.read_text(&entry.path).unwrap_or_default();
        let sentence = header_sentence(&text);
        let sentence = sentence.unwrap_or_else(|| entry.description.clone());
        (entry.name.clone(), sentence)
    };
    entries.iter().map(purpose).collect()
}

/// The first sentence of a file's header, behind the line with its title.
fn header_sentence(text: &str) -> Option<String> {
    let header = text.lines().map_while(|line| line.strip_prefix("//"));
    let lines = header.map(|line| line.trim_start_matches('/').trim());
    // The title is a paragraph of its own.
    let lines = lines.skip_while(|line| !line.is_empty());
    let lines = lines.skip_while(|line| line.is_empty());
    let paragraph: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
    let paragraph = paragraph.join(" ");
    let end = paragraph.find(". ").map_or(paragraph.len(), |dot| dot + 1);
    let sentence = paragraph[..end].trim();
    (!sentence.is_empty()).then(|| sentence.to_owned())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_first_sentence_of_a_header_may_go_over_lines() {
        let text = "// Title.\n//\n// First goes\n// on. Second.\n//\n// Trades: 3.\nlet p = 1;";
        assert_eq!(header_sentence(text).unwrap(), "First goes on.");
        assert_eq!(header_sentence("// Only a title.\nlet p = 1;"), None);
        assert_eq!(header_sentence("// T\n//\n// No end").unwrap(), "No end");
        assert_eq!(header_sentence(""), None);
    }

    #[test]
    fn every_shipped_pipeline_says_what_it_is_for() {
        let files = Files::shipped();
        for entry in list_pipelines(&files).unwrap() {
            let text = files.read_text(&entry.path).unwrap();
            let sentence = header_sentence(&text).unwrap_or_default();
            assert!(sentence.len() > 20, "{}: {sentence}", entry.name);
        }
    }
}
