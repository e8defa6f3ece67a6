//! The whole examples of the reference of pipeline files, one for each kind of pass, draw what their
//! headers say.
#![allow(clippy::unwrap_used)]

use lightbench::assets::files::Files;
use lightbench::render::binding::provided;
use lightbench::render::{Pipeline, Renderer, TargetImage, View};
use lightbench::script::load_pipeline;
use lightbench::world::glam::Vec3;
use lightbench_tests::{Studio, Workshop, settings};

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

    /// Bytes that the cost model counts for a pass: read and written.
    fn bytes(&mut self, kind: &str, pass: &str) -> (f64, f64) {
        let mut pipeline = self.compile(kind, &[]);
        let index = pipeline.desc.passes.iter().position(|p| p.name == pass);
        let studio = &mut self.studio;
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        let frame = studio
            .renderer
            .render_whole(world, assets, &mut pipeline, &studio.view, SIZE, 0.0)
            .unwrap();
        let traffic = frame.passes[index.unwrap()].traffic;
        (traffic.read as f64, traffic.written as f64)
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
    assert!(listed.len() >= 10);
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

/// The sentence on bytes at each kind of pass, as numbers: bytes read and written a pixel.
#[test]
fn the_cost_model_counts_what_the_reference_says() {
    let pixels = f64::from(SIZE.0 * SIZE.1);
    // Six levels of 8 bytes a texel, each half as large along each side, rounded down.
    let level = |mip: u32| f64::from((SIZE.0 >> mip) * (SIZE.1 >> mip)) * 8.0 / pixels;
    let levels = |range: std::ops::Range<u32>| range.map(level).sum::<f64>();
    let mut examples = Examples::new();
    for (kind, pass, read, written) in [
        // Colour 8 bytes, depth 4: both are cleared, so nothing old is read.
        ("geometry", "shade", 0.0, 12.0),
        // Depth is read; colour is blended with.
        ("fullscreen", "fog", 4.0 + 8.0, 8.0),
        // The whole buffer of four words is written.
        ("compute", "count", 8.0, 16.0 / pixels),
        ("compute", "begin", 0.0, 16.0 / pixels),
        ("clear", "background", 0.0, 4.0),
        ("copy", "keep", 8.0, 8.0),
        ("copy", "sharpen", 8.0, 8.0),
        ("resolve", "shade", 0.0, 4.0 * 12.0),
        ("resolve", "mean", 4.0 * 8.0, 8.0),
        ("mips", "shrink", levels(0..5), levels(1..6)),
        ("history", "keep", 8.0, 8.0),
    ] {
        let (found_read, found_written) = examples.bytes(kind, pass);
        let bytes = |a_pixel: f64| (a_pixel * pixels).round();
        assert_eq!(
            (found_read, found_written),
            (bytes(read), bytes(written)),
            "{kind} {pass}"
        );
    }
    // What a volume covers is not known here; what is read and written for it is: depth, 13 bytes of
    // G-buffer and the old light against the new one.
    let (read, written) = examples.bytes("lights", "lights");
    assert!(written > 0.0);
    assert!((read / written - (4.0 + 13.0 + 8.0) / 8.0).abs() < 1e-3);
}

/// A board between a spot light and the floor: its shadow is where similar triangles put it, and
/// outside of it nothing has changed.
#[test]
fn the_shadow_example_lays_shadows_where_geometry_says() {
    let workshop = Workshop::new();
    let mut scene = workshop.scene(
        "let paint = material(\"paint\");
        spawn(\"floor\").mesh(plane(12, 12)).material(paint);
        spawn(\"board\").mesh(box(2, 0.02, 2)).material(paint).at(0, 2, 0);
        spot_light(\"lamp\").at(0, 4, 0).aim(0, 0, 0).range(12).intensity(50).inner(60).outer(80);",
    );
    // From below the board straight down. The floor is 1.5 m away, the picture 6 m wide.
    const SIDE: u32 = 120;
    let angle = 2.0 * 2.0_f32.atan();
    let eye = Vec3::new(0.0, 1.5, 0.0);
    let view = View::look_at(eye, Vec3::new(0.0, 0.0, -1e-4), angle, 0.1, 10.0);
    let mut renderer = Renderer::new(lightbench_tests::gpu(false));
    let mut draw = |kind: &str| {
        let path = format!("{FOLDER}/{kind}.rhai");
        let desc = load_pipeline(&workshop.files, &path, &settings(&[])).unwrap();
        let mut pipeline = workshop.compile(&renderer, &desc);
        let (world, assets) = (&mut scene.world, &scene.assets);
        let frame = renderer
            .render_whole(world, assets, &mut pipeline, &view, (SIDE, SIDE), 0.0)
            .unwrap()
            .clone();
        (renderer.read_target(&pipeline, "hdr").unwrap(), frame)
    };
    let (plain, _) = draw("geometry");
    let (shadowed, frame) = draw("shadow");
    // One view of 1024 × 1024 texels, cleared before: nothing is read.
    let traffic = frame.passes[0].traffic;
    assert_eq!((traffic.read, traffic.written), (0, 1024 * 1024 * 4));
    assert_eq!(frame.passes[0].unplaced_lights, 0);

    let metres = |at: usize| ((at as f32 + 0.5) / SIDE as f32 - 0.5) * 6.0;
    // The upper rim of the board, 1 m from the middle, is 1.99 m below the lamp.
    let rim = 4.0 / 1.99;
    let (mut dark, mut lit) = (0, 0);
    for (index, (plain, shadowed)) in plain.texels.iter().zip(&shadowed.texels).enumerate() {
        let (x, z) = (index % SIDE as usize, index / SIDE as usize);
        let from_middle = metres(x).abs().max(metres(z).abs());
        if (from_middle - rim).abs() < 0.06 {
            continue;
        }
        if from_middle < rim {
            assert_eq!(brightest(shadowed), 0.0, "{x} {z}");
            dark += usize::from(brightest(plain) > 0.01);
        } else {
            assert_eq!(shadowed, plain, "{x} {z}");
            lit += usize::from(brightest(plain) > 0.01);
        }
    }
    assert!(dark > 6000 && lit > 3000, "{dark} {lit}");
}

/// What a shader finds in group 1 without a word of the pipeline compiles as the reference writes it.
#[test]
fn samplers_and_engine_buffers_are_declared_as_in_the_reference() {
    let mut declarations = String::from("#import lightbench::shadow\n");
    for (index, thing) in provided().enumerate() {
        declarations += &format!("@group(1) @binding({index}) {};\n", thing.declaration);
    }
    let compile = |declarations: &str| {
        let workshop = Workshop::new();
        workshop.write(
            "shaders/all.wgsl",
            &format!(
                "{declarations}@fragment fn fragment_main() -> @location(0) vec4f {{ return vec4f(1.0); }}"
            ),
        );
        workshop.write(
            "scripts/pipelines/all.rhai",
            "let p = pipeline(\"All\");\np.target(\"output\", \"rgba8unorm\");\n\
             p.fullscreen(\"all\").shader(\"shaders/all.wgsl\").writes(\"output\");\n\
             p.show(\"output\");\np",
        );
        let desc = load_pipeline(&workshop.files, "all", &settings(&[])).unwrap();
        let renderer = Renderer::new(lightbench_tests::gpu(false));
        renderer
            .compiler()
            .compile(&workshop.files, &desc)
            .map(drop)
    };
    compile(&declarations).unwrap_or_else(|problems| panic!("{problems}"));
    // There are no others.
    let other = compile("@group(1) @binding(0) var smooth_one: sampler;\n").unwrap_err();
    let hint = other.0[0].hint.clone().unwrap();
    for name in hint
        .split([' ', ','])
        .filter(|word| word.ends_with("_sampler"))
    {
        assert!(provided().any(|known| known.name == name), "{hint}");
    }
}
