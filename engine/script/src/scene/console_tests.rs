#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_world::Light;

use crate::testing::project;
use crate::{Limits, Scene, Settings, load_scene, load_scene_within};

fn scene() -> Scene {
    let script = "state.n = 1; point_light(\"lamp\").intensity(2);
                  fn update() { state.n += 1; }";
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", script)]);
    load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap()
}

#[test]
fn a_line_is_scene_script_on_the_scene_that_is_there() {
    let mut scene = scene();
    let mut value = |line: &str| scene.evaluate(line).unwrap().unwrap_or_default();
    assert_eq!(
        value("let lamp = entity(\"lamp\"); lamp.intensity = 40;"),
        ""
    );
    assert_eq!(value("entity(\"lamp\").intensity"), "40.0");
    assert_eq!(value("let x = 3; x * 2"), "6");
    assert_eq!(value("x += 1; x"), "4", "a variable stays");
    assert_eq!(value("state.n"), "1");
    assert_eq!(value("vec3(1, 2, 3)"), "vec3(1.0, 2.0, 3.0)");
    assert_eq!(value("\"a\" + 1"), "\"a1\"");
    assert_eq!(value("[1, vec3(1, 2, 3)]"), "[1, vec3(1.0, 2.0, 3.0)]");
    assert_eq!(value("print(\"hi\")"), "");
    assert_eq!(value("for i in 0..3 { spawn(`new ${i}`); }"), "");
    assert!(value("entity(\"new 2\")").starts_with('#'));
    assert_eq!(scene.take_log()[0].text, "hi");
    assert_eq!(scene.take_log().len(), 0);
    assert!(scene.world.find("new 2").is_some());
    let lamp = scene.world.find("lamp").unwrap();
    assert_eq!(scene.world.get::<Light>(lamp).unwrap().intensity, 40.0);
    assert!(scene.console_variables().contains(&"x".to_owned()));
    assert!(scene.console_variables().contains(&"state".to_owned()));
}

#[test]
fn a_line_with_a_mistake_changes_nothing_and_says_what_is_wrong() {
    let mut scene = scene();
    scene.evaluate("let x = 1;").unwrap();
    let before = scene.to_text().unwrap();
    for (line, message) in [
        (
            "spawn(\"new\"); state.n = 9; x = 5; entity(\"lmap\")",
            "there is no entity `lmap`",
        ),
        ("spawn(\"new\"); y", "there is no variable `y`"),
        (
            "entity(\"lamp\").remove(); throw",
            "the script threw an error without a text",
        ),
        ("let = 3", ""),
        ("spawn(\"new\"); loop { }", "the script does more than"),
        ("fn f() { f() } f()", "functions call each other more than"),
        ("me", "`me` is the entity of a behaviour"),
    ] {
        let problem = scene.evaluate(line).unwrap_err();
        assert!(problem.message.starts_with(message), "{line}: {problem}");
        assert_eq!(&*problem.place.file, "console", "{line}");
        assert_eq!(problem.place.line, 1, "{line}");
        assert_eq!(scene.to_text().unwrap(), before, "{line}");
        assert_eq!(scene.evaluate("[state.n, x]").unwrap().unwrap(), "[1, 1]");
    }
    scene.update(0.0, 0.0).unwrap();
    assert_eq!(scene.evaluate("state.n").unwrap().unwrap(), "2");
}

#[test]
fn the_limits_of_the_scene_hold_for_lines_too() {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", "camera();")]);
    let limits = Limits {
        entities: 10,
        operations: 10_000,
        ..Limits::default()
    };
    let (settings, progress) = (Settings::new(), Progress::new());
    let cache = lightbench_assets::cache::Cache::default();
    let mut scene =
        load_scene_within(&files, "test", &settings, &progress, &cache, &limits).unwrap();
    let problem = scene.evaluate("for i in 0..20 { spawn(); }").unwrap_err();
    assert!(problem.message.contains("may not have more"), "{problem}");
    assert_eq!(scene.world.len(), 1);
    let problem = scene
        .evaluate("let i = 0; while i < 100000 { i += 1; }")
        .unwrap_err();
    assert!(
        problem.message.contains("more than 10000 steps"),
        "{problem}"
    );
}
