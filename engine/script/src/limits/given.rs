//! Limits that somebody sets: in a project's file, or from the command line for all projects.

use std::sync::OnceLock;
use std::time::Duration;

use lightbench_assets::files::{Files, PROJECT_MARKER};
use lightbench_render::{Place, Problem};
use serde::Deserialize;

use super::Limits;

/// Limits of a file, over those of [`Limits::default`]:
///
/// ```
/// use lightbench_script::GivenLimits;
///
/// let given = GivenLimits::read("exam.toml", "[limits]\nload_seconds = 2\nentities = 5000\n")?;
/// # Ok::<(), lightbench_render::Problem>(())
/// ```
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct GivenLimits {
    operations: Option<u64>,
    call_depth: Option<usize>,
    nesting: Option<usize>,
    text_bytes: Option<usize>,
    array_elements: Option<usize>,
    map_entries: Option<usize>,
    variables: Option<usize>,
    functions: Option<usize>,
    modules: Option<usize>,
    file_bytes: Option<usize>,
    load_seconds: Option<f64>,
    update_seconds: Option<f64>,
    memory_bytes: Option<usize>,
    entities: Option<usize>,
    triangles: Option<usize>,
}

/// A file with limits, which may hold other things too.
#[derive(Default, Deserialize)]
struct File {
    limits: Option<GivenLimits>,
}

/// Those that count for every project.
static IMPOSED: OnceLock<GivenLimits> = OnceLock::new();

impl GivenLimits {
    /// Reads the table `limits` of a TOML file. Without one nothing is given.
    ///
    /// # Errors
    /// A file that is no TOML, a limit that there is not, or a value that can't be one, with its line.
    pub fn read(path: &str, text: &str) -> Result<Self, Problem> {
        let wrong = |offset: usize, message: String| {
            let before = &text[..offset.min(text.len())];
            let line = before.matches('\n').count() as u32 + 1;
            let column = before.rsplit('\n').next().unwrap_or("").chars().count() as u32 + 1;
            Problem::new(Place::new(path, line, column), message).with_source(text)
        };
        let file: File = toml::from_str(text).map_err(|error| {
            let offset = error.span().map_or(0, |span| span.start);
            wrong(offset, error.message().to_owned())
        })?;
        let given = file.limits.unwrap_or_default();
        for (name, seconds) in [
            ("load_seconds", given.load_seconds),
            ("update_seconds", given.update_seconds),
        ] {
            if let Some(seconds) = seconds
                && !(0.001..=1e6).contains(&seconds)
            {
                let message = format!("`{name}` must be from 0.001 to 1000000, not {seconds}");
                return Err(wrong(text.find(name).unwrap_or(0), message));
            }
        }
        Ok(given)
    }

    /// Lets these count in this program from now on, whatever a project's file says: for whoever runs
    /// the scripts of others. The first call counts.
    pub fn impose(self) {
        // A second one would let a later caller loosen what an earlier one has tightened.
        let _ = IMPOSED.set(self);
    }

    fn over(self, base: Limits) -> Limits {
        let seconds = |given: Option<f64>, base| given.map_or(base, Duration::from_secs_f64);
        Limits {
            operations: self.operations.unwrap_or(base.operations),
            call_depth: self.call_depth.unwrap_or(base.call_depth),
            nesting: self.nesting.unwrap_or(base.nesting),
            text_bytes: self.text_bytes.unwrap_or(base.text_bytes),
            array_elements: self.array_elements.unwrap_or(base.array_elements),
            map_entries: self.map_entries.unwrap_or(base.map_entries),
            variables: self.variables.unwrap_or(base.variables),
            functions: self.functions.unwrap_or(base.functions),
            modules: self.modules.unwrap_or(base.modules),
            file_bytes: self.file_bytes.unwrap_or(base.file_bytes),
            load_time: seconds(self.load_seconds, base.load_time),
            update_time: seconds(self.update_seconds, base.update_time),
            memory_bytes: self.memory_bytes.unwrap_or(base.memory_bytes),
            entities: self.entities.unwrap_or(base.entities),
            triangles: self.triangles.unwrap_or(base.triangles),
        }
    }
}

impl Limits {
    /// The limits for the scripts of a project: these, those of its file `lightbench.toml` over them,
    /// and over both what was imposed.
    ///
    /// # Errors
    /// What is wrong with the project's file.
    pub fn in_project(self, files: &Files) -> Result<Self, Problem> {
        let mut limits = self;
        let file = files.project().map(|folder| folder.join(PROJECT_MARKER));
        // Without a file nothing is given.
        if let Some(text) = file.and_then(|file| std::fs::read_to_string(file).ok()) {
            limits = GivenLimits::read(PROJECT_MARKER, &text)?.over(limits);
        }
        if let Some(imposed) = IMPOSED.get() {
            limits = imposed.over(limits);
        }
        Ok(limits)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::testing::project;
    use crate::{Settings, load_scene};

    #[test]
    fn every_limit_can_be_given() {
        let text = "title = \"mine\"\n[limits]\noperations = 1\ncall_depth = 2\nnesting = 3\n\
                    text_bytes = 4\narray_elements = 5\nmap_entries = 6\nvariables = 7\n\
                    functions = 8\nmodules = 9\nfile_bytes = 10\nload_seconds = 11\n\
                    update_seconds = 0.5\nmemory_bytes = 13\nentities = 14\ntriangles = 15\n";
        let limits = GivenLimits::read("a.toml", text)
            .unwrap()
            .over(Limits::default());
        let expected = Limits {
            operations: 1,
            call_depth: 2,
            nesting: 3,
            text_bytes: 4,
            array_elements: 5,
            map_entries: 6,
            variables: 7,
            functions: 8,
            modules: 9,
            file_bytes: 10,
            load_time: Duration::from_secs(11),
            update_time: Duration::from_millis(500),
            memory_bytes: 13,
            entities: 14,
            triangles: 15,
        };
        assert_eq!(limits, expected);
    }

    #[test]
    fn a_projects_limits_hold_its_scripts() {
        let script = "for i in 0..20 { spawn(); }";
        let load = |limits: &str| {
            let (_folder, files) = project(&[
                ("scripts/scenes/test.rhai", script),
                ("lightbench.toml", limits),
            ]);
            load_scene(&files, "test", &Settings::new(), &Default::default())
                .map(drop)
                .map_err(|problems| problems.to_string())
        };
        load("").unwrap();
        load("[limits]\nentities = 30\n").unwrap();
        let error = load("[limits]\nentities = 5\n").unwrap_err();
        assert!(error.contains("the scene has 5 entities"), "{error}");
        let error = load("[limits]\n\nentitys = 5\n").unwrap_err();
        assert!(error.contains("lightbench.toml:3:1"), "{error}");
        assert!(error.contains("`entitys`"), "{error}");
        let error = load("[limits]\nload_seconds = -1\n").unwrap_err();
        assert!(error.contains("lightbench.toml:2"), "{error}");
        let error = load("[limits\n").unwrap_err();
        assert!(error.contains("lightbench.toml:1"), "{error}");
    }
}
