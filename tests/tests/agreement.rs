//! All pipelines give the same picture of opaque objects.
#![allow(clippy::unwrap_used)]

use lightbench::lab::{HdrImage, LdrImage, diff};
use lightbench::render::TargetImage;
use lightbench_tests::{Studio, gpu, settings};

const SIZE: (u32, u32) = (320, 180);
const PIPELINES: [&str; 2] = ["forward_single_pass", "deferred_shading"];

fn flip_mean(a: &[u8], b: &[u8]) -> f64 {
    let picture = |bytes: &[u8]| {
        let pixels = bytes
            .chunks_exact(4)
            .map(|p| [p[0], p[1], p[2], p[3]])
            .collect();
        LdrImage::new(SIZE.0, SIZE.1, pixels).unwrap()
    };
    let options = diff::DiffOptions::default();
    diff::diff_ldr(&picture(a), &picture(b), options)
        .unwrap()
        .difference
        .flip
        .mean
}

fn agree(scene: &str, texts: &[&str], portable: bool) {
    let mut studio = Studio::on(gpu(portable), scene, &settings(texts));
    let [forward, deferred] = PIPELINES.map(|name| studio.output(name, &settings(&[]), SIZE));
    let flip = flip_mean(&forward, &deferred);
    println!("{scene} {texts:?} portable={portable}: FLIP mean {flip:.5}");
    assert!(flip < 0.01, "{scene} {texts:?}: FLIP mean {flip}");
    assert!(
        forward.chunks_exact(4).any(|p| p[..3] != forward[..3]),
        "{scene}: the picture is not plain"
    );
}

#[test]
fn on_the_atrium() {
    agree("atrium", &[], false);
}

#[test]
fn on_the_atrium_with_portable_features_only() {
    agree("atrium", &[], true);
}

#[test]
fn on_many_lights() {
    agree("many_lights", &["lights=64"], false);
    agree("many_lights", &["lights=256"], false);
}

#[test]
fn on_the_cornell_box() {
    agree("cornell_box", &[], false);
}

/// Options of one pipeline that must not change its picture. With 32-bit accumulation the
/// order of additions is all that differs.
#[test]
fn options_that_only_change_the_cost_change_no_pixel() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=64"]));
    let mut hdr = |pipeline: &str, texts: &[&str]| studio.hdr(pipeline, &settings(texts), SIZE);
    let full = "accumulation=rgba32float";
    let forward = hdr("forward_single_pass", &[full]);
    for texts in [[full, "depth_prepass=on"], [full, "gather_lights=off"]] {
        close(
            &forward,
            &hdr("forward_single_pass", &texts),
            &format!("{texts:?}"),
        );
    }
    let deferred = hdr("deferred_shading", &[full]);
    close(
        &deferred,
        &hdr("deferred_shading", &[full, "light_volumes=off"]),
        "light_volumes=off",
    );
}

fn close(a: &TargetImage, b: &TargetImage, what: &str) {
    for (index, (a, b)) in a.texels.iter().zip(&b.texels).enumerate() {
        for channel in 0..3 {
            let (a, b) = (a[channel], b[channel]);
            assert!(
                (a - b).abs() <= 1e-5 * a.abs().max(b.abs()) + 1e-7,
                "{what}, pixel {index}: {a} and {b}"
            );
        }
    }
}

/// Must-fail twins: the comparison sees a shifted pixel column and a missing light.
#[test]
fn the_comparison_notices_what_must_not_pass() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=64"]));
    let picture = studio.output("deferred_shading", &settings(&[]), SIZE);
    let mut shifted = picture.clone();
    shifted.rotate_right(4);
    assert!(flip_mean(&picture, &shifted) > 0.01);
    let mut darker = Studio::new("many_lights", &settings(&["lights=56"]));
    let darker = darker.output("deferred_shading", &settings(&[]), SIZE);
    assert!(flip_mean(&picture, &darker) > 0.01);
}

#[test]
fn no_pixel_is_invalid_and_the_energy_is_the_same() {
    for scene in ["atrium", "many_lights", "cornell_box"] {
        let mut studio = Studio::new(scene, &settings(&[]));
        let [forward, deferred] = PIPELINES.map(|name| {
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
