//! What a person changes of materials, meshes and textures. Each is a change of the structure that can be
//! taken back.

use std::path::Path;

use lightbench::assets::files::FileError;
use lightbench::script::overlays::{AssetEdit, Edit, SurfaceField, SurfaceValue, Who};
use lightbench::world::{Entity, Transform};

use super::Workbench;
use crate::ui::messages::say;

/// The folder of a project into which pictures from elsewhere are copied.
const TEXTURES: &str = "textures";

impl Workbench {
    /// Changes assets by hand, as one step.
    ///
    /// # Errors
    /// A sentence that says why it can't be. Then nothing has changed.
    pub fn change_assets(&mut self, edit: AssetEdit) -> Result<(), String> {
        self.edit(Edit::Assets(edit))
    }

    /// Changes one field of materials. Changes of the same that follow at once, as while a slider is
    /// dragged, are one step.
    ///
    /// # Errors
    /// As [`Workbench::change_assets`].
    pub fn paint(
        &mut self,
        field: SurfaceField,
        of: Vec<(Who, Option<SurfaceValue>)>,
    ) -> Result<(), String> {
        let edit = Edit::Assets(AssetEdit::Paint { field, of });
        let grows = self.undo.growing().filter(|old| is_same(old, &edit));
        let Some(old) = grows.cloned() else {
            let edit = self.do_edit(edit)?;
            self.note_growing(edit);
            return Ok(());
        };
        self.take_back_edit(&old)?;
        match self.do_edit(edit) {
            Ok(edit) => {
                self.undo.regrow(edit);
                Ok(())
            }
            Err(why) => {
                // It could be done a moment ago.
                self.do_edit(old)?;
                Err(why)
            }
        }
    }

    /// Gives what is chosen another material.
    ///
    /// # Errors
    /// As [`Workbench::change_assets`].
    pub fn dress_chosen(&mut self, material: Option<Who>) -> Result<(), String> {
        let of = self.chosen(Who::of)?;
        self.change_assets(AssetEdit::Dress { of, material })
    }

    /// Gives what is chosen another mesh.
    ///
    /// # Errors
    /// As [`Workbench::change_assets`].
    pub fn reshape_chosen(&mut self, mesh: Option<Who>) -> Result<(), String> {
        let of = self.chosen(Who::of)?;
        self.change_assets(AssetEdit::Reshape { of, mesh })
    }

    /// Adds a model to the scene, where the view is turned to.
    ///
    /// # Errors
    /// As [`Workbench::change_assets`].
    pub fn add_model(&mut self, path: &str) -> Result<(), String> {
        if path.starts_with('@') {
            self.log.warn(say!("assets.outside", path = path));
        }
        self.change_assets(AssetEdit::AddModel {
            path: path.to_owned(),
            name: String::new(),
            number: 0,
            place: Transform::from_translation(self.camera.pivot()),
        })
    }

    /// Lets a file in that a person brought, also for the scene on screen. Returns its path for scripts.
    ///
    /// # Errors
    /// A file that is not there.
    pub fn let_in(&mut self, file: &Path) -> Result<String, String> {
        let path = self.files.grant(file).map_err(|error| error.to_string())?;
        self.scenes.use_files(self.files.clone());
        if let Some(scene) = self.scenes.scene_mut() {
            scene.let_in(self.files.grants());
        }
        Ok(path)
    }

    /// Lets a picture in. Where there is a project, one from elsewhere is copied into it, so that a saved
    /// scene finds it.
    ///
    /// # Errors
    /// A file that is not there, or can't be copied.
    pub fn import_picture(&mut self, file: &Path) -> Result<String, String> {
        let path = self.let_in(file)?;
        if !path.starts_with('@') || self.files.project().is_none() {
            return Ok(path);
        }
        let bytes = self.files.read(&path).map_err(|error| error.to_string())?;
        let name = path.rsplit('/').next().unwrap_or(&path);
        let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
        let mut number = 1;
        loop {
            let name = match number {
                1 => format!("{TEXTURES}/{name}"),
                number => format!("{TEXTURES}/{stem}-{number}.{ending}"),
            };
            let there = self.files.read(&name);
            match there {
                Ok(known) if known == bytes => return Ok(name),
                Ok(_) => number += 1,
                Err(FileError::NotFound { .. }) => {
                    let written = self.files.write(&name, &bytes);
                    let written = written.map_err(|error| error.to_string())?;
                    let place = written.display();
                    self.log.info(say!("assets.copied_to", place = place));
                    return Ok(name);
                }
                Err(error) => return Err(error.to_string()),
            }
        }
    }

    /// The names of entities, some of them, for people.
    pub fn names_for_people(&self, entities: &[Entity]) -> String {
        /// So many are named.
        const SOME: usize = 12;
        let Some(scene) = self.scenes.scene() else {
            return String::new();
        };
        let some = &entities[..entities.len().min(SOME)];
        let names: Vec<String> = Who::of(&scene.world, some).iter().map(Who::words).collect();
        let mut text = names.join(", ");
        if entities.len() > SOME {
            let more = entities.len() - SOME;
            text += &say!("assets.and_more", more = more);
        }
        text
    }
}

/// Whether two changes change the same field of the same materials.
fn is_same(a: &Edit, b: &Edit) -> bool {
    let (Edit::Assets(a), Edit::Assets(b)) = (a, b) else {
        return false;
    };
    match (a, b) {
        (
            AssetEdit::Paint { field: a, of: one },
            AssetEdit::Paint {
                field: b,
                of: other,
            },
        ) => {
            let names = |of: &[(Who, _)]| of.iter().map(|(who, _)| who.clone()).collect::<Vec<_>>();
            a == b && names(one) == names(other)
        }
        _ => false,
    }
}
