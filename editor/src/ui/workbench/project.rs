//! Another project in the place of the present one.

use std::path::Path;

use lightbench::assets::files::Files;

use super::notebook::Notebook;
use super::reporting::WorkerOptions;
use super::watching::{Touched, Watch};
use super::{Wake, Workbench};

impl Workbench {
    /// Goes on with the files of another project. Scene and pipeline are those of the same names
    /// there.
    ///
    /// # Errors
    /// A sentence, where the folder can't be read; the present project stays.
    pub fn open_project(&mut self, folder: &Path) -> Result<(), String> {
        let files = Files::with_project(folder).map_err(|error| error.to_string())?;
        // What was done by hand was done to the scenes of the former one.
        self.overlays.clear();
        self.saved.clear();
        (self.typed, self.saved_lines) = Default::default();
        self.coming.clear();
        self.forget_views();
        self.notebook = Notebook::default();
        self.watch = Watch::start(&files, &self.wake, &mut self.log);
        self.use_files(files);
        let compiler = self.renderer.compiler();
        self.pipelines
            .move_to(compiler, self.files.clone(), self.wake.clone());
        self.renderer.inspector().forget_shaders();
        // Files outside of the former project have other numbers now.
        let scene = self.scenes.selected();
        if scene.starts_with('@') || !self.has_scene(scene) {
            self.quietly(|this| this.select_scene("atrium"));
        }
        self.reload();
        self.undo.begin_anew();
        Ok(())
    }

    fn has_scene(&self, name: &str) -> bool {
        let path = format!("{}/{name}.rhai", lightbench::script::SCENES);
        self.files.exists(name) || self.files.exists(&path)
    }

    /// Reads from another store from now on.
    pub(in crate::ui) fn use_files(&mut self, files: Files) {
        self.scenes.use_files(files.clone());
        self.files = files;
    }

    /// Who is told when a thread has finished something.
    pub(in crate::ui) fn wake(&self) -> &Wake {
        &self.wake
    }

    /// How processes of the program are started.
    pub(in crate::ui) fn worker(&self) -> &WorkerOptions {
        &self.worker
    }

    /// Whether changes of the project's files are noticed.
    pub fn is_watching(&self) -> bool {
        self.watch.is_on()
    }

    /// What changed on the disk since the last call.
    pub(in crate::ui) fn take_touched(&mut self) -> Option<Touched> {
        self.touched.take()
    }
}
