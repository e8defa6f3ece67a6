//! `render`, `diff` and `compare`: pictures and what is said of them.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::collections::BTreeSet;
use std::fs;

use cli_support::{Project, run_in};
use image::{DynamicImage, GenericImageView as _};

fn open(path: &std::path::Path) -> DynamicImage {
    image::ImageReader::open(path).unwrap().decode().unwrap()
}

#[test]
fn the_same_input_gives_the_same_picture_bit_for_bit() {
    let project = Project::new();
    let size = ["--size", "160x90", "--frame", "7"];
    let render = |out: &str, environment: &[(&str, &str)]| {
        let arguments = [&["render", "tiny", "--out", out], &size[..]].concat();
        run_in(project.path(), &arguments, environment).succeeded();
        fs::read(project.file(out)).unwrap()
    };
    let first = render("a.png", &[]);
    assert_eq!(first, render("b.png", &[]), "a second run differs");
    let threads = [("RAYON_NUM_THREADS", "1"), ("LP_NUM_THREADS", "1")];
    assert_eq!(first, render("c.png", &threads), "one thread differs");

    let picture = open(&project.file("a.png"));
    assert_eq!(picture.dimensions(), (160, 90));
    let colors: BTreeSet<_> = picture.pixels().map(|(_, _, color)| color.0).collect();
    assert!(
        colors.len() > 100,
        "a lit scene has {} colours",
        colors.len()
    );
    assert!(colors.iter().all(|color| color[3] == 255));
}

#[test]
fn frames_are_moments_of_the_scene() {
    let project = Project::new();
    let render = |out: &str, more: &[&str]| {
        project.render("tiny", out, more).succeeded();
        fs::read(project.file(out)).unwrap()
    };
    let start = render("0.png", &[]);
    assert_eq!(start, render("same.png", &["--frame", "0"]));
    let later = render("60.png", &["--frame", "60"]);
    assert_ne!(start, later);
    // After one second the box has moved by one metre, to where a parameter can put it at once.
    let moved = render("moved.png", &["--set", "shift=1"]);
    assert_eq!(later, moved);
}

#[test]
fn an_exr_holds_linear_light_and_a_png_what_follows_from_it() {
    let project = Project::new();
    let linear = ["--set", "tone_curve=linear"];
    project.render("tiny", "light.exr", &[]).succeeded();
    project.render("tiny", "shown.png", &linear).succeeded();
    let light = open(&project.file("light.exr")).into_rgba32f();
    let shown = open(&project.file("shown.png")).into_rgba8();
    assert_eq!(light.dimensions(), (64, 36));
    // IEC 61966-2-1.
    let encode = |c: f32| {
        let c = c.clamp(0.0, 1.0);
        if c <= 0.003_130_8 {
            12.92 * c
        } else {
            1.055 * c.powf(1.0 / 2.4) - 0.055
        }
    };
    let mut brightest = 0.0_f32;
    for (light, shown) in light.pixels().zip(shown.pixels()) {
        for channel in 0..3 {
            let expected = encode(light[channel]) * 255.0;
            let found = f32::from(shown[channel]);
            assert!(
                (found - expected).abs() <= 0.51,
                "{light:?} became {shown:?}"
            );
            brightest = brightest.max(light[channel]);
        }
        assert_eq!(light[3], 1.0);
    }
    assert!(brightest > 0.1, "{brightest}");

    // Exposure belongs to the display: it changes the PNG and not the EXR.
    project
        .render("tiny", "brighter.exr", &["--set", "pipeline.exposure=2"])
        .succeeded();
    assert_eq!(open(&project.file("brighter.exr")).into_rgba32f(), light);
    project
        .render("tiny", "brighter.png", &["--set", "exposure=2"])
        .succeeded();
    assert_ne!(open(&project.file("brighter.png")).into_rgba8(), shown);
}

#[test]
fn sizes_go_down_to_one_pixel() {
    let project = Project::new();
    for (size, dimensions) in [("1x1", (1, 1)), ("1x37", (1, 37)), ("637x1", (637, 1))] {
        let arguments = ["render", "tiny", "--size", size, "--out", "x.png"];
        project.run(&arguments).succeeded();
        assert_eq!(open(&project.file("x.png")).dimensions(), dimensions);
    }
    for size in ["0x0", "0x5", "640", "axb"] {
        let arguments = ["render", "tiny", "--size", size, "--out", "y.png"];
        project.run(&arguments).failed(2, &["--size", "640x360"]);
    }
    let arguments = ["render", "tiny", "--size", "1000000x1", "--out", "y.png"];
    project.run(&arguments).failed(1, &["limit"]);
    assert!(!project.file("y.png").exists());
}

#[test]
fn a_model_from_anywhere_is_shown() {
    let project = Project::new();
    let elsewhere = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let model = elsewhere.path().join("quad.obj");
    fs::write(&model, obj).unwrap();
    let model = model.to_str().unwrap();
    project
        .render("showroom", "quad.png", &["--model", model])
        .succeeded();
    project.render("showroom", "vase.png", &[]).succeeded();
    assert_ne!(
        open(&project.file("quad.png")),
        open(&project.file("vase.png"))
    );
}

#[test]
fn diff_says_how_far_apart_pictures_are() {
    let project = Project::new();
    project.render("tiny", "a.png", &[]).succeeded();
    project
        .render("tiny", "b.png", &["--set", "light=6"])
        .succeeded();
    project.render("tiny", "a.exr", &[]).succeeded();
    project
        .render("tiny", "b.exr", &["--set", "light=6"])
        .succeeded();

    let same = project
        .run(&["diff", "a.png", "a.png", "--json"])
        .succeeded();
    let same: serde_json::Value = serde_json::from_str(&same.stdout).unwrap();
    assert_eq!(same["difference"]["flip"]["mean"], 0.0);
    let other = project
        .run(&["diff", "a.png", "b.png", "--heat-map", "heat.png"])
        .succeeded();
    for name in ["FLIP mean", "RMSE (sRGB)", "PSNR (sRGB)", "SSIM"] {
        assert!(other.stdout.contains(name), "{}", other.all());
    }
    assert_eq!(open(&project.file("heat.png")).width(), 64);
    // Linear light grows with the lamp: the energy ratio lies between 1 and 6/4.
    let linear = project
        .run(&["diff", "a.exr", "b.exr", "--json"])
        .succeeded();
    let linear: serde_json::Value = serde_json::from_str(&linear.stdout).unwrap();
    let ratio = linear["difference"]["linear"]["energy_ratio"]
        .as_f64()
        .unwrap();
    assert!((1.05..1.5).contains(&ratio), "{ratio}");

    project
        .run(&["diff", "a.png", "a.exr"])
        .failed(1, &["a.png", "a.exr", "kind"]);
    let small = ["render", "tiny", "--size", "32x18", "--out", "small.png"];
    project.run(&small).succeeded();
    project
        .run(&["diff", "a.png", "small.png"])
        .failed(1, &["64 × 36", "32 × 18"]);
    project
        .run(&["diff", "a.png", "none.png"])
        .failed(1, &["none.png"]);
    project
        .run(&["diff", "a.png", "b.png", "--heat-map", "heat.jpg"])
        .failed(2, &["heat.jpg"]);
}

#[test]
fn a_comparison_is_a_report_with_everything_in_it() {
    let project = Project::new();
    let arguments = [
        "compare",
        "tiny",
        "--pipelines",
        "forward_single_pass,deferred_shading",
        "--size",
        "64x36",
        "--frames",
        "8",
        "--warmup",
        "1",
        "--processes",
        "1",
        "--set",
        "light=5",
        "--set",
        "deferred_shading.light_volumes=off",
        "--out",
        "out/the report",
    ];
    let outcome = project.run(&arguments).succeeded();
    for part in [
        "forward_single_pass",
        "deferred_shading",
        "median",
        "report.html",
    ] {
        assert!(
            outcome.stdout.contains(part),
            "no {part} in {}",
            outcome.all()
        );
    }
    let out = project.file("out/the report");
    let html = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(html.contains("Deferred shading") && html.contains("data:image/png;base64,"));
    let json = fs::read_to_string(out.join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    let report = &report["points"][0]["comparison"];
    assert_eq!(report["reference"], "forward_single_pass");
    assert_eq!(report["scene"], "tiny");
    assert_eq!(
        (&report["frames"], &report["warmup_frames"]),
        (&8.into(), &1.into())
    );
    let line = report["command_line"].as_str().unwrap();
    assert!(line.starts_with("lightbench compare tiny") && line.contains("'out/the report'"));
    assert!(!report["machine"]["cpu"].as_str().unwrap().is_empty());
    assert!(!report["adapter"]["driver"].as_str().unwrap().is_empty());
    let set = report["parameters"].as_array().unwrap();
    assert!(
        set.iter()
            .any(|p| p["name"] == "light" && p["value"] == "5"),
        "{set:?}"
    );

    // Every text that went in, scripts and shaders, with its hash.
    let inputs = report["inputs"].as_array().unwrap();
    for path in [
        "scripts/scenes/tiny.rhai",
        "scripts/pipelines/deferred_shading.rhai",
        "scripts/pipelines/parts/output.rhai",
        "shaders/deferred_shading/light.wgsl",
        "shaders/lib/lighting.wgsl",
    ] {
        let input = inputs.iter().find(|input| input["path"] == path);
        assert_eq!(input.unwrap()["hash"].as_str().unwrap().len(), 64, "{path}");
    }

    let pipelines = report["pipelines"].as_array().unwrap();
    assert_eq!(pipelines.len(), 2);
    let volumes = pipelines[1]["parameters"].as_array().unwrap();
    assert!(
        volumes
            .iter()
            .any(|p| p["name"] == "light_volumes" && p["value"] == "off")
    );
    for pipeline in pipelines {
        assert_eq!(pipeline["frame_cpu_ms"].as_array().unwrap().len(), 8);
        let targets = pipeline["targets"].as_array().unwrap();
        let bytes: u64 = targets.iter().map(|t| t["bytes"].as_u64().unwrap()).sum();
        assert_eq!(pipeline["target_bytes_total"], bytes);
        let passes = pipeline["passes"].as_array().unwrap();
        assert!(passes.iter().any(|pass| pass["kind"] == "geometry"));
        for pass in passes {
            let timed = pass["gpu_ms"].as_array().map(Vec::len);
            assert!(timed == Some(8) || pass["why_not"].is_string(), "{pass}");
        }
        let picture = pipeline["picture_file"].as_str().unwrap();
        assert_eq!(open(&out.join(picture)).dimensions(), (64, 36));
    }
    // Both draw the same scene: the pictures agree.
    let flip = pipelines[1]["difference"]["flip"]["mean"].as_f64().unwrap();
    assert!(flip < 0.01, "{flip}");
    assert!(pipelines[1]["linear_difference"]["rmse"].as_f64().unwrap() < 0.01);
    assert!(pipelines[0]["difference"].is_null());
}

#[test]
fn a_picture_of_a_report_is_the_one_that_render_makes() {
    let project = Project::new();
    let arguments = [
        "compare",
        "tiny",
        "--pipelines",
        "deferred_shading",
        "--size",
        "64x36",
        "--frames",
        "4",
        "--start",
        "3",
        "--processes",
        "1",
        "--out",
        "report",
    ];
    project.run(&arguments).succeeded();
    project
        .render("tiny", "x.png", &["--frame", "3"])
        .succeeded();
    let reported = open(&project.file("report/pictures/deferred_shading.png")).into_rgb8();
    assert_eq!(reported, open(&project.file("x.png")).into_rgb8());
}

#[test]
fn wrong_comparisons_are_explained() {
    let project = Project::new();
    let compare = |more: &[&str]| project.run(&[&["compare", "tiny", "--out", "r"], more].concat());
    compare(&["--pipelines", "deferred_shadng"]).failed(1, &["did you mean `deferred_shading`?"]);
    compare(&["--pipelines", "deferred_shading,deferred_shading"]).failed(2, &["twice"]);
    compare(&["--pipelines", "deferred_shading,,"]).failed(2, &["empty"]);
    compare(&["--frames", "0"]).failed(2, &["--frames"]);
    compare(&[
        "--pipelines",
        "deferred_shading",
        "--reference",
        "forward_single_pas",
    ])
    .failed(2, &["--reference"]);
    assert!(!project.file("r/report.html").exists());
}
