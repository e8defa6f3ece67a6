//! What there is to look at and to begin from: scenes, pipelines and examples with their pictures.

pub mod cards;
mod kept_pictures;
pub mod thumbnails;

use std::path::PathBuf;

use lightbench::assets::Task;
use lightbench::assets::files::Files;
use lightbench::render::GpuOptions;

use self::cards::{Card, Shelf};
use self::thumbnails::Thumbnails;
use super::workbench::Wake;
use super::workbench::library::Library;

/// The gallery.
pub struct Gallery {
    /// Whether its window is open.
    pub is_open: bool,
    /// What is shown of it.
    pub shelf: Shelf,
    /// Words that titles and sentences must hold.
    pub filter: String,
    examples: Vec<Card>,
    reading: Option<Task<Vec<Card>>>,
    /// What the cards were made from: how many scenes and pipelines there were, and of which project.
    made_of: Option<(usize, usize, Option<PathBuf>)>,
    cards: Vec<Card>,
    /// Their pictures.
    pub thumbnails: Thumbnails,
}

impl Gallery {
    /// A closed gallery, which keeps no pictures over restarts.
    pub fn new() -> Self {
        Self {
            is_open: false,
            shelf: Shelf::Scenes,
            filter: String::new(),
            examples: Vec::new(),
            reading: None,
            made_of: None,
            cards: Vec::new(),
            thumbnails: Thumbnails::default(),
        }
    }

    /// Opens the window; what lies in the folders is read in the background.
    pub fn open(&mut self, files: &Files, wake: &Wake) {
        self.is_open = true;
        // Files may have changed: what is kept of them is looked through again.
        self.thumbnails.forget();
        let (files, wake) = (files.clone(), wake.clone());
        let read = Task::start(move |_| {
            let examples = cards::examples(&files);
            wake();
            examples
        });
        // Without a thread there are scenes and pipelines still.
        self.reading = read.ok();
    }

    /// Takes in what was read, and lets pictures be made while the window is open.
    pub fn tend(&mut self, library: &Library, files: &Files, gpu: &GpuOptions, wake: &Wake) {
        self.thumbnails.set_wanted(self.is_open);
        if !self.is_open {
            return;
        }
        if let Some(reading) = &self.reading {
            match reading.poll() {
                Ok(None) => {}
                Ok(Some(examples)) => {
                    self.examples = examples;
                    self.made_of = None;
                    self.reading = None;
                }
                Err(_) => self.reading = None,
            }
        }
        let project = files.project().map(ToOwned::to_owned);
        let made_of = (library.scenes.len(), library.pipelines.len(), project);
        if self.made_of.as_ref() != Some(&made_of) {
            self.cards = cards::of_library(library);
            self.cards.extend(self.examples.iter().cloned());
            self.made_of = Some(made_of);
        }
        self.thumbnails.tend(files, gpu, wake);
    }

    /// The cards of the shelf that fit the filter.
    pub fn shown(&self) -> Vec<Card> {
        let on_shelf = self.cards.iter().filter(|card| card.shelf == self.shelf);
        let fits = on_shelf.filter(|card| card.fits(&self.filter));
        fits.cloned().collect()
    }
}

impl Default for Gallery {
    fn default() -> Self {
        Self::new()
    }
}
