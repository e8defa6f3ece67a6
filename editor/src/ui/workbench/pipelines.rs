//! The pipelines that were visited, and which of them is on screen.

use std::collections::BTreeMap;
use std::time::Duration;

use lightbench::assets::files::Files;
use lightbench::render::heat_map;
use lightbench::render::{Compiler, Pipeline, PipelineDesc, Problems, Variants};
use lightbench::script::{SettingValue, Settings};

use super::Wake;
use super::compiling::{Answer, Built, CompileWorker, Request};

/// One pipeline that was visited.
#[derive(Debug, Default)]
pub struct Slot {
    /// Values that somebody gave to its parameters.
    pub settings: Settings,
    /// The last good one that can draw without a delay.
    pub pipeline: Option<Pipeline>,
    /// A newer one that takes its place once it is warm.
    next: Option<Pipeline>,
    /// Why the newest state of its files or settings does not work.
    pub problems: Option<Problems>,
    /// The newest request that was not answered yet.
    pending: Option<u64>,
    /// Files changed since the last request.
    stale: bool,
}

impl Slot {
    /// The newest description with its parameters.
    pub fn desc(&self) -> Option<&PipelineDesc> {
        self.newest().map(|pipeline| &pipeline.desc)
    }

    fn newest(&self) -> Option<&Pipeline> {
        self.next.as_ref().or(self.pipeline.as_ref())
    }
}

/// What became of a request.
#[derive(Debug)]
pub enum News {
    /// A pipeline was compiled in that time.
    Compiled(String, Duration),
    /// Parameters got new values without compiling.
    Values(String),
    /// It has mistakes.
    Failed(String, Problems),
    /// Settings were left out, because the file has no such parameters any more.
    LeftOut(String, Vec<String>),
}

/// All visited pipelines.
pub struct Pipelines {
    slots: BTreeMap<String, Slot>,
    selected: String,
    shown: Option<String>,
    worker: CompileWorker,
    ticket: u64,
    /// The variants of meshes that the scene has.
    variants: Variants,
    swaps: u64,
}

impl Pipelines {
    /// No pipeline is built yet.
    pub fn new(compiler: Compiler, files: Files, wake: Wake) -> Self {
        Self {
            slots: BTreeMap::new(),
            selected: String::new(),
            shown: None,
            worker: CompileWorker::start(compiler, files, wake),
            ticket: 0,
            variants: Variants::default(),
            swaps: 0,
        }
    }

    /// The same visits and settings on another device: everything is built anew.
    pub fn move_to(&mut self, compiler: Compiler, files: Files, wake: Wake) {
        self.worker = CompileWorker::start(compiler, files, wake);
        self.shown = None;
        for slot in self.slots.values_mut() {
            slot.pipeline = None;
            slot.next = None;
            slot.pending = None;
            slot.stale = true;
        }
        if !self.selected.is_empty() {
            self.request(&self.selected.clone(), true);
        }
    }

    /// Which pipeline was asked for.
    pub fn selected(&self) -> &str {
        &self.selected
    }

    /// Which pipeline draws; until the selected one is ready, the one before it.
    pub fn shown(&self) -> Option<&str> {
        self.shown.as_deref()
    }

    /// The pipeline that draws.
    pub fn shown_pipeline(&mut self) -> Option<&mut Pipeline> {
        let slot = self.slots.get_mut(self.shown.as_deref()?)?;
        slot.pipeline.as_mut()
    }

    /// Gives back the memory that visited pipelines which are not on screen hold for a picture of
    /// another size; they take theirs when they are shown again.
    pub fn release_hidden(&mut self) {
        for (name, slot) in &mut self.slots {
            if self.shown.as_ref() != Some(name)
                && let Some(pipeline) = &mut slot.pipeline
            {
                pipeline.release_targets();
            }
        }
    }

    /// Gives back the memory that all pipelines hold for the pictures of a series.
    pub fn release_series(&mut self, series: usize) {
        for slot in self.slots.values_mut() {
            let built = slot.next.iter_mut().chain(&mut slot.pipeline);
            built.for_each(|pipeline| pipeline.release_series(series));
        }
    }

    /// A visited pipeline.
    pub fn slot(&self, name: &str) -> Option<&Slot> {
        self.slots.get(name)
    }

    /// Values that somebody gave to the parameters of pipelines, by the names of these.
    pub fn all_settings(&self) -> impl Iterator<Item = (&str, &Settings)> {
        let all = self.slots.iter().map(|(name, slot)| (name, &slot.settings));
        let all = all.filter(|(_, settings)| !settings.is_empty());
        all.map(|(name, settings)| (name.as_str(), settings))
    }

    /// Gives values to the parameters of a pipeline, for when it is chosen next.
    pub fn remember(&mut self, name: &str, settings: Settings) {
        let slot = self.slots.entry(name.to_owned()).or_default();
        if slot.settings != settings {
            slot.settings = settings;
            slot.stale = true;
        }
    }

    /// The mistakes of the selected pipeline, if it has any.
    pub fn problems(&self) -> Option<&Problems> {
        self.slots.get(&self.selected)?.problems.as_ref()
    }

    /// Whether the selected pipeline is being built.
    pub fn is_busy(&self) -> bool {
        self.slots
            .get(&self.selected)
            .is_some_and(|slot| slot.pending.is_some())
    }

    /// How many new or changed pipelines went on screen since the start.
    pub fn swaps(&self) -> u64 {
        self.swaps
    }

    /// The selected pipeline, if it is built but not warm: see
    /// [`Renderer::warm_up`](lightbench::render::Renderer::warm_up).
    pub fn cold(&mut self) -> Option<&mut Pipeline> {
        self.slots.get_mut(&self.selected)?.next.as_mut()
    }

    /// Whether the selected pipeline is being warmed up.
    pub fn is_warming(&self) -> bool {
        self.slots
            .get(&self.selected)
            .is_some_and(|slot| slot.next.is_some())
    }

    /// Whether the pipeline on screen is about to be replaced by a newer state of itself.
    pub fn is_renewing(&self) -> bool {
        self.shown() == Some(self.selected()) && (self.is_busy() || self.is_warming())
    }

    /// The selected pipeline is warm: it goes on screen.
    pub fn warmed(&mut self) {
        let Some(slot) = self.slots.get_mut(&self.selected) else {
            return;
        };
        if let Some(next) = slot.next.take() {
            slot.pipeline = Some(next);
            self.shown = Some(self.selected.clone());
            self.swaps += 1;
        }
    }

    /// The scene has meshes of these variants: builds what can't draw them again.
    pub fn need(&mut self, variants: Variants) {
        let more = self.variants.or(variants);
        if more == self.variants {
            return;
        }
        self.variants = more;
        for slot in self.slots.values_mut() {
            slot.stale = true;
        }
        if !self.selected.is_empty() {
            self.request(&self.selected.clone(), true);
        }
    }

    /// Swaps to another pipeline: at once if it was visited, else as soon as it is built and warm.
    ///
    /// A heat map stays on when the pipeline changes.
    pub fn select(&mut self, name: &str) {
        let other = self.share_heat_map(name);
        self.selected = name.to_owned();
        let slot = self.slots.entry(name.to_owned()).or_default();
        if !other && slot.pipeline.is_some() {
            self.shown = Some(name.to_owned());
        }
        if other || (slot.newest().is_none() || slot.stale) && slot.pending.is_none() {
            self.request(name, true);
        }
    }

    /// Gives a pipeline the heat map of the selected one. Says whether it had another.
    fn share_heat_map(&mut self, name: &str) -> bool {
        let before = self.slots.get(&self.selected);
        let heat_map = before.map_or_else(Settings::new, |slot| heat_map_of(&slot.settings));
        let slot = self.slots.entry(name.to_owned()).or_default();
        let other = heat_map_of(&slot.settings) != heat_map;
        if other {
            let names = [heat_map::PARAMETER, heat_map::MOST].map(str::to_owned);
            slot.settings = without(&slot.settings, &names);
            for (name, value) in heat_map.iter() {
                slot.settings.set(name, value.clone());
            }
            // What was built shows something else.
            slot.stale = true;
        }
        other
    }

    /// Builds a pipeline that is drawn beside the selected one, unless it is built already.
    pub fn build_beside(&mut self, name: &str) {
        let other = self.share_heat_map(name);
        let slot = self.slots.entry(name.to_owned()).or_default();
        if other || (slot.newest().is_none() || slot.stale) && slot.pending.is_none() {
            self.request(name, false);
        }
    }

    /// The newest state of a pipeline that is drawn beside the selected one; none while it is built.
    ///
    /// # Errors
    /// Its first mistake.
    pub fn beside(&mut self, name: &str) -> Result<Option<&mut Pipeline>, String> {
        let Some(slot) = self.slots.get_mut(name) else {
            return Ok(None);
        };
        if slot.pending.is_some() || slot.stale {
            return Ok(None);
        }
        if let Some(problem) = slot.problems.as_ref().and_then(|known| known.0.first()) {
            return Err(problem.to_string());
        }
        Ok(slot.next.as_mut().or(slot.pipeline.as_mut()))
    }

    /// Gives back the memory that a pipeline took to be drawn beside the one on screen.
    pub fn release_beside(&mut self, name: &str) {
        if self.shown.as_deref() == Some(name) || self.selected == name {
            return;
        }
        if let Some(slot) = self.slots.get_mut(name) {
            let built = slot.next.iter_mut().chain(&mut slot.pipeline);
            built.for_each(Pipeline::release_targets);
        }
    }

    /// As [`Pipelines::select`], with values for its parameters.
    pub fn select_with(&mut self, name: &str, settings: Settings) {
        self.selected = name.to_owned();
        self.set_all(name, settings);
    }

    /// Gives a value to a parameter of the selected pipeline.
    pub fn set(&mut self, parameter: &str, value: SettingValue) {
        let name = self.selected.clone();
        let slot = self.slots.entry(name.clone()).or_default();
        slot.settings.set(parameter, value);
        self.request(&name, true);
    }

    /// Takes a parameter of the selected pipeline back to its default.
    pub fn unset(&mut self, parameter: &str) {
        let name = self.selected.clone();
        let slot = self.slots.entry(name.clone()).or_default();
        slot.settings = without(&slot.settings, &[parameter.to_owned()]);
        self.request(&name, true);
    }

    /// Replaces all values of a pipeline's parameters.
    pub fn set_all(&mut self, name: &str, settings: Settings) {
        let slot = self.slots.entry(name.to_owned()).or_default();
        slot.settings = settings;
        self.request(name, name == self.selected);
    }

    /// Builds again what depends on changed files, the selected pipeline first. Returns whether
    /// anything does.
    pub fn changed(&mut self, paths: &[String]) -> bool {
        self.worker.changed(paths.to_vec());
        let mut affected = Vec::new();
        for (name, slot) in &mut self.slots {
            let script = |path: &String| path.starts_with("scripts/pipelines/");
            let hit = match (slot.newest(), &slot.problems) {
                (Some(pipeline), None) => paths.iter().any(|path| pipeline.files().contains(path)),
                // What is broken may have named any of these.
                _ => paths
                    .iter()
                    .any(|path| script(path) || path.starts_with("shaders/")),
            };
            if hit {
                slot.stale = true;
                affected.push(name.clone());
            }
        }
        affected.sort_by_key(|name| *name != self.selected);
        for name in &affected {
            self.request(name, *name == self.selected);
        }
        !affected.is_empty()
    }

    /// Takes in what the worker finished.
    pub fn poll(&mut self) -> Vec<News> {
        let mut news = Vec::new();
        while let Some(answer) = self.worker.poll() {
            self.take(answer, &mut news);
        }
        news
    }

    fn take(&mut self, answer: Answer, news: &mut Vec<News>) {
        let slot = self.slots.entry(answer.name.clone()).or_default();
        if slot.pending == Some(answer.ticket) {
            slot.pending = None;
        }
        if !answer.left_out.is_empty() {
            slot.settings = without(&slot.settings, &answer.left_out);
            news.push(News::LeftOut(answer.name.clone(), answer.left_out));
        }
        match answer.result {
            Ok(Built::Pipeline(pipeline)) => {
                slot.next = Some(*pipeline);
                slot.problems = None;
                news.push(News::Compiled(answer.name.clone(), answer.took));
            }
            Ok(Built::Values(desc)) => {
                if let Some(pipeline) = slot.next.as_mut().or(slot.pipeline.as_mut()) {
                    pipeline.adopt_values(&desc);
                }
                slot.problems = None;
                news.push(News::Values(answer.name.clone()));
            }
            Err(problems) => {
                // The same mistake again, as after each keystroke of a slider, is no news.
                if slot.problems.as_ref() != Some(&problems) {
                    news.push(News::Failed(answer.name.clone(), problems.clone()));
                }
                slot.problems = Some(problems);
            }
        }
    }

    fn request(&mut self, name: &str, urgent: bool) {
        self.ticket += 1;
        let slot = self.slots.entry(name.to_owned()).or_default();
        slot.pending = Some(self.ticket);
        slot.stale = false;
        self.worker.build(Request {
            name: name.to_owned(),
            settings: slot.settings.clone(),
            variants: self.variants,
            ticket: self.ticket,
            urgent,
        });
    }
}

/// What settings say of the heat map.
fn heat_map_of(settings: &Settings) -> Settings {
    let mut kept = Settings::new();
    for name in [heat_map::PARAMETER, heat_map::MOST] {
        if let Some(value) = settings.get(name) {
            kept.set(name, value.clone());
        }
    }
    kept
}

/// The settings but for some names.
fn without(settings: &Settings, names: &[String]) -> Settings {
    let mut kept = Settings::new();
    for (name, value) in settings.iter() {
        if !names.iter().any(|left_out| left_out == name) {
            kept.set(name, value.clone());
        }
    }
    kept
}
