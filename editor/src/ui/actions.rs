//! Everything that menus and keys do, in one table.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::editor::Editor;
use super::layout::Panel;

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
    /// Back to the scene's camera.
    ResetCamera,
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
    /// What this program is.
    About,
    /// Close the window.
    Quit,
}

/// An action's words and key.
pub struct Entry {
    /// What it does.
    pub action: Action,
    /// Title in menus.
    pub title: &'static str,
    /// Its key, if it has one.
    pub shortcut: Option<KeyboardShortcut>,
}

const fn key(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

const fn command(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

const fn entry(action: Action, title: &'static str, shortcut: Option<KeyboardShortcut>) -> Entry {
    Entry {
        action,
        title,
        shortcut,
    }
}

/// The menus, in their order, each with its groups of actions.
pub const MENUS: [(&str, &[&[Entry]]); 5] = [
    (
        "File",
        &[
            &[entry(Action::Reload, "Reload everything", key(Key::F5))],
            &[entry(Action::Quit, "Quit", command(Key::Q))],
        ],
    ),
    (
        "View",
        &[
            &[
                entry(Action::Frame, "Frame the scene", key(Key::F)),
                entry(Action::ResetCamera, "Reset the camera", key(Key::Home)),
            ],
            &[
                entry(Action::Toggle(Panel::Passes), "Passes", None),
                entry(Action::Toggle(Panel::Targets), "Targets", None),
                entry(Action::Toggle(Panel::Pixel), "Pixel", None),
                entry(Action::Toggle(Panel::Pipeline), "Pipeline parameters", None),
                entry(Action::Toggle(Panel::Scene), "Scene parameters", None),
                entry(Action::Toggle(Panel::Entities), "Entities", None),
                entry(Action::Toggle(Panel::Log), "Log", None),
                entry(Action::Toggle(Panel::Console), "Console", None),
                entry(Action::Toggle(Panel::Actions), "Actions", None),
                entry(Action::Toggle(Panel::Plots), "Plots", None),
            ],
            &[
                entry(Action::ResetLayout, "Reset the layout", None),
                entry(Action::SwitchTheme, "Dark or light", command(Key::T)),
            ],
        ],
    ),
    (
        "Pipeline",
        &[&[
            entry(
                Action::PreviousPipeline,
                "Previous pipeline",
                key(Key::OpenBracket),
            ),
            entry(
                Action::NextPipeline,
                "Next pipeline",
                key(Key::CloseBracket),
            ),
        ]],
    ),
    (
        "Time",
        &[&[
            entry(Action::PlayPause, "Play or pause", key(Key::Space)),
            entry(Action::Step, "Step", key(Key::Period)),
            entry(Action::Stop, "Stop", command(Key::Period)),
            entry(Action::Rewind, "Back to the beginning", key(Key::Backspace)),
        ]],
    ),
    (
        "Help",
        &[&[
            entry(Action::Help, "Mouse and keys", key(Key::F1)),
            entry(Action::About, "About Lightbench", None),
        ]],
    ),
];

/// The keys of the first nine pipelines.
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
        Key::OpenBracket => "[".to_owned(),
        Key::CloseBracket => "]".to_owned(),
        Key::Period => ".".to_owned(),
        _ => ctx.format_shortcut(shortcut),
    }
}

/// The key of an action, as people write it.
pub fn shortcut_text(ctx: &egui::Context, action: Action) -> Option<String> {
    let entry = entries().find(|entry| entry.action == action)?;
    entry.shortcut.map(|shortcut| key_text(ctx, &shortcut))
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
    for entry in entries() {
        if let Some(shortcut) = entry.shortcut.filter(is_left)
            && ctx.input_mut(|input| input.consume_shortcut(&shortcut))
        {
            editor.perform(entry.action, ctx);
        }
    }
    if scene_has_keys {
        return;
    }
    let chosen = NUMBERS
        .iter()
        .position(|key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, *key)));
    if let Some(index) = chosen {
        let name = editor.workbench.library.pipelines.get(index);
        if let Some(name) = name.map(|entry| entry.name.clone()) {
            editor.workbench.select_pipeline(&name);
        }
    }
}
