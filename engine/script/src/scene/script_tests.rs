//! What a scene's own script is told of, and what it keeps.
#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_assets::cache::Cache;
use lightbench_world::glam::Vec3;

use super::{KeptState, Ray, Scene, SceneEvent, load_scene_again};
use crate::testing::project;
use crate::{Limits, Settings};

fn load(files: &[(&str, &str)], kept: KeptState) -> Scene {
    let (_folder, files) = project(files);
    let (cache, limits) = (Cache::default(), Limits::default());
    let (settings, progress) = (Settings::new(), Progress::new());
    load_scene_again(&files, "test", &settings, &progress, &cache, &limits, kept)
        .unwrap_or_else(|problems| panic!("{problems}"))
}

fn scene(text: &str) -> Scene {
    load(&[("scripts/scenes/test.rhai", text)], KeptState::default())
}

fn said(scene: &mut Scene) -> Vec<String> {
    let lines = scene.take_log().into_iter();
    lines.map(|line| line.text).collect()
}

#[test]
fn the_script_hears_keys_clicks_and_broadcasts() {
    let mut scene = scene(
        "spawn(\"ball\").mesh(sphere(1)).material(material(\"clay\"));
        fn on_key(key) { print(\"key \" + key); broadcast(\"pressed\", key); }
        fn on_click(entity, point) { print(entity.name + \" at \" + round(point.z)); }
        fn on_message(name, value) { print(name + \" \" + value); }
        fn update() { print(\"update\"); }",
    );
    let from = |x: f32| Ray {
        origin: Vec3::new(x, 0.0, 5.0),
        direction: Vec3::NEG_Z,
    };
    scene.happen(SceneEvent::KeyDown("a".to_owned()));
    scene.happen(SceneEvent::Click(from(0.0)));
    // Beside everything: nobody is told.
    scene.happen(SceneEvent::Click(from(9.0)));
    scene.update(0.1, 0.1).unwrap();
    let expected = ["key a", "ball at 1.0", "update", "pressed a"];
    assert_eq!(said(&mut scene), expected);
    scene.update(0.2, 0.1).unwrap();
    assert_eq!(said(&mut scene), ["update"]);
}

#[test]
fn a_mistake_in_one_function_stops_the_script_and_is_told_once() {
    let mut scene =
        scene("fn on_key(key) {\n    throw \"no \" + key;\n}\nfn update() { print(\"update\"); }");
    scene.happen(SceneEvent::KeyDown("a".to_owned()));
    let problem = scene.update(0.1, 0.1).unwrap_err();
    assert_eq!(problem.message, "no a");
    assert_eq!(problem.place.line, 2);
    scene.happen(SceneEvent::KeyDown("b".to_owned()));
    scene.update(0.2, 0.1).unwrap();
    assert_eq!(said(&mut scene), [""; 0]);
    assert!(!scene.has_update());
}

#[test]
fn functions_with_too_many_arguments_are_refused() {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", "fn on_click(a, b, c) { }")]);
    let problems = crate::load_scene(&files, "test", &Settings::new(), &Progress::new());
    let problem = &problems.unwrap_err().0[0];
    assert_eq!(problem.message, "`on_click` takes 3 arguments");
    let hint = problem.hint.as_deref();
    assert_eq!(
        hint,
        Some("it is written `fn on_click(entity, point) { … }`")
    );
}

const COUNTS: &str = "
state.keep(\"visits\", 0);
state.keep(\"path\", [vec3(0, 0, 0)]);
state.other = 0;
fn update() {
    state.visits += 1;
    state.other += 1;
    state.path += vec3(state.visits, 0, 0);
    print(`${state.visits} ${state.other} ${state.path.len()}`);
}";

#[test]
fn what_a_script_keeps_goes_on_after_it_was_loaded_again() {
    let mut first = scene(COUNTS);
    for _ in 0..3 {
        first.update(0.1, 0.1).unwrap();
    }
    assert_eq!(said(&mut first), ["1 1 2", "2 2 3", "3 3 4"]);
    let changed = COUNTS.replace("print", "// It was saved.\n    print");
    let mut second = load(&[("scripts/scenes/test.rhai", &changed)], first.kept());
    second.update(0.1, 0.1).unwrap();
    assert_eq!(said(&mut second), ["4 1 5"]);
    // What is no longer asked for is forgotten.
    let mut third = load(
        &[(
            "scripts/scenes/test.rhai",
            "state.visits = 0; fn update() { print(state.visits); }",
        )],
        second.kept(),
    );
    third.update(0.1, 0.1).unwrap();
    assert_eq!(said(&mut third), ["0"]);
}

#[test]
fn behaviours_keep_their_own_by_the_names_of_their_entities() {
    let behaviour = "state.keep(\"turns\", 0);
        fn update() { state.turns += me.position.x; print(me.name + \" \" + state.turns); }";
    let files = [
        ("scripts/behaviours/count.rhai", behaviour),
        (
            "scripts/scenes/test.rhai",
            "spawn(\"one\").at(1, 0, 0).behave(\"count\");
            spawn(\"ten\").at(10, 0, 0).behave(\"count\");",
        ),
    ];
    let mut first = load(&files, KeptState::default());
    first.update(0.1, 0.1).unwrap();
    first.update(0.2, 0.1).unwrap();
    first.take_log();
    let mut second = load(&files, first.kept());
    second.update(0.1, 0.1).unwrap();
    assert_eq!(said(&mut second), ["one 3.0", "ten 30.0"]);
}

#[test]
fn entities_are_not_kept() {
    let (_folder, files) = project(&[(
        "scripts/scenes/test.rhai",
        "state.keep(\"lamp\", spawn(\"lamp\"));",
    )]);
    let problems = crate::load_scene(&files, "test", &Settings::new(), &Progress::new());
    let message = problems.unwrap_err().0[0].message.clone();
    assert_eq!(
        message,
        "`keep` can't keep an entity: it belongs to this run alone"
    );
    // Nor one that came later; the others are.
    let text = "state.keep(\"lamp\", ()); state.keep(\"count\", 0);
        fn update() { state.lamp = spawn(\"lamp\"); state.count += 1; print(state.count); }";
    let mut first = scene(text);
    first.update(0.1, 0.1).unwrap();
    let text = format!("{text} print(type_of(state.lamp));");
    let mut second = load(&[("scripts/scenes/test.rhai", &text)], first.kept());
    first.take_log();
    second.update(0.1, 0.1).unwrap();
    assert_eq!(said(&mut second), ["()", "2"]);
}

#[test]
fn a_script_asks_for_a_pipeline() {
    let mut scene = scene(
        "use_pipeline(\"tiled_forward\", #{ tile_size: \"16\", exposure: 2 });
        fn update() { use_pipeline(\"deferred_shading\"); }",
    );
    let choice = scene.take_pipeline_choice().unwrap();
    assert_eq!(choice.name, "tiled_forward");
    let exposure = choice.settings.get("exposure").map(ToString::to_string);
    assert_eq!(exposure.as_deref(), Some("2"));
    assert_eq!(scene.take_pipeline_choice(), None);
    scene.update(0.1, 0.1).unwrap();
    assert_eq!(
        scene.take_pipeline_choice().unwrap().name,
        "deferred_shading"
    );
    let (_folder, files) = project(&[(
        "scripts/scenes/test.rhai",
        "use_pipeline(\"tiled_foward\");",
    )]);
    let problems = crate::load_scene(&files, "test", &Settings::new(), &Progress::new());
    let problem = problems.unwrap_err().0.remove(0);
    assert_eq!(problem.message, "there is no pipeline `tiled_foward`");
    assert_eq!(
        problem.hint.as_deref(),
        Some("did you mean `tiled_forward`?")
    );
}

#[test]
fn functions_without_a_name_see_the_state() {
    let mut scene = scene(
        "state.least = 2;
        print([1, 2, 3].filter(|x| x >= state.least).len());
        fn update() { print([1, 2, 3].map(|x| x * state.least)[2]); }",
    );
    scene.update(0.1, 0.1).unwrap();
    assert_eq!(said(&mut scene), ["2", "6"]);
}

#[test]
fn near_misses_of_names_that_are_called_are_told() {
    let mut first = scene("fn Update(t, dt) { }\nfn on_keys(key) { }\nfn updated() { } updated();");
    let told = said(&mut first);
    assert_eq!(
        told,
        [
            "warning: nothing calls `Update`: did you mean `update`?",
            "warning: nothing calls `on_keys`: did you mean `on_key`?",
        ]
    );
    let mut second = scene("fn update() { step(); } fn step() { }");
    assert_eq!(said(&mut second), [""; 0]);
}

#[test]
fn a_key_that_there_is_not_is_refused() {
    for (key, hint) in [
        ("ArrowLeft", "did you mean `left`?"),
        ("spcae", "did you mean `space`?"),
        ("hyper", "keys are letters and digits"),
    ] {
        let text = format!("key_down(\"{key}\");");
        let (_folder, files) = project(&[("scripts/scenes/test.rhai", &text)]);
        let problems = crate::load_scene(&files, "test", &Settings::new(), &Progress::new());
        let told = problems.unwrap_err().to_string();
        assert!(
            told.contains("there is no key") && told.contains(hint),
            "{told}"
        );
    }
    let mut scene = scene("fn update() { key_down(\"7\"); key_down(\"Space\"); }");
    assert!(!scene.hears_keys());
    scene.update(0.1, 0.1).unwrap();
    assert!(scene.hears_keys());
}

#[test]
fn a_click_on_a_part_goes_to_what_it_belongs_to() {
    let files = [
        (
            "scripts/behaviours/door.rhai",
            "fn on_click(point) { print(me.name + \" \" + round(point.z)); }",
        ),
        (
            "scripts/scenes/test.rhai",
            "let door = spawn(\"door\").behave(\"door\");
            spawn(\"leaf\").mesh(sphere(1)).material(material(\"oak\")).parent(door);",
        ),
    ];
    let mut scene = load(&files, KeptState::default());
    let ray = Ray {
        origin: Vec3::new(0.0, 0.0, 5.0),
        direction: Vec3::NEG_Z,
    };
    scene.happen(SceneEvent::Click(ray));
    // The behaviour's file is needed no more: it began with the scene.
    scene.update(0.1, 0.1).unwrap();
    assert_eq!(said(&mut scene), ["door 1.0"]);
}

#[test]
fn wrong_values_for_a_pipeline_are_told_at_their_line() {
    for (call, expected) in [
        ("use_pipeline(\"tiled_forward\", #{ foo: 1 });", "`foo`"),
        (
            "use_pipeline(\"tiled_forward\", #{ tile_size: 7 });",
            "`tile_size`",
        ),
    ] {
        let text = format!("let a = 1;\n{call}");
        let (_folder, files) = project(&[("scripts/scenes/test.rhai", &text)]);
        let problems = crate::load_scene(&files, "test", &Settings::new(), &Progress::new());
        let problem = problems.unwrap_err().0.remove(0);
        assert_eq!(problem.place.line, 2, "{problem}");
        assert!(problem.message.contains(expected), "{problem}");
    }
}
