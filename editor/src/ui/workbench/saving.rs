//! Writing the scene as a file that holds its world.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lightbench::script::SCENE_EXTENSION;

use super::Workbench;
use crate::ui::messages::say;

/// The folder in which saved scenes lie.
const FOLDER: &str = "scripts/scenes";

impl Workbench {
    /// A name for the file of the scene on screen.
    pub fn name_to_save(&self) -> String {
        let shown = self.scenes.shown().unwrap_or("scene");
        let name = shown.rsplit(['/', '\\']).next().unwrap_or(shown);
        let name = name.split('.').next().unwrap_or(name);
        format!("{name}_edited")
    }

    /// Writes the scene as it is now, with all that was changed by hand. A name goes to the project's
    /// scenes, a path to where it leads. Returns the file.
    ///
    /// # Errors
    /// A sentence that says what is wrong.
    pub fn save_scene(&mut self, name: &str) -> Result<PathBuf, String> {
        let name = name.trim();
        let plain = name.strip_suffix(&format!(".{SCENE_EXTENSION}"));
        let plain = plain.unwrap_or(name);
        if plain.is_empty() {
            return Err(say!("saving.give_the_file_a_name").to_owned());
        }
        let Some(scene) = self.scenes.scene_mut() else {
            return Err(say!("saving.no_scene_is_loaded").to_owned());
        };
        let update = scene.has_update();
        let text = scene.to_text().map_err(|problem| problem.message)?;
        let is_path = Path::new(plain).is_absolute();
        let file = if is_path {
            let file = PathBuf::from(format!("{plain}.{SCENE_EXTENSION}"));
            scene.save(&file).map_err(|problem| problem.message)?;
            file
        } else {
            let path = format!("{FOLDER}/{plain}.{SCENE_EXTENSION}");
            let written = self.files.write(&path, text.as_bytes());
            written.map_err(|error| error.to_string())?
        };
        self.was_saved();
        self.log
            .info(say!("saving.saved_as", file = file.display()));
        if update {
            self.log.warn(say!("saving.the_script_update_is_not_part"));
        }
        for file in self.outside(&text) {
            self.log.warn(say!("saving.outside", file = file));
        }
        self.library.refresh(&self.files, &self.wake);
        Ok(file)
    }
    /// The files outside of the project that the text of a scene names. Their paths there hold for this run.
    fn outside(&self, text: &str) -> BTreeSet<String> {
        // What stands between quotes: every second piece.
        let names = text
            .lines()
            .flat_map(|line| line.split('"').skip(1).step_by(2));
        let of_this_run = names.filter(|name| name.starts_with('@'));
        let files = of_this_run.map(|name| self.files.display(name));
        files.filter(|file| Path::new(file).is_absolute()).collect()
    }
}
