//! `lightbench trace`: pictures by the path tracer.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;
use std::path::Path;

use cli_support::Project;
use image::DynamicImage;

fn open(path: &Path) -> DynamicImage {
    image::ImageReader::open(path).unwrap().decode().unwrap()
}

const SMALL: [&str; 4] = ["trace", "tiny", "--size", "48x27"];

#[test]
fn an_exr_comes_with_its_variance_and_a_png_through_the_tone_curve() {
    let project = Project::new();
    let arguments = [
        &SMALL[..],
        &[
            "--samples",
            "8",
            "--out",
            "a.exr",
            "--out",
            "a.png",
            "--tone-curve",
            "linear",
        ],
    ];
    let outcome = project.run(&arguments.concat()).succeeded();
    assert!(
        outcome.stderr.contains("8 samples a pixel"),
        "{}",
        outcome.all()
    );
    let light = open(&project.file("a.exr")).into_rgba32f();
    let variance = open(&project.file("a.variance.exr")).into_rgba32f();
    let shown = open(&project.file("a.png")).into_rgba8();
    assert_eq!(light.dimensions(), (48, 27));
    let noisy = variance.pixels().filter(|pixel| pixel[0] > 0.0).count();
    assert!(noisy > 48 * 27 / 4, "{noisy} pixels have a variance");
    for (light, shown) in light.pixels().zip(shown.pixels()) {
        let linear = light[0].clamp(0.0, 1.0);
        let coded = match linear <= 0.003_130_8 {
            true => 12.92 * linear,
            false => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
        };
        assert!(
            (coded * 255.0 - f32::from(shown[0])).abs() <= 0.51,
            "{light:?} {shown:?}"
        );
    }
    // The same again, bit for bit; another seed is other noise.
    let again = [&SMALL[..], &["--samples", "8", "--out", "b.exr"]].concat();
    project.run(&again).succeeded();
    let bytes = |name: &str| fs::read(project.file(name)).unwrap();
    assert_eq!(bytes("a.exr"), bytes("b.exr"));
    project
        .run(&[&again[..], &["--seed", "5"]].concat())
        .succeeded();
    assert_ne!(bytes("a.exr"), bytes("b.exr"));
}

#[test]
fn direct_light_is_what_render_draws() {
    let project = Project::new();
    let size = ["--size", "48x27"];
    let render = [
        "render",
        "tiny",
        "--pipeline",
        "forward_single_pass",
        "--out",
        "drawn.png",
    ];
    project.run(&[&render[..], &size].concat()).succeeded();
    let trace = [&SMALL[..], &["--mode", "direct", "--out", "traced.png"]].concat();
    project.run(&trace).succeeded();
    let [drawn, traced] =
        ["drawn.png", "traced.png"].map(|name| open(&project.file(name)).into_rgba8());
    let apart = drawn
        .pixels()
        .zip(traced.pixels())
        .filter(|(a, b)| (0..3).any(|channel| a[channel].abs_diff(b[channel]) > 1));
    // Where an edge runs through the middle of a pixel, rounding decides.
    let apart = apart.count();
    assert!(apart <= 4, "{apart} pixels differ");
}

#[test]
fn parameters_of_the_scene_and_frames_count() {
    let project = Project::new();
    let trace = |out: &str, more: &[&str]| {
        let arguments = [&SMALL[..], &["--mode", "shadowed", "--out", out], more].concat();
        project.run(&arguments).succeeded();
        fs::read(project.file(out)).unwrap()
    };
    let later = trace("a.exr", &["--frame", "60"]);
    assert_eq!(later, trace("b.exr", &["--set", "shift=1"]));
    assert_ne!(later, trace("c.exr", &["--set", "light=9"]));
    // Nothing is left to chance here.
    let variance = open(&project.file("c.variance.exr")).into_rgba32f();
    assert!(variance.pixels().all(|pixel| pixel[0] == 0.0));
}

#[test]
fn what_means_nothing_is_refused_with_the_way_out() {
    let project = Project::new();
    let with = |more: &[&str]| project.run(&[&SMALL[..], more].concat());
    with(&["--out", "x.jpg"]).failed(2, &["x.jpg", ".exr"]);
    with(&[]).failed(2, &["--out"]);
    let direct = ["--out", "x.exr", "--mode", "direct"];
    for (name, value) in [("--samples", "4"), ("--depth", "2"), ("--sources", "sky")] {
        with(&[&direct[..], &[name, value]].concat()).failed(2, &[name, "--mode full"]);
    }
    with(&["--out", "x.exr", "--samples", "0"]).failed(2, &["--samples"]);
    let huge = ["trace", "tiny", "--size", "100000x100000", "--out", "x.exr"];
    project
        .run(&huge)
        .failed(2, &["--size 100000x100000", "64 million"]);
    with(&["--out", "x.exr", "--tone-curve", "aces"]).failed(2, &["aces", "reinhard"]);
    with(&["--out", "x.exr", "--set", "nothing=1"]).failed(1, &["nothing"]);
    assert!(!project.file("x.exr").exists());
}

/// Ctrl-C ends the work and keeps what is there.
#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_there() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let project = Project::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_lightbench"))
        .args(SMALL)
        .args(["--samples", "100000000", "--out", "long.exr"])
        .current_dir(project.path())
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(4));
    let process = child.id().to_string();
    let interrupt = Command::new("kill").args(["-INT", &process]).status();
    assert!(interrupt.unwrap().success());
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        assert!(
            start.elapsed() < Duration::from_secs(60),
            "it does not stop"
        );
        std::thread::sleep(Duration::from_millis(50));
    }
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains("what was traced so far is written"), "{said}");
    let light = open(&project.file("long.exr")).into_rgba32f();
    assert!(light.pixels().any(|pixel| pixel[0] > 0.01));
    assert!(project.file("long.variance.exr").exists());
}

#[test]
fn export_writes_a_scene_for_mitsuba_and_names_what_is_not_in_it() {
    let project = Project::new();
    let outcome = project.run(&["export", "tiny", "--mitsuba", "out/tiny", "--size", "80x45"]);
    let outcome = outcome.succeeded();
    for part in ["material `paint`: its highlights", "light `lamp`"] {
        assert!(outcome.stderr.contains(part), "{}", outcome.all());
    }
    assert!(outcome.stdout.contains("scene.xml"), "{}", outcome.all());
    let text = fs::read_to_string(project.file("out/tiny/scene.xml")).unwrap();
    assert!(
        text.contains("value=\"80\"") && text.contains("not here: material `paint`"),
        "{text}"
    );
    project.run(&["export", "tiny"]).failed(2, &["--mitsuba"]);
    // A file where a folder is needed.
    project.write("taken", "");
    let refused = project.run(&["export", "tiny", "--mitsuba", "taken/x"]);
    refused.failed(1, &["taken"]);
}
