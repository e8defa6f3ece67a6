//! Views of the viewport, what is drawn over it, and choosing entities in it and in the list.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_kittest::kittest::Queryable as _;
use lightbench::world::glam::Vec3;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::lens::Lens;
use lightbench_editor::ui::workbench::flat::Side;
use lightbench_editor::ui::workbench::sight::Sight;

use ui_support::{Bench, PATIENCE};

/// Three boxes in a row, a lamp above, and a second camera.
const ROW: &str = r#"
for i in 0..3 { spawn(`box ${i}`).mesh(box(1)).at(2 * i - 2, 0, 0); }
spawn("behind").mesh(box(1)).at(0, 0, -3);
point_light("lamp").intensity(60).range(2).at(0, 2.2, 0);
point_light("fill").intensity(90).range(40).at(3, 4, 12);
camera("eye").at(0, 1, 8).look_at(0, 0.5, 0);
camera("other").at(8, 3, 0).look_at(0, 0, 0).fov(40);
"#;

fn open() -> Bench {
    let mut bench = Bench::open();
    bench.save("scripts/scenes/row.rhai", ROW);
    bench.harness.state_mut().workbench.select_scene("row");
    bench.until("the scene", |editor| {
        editor.workbench.scenes.shown() == Some("row") && !editor.workbench.scenes.is_busy()
    });
    bench.harness.run_steps(2);
    bench
}

fn viewport(bench: &Bench) -> Rect {
    let node = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    node.rect()
}

/// Runs frames until the picture is the one before.
fn until_picture_is(bench: &mut Bench, wanted: &[u8]) {
    let begun = std::time::Instant::now();
    while bench.picture() != wanted {
        assert!(begun.elapsed() < PATIENCE, "the picture is another one");
        bench.harness.step();
    }
}

/// Where a point of the world is on the screen.
fn place(bench: &Bench, at: Vec3) -> Pos2 {
    let view = bench.harness.state().workbench.camera.view();
    Lens::new(viewport(bench), view).point(at).unwrap()
}

fn hold(bench: &mut Bench, modifiers: Modifiers) {
    bench.harness.event(Event::ModifiersChanged(modifiers));
    bench.harness.step();
}

fn button(bench: &mut Bench, at: Pos2, pressed: bool, modifiers: Modifiers) {
    bench.harness.event(Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers,
    });
    bench.harness.step();
}

fn click(bench: &mut Bench, at: Vec3, modifiers: Modifiers) {
    let at = place(bench, at);
    hold(bench, modifiers);
    bench.harness.hover_at(at);
    bench.harness.step();
    button(bench, at, true, modifiers);
    button(bench, at, false, modifiers);
    hold(bench, Modifiers::NONE);
}

fn drag(bench: &mut Bench, from: Pos2, to: Pos2, modifiers: Modifiers) {
    hold(bench, modifiers);
    bench.harness.hover_at(from);
    bench.harness.step();
    button(bench, from, true, modifiers);
    for part in 1..=4 {
        bench.harness.hover_at(from.lerp(to, part as f32 / 4.0));
        bench.harness.step();
    }
    button(bench, to, false, modifiers);
    bench.harness.step();
    hold(bench, Modifiers::NONE);
}

fn chosen(bench: &Bench) -> Vec<String> {
    let workbench = &bench.harness.state().workbench;
    let world = &workbench.scenes.scene().unwrap().world;
    let name = |entity| world.get::<lightbench::world::Name>(entity).unwrap().text;
    workbench.selection.entities().map(name).collect()
}

fn menu(bench: &mut Bench, title: &str, entry: &str) {
    bench
        .harness
        .get_by_role_and_label(Role::Button, title)
        .click();
    bench.harness.run_steps(3);
    bench
        .harness
        .get_by(|node| {
            node.role() == Role::Button
                && node.label().is_some_and(|label| label.starts_with(entry))
        })
        .click();
    bench.harness.run_steps(3);
}

/// The pixels of the window within the viewport.
fn screen(bench: &mut Bench) -> Vec<u8> {
    bench.picture();
    bench.harness.remove_cursor();
    bench.harness.run_steps(3);
    let rect = viewport(bench);
    let image = bench.harness.render().unwrap();
    let (x, y) = (rect.left() as u32, rect.top() as u32);
    let (width, height) = (rect.width() as u32, rect.height() as u32);
    image::imageops::crop_imm(&image, x, y, width, height)
        .to_image()
        .into_raw()
}

#[test]
fn clicks_choose_what_is_in_front_and_ctrl_more_of_it() {
    let mut bench = open();
    click(&mut bench, Vec3::new(0.0, 0.0, 0.5), Modifiers::NONE);
    assert_eq!(chosen(&bench), ["box 1"], "not the one behind it");
    click(&mut bench, Vec3::new(2.0, 0.0, 0.5), Modifiers::COMMAND);
    assert_eq!(chosen(&bench), ["box 1", "box 2"]);
    click(&mut bench, Vec3::new(0.0, 0.0, 0.5), Modifiers::COMMAND);
    assert_eq!(chosen(&bench), ["box 2"]);
    // A lamp has no mesh, but an icon.
    click(&mut bench, Vec3::new(0.0, 2.2, 0.0), Modifiers::NONE);
    assert_eq!(chosen(&bench), ["lamp"]);
    menu(&mut bench, "View", "Lights and cameras");
    click(&mut bench, Vec3::new(0.0, 2.2, 0.0), Modifiers::NONE);
    assert_eq!(chosen(&bench), [""; 0], "nothing is there without its icon");

    click(&mut bench, Vec3::new(-2.0, 0.0, 0.5), Modifiers::NONE);
    assert_eq!(chosen(&bench), ["box 0"]);
    bench.harness.key_press(Key::Escape);
    bench.harness.step();
    assert_eq!(chosen(&bench), [""; 0]);
    assert!(!bench.harness.state().workbench.camera.is_moved());
}

#[test]
fn a_box_chooses_what_is_in_it_and_does_not_move_the_camera() {
    let mut bench = open();
    let (from, to) = (
        place(&bench, Vec3::new(-3.0, 0.9, 0.0)),
        place(&bench, Vec3::new(0.3, -0.9, 0.0)),
    );
    drag(&mut bench, from, to, Modifiers::SHIFT);
    let mut names = chosen(&bench);
    names.sort();
    assert_eq!(names, ["behind", "box 0", "box 1"]);
    assert!(!bench.harness.state().workbench.camera.is_moved());
    let (from, to) = (
        place(&bench, Vec3::new(1.5, 0.9, 0.0)),
        place(&bench, Vec3::new(2.5, -0.9, 0.0)),
    );
    drag(&mut bench, from, to, Modifiers::SHIFT | Modifiers::COMMAND);
    assert_eq!(chosen(&bench).len(), 4, "Ctrl adds");
    drag(&mut bench, from, to, Modifiers::SHIFT);
    assert_eq!(chosen(&bench), ["box 2"]);
    // Without Shift it orbits.
    drag(&mut bench, from, to, Modifiers::NONE);
    assert_eq!(chosen(&bench), ["box 2"]);
    assert!(bench.harness.state().workbench.camera.is_moved());
}

#[test]
fn the_list_chooses_several_and_a_load_finds_them_again() {
    let mut bench = open();
    bench.show(Panel::Entities);
    let row = |bench: &mut Bench, name: &str, modifiers| {
        hold(bench, modifiers);
        let node = bench.harness.get_by_role_and_label(Role::Button, name);
        let at = node.rect().center();
        bench.harness.hover_at(at);
        bench.harness.step();
        button(bench, at, true, modifiers);
        button(bench, at, false, modifiers);
        hold(bench, Modifiers::NONE);
    };
    row(&mut bench, "box 0", Modifiers::NONE);
    row(&mut bench, "box 2", Modifiers::SHIFT);
    assert_eq!(chosen(&bench), ["box 0", "box 1", "box 2"]);
    assert_eq!(bench.count("3 entities are chosen"), 1);
    row(&mut bench, "box 1", Modifiers::COMMAND);
    assert_eq!(chosen(&bench), ["box 0", "box 2"]);
    // Who works with the list keeps it in front.
    click(&mut bench, Vec3::new(0.0, 0.0, 0.5), Modifiers::COMMAND);
    assert_eq!(chosen(&bench), ["box 0", "box 2", "box 1"]);
    assert_eq!(bench.count("3 entities are chosen"), 1);

    let swaps = bench.harness.state().workbench.scenes.swaps();
    bench.save(
        "scripts/scenes/row.rhai",
        &format!(
            "spawn(\"new\");{}",
            ROW.replace("`box ${i}`", "`box ${2 * i}`")
        ),
    );
    bench
        .harness
        .state_mut()
        .workbench
        .files_changed(&["scripts/scenes/row.rhai".to_owned()]);
    bench.until("the scene anew", |editor| {
        editor.workbench.scenes.swaps() > swaps && !editor.workbench.scenes.is_busy()
    });
    bench.harness.run_steps(2);
    assert_eq!(chosen(&bench), ["box 0", "box 2"]);
}

#[test]
fn orthographic_views_show_rows_as_they_are_and_go_back() {
    let mut bench = open();
    let first = bench.picture();
    let before = bench.harness.state().workbench.camera.view();
    for (key, side) in [
        (Key::Num1, Side::Top),
        (Key::Num2, Side::Front),
        (Key::Num3, Side::Right),
    ] {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, key);
        bench.harness.run_steps(2);
        assert_eq!(bench.harness.state().workbench.sight(), Sight::Side(side));
    }
    // From the side, boxes at different depths are exactly as large as each other.
    let across = |bench: &Bench, x: f32| {
        let at = |y: f32| place(bench, Vec3::new(x, y, 0.0));
        at(0.0).distance(at(1.0))
    };
    assert!((across(&bench, -2.0) - across(&bench, 2.0)).abs() < 0.1);
    let side = bench.until_picture_is_not(&first);

    // Any drag moves the view in its plane.
    let center = viewport(&bench).center();
    let origin = place(&bench, Vec3::ZERO);
    let by = egui::vec2(40.0, 24.0);
    drag(&mut bench, center, center + by, Modifiers::NONE);
    let moved = place(&bench, Vec3::ZERO) - origin;
    assert!((moved - by).length() < 12.0, "{moved:?}");
    bench.until_picture_is_not(&side);
    // A click meets what is there: from the front, the box before the one behind.
    bench
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::Num2);
    bench.harness.run_steps(2);
    click(&mut bench, Vec3::new(0.0, 0.0, 0.0), Modifiers::NONE);
    assert_eq!(chosen(&bench), ["box 1"]);

    // Back in the scene's camera, everything is as it was.
    bench.harness.key_press(Key::Escape);
    bench
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::Home);
    bench.harness.run_steps(2);
    assert_eq!(bench.harness.state().workbench.camera.view(), before);
    until_picture_is(&mut bench, &first);
}

#[test]
fn the_view_through_another_camera_follows_it_and_the_keys_frame() {
    let mut bench = open();
    let first = bench.picture();
    assert_eq!(
        bench.harness.state().workbench.sight(),
        Sight::Camera("eye".to_owned())
    );
    bench.choose("View", "other");
    let view = bench.harness.state().workbench.camera.view();
    assert!((view.position() - Vec3::new(8.0, 3.0, 0.0)).length() < 1e-4);
    assert!((view.fov_y.to_degrees() - 40.0).abs() < 1e-3);
    let other = bench.until_picture_is_not(&first);
    // A change of the camera by hand moves the view.
    let workbench = &mut bench.harness.state_mut().workbench;
    let camera = workbench
        .scenes
        .scene()
        .unwrap()
        .world
        .find("other")
        .unwrap();
    let up = lightbench::world::Value::Vec3(Vec3::new(8.0, 5.0, 0.0));
    workbench
        .set_field(camera, "transform.translation", up)
        .unwrap();
    bench.harness.run_steps(2);
    bench.until_picture_is_not(&other);
    let view = bench.harness.state().workbench.camera.view();
    assert!((view.position().y - 5.0).abs() < 1e-4);
    bench
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::Home);
    bench.harness.run_steps(2);
    until_picture_is(&mut bench, &first);

    // F shows what is chosen, Home all of the scene.
    click(&mut bench, Vec3::new(2.0, 0.0, 0.5), Modifiers::NONE);
    bench.harness.key_press(Key::F);
    bench.harness.run_steps(2);
    let height = |bench: &Bench| {
        let at = |y: f32| place(bench, Vec3::new(2.0, y, 0.0));
        at(-0.5).distance(at(0.5)) / viewport(bench).height()
    };
    let center = place(&bench, Vec3::new(2.0, 0.0, 0.0));
    assert!(center.distance(viewport(&bench).center()) < 1.0);
    let near = height(&bench);
    assert!(near > 0.35, "{near}");
    bench.harness.key_press(Key::Home);
    bench.harness.run_steps(2);
    assert!(height(&bench) < 0.5 * near);
}

#[test]
fn what_is_drawn_over_the_picture_can_be_switched_off() {
    let mut bench = open();
    let plain = screen(&mut bench);
    for entry in ["Grid and axes", "Lights and cameras"] {
        menu(&mut bench, "View", entry);
        assert!(screen(&mut bench) != plain, "{entry}");
        menu(&mut bench, "View", entry);
        assert!(screen(&mut bench) == plain, "{entry}");
    }
    // The lamp's range and the bounds of a box belong to what is chosen.
    for at in [Vec3::new(0.0, 2.2, 0.0), Vec3::new(2.0, 0.0, 0.5)] {
        click(&mut bench, at, Modifiers::NONE);
        bench.harness.state_mut().workbench.probing.pixel = None;
        let with = screen(&mut bench);
        assert!(with != plain);
        menu(&mut bench, "View", "Bounds and ranges");
        assert!(screen(&mut bench) != with);
        menu(&mut bench, "View", "Bounds and ranges");
        assert!(screen(&mut bench) == with);
    }
}
