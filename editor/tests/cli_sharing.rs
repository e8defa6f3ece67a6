//! Studies on several machines, against earlier ones, and for others.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use cli_support::Project;
use cli_support::studies::{STUDY, fixed, json, study};
use serde_json::Value;

#[test]
fn shares_merge_into_the_whole() {
    let project = Project::new();
    project.run(&study("whole", &[])).succeeded();
    project.run(&study("a", &["--shard", "1/2"])).succeeded();
    let early = project.run(&["merge", "a", "--out", "half"]).succeeded();
    assert!(
        early.stderr.contains("1 of 2 points are not complete"),
        "{}",
        early.all()
    );
    project.run(&study("b", &["--shard", "2/2"])).succeeded();
    project
        .run(&["merge", "a", "b", "--out", "merged"])
        .succeeded();
    assert_eq!(
        fixed(&project.file("whole")),
        fixed(&project.file("merged"))
    );
    // Merged once more with what came later.
    project
        .run(&["merge", "a", "b", "--out", "half"])
        .succeeded();
    assert_eq!(fixed(&project.file("whole")), fixed(&project.file("half")));

    project.run(&study("other", &["--start", "3"])).succeeded();
    project
        .run(&["merge", "a", "other", "--out", "m"])
        .failed(2, &["different studies"]);
    project
        .run(&["merge", "scripts", "--out", "m"])
        .failed(1, &["no study"]);
    project
        .run(&study("x", &["--shard", "3/2"]))
        .failed(2, &["3/16"]);
}

#[test]
fn a_study_is_compared_with_an_earlier_one() {
    let project = Project::new();
    project.run(&study("old", &[])).succeeded();
    let same = project
        .run(&study("new", &["--against", "old/report.json"]))
        .succeeded();
    assert!(same.stdout.contains("4 of 4 pipelines"), "{}", same.all());
    project.write(
        "scripts/scenes/tiny.rhai",
        cli_support::SCENE.replace("sphere(0.6)", "plane(1, 1)"),
    );
    let changed = project.run(&study("newer", &["--against", "old/report.json"]));
    assert_eq!(changed.status, 1, "{}", changed.all());
    for part in ["another picture", "triangles", "0 of 4 pipelines"] {
        assert!(changed.stdout.contains(part), "{}", changed.all());
    }
    project
        .run(&study("newer", &["--against", "none.json"]))
        .failed(1, &["none.json"]);
    project
        .run(&study("newer", &["--against", "newer/report.json"]))
        .failed(2, &["another folder"]);
}

#[test]
fn a_bundle_is_reproduced_without_the_project() {
    let project = Project::new();
    // A scene from outside of the project.
    let outside = tempfile::tempdir().unwrap();
    let scene = outside.path().join("far.rhai");
    fs::write(&scene, cli_support::SCENE).unwrap();
    let arguments = [
        "compare",
        "tiny",
        scene.to_str().unwrap(),
        "--pipelines",
        "deferred_shading,forward_single_pass",
        "--size",
        "48x27",
        "--frames",
        "1",
        "--processes",
        "1",
        "--out",
        "r",
    ];
    project.run(&arguments).succeeded();
    project
        .run(&["bundle", "r", "--out", "b.zip"])
        .failed(2, &[".tar.gz"]);
    project
        .run(&["bundle", "r", "--out", "b.tar.gz"])
        .succeeded();

    let elsewhere = tempfile::tempdir().unwrap();
    fs::copy(project.file("b.tar.gz"), elsewhere.path().join("b.tar.gz")).unwrap();
    drop(outside);
    let reproduce = ["reproduce", "b.tar.gz", "--out", "again"];
    let again = cli_support::run_in(elsewhere.path(), &reproduce, &[]).succeeded();
    for part in [
        "Pictures: 4 equal, 0 within the bound, 0 different",
        "Counts: 4 equal, 0 different",
    ] {
        assert!(again.stdout.contains(part), "{}", again.all());
    }
    // Another input gives another picture, which is said.
    let inside = elsewhere
        .path()
        .join("again/bundle/project/scripts/scenes/tiny.rhai");
    assert!(fs::read_to_string(inside).unwrap().contains("const LIGHT"));

    project.write(
        "scripts/scenes/tiny.rhai",
        cli_support::SCENE.replace("sphere(0.6)", "plane(1, 1)"),
    );
    project
        .run(&["bundle", "r", "--out", "late.tar.gz"])
        .failed(1, &["tiny.rhai has changed"]);
    project.write("no.tar.gz", "nothing");
    project
        .run(&["reproduce", "no.tar.gz", "--out", "x"])
        .failed(1, &["no bundle"]);
}

/// The lines for GNU parallel in the documentation, run as they stand. Where it is not installed, a
/// few lines of shell stand in for it: they run the same commands, one after another.
#[cfg(unix)]
#[test]
fn the_example_of_gnu_parallel_works() {
    let page = include_str!("../../engine/lab/docs/studies.md");
    let line = |start: &str| page.lines().find(|line| line.starts_with(start)).unwrap();
    let share = line("parallel --jobs 1 lightbench");
    let merge = line("lightbench merge shares/1 shares/2");
    let program = Path::new(env!("CARGO_BIN_EXE_lightbench"));
    let more = STUDY[1..].join(" ");
    let stand_in = r#"
        if ! parallel --version 2>/dev/null | grep -q GNU; then
            parallel() {
                shift 2
                command=
                while [ "$1" != ::: ]; do command="$command $1"; shift; done
                shift
                for value in "$@"; do eval "$(echo "$command" | sed "s/{}/$value/g")" || return 1; done
            }
        fi
    "#;
    let project = Project::new();
    let script = format!(
        "set -e\nPATH={}:$PATH\n{stand_in}\n{}\n{merge}\n",
        program.parent().unwrap().display(),
        share.replace("compare ", &format!("compare {more} "))
    );
    let ran = Command::new("bash")
        .current_dir(project.path())
        .args(["-c", &script])
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(ran.status.success(), "{script}\n{said}");
    let report = json(&project.file("report/report.json"));
    assert_eq!(report["points"].as_array().unwrap().len(), 2);
    assert_eq!(report["missing"], Value::Array(Vec::new()));
}
