//! What the editor keeps over restarts, in a file of the user's settings.

use std::collections::BTreeMap;
use std::env;
use std::path::PathBuf;

use lightbench::assets::files::write_atomic;
use serde_json::{Map, Value};

use super::arrangement::Arrangement;
use crate::ui::messages::say;

/// Lines of the console that are kept.
const MOST_LINES: usize = 200;

/// The name under which the arrangement of the window is kept.
const ARRANGEMENT: &str = "arrangement";

/// Scenes that are kept.
const MOST_SCENES: usize = 8;

/// The least and the greatest size of text and widgets.
const SCALES: (f32, f32) = (0.6, 3.0);

/// What is kept of lessons.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeptLessons {
    /// The language, by its code.
    pub language: String,
    /// The lesson that is open, by its name; may be empty.
    pub open: String,
    /// The student for whom one was begun last; may be empty.
    pub student: String,
}

/// What is kept, and where.
pub struct Kept {
    path: Option<PathBuf>,
    /// Whether there was no file yet: the editor starts for the first time.
    pub is_new: bool,
    /// Lines of the console, oldest first.
    pub console: Vec<String>,
    /// Scenes of late, the last one first: names, or paths of files outside the project.
    pub scenes: Vec<String>,
    /// The pipelines of number keys from 1, where somebody gave a key to one.
    pub favourites: BTreeMap<usize, String>,
    /// What is kept of lessons.
    pub lessons: KeptLessons,
    /// Whether the window is dark, where somebody chose that.
    pub dark: Option<bool>,
    /// How large text and widgets are, to what the system says: 1 as it says.
    pub scale: f32,
    /// How the window is arranged.
    pub arrangement: Option<Arrangement>,
    /// What other versions of the program have written, and what is not read anew.
    others: Map<String, Value>,
}

/// The file of the settings, by the habits of the system; `None` where it has no place for such.
pub fn default_path() -> Option<PathBuf> {
    let variable = |name: &str| env::var_os(name).filter(|value| !value.is_empty());
    let folder = if cfg!(windows) {
        PathBuf::from(variable("APPDATA")?)
    } else if cfg!(target_os = "macos") {
        PathBuf::from(variable("HOME")?).join("Library/Application Support")
    } else {
        match variable("XDG_CONFIG_HOME") {
            Some(folder) => PathBuf::from(folder),
            None => PathBuf::from(variable("HOME")?).join(".config"),
        }
    };
    Some(folder.join("lightbench").join("editor.json"))
}

impl Kept {
    /// Reads the file. One that is not there, or that is damaged, gives nothing.
    pub fn read(path: Option<PathBuf>) -> Self {
        let text = path
            .as_ref()
            .and_then(|path| std::fs::read_to_string(path).ok());
        let value = text.and_then(|text| serde_json::from_str(&text).ok());
        let mut others = match value {
            Some(Value::Object(map)) => map,
            _ => Map::new(),
        };
        let mut texts = |name: &str| match others.remove(name) {
            Some(Value::Array(lines)) => lines
                .into_iter()
                .filter_map(|line| line.as_str().map(str::to_owned))
                .collect(),
            _ => Vec::new(),
        };
        let (console, scenes) = (texts("console"), texts("scenes"));
        let favourites = match others.remove("favourites") {
            Some(Value::Object(map)) => map
                .into_iter()
                .filter_map(|(key, name)| {
                    let key = key.parse().ok().filter(|key| (1..=9).contains(key))?;
                    Some((key, name.as_str()?.to_owned()))
                })
                .collect(),
            _ => BTreeMap::new(),
        };
        let lessons = match others.remove("lessons") {
            Some(Value::Object(map)) => {
                let text = |name: &str| {
                    let text = map.get(name).and_then(Value::as_str);
                    text.unwrap_or_default().to_owned()
                };
                KeptLessons {
                    language: text("language"),
                    open: text("open"),
                    student: text("student"),
                }
            }
            _ => KeptLessons::default(),
        };
        let arrangement = others.get(ARRANGEMENT).and_then(Arrangement::read);
        let dark = others.remove("dark").and_then(|dark| dark.as_bool());
        let scale = others.remove("scale").and_then(|scale| scale.as_f64());
        Self {
            dark,
            scale: (scale.unwrap_or(1.0) as f32).clamp(SCALES.0, SCALES.1),
            is_new: path.as_ref().is_some_and(|path| !path.exists()),
            path,
            console,
            scenes,
            favourites,
            lessons,
            arrangement,
            others,
        }
    }

    /// The folder of texts that are not saved, beside the file.
    pub fn unsaved_folder(&self) -> Option<PathBuf> {
        Some(self.path.as_ref()?.parent()?.join("unsaved"))
    }

    /// The folder of what somebody works on, beside the file.
    pub fn recovery_folder(&self) -> Option<PathBuf> {
        Some(self.path.as_ref()?.parent()?.join("recovery"))
    }

    /// Keeps a line of the console.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. The line is there until the program ends.
    pub fn remember(&mut self, line: &str) -> Result<(), String> {
        // The same line again moves to the end.
        self.console.retain(|known| known != line);
        self.console.push(line.to_owned());
        if self.console.len() > MOST_LINES {
            self.console.remove(0);
        }
        self.write()
    }

    /// Keeps a scene as the last one.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. The scene is there until the program ends.
    pub fn remember_scene(&mut self, name: &str) -> Result<(), String> {
        if self.scenes.first().is_some_and(|first| first == name) {
            return Ok(());
        }
        self.scenes.retain(|known| known != name);
        self.scenes.insert(0, name.to_owned());
        self.scenes.truncate(MOST_SCENES);
        self.write()
    }

    /// Gives a number key, from 1 to 9, to a pipeline, which has no other one then.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. The key is there until the program ends.
    pub fn give_key(&mut self, key: usize, pipeline: &str) -> Result<(), String> {
        self.favourites.retain(|_, known| known != pipeline);
        self.favourites.insert(key, pipeline.to_owned());
        self.write()
    }

    /// Gives number keys to pipelines, and no others.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. The keys are there until the program ends.
    pub fn give_keys(&mut self, keys: BTreeMap<usize, String>) -> Result<(), String> {
        self.favourites = keys;
        self.write()
    }

    /// Keeps what is open of lessons.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. It is there until the program ends.
    pub fn remember_lessons(&mut self, lessons: KeptLessons) -> Result<(), String> {
        if self.lessons == lessons {
            return Ok(());
        }
        self.lessons = lessons;
        self.write()
    }

    /// Keeps whether the window is dark.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. The choice is there until the program ends.
    pub fn choose_dark(&mut self, dark: bool) -> Result<(), String> {
        self.dark = Some(dark);
        self.write()
    }

    /// Makes text and widgets larger by a factor, or smaller, within bounds.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. The size is there until the program ends.
    pub fn scale_by(&mut self, factor: f32) -> Result<(), String> {
        self.scale = (self.scale * factor).clamp(SCALES.0, SCALES.1);
        self.write()
    }

    /// Gives text and widgets the size that the system says.
    ///
    /// # Errors
    /// A sentence, where the file can't be written.
    pub fn reset_scale(&mut self) -> Result<(), String> {
        self.scale = 1.0;
        self.write()
    }

    /// Keeps how the window is arranged.
    ///
    /// # Errors
    /// A sentence, where the file can't be written. It holds until the program ends.
    pub fn arrange(&mut self, arrangement: Arrangement) -> Result<(), String> {
        if let Some(value) = arrangement.to_value() {
            self.others.insert(ARRANGEMENT.to_owned(), value);
        }
        self.arrangement = Some(arrangement);
        self.write()
    }

    fn write(&self) -> Result<(), String> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        let mut all = self.others.clone();
        all.insert("console".to_owned(), self.console.clone().into());
        all.insert("scenes".to_owned(), self.scenes.clone().into());
        if let Some(dark) = self.dark {
            all.insert("dark".to_owned(), dark.into());
        }
        // As text has it: 1.1 and not 1.10000002384.
        let scale = (f64::from(self.scale) * 1000.0).round() / 1000.0;
        all.insert("scale".to_owned(), scale.into());
        if !self.favourites.is_empty() {
            let favourites = self.favourites.iter();
            let favourites = favourites.map(|(key, name)| (key.to_string(), name.clone().into()));
            all.insert("favourites".to_owned(), Value::Object(favourites.collect()));
        }
        if self.lessons != KeptLessons::default() {
            let KeptLessons {
                language,
                open,
                student,
            } = &self.lessons;
            let lessons = [("language", language), ("open", open), ("student", student)];
            let lessons = lessons.map(|(name, text)| (name.to_owned(), text.clone().into()));
            all.insert(
                "lessons".to_owned(),
                Value::Object(lessons.into_iter().collect()),
            );
        }
        let text = format!("{:#}\n", Value::Object(all));
        let failed = |error: &dyn std::fmt::Display| {
            say!(
                "kept.the_editor_settings_are_not_kept",
                path = path.display(),
                error = error
            )
        };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|error| failed(&error))?;
        }
        write_atomic(path, text.as_bytes()).map_err(|error| failed(&error))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn lines_are_kept_in_a_file_with_what_others_wrote_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/editor.json");
        let mut kept = Kept::read(Some(path.clone()));
        for line in ["a", "b", "a"] {
            kept.remember(line).unwrap();
        }
        assert_eq!(Kept::read(Some(path.clone())).console, ["b", "a"]);
        std::fs::write(&path, "{\"console\": [\"x\", 3], \"theme\": \"dark\"}").unwrap();
        let mut kept = Kept::read(Some(path.clone()));
        assert_eq!(kept.console, ["x"]);
        for i in 0..MOST_LINES {
            kept.remember(&i.to_string()).unwrap();
        }
        assert_eq!(kept.console.len(), MOST_LINES);
        assert_eq!(kept.console[0], "0");
        assert!(
            std::fs::read_to_string(&path)
                .unwrap()
                .contains("\"theme\": \"dark\"")
        );
        for damaged in ["", "[]", "{", "{\"console\": 4}"] {
            std::fs::write(&path, damaged).unwrap();
            assert!(
                Kept::read(Some(path.clone())).console.is_empty(),
                "{damaged}"
            );
        }
        // A folder in the file's place.
        let mut kept = Kept::read(Some(folder.path().to_owned()));
        assert!(kept.remember("a").unwrap_err().contains("not kept in"));
        assert_eq!(kept.console, ["a"]);
        Kept::read(None).remember("a").unwrap();
    }

    #[test]
    fn the_last_scenes_are_kept_each_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("editor.json");
        let mut kept = Kept::read(Some(path.clone()));
        for name in ["a", "b", "a", "a"] {
            kept.remember_scene(name).unwrap();
        }
        assert_eq!(Kept::read(Some(path)).scenes, ["a", "b"]);
        for number in 0..20 {
            kept.remember_scene(&number.to_string()).unwrap();
        }
        assert_eq!(kept.scenes.len(), MOST_SCENES);
        assert_eq!(kept.scenes[0], "19");
    }

    #[test]
    fn the_open_lesson_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("editor.json");
        let lessons = KeptLessons {
            language: "es".to_owned(),
            open: "01-a".to_owned(),
            student: "ana \"x\"".to_owned(),
        };
        let mut kept = Kept::read(Some(path.clone()));
        kept.remember_lessons(lessons.clone()).unwrap();
        assert_eq!(Kept::read(Some(path.clone())).lessons, lessons);
        std::fs::write(&path, "{\"lessons\": {\"open\": 3}}").unwrap();
        assert_eq!(Kept::read(Some(path)).lessons, KeptLessons::default());
    }

    #[test]
    fn number_keys_are_kept_and_a_pipeline_has_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("editor.json");
        let mut kept = Kept::read(Some(path.clone()));
        kept.give_key(2, "a").unwrap();
        kept.give_key(3, "b").unwrap();
        kept.give_key(9, "a").unwrap();
        kept.give_key(3, "c").unwrap();
        let again = Kept::read(Some(path.clone())).favourites;
        let pairs = [(3, "c".to_owned()), (9, "a".to_owned())];
        assert_eq!(again, BTreeMap::from(pairs));
        std::fs::write(
            &path,
            "{\"favourites\": {\"0\": \"a\", \"x\": \"b\", \"4\": 5, \"5\": \"d\"}}",
        )
        .unwrap();
        let pairs = [(5, "d".to_owned())];
        assert_eq!(Kept::read(Some(path)).favourites, BTreeMap::from(pairs));
    }
}
