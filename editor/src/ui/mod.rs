//! The editor's window.
//!
//! [`workbench`] is what the editor does, without a widget in it; [`Editor`] shows it and hands
//! it what a person wants; [`run`] puts the editor into a window that owns its device.

pub mod actions;
pub mod arrangement;
pub mod bench;
pub mod code;
mod coding;
pub mod compare_actions;
pub mod dialogs;
pub mod editor;
pub mod gallery;
mod keeping;
pub mod kept;
pub mod layout;
pub mod lens;
pub mod lesson;
mod lessoning;
pub mod menus;
pub(crate) mod messages;
mod panels;
mod panes;
mod pictures;
pub mod recovery;
mod runs;
mod screen;
mod surface;
pub mod theme;
mod window;
pub mod window_view;
pub mod workbench;

pub use editor::Editor;

use std::path::PathBuf;

use lightbench::assets::files::Files;
use lightbench::render::GpuOptions;
use lightbench::script::Settings;

use workbench::reporting::WorkerOptions;

/// What the editor opens with.
#[derive(Clone, Debug)]
pub struct EditorOptions {
    /// Where shaders and scripts come from; a project's files are watched.
    pub files: Files,
    /// Name or path of the first scene.
    pub scene: String,
    /// Values for the scene's parameters.
    pub scene_settings: Settings,
    /// Name or path of the first pipeline.
    pub pipeline: String,
    /// Values for the first pipeline's parameters.
    pub pipeline_settings: Settings,
    /// Which graphics adapter to use.
    pub gpu: GpuOptions,
    /// The file of what is kept over restarts; without one nothing is.
    pub kept: Option<PathBuf>,
    /// How processes that measure are started.
    pub worker: WorkerOptions,
}

impl EditorOptions {
    /// The atrium through deferred shading, with the files given.
    #[must_use]
    pub fn new(files: Files) -> Self {
        Self {
            files,
            scene: "atrium".to_owned(),
            scene_settings: Settings::new(),
            pipeline: "deferred_shading".to_owned(),
            pipeline_settings: Settings::new(),
            gpu: GpuOptions::default(),
            kept: None,
            worker: WorkerOptions::default(),
        }
    }
}

/// Opens the window and runs until it is closed.
///
/// # Errors
/// Without a display, or without a graphics driver that can draw to it.
pub fn run(options: EditorOptions) -> anyhow::Result<()> {
    window::run(options)
}
