//! The path tracer's direct light is the picture that pipelines draw.
#![allow(clippy::unwrap_used)]

use glam::Vec4;
use lightbench::assets::{Progress, Texture, TextureFormat, TextureId};
use lightbench::lab::tracer::{Mode, Options, TracedScene, trace};
use lightbench::render::TargetImage;
use lightbench_tests::compare::{mean_difference, share_beyond};
use lightbench_tests::{Studio, hard_shapes, project, settings};

const SIZE: (u32, u32) = (320, 180);
const FORWARD: &str = "forward_single_pass";

/// What other rounding of positions and normals does to a pixel: that of the visibility buffer, which
/// interpolates for itself too (see `agreement.rs`).
const INTERPOLATION: f32 = 4e-4;
/// The share of pixels in which rounding decides which of two triangles is seen: the rasteriser moves
/// corners to a grid of 1/256 of a pixel. The scenes here stay below 9e-4.
const EDGES: f64 = 1e-3;
/// What other rounding of texture coordinates does to a pixel near which the finest level alone is seen.
const FINEST: f32 = 5e-3;
/// What the software driver's logarithm, by which it chooses levels, does to the light of a picture, in the
/// mean: it draws a straight line from one power of two to the next. The scenes here stay below 0.0015; with
/// that logarithm here too, the visibility buffer's `shapes` differs by 0.00004.
const LEVELS: f64 = 0.002;
/// What the software driver's arithmetic on eight-bit textures does to the light of a picture, in the
/// mean. The scenes here stay below 0.0055.
const EIGHT_BITS: f64 = 0.006;

/// The picture of a pipeline, and the traced one.
fn both(studio: &mut Studio, pipeline: &str) -> [TargetImage; 2] {
    let full = settings(&["accumulation=rgba32float"]);
    let rasterised = studio.hdr(pipeline, &full, SIZE);
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
    let [rasterised, traced] = both(studio, FORWARD);
    let differing = share_beyond(&rasterised, &traced, INTERPOLATION);
    let mean = mean_difference(&rasterised, &traced);
    println!("{what}: {differing:.2e} of the pixels differ, mean {mean:.2e}");
    assert!(differing <= EDGES, "{what}: {differing}");
}

/// The same where there are textures, kept in floats: no more than a share of the pixels differs by more
/// than a bound, and the light by no more than another one in the mean.
fn alike(studio: &mut Studio, what: &str, (bound, share): (f32, f64), most: f64) {
    keep_in_floats(studio);
    for pipeline in [FORWARD, "visibility_buffer"] {
        let [rasterised, traced] = both(studio, pipeline);
        let differing = share_beyond(&rasterised, &traced, bound);
        let mean = mean_difference(&rasterised, &traced);
        println!("{what}, {pipeline}: beyond {bound}: {differing:.2e}, mean {mean:.2e}");
        assert!(differing <= share, "{what}, {pipeline}: {differing}");
        assert!(mean <= most, "{what}, {pipeline}: {mean}");
    }
}

/// Keeps each texture in 16-bit floats. The software driver filters eight-bit textures in eight bits, and
/// decodes sRGB by a polynomial, which is the most that its pictures and these differ by.
fn keep_in_floats(studio: &mut Studio) {
    change_textures(studio, |texture| {
        let (width, height) = (texture.width, texture.height);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let pixels = places.map(|(x, y)| texture.pixel(0, x, y).unwrap());
        (width, height, pixels.collect())
    });
}

/// Gives each texture another size and other pixels, in 16-bit floats.
fn change_textures(studio: &mut Studio, change: impl Fn(&Texture) -> (u32, u32, Vec<Vec4>)) {
    let assets = &mut studio.scene.assets;
    let textures = assets.textures().to_vec();
    for (index, texture) in textures.iter().enumerate() {
        let (width, height, pixels) = change(texture);
        let (name, format) = (texture.name.as_str(), TextureFormat::Rgba16Float);
        let kept = Texture::from_linear(name, width, height, format, &pixels).unwrap();
        assets
            .replace_texture(TextureId(index as u32), kept)
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

/// 64 lights, mirrored and scaled objects, two sides; each texture has one colour.
#[test]
fn the_atrium_in_plain_colours_is_drawn_alike() {
    let mut studio = Studio::new("atrium", &settings(&[]));
    change_textures(&mut studio, |texture| {
        let last = texture.mips.len() - 1;
        (1, 1, vec![texture.pixel(last, 0, 0).unwrap()])
    });
    equal(&mut studio, "atrium in plain colours");
}

/// And with its textures, normal maps, leaves with holes, and all levels.
#[test]
fn the_atrium_is_drawn_alike() {
    let mut studio = Studio::new("atrium", &settings(&[]));
    alike(&mut studio, "atrium", (0.1, 2.0 * EDGES), LEVELS);
}

#[test]
fn the_atrium_is_drawn_alike_but_for_what_the_driver_rounds() {
    let mut studio = Studio::new("atrium", &settings(&[]));
    let [rasterised, traced] = both(&mut studio, FORWARD);
    let mean = mean_difference(&rasterised, &traced);
    println!(
        "atrium: mean {mean:.2e}, beyond a tenth {:.2e}",
        share_beyond(&rasterised, &traced, 0.1)
    );
    assert!(mean < EIGHT_BITS, "{mean}");
    // Must-fail twin: without one of its lamps.
    let lamp = studio.scene.world.find("lamp 3").unwrap();
    studio.scene.world.remove::<lightbench::world::Light>(lamp);
    let [without, _] = both(&mut studio, FORWARD);
    let lost = mean_difference(&without, &traced);
    println!("without a lamp: {lost:.2e}");
    assert!(lost > 1.5 * EIGHT_BITS, "{lost}");
}

/// Near enough that the finest level is seen alone, and far enough that all are: colours, normal maps,
/// holes, mirrors, backs.
#[test]
fn textures_are_drawn_alike() {
    let script = "
        let cloth = material(\"cloth\").surface(weave_texture()).specular(0.1).power(60).two_sided();
        spawn(\"cloth\").mesh(plane(30, 30)).material(cloth).at(0, 0, 0).turn(90, 20, 0);
        spawn(\"behind\").mesh(plane(8, 8)).material(cloth).at(0.5, 0, 0.3).turn(80, 190, 10)
            .scale(-1, 1, 1);
        point_light(\"lamp\").at(0.2, 0.5, 1.5).range(12).intensity(3);
        ambient_light(\"sky\").color(0.6, 0.7, 1).intensity(0.1);
        camera(\"eye\").at(0, 0, 0.9).look_at(0, 0.1, 0).fov(20).near(0.01).far(90);";
    let (_folder, files) = project(&[("scripts/scenes/near.rhai", script)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "near");
    alike(&mut studio, "near", (FINEST, EDGES), 3e-4);
    let (_folder, files) = hard_shapes();
    studio.show(files, "shapes");
    alike(&mut studio, "shapes", (0.1, EDGES), LEVELS);
}
