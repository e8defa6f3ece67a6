//! Looking into frames with the editor's widgets: pixels, stencil, heat maps.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::collections::BTreeSet;

use egui_kittest::kittest::Queryable as _;
use lightbench::render::readback::read_bytes;

use ui_support::Bench;

/// The colours of the picture at the left, which only the heat map's own pipeline makes.
fn colors(bytes: &[u8]) -> BTreeSet<&[u8]> {
    bytes.chunks(4).collect()
}

#[test]
fn a_heat_map_takes_the_place_of_the_picture_and_stays_when_the_pipeline_changes() {
    let mut bench = Bench::open();
    let picture = bench.picture();
    bench.choose("Show", "Lights evaluated");
    let heat = bench.until_picture_is_not(&picture);
    assert!(colors(&heat).len() < 20, "counts have few colours");
    bench.harness.run_steps(2);

    bench.choose("Pipeline", "Forward, multi-pass");
    bench.until("the other pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_multi_pass")
    });
    let other = bench.picture();
    assert!(colors(&other).len() < 20, "the heat map is still on");

    bench.choose("Show", "Picture");
    let back = bench.until_picture_is_not(&other);
    assert!(colors(&back).len() > 100);
    bench.choose("Pipeline", "Deferred shading");
    bench.until("the first pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("deferred_shading")
            && editor.workbench.picture_is_current()
    });
    assert_eq!(bench.picture(), picture);
}

/// Clicks, and compares what is said of the last pass with what is on the screen.
fn click_and_compare(bench: &mut Bench) {
    bench.click_at(egui::pos2(300.0, 350.0));
    bench.until("the values", |editor| {
        !editor.workbench.probing.is_waiting() && !editor.workbench.probing.values.is_empty()
    });
    let probing = bench.harness.state().workbench.probing.clone();
    let passes: BTreeSet<&str> = probing.values.iter().map(|v| v.pass.as_str()).collect();
    assert!(passes.contains("g_buffer") && passes.contains("lights") && passes.contains("output"));
    // The last value is what is on the screen.
    let last = probing.values.last().unwrap();
    assert_eq!(
        (last.pass.as_str(), last.target.as_str()),
        ("output", "output")
    );
    let (x, y) = probing.pixel.unwrap();
    let (width, _) = bench.harness.state().workbench.drawn_size().unwrap();
    let bytes = bench.picture();
    let texel = &bytes[((y * width + x) * 4) as usize..][..3];
    let said: Vec<f32> = last
        .after
        .split(' ')
        .map(|word| word.parse().unwrap())
        .collect();
    for (byte, value) in texel.iter().zip(&said) {
        assert!(
            (f32::from(*byte) - value * 255.0).abs() < 0.51,
            "{texel:?} and {said:?}"
        );
    }
}

#[test]
fn a_click_tells_what_each_pass_did_to_the_pixel() {
    let mut bench = Bench::open();
    click_and_compare(&mut bench);
    bench.harness.run_steps(2);
    assert!(bench.count("g_albedo") > 0, "the table is on the screen");

    bench.harness.get_by_label("Find invalid numbers").click();
    bench.until("the search", |editor| {
        editor.workbench.probing.invalid.is_some()
    });
    bench.harness.run_steps(2);
    assert!(bench.count("Every value that a pass writes is a finite number.") > 0);
}

/// On slow adapters what changes is drawn small at first; what is looked into is not.
#[test]
fn a_click_reads_the_picture_that_is_on_the_screen_whatever_its_scale() {
    let mut bench = Bench::open();
    let full = bench.harness.state().workbench.drawn_size();
    let resolution = &mut bench.harness.state_mut().workbench.resolution;
    resolution.adaptive = true;
    resolution.measured(resolution.scale(true), 10_000.0);
    assert!(resolution.scale(true) < 0.2);
    click_and_compare(&mut bench);
    let workbench = &mut bench.harness.state_mut().workbench;
    assert_eq!(workbench.drawn_size(), full);
    let first = workbench.probing.values.clone();
    workbench.probe_again();
    bench.until("the values", |editor| {
        !editor.workbench.probing.is_waiting()
    });
    assert_eq!(bench.harness.state().workbench.probing.values, first);
}

#[test]
fn invalid_numbers_are_found_in_the_pass_that_makes_them() {
    let mut bench = Bench::open();
    let (path, text) = bench.own("shaders/sky.wgsl");
    let broken = text.replace(
        "return vec4f(scene::frame.sky, 1.0);",
        "let zero = min(scene::frame.resolution.x, 0.0);\n    return vec4f(1.0 / zero);",
    );
    assert_ne!(broken, text);
    let before = bench.harness.state().workbench.pipelines.swaps();
    std::fs::write(&path, &broken).unwrap();
    bench.until("the new sky", |editor| {
        editor.workbench.pipelines.swaps() > before && editor.workbench.picture_is_current()
    });
    bench.harness.state_mut().workbench.find_invalid();
    bench.until("the search", |editor| {
        editor.workbench.probing.invalid.is_some()
    });
    let said = bench
        .harness
        .state()
        .workbench
        .probing
        .invalid
        .clone()
        .unwrap();
    assert!(
        said.starts_with("The pass sky leaves values in hdr"),
        "{said}"
    );
}

#[test]
fn stencil_is_shown_beside_depth() {
    let mut bench = Bench::open();
    let pipelines = &mut bench.harness.state_mut().workbench.pipelines;
    pipelines.set("volume_stencil", "two_pass".into());
    bench.until("the pipeline with stencil", |editor| {
        let pipeline = editor.workbench.pipelines.shown_pipeline();
        pipeline.is_some_and(|p| p.desc.target("g_depth").is_some())
    });
    bench.choose("Target", "depth");
    bench.until("the target", |editor| {
        editor.workbench.inspected().is_some()
    });
    bench.harness.run_steps(2);
    bench.harness.get_by_label("Stencil").click();
    bench.harness.run_steps(2);
    bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.inspected().unwrap();
    let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
    // After the frame all marks are gone again.
    assert_eq!(colors(&bytes), BTreeSet::from([&[0, 0, 0, 255][..]]));
}
