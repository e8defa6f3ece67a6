#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_assets::files::Files;
use lightbench_world::glam::Vec3;
use lightbench_world::{Light, Transform};

use super::*;
use crate::scene::{Ray, Scene, SceneEvent, load_scene};
use crate::testing::project;

const STEP: f64 = 1.0 / 60.0;

/// The scene `test` with its project, which lasts as long as the folder.
type Loaded = (tempfile::TempDir, Scene);

fn load(scene: &str, behaviours: &[(&str, &str)]) -> Result<Loaded, Problems> {
    let paths: Vec<String> = behaviours
        .iter()
        .map(|(name, _)| format!("{BEHAVIOURS}/{name}.rhai"))
        .collect();
    let texts = behaviours.iter().map(|(_, text)| *text);
    let mut files: Vec<(&str, &str)> = paths.iter().map(String::as_str).zip(texts).collect();
    files.push(("scripts/scenes/test.rhai", scene));
    let (folder, files) = project(&files);
    let scene = load_scene(&files, "test", &Settings::new(), &Progress::new())?;
    Ok((folder, scene))
}

fn good(scene: &str, behaviours: &[(&str, &str)]) -> Loaded {
    load(scene, behaviours).unwrap_or_else(|problems| panic!("{problems}"))
}

fn place(scene: &Scene, name: &str) -> Vec3 {
    let entity = scene.world.find(name).unwrap();
    let transform: Transform = scene.world.get(entity).unwrap();
    transform.translation
}

fn run(scene: &mut Scene, steps: u32) {
    for step in 1..=steps {
        scene.update(f64::from(step) * STEP, STEP).unwrap();
    }
}

const CLIMB: &str = "
const SPEED = param(\"speed\", 1.0, 0, 10, \"Metres a second\");
state.steps = 0;
fn init() { me.move(0, 10, 0); }
fn update(time, dt) {
    state.steps += 1;
    me.move(0, SPEED * dt, 0);
    me.at(state.steps, me.position.y, 0);
}";

#[test]
fn each_entity_has_its_own_state_and_parameters() {
    let (_folder, mut scene) = good(
        "spawn(\"slow\").behave(\"climb\");
        spawn(\"fast\").behave(\"climb\", #{ speed: 4 });
        state.steps = 100;
        spawn(\"late\");
        fn update(time, dt) {
            state.steps += 1;
            if state.steps == 103 { entity(\"late\").behave(\"climb\", #{ speed: 2.5 }); }
        }",
        &[("climb", CLIMB)],
    );
    assert_eq!(place(&scene, "slow").y, 10.0, "`init` is called at once");
    run(&mut scene, 6);
    // `late` got it in the third step, and was updated in it.
    for (name, steps, speed) in [("slow", 6.0, 1.0), ("fast", 6.0, 4.0), ("late", 4.0, 2.5)] {
        let expected = Vec3::new(steps, 10.0 + steps * speed * STEP as f32, 0.0);
        let found = place(&scene, name);
        assert!(found.distance(expected) < 1e-4, "{name}: {found}");
    }
    let listed = scene.behaviours();
    let speeds: Vec<String> = listed
        .iter()
        .map(|behaviour| behaviour.parameters[0].value.to_string())
        .collect();
    assert_eq!(speeds, ["1", "4", "2.5"]);
}

#[test]
fn messages_come_after_updates_and_answers_a_step_later() {
    let ping = "
    fn update(time, dt) { if time < 0.02 { entity(\"pong\").send(\"ping\", 7); } }
    fn on_message(name, value) { print(`${name} ${value}`); }";
    let pong = "
    fn on_message(name, value) {
        print(`${name} ${value}`);
        if name == \"ping\" { entity(\"ping\").send(\"pong\", value + 1); broadcast(\"all\"); }
    }";
    let (_folder, mut scene) = good(
        "spawn(\"ping\").behave(\"ping\"); spawn(\"pong\").behave(\"pong\");",
        &[("ping", ping), ("pong", pong)],
    );
    let mut step = |number: u32| -> Vec<String> {
        scene.update(f64::from(number) * STEP, STEP).unwrap();
        let log = scene.take_log();
        log.into_iter().map(|line| line.text).collect()
    };
    assert_eq!(step(1), ["ping 7"]);
    assert_eq!(step(2), ["pong 8", "all ", "all "]);
    assert_eq!(step(3), [""; 0]);
}

#[test]
fn an_error_stops_one_behaviour_and_is_told_once() {
    let bad = "fn update(time, dt) {\n    if time > 0.03 { me.at(nothing(), 0, 0); }\n}";
    let (_folder, mut scene) = good(
        "spawn(\"bad\").behave(\"bad\"); spawn(\"good\").behave(\"climb\");",
        &[("bad", bad), ("climb", CLIMB)],
    );
    run(&mut scene, 1);
    let problem = scene.update(2.0 * STEP, STEP).unwrap_err();
    assert_eq!(
        problem.place.to_string(),
        "scripts/behaviours/bad.rhai:2:28"
    );
    assert_eq!(problem.message, "there is no function `nothing`");
    scene.update(3.0 * STEP, STEP).unwrap();
    assert_eq!(place(&scene, "good").x, 3.0, "the other goes on");
    let stopped: Vec<bool> = scene.behaviours().iter().map(|b| b.stopped).collect();
    assert_eq!(stopped, [true, false]);
}

#[test]
fn mistakes_name_the_file_and_the_way_out() {
    let at = |scene: &str, behaviour: &str| {
        let problems = load(scene, &[("climb", behaviour)])
            .map(|_| ())
            .unwrap_err();
        let problem = &problems.0[0];
        format!(
            "{}: {}; {}",
            problem.place,
            problem.message,
            problem.hint.clone().unwrap_or_default()
        )
    };
    let spawned = "spawn(\"a\").behave(\"climb\");";
    for (scene, behaviour, told) in [
        (
            "spawn(\"a\").behave(\"clim\");",
            CLIMB,
            "scripts/scenes/test.rhai:1:12: there is no behaviour `clim`; did you mean `climb`?",
        ),
        (
            "spawn(\"a\").behave(\"climb\", #{ sped: 3 });",
            CLIMB,
            "scripts/behaviours/climb.rhai: the behaviour has no parameter `sped`; \
             did you mean `speed`?",
        ),
        (
            "spawn(\"a\").behave(\"climb\", #{ speed: 30 });",
            CLIMB,
            "scripts/behaviours/climb.rhai:2:15: `speed` takes a number from 0 to 10, not `30`; ",
        ),
        (
            "spawn(\"a\").behave(\"climb\", 3);",
            CLIMB,
            "scripts/scenes/test.rhai:1:12: `values` of `behave` must be a map, as in \
             `#{ speed: 30 }`, not the number 3; it is written `.behave(name, values)`",
        ),
        (
            spawned,
            "fn on_key(key, more) { }",
            "scripts/behaviours/climb.rhai:1:4: `on_key` takes 2 arguments; it is written \
             `fn on_key(key) { … }`",
        ),
        (
            "me.at(0, 0, 0);",
            CLIMB,
            "scripts/scenes/test.rhai:1:1: `me` is the entity of a behaviour, and the scene's own \
             script has none; behaviours lie in scripts/behaviours/",
        ),
    ] {
        assert_eq!(at(scene, behaviour), told);
    }
}

/// One that can't begin is told once, and tried again when it changes; also in the middle of a run.
#[test]
fn a_behaviour_that_cannot_begin_is_told_once() {
    let (_folder, mut scene) = good(
        "spawn(\"a\");
        fn update(time, dt) {
            if time == 1 { entity(\"a\").behave(\"climb\", #{ speed: 30 }); }
            if time == 4 { entity(\"a\").behave(\"climb\", #{ speed: 3 }); }
        }",
        &[("climb", CLIMB)],
    );
    let told: Vec<bool> = (1..6)
        .map(|time| scene.update(f64::from(time), STEP).is_err())
        .collect();
    assert_eq!(told, [true, false, false, false, false]);
    assert_eq!(place(&scene, "a").x, 2.0, "it runs since the fourth step");
    assert!(!scene.behaviours()[0].stopped);
}

#[test]
fn messages_that_multiply_are_stopped_and_those_to_nobody_go() {
    let (_folder, mut scene) = good(
        "for i in 0..3 { spawn().behave(\"echo\"); }
        broadcast(\"begin\");",
        &[("echo", "fn on_message(name) { broadcast(name); }")],
    );
    let problem = (1..20).find_map(|step| scene.update(f64::from(step), STEP).err());
    let message = problem.unwrap().message;
    assert!(
        message.starts_with("more than 10000 messages wait"),
        "{message}"
    );

    let (_folder, mut scene) = good(
        "fn update(time, dt) { for i in 0..6000 { broadcast(\"hello\"); } }",
        &[],
    );
    run(&mut scene, 3);
}

#[test]
fn keys_and_clicks_reach_behaviours() {
    let listen = "
    fn on_key(key) { print(`${key} ${keys_down()}`); }
    fn on_click(point) { print(`${me.name} at ${point.z}`); }";
    let (_folder, mut scene) = good(
        "spawn(\"near\").mesh(box(1, 1, 1)).at(0, 0, -3).behave(\"listen\");
        spawn(\"far\").mesh(box(9, 9, 1)).at(0, 0, -8).behave(\"listen\");",
        &[("listen", listen)],
    );
    let told = |scene: &mut Scene| -> Vec<String> {
        scene.update(STEP, STEP).unwrap();
        scene.take_log().into_iter().map(|line| line.text).collect()
    };
    scene.happen(SceneEvent::KeyDown("a".to_owned()));
    // A key that is held down repeats; it went down once.
    scene.happen(SceneEvent::KeyDown("a".to_owned()));
    assert_eq!(told(&mut scene), ["a [\"a\"]", "a [\"a\"]"]);
    let click = |x: f32| {
        SceneEvent::Click(Ray {
            origin: Vec3::new(x, 0.0, 0.0),
            direction: Vec3::NEG_Z,
        })
    };
    scene.happen(click(0.0));
    scene.happen(click(2.0));
    scene.happen(click(20.0));
    assert_eq!(told(&mut scene), ["near at -2.5", "far at -7.5"]);
    scene.happen(SceneEvent::Leave);
    scene.happen(SceneEvent::KeyDown("b".to_owned()));
    assert_eq!(told(&mut scene), ["b [\"b\"]", "b [\"b\"]"]);
}

#[test]
fn a_behaviour_ends_with_its_entity_and_begins_anew_with_other_values() {
    let (_folder, mut scene) = good(
        "spawn(\"a\").behave(\"climb\"); spawn(\"b\").behave(\"climb\");
        fn update(time, dt) { if time > 0.04 && has_entity(\"a\") { entity(\"a\").remove(); } }",
        &[("climb", CLIMB)],
    );
    run(&mut scene, 3);
    assert_eq!(scene.behaviours().len(), 1);
    let b = scene.world.find("b").unwrap();
    let speed = SettingValue::Number(7.0);
    scene.set_behaviour(b, "speed", &speed).unwrap();
    assert_eq!(
        scene.set_behaviour(b, "speed", &SettingValue::Number(11.0)),
        Err("`speed` takes a number from 0 to 10, not `11`".to_owned())
    );
    scene.update(1.0, 0.5).unwrap();
    // `init` again, and half a second at seven metres a second.
    let found = place(&scene, "b");
    assert_eq!(found.x, 1.0);
    assert!(
        (found.y - (20.0 + 3.0 * STEP as f32 + 3.5)).abs() < 1e-4,
        "{found}"
    );
}

#[test]
fn shipped_behaviours_do_what_they_say() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = "
    spawn(\"globe\").behave(\"spin\", #{ speed: 90 });
    point_light(\"candle\").intensity(2).behave(\"flicker\");
    spawn(\"ball\").mesh(sphere(0.3)).at(0, 0.3, 0).behave(\"drive\");";
    let (own, _) = project(&[("scripts/scenes/test.rhai", text)]);
    let shipped = Files::with_project(folder).unwrap();
    for name in ["spin", "flicker", "drive"] {
        let path = format!("{BEHAVIOURS}/{name}.rhai");
        let to = own.path().join(&path);
        std::fs::create_dir_all(to.parent().unwrap()).unwrap();
        std::fs::write(to, shipped.read_text(&path).unwrap()).unwrap();
    }
    let files = Files::with_project(own.path()).unwrap();
    let mut scene = load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap();
    scene.happen(SceneEvent::KeyDown("right".to_owned()));
    scene.happen(SceneEvent::KeyDown("enter".to_owned()));
    let (mut least, mut most, mut highest) = (f32::MAX, 0.0_f32, 0.0_f32);
    for step in 1..=120 {
        scene.update(f64::from(step) * STEP, STEP).unwrap();
        let candle = scene.world.find("candle").unwrap();
        let light: Light = scene.world.get(candle).unwrap();
        least = least.min(light.intensity);
        most = most.max(light.intensity);
        highest = highest.max(place(&scene, "ball").y);
    }
    let globe: Transform = scene.world.get(scene.world.find("globe").unwrap()).unwrap();
    // Two seconds at ninety degrees a second: half a turn.
    assert!((globe.rotation * Vec3::X).distance(Vec3::NEG_X) < 1e-3);
    assert!(
        least >= 1.2 && most <= 2.0 && most - least > 0.1,
        "{least} to {most}"
    );
    let ball = place(&scene, "ball");
    assert!(
        (ball.x - 6.0).abs() < 1e-3 && (ball.y - 0.3).abs() < 1e-6,
        "{ball}"
    );
    // v² / 2g is 0.815 m.
    assert!((highest - 1.1).abs() < 0.05, "{highest}");
    let candle = scene.world.find("candle").unwrap();
    scene.happen(SceneEvent::KeyUp("right".to_owned()));
    scene
        .set_behaviour(candle, "depth", &SettingValue::Number(1.0))
        .unwrap();
    scene.update(3.0, STEP).unwrap();
    assert!(scene.world.get::<Light>(candle).unwrap().intensity < most);
}
