//! `new`: projects, and pipelines in them.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;
use std::path::Path;

use cli_support::{Project, run_in};

/// The bytes of red, green and blue of a picture, one after the other.
fn colors(path: &Path) -> Vec<u8> {
    let picture = image::ImageReader::open(path).unwrap().decode().unwrap();
    picture.into_rgb8().into_raw()
}

#[test]
fn a_new_pipeline_draws_and_a_second_of_its_name_is_refused() {
    let project = Project::new();
    let new = ["new", "pipeline", "night_vision"];
    let made = project.run(&new).succeeded();
    let mut paths = made.stdout.lines();
    for path in [
        "scripts/pipelines/night_vision.rhai",
        "shaders/night_vision/shade.wgsl",
    ] {
        let file = fs::canonicalize(project.file(path)).unwrap();
        assert_eq!(paths.next(), file.to_str(), "{}", made.all());
        let text = fs::read_to_string(file).unwrap();
        assert!(text.contains("Night vision"), "{text}");
        assert!(!text.contains("NAME") && !text.contains("TITLE"), "{text}");
    }
    // What it says to do next can be done.
    let next = [
        "lightbench check-pipeline night_vision",
        "lightbench render cornell_box --pipeline night_vision --out out/night_vision.png",
        "lightbench edit --pipeline night_vision",
        "lightbench docs pipelines",
    ];
    for line in next {
        assert!(made.stderr.contains(line), "{}", made.all());
    }
    let words = |line: &'static str| line.split(' ').skip(1).collect::<Vec<_>>();
    let checked = project.run(&words(next[0])).succeeded();
    assert!(checked.stdout.contains("no mistakes"), "{}", checked.all());
    project.run(&words(next[1])).succeeded();
    let picture = colors(&project.file("out/night_vision.png"));
    let bright = picture.iter().filter(|value| **value > 16).count();
    assert!(bright * 2 > picture.len(), "{bright} of {}", picture.len());

    // Without what is its own it is forward shading, and its parameter changes the picture.
    let render = |out: &str, more: &[&str]| {
        project.render("tiny", out, more).succeeded();
        colors(&project.file(out))
    };
    let mine = ["--pipeline", "night_vision"];
    let plain = render("plain.png", &[&mine[..], &["--set", "rim=0"]].concat());
    assert_eq!(
        plain,
        render("forward.png", &["--pipeline", "forward_single_pass"])
    );
    assert_ne!(plain, render("rim.png", &mine));

    let text = fs::read_to_string(project.file("scripts/pipelines/night_vision.rhai")).unwrap();
    project
        .run(&new)
        .failed(1, &["night_vision.rhai already", "choose another name"]);
    // The same file on Windows and macOS.
    let capitals = ["new", "pipeline", "NIGHT_Vision"];
    project.run(&capitals).failed(1, &["choose another name"]);
    let after = fs::read_to_string(project.file("scripts/pipelines/night_vision.rhai")).unwrap();
    assert_eq!(text, after);
}

#[test]
fn names_that_hide_something_or_can_be_no_file_are_refused_with_a_way_out() {
    let project = Project::new();
    let new = |name: &str| project.run(&["new", "pipeline", name]);
    new("deferred_shading").failed(
        1,
        &["lightbench copy scripts/pipelines/deferred_shading.rhai"],
    );
    // Its shader would lie among those of other pipelines.
    new("tiled").failed(1, &["shaders/tiled/", "choose another name"]);
    new("lib").failed(1, &["shaders/lib/"]);
    for (name, better) in [
        ("my pipeline", "try `my_pipeline`"),
        ("../up", "try `up`"),
        ("nul", "try `my_nul`"),
        ("mine.rhai", "try `mine`"),
        ("a:b", "try `a_b`"),
        ("", "try `mine`"),
    ] {
        new(name).failed(2, &[better]);
    }
    assert!(!project.file("shaders").exists(), "nothing was made");
    // Letters of any language will do.
    new("iluminación").succeeded();
    let check = ["check-pipeline", "iluminación"];
    project.run(&check).succeeded();
}

#[test]
fn a_pipeline_goes_where_the_project_is() {
    let place = tempfile::tempdir().unwrap();
    let run = |folder: &Path, arguments: &[&str]| run_in(folder, arguments, &[]);
    run(place.path(), &["new", "pipeline", "mine"]).failed(
        1,
        &[
            "scripts/pipelines/mine.rhai",
            "project",
            "lightbench new DIR",
        ],
    );
    // A folder that is named like a part of the command.
    run(place.path(), &["new", "project", "pipeline"]).succeeded();
    let project = place.path().join("pipeline");
    let below = project.join("scripts/scenes");
    run(&below, &["new", "pipeline", "mine"]).succeeded();
    assert!(project.join("scripts/pipelines/mine.rhai").exists());
    let from_outside = ["--project", "pipeline", "new", "pipeline", "other"];
    let made = run(place.path(), &from_outside).succeeded();
    assert!(made.stderr.contains("cd \""), "{}", made.all());
    assert!(project.join("shaders/other/shade.wgsl").exists());
    run(place.path(), &["new", "short"]).succeeded();
    assert!(place.path().join("short/lightbench.toml").exists());
    run(place.path(), &["new"]).failed(2, &["lightbench new pipeline <NAME>"]);
}
