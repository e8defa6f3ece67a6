//! Two viewports on one world: pictures, cameras, choosing, handles, marks, and what is kept of them.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use lightbench::lab::Picture;
use lightbench::render::readback::read_bytes;
use lightbench::world::glam::Vec3;
use lightbench::world::{Name, Transform};
use lightbench_editor::ui::lens::Lens;
use lightbench_editor::ui::workbench::flat::Side;
use lightbench_editor::ui::workbench::sight::Sight;
use lightbench_editor::ui::workbench::viewports::Viewport;

use ui_support::{Bench, CTRL, PATIENCE};

/// Three boxes in a row, a lamp above the middle one, and a second camera.
const ROW: &str = r#"
for i in 0..3 { spawn(`box ${i}`).mesh(box(1)).at(2 * i - 2, 0, 0); }
spawn("tall").mesh(box(1)).at(0, 0, -3).scale(1, 2.5, 1);
point_light("lamp").intensity(60).range(2).at(0, 2.2, 0);
point_light("fill").intensity(90).range(40).at(3, 4, 12);
camera("eye").at(0, 1, 8).look_at(0, 0.5, 0);
camera("other").at(8, 3, 0).look_at(0, 0, 0).fov(40);
"#;

/// The same, with a box that goes to and fro.
const MOVES: &str = r#"
spawn("box").mesh(box(1));
point_light("fill").intensity(90).range(40).at(3, 4, 8);
camera("eye").at(0, 1, 8).look_at(0, 0.5, 0);
fn update(time, dt) { entity("box").at(time, 0, 0); }
"#;

fn show_scene(bench: &mut Bench, name: &'static str, text: &str) {
    bench.save(&format!("scripts/scenes/{name}.rhai"), text);
    bench.harness.state_mut().workbench.select_scene(name);
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some(name) && !editor.workbench.scenes.is_busy()
    });
    // The watcher tells of the file a little later, and the scene is loaded once more.
    let swaps = bench.harness.state().workbench.scenes.swaps();
    let begun = Instant::now();
    bench.until("the watcher", |editor| {
        editor.workbench.scenes.swaps() > swaps || begun.elapsed().as_secs() > 2
    });
    bench.harness.run_steps(2);
}

fn open() -> Bench {
    let mut bench = Bench::open();
    show_scene(&mut bench, "row", ROW);
    bench
}

/// The same with both viewports; the second looks from the top and has the focus.
fn open_both() -> Bench {
    let mut bench = open();
    bench.key(Modifiers::NONE, Key::V);
    bench.key(CTRL, Key::Num1);
    second_picture(&mut bench);
    bench
}

fn rect(bench: &Bench, viewport: Viewport) -> Rect {
    let node = bench
        .harness
        .get_by_role_and_label(Role::Image, viewport.title());
    node.rect()
}

/// The bytes of the second viewport's picture, once it shows the present state at its present size.
fn second_picture(bench: &mut Bench) -> Vec<u8> {
    let began = Instant::now();
    loop {
        bench.harness.step();
        let size = rect(bench, Viewport::Second).size();
        let size = (size.x.round() as u32, size.y.round() as u32);
        let workbench = &bench.harness.state().workbench;
        if workbench.second_is_current() && workbench.second_size() == Some(size) {
            let texture = workbench.second_picture().unwrap().texture;
            return read_bytes(workbench.gpu(), &texture).unwrap();
        }
        assert!(
            began.elapsed() < PATIENCE,
            "no picture of the present state"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The view of a viewport as a line of text.
fn view_text(bench: &Bench, viewport: Viewport) -> String {
    let workbench = &bench.harness.state().workbench;
    workbench.viewpoint_in(viewport).unwrap().to_string()
}

/// What the command line, which knows one view alone, draws for a viewport.
fn drawn_alone(bench: &Bench, viewport: Viewport) -> Vec<u8> {
    let view = view_text(bench, viewport);
    let out = bench.path().join("alone.png");
    let mut command = Command::new(env!("CARGO_BIN_EXE_lightbench"));
    command.arg("--project").arg(bench.path());
    command.args(["render", "--view", &view, "--out"]).arg(&out);
    let output = command.output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    match Picture::open(&out).unwrap() {
        Picture::Ldr(picture) => picture.pixels.as_flattened().to_vec(),
        Picture::Hdr(_) => panic!("a PNG has eight bits"),
    }
}

fn sight(bench: &Bench, viewport: Viewport) -> Sight {
    bench.harness.state().workbench.sight_of(viewport)
}

/// Where both are seen from.
fn views(bench: &Bench) -> [lightbench::render::View; 2] {
    let workbench = &bench.harness.state().workbench;
    Viewport::ALL.map(|viewport| workbench.camera_of(viewport).view())
}

fn lens(bench: &Bench, viewport: Viewport) -> Lens {
    let view = bench.harness.state().workbench.camera_of(viewport).view();
    Lens::new(rect(bench, viewport), view)
}

/// Where a point of the world is in a viewport.
fn place(bench: &Bench, viewport: Viewport, at: Vec3) -> Pos2 {
    lens(bench, viewport).point(at).unwrap()
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

fn drag(bench: &mut Bench, from: Pos2, to: Pos2, modifiers: Modifiers) {
    bench.harness.event(Event::ModifiersChanged(modifiers));
    bench.harness.hover_at(from);
    bench.harness.step();
    button(bench, from, true, modifiers);
    for part in 1..=6 {
        bench.harness.hover_at(from.lerp(to, part as f32 / 6.0));
        bench.harness.step();
    }
    button(bench, to, false, modifiers);
    bench
        .harness
        .event(Event::ModifiersChanged(Modifiers::NONE));
    bench.harness.run_steps(2);
}

fn chosen(bench: &Bench) -> Vec<String> {
    let workbench = &bench.harness.state().workbench;
    let world = &workbench.scenes.scene().unwrap().world;
    let name = |entity| world.get::<Name>(entity).unwrap().text;
    let mut names: Vec<String> = workbench.selection.entities().map(name).collect();
    names.sort_unstable();
    names
}

fn menu(bench: &mut Bench, title: &str, entry: &str) {
    bench.press(title);
    let harness = &mut bench.harness;
    harness
        .get_by(|node| {
            node.role() == Role::Button
                && node.label().is_some_and(|label| label.starts_with(entry))
        })
        .click();
    harness.run_steps(3);
}

fn until_at_rest(bench: &mut Bench) {
    bench.until("rest", |editor| {
        editor.workbench.next_due(Instant::now()).is_none()
    });
}

#[test]
fn each_viewport_shows_what_a_single_one_would() {
    let mut bench = open();
    let alone = bench.picture();
    // It begins with what the first one shows.
    bench.key(Modifiers::NONE, Key::V);
    let begun = second_picture(&mut bench);
    let first = bench.picture();
    assert!(begun == first);
    bench.key(CTRL, Key::Num1);
    let top = second_picture(&mut bench);
    assert_eq!(sight(&bench, Viewport::Second), Sight::Side(Side::Top));
    assert!(view_text(&bench, Viewport::Second).contains("camera=top"));
    assert!(drawn_alone(&bench, Viewport::Second) == top);
    assert!(drawn_alone(&bench, Viewport::First) == first);
    assert_ne!(first, top);

    // Keys and the toolbar change what has the focus, which is what was opened.
    bench.key(CTRL, Key::Num2);
    let front = second_picture(&mut bench);
    assert!(front != top && drawn_alone(&bench, Viewport::Second) == front);
    bench.choose("View", "other");
    let other = second_picture(&mut bench);
    assert!(view_text(&bench, Viewport::Second).contains("camera.name=other"));
    assert!(other != front && drawn_alone(&bench, Viewport::Second) == other);
    assert_eq!(bench.picture(), first);
    assert_eq!(
        sight(&bench, Viewport::First),
        Sight::Camera("eye".to_owned())
    );

    // With another pipeline and another scene too.
    bench
        .harness
        .state_mut()
        .workbench
        .select_pipeline("clustered_forward");
    bench.until("the pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("clustered_forward")
    });
    let clustered = second_picture(&mut bench);
    assert!(drawn_alone(&bench, Viewport::Second) == clustered);

    // Nothing is drawn while nothing happens.
    until_at_rest(&mut bench);
    let frames = |bench: &Bench| {
        Viewport::ALL.map(|viewport| bench.harness.state().workbench.frames_of(viewport))
    };
    let before = frames(&bench);
    bench.harness.run_steps(5);
    assert_eq!(frames(&bench), before);
    let targets = |bench: &Bench, series| {
        let pipelines = &bench.harness.state().workbench.pipelines;
        let slot = pipelines.slot("clustered_forward").unwrap();
        let pipeline = slot.pipeline.as_ref().unwrap();
        pipeline.targets_of(series).is_some()
    };
    assert!(targets(&bench, 0) && targets(&bench, 1));

    // Closed, it holds nothing, and the first one is as it was.
    bench.key(Modifiers::NONE, Key::V);
    bench.harness.run_steps(2);
    let workbench = &bench.harness.state().workbench;
    assert!(workbench.second_picture().is_none() && !workbench.second.is_open());
    assert_eq!(workbench.focus(), Viewport::First);
    assert!(targets(&bench, 0) && !targets(&bench, 1));
    bench
        .harness
        .state_mut()
        .workbench
        .select_pipeline("deferred_shading");
    assert_eq!(bench.picture(), alone);
}

#[test]
fn history_of_one_viewport_is_not_seen_in_the_other() {
    let mut bench = open_both();
    let text = bench
        .files
        .read_text("scripts/pipelines/examples/history.rhai");
    bench.save("scripts/pipelines/trail.rhai", &text.unwrap());
    bench.harness.state_mut().workbench.select_pipeline("trail");
    bench.until("the pipeline", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.pipelines.shown() == Some("trail")
    });
    // Both have the same size, so that nothing else keeps them apart.
    let [first, second] = Viewport::ALL.map(|viewport| rect(&bench, viewport).size());
    assert_eq!(first, second);
    let expected = Viewport::ALL.map(|viewport| {
        bench.picture();
        second_picture(&mut bench);
        drawn_alone(&bench, viewport)
    });
    assert!(expected[0] != expected[1]);
    for _ in 0..6 {
        // Draws both anew.
        bench.harness.state_mut().workbench.inspect(None);
        assert!(bench.picture() == expected[0]);
        assert!(second_picture(&mut bench) == expected[1]);
    }
    // A trail stays where something moves, in the viewport in which it does.
    bench.key(CTRL, Key::Num2);
    assert!(second_picture(&mut bench) != drawn_alone(&bench, Viewport::Second));
    assert!(bench.picture() == expected[0]);
}

#[test]
fn a_click_chooses_what_lies_there_in_that_viewport() {
    let mut bench = open_both();
    let at = place(&bench, Viewport::Second, Vec3::new(2.0, 0.5, 0.0));
    bench.click_at(at);
    assert_eq!(chosen(&bench), ["box 2"]);
    // Pixels are probed in the first one.
    assert_eq!(bench.harness.state().workbench.probing.pixel, None);
    // The lamp's icon lies over the box in the middle there.
    let lamp = Vec3::new(0.0, 2.2, 0.0);
    let over = place(&bench, Viewport::Second, lamp);
    bench.click_at(over);
    assert_eq!(chosen(&bench), ["lamp"]);
    let at = place(&bench, Viewport::First, Vec3::new(-2.0, 0.0, 0.5));
    bench.click_at(at);
    assert_eq!(chosen(&bench), ["box 0"]);
    assert!(bench.harness.state().workbench.probing.pixel.is_some());

    let [from, to] = [Vec3::new(-2.6, 0.0, -0.8), Vec3::new(0.8, 0.0, 0.8)]
        .map(|at| place(&bench, Viewport::Second, at));
    drag(&mut bench, from, to, Modifiers::SHIFT);
    assert_eq!(chosen(&bench), ["box 0", "box 1", "lamp"]);

    // Without icons in the second viewport what is below is chosen there; the first one has its own.
    assert_eq!(bench.harness.state().workbench.focus(), Viewport::Second);
    menu(&mut bench, "View", "Lights and cameras");
    bench.click_at(over);
    assert_eq!(chosen(&bench), ["box 1"]);
    let at = place(&bench, Viewport::First, lamp);
    bench.click_at(at);
    assert_eq!(chosen(&bench), ["lamp"]);
    assert!(!bench.harness.state().workbench.camera.is_moved());
}

#[test]
fn a_handle_in_the_second_viewport_moves_the_entity_as_one_step() {
    let mut bench = open_both();
    let before = (bench.picture(), second_picture(&mut bench));
    let seen_from = views(&bench);
    let transform = |bench: &Bench| {
        let scene = bench.harness.state().workbench.scenes.scene().unwrap();
        let entity = scene.world.find("box 0").unwrap();
        scene.world.get::<Transform>(entity).unwrap().translation
    };
    let at = place(&bench, Viewport::Second, Vec3::new(-2.3, 0.5, 0.3));
    bench.click_at(at);
    assert_eq!(chosen(&bench), ["box 0"]);
    // Along z, which goes down there.
    let handle = lens(&bench, Viewport::Second);
    let start = Vec3::new(-2.0, 0.0, 0.0);
    let on_it = start + Vec3::Z * 40.0 * handle.metres_per_point(start);
    let [from, to] = [on_it, on_it + Vec3::Z].map(|at| handle.point(at).unwrap());
    assert!(to.y > from.y + 20.0 && (to.x - from.x).abs() < 1.0);
    let steps = |bench: &Bench| bench.harness.state().workbench.undo.done().len();
    let steps_before = steps(&bench);
    drag(&mut bench, from, to, Modifiers::NONE);
    let moved = transform(&bench);
    assert!(
        (moved - Vec3::new(-2.0, 0.0, 1.0)).length() < 0.01,
        "{moved}"
    );
    assert_eq!(views(&bench), seen_from);
    let after = (bench.picture(), second_picture(&mut bench));
    assert!(after.0 != before.0 && after.1 != before.1);
    assert!(drawn_with_edits_differs(&bench));
    assert_eq!(steps(&bench), steps_before + 1);
    bench.key(CTRL, Key::Z);
    assert_eq!(transform(&bench), start);
    assert!(bench.picture() == before.0 && second_picture(&mut bench) == before.1);
    // Looking elsewhere, closing and opening are no steps.
    bench.key(CTRL, Key::Num3);
    bench.key(Modifiers::NONE, Key::V);
    bench.key(Modifiers::NONE, Key::V);
    assert_eq!(steps(&bench), steps_before);
}

/// What was changed by hand is in no view as text: the command line draws the box where it was.
fn drawn_with_edits_differs(bench: &Bench) -> bool {
    let texture = bench.harness.state().workbench.second_picture().unwrap();
    let gpu = bench.harness.state().workbench.gpu();
    drawn_alone(bench, Viewport::Second) != read_bytes(gpu, &texture.texture).unwrap()
}

#[test]
fn cameras_move_apart_and_keys_go_to_what_has_the_focus() {
    let mut bench = open_both();
    let focus = |bench: &Bench| bench.harness.state().workbench.focus();
    let [first, second] = views(&bench);
    // Orbit in the first one.
    let from = rect(&bench, Viewport::First).center() + vec2(-60.0, 90.0);
    drag(&mut bench, from, from + vec2(50.0, 10.0), Modifiers::NONE);
    let [orbited, same] = views(&bench);
    assert!(orbited != first && same == second);
    assert_eq!(focus(&bench), Viewport::First);
    // The wheel and a key over the second one.
    let over = rect(&bench, Viewport::Second).center() + vec2(-60.0, 90.0);
    bench.harness.hover_at(over);
    bench.harness.step();
    bench.harness.event(Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    bench.harness.run_steps(20);
    let [still, zoomed] = views(&bench);
    assert!(still == orbited && zoomed.position().y < second.position().y);
    assert_eq!(focus(&bench), Viewport::Second);
    bench.harness.key_down(Key::D);
    bench.harness.run_steps(5);
    bench.harness.key_up(Key::D);
    bench.harness.run_steps(2);
    let [still, flown] = views(&bench);
    assert!(still == orbited && flown.position().x > zoomed.position().x);

    // All of what is chosen, in the one that has the focus.
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let entity = scene.world.find("box 2").unwrap();
    workbench.selection.set(scene, [entity]);
    bench.key(Modifiers::NONE, Key::F);
    let [still, framed] = views(&bench);
    assert!(still == orbited);
    let middle = lens(&bench, Viewport::Second)
        .point(Vec3::new(2.0, 0.0, 0.0))
        .unwrap();
    assert!(middle.distance(rect(&bench, Viewport::Second).center()) < 1.0);
    bench.key(Modifiers::SHIFT, Key::V);
    assert_eq!(focus(&bench), Viewport::First);
    bench.key(Modifiers::NONE, Key::Home);
    let [home, still] = views(&bench);
    assert!(home != orbited && still == framed);
    bench.key(Modifiers::SHIFT, Key::Home);
    assert_eq!(views(&bench), [first, framed]);

    // The frame of the one that has the focus is another colour than the edge of the other.
    bench.harness.remove_cursor();
    bench.harness.run_steps(2);
    let corners = |bench: &mut Bench| {
        let image = bench.harness.render().unwrap();
        Viewport::ALL.map(|viewport| {
            let at = rect(bench, viewport).left_bottom() + vec2(1.0, -1.5);
            *image.get_pixel(at.x as u32, at.y as u32)
        })
    };
    let [focused, other] = corners(&mut bench);
    bench.key(Modifiers::SHIFT, Key::V);
    let [other_then, focused_then] = corners(&mut bench);
    assert_eq!(focused, focused_then);
    assert_ne!(focused, other_then);
    assert_ne!(focused, other);
}

#[test]
fn lines_and_resolution_are_those_of_each_viewport() {
    let mut bench = open_both();
    menu(&mut bench, "View", "Wireframe");
    second_picture(&mut bench);
    let lines = |bench: &mut Bench, viewport| {
        let workbench = &mut bench.harness.state_mut().workbench;
        workbench.lines_picture(viewport).map(|texture| {
            let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
            ((texture.width(), texture.height()), bytes)
        })
    };
    let (size, second) = lines(&mut bench, Viewport::Second).unwrap();
    assert_eq!(bench.harness.state().workbench.second_size(), Some(size));
    assert!(second.iter().any(|byte| *byte != 0));
    assert!(lines(&mut bench, Viewport::First).is_none());
    bench.key(Modifiers::SHIFT, Key::V);
    menu(&mut bench, "View", "Wireframe");
    bench.picture();
    let (_, first) = lines(&mut bench, Viewport::First).unwrap();
    assert!(first != second);
    assert!(lines(&mut bench, Viewport::Second).unwrap().1 == second);
    bench.harness.run_steps(2);

    // While something moves both are drawn smaller on the software driver, and in full after it.
    show_scene(&mut bench, "moves", MOVES);
    bench.harness.state_mut().workbench.resolution.adaptive = true;
    bench.until("both smaller", |editor| {
        let workbench = &mut editor.workbench;
        let second = workbench.second_picture().is_some_and(|it| it.scale < 1.0);
        workbench.picture().is_some_and(|it| it.scale < 1.0) && second
    });
    let time = bench.harness.state().workbench.clock.time();
    let before = Viewport::ALL.map(|it| bench.harness.state().workbench.frames_of(it));
    bench.until("both to go on", |editor| {
        let [first, second] = Viewport::ALL.map(|it| editor.workbench.frames_of(it));
        first > before[0] + 3 && second > before[1] + 3
    });
    assert!(bench.harness.state().workbench.clock.time() > time);
    bench.harness.state_mut().workbench.clock.playing = false;
    until_at_rest(&mut bench);
    let workbench = &mut bench.harness.state_mut().workbench;
    assert_eq!(workbench.picture().unwrap().scale, 1.0);
    assert_eq!(workbench.second_picture().unwrap().scale, 1.0);
    let drawn = second_picture(&mut bench);
    assert!(drawn_alone(&bench, Viewport::Second) == drawn);
}

#[test]
fn a_comparison_stays_in_the_first_viewport() {
    let mut bench = open_both();
    let second = second_picture(&mut bench);
    bench.key(Modifiers::NONE, Key::C);
    bench.until("B", |editor| {
        let workbench = &editor.workbench;
        let side = workbench.comparing.side().unwrap();
        side.pipelines.shown().is_some()
            && !side.pipelines.is_warming()
            && workbench.comparing.pairs() > 0
            && !workbench.comparing.is_waiting()
    });
    assert_eq!(second_picture(&mut bench), second);
    // The split is moved in the first one; the same place of the second is only its picture.
    let at = rect(&bench, Viewport::Second).center();
    let split = bench.harness.state().workbench.comparing.split;
    drag(&mut bench, at, at + vec2(40.0, 0.0), Modifiers::NONE);
    assert_eq!(bench.harness.state().workbench.comparing.split, split);
    let at = rect(&bench, Viewport::First).center() + vec2(0.0, 60.0);
    drag(&mut bench, at, at + vec2(40.0, 0.0), Modifiers::NONE);
    assert!(bench.harness.state().workbench.comparing.split > split);
    // Time runs for all three.
    show_scene(&mut bench, "moves", MOVES);
    let frames = Viewport::ALL.map(|it| bench.harness.state().workbench.frames_of(it));
    let pairs = bench.harness.state().workbench.comparing.pairs();
    bench.until("all to go on", |editor| {
        let workbench = &editor.workbench;
        let [a, b] = Viewport::ALL.map(|it| workbench.frames_of(it));
        a > frames[0] + 3 && b > frames[1] + 3 && workbench.comparing.pairs() > pairs + 3
    });
}

/// A file of settings that is there, so that nothing greets.
fn settings(folder: &tempfile::TempDir) -> PathBuf {
    let path = folder.path().join("editor.json");
    std::fs::write(&path, "{}").unwrap();
    path
}

#[test]
fn the_arrangement_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = settings(&folder);
    let mut bench = Bench::open_with(Some(path.clone()));
    bench.harness.hover_at(pos2(600.0, 300.0));
    bench.harness.run_steps(2);
    // Who changes nothing keeps nothing.
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(!text.contains("arrangement"), "{text}");
    bench.key(Modifiers::NONE, Key::V);
    second_picture(&mut bench);
    bench.key(CTRL, Key::Num2);
    menu(&mut bench, "View", "Wireframe");
    // The line between both.
    let [first, second] = Viewport::ALL.map(|viewport| rect(&bench, viewport));
    let between = pos2(0.5 * (first.right() + second.left()), first.center().y);
    drag(
        &mut bench,
        between,
        between - vec2(90.0, 0.0),
        Modifiers::NONE,
    );
    let rects = Viewport::ALL.map(|viewport| rect(&bench, viewport));
    assert!(rects[0].width() < first.width() - 60.0, "{rects:?}");
    assert!(rects[1].width() > second.width() + 60.0, "{rects:?}");

    let project = bench.close();
    let mut bench = Bench::open_project(project, Some(path.clone()));
    second_picture(&mut bench);
    for (viewport, before) in Viewport::ALL.into_iter().zip(rects) {
        let now = rect(&bench, viewport);
        let apart = (now.min - before.min).length() + (now.max - before.max).length();
        assert!(apart < 1.0, "{now} was {before}");
    }
    assert_eq!(sight(&bench, Viewport::Second), Sight::Side(Side::Front));
    let workbench = &mut bench.harness.state_mut().workbench;
    assert!(workbench.lines_picture(Viewport::Second).is_some());
    assert!(workbench.lines_picture(Viewport::First).is_none());
    // Another scene is seen from the same side, and all of it.
    show_scene(&mut bench, "row", ROW);
    let front = second_picture(&mut bench);
    assert_eq!(sight(&bench, Viewport::Second), Sight::Side(Side::Front));
    assert!(drawn_alone(&bench, Viewport::Second) == front);

    // Closed, it stays closed.
    bench.key(Modifiers::NONE, Key::V);
    let project = bench.close();
    let bench = Bench::open_project(project, Some(path.clone()));
    assert!(!bench.harness.state().workbench.second.is_open());
    // What can't be read is as if nothing was kept.
    let project = bench.close();
    std::fs::write(&path, "{\"arrangement\": {\"panels\": 3}}").unwrap();
    let bench = Bench::open_project(project, Some(path));
    assert!(rect(&bench, Viewport::First).width() > 400.0);
}
