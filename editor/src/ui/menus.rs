//! The menus: what each holds, with its words and its key.

use egui::{Key, KeyboardShortcut, Modifiers};
use lightbench::script::overlays::NewKind;

use super::actions::{Action, Entry};
use super::compare_actions;
use super::layout::Panel;
use super::messages::message;
use super::panels::handles::Tool;
use super::panels::marks::Mark;
use super::workbench::flat::Side;

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
                entry(Action::Lessons, message!("action.lessons"), None),
                entry(
                    Action::CheckLesson,
                    message!("action.check_the_lesson"),
                    None,
                ),
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
                    Action::ViewBack,
                    message!("action.view_back"),
                    shifted(Key::Z),
                ),
                entry(
                    Action::ViewForth,
                    message!("action.view_forth"),
                    shifted(Key::Y),
                ),
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
                    Action::Create(NewKind::AmbientLight),
                    message!("action.create_ambient_light"),
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
                entry(
                    Action::Toggle(Panel::Materials),
                    message!("action.materials"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Assets),
                    message!("action.assets"),
                    None,
                ),
                entry(
                    Action::Toggle(Panel::Environment),
                    message!("action.environment"),
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
                entry(
                    Action::Toggle(Panel::Lesson),
                    message!("action.lesson"),
                    None,
                ),
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
                entry(
                    Action::LargerText,
                    message!("action.larger_text"),
                    command(Key::Plus),
                ),
                entry(
                    Action::SmallerText,
                    message!("action.smaller_text"),
                    command(Key::Minus),
                ),
                entry(Action::UsualText, message!("action.usual_text"), None),
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
