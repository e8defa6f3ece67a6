//! Two pipelines beside the same passes written by hand against wgpu.
//!
//! Both sides run the shipped shaders on targets of the same formats, with the scene uploaded before
//! and the same draws and dispatches. The side by hand knows its passes when it is compiled: it has
//! no description, no lists of passes, no queries, and it extracts nothing from the world. So the
//! ratio is what the machinery of passes costs.

mod deferred;
mod ground;
mod passes;
mod tiled;

use lightbench::render::Pipeline;
use lightbench::render::readback::read_bytes;
use lightbench::script::{Settings, load_pipeline};
use lightbench_tests::{Studio, settings};

use crate::SIZE;
use crate::bar::Bars;
use crate::frames::{Times, draw};
use ground::Ground;

/// Frames measured of each side.
const FRAMES: usize = 16;
/// A pipeline may take so much longer than its passes by hand.
const BOUND: f64 = 1.10;

/// Passes written by hand.
pub trait ByHand {
    /// Records all passes of a frame.
    fn record(&self, ground: &Ground, encoder: &mut wgpu::CommandEncoder);
    /// The picture as a display shows it.
    fn output(&self) -> &wgpu::Texture;
}

/// Compares both pairs.
pub fn run(bars: &mut Bars) {
    // The scene stands still, since the side by hand uploads it once.
    let scene = settings(&["lights=256", "moving=off"]);
    let mut studio = Studio::new("many_lights", &scene);
    for name in ["deferred_shading", "tiled_forward"] {
        let desc = load_pipeline(&studio.files, name, &Settings::new()).unwrap();
        let mut ground = Ground::new(&mut studio, desc, SIZE);
        let by_hand: Box<dyn ByHand> = match name {
            "deferred_shading" => Box::new(deferred::Deferred::new(&mut ground)),
            _ => Box::new(tiled::Tiled::new(&mut ground)),
        };
        let mut pipeline = studio.compile(name, &Settings::new());
        compare(
            bars,
            name,
            &mut studio,
            &ground,
            by_hand.as_ref(),
            &mut pipeline,
        );
    }
}

fn compare(
    bars: &mut Bars,
    name: &str,
    studio: &mut Studio,
    ground: &Ground,
    by_hand: &dyn ByHand,
    pipeline: &mut Pipeline,
) {
    let (mut ours, mut hand) = (Times::default(), Times::default());
    for frame in 0..FRAMES + 2 {
        // Who begins changes from frame to frame.
        for turn in 0..2 {
            if (frame + turn) % 2 == 0 {
                ours.take(|| draw(studio, pipeline));
            } else {
                hand.take(|| ground.draw(|encoder| by_hand.record(ground, encoder)));
            }
        }
    }
    // The first two compile and warm up.
    ours.warm(2);
    hand.warm(2);
    let (_, _, theirs) = studio.renderer.read_output(pipeline).unwrap();
    let picture = read_bytes(&ground.gpu, by_hand.output()).unwrap();
    let pairs = || theirs.iter().zip(&picture);
    let largest = pairs().map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(255);
    let differing = pairs().filter(|(a, b)| a != b).count();
    assert_eq!(theirs.len(), picture.len());
    println!(
        "  {name}: pictures differ in {differing} of {} values, at most by {largest} of 255",
        picture.len()
    );
    // The same shaders on the same driver: any difference would be another frame.
    assert_eq!(
        differing, 0,
        "{name}: the side by hand draws another picture"
    );
    bars.ratio(
        &format!("{name} to its passes by hand"),
        &ours,
        &hand,
        BOUND,
    );
}
