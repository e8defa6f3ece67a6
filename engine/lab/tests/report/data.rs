//! A made-up study of the size that a report must hold.

use lightbench_lab::diff::DiffOptions;
use lightbench_lab::report::{
    AbilityResult, Comparison, CounterResult, Input, Parameter, PassResult, PipelineResult,
    ProcessRecord, SCHEMA, Seed, SystemResult, TargetResult, ViewResult,
};
use lightbench_lab::study::{Axis, Choice, Plan, Point, Study};
use lightbench_lab::{HdrImage, LdrImage};

/// The pipelines that come with Lightbench, without one.
pub const NAMES: [&str; 13] = [
    "forward_single_pass",
    "forward_multi_pass",
    "deferred_shading",
    "deferred_lighting",
    "inferred_lighting",
    "light_indexed_forward",
    "light_indexed_deferred",
    "tiled_forward",
    "tiled_deferred",
    "clustered_forward",
    "clustered_deferred",
    "visibility_buffer",
    "world_indexed_forward",
];

/// A number that looks random, the same for the same input: the finaliser of SplitMix64 (Steele et
/// al. 2014).
fn hash(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A floor with a grainy texture, shaded spheres before it, and lights; another pipeline rounds some
/// pixels differently and shifts the spheres' edges.
fn picture(pipeline: u64, point: u64, [width, height]: [u32; 2]) -> LdrImage {
    let shift = if pipeline == 0 { 0.0 } else { 0.0015 };
    LdrImage::from_fn(width, height, |x, y| {
        let at = u64::from(y * width + x);
        let (u, v) = (
            f64::from(x) / f64::from(width),
            f64::from(y) / f64::from(height),
        );
        let grain = (hash(at ^ point << 32) % 17) as f64 - 8.0;
        let mut light = 60.0 + 90.0 * v + grain;
        for ball in 0..6_u64 {
            let centre = (0.1 + 0.16 * ball as f64, 0.35 + 0.05 * (ball % 3) as f64);
            let (dx, dy) = (u - centre.0 + shift, (v - centre.1) * 0.5625);
            let distance = (dx * dx + dy * dy).sqrt() / 0.07;
            if distance < 1.0 {
                light = 230.0 * (1.0 - distance * distance).sqrt() + 10.0;
            }
        }
        let rounding = u64::from(pipeline > 0 && hash(at ^ pipeline << 40).is_multiple_of(30));
        let channel = |share: f64| (light * share).clamp(0.0, 254.0) as u8 + rounding as u8;
        [channel(1.0), channel(0.85), channel(0.7), 255]
    })
}

fn times(median: f64, seed: u64, count: u64) -> Vec<f64> {
    let spread = |i: u64| (hash(seed << 20 ^ i) % 1000) as f64 / 1000.0 - 0.5;
    (0..count)
        .map(|i| median * (1.0 + 0.03 * spread(i)))
        .collect()
}

fn pipeline(number: usize, point: u64, lights: f64, size: [u32; 2]) -> PipelineResult {
    let name = NAMES[number];
    let seed = number as u64 * 100 + point;
    // Some grow with the number of lights and some hardly do.
    let ms = match name.contains("tiled") || name.contains("clustered") {
        true => 14.0 + number as f64 + 0.01 * lights,
        false => 6.0 + 0.5 * number as f64 + (0.08 + 0.01 * number as f64) * lights,
    };
    let pass = |name: &str, kind: &str, share: f64, draws: u64| PassResult {
        name: name.into(),
        kind: kind.into(),
        gpu_ms: Some(times(ms * share, seed + draws, 60)),
        cpu_ms: times(0.05, seed, 60),
        draws,
        triangles: draws * 1200,
        fragments: Some(draws * 5000),
        vertices: Some(draws * 900),
        bytes_read: 4 << 20,
        bytes_written: 8 << 20,
        bytes_overdraw: Some(1 << 20),
        why_not: Some("no bytes of textures are counted".into()),
        ..PassResult::default()
    };
    let target = |name: &str, format: &str, pixel: u64| TargetResult {
        name: name.into(),
        format: format.into(),
        size,
        samples: 1,
        bytes: u64::from(size[0]) * u64::from(size[1]) * pixel,
    };
    let mut passes = vec![pass("geometry", "geometry", 0.4, 80)];
    if number % 2 == 1 {
        passes.push(pass("lights", "compute", 0.2, 0));
    }
    passes.push(pass("output", "fullscreen", 0.3, 1));
    let targets = vec![
        target("depth", "Depth32Float", 4),
        target("hdr", "Rgba16Float", 8),
        target("output", "Rgba8UnormSrgb", 4),
    ];
    let picture = picture(number as u64, point, size);
    PipelineResult {
        name: name.into(),
        title: name.replace('_', " "),
        description: "Made up.".into(),
        parameters: vec![Parameter {
            name: "accumulation".into(),
            value: "rgba16float".into(),
        }],
        features_needed: vec!["timestamps".into()],
        frame_cpu_ms: times(0.3, seed, 60),
        process_frames: vec![20; 3],
        settled_after: vec![5; 3],
        frame_wall_ms: times(ms * 1.1, seed, 60),
        unqueried_wall_ms: times(ms * 1.08, seed, 12),
        frame_gpu_ms: Some(times(ms, seed, 60)),
        systems: vec![SystemResult {
            name: "script".into(),
            thread_ms: times(0.1, seed, 60),
        }],
        passes,
        target_bytes_total: targets.iter().map(|t| t.bytes).sum(),
        targets,
        counters: vec![CounterResult {
            name: "lights_on_lists".into(),
            description: "Lights on lists".into(),
            values: vec![lights; 60],
        }],
        abilities: vec![AbilityResult {
            name: "transparency".into(),
            supported: true,
            text: "in a forward pass".into(),
        }],
        views: vec![ViewResult {
            name: "lights evaluated".into(),
            description: "viridis, up to 64".into(),
            file: None,
            picture: Some(LdrImage::from_fn(size[0], size[1], |x, y| {
                [(x / 32) as u8 * 10, (y / 32) as u8 * 20, 90, 255]
            })),
        }],
        linear: Some(HdrImage::from_fn(size[0], size[1], |x, y| {
            let [r, g, b, _] = picture.pixels[(y * size[0] + x) as usize];
            [r, g, b, 255].map(|v| (f32::from(v) / 255.0).powf(2.2) * 4.0)
        })),
        picture: Some(picture),
        ..PipelineResult::default()
    }
}

/// A study of so many pipelines at so many points.
pub fn study(pipelines: usize, points: usize, size: [u32; 2]) -> Study {
    let lights = |point: usize| 16 << (2 * point);
    let value = |name: &str, value: String| Parameter {
        name: name.into(),
        value,
    };
    let points = (0..points).map(|point| {
        let mut comparison = Comparison {
            schema: SCHEMA,
            title: "Made up".into(),
            scene: "atrium".into(),
            command_line: "lightbench compare study.toml --out out".into(),
            created: "2026-11-22T10:30:00Z".into(),
            program_version: "0.1.0".into(),
            size,
            frames: 20,
            warmup_frames: 10,
            processes: (0..3)
                .map(|index| ProcessRecord {
                    index,
                    started: "2026-11-22T10:30:00Z".into(),
                    seconds: 5.0,
                    load_average: Some(0.1),
                    processor_mhz: Some(3000.0),
                })
                .collect(),
            reference: NAMES[0].into(),
            parameters: vec![value("lights", lights(point).to_string())],
            seeds: vec![Seed {
                name: "scene".into(),
                value: 7,
            }],
            inputs: vec![Input {
                path: "scripts/scenes/atrium.rhai".into(),
                algorithm: "SHA-256".into(),
                hash: "9f2feb0f".into(),
            }],
            pipelines: (0..pipelines)
                .map(|number| pipeline(number, point as u64, f64::from(lights(point)), size))
                .collect(),
            heat_map_scale: 1.0,
            ..Comparison::default()
        };
        comparison.compare_pictures(DiffOptions::default()).unwrap();
        Point {
            key: format!("scene=atrium,lights={}", lights(point)),
            coordinates: vec![
                value("scene", "atrium".into()),
                value("lights", lights(point).to_string()),
            ],
            comparison,
        }
    });
    let choice = |path: &str| Choice {
        label: Some(path.replace('_', " ")),
        path: path.into(),
        settings: vec![value("accumulation", "rgba16float".into())],
    };
    let points: Vec<Point> = points.collect();
    Study {
        schema: SCHEMA,
        plan: Plan {
            title: "Made up".into(),
            scenes: vec![choice("atrium")],
            pipelines: NAMES[..pipelines].iter().map(|name| choice(name)).collect(),
            axes: vec![Axis {
                name: "lights".into(),
                values: (0..points.len()).map(|p| lights(p).to_string()).collect(),
            }],
            size,
            reference: NAMES[0].into(),
            warmup: 10,
            frames: 20,
            step: 1.0 / 60.0,
            processes: 3,
            seconds: 60.0,
            ..Plan::default()
        },
        points,
        missing: vec![],
    }
}
