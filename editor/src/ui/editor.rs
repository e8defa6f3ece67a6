//! The editor: a workbench and the widgets around it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use egui::mutex::RwLock;
use egui_tiles::Tree;
use lightbench::render::Gpu;

use super::actions::{self, Action};
use super::arrangement::Arrangement;
use super::code::Code;
use super::dialogs::{Dialogs, Question};
use super::gallery::Gallery;
use super::keeping;
use super::kept::Kept;
use super::layout::{self, Panel};
use super::lesson::Lessons;
use super::panels::assets::AssetsPanel;
use super::panels::code::CodePanel;
use super::panels::console::ConsolePanel;
use super::panels::entities::EntitiesPanel;
use super::panels::lesson::LessonPanel;
use super::panels::marks::Marks;
use super::panels::materials::MaterialsPanel;
use super::panels::notebook::NotebookPanel;
use super::panels::palette::Palette;
use super::panels::plots::PlotsPanel;
use super::panels::view_text::PasteWindow;
use super::panels::viewport::ViewportPanel;
use super::panels::{self, passes::PassesPanel, targets::TargetsPanel};
use super::panes::Panes;
use super::pictures::Pictures;
use super::recovery::Recovery;
use super::screen::Screen;
use super::window_view::WindowView;
use super::workbench::Workbench;
use super::workbench::sight::Sight;
use super::workbench::viewports::Viewport;

/// The state of the window's contents. [`Editor::ui`] draws it; who calls that owns the window.
pub struct Editor {
    /// What is edited.
    pub workbench: Workbench,
    pub(super) screen: Screen,
    pub(super) layout: Tree<Panel>,
    pub(super) passes: PassesPanel,
    pub(super) targets: TargetsPanel,
    pub(super) entities: EntitiesPanel,
    pub(super) materials: MaterialsPanel,
    pub(super) assets: AssetsPanel,
    /// Pictures of materials, meshes and textures.
    pub pictures: Pictures,
    pub(super) console: ConsolePanel,
    pub(super) plots: PlotsPanel,
    /// The files that are open.
    pub code: Code,
    pub(super) code_panel: CodePanel,
    /// What there is to look at.
    pub gallery: Gallery,
    /// Lessons, and the one that is open.
    pub lessons: Lessons,
    pub(super) lesson_panel: LessonPanel,
    /// Whether it is said what to try first.
    pub welcome: bool,
    /// Questions for files and folders.
    pub dialogs: Dialogs,
    pub(super) viewport: ViewportPanel,
    pub(super) notebook: NotebookPanel,
    /// The window in which a view is pasted, while it is open.
    pub(super) paste: Option<PasteWindow>,
    /// The palette, while it is open.
    pub(super) palette: Option<Palette>,
    /// What is kept so that a crash takes little.
    pub recovery: Recovery,
    /// Why what should be kept before the window closes is not.
    pub(super) not_kept: Option<String>,
    /// The window that saves the scene, while it is open.
    pub(super) saving: Option<panels::saving::Saving>,
    /// What is drawn over the picture of each viewport.
    pub(super) marks: [Marks; 2],
    /// What is kept over restarts.
    pub kept: Kept,
    /// How the window was arranged when that was last looked at.
    pub(super) arranged: Option<Arrangement>,
    /// How the window is arranged, as a part of what is looked at.
    pub(super) window_view: Arc<WindowView>,
    /// How it is arranged now, until it has been so in two frames.
    pub(super) window_coming: Option<WindowView>,
    /// A panel to show before those that share its place, once all are drawn.
    pub(super) bring: Option<Panel>,
    /// A panel to show, also where somebody has hidden it, once all are drawn.
    revealed: Option<Panel>,
    /// Whether what the mouse does is told over the picture.
    pub hint: bool,
    pub(super) help: bool,
    pub(super) about: bool,
    pub(super) quit: bool,
    /// Whether a widget had the keys in the last frame.
    pub(super) was_typing: bool,
    /// Whether the window had the keys in the last frame.
    pub(super) was_focused: bool,
    /// The file that was brought last.
    opened: Option<PathBuf>,
    /// The swap of scenes that is kept among those of late.
    remembered: u64,
    /// Whether the window's context has what was chosen for it.
    is_dressed: bool,
}

/// How much larger text gets at once.
const LARGER: f32 = 1.1;

impl Editor {
    /// An editor whose widgets are drawn by `painter` on the workbench's device.
    pub fn new(
        mut workbench: Workbench,
        painter: Arc<RwLock<egui_wgpu::Renderer>>,
        kept: Kept,
    ) -> Self {
        let screen = Screen::new(workbench.gpu().device.clone(), painter);
        let code = Code::new(kept.unsaved_folder(), workbench.files());
        let project = workbench.files().project();
        let recovery = keeping::open_recovery(kept.recovery_folder(), project);
        let Arrangement {
            panels: mut layout,
            marks,
            second,
        } = kept.arrangement.clone().unwrap_or_default();
        if let Some(look) = second {
            workbench.second.look_through_later(look.sight());
        }
        if !kept.lessons.open.is_empty() {
            layout::set_visible(&mut layout, Panel::Lesson, true);
        }
        if !code.offered.is_empty() {
            layout::set_visible(&mut layout, Panel::Code, true);
        }
        Self {
            code,
            code_panel: CodePanel::default(),
            dialogs: Dialogs::default(),
            gallery: Gallery::new(),
            lessons: super::lessoning::kept_lessons(&kept, workbench.files()),
            lesson_panel: LessonPanel::default(),
            welcome: kept.is_new,
            workbench,
            screen,
            layout,
            passes: PassesPanel::default(),
            targets: TargetsPanel::default(),
            entities: EntitiesPanel::default(),
            materials: MaterialsPanel::default(),
            assets: AssetsPanel::default(),
            pictures: Pictures::default(),
            console: ConsolePanel::default(),
            plots: PlotsPanel::default(),
            viewport: ViewportPanel::default(),
            notebook: NotebookPanel::default(),
            paste: None,
            palette: None,
            saving: None,
            recovery,
            not_kept: None,
            marks,
            kept,
            arranged: None,
            window_view: Arc::default(),
            window_coming: None,
            bring: None,
            revealed: None,
            hint: true,
            help: false,
            about: false,
            quit: false,
            was_typing: false,
            was_focused: true,
            opened: None,
            remembered: 0,
            is_dressed: false,
        }
    }

    /// Goes on with another device and painter; what was edited stays.
    pub fn move_to(&mut self, gpu: Gpu, painter: Arc<RwLock<egui_wgpu::Renderer>>) {
        self.screen = Screen::new(gpu.device.clone(), painter);
        self.gallery.thumbnails.forget();
        self.is_dressed = false;
        self.pictures.forget();
        self.workbench.move_to(gpu);
    }

    /// The same, from within a panel: the layout is at work until all are drawn.
    pub(super) fn reveal(&mut self, panel: Panel) {
        self.revealed = Some(panel);
    }

    /// Brings a panel before those that share its place.
    pub fn show(&mut self, panel: Panel) {
        layout::set_visible(&mut self.layout, panel, true);
    }

    /// Puts the panels into another order.
    pub fn lay_out(&mut self, layout: Tree<Panel>) {
        self.layout = layout;
    }

    /// Where a panel was drawn in the last frame, in points; `None` where it is not shown.
    pub fn rect_of(&self, panel: Panel) -> Option<egui::Rect> {
        layout::rect(&self.layout, panel)
    }

    /// Whether somebody asked to close the window.
    pub fn wants_to_quit(&self) -> bool {
        self.quit
    }

    /// Draws one frame of the window and does what was asked for in it.
    pub fn ui(&mut self, ui: &mut egui::Ui) {
        let now = Instant::now();
        self.workbench.tick(now);
        let ctx = ui.ctx().clone();
        self.dress(&ctx);
        self.tend_code(now, ctx.input(|input| input.focused));
        self.tend_recovery(now);
        self.tend_lessons();
        panels::code::keys(self, &ctx);
        actions::keyboard(self, &ctx);

        egui::Panel::top("menu").show(ui, |ui| panels::menu::show(self, ui));
        egui::Panel::top("toolbar").show(ui, |ui| panels::toolbar::show(self, ui));
        egui::Panel::bottom("status").show(ui, |ui| panels::status::show(self, ui));
        egui::CentralPanel::no_frame().show(ui, |ui| {
            // The panels need the editor, and the tree is a part of it.
            let mut tree =
                std::mem::replace(&mut self.layout, Tree::empty(egui::Id::unique("moved")));
            panels::steering::begin(self);
            tree.ui(&mut Panes { editor: self, now }, ui);
            panels::steering::end(self);
            if self.layout.is_empty() {
                self.layout = tree;
            }
        });
        // A panel that somebody has hidden stays so, and who works with entities goes on with them.
        let brought = self.bring.take().filter(|panel| {
            let with_entities = [
                Panel::Entities,
                Panel::Materials,
                Panel::Assets,
                Panel::Environment,
            ];
            let mut at_work = with_entities.iter();
            *panel != Panel::Pixel
                || !at_work.any(|panel| layout::is_in_front(&self.layout, *panel))
        });
        if let Some(panel) = brought.filter(|panel| layout::is_visible(&self.layout, *panel)) {
            layout::set_visible(&mut self.layout, panel, true);
        }
        self.tend_pictures(&ctx);
        panels::help::show(self, &ctx);
        panels::welcome::show(self, &ctx);
        panels::gallery::show(self, &ctx);
        panels::palette::show(self, &ctx);
        panels::view_text::show(self, &ctx);
        panels::leaving::show(self, &ctx);
        panels::recovery::show(self, &ctx);
        self.follow_dialogs(&ctx);
        panels::saving::show(self, &ctx);
        if let Some(panel) = self.revealed.take() {
            self.show(panel);
            ctx.request_repaint();
        }
        self.take_dropped_files(&ctx);
        self.remember_scene();
        self.tend_window_view(&ctx);
        self.remember_arrangement(&ctx);
        self.take_number_keys();

        let held = ctx.input(|input| input.pointer.any_down() || !input.keys_down.is_empty());
        self.was_typing = ctx.egui_wants_keyboard_input();
        self.workbench.note_dials();
        let window = Arc::clone(&self.window_view);
        self.workbench.note_view(now, held, &window);
        if !held && !self.was_typing {
            self.workbench.undo.seal();
        }

        let due = [
            self.workbench.next_due(now),
            self.code.next_due(now),
            self.recovery.next_due(now),
        ];
        if let Some(due) = due.into_iter().flatten().min() {
            ctx.request_repaint_after(due);
        }
    }

    /// Does what a menu or a key asks for.
    pub fn perform(&mut self, action: Action, ctx: &egui::Context) {
        let workbench = &mut self.workbench;
        match action {
            Action::PlayPause => workbench.play_or_pause(),
            Action::Step => workbench.step(),
            Action::Stop => workbench.stop(),
            Action::Rewind => workbench.rewind(),
            Action::Frame => workbench.frame_scene(),
            Action::FrameSelection => workbench.frame_selection(),
            Action::ResetCamera => workbench.reset_camera(),
            Action::LookFrom(side) => workbench.look_through(Sight::Side(side)),
            Action::Perspective => workbench.look_through(Sight::Perspective),
            Action::OtherViewport => workbench.set_focus(workbench.focus().other()),
            Action::Mark(mark) => self.marks[workbench.focus() as usize].toggle(mark),
            Action::Compare(action) => super::compare_actions::perform(self, action, ctx),
            Action::Palette => self.palette = Some(Palette::default()),
            Action::Undo => _ = workbench.undo(),
            Action::Redo => _ = workbench.redo(),
            Action::ViewBack => _ = workbench.view_back(),
            Action::ViewForth => _ = workbench.view_forth(),
            Action::Tool(tool) => self.viewport.handles.tool = tool,
            Action::LocalAxes => self.viewport.handles.local = !self.viewport.handles.local,
            // Out of the walk through the frame first.
            Action::SelectNone if workbench.is_stopped() => workbench.stop_after(None),
            Action::SelectNone => workbench.selection.clear(),
            Action::PassAfter => workbench.stop_by(1),
            Action::PassBefore => workbench.stop_by(-1),
            Action::WholeFrame => workbench.stop_after(None),
            Action::Create(_)
            | Action::Duplicate
            | Action::Delete
            | Action::Rename
            | Action::Detach
            | Action::Hide
            | Action::Lock => panels::entities::perform(self, action),
            Action::SaveScene => self.saving = Some(panels::saving::Saving::new(workbench)),
            Action::NextPipeline => self.select_beside(1),
            Action::PreviousPipeline => self.select_beside(-1),
            Action::Reload => workbench.reload(),
            Action::Toggle(panel) => {
                let visible = layout::is_visible(&self.layout, panel);
                layout::set_visible(&mut self.layout, panel, !visible);
                if panel == Panel::Second && !visible {
                    workbench.open_second();
                    workbench.set_focus(Viewport::Second);
                }
            }
            Action::ResetLayout => self.layout = layout::first(),
            Action::SwitchTheme => {
                let dark = ctx.theme() == egui::Theme::Dark;
                let other = if dark {
                    egui::Theme::Light
                } else {
                    egui::Theme::Dark
                };
                ctx.set_theme(other);
                let kept = self.kept.choose_dark(!dark);
                self.tell_if_not_kept(kept);
            }
            Action::LargerText => self.scale_text(Some(LARGER), ctx),
            Action::SmallerText => self.scale_text(Some(1.0 / LARGER), ctx),
            Action::UsualText => self.scale_text(None, ctx),
            Action::Help => self.help = !self.help,
            Action::About => self.about = true,
            Action::EditScene => self.edit_scene(),
            Action::EditPipeline => self.edit_pipeline(),
            Action::Save => self.save(),
            Action::OpenProject => self.ask_for(Question::Project),
            Action::OpenScene => self.ask_for(Question::Scene),
            Action::Gallery => {
                let (files, wake) = (
                    self.workbench.files().clone(),
                    self.workbench.wake().clone(),
                );
                self.gallery.open(&files, &wake);
            }
            Action::Lessons => self.reveal(Panel::Lesson),
            Action::CheckLesson => self.check_lesson(),
            Action::Welcome => self.welcome = true,
            Action::Quit => self.ask_to_quit(),
        }
    }

    /// Opens a scene by its name, or a file by its path.
    pub(super) fn open_scene(&mut self, name: &str) {
        let path = Path::new(name);
        if path.is_absolute() {
            self.open_file(path);
        } else {
            self.workbench.select_scene(name);
        }
    }

    /// Opens a file that somebody brought.
    pub(super) fn open_file(&mut self, file: &Path) {
        if let Err(why) = self.try_to_open_file(file) {
            self.workbench.log.error(why);
            layout::set_visible(&mut self.layout, Panel::Log, true);
        }
    }

    /// The same; what keeps the file from being opened is told.
    pub(super) fn try_to_open_file(&mut self, file: &Path) -> Result<(), String> {
        self.workbench.open_file(file)?;
        self.opened = std::path::absolute(file).ok();
        Ok(())
    }

    /// The file that was brought last is none of the present project.
    pub(super) fn forget_opened_file(&mut self) {
        self.opened = None;
    }

    /// Opens the files that were dropped onto the window.
    fn take_dropped_files(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        for file in dropped.iter().map(|file| file.path()) {
            self.open_file(file);
        }
    }

    /// Keeps the scene on screen among those of late.
    fn remember_scene(&mut self) {
        let scenes = &self.workbench.scenes;
        let Some(name) = scenes.shown().filter(|_| scenes.swaps() != self.remembered) else {
            return;
        };
        self.remembered = scenes.swaps();
        // A file of another folder has no name that holds over restarts, but a path.
        let path = self.opened.as_deref().and_then(Path::to_str);
        let is_outside = name.starts_with('@');
        let known = if is_outside { path } else { Some(name) };
        if let Some(known) = known.map(str::to_owned)
            && let Err(error) = self.kept.remember_scene(&known)
        {
            self.workbench.log.warn(error);
        }
    }

    /// Makes text and widgets larger or smaller, or as large as the system says.
    fn scale_text(&mut self, factor: Option<f32>, ctx: &egui::Context) {
        let kept = match factor {
            Some(factor) => self.kept.scale_by(factor),
            None => self.kept.reset_scale(),
        };
        self.tell_if_not_kept(kept);
        ctx.set_zoom_factor(self.kept.scale);
    }

    pub(super) fn tell_if_not_kept(&mut self, kept: Result<(), String>) {
        if let Err(error) = kept {
            self.workbench.log.warn(error);
        }
    }

    /// Gives a context that is new what somebody chose: a dark window or a light one, and how large text is.
    fn dress(&mut self, ctx: &egui::Context) {
        if std::mem::replace(&mut self.is_dressed, true) {
            return;
        }
        if let Some(dark) = self.kept.dark {
            ctx.set_theme(match dark {
                true => egui::Theme::Dark,
                false => egui::Theme::Light,
            });
        }
        // The editor has keys of its own for it, whose choice is kept.
        ctx.options_mut(|options| options.zoom_with_keyboard = false);
        ctx.set_zoom_factor(self.kept.scale);
    }

    fn select_beside(&mut self, by: isize) {
        let workbench = &mut self.workbench;
        let selected = workbench.pipelines.selected().to_owned();
        let next = workbench.library.pipeline_beside(&selected, by);
        if let Some(next) = next.map(str::to_owned) {
            workbench.select_pipeline(&next);
        }
    }
}
