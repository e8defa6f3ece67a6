//! What it takes to find the lights of tiles and clusters, as a share of the frame.
//!
//! Tiled deferred shading is not here: it finds lights in the pass that shades, by the same functions
//! as tiled forward shading.

use lightbench::script::Settings;

use crate::bar::{Bars, median};
use crate::frames::{Times, draw};
use crate::sums::studio;

/// Pipelines, with the first and the last pass that find lights.
const PIPELINES: [(&str, &str, &str); 3] = [
    ("tiled_forward", "light_spheres", "cull"),
    ("clustered_forward", "light_spheres", "fill"),
    ("clustered_deferred", "light_spheres", "fill"),
];
/// Frames measured of each part.
const FRAMES: usize = 9;

/// Measures the share at 1,024 lights.
pub fn run(bars: &mut Bars) {
    let mut studio = studio("1024");
    for (name, first, last) in PIPELINES {
        let mut pipeline = studio.compile(name, &Settings::new());
        let place = |pass: &str| {
            pipeline
                .desc
                .passes
                .iter()
                .position(|p| p.name == pass)
                .unwrap()
        };
        let (first, last) = (place(first), place(last));
        // Finding lights takes what a frame that ends after it takes longer than one that ends
        // before. A software driver takes timestamps of compute passes when it queues them, so these
        // say nothing. Of passes at the beginning, all of the frame counts.
        let ends = [first.checked_sub(1), Some(last), None];
        let mut times: [Times; 3] = Default::default();
        for _ in 0..FRAMES + 1 {
            for (times, end) in times.iter_mut().zip(ends) {
                pipeline.stop_after(end);
                times.take(|| draw(&mut studio, &mut pipeline));
            }
        }
        // The first frame compiles.
        times.iter_mut().for_each(|times| times.warm(1));
        let [before, after, whole] = times.map(|times| median(times.judged(bars.software)));
        let before = if first == 0 { 0.0 } else { before };
        let found = after - before;
        let remark = format!("({found:.1} ms of {whole:.1} ms)");
        let what = format!("1024 lights, {name}: culling and lists as a share of the frame");
        bars.at_most(&what, found / whole, 0.2, &remark);
    }
}
