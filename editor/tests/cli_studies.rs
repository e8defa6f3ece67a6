//! Studies of several points: resumed, split, merged, compared with earlier ones, and bundled.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use cli_support::Project;
use serde_json::Value;

/// Two points of two pipelines, each measured by two processes.
const STUDY: [&str; 14] = [
    "compare",
    "tiny",
    "--pipelines",
    "forward_single_pass,clustered_deferred",
    "--sweep",
    "light=2,8",
    "--size",
    "48x27",
    "--frames",
    "2",
    "--processes",
    "2",
    "--warmup",
    "1",
];

fn study<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&STUDY[..], &["--out", out], more].concat()
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// What must be the same however a study was measured: of each pipeline at each point the bytes of its
/// picture, and every count of its first frame.
fn fixed(out: &Path) -> BTreeMap<String, String> {
    let report = json(&out.join("report.json"));
    let mut found = BTreeMap::new();
    for point in report["points"].as_array().unwrap() {
        for pipeline in point["comparison"]["pipelines"].as_array().unwrap() {
            let picture = fs::read(out.join(pipeline["picture_file"].as_str().unwrap())).unwrap();
            let passes: Vec<String> = pipeline["passes"]
                .as_array()
                .unwrap()
                .iter()
                .map(|pass| {
                    format!(
                        "{} {} {}",
                        pass["draws"], pass["triangles"], pass["bytes_written"]
                    )
                })
                .collect();
            let counters: Vec<String> = pipeline["counters"]
                .as_array()
                .unwrap()
                .iter()
                .map(|counter| format!("{} {}", counter["name"], counter["values"][0]))
                .collect();
            found.insert(
                format!("{} {}", point["key"], pipeline["name"]),
                format!(
                    "{picture:?} {passes:?} {counters:?} {}",
                    pipeline["difference"]
                ),
            );
        }
    }
    found
}

#[test]
fn every_point_is_measured_by_every_process() {
    let project = Project::new();
    let outcome = project.run(&study("r", &[])).succeeded();
    assert!(
        outcome
            .stderr
            .contains("process 2 of 2: scene=tiny,light=8"),
        "{}",
        outcome.all()
    );
    let report = json(&project.file("r/report.json"));
    let points = report["points"].as_array().unwrap();
    let keys: Vec<&str> = points.iter().map(|p| p["key"].as_str().unwrap()).collect();
    assert_eq!(keys, ["scene=tiny,light=2", "scene=tiny,light=8"]);
    assert_eq!(report["missing"], Value::Array(Vec::new()));
    for (point, light) in points.iter().zip(["2", "8"]) {
        let comparison = &point["comparison"];
        let processes = comparison["processes"].as_array().unwrap();
        assert_eq!(processes.len(), 2);
        assert!(
            processes
                .iter()
                .all(|p| p["seconds"].as_f64().unwrap() > 0.0)
        );
        let parameters = comparison["parameters"].as_array().unwrap();
        let set = parameters.iter().find(|p| p["name"] == "light").unwrap();
        assert_eq!(set["value"], light);
        for pipeline in comparison["pipelines"].as_array().unwrap() {
            assert_eq!(pipeline["process_frames"], serde_json::json!([2, 2]));
            assert_eq!(pipeline["frame_cpu_ms"].as_array().unwrap().len(), 4);
            assert_eq!(pipeline["frame_wall_ms"].as_array().unwrap().len(), 4);
            // Queries are left out in every second round.
            assert_eq!(pipeline["unqueried_wall_ms"].as_array().unwrap().len(), 2);
            let settled = pipeline["settled_after"].as_array().unwrap();
            assert!(
                settled
                    .iter()
                    .all(|n| (1..=7).contains(&n.as_u64().unwrap()))
            );
            assert_eq!(pipeline["cut"], false);
        }
    }
    // The points differ, and the pipelines agree.
    let found: Vec<String> = fixed(&project.file("r")).into_values().collect();
    assert_ne!(found[0], found[2]);
}

#[test]
fn a_sweep_reaches_pipelines_sizes_frames_and_cameras() {
    let project = Project::new();
    let scene = format!(
        "{}\ncamera(\"side\").at(5, 1, 0).look_at(0, 0.5, 0).fov(50);\n",
        cli_support::SCENE
    );
    project.write("scripts/scenes/tiny.rhai", scene);
    let run = |sweeps: &[&str]| {
        let mut arguments = vec![
            "compare",
            "tiny",
            "--pipelines",
            "tiled_deferred",
            "--size",
            "48x27",
            "--frames",
            "1",
            "--processes",
            "1",
            "--restart",
            "--out",
            "r",
        ];
        for sweep in sweeps {
            arguments.extend(["--sweep", sweep]);
        }
        project.run(&arguments)
    };
    run(&["tile_size=8,32", "size=32x18,16x9"]).succeeded();
    let report = json(&project.file("r/report.json"));
    let points = report["points"].as_array().unwrap();
    assert_eq!(points.len(), 4);
    let last = &points[3]["comparison"];
    assert_eq!(points[3]["key"], "scene=tiny,*.tile_size=32,size=16x9");
    assert_eq!(last["size"], serde_json::json!([16, 9]));
    let parameters = last["pipelines"][0]["parameters"].as_array().unwrap();
    assert!(
        parameters
            .iter()
            .any(|p| p["name"] == "tile_size" && p["value"] == "32")
    );

    // The box of the scene moves with time, and another camera sees it from elsewhere.
    run(&["start=0,60", "camera=main,side"]).succeeded();
    let found: Vec<String> = fixed(&project.file("r")).into_values().collect();
    for a in 0..4 {
        for b in 0..a {
            assert_ne!(found[a], found[b]);
        }
    }
    run(&["camera=top"]).failed(1, &["no camera `top`", "`main`, `side`"]);
    run(&["lights=4"]).failed(1, &["lights"]);
    run(&["tiled_deferred.tile_siz=8"]).failed(2, &["did you mean `tile_size`?"]);
    run(&["size=0x4"]).failed(1, &["640x360"]);
    run(&["tile_size=8,8"]).failed(1, &["twice"]);
}

#[test]
fn the_path_tracer_can_be_the_reference() {
    let project = Project::new();
    let arguments = [
        "compare",
        "tiny",
        "--pipelines",
        "forward_single_pass",
        "--size",
        "48x27",
        "--frames",
        "1",
        "--processes",
        "1",
        "--reference",
        "traced",
        "--out",
        "r",
    ];
    project.run(&arguments).succeeded();
    let report = json(&project.file("r/report.json"));
    let pipelines = report["points"][0]["comparison"]["pipelines"]
        .as_array()
        .unwrap()
        .clone();
    assert_eq!(pipelines[0]["name"], "traced");
    let flip = pipelines[1]["difference"]["flip"]["mean"].as_f64().unwrap();
    // Both evaluate the same lights on the same surfaces; edges differ by the rule of coverage.
    assert!(flip < 0.01, "{flip}");
    assert!(pipelines[1]["linear_difference"]["rmse"].as_f64().unwrap() > 0.0);
}

/// Each pipeline is measured with the fastest of the values that it declares, and the report says which.
#[test]
fn tuning_chooses_declared_values_and_keeps_the_picture() {
    let project = Project::new();
    let arguments = [
        "compare",
        "tiny",
        "--pipelines",
        "tiled_deferred,deferred_shading",
        "--size",
        "48x27",
        "--frames",
        "1",
        "--processes",
        "1",
        "--out",
        "r",
    ];
    let tuned = project
        .run(&[&arguments[..], &["--tune"]].concat())
        .succeeded();
    // Three sides of a tile with and without a mask; volumes or not, with three uses of the stencil.
    assert!(
        tuned.stderr.contains("tuning: 12 variants of 2 pipelines"),
        "{}",
        tuned.all()
    );
    let report = json(&project.file("r/report.json"));
    let chosen = report["plan"]["tuned"].as_array().unwrap();
    let names = |entry: &Value| -> Vec<String> {
        let settings = entry["settings"].as_array().unwrap().iter();
        settings
            .map(|s| s["name"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(names(&chosen[0]), ["tile_size", "depth_mask"]);
    assert_eq!(names(&chosen[1]), ["light_volumes", "volume_stencil"]);
    let pipelines = report["points"][0]["comparison"]["pipelines"].clone();
    for (pipeline, chosen) in pipelines.as_array().unwrap().iter().zip(chosen) {
        for setting in chosen["settings"].as_array().unwrap() {
            let parameters = pipeline["parameters"].as_array().unwrap();
            assert!(parameters.contains(setting), "{setting} {parameters:?}");
        }
    }
    let as_tuned = fixed(&project.file("r"));
    project
        .run(&[&arguments[..], &["--restart"]].concat())
        .succeeded();
    let picture = |of: &BTreeMap<String, String>, name: &str| {
        let text = of.iter().find(|(key, _)| key.contains(name)).unwrap().1;
        text.split(']').next().unwrap().to_owned()
    };
    let plain = fixed(&project.file("r"));
    assert_eq!(
        picture(&as_tuned, "tiled_deferred"),
        picture(&plain, "tiled_deferred")
    );
}

#[test]
fn another_study_is_not_replaced_unasked_and_changed_files_are_measured_again() {
    let project = Project::new();
    project.run(&study("r", &[])).succeeded();
    let again = project.run(&study("r", &[])).succeeded();
    assert!(again.stderr.contains("measured already"), "{}", again.all());
    let other = project.run(&study("r", &["--start", "5"]));
    other.failed(1, &["another study", "--restart"]);
    project.write(
        "scripts/scenes/tiny.rhai",
        cli_support::SCENE.replace("color(0.8, 0.5, 0.3)", "color(0.2, 0.5, 0.3)"),
    );
    let before = fixed(&project.file("r"));
    let changed = project.run(&study("r", &[])).succeeded();
    assert!(
        changed
            .stderr
            .contains("scripts/scenes/tiny.rhai has changed"),
        "{}",
        changed.all()
    );
    assert_ne!(before, fixed(&project.file("r")));
}

/// Killed at ten moments, a study goes on each time, and ends in what an undisturbed one ends in.
#[test]
fn a_killed_study_goes_on() {
    let project = Project::new();
    project.run(&study("calm", &[])).succeeded();
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    for _ in 0..10 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_lightbench"))
            .current_dir(project.path())
            .args(study("killed", &[]))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_millis(100 + (seed >> 54)));
        // On Unix this is SIGKILL.
        child.kill().unwrap();
        child.wait().unwrap();
    }
    project.run(&study("killed", &[])).succeeded();
    assert_eq!(fixed(&project.file("calm")), fixed(&project.file("killed")));
}

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

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_was_measured_and_the_same_command_goes_on() {
    use std::io::{BufRead as _, BufReader};
    use std::time::Instant;

    let project = Project::new();
    let long = [
        "--sweep",
        "start=0,1,2,3,4,5,6,7,8,9",
        "--sweep",
        "shift=-1,0,1",
    ];
    let mut program = Command::new(env!("CARGO_BIN_EXE_lightbench"))
        .current_dir(project.path())
        .args(study("r", &long))
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(program.stderr.take().unwrap()).lines();
    let begun = lines
        .by_ref()
        .any(|line| line.unwrap().contains("process 1 of 2: scene=tiny"));
    assert!(begun, "the measurement did not begin");
    let id = program.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let asked = Instant::now();
    let said: String = lines.map(|line| line.unwrap() + "\n").collect();
    assert_eq!(program.wait().unwrap().code(), Some(130), "{said}");
    assert!(asked.elapsed() < Duration::from_secs(20));
    assert!(
        said.contains("the same command goes on") && said.contains("stopped"),
        "{said}"
    );
    let report = json(&project.file("r/report.json"));
    let complete = report["points"].as_array().unwrap().len();
    // All 60 points lack the second process.
    assert!((1..60).contains(&complete), "{complete}");
    assert_eq!(report["missing"].as_array().unwrap().len(), 60);
}

/// A script that fails in the middle ends the study with its line; what was measured stays.
#[test]
fn a_mistake_in_one_point_keeps_the_others() {
    let project = Project::new();
    let scene = cli_support::SCENE.replace(
        "fn update",
        "if LIGHT > 5.0 { entity(\"nobody\").at(0, 0, 0); }\nfn update",
    );
    project.write("scripts/scenes/tiny.rhai", scene);
    project
        .run(&study("r", &[]))
        .failed(1, &["tiny.rhai:", "nobody"]);
    let parts = fs::read_dir(project.file("r/parts")).unwrap();
    let json = parts.filter(|entry| {
        let path = entry.as_ref().unwrap().path();
        path.extension().is_some_and(|end| end == "json")
    });
    assert_eq!(json.count(), 1);
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
