//! Views as lines of text, reports of what is on the screen, and the notebook.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::Path;
use std::process::Command;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable as _;
use lightbench::lab::diff::{DiffOptions, diff_ldr};
use lightbench::lab::{LdrImage, Picture};
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::comparing::Mode;
use lightbench_editor::viewpoint::plan::Effort;

use ui_support::Bench;

/// A scene that moves by time, and by how it was stepped.
const MOVES: &str = r#"
const WIDTH = param("width", 1.0, 0.5, 3, "How wide the box is");
let paint = material("paint").color(0.8, 0.5, 0.3).specular(0.04).power(40);
spawn("floor").mesh(plane(6, 6)).material(paint);
spawn("box").mesh(box(WIDTH, 1, 1)).material(paint);
spawn("ball").mesh(sphere(0.4)).material(paint);
point_light("lamp").at(1, 2.5, 2).color(1, 0.9, 0.8).intensity(4).range(8);
ambient_light("sky").color(0.4, 0.5, 0.7).intensity(0.2);
camera("main").at(0, 2, 5).look_at(0, 0.5, 0).fov(50);
state.way = 0.0;
fn update(time, dt) {
    state.way += dt * (1.0 + state.way);
    entity("box").at(time, 0.6, 0);
    entity("ball").at(-1.0 - state.way, 0.4, 1);
}
"#;

fn press(bench: &mut Bench, modifiers: Modifiers, key: Key) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(2);
}

fn click(bench: &mut Bench, label: &str) {
    // By the reader of the screen: it may be below what is seen of its panel.
    let button = bench.harness.get_by_role_and_label(Role::Button, label);
    button.click_accesskit();
    bench.harness.run_steps(2);
}

/// What the button of the panel copies.
fn copied_view(bench: &mut Bench) -> String {
    bench.show(Panel::Compare);
    bench.copied_by("Copy view")
}

/// Runs the program in the project.
fn run(bench: &Bench, arguments: &[&str]) -> std::process::Output {
    let program = env!("CARGO_BIN_EXE_lightbench");
    let mut command = Command::new(program);
    command.arg("--project").arg(bench.path()).args(arguments);
    command.output().unwrap()
}

/// Draws a view by the command line.
fn rendered(bench: &Bench, view: &str, file: &str) -> LdrImage {
    let out = bench.path().join(file);
    let out = out.to_str().unwrap();
    let output = run(bench, &["render", "--view", view, "--out", out]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    open(Path::new(out))
}

fn open(path: &Path) -> LdrImage {
    match Picture::open(path).unwrap() {
        Picture::Ldr(picture) => picture,
        Picture::Hdr(_) => panic!("a PNG has eight bits"),
    }
}

fn select_scene(bench: &mut Bench, text: &str) {
    bench.save("scripts/scenes/moves.rhai", text);
    bench.harness.state_mut().workbench.select_scene("moves");
    bench.until("the scene", |editor| {
        let problems: Vec<String> = editor
            .workbench
            .problems()
            .map(ToString::to_string)
            .collect();
        assert!(problems.is_empty(), "{problems:?}");
        editor.workbench.scenes.shown() == Some("moves") && !editor.workbench.scenes.is_busy()
    });
    // The watcher tells of the file a little later, and the scene is loaded once more.
    let swaps = bench.harness.state().workbench.scenes.swaps();
    let begun = std::time::Instant::now();
    bench.until("the watcher", |editor| {
        editor.workbench.scenes.swaps() > swaps || begun.elapsed().as_secs() > 2
    });
}

/// Orbits with the mouse, and steps by the button of the toolbar.
fn move_about(bench: &mut Bench) {
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let from = viewport.rect().center() + vec2(-120.0, 60.0);
    for (pressed, at) in [(true, from), (false, from + vec2(70.0, -25.0))] {
        bench.harness.hover_at(at);
        bench.harness.step();
        bench.harness.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        bench.harness.step();
    }
    for _ in 0..7 {
        bench
            .harness
            .get_by_role_and_label(Role::Button, "Step")
            .click();
        bench.harness.run_steps(2);
    }
}

#[test]
fn the_command_line_draws_the_view_that_was_copied() {
    let mut bench = Bench::open();
    select_scene(&mut bench, MOVES);
    if bench.harness.state().workbench.clock.playing {
        press(&mut bench, Modifiers::NONE, Key::Space);
    }
    // From the beginning, as a view begins.
    let text = copied_view(&mut bench);
    let begin = text.split(" time=").next().unwrap();
    press(&mut bench, Modifiers::COMMAND, Key::G);
    bench.harness.event(Event::Text(begin.to_owned()));
    bench.harness.run_steps(2);
    click(&mut bench, "Go there");
    bench.until("the beginning", |editor| !editor.workbench.is_arriving());
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_scene_parameter("width", Some(2.0.into()));
    workbench.set_pipeline_parameter("exposure", Some(0.7.into()));
    bench.until("the wider box", |editor| {
        !editor.workbench.scenes.is_busy() && !editor.workbench.pipelines.is_busy()
    });
    let before = bench.picture();
    move_about(&mut bench);
    let after = bench.until_picture_is_not(&before);
    assert!(bench.harness.state().workbench.camera.is_moved());

    let text = copied_view(&mut bench);
    assert!(
        text.contains(" camera=free ") && text.contains("scene.width=2"),
        "{text}"
    );
    assert_eq!(text.lines().count(), 1);
    let drawn = rendered(&bench, &text, "view.png");
    let (width, height) = bench.harness.state().workbench.drawn_size().unwrap();
    assert_eq!((drawn.width, drawn.height), (width, height));
    assert!(
        drawn.pixels.as_flattened() == after.as_slice(),
        "the pictures differ"
    );

    // Elsewhere, and back by pasting.
    bench
        .harness
        .state_mut()
        .workbench
        .select_scene("cornell_box");
    bench.until("another scene", |editor| {
        editor.workbench.scenes.shown() == Some("cornell_box")
    });
    let elsewhere = bench.picture();
    assert_ne!(elsewhere, after);
    bench.harness.event(Event::Paste(text.clone()));
    bench.until("the view", |editor| {
        editor.workbench.scenes.shown() == Some("moves")
            && !editor.workbench.is_arriving()
            && !editor.workbench.pipelines.is_busy()
            && editor.workbench.picture_is_current()
    });
    assert_eq!(copied_view(&mut bench), text);
    assert!(
        bench.picture() == after,
        "the picture is not the same after pasting"
    );

    // From the front, without perspective, too.
    press(&mut bench, Modifiers::COMMAND, Key::Num2);
    let front = bench.until_picture_is_not(&after);
    let text = copied_view(&mut bench);
    assert!(text.contains("camera=front"), "{text}");
    let drawn = rendered(&bench, &text, "front.png");
    assert!(drawn.pixels.as_flattened() == front.as_slice());
}

#[test]
fn a_bad_view_is_explained_and_changes_nothing() {
    let mut bench = Bench::open();
    let before = bench.picture();
    press(&mut bench, Modifiers::COMMAND, Key::G);
    bench
        .harness
        .event(Event::Text("lightbench-view-9 scene=a".to_owned()));
    bench.harness.run_steps(2);
    press(&mut bench, Modifiers::NONE, Key::Enter);
    assert!(bench.count("version 9 of its format") > 0);
    click(&mut bench, "Close");
    assert_eq!(bench.count("Paste a view"), 0);
    // One that leads outside of the project.
    let outside = "lightbench-view-1 scene=/etc/room.rhai pipeline=deferred_shading";
    bench.harness.event(Event::Paste(outside.to_owned()));
    bench.harness.run_steps(2);
    assert!(bench.count("outside of the project") > 0);
    assert_eq!(bench.picture(), before);

    let output = run(
        &bench,
        &[
            "render",
            "--view",
            "lightbench-view-9 scene=a",
            "--out",
            "x.png",
        ],
    );
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.contains("version 9 of its format"), "{error}");
    let nowhere = "lightbench-view-1 scene=cornell_box pipeline=deferred_shading camera=named \
                   camera.name=nobody";
    let output = run(&bench, &["render", "--view", nowhere, "--out", "x.png"]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.contains("no camera `nobody`"), "{error}");
}

/// Compares deferred shading with itself, darker, and waits for the numbers.
fn compare(bench: &mut Bench) {
    press(bench, Modifiers::NONE, Key::C);
    click(bench, "Give B what A has");
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_other_parameter("exposure", Some((-1.0).into()));
    bench.until("the numbers", |editor| {
        let workbench = &editor.workbench;
        let side = workbench.comparing.side().unwrap();
        let judged = workbench.judgement();
        !side.pipelines.is_busy()
            && !side.pipelines.is_warming()
            && workbench.picture_is_current()
            && !workbench.comparing.is_waiting()
            && judged.is_some_and(|judged| judged.frames_ago == 0)
    });
}

#[test]
fn the_numbers_are_those_of_the_command_line() {
    let mut bench = Bench::open();
    compare(&mut bench);
    let workbench = &bench.harness.state().workbench;
    let (first, second) = (
        workbench.viewpoint().unwrap().to_string(),
        workbench.other_viewpoint().unwrap().to_string(),
    );
    let found = workbench.judgement().unwrap().judged.difference.clone();
    rendered(&bench, &first, "a.png");
    rendered(&bench, &second, "b.png");
    let paths = ["a.png", "b.png"].map(|file| bench.path().join(file));
    let [a, b] = [&paths[0], &paths[1]].map(|path| path.to_str().unwrap());
    let output = run(&bench, &["diff", a, b, "--json"]);
    assert!(output.status.success());
    let said: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let said: lightbench::lab::diff::LdrDifference =
        serde_json::from_value(said["difference"].clone()).unwrap();
    assert!(found.flip.mean > 0.01, "there is a difference");
    assert_eq!(said, found);

    // FLIP over the picture: its least colour is the map's black where nothing differs.
    bench.harness.state_mut().workbench.comparing.mode = Mode::Flip;
    bench.harness.run_steps(3);
    let mean = format!("FLIP {:.4} in the mean", found.flip.mean);
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.shown_picture().unwrap();
    let bytes = lightbench::render::readback::read_bytes(workbench.gpu(), &texture).unwrap();
    let images = [&paths[0], &paths[1]].map(|path| open(path));
    let map = diff_ldr(&images[0], &images[1], DiffOptions::default())
        .unwrap()
        .map;
    let magma = lightbench::lab::colormap::ColorMap::Magma;
    let painted = lightbench::lab::heatmap::heat_map(&map, magma, 1.0);
    assert!(painted.pixels.as_flattened() == bytes.as_slice(), "{mean}");
}

#[test]
fn a_report_of_what_is_on_the_screen_is_written_into_the_project() {
    let mut bench = Bench::open();
    move_about(&mut bench);
    compare(&mut bench);
    bench.harness.state_mut().workbench.reporting.effort = Effort {
        warmup: 0,
        frames: 1,
        processes: 1,
        seconds: 0.1,
    };
    click(&mut bench, "Report of what is on screen");
    assert!(
        bench
            .harness
            .state()
            .workbench
            .reporting
            .progress()
            .is_some()
    );
    assert!(bench.count("Stop the report") > 0);
    bench.until("the report", |editor| {
        editor.workbench.reporting.progress().is_none()
    });
    bench.harness.run_steps(2);
    let reporting = &bench.harness.state().workbench.reporting;
    let report = reporting.last().unwrap().clone().unwrap();
    assert!(
        report
            .folder
            .starts_with(bench.path().canonicalize().unwrap().join("reports"))
    );
    assert!(report.page.is_file());
    assert!(bench.count("Open the report") > 0);
    let json = std::fs::read_to_string(report.folder.join("report.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let plan = &json["plan"];
    let (width, height) = bench.harness.state().workbench.drawn_size().unwrap();
    assert_eq!(plan["size"], serde_json::json!([width, height]));
    let command = json["points"][0]["comparison"]["command_line"]
        .as_str()
        .unwrap();
    assert!(
        command.starts_with("lightbench compare --view 'lightbench-view-1 "),
        "{command}"
    );

    // The pictures are those of the screen, but for the camera's last bits.
    let picture = bench.picture();
    let pixels = picture.as_chunks::<4>().0.to_vec();
    let screen = LdrImage::new(width, height, pixels).unwrap();
    let pipelines = json["points"][0]["comparison"]["pipelines"]
        .as_array()
        .unwrap();
    assert_eq!(pipelines.len(), 2);
    let file = pipelines[0]["picture_file"].as_str().unwrap_or_else(|| {
        panic!(
            "{:?}",
            pipelines[0].as_object().unwrap().keys().collect::<Vec<_>>()
        )
    });
    let drawn = open(&report.folder.join(file));
    let difference = diff_ldr(&screen, &drawn, DiffOptions::default())
        .unwrap()
        .difference;
    assert!(difference.srgb.share_different < 0.001, "{difference:?}");
}

#[test]
fn a_report_can_be_stopped_and_the_editor_goes_on() {
    let mut bench = Bench::open();
    press(&mut bench, Modifiers::NONE, Key::C);
    click(&mut bench, "Report of what is on screen");
    click(&mut bench, "Stop the report");
    bench.until("the end", |editor| {
        editor.workbench.reporting.progress().is_none()
    });
    bench.harness.run_steps(2);
    assert!(bench.count("No report: it was stopped") > 0);
    bench.picture();
}

#[test]
fn the_notebook_keeps_restores_exports_and_deletes() {
    let mut bench = Bench::open();
    move_about(&mut bench);
    compare(&mut bench);
    bench.show(Panel::Notebook);
    let field = bench.harness.get_by_role_and_label(Role::TextInput, "Note");
    field.focus();
    bench.harness.run_steps(2);
    bench.harness.event(Event::Text("a darker B".to_owned()));
    bench.harness.run_steps(2);
    click(&mut bench, "Keep this measurement");
    bench.until("the entry", |editor| {
        editor.workbench.notebook.entries().len() == 1 && !editor.workbench.notebook.is_busy()
    });
    bench.harness.run_steps(2);
    let kept = bench.harness.state().workbench.notebook.entries()[0].clone();
    assert_eq!(kept.unsaved, None);
    let entry = kept.entry;
    assert_eq!(entry.note, "a darker B");
    assert_eq!(entry.costs.len(), 2);
    assert!(entry.difference.unwrap().flip_mean > 0.0 && entry.machine.is_some());
    let folder = bench.path().join("notebook");
    let shown = {
        let workbench = &mut bench.harness.state_mut().workbench;
        let texture = workbench.shown_picture().unwrap();
        lightbench::render::readback::read_bytes(workbench.gpu(), &texture).unwrap()
    };
    let picture = open(&folder.join(entry.picture()));
    assert!(picture.pixels.as_flattened() == shown.as_slice());

    click(&mut bench, "Export Markdown");
    let page = std::fs::read_to_string(folder.join("notebook.md")).unwrap();
    assert!(page.contains("a darker B") && page.contains(&format!("]({})", entry.picture())));

    // Somewhere else, and back with a click.
    press(&mut bench, Modifiers::SHIFT, Key::Home);
    bench.harness.state_mut().workbench.compare(false);
    bench.harness.run_steps(2);
    click(&mut bench, &format!("Go to the view of {}", entry.name));
    bench.until("the view", |editor| {
        !editor.workbench.is_arriving()
            && editor.workbench.comparing.is_on()
            && editor.workbench.viewpoint().is_some()
    });
    let workbench = &bench.harness.state().workbench;
    assert_eq!(workbench.viewpoint().unwrap().to_string(), entry.view);
    bench.until("B", |editor| editor.workbench.other_viewpoint().is_some());
    let workbench = &bench.harness.state().workbench;
    assert_eq!(
        workbench.other_viewpoint().map(|view| view.to_string()),
        entry.view_b
    );

    click(&mut bench, "Delete");
    assert!(folder.join(entry.picture()).is_file(), "it is asked first");
    click(&mut bench, "Keep it");
    assert_eq!(bench.harness.state().workbench.notebook.entries().len(), 1);
    click(&mut bench, "Delete");
    click(&mut bench, "Delete it");
    assert!(
        bench
            .harness
            .state()
            .workbench
            .notebook
            .entries()
            .is_empty()
    );
    assert!(!folder.join(entry.picture()).exists());
}

#[test]
fn an_entry_that_can_not_be_written_is_kept_until_it_can() {
    let mut bench = Bench::open();
    bench.save("notebook", "a file in the folder's place");
    bench.show(Panel::Notebook);
    click(&mut bench, "Keep this measurement");
    bench.until("the entry", |editor| {
        editor.workbench.notebook.entries().len() == 1 && !editor.workbench.notebook.is_busy()
    });
    bench.harness.run_steps(2);
    assert!(bench.count("Only in memory") > 0);
    std::fs::remove_file(bench.path().join("notebook")).unwrap();
    click(&mut bench, "Save again");
    bench.until("the file", |editor| {
        editor.workbench.notebook.entries()[0].unsaved.is_none()
    });
    let name = &bench.harness.state().workbench.notebook.entries()[0]
        .entry
        .name;
    let folder = bench.path().join("notebook");
    assert!(folder.join(format!("{name}.json")).is_file());
    assert!(folder.join(format!("{name}.png")).is_file());
}
