//! The scene on screen, and the loading of the next one.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

use lightbench::assets::Task;
use lightbench::assets::cache::Cache;
use lightbench::assets::files::Files;
use lightbench::render::{Place, Problem, Problems};
use lightbench::script::{Limits, Scene, SettingValue, Settings, load_scene_again};

use super::Wake;
use crate::ui::messages::say;

/// Paths that a load has read or looked for.
type Reads = Arc<Mutex<BTreeSet<String>>>;

struct Loading {
    name: String,
    task: Task<Result<Scene, Problems>>,
    reads: Reads,
}

/// How far the next scene is.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadingState {
    /// The scene's name.
    pub name: String,
    /// The share that is done, 0 to 1.
    pub fraction: f32,
    /// What is being done.
    pub label: String,
}

/// What came of a load.
pub enum Loaded {
    /// A scene takes the place of the one before; whether it is the same one, loaded anew.
    Scene {
        /// Whether only its files or parameters changed.
        again: bool,
    },
    /// It has mistakes; the one before stays.
    Failed(Problems),
}

/// The scene on screen and the one to come.
pub struct Scenes {
    files: Files,
    wake: Wake,
    /// What loads have made, for the next ones.
    cache: Cache,
    scene: Option<Scene>,
    shown: Option<String>,
    selected: String,
    settings: BTreeMap<String, Settings>,
    loading: Option<Loading>,
    /// Whether a load is wanted that has not begun.
    wanted: bool,
    problems: Option<Problems>,
    reads: BTreeSet<String>,
    swaps: u64,
}

impl Scenes {
    /// No scene yet.
    pub fn new(files: Files, wake: Wake) -> Self {
        Self {
            files,
            wake,
            cache: Cache::default(),
            scene: None,
            shown: None,
            selected: String::new(),
            settings: BTreeMap::new(),
            loading: None,
            wanted: false,
            problems: None,
            reads: BTreeSet::new(),
            swaps: 0,
        }
    }

    /// The scene on screen.
    pub fn scene(&self) -> Option<&Scene> {
        self.scene.as_ref()
    }

    /// The scene on screen, to be moved.
    pub fn scene_mut(&mut self) -> Option<&mut Scene> {
        self.scene.as_mut()
    }

    /// Which scene was asked for.
    pub fn selected(&self) -> &str {
        &self.selected
    }

    /// Which scene is on screen.
    pub fn shown(&self) -> Option<&str> {
        self.shown.as_deref()
    }

    /// How often a scene has taken the place of another.
    pub fn swaps(&self) -> u64 {
        self.swaps
    }

    /// Mistakes of the selected scene.
    pub fn problems(&self) -> Option<&Problems> {
        self.problems.as_ref()
    }

    /// Takes note of a mistake that showed while the scene ran, or that there is none any more.
    pub fn set_problems(&mut self, problems: Option<Problems>) {
        self.problems = problems;
    }

    /// Values that somebody gave to the selected scene's parameters.
    pub fn settings(&self) -> Option<&Settings> {
        self.settings.get(&self.selected)
    }

    /// Values that somebody gave to the parameters of scenes, by the names of these.
    pub fn all_settings(&self) -> impl Iterator<Item = (&str, &Settings)> {
        let all = self.settings.iter().filter(|(_, all)| !all.is_empty());
        all.map(|(name, settings)| (name.as_str(), settings))
    }

    /// Gives values to the parameters of a scene, for when it is loaded next.
    pub fn remember(&mut self, name: &str, settings: Settings) {
        self.settings.insert(name.to_owned(), settings);
    }

    /// How far a load is, if one runs.
    pub fn loading(&self) -> Option<LoadingState> {
        let loading = self.loading.as_ref()?;
        let progress = loading.task.progress();
        Some(LoadingState {
            name: loading.name.clone(),
            fraction: progress.fraction(),
            label: progress.label(),
        })
    }

    /// Loads another scene.
    pub fn select(&mut self, name: &str, settings: Option<Settings>) {
        if let Some(settings) = settings {
            self.settings.insert(name.to_owned(), settings);
        }
        if self.selected != name {
            // Whatever loads now, nobody waits for it any more.
            self.loading = None;
        }
        self.selected = name.to_owned();
        self.wanted = true;
    }

    /// Reads files from another store from the next load on.
    pub fn use_files(&mut self, files: Files) {
        self.files = files;
    }

    /// Loads the selected scene again.
    pub fn reload(&mut self) {
        self.wanted = !self.selected.is_empty();
    }

    /// Gives a value to a parameter and loads the scene with it.
    pub fn set(&mut self, parameter: &str, value: SettingValue) {
        let settings = self.settings.entry(self.selected.clone()).or_default();
        settings.set(parameter, value);
        self.wanted = true;
    }

    /// Takes a parameter back to its default.
    pub fn unset(&mut self, parameter: &str) {
        if let Some(settings) = self.settings.get_mut(&self.selected) {
            let mut kept = Settings::new();
            for (name, value) in settings.iter().filter(|(name, _)| *name != parameter) {
                kept.set(name, value.clone());
            }
            *settings = kept;
            self.wanted = true;
        }
    }

    /// Loads again if one of these files is part of the scene. Returns whether it is.
    pub fn changed(&mut self, paths: &[String]) -> bool {
        let loading = self.loading.as_ref().map(|loading| &loading.reads);
        let loading = loading.map(|reads| reads.lock().unwrap_or_else(PoisonError::into_inner));
        let hit = paths.iter().any(|path| {
            self.reads.contains(path)
                // What a load has read by now may be older than the save.
                || loading.as_ref().is_some_and(|reads| reads.contains(path))
                // Whatever is broken may wait for a file that was not there.
                || self.problems.is_some() && !path.starts_with("shaders/")
        });
        drop(loading);
        self.wanted |= hit;
        hit
    }

    /// Begins and ends loads. One load runs at a time; changes during it lead to one more.
    pub fn poll(&mut self) -> Option<Loaded> {
        let mut news = None;
        if let Some(loading) = &self.loading {
            match loading.task.poll() {
                Ok(None) => return None,
                Ok(Some(result)) => news = Some(result),
                Err(lost) => {
                    let problem =
                        Problem::new(Place::file(loading.name.as_str()), lost.to_string());
                    news = Some(Err(problem.into()));
                }
            }
        }
        let news = news.map(|result| self.take(result));
        if self.loading.is_none() && std::mem::take(&mut self.wanted) {
            self.begin();
        }
        news
    }

    /// Whether something loads or waits to.
    pub fn is_busy(&self) -> bool {
        self.loading.is_some() || self.wanted
    }

    /// Whether a newer state of the scene on screen is being loaded.
    pub fn is_renewing(&self) -> bool {
        self.is_busy() && self.shown.as_deref() == Some(&self.selected)
    }

    fn take(&mut self, result: Result<Scene, Problems>) -> Loaded {
        let Some(loading) = self.loading.take() else {
            return Loaded::Scene { again: true };
        };
        let reads = loading.reads.lock().unwrap_or_else(PoisonError::into_inner);
        match result {
            Ok(scene) => {
                let again = self.shown.as_deref() == Some(&loading.name);
                self.reads = reads.clone();
                self.scene = Some(scene);
                self.shown = Some(loading.name.clone());
                self.problems = None;
                self.swaps += 1;
                Loaded::Scene { again }
            }
            Err(problems) => {
                // What the good one was made of still counts.
                self.reads.extend(reads.iter().cloned());
                self.problems = Some(problems.clone());
                Loaded::Failed(problems)
            }
        }
    }

    fn begin(&mut self) {
        let name = self.selected.clone();
        let settings = self.settings.get(&name).cloned().unwrap_or_default();
        let reads = Reads::default();
        let told = Arc::clone(&reads);
        let files = self.files.observed_with_missing(move |path, _| {
            let mut reads = told.lock().unwrap_or_else(PoisonError::into_inner);
            reads.insert(path.to_owned());
        });
        let wake = Arc::clone(&self.wake);
        let (wanted, cache) = (name.clone(), self.cache.clone());
        // What its scripts asked to keep, where it is the same scene.
        let shown = self
            .scene
            .as_ref()
            .filter(|_| self.shown.as_deref() == Some(&name));
        let kept = shown.map(Scene::kept).unwrap_or_default();
        let task = Task::start(move |progress| {
            let limits = Limits::default().in_project(&files).map_err(Problems::from);
            let scene = limits.and_then(|limits| {
                load_scene_again(&files, &wanted, &settings, progress, &cache, &limits, kept)
            });
            wake();
            scene
        });
        match task {
            Ok(task) => self.loading = Some(Loading { name, task, reads }),
            Err(error) => {
                let text = say!("scenes.no_thread_to_load_the_scene", error = error);
                self.problems = Some(Problem::new(Place::file(name), text).into());
            }
        }
    }
}
