//! The console panel of the editor.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use lightbench::world::Light;
use lightbench_editor::ui::layout::Panel;

use ui_support::Bench;

fn focus(bench: &mut Bench) {
    bench.show(Panel::Console);
    bench
        .harness
        .get_by_role_and_label(Role::TextInput, "Line")
        .focus();
    bench.harness.run_steps(2);
}

fn write(bench: &mut Bench, text: &str) {
    // Key by key, so that a shortcut among them would fire.
    for letter in text.chars() {
        if let Some(key) = Key::from_name(&letter.to_string().to_uppercase()) {
            bench.harness.key_press(key);
        }
        bench.harness.event(egui::Event::Text(letter.to_string()));
        bench.harness.run_steps(1);
    }
}

fn press(bench: &mut Bench, key: Key) {
    bench.harness.key_press(key);
    bench.harness.run_steps(2);
}

fn line(bench: &Bench) -> String {
    let field = bench.harness.get_by_role_and_label(Role::TextInput, "Line");
    field.value().unwrap_or_default()
}

#[test]
fn a_line_changes_the_scene_and_no_key_of_it_is_a_shortcut() {
    let mut bench = Bench::open();
    let first = bench.picture();
    let pipeline = bench.shown();
    focus(&mut bench);
    write(
        &mut bench,
        "for e in entities().with(\"light\") { e.intensity = 4 + 2; } [1.5]",
    );
    press(&mut bench, Key::Enter);
    let scene = bench
        .harness
        .state_mut()
        .workbench
        .scenes
        .scene_mut()
        .unwrap();
    assert!(
        scene
            .world
            .columns::<Light>()
            .intensity()
            .iter()
            .all(|i| *i == 6.0)
    );
    assert_ne!(bench.picture(), first);
    assert!(bench.count("[1.5]") >= 2, "the line and its value");
    // 1 to 9 choose a pipeline elsewhere, f frames the scene, space plays, a point steps.
    assert_eq!(bench.shown(), pipeline);
    let workbench = &bench.harness.state().workbench;
    assert!(!workbench.camera.is_moved());
    assert!(!workbench.clock.playing);
    assert_eq!(workbench.clock.time(), 0.0);
    assert_eq!(bench.last_deed().what, "typed into the console");
    assert_eq!(line(&bench), "");

    // The line is ready for the next; a mistake changes nothing and is told.
    let bright = bench.picture();
    write(&mut bench, "print(7 * 6); spawn(\"x\"); entity(\"y\")");
    press(&mut bench, Key::Enter);
    assert!(bench.count("there is no entity `y`") >= 1);
    assert_eq!(bench.picture(), bright);
    let scene = bench
        .harness
        .state_mut()
        .workbench
        .scenes
        .scene_mut()
        .unwrap();
    assert!(scene.world.find("x").is_none());
    write(&mut bench, "print(\"said \" + 6 * 7);");
    press(&mut bench, Key::Enter);
    assert_eq!(bench.count("said 42"), 1);
    assert!(
        bench
            .harness
            .state()
            .workbench
            .log
            .lines()
            .any(|line| line.text == "said 42")
    );
}

#[test]
fn earlier_lines_come_back_also_after_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let kept = Some(folder.path().join("settings/editor.json"));
    let mut bench = Bench::open_with(kept.clone());
    focus(&mut bench);
    for text in ["1 + 1", "7 * 191"] {
        write(&mut bench, text);
        press(&mut bench, Key::Enter);
    }
    write(&mut bench, "draft");
    press(&mut bench, Key::ArrowUp);
    assert_eq!(line(&bench), "7 * 191");
    press(&mut bench, Key::ArrowUp);
    press(&mut bench, Key::ArrowUp);
    assert_eq!(line(&bench), "1 + 1");
    press(&mut bench, Key::ArrowDown);
    assert_eq!(line(&bench), "7 * 191");
    press(&mut bench, Key::ArrowDown);
    assert_eq!(line(&bench), "draft");

    drop(bench);
    let mut again = Bench::open_with(kept);
    focus(&mut again);
    press(&mut again, Key::ArrowUp);
    assert_eq!(line(&again), "7 * 191");
    // An earlier line is run as it stands there.
    press(&mut again, Key::Enter);
    assert_eq!(again.count("1337"), 1);
}

#[test]
fn tab_completes_names_and_the_text_of_the_name_is_shown() {
    let mut bench = Bench::open();
    focus(&mut bench);
    write(&mut bench, "point_l");
    press(&mut bench, Key::Tab);
    assert_eq!(line(&bench), "point_light(");
    let page = lightbench::script::reference::api();
    let about = "Makes a light that shines from a point in all directions";
    let shown = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let told = shown.contains(about);
    press(&mut bench, Key::Tab);
    // One after the other, and round again.
    let first = line(&bench);
    press(&mut bench, Key::Tab);
    let second = line(&bench);
    assert_ne!(first, second);
    press(&mut bench, Key::Tab);
    assert_eq!(line(&bench), first);
    assert!(bench.count("point_light(name)") >= 1);
    assert!(!told || bench.count(about) >= 1);

    // What is typed around Tab lands around the name, also where all comes in one frame.
    press(&mut bench, Key::Enter);
    bench
        .harness
        .event(egui::Event::Text("smoothst".to_owned()));
    bench.harness.key_press(Key::Tab);
    bench.harness.run_steps(3);
    assert_eq!(line(&bench), "smoothstep(");
    press(&mut bench, Key::Enter);
    write(&mut bench, "smoothst");
    bench.harness.key_press(Key::Tab);
    bench
        .harness
        .event(egui::Event::Text("1, 2, 3)".to_owned()));
    bench.harness.run_steps(3);
    assert_eq!(line(&bench), "smoothstep(1, 2, 3)");

    // Tab stays in the line, and completes what is in a text.
    press(&mut bench, Key::Enter);
    write(&mut bench, "spawn(\"a long name\");");
    press(&mut bench, Key::Enter);
    write(&mut bench, "entity(\"a l");
    press(&mut bench, Key::Tab);
    assert_eq!(line(&bench), "entity(\"a long name");
    write(&mut bench, "\").set(\"transform.tr");
    press(&mut bench, Key::Tab);
    assert_eq!(
        line(&bench),
        "entity(\"a long name\").set(\"transform.translation"
    );
    assert!(bench.count("Position of the entity's origin in its parent's space.") >= 1);
}
