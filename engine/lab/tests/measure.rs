//! Pictures and measurements of a scene on the device.
#![allow(clippy::unwrap_used)]

use std::thread;
use std::time::Duration;

use lightbench_assets::Progress;
use lightbench_assets::files::Files;
use lightbench_lab::capture::{CaptureError, CaptureOptions, STEP, capture};
use lightbench_lab::measure::{Inputs, MeasureError, MeasureOptions, measure};
use lightbench_render::{Gpu, GpuOptions, Pipeline, Renderer};
use lightbench_script::{Scene, Settings, load_pipeline, load_scene};

const SCENE: &str = r#"
spawn("ball").mesh(sphere(1)).material(material("paint").color(0.8, 0.4, 0.2));
point_light("lamp").at(2, 2, 2).intensity(20).range(10);
camera("main").at(0, 0, 4).look_at(0, 0, 0);
fn update(time, dt) {
    if time > 5.0 { entity("nobody").at(0, 0, 0); }
    entity("ball").at(time, 0, 0);
}
"#;

/// A renderer, the scene, and the pipelines of those names.
fn stage(names: &[&str], files: &Files) -> (Renderer, Scene, Vec<Pipeline>) {
    let renderer = Renderer::new(Gpu::open(&GpuOptions::default()).unwrap());
    let mut compiler = renderer.compiler();
    let compile = |name: &&str| {
        let desc = load_pipeline(files, name, &Settings::new()).unwrap();
        compiler.compile(files, &desc).unwrap()
    };
    let pipelines = names.iter().map(compile).collect();
    let scene = load_scene(files, "moving", &Settings::new(), &Progress::new()).unwrap();
    (renderer, scene, pipelines)
}

fn project() -> (tempfile::TempDir, Files) {
    let folder = tempfile::tempdir().unwrap();
    let scenes = folder.path().join("scripts/scenes");
    std::fs::create_dir_all(&scenes).unwrap();
    std::fs::write(scenes.join("moving.rhai"), SCENE).unwrap();
    let files = Files::with_project(folder.path()).unwrap();
    (folder, files)
}

/// A report says what a pipeline drew with another reflection model than was asked for.
#[test]
fn replaced_reflection_models_are_counted_in_the_notes() {
    let (folder, files) = project();
    let scene = SCENE.replace(".color(0.8, 0.4, 0.2)", ".color(0.8, 0.4, 0.2).ggx(0.3)");
    std::fs::write(folder.path().join("scripts/scenes/moving.rhai"), scene).unwrap();
    let names = ["forward_single_pass", "deferred_lighting"];
    let (mut renderer, mut scene, mut pipelines) = stage(&names, &files);
    let options = MeasureOptions {
        size: (48, 27),
        warmup: 1,
        frames: 3,
        ..MeasureOptions::default()
    };
    let (renderer, scene) = (&mut renderer, &mut scene);
    let measured = measure(renderer, scene, &mut pipelines, options, &Progress::new()).unwrap();
    let notes: Vec<_> = measured.pipelines.iter().map(|p| &p.notes[..]).collect();
    let told = "1 material is drawn with another reflection model: 1 of `ggx` as `ward`";
    assert_eq!(notes, [&[][..], &[told.to_owned()]]);
    // Once, although pipelines took turns.
    assert_eq!(
        renderer.take_warnings(),
        [format!("deferred_lighting: {told}")]
    );
}

const NAMES: [&str; 2] = ["forward_single_pass", "deferred_shading"];

#[test]
fn every_frame_of_every_pipeline_is_measured_at_the_same_moments() {
    let (_folder, files) = project();
    let inputs = Inputs::new();
    let (mut renderer, mut scene, mut pipelines) = stage(&NAMES, &inputs.watch(&files));
    let options = MeasureOptions {
        size: (48, 27),
        warmup: 1,
        frames: 5,
        ..MeasureOptions::default()
    };
    let progress = Progress::new();
    let measured = measure(
        &mut renderer,
        &mut scene,
        &mut pipelines,
        options,
        &progress,
    )
    .unwrap();
    assert_eq!(measured.frames, 5);
    let read: Vec<_> = inputs
        .list(&files)
        .into_iter()
        .map(|input| input.path)
        .collect();
    assert!(
        read.contains(&"shaders/lib/lighting.wgsl".to_owned()),
        "{read:?}"
    );

    for (result, pipeline) in measured.pipelines.iter().zip(&pipelines) {
        assert_eq!(result.frame_cpu_ms.len(), 5);
        assert_eq!(result.passes.len(), pipeline.desc.passes.len());
        let geometry = result
            .passes
            .iter()
            .find(|pass| pass.kind == "geometry")
            .unwrap();
        // One object in one draw, at least the triangles of an octahedron.
        assert!(geometry.draws == 1 && geometry.instances == 1 && geometry.triangles >= 8);
        if let Some(frames) = &result.frame_gpu_ms {
            assert!(
                frames.len() == 5 && frames.iter().all(|ms| *ms > 0.0),
                "{frames:?}"
            );
            // The passes lie inside of the frame.
            for (frame, whole) in frames.iter().enumerate() {
                let passes = result
                    .passes
                    .iter()
                    .map(|p| p.gpu_ms.as_ref().unwrap()[frame]);
                assert!(passes.sum::<f64>() <= whole * 1.001);
            }
        } else {
            assert!(result.gpu_why_not.is_some());
        }

        // The picture is that of the first frame, as a capture takes it from a fresh scene.
        let mut fresh = load_scene(&files, "moving", &Settings::new(), &progress).unwrap();
        let (mut other, _, mut again) = stage(&[result.name.as_str()], &files);
        let options = CaptureOptions {
            size: (48, 27),
            frame: 0,
        };
        let picture = capture(&mut other, &mut fresh, &mut again[0], options, &progress).unwrap();
        assert_eq!(result.picture.as_ref().unwrap(), &picture.output);
        assert_eq!(result.linear, picture.hdr);
    }
}

#[test]
fn what_was_measured_before_a_stop_is_kept() {
    let (_folder, files) = project();
    let (mut renderer, mut scene, mut pipelines) = stage(&NAMES, &files);
    // More frames than are drawn before a busy machine lets the other thread look.
    const FRAMES: u32 = 10_000;
    let options = MeasureOptions {
        size: (16, 9),
        warmup: 0,
        frames: FRAMES,
        ..MeasureOptions::default()
    };
    let progress = Progress::new();
    let seen = progress.clone();
    let stopper = thread::spawn(move || {
        let frame = || -> Option<u32> {
            let label = seen.label();
            let rest = label.strip_prefix("measuring frame ")?;
            rest.split(' ').next()?.parse().ok()
        };
        while frame().is_none_or(|frame| frame < 3) {
            thread::sleep(Duration::from_micros(50));
            assert!(seen.fraction() < 0.9, "nobody saw the third frame");
        }
        seen.cancel();
    });
    let measured = measure(
        &mut renderer,
        &mut scene,
        &mut pipelines,
        options,
        &progress,
    )
    .unwrap();
    stopper.join().unwrap();
    assert!(
        (2..FRAMES).contains(&measured.frames),
        "{}",
        measured.frames
    );
    for result in &measured.pipelines {
        assert_eq!(result.frame_cpu_ms.len(), measured.frames as usize);
        assert!(result.picture.is_some());
    }

    // Stopped before the first frame there is nothing to keep.
    let early = measure(
        &mut renderer,
        &mut scene,
        &mut pipelines,
        MeasureOptions {
            warmup: 1,
            ..options
        },
        &progress,
    );
    assert!(matches!(early, Err(MeasureError::Cancelled(_))));
}

#[test]
fn a_script_that_fails_later_is_an_error_with_its_line() {
    let (_folder, files) = project();
    let (mut renderer, mut scene, mut pipelines) = stage(&NAMES[..1], &files);
    let options = CaptureOptions {
        size: (8, 8),
        frame: (5.0 / STEP) as u32 + 2,
    };
    let failed = capture(
        &mut renderer,
        &mut scene,
        &mut pipelines[0],
        options,
        &Progress::new(),
    );
    match failed {
        Err(CaptureError::Script(problem)) => {
            assert_eq!(
                (&*problem.place.file, problem.place.line),
                ("scripts/scenes/moving.rhai", 6)
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn lights_without_a_place_in_an_array_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = folder.path().join("scripts/scenes");
    std::fs::create_dir_all(&scenes).unwrap();
    // Twelve lights at one place: eight arrays take one each.
    let scene = "for i in 0..12 { point_light(\"lamp\").at(0, 0, 0).range(2); }
        camera(\"main\").at(0, 0, 4).look_at(0, 0, 0);";
    std::fs::write(scenes.join("moving.rhai"), scene).unwrap();
    let files = Files::with_project(folder.path()).unwrap();
    let (mut renderer, mut scene, _) = stage(&[], &files);
    let settings = Settings::new().with("packing", "arrays");
    let desc = load_pipeline(&files, "light_indexed_forward", &settings).unwrap();
    let mut pipelines = [renderer.compiler().compile(&files, &desc).unwrap()];
    let options = MeasureOptions {
        size: (48, 27),
        warmup: 0,
        frames: 2,
        ..MeasureOptions::default()
    };
    let progress = Progress::new();
    let measured = measure(
        &mut renderer,
        &mut scene,
        &mut pipelines,
        options,
        &progress,
    )
    .unwrap();
    let counters = &measured.pipelines[0].counters;
    let of = |name: &str| {
        let found = counters.iter().find(|counter| counter.name == name);
        found
            .unwrap_or_else(|| panic!("{counters:?}"))
            .values
            .clone()
    };
    assert_eq!(of("unplaced_lights of opaque_light_indices"), [4.0; 2]);
    assert_eq!(of("numbered_lights"), [12.0; 2]);
}
