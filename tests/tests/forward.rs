//! Forward shading: its light is the sum that the CPU makes, passes for groups of lights add up to a
//! single one, and depth or stencil drawn first saves just the fragments that it should.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench::assets::files::Files;
use lightbench::lab::reference::outgoing_radiance;
use lightbench::render::TargetImage;
use lightbench::render::volumes::SPHERE_BOUND;
use lightbench::script::list_pipelines;
use lightbench_tests::compare::largest_difference;
use lightbench_tests::flat::{Paint, Rectangle, Seen, script, seen};
use lightbench_tests::pixels::{Pixels, depth_inside};
use lightbench_tests::{Mistake, Studio, project, project_with_mistake, settings};

const SIZE: (u32, u32) = (240, 135);
const FULL: &str = "accumulation=rgba32float";

/// A floor, and a wall that stands on nothing, so that no pixel shows both at one depth.
const ROOM: [Rectangle; 2] = [
    Rectangle {
        corner: DVec3::new(-20.0, 0.0, 10.0),
        along: DVec3::new(40.0, 0.0, 0.0),
        up: DVec3::new(0.0, 0.0, -30.0),
        paint: Paint {
            color: [0.6, 0.5, 0.4],
            specular: 0.2,
            power: 24.0,
            emissive: 0.0,
        },
    },
    Rectangle {
        corner: DVec3::new(-5.0, 0.1, -6.0),
        along: DVec3::new(9.0, 0.0, 2.0),
        up: DVec3::new(0.0, 5.0, -1.0),
        paint: Paint {
            color: [0.3, 0.5, 0.7],
            specular: 0.4,
            power: 60.0,
            emissive: 0.02,
        },
    },
];

const CAMERA: &str = "camera(\"eye\").at(0.3, 2.5, 6).look_at(0, 1, -2).fov(55).near(0.1).far(60);";

/// One of each kind, and some whose range or cone ends within the picture.
const LAMPS: [&str; 8] = [
    "point_light(\"a\").at(1, 2, 1).range(9).intensity(3);",
    "spot_light(\"b\").at(-3, 4, 2).look_at(-1, 0, -1).inner(30).outer(70).range(12).intensity(9)
        .color(0.4, 0.6, 1);",
    "directional_light(\"c\").at(2, 5, 3).look_at(0, 0, 0).intensity(0.4).color(1, 0.9, 0.7);",
    "ambient_light(\"d\").color(0.5, 0.6, 0.8).intensity(0.1);",
    "point_light(\"e\").at(-2, 1, -3).range(3).intensity(2).color(1, 0.3, 0.2);",
    "spot_light(\"f\").at(3, 2, -1).look_at(3, 0, -3).inner(100).outer(170).range(5).intensity(4);",
    "point_light(\"g\").at(0.5, 0.2, 3).range(1.5).intensity(0.3).color(0.2, 1, 0.4);",
    "point_light(\"h\").at(-1, 3, -12).range(40).intensity(20);",
];

fn studio(lights: &str) -> Studio {
    let scene = format!("{}{CAMERA}{lights}", script(&ROOM));
    let (_folder, files) = project(&[("scripts/scenes/room.rhai", &scene)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "room");
    studio
}

// --- The sum ---------------------------------------------------------------------------------------

/// Pixels that differ from the sum of the CPU, and pixels that were compared. Corners travel in single
/// precision, so that positions are off by some 1e-6 of the scene; a highlight of power 60 makes that
/// some 1e-5 of its light, and the edge of a range more of next to nothing.
fn off_the_sum(studio: &Studio, picture: &TargetImage) -> (usize, usize) {
    let pixels = Pixels::of(&studio.renderer);
    let (mut wrong, mut compared, mut worst) = (0, 0, 0.0_f64);
    for (index, texel) in picture.texels.iter().enumerate() {
        let Seen::Surface(_, surface) = seen(&ROOM, &pixels, index) else {
            continue;
        };
        let expected = outgoing_radiance(studio.renderer.lights(), &surface, pixels.eye);
        let off = (0..3)
            .map(|c| (f64::from(texel[c]) - expected[c]).abs() / (expected[c] + 0.01))
            .fold(0.0, f64::max);
        worst = worst.max(off);
        wrong += usize::from(off > 1e-4);
        compared += 1;
    }
    println!("{wrong} of {compared} pixels are off, by {worst:.1e} at most");
    (wrong, compared)
}

#[test]
fn one_to_eight_lights_make_the_sum_of_the_cpu() {
    for count in 1..=LAMPS.len() {
        let mut studio = studio(&LAMPS[..count].concat());
        for gather in ["gather_lights=on", "gather_lights=off"] {
            let picture = studio.hdr("forward_single_pass", &settings(&[FULL, gather]), SIZE);
            let (wrong, compared) = off_the_sum(&studio, &picture);
            assert_eq!(wrong, 0, "{count} lights");
            assert!(compared > 20_000);
        }
    }
}

/// Must-fail twins of the sum.
#[test]
fn a_lost_light_another_falloff_and_a_wrong_normalisation_are_caught() {
    let mut studio = studio(&LAMPS.concat());
    let mistakes: [Mistake<'_>; 4] = [
        (
            "shaders/forward/single_pass.wgsl",
            "i < object.light_count",
            "i + 1u < object.light_count",
        ),
        ("shaders/lib/lighting.wgsl", "ratio * ratio", "ratio"),
        (
            "shaders/lib/lighting.wgsl",
            "received / brdf::PI",
            "received / 3.14",
        ),
        ("shaders/lib/lighting.wgsl", "edge * edge", "edge"),
    ];
    for mistake in mistakes {
        let (_folder, files) = project_with_mistake(&[], mistake);
        studio.files = files;
        let picture = studio.hdr("forward_single_pass", &settings(&[FULL]), SIZE);
        let (wrong, _) = off_the_sum(&studio, &picture);
        assert!(wrong > 1000, "`{}` went unnoticed: {wrong}", mistake.2);
    }
}

/// Three that shine on what there is, and between them one of each kind that does not shine.
const LIT: [&str; 3] = [LAMPS[0], LAMPS[1], LAMPS[3]];
const DARK: [&str; 4] = [
    "point_light(\"dark\").at(0, 1, 0).range(20).intensity(0);",
    "spot_light(\"dark\").at(0, 3, 0).look_at(0, 0, -1).inner(60).outer(90).range(20).intensity(0);",
    "directional_light(\"dark\").at(1, 3, 2).look_at(0, 0, 0).intensity(0);",
    "ambient_light(\"dark\").intensity(0);",
];

#[test]
fn lights_without_intensity_change_no_bit_in_any_pipeline() {
    let mut lit = studio(&LIT.concat());
    let mut both = studio(&[DARK[0], LIT[0], DARK[1], DARK[2], LIT[1], DARK[3], LIT[2]].concat());
    for entry in list_pipelines(&Files::shipped()).unwrap() {
        let name = &entry.name;
        let expected = lit.hdr(name, &settings(&[]), SIZE);
        let found = both.hdr(name, &settings(&[]), SIZE);
        // Passes that add light add to alpha too, which means nothing.
        assert_eq!(largest_difference(&found, &expected), 0.0, "{name}");
        assert!(expected.texels.iter().any(|texel| texel[0] > 0.1), "{name}");
    }
    assert_eq!(both.renderer.lights().len(), 7);
    // Must-fail twin: lights that never go out.
    let mistake = (
        "shaders/lib/lighting.wgsl",
        "var irradiance = light.intensity;",
        "var irradiance = max(light.intensity, vec3f(0.001));",
    );
    let (_folder, files) = project_with_mistake(&[], mistake);
    both.files = files;
    let expected = lit.hdr("forward_single_pass", &settings(&[]), SIZE);
    let found = both.hdr("forward_single_pass", &settings(&[]), SIZE);
    assert!(largest_difference(&found, &expected) > 1e-5);
}

// --- Several passes --------------------------------------------------------------------------------

/// Ambient light and three lamps, so bright that the brightest pixel is between 0.5 and 1.
const BRIGHT: &str = "
ambient_light(\"sky\").color(0.5, 0.6, 0.8).intensity(0.2);
point_light(\"a\").at(1, 2, 1).range(9).intensity(9);
spot_light(\"b\").at(-3, 4, 2).look_at(-1, 0, -1).inner(30).outer(70).range(12).intensity(30)
    .color(0.4, 0.6, 1);
directional_light(\"c\").at(2, 5, 3).look_at(0, 0, 0).intensity(1).color(1, 0.9, 0.7);";

/// Below 1, half floats round by 2⁻¹² at most. The ambient pass and three lights make four roundings:
/// 1/1024 together.
#[test]
fn groups_of_lights_add_up_to_a_single_pass_in_16_bits() {
    let mut studio = studio(BRIGHT);
    let single = studio.hdr("forward_single_pass", &settings(&[]), SIZE);
    let values = single.texels.iter().flat_map(|texel| &texel[..3]);
    let brightest = values.copied().fold(0.0, f32::max);
    assert!((0.5..1.0).contains(&brightest), "{brightest}");
    let ways = ["scissor=on", "scissor=off", "stencil_mask=on"];
    for at_once in [1, 2, 4] {
        for way in ways.iter().take(if at_once == 1 { 3 } else { 2 }) {
            let texts = settings(&[&format!("lights_at_once={at_once}"), way]);
            let several = studio.hdr("forward_multi_pass", &texts, SIZE);
            let off = largest_difference(&single, &several);
            println!("{at_once} at once, {way}: {off:.1e}");
            assert!(off <= 1.0 / 1024.0, "{at_once} at once, {way}: {off}");
        }
    }
    // Must-fail twin: each pass adds what the surface emits.
    let mistake = (
        "shaders/forward/single_pass.wgsl",
        "var radiance = vec3f(0.0);",
        "var radiance = fragment.emissive;",
    );
    let (_folder, files) = project_with_mistake(&[], mistake);
    studio.files = files;
    let wrong = studio.hdr("forward_multi_pass", &settings(&[]), SIZE);
    let off = largest_difference(&single, &wrong);
    assert!(off > 0.01, "{off}");
}

// --- Fragments -------------------------------------------------------------------------------------

/// How often each pixel is shaded.
fn overdraw(studio: &mut Studio, pipeline: &str, texts: &[&str]) -> Vec<u32> {
    let texts = settings(&[texts, &["heat_map=overdraw"]].concat());
    let counts = studio.hdr(pipeline, &texts, SIZE);
    counts.texels.iter().map(|texel| texel[0] as u32).collect()
}

#[test]
fn with_depth_drawn_first_each_pixel_is_shaded_once() {
    let mut cases = vec![studio(&LIT.concat())];
    for scene in ["many_lights", "atrium"] {
        cases.push(Studio::new(scene, &settings(&[])));
    }
    for studio in &mut cases {
        for pipeline in ["forward_single_pass", "clustered_forward"] {
            let with = overdraw(studio, pipeline, &["depth_prepass=on"]);
            let without = overdraw(studio, pipeline, &["depth_prepass=off"]);
            let (drawn, _) = studio.draw_whole(pipeline, &settings(&["depth_prepass=on"]), SIZE);
            let depth = studio.renderer.read_target(&drawn, "depth").unwrap();
            let mut touching = 0;
            for (index, texel) in depth.texels.iter().enumerate() {
                let covered = u32::from(texel[0] > 0.0);
                // Where two surfaces touch, both have the depth that passes.
                touching += usize::from(with[index] > covered);
                assert!(with[index] >= covered, "{pipeline}, pixel {index}");
                assert!(without[index] >= covered);
            }
            let sum = |counts: &[u32]| counts.iter().sum::<u32>();
            println!(
                "{pipeline}: {} fragments with depth first, {} without, {touching} pixels twice",
                sum(&with),
                sum(&without)
            );
            assert!(touching * 1000 < with.len(), "{touching}");
            assert!(sum(&with) < sum(&without));
        }
    }
    // Must-fail twin: depth is drawn first, and then not looked at.
    let mistake = (
        "scripts/pipelines/forward_single_pass.rhai",
        "shade.depth(\"depth\").test(\"equal\").read_only();",
        "shade.depth(\"depth\").clear(0.0);",
    );
    let (_folder, files) = project_with_mistake(&[], mistake);
    let studio = &mut cases[1];
    studio.files = files;
    let wrong = overdraw(studio, "forward_single_pass", &["depth_prepass=on"]);
    assert!(wrong.iter().filter(|count| **count > 1).count() > 1000);
}

/// Pixels that miss a light that reaches them, and pixels that are shaded for one that does not: with
/// a stencil mask a pixel is shaded once, and once more for each light in whose volume it lies. Volumes
/// have flat faces, and stand out by up to 7 % of the range.
fn off_the_mask(studio: &mut Studio, fragments: &[u32]) -> (usize, usize) {
    let (pipeline, _) = studio.draw_whole("forward_single_pass", &settings(&[]), SIZE);
    let depth = studio.renderer.read_target(&pipeline, "depth").unwrap();
    let pixels = Pixels::of(&studio.renderer);
    let lights = studio.renderer.lights();
    let (mut missed, mut in_vain) = (0, 0);
    for (index, found) in fragments.iter().enumerate() {
        let reversed = depth.texels[index][0];
        let point = pixels.at(index, reversed);
        let within = |share: f64| {
            let inside = |light: &&_| depth_inside(light, point) > share;
            let lamps = lights.iter().filter(|light| light.kind == 0);
            u32::from(reversed > 0.0) * (1 + lamps.filter(inside).count() as u32)
        };
        missed += usize::from(*found < within(1e-4));
        in_vain += usize::from(*found > within(1.0 - f64::from(SPHERE_BOUND)));
    }
    (missed, in_vain)
}

#[test]
fn a_stencil_mask_shades_the_pixels_within_each_light_and_no_others() {
    let lights = [0, 4, 6, 7].map(|lamp| LAMPS[lamp]).concat();
    let hard = |case: &str| Studio::new("hard_cases", &settings(&[case]));
    let mut cases = [
        studio(&lights),
        Studio::new("many_lights", &settings(&["lights=40"])),
        hard("case=camera_inside"),
        hard("case=near_plane"),
        // Where the far plane would cut a volume, all pixels are marked.
        hard("case=far_plane"),
    ];
    for (case, studio) in cases.iter_mut().enumerate() {
        let masked = overdraw(studio, "forward_multi_pass", &["stencil_mask=on"]);
        let cut = case == 4;
        let (missed, in_vain) = off_the_mask(studio, &masked);
        assert_eq!((missed, in_vain > 0), (0, cut), "case {case}: {in_vain}");
        let sum = |counts: &[u32]| counts.iter().sum::<u32>();
        let scissored = overdraw(studio, "forward_multi_pass", &[]);
        let plain = overdraw(studio, "forward_multi_pass", &["scissor=off"]);
        println!(
            "{} fragments with masks, {} with rectangles, {} without",
            sum(&masked),
            sum(&scissored),
            sum(&plain)
        );
        assert!(sum(&masked) < sum(&scissored) || cut);
        assert!(sum(&masked) <= sum(&scissored) && sum(&scissored) <= sum(&plain));
    }
    // Must-fail twin: volumes that are too small.
    let mistake = (
        "shaders/vertex/light_volume.wgsl",
        "vec4f(position, 1.0)",
        "vec4f(0.95 * position, 1.0)",
    );
    let (_folder, files) = project_with_mistake(&[], mistake);
    let studio = &mut cases[1];
    studio.files = files;
    let masked = overdraw(studio, "forward_multi_pass", &["stencil_mask=on"]);
    assert!(off_the_mask(studio, &masked).0 > 100);
}
