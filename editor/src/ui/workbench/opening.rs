//! Files that a person brings from outside: scripts and models.

use std::path::Path;

use lightbench::script::SCENES;

use super::Workbench;
use crate::ui::messages::say;

/// The scene that shows a model.
const SHOWROOM: &str = "showroom";

/// The folder of pipelines.
const PIPELINES: &str = lightbench::script::PIPELINES;

impl Workbench {
    /// Opens a file: a script as a scene, or as a pipeline where it lies in a folder of such, and a
    /// model in the showroom.
    ///
    /// # Errors
    /// A sentence that says what can be opened, or what keeps the file from it.
    pub fn open_file(&mut self, file: &Path) -> Result<(), String> {
        let kind = file.extension().and_then(|kind| kind.to_str());
        let kind = kind.map(str::to_lowercase);
        let is_model = match kind.as_deref() {
            Some("rhai" | "scene") => false,
            Some("obj" | "gltf" | "glb") => true,
            _ => {
                return Err(say!(
                    "opening.is_no_scene_pipeline_or_model",
                    file = file.display()
                ));
            }
        };
        let path = self.files.grant(file).map_err(|error| error.to_string())?;
        self.scenes.use_files(self.files.clone());
        if is_model {
            let what = say!("history.model", path = file.display());
            self.as_place("scene", &what, true, |this| {
                this.select_scene(SHOWROOM);
                this.change_scene_parameter("model", Some(path.into()));
            });
            return Ok(());
        }
        let folder = file.parent().and_then(Path::file_name);
        let is_pipeline = path.starts_with(PIPELINES) || folder.is_some_and(|it| it == "pipelines");
        if is_pipeline && path.starts_with('@') {
            return Err(say!(
                "opening.is_a_pipeline_outside_the_project",
                file = file.display(),
                pipelines = PIPELINES
            ));
        }
        if is_pipeline {
            self.select_pipeline(short(PIPELINES, &path));
        } else {
            self.select_scene(short(SCENES, &path));
        }
        Ok(())
    }
}

/// The name of a script that lies in its folder; the path of any other.
fn short<'a>(folder: &str, path: &'a str) -> &'a str {
    let within = path
        .strip_prefix(folder)
        .and_then(|rest| rest.strip_prefix('/'));
    let stem = within.and_then(|name| name.strip_suffix(".rhai"));
    stem.filter(|stem| !stem.contains('/')).unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_in_their_folder_have_names() {
        assert_eq!(short(SCENES, "scripts/scenes/a.rhai"), "a");
        let below = "scripts/scenes/parts/a.rhai";
        assert_eq!(short(SCENES, below), below);
        assert_eq!(short(SCENES, "@0/a.rhai"), "@0/a.rhai");
    }
}
