//! The gallery, the first start, and files that are asked for.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::assets::files::PROJECT_MARKER;

use ui_support::{Bench, CTRL};

fn menu(bench: &mut Bench, menu: &str, entry: &str) {
    bench.press(menu);
    bench
        .harness
        .get_by(|node| {
            let label = node.label().unwrap_or_default();
            node.role() == Role::Button && label.starts_with(entry)
        })
        .click();
    bench.harness.run_steps(3);
}

fn open_gallery(bench: &mut Bench) {
    menu(bench, "File", "Gallery");
    // Until pictures and examples are there or can't be.
    bench.until("the gallery", |editor| {
        !editor.gallery.shown().is_empty() && !editor.gallery.thumbnails.is_busy()
    });
    bench.harness.run_steps(3);
}

/// Clicks what lies in the window of the gallery.
fn press_in_gallery(bench: &mut Bench, label: &str) {
    let all = bench
        .harness
        .query_all_by_role_and_label(Role::Button, label);
    all.last().unwrap().click();
    bench.harness.run_steps(3);
}

#[test]
fn the_gallery_shows_pictures_and_opens_scenes_pipelines_and_copies() {
    let pictures = tempfile::tempdir().unwrap();
    let mut bench = Bench::open();
    let thumbnails = &mut bench.harness.state_mut().gallery.thumbnails;
    thumbnails.folder = Some(pictures.path().to_owned());
    bench.harness.state_mut().gallery.filter = "layers".to_owned();
    open_gallery(&mut bench);
    assert_eq!(bench.count("is being drawn"), 0);
    let kept: Vec<String> = std::fs::read_dir(pictures.path())
        .unwrap()
        .map(|file| file.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(
        kept.len(),
        2,
        "a picture and what it was made from: {kept:?}"
    );
    let picture = kept.iter().find(|name| name.ends_with(".png")).unwrap();
    let picture = image::open(pictures.path().join(picture))
        .unwrap()
        .to_rgb8();
    assert_eq!(picture.dimensions(), (320, 180));
    let colors: std::collections::BTreeSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colors.len() > 100, "{} colours", colors.len());

    let first = bench.picture();
    let title = {
        let editor = bench.harness.state();
        editor.gallery.shown()[0].title.clone()
    };
    press_in_gallery(&mut bench, &title);
    bench.until("the scene", |editor| {
        editor.workbench.scenes.shown() == Some("layers")
    });
    bench.until_picture_is_not(&first);
    assert!(!bench.harness.state().gallery.is_open);

    // A copy can be edited.
    menu(&mut bench, "File", "Gallery");
    press_in_gallery(&mut bench, "Copy into the project");
    let project = bench.files.project().unwrap().to_owned();
    let copy = project.join("scripts/scenes/layers.rhai");
    assert!(copy.is_file());
    let shown = bench.harness.state().code.shown().unwrap();
    assert_eq!(shown.path, "scripts/scenes/layers.rhai");
    assert!(!shown.is_shipped());

    // Pipelines are chosen by a click as well.
    bench.harness.state_mut().gallery.filter = "tiled forward".to_owned();
    menu(&mut bench, "File", "Gallery");
    bench.press("Pipelines");
    let title = bench.harness.state().gallery.shown()[0].title.clone();
    press_in_gallery(&mut bench, &title);
    bench.until("the pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("tiled_forward")
    });
}

#[test]
fn the_first_start_says_what_to_try_and_the_second_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let kept = folder.path().join("editor.json");
    let mut bench = Bench::open_with(Some(kept.clone()));
    assert_eq!(bench.count("Welcome to Lightbench"), 1);
    bench.press("Edit the script");
    assert_eq!(bench.count("Welcome to Lightbench"), 0);
    let shown = bench.harness.state().code.shown().unwrap();
    assert_eq!(shown.path, "scripts/scenes/cornell_box.rhai");
    bench.close();

    let mut bench = Bench::open_with(Some(kept));
    assert_eq!(bench.count("Welcome to Lightbench"), 0);
    menu(&mut bench, "Help", "Welcome");
    assert_eq!(bench.count("Welcome to Lightbench"), 1);
}

/// Asks by a key for a path and types it.
fn answer(bench: &mut Bench, path: &str) {
    bench.key(CTRL, Key::A);
    bench.type_text(path);
    bench.key(Modifiers::NONE, Key::Enter);
}

#[test]
fn scenes_and_projects_are_opened_and_saved_by_paths_where_there_is_no_dialog() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open();
    let saved = folder.path().join("saved");
    bench.key(CTRL | Modifiers::SHIFT, Key::S);
    answer(&mut bench, saved.to_str().unwrap());
    let saved = saved.with_extension("scene");
    let text = std::fs::read_to_string(&saved).unwrap();
    assert!(text.contains("short block"), "the entities are in it");

    bench.key(CTRL, Key::O);
    answer(&mut bench, "/there/is/no/such.scene");
    assert_eq!(bench.count("Open a scene"), 1, "it asks again");
    assert!(bench.count("no such file") >= 1);
    answer(&mut bench, saved.to_str().unwrap());
    bench.until("the saved scene", |editor| {
        editor.workbench.scenes.shown() == Some("@0/saved.scene")
    });

    // A new folder becomes a project, and the files are read from there.
    let project = folder.path().join("project");
    menu(&mut bench, "File", "Open a project");
    answer(&mut bench, project.to_str().unwrap());
    assert!(project.join(PROJECT_MARKER).is_file());
    let files = bench.harness.state().workbench.files().clone();
    assert_eq!(files.project().unwrap(), project.canonicalize().unwrap());
    bench.until("the atrium", |editor| {
        editor.workbench.scenes.shown() == Some("atrium") && editor.workbench.picture_ready()
    });
    let first = bench.picture();
    let shader = files.copy_to_project("shaders/output.wgsl").unwrap();
    let text = std::fs::read_to_string(&shader).unwrap();
    let darker = text.replace("exp2(parameters.exposure)", "0.2");
    assert_ne!(darker, text);
    std::fs::write(&shader, darker).unwrap();
    bench.until_picture_is_not(&first);
}
