//! A comparison with made-up numbers for tests. Never part of the program.
#![allow(clippy::unwrap_used)]

use super::model::*;
use crate::LdrImage;
use crate::diff::DiffOptions;
use crate::study::{Axis, Plan, Point, Study};

/// `count` times around a median with a long tail, the same at every call.
pub fn series(median: f64, spread: f64, count: u32) -> Vec<f64> {
    (0..count)
        .map(|i| {
            let t = f64::from((i * 37 + 11) % 101) / 100.0;
            median + spread * (t - 0.5) + if t > 0.97 { 2.0 * spread } else { 0.0 }
        })
        .collect()
}

/// A small scene: a floor, a lit ball and a glow that a pipeline may shift.
pub fn picture(width: u32, height: u32, shift: f64, glow: f64) -> LdrImage {
    LdrImage::from_fn(width, height, |x, y| {
        let (u, v) = (
            f64::from(x) / f64::from(width),
            f64::from(y) / f64::from(height),
        );
        let (dx, dy) = (
            (u - 0.45) * f64::from(width) / f64::from(height) + shift,
            v - 0.5,
        );
        let ball = (dx * dx + dy * dy).sqrt() < 0.3;
        let light = (-8.0 * ((u - 0.75).powi(2) + (v - 0.3).powi(2))).exp() * glow;
        let tile = ((u * 16.0) as u32 + (v * 9.0) as u32) % 2;
        let base = if ball {
            [0.75 - dx + shift, 0.45 - dy, 0.35]
        } else {
            let k = if tile == 0 { 0.3 } else { 0.36 } * (0.6 + 0.6 * v);
            [k, k, k * 1.15]
        };
        let [r, g, b] = [
            base[0] + light,
            base[1] + 0.8 * light,
            base[2] + 0.5 * light,
        ]
        .map(|c| (c.clamp(0.0, 1.0) * 255.0) as u8);
        [r, g, b, 255]
    })
}

fn pass(name: &str, kind: &str, gpu: f64, draws: u64, written: u64) -> PassResult {
    PassResult {
        name: name.into(),
        kind: kind.into(),
        gpu_ms: Some(series(gpu, gpu * 0.06, 60)),
        cpu_ms: series(gpu * 0.02 + 0.01, 0.01, 60),
        draws,
        instances: draws * 12,
        triangles: draws * 1450,
        fragments: Some(draws * 9_000),
        dispatches: u64::from(kind == "compute") * 3600,
        bytes_read: written / 2,
        bytes_written: written,
        bytes_loaded: written / 4,
        bytes_stored: written,
        bytes_overdraw: Some(written / 3),
        why_not: None,
        ..PassResult::default()
    }
}

fn target(name: &str, format: &str, size: [u32; 2], pixel: u64) -> TargetResult {
    let bytes = u64::from(size[0]) * u64::from(size[1]) * pixel;
    TargetResult {
        name: name.into(),
        format: format.into(),
        size,
        samples: 1,
        bytes,
    }
}

/// A pipeline with the given frame time and picture.
pub fn pipeline(name: &str, title: &str, gpu: f64, picture: LdrImage) -> PipelineResult {
    let size = [picture.width, picture.height];
    let deferred = name.contains("deferred");
    let passes = if deferred {
        vec![
            pass("gbuffer", "geometry", gpu * 0.35, 84, 24 << 20),
            pass("tile lights", "compute", gpu * 0.08, 0, 1 << 20),
            pass("lighting", "fullscreen", gpu * 0.45, 1, 7 << 20),
            pass("output", "fullscreen", gpu * 0.07, 1, 3 << 20),
        ]
    } else {
        vec![
            pass("forward", "geometry", gpu * 0.9, 84, 16 << 20),
            pass("output", "fullscreen", gpu * 0.06, 1, 3 << 20),
        ]
    };
    let mut targets = vec![
        target("depth", "Depth32FloatStencil8", size, 5),
        target("hdr", "Rgba16Float", size, 8),
    ];
    if deferred {
        targets.push(target("albedo", "Rgba8UnormSrgb", size, 4));
        targets.push(target("normal", "Rgba16Float", size, 8));
    }
    PipelineResult {
        name: name.into(),
        title: title.into(),
        description: "Shades every surface that the camera sees, with all lights of the scene."
            .into(),
        parameters: vec![Parameter {
            name: "lights".into(),
            value: "64".into(),
        }],
        features_needed: if deferred {
            vec!["4 colour targets of 32 bytes a sample".into()]
        } else {
            vec![]
        },
        frame_cpu_ms: series(gpu * 0.05, 0.05, 60),
        process_frames: vec![12; 5],
        frame_gpu_ms: Some(series(gpu, gpu * 0.05, 60)),
        systems: ["script", "world matrices", "extraction"]
            .into_iter()
            .map(|name| SystemResult {
                name: name.into(),
                thread_ms: series(0.2, 0.02, 60),
            })
            .collect(),
        passes,
        target_bytes_total: targets.iter().map(|t| t.bytes).sum(),
        targets,
        picture: Some(picture),
        ..PipelineResult::default()
    }
}

/// Two pipelines, the second slower and with a shifted ball, on a software driver.
pub fn comparison() -> Comparison {
    let pipelines = vec![
        pipeline(
            "deferred_shading",
            "Deferred shading",
            24.1,
            picture(160, 90, 0.0, 0.5),
        ),
        pipeline(
            "forward_single_pass",
            "Forward single pass",
            61.7,
            picture(160, 90, 0.004, 0.5),
        ),
    ];
    with(pipelines)
}

/// A comparison of the given pipelines with the first as the reference and all differences.
pub fn with(pipelines: Vec<PipelineResult>) -> Comparison {
    let mut c = Comparison {
        schema: SCHEMA,
        title: "Two ways to light an atrium".into(),
        scene: "atrium".into(),
        command_line: "lightbench compare atrium --pipelines deferred_shading,forward_single_pass --size 160x90 --frames 60 --out out".into(),
        created: "2026-11-22T10:30:00Z".into(),
        program_version: "0.1.0".into(),
        machine: Machine { cpu: "Example CPU 9000".into(), cores: 2, memory_bytes: 24 << 30, os: "Debian 12".into() },
        adapter: Adapter {
            name: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
            driver: "llvmpipe".into(),
            driver_info: "Mesa 22.3.6".into(),
            backend: "Vulkan".into(),
            kind: "CPU".into(),
            software: true,
        },
        size: [160, 90],
        frames: 60,
        warmup_frames: 20,
        processes: vec![],
        reference: pipelines.first().map_or_else(String::new, |p| p.name.clone()),
        parameters: vec![Parameter { name: "lights".into(), value: "64".into() }],
        seeds: vec![Seed { name: "scene".into(), value: 7 }],
        inputs: vec![Input {
            path: "scripts/scenes/atrium.rhai".into(),
            algorithm: "SHA-256".into(),
            hash: "9f2feb0f1ef425b292f2f94bdd2d1d3b5c8f0e0e".into(),
        }],
        pipelines,
        heat_map_scale: 1.0,
    };
    c.compare_pictures(DiffOptions::default()).unwrap();
    c
}

/// A study of the two pipelines over lights, whose times at each value `times` gives.
pub fn study(lights: &[u32], times: impl Fn(f64) -> [f64; 2]) -> Study {
    let points = lights.iter().map(|count| {
        let [deferred, forward] = times(f64::from(*count));
        let mut c = comparison();
        for (p, time) in c.pipelines.iter_mut().zip([deferred, forward]) {
            let fresh = pipeline(&p.name, &p.title, time, picture(2, 2, 0.0, 0.0));
            p.frame_gpu_ms = Some((0..5).flat_map(|_| series(time, time * 0.03, 12)).collect());
            p.frame_cpu_ms = fresh.frame_cpu_ms;
            p.passes = fresh.passes;
            p.process_frames = vec![12; 5];
            p.settled_after = vec![4; 5];
        }
        c.processes = (0..5)
            .map(|index| ProcessRecord {
                index,
                started: "2026-11-22T10:30:00Z".into(),
                seconds: 4.5,
                load_average: Some(0.2),
                processor_mhz: Some(2900.0),
            })
            .collect();
        c.frames = 20;
        let value = |name: &str, value: String| Parameter {
            name: name.into(),
            value,
        };
        Point {
            key: format!("scene=atrium,lights={count}"),
            coordinates: vec![
                value("scene", "atrium".into()),
                value("lights", count.to_string()),
            ],
            comparison: c,
        }
    });
    Study {
        schema: SCHEMA,
        plan: Plan {
            title: "Two ways to light an atrium".into(),
            axes: vec![Axis {
                name: "lights".into(),
                values: lights.iter().map(u32::to_string).collect(),
            }],
            size: [160, 90],
            reference: "deferred_shading".into(),
            frames: 20,
            processes: 3,
            seconds: 60.0,
            ..Plan::default()
        },
        points: points.collect(),
        missing: vec![],
    }
}
