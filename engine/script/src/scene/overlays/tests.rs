#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_world::glam::{DVec3, Vec3};
use lightbench_world::{Light, LightKind, Transform, Value, ValueType};

use super::super::tables;
use super::*;
use crate::testing::project;
use crate::{Settings, load_scene};

fn scene(script: &str) -> Scene {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", script)]);
    load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap()
}

const LAMP: &str = "point_light(\"lamp\").intensity(12).range(6).at(1, 2, 3);";

fn intensity(scene: &Scene) -> f32 {
    let lamp = scene.world.find("lamp").unwrap();
    scene.world.get::<Light>(lamp).unwrap().intensity
}

fn set(overlays: &mut Overlays, scene: &mut Scene, field: &str, value: Value) {
    let lamp = scene.world.find("lamp").unwrap();
    overlays.set(scene, lamp, field, value).unwrap();
}

#[test]
fn a_change_lies_over_the_script_and_is_taken_off_again() {
    let script = format!("{LAMP} camera(\"eye\");");
    let (mut scene, mut overlays) = (scene(&script), Overlays::new());
    set(
        &mut overlays,
        &mut scene,
        "light.intensity",
        Value::Float(40.0),
    );
    set(
        &mut overlays,
        &mut scene,
        "light.intensity",
        Value::Float(50.0),
    );
    assert_eq!(intensity(&scene), 50.0);
    let overlay = overlays.get("lamp", "light.intensity").unwrap();
    assert_eq!(
        overlay.script,
        Some(Value::Float(12.0)),
        "not that of the first change"
    );
    assert!(!overlay.contested && !overlay.is_waiting());
    assert!(overlays.reset(&mut scene, "lamp", "light.intensity"));
    assert_eq!(intensity(&scene), 12.0);
    assert!(!overlays.reset(&mut scene, "lamp", "light.intensity"));

    set(
        &mut overlays,
        &mut scene,
        "light.intensity",
        Value::Float(40.0),
    );
    set(&mut overlays, &mut scene, "light.range", Value::Float(9.0));
    let eye = scene.world.find("eye").unwrap();
    overlays
        .set(&mut scene, eye, "camera.near", Value::Float(0.25))
        .unwrap();
    overlays.reset_entity(&mut scene, "lamp");
    assert_eq!(overlays.iter().count(), 1);
    assert_eq!(intensity(&scene), 12.0);
    overlays.reset_all(&mut scene);
    assert!(overlays.is_empty());
    assert_ne!(
        scene.world.get_field(eye, "Camera", "near"),
        Some(Value::Float(0.25))
    );
}

#[test]
fn changes_are_laid_on_by_name_when_the_script_was_loaded_anew_or_wait() {
    let (mut first, mut overlays) = (scene(LAMP), Overlays::new());
    set(
        &mut overlays,
        &mut first,
        "light.intensity",
        Value::Float(40.0),
    );
    // Another slot, and another value of the script.
    let mut second = scene("spawn(\"new\"); point_light(\"lamp\").intensity(3);");
    overlays.lay_on(&mut second);
    assert_eq!(intensity(&second), 40.0);
    let overlay = overlays.get("lamp", "light.intensity").unwrap();
    assert_eq!(overlay.script, Some(Value::Float(3.0)));
    // The lamp is gone, or is no lamp any more.
    for script in ["spawn(\"other\");", "spawn(\"lamp\");"] {
        let mut without = scene(script);
        overlays.lay_on(&mut without);
        assert_eq!(overlays.waiting().count(), 1, "{script}");
        overlays.follow(&mut without);
    }
    let mut third = scene(LAMP);
    overlays.lay_on(&mut third);
    assert_eq!(overlays.waiting().count(), 0);
    assert_eq!(intensity(&third), 40.0);
}

#[test]
fn an_entity_that_comes_while_the_scene_runs_gets_what_waited_for_it() {
    let mut scene = scene(
        "state.n = 0;
         fn update() {
             state.n += 1;
             if state.n == 2 { point_light(\"lamp\").intensity(5); }
             if state.n == 4 { entity(\"lamp\").remove(); }
         }",
    );
    let mut overlays = Overlays::new();
    let mut lit = self::scene(LAMP);
    set(
        &mut overlays,
        &mut lit,
        "light.intensity",
        Value::Float(40.0),
    );
    overlays.lay_on(&mut scene);
    let mut seen = Vec::new();
    for _ in 0..4 {
        scene.update(0.0, 0.0).unwrap();
        overlays.follow(&mut scene);
        let lamp = scene.world.find("lamp");
        let lamp = lamp.map(|lamp| scene.world.get::<Light>(lamp).unwrap().intensity);
        seen.push((lamp, overlays.waiting().count()));
    }
    assert_eq!(
        seen,
        [(None, 1), (Some(40.0), 0), (Some(40.0), 0), (None, 1)]
    );
}

#[test]
fn a_change_wins_over_a_script_that_writes_the_field_in_each_step() {
    let mut scene = scene(&format!(
        "{LAMP} fn update(time) {{ entity(\"lamp\").intensity(time); }}"
    ));
    let mut overlays = Overlays::new();
    set(
        &mut overlays,
        &mut scene,
        "light.intensity",
        Value::Float(40.0),
    );
    set(&mut overlays, &mut scene, "light.range", Value::Float(9.0));
    for time in [1.0, 2.0] {
        scene.update(time, 1.0).unwrap();
        overlays.follow(&mut scene);
        assert_eq!(intensity(&scene), 40.0);
    }
    let overlay = overlays.get("lamp", "light.intensity").unwrap();
    assert!(overlay.contested);
    assert_eq!(overlay.script, Some(Value::Float(2.0)));
    assert!(!overlays.get("lamp", "light.range").unwrap().contested);
    overlays.reset(&mut scene, "lamp", "light.intensity");
    assert_eq!(intensity(&scene), 2.0, "the script's last value");
}

/// What is computed from a field follows it, and a component that moves it does not win.
#[test]
fn a_place_that_was_changed_is_where_the_entity_is_drawn() {
    let mut scene = scene("spawn(\"sledge\").mesh(sphere(1)).velocity(1, 0, 0);");
    let mut overlays = Overlays::new();
    let sledge = scene.world.find("sledge").unwrap();
    let place = Value::Vec3(Vec3::new(0.0, 5.0, 0.0));
    overlays
        .set(&mut scene, sledge, "transform.translation", place)
        .unwrap();
    scene.update(1.0, 1.0).unwrap();
    overlays.follow(&mut scene);
    let overlay = overlays.get("sledge", "transform.translation").unwrap();
    assert!(overlay.contested);
    assert_eq!(overlay.script, Some(Value::Vec3(Vec3::new(1.0, 5.0, 0.0))));
    let bounds: lightbench_world::WorldBounds = scene.world.get(sledge).unwrap();
    assert_eq!(bounds.center(), Vec3::new(0.0, 5.0, 0.0));
}

#[test]
fn what_can_not_be_kept_by_name_or_is_refused_says_why() {
    let mut scene = scene("spawn(); spawn(\"twin\"); spawn(\"twin\"); point_light(\"lamp\");");
    let mut overlays = Overlays::new();
    let all: Vec<Entity> = scene.world.entities().collect();
    let size = Value::Vec3(Vec3::ONE);
    let lamp = scene.world.find("lamp").unwrap();
    for (entity, field, value, expected) in [
        (
            all[0],
            "transform.scale",
            size.clone(),
            "this entity has none",
        ),
        (
            all[2],
            "transform.scale",
            size.clone(),
            "is called `twin` too",
        ),
        (
            all[1],
            "light.range",
            Value::Float(1.0),
            "`twin` has no `light`",
        ),
        (lamp, "light.range", Value::Float(-1.0), "outside 0 to inf"),
        (
            lamp,
            "light.range",
            Value::Float(f32::INFINITY),
            "must be finite",
        ),
        (
            lamp,
            "light.kind",
            Value::Text("laser".into()),
            "is none of",
        ),
        (lamp, "light.reach", Value::Float(1.0), "no field `reach`"),
        (
            lamp,
            "name.text",
            Value::Text("x".into()),
            "changed in the field above",
        ),
        (lamp, "world_matrix.matrix", size, "The engine computes it."),
    ] {
        let error = overlays.set(&mut scene, entity, field, value).unwrap_err();
        assert!(error.contains(expected), "{field}: {error}");
    }
    let camera = scene.world.find("camera").unwrap();
    let near = Value::Float(1.0);
    let error = overlays
        .set(&mut scene, camera, "camera.near", near)
        .unwrap_err();
    assert!(error.contains("makes no camera"), "{error}");
    assert!(overlays.is_empty());
}

/// The line that is copied, at the end of the script, makes the same value as the change by hand:
/// for every field that can be changed.
#[test]
fn the_line_of_a_change_does_the_same_in_the_script() {
    let mut script = String::from("let e = spawn(\"a \\\"lamp\\\"\");\n");
    for component in tables::components() {
        if component.kind.info().role != Role::Computed {
            script += &format!("e.add(\"{}\");\n", component.name);
        }
    }
    script += "e.name = \"a \\\"lamp\\\"\";\n";
    let mut tried = 0;
    for component in tables::components() {
        for info in component.kind.info().fields {
            if editable(component.kind, info).is_err() {
                continue;
            }
            let path = field_path(component.kind, info).unwrap();
            let number = if info.range.1 < 10.0 { 1.234_567 } else { 20.1 };
            let value = match info.value_type {
                ValueType::Bool => Value::Bool((info.default)() == Value::Bool(false)),
                ValueType::Float => Value::Float(number),
                ValueType::Vec3 => Value::Vec3(Vec3::new(number, 1.0e-7, 1.0 / 3.0)),
                ValueType::Quat => Value::Quat(rotation_of(DVec3::new(10.0, -120.5, 33.3))),
                ValueType::Choice(names) => Value::Text(names[1].to_owned()),
                other => panic!("a value for {other:?}"),
            };
            let mut by_hand = scene(&script);
            let entity = by_hand.world.find("a \"lamp\"").unwrap();
            let mut overlays = Overlays::new();
            overlays
                .set(&mut by_hand, entity, path, value.clone())
                .unwrap();
            let line = line("a \"lamp\"", path, &value).unwrap();
            let in_script = scene(&format!("{script}{line}"));
            let field = tables::field(path).unwrap();
            let value_of = |scene: &Scene| {
                let entity = scene.world.find("a \"lamp\"").unwrap();
                scene
                    .world
                    .field_at(entity, field.kind, field.index)
                    .unwrap()
            };
            match (value_of(&by_hand), value_of(&in_script)) {
                // Degrees become a unit quaternion by way of sines.
                (Value::Quat(a), Value::Quat(b)) => assert!(a.dot(b).abs() > 1.0 - 1e-6, "{line}"),
                (a, b) => assert_eq!(a, b, "{line}"),
            }
            tried += 1;
        }
    }
    assert!(tried > 15, "{tried}");
    let nice = line("lamp", "light.intensity", &Value::Float(40.0));
    assert_eq!(nice.unwrap(), "entity(\"lamp\").intensity(40.0);");
    let kind = line("lamp", "light.kind", &Value::Text("spot".into()));
    assert_eq!(
        kind.unwrap(),
        "entity(\"lamp\").set(\"light.kind\", \"spot\");"
    );
    assert_eq!(LightKind::ALL[1].name(), "spot");
}

#[test]
fn numbers_are_spelled_so_that_the_same_bits_are_read() {
    let mut bits: u32 = 1;
    for _ in 0..20_000 {
        // Linear congruences walk through many exponents and digits.
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let number = f32::from_bits(bits);
        if !number.is_finite() {
            continue;
        }
        let read: f64 = lines::spell_single(number).parse().unwrap();
        assert_eq!((read as f32).to_bits(), number.to_bits());
    }
    assert_eq!(lines::spell_single(0.1), "0.1");
}

/// What is turned to a point stays turned to it, as when a script moves it.
#[test]
fn moving_a_spot_by_hand_keeps_it_aimed_as_its_line_does() {
    let script = "spot_light(\"lamp\").at(0, 5, 0).look_at(1, 0, 0);";
    let (mut by_hand, mut overlays) = (scene(script), Overlays::new());
    let rotation = |scene: &Scene| {
        let lamp = scene.world.find("lamp").unwrap();
        scene.world.get::<Transform>(lamp).unwrap().rotation
    };
    let before = rotation(&by_hand);
    let place = Value::Vec3(Vec3::new(4.0, 1.0, 2.0));
    set(
        &mut overlays,
        &mut by_hand,
        "transform.translation",
        place.clone(),
    );
    assert_ne!(rotation(&by_hand), before);
    let line = line("lamp", "transform.translation", &place).unwrap();
    let in_script = scene(&format!("{script}{line}"));
    assert_eq!(rotation(&by_hand), rotation(&in_script));
    overlays.reset(&mut by_hand, "lamp", "transform.translation");
    assert_eq!(rotation(&by_hand), before);
}

/// As when a reset is taken back, after the light was taken away and before that is taken back too.
#[test]
fn what_is_laid_again_waits_where_its_component_is_gone() {
    let script = format!("{LAMP} camera(\"eye\");");
    let (mut scene, mut overlays) = (scene(&script), Overlays::new());
    let lamp = scene.world.find("lamp").unwrap();
    let light: Light = scene.world.remove(lamp).unwrap();
    let again = |overlays: &mut Overlays, scene: &mut Scene, who: &str| {
        overlays.lay_again(scene, who, "light.intensity", Value::Float(40.0))
    };
    again(&mut overlays, &mut scene, "lamp").unwrap();
    again(&mut overlays, &mut scene, "nobody").unwrap();
    assert_eq!(overlays.waiting().count(), 2);
    scene.world.insert(lamp, light).unwrap();
    overlays.follow(&mut scene);
    assert_eq!(intensity(&scene), 40.0);
    assert_eq!(overlays.waiting().count(), 1);
    assert!(overlays.reset(&mut scene, "lamp", "light.intensity"));
    assert_eq!(intensity(&scene), 12.0);
    // One that is there takes it at once, and refuses what it does not take.
    again(&mut overlays, &mut scene, "lamp").unwrap();
    assert_eq!(intensity(&scene), 40.0);
    let wrong = Value::Float(f32::NAN);
    overlays
        .lay_again(&mut scene, "lamp", "light.intensity", wrong)
        .unwrap_err();
}
