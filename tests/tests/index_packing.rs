//! Numbers of lights survive being blended over one another, and lights that share a channel never
//! meet in a pixel.
#![allow(clippy::unwrap_used)]

use lightbench::lab::reference::index_packing::Capacity;
use lightbench::script::Settings;
use lightbench_tests::{Studio, gpu, project, settings};

/// Ends each pipeline of this file.
const SHOW: &str = "@group(1) @binding(0) var result: texture_2d<f32>;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return textureLoad(result, vec2u(pixel.xy), 0) / 65536.0;
}";

/// The hash of the shader below (O'Neill 2014, PCG, "RXS M XS 32").
fn hash(x: u32) -> u32 {
    let v = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let w = ((v >> ((v >> 28) + 4)) ^ v).wrapping_mul(277_803_737);
    (w >> 22) ^ w
}

/// Blends the next number of each pixel's sequence over those before it.
const DRAW: &str = "#import lightbench::index_packing
fn hash(x: u32) -> u32 {
    let v = x * 747796405u + 2891336453u;
    let w = ((v >> ((v >> 28u) + 4u)) ^ v) * 277803737u;
    return (w >> 22u) ^ w;
}
struct Out {
    @location(0) first: vec4f,
    @location(1) second: vec4f,
}
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> Out {
    let index = u32(pixel.y) * 160u + u32(pixel.x);
    if hash(index) % #{LENGTHS}u + #{SHORTEST}u <= #{STEP}u {
        discard;
    }
    let texels = index_packing::pack(1u + hash(index * 16u + #{STEP}u + 1000000u) % 255u);
    return Out(texels.first, texels.second);
}";

/// The numbers as they lie, two in each channel; and sorted.
const DECODE: &str = "#import lightbench::index_packing
@group(1) @binding(0) var first: texture_2d<f32>;
@group(1) @binding(1) var second: texture_2d<f32>;
struct Out {
    @location(0) result: vec4f,
    @location(1) ordered: vec4f,
}
fn pairs(unpaired: array<u32, index_packing::CAPACITY>) -> vec4f {
    var numbers = unpaired;
    var out = vec4u(0u);
    for (var i = 0u; i < index_packing::CAPACITY; i++) {
        out[i / 2u] += numbers[i] << (8u * (i % 2u));
    }
    return vec4f(out);
}
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> Out {
    let texel = vec2u(pixel.xy);
    let texels = index_packing::Texels(textureLoad(first, texel, 0), textureLoad(second, texel, 0));
    let numbers = index_packing::unpack(texels);
    return Out(pairs(numbers), pairs(index_packing::sort(numbers)));
}";

/// Draws 20,000 sequences of `shortest` to `shortest + lengths - 1` numbers; gives for each pixel
/// the numbers in the order of drawing, those that were decoded, and those sorted.
fn blended(capacity: Capacity, shortest: u32, lengths: u32, portable: bool) -> Vec<[Vec<u32>; 3]> {
    let (room, steps) = (capacity.lights() as u32, shortest + lengths - 1);
    let shift = capacity.factor();
    let pipeline = format!(
        "let p = pipeline(\"Packing\");
        p.target(\"first\", \"rgba8unorm\");
        p.target(\"second\", \"rgba8unorm\");
        p.target(\"result\", \"rgba32float\");
        p.target(\"ordered\", \"rgba32float\");
        p.target(\"output\", \"rgba8unorm\");
        p.clear(\"begin\").writes(\"first\").clear(0, 0, 0, 0).writes(\"second\").clear(0, 0, 0, 0);
        for step in 0..{steps} {{
            p.fullscreen(\"number \" + step).shader(\"shaders/draw.wgsl\")
                .define(\"CAPACITY\", {room}).define(\"STEP\", step)
                .define(\"SHORTEST\", {shortest}).define(\"LENGTHS\", {lengths})
                .blend_constant({shift}, {shift}, {shift}, {shift})
                .writes(\"first\").blend(\"one\", \"add\", \"constant\")
                .writes(\"second\").blend(\"one\", \"add\", \"constant\");
        }}
        p.fullscreen(\"decode\").shader(\"shaders/decode.wgsl\").define(\"CAPACITY\", {room})
            .reads(\"first\").reads(\"second\").writes(\"result\").writes(\"ordered\");
        p.fullscreen(\"show\").shader(\"shaders/show.wgsl\").reads(\"result\").writes(\"output\");
        p.show(\"output\");
        p"
    );
    let (_folder, files) = project(&[
        ("scripts/pipelines/packing.rhai", &pipeline),
        ("shaders/draw.wgsl", DRAW),
        ("shaders/decode.wgsl", DECODE),
        ("shaders/show.wgsl", SHOW),
    ]);
    let mut studio = Studio::on(gpu(portable), "hard_cases", &settings(&["case=no_objects"]));
    studio.files = files;
    let (pipeline, _) = studio.draw_whole("packing", &Settings::new(), (160, 125));
    let read = |name: &str| {
        let image = studio.renderer.read_target(&pipeline, name).unwrap();
        image.texels.into_iter().map(move |texel| {
            let of_pair = |pair: f32| [pair as u32 & 255, pair as u32 >> 8];
            let numbers = texel.into_iter().flat_map(of_pair);
            numbers.take(room as usize).collect::<Vec<u32>>()
        })
    };
    let drawn = (0..20_000_u32).map(|index| {
        let length = hash(index) % lengths + shortest;
        let number = |step: u32| 1 + hash(index * 16 + step + 1_000_000) % 255;
        (0..length).map(number).collect::<Vec<u32>>()
    });
    let decoded = read("result").zip(read("ordered"));
    drawn
        .zip(decoded)
        .map(|(drawn, (decoded, ordered))| [drawn, decoded, ordered])
        .collect()
}

#[test]
fn twenty_thousand_sequences_survive_blending() {
    for portable in [false, true] {
        for capacity in [Capacity::Four, Capacity::Eight] {
            let room = capacity.lights();
            for [drawn, decoded, ordered] in blended(capacity, 0, room as u32 + 1, portable) {
                let mut expected: Vec<u32> = drawn.iter().rev().copied().collect();
                expected.resize(room, 0);
                assert_eq!(decoded, expected, "drawn {drawn:?}");
                expected.sort_unstable();
                assert_eq!(ordered, expected);
            }
        }
    }
}

#[test]
fn one_number_more_than_there_is_room_for_corrupts() {
    for capacity in [Capacity::Four, Capacity::Eight] {
        let room = capacity.lights() as u32;
        let sequences = blended(capacity, room + 1, 1, false);
        let corrupt = sequences.iter().filter(|[drawn, decoded, _]| {
            let last = drawn[1..].iter().rev();
            !last.eq(decoded)
        });
        // Bits that fall off at the lower end round up those above them.
        let corrupt = corrupt.count();
        println!("{capacity:?}: {corrupt} of {} are corrupt", sequences.len());
        assert!(corrupt > sequences.len() / 2, "{corrupt}");
    }
}

/// Adds 1 where the line of sight meets the light's range.
const IN_SIGHT: &str = "#import lightbench::scene
@fragment fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) index: u32,
) -> @location(0) vec4f {
    let sight = normalize(scene::view_direction(pixel.xy, scene::frame.resolution));
    let light = scene::lights[index];
    let center = (scene::frame.view * vec4f(light.position, 1.0)).xyz;
    return vec4f(select(0.0, 1.0, length(cross(sight, center)) < light.range));
}";

/// For each pixel the lights in each channel, with more said of the pass that draws them.
fn in_sight(more: &str) -> Vec<[f32; 4]> {
    let pipeline = format!(
        "let p = pipeline(\"Arrays\");
        p.target(\"result\", \"rgba16float\");
        p.target(\"output\", \"rgba8unorm\");
        p.lights(\"lights\").shader(\"shaders/in_sight.wgsl\").bounded_only(true){more}
            .writes(\"result\").clear(0, 0, 0, 0).blend(\"add\");
        p.fullscreen(\"show\").shader(\"shaders/show.wgsl\").reads(\"result\").writes(\"output\");
        p.show(\"output\");
        p"
    );
    let (_folder, files) = project(&[
        ("scripts/pipelines/arrays.rhai", &pipeline),
        ("shaders/in_sight.wgsl", IN_SIGHT),
        ("shaders/show.wgsl", SHOW),
    ]);
    // Many small ones, so that some that are apart in space are one before the other.
    let mut studio = Studio::new("many_lights", &settings(&["lights=40", "range=1.2"]));
    studio.files = files;
    let (pipeline, _) = studio.draw_whole("arrays", &Settings::new(), (160, 90));
    studio
        .renderer
        .read_target(&pipeline, "result")
        .unwrap()
        .texels
}

#[test]
fn at_any_depth_no_channel_of_the_arrays_holds_two_lights() {
    let all = in_sight(".any_depth(true)");
    let spread = in_sight(".any_depth(true).arrays(4)");
    let apart = in_sight(".arrays(4)");
    let most = |texels: &[[f32; 4]]| texels.iter().flatten().copied().fold(0.0, f32::max);
    assert!(
        most(&apart) > 1.0,
        "lights that are apart in space hide none here"
    );
    assert_eq!(most(&spread), 1.0);
    let sum = |texels: &[[f32; 4]]| texels.iter().map(|t| t.iter().sum::<f32>()).sum::<f32>();
    assert!(sum(&spread) <= sum(&all) / 4.0, "none is drawn twice");
}
