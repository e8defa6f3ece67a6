//! Everything that menus and keys do, in one table.

use egui::{Key, KeyboardShortcut, Modifiers};
use lightbench::script::overlays::NewKind;

use super::compare_actions::{self, CompareAction};
use super::editor::Editor;
use super::layout::Panel;
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
    /// Say what to try first.
    Welcome,
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

pub(super) const fn key(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

pub(super) const fn command(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

/// Ctrl, or the command key, and Shift.
const COMMAND_SHIFT: Modifiers = Modifiers {
    shift: true,
    ..Modifiers::COMMAND
};

pub(super) const fn shifted(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::SHIFT, key))
}

pub(super) const fn entry(
    action: Action,
    title: &'static str,
    shortcut: Option<KeyboardShortcut>,
) -> Entry {
    Entry {
        action,
        title,
        shortcut,
    }
}

/// The menus, in their order, each with its groups of actions.
pub const MENUS: [(&str, &[&[Entry]]); 8] = [
    (
        "File",
        &[
            &[
                entry(Action::Palette, "Find an action", command(Key::P)),
                entry(Action::Reload, "Reload everything", key(Key::F5)),
            ],
            &[
                entry(Action::Gallery, "Gallery", None),
                entry(Action::OpenProject, "Open a project", None),
                // Before the key without Shift, which fits both.
                entry(
                    Action::SaveScene,
                    "Save the scene as",
                    Some(KeyboardShortcut::new(COMMAND_SHIFT, Key::S)),
                ),
                entry(Action::OpenScene, "Open a scene", command(Key::O)),
            ],
            &[
                entry(
                    Action::EditScene,
                    "Edit the scene's script",
                    command(Key::E),
                ),
                entry(Action::EditPipeline, "Edit the pipeline's file", None),
                entry(Action::Save, "Save", command(Key::S)),
            ],
            &[entry(Action::Quit, "Quit", command(Key::Q))],
        ],
    ),
    (
        "Edit",
        &[
            &[
                // Before the key without Shift, which fits both.
                entry(
                    Action::Redo,
                    "Redo",
                    Some(KeyboardShortcut::new(COMMAND_SHIFT, Key::Z)),
                ),
                entry(Action::Undo, "Undo", command(Key::Z)),
            ],
            &[
                entry(Action::Tool(Tool::Move), "Move", key(Key::M)),
                entry(Action::Tool(Tool::Turn), "Rotate", key(Key::R)),
                entry(Action::Tool(Tool::Scale), "Scale", key(Key::X)),
                entry(Action::LocalAxes, "Local axes", key(Key::L)),
            ],
            &[entry(
                Action::SelectNone,
                "Choose nothing",
                key(Key::Escape),
            )],
        ],
    ),
    (
        "Entity",
        &[
            &[
                entry(Action::Create(NewKind::Empty), "Create empty", None),
                entry(Action::Create(NewKind::Box), "Create box", None),
                entry(Action::Create(NewKind::Sphere), "Create sphere", None),
                entry(Action::Create(NewKind::Cylinder), "Create cylinder", None),
                entry(Action::Create(NewKind::Cone), "Create cone", None),
                entry(Action::Create(NewKind::Torus), "Create torus", None),
                entry(Action::Create(NewKind::Plane), "Create plane", None),
            ],
            &[
                entry(
                    Action::Create(NewKind::PointLight),
                    "Create point light",
                    None,
                ),
                entry(
                    Action::Create(NewKind::SpotLight),
                    "Create spot light",
                    None,
                ),
                entry(
                    Action::Create(NewKind::DirectionalLight),
                    "Create directional light",
                    None,
                ),
                entry(Action::Create(NewKind::Camera), "Create camera", None),
            ],
            &[
                entry(Action::Duplicate, "Duplicate", command(Key::D)),
                entry(Action::Delete, "Delete", key(Key::Delete)),
                entry(Action::Rename, "Rename", key(Key::F2)),
                entry(Action::Detach, "Put below nothing", None),
                entry(Action::Hide, "Hide or show", key(Key::H)),
                entry(Action::Lock, "Lock or unlock", None),
            ],
        ],
    ),
    (
        "View",
        &[
            &[
                entry(Action::FrameSelection, "Frame the selection", key(Key::F)),
                // Before the key without Shift, which fits both.
                entry(Action::ResetCamera, "Reset the camera", shifted(Key::Home)),
                entry(Action::Frame, "Frame the scene", key(Key::Home)),
            ],
            &[
                entry(Action::Perspective, "Perspective", command(Key::Num0)),
                entry(
                    Action::LookFrom(Side::Top),
                    "Top, orthographic",
                    command(Key::Num1),
                ),
                entry(
                    Action::LookFrom(Side::Front),
                    "Front, orthographic",
                    command(Key::Num2),
                ),
                entry(
                    Action::LookFrom(Side::Right),
                    "Side, orthographic",
                    command(Key::Num3),
                ),
            ],
            &[
                entry(Action::Mark(Mark::Grid), "Grid and axes", None),
                entry(Action::Mark(Mark::Icons), "Lights and cameras", None),
                entry(Action::Mark(Mark::Selection), "Bounds and ranges", None),
                entry(Action::Mark(Mark::Handles), "Handles", None),
            ],
            &[
                entry(Action::Mark(Mark::Edges), "Wireframe", None),
                entry(Action::Mark(Mark::Normals), "Vertex normals", None),
                entry(
                    Action::Mark(Mark::OfChosen),
                    "Lines of what is chosen alone",
                    None,
                ),
            ],
            &[
                entry(Action::Toggle(Panel::Passes), "Passes", None),
                entry(Action::Toggle(Panel::Targets), "Targets", None),
                entry(Action::Toggle(Panel::Pixel), "Pixel", None),
                entry(Action::Toggle(Panel::Pipeline), "Pipeline parameters", None),
                entry(Action::Toggle(Panel::Pipelines), "All pipelines", None),
                entry(Action::Toggle(Panel::Scene), "Scene parameters", None),
                entry(Action::Toggle(Panel::Entities), "Entities", None),
                entry(Action::Toggle(Panel::Log), "Log", None),
                entry(Action::Toggle(Panel::Console), "Console", None),
                entry(Action::Toggle(Panel::Actions), "Actions", None),
                entry(Action::Toggle(Panel::Plots), "Plots", None),
                entry(Action::Toggle(Panel::History), "History", None),
                entry(Action::Toggle(Panel::Compare), "Comparison", None),
                entry(Action::Toggle(Panel::Notebook), "Notebook", None),
                entry(Action::Toggle(Panel::Code), "Code", None),
            ],
            &[
                entry(Action::ResetLayout, "Reset the layout", None),
                entry(Action::SwitchTheme, "Dark or light", command(Key::T)),
            ],
        ],
    ),
    (
        "Pipeline",
        &[
            &[
                entry(
                    Action::PassBefore,
                    "Picture after the pass before",
                    command(Key::OpenBracket),
                ),
                entry(
                    Action::PassAfter,
                    "Picture after the next pass",
                    command(Key::CloseBracket),
                ),
                entry(Action::WholeFrame, "Picture after all passes", None),
            ],
            &[
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
            ],
        ],
    ),
    ("Compare", compare_actions::MENU),
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
            entry(Action::Welcome, "Welcome", None),
            entry(Action::Help, "Mouse and keys", key(Key::F1)),
            entry(Action::About, "About Lightbench", None),
        ]],
    ),
];

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
    if let Some(index) = chosen
        && let Some(name) = favourites(editor)[index].take()
    {
        editor.workbench.select_pipeline(&name);
    }
}
