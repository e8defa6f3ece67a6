//! What lists of lights save: tiled and clustered pipelines against those without lists.

use lightbench::script::Settings;
use lightbench_tests::{Studio, settings};

use crate::SIZE;
use crate::bar::Bars;
use crate::frames::in_turn;

/// Frames measured of each pipeline.
const FRAMES: usize = 7;
/// The pipelines with lists, and their settings.
const LISTED: [(&str, &[&str]); 5] = [
    ("tiled_forward", &[]),
    ("tiled_deferred", &[]),
    ("tiled_deferred", &["shading=fragments"]),
    ("clustered_forward", &[]),
    ("clustered_deferred", &[]),
];

/// Compares at 256 lights and at 1,024.
pub fn run(bars: &mut Bars) {
    let forward = "forward_single_pass";
    let mut studio = studio("256");
    let mut pipelines = vec![
        studio.compile(forward, &settings(&["gather_lights=off"])),
        studio.compile(forward, &Settings::new()),
    ];
    pipelines.extend(LISTED.map(|(name, texts)| studio.compile(name, &settings(texts))));
    let times = in_turn(&mut studio, &mut pipelines, FRAMES);
    for ((name, texts), listed) in LISTED.iter().zip(&times[2..]) {
        let name = titled(name, texts);
        let what = |other: &str| format!("256 lights, {name} to {forward} with {other}");
        bars.ratio(&what("all lights"), listed, &times[0], 0.25);
        bars.ratio(&what("gathered lights"), listed, &times[1], 0.6);
    }
    say_lights(&mut studio, forward);

    let deferred = "deferred_shading";
    let mut studio = self::studio("1024");
    let mut pipelines = vec![studio.compile(deferred, &Settings::new())];
    pipelines.extend(LISTED.map(|(name, texts)| studio.compile(name, &settings(texts))));
    let times = in_turn(&mut studio, &mut pipelines, FRAMES);
    for ((name, texts), listed) in LISTED.iter().zip(&times[1..]) {
        let name = titled(name, texts);
        bars.ratio(
            &format!("1024 lights, {name} to {deferred}"),
            listed,
            &times[0],
            0.5,
        );
    }
    say_lights(&mut studio, deferred);
}

/// A pipeline with its settings.
pub fn titled(name: &str, texts: &[&str]) -> String {
    let mut title = name.to_owned();
    for text in texts {
        title += &format!(", {text}");
    }
    title
}

/// The scene with so many lights.
pub fn studio(lights: &str) -> Studio {
    Studio::new("many_lights", &settings(&[&format!("lights={lights}")]))
}

/// Says how many lights a pipeline and those with lists evaluate a pixel, in the mean over the picture.
fn say_lights(studio: &mut Studio, other: &str) {
    let none: &[&str] = &[];
    for (name, texts) in std::iter::once((other, none)).chain(LISTED) {
        let count = |studio: &mut Studio, map: &str| {
            let map = format!("heat_map={map}");
            let texts = [texts, &[&*map]].concat();
            let image = studio.hdr(name, &settings(&texts), SIZE);
            let sum: f64 = image.texels.iter().map(|texel| f64::from(texel[0])).sum();
            sum / image.texels.len() as f64
        };
        let evaluated = count(studio, "lights_evaluated");
        let reaching = count(studio, "lights_reaching");
        println!(
            "  {}: {evaluated:.1} lights evaluated a pixel, of which {reaching:.1} reach it",
            titled(name, texts)
        );
    }
}
