//! What a ray takes of one core, and how much of that is the tree's.
//!
//! The tree traverses the very rays of the picture once more, and nothing else is done with what they
//! meet.

use lightbench::assets::files::Files;
use lightbench::lab::tracer::{Options, Recorded};
use lightbench::script::Settings;
use lightbench_tests::tracing::Set;

use crate::bar::{Bars, median};
use crate::frames::Times;

/// Pictures of each side.
const TURNS: usize = 9;

/// Measures light along all paths of the atrium, one path a pixel.
pub fn run(bars: &mut Bars) {
    let set = Set::load(&Files::shipped(), "atrium", &Settings::new());
    let options = Options {
        size: (320, 180),
        samples: 1,
        ..Options::default()
    };
    let alone = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let recorded = Recorded::of(&set.scene, &set.view, &options);
    let (mut tracing, mut bare) = (Times::default(), Times::default());
    let (mut rays, mut met) = (0, 0);
    for _ in 0..TURNS + 1 {
        tracing.take(|| rays = alone.install(|| set.trace(&options)).rays);
        bare.take(|| met = recorded.replay(&set.scene));
    }
    // The first of each fetches the scene from memory.
    tracing.warm(1);
    bare.warm(1);
    assert_eq!(rays as usize, recorded.len());
    println!(
        "  {} triangles, {} lights, {} triangles that shine; {rays} rays, {met} meet something",
        set.scene.triangles(),
        set.scene.lights(),
        set.scene.emitters(),
    );
    let each = |times: &Times| median(times.judged(bars.software)) * 1e3 / rays as f64;
    let (a_ray, of_tree) = (each(&tracing), each(&bare));
    let remark = format!(
        "({:.2} million rays a second; the tree alone {:.2})",
        a_ray.recip(),
        of_tree.recip()
    );
    bars.at_most(
        "atrium, microseconds a ray on one core",
        a_ray,
        1.0,
        &remark,
    );
    bars.ratio("atrium, tracing over the bare tree", &tracing, &bare, 2.0);
}
