//! Whose the keys are: the editor's, or those of a scene whose scripts hear them.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::time::{Duration, Instant};

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use ui_support::Bench;

const HEARS: &str = "
camera(\"eye\").at(0, 1, 5).look_at(0, 0, 0);
state.heard = \"\";
fn on_key(key) {
    state.heard += key + \" \";
    print(\"heard: \" + state.heard);
    if key == \"9\" { use_pipeline(\"tiled_forward\", #{ tile_size: \"8\" }); }
}
fn update() { }";

/// Opens a scene, lets time run, and puts the pointer over the picture.
fn open(bench: &mut Bench, text: &str) {
    bench.save("scripts/scenes/hears.rhai", text);
    bench.harness.state_mut().workbench.select_scene("hears");
    // The watcher tells of the new file a little later, and a key that is pressed just before the
    // scene is loaded again goes to the scene before.
    let begun = Instant::now();
    bench.until("the scene", |editor| {
        let scenes = &editor.workbench.scenes;
        let is_there = scenes.shown() == Some("hears") && !scenes.is_busy();
        is_there && begun.elapsed() > Duration::from_secs(2)
    });
    assert!(bench.harness.state().workbench.clock.playing);
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let center = viewport.rect().center();
    bench.harness.hover_at(center);
    bench.harness.run_steps(2);
}

fn press(bench: &mut Bench, keys: &[Key]) {
    for key in keys {
        bench.harness.key_press(*key);
        bench.harness.run_steps(2);
    }
}

/// What the scene's script has heard last.
fn heard(bench: &Bench) -> String {
    let lines = bench.harness.state().workbench.log.lines();
    let mut heard = lines.filter_map(|line| line.text.strip_prefix("heard: "));
    heard.next_back().unwrap_or_default().trim_end().to_owned()
}

#[test]
fn over_the_picture_keys_are_the_scenes_and_elsewhere_the_editors() {
    let mut bench = Bench::open();
    open(&mut bench, HEARS);
    let pipeline = bench.shown();
    press(&mut bench, &[Key::Num3, Key::W, Key::Space, Key::F]);
    bench.until("the script", |editor| {
        let mut lines = editor.workbench.log.lines();
        lines.any(|line| line.text == "heard: 3 w space f ")
    });
    assert_eq!(heard(&bench), "3 w space f");
    let workbench = &bench.harness.state().workbench;
    assert_eq!(bench.shown(), pipeline);
    assert!(workbench.clock.playing && !workbench.camera.is_moved());

    // Keys with Ctrl stay the editor's; so do all of them beside the picture.
    bench.harness.hover_at(egui::pos2(3.0, 3.0));
    bench.harness.run_steps(2);
    press(&mut bench, &[Key::Space]);
    assert!(!bench.harness.state().workbench.clock.playing);
    press(&mut bench, &[Key::Num3]);
    bench.until("another pipeline", |editor| {
        editor.workbench.pipelines.selected() != "deferred_shading"
    });
    assert_eq!(heard(&bench), "3 w space f");
}

#[test]
fn a_scene_chooses_its_pipeline_with_values() {
    let mut bench = Bench::open();
    open(&mut bench, HEARS);
    press(&mut bench, &[Key::Num9]);
    bench.until("the pipeline that was asked for", |editor| {
        editor.workbench.pipelines.shown() == Some("tiled_forward")
    });
    let workbench = &bench.harness.state().workbench;
    let slot = workbench.pipelines.slot("tiled_forward").unwrap();
    let size = slot.settings.get("tile_size").map(ToString::to_string);
    assert_eq!(size.as_deref(), Some("8"));
}

#[test]
fn what_a_script_keeps_goes_on_after_a_save() {
    let mut bench = Bench::open();
    let text = "state.keep(\"count\", 40); fn on_key(key) { state.count += 1; print(`count ${state.count}`); }
        fn update() { }";
    open(&mut bench, text);
    let told = |wanted: &'static str| {
        move |editor: &mut lightbench_editor::ui::Editor| {
            let mut lines = editor.workbench.log.lines();
            lines.any(|line| line.text == wanted)
        }
    };
    press(&mut bench, &[Key::X]);
    bench.until("41", told("count 41"));
    let swaps = bench.harness.state().workbench.scenes.swaps();
    bench.save(
        "scripts/scenes/hears.rhai",
        &format!("// Saved again.\n{text}"),
    );
    bench.until("the reload", |editor| {
        editor.workbench.scenes.swaps() > swaps
    });
    press(&mut bench, &[Key::Y]);
    bench.until("42", told("count 42"));
}

/// Every key that the editor may tell a scene of is one that a script may ask for.
#[test]
fn keys_have_the_same_names_for_those_who_hear_them_and_those_who_ask() {
    let mut bench = Bench::open();
    open(&mut bench, "fn update() { }");
    // Keys for players, browsers and the machine itself are nothing to play a scene with.
    let special = [
        "Browser", "Media", "Audio", "Launch", "Copy", "Cut", "Paste", "Fn", "Eject", "Power",
        "Sleep",
    ];
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene_mut().unwrap();
    for key in Key::ALL {
        if !special.iter().any(|prefix| key.name().starts_with(prefix)) {
            let line = format!("key_down(\"{}\")", key.name().to_lowercase());
            scene
                .evaluate(&line)
                .unwrap_or_else(|problem| panic!("{problem}"));
        }
    }
}

/// A frame may take so long that a key is pressed more than once in it.
#[test]
fn each_press_counts_also_where_a_frame_brings_two() {
    let mut bench = Bench::open();
    let entities = |bench: &Bench| {
        let scene = bench.harness.state().workbench.scenes.scene();
        scene.unwrap().world.entities().count()
    };
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let named = scene.world.columns::<lightbench::world::Name>();
    let first = named.entities()[0];
    workbench.selection.set(scene, Some(first));
    bench.harness.run_steps(2);
    let before = entities(&bench);
    let press = |pressed| egui::Event::Key {
        key: Key::D,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: egui::Modifiers::COMMAND,
    };
    let twice = [press(true), press(false), press(true), press(false)];
    bench.harness.input_mut().events.extend(twice);
    bench.harness.run_steps(3);
    assert_eq!(entities(&bench), before + 2);
}
