//! All that somebody works on, to be kept, and going on with what was kept.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use lightbench::script::Settings;
use lightbench::script::overlays::{KeptOverlays, Overlays};

use super::Workbench;
use super::typed::Coming;
use super::undo::Chosen;
use crate::ui::messages::say;
use crate::ui::recovery::Session;
use crate::viewpoint::Viewpoint;

impl Workbench {
    /// How much was done: steps, and views.
    pub fn done_so_far(&self) -> (u64, u64) {
        (self.undo.revision(), self.views.revision())
    }

    /// What somebody works on; `None` while a scene is on its way.
    pub fn session(&self) -> Option<Session> {
        if self.is_between_scenes() || self.undo.is_waiting() {
            return None;
        }
        let mut view = self.view_to_keep()?;
        let plays = self.clock.playing;
        if plays {
            // No moment was chosen.
            view.time = 0.0;
        }
        let named = |(name, settings): (&str, &Settings)| (name.to_owned(), settings.clone());
        let scenes = self.scenes.all_settings();
        let scenes = scenes.map(|(name, all)| (self.files.display(name), all.clone()));
        let overlays = self.overlays.iter().filter(|(_, all)| !all.is_empty());
        let overlays = overlays.map(|(name, all)| (self.files.display(name), all.kept()));
        let mut overlays: BTreeMap<String, KeptOverlays> = overlays.collect();
        let mut typed = BTreeMap::new();
        if !self.typed.is_empty() {
            let shown = self.scenes.shown().unwrap_or_default();
            typed.insert(self.files.display(shown), self.typed.clone());
        }
        // What still waits for a scene that could not be shown.
        for coming in &self.coming {
            let name = self.files.display(&coming.scene);
            let own = overlays.entry(name.clone()).or_default();
            own.edits.extend(coming.edits.iter().cloned());
            typed.insert(name, coming.lines.iter().cloned().collect());
        }
        Some(Session {
            project: self.files.project().map(Path::to_owned),
            on_purpose: false,
            view: view.to_string(),
            plays,
            view_b: self.other_viewpoint().map(|view| view.to_string()),
            dials: self.dials(),
            scenes: scenes.collect(),
            pipelines: self.pipelines.all_settings().map(named).collect(),
            overlays,
            typed,
        })
    }

    /// Goes on with what was kept. What can be taken back begins anew.
    ///
    /// # Errors
    /// A sentence, where what was on the screen can't be shown. What was changed by hand is there all the
    /// same, for when its scene is opened.
    pub fn resume(&mut self, session: &Session) -> Result<(), String> {
        let result = self.quietly(|this| this.resume_quietly(session));
        self.undo.clear();
        self.forget_views();
        result
    }

    fn resume_quietly(&mut self, session: &Session) -> Result<(), String> {
        self.coming.clear();
        let named: BTreeSet<&String> = session
            .overlays
            .keys()
            .chain(session.typed.keys())
            .collect();
        for name in named {
            let mut kept = session.overlays.get(name).cloned().unwrap_or_default();
            let lines = session.typed.get(name).map_or(&[][..], Vec::as_slice);
            let name = self.name_inside(name);
            let coming = Coming::new(name.clone(), lines, &mut kept.edits);
            self.coming.extend(coming);
            self.overlays.insert(name, Overlays::from_kept(kept));
        }
        for (name, settings) in &session.scenes {
            let name = self.name_inside(name);
            self.scenes.remember(&name, settings.clone());
        }
        for (name, settings) in &session.pipelines {
            self.pipelines.remember(name, settings.clone());
        }
        self.set_dials(session.dials);
        let read = |text: &str| {
            let view = text.parse::<Viewpoint>();
            view.map_err(|error| say!("recovery.no_view", error = error))
        };
        let view = read(&session.view)?;
        self.go_to(&view)?;
        if let Some(way) = &mut self.arriving {
            way.then_plays = session.plays;
        }
        if let Some(view) = &session.view_b {
            let view = read(view)?;
            self.compare(true);
            self.choose_other(&Chosen {
                name: view.pipeline,
                settings: view.pipeline_settings,
            });
        }
        Ok(())
    }

    /// The name that a scene has in this run. A file outside of the project had been opened by the person
    /// whose work this is.
    fn name_inside(&mut self, name: &str) -> String {
        let path = Path::new(name);
        if !path.is_absolute() {
            return name.to_owned();
        }
        let granted = self.files.grant(path);
        self.scenes.use_files(self.files.clone());
        granted.unwrap_or_else(|_| name.to_owned())
    }

    /// Scenes with changes by hand that are in no file, and how many.
    pub fn unsaved_changes(&self) -> Vec<(String, usize)> {
        let all = self.overlays.iter().map(|(name, all)| (name, all.kept()));
        let unsaved = all.filter(|(name, kept)| {
            let saved = self.saved.get(*name);
            !kept.is_empty() && saved != Some(kept)
        });
        let mut unsaved: BTreeMap<String, usize> = unsaved
            .map(|(name, kept)| (name.clone(), kept.len()))
            .collect();
        let lines = self.unsaved_lines();
        if let Some(name) = self.scenes.shown().filter(|_| lines > 0) {
            *unsaved.entry(name.to_owned()).or_default() += lines;
        }
        unsaved.into_iter().collect()
    }

    /// The scene on screen is in a file as it is now.
    pub(super) fn was_saved(&mut self) {
        self.saved_lines.clone_from(&self.typed);
        if let (Some(name), Some(all)) = (self.scenes.shown(), self.overlays_now()) {
            let (name, kept) = (name.to_owned(), all.kept());
            self.saved.insert(name, kept);
        }
    }
}

/// What lay over scenes when they were saved, by the names of the scenes.
pub(super) type Saved = BTreeMap<String, KeptOverlays>;
