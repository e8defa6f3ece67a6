//! What the browser shows: assets of the scene, and files of the project that could be.

use std::collections::BTreeSet;
use std::path::PathBuf;

use lightbench::assets::Task;
use lightbench::assets::files::Files;
use lightbench::script::Scene;
use lightbench::script::overlays::{AssetId, Listed};

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

    /// The cards of a shelf.
    pub fn cards(&self, scene: &Scene, shelf: Shelf) -> Vec<Card> {
        let listed = scene.listed();
        let known: BTreeSet<String> = listed.iter().filter_map(|one| one.recipe.clone()).collect();
        let on_shelf = |one: &Listed| match one.id {
            AssetId::Material(_) => shelf == Shelf::Materials,
            AssetId::Mesh(_) => shelf == Shelf::Meshes,
            AssetId::Texture(_) => shelf == Shelf::Textures,
        };
        let assets = listed.into_iter().filter(on_shelf);
        let assets = assets.map(|one| Card {
            title: one.who.words(),
            kind: Kind::Asset(one),
        });
        let mut cards: Vec<Card> = assets.collect();
        let file = |path: &String| path.rsplit('/').next().unwrap_or(path).to_owned();
        match shelf {
            Shelf::Textures => {
                let new = self.files.pictures.iter();
                let new = new.filter(|path| !known.contains(&super::picture_call(path)));
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
