//! Everything that menus and keys do, in one table.

use egui::{Key, KeyboardShortcut, Modifiers};
use lightbench::script::overlays::NewKind;

use super::compare_actions::{self, CompareAction};
use super::editor::Editor;
use super::layout::Panel;
use super::messages::{message, text};
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
    message: &'static str,
    shortcut: Option<KeyboardShortcut>,
) -> Entry {
    Entry {
        action,
        message,
        shortcut,
    }
}

/// The menus, in their order, each with the message of its title and its groups of actions.
pub const MENUS: [(&str, &[&[Entry]]); 8] = [
    (
        message!("menu.file"),
        &[
            &[
                entry(
                    Action::Palette,
                    message!("action.find_an_action"),
                    command(Key::P),
                ),
                entry(
                    Action::Reload,
                    message!("action.reload_everything"),
                    key(Key::F5),
                ),
            ],
            &[
                entry(Action::Gallery, message!("action.gallery"), None),
                entry(Action::OpenProject, message!("action.open_a_project"), None),
                // Before the key without Shift, which fits both.
                entry(
                    Action::SaveScene,
                    message!("action.save_the_scene_as"),
                    Some(KeyboardShortcut::new(COMMAND_SHIFT, Key::S)),
                ),
                entry(
                    Action::OpenScene,
                    message!("action.open_a_scene"),
                    command(Key::O),
                ),
            ],
            &[
                entry(
                    Action::EditScene,
                    message!("action.edit_the_scene_s_script"),
                    command(Key::E),
                ),
                entry(
                    Action::EditPipeline,
                    message!("action.edit_the_pipeline_s_file"),
                    None,
                ),
                entry(Action::Save, message!("action.save"), command(Key::S)),
            ],
            &[entry(
                Action::Quit,
                message!("action.quit"),
                command(Key::Q),
            )],
        ],
    ),
    (
        message!("menu.edit"),
        &[
            &[
                // Before the key without Shift, which fits both.
                entry(
                    Action::Redo,
                    message!("action.redo"),
                    Some(KeyboardShortcut::new(COMMAND_SHIFT, Key::Z)),
                ),
                entry(Action::Undo, message!("action.undo"), command(Key::Z)),
            ],
            &[
                entry(
                    Action::Tool(Tool::Move),
                    message!("action.move"),
                    key(Key::M),
                ),
                entry(
                    Action::Tool(Tool::Turn),
                    message!("action.rotate"),
                    key(Key::R),
                ),
                entry(
                    Action::Tool(Tool::Scale),
                    message!("action.scale"),
                    key(Key::X),
                ),
                entry(
                    Action::LocalAxes,
                    message!("action.local_axes"),
                    key(Key::L),
                ),
            ],
            &[entry(
                Action::SelectNone,
                message!("action.choose_nothing"),
                key(Key::Escape),
            )],
        ],
    ),
    (
        message!("menu.entity"),
        &[
            &[
                entry(
                    Action::Create(NewKind::Empty),
                    message!("action.create_empty"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Box),
                    message!("action.create_box"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Sphere),
                    message!("action.create_sphere"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Cylinder),
                    message!("action.create_cylinder"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Cone),
                    message!("action.create_cone"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Torus),
                    message!("action.create_torus"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Plane),
                    message!("action.create_plane"),
                    None,
                ),
            ],
            &[
                entry(
                    Action::Create(NewKind::PointLight),
                    message!("action.create_point_light"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::SpotLight),
                    message!("action.create_spot_light"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::DirectionalLight),
                    message!("action.create_directional_light"),
                    None,
                ),
                entry(
                    Action::Create(NewKind::Camera),
                    message!("action.create_camera"),
                    None,
                ),
            ],
            &[
                entry(
                    Action::Duplicate,
                    message!("action.duplicate"),
                    command(Key::D),
                ),
                entry(Action::Delete, message!("action.delete"), key(Key::Delete)),
                entry(Action::Rename, message!("action.rename"), key(Key::F2)),
                entry(Action::Detach, message!("action.put_below_nothing"), None),
                entry(Action::Hide, message!("action.hide_or_show"), key(Key::H)),
                entry(Action::Lock, message!("action.lock_or_unlock"), None),
            ],
        ],
    ),
    (
        message!("menu.view"),
        &[
            &[
                entry(
                    Action::FrameSelection,
                    message!("action.frame_the_selection"),
                    key(Key::F),
                ),
                // Before the key without Shift, which fits both.
                entry(
                    Action::ResetCamera,
                    message!("action.reset_the_camera"),
                    shifted(Key::Home),
                ),
                entry(
                    Action::Frame,
                    message!("action.frame_the_scene"),
                    key(Key::Home),
                ),
            ],
            &[
                // Before the key without Shift, which fits both.
                entry(
                    Action::OtherViewport,
                    message!("action.go_to_the_other_viewport"),
                    shifted(Key::V),
                ),
                entry(
                    Action::Toggle(Panel::Second),
                    message!("action.second_viewport"),
                    key(Key::V),
                ),
            ],
            &[
                entry(
                    Action::Perspective,
                    message!("action.perspective"),
                    command(Key::Num0),
                ),
                entry(
                    Action::LookFrom(Side::Top),
                    message!("action.top_orthographic"),
                    command(Key::Num1),
                ),
                entry(
                    Action::LookFrom(Side::Front),
                    message!("action.front_orthographic"),
                    command(Key::Num2),
                ),
                entry(
                    Action::LookFrom(Side::Right),
                    message!("action.side_orthographic"),
                    command(Key::Num3),
                ),
            ],
            &[
                entry(
                    Action::Mark(Mark::Grid),
                    message!("action.grid_and_axes"),
                    None,
                ),
                entry(
                    Action::Mark(Mark::Icons),
                    message!("action.lights_and_cameras"),
                    None,
                ),
                entry(
                    Action::Mark(Mark::Selection),
                    message!("action.bounds_and_ranges"),
                    None,
                ),
                entry(
                    Action::Mark(Mark::Handles),
                    message!("action.handles"),
                    None,
                ),
            ],
            &[
                entry(
                    Action::Mark(Mark::Edges),
                    message!("action.wireframe"),
                    None,
                ),
                entry(
                    Action::Mark(Mark::Normals),
                    message!("action.vertex_normals"),
                    None,
                ),
                entry(
                    Action::Mark(Mark::OfChosen),
                    message!("action.lines_of_what_is_chosen_alone"),
                    None,
                ),
            ],
            &[
                entry(
                    Action::Toggle(Panel::Passes),
                    message!("action.passes"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Targets),
                    message!("action.targets"),
                    None,
                ),
                entry(Action::Toggle(Panel::Pixel), message!("action.pixel"), None),
                entry(
                    Action::Toggle(Panel::Pipeline),
                    message!("action.pipeline_parameters"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Pipelines),
                    message!("action.all_pipelines"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Scene),
                    message!("action.scene_parameters"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Entities),
                    message!("action.entities"),
                    None,
                ),
                entry(Action::Toggle(Panel::Log), message!("action.log"), None),
                entry(
                    Action::Toggle(Panel::Console),
                    message!("action.console"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Actions),
                    message!("action.actions"),
                    None,
                ),
                entry(Action::Toggle(Panel::Plots), message!("action.plots"), None),
                entry(
                    Action::Toggle(Panel::History),
                    message!("action.history"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Compare),
                    message!("action.comparison"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Notebook),
                    message!("action.notebook"),
                    None,
                ),
                entry(Action::Toggle(Panel::Code), message!("action.code"), None),
            ],
            &[
                entry(
                    Action::ResetLayout,
                    message!("action.reset_the_layout"),
                    None,
                ),
                entry(
                    Action::SwitchTheme,
                    message!("action.dark_or_light"),
                    command(Key::T),
                ),
            ],
        ],
    ),
    (
        message!("menu.pipeline"),
        &[
            &[
                entry(
                    Action::PassBefore,
                    message!("action.picture_after_the_pass_before"),
                    command(Key::OpenBracket),
                ),
                entry(
                    Action::PassAfter,
                    message!("action.picture_after_the_next_pass"),
                    command(Key::CloseBracket),
                ),
                entry(
                    Action::WholeFrame,
                    message!("action.picture_after_all_passes"),
                    None,
                ),
            ],
            &[
                entry(
                    Action::PreviousPipeline,
                    message!("action.previous_pipeline"),
                    key(Key::OpenBracket),
                ),
                entry(
                    Action::NextPipeline,
                    message!("action.next_pipeline"),
                    key(Key::CloseBracket),
                ),
            ],
        ],
    ),
    (message!("menu.compare"), compare_actions::MENU),
    (
        message!("menu.time"),
        &[&[
            entry(
                Action::PlayPause,
                message!("action.play_or_pause"),
                key(Key::Space),
            ),
            entry(Action::Step, message!("action.step"), key(Key::Period)),
            entry(Action::Stop, message!("action.stop"), command(Key::Period)),
            entry(
                Action::Rewind,
                message!("action.back_to_the_beginning"),
                key(Key::Backspace),
            ),
        ]],
    ),
    (
        message!("menu.help"),
        &[&[
            entry(Action::Welcome, message!("action.welcome"), None),
            entry(
                Action::Help,
                message!("action.mouse_and_keys"),
                key(Key::F1),
            ),
            entry(Action::About, message!("action.about_lightbench"), None),
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
