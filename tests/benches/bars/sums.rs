//! What lists of lights save: tiled and clustered pipelines against those without lists.

use lightbench::script::Settings;
use lightbench_tests::{Studio, settings};

use crate::SIZE;
use crate::bar::Bars;
use crate::frames::in_turn;

/// Frames measured of each pipeline.
const FRAMES: usize = 7;
/// The pipelines with lists.
const LISTED: [&str; 4] = [
    "tiled_forward",
    "tiled_deferred",
    "clustered_forward",
    "clustered_deferred",
];

/// Compares at 256 lights and at 1,024.
pub fn run(bars: &mut Bars) {
    let forward = "forward_single_pass";
    let mut studio = studio("256");
    let mut pipelines = vec![
        studio.compile(forward, &settings(&["gather_lights=off"])),
        studio.compile(forward, &Settings::new()),
    ];
    pipelines.extend(LISTED.map(|name| studio.compile(name, &Settings::new())));
    let times = in_turn(&mut studio, &mut pipelines, FRAMES);
    for (name, listed) in LISTED.iter().zip(&times[2..]) {
        let what = |other: &str| format!("256 lights, {name} to {forward} with {other}");
        bars.ratio(&what("all lights"), listed, &times[0], 0.25);
        bars.ratio(&what("gathered lights"), listed, &times[1], 0.6);
    }
    say_lights(&mut studio, forward);

    let deferred = "deferred_shading";
    let mut studio = self::studio("1024");
    let mut pipelines = vec![studio.compile(deferred, &Settings::new())];
    pipelines.extend(LISTED.map(|name| studio.compile(name, &Settings::new())));
    let times = in_turn(&mut studio, &mut pipelines, FRAMES);
    for (name, listed) in LISTED.iter().zip(&times[1..]) {
        bars.ratio(
            &format!("1024 lights, {name} to {deferred}"),
            listed,
            &times[0],
            0.5,
        );
    }
    say_lights(&mut studio, deferred);
}

/// The scene with so many lights.
pub fn studio(lights: &str) -> Studio {
    Studio::new("many_lights", &settings(&[&format!("lights={lights}")]))
}

/// Says how many lights a pipeline and those with lists evaluate a pixel, in the mean over the picture.
fn say_lights(studio: &mut Studio, other: &str) {
    for name in std::iter::once(other).chain(LISTED) {
        let count = |studio: &mut Studio, map: &str| {
            let image = studio.hdr(name, &settings(&[&format!("heat_map={map}")]), SIZE);
            let sum: f64 = image.texels.iter().map(|texel| f64::from(texel[0])).sum();
            sum / image.texels.len() as f64
        };
        let evaluated = count(studio, "lights_evaluated");
        let reaching = count(studio, "lights_reaching");
        println!(
            "  {name}: {evaluated:.1} lights evaluated a pixel, of which {reaching:.1} reach it"
        );
    }
}
