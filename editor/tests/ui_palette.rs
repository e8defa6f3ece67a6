//! Finding things by name, scenes of late, and files that are dropped onto the window.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{DroppedFile, Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench_editor::ui::workbench::flat::Side;
use lightbench_editor::ui::workbench::sight::Sight;

use ui_support::Bench;

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_file(bench: &mut Bench, path: &Path) {
    let file = Arc::new(Dropped(path.to_owned()));
    bench.harness.input_mut().dropped_files.push(file);
    bench.harness.run_steps(2);
}

fn until_scene(bench: &mut Bench, name: &'static str) {
    bench.until("the scene", move |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some(name) && !editor.workbench.scenes.is_busy()
    });
}

fn key(bench: &mut Bench, key: Key, modifiers: Modifiers) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(3);
}

/// Opens the palette and types into it.
fn find(bench: &mut Bench, text: &str) {
    key(bench, Key::P, Modifiers::COMMAND);
    bench.harness.event(Event::Text(text.to_owned()));
    bench.harness.run_steps(3);
}

fn is_open(bench: &Bench) -> bool {
    let found = bench
        .harness
        .query_all_by_label_contains("Find an action, a scene");
    found.count() > 0
}

fn files_named(folder: &Path, files: &[(&str, &str)]) {
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
}

const OUTSIDE: &str =
    "spawn(\"outsider\").mesh(box(1)); camera(\"eye\").at(0, 1, 4).look_at(0, 0, 0);";

#[test]
fn the_palette_finds_actions_scenes_and_pipelines_by_their_names() {
    let mut bench = Bench::open();
    find(&mut bench, "ortho top");
    assert!(is_open(&bench));
    assert_eq!(bench.count("Front, orthographic"), 0, "it does not fit");
    key(&mut bench, Key::Enter, Modifiers::NONE);
    assert!(!is_open(&bench));
    let sight = bench.harness.state().workbench.sight();
    assert_eq!(sight, Sight::Side(Side::Top));

    // Letters are typed, and do nothing else; arrows choose another line.
    find(&mut bench, "orthographic");
    key(&mut bench, Key::ArrowDown, Modifiers::NONE);
    key(&mut bench, Key::ArrowDown, Modifiers::NONE);
    key(&mut bench, Key::ArrowUp, Modifiers::NONE);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    let sight = bench.harness.state().workbench.sight();
    assert_eq!(sight, Sight::Side(Side::Front));

    find(&mut bench, "single forward pipeline");
    key(&mut bench, Key::Enter, Modifiers::NONE);
    bench.until("the pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });

    find(&mut bench, "no such thing");
    assert_eq!(bench.count("Nothing is called so."), 1);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    assert!(is_open(&bench), "there was nothing to do");
    key(&mut bench, Key::Escape, Modifiers::NONE);
    assert!(!is_open(&bench));

    // Every action is there with its key.
    key(&mut bench, Key::P, Modifiers::COMMAND);
    for entry in ["Undo", "Frame the selection", "Grid and axes", "Console"] {
        assert!(bench.count(entry) >= 1, "{entry}");
    }
    bench.harness.event(Event::Text("perspective".to_owned()));
    bench.harness.run_steps(3);
    bench
        .harness
        .get_by(|node| {
            let label = node.label().unwrap_or_default();
            node.role() == Role::Button && label.starts_with("Perspective")
        })
        .click();
    bench.harness.run_steps(3);
    assert!(!is_open(&bench));
    assert_eq!(bench.harness.state().workbench.sight(), Sight::Perspective);
}

#[test]
fn scenes_of_late_are_kept_over_restarts_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let kept = folder.path().join("editor.json");
    files_named(folder.path(), &[("outside.rhai", OUTSIDE)]);
    let outside = folder.path().join("outside.rhai");
    {
        let mut bench = Bench::open_with(Some(kept.clone()));
        drop_file(&mut bench, &outside);
        until_scene(&mut bench, "@0/outside.rhai");
        bench.harness.run_steps(2);
    }
    let mut bench = Bench::open_with(Some(kept));
    let scenes = bench.harness.state().kept.scenes.clone();
    assert_eq!(scenes, ["cornell_box", outside.to_str().unwrap()]);
    find(&mut bench, "recent outside");
    key(&mut bench, Key::Enter, Modifiers::NONE);
    until_scene(&mut bench, "@0/outside.rhai");
    let world = &bench
        .harness
        .state()
        .workbench
        .scenes
        .scene()
        .unwrap()
        .world;
    assert!(world.find("outsider").is_some());
}

#[test]
fn dropped_scripts_and_models_are_opened_and_others_are_refused_in_the_log() {
    let mut bench = Bench::open();
    let first = bench.picture();
    // A scene of the project goes by its name.
    bench.save("scripts/scenes/inside.rhai", OUTSIDE);
    let project = bench.files.project().unwrap().to_owned();
    drop_file(&mut bench, &project.join("scripts/scenes/inside.rhai"));
    until_scene(&mut bench, "inside");
    let second = bench.until_picture_is_not(&first);

    let folder = tempfile::tempdir().unwrap();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    files_named(
        folder.path(),
        &[("shape.obj", triangle), ("picture.txt", "nothing")],
    );
    drop_file(&mut bench, &folder.path().join("shape.obj"));
    until_scene(&mut bench, "showroom");
    let settings = bench.harness.state().workbench.scenes.settings().unwrap();
    let model = settings.get("model").map(ToString::to_string);
    assert_eq!(model.as_deref(), Some("@0/shape.obj"));
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let has_it = scene
        .assets
        .meshes()
        .iter()
        .any(|mesh| mesh.value.indices.len() == 12);
    assert!(has_it, "the model of four triangles is in the scene");
    bench.until_picture_is_not(&second);

    drop_file(&mut bench, &folder.path().join("picture.txt"));
    assert!(bench.count("is no scene, pipeline or model") >= 1);
    drop_file(&mut bench, &folder.path().join("gone.rhai"));
    assert!(bench.count("gone.rhai") >= 1);
    let shown = bench.harness.state().workbench.scenes.shown();
    assert_eq!(shown, Some("showroom"), "what is shown stays");

    // A pipeline of the project swaps the pipeline, not the scene.
    let (own, _) = bench.own("scripts/pipelines/forward_single_pass.rhai");
    drop_file(&mut bench, &own);
    bench.until("the pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
}
