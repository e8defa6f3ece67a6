//! What lists of lights save: tiled and clustered pipelines against those without lists.

use lightbench::assets::Progress;
use lightbench::lab::measure::{MeasureOptions, Measurement, measure};
use lightbench::lab::report::PipelineResult;
use lightbench::render::Pipeline;
use lightbench_tests::{Studio, settings};

use crate::SIZE;
use crate::bar::Bars;

/// Frames measured of each pipeline.
const FRAMES: u32 = 7;
/// The pipelines with lists.
pub const LISTED: [&str; 4] = [
    "tiled_forward",
    "tiled_deferred",
    "clustered_forward",
    "clustered_deferred",
];

/// Compares at 256 lights and at 1,024.
pub fn run(bars: &mut Bars) {
    let mut studio = studio("256");
    let (all, gathered) = ("forward_single_pass all", "forward_single_pass gathered");
    let mut pipelines = vec![
        named(&studio, all, "forward_single_pass", &["gather_lights=off"]),
        named(&studio, gathered, "forward_single_pass", &[]),
    ];
    pipelines.extend(LISTED.map(|name| named(&studio, name, name, &[])));
    let measured = measured(&mut studio, &mut pipelines);
    for name in LISTED {
        let what = |other: &str| format!("256 lights, {name} to {other}");
        let times = gpu_times(&measured, name);
        bars.ratio(&what(all), times, gpu_times(&measured, all), 0.25);
        bars.ratio(&what(gathered), times, gpu_times(&measured, gathered), 0.6);
    }
    let mut names = vec!["forward_single_pass"];
    names.extend(LISTED);
    say_lights(&mut studio, &names);

    let mut studio = self::studio("1024");
    let deferred = "deferred_shading";
    let mut pipelines = vec![named(&studio, deferred, deferred, &[])];
    pipelines.extend(LISTED.map(|name| named(&studio, name, name, &[])));
    let measured = self::measured(&mut studio, &mut pipelines);
    for name in LISTED {
        let what = format!("1024 lights, {name} to {deferred}");
        bars.ratio(&what, gpu_times(&measured, name), gpu_times(&measured, deferred), 0.5);
    }
    names[0] = deferred;
    say_lights(&mut studio, &names);
}

/// The scene with so many lights.
pub fn studio(lights: &str) -> Studio {
    Studio::new("many_lights", &settings(&[&format!("lights={lights}")]))
}

/// A pipeline under a name of its own.
fn named(studio: &Studio, name: &str, pipeline: &str, values: &[&str]) -> Pipeline {
    let mut pipeline = studio.compile(pipeline, &settings(values));
    pipeline.desc.name = name.to_owned();
    pipeline
}

/// Measures pipelines in turn.
pub fn measured(studio: &mut Studio, pipelines: &mut [Pipeline]) -> Measurement {
    let options = MeasureOptions {
        size: SIZE,
        warmup: 2,
        frames: FRAMES,
    };
    let (renderer, scene) = (&mut studio.renderer, &mut studio.scene);
    measure(renderer, scene, pipelines, options, &Progress::new()).unwrap()
}

/// The result of a pipeline.
pub fn result<'a>(measured: &'a Measurement, name: &str) -> &'a PipelineResult {
    measured.pipelines.iter().find(|pipeline| pipeline.name == name).unwrap()
}

/// GPU time of its frames.
pub fn gpu_times<'a>(measured: &'a Measurement, name: &str) -> &'a [f64] {
    result(measured, name).gpu_samples().unwrap()
}

/// Says how many lights each pipeline evaluates a pixel, in the mean over the picture.
fn say_lights(studio: &mut Studio, pipelines: &[&str]) {
    for name in pipelines {
        let count = |studio: &mut Studio, map: &str| {
            let image = studio.hdr(name, &settings(&[&format!("heat_map={map}")]), SIZE);
            let sum: f64 = image.texels.iter().map(|texel| f64::from(texel[0])).sum();
            sum / image.texels.len() as f64
        };
        let evaluated = count(studio, "lights_evaluated");
        let reaching = count(studio, "lights_reaching");
        println!("  {name}: {evaluated:.1} lights evaluated a pixel, of which {reaching:.1} reach it");
    }
}
