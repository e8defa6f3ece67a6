//! What the editor does with the files that are open in the panel Code, and with projects.

use std::path::{Path, PathBuf};
use std::time::Instant;

use lightbench::assets::files::create_project;
use lightbench::render::Place;
use lightbench::script::overlays::AssetEdit;
use lightbench::script::{PIPELINES, SCENES};

use super::code::document::{Document, SaveError};
use super::code::{Leaving, Spot};
use super::dialogs::Question;
use super::editor::Editor;
use super::keeping::open_recovery;
use super::layout::Panel;
use super::panels::saving::Saving;
use crate::ui::messages::say;

/// The file of a scene or a pipeline that is known by its name.
fn file_of(folder: &str, name: &str) -> String {
    if name.contains('/') {
        name.to_owned()
    } else {
        format!("{folder}/{name}.rhai")
    }
}

/// Whether a place is one in a file that can be shown.
pub fn is_in_a_file(place: &Place) -> bool {
    place.file.ends_with(".rhai") || place.file.ends_with(".wgsl")
}

impl Editor {
    /// Opens a script or a shader, with the caret at a place.
    pub fn open_code(&mut self, path: &str, spot: Option<Spot>) {
        if let Err(error) = self.code.open(self.workbench.files(), path, spot) {
            self.workbench.log.error(error.to_string());
            self.reveal(Panel::Log);
            return;
        }
        self.reveal(Panel::Code);
        self.code_panel.focus();
    }

    /// Shows the place of a mistake.
    pub fn go_to(&mut self, place: &Place) {
        let spot = Spot {
            line: place.line.max(1) as usize,
            column: place.column as usize,
        };
        self.open_code(&place.file, Some(spot));
    }

    /// Opens the script of the scene.
    pub(super) fn edit_scene(&mut self) {
        let name = self.workbench.scenes.selected();
        let path = file_of(SCENES, name);
        self.open_code(&path, None);
    }

    /// Opens the file of the pipeline.
    pub(super) fn edit_pipeline(&mut self) {
        let path = file_of(PIPELINES, self.workbench.pipelines.selected());
        self.open_code(&path, None);
    }

    /// Saves the file that is shown, if it has unsaved text; else asks where to save the scene.
    pub(super) fn save(&mut self) {
        if self.code.shown().is_some_and(Document::is_unsaved) {
            self.save_shown_file();
        } else {
            self.saving = Some(Saving::new(&self.workbench));
        }
    }

    /// Saves the file that is shown.
    pub(super) fn save_shown_file(&mut self) {
        if let Some(document) = self.code.shown() {
            let path = document.path.clone();
            self.save_file(&path);
        }
    }

    /// Saves an open file. Returns whether it is saved.
    pub(super) fn save_file(&mut self, path: &str) -> bool {
        let open = self.code.documents().iter();
        let Some(index) = open
            .enumerate()
            .find_map(|(i, open)| (open.path == path).then_some(i))
        else {
            return true;
        };
        self.code.show(index);
        let saved = self.code.save(self.workbench.files());
        self.was_saved(saved, &[path.to_owned()])
    }

    /// Saves all open files. Returns whether all are saved.
    pub(super) fn save_all_files(&mut self) -> bool {
        let paths: Vec<String> = self.code.unsaved().map(|open| open.path.clone()).collect();
        let saved = self.code.save_all(self.workbench.files());
        self.was_saved(saved, &paths)
    }

    fn was_saved(&mut self, saved: Result<(), SaveError>, paths: &[String]) -> bool {
        // What is watched tells of itself.
        let unwatched = |path: &String| path.starts_with('@') || !self.workbench.is_watching();
        let unwatched: Vec<String> = paths
            .iter()
            .filter(|path| unwatched(path))
            .cloned()
            .collect();
        if !unwatched.is_empty() {
            self.workbench.files_changed(&unwatched);
        }
        match saved {
            Ok(()) => true,
            Err(error) => {
                self.workbench
                    .log
                    .error(say!("coding.not_saved", error = error));
                false
            }
        }
    }

    /// Copies the file that is shown into the project, where it can be changed.
    pub(super) fn copy_shown_file(&mut self) {
        let Some(path) = self.code.shown().map(|document| document.path.clone()) else {
            return;
        };
        self.copy_into_project(&path);
        self.code_panel.focus();
    }

    /// Copies a shipped file into the project. Returns whether it is there.
    pub(super) fn copy_into_project(&mut self, path: &str) -> bool {
        match self.workbench.files().copy_to_project(path) {
            Ok(place) => {
                let text = say!(
                    "coding.is_now_in_the_project",
                    path = path,
                    place = place.display()
                );
                self.workbench.log.info(text);
                let paths = [path.to_owned()];
                self.code.refresh(self.workbench.files(), Some(&paths));
                if !self.workbench.is_watching() {
                    self.workbench.files_changed(&paths);
                }
                true
            }
            Err(error) => {
                self.workbench.log.error(error.to_string());
                self.reveal(Panel::Log);
                false
            }
        }
    }

    /// Opens a text that a crash has left.
    pub(super) fn restore_draft(&mut self, index: usize) {
        let mut files = self.workbench.files().clone();
        self.code.restore(&mut files, index);
        self.workbench.use_files(files);
        self.reveal(Panel::Code);
        self.code_panel.focus();
    }

    /// Takes in what changed on the disk, and keeps what is not saved.
    pub(super) fn tend_code(&mut self, now: Instant, focused: bool) {
        if focused && !self.was_focused {
            // Who comes back from another program may have saved something that is not watched.
            self.code.refresh(self.workbench.files(), None);
        }
        self.was_focused = focused;
        if let Some(touched) = self.workbench.take_touched() {
            let paths: Vec<String> = touched.paths.into_iter().collect();
            let changed = (!touched.everything).then_some(paths.as_slice());
            self.code.refresh(self.workbench.files(), changed);
            self.lessons.changed(self.workbench.files(), changed);
            self.lesson_panel.pictures.forget();
            self.pictures.files_changed(&paths);
            self.assets.shelves.forget();
        }
        for error in self.code.note(now) {
            self.workbench.log.error(error);
        }
    }

    /// Whether something is asked that comes before all else.
    pub(super) fn has_question(&self) -> bool {
        self.code.leaving.is_some() || self.dialogs.is_typing() || !self.recovery.left.is_empty()
    }

    /// Asks for a file or a folder.
    pub(super) fn ask_for(&mut self, question: Question) {
        let project = self.workbench.files().project();
        let begin_at = match question {
            Question::Project | Question::Lesson => {
                project.and_then(Path::parent).map(Path::to_owned)
            }
            Question::Picture | Question::Texture | Question::Model => project.map(Path::to_owned),
            Question::Scene | Question::SaveScene => project
                .map(|project| project.join(SCENES))
                .filter(|folder| folder.is_dir()),
        };
        self.dialogs.ask(question, begin_at.as_deref());
    }

    /// Asks, and does what was answered.
    pub(super) fn follow_dialogs(&mut self, ctx: &egui::Context) {
        let Some((question, path)) = self.dialogs.show(ctx) else {
            return;
        };
        let done = match question {
            Question::Project if self.has_something_to_lose() => {
                self.code.leaving = Some(Leaving::Project(path.clone()));
                Ok(())
            }
            Question::Project => self.try_to_open_project(&path, false),
            Question::Picture => self.take_picture(&path),
            Question::Texture => self.add_texture(&path),
            Question::Model => self.add_model(&path),
            Question::Scene => self.try_to_open_file(&path),
            Question::SaveScene => self.save_scene_to(&path),
            Question::Lesson => {
                self.lessons.beginning.folder = path.to_string_lossy().into_owned();
                Ok(())
            }
        };
        if let Err(why) = done {
            self.dialogs.refuse(question, &path, why);
        }
    }

    /// Goes on with another project. What keeps it from that is asked about again.
    pub(super) fn open_project(&mut self, folder: &Path, keeps: bool) {
        if let Err(why) = self.try_to_open_project(folder, keeps) {
            self.dialogs.refuse(Question::Project, folder, why);
        }
    }

    /// `keeps` leaves what was kept of the present project for when it is opened again.
    pub(super) fn try_to_open_project(&mut self, folder: &Path, keeps: bool) -> Result<(), String> {
        let is_empty = std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none());
        let folder: PathBuf = if is_empty || !folder.exists() {
            create_project(folder).map_err(|error| error.to_string())?
        } else {
            folder.to_owned()
        };
        let has_changes = !self.workbench.unsaved_changes().is_empty();
        self.workbench.open_project(&folder)?;
        if !(keeps && has_changes) {
            self.recovery.forget();
        }
        let project = self.workbench.files().project();
        self.recovery = open_recovery(self.kept.recovery_folder(), project);
        let root = self.kept.unsaved_folder();
        self.code.move_to(root, self.workbench.files());
        self.forget_opened_file();
        self.show_scene_of_lesson();
        Ok(())
    }

    /// Lets the gallery go on, unless somebody works.
    pub(super) fn tend_gallery(&mut self, ctx: &egui::Context) {
        let works = ctx.input(|input| input.pointer.any_down() || !input.events.is_empty());
        if works {
            self.gallery.thumbnails.hold();
        }
        let workbench = &self.workbench;
        let (files, gpu) = (workbench.files(), workbench.gpu_options());
        self.gallery
            .tend(&workbench.library, files, gpu, workbench.wake());
    }

    /// Lets pictures of assets be made.
    pub(super) fn tend_pictures(&mut self, ctx: &egui::Context) {
        let works = ctx.input(|input| input.pointer.any_down() || !input.events.is_empty());
        if works {
            self.pictures.hold();
        }
        let workbench = &self.workbench;
        let (files, gpu) = (workbench.files(), workbench.gpu_options());
        if self.pictures.tend(files, gpu, workbench.wake()) {
            // The panels that show them are drawn already.
            ctx.request_repaint();
        }
    }

    /// Adds a picture of a file to the scene's textures.
    fn add_texture(&mut self, file: &Path) -> Result<(), String> {
        let path = self.workbench.import_picture(file)?;
        let recipe = format!("picture({path:?})");
        self.workbench
            .change_assets(AssetEdit::NewTexture { recipe })
    }

    /// Adds a model of a file to the scene.
    fn add_model(&mut self, file: &Path) -> Result<(), String> {
        let path = self.workbench.let_in(file)?;
        self.workbench.add_model(&path)
    }

    fn save_scene_to(&mut self, path: &Path) -> Result<(), String> {
        let saved = self.workbench.save_scene(&path.to_string_lossy());
        saved.map(|_| ())
    }
}
