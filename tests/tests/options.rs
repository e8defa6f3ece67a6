//! Options that only change what a picture costs change no pixel of it.
#![allow(clippy::unwrap_used)]

use lightbench::render::{Renderer, Variants};
use lightbench::script::load_pipeline;
use lightbench_tests::compare::{close, order_bound, relative_difference};
use lightbench_tests::{Studio, gpu, project_with_mistake, settings};

const SIZE: (u32, u32) = (320, 180);

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
        let deferred = hdr("tiled_deferred", &[full]);
        close(&deferred, &hdr("tiled_deferred", &texts), &text);
        let listed = [&texts[..], &["shading=fragments", "capacity=64"]].concat();
        close(&deferred, &hdr("tiled_deferred", &listed), &text);
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
    let fetched = hdr("visibility_buffer", &[full]);
    for texts in [
        [full, "numbers=compact"],
        [full, "tile_size=32"],
        [full, "slices=64"],
    ] {
        close(
            &fetched,
            &hdr("visibility_buffer", &texts),
            &format!("{texts:?}"),
        );
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

/// The shader that marks is no pass's own, and still somebody may edit it.
#[test]
fn a_marking_shader_without_a_fragment_stage_is_told() {
    let mistake = ("shaders/mark.wgsl", "@fragment\nfn fragment_main() {}", "");
    let (_folder, files) = project_with_mistake(&[], mistake);
    let compiler = || Renderer::new(gpu(false)).compiler();
    for (pipeline, text) in [
        ("deferred_shading", "volume_stencil=inverse"),
        ("forward_multi_pass", "stencil_mask=on"),
    ] {
        let desc = load_pipeline(&files, pipeline, &settings(&[text])).unwrap();
        let compiled = compiler().compile_for(&files, &desc, Variants::DEFAULT_MODEL);
        let problems = compiled.map(|_| ()).unwrap_err();
        let problem = &problems.0[0];
        assert_eq!(
            problem.place.to_string(),
            "shaders/mark.wgsl:1:1",
            "{problem}"
        );
        assert_eq!(problem.message, "the shader has no `fragment_main`");
    }
}
