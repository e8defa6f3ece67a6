#![allow(clippy::unwrap_used)]

use lightbench_world::glam::Vec3;
use lightbench_world::{Light, LightKind, MeshRenderer, Name, Transform};

use super::*;
use crate::settings::Settings;
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
        Vec3::splat(0.04)
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
            let lamp = entity("lamp");
            lamp.intensity = state.turns;
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

#[test]
fn shipped_scenes_load_move_and_repeat() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = Files::with_project(folder).unwrap();
    for (name, settings, entities) in [
        ("cornell_box", Settings::new(), 7 + 1 + 9 + 1 + 1),
        (
            "many_lights",
            Settings::new().with("lights", "20").with("spheres", 30.0),
            1 + 30 + 20 + 1 + 1,
        ),
        ("showroom", Settings::new(), 1 + 1 + 1 + 1 + 12 + 1 + 1),
        (
            "swarm",
            Settings::new().with("motes", "50").with("lamps", "4"),
            1 + 1 + 50 + 4 + 1 + 1,
        ),
    ] {
        let run = || {
            let mut scene = match load_scene(&files, name, &settings, &Progress::new()) {
                Ok(scene) => scene,
                Err(problems) => panic!("{name}: {problems}"),
            };
            for frame in 0..10 {
                scene.update(f64::from(frame) / 60.0, 1.0 / 60.0).unwrap();
            }
            scene
        };
        let (first, second) = (run(), run());
        assert_eq!(first.world.len(), entities, "{name}");
        assert!(first.camera().is_some());
        let rows = |scene: &Scene| -> Vec<(Transform, Option<Light>)> {
            let entities = scene.world.entities();
            entities
                .map(|e| (scene.world.get(e).unwrap(), scene.world.get(e)))
                .collect()
        };
        assert_eq!(
            rows(&first),
            rows(&second),
            "{name} differs from run to run"
        );
    }
}

#[test]
fn the_box_has_its_published_measures() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = Files::with_project(folder).unwrap();
    let scene = load_scene(&files, "cornell_box", &Settings::new(), &Progress::new()).unwrap();
    let area = |name: &str| {
        let renderer: MeshRenderer = named(&scene, name);
        scene.assets.mesh(renderer.mesh).unwrap().area()
    };
    // Trapezia and rectangles of Cornell's list, in units of 10 mm.
    let floor = (5.528 + 5.496) / 2.0 * 5.592;
    assert!((area("floor") - floor).abs() < 1e-3, "{}", area("floor"));
    assert!((area("ceiling") - 5.56 * 5.592).abs() < 1e-3);
    // Every face looks into the room.
    let middle = Vec3::new(2.78, 2.74, 2.8);
    for name in [
        "floor",
        "ceiling",
        "back wall",
        "right wall",
        "left wall",
        "lamp",
    ] {
        let renderer: MeshRenderer = named(&scene, name);
        let mesh = scene.assets.mesh(renderer.mesh).unwrap();
        assert!(
            mesh.normals[0].dot(middle - mesh.positions[0]) > 0.0,
            "{name}"
        );
    }
    for name in ["short block", "tall block"] {
        let renderer: MeshRenderer = named(&scene, name);
        let mesh = scene.assets.mesh(renderer.mesh).unwrap();
        let center = mesh.bounds().center;
        for (normal, position) in mesh.normals.iter().zip(&mesh.positions) {
            assert!(normal.dot(*position - center) > 0.0, "{name}");
        }
    }
    let camera: Camera = named(&scene, "main");
    assert!((camera.fov_y.to_degrees() - 39.3077).abs() < 1e-3);
}

#[test]
fn parameters_are_set_and_refused() {
    let text = "let n = param(\"lights\", 4, 0, 10, \"How many\");\nlet on = param(\"on\", true);\n\
                let kind = param(\"kind\", [\"a\", \"b\"]);\nlet x = param(\"x\", 0.5, 0, 1);\n\
                let path = param(\"path\", \"\");\nfor i in 0..n { spawn(); }\n\
                if !on && kind == \"b\" && x == 1 && path == \"é.obj\" { spawn(\"all\"); }";
    let settings = Settings::new()
        .with("lights", "3")
        .with("on", "off")
        .with("kind", "b")
        .with("x", 1.0)
        .with("path", "é.obj");
    let scene = load_with(text, &settings).unwrap();
    assert!(scene.world.find("all").is_some());
    assert_eq!(scene.world.len(), 3 + 1 + 1);
    assert_eq!(scene.parameters.len(), 5);
    assert_eq!(scene.parameters[0].description, "How many");
    for (name, value, message) in [
        (
            "lights",
            "2.5",
            "`lights` takes a whole number from 0 to 10, not `2.5`",
        ),
        (
            "lights",
            "11",
            "`lights` takes a whole number from 0 to 10, not `11`",
        ),
        (
            "lights",
            "NaN",
            "`lights` takes a whole number from 0 to 10, not `NaN`",
        ),
        ("on", "maybe", "`on` takes `on` or `off`, not `maybe`"),
        ("kind", "c", "`kind` takes `a` or `b`, not `c`"),
        ("light", "3", "the scene has no parameter `light`"),
    ] {
        let error = load_with(text, &Settings::new().with(name, value)).unwrap_err();
        assert_eq!(error.0[0].message, message);
    }
}

#[test]
fn families_names_and_removal() {
    let mut scene = good(
        r#"
        let parent = spawn("parent").at(1, 0, 0).turn(0, 90, 0);
        let child = spawn("child").parent(parent).at(0, 0, -2);
        state.far = child.world_position;
        state.count = parent.children.len();
        let p = child.position;
        child.position.y = 5;
        child.position.y += p.z;
        child.size = 2;
        let gone = spawn("gone");
        gone.remove();
        print(gone.exists);
        print(child.parent == parent);
        print(`${child.name} at ${child.position}`);
        print(vec3(1, 2.5, 3));
        "#,
    );
    let child: Transform = named(&scene, "child");
    assert_eq!(child.translation, Vec3::new(0.0, 3.0, -2.0));
    assert_eq!(child.scale, Vec3::splat(2.0));
    assert!(scene.world.find("gone").is_none());
    let log: Vec<String> = scene.take_log().into_iter().map(|line| line.text).collect();
    assert_eq!(log, ["false", "true", "child at (0, 3, -2)", "(1, 2.5, 3)"]);
}

#[test]
fn a_scene_without_a_camera_gets_one_that_sees_everything() {
    let scene = good("spawn().mesh(sphere(100)).at(1000, 0, 0);");
    let camera = scene.camera().unwrap();
    let transform: Transform = scene.world.get(camera).unwrap();
    let lens: Camera = scene.world.get(camera).unwrap();
    let to_center = Vec3::new(1000.0, 0.0, 0.0) - transform.translation;
    let angle = (transform.rotation * Vec3::NEG_Z).angle_between(to_center);
    assert!(angle < 1e-3);
    let distance = to_center.length();
    assert!((100.0 / distance).asin() < lens.fov_y / 2.0);
    assert!(lens.near < distance - 100.0 && distance + 100.0 < lens.far);
}

#[test]
fn models_become_families() {
    let (_folder, files) = project(&[
        (
            "scripts/scenes/test.rhai",
            "let m = load_obj(\"models/two.obj\");\nprint(m.high.x);",
        ),
        (
            "models/two.obj",
            "mtllib two.mtl\nv 0 0 0\nv 2 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n",
        ),
        (
            "models/two.mtl",
            "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\nmap_Kd none.png\n",
        ),
    ]);
    let mut scene = load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap();
    let model = scene.world.find("two").unwrap();
    assert_eq!(scene.world.children(model).count(), 2);
    assert!(scene.files().contains(&"models/two.obj".to_owned()));
    let log = scene.take_log();
    assert!(
        log.iter().any(|line| line.text.contains("none.png")),
        "{log:?}"
    );
    assert!(log.iter().any(|line| line.text == "2.0"), "{log:?}");
    assert_eq!(log[0].place.line, 1);
}

#[test]
fn what_happens_to_the_progress_of_a_load_later_does_not_stop_the_scene() {
    let text = r#"
        spawn("box").at(0, 0, 0);
        fn update(time, dt) {
            // Enough operations for the watch to look.
            for i in 0..1000 { let x = i * 2; }
            entity("box").at(time, 0, 0);
        }
        "#;
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
    let progress = Progress::new();
    let mut scene = load_scene(&files, "test", &Settings::new(), &progress).unwrap();
    // As a task does that is dropped with its result taken.
    progress.cancel();
    scene.update(2.0, 0.1).unwrap();
    let place: Transform = named(&scene, "box");
    assert_eq!(place.translation, Vec3::new(2.0, 0.0, 0.0));
}

#[test]
fn components_move_what_no_script_touches() {
    let mut scene = good(
        r#"
        spawn("cart").at(1, 0, 0).velocity(2, 0, 0);
        spawn("wheel").parent(entity("cart")).spin(0, 90, 0);
        spawn("lift").animate_position([[0, vec3(0, 0, 0)], [2, vec3(0, 4, 0)]]).animation_repeat("once");
        spawn("door").animate_rotation([[0, vec3(0, 0, 0)], [1, vec3(0, 90, 0)]], "step");
        spawn("heart").animate_scale([[0, 1], [1, 2], [2, 1]], "smooth").animation_speed(2).animation_start(1);
        "#,
    );
    assert!(scene.moves() && !scene.has_update());
    // Posed as soon as it is loaded.
    assert_eq!(named::<Transform>(&scene, "heart").scale, Vec3::splat(2.0));
    for frame in 1..=60 {
        scene.update(f64::from(frame) / 60.0, 1.0 / 60.0).unwrap();
    }
    let cart: Transform = named(&scene, "cart");
    assert!(cart.translation.distance(Vec3::new(3.0, 0.0, 0.0)) < 1e-4);
    let wheel: Transform = named(&scene, "wheel");
    assert!((wheel.rotation * Vec3::X).distance(Vec3::NEG_Z) < 1e-4);
    let lift: Transform = named(&scene, "lift");
    assert!(lift.translation.distance(Vec3::new(0.0, 2.0, 0.0)) < 1e-5);
    let door: Transform = named(&scene, "door");
    assert!((door.rotation * Vec3::X).distance(Vec3::X) < 1e-5);
    let heart: Transform = named(&scene, "heart");
    assert!(heart.scale.distance(Vec3::splat(2.0)) < 1e-4);
    // The systems have brought matrices along.
    let matrix: lightbench_world::WorldMatrix = named(&scene, "wheel");
    assert!((matrix.matrix.translation.x - 3.0).abs() < 1e-4);
    let names: Vec<_> = scene.system_times().map(|time| time.name).collect();
    assert_eq!(names, ["velocity", "animation", "world matrices", "bounds"]);
}

#[test]
fn the_same_steps_give_the_same_scene() {
    let text = r#"
        for i in 0..50 {
            spawn("mote " + i).velocity(0.1 * i, 1, 0).spin(i, 2 * i, 0)
                .animate_scale([[0, 1], [0.3 + i, 2]], "smooth");
        }
        fn update(time, dt) { entity("mote 3").at(time, 0, 0); }
    "#;
    let run = || {
        let mut scene = good(text);
        for frame in 1..=30 {
            scene.update(f64::from(frame) / 60.0, 1.0 / 60.0).unwrap();
        }
        let places = scene.world.columns::<Transform>();
        (0..places.len())
            .map(|row| places.row(row))
            .collect::<Vec<_>>()
    };
    assert_eq!(run(), run());
}

#[test]
fn bad_animations_are_told() {
    for (call, expected) in [
        (
            "animate_position([1, 2])",
            "key 1 of the animation is no pair",
        ),
        ("animate_position([[0, 1]])", "key 1: the value is no point"),
        (
            "animate_position([[1, vec3(0, 0, 0)], [1, vec3(0, 0, 0)]])",
            "must ascend",
        ),
        (
            "animate_scale([[0, 1]], \"cubic\")",
            "`mode` of `animate_scale` must be",
        ),
        ("animation_repeat(\"twice\")", "loop"),
    ] {
        let problems = load(&format!("spawn(\"a\").{call};")).unwrap_err();
        assert!(problems.to_string().contains(expected), "{problems}");
    }
}
