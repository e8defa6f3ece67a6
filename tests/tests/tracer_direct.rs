//! The path tracer's direct light is the picture that pipelines draw.
#![allow(clippy::unwrap_used)]

use lightbench::assets::{Progress, Texture, TextureId};
use lightbench::lab::tracer::{Mode, Options, TracedScene, trace};
use lightbench::render::TargetImage;
use lightbench_tests::compare::{mean_difference, share_beyond};
use lightbench_tests::{Studio, hard_shapes, project, settings};

const SIZE: (u32, u32) = (320, 180);

/// What other rounding of positions and normals does to a pixel: that of the visibility buffer, which
/// interpolates for itself too (see `agreement.rs`).
const INTERPOLATION: f32 = 4e-4;
/// The share of pixels in which rounding decides which of two triangles is seen: the rasteriser moves
/// corners to a grid of 1/256 of a pixel. The scenes here stay below 7e-4.
const EDGES: f64 = 1e-3;
/// What the driver's way to choose among mip levels does to the light of a picture, in the mean. The
/// scenes here stay below 0.006; the software driver hurries over what lies between two levels.
const LEVELS: f64 = 0.007;

/// The picture of a pipeline, and the traced one.
fn both(studio: &mut Studio) -> [TargetImage; 2] {
    let full = settings(&["accumulation=rgba32float"]);
    let rasterised = studio.hdr("forward_single_pass", &full, SIZE);
    studio.scene.refresh();
    let scene = TracedScene::new(&studio.scene.world, &studio.scene.assets);
    let options = Options {
        size: SIZE,
        mode: Mode::Direct,
        ..Options::default()
    };
    let traced = trace(&scene, &studio.view, &options, &Progress::new()).unwrap();
    let traced = TargetImage {
        texels: traced.picture.pixels,
        ..rasterised.clone()
    };
    [rasterised, traced]
}

/// Pixel by pixel the same, but for edges.
fn equal(studio: &mut Studio, what: &str) {
    let [rasterised, traced] = both(studio);
    let differing = share_beyond(&rasterised, &traced, INTERPOLATION);
    let mean = mean_difference(&rasterised, &traced);
    println!("{what}: {differing:.2e} of the pixels differ, mean {mean:.2e}");
    assert!(differing <= EDGES, "{what}: {differing}");
}

/// Gives each texture the one colour that is its last level.
fn flatten(studio: &mut Studio) {
    let assets = &mut studio.scene.assets;
    let textures: Vec<_> = assets.textures().to_vec();
    for (index, entry) in textures.iter().enumerate() {
        let last = entry.mips.len() - 1;
        let color = entry.pixel(last, 0, 0).unwrap();
        let (name, format) = (entry.name.as_str(), entry.format);
        let flat = Texture::from_linear(name, 1, 1, format, &[color]).unwrap();
        assets
            .replace_texture(TextureId(index as u32), flat)
            .unwrap();
    }
}

#[test]
fn all_reflection_models_are_drawn_alike() {
    equal(
        &mut Studio::new("brdf_spheres", &settings(&[])),
        "brdf_spheres",
    );
}

#[test]
fn hard_cases_and_panes_are_drawn_alike() {
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    for case in [
        "no_objects",
        "panes",
        "wide_spot",
        "one_point",
        "far_plane",
        "camera_inside",
    ] {
        studio.load("hard_cases", &settings(&[&format!("case={case}")]));
        equal(&mut studio, case);
    }
}

/// All of the atrium but what is painted on it: 64 lights, mirrored and scaled objects, two-sided leaves.
#[test]
fn the_atrium_in_plain_colours_is_drawn_alike() {
    let mut studio = Studio::new("atrium", &settings(&[]));
    flatten(&mut studio);
    equal(&mut studio, "atrium in plain colours");
}

#[test]
fn the_atrium_is_drawn_alike_but_for_the_levels_of_its_textures() {
    let mut studio = Studio::new("atrium", &settings(&[]));
    let [rasterised, traced] = both(&mut studio);
    let mean = mean_difference(&rasterised, &traced);
    println!(
        "atrium: mean {mean:.2e}, beyond a tenth {:.2e}",
        share_beyond(&rasterised, &traced, 0.1)
    );
    assert!(mean < LEVELS, "{mean}");
    // Must-fail twin: without one of its lamps.
    let lamp = studio.scene.world.find("lamp 3").unwrap();
    studio.scene.world.remove::<lightbench::world::Light>(lamp);
    let [without, _] = both(&mut studio);
    let lost = mean_difference(&without, &traced);
    println!("without a lamp: {lost:.2e}");
    assert!(lost > 1.5 * LEVELS, "{lost}");
}

/// Near enough that the finest level is seen alone: colours, normal maps, holes, mirrors, backs.
#[test]
fn textures_seen_from_near_are_drawn_alike() {
    let script = "
        let cloth = material(\"cloth\").surface(weave_texture()).specular(0.1).power(60).two_sided();
        spawn(\"cloth\").mesh(plane(30, 30)).material(cloth).at(0, 0, 0).turn(90, 20, 0);
        spawn(\"behind\").mesh(plane(8, 8)).material(cloth).at(0.5, 0, 0.3).turn(80, 190, 10).scale(-1, 1, 1);
        point_light(\"lamp\").at(0.2, 0.5, 1.5).range(12).intensity(3);
        ambient_light(\"sky\").color(0.6, 0.7, 1).intensity(0.1);
        camera(\"eye\").at(0, 0, 0.9).look_at(0, 0.1, 0).fov(20).near(0.01).far(90);";
    let (_folder, files) = project(&[("scripts/scenes/near.rhai", script)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "near");
    let [rasterised, traced] = both(&mut studio);
    // The sampler keeps eight bits of the place between two texels.
    let differing = share_beyond(&rasterised, &traced, 0.02);
    let mean = mean_difference(&rasterised, &traced);
    println!("near: {differing:.2e} of the pixels differ, mean {mean:.2e}");
    assert!(differing <= EDGES && mean < 2e-3, "{differing} {mean}");
    // The same with holes, whose edges the levels of alpha move.
    let (_folder, files) = hard_shapes();
    studio.show(files, "shapes");
    let [rasterised, traced] = both(&mut studio);
    let mean = mean_difference(&rasterised, &traced);
    let differing = share_beyond(&rasterised, &traced, 0.1);
    println!("shapes: {differing:.2e} differ, mean {mean:.2e}");
    assert!(differing <= EDGES && mean < LEVELS, "{differing} {mean}");
}
