//! The editor driven through its real widgets, on a real device, without a window.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Key, pos2};
use egui_kittest::kittest::Queryable as _;
use lightbench::render::readback::read_bytes;
use lightbench::render::{Gpu, GpuOptions};
use lightbench_editor::ui::workbench::Workbench;

use ui_support::{Bench, PATIENCE};

const FORWARD: &str = "Forward, single pass";
const OUTPUT_SHADER: &str = "shaders/output.wgsl";

#[test]
fn choosing_a_pipeline_swaps_it_and_keeps_scene_camera_and_time() {
    let mut bench = Bench::open();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.clock.step();
    workbench
        .camera
        .orbit(lightbench::world::glam::Vec2::new(0.3, 0.1));
    let deferred = bench.picture();
    let (view, time) = {
        let workbench = &bench.harness.state().workbench;
        (workbench.camera.view(), workbench.clock.time())
    };

    bench.choose("Pipeline", FORWARD);
    bench.until("the other pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
    let forward = bench.picture();
    assert_eq!(forward.len(), deferred.len());
    // The same light by another way: not the same bits, but the same picture.
    assert_ne!(forward, deferred, "another pipeline drew the same bits");
    let difference: u64 = forward
        .iter()
        .zip(&deferred)
        .map(|(a, b)| u64::from(a.abs_diff(*b)))
        .sum();
    assert!((difference as f64) < 2.0 * forward.len() as f64);
    let workbench = &bench.harness.state().workbench;
    assert_eq!(workbench.camera.view(), view);
    assert_eq!(workbench.clock.time(), time);
    assert_eq!(workbench.scenes.shown(), Some("cornell_box"));

    // Back by its key: at once, and without compiling.
    let swaps = workbench.pipelines.swaps();
    bench.harness.key_press(Key::Num4);
    bench.harness.step();
    assert_eq!(bench.shown(), "deferred_shading");
    assert_eq!(bench.picture(), deferred);
    assert_eq!(bench.harness.state().workbench.pipelines.swaps(), swaps);
    bench.harness.key_press(Key::Num6);
    bench.harness.step();
    assert_eq!(bench.shown(), "forward_single_pass");
    bench.harness.key_press(Key::OpenBracket);
    bench.until("the pipeline before", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_multi_pass")
    });
}

#[test]
fn a_saved_shader_changes_the_picture_and_a_broken_one_does_not() {
    let mut bench = Bench::open();
    let (path, good) = bench.own(OUTPUT_SHADER);
    let first = bench.picture();

    let darker = good.replace(
        "exp2(parameters.exposure)",
        "exp2(parameters.exposure - 1.0)",
    );
    assert_ne!(darker, good);
    std::fs::write(&path, &darker).unwrap();
    let dark = bench.until_picture_is_not(&first);
    let sum = |bytes: &[u8]| bytes.iter().map(|b| u64::from(*b)).sum::<u64>();
    assert!(sum(&dark) < sum(&first));

    // A type error: the last good picture stays, and the message names file and line.
    let broken = darker.replace("let exposed =", "let exposed: u32 =");
    let line = broken.lines().position(|l| l.contains(": u32 =")).unwrap() + 1;
    std::fs::write(&path, &broken).unwrap();
    bench.until("the mistake", |editor| Bench::has_problems(editor));
    assert_eq!(bench.picture(), dark);
    let place = format!("{OUTPUT_SHADER}:{line}");
    assert!(bench.has_message());
    assert!(bench.count(&place) >= 2, "no {place} over the picture");

    // A file caught half-way through a save.
    std::fs::write(&path, "").unwrap();
    bench.until("the empty file", |editor| {
        editor
            .workbench
            .problems()
            .any(|problem| problem.message.contains("empty"))
    });
    assert_eq!(bench.picture(), dark);
    std::fs::write(&path, &good[..good.len() / 2]).unwrap();
    bench.until("the half file", |editor| {
        editor
            .workbench
            .problems()
            .any(|problem| !problem.message.contains("empty"))
    });
    assert_eq!(bench.picture(), dark);

    std::fs::write(&path, &good).unwrap();
    bench.until("the mended file", |editor| !Bench::has_problems(editor));
    assert_eq!(bench.picture(), first);
    bench.harness.step();
    assert!(!bench.has_message());
}

#[test]
fn a_saved_pipeline_script_changes_the_picture() {
    let mut bench = Bench::open();
    let (path, good) = bench.own("scripts/pipelines/parts/output.rhai");
    let first = bench.picture();
    let brighter = good.replace("p.number(\"exposure\", 0.0", "p.number(\"exposure\", 2.0");
    assert_ne!(brighter, good);
    std::fs::write(&path, brighter).unwrap();
    let bright = bench.until_picture_is_not(&first);

    std::fs::write(&path, good.replace("fn add(", "fn add((")).unwrap();
    bench.until("the mistake", |editor| Bench::has_problems(editor));
    assert_eq!(bench.picture(), bright);
    assert!(bench.has_message());
    assert!(bench.count("parts/output.rhai:") >= 2);

    std::fs::write(&path, good).unwrap();
    bench.until("the mended file", |editor| !Bench::has_problems(editor));
    assert_eq!(bench.until_picture_is_not(&bright), first);
}

#[test]
fn a_parameter_widget_changes_the_picture_without_compiling() {
    let mut bench = Bench::open();
    let first = bench.picture();
    let swaps = bench.harness.state().workbench.pipelines.swaps();
    // The pipeline has more parameters than fit in the panel.
    bench
        .harness
        .get_by_role_and_label(Role::Slider, "Exposure")
        .scroll_to_me();
    bench.harness.run_steps(4);
    let rail = bench
        .harness
        .get_by_role_and_label(Role::Slider, "Exposure")
        .rect();
    bench.click_at(pos2(rail.left() + 0.65 * rail.width(), rail.center().y));
    let bright = bench.until_picture_is_not(&first);
    assert!(
        bright
            .iter()
            .zip(&first)
            .all(|(after, before)| after >= before)
    );
    assert_eq!(bench.harness.state().workbench.pipelines.swaps(), swaps);
    bench
        .harness
        .get_by_role_and_label(Role::Button, "Reset")
        .click();
    assert_eq!(bench.until_picture_is_not(&bright), first);
}

#[test]
fn the_mouse_and_keys_move_the_camera_and_time() {
    let mut bench = Bench::open();
    let first = bench.picture();
    let home = bench.harness.state().workbench.camera.view();
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let at = viewport.rect().center();
    bench.harness.drag_at(at);
    bench.harness.step();
    for step in 1..6 {
        bench
            .harness
            .hover_at(pos2(at.x + 12.0 * step as f32, at.y));
        bench.harness.step();
    }
    bench.harness.drop_at(pos2(at.x + 60.0, at.y));
    bench.harness.run_steps(2);
    let moved = bench.picture();
    assert_ne!(moved, first);
    assert!(bench.harness.state().workbench.camera.is_moved());
    bench
        .harness
        .key_press_modifiers(egui::Modifiers::SHIFT, Key::Home);
    bench.harness.run_steps(2);
    assert_eq!(bench.harness.state().workbench.camera.view(), home);
    assert_eq!(bench.picture(), first);

    bench.harness.key_press(Key::Period);
    bench.harness.run_steps(2);
    let time = bench.harness.state().workbench.clock.time();
    assert!((time - 1.0 / 60.0).abs() < 1e-9);
    bench
        .harness
        .get_by_role_and_label(Role::Button, "Play")
        .click();
    bench.harness.run_steps(3);
    assert!(bench.harness.state().workbench.clock.time() > time);
    bench.harness.key_press(Key::Space);
    bench.harness.run_steps(2);
    assert!(!bench.harness.state().workbench.clock.playing);
}

#[test]
fn any_target_can_be_looked_at_after_any_pass() {
    let mut bench = Bench::open();
    bench.choose("Target", "hdr");
    bench.until("the target", |editor| {
        editor.workbench.inspected().is_some()
    });
    let look = |bench: &mut Bench| {
        bench.harness.run_steps(3);
        let workbench = &mut bench.harness.state_mut().workbench;
        let texture = workbench.inspected().unwrap();
        read_bytes(workbench.gpu(), &texture).unwrap()
    };
    let lit = look(&mut bench);
    assert!(lit.chunks(4).any(|texel| texel[0] > 40));

    // Before the lights there is only what shines by itself.
    bench.choose("After pass", "g_buffer");
    let emitted = look(&mut bench);
    let sum = |bytes: &[u8]| bytes.iter().map(|b| u64::from(*b)).sum::<u64>();
    assert!(sum(&emitted) < sum(&lit));

    bench.choose("Target", "depth");
    let depth = look(&mut bench);
    let colors: std::collections::BTreeSet<&[u8]> = depth.chunks(4).collect();
    assert!(colors.len() > 20, "depth shows {} colours", colors.len());
    bench.choose("Target", "g_normal");
    assert_ne!(look(&mut bench), depth);
}

#[test]
fn a_window_of_another_size_takes_no_memory_for_pipelines_that_are_not_shown() {
    let mut bench = Bench::open();
    bench.choose("Pipeline", FORWARD);
    bench.until("the other pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
    let holds = |bench: &Bench| {
        let slot = bench
            .harness
            .state()
            .workbench
            .pipelines
            .slot("deferred_shading");
        slot.unwrap().pipeline.as_ref().unwrap().targets().is_some()
    };
    assert!(holds(&bench), "a swap back is immediate");
    bench.harness.set_size(egui::vec2(900.0, 600.0));
    bench.until("the memory", |editor| {
        let slot = editor.workbench.pipelines.slot("deferred_shading").unwrap();
        slot.pipeline.as_ref().unwrap().targets().is_none()
    });
    bench.choose("Pipeline", "Deferred shading");
    assert_eq!(bench.shown(), "deferred_shading");
    bench.until("its targets", |editor| {
        let slot = editor.workbench.pipelines.slot("deferred_shading").unwrap();
        slot.pipeline.as_ref().unwrap().targets().is_some()
    });
}

#[test]
fn another_device_takes_over_with_scene_camera_and_time() {
    let mut bench = Bench::open();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench
        .camera
        .look(lightbench::world::glam::Vec2::new(0.1, 0.0));
    workbench.clock.step();
    let size = (160, 90);
    let before = picture(workbench, size);
    let time = workbench.clock.time();

    let gpu = Gpu::open(&GpuOptions::default()).unwrap();
    workbench.move_to(gpu);
    workbench.resolution.adaptive = false;
    assert_eq!(picture(workbench, size), before);
    assert_eq!(workbench.clock.time(), time);
}

/// The picture at that size, once it shows the present state.
fn picture(workbench: &mut Workbench, size: (u32, u32)) -> Vec<u8> {
    let began = Instant::now();
    loop {
        workbench.tick(Instant::now());
        let picture = workbench.draw(size, Instant::now());
        let drawn = workbench.picture_is_current() && workbench.drawn_size() == Some(size);
        if let Some(picture) = picture.filter(|_| drawn) {
            return read_bytes(workbench.gpu(), &picture.texture).unwrap();
        }
        assert!(began.elapsed() < PATIENCE, "no picture");
        std::thread::sleep(Duration::from_millis(5));
    }
}
