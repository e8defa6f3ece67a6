//! All pipelines give the same picture of opaque objects.
#![allow(clippy::unwrap_used)]

mod comparison;

use lightbench::assets::files::Files;
use lightbench::lab::{HdrImage, diff};
use lightbench::script::list_pipelines;
use lightbench_tests::compare::{flip_mean, mean_difference, relative_difference};
use lightbench_tests::{Studio, project_with_mistake, settings};

use comparison::{PIPELINES, QUANTISATION, Room, Surfaces, agree, agree_among, studio};

const SIZE: (u32, u32) = (320, 180);

#[test]
fn on_the_atrium() {
    agree("atrium", &[], false, Room::Short);
}

#[test]
fn on_the_atrium_with_portable_features_only() {
    agree("atrium", &[], true, Room::Short);
}

#[test]
fn on_many_lights() {
    agree("many_lights", &["lights=64"], false, Room::Short);
    agree("many_lights", &["lights=256"], false, Room::Short);
}

#[test]
fn on_many_lights_with_portable_features_only() {
    agree("many_lights", &["lights=64"], true, Room::Short);
    agree("many_lights", &["lights=256"], true, Room::Short);
}

#[test]
fn on_the_cornell_box() {
    agree("cornell_box", &[], false, Room::Short);
}

/// Pipelines with room for few lights a pixel, both ways of packing, on scenes that need no more.
#[test]
fn within_their_capacity_nothing_is_lost() {
    const LIMITED: [(&str, Surfaces, &[&str]); 10] = [
        ("forward_single_pass", Surfaces::Exact, &[]),
        ("deferred_shading", Surfaces::GBuffer, &[]),
        (
            "light_indexed_forward",
            Surfaces::Exact,
            &["packing=bits", "lights_per_pixel=8"],
        ),
        (
            "light_indexed_forward",
            Surfaces::Exact,
            &["packing=bits", "lights_per_pixel=4"],
        ),
        (
            "light_indexed_forward",
            Surfaces::Exact,
            &["packing=arrays", "lights_per_pixel=8"],
        ),
        (
            "light_indexed_forward",
            Surfaces::Exact,
            &["transparency=forward"],
        ),
        (
            "light_indexed_deferred",
            Surfaces::GBuffer,
            &["transparency=forward"],
        ),
        (
            "light_indexed_deferred",
            Surfaces::GBuffer,
            &["packing=bits", "lights_per_pixel=8"],
        ),
        (
            "light_indexed_deferred",
            Surfaces::GBuffer,
            &["packing=bits", "lights_per_pixel=4"],
        ),
        (
            "light_indexed_deferred",
            Surfaces::GBuffer,
            &["packing=arrays", "lights_per_pixel=8"],
        ),
    ];
    let mut studios = [studio(false), studio(true)];
    for (scene, texts) in [
        ("many_lights", &["lights=64", "range=1.3"][..]),
        ("many_lights", &["lights=256", "range=0.8"]),
        ("cornell_box", &["lamps=2"]),
        ("atrium", &["lights=6"]),
        ("hard_cases", &["case=panes"]),
    ] {
        for (portable, studio) in [false, true].into_iter().zip(&mut studios) {
            agree_among(studio, &LIMITED, scene, texts, portable, Room::Enough);
        }
    }
}

/// Each reflection model through each pipeline, as plastic and as metal.
#[test]
fn on_all_reflection_models() {
    agree("brdf_spheres", &["surface=plastic"], false, Room::Enough);
    agree("brdf_spheres", &["surface=gold"], false, Room::Enough);
}

#[test]
fn on_all_reflection_models_with_portable_features_only() {
    agree("brdf_spheres", &["surface=gold"], true, Room::Enough);
}

/// Deferred lighting carries no Fresnel term. What it draws instead differs from what was asked for,
/// so that the comparison above is with something else; and it says so, once.
#[test]
fn a_model_that_a_pipeline_lacks_is_drawn_as_another_and_told() {
    let mut studio = Studio::new("brdf_spheres", &settings(&["surface=gold"]));
    let full = settings(&["accumulation=rgba32float"]);
    let asked_for = studio.hdr("forward_single_pass", &full, SIZE);
    assert_eq!(studio.renderer.take_warnings(), [] as [&str; 0]);
    let drawn = studio.hdr("deferred_lighting", &full, SIZE);
    let difference = mean_difference(&asked_for, &drawn);
    assert!(difference > 4.0 * QUANTISATION, "{difference}");
    let told = "deferred_lighting: 16 materials are drawn with another reflection model: \
                8 of `beckmann` as `ward`, 8 of `ggx` as `ward`";
    assert_eq!(studio.renderer.take_warnings(), [told]);

    // The table of materials is another for each pipeline.
    let again = studio.hdr("forward_single_pass", &full, SIZE);
    assert_eq!(relative_difference(&asked_for, &again), 0.0);
    assert_eq!(studio.renderer.take_warnings(), [] as [&str; 0]);
}

/// Where techniques differ in what they must get right.
const HARD_CASES: [&str; 11] = [
    "camera_inside",
    "near_plane",
    "far_plane",
    "wide_spot",
    "tiny",
    "huge",
    "one_point",
    "behind",
    "panes",
    "no_lights",
    "no_objects",
];

fn on_hard_cases(portable: bool) {
    let mut studio = studio(portable);
    for case in HARD_CASES {
        let room = if case == "one_point" {
            Room::OnePoint
        } else {
            Room::Enough
        };
        let case = format!("case={case}");
        agree_among(
            &mut studio,
            &PIPELINES,
            "hard_cases",
            &[&case],
            portable,
            room,
        );
    }
}

#[test]
fn on_the_hard_cases() {
    on_hard_cases(false);
}

#[test]
fn on_the_hard_cases_with_portable_features_only() {
    on_hard_cases(true);
}

/// Must-fail twins: a shader with one mistake is outside the bounds that right ones keep.
#[test]
fn a_wrong_normal_a_lost_light_and_a_shifted_pixel_are_caught() {
    let mistakes = [
        (
            "shaders/lib/normals.wgsl",
            "vec2f(encoded) / 65535.0 * 2.0",
            "vec2f(encoded) / 65535.0 * 1.97",
        ),
        (
            "shaders/deferred_shading/light.wgsl",
            "sample) == 0.0 {",
            "sample) == 0.0 || light == 3u {",
        ),
        (
            "shaders/deferred_shading/light.wgsl",
            "let texel = vec2u(pixel.xy);",
            "let texel = vec2u(pixel.xy) + vec2u(1u, 0u);",
        ),
    ];
    let mut studio = Studio::new("many_lights", &settings(&["lights=64"]));
    let full = settings(&["accumulation=rgba32float"]);
    let forward = studio.hdr("forward_single_pass", &full, SIZE);
    let right = mean_difference(&forward, &studio.hdr("deferred_shading", &full, SIZE));
    assert!(right <= QUANTISATION);
    for (path, from, to) in mistakes {
        let (_folder, files) = project_with_mistake(&[], (path, from, to));
        studio.files = files;
        let wrong = mean_difference(&forward, &studio.hdr("deferred_shading", &full, SIZE));
        assert!(wrong > QUANTISATION, "`{to}` went unnoticed: {wrong}");
    }
}

/// A pipeline that is not in the list above would go untested.
#[test]
fn every_shipped_pipeline_is_compared() {
    let shipped = list_pipelines(&Files::shipped()).unwrap();
    for pipeline in shipped {
        assert!(
            PIPELINES.iter().any(|(name, ..)| *name == pipeline.name),
            "{} is not compared with the others",
            pipeline.name
        );
    }
}

/// Must-fail twins: the comparison sees a shifted pixel column and a missing light.
#[test]
fn the_comparison_notices_what_must_not_pass() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=64"]));
    let picture = studio.output("deferred_shading", &settings(&[]), SIZE);
    let mut shifted = picture.clone();
    shifted.rotate_right(4);
    assert!(flip_mean(&picture, &shifted, SIZE) > 0.01);
    let mut darker = Studio::new("many_lights", &settings(&["lights=56"]));
    let darker = darker.output("deferred_shading", &settings(&[]), SIZE);
    assert!(flip_mean(&picture, &darker, SIZE) > 0.01);
}

#[test]
fn no_pixel_is_invalid_and_the_energy_is_the_same() {
    for scene in ["atrium", "many_lights", "cornell_box"] {
        let mut studio = Studio::new(scene, &settings(&[]));
        let [forward, deferred] = ["forward_single_pass", "deferred_shading"].map(|name| {
            let image = studio.hdr(name, &settings(&[]), SIZE);
            assert!(
                image
                    .texels
                    .iter()
                    .all(|texel| texel[..3].iter().all(|v| v.is_finite() && *v >= 0.0))
            );
            HdrImage::new(image.width, image.height, image.texels).unwrap()
        });
        let errors = diff::diff_hdr(&forward, &deferred, diff::DiffOptions::default())
            .unwrap()
            .difference;
        let ratio = errors.linear.energy_ratio;
        assert!((ratio - 1.0).abs() < 0.01, "{scene}: energy ratio {ratio}");
    }
}
