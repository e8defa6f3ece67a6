//! The way back of how the window is arranged, of measurements and of number keys, with the editor's widgets.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::{Path, PathBuf};

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::viewports::Viewport;

use ui_support::{Bench, CTRL};

const CTRL_SHIFT: Modifiers = Modifiers {
    shift: true,
    ..CTRL
};

fn back(bench: &mut Bench) {
    bench.key(Modifiers::SHIFT, Key::Z);
}

fn forth(bench: &mut Bench) {
    bench.key(Modifiers::SHIFT, Key::Y);
}

fn views(bench: &Bench) -> Vec<String> {
    let views = &bench.harness.state().workbench.views;
    let done = &views.all()[1..=views.at()];
    done.iter().map(|view| view.what.clone()).collect()
}

fn steps(bench: &Bench) -> Vec<String> {
    let undo = &bench.harness.state().workbench.undo;
    undo.done().iter().map(|step| step.what.clone()).collect()
}

fn perform(bench: &mut Bench, action: &str) {
    bench.key(CTRL, Key::P);
    bench.type_text(action);
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(4);
}

fn rect(bench: &Bench, panel: Panel) -> Option<egui::Rect> {
    bench.harness.state().rect_of(panel)
}

/// The lines over the picture.
fn has_lines(bench: &mut Bench) -> bool {
    bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.lines_picture(Viewport::First).is_some()
}

fn drag(bench: &mut Bench, from: Pos2, to: Pos2) {
    let press = |bench: &mut Bench, pos: Pos2, pressed: bool| {
        bench.harness.event(Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        bench.harness.step();
    };
    bench.harness.hover_at(from);
    bench.harness.run_steps(2);
    press(bench, from, true);
    for part in 1..=6 {
        bench.harness.hover_at(from.lerp(to, part as f32 / 6.0));
        bench.harness.step();
    }
    press(bench, to, false);
    bench.harness.hover_at(pos2(3.0, 3.0));
    bench.harness.run_steps(3);
}

fn kept_file(path: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn open() -> (Bench, PathBuf, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("editor.json");
    std::fs::write(&path, "{}").unwrap();
    let mut bench = Bench::open_with(Some(path.clone()));
    bench.harness.state_mut().workbench.undo.clear();
    (bench, path, folder)
}

#[test]
fn panels_and_marks_go_back_and_forth_with_views_and_a_border_that_is_dragged_is_one() {
    let (mut bench, path, _folder) = open();
    assert!(views(&bench).is_empty());
    let home = rect(&bench, Panel::Passes).unwrap();
    let viewport = rect(&bench, Panel::Viewport).unwrap();

    // Closed, and what is over the picture.
    perform(&mut bench, "Passes");
    assert_eq!(rect(&bench, Panel::Passes), None);
    perform(&mut bench, "Wireframe");
    assert!(has_lines(&mut bench));
    // The border between the picture and what is below it.
    let border = pos2(viewport.center().x, viewport.bottom() + 2.0);
    drag(&mut bench, border, border - vec2(0.0, 90.0));
    let smaller = rect(&bench, Panel::Viewport).unwrap();
    assert!((viewport.height() - smaller.height() - 90.0).abs() < 4.0);
    let words = [
        "The panel Passes is closed",
        "Wireframe: shown in Viewport",
        "A border between panels is moved",
    ];
    assert_eq!(views(&bench), words);
    assert!(steps(&bench).is_empty(), "changes are others");
    let small = kept_file(&path)["arrangement"].clone();

    back(&mut bench);
    let again = rect(&bench, Panel::Viewport).unwrap();
    assert!((again.height() - viewport.height()).abs() < 0.5);
    assert!(has_lines(&mut bench));
    back(&mut bench);
    assert!(!has_lines(&mut bench));
    back(&mut bench);
    assert_eq!(rect(&bench, Panel::Passes), Some(home));
    assert!(views(&bench).is_empty());
    assert_ne!(kept_file(&path)["arrangement"], small, "it is kept so");
    for _ in 0..3 {
        forth(&mut bench);
    }
    assert_eq!(views(&bench), words);
    assert_eq!(rect(&bench, Panel::Passes), None);
    assert_eq!(rect(&bench, Panel::Viewport), Some(smaller));
    assert!(has_lines(&mut bench));
    assert_eq!(kept_file(&path)["arrangement"], small);

    // From the list, which stays in sight, as do the panels' tabs.
    bench.show(Panel::History);
    assert_eq!(views(&bench), words, "a tab is no arrangement");
    bench.harness.get_by_label("The first view").click();
    bench.harness.run_steps(4);
    assert_eq!(rect(&bench, Panel::Passes), Some(home));
    assert_eq!(bench.count("A border between panels is moved"), 1);

    // With another scene the camera's way begins anew, the window's goes on.
    for _ in 0..3 {
        forth(&mut bench);
    }
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.select_scene("corridor");
    bench.until("the scene", |editor| {
        let scenes = &editor.workbench.scenes;
        scenes.shown() == Some("corridor") && !scenes.is_busy()
    });
    bench.harness.state_mut().workbench.stop();
    bench.harness.run_steps(4);
    assert_eq!(views(&bench), words);
    let eye = bench.harness.state().workbench.camera.view();
    back(&mut bench);
    back(&mut bench);
    assert_eq!(views(&bench), words[..1]);
    assert!(!has_lines(&mut bench));
    assert_eq!(bench.harness.state().workbench.camera.view(), eye);
}

#[test]
fn a_panel_that_is_dragged_elsewhere_comes_back() {
    let (mut bench, _path, _folder) = open();
    let place = rect(&bench, Panel::Passes).unwrap();
    let viewport = rect(&bench, Panel::Viewport).unwrap();
    let tab = bench.harness.get_all_by_label("Passes");
    let tab = tab
        .map(|node| node.rect())
        .find(|rect| rect.bottom() <= place.top() + 1.0 && rect.top() > place.top() - 60.0)
        .unwrap();
    let to = viewport.left_center() + vec2(20.0, 0.0);
    drag(&mut bench, tab.center(), to);
    let moved = rect(&bench, Panel::Passes).unwrap();
    assert!(moved.center().x < viewport.center().x, "{moved:?}");
    assert_eq!(views(&bench), ["The panel Passes is moved"]);
    back(&mut bench);
    assert_eq!(rect(&bench, Panel::Passes), Some(place));
    forth(&mut bench);
    assert_eq!(rect(&bench, Panel::Passes), Some(moved));
    assert_eq!(views(&bench), ["The panel Passes is moved"]);
    perform(&mut bench, "Reset the layout");
    assert_eq!(rect(&bench, Panel::Passes), Some(place));
    back(&mut bench);
    assert_eq!(rect(&bench, Panel::Passes), Some(moved));
}

#[test]
fn a_measurement_that_was_kept_is_taken_back_and_comes_again_byte_for_byte() {
    let (mut bench, _path, _folder) = open();
    bench.show(Panel::Notebook);
    bench.press("Keep this measurement");
    bench.until("the entry", |editor| {
        let notebook = &editor.workbench.notebook;
        !notebook.is_busy() && notebook.entries().len() == 1
    });
    bench.harness.run_steps(2);
    let folder = bench.path().join("notebook");
    let files = |folder: &Path| -> Vec<(PathBuf, Vec<u8>)> {
        let entries = std::fs::read_dir(folder).unwrap().flatten();
        let mut all: Vec<_> = entries
            .map(|file| (file.path(), std::fs::read(file.path()).unwrap()))
            .collect();
        all.sort();
        all
    };
    let first = files(&folder);
    assert_eq!(first.len(), 2);
    let entries = bench.harness.state().workbench.notebook.entries();
    let name = entries[0].entry.name.clone();
    assert_eq!(steps(&bench), [format!("Keep the measurement {name}")]);
    bench.key(CTRL, Key::Z);
    assert_eq!(files(&folder), []);
    assert!(
        bench
            .harness
            .state()
            .workbench
            .notebook
            .entries()
            .is_empty()
    );
    bench.key(CTRL_SHIFT, Key::Z);
    assert_eq!(files(&folder), first);

    // With the note that it had then, where that was changed since.
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_note(&name, "bright");
    bench.harness.run_steps(2);
    let noted = files(&folder);
    assert_ne!(noted, first);
    bench.key(CTRL, Key::Z);
    assert_eq!(files(&folder), first);
    bench.key(CTRL, Key::Z);
    assert_eq!(files(&folder), []);
    bench.key(CTRL_SHIFT, Key::Z);
    bench.key(CTRL_SHIFT, Key::Z);
    assert_eq!(files(&folder), noted);
    bench.show(Panel::History);
    assert_eq!(bench.count("Keep the measurement"), 1);
}

#[test]
fn number_keys_of_pipelines_are_taken_back() {
    let (mut bench, path, _folder) = open();
    bench.show(Panel::Pipelines);
    let key = "Key of Forward, single pass";
    let give = |bench: &mut Bench, number: &str| {
        let node = bench.harness.get_by_role_and_label(Role::ComboBox, key);
        node.scroll_to_me();
        bench.harness.run_steps(8);
        bench.choose(key, number);
        bench.harness.hover_at(pos2(3.0, 3.0));
        bench.harness.run_steps(2);
    };
    give(&mut bench, "3");
    give(&mut bench, "7");
    let words = [
        "Number key 3 for Forward, single pass",
        "Number key 7 for Forward, single pass",
    ];
    assert_eq!(steps(&bench), words);
    let with = |number: &str| serde_json::json!({ number: "forward_single_pass" });
    assert_eq!(kept_file(&path)["favourites"], with("7"));
    bench.key(CTRL, Key::Z);
    assert_eq!(kept_file(&path)["favourites"], with("3"));
    bench.key(CTRL_SHIFT, Key::Z);
    assert_eq!(kept_file(&path)["favourites"], with("7"));
    bench.key(CTRL, Key::Z);
    bench.harness.key_press(Key::Num3);
    bench.until("the favourite", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
    bench.key(CTRL, Key::Z);
    bench.key(CTRL, Key::Z);
    assert_eq!(kept_file(&path).get("favourites"), None);
    assert!(steps(&bench).is_empty());
    bench.key(CTRL_SHIFT, Key::Z);
    assert_eq!(kept_file(&path)["favourites"], with("3"));
}
