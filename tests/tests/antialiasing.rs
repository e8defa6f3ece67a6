//! Four samples a pixel: every pipeline that has them draws the same smooth edges, and what lies
//! inside surfaces does not change.
#![allow(clippy::unwrap_used)]

use lightbench::assets::files::Files;
use lightbench::lab::inspect::{FrameInspector, Part};
use lightbench::render::TargetImage;
use lightbench::script::{list_pipelines, load_pipeline};
use lightbench_tests::compare::{mean_difference, share_beyond};
use lightbench_tests::{Studio, hard_shapes, project, project_with_mistake, settings};

const SIZE: (u32, u32) = (320, 180);

/// What is computed in 32 bits and rounded to 16 twice, for each sample and for their mean, differs by
/// at most two steps of 2⁻¹⁰ of itself.
const HALF: f32 = 2.0 / 1024.0;
/// What the G-buffer's rounding does to the light of a whole picture: see `agreement`.
const QUANTISATION: f64 = 0.0045;

/// What gradients that are not differences over two pixels do to textures, in the mean: see `agreement`.
const GRADIENTS: f64 = 0.001;
/// The share of the pixels in which two surfaces touch, where multi-pass adds twice.
const TOUCHING: f64 = 3e-3;
/// The share of the pixels that show a triangle's light beyond its edge, where it has other lights.
const BEYOND: f64 = 1e-4;

/// What inferred lighting makes of edges even with buffers at full size, in the mean: a surface that
/// shows in some samples and not in the pixel's middle has no light of its own, and takes another's.
const WITHOUT_TEXEL: f64 = 0.015;

/// The pipelines that declare four samples.
fn pipelines() -> Vec<String> {
    let files = Files::shipped();
    let names = list_pipelines(&files).unwrap().into_iter().map(|p| p.name);
    let with_samples = |name: &String| {
        let desc = load_pipeline(&files, name, &settings(&[])).unwrap();
        desc.ability("msaa")
            .is_some_and(|ability| ability.supported)
    };
    names.filter(with_samples).collect()
}

/// The options under which a pipeline shows what forward shading shows.
fn options(pipeline: &str) -> &'static [&'static str] {
    match pipeline {
        "inferred_lighting" => &["scale=1", "transparency=forward"],
        "tiled_forward" | "world_indexed_forward" => &["capacity=1024"],
        _ => &[],
    }
}

/// Whether a pipeline keeps surfaces in textures, which rounds them.
fn rounds(pipeline: &str) -> bool {
    pipeline.contains("deferred")
}

/// Pixels that lost lights, where a pipeline marks them.
fn marked(studio: &Studio, pipeline: &lightbench::render::Pipeline) -> Option<TargetImage> {
    pipeline.desc.target("over_capacity")?;
    let target = studio.renderer.read_target(pipeline, "over_capacity");
    Some(target.unwrap())
}

fn scenes() -> Vec<(Option<Files>, &'static str, &'static [&'static str])> {
    vec![
        (None, "hard_cases", &["case=panes"]),
        (None, "hard_cases", &["case=wide_spot"]),
        (None, "many_lights", &["lights=40", "range=1"]),
        (None, "cornell_box", &["lamps=2"]),
    ]
}

#[test]
fn pipelines_with_four_samples_draw_the_same_edges() {
    let names = pipelines();
    assert!(names.len() >= 10, "{names:?}");
    let (_folder, shapes) = hard_shapes();
    let shapes: (_, _, &[&str]) = (Some(shapes), "shapes", &[]);
    for (files, scene, texts) in scenes().into_iter().chain([shapes]) {
        let mut studio = match files {
            None => Studio::new(scene, &settings(texts)),
            Some(files) => {
                let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
                studio.show(files, scene);
                studio
            }
        };
        let msaa = settings(&["antialiasing=msaa"]);
        let plain = studio.hdr("forward_single_pass", &settings(&[]), SIZE);
        let expected = studio.hdr("forward_single_pass", &msaa, SIZE);
        let smoothed = share_beyond(&plain, &expected, 0.05);
        assert!(
            smoothed > 0.002,
            "{scene}: {smoothed} of the pixels are edges"
        );
        for name in &names {
            let texts = settings(&[options(name), &["antialiasing=msaa"]].concat());
            let (pipeline, _) = studio.draw_whole(name, &texts, SIZE);
            let mut found = studio.renderer.read_hdr(&pipeline).unwrap().unwrap();
            if let Some(marked) = marked(&studio, &pipeline) {
                let lost = marked.texels.iter().map(|texel| texel[0] > 0.0);
                for (index, _) in lost.enumerate().filter(|(_, lost)| *lost) {
                    found.texels[index] = expected.texels[index];
                }
            }
            // Multi-pass rounds for each light; few reach one pixel here.
            let roundings = if name == "forward_multi_pass" {
                4.0
            } else {
                1.0
            };
            let beyond = share_beyond(&expected, &found, roundings * HALF);
            let mean = mean_difference(&expected, &found);
            println!("{scene} {name:24} {beyond:.5} of the pixels differ, mean {mean:.2e}");
            if name == "inferred_lighting" {
                assert!(mean <= WITHOUT_TEXEL, "{scene} {name}: {mean}");
            } else if name == "visibility_buffer" {
                // It finds the gradients of textures in another way: see `agreement`.
                assert!(mean <= GRADIENTS, "{scene} {name}: {mean}");
            } else if rounds(name) {
                assert!(mean <= QUANTISATION, "{scene} {name}: {mean}");
            } else {
                // At edges the pixel's middle lies beyond the triangle, where lists of the object's
                // lights lack some.
                let allowed = if name == "forward_multi_pass" {
                    TOUCHING
                } else {
                    BEYOND
                };
                assert!(beyond <= allowed, "{scene} {name}: {beyond}");
            }
        }
    }
}

/// The mean of blocks of 4 × 4 pixels.
fn shrink(image: &TargetImage) -> TargetImage {
    let (width, height) = (image.width / 4, image.height / 4);
    let texels = (0..width * height).map(|index| {
        let corner = ((index / width) * 4 * image.width + index % width * 4) as usize;
        let mut sum = [0.0; 4];
        for row in 0..4 {
            for texel in &image.texels[corner + row * image.width as usize..][..4] {
                (0..4).for_each(|c| sum[c] += texel[c] / 16.0);
            }
        }
        sum
    });
    TargetImage {
        width,
        height,
        texels: texels.collect(),
        ..image.clone()
    }
}

/// Sixteen pixels for each are nearer to the truth than four samples, and four nearer than one.
#[test]
fn four_samples_come_closer_to_many_pixels() {
    let mut studio = Studio::new("cornell_box", &settings(&["lamps=2"]));
    let fine = studio.hdr(
        "forward_single_pass",
        &settings(&[]),
        (SIZE.0 * 4, SIZE.1 * 4),
    );
    let truth = shrink(&fine);
    for name in [
        "forward_single_pass",
        "deferred_shading",
        "clustered_deferred",
    ] {
        let [one, four] = ["antialiasing=off", "antialiasing=msaa"]
            .map(|text| share_beyond(&truth, &studio.hdr(name, &settings(&[text]), SIZE), 0.2));
        println!(
            "{name}: {one:.4} of the pixels are far from the truth, with four samples {four:.4}"
        );
        assert!(four < 0.6 * one, "{name}: {one} and {four}");
    }
}

/// Lighting single samples at edges alone is for speed: the picture is that of lighting them everywhere.
#[test]
fn lighting_samples_at_edges_alone_gives_the_picture_of_lighting_all() {
    let (_folder, files) = hard_shapes();
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "shapes");
    for name in [
        "deferred_shading",
        "clustered_deferred",
        "light_indexed_deferred",
    ] {
        let mut hdr = |more: &[&str]| {
            let texts = settings(&[&["antialiasing=msaa"], more].concat());
            studio.hdr(name, &texts, SIZE)
        };
        let edges = hdr(&[]);
        let all = hdr(&["edges_only=off"]);
        let finest = hdr(&["edge_angle=0", "edge_depth=0"]);
        let [edges, finest] = [&edges, &finest].map(|image| mean_difference(&all, image));
        println!("{name}: {edges:.2e} beside every sample, {finest:.2e} with the finest edges");
        // What is left are steep parts of bent surfaces, turned by less than five degrees in a pixel.
        assert!(edges < 6e-4, "{name}: {edges}");
        // Each light is added to 16 bits, for all samples alike or for each.
        assert!(finest < 1e-6, "{name}: {finest}");
        if name == "deferred_shading" {
            for scheme in ["volume_stencil=two_pass", "volume_stencil=inverse"] {
                let stencil = hdr(&[scheme, "threshold=0"]);
                assert_eq!(share_beyond(&all, &stencil, HALF), 0.0, "{scheme}");
            }
        }
    }
}

#[test]
fn inside_surfaces_nothing_changes() {
    let (_folder, files) = hard_shapes();
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "shapes");
    let [one, four] = ["antialiasing=off", "antialiasing=msaa"]
        .map(|text| studio.hdr("forward_single_pass", &settings(&[text]), SIZE));
    // Where all four samples show what the middle of the pixel shows.
    let inside: Vec<usize> = (0..one.texels.len())
        .filter(|&index| one.texels[index] == four.texels[index])
        .collect();
    assert!(inside.len() * 10 > one.texels.len() * 8, "{}", inside.len());
    for name in [
        "deferred_shading",
        "clustered_deferred",
        "light_indexed_deferred",
    ] {
        let [one, four] = ["antialiasing=off", "antialiasing=msaa"]
            .map(|text| studio.hdr(name, &settings(&[text]), SIZE));
        let mut rounded = 0;
        for &index in &inside {
            let (one, four) = (one.texels[index], four.texels[index]);
            let off = (0..3).map(|c| (one[c] - four[c]).abs() / one[c].max(1e-3));
            let off = off.fold(0.0, f32::max);
            // Where two triangles of one plane meet, what is the same but for 24 bits may be rounded to
            // neighbouring steps of 8 bits.
            assert!(off < 0.02, "{name}, pixel {index}: {one:?} and {four:?}");
            rounded += usize::from(off > HALF);
        }
        assert!(rounded * 200 < inside.len(), "{name}: {rounded}");
    }
}

/// A lamp that shines a hundred times brighter than white, before a dim wall.
const BRIGHT: &str = "
let lamp = material(\"lamp\").color(0, 0, 0).specular(0).emissive(rgb(100, 100, 100));
let wall = material(\"wall\").color(0, 0, 0).specular(0).emissive(rgb(0.2, 0.2, 0.2));
spawn(\"lamp\").mesh(box(1, 1, 1)).material(lamp).turn(0, 0, 17);
spawn(\"wall\").mesh(plane(40, 40)).material(wall).at(0, 0, -8).turn(90, 0, 0);
camera(\"eye\").at(0, 0, 4).look_at(0, 0, 0).fov(50).near(0.1).far(40);
";

/// The mean after the tone curve, against the formula on the samples themselves; and the edge of the
/// lamp then has steps that can be told apart.
#[test]
fn the_mean_after_the_tone_curve_keeps_bright_edges_smooth() {
    let (_folder, files) = project(&[("scripts/scenes/bright.rhai", BRIGHT)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "bright");
    let texts = settings(&["antialiasing=msaa_tone_mapped"]);
    let found = studio.hdr("forward_single_pass", &texts, SIZE);
    let mut pipeline = studio.compile("forward_single_pass", &texts);
    let sky = pipeline
        .desc
        .passes
        .iter()
        .position(|pass| pass.name == "transparent");
    let mut look = FrameInspector::new(
        &mut studio.renderer,
        &studio.files,
        &mut studio.scene,
        &mut pipeline,
        SIZE,
        0,
    );
    let samples: Vec<_> = (0..4)
        .map(|sample| {
            let part = Part {
                sample: Some(sample),
                ..Part::default()
            };
            look.target(sky.unwrap(), "hdr_samples", part).unwrap()
        })
        .collect();
    let mut mixed = Vec::new();
    for (index, texel) in found.texels.iter().enumerate() {
        let light = [0, 1, 2, 3].map(|sample: usize| f64::from(samples[sample].texels[index][0]));
        // Grey light, so that the largest channel is each.
        let bent = light.map(|light| light / (1.0 + light)).iter().sum::<f64>() / 4.0;
        let expected = bent / (1.0 - bent);
        let off = (f64::from(texel[0]) - expected).abs() / expected.max(1e-3);
        assert!(
            off < 1.0 / 1024.0,
            "pixel {index}: {light:?} became {}",
            texel[0]
        );
        if light.iter().any(|other| *other != light[0]) {
            mixed.push(expected);
        }
    }
    assert!(mixed.len() > 100, "{} pixels of edge", mixed.len());
    // One sample of the lamp and three of the wall are 25 in the mean of light, white on any display.
    // After the curve they are less than one.
    let quarter = mixed.iter().copied().fold(f64::MAX, f64::min);
    assert!(quarter < 1.0, "{quarter}");
}

/// Must-fail twins: without edges, or with samples of another pixel, the comparisons notice.
#[test]
fn missing_edges_and_wrong_samples_are_caught() {
    let mut studio = Studio::new("hard_cases", &settings(&["case=panes"]));
    let msaa = settings(&["antialiasing=msaa"]);
    let expected = studio.hdr("forward_single_pass", &msaa, SIZE);
    let right = studio.hdr("deferred_shading", &msaa, SIZE);
    let right = share_beyond(&expected, &right, 0.05);
    for (path, from, to) in [
        (
            "shaders/deferred_shading/mark_edges.wgsl",
            "is_edge = is_edge || differs(texel, sample)",
            "is_edge = is_edge || (sample > 3u && differs(texel, sample))",
        ),
        (
            "shaders/lib/g_buffer_texels.wgsl",
            "textureLoad(g_albedo, texel, sample)",
            "textureLoad(g_albedo, texel, 0u)",
        ),
    ] {
        let (_folder, files) = project_with_mistake(&[], (path, from, to));
        studio.files = files;
        let wrong = share_beyond(
            &expected,
            &studio.hdr("deferred_shading", &msaa, SIZE),
            0.05,
        );
        println!("`{to}`: {wrong:.5} of the pixels are wrong, {right:.5} without");
        assert!(wrong > 5.0 * right + 1e-3, "`{to}` went unnoticed: {wrong}");
    }
}
