//! Everything that menus and keys do.

use egui::{Key, KeyboardShortcut, Modifiers};
use lightbench::script::overlays::NewKind;

use super::compare_actions::CompareAction;
use super::editor::Editor;
use super::layout::Panel;
use super::menus::MENUS;
use super::messages::text;
use super::panels::handles::Tool;
use super::panels::marks::Mark;
use super::panels::pipelines::favourites;
use super::workbench::flat::Side;

/// Something that a person can ask for without an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Let time run, or stop it.
    PlayPause,
    /// One step further in time.
    Step,
    /// Give back what there was before time ran.
    Stop,
    /// Back to the beginning of time.
    Rewind,
    /// Show the whole scene.
    Frame,
    /// Show all of what is chosen, or the whole scene where nothing is.
    FrameSelection,
    /// Look from a side, without perspective.
    LookFrom(Side),
    /// Back from an orthographic view to the camera that a person moves.
    Perspective,
    /// Give the other viewport the focus.
    OtherViewport,
    /// Show something over the picture, or hide it.
    Mark(Mark),
    /// Compare two pipelines, and keep what was found.
    Compare(CompareAction),
    /// Find an action, a scene or a pipeline by its name.
    Palette,
    /// Take back the last change by hand.
    Undo,
    /// Do again what was taken back.
    Redo,
    /// Back to what was looked at before.
    ViewBack,
    /// Forth again.
    ViewForth,
    /// Choose what handles do.
    Tool(Tool),
    /// Handles along the axes of the entity, or of the world.
    LocalAxes,
    /// Choose no entity.
    SelectNone,
    /// Make an entity.
    Create(NewKind),
    /// Make copies of what is chosen.
    Duplicate,
    /// Remove what is chosen.
    Delete,
    /// Call what is chosen otherwise.
    Rename,
    /// Hang what is chosen below nothing.
    Detach,
    /// Hide what is chosen, or show it.
    Hide,
    /// Lock what is chosen, or unlock it.
    Lock,
    /// Write the scene to a file.
    SaveScene,
    /// Back to the scene's camera.
    ResetCamera,
    /// The picture as it is after the next pass of the frame.
    PassAfter,
    /// The picture as it is after the pass before.
    PassBefore,
    /// The picture after all passes.
    WholeFrame,
    /// The pipeline after the present one.
    NextPipeline,
    /// The pipeline before the present one.
    PreviousPipeline,
    /// Read and build everything again.
    Reload,
    /// Show a panel, or hide it.
    Toggle(Panel),
    /// The panels as they were at the first start.
    ResetLayout,
    /// Dark or light.
    SwitchTheme,
    /// What can be done with mouse and keys.
    Help,
    /// Open the script of the scene.
    EditScene,
    /// Open the file of the pipeline.
    EditPipeline,
    /// Save the file in Code if it has unsaved text, else the scene.
    Save,
    /// Go on with another project.
    OpenProject,
    /// Open a scene, a pipeline or a model.
    OpenScene,
    /// Show scenes, pipelines and examples.
    Gallery,
    /// Show the lesson that is open, or all of them.
    Lessons,
    /// Check the lesson.
    CheckLesson,
    /// Say what to try first.
    Welcome,
    /// Text and widgets larger.
    LargerText,
    /// Text and widgets smaller.
    SmallerText,
    /// Text and widgets as large as the system says.
    UsualText,
    /// What this program is.
    About,
    /// Close the window.
    Quit,
}

/// An action's words and key.
pub struct Entry {
    /// What it does.
    pub action: Action,
    /// Message with its title in menus.
    pub(super) message: &'static str,
    /// Its key, if it has one.
    pub shortcut: Option<KeyboardShortcut>,
}

impl Entry {
    /// Title in menus.
    #[must_use]
    pub fn title(&self) -> &'static str {
        text(self.message)
    }
}

/// The keys of favourite pipelines.
const NUMBERS: [Key; 9] = [
    Key::Num1,
    Key::Num2,
    Key::Num3,
    Key::Num4,
    Key::Num5,
    Key::Num6,
    Key::Num7,
    Key::Num8,
    Key::Num9,
];

/// All actions with their words.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    MENUS
        .iter()
        .flat_map(|(_, groups)| groups.iter())
        .flat_map(|group| group.iter())
}

/// A key as people write it: signs as such, others by name.
pub fn key_text(ctx: &egui::Context, shortcut: &KeyboardShortcut) -> String {
    match shortcut.logical_key {
        Key::OpenBracket => with_modifiers(ctx, shortcut, "["),
        Key::CloseBracket => with_modifiers(ctx, shortcut, "]"),
        Key::Period => ".".to_owned(),
        _ => ctx.format_shortcut(shortcut),
    }
}

/// A sign behind the keys that are held with it.
fn with_modifiers(ctx: &egui::Context, shortcut: &KeyboardShortcut, sign: &str) -> String {
    let named = ctx.format_shortcut(shortcut);
    match named.rsplit_once('+') {
        Some((held, _)) => format!("{held}+{sign}"),
        None => sign.to_owned(),
    }
}

/// The key of an action, as people write it.
pub fn shortcut_text(ctx: &egui::Context, action: Action) -> Option<String> {
    let entry = entries().find(|entry| entry.action == action)?;
    entry.shortcut.map(|shortcut| key_text(ctx, &shortcut))
}

/// How often a key is pressed in this frame, which is taken then: a slow frame may bring several presses.
/// Plus shares its key with the sign for equal on many keyboards, and is meant also without Shift.
fn presses(input: &mut egui::InputState, shortcut: &KeyboardShortcut) -> usize {
    let mut count = |key| input.count_and_consume_key(shortcut.modifiers, key);
    let presses = count(shortcut.logical_key);
    match shortcut.logical_key {
        Key::Plus => presses + count(Key::Equals),
        _ => presses,
    }
}

/// Does what the keys of this frame ask for, unless a text field has them.
pub fn keyboard(editor: &mut Editor, ctx: &egui::Context) {
    if ctx.egui_wants_keyboard_input() {
        return;
    }
    // Letters, digits and the like are the scene's, where its scripts hear them.
    let scene_has_keys = editor.workbench.scene_has_keys;
    let is_left = |shortcut: &KeyboardShortcut| {
        let special = matches!(shortcut.logical_key, Key::F1 | Key::F5 | Key::Home);
        !scene_has_keys || special || shortcut.modifiers != Modifiers::NONE
    };
    if editor.viewport.handles.is_dragged() {
        // Keys are for its amount.
        return;
    }
    if editor.palette.is_some() || editor.saving.is_some() || editor.has_question() {
        return;
    }
    // Escape closes a menu or leaves a field first.
    let menu_is_open = egui::Popup::is_any_open(ctx) || editor.was_typing;
    for entry in entries() {
        if entry.action == Action::SelectNone && menu_is_open {
            continue;
        }
        let Some(shortcut) = entry.shortcut.filter(is_left) else {
            continue;
        };
        for _ in 0..ctx.input_mut(|input| presses(input, &shortcut)) {
            editor.perform(entry.action, ctx);
        }
    }
    if scene_has_keys {
        return;
    }
    let chosen = NUMBERS
        .iter()
        .position(|key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, *key)));
    if let Some(index) = chosen
        && let Some(name) = favourites(editor)[index].take()
    {
        editor.workbench.select_pipeline(&name);
    }
}
