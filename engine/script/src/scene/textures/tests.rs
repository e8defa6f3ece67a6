#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_assets::cache::Cache;

use crate::testing::project;
use crate::{Limits, Scene, Settings, load_scene_within};

const SCENE: &str = "
let size = param(\"size\", 4, 1, 64, \"Pixels\").to_int();
let stripes = 2.0;
let paint = painted_texture(size, |u, v| if modulo(u * stripes, 1) < 0.5 { rgb(1, 0, 0) } else { rgb(0, v, 0) });
spawn(\"a\").mesh(plane(1, 1)).material(material(\"m\").surface(paint.heights(|u, v| u * 0.25)));";

fn load(text: &str, cache: &Cache) -> Result<Scene, String> {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
    let (settings, progress, limits) = (Settings::new(), Progress::new(), Limits::default());
    load_scene_within(&files, "test", &settings, &progress, cache, &limits)
        .map_err(|problems| problems.to_string())
}

#[test]
fn each_pixel_is_what_the_function_gave_for_its_middle() {
    let scene = load(SCENE, &Cache::default()).unwrap();
    let material = &scene.assets.materials().last().unwrap().value;
    let color = scene
        .assets
        .texture(material.base_color_texture.unwrap())
        .unwrap();
    assert_eq!(color.level_size(0), (4, 4));
    for (x, y) in [(0, 0), (1, 2), (2, 0), (3, 3)] {
        let pixel = color.pixel(0, x, y).unwrap();
        let middle = (y as f32 + 0.5) / 4.0;
        let expected = if x % 2 == 0 {
            [1.0, 0.0]
        } else {
            [0.0, middle]
        };
        // Eight bits of sRGB.
        assert!((pixel.x - expected[0]).abs() < 0.005, "{x} {y}: {pixel}");
        assert!((pixel.y - expected[1]).abs() < 0.005, "{x} {y}: {pixel}");
    }
    // It rises by a quarter of the side from left to right, so that its normals lean to the left.
    let normal = scene
        .assets
        .texture(material.normal_texture.unwrap())
        .unwrap();
    let slope = normal.pixel(0, 1, 1).unwrap().truncate() * 2.0 - 1.0;
    assert!((-slope.x / slope.z - 0.25).abs() < 0.02, "{slope}");
}

#[test]
fn the_same_picture_is_found_again() {
    let cache = Cache::default();
    let revisions = |text: &str| {
        let scene = load(text, &cache).unwrap();
        let material = scene.assets.materials().last().unwrap().value.clone();
        let ids = [material.base_color_texture, material.normal_texture];
        ids.map(|id| scene.assets.textures()[id.unwrap().0 as usize].revision)
    };
    let first = revisions(SCENE);
    assert_eq!(first, revisions(SCENE));
    let other = revisions(&SCENE.replace("0.25", "0.5"));
    assert_ne!(first[1], other[1]);
}

#[test]
fn mistakes_in_the_function_are_told_with_their_place() {
    for (paint, expected) in [
        (
            "|u, v| 0.5",
            "the function must give a colour, not the number 0.5",
        ),
        ("|u, v| rgb(u, w, 0)", "there is no variable `w`"),
        ("|u, v| {\n  throw \"no\" }", "test.rhai:2"),
        (
            "3",
            "`color` of `painted_texture` must be a function of u and v",
        ),
    ] {
        let error = load(&format!("painted_texture(2, {paint});"), &Cache::default());
        let error = error.err().unwrap();
        assert!(error.contains(expected), "{error}");
    }
    let endless =
        "painted_texture(2048, |u, v| { let x = 0; while x < 1000000 { x += 1; } rgb(1, 1, 1) });";
    let error = load(endless, &Cache::default()).err().unwrap();
    assert!(error.contains("a loop that never ends"), "{error}");
}
