//! Pictures and memory after changes of size: as if the pipeline had never drawn another one.
#![allow(clippy::unwrap_used)]

use lightbench::render::Pipeline;
use lightbench::script::{Settings, list_pipelines};
use lightbench_tests::{Studio, settings};

/// The picture of a pipeline at a size, and the bytes that its targets and buffers take.
fn draw(studio: &mut Studio, pipeline: &mut Pipeline, size: (u32, u32)) -> (Vec<u8>, u64) {
    let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
    let bytes = studio
        .renderer
        .render_whole(world, assets, pipeline, &studio.view, size, 0.0)
        .unwrap()
        .target_bytes;
    (studio.renderer.read_output(pipeline).unwrap().2, bytes)
}

#[test]
fn odd_sizes_and_single_pixels_leave_nothing_behind() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=300", "spheres=80"]));
    for entry in list_pipelines(&studio.files).unwrap() {
        let mut pipeline = studio.compile(&entry.name, &Settings::new());
        for size in [(211, 118), (37, 23), (1, 1), (96, 64), (1, 1), (640, 3)] {
            let (picture, bytes) = draw(&mut studio, &mut pipeline, size);
            let mut fresh = studio.compile(&entry.name, &Settings::new());
            let (expected, fresh_bytes) = draw(&mut studio, &mut fresh, size);
            assert_eq!(picture, expected, "{} at {size:?}", entry.name);
            // What a larger picture's lists needed is given back as pixels are; lists that grew at
            // this size have half as much again to spare.
            assert!(
                bytes as f64 <= 1.5 * fresh_bytes as f64,
                "{} at {size:?}: {bytes} bytes instead of {fresh_bytes}",
                entry.name
            );
        }
    }
}

#[test]
fn released_targets_are_made_again() {
    let mut studio = Studio::new("cornell_box", &Settings::new());
    let mut pipeline = studio.compile("clustered_deferred", &Settings::new());
    let before = draw(&mut studio, &mut pipeline, (64, 64));
    pipeline.release_targets();
    assert!(pipeline.targets().is_none());
    assert_eq!(draw(&mut studio, &mut pipeline, (64, 64)), before);
}
