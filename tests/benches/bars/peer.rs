//! The scene with which Bevy 0.20 was measured on two cores and Mesa's software driver: 256 spheres of
//! about 700 triangles over a floor, 256 point lights of range 4 m, GGX, no shadows, 1280 × 720.
//!
//! Bevy's frames took 800 ms clustered forward and 380 ms deferred. Those are times of a quiet machine:
//! on one that is busy, or another, the numbers here say little.

use lightbench::lab::statistics::Summary;
use lightbench::script::Settings;
use lightbench_tests::{Studio, settings};

use crate::bar::Bars;
use crate::sums::{gpu_times, measured};

/// Pipelines of the same family, with the time of Bevy's in milliseconds.
const PIPELINES: [(&str, f64); 6] = [
    ("clustered_forward", 800.0),
    ("tiled_forward", 800.0),
    ("clustered_deferred", 380.0),
    ("tiled_deferred", 380.0),
    ("deferred_shading", 380.0),
    ("visibility_buffer", 380.0),
];
/// At most half.
const BOUND: f64 = 0.5;

/// Measures ours.
pub fn run(bars: &mut Bars) {
    let scene = ["lights=256", "range=4", "reflection=ggx", "segments=14"];
    let mut studio = Studio::new("many_lights", &settings(&scene));
    let compile = |(name, _): (&str, f64)| studio.compile(name, &Settings::new());
    let mut pipelines: Vec<_> = PIPELINES.into_iter().map(compile).collect();
    let measured = measured(&mut studio, &mut pipelines);
    for (name, theirs) in PIPELINES {
        let times = Summary::of(gpu_times(&measured, name)).unwrap();
        let remark = format!(" ({:.0} ms, fastest {:.0}, / {theirs} ms)", times.median, times.min);
        bars.at_most(&format!("{name} to Bevy"), times.median / theirs, BOUND, &remark);
    }
}
