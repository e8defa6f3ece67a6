//! The scene with which Bevy 0.20 was measured on two cores and Mesa's software driver: 256 spheres of
//! about 700 triangles over a floor, 256 point lights of range 4 m, GGX, no shadows, 1280 × 720.
//!
//! Bevy's frames took 800 ms clustered forward and 380 ms deferred, on a quiet machine. Ours are the
//! processor time of a frame, divided among the cores; on another kind of machine they say little.

use lightbench_tests::{Studio, settings};

use crate::bar::{Bars, median};
use crate::frames::in_turn;
use crate::sums::titled;

/// Pipelines of the same family and their settings, with the time of Bevy's in milliseconds.
const PIPELINES: [(&str, &[&str], f64); 7] = [
    ("clustered_forward", &[], 800.0),
    ("tiled_forward", &[], 800.0),
    ("clustered_deferred", &[], 380.0),
    ("tiled_deferred", &[], 380.0),
    ("tiled_deferred", &["shading=fragments"], 380.0),
    ("deferred_shading", &[], 380.0),
    ("visibility_buffer", &[], 380.0),
];
/// Frames measured of each pipeline.
const FRAMES: usize = 7;
/// At most half.
const BOUND: f64 = 0.5;

/// Measures ours.
pub fn run(bars: &mut Bars) {
    let scene = ["lights=256", "range=4", "reflection=ggx", "segments=14"];
    let mut studio = Studio::new("many_lights", &settings(&scene));
    let compile = |(name, texts, _): (&str, &[&str], f64)| studio.compile(name, &settings(texts));
    let mut pipelines: Vec<_> = PIPELINES.into_iter().map(compile).collect();
    let times = in_turn(&mut studio, &mut pipelines, FRAMES);
    for ((name, texts, theirs), times) in PIPELINES.iter().zip(&times) {
        // What all cores together take, if nothing else runs.
        let share = if bars.software {
            f64::from(bars.cores)
        } else {
            1.0
        };
        let ours = median(times.judged(bars.software)) / share;
        let remark = format!(
            "({ours:.0} / {theirs} ms; by the clock {:.0} ms)",
            median(&times.wall)
        );
        let name = titled(name, texts);
        bars.at_most(&format!("{name} to Bevy"), ours / theirs, BOUND, &remark);
    }
}
