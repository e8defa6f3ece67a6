//! What menus and keys do for comparisons.

use egui::Key;

use super::actions::{Action, Entry};
use super::editor::Editor;
use super::layout::Panel;
use super::menus::{command, entry, key, shifted};
use super::messages::message;
use super::panels::compare::report;
use super::panels::notebook;
use super::panels::view_text::{self, PasteWindow};
use super::workbench::Workbench;
use super::workbench::comparing::Mode;

/// Something about comparisons that a person can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompareAction {
    /// Begin to compare, or end it.
    OnOff,
    /// Show both pictures in one way.
    Show(Mode),
    /// Show the other picture in full.
    Other,
    /// Make A of B, and B of A.
    Swap,
    /// Give B the pipeline and values of A.
    Like,
    /// Move the line between both pictures to the left.
    SplitLeft,
    /// Move it to the right.
    SplitRight,
    /// Copy what is on the screen as a line of text.
    CopyView,
    /// Go to such a line.
    PasteView,
    /// Keep what is on the screen in the notebook.
    Keep,
    /// Measure what is on the screen and write a report.
    Report,
}

impl CompareAction {
    /// Whether a menu marks it as chosen.
    pub fn is_in_force(self, workbench: &Workbench) -> bool {
        let comparing = &workbench.comparing;
        match self {
            Self::OnOff => comparing.is_on(),
            Self::Show(mode) => comparing.is_on() && comparing.mode == mode,
            _ => false,
        }
    }
}

/// The share of the picture by which a key moves the line.
const STEP: f32 = 0.02;

const fn compare(
    action: CompareAction,
    message: &'static str,
    shortcut: Option<egui::KeyboardShortcut>,
) -> Entry {
    entry(Action::Compare(action), message, shortcut)
}

/// The menu.
pub const MENU: &[&[Entry]] = &[
    &[
        // Before the key without Shift, which fits both.
        compare(
            CompareAction::Swap,
            message!("action.swap_a_and_b"),
            shifted(Key::C),
        ),
        compare(
            CompareAction::OnOff,
            message!("action.compare_two_pipelines"),
            key(Key::C),
        ),
        compare(
            CompareAction::Like,
            message!("action.give_b_what_a_has"),
            None,
        ),
    ],
    &[
        compare(
            CompareAction::Show(Mode::Split),
            message!("action.compare_by_a_split"),
            None,
        ),
        compare(
            CompareAction::Show(Mode::Flicker),
            message!("action.compare_by_flicker"),
            None,
        ),
        compare(
            CompareAction::Show(Mode::Difference),
            message!("action.compare_by_difference"),
            None,
        ),
        compare(
            CompareAction::Show(Mode::Flip),
            message!("action.compare_by_flip"),
            None,
        ),
    ],
    &[
        compare(
            CompareAction::Other,
            message!("action.show_the_other_picture"),
            key(Key::B),
        ),
        compare(
            CompareAction::SplitLeft,
            message!("action.move_the_split_to_the_left"),
            shifted(Key::ArrowLeft),
        ),
        compare(
            CompareAction::SplitRight,
            message!("action.move_the_split_to_the_right"),
            shifted(Key::ArrowRight),
        ),
    ],
    &[
        compare(
            CompareAction::CopyView,
            message!("action.copy_view"),
            command(Key::L),
        ),
        compare(
            CompareAction::PasteView,
            message!("action.paste_view"),
            command(Key::G),
        ),
        compare(
            CompareAction::Keep,
            message!("action.keep_this_measurement"),
            command(Key::K),
        ),
        compare(
            CompareAction::Report,
            message!("action.report_of_what_is_on_screen"),
            None,
        ),
    ],
];

/// Does what was asked for.
pub fn perform(editor: &mut Editor, action: CompareAction, ctx: &egui::Context) {
    let workbench = &mut editor.workbench;
    match action {
        CompareAction::OnOff => {
            let on = !workbench.comparing.is_on();
            workbench.compare(on);
            if on {
                editor.show(Panel::Compare);
            }
        }
        CompareAction::Show(mode) => {
            workbench.compare(true);
            workbench.comparing.mode = mode;
            editor.show(Panel::Compare);
        }
        CompareAction::Other => {
            workbench.compare(true);
            workbench.comparing.mode = Mode::Flicker;
            workbench.comparing.flicker.change();
        }
        CompareAction::Swap => workbench.swap_sides(),
        CompareAction::Like => {
            workbench.other_like_this();
            editor.show(Panel::Compare);
        }
        CompareAction::SplitLeft => move_split(workbench, -STEP),
        CompareAction::SplitRight => move_split(workbench, STEP),
        CompareAction::CopyView => view_text::copy(editor, ctx),
        CompareAction::PasteView => editor.paste = Some(PasteWindow::default()),
        CompareAction::Keep => {
            notebook::keep(editor);
            editor.show(Panel::Notebook);
        }
        CompareAction::Report => {
            report::begin(editor);
            editor.show(Panel::Compare);
        }
    }
}

fn move_split(workbench: &mut Workbench, by: f32) {
    let comparing = &mut workbench.comparing;
    if comparing.is_on() {
        comparing.mode = Mode::Split;
        comparing.split = (comparing.split + by).clamp(0.0, 1.0);
    }
}
