//! What it takes to find the lights of tiles and clusters, as a share of the frame.
//!
//! Tiled deferred shading is not here: it finds lights in the pass that shades, by the same functions
//! as tiled forward shading.

use std::time::Instant;

use lightbench::lab::statistics::median;
use lightbench::render::Pipeline;
use lightbench::script::Settings;
use lightbench_tests::Studio;

use crate::SIZE;
use crate::bar::Bars;
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
        let place = |pass: &str| pipeline.desc.passes.iter().position(|p| p.name == pass).unwrap();
        let (first, last) = (place(first), place(last));
        // Finding lights takes what a frame that ends after it takes longer than one that ends
        // before, by the clock on the wall: a software driver takes timestamps of compute passes when
        // it queues them. Of passes at the beginning, all of the frame counts.
        let ends = [first.checked_sub(1), Some(last), None];
        let mut times = [const { Vec::new() }; 3];
        for frame in 0..FRAMES + 1 {
            for (part, times) in times.iter_mut().enumerate() {
                let nothing = part == 0 && first == 0;
                let took = if nothing { 0.0 } else { draw(&mut studio, &mut pipeline, ends[part]) };
                // The first frame compiles.
                if frame > 0 {
                    times.push(took);
                }
            }
        }
        let [before, after, whole] = times.map(|times| median(&times).unwrap());
        let found = after - before;
        let remark = format!(" ({found:.1} ms of {whole:.1} ms)");
        let what = format!("1024 lights, {name}: culling and lists as a share of the frame");
        bars.at_most(&what, found / whole, 0.2, &remark);
    }
}

/// Milliseconds of a frame until the device is idle. It ends after a pass, if one is named.
fn draw(studio: &mut Studio, pipeline: &mut Pipeline, end: Option<usize>) -> f64 {
    pipeline.stop_after(end);
    let start = Instant::now();
    let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
    studio.renderer.set_frame_index(0);
    studio
        .renderer
        .render(world, assets, pipeline, &studio.view, SIZE, 0.0)
        .unwrap();
    let measured = studio.renderer.finish(60).unwrap();
    let took = start.elapsed().as_secs_f64() * 1e3;
    pipeline.grow(&measured);
    took
}
