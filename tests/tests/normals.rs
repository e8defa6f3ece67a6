//! The three ways to keep a normal in 32 bits: on the GPU as on the CPU, and what each does to a picture.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench::lab::reference::normals::{
    decode_best_fit, decode_octahedral, decode_plain, encode_best_fit, encode_octahedral,
    encode_plain,
};
use lightbench_tests::compare::{flip_mean, mean_difference};
use lightbench_tests::{Studio, Workshop, gpu, settings};

const SIZE: (u32, u32) = (320, 180);

/// Directions along each side of the picture of directions.
const SIDE: u32 = 64;

/// Encodes and decodes a direction for each pixel, from a stereographic grid: both halves of the
/// sphere, in rational numbers that both sides round alike.
const ROUND_TRIP: &str = "#import lightbench::normals
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let grid = (floor(pixel.xy) - 31.5) / 16.0;
    let squared = dot(grid, grid);
    let direction = vec3f(2.0 * grid, 1.0 - squared) / (1.0 + squared);
    return vec4f(normals::decode_WAY(normals::encode_WAY(direction)), 0.0);
}";

fn direction(index: u32) -> DVec3 {
    let grid = |cell: u32| (f64::from(cell) - 31.5) / 16.0;
    let (x, y) = (grid(index % SIDE), grid(index / SIDE));
    let squared = x * x + y * y;
    DVec3::new(2.0 * x, 2.0 * y, 1.0 - squared) / (1.0 + squared)
}

#[test]
fn normals_come_back_on_the_gpu_as_on_the_cpu() {
    type RoundTrip = fn(DVec3) -> DVec3;
    // With the largest angle that each leaves, in degrees.
    let ways: [(&str, f64, RoundTrip); 3] = [
        ("octahedral", 0.004, |n| {
            decode_octahedral(encode_octahedral(n))
        }),
        ("best_fit", 0.31, |n| decode_best_fit(encode_best_fit(n))),
        ("plain", 0.39, |n| decode_plain(encode_plain(n))),
    ];
    for (way, most, twin) in ways {
        let workshop = Workshop::new();
        let mut scene = workshop.scene("");
        let desc = workshop.pipeline(
            "p.target(\"result\", \"rgba32float\");
            p.fullscreen(\"draw\").shader(\"shaders/draw.wgsl\").writes(\"result\");",
            &[("draw", &ROUND_TRIP.replace("WAY", way))],
        );
        let mut renderer = lightbench::render::Renderer::new(gpu(false));
        let mut pipeline = workshop.compile(&renderer, &desc);
        pipeline.keep_all_targets(true);
        let view = lightbench::render::View::default();
        let (world, assets) = (&mut scene.world, &scene.assets);
        renderer
            .render_whole(world, assets, &mut pipeline, &view, (SIDE, SIDE), 0.0)
            .unwrap();
        let image = renderer.read_target(&pipeline, "result").unwrap();
        let mut others = 0;
        for (index, texel) in (0..).zip(&image.texels) {
            let found = DVec3::new(texel[0].into(), texel[1].into(), texel[2].into());
            let away = found.distance(twin(direction(index)));
            // Single precision may fall on the other side of a step, or take another of two lengths
            // that fit equally well.
            if away > 1e-5 {
                others += 1;
                let kept = found.angle_between(direction(index)).to_degrees();
                assert!(kept < most, "{way} {index}: {kept} degrees away");
            }
        }
        println!("{way}: {others} of {} fall to the other side", SIDE * SIDE);
        assert!(others * 50 < SIDE * SIDE, "{way}: {others}");
    }
}

/// What the ways cost a picture, beside forward shading: in the order of their angles, and each within
/// a bound. What the octahedral map leaves is the rounding of colours and gloss.
#[test]
fn coarser_normals_cost_more_of_the_picture() {
    for (scene, text, bounds) in [
        ("many_lights", "lights=64", [0.0045, 0.006, 0.025]),
        ("brdf_spheres", "surface=gold", [0.0045, 0.006, 0.025]),
    ] {
        let mut studio = Studio::new(scene, &settings(&[text]));
        let full = "accumulation=rgba32float";
        let forward = studio.hdr("forward_single_pass", &settings(&[full]), SIZE);
        let shown = studio.output("forward_single_pass", &settings(&[full]), SIZE);
        let mut last = 0.0;
        for (way, bound) in ["octahedral", "best_fit", "plain"].into_iter().zip(bounds) {
            let texts = settings(&[full, &format!("normals={way}")]);
            let mean = mean_difference(&forward, &studio.hdr("deferred_shading", &texts, SIZE));
            let flip = flip_mean(
                &shown,
                &studio.output("deferred_shading", &texts, SIZE),
                SIZE,
            );
            println!("{scene} {way}: {mean:.5} of the light, FLIP {flip:.5}");
            assert!(mean <= bound, "{scene} {way}: {mean}");
            assert!(mean >= last, "{scene} {way}: {mean} after {last}");
            last = mean;
        }
    }
}
