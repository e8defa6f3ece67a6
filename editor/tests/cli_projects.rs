//! Projects, lists, and what the program says of itself and of the machine.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;

use cli_support::{Project, SCENE, run_in};

#[test]
fn a_project_is_made_and_its_files_are_used_in_place_of_the_shipped_ones() {
    let place = tempfile::Builder::new().prefix("ñ ").tempdir().unwrap();
    run_in(place.path(), &["new", "práctica 1 ñ"], &[]).succeeded();
    let project = place.path().join("práctica 1 ñ");
    run_in(place.path(), &["new", "práctica 1 ñ"], &[]).failed(1, &["not empty"]);

    // Without a project nothing can be copied; in one, or with --project, it can.
    let copy = ["copy", "shaders/output.wgsl"];
    run_in(place.path(), &copy, &[]).failed(1, &["lightbench new"]);
    let from_outside = [&["--project", "práctica 1 ñ"], &copy[..]].concat();
    run_in(place.path(), &from_outside, &[]).succeeded();
    let shader = project.join("shaders/output.wgsl");
    let text = fs::read_to_string(&shader).unwrap();

    let render = |folder: &std::path::Path, out: &str| {
        let out = project.join("out").join(out);
        let size = ["--size", "32x18", "--out", out.to_str().unwrap()];
        run_in(
            folder,
            &[&["render", "cornell_box"], &size[..]].concat(),
            &[],
        )
        .succeeded();
        fs::read(out).unwrap()
    };
    let shipped = render(place.path(), "shipped.png");
    assert_eq!(
        render(&project, "same.png"),
        shipped,
        "the copy is the shipped file"
    );
    // A file from Windows: CR LF, and a byte-order mark.
    let inverted = text.replace("return vec4f(", "return vec4f(1.0) - vec4f(");
    assert_ne!(inverted, text);
    fs::write(
        &shader,
        format!("\u{feff}{}", inverted.replace('\n', "\r\n")),
    )
    .unwrap();
    let mine = render(&project, "mine.png");
    assert_ne!(mine, shipped);
    // The project also holds below its top folder, and not outside of it.
    assert_eq!(render(&project.join("scripts/scenes"), "below.png"), mine);
    assert_eq!(render(place.path(), "outside.png"), shipped);
    // A second copy leaves the student's work alone.
    run_in(&project, &copy, &[]).succeeded();
    assert_ne!(fs::read_to_string(&shader).unwrap(), text);
    fs::remove_file(&shader).unwrap();
    assert_eq!(
        render(&project, "again.png"),
        shipped,
        "the shipped file is back"
    );
}

#[test]
fn scripts_with_windows_line_ends_work_and_keep_their_line_numbers() {
    let project = Project::new();
    project.write("scripts/scenes/crlf.rhai", SCENE.replace('\n', "\r\n"));
    project.render("tiny", "lf.png", &[]).succeeded();
    project.render("crlf", "crlf.png", &[]).succeeded();
    let read = |name| fs::read(project.file(name)).unwrap();
    assert_eq!(read("lf.png"), read("crlf.png"));
    project.write(
        "scripts/scenes/wrong.rhai",
        "let a = 1;\r\n\r\nlet b = = 2;\r\n",
    );
    project
        .render("wrong", "x.png", &[])
        .failed(1, &["wrong.rhai:3"]);
    // A scene may lie anywhere; messages then name it as it was found.
    let elsewhere = tempfile::tempdir().unwrap();
    let scene = elsewhere.path().join("mi escena.rhai");
    fs::write(&scene, SCENE.replace('\n', "\r\n")).unwrap();
    project
        .render(scene.to_str().unwrap(), "elsewhere.png", &[])
        .succeeded();
    assert_eq!(read("elsewhere.png"), read("lf.png"));
    fs::write(&scene, "let = 1;").unwrap();
    let place = format!("{}:1", fs::canonicalize(&scene).unwrap().display());
    project
        .render(scene.to_str().unwrap(), "x.png", &[])
        .failed(1, &[&place]);
}

#[test]
fn a_project_that_cant_be_written_can_be_read() {
    let project = Project::new();
    let place = tempfile::tempdir().unwrap();
    let mut permissions = fs::metadata(project.path()).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(project.path(), permissions.clone()).unwrap();
    let out = place.path().join("x.png");
    project
        .render("tiny", out.to_str().unwrap(), &[])
        .succeeded();
    assert!(out.exists());
    #[allow(clippy::permissions_set_readonly_false)] // It goes away with the test.
    permissions.set_readonly(false);
    fs::set_permissions(project.path(), permissions).unwrap();
}

#[test]
fn a_wrong_project_folder_is_named() {
    let place = tempfile::tempdir().unwrap();
    let list = ["list", "scenes", "--project", "nowhere"];
    run_in(place.path(), &list, &[]).failed(1, &["--project nowhere"]);
}

#[test]
fn lists_name_what_there_is_and_where_it_comes_from() {
    let project = Project::new();
    project.write(
        "scripts/scenes/tiny.rhai",
        format!("// A tiny scene.\n{SCENE}"),
    );
    project.write("scripts/pipelines/broken.rhai", "let p = ;");
    let scenes = project.run(&["list", "scenes"]).succeeded().stdout;
    let line = |text: &str, name: &str| {
        let mut lines = text.lines();
        lines
            .find(|line| line.starts_with(name))
            .unwrap_or("none")
            .to_owned()
    };
    assert!(line(&scenes, "tiny ").contains("project"), "{scenes}");
    assert!(line(&scenes, "tiny ").ends_with("A tiny scene"), "{scenes}");
    for scene in ["cornell_box", "many_lights", "showroom"] {
        assert!(line(&scenes, scene).contains("shipped"), "{scenes}");
    }
    let pipelines = project.run(&["list", "pipelines"]);
    assert_eq!(pipelines.status, 0, "{}", pipelines.all());
    assert!(line(&pipelines.stdout, "deferred_shading").ends_with("Deferred shading"));
    assert!(
        pipelines
            .stderr
            .contains("warning: scripts/pipelines/broken.rhai:1")
    );
    let files = project.run(&["list", "files"]).succeeded().stdout;
    assert!(
        line(&files, "shaders/output.wgsl").contains("shipped"),
        "{files}"
    );
    assert!(
        line(&files, "scripts/scenes/tiny.rhai").contains("project"),
        "{files}"
    );

    let adapters = project.run(&["list", "adapters"]).succeeded().stdout;
    let first = adapters.lines().next().unwrap();
    assert!(first.starts_with("0  "), "{adapters}");
    // The number chooses that adapter.
    project
        .render("tiny", "x.png", &["--adapter", "0"])
        .succeeded();
}

#[test]
fn the_doctor_draws_to_know() {
    let project = Project::new();
    let doctor = project.run(&["doctor"]).succeeded().stdout;
    for part in [
        "machine ",
        "adapter 0",
        "draws: a test picture came out right",
        "display ",
        "project ",
    ] {
        assert!(doctor.contains(part), "no `{part}` in {doctor}");
    }
    let name = project.path().file_name().unwrap().to_str().unwrap();
    assert!(doctor.contains(name), "{doctor}");
}

#[test]
fn every_command_explains_itself_with_examples() {
    let project = Project::new();
    let top = project.run(&["--help"]).succeeded().stdout;
    for command in [
        "edit",
        "render",
        "compare",
        "diff",
        "list",
        "new",
        "copy",
        "docs",
        "check-pipeline",
        "doctor",
        "bench",
    ] {
        assert!(top.contains(&format!("\n  {command} ")), "{top}");
        let help = project.run(&["help", command]).succeeded().stdout;
        if command != "doctor" {
            assert!(help.contains(&format!("lightbench {command}")), "{help}");
            assert!(help.contains("Example"), "{help}");
        }
    }
    project.run(&[]).failed(2, &["Usage"]);
    let version = project.run(&["--version"]).succeeded().stdout;
    assert_eq!(
        version.trim(),
        format!("lightbench {}", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn the_layouts_are_measured() {
    let project = Project::new();
    let bench = ["bench", "world", "--objects", "5000"];
    let report = project.run(&bench).succeeded().stdout;
    for part in [
        "5000 objects",
        "columns",
        "array of structures",
        "boxed objects",
        "ns/object",
    ] {
        assert!(report.contains(part), "no `{part}` in {report}");
    }
    project
        .run(&["bench", "world", "--objects", "0"])
        .failed(2, &["--objects"]);
}

#[test]
fn the_editor_without_a_display_says_what_works_without_one() {
    let project = Project::new();
    let none = [("DISPLAY", ""), ("WAYLAND_DISPLAY", "")];
    if cfg!(target_os = "linux") {
        run_in(project.path(), &["edit"], &none)
            .failed(1, &["display", "lightbench render", "lightbench compare"]);
    }
}
