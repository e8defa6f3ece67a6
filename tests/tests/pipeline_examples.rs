//! The whole examples of the reference of pipeline files, one for each kind of pass, draw what their
//! headers say.
#![allow(clippy::unwrap_used)]

use lightbench::assets::files::Files;
use lightbench::render::{Pipeline, TargetImage};
use lightbench::script::load_pipeline;
use lightbench_tests::{Studio, settings};

const SIZE: (u32, u32) = (150, 90);
const FOLDER: &str = "scripts/pipelines/examples";

struct Examples {
    studio: Studio,
}

impl Examples {
    /// Lights that shine brighter than a display.
    fn new() -> Self {
        Self {
            studio: Studio::new("many_lights", &settings(&["lights=30", "range=8"])),
        }
    }

    fn compile(&mut self, kind: &str, texts: &[&str]) -> Pipeline {
        let path = format!("{FOLDER}/{kind}.rhai");
        let desc = load_pipeline(&self.studio.files, &path, &settings(texts))
            .unwrap_or_else(|e| panic!("{e}"));
        let mut compiler = self.studio.renderer.compiler();
        let pipeline = compiler
            .compile(&self.studio.files, &desc)
            .unwrap_or_else(|e| panic!("{e}"));
        let dropped: Vec<_> = pipeline.lives().dropped(&pipeline.desc).collect();
        assert!(dropped.is_empty(), "{path}: {dropped:?}");
        pipeline
    }

    fn draw(&mut self, pipeline: &mut Pipeline) -> TargetImage {
        let studio = &mut self.studio;
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        studio
            .renderer
            .render_whole(world, assets, pipeline, &studio.view, SIZE, 0.0)
            .unwrap();
        let shown = pipeline.desc.hdr.clone().or(pipeline.desc.output.clone());
        let shown = shown.unwrap().name;
        studio.renderer.read_target(pipeline, &shown).unwrap()
    }

    fn light(&mut self, kind: &str, texts: &[&str]) -> TargetImage {
        let mut pipeline = self.compile(kind, texts);
        self.draw(&mut pipeline)
    }
}

/// The largest difference of red, green and blue.
fn furthest(a: &TargetImage, b: &TargetImage) -> f32 {
    let pairs = a.texels.iter().zip(&b.texels);
    pairs
        .flat_map(|(a, b)| (0..3).map(|channel| (a[channel] - b[channel]).abs()))
        .fold(0.0, f32::max)
}

fn brightest(texel: &[f32; 4]) -> f32 {
    texel[..3].iter().copied().fold(0.0, f32::max)
}

#[test]
fn every_example_draws() {
    let mut examples = Examples::new();
    let listed = Files::shipped().list(FOLDER, "rhai").unwrap();
    assert!(listed.len() >= 9);
    for file in listed {
        let kind = file.path[FOLDER.len() + 1..].trim_end_matches(".rhai");
        let picture = examples.light(kind, &[]);
        let lit = picture.texels.iter().filter(|t| brightest(t) > 0.05);
        let lit = lit.count();
        assert!(lit * 3 > picture.texels.len(), "{kind}: {lit}");
        assert!(picture.texels.as_flattened().iter().all(|v| v.is_finite()));
    }
}

/// With its parameter at 0, what an example adds to forward shading is gone; with it, it is there.
#[test]
fn what_an_example_adds_can_be_taken_away() {
    let mut examples = Examples::new();
    let plain = examples.light("geometry", &[]);
    for (kind, parameter) in [
        ("fullscreen", "density"),
        ("copy", "sharpness"),
        ("mips", "glow"),
    ] {
        let without = examples.light(kind, &[&format!("{parameter}=0")]);
        assert_eq!(furthest(&plain, &without), 0.0, "{kind}");
        let with = examples.light(kind, &[]);
        assert!(furthest(&plain, &with) > 0.05, "{kind}");
    }
    let counted = examples.light("compute", &[]);
    assert_eq!(furthest(&plain, &counted), 0.0, "counting changes nothing");
}

#[test]
fn the_lights_of_the_lights_example_are_those_of_deferred_shading() {
    let mut examples = Examples::new();
    let example = examples.light("lights", &[]);
    let shipped = examples
        .studio
        .hdr("deferred_shading", &settings(&[]), SIZE);
    assert_eq!(furthest(&example, &shipped), 0.0);
}

#[test]
fn the_compute_example_counts_what_is_too_bright() {
    let mut examples = Examples::new();
    let mut pipeline = examples.compile("compute", &[]);
    // The count of one frame, and not of all so far.
    for _ in 0..3 {
        let serial = examples.studio.renderer.next_frame();
        let picture = examples.draw(&mut pipeline);
        let expected = picture.texels.iter().filter(|t| brightest(t) > 1.0).count();
        assert!(expected > 100 && expected < picture.texels.len());
        let measured = examples.studio.renderer.finish(60).unwrap();
        let counters = measured.into_iter().find(|m| m.frame == serial).unwrap();
        assert_eq!(counters.counters, [expected as u32]);
    }
}

/// The mean of four samples lies between its neighbours' colours, and inside a surface all four are
/// nearly the same.
#[test]
fn the_resolve_example_smooths_edges_alone() {
    let mut examples = Examples::new();
    let plain = examples.light("geometry", &[]);
    let smooth = examples.light("resolve", &[]);
    let differ = plain.texels.iter().zip(&smooth.texels).filter(|(a, b)| {
        let far = |channel: usize| (a[channel] - b[channel]).abs() > 0.1 * brightest(a).max(0.1);
        (0..3).any(far)
    });
    let share = differ.count() as f64 / plain.texels.len() as f64;
    assert!(
        share > 0.01 && share < 0.25,
        "{share} of the pixels are edges"
    );
}

#[test]
fn the_history_example_mixes_with_the_last_frame() {
    let mut examples = Examples::new();
    let plain = examples.light("geometry", &[]);
    let mut pipeline = examples.compile("history", &["trail=0.75"]);
    let first = examples.draw(&mut pipeline);
    assert_eq!(furthest(&plain, &first), 0.0, "there was no frame before");
    // The lights go out: the next frames are what stays of the first one.
    let world = examples.studio.scene.world.clone();
    for light in world.columns::<lightbench::world::Light>().entities() {
        examples
            .studio
            .scene
            .world
            .remove::<lightbench::world::Light>(*light);
    }
    for share in [0.75_f32, 0.75 * 0.75] {
        let dark = examples.draw(&mut pipeline);
        for (lit, dark) in first.texels.iter().zip(&dark.texels) {
            for channel in 0..3 {
                let expected = lit[channel] * share;
                assert!((dark[channel] - expected).abs() <= expected * 2e-3 + 1e-4);
            }
        }
    }
}

/// Fog hides more the farther a surface is, and the sky not at all.
#[test]
fn the_fullscreen_example_is_fog() {
    let mut examples = Examples::new();
    let plain = examples.light("geometry", &[]);
    let fog = examples.light("fullscreen", &["density=0.1"]);
    let mut pipeline = examples.compile("geometry", &[]);
    pipeline.keep_all_targets(true);
    examples.draw(&mut pipeline);
    let depth = examples
        .studio
        .renderer
        .read_target(&pipeline, "depth")
        .unwrap();
    let data = examples.studio.renderer.frame().data;
    let (sky, far, near) = (data.sky, f64::from(data.far), f64::from(data.near));
    for (index, (plain, fog)) in plain.texels.iter().zip(&fog.texels).enumerate() {
        let depth = f64::from(depth.texels[index][0]);
        if depth == 0.0 {
            assert_eq!(plain, fog);
            continue;
        }
        // Distance along the view; along the ray to the pixel it is longer, by the ray's slope.
        let along = near * far / (depth * (far - near) + near);
        let (x, y) = (index % SIZE.0 as usize, index / SIZE.0 as usize);
        let slope = |at: usize, size: u32, scale: f32| {
            ((at as f64 + 0.5) / f64::from(size) * 2.0 - 1.0) / f64::from(scale)
        };
        let across = slope(x, SIZE.0, data.projection.x_axis.x);
        let down = slope(y, SIZE.1, data.projection.y_axis.y);
        let metres = along * (1.0 + across * across + down * down).sqrt();
        let hidden = 1.0 - (-0.1 * metres).exp();
        for channel in 0..3 {
            let expected =
                f64::from(plain[channel]) * (1.0 - hidden) + f64::from(sky[channel]) * hidden;
            let found = f64::from(fog[channel]);
            assert!(
                (found - expected).abs() <= expected * 3e-3 + 1e-4,
                "pixel {index}: {found} and {expected}"
            );
        }
    }
}
