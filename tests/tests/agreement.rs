//! All pipelines give the same picture of opaque objects.
#![allow(clippy::unwrap_used)]

use lightbench::assets::ReflectionModels;
use lightbench::assets::files::Files;
use lightbench::lab::{HdrImage, LdrImage, diff};
use lightbench::render::TargetImage;
use lightbench::script::list_pipelines;
use lightbench_tests::{Studio, gpu, settings};

const SIZE: (u32, u32) = (320, 180);

/// How a pipeline keeps surfaces between passes, which decides what it must agree with, and how
/// closely.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Surfaces {
    /// In registers: agrees with forward shading but for the order of additions.
    Exact,
    /// In registers, and light is added in passes that draw where depth is equal: where two
    /// surfaces touch, so that a pixel has both at the same depth, both are added.
    Added,
    /// In the G-buffer of shaders/lib/g_buffer.wgsl: agrees so with deferred shading, and with
    /// forward shading within the quantisation.
    GBuffer,
    /// Normal and power in textures, colours in registers: agrees within the quantisation.
    Thin,
}

/// Each pipeline, what its surfaces are, and the settings under which no list overflows in the
/// scenes of this file.
const PIPELINES: [(&str, Surfaces, &[&str]); 9] = [
    ("forward_single_pass", Surfaces::Exact, &[]),
    ("forward_multi_pass", Surfaces::Added, &[]),
    ("tiled_forward", Surfaces::Exact, &["capacity=1024"]),
    ("clustered_forward", Surfaces::Exact, &[]),
    ("world_indexed_forward", Surfaces::Exact, &["capacity=1024"]),
    ("deferred_shading", Surfaces::GBuffer, &[]),
    ("tiled_deferred", Surfaces::GBuffer, &[]),
    ("clustered_deferred", Surfaces::GBuffer, &[]),
    ("deferred_lighting", Surfaces::Thin, &[]),
];

/// The largest difference of two linear pictures, relative to the brighter of the two values and
/// to a thousandth of the brightest value of all: darker ones nobody sees.
fn relative_difference(a: &TargetImage, b: &TargetImage) -> f32 {
    let brightest = a.texels.iter().flat_map(|texel| &texel[..3]).copied();
    let floor = brightest.fold(0.0_f32, f32::max) * 1e-3;
    let pairs = a.texels.iter().zip(&b.texels);
    pairs
        .flat_map(|(a, b)| (0..3).map(|channel| (a[channel], b[channel])))
        .map(|(a, b)| (a - b).abs() / a.abs().max(b.abs()).max(floor).max(1e-9))
        .fold(0.0, f32::max)
}

/// The share of the pixels that differ by more than a bound, relative to the brighter value.
fn share_beyond(a: &TargetImage, b: &TargetImage, bound: f32) -> f64 {
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| {
        (0..3).any(|channel| {
            let (a, b) = (a[channel], b[channel]);
            (a - b).abs() > bound * a.abs().max(b.abs())
        })
    };
    let beyond = a.texels.iter().zip(&b.texels).filter(differs).count();
    beyond as f64 / a.texels.len() as f64
}

/// The same, but the mean over all values instead of the largest.
fn mean_difference(a: &TargetImage, b: &TargetImage) -> f64 {
    let values = |image: &TargetImage| -> Vec<f64> {
        let texels = image.texels.iter().flat_map(|texel| &texel[..3]);
        texels.map(|value| f64::from(*value)).collect()
    };
    let (a, b) = (values(a), values(b));
    let sum: f64 = a.iter().sum::<f64>().max(1e-9);
    let differences = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    differences.sum::<f64>() / sum
}

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

/// Additions in another order, in 32 bits: each sum rounds by 2⁻²⁴ of itself, on either side. The
/// evaluation of a light itself takes some more operations.
fn order_bound(lights: usize) -> f32 {
    (lights as f32 + 8.0) * (-23.0_f32).exp2()
}

/// The share of the pixels in which two surfaces touch: edges of the atrium's stones.
const TOUCHING: f64 = 3e-4;

/// What the G-buffer's rounding does to the light of a whole picture: base colour within 1/255 of
/// its root, twice that squared, power within 1.5 %, normals within 0.004°. The scenes here stay below
/// 0.0034, and one lost light of 64 is 0.0053.
const QUANTISATION: f64 = 0.0045;
/// The same as people see it: FLIP rates a picture of which every value is one step of eight bits
/// too bright at about this.
const FLIP: f64 = 0.012;

/// The setting of the format in which light is added up: blending of 32-bit floats is not everywhere.
fn accumulation(portable: bool) -> String {
    let float = if portable {
        "rgba16float"
    } else {
        "rgba32float"
    };
    format!("accumulation={float}")
}

/// All pipelines on one scene, with what `portable` leaves of the adapter.
fn agree(scene: &str, texts: &[&str], portable: bool) {
    let mut studio = Studio::on(gpu(portable), scene, &settings(texts));
    let mut pictures = Vec::new();
    for (name, surfaces, options) in PIPELINES {
        let accumulation = accumulation(portable);
        let mut options = options.to_vec();
        options.push(&accumulation);
        let options = settings(&options);
        let linear = studio.hdr(name, &options, SIZE);
        let output = studio.output(name, &options, SIZE);
        pictures.push((name, surfaces, linear, output));
    }
    let find = |wanted: &str| pictures.iter().find(|(name, ..)| *name == wanted).unwrap();
    let (_, _, carrying_all, carrying_all_output) = find("forward_single_pass");
    let (_, _, deferred, _) = find("deferred_shading");
    let bound = order_bound(studio.renderer.lights().len());
    println!("{scene} {texts:?} portable={portable}, bound {bound:.2e}");
    for (name, surfaces, linear, output) in &pictures {
        // A pipeline that lacks a reflection model is held to forward shading of what it draws
        // instead.
        let carried = studio.models(name, &settings(&[]));
        let replaced = if carried == ReflectionModels::all() {
            None
        } else {
            let options = settings(&[&accumulation(portable)]);
            let assets = studio.replace_models(carried);
            let linear = studio.hdr("forward_single_pass", &options, SIZE);
            let output = studio.output("forward_single_pass", &options, SIZE);
            studio.scene.assets = assets;
            Some((linear, output))
        };
        let (forward, forward_output) = match &replaced {
            Some((linear, output)) => (linear, output),
            None => (carrying_all, carrying_all_output),
        };
        let reference = match surfaces {
            Surfaces::GBuffer => deferred,
            Surfaces::Exact | Surfaces::Added | Surfaces::Thin => forward,
        };
        let order = relative_difference(reference, linear);
        let quantised = mean_difference(forward, linear);
        let flip = flip_mean(forward_output, output);
        println!(
            "  {name:24} {surfaces:?}: order {order:.2e}, quantised {quantised:.2e}, FLIP {flip:.5}"
        );
        let touching = share_beyond(reference, linear, bound);
        if *surfaces == Surfaces::Added && !portable {
            assert!(touching <= TOUCHING, "{scene} {texts:?} {name}: {touching}");
        } else if *surfaces != Surfaces::Thin && !portable {
            assert!(order <= bound, "{scene} {texts:?} {name}: {order}");
        }
        assert!(
            quantised <= QUANTISATION,
            "{scene} {texts:?} {name}: {quantised}"
        );
        assert!(flip <= FLIP, "{scene} {texts:?} {name}: FLIP {flip}");
    }
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

/// Each reflection model through each pipeline, as plastic and as metal.
#[test]
fn on_all_reflection_models() {
    agree("brdf_spheres", &["surface=plastic"], false);
    agree("brdf_spheres", &["surface=gold"], false);
}

#[test]
fn on_all_reflection_models_with_portable_features_only() {
    agree("brdf_spheres", &["surface=gold"], true);
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

#[test]
fn on_the_hard_cases() {
    for case in [
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
    ] {
        agree("hard_cases", &[&format!("case={case}")], false);
    }
}

#[test]
fn on_hard_cases_with_portable_features_only() {
    for case in ["camera_inside", "far_plane", "wide_spot", "panes"] {
        agree("hard_cases", &[&format!("case={case}")], true);
    }
}

/// Both stencil schemes where the camera or a plane of the view cuts a volume, and with more lights
/// than there are marks.
#[test]
fn stencil_schemes_light_the_same_pixels() {
    let cases = [
        ("hard_cases", "case=camera_inside"),
        ("hard_cases", "case=near_plane"),
        ("hard_cases", "case=far_plane"),
        ("hard_cases", "case=wide_spot"),
        ("many_lights", "lights=600"),
        ("brdf_spheres", "surface=gold"),
    ];
    for (scene, case) in cases {
        let mut studio = Studio::new(scene, &settings(&[case]));
        let mut hdr = |pipeline: &str, texts: &[&str]| studio.hdr(pipeline, &settings(texts), SIZE);
        let full = "accumulation=rgba32float";
        let deferred = hdr("deferred_shading", &[full]);
        for scheme in ["volume_stencil=two_pass", "volume_stencil=inverse"] {
            let other = hdr("deferred_shading", &[full, scheme, "threshold=0"]);
            let order = relative_difference(&deferred, &other);
            assert!(order <= order_bound(600), "{case} {scheme}: {order}");
        }
        let forward = hdr("forward_single_pass", &[full]);
        let masked = hdr("forward_multi_pass", &[full, "stencil_mask=on"]);
        let order = relative_difference(&forward, &masked);
        assert!(order <= order_bound(600), "{case} stencil_mask: {order}");
    }
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
            "if texel_depth == 0.0 {",
            "if texel_depth == 0.0 || light == 3u {",
        ),
        (
            "shaders/deferred_shading/light.wgsl",
            "let texel = vec2i(pixel.xy);",
            "let texel = vec2i(pixel.xy) + vec2i(1, 0);",
        ),
    ];
    let mut studio = Studio::new("many_lights", &settings(&["lights=64"]));
    let full = settings(&["accumulation=rgba32float"]);
    let forward = studio.hdr("forward_single_pass", &full, SIZE);
    let right = mean_difference(&forward, &studio.hdr("deferred_shading", &full, SIZE));
    assert!(right <= QUANTISATION);
    for (path, from, to) in mistakes {
        let text = Files::shipped().read_text(path).unwrap();
        assert!(text.contains(from), "{path} has no `{from}`");
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(path);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(&file, text.replace(from, to)).unwrap();
        studio.files = Files::with_project(folder.path()).unwrap();
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
    for texts in [
        &["lights_at_once=1", "scissor=off"][..],
        &["lights_at_once=1", "stencil_mask=on"],
        &["lights_at_once=2"],
        &["lights_at_once=4"],
        &["lights_at_once=8", "scissor=off"],
    ] {
        let multi = hdr("forward_multi_pass", &[texts, &[full]].concat());
        close(&forward, &multi, &format!("{texts:?}"));
    }
    for texts in [
        [full, "tile_size=8"],
        [full, "tile_size=32"],
        [full, "depth_mask=on"],
    ] {
        let text = format!("{texts:?}");
        let tiled = hdr("tiled_forward", &[&texts[..], &["capacity=1024"]].concat());
        close(&forward, &tiled, &text);
        close(
            &hdr("tiled_deferred", &[full]),
            &hdr("tiled_deferred", &texts),
            &text,
        );
    }
    for texts in [
        [full, "tile_size=32", "slices=64"],
        [full, "tile_size=128", "slices=16"],
    ] {
        let text = format!("{texts:?}");
        close(&forward, &hdr("clustered_forward", &texts), &text);
    }
    for texts in [
        [full, "layers=3d", "capacity=256", "cell_size=1"],
        [full, "layers=2d", "capacity=1024", "cell_size=8"],
    ] {
        let text = format!("{texts:?}");
        close(&forward, &hdr("world_indexed_forward", &texts), &text);
    }
    let deferred = hdr("deferred_shading", &[full]);
    for texts in [
        &["light_volumes=off"][..],
        &["volume_stencil=two_pass", "threshold=0"],
        &["volume_stencil=inverse", "threshold=0"],
        &["volume_stencil=inverse", "threshold=0.3"],
    ] {
        let other = hdr("deferred_shading", &[texts, &[full]].concat());
        close(&deferred, &other, &format!("{texts:?}"));
    }
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
