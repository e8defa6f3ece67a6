#![allow(clippy::unwrap_used)]

use lightbench_world::glam::Vec3;
use lightbench_world::{Light, LightKind, MeshRenderer, Name, Transform};

use super::*;
use crate::testing::project;

fn load(text: &str) -> Result<Scene, Problems> {
    load_with(text, &Settings::new())
}

fn load_with(text: &str, settings: &Settings) -> Result<Scene, Problems> {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
    load_scene(&files, "test", settings, &Progress::new())
}

fn good(text: &str) -> Scene {
    match load(text) {
        Ok(scene) => scene,
        Err(problems) => panic!("{problems}"),
    }
}

fn named<C: lightbench_world::Stored>(scene: &Scene, name: &str) -> C {
    let entity = scene.world.find(name).unwrap();
    scene.world.get(entity).unwrap()
}

#[test]
fn builds_a_world() {
    let scene = good(
        r#"
        let stone = material("stone").color(0.8, 0.75, 0.7).specular(0.04).power(32);
        let shaft = mesh(column(0.25, 3));
        for i in 0..3 {
            spawn("column " + i).mesh(shaft).material(stone).at(i * 2, 0, -1.5).turn(0, 90, 0).scale(2);
        }
        point_light("lamp").color(1, 0.7, 0.4).intensity(12).range(6).at(0, 2.5, 0);
        spot_light("spot").inner(20).outer(35).aim(0, 0, 0).at(0, 5, 0);
        ambient_light("sky").color(srgb(1, 1, 1)).intensity(0.1);
        camera("main").at(0, 1.6, 5).look_at(0, 1.6, 0).fov(55).near(0.1).far(100);
        "#,
    );
    assert_eq!(scene.world.len(), 7);
    let transform: Transform = named(&scene, "column 2");
    assert_eq!(transform.translation, Vec3::new(4.0, 0.0, -1.5));
    assert_eq!(transform.scale, Vec3::splat(2.0));
    // A quarter turn about y takes the x axis to −z.
    assert!((transform.rotation * Vec3::X).distance(Vec3::NEG_Z) < 1e-6);
    let first: MeshRenderer = named(&scene, "column 0");
    let last: MeshRenderer = named(&scene, "column 2");
    assert_eq!(first, last);
    assert_eq!(
        scene.assets.material(first.material).unwrap().specular,
        0.04
    );
    let lamp: Light = named(&scene, "lamp");
    assert_eq!(
        (lamp.kind, lamp.intensity, lamp.range),
        (LightKind::Point, 12.0, 6.0)
    );
    let spot: Light = named(&scene, "spot");
    assert!((spot.outer_angle - 35_f32.to_radians()).abs() < 1e-6);
    // The light was aimed before it was placed.
    let spot: Transform = named(&scene, "spot");
    assert!((spot.rotation * Vec3::NEG_Z).distance(Vec3::NEG_Y) < 1e-6);
    let camera = scene.camera().unwrap();
    assert_eq!(scene.world.get::<Name>(camera).unwrap().text, "main");
}

#[test]
fn updates_move_things_and_remember() {
    let mut scene = good(
        r#"
        const RADIUS = 2.0;
        let lamp = point_light("lamp");
        state.turns = 0;
        fn place(angle) { vec3(RADIUS * cos(angle), 1, RADIUS * sin(angle)) }
        fn update(time, dt) {
            entity("lamp").at(place(time));
            state.turns += 1;
            entity("lamp").intensity = state.turns;
        }
        "#,
    );
    assert!(scene.has_update());
    for frame in 0..3 {
        scene.update(f64::from(frame), 0.5).unwrap();
    }
    let transform: Transform = named(&scene, "lamp");
    let expected = Vec3::new(2.0 * 2_f32.cos(), 1.0, 2.0 * 2_f32.sin());
    assert!(transform.translation.distance(expected) < 1e-6);
    let light: Light = named(&scene, "lamp");
    assert_eq!(light.intensity, 3.0);
}

#[test]
fn an_error_in_an_update_is_told_once() {
    let mut scene = good(
        "point_light(\"lamp\");\nfn update(time, dt) {\n    entity(\"lamp\").move(0, 1, 0);\n    entity(\"lmp\");\n}",
    );
    let problem = scene.update(0.0, 0.1).unwrap_err();
    assert_eq!(problem.place.to_string(), "scripts/scenes/test.rhai:4:5");
    assert_eq!(problem.message, "there is no entity `lmp`");
    assert_eq!(problem.hint.as_deref(), Some("did you mean `lamp`?"));
    assert!(!scene.has_update());
    scene.update(0.1, 0.1).unwrap();
    let transform: Transform = named(&scene, "lamp");
    assert_eq!(
        transform.translation.y, 4.0,
        "what was done before the error stays"
    );
}
