//! Looking into frames: every kind of target, slice by slice and sample by sample, against what the
//! shaders wrote.
#![allow(clippy::unwrap_used)]

use lightbench::lab::inspect::{FrameInspector, Part};
use lightbench::render::description::Slice;
use lightbench::render::inspect::{Aspect, PixelValue, TexelValue};
use lightbench::render::{Pipeline, Renderer};
use lightbench::script::Scene;
use lightbench_tests::{Workshop, gpu};

const SIZE: (u32, u32) = (8, 6);

/// A renderer, and a pipeline of a test's own on an empty scene.
struct Desk {
    workshop: Workshop,
    renderer: Renderer,
    scene: Scene,
    pipeline: Pipeline,
}

impl Desk {
    fn new(body: &str, shaders: &[(&str, &str)]) -> Self {
        let workshop = Workshop::new();
        let scene = workshop.scene("");
        let desc = workshop.pipeline(body, shaders);
        let renderer = Renderer::new(gpu(false));
        let pipeline = workshop.compile(&renderer, &desc);
        Self {
            workshop,
            renderer,
            scene,
            pipeline,
        }
    }

    fn look(&mut self) -> FrameInspector<'_> {
        let files = &self.workshop.files;
        let (renderer, scene) = (&mut self.renderer, &mut self.scene);
        FrameInspector::new(renderer, files, scene, &mut self.pipeline, SIZE, 0)
    }
}

const FILL: &str = "p.target(\"result\", \"r32float\");
    p.clear(\"fill\").writes(\"result\").clear(0, 0, 0, 0);";

fn part(mip: u32, layer: u32) -> Part {
    Part {
        slice: Slice { mip, layer },
        ..Part::default()
    }
}

#[test]
fn samples_are_read_one_by_one_and_as_their_mean() {
    let body = "p.target(\"samples\", \"rgba16float\").samples(4);
        p.target(\"counts\", \"r32uint\");
        p.fullscreen(\"draw\").shader(\"shaders/draw.wgsl\").writes(\"samples\");
        p.fullscreen(\"keep\").shader(\"shaders/keep.wgsl\").reads(\"samples\").writes(\"result\");
        p.target(\"result\", \"r32float\");
        p.fullscreen(\"count\").shader(\"shaders/count.wgsl\").writes(\"counts\");";
    let draw = "@fragment fn fragment_main(
            @builtin(position) pixel: vec4f, @builtin(sample_index) index: u32,
        ) -> @location(0) vec4f {
            return vec4f(f32(index * index), floor(pixel.x), floor(pixel.y), 1.0);
        }";
    let keep = "@group(1) @binding(0) var samples: texture_multisampled_2d<f32>;
        @fragment fn fragment_main() -> @location(0) vec4f {
            return textureLoad(samples, vec2i(0), 0);
        }";
    let count = "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) u32 {
            return 0xffff0000u + u32(pixel.x);
        }";
    let mut desk = Desk::new(body, &[("draw", draw), ("keep", keep), ("count", count)]);
    let mut look = desk.look();
    let at = (2 * SIZE.0 + 5) as usize;
    for sample in 0..4 {
        let part = Part {
            sample: Some(sample),
            ..Part::default()
        };
        let image = look.target(0, "samples", part).unwrap();
        let expected = (sample * sample) as f32;
        assert_eq!(image.texels[at], [expected, 5.0, 2.0, 1.0]);
    }
    let mean = look.target(0, "samples", Part::default()).unwrap();
    // 0, 1, 4 and 9.
    assert_eq!(mean.texels[at], [3.5, 5.0, 2.0, 1.0]);
    let beyond = Part {
        sample: Some(4),
        ..Part::default()
    };
    let error = look.target(0, "samples", beyond).unwrap_err().to_string();
    assert_eq!(error, "`samples` has 4 samples a texel, counted from 0");

    let history = look.history((5, 2)).unwrap();
    let of = |target: &str| -> Vec<&PixelValue> {
        history
            .iter()
            .filter(|value| value.target == target)
            .collect()
    };
    let samples = of("samples");
    assert_eq!(samples.len(), 4);
    for (sample, value) in (0_u32..).zip(samples) {
        assert_eq!(value.sample, Some(sample));
        let red = (sample * sample) as f32;
        assert_eq!(value.after, TexelValue::Float([red, 5.0, 2.0, 1.0]));
    }
    // Integers keep all their bits.
    let counts = of("counts")[0];
    assert_eq!(counts.after.in_words(counts.channels), "4294901765");
}

#[test]
fn mips_layers_sides_slices_and_stencil_are_read() {
    let body = "p.target(\"layers\", \"r32float\").size(4, 4).array(3).mips();
        p.target(\"cube\", \"rg16uint\").size(2, 2).cube();
        p.target(\"volume\", \"r32sint\").size(4, 2).volume(5);
        p.target(\"depth\", \"depth24plus-stencil8\");
        for layer in 0..3 {
            p.fullscreen(`layer ${layer}`).shader(\"shaders/value.wgsl\").define(\"VALUE\", layer + 1)
                .writes(\"layers\").layer(layer);
        }
        p.mips(\"shrink\", \"layers\", \"max\");
        p.clear(\"sides\").writes(\"cube\").clear(3, 70000, 0, 0);
        p.compute(\"fill\").shader(\"shaders/fill.wgsl\").threads_of(\"volume\").updates(\"volume\");
        p.fullscreen(\"mark\").shader(\"shaders/left.wgsl\").writes(\"result\").clear(0, 0, 0, 0)
            .depth(\"depth\").clear(0.5).test(\"always\")
            .stencil(\"always\", 7).stencil_write(\"replace\").clear_stencil(1);
        p.target(\"result\", \"r32float\");";
    let value =
        "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            return vec4f(#{VALUE}.0 + 10.0 * floor(pixel.x), 0.0, 0.0, 1.0);
        }";
    let fill = "@group(1) @binding(0) var volume: texture_storage_3d<r32sint, write>;
        @compute @workgroup_size(4, 4, 4) fn compute_main(@builtin(global_invocation_id) id: vec3u) {
            if all(id < textureDimensions(volume)) {
                textureStore(volume, id, vec4i(-i32(id.x + 10u * id.y + 100u * id.z), 0, 0, 1));
            }
        }";
    let left = "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            if pixel.x >= 2.0 { discard; }
            return vec4f(1.0);
        }";
    let shaders = [("value", value), ("fill", fill), ("left", left)];
    let mut desk = Desk::new(body, &shaders);
    let last = desk.pipeline.desc.passes.len() - 1;
    let mut look = desk.look();
    for layer in 0..3 {
        // The largest of a texel's four is the rightmost.
        let image = look.target(last, "layers", part(1, layer)).unwrap();
        let first = layer as f32 + 1.0;
        let reds: Vec<f32> = image.texels.iter().map(|texel| texel[0]).collect();
        assert_eq!(
            reds,
            [first + 10.0, first + 30.0, first + 10.0, first + 30.0]
        );
    }
    let side = look.target(last, "cube", part(0, 5)).unwrap();
    // 70,000 does not fit sixteen bits.
    assert_eq!(side.texels[3][..2], [3.0, 65535.0]);
    let slice = look.target(last, "volume", part(0, 4)).unwrap();
    assert_eq!(slice.texels[6][0], -412.0);
    let error = look.target(last, "volume", part(0, 5)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`volume` has 1 mip level and 5 layers, both counted from 0"
    );

    let stencil = Part {
        aspect: Aspect::Stencil,
        ..Part::default()
    };
    let marks = look.target(last, "depth", stencil).unwrap();
    let row: Vec<f32> = marks.texels[..8].iter().map(|texel| texel[0]).collect();
    assert_eq!(row, [7.0, 7.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(marks.channels, 1);
    // Depth of 24 bits can't be copied, but read.
    let depth = look.target(last, "depth", Part::default()).unwrap();
    assert!(
        (depth.texels[7][0] - 0.5).abs() < 1e-6,
        "{:?}",
        depth.texels[7]
    );
    let error = look.target(last, "result", stencil).unwrap_err();
    assert_eq!(error.to_string(), "`result` has no stencil");

    let history = look.history((1, 0)).unwrap();
    let marks: Vec<String> = history
        .iter()
        .filter(|value| value.aspect == Aspect::Stencil)
        .map(|value| value.after.in_words(1))
        .collect();
    assert_eq!(marks, ["7"]);
    let levels = history.iter().filter(|value| value.slice.mip == 2).count();
    assert_eq!(levels, 3, "the last level of each layer");
}

#[test]
fn values_that_are_no_numbers_are_found_in_every_slice_and_sample() {
    let body = format!(
        "p.target(\"layers\", \"rgba16float\").size(4, 4).array(3);
        p.target(\"samples\", \"rgba16float\").samples(4);
        p.target(\"plain\", \"r32float\");
        {FILL}
        p.clear(\"begin\").writes(\"layers\").clear(0, 0, 0, 0);
        p.fullscreen(\"good\").shader(\"shaders/good.wgsl\").writes(\"plain\");
        p.fullscreen(\"layer\").shader(\"shaders/bad.wgsl\").writes(\"layers\").layer(2);
        p.fullscreen(\"sample\").shader(\"shaders/bad.wgsl\").define(\"SAMPLED\").writes(\"samples\");"
    );
    let good = "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            return vec4f(3.4e38, -3.4e38, 1.0e-45, 0.0);
        }";
    let bad = "#ifdef SAMPLED
        @fragment fn fragment_main(
            @builtin(position) pixel: vec4f, @builtin(sample_index) index: u32,
        ) -> @location(0) vec4f {
            let here = index == 3u && floor(pixel.x) == 6.0 && floor(pixel.y) == 1.0;
        #else
        @fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            let here = floor(pixel.x) == 2.0 && floor(pixel.y) >= 1.0;
        #endif
            let zero = min(pixel.x, 0.0);
            return vec4f(0.0, select(1.0, 1.0 / zero, here), 0.0, 1.0);
        }";
    let mut desk = Desk::new(&body, &[("good", good), ("bad", bad)]);
    let first = desk.look().first_invalid().unwrap().unwrap();
    assert_eq!(first.pass, "layer");
    let place = &first.place;
    assert_eq!((place.target.as_str(), place.slice.layer), ("layers", 2));
    assert_eq!((place.first, place.texels), ((2, 1), 3));
    assert_eq!(first.value[1], f32::INFINITY);

    // Without it, the sample is the first.
    let body = body.replace(
        "p.fullscreen(\"layer\").shader(\"shaders/bad.wgsl\")",
        "p.fullscreen(\"layer\").shader(\"shaders/good.wgsl\")",
    );
    let body = body.replace("\"rgba16float\").size(4, 4)", "\"rgba32float\").size(4, 4)");
    let mut desk = Desk::new(&body, &[("good", good), ("bad", bad)]);
    let first = desk.look().first_invalid().unwrap().unwrap();
    assert_eq!(first.pass, "sample");
    let place = &first.place;
    assert_eq!(
        (place.sample, place.first, place.texels),
        (Some(3), (6, 1), 1)
    );
    assert_eq!(first.value[1], f32::INFINITY);
}
