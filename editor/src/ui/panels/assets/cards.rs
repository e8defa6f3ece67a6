//! What the browser shows: assets of the scene, and files of the project that could be.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use lightbench::assets::Task;
use lightbench::assets::files::Files;
use lightbench::script::Scene;
use lightbench::script::overlays::{AssetId, Listed, Listing};

use crate::ui::pictures::{MODELS, PICTURES, Subject};
use crate::ui::workbench::Wake;

/// A part of the browser.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shelf {
    /// Materials of the scene.
    #[default]
    Materials,
    /// Meshes of the scene.
    Meshes,
    /// Textures of the scene, and pictures of the project.
    Textures,
    /// Files with models.
    Models,
}

/// What a card stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// An asset of the scene.
    Asset(Listed),
    /// A picture that is not in the scene.
    Picture(String),
    /// A file with a model.
    Model(String),
}

/// One thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// What it is.
    pub kind: Kind,
    /// In a few words.
    pub title: String,
}

impl Card {
    /// Whether each word that was typed is in its title, its calls or its path.
    pub fn fits(&self, typed: &str) -> bool {
        if typed.is_empty() {
            return true;
        }
        let more = match &self.kind {
            Kind::Asset(listed) => listed.recipe.as_deref().unwrap_or_default(),
            Kind::Picture(path) | Kind::Model(path) => path,
        };
        let text = format!("{} {more}", self.title).to_lowercase();
        let mut words = typed.split_whitespace();
        words.all(|word| text.contains(&word.to_lowercase()))
    }

    /// What its picture shows.
    pub fn subject(&self, scene: &Scene) -> Option<Subject> {
        match &self.kind {
            Kind::Asset(listed) => match listed.id {
                AssetId::Material(id) => Subject::material(&scene.assets, id),
                AssetId::Mesh(id) => Subject::mesh(&scene.assets, id),
                AssetId::Texture(id) => Subject::texture(&scene.assets, id),
            },
            Kind::Picture(path) => Some(Subject::PictureFile(path.clone())),
            Kind::Model(path) => Some(Subject::ModelFile(path.clone())),
        }
    }
}

/// Files of a project that can come into a scene.
#[derive(Clone, Debug, Default)]
pub struct FilesOfProject {
    models: Vec<String>,
    pictures: Vec<String>,
    project: Option<PathBuf>,
}

/// Those files, read in the background.
#[derive(Default)]
pub struct Shelves {
    files: FilesOfProject,
    reading: Option<Task<FilesOfProject>>,
    is_read: bool,
    last: Option<LastCards>,
}

/// The cards of a shelf.
#[derive(Debug)]
pub struct Cards {
    /// All of them.
    pub all: Vec<Card>,
    /// The places of those that hold each word that was typed.
    pub shown: Vec<usize>,
}

/// What the cards were made from last: they are made again where something of it is another one.
struct LastCards {
    listing: Arc<Listing>,
    shelf: Shelf,
    typed: String,
    cards: Arc<Cards>,
}

impl Shelves {
    /// Files have come or gone.
    pub fn forget(&mut self) {
        self.is_read = false;
    }

    /// Reads what lies in the project, and takes it in.
    pub fn tend(&mut self, files: &Files, wake: &Wake) {
        if self.files.project.as_deref() != files.project() {
            self.is_read = false;
        }
        if let Some(reading) = &self.reading {
            match reading.poll() {
                Ok(None) => return,
                Ok(Some(files)) => self.files = files,
                Err(_) => self.files = FilesOfProject::default(),
            }
            self.reading = None;
            self.last = None;
        }
        if !self.is_read {
            self.is_read = true;
            self.files.project = files.project().map(ToOwned::to_owned);
            let (files, wake) = (files.clone(), wake.clone());
            let read = Task::start(move |_| {
                let paths = |endings: &[&str]| {
                    // What can't be read can't be shown.
                    let all = files.list_project(endings).unwrap_or_default();
                    all.into_iter().map(|listed| listed.path).collect()
                };
                let found = FilesOfProject {
                    models: paths(&MODELS),
                    pictures: paths(&PICTURES),
                    project: files.project().map(ToOwned::to_owned),
                };
                wake();
                found
            });
            // Without a thread there is what the scene has still.
            self.reading = read.ok();
        }
    }

    /// The cards of a shelf, and which of them hold each word that was typed.
    pub fn cards(&mut self, scene: &Scene, shelf: Shelf, typed: &str) -> Arc<Cards> {
        let listing = scene.listed();
        let before = self.last.take().filter(|last| {
            last.shelf == shelf && last.typed == typed && Arc::ptr_eq(&last.listing, &listing)
        });
        let cards = match before {
            Some(last) => last.cards,
            None => {
                let all = self.all(&listing, shelf);
                let places = (0..all.len()).filter(|place| all[*place].fits(typed));
                let shown = places.collect();
                Arc::new(Cards { all, shown })
            }
        };
        self.last = Some(LastCards {
            listing,
            shelf,
            typed: typed.to_owned(),
            cards: Arc::clone(&cards),
        });
        cards
    }

    fn all(&self, listing: &Listing, shelf: Shelf) -> Vec<Card> {
        let recipes = listing.textures().iter().map(|one| one.recipe.as_deref());
        let known: BTreeSet<&str> = recipes.flatten().collect();
        let assets = match shelf {
            Shelf::Materials => listing.materials(),
            Shelf::Meshes => listing.meshes(),
            Shelf::Textures => listing.textures(),
            Shelf::Models => &[],
        };
        let assets = assets.iter().map(|one| Card {
            title: one.who.words(),
            kind: Kind::Asset(one.clone()),
        });
        let mut cards: Vec<Card> = assets.collect();
        let file = |path: &String| path.rsplit('/').next().unwrap_or(path).to_owned();
        match shelf {
            Shelf::Textures => {
                let new = self.files.pictures.iter();
                let new = new.filter(|path| !known.contains(&*super::picture_call(path)));
                cards.extend(new.map(|path| Card {
                    title: file(path),
                    kind: Kind::Picture(path.clone()),
                }));
            }
            Shelf::Models => cards.extend(self.files.models.iter().map(|path| Card {
                title: file(path),
                kind: Kind::Model(path.clone()),
            })),
            Shelf::Materials | Shelf::Meshes => {}
        }
        cards
    }
}
