//! Taking back and doing again of all that changes something, across panels, with the list of all of it.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use lightbench::world::{Light, Transform, Value};
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::comparing::Mode;

use ui_support::{Bench, CTRL};

const CTRL_SHIFT: Modifiers = Modifiers {
    shift: true,
    ..CTRL
};

/// Stands still.
const STILL: &str = r#"
spawn("box").mesh(box(1)).at(1, 0, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

/// Moves, and remembers what it did: to go back to a moment takes all of it.
const MOVES: &str = r#"
const DICE = random(3);
spawn("box").mesh(box(1));
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
state.way = 0.0;
fn update(time, dt) {
    state.way += dt * (1.0 + DICE.float());
    entity("box").at(state.way, time, 0);
}
"#;

fn undo(bench: &mut Bench) {
    bench.key(CTRL, Key::Z);
}

fn redo(bench: &mut Bench) {
    bench.key(CTRL_SHIFT, Key::Z);
}

fn steps(bench: &Bench) -> Vec<String> {
    let undo = &bench.harness.state().workbench.undo;
    undo.done().iter().map(|step| step.what.clone()).collect()
}

fn settle(bench: &mut Bench, scene: &str) {
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        let workbench = &editor.workbench;
        let (scenes, pipelines) = (&workbench.scenes, &workbench.pipelines);
        scenes.shown() == Some(scene)
            && !scenes.is_busy()
            && !workbench.is_arriving()
            && !workbench.undo.is_waiting()
            && !pipelines.is_busy()
            && !pipelines.is_warming()
    });
    bench.harness.run_steps(2);
}

fn open(bench: &mut Bench, name: &str, script: &str) {
    bench.save(&format!("scripts/scenes/{name}.rhai"), script);
    bench.harness.state_mut().workbench.select_scene(name);
    settle(bench, name);
    // A file that was just written is told of once more.
    for _ in 0..40 {
        bench.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    settle(bench, name);
}

/// Waits until B is on screen.
fn settle_other(bench: &mut Bench) {
    bench.until("B", |editor| {
        let side = editor.workbench.comparing.side();
        side.is_some_and(|side| {
            let pipelines = &side.pipelines;
            pipelines.shown() == Some(pipelines.selected())
                && !pipelines.is_busy()
                && !pipelines.is_warming()
        })
    });
}

fn text(bench: &mut Bench) -> String {
    let scenes = &mut bench.harness.state_mut().workbench.scenes;
    scenes.scene_mut().unwrap().to_text().unwrap()
}

fn intensity(bench: &Bench) -> f32 {
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let lamp = scene.world.find("lamp").unwrap();
    scene.world.get::<Light>(lamp).unwrap().intensity
}

fn set_intensity(bench: &mut Bench, value: f32) {
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let lamp = scene.world.find("lamp").unwrap();
    let value = Value::Float(value);
    workbench.set_field(lamp, "light.intensity", value).unwrap();
    bench.harness.run_steps(2);
}

fn place(bench: &Bench) -> Transform {
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let thing = scene.world.find("box").unwrap();
    scene.world.get::<Transform>(thing).unwrap()
}

fn time(bench: &Bench) -> f64 {
    bench.harness.state().workbench.clock.time()
}

fn click(bench: &mut Bench, label: &str) {
    let button = bench.harness.get_by_role_and_label(Role::Button, label);
    button.click_accesskit();
    bench.harness.run_steps(3);
}

fn press_at(bench: &mut Bench, button: PointerButton, at: Pos2, pressed: bool) {
    bench.harness.event(Event::PointerButton {
        pos: at,
        button,
        pressed,
        modifiers: Modifiers::NONE,
    });
    bench.harness.step();
}

fn drag(bench: &mut Bench, button: PointerButton, from: Pos2, to: Pos2) {
    bench.harness.hover_at(from);
    bench.harness.step();
    press_at(bench, button, from, true);
    for part in 1..=5 {
        bench.harness.hover_at(from.lerp(to, part as f32 / 5.0));
        bench.harness.step();
    }
    press_at(bench, button, to, false);
    bench.harness.run_steps(2);
}

#[test]
fn another_scene_is_taken_back_with_its_changes_its_camera_and_the_picture() {
    let mut bench = Bench::open();
    open(&mut bench, "still", STILL);
    bench.harness.state_mut().workbench.undo.clear();
    set_intensity(&mut bench, 25.0);
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let middle = viewport.rect().center();
    drag(
        &mut bench,
        PointerButton::Secondary,
        middle,
        middle + vec2(30.0, 9.0),
    );
    let view = bench.harness.state().workbench.camera.view();
    let (first, first_text) = (bench.picture(), text(&mut bench));

    open(&mut bench, "moves", MOVES);
    bench.harness.state_mut().workbench.stop();
    set_intensity(&mut bench, 7.0);
    let count = steps(&bench).len();
    assert_eq!(steps(&bench)[0], "light.intensity of lamp");
    assert_eq!(steps(&bench)[1], "Open the scene moves");

    // Out of the other scene and out of the change that was made here, at once: the scene is loaded between.
    bench.show(Panel::History);
    assert_eq!(bench.count("Open the scene moves"), 1);
    let rows: Vec<_> = bench
        .harness
        .query_all_by_label("light.intensity of lamp")
        .collect();
    assert_eq!(rows.len(), 2, "one of each scene");
    rows[0].click_accesskit();
    bench.harness.run_steps(3);
    settle(&mut bench, "still");
    assert_eq!(steps(&bench).len(), 1);
    assert_eq!(text(&mut bench), first_text);
    assert_eq!(bench.harness.state().workbench.camera.view(), view);
    assert_eq!(bench.picture(), first);
    undo(&mut bench);
    assert_eq!(intensity(&bench), 60.0);

    // And all again, to the end.
    for _ in 0..count {
        redo(&mut bench);
    }
    settle(&mut bench, "moves");
    assert_eq!(intensity(&bench), 7.0);
    assert_eq!(steps(&bench).len(), count);
    bench.harness.state_mut().workbench.go_to_step(0);
    settle(&mut bench, "still");
    assert_eq!(intensity(&bench), 60.0);
    let log = &bench.harness.state().workbench.log;
    let wrong: Vec<_> = log
        .lines()
        .filter(|line| line.text.contains("passed over"))
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn pipelines_and_the_comparison_are_taken_back() {
    let mut bench = Bench::open();
    let first = bench.picture();
    bench.key(Modifiers::NONE, Key::CloseBracket);
    settle(&mut bench, "cornell_box");
    let second = bench.shown();
    assert_ne!(second, "deferred_shading");
    undo(&mut bench);
    assert_eq!(bench.shown(), "deferred_shading");
    assert_eq!(bench.picture(), first);
    // The view that was turned meanwhile stays.
    let turn = lightbench::world::glam::Vec2::new(0.1, 0.0);
    let workbench = &mut bench.harness.state_mut().workbench;
    let home = workbench.camera;
    workbench.camera.look(turn);
    let turned = workbench.camera.view();
    bench.harness.run_steps(2);
    redo(&mut bench);
    assert_eq!(bench.shown(), second);
    let workbench = &mut bench.harness.state_mut().workbench;
    assert!(!workbench.is_arriving());
    assert_eq!(workbench.camera.view(), turned);
    workbench.camera = home;
    undo(&mut bench);

    bench.key(Modifiers::NONE, Key::C);
    click(&mut bench, "Give B what A has");
    let value = |bench: &Bench, parameter: &str| {
        let side = bench.harness.state().workbench.comparing.side().unwrap();
        let slot = side.pipelines.slot("deferred_shading").unwrap();
        slot.settings.get(parameter).map(ToString::to_string)
    };
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_other_parameter("exposure", Some(2.0.into()));
    bench.harness.run_steps(2);
    assert_eq!(value(&bench, "exposure").as_deref(), Some("2"));
    bench.show(Panel::Compare);
    click(&mut bench, "Difference");
    let mode = |bench: &Bench| bench.harness.state().workbench.comparing.mode;
    assert_eq!(mode(&bench), Mode::Difference);
    settle_other(&mut bench);
    bench.key(Modifiers::SHIFT, Key::C);
    let a_exposure = |bench: &Bench| {
        let slot = bench
            .harness
            .state()
            .workbench
            .pipelines
            .slot("deferred_shading");
        slot.unwrap()
            .settings
            .get("exposure")
            .map(ToString::to_string)
    };
    assert_eq!(
        a_exposure(&bench).as_deref(),
        Some("2"),
        "A and B have changed"
    );
    let words = [
        "Compare two pipelines",
        "Give B what A has",
        "The parameter exposure of B",
        "How both pictures are shown",
        "Swap A and B",
    ];
    assert_eq!(steps(&bench), words);

    undo(&mut bench);
    assert_eq!(a_exposure(&bench), None);
    assert_eq!(value(&bench, "exposure").as_deref(), Some("2"));
    undo(&mut bench);
    assert_eq!(mode(&bench), Mode::Split);
    undo(&mut bench);
    assert_eq!(value(&bench, "exposure"), None);
    undo(&mut bench);
    undo(&mut bench);
    assert!(!bench.harness.state().workbench.comparing.is_on());
    settle(&mut bench, "cornell_box");
    assert_eq!(bench.picture(), first);
    for _ in 0..5 {
        redo(&mut bench);
    }
    assert_eq!(steps(&bench), words);
    assert_eq!(mode(&bench), Mode::Difference);
    assert_eq!(a_exposure(&bench).as_deref(), Some("2"));
    assert_eq!(value(&bench, "exposure"), None);
}

#[test]
fn a_line_that_is_dragged_is_one_step() {
    let mut bench = Bench::open();
    bench.key(Modifiers::NONE, Key::C);
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let rect = viewport.rect();
    let at = |x: f32| pos2(rect.left() + rect.width() * x, rect.center().y);
    drag(&mut bench, PointerButton::Primary, at(0.5), at(0.25));
    drag(&mut bench, PointerButton::Primary, at(0.25), at(0.75));
    let split = |bench: &Bench| bench.harness.state().workbench.comparing.split;
    let name = "Where the pictures are split";
    assert_eq!(steps(&bench)[1..], [name, name]);
    assert!((split(&bench) - 0.75).abs() < 0.01);
    undo(&mut bench);
    assert!((split(&bench) - 0.25).abs() < 0.01);
    undo(&mut bench);
    assert_eq!(split(&bench), 0.5);
    redo(&mut bench);
    redo(&mut bench);
    assert!((split(&bench) - 0.75).abs() < 0.01);
}

#[test]
fn time_is_taken_back_with_the_scene_as_it_stood() {
    let mut bench = Bench::open();
    open(&mut bench, "moves", MOVES);
    bench.harness.state_mut().workbench.stop();
    bench.harness.state_mut().workbench.undo.clear();
    bench.harness.run_steps(2);
    let first = text(&mut bench);
    bench.key(Modifiers::NONE, Key::Period);
    bench.key(Modifiers::NONE, Key::Period);
    let (after_two, at) = (text(&mut bench), time(&bench));
    assert_ne!(after_two, first);
    let still = place(&bench);
    bench.key(Modifiers::NONE, Key::Space);
    bench.until("time to run", |editor| {
        editor.workbench.clock.time() > at + 0.3
    });
    bench.key(Modifiers::NONE, Key::Space);
    let (held, held_at) = (text(&mut bench), time(&bench));
    bench.key(CTRL, Key::Period);
    assert_eq!(text(&mut bench), first, "Stop gives back what there was");
    assert_eq!(steps(&bench), ["Step", "Step", "Play", "Pause", "Stop"]);

    undo(&mut bench);
    assert_eq!((text(&mut bench), time(&bench)), (held.clone(), held_at));
    assert!(bench.harness.state().workbench.is_in_play());
    undo(&mut bench);
    assert!(
        bench.harness.state().workbench.clock.playing,
        "it ran until then"
    );
    undo(&mut bench);
    assert!(!bench.harness.state().workbench.clock.playing);
    assert_eq!((text(&mut bench), time(&bench)), (after_two.clone(), at));
    assert_eq!(place(&bench), still);
    undo(&mut bench);
    undo(&mut bench);
    assert_eq!((text(&mut bench), time(&bench)), (first.clone(), 0.0));
    redo(&mut bench);
    redo(&mut bench);
    assert_eq!((text(&mut bench), time(&bench)), (after_two, at));
    // From there the same steps give the same scene again.
    bench.key(Modifiers::NONE, Key::Backspace);
    assert_eq!(time(&bench), 0.0);
    undo(&mut bench);
    assert_eq!(time(&bench), at);
    let speed = &mut bench.harness.state_mut().workbench.clock.speed;
    *speed = 4.0;
    bench.harness.run_steps(2);
    undo(&mut bench);
    assert_eq!(bench.harness.state().workbench.clock.speed, 1.0);
    // The script was loaded anew: how it stood before is not known, the clock is.
    let swaps = bench.harness.state().workbench.scenes.swaps();
    bench.harness.state_mut().workbench.reload();
    bench.until("the scene anew", |editor| {
        editor.workbench.scenes.swaps() > swaps && !editor.workbench.scenes.is_busy()
    });
    undo(&mut bench);
    assert!((time(&bench) - at / 2.0).abs() < 1e-9);
    let log = &bench.harness.state().workbench.log;
    assert!(log.lines().any(|line| line.text.contains("only the clock")));
}

#[test]
fn lines_of_the_console_are_taken_back_and_those_that_change_nothing_are_no_steps() {
    let mut bench = Bench::open();
    open(&mut bench, "still", STILL);
    bench.harness.state_mut().workbench.undo.clear();
    let first = text(&mut bench);
    bench.show(Panel::Console);
    let run = |bench: &mut Bench, line: &str| {
        let field = bench.harness.get_by_role_and_label(Role::TextInput, "Line");
        field.focus();
        bench.harness.run_steps(2);
        bench.type_text(line);
        bench.harness.key_press(Key::Enter);
        bench.harness.run_steps(3);
        // Keys are the editor's again.
        bench.harness.key_press(Key::Escape);
        bench.harness.run_steps(2);
    };
    run(&mut bench, "entity(\"lamp\").intensity");
    run(&mut bench, "print(1 + 1)");
    assert_eq!(steps(&bench), [""; 0]);
    run(
        &mut bench,
        "entity(\"lamp\").intensity(5); entity(\"box\").remove();",
    );
    set_intensity(&mut bench, 8.0);
    run(&mut bench, "let more = 3;");
    run(&mut bench, "spawn(\"new\").at(more, 0, 0)");
    let last = text(&mut bench);
    assert_eq!(steps(&bench).len(), 4);
    assert!(steps(&bench)[3].starts_with("Console: spawn"));
    undo(&mut bench);
    undo(&mut bench);
    assert_eq!(intensity(&bench), 8.0);
    undo(&mut bench);
    assert_eq!(intensity(&bench), 5.0);
    undo(&mut bench);
    assert_eq!(text(&mut bench), first);
    for _ in 0..4 {
        redo(&mut bench);
    }
    assert_eq!(text(&mut bench), last);
    // The variable is there again.
    run(&mut bench, "spawn(\"newer\").at(more, 1, 0)");
    assert_eq!(steps(&bench).len(), 5);
}

#[test]
fn views_have_a_way_back_of_their_own() {
    let mut bench = Bench::open();
    open(&mut bench, "still", STILL);
    bench.harness.state_mut().workbench.undo.clear();
    let eye = |bench: &Bench| bench.harness.state().workbench.camera.view();
    let chosen = |bench: &Bench| bench.harness.state().workbench.selection.len();
    let (home, home_picture) = (eye(&bench), bench.picture());
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let from = viewport.rect().center() + vec2(0.0, 200.0);
    drag(
        &mut bench,
        PointerButton::Secondary,
        from,
        from + vec2(80.0, 0.0),
    );
    let turned = eye(&bench);
    drag(
        &mut bench,
        PointerButton::Secondary,
        from,
        from - vec2(40.0, 50.0),
    );
    let again = eye(&bench);
    set_intensity(&mut bench, 9.0);
    bench.show(Panel::Entities);
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let lamp = scene.world.find("lamp").unwrap();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench
        .selection
        .set(workbench.scenes.scene().unwrap(), [lamp]);
    bench.harness.run_steps(2);
    let views = |bench: &Bench| -> Vec<String> {
        let views = bench.harness.state().workbench.views.all();
        views.iter().map(|view| view.what.clone()).collect()
    };
    let words = [
        "The camera is moved",
        "The camera is moved",
        "lamp is chosen",
    ];
    assert_eq!(views(&bench)[1..], words);
    assert_eq!(steps(&bench), ["light.intensity of lamp"]);

    // A change is taken back without the view.
    undo(&mut bench);
    assert_eq!((intensity(&bench), eye(&bench)), (60.0, again));
    assert_eq!(chosen(&bench), 1);
    bench.key(Modifiers::SHIFT, Key::Z);
    assert_eq!((chosen(&bench), eye(&bench)), (0, again));
    bench.key(Modifiers::SHIFT, Key::Z);
    assert_eq!(eye(&bench), turned);
    bench.key(Modifiers::SHIFT, Key::Z);
    assert_eq!(eye(&bench), home);
    assert_eq!(bench.picture(), home_picture);
    bench.key(Modifiers::SHIFT, Key::Y);
    assert_eq!(eye(&bench), turned);
    bench.show(Panel::History);
    click(&mut bench, "lamp is chosen");
    assert_eq!((chosen(&bench), eye(&bench)), (1, again));
    click(&mut bench, "The first view");
    assert_eq!((chosen(&bench), eye(&bench)), (0, home));
}

#[test]
fn entries_of_the_notebook_come_back_byte_for_byte() {
    let mut bench = Bench::open();
    bench.show(Panel::Notebook);
    click(&mut bench, "Keep this measurement");
    bench.until("the entry", |editor| {
        let notebook = &editor.workbench.notebook;
        !notebook.is_busy() && notebook.entries().len() == 1
    });
    let folder = bench.path().join("notebook");
    let files = |folder: &std::path::Path| -> Vec<(std::path::PathBuf, Vec<u8>)> {
        let entries = std::fs::read_dir(folder).unwrap().flatten();
        let mut all: Vec<_> = entries
            .map(|file| (file.path(), std::fs::read(file.path()).unwrap()))
            .collect();
        all.sort();
        all
    };
    let before = files(&folder);
    assert_eq!(before.len(), 2);
    let name = bench.harness.state().workbench.notebook.entries()[0]
        .entry
        .name
        .clone();
    bench.harness.run_steps(2);
    click(&mut bench, "Delete");
    click(&mut bench, "Delete it");
    assert_eq!(files(&folder), []);
    undo(&mut bench);
    assert_eq!(files(&folder), before);
    assert_eq!(bench.harness.state().workbench.notebook.entries().len(), 1);
    redo(&mut bench);
    assert_eq!(files(&folder), []);
    undo(&mut bench);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_note(&name, "something else");
    undo(&mut bench);
    assert_eq!(files(&folder), before);
    redo(&mut bench);
    let entries = bench.harness.state().workbench.notebook.entries();
    assert_eq!(entries[0].entry.note, "something else");
}
