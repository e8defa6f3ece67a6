//! Studies of several points: what is measured, and what is left when they are stopped.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use cli_support::Project;
use cli_support::studies::{fixed, json, study};
use serde_json::Value;

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
    // Three sides of a tile with and without a mask, shaded in two ways; volumes or not, with three uses of
    // the stencil.
    assert!(
        tuned.stderr.contains("tuning: 18 variants of 2 pipelines"),
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
    assert_eq!(names(&chosen[0]), ["tile_size", "depth_mask", "shading"]);
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

/// Of two views, only the pipeline and its values may differ.
#[test]
fn views_are_measured_on_what_they_show() {
    let project = Project::new();
    let view = |pipeline: &str, more: &str| {
        format!(
            "lightbench-view-1 scene=tiny scene.light=8 pipeline={pipeline} camera=free \
             camera.eye=1,2.5,4 camera.turn=0.3,-0.4 camera.orbit=4 camera.lens=1,0.1,inf \
             time=0.5 size=48x27{more}"
        )
    };
    let (first, second) = (
        view("deferred_shading", ""),
        view("deferred_shading pipeline.exposure=1", ""),
    );
    let few = ["--frames", "1", "--warmup", "0", "--processes", "1"];
    let arguments = ["compare", "--view", &first, "--view", &second, "--out", "r"];
    project.run(&[&arguments[..], &few].concat()).succeeded();
    let report = json(&project.file("r/report.json"));
    let comparison = &report["points"][0]["comparison"];
    let pipelines = comparison["pipelines"].as_array().unwrap();
    let names: Vec<&str> = pipelines
        .iter()
        .map(|p| p["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["deferred_shading", "deferred_shading exposure=1"]);
    assert_eq!(comparison["reference"], "deferred_shading");
    assert!(pipelines[1]["difference"]["flip"]["mean"].as_f64().unwrap() > 0.01);

    // The picture is that of `render`, but for the last bits of the camera.
    let drawn = ["render", "--view", &first, "--out", "view.png"];
    project.run(&drawn).succeeded();
    let file = pipelines[0]["picture_file"].as_str().unwrap();
    let open = |path: &str| image::open(project.file(path)).unwrap().into_rgb8();
    let (reported, rendered) = (open(&format!("r/{file}")), open("view.png"));
    let pairs = reported.pixels().zip(rendered.pixels());
    let differ = pairs.filter(|(a, b)| a != b).count();
    assert!(differ <= 48 * 27 / 100, "{differ} pixels differ");
    let own = ["render", "tiny", "--set", "light=8", "--size", "48x27"];
    project
        .run(&[&own[..], &["--out", "own.png"]].concat())
        .succeeded();
    assert_ne!(open("own.png"), rendered, "the camera is the view's");

    let other = view("forward_single_pass", "").replace("time=0.5", "time=0.6");
    let arguments = ["compare", "--view", &first, "--view", &other, "--out", "s"];
    project
        .run(&arguments)
        .failed(2, &["view 2", "in its time"]);
    let arguments = ["compare", "tiny", "--view", &first, "--out", "s"];
    project.run(&arguments).failed(2, &["--view"]);
}
