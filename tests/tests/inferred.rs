//! Inferred lighting: light stays on its side of an edge, full-size buffers lose nothing, and each
//! transparent layer gets its own light.
#![allow(clippy::unwrap_used)]

use std::f32::consts::PI;

use lightbench::render::TargetImage;
use lightbench_tests::compare::mean_difference;
use lightbench_tests::panes::{composite, middle, panes};
use lightbench_tests::{Counts, Studio, gpu, hard_shapes, project, project_with_mistake, settings};

const PIPELINE: &str = "inferred_lighting";
const FULL: &str = "accumulation=rgba32float";
/// Not a multiple of anything, so that the texels of small buffers lie in all ways to the edges.
const SIZE: (u32, u32) = (203, 151);

/// A sun from the left; what faces the camera is lit, what is turned to the right is dark.
const SUN: &str = "
directional_light(\"sun\").at(-1, 0, 1).look_at(0, 0, 0).color(1, 1, 1).intensity(4);
camera(\"eye\").at(0.013, 0.1, 8).look_at(0.013, 0.1, 0).fov(40).near(0.1).far(50);
let matt = material(\"matt\").color(rgb(0.5, 0.5, 0.5)).specular(0);
let lit = [vec3(-4, -2.5, 0), vec3(0, -2.5, 0), vec3(0, 2.5, 0), vec3(-4, 2.5, 0)];
let dark = [vec3(0, -2.5, 0), vec3(2, -2.5, -3.464), vec3(2, 2.5, -3.464), vec3(0, 2.5, 0)];
";
/// Two flat objects side by side.
const TWO: &str = "spawn(\"lit\").mesh(faces([lit])).material(matt);
spawn(\"dark\").mesh(faces([dark])).material(matt);";
/// One object with a hard edge.
const ONE: &str = "spawn(\"both\").mesh(faces([lit, dark])).material(matt);";

/// What the sun makes the lit side send: ρ / π · E · cos 45°.
fn lit() -> f32 {
    0.5 / PI * 4.0 * 0.5_f32.sqrt()
}

fn studio(scene: &str) -> Studio {
    let (folder, files) = project(&[("scripts/scenes/flat.rhai", scene)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "flat");
    drop(folder);
    studio
}

fn draw(studio: &mut Studio, texts: &[&str]) -> (TargetImage, TargetImage, Counts) {
    let (pipeline, counts) = studio.draw_whole(PIPELINE, &settings(texts), SIZE);
    let read = |name| studio.renderer.read_target(&pipeline, name).unwrap();
    (read("hdr"), read("acceptance"), counts)
}

/// Pixels that differ by more than a hundred-thousandth of the lit side's light.
fn differing(a: &TargetImage, b: &TargetImage) -> usize {
    let pixels = a.texels.iter().zip(&b.texels);
    pixels
        .filter(|(a, b)| (a[0] - b[0]).abs() > 1e-5 * lit())
        .count()
}

#[test]
fn light_does_not_cross_the_edge_between_two_flat_objects() {
    let mut studio = studio(&format!("{SUN}{TWO}"));
    let expected = studio.hdr("deferred_lighting", &settings(&[FULL]), SIZE);
    let most = expected.texels.iter().map(|t| t[0]).fold(0.0, f32::max);
    assert!((most / lit() - 1.0).abs() < 1e-4, "{most} is not {}", lit());
    for surfaces in ["surfaces=depth_and_groups", "surfaces=object_id"] {
        for scale in ["scale=0.5", "scale=0.37", "scale=0.25"] {
            let (found, acceptance, counts) = draw(&mut studio, &[FULL, surfaces, scale]);
            assert_eq!(differing(&expected, &found), 0, "{surfaces} {scale}");
            let black = acceptance.texels.iter().filter(|t| t[0] == 0.0).count();
            assert_eq!(counts.of("pixels_across_edges"), black as u32);
            // The filter left texels out along the edges, and nowhere else.
            let filtered = acceptance.texels.iter().filter(|t| t[0] < 1.0).count();
            assert!(
                filtered > 300 && filtered < acceptance.texels.len() / 4,
                "{filtered}"
            );

            let (bled, acceptance, _) = draw(&mut studio, &[FULL, surfaces, scale, "filter=off"]);
            let bled = differing(&expected, &bled);
            println!("{surfaces} {scale}: {filtered} pixels filtered; without, {bled} bleed");
            assert!(bled > 200, "{bled}");
            assert!(acceptance.texels.iter().all(|t| t[0] == 1.0));
        }
    }
}

#[test]
fn smooth_groups_keep_light_on_its_side_of_a_hard_edge() {
    let mut studio = studio(&format!("{SUN}{ONE}"));
    let expected = studio.hdr("deferred_lighting", &settings(&[FULL]), SIZE);
    let (found, ..) = draw(&mut studio, &[FULL]);
    assert_eq!(differing(&expected, &found), 0);
    // Objects alone don't know of it.
    let (found, ..) = draw(&mut studio, &[FULL, "surfaces=object_id"]);
    assert!(differing(&expected, &found) > 100);
}

#[test]
fn four_samples_mix_the_sides_and_nothing_else() {
    let mut studio = studio(&format!("{SUN}{TWO}"));
    let (found, ..) = draw(&mut studio, &["antialiasing=msaa"]);
    let mut mixed = 0;
    for (index, texel) in found.texels.iter().enumerate() {
        let quarters = texel[0] / lit() * 4.0;
        let off = (quarters - quarters.round()).abs();
        assert!(
            off < 0.01,
            "pixel {index}: {quarters} quarters of the light"
        );
        mixed += usize::from(quarters > 0.5 && quarters < 3.5);
    }
    assert!(mixed > 100, "{mixed} pixels are smoothed");
}

#[test]
fn full_size_buffers_give_the_picture_of_deferred_lighting() {
    let (_folder, files) = hard_shapes();
    for (scene, texts) in [
        ("shapes", &[][..]),
        ("atrium", &[]),
        ("many_lights", &["lights=64"]),
        ("cornell_box", &[]),
        ("hard_cases", &["case=wide_spot"]),
        ("hard_cases", &["case=panes"]),
        ("brdf_spheres", &["surface=gold"]),
    ] {
        let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
        if scene == "shapes" {
            studio.show(files.clone(), scene);
        } else {
            studio = Studio::new(scene, &settings(texts));
        }
        for highlights in ["highlights=color", "highlights=monochrome"] {
            let plain = settings(&[FULL, highlights]);
            let expected = studio.hdr("deferred_lighting", &plain, SIZE);
            for surfaces in ["surfaces=depth_and_groups", "surfaces=object_id"] {
                let full_size = [
                    FULL,
                    highlights,
                    surfaces,
                    "scale=1",
                    "transparency=forward",
                ];
                let found = studio.hdr(PIPELINE, &settings(&full_size), SIZE);
                assert!(
                    found.texels == expected.texels,
                    "{scene} {texts:?} {highlights} {surfaces}"
                );
            }
        }
    }
}

#[test]
fn three_stacked_panes_recover_the_light_of_each_layer() {
    let mut studio = studio(&panes(&[0, 1, 2]));
    let expected = composite(3);
    for scale in ["scale=1", "scale=0.5", "scale=0.3"] {
        for surfaces in ["surfaces=depth_and_groups", "surfaces=object_id"] {
            let (found, acceptance, counts) = draw(&mut studio, &[FULL, scale, surfaces]);
            for texel in middle(&found) {
                for channel in 0..3 {
                    let off = f64::from(texel[channel]) / expected[channel] - 1.0;
                    assert!(off.abs() < 1e-4, "{scale}: {texel:?} is not {expected:?}");
                }
            }
            assert!(middle(&acceptance).all(|texel| texel[0] > 0.0), "{scale}");
            assert_eq!(counts.of("texels_of_lost_layers"), 0);
        }
    }
}

#[test]
fn a_fourth_pane_loses_its_light_and_is_counted() {
    let mut studio = studio(&panes(&[0, 1, 2, 3]));
    let (found, acceptance, counts) = draw(&mut studio, &[FULL]);
    // It shares its layer, a quarter of the texels, with the nearest one: of these it loses all
    // that both cover, at least those in the middle of the picture.
    let lost = counts.of("texels_of_lost_layers");
    let texels = SIZE.0 * SIZE.1 / 4;
    println!("{lost} of {texels} texels lost a layer");
    assert!(lost > texels / 4 / 9 && lost < texels / 4, "{lost}");
    let black = acceptance.texels.iter().filter(|t| t[0] == 0.0).count();
    assert_eq!(counts.of("pixels_across_edges"), black as u32);
    assert!(
        middle(&acceptance).all(|texel| texel[0] == 0.0),
        "the fourth has no texel"
    );
    // The light is wrong there, but it is light.
    let expected = composite(4);
    let worst = middle(&found).map(|texel| (f64::from(texel[0]) / expected[0] - 1.0).abs());
    let worst = worst.fold(0.0, f64::max);
    assert!(worst > 1e-3 && worst < 0.5, "{worst}");
    // Drawn forward, four are no more than three.
    let (found, ..) = draw(&mut studio, &[FULL, "transparency=forward"]);
    for texel in middle(&found) {
        assert!((f64::from(texel[0]) / expected[0] - 1.0).abs() < 1e-4);
    }
}

#[test]
fn pictures_smaller_than_a_pattern_draw() {
    for portable in [false, true] {
        let mut studio = Studio::on(gpu(portable), "hard_cases", &settings(&["case=panes"]));
        for size in [(1, 1), (2, 1), (5, 3)] {
            for scale in ["scale=0.125", "scale=0.5", "scale=1"] {
                let image = studio.hdr(PIPELINE, &settings(&[scale]), size);
                let finite = |texel: &[f32; 4]| texel.iter().all(|value| value.is_finite());
                assert!(image.texels.iter().all(finite), "{size:?} {scale}");
            }
        }
    }
}

/// Half the width and height lose detail of normals and highlights; the filter must lose less than
/// going without, most of all where light changes at edges.
#[test]
fn at_half_the_size_the_filter_saves_light_from_crossing_edges() {
    const LARGER: (u32, u32) = (640, 360);
    // For each scene the mean difference with the filter at most, and as a share of that without.
    for (scene, texts, most, share) in [
        ("atrium", &[][..], 0.17, 0.7),
        ("many_lights", &["lights=64"], 0.09, 0.8),
        ("cornell_box", &[], 3e-4, 0.05),
        ("hard_cases", &["case=camera_inside"], 0.0025, 0.8),
        ("hard_cases", &["case=panes"], 0.005, 0.1),
    ] {
        let mut studio = Studio::new(scene, &settings(texts));
        let expected = studio.hdr("deferred_lighting", &settings(&[FULL]), LARGER);
        let mut error = |texts: &[&str]| {
            let found = studio.hdr(PIPELINE, &settings(&[&[FULL], texts].concat()), LARGER);
            mean_difference(&expected, &found)
        };
        let (with, without) = (error(&[]), error(&["filter=off"]));
        let objects = error(&["surfaces=object_id"]);
        println!(
            "{scene} {texts:?}: {with:.4} with, {without:.4} without, {objects:.4} by objects"
        );
        assert!(with < most, "{scene} {texts:?}: {with}");
        assert!(
            with < share * without,
            "{scene} {texts:?}: {with} and {without}"
        );
        assert!(objects < without && with < 1.05 * objects);
    }
}

/// Must-fail twins: a filter with one mistake bleeds, or loses light at full size.
#[test]
fn mistakes_of_the_filter_are_caught() {
    let shader = "shaders/inferred/material.wgsl";
    for (from, to) in [
        ("vec2f(texel) + 0.5", "vec2f(texel)"),
        ("texels_per_pixel - 0.5 -", "texels_per_pixel -"),
        ("side == vec2i(1)", "side == vec2i(0)"),
    ] {
        let (_folder, files) = project_with_mistake(&[], (shader, from, to));
        // A slope, so that where a texel lies matters to its depth.
        let mut studio = Studio::new("many_lights", &settings(&["lights=16"]));
        let strict = [FULL, "scale=0.5", "depth_tolerance=0.001"];
        let right = studio.hdr(PIPELINE, &settings(&strict), SIZE);
        let reference = studio.hdr("deferred_lighting", &settings(&[FULL]), SIZE);
        studio.files = files;
        let wrong = studio.hdr(PIPELINE, &settings(&strict), SIZE);
        let error = |image: &TargetImage| {
            let pixels = image.texels.iter().zip(&reference.texels);
            pixels
                .map(|(a, b)| f64::from((a[0] - b[0]).abs()))
                .sum::<f64>()
        };
        println!("`{to}`: {} instead of {}", error(&wrong), error(&right));
        assert!(
            error(&wrong) > 1.05 * error(&right),
            "`{to}` went unnoticed"
        );
    }
}
