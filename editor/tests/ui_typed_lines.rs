//! What lines of the console did to a scene is offered after a crash, and asked about before the window closes.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::Path;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::script::overlays::NewKind;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::recovery::Session;
use tempfile::TempDir;

use ui_support::{Bench, CTRL};

/// Moves by what scripts remember, which a line can change.
const SCENE: &str = r#"
spawn("box").mesh(box(1));
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
state.way = 0.0;
state.speed = 1.0;
fn update(time, dt) {
    state.way += state.speed * dt;
    if has_entity("box") { entity("box").at(state.way, 0, 0); }
}
"#;

const FILE: &str = "scripts/scenes/moves.rhai";

fn settle(bench: &mut Bench) {
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        let workbench = &editor.workbench;
        workbench.scenes.shown() == Some("moves")
            && !workbench.scenes.is_busy()
            && !workbench.is_arriving()
    });
    bench.harness.run_steps(2);
}

fn open(project: TempDir, settings: &Path) -> Bench {
    let path = project.path().join(FILE);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, SCENE).unwrap();
    if !settings.exists() {
        std::fs::write(settings, "{}").unwrap();
    }
    let mut bench = Bench::open_project_of("moves", project, Some(settings.to_owned()));
    settle(&mut bench);
    bench
}

/// From the beginning, with nothing that could be taken back.
fn begin(bench: &mut Bench) {
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.stop();
    workbench.undo.clear();
    bench.harness.run_steps(2);
}

fn text(bench: &mut Bench) -> String {
    let scenes = &mut bench.harness.state_mut().workbench.scenes;
    scenes.scene_mut().unwrap().to_text().unwrap()
}

fn run(bench: &mut Bench, line: &str) {
    bench.show(Panel::Console);
    let field = bench.harness.get_by_role_and_label(Role::TextInput, "Line");
    field.focus();
    bench.harness.run_steps(2);
    bench.type_text(line);
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(3);
    // Keys are the editor's again.
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
}

fn step(bench: &mut Bench) {
    bench.key(Modifiers::NONE, Key::Period);
}

fn choose(bench: &mut Bench, name: &str) {
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let entity = scene.world.find(name).unwrap();
    workbench.selection.set(scene, [entity]);
}

/// The lines that are kept below a folder.
fn kept_lines(folder: &Path) -> Vec<String> {
    let runs = std::fs::read_dir(folder.join("recovery"));
    let runs = runs.into_iter().flatten().flatten();
    let files = runs.map(|run| run.path().join("session.json"));
    let texts = files.filter_map(|file| std::fs::read_to_string(file).ok());
    let sessions = texts.map(|text| Session::from_json(&text).unwrap());
    let lines = sessions.flat_map(|session| session.typed.into_values().flatten());
    lines.map(|typed| typed.line).collect()
}

#[test]
fn lines_are_run_again_after_a_crash_at_their_time_and_among_the_changes_by_hand() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    begin(&mut bench);
    run(&mut bench, "print(entity(\"lamp\").intensity)");
    run(&mut bench, "let far = 3;");
    run(
        &mut bench,
        "spawn(\"new\").mesh(sphere(0.5)).at(far, 1, 0);",
    );
    // What a line has made is called otherwise by hand, and a line finds it by that name.
    choose(&mut bench, "new");
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.rename_chosen("ball").unwrap();
    workbench.create(NewKind::Torus).unwrap();
    run(
        &mut bench,
        "entity(\"ball\").scale(2); entity(\"torus\").at(0, far, 0);",
    );
    // At a time of its own, with steps before it and after it.
    step(&mut bench);
    step(&mut bench);
    run(&mut bench, "state.speed = 5.0;");
    step(&mut bench);
    // What was taken back is none of it.
    run(&mut bench, "entity(\"lamp\").remove();");
    bench.key(CTRL, Key::Z);
    let (written, time) = (
        text(&mut bench),
        bench.harness.state().workbench.clock.time(),
    );
    let lines = [
        "let far = 3;",
        "spawn(\"new\").mesh(sphere(0.5)).at(far, 1, 0);",
        "entity(\"ball\").scale(2); entity(\"torus\").at(0, far, 0);",
        "state.speed = 5.0;",
    ];
    bench.until("the session", |_| kept_lines(kept.path()) == lines);
    let project = bench.close();

    let mut bench = open(project, &settings);
    assert_eq!(bench.count("moves, lines of the console: 4"), 1);
    assert_eq!(bench.count("moves, changes by hand: 2"), 1);
    assert_ne!(text(&mut bench), written);
    bench.press("Restore");
    settle(&mut bench);
    assert_eq!(bench.harness.state().workbench.clock.time(), time);
    assert_eq!(text(&mut bench), written);
    // Its variables are there, and it is a session of this run now.
    run(&mut bench, "entity(\"ball\").at(far, 2, far);");
    let moved = text(&mut bench);
    assert_ne!(moved, written);
    bench.until("the session", |_| kept_lines(kept.path()).len() == 5);
    let mut bench = open(bench.close(), &settings);
    bench.press("Restore");
    settle(&mut bench);
    assert_eq!(text(&mut bench), moved);
}

#[test]
fn lines_count_when_the_window_is_closed_and_go_with_the_scene_that_they_changed() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    begin(&mut bench);
    run(&mut bench, "let far = 3;");
    let unsaved = |bench: &Bench| bench.harness.state().workbench.unsaved_changes();
    assert_eq!(unsaved(&bench), [], "a variable is nothing to save");
    run(&mut bench, "entity(\"lamp\").intensity(far);");
    assert_eq!(unsaved(&bench), [("moves".to_owned(), 1)]);
    bench.key(CTRL, Key::Q);
    assert!(!bench.harness.state().wants_to_quit());
    bench.press("Go on editing");
    bench.key(CTRL, Key::Z);
    assert_eq!(unsaved(&bench), []);
    bench.key(
        Modifiers {
            shift: true,
            ..CTRL
        },
        Key::Z,
    );
    assert_eq!(unsaved(&bench), [("moves".to_owned(), 1)]);
    // In a file they are safe.
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.save_scene("copy").unwrap();
    assert_eq!(unsaved(&bench), []);
    run(&mut bench, "entity(\"lamp\").intensity(8);");
    assert_eq!(unsaved(&bench).len(), 1);
    bench.until("the session", |_| kept_lines(kept.path()).len() == 3);
    // The script is read anew, and what the lines did is gone with the scene.
    let swaps = bench.harness.state().workbench.scenes.swaps();
    bench.save(FILE, &SCENE.replace("60", "61"));
    bench.until("the scene anew", |editor| {
        editor.workbench.scenes.swaps() > swaps && !editor.workbench.scenes.is_busy()
    });
    assert_eq!(unsaved(&bench), []);
}
