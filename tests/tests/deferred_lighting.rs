//! Deferred lighting against deferred shading: the same picture with highlights in colour; with
//! monochrome ones the same where all lights have one hue, and a known loss where they have many.
#![allow(clippy::unwrap_used)]

use lightbench::render::TargetImage;
use lightbench_tests::compare::{flip_mean, mean_difference, relative_difference};
use lightbench_tests::{Mistake, Studio, hard_shapes, project, project_with_mistake, settings};

const SIZE: (u32, u32) = (320, 180);
const FULL: &str = "accumulation=rgba32float";

/// Balls and a floor with grey and with golden highlights.
const BALLS: &str = "
let floor = material(\"floor\").color(rgb(0.5, 0.45, 0.4)).specular(0.06).power(40);
let paint = material(\"paint\").color(rgb(0.6, 0.06, 0.2)).specular(0.3).power(80);
let gold = material(\"gold\").color(rgb(0.03, 0.02, 0.01)).specular(rgb(0.8, 0.5, 0.13)).power(300);
spawn(\"floor\").mesh(plane(40, 40)).material(floor);
for i in 0..9 {
    spawn(\"ball \" + i).mesh(sphere(0.7).segments(48, 24)).material(if i % 2 == 0 { paint } else { gold })
        .at(1.7 * (i % 3) - 1.7, 0.7, -1.7 * (i / 3));
}
camera(\"eye\").at(0, 3, 5).look_at(0, 0.5, -1).fov(50).near(0.1).far(60);
";
/// Five lamps of the same hue, of any brightness, and a sky of that hue.
const ONE_HUE: &str = "
for i in 0..5 {
    point_light(\"lamp\").at(2.5 * sin(2.0 * i), 2 + 0.3 * i, 2.5 * cos(2.0 * i) - 1).range(9)
        .color(1, 0.7, 0.4).intensity(1.0 + 2 * i);
}
ambient_light(\"sky\").color(1, 0.7, 0.4).intensity(0.05);";
const MANY_HUES: &str = "
for i in 0..5 {
    point_light(\"lamp\").at(2.5 * sin(2.0 * i), 2 + 0.3 * i, 2.5 * cos(2.0 * i) - 1).range(9)
        .color(hsv(72 * i, 0.8, 1)).intensity(1.0 + 2 * i);
}
ambient_light(\"sky\").color(0.5, 0.6, 1).intensity(0.05);";

fn studio(lights: &str) -> Studio {
    let scene = format!("{BALLS}{lights}");
    let (_folder, files) = project(&[("scripts/scenes/balls.rhai", &scene)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "balls");
    studio
}

/// How many steps of 255 two pictures are apart at most, as a display shows them.
fn steps_apart(studio: &mut Studio) -> u8 {
    let texts = settings(&[FULL]);
    let deferred = studio.output("deferred_shading", &texts, SIZE);
    let lighting = studio.output("deferred_lighting", &texts, SIZE);
    let steps = deferred.iter().zip(&lighting).map(|(a, b)| a.abs_diff(*b));
    steps.max().unwrap()
}

/// Though a G-buffer rounds colours to 8 bits of a root, and deferred lighting keeps none: that is half
/// a step of a display's code, which is much like a root. The tone curve makes it no larger; a linear
/// one would, by up to two steps on dark surfaces in bright light.
#[test]
fn coloured_highlights_give_the_picture_of_deferred_shading_within_a_255th() {
    let (_folder, files) = hard_shapes();
    let mut shapes = studio(ONE_HUE);
    shapes.show(files, "shapes");
    let mut cases = [
        ("one hue", studio(ONE_HUE)),
        ("many hues", studio(MANY_HUES)),
        ("shapes", shapes),
        ("atrium", Studio::new("atrium", &settings(&[]))),
        (
            "many lights",
            Studio::new("many_lights", &settings(&["lights=64"])),
        ),
        ("cornell box", Studio::new("cornell_box", &settings(&[]))),
        (
            "wide spot",
            Studio::new("hard_cases", &settings(&["case=wide_spot"])),
        ),
    ];
    for (name, studio) in &mut cases {
        let most = steps_apart(studio);
        println!("{name}: {most} steps at most");
        assert!(most <= 1, "{name}: {most}");
    }
    // Must-fail twins: a little less light, and highlights without their share of the surface.
    let mistakes: [Mistake<'_>; 2] = [
        (
            "shaders/deferred_lighting/material.wgsl",
            "* diffuse.rgb",
            "* 0.97 * diffuse.rgb",
        ),
        (
            "shaders/deferred_lighting/material.wgsl",
            "fragment.specular * highlight",
            "0.3 * highlight",
        ),
    ];
    for mistake in mistakes {
        let (_folder, files) = project_with_mistake(&[], mistake);
        let (_, studio) = &mut cases[0];
        studio.files = files;
        let most = steps_apart(studio);
        assert!(most > 1, "`{}` went unnoticed: {most}", mistake.2);
    }
}

fn monochrome_and_colour(studio: &mut Studio) -> [TargetImage; 2] {
    ["highlights=monochrome", "highlights=color"]
        .map(|highlights| studio.hdr("deferred_lighting", &settings(&[FULL, highlights]), SIZE))
}

#[test]
fn monochrome_highlights_are_exact_where_all_lights_have_one_hue() {
    let mut studio = studio(ONE_HUE);
    let [monochrome, colour] = monochrome_and_colour(&mut studio);
    let off = relative_difference(&monochrome, &colour);
    println!("one hue: {off:.1e}");
    // Some ten operations of single precision more.
    assert!(off < 1e-6, "{off}");
    // Must-fail twins.
    let mistakes: [Mistake<'_>; 2] = [
        (
            "shaders/deferred_lighting/material.wgsl",
            "diffuse.rgb * (",
            "vec3f(",
        ),
        (
            "shaders/lib/g_buffer.wgsl",
            "vec3f(0.2126, 0.7152, 0.0722)",
            "vec3f(0.2126, 0.7152, 0.05) * length(color)",
        ),
    ];
    for mistake in mistakes {
        let (_folder, files) = project_with_mistake(&[], mistake);
        studio.files = files;
        let [monochrome, colour] = monochrome_and_colour(&mut studio);
        let off = relative_difference(&monochrome, &colour);
        assert!(off > 1e-3, "`{}` went unnoticed: {off}", mistake.2);
    }
}

/// Highlights take the hue of the diffuse light and keep their luminance. So the whole picture keeps its
/// luminance where surfaces mirror all colours alike; hues shift by what was measured, with a fifth
/// to spare.
#[test]
fn what_monochrome_highlights_lose_under_many_hues_is_known() {
    let mut cases = [
        ("balls", studio(MANY_HUES), 0.062, 2e-4),
        (
            "many lights",
            Studio::new("many_lights", &settings(&["lights=64"])),
            0.028,
            1e-7,
        ),
        ("atrium", Studio::new("atrium", &settings(&[])), 0.008, 1e-7),
    ];
    for (name, studio, most, luminance_bound) in &mut cases {
        let [monochrome, colour] = monochrome_and_colour(studio);
        let mean = mean_difference(&colour, &monochrome);
        let luminance = |texel: &[f32; 4]| {
            let [r, g, b, _] = texel.map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let sum = |image: &TargetImage| image.texels.iter().map(luminance).sum::<f64>();
        let brightness = sum(&monochrome) / sum(&colour) - 1.0;
        let shown = ["highlights=monochrome", "highlights=color"]
            .map(|text| studio.output("deferred_lighting", &settings(&[FULL, text]), SIZE));
        let flip = flip_mean(&shown[0], &shown[1], SIZE);
        println!("{name}: mean {mean:.2e}, FLIP {flip:.4}, brightness {brightness:.1e}");
        assert!(mean > 1e-3 && mean < *most, "{name}: {mean}");
        assert!(brightness.abs() < *luminance_bound, "{name}: {brightness}");
        assert!(flip < 0.016, "{name}: {flip}");
    }
}
