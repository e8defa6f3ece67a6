//! Changing entities by hand in the editor, playing and stopping, and the lines of what was done.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::assets::Progress;
use lightbench::render::readback::read_bytes;
use lightbench::script::{Scene, Settings, load_scene};
use lightbench::world::{Light, Value};
use lightbench_editor::ui::Editor;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::history::Script;

use ui_support::Bench;

/// A lamp that the script leaves alone, and one that it moves and dims in each step.
const LAMPS: &str = r#"
spawn("floor").mesh(plane(6, 6)).material(material("stone").color(0.6, 0.6, 0.6));
point_light("still").intensity(5).range(6).at(-1, 1, 0);
point_light("busy").intensity(3).range(6).at(1, 1, 0);
camera("eye").at(0, 3, 6).look_at(0, 0, 0);
const ROW = random(3);
state.steps = 0;
fn update(time, dt) {
    state.steps += 1;
    entity("busy").intensity(3 + ROW.float());
    entity("busy").at(1, 1 + time, 0);
    plot("height", 1 + time);
}
"#;

fn open(bench: &mut Bench, script: &str) {
    save(bench, script);
    bench.harness.state_mut().workbench.select_scene("lamps");
    bench.until("the scene", |editor| {
        editor.workbench.scenes.shown() == Some("lamps") && !editor.workbench.scenes.is_busy()
    });
    // The scene moves, so it plays. Each test lets time pass itself.
    bench.harness.state_mut().workbench.stop();
    // The choice of the scene is a step too.
    bench.harness.state_mut().workbench.undo.clear();
    bench.harness.run_steps(2);
}

fn save(bench: &Bench, script: &str) {
    bench.save("scripts/scenes/lamps.rhai", script);
}

/// Saves the script and waits for the scene that it makes.
fn reload(bench: &mut Bench, script: &str) {
    let swaps = bench.harness.state().workbench.scenes.swaps();
    save(bench, script);
    bench
        .harness
        .state_mut()
        .workbench
        .files_changed(&["scripts/scenes/lamps.rhai".to_owned()]);
    bench.until("the scene anew", |editor| {
        editor.workbench.scenes.swaps() > swaps && !editor.workbench.scenes.is_busy()
    });
    bench.harness.run_steps(2);
}

fn show(bench: &mut Bench, panel: Panel) {
    bench.show(panel);
}

fn scene(editor: &mut Editor) -> &mut Scene {
    editor.workbench.scenes.scene_mut().unwrap()
}

fn intensity(bench: &mut Bench, name: &str) -> f32 {
    let scene = scene(bench.harness.state_mut());
    let lamp = scene.world.find(name).unwrap();
    scene.world.get::<Light>(lamp).unwrap().intensity
}

fn button(bench: &mut Bench, label: &str) {
    let found = |bench: &mut Bench, scroll: bool| {
        let node = bench.harness.get_by_role_and_label(Role::Button, label);
        if scroll {
            node.scroll_to_me();
        } else {
            node.click();
        }
        bench.harness.run_steps(3);
    };
    found(bench, true);
    found(bench, false);
}

/// Types a number into a field of the entity that is chosen.
fn type_number(bench: &mut Bench, label: &str, number: &str) {
    let field = bench.harness.get_by_role_and_label(Role::SpinButton, label);
    field.scroll_to_me();
    bench.harness.run_steps(3);
    bench
        .harness
        .get_by_role_and_label(Role::SpinButton, label)
        .click();
    bench.harness.run_steps(2);
    bench
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::A);
    bench.harness.event(egui::Event::Text(number.to_owned()));
    bench.harness.run_steps(1);
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(2);
}

#[test]
fn a_field_is_changed_by_hand_marked_laid_on_again_and_reset() {
    let mut bench = Bench::open();
    open(&mut bench, LAMPS);
    show(&mut bench, Panel::Entities);
    let before = bench.picture();
    bench.harness.get_by_label("still").click();
    bench.harness.run_steps(3);
    type_number(&mut bench, "Intensity", "40");
    assert_eq!(intensity(&mut bench, "still"), 40.0);
    let bright = bench.until_picture_is_not(&before);
    assert_eq!(bench.count("Changed by hand. The script's value: 5"), 1);
    let deed = bench.last_deed();
    assert_eq!(deed.line, "entity(\"still\").intensity(40.0);");
    assert_eq!(deed.script, Script::Scene);
    assert_eq!(bench.copied_by("Copy"), deed.line);

    // The script says something else, then has no such lamp, then has it again.
    reload(&mut bench, &LAMPS.replace("intensity(5)", "intensity(7)"));
    assert_eq!(intensity(&mut bench, "still"), 40.0);
    assert_eq!(bench.count("The script's value: 7"), 1);
    reload(&mut bench, &LAMPS.replace("\"still\"", "\"other\""));
    assert_eq!(intensity(&mut bench, "other"), 5.0);
    assert_eq!(
        bench.count("still: light.intensity"),
        1,
        "it is listed as waiting"
    );
    reload(&mut bench, LAMPS);
    assert_eq!(intensity(&mut bench, "still"), 40.0);
    assert_eq!(bench.picture(), bright);

    bench.harness.get_by_label("still").click();
    bench.harness.run_steps(2);
    button(&mut bench, "Reset");
    assert_eq!(intensity(&mut bench, "still"), 5.0);
    assert_eq!(bench.until_picture_is_not(&bright), before);
    assert_eq!(bench.count("Changed by hand"), 0);
    assert_eq!(bench.count("No field is changed by hand"), 1);
    assert_eq!(bench.last_deed().line, "entity(\"still\").intensity(5.0);");
}

#[test]
fn what_was_changed_wins_over_a_script_that_writes_it_and_the_panel_says_so() {
    let mut bench = Bench::open();
    open(&mut bench, LAMPS);
    show(&mut bench, Panel::Entities);
    bench.harness.get_by_label("busy").click();
    bench.harness.run_steps(3);
    type_number(&mut bench, "Intensity", "40");
    type_number(&mut bench, "Range", "9");
    bench.harness.state_mut().workbench.step();
    bench.harness.run_steps(3);
    assert_eq!(intensity(&mut bench, "busy"), 40.0);
    assert_eq!(bench.count("writes it too"), 1, "of two changed fields");
    let lines = bench.harness.state().workbench.overlay_lines();
    assert_eq!(
        lines,
        "entity(\"busy\").intensity(40.0);\nentity(\"busy\").set(\"light.range\", 9.0);"
    );
    button(&mut bench, "Reset entity");
    let now = intensity(&mut bench, "busy");
    assert!((3.0..4.0).contains(&now), "{now}");
    assert_eq!(bench.count("No field is changed by hand"), 1);

    type_number(&mut bench, "Range", "9");
    button(&mut bench, "Reset all");
    assert!(
        bench
            .harness
            .state()
            .workbench
            .overlays_now()
            .unwrap()
            .is_empty()
    );
}

#[test]
fn the_filter_finds_one_of_twenty_thousand_and_only_rows_in_sight_are_drawn() {
    let mut bench = Bench::open();
    open(
        &mut bench,
        "let group = spawn(\"group\"); \
         for i in 0..20000 { let t = spawn(`thing ${i}`); if i % 2 == 0 { t.parent(group); } } \
         spawn(); camera(\"eye\");",
    );
    show(&mut bench, Panel::Entities);
    let rows = |bench: &Bench| {
        let named = bench.harness.query_all_by_label_contains("thing ");
        named.count()
    };
    let shown = rows(&bench);
    assert!((3..60).contains(&shown), "{shown} rows are drawn");
    assert_eq!(bench.count("20003 of 20003 entities"), 1);
    // A frame with the list takes little longer than one without it. The shortest of several, because
    // other programs only make them longer.
    let time = |bench: &mut Bench| {
        let frames = (0..15).map(|_| {
            let began = Instant::now();
            bench.harness.step();
            began.elapsed()
        });
        frames.min().unwrap()
    };
    let with = time(&mut bench);
    show(&mut bench, Panel::Scene);
    let without = time(&mut bench);
    println!("a frame takes {with:?} with the list of 20,003 entities, {without:?} without it");
    assert!(
        with < without + Duration::from_millis(8),
        "{with:?} with the list, {without:?} without"
    );
    show(&mut bench, Panel::Entities);
    bench
        .harness
        .get_by_role_and_label(Role::TextInput, "Filter")
        .focus();
    bench.harness.run_steps(2);
    bench
        .harness
        .event(egui::Event::Text("THING 1234".to_owned()));
    bench.harness.run_steps(3);
    assert_eq!(bench.count("11 of 20003 entities"), 1);
    bench.harness.get_by_label("thing 1234").click();
    bench.harness.run_steps(2);
    assert!(bench.count("Translation") >= 1);
}

#[test]
fn an_entity_without_a_name_says_why_it_can_not_be_changed() {
    let mut bench = Bench::open();
    open(&mut bench, "spawn(); camera(\"eye\");");
    show(&mut bench, Panel::Entities);
    // The file that was just written is told of once more, and loaded again. What was chosen is found
    // again by its name, and this one has none.
    let why = "What is changed by hand is kept by name";
    for _ in 0..100 {
        bench.harness.get_by_label_contains("(no name").click();
        bench.harness.run_steps(2);
        if bench.count(why) > 0 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(bench.count(why) > 0);
    let fields = bench
        .harness
        .query_all_by_role_and_label(Role::SpinButton, "Translation");
    assert_eq!(fields.count(), 0);
}

/// Everything that a scene has: its entities, and what its scripts remember.
fn everything(bench: &mut Bench) -> (String, String, f64) {
    let time = bench.harness.state().workbench.clock.time();
    let scene = scene(bench.harness.state_mut());
    // The numbers of a saved scene are given once.
    let text = scene.to_text().unwrap();
    let state = scene.evaluate("[state.steps, values(\"height\")]").unwrap();
    (text, state.unwrap(), time)
}

#[test]
fn stop_gives_back_world_script_state_picture_and_time() {
    let mut bench = Bench::open();
    open(&mut bench, LAMPS);
    everything(&mut bench);
    let before = everything(&mut bench);
    let picture = bench.picture();
    assert!(!bench.harness.state().workbench.is_in_play());

    let mut played = Vec::new();
    for _ in 0..2 {
        button(&mut bench, "Play");
        bench.until("some time", |editor| editor.workbench.clock.time() > 0.3);
        button(&mut bench, "Pause");
        assert_ne!(everything(&mut bench), before);
        assert_ne!(bench.picture(), picture);
        // Hands and lines while it plays.
        let workbench = &mut bench.harness.state_mut().workbench;
        workbench
            .evaluate("spawn(\"new\"); state.steps = 99;")
            .unwrap();
        button(&mut bench, "Stop");
        assert_eq!(everything(&mut bench), before);
        assert_eq!(bench.picture(), picture);
        assert!(!bench.harness.state().workbench.is_in_play());
        // The same steps give the same again: the row of random numbers was taken back too.
        bench.harness.key_press(Key::Period);
        bench.harness.run_steps(2);
        played.push((everything(&mut bench), bench.picture()));
        bench.harness.state_mut().workbench.stop();
        bench.harness.run_steps(2);
    }
    assert_eq!(played[0], played[1]);
    assert_eq!(everything(&mut bench), before);
}

#[test]
fn stop_keeps_what_was_changed_by_hand_and_a_new_script() {
    let mut bench = Bench::open();
    open(&mut bench, LAMPS);
    let set = |bench: &mut Bench, name: &str, value: f32| {
        let lamp = scene(bench.harness.state_mut()).world.find(name).unwrap();
        let workbench = &mut bench.harness.state_mut().workbench;
        let value = Value::Float(value);
        workbench.set_field(lamp, "light.intensity", value).unwrap();
    };
    set(&mut bench, "still", 20.0);
    let step = |bench: &mut Bench| {
        bench.harness.state_mut().workbench.step();
        bench.harness.run_steps(2);
    };
    step(&mut bench);
    // One change more and one less while it plays.
    set(&mut bench, "busy", 30.0);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.reset_field("still", "light.intensity");
    workbench.stop();
    bench.harness.run_steps(2);
    assert_eq!(intensity(&mut bench, "still"), 5.0);
    assert_eq!(intensity(&mut bench, "busy"), 30.0);

    // A script that is saved while it plays is what stop goes back to.
    step(&mut bench);
    step(&mut bench);
    reload(&mut bench, &LAMPS.replace("intensity(5)", "intensity(7)"));
    step(&mut bench);
    bench.harness.state_mut().workbench.stop();
    bench.harness.run_steps(2);
    assert_eq!(intensity(&mut bench, "still"), 7.0);
    assert_eq!(bench.harness.state().workbench.clock.time(), 0.0);
}

#[test]
fn each_action_is_a_line_that_does_the_same() {
    let mut bench = Bench::open();
    // The editor shows the script the beginning of time once more than an experiment does, so nothing
    // may depend on how often it is called.
    let lamps = LAMPS
        .replace(" + ROW.float()", "")
        .replace("intensity(5)", "intensity(param(\"power\", 5.0, 0, 90))");
    open(&mut bench, &lamps);
    // The camera, as a line of the scene's script.
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench
        .camera
        .orbit(lightbench::world::glam::Vec2::new(0.3, 0.1));
    bench.harness.run_steps(2);
    let line = bench.last_deed().line;
    assert!(line.starts_with("entity(\"eye\").at("), "{line}");
    let view = bench.harness.state().workbench.camera.view();
    let picture = bench.picture();
    bench
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::Home);
    bench.harness.run_steps(2);
    assert_eq!(bench.last_deed().what, "the scene's own camera again");
    reload(&mut bench, &format!("{lamps}\n{line}"));
    let from_script = bench.harness.state().workbench.camera.view();
    assert!(from_script.view.abs_diff_eq(view.view, 1e-4));
    let moved = bench.picture();
    let difference = moved
        .iter()
        .zip(&picture)
        .map(|(a, b)| u64::from(a.abs_diff(*b)));
    assert!(difference.sum::<u64>() < moved.len() as u64 / 100);
    reload(&mut bench, &lamps);

    // Pipeline, its parameters and time, as lines of experiments that draw the picture on screen.
    bench.choose("Pipeline", "Forward, single pass");
    bench.until("the other pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
    let mut lines = vec![(bench.last_deed().line, bench.picture())];
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_pipeline_parameter("exposure", Some(1.5.into()));
    let bright = bench.until_picture_is_not(&lines[0].1);
    lines.push((bench.last_deed().line, bright));
    bench.harness.key_press(Key::Period);
    bench.harness.run_steps(3);
    let deed = bench.last_deed();
    assert_eq!(deed.script, Script::Experiment);
    assert!(deed.line.contains("frame: 1"), "{}", deed.line);
    let stepped = bench.picture();
    lines.push((deed.line, stepped));
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_scene_parameter("power", Some(33.5.into()));
    let swaps = workbench.scenes.swaps();
    bench.until("the brighter lamp", |editor| {
        editor.workbench.scenes.swaps() > swaps
    });
    bench.harness.run_steps(2);
    assert_eq!(intensity(&mut bench, "still"), 33.5);
    lines.push((bench.last_deed().line, bench.picture()));
    button(&mut bench, "Stop");
    let deed = bench.last_deed();
    assert_eq!(deed.what, "the frame from which time ran");
    assert!(!deed.line.contains("frame: "), "{}", deed.line);
    lines.push((deed.line, bench.picture()));
    bench.choose("Scene", "Cornell box");
    bench.until("the other scene", |editor| {
        editor.workbench.scenes.shown() == Some("cornell_box")
    });
    bench.harness.run_steps(2);
    lines.push((bench.last_deed().line, bench.picture()));
    for (line, picture) in lines {
        assert_eq!(drawn(&bench, &line), picture, "{line}");
    }

    show(&mut bench, Panel::Actions);
    assert!(bench.count("experiment: one step further") > 0);
    let copied = bench.copied_by("Copy all");
    assert!(copied.lines().count() > 4, "{copied}");
    // The lines of the scene's script are one.
    let script: Vec<&str> = copied
        .lines()
        .filter(|l| l.contains("// scene script"))
        .collect();
    let (settings, progress) = (Settings::new(), Progress::new());
    save(&bench, &format!("{LAMPS}\n{}", script.join("\n")));
    load_scene(&bench.files, "lamps", &settings, &progress).unwrap();
}

/// The bytes of the picture that an experiment's line draws.
fn drawn(bench: &Bench, line: &str) -> Vec<u8> {
    bench.run_experiment(&format!(
        "{line}\nframe.target(frame.output).save(\"out/drawn.png\");"
    ));
    let path = bench.files.project().unwrap().join("out/drawn.png");
    image::open(path).unwrap().to_rgba8().into_raw()
}

#[test]
fn curves_are_drawn_read_and_gone_after_a_reload() {
    let mut bench = Bench::open();
    open(&mut bench, LAMPS);
    show(&mut bench, Panel::Plots);
    for _ in 0..5 {
        bench.harness.state_mut().workbench.step();
        bench.harness.run_steps(1);
    }
    bench.harness.run_steps(2);
    assert_eq!(bench.count("height"), 1);
    let chart = bench
        .harness
        .get_by_role_and_label(Role::Image, "Curves")
        .rect();
    bench
        .harness
        .hover_at(egui::pos2(chart.right() - 10.0, chart.center().y));
    bench.harness.run_steps(2);
    let last = 5.0 / 60.0;
    assert_eq!(bench.count(&format!("height {:.3}", 1.0 + last)), 1);
    // Hidden, it is not read.
    bench
        .harness
        .get_by_role_and_label(Role::CheckBox, "height")
        .click();
    bench.harness.run_steps(2);
    assert_eq!(bench.count("height "), 0);
    reload(
        &mut bench,
        &LAMPS.replace("plot(\"height\", 1 + time);", ""),
    );
    assert_eq!(bench.count("draws a curve here"), 1);
    // Experiments read the same values.
    save(&bench, LAMPS);
    let said = bench.run_experiment(
        "let frame = draw(\"lamps\", \"deferred_shading\", #{ frame: 5, size: [32, 18] });
         print(frame.values(\"height\").len()); print(frame.values(\"height\")[4]);",
    );
    assert_eq!(
        said,
        ["5".to_owned(), format!("{:?}", 1.0 + 5.0 * (1.0 / 60.0))]
    );
}

#[test]
fn the_texture_of_the_picture_is_what_is_compared() {
    // `drawn` reads a file, `picture` a texture: both have the same bytes.
    let mut bench = Bench::open();
    let line = lightbench::script::draw_line(&bench.harness.state().workbench.shot());
    let picture = bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.picture().unwrap().texture;
    assert_eq!(read_bytes(workbench.gpu(), &texture).unwrap(), picture);
    assert_eq!(drawn(&bench, &line), picture);
}
