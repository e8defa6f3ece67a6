//! Asking for a file or a folder: by the system's own dialog, or by its path where there is none.

use std::env;
use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::{Arc, OnceLock};
use std::task::{Context as TaskContext, Poll, Wake, Waker};
use std::time::{Duration, Instant};

use egui::{Context, Id, Key, Modal, Modifiers, RichText, TextEdit};
use lightbench::script::SCENE_EXTENSION;
use rfd::{AsyncFileDialog, FileHandle};
use winit::window::Window;

use super::pictures::{MODELS, PICTURES};
use crate::ui::messages::say;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// The folder of a project.
    Project,
    /// A scene, a pipeline or a model.
    Scene,
    /// A picture for materials.
    Picture,
    /// A picture for the scene.
    Texture,
    /// A model to add to the scene.
    Model,
    /// Where to write the scene on screen.
    SaveScene,
    /// Where to begin a lesson.
    Lesson,
}

impl Question {
    fn title(self) -> &'static str {
        match self {
            Self::Project => say!("dialogs.open_a_project"),
            Self::Scene => say!("dialogs.open_a_scene"),
            Self::Picture | Self::Texture => say!("assets.ask_picture"),
            Self::Model => say!("assets.ask_model"),
            Self::SaveScene => say!("dialogs.save_the_scene_as"),
            Self::Lesson => say!("lesson.folder_title"),
        }
    }

    fn about(self) -> &'static str {
        match self {
            Self::Project => {
                say!("dialogs.the_folder_of_a_project_in")
            }
            Self::Scene => {
                say!("dialogs.a_script_rhai_a_saved_scene")
            }
            Self::Picture | Self::Texture => say!("assets.ask_picture_about"),
            Self::Model => say!("assets.ask_model_about"),
            Self::SaveScene => say!("dialogs.the_file_to_write_it_ends"),
            Self::Lesson => say!("lesson.folder_about"),
        }
    }
}

/// An answer that comes sooner than a person could give it: there was no dialog.
const AT_ONCE: Duration = Duration::from_millis(300);

type Answer = Pin<Box<dyn Future<Output = Option<FileHandle>> + Send>>;

/// A dialog of the system that is open.
struct Native {
    question: Question,
    begin_at: Option<PathBuf>,
    since: Instant,
    bell: Option<Arc<Bell>>,
    answer: Answer,
}

impl Native {
    fn new(question: Question, begin_at: Option<&Path>, answer: Answer) -> Self {
        Self {
            question,
            begin_at: begin_at.map(Path::to_owned),
            since: Instant::now(),
            bell: None,
            answer,
        }
    }

    fn poll(&mut self, ctx: &Context) -> Poll<Option<FileHandle>> {
        let bell = self.bell.get_or_insert_with(|| {
            Arc::new(Bell {
                ctx: ctx.clone(),
                rung: OnceLock::new(),
            })
        });
        let waker = Waker::from(Arc::clone(bell));
        let mut context = TaskContext::from_waker(&waker);
        self.answer.as_mut().poll(&mut context)
    }

    /// How long the answer took. The window may have looked for it later, in its next frame.
    fn took(&self) -> Duration {
        let rung = self.bell.as_ref().and_then(|bell| bell.rung.get());
        rung.map_or(self.since.elapsed(), |rung| {
            rung.saturating_duration_since(self.since)
        })
    }
}

/// A path that is typed.
struct Typed {
    question: Question,
    path: String,
    why_not: Option<String>,
    focus: bool,
}

/// The question that is asked, if one is.
pub struct Dialogs {
    /// Whether the system is asked for its dialogs.
    pub native: bool,
    /// The window before which they lie.
    pub(super) window: Option<Arc<Window>>,
    open: Option<Native>,
    typed: Option<Typed>,
}

impl Default for Dialogs {
    fn default() -> Self {
        Self {
            native: has_dialogs(),
            window: None,
            open: None,
            typed: None,
        }
    }
}

/// Draws a window when a dialog has an answer, and notes when that came.
struct Bell {
    ctx: Context,
    rung: OnceLock<Instant>,
}

impl Wake for Bell {
    fn wake(self: Arc<Self>) {
        self.rung.get_or_init(Instant::now);
        self.ctx.request_repaint();
    }
}

impl Dialogs {
    /// Asks. Who asks again while a dialog should be open does not see it: a path is asked for.
    pub fn ask(&mut self, question: Question, begin_at: Option<&Path>) {
        if self.typed.is_some() {
            return;
        }
        if self.open.take().is_some() || !self.native {
            self.ask_for_path(question, begin_at);
            return;
        }
        let mut dialog = AsyncFileDialog::new().set_title(question.title());
        if let Some(folder) = begin_at {
            dialog = dialog.set_directory(folder);
        }
        if let Some(window) = &self.window {
            dialog = dialog.set_parent(window);
        }
        let answer: Answer = match question {
            Question::Project | Question::Lesson => Box::pin(dialog.pick_folder()),
            Question::Scene => {
                let endings = ["rhai", SCENE_EXTENSION, "obj", "gltf", "glb"];
                Box::pin(
                    dialog
                        .add_filter(say!("dialogs.scenes_and_models"), &endings)
                        .pick_file(),
                )
            }
            Question::Picture | Question::Texture => {
                let title = say!("assets.pictures");
                Box::pin(dialog.add_filter(title, &PICTURES).pick_file())
            }
            Question::Model => {
                let title = say!("assets.models");
                Box::pin(dialog.add_filter(title, &MODELS).pick_file())
            }
            Question::SaveScene => {
                let dialog = dialog.add_filter(say!("dialogs.scenes"), &[SCENE_EXTENSION]);
                Box::pin(dialog.set_file_name("scene.scene").save_file())
            }
        };
        self.open = Some(Native::new(question, begin_at, answer));
    }

    /// Asks for a path that is typed.
    fn ask_for_path(&mut self, question: Question, begin_at: Option<&Path>) {
        let folder = begin_at.map(|folder| folder.join("")).unwrap_or_default();
        self.typed = Some(Typed {
            question,
            path: folder.to_string_lossy().into_owned(),
            why_not: None,
            focus: true,
        });
    }

    /// Draws what is asked here, and returns the path that was given, if one was.
    pub fn show(&mut self, ctx: &Context) -> Option<(Question, PathBuf)> {
        if let Some(open) = &mut self.open {
            let Poll::Ready(answer) = open.poll(ctx) else {
                return None;
            };
            let (question, took) = (open.question, open.took());
            let begin_at = open.begin_at.take();
            self.open = None;
            match answer {
                Some(file) => return Some((question, file.path().to_owned())),
                None if took < AT_ONCE => {
                    self.native = false;
                    self.ask_for_path(question, begin_at.as_deref());
                }
                None => {}
            }
        }
        self.show_typed(ctx)
    }

    /// Asks again, because nothing can be done with the path.
    pub fn refuse(&mut self, question: Question, path: &Path, why: String) {
        self.typed = Some(Typed {
            question,
            path: path.to_string_lossy().into_owned(),
            why_not: Some(why),
            focus: true,
        });
    }

    /// Whether a path is being typed.
    pub fn is_typing(&self) -> bool {
        self.typed.is_some()
    }

    fn show_typed(&mut self, ctx: &Context) -> Option<(Question, PathBuf)> {
        let typed = self.typed.as_mut()?;
        let mut done = false;
        let mut given = false;
        let modal = Modal::new(Id::unique("path")).show(ctx, |ui| {
            ui.set_width(460.0);
            ui.heading(typed.question.title());
            let label = ui.label(typed.question.about());
            let field = TextEdit::singleline(&mut typed.path).desired_width(f32::INFINITY);
            let field = ui.add(field).labelled_by(label.id);
            if std::mem::take(&mut typed.focus) {
                field.request_focus();
            }
            given = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if let Some(why) = &typed.why_not {
                ui.label(RichText::new(why).color(ui.visuals().error_fg_color));
            }
            ui.horizontal(|ui| {
                given |= ui.button(say!("dialogs.ok")).clicked();
                done = ui.button(say!("dialogs.cancel")).clicked();
            });
        });
        let escaped = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        let path = typed.path.trim();
        if given && !path.is_empty() {
            let answer = (typed.question, PathBuf::from(path));
            self.typed = None;
            return Some(answer);
        }
        if done || escaped || modal.should_close() {
            self.typed = None;
        }
        None
    }
}

/// Whether the system may have dialogs. On Linux and its like they come over the session's bus
/// (XDG Desktop Portal) or from the program zenity.
fn has_dialogs() -> bool {
    if cfg!(any(windows, target_os = "macos")) {
        return true;
    }
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty());
    let bus = set("DBUS_SESSION_BUS_ADDRESS").is_some()
        || set("XDG_RUNTIME_DIR").is_some_and(|folder| Path::new(&folder).join("bus").exists());
    let mut folders = set("PATH")
        .into_iter()
        .flat_map(|path| env::split_paths(&path).collect::<Vec<_>>());
    bus || folders.any(|folder| folder.join("zenity").is_file())
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    /// A dialog of the system, which a test answers.
    #[derive(Clone, Default)]
    struct Dialog(Arc<Mutex<Open>>);

    #[derive(Default)]
    struct Open {
        answer: Option<Option<FileHandle>>,
        waker: Option<Waker>,
    }

    impl Dialog {
        fn open(dialogs: &mut Dialogs) -> Self {
            let dialog = Self::default();
            let open = Arc::clone(&dialog.0);
            let answer = std::future::poll_fn(move |context| {
                let mut open = open.lock().expect("no test panics meanwhile");
                open.waker = Some(context.waker().clone());
                open.answer.take().map_or(Poll::Pending, Poll::Ready)
            });
            let folder = Some(Path::new("here"));
            dialogs.native = true;
            dialogs.open = Some(Native::new(Question::Scene, folder, Box::pin(answer)));
            dialog
        }

        fn answer(&self, answer: Option<PathBuf>) {
            let mut open = self.0.lock().expect("no test panics meanwhile");
            open.answer = Some(answer.map(FileHandle::from));
            open.waker.take().expect("somebody waits").wake();
        }
    }

    /// A frame of a window.
    fn frame(dialogs: &mut Dialogs, ctx: &Context) -> Option<(Question, PathBuf)> {
        let mut answer = None;
        let _ = ctx.run_ui(egui::RawInput::default(), |ui| {
            answer = answer.take().or(dialogs.show(ui.ctx()));
        });
        answer
    }

    #[test]
    fn where_there_is_no_dialog_a_path_is_asked_for_however_late_the_window_sees_it() {
        let (mut dialogs, ctx) = (Dialogs::default(), Context::default());
        let dialog = Dialog::open(&mut dialogs);
        assert!(frame(&mut dialogs, &ctx).is_none());
        dialog.answer(None);
        // A frame that takes longer than a person needs to answer.
        std::thread::sleep(2 * AT_ONCE);
        assert!(frame(&mut dialogs, &ctx).is_none());
        assert!(dialogs.is_typing() && !dialogs.native);
        let path = dialogs.typed.as_ref().map(|typed| typed.path.as_str());
        assert_eq!(path, Path::new("here").join("").to_str());
    }

    #[test]
    fn who_cancels_a_dialog_is_asked_no_more() {
        let (mut dialogs, ctx) = (Dialogs::default(), Context::default());
        let dialog = Dialog::open(&mut dialogs);
        assert!(frame(&mut dialogs, &ctx).is_none());
        std::thread::sleep(2 * AT_ONCE);
        dialog.answer(None);
        assert!(frame(&mut dialogs, &ctx).is_none());
        assert!(dialogs.open.is_none() && !dialogs.is_typing() && dialogs.native);
    }

    #[test]
    fn a_file_that_was_chosen_is_given_on() {
        let (mut dialogs, ctx) = (Dialogs::default(), Context::default());
        let dialog = Dialog::open(&mut dialogs);
        assert!(frame(&mut dialogs, &ctx).is_none());
        let file = PathBuf::from("somewhere/a scene.rhai");
        dialog.answer(Some(file.clone()));
        assert_eq!(frame(&mut dialogs, &ctx), Some((Question::Scene, file)));
        assert!(dialogs.open.is_none() && !dialogs.is_typing());
    }
}
