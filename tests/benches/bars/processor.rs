//! What the engine takes of the processor for a frame: all systems, extraction, uploads, recording
//! and submission, as CPU time of the thread. The device is idle when a frame begins.

use lightbench::lab::capture::STEP;
use lightbench::lab::statistics::median;
use lightbench::script::{Settings, list_pipelines};
use lightbench::world::{MeshRenderer, SystemTime};
use lightbench_tests::{Studio, settings};

use crate::bar::Bars;

/// Small, since drawing is no part of it.
const SIZE: (u32, u32) = (64, 36);
/// Frames measured of each pipeline, after some to warm up.
const FRAMES: u32 = 40;
const WARMUP: u32 = 3;
/// The pipeline whose draws grow with the number of lights; it has a bar of its own.
const MULTI_PASS: &str = "forward_multi_pass";

/// Measures all pipelines on both scenes.
pub fn run(bars: &mut Bars) {
    // Few triangles, since the driver has to draw them all before the next frame begins.
    let many = ["spheres=10000", "lights=1024", "segments=4"];
    for (scene, values, bound) in [("atrium", &[][..], 1.0), ("many_lights", &many[..], 4.0)] {
        let mut studio = Studio::new(scene, &settings(values));
        let objects = studio.scene.world.columns::<MeshRenderer>().len();
        println!("  {scene} {}: {objects} objects", values.join(" "));
        for entry in list_pipelines(&studio.files).unwrap() {
            let (median, draws) = measure(&mut studio, &entry.name);
            let remark = format!("({draws} draws)");
            if entry.name == MULTI_PASS {
                let what = format!("{scene}, {}: microseconds a draw", entry.name);
                bars.at_most(&what, median * 1e3 / f64::from(draws.max(1)), 1.0, &remark);
            } else {
                let what = format!("{scene}, {}: CPU ms a frame", entry.name);
                bars.at_most(&what, median, bound, &remark);
            }
        }
    }
}

/// The median of a pipeline's frames in milliseconds, and the draws of the last.
fn measure(studio: &mut Studio, pipeline: &str) -> (f64, u32) {
    let mut pipeline = studio.compile(pipeline, &Settings::new());
    let mut times = Vec::new();
    let mut draws = 0;
    for frame in 0..WARMUP + FRAMES {
        let time = f64::from(frame) * STEP;
        studio.scene.update(time, STEP).unwrap();
        // The script is the scene's and not the engine's.
        let systems = studio
            .scene
            .system_times()
            .filter(|system| system.name != "script");
        let systems: f64 = systems.map(|system| system.thread_ms()).sum();
        studio.renderer.set_frame_index(frame);
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        let (drawing, statistics) = SystemTime::of("drawing", || {
            let renderer = &mut studio.renderer;
            renderer
                .render(world, assets, &mut pipeline, &studio.view, SIZE, time)
                .unwrap()
                .clone()
        });
        let measured = studio.renderer.finish(60).unwrap();
        pipeline.grow(&measured);
        if frame >= WARMUP {
            times.push(systems + drawing.thread_ms());
            draws = statistics.passes.iter().map(|pass| pass.draws).sum();
        }
    }
    (median(&times).unwrap(), draws)
}
