//! Handles that move, turn and scale what is chosen, and taking changes by hand back.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_kittest::kittest::Queryable as _;
use lightbench::world::glam::{Quat, Vec3};
use lightbench::world::{Light, Transform, WorldMatrix};
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::lens::Lens;

use ui_support::{Bench, PATIENCE};

/// A box, one that hangs on a turned and scaled one, and a lamp.
const THINGS: &str = r#"
spawn("alone").mesh(box(1)).at(-2, 0, 0);
spawn("above").mesh(box(1)).at(1, 0, 0).rotate(0, 90, 0).scale(2);
spawn("below").mesh(box(0.5)).parent(entity("above")).at(0, 1, 0);
spawn().mesh(box(0.5)).at(3, 0, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

fn open() -> Bench {
    let mut bench = Bench::open();
    bench.save("scripts/scenes/things.rhai", THINGS);
    bench.harness.state_mut().workbench.select_scene("things");
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some("things") && !editor.workbench.scenes.is_busy()
    });
    // The choice of the scene is a step too.
    bench.harness.state_mut().workbench.undo.clear();
    bench.harness.run_steps(2);
    bench
}

fn viewport(bench: &Bench) -> Rect {
    let node = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    node.rect()
}

fn lens(bench: &Bench) -> Lens {
    let view = bench.harness.state().workbench.camera.view();
    Lens::new(viewport(bench), view)
}

fn transform(bench: &Bench, name: &str) -> Transform {
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let entity = scene.world.find(name).unwrap();
    scene.world.get(entity).unwrap()
}

fn world_place(bench: &Bench, name: &str) -> Vec3 {
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let entity = scene.world.find(name).unwrap();
    let matrix: WorldMatrix = scene.world.get(entity).unwrap();
    matrix.matrix.translation.into()
}

fn hold(bench: &mut Bench, modifiers: Modifiers) {
    bench.harness.event(Event::ModifiersChanged(modifiers));
    bench.harness.step();
}

fn button(bench: &mut Bench, at: Pos2, pressed: bool) {
    bench.harness.event(Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    });
    bench.harness.step();
}

/// Takes hold of something and moves it, without letting go.
fn pull(bench: &mut Bench, from: Pos2, to: Pos2) {
    bench.harness.hover_at(from);
    bench.harness.step();
    button(bench, from, true);
    for part in 1..=6 {
        bench.harness.hover_at(from.lerp(to, part as f32 / 6.0));
        bench.harness.step();
    }
}

fn drag(bench: &mut Bench, from: Pos2, to: Pos2) {
    pull(bench, from, to);
    button(bench, to, false);
    bench.harness.run_steps(2);
}

fn key(bench: &mut Bench, key: Key, modifiers: Modifiers) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(2);
}

fn steps(bench: &Bench) -> Vec<String> {
    let undo = &bench.harness.state().workbench.undo;
    undo.done().iter().map(|step| step.what.clone()).collect()
}

/// A place on the handle of an axis, and one that is `metres` further along it.
fn on_handle(bench: &Bench, at: Vec3, axis: Vec3, metres: f32) -> (Pos2, Pos2) {
    let lens = lens(bench);
    let half = 40.0 * lens.metres_per_point(at);
    let from = at + axis * half;
    (
        lens.point(from).unwrap(),
        lens.point(from + axis * metres).unwrap(),
    )
}

fn until_picture_is(bench: &mut Bench, wanted: &[u8]) {
    let begun = std::time::Instant::now();
    while bench.picture() != wanted {
        assert!(begun.elapsed() < PATIENCE, "the picture is another one");
        bench.harness.step();
    }
}

#[test]
fn a_handle_moves_what_is_chosen_as_one_step_that_is_taken_back_and_done_again() {
    let mut bench = open();
    let first = bench.picture();
    bench.choose_entities(&["alone"]);
    let (from, to) = on_handle(&bench, Vec3::new(-2.0, 0.0, 0.0), Vec3::X, 1.0);
    drag(&mut bench, from, to);
    let at = transform(&bench, "alone").translation;
    assert!((at - Vec3::new(-1.0, 0.0, 0.0)).length() < 0.01, "{at}");
    assert!(!bench.harness.state().workbench.camera.is_moved());
    assert_eq!(steps(&bench), ["Move"]);
    let line = bench.last_deed().line;
    assert!(line.starts_with("entity(\"alone\").at("), "{line}");
    let moved = bench.until_picture_is_not(&first);

    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(
        transform(&bench, "alone").translation,
        Vec3::new(-2.0, 0.0, 0.0)
    );
    let overlays = bench.harness.state().workbench.overlays_now().unwrap();
    assert!(overlays.is_empty(), "it is the script's again");
    until_picture_is(&mut bench, &first);
    key(&mut bench, Key::Z, Modifiers::COMMAND | Modifiers::SHIFT);
    assert_eq!(transform(&bench, "alone").translation, at);
    until_picture_is(&mut bench, &moved);

    // With Ctrl it goes by steps.
    let (from, to) = on_handle(&bench, at, Vec3::Y, 0.6);
    hold(&mut bench, Modifiers::COMMAND);
    drag(&mut bench, from, to);
    hold(&mut bench, Modifiers::NONE);
    let up = transform(&bench, "alone").translation.y;
    assert!((up - 0.5).abs() < 1e-4, "{up}");
    assert_eq!(steps(&bench), ["Move", "Move"]);
}

#[test]
fn what_was_typed_is_the_amount_and_escape_gives_it_up() {
    let mut bench = open();
    bench.choose_entities(&["alone"]);
    let at = Vec3::new(-2.0, 0.0, 0.0);
    let (from, to) = on_handle(&bench, at, Vec3::X, 0.3);
    pull(&mut bench, from, to);
    for text in ["1", ".", "7", "5"] {
        bench.harness.event(Event::Text(text.to_owned()));
        bench.harness.step();
    }
    // A digit chooses no pipeline meanwhile.
    key(&mut bench, Key::Num1, Modifiers::NONE);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    button(&mut bench, to, false);
    let now = transform(&bench, "alone").translation;
    assert!((now - Vec3::new(-0.25, 0.0, 0.0)).length() < 1e-5, "{now}");
    assert_eq!(bench.shown(), "deferred_shading");
    assert_eq!(steps(&bench), ["Move"]);

    let (from, to) = on_handle(&bench, now, Vec3::Y, 1.0);
    pull(&mut bench, from, to);
    assert!(transform(&bench, "alone").translation.y > 0.5);
    key(&mut bench, Key::Escape, Modifiers::NONE);
    assert_eq!(transform(&bench, "alone").translation, now);
    button(&mut bench, to, false);
    assert_eq!(transform(&bench, "alone").translation, now);
    assert_eq!(steps(&bench), ["Move"]);
    assert_eq!(bench.harness.state().workbench.undo.undone().len(), 0);
}

#[test]
fn the_world_s_axes_hold_below_a_turned_parent_and_local_ones_turn_with_it() {
    let mut bench = open();
    bench.choose_entities(&["below"]);
    let before = world_place(&bench, "below");
    assert!(
        (before - Vec3::new(1.0, 2.0, 0.0)).length() < 1e-4,
        "{before}"
    );
    let (from, to) = on_handle(&bench, before, Vec3::X, -0.5);
    drag(&mut bench, from, to);
    let moved = world_place(&bench, "below") - before;
    assert!(
        (moved - Vec3::new(-0.5, 0.0, 0.0)).length() < 0.01,
        "{moved}"
    );
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    // The parent turns a quarter about y: its z is the world's x.
    key(&mut bench, Key::L, Modifiers::NONE);
    let before = world_place(&bench, "below");
    let (from, to) = on_handle(&bench, before, Vec3::X, 0.5);
    drag(&mut bench, from, to);
    let own = transform(&bench, "below").translation;
    assert!((own.z - 0.25).abs() < 0.01 && own.x.abs() < 1e-3, "{own}");
}

#[test]
fn several_turn_and_scale_together_and_what_hangs_on_one_goes_along_once() {
    let mut bench = open();
    // The last one has the handles.
    bench.choose_entities(&["below", "alone", "above"]);
    key(&mut bench, Key::R, Modifiers::NONE);
    let center = Vec3::new(1.0, 0.0, 0.0);
    let lens_now = lens(&bench);
    let length = 80.0 * lens_now.metres_per_point(center);
    // The circle about z faces the camera: off its axes it is alone.
    let on = |degrees: f32| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        lens_now
            .point(center + Vec3::new(cos, sin, 0.0) * length)
            .unwrap()
    };
    bench.harness.hover_at(on(30.0));
    bench.harness.step();
    button(&mut bench, on(30.0), true);
    for degrees in [50.0, 70.0, 90.0, 110.0, 120.0] {
        bench.harness.hover_at(on(degrees));
        bench.harness.step();
    }
    button(&mut bench, on(120.0), false);
    bench.harness.run_steps(2);
    let turn = Quat::from_rotation_z(90.0_f32.to_radians());
    let above = transform(&bench, "above");
    let wanted = turn * Quat::from_rotation_y(90.0_f32.to_radians());
    assert!(above.rotation.angle_between(wanted) < 0.01);
    assert_eq!(above.translation, center);
    // Three metres to the left of the middle: now below it.
    let alone = transform(&bench, "alone");
    assert!((alone.translation - Vec3::new(1.0, -3.0, 0.0)).length() < 0.03);
    assert!(alone.rotation.angle_between(turn) < 0.01);
    let below = world_place(&bench, "below");
    assert!(
        (below - Vec3::new(-1.0, 0.0, 0.0)).length() < 0.03,
        "{below}"
    );
    assert_eq!(steps(&bench), ["Rotate 2 entities"]);

    key(&mut bench, Key::X, Modifiers::NONE);
    let middle = lens(&bench).point(center).unwrap();
    drag(&mut bench, middle, middle + egui::vec2(40.0, 0.0));
    let scale = transform(&bench, "above").scale;
    assert!((scale - Vec3::splat(3.0)).length() < 1e-3, "{scale}");
    assert!((transform(&bench, "alone").scale - Vec3::splat(1.5)).length() < 1e-3);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(transform(&bench, "alone").scale, Vec3::ONE);
    assert_eq!(
        transform(&bench, "alone").translation,
        Vec3::new(-2.0, 0.0, 0.0)
    );
    assert!(steps(&bench).is_empty());
}

#[test]
fn the_history_goes_to_any_step_over_fields_parameters_and_resets() {
    let mut bench = open();
    let world = |bench: &Bench| {
        let scene = bench.harness.state().workbench.scenes.scene().unwrap();
        let lamp = scene.world.find("lamp").unwrap();
        scene.world.get::<Light>(lamp).unwrap().intensity
    };
    let exposure = |bench: &Bench| {
        let pipelines = &bench.harness.state().workbench.pipelines;
        let slot = pipelines.slot("deferred_shading").unwrap();
        slot.settings.get("exposure").map(ToString::to_string)
    };
    let set = |bench: &mut Bench, number: f32| {
        let workbench = &mut bench.harness.state_mut().workbench;
        let lamp = workbench
            .scenes
            .scene()
            .unwrap()
            .world
            .find("lamp")
            .unwrap();
        let value = lightbench::world::Value::Float(number);
        workbench.set_field(lamp, "light.intensity", value).unwrap();
        bench.harness.step();
    };
    set(&mut bench, 70.0);
    set(&mut bench, 80.0);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_pipeline_parameter("exposure", Some(1.5.into()));
    bench.harness.step();
    bench.harness.state_mut().workbench.reset_all_fields();
    bench.harness.step();
    assert_eq!(
        steps(&bench),
        [
            "light.intensity of lamp",
            "light.intensity of lamp",
            "the parameter exposure",
            "all back to the script"
        ]
    );
    assert_eq!(
        (world(&bench), exposure(&bench).as_deref()),
        (60.0, Some("1.5"))
    );

    // High enough for all rows.
    bench.harness.set_size(egui::vec2(1280.0, 1300.0));
    bench.show(Panel::History);
    let click = |bench: &mut Bench, label: &str| {
        let node = bench.harness.get_by_role_and_label(Role::Button, label);
        node.scroll_to_me();
        bench.harness.run_steps(3);
        let node = bench.harness.get_by_role_and_label(Role::Button, label);
        node.click();
        bench.harness.run_steps(3);
    };
    click(&mut bench, "the parameter exposure");
    assert_eq!(
        (world(&bench), exposure(&bench).as_deref()),
        (80.0, Some("1.5"))
    );
    click(&mut bench, "As it was at the start");
    assert_eq!((world(&bench), exposure(&bench)), (60.0, None));
    click(&mut bench, "Redo");
    assert_eq!(world(&bench), 70.0);
    click(&mut bench, "all back to the script");
    assert_eq!(
        (world(&bench), exposure(&bench).as_deref()),
        (60.0, Some("1.5"))
    );
    click(&mut bench, "Undo");
    assert_eq!(world(&bench), 80.0);
    // Something new takes the place of what was taken back.
    set(&mut bench, 90.0);
    assert_eq!(bench.harness.state().workbench.undo.undone().len(), 0);
    assert_eq!(steps(&bench).len(), 4);
}

#[test]
fn what_is_typed_into_a_field_is_one_step_and_escape_leaves_the_field_alone() {
    let mut bench = open();
    bench.choose_entities(&["lamp"]);
    bench.show(Panel::Entities);
    let field = |bench: &mut Bench| {
        bench
            .harness
            .get_by_role_and_label(Role::SpinButton, "Intensity")
            .scroll_to_me();
        bench.harness.run_steps(3);
        bench
            .harness
            .get_by_role_and_label(Role::SpinButton, "Intensity")
            .click();
        bench.harness.run_steps(2);
    };
    let intensity = |bench: &Bench| {
        let scene = bench.harness.state().workbench.scenes.scene().unwrap();
        let lamp = scene.world.find("lamp").unwrap();
        scene.world.get::<Light>(lamp).unwrap().intensity
    };
    field(&mut bench);
    key(&mut bench, Key::A, Modifiers::COMMAND);
    for text in ["4", "7"] {
        bench.harness.event(Event::Text(text.to_owned()));
        bench.harness.step();
    }
    key(&mut bench, Key::Enter, Modifiers::NONE);
    assert_eq!(intensity(&bench), 47.0);
    assert_eq!(steps(&bench), ["light.intensity of lamp"]);
    field(&mut bench);
    key(&mut bench, Key::Escape, Modifiers::NONE);
    assert_eq!(bench.harness.state().workbench.selection.len(), 1);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(intensity(&bench), 60.0);
    key(&mut bench, Key::Escape, Modifiers::NONE);
    assert_eq!(bench.harness.state().workbench.selection.len(), 0);
}

#[test]
fn parameters_of_scene_and_behaviours_are_taken_back_also_after_a_load() {
    let mut bench = open();
    bench.save(
        "scripts/scenes/set.rhai",
        "const HIGH = param(\"high\", 1.0, 0, 9, \"How high\");
         spawn(\"top\").mesh(box(1)).at(0, HIGH, 0).behave(\"spin\");",
    );
    bench.harness.state_mut().workbench.select_scene("set");
    let settled = |bench: &mut Bench, high: f32| {
        bench.until("the scene", |editor| {
            assert!(!Bench::has_problems(editor));
            let scenes = &editor.workbench.scenes;
            let place = scenes.scene().and_then(|scene| {
                let top = scene.world.find("top")?;
                Some(scene.world.get::<Transform>(top)?.translation.y)
            });
            !scenes.is_busy() && place == Some(high)
        });
    };
    settled(&mut bench, 1.0);
    bench.harness.state_mut().workbench.stop();
    bench.harness.state_mut().workbench.undo.clear();
    let behaviour = |bench: &Bench| {
        let scene = bench.harness.state().workbench.scenes.scene().unwrap();
        let behaviour = scene.behaviours().remove(0);
        let parameter = behaviour.parameters[0].clone();
        (behaviour.entity, parameter.name, parameter.value)
    };
    let (entity, name, before) = behaviour(&bench);
    let after = lightbench::script::SettingValue::from(12.5);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_behaviour_parameter(entity, &name, &after);
    bench.harness.run_steps(2);
    assert_eq!(behaviour(&bench).2, after);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_scene_parameter("high", Some(3.0.into()));
    settled(&mut bench, 3.0);
    let what = "the parameter high".to_owned();
    assert_eq!(steps(&bench), [name, what]);

    key(&mut bench, Key::Z, Modifiers::COMMAND);
    settled(&mut bench, 1.0);
    // The load made the entity anew: it is found by its name.
    let made = behaviour(&bench).2;
    key(&mut bench, Key::Z, Modifiers::COMMAND | Modifiers::SHIFT);
    settled(&mut bench, 3.0);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    settled(&mut bench, 1.0);
    assert_eq!(behaviour(&bench).2, made);
    let (entity, name, _) = behaviour(&bench);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_behaviour_parameter(entity, &name, &after);
    bench.harness.run_steps(2);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(behaviour(&bench).2, made);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(behaviour(&bench).2, before);
    assert!(steps(&bench).is_empty());
}
