//! The same script, the same steps: the same world and the same picture, bit for bit.
#![allow(clippy::unwrap_used)]

use lightbench::assets::files::Files;
use lightbench::script::{Scene, SceneEvent, Settings};
use lightbench_tests::{Studio, settings};

const FRAMES: u32 = 300;
const STEP: f64 = 1.0 / 60.0;

/// A scene in which chance, noise, columns, behaviours, messages, keys and curves move things.
const EVERYTHING: &str = "
let chance = random(7);
let path = curve([[0, vec3(-2, 1, 0)], [2, vec3(2, 2, 1)], [5, vec3(-2, 1, 0)]], \"smooth\");
spawn(\"floor\").mesh(plane(12, 12)).material(material(\"clay\").color(0.6, 0.5, 0.4));
for i in 0..40 {
    let ball = spawn(\"ball \" + i).mesh(sphere(0.2).segments(12, 6)).material(material(\"m\" + i % 4)).tag(\"ball\");
    ball.at(chance.range(-4, 4), chance.range(0, 3), chance.range(-4, 4));
    if i % 8 == 0 { ball.behave(\"spin\", #{ speed: 10 + i }); }
}
for i in 0..12 {
    point_light(\"lamp \" + i).range(4).intensity(3).at(chance.range(-4, 4), 2, chance.range(-4, 4));
}
entity(\"lamp 0\").behave(\"flicker\");
camera(\"eye\").at(0, 4, 9).look_at(0, 1, 0);
const PATH = path;
state.lots = chance;
state.keys = 0;
fn on_key(key) { state.keys += 1; entity(\"floor\").turn(0, 7 * state.keys, 0); }
fn update(time, dt) {
    let balls = entities().tagged(\"ball\");
    let places = balls.get(\"transform.translation\");
    balls.set(\"transform.translation\", places + state.lots.directions(places.count) * (0.5 * dt));
    entity(\"lamp 1\").at(PATH.at(modulo(time, 5)));
    entity(\"lamp 2\").intensity(2 + fractal_noise(time, 0, 0, 3));
    if state.lots.chance(0.02) { entity(\"ball \" + state.lots.int(0, 39)).visible(state.lots.chance(0.5)); }
}";

fn files() -> (tempfile::TempDir, Files) {
    let folder = tempfile::tempdir().unwrap();
    let scenes = folder.path().join("scripts/scenes");
    std::fs::create_dir_all(&scenes).unwrap();
    std::fs::write(scenes.join("everything.rhai"), EVERYTHING).unwrap();
    let files = Files::with_project(folder.path()).unwrap();
    (folder, files)
}

/// One step, with a key now and then.
fn step(scene: &mut Scene, frame: u32) {
    if frame.is_multiple_of(50) {
        scene.happen(SceneEvent::KeyDown("a".to_owned()));
        scene.happen(SceneEvent::KeyUp("a".to_owned()));
    }
    let time = f64::from(frame) * STEP;
    scene
        .update(time, STEP)
        .unwrap_or_else(|problem| panic!("{problem}"));
}

/// The world after every frame, and the picture after the last.
fn run(files: &Files, name: &str, settings: &Settings) -> (Vec<String>, Vec<u32>) {
    let mut studio = Studio::new("layers", &Settings::new());
    studio.files = files.clone();
    studio.load(name, settings);
    let mut worlds = Vec::new();
    for frame in 1..=FRAMES {
        step(&mut studio.scene, frame);
        worlds.push(studio.scene.to_text().unwrap());
    }
    let picture = studio.hdr("forward_single_pass", &Settings::new(), (96, 54));
    let bits = picture.texels.iter().flatten().map(|value| value.to_bits());
    (worlds, bits.collect())
}

#[test]
fn two_runs_are_the_same_bit_for_bit() {
    let (_folder, files) = files();
    for (name, texts) in [
        ("everything", &[][..]),
        ("swarm", &["motes=200"]),
        ("many_lights", &["lights=16", "spheres=25"]),
    ] {
        let settings = settings(texts);
        let (first, picture) = run(&files, name, &settings);
        let (second, again) = run(&files, name, &settings);
        for (frame, (a, b)) in first.iter().zip(&second).enumerate() {
            assert!(
                a == b,
                "{name}: the worlds differ after frame {}",
                frame + 1
            );
        }
        assert!(picture == again, "{name}: the pictures differ");
        // It would be easy if nothing moved.
        assert!(
            first[0] != first[FRAMES as usize - 1],
            "{name} stands still"
        );
        let distinct: std::collections::BTreeSet<_> = picture.iter().collect();
        assert!(distinct.len() > 100, "{name} shows nothing");
    }
}
