//! The editor on a project of its own, for tests.

// Each file of tests uses a part of it.
#![allow(dead_code)]

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::mutex::RwLock;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use egui_kittest::wgpu::WgpuTestRenderer;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::experiment::Workbench as Laboratory;
use lightbench::render::readback::read_bytes;
use lightbench::render::{Gpu, GpuOptions};
use lightbench::script::{LogLine, Settings, run_experiment};
use lightbench_editor::ui::kept::Kept;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::Workbench;
use lightbench_editor::ui::workbench::history::Deed;
use lightbench_editor::ui::workbench::reporting::WorkerOptions;
use lightbench_editor::ui::{Editor, EditorOptions, theme};
use tempfile::TempDir;

/// How long anything may take.
pub const PATIENCE: Duration = Duration::from_secs(120);

/// Ctrl as keyboards send it.
pub const CTRL: egui::Modifiers = egui::Modifiers {
    ctrl: true,
    command: true,
    ..egui::Modifiers::NONE
};

/// The editor on a project of its own.
pub struct Bench {
    /// The project's files.
    pub files: Files,
    /// The editor and its widgets.
    pub harness: Harness<'static, Editor>,
    // Last, so that the watcher ends before the folder does.
    _project: TempDir,
}

impl Bench {
    /// Opens the Cornell box through deferred shading and waits for the first picture.
    pub fn open() -> Self {
        Self::open_with(None)
    }

    /// The same, with a file of what is kept over restarts.
    pub fn open_with(kept: Option<PathBuf>) -> Self {
        Self::open_project(tempfile::tempdir().unwrap(), kept)
    }

    /// The same, in a folder that may have files.
    pub fn open_project(project: TempDir, kept: Option<PathBuf>) -> Self {
        Self::open_project_of("cornell_box", project, kept)
    }

    /// The same, with another scene.
    pub fn open_project_of(scene: &str, project: TempDir, kept: Option<PathBuf>) -> Self {
        let files = Files::with_project(project.path()).unwrap();
        let gpu = Gpu::open(&GpuOptions::default()).unwrap();
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let settings = egui_wgpu::RendererOptions::PREDICTABLE;
        let painter = egui_wgpu::Renderer::new(&gpu.device, format, settings);
        let painter = Arc::new(RwLock::new(painter));
        let state = egui_wgpu::RenderState {
            adapter: gpu.adapter.clone(),
            available_adapters: Vec::new(),
            instance: wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle()),
            device: gpu.device.clone(),
            queue: gpu.queue.clone(),
            target_format: format,
            renderer: Arc::clone(&painter),
        };
        let renderer = WgpuTestRenderer::from_render_state(state);
        let options = EditorOptions {
            scene: scene.to_owned(),
            worker: WorkerOptions {
                program: Some(PathBuf::from(env!("CARGO_BIN_EXE_lightbench"))),
                limits: None,
            },
            ..EditorOptions::new(files.clone())
        };
        let mut workbench = Workbench::new(gpu, options, Arc::new(|| {}));
        workbench.resolution.adaptive = false;
        let mut editor = Editor::new(workbench, painter, Kept::read(kept));
        // No window of the system opens in a test.
        editor.dialogs.native = false;
        // Nothing lies over the picture that is clicked on.
        editor.hint = false;
        let harness = Harness::builder()
            .with_size(egui::vec2(1280.0, 800.0))
            .renderer(renderer)
            .build_ui_state(
                |ui, editor: &mut Editor| {
                    theme::apply(ui.ctx());
                    editor.ui(ui);
                },
                editor,
            );
        let mut bench = Self {
            files,
            harness,
            _project: project,
        };
        bench.until("the first picture", |editor| {
            editor.workbench.drawn_size().is_some() && !editor.workbench.library.is_busy()
        });
        bench.harness.run_steps(2);
        bench
    }

    /// Ends the editor and gives back its project.
    pub fn close(self) -> TempDir {
        let Self {
            harness, _project, ..
        } = self;
        drop(harness);
        _project
    }

    /// Presses a key with others held, and lets some frames pass.
    pub fn key(&mut self, modifiers: egui::Modifiers, key: egui::Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.harness.run_steps(3);
    }

    /// Types letters, without keys that do something else.
    pub fn type_text(&mut self, text: &str) {
        self.harness.event(egui::Event::Text(text.to_owned()));
        self.harness.run_steps(2);
    }

    /// Clicks the button of that name.
    pub fn press(&mut self, label: &str) {
        self.harness
            .get_by_role_and_label(Role::Button, label)
            .click();
        self.harness.run_steps(3);
    }

    /// Runs frames until something is true.
    pub fn until(&mut self, what: &str, done: impl Fn(&mut Editor) -> bool) {
        let began = Instant::now();
        loop {
            self.harness.step();
            if done(self.harness.state_mut()) {
                return;
            }
            assert!(began.elapsed() < PATIENCE, "waited in vain for {what}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// The bytes of the viewport's picture, once it shows the present state at its present size.
    pub fn picture(&mut self) -> Vec<u8> {
        let began = Instant::now();
        loop {
            self.harness.step();
            let viewport = self.harness.get_by_role_and_label(Role::Image, "Viewport");
            let size = viewport.rect().size();
            let size = (size.x.round() as u32, size.y.round() as u32);
            let workbench = &self.harness.state().workbench;
            if workbench.picture_is_current() && workbench.drawn_size() == Some(size) {
                break;
            }
            assert!(
                began.elapsed() < PATIENCE,
                "no picture of the present state"
            );
            std::thread::sleep(Duration::from_millis(5));
        }
        let workbench = &mut self.harness.state_mut().workbench;
        let picture = workbench.picture().unwrap();
        read_bytes(workbench.gpu(), &picture.texture).unwrap()
    }

    /// Runs frames until the picture is another one.
    pub fn until_picture_is_not(&mut self, before: &[u8]) -> Vec<u8> {
        let began = Instant::now();
        loop {
            let now = self.picture();
            if now != before {
                return now;
            }
            assert!(began.elapsed() < PATIENCE, "the picture stayed the same");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Chooses the entities of those names.
    pub fn choose_entities(&mut self, names: &[&str]) {
        let workbench = &mut self.harness.state_mut().workbench;
        let scene = workbench.scenes.scene().unwrap();
        let found = names.iter().map(|name| scene.world.find(name).unwrap());
        let entities: Vec<_> = found.collect();
        workbench.selection.set(scene, entities);
        self.harness.run_steps(2);
    }

    /// Opens a combo box and picks an entry.
    pub fn choose(&mut self, combo: &str, entry: &str) {
        self.harness
            .get_by_role_and_label(Role::ComboBox, combo)
            .click();
        self.harness.run_steps(3);
        // Entries may have a key behind their title.
        let is_entry = |role: Role, label: Option<String>, whole: bool| {
            let fits = |label: String| label == entry || (!whole && label.starts_with(entry));
            role == Role::Button && label.is_some_and(fits)
        };
        let harness = &self.harness;
        let exact = harness.query_by(|node| is_entry(node.role(), node.label(), true));
        let node = exact
            .unwrap_or_else(|| harness.get_by(|node| is_entry(node.role(), node.label(), false)));
        node.click();
        self.harness.run_steps(2);
    }

    /// Presses and releases the mouse.
    pub fn click_at(&mut self, at: egui::Pos2) {
        self.harness.hover_at(at);
        self.harness.step();
        self.harness.drag_at(at);
        self.harness.step();
        self.harness.drop_at(at);
        self.harness.step();
    }

    /// Whether the message over the picture is there.
    pub fn has_message(&self) -> bool {
        self.harness
            .query_by_label_contains("The last good picture stays")
            .is_some()
    }

    /// How often a text is on the screen: an error's place is over the picture and in the log.
    pub fn count(&self, text: &str) -> usize {
        self.harness.query_all_by_label_contains(text).count()
    }

    /// The pipeline that draws.
    pub fn shown(&self) -> String {
        let pipelines = &self.harness.state().workbench.pipelines;
        pipelines.shown().unwrap_or_default().to_owned()
    }

    /// A shipped file as a file of the project.
    pub fn own(&self, path: &str) -> (PathBuf, String) {
        let text = self.files.read_text(path).unwrap();
        (self.files.copy_to_project(path).unwrap(), text)
    }

    /// Brings a panel before those that share its place.
    pub fn show(&mut self, panel: Panel) {
        self.harness.state_mut().show(panel);
        self.harness.run_steps(3);
    }

    /// The project's folder.
    pub fn path(&self) -> &std::path::Path {
        self._project.path()
    }

    /// Saves a file of the project.
    pub fn save(&self, path: &str, text: &str) {
        let path = self._project.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// What was done last.
    pub fn last_deed(&self) -> Deed {
        let history = &self.harness.state().workbench.history;
        history.deeds().next_back().unwrap().clone()
    }

    /// Clicks a button and gives what it copies.
    pub fn copied_by(&mut self, label: &str) -> String {
        self.harness
            .get_by_role_and_label(Role::Button, label)
            .click();
        for _ in 0..4 {
            self.harness.step();
            let commands = &self.harness.output().platform_output.commands;
            let text = commands.iter().find_map(|command| match command {
                egui::OutputCommand::CopyText(text) => Some(text.clone()),
                _ => None,
            });
            if let Some(text) = text {
                return text;
            }
        }
        String::new()
    }

    /// Runs an experiment on the project's files, and gives what it printed.
    pub fn run_experiment(&self, text: &str) -> Vec<String> {
        let said = Arc::new(Mutex::new(Vec::new()));
        self.save("scripts/experiments/test.rhai", text);
        let progress = Progress::new();
        let gpu = GpuOptions::default();
        let laboratory = Laboratory::new(&self.files, gpu, &progress, |_| {});
        let told = Arc::clone(&said);
        let print = move |line: LogLine| told.lock().unwrap().push(line.text);
        let (settings, laboratory) = (Settings::new(), Box::new(laboratory));
        run_experiment(&self.files, "test", &settings, laboratory, print, &progress).unwrap();
        let said = said.lock().unwrap();
        said.clone()
    }

    /// Whether anything keeps the newest state off the screen.
    pub fn has_problems(editor: &Editor) -> bool {
        editor.workbench.problems().next().is_some()
    }
}
