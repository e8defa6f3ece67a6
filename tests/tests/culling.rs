//! Lists of tiles: every light that reaches a pixel is on the list of its tile; and how many are there
//! in vain.
#![allow(clippy::unwrap_used)]

use lightbench::assets::files::Files;
use lightbench::render::TargetImage;
use lightbench::script::list_pipelines;
use lightbench_tests::compare::close;
use lightbench_tests::lists::{Found, before, of_fixed_room, run, shown};
use lightbench_tests::pixels::Pixels;
use lightbench_tests::{Counts, Mistake, Studio, project, project_with_mistake, settings};

/// Divided by no tile.
const SIZE: (u32, u32) = (203, 151);
/// Scenes with many lights, with spots of all widths, and with lights that planes of the view cut.
const SCENES: [(&str, &[&str]); 4] = [
    ("many_lights", &["lights=200", "range=2"]),
    ("atrium", &[]),
    ("hard_cases", &["case=wide_spot"]),
    ("hard_cases", &["case=far_plane"]),
];

/// Lists of lights, and what was counted when they were made.
struct Lists {
    lists: Vec<Vec<u32>>,
    counts: Counts,
}

// --- Tiles -----------------------------------------------------------------------------------------

fn tile_of(pixels: &Pixels, index: usize, tile: usize) -> usize {
    let [x, y] = pixels.column_and_row(index);
    y / tile * pixels.size[0].div_ceil(tile) + x / tile
}

fn tiles(tile: usize) -> usize {
    (SIZE.0 as usize).div_ceil(tile) * (SIZE.1 as usize).div_ceil(tile)
}

/// The lists of opaque surfaces and those of transparent ones.
fn tile_lists(
    studio: &mut Studio,
    tile: usize,
    more: &[&str],
    mistake: Option<Mistake<'_>>,
) -> (TargetImage, [Lists; 2]) {
    const ROOM: usize = 1024;
    let size = format!("tile_size={tile}");
    let texts = [more, &[&size, "capacity=1024"]].concat();
    let length = (tiles(tile) * (ROOM + 1)) as u32;
    let buffers = [("tile_lists", length), ("tile_lists_transparent", length)];
    let (depth, found, counts) = run(studio, "tiled_forward", &texts, SIZE, &buffers, mistake);
    let lists = [0, 1].map(|which: usize| Lists {
        lists: of_fixed_room(&found[which], ROOM, tiles(tile)),
        counts: counts.clone(),
    });
    (depth, lists)
}

/// What is found of tiles, opaque and transparent.
fn of_tiles(
    studio: &mut Studio,
    tile: usize,
    more: &[&str],
    mistake: Option<Mistake<'_>>,
) -> ([Lists; 2], [Found; 2]) {
    let (depth, lists) = tile_lists(studio, tile, more, mistake);
    let pixels = Pixels::of(&studio.renderer);
    let in_tile = |(index, point)| (tile_of(&pixels, index, tile), point);
    let lights = studio.renderer.lights();
    let [solid, clear] = &lists;
    let found = [
        Found::look(&solid.lists, lights, shown(&pixels, &depth).map(in_tile)),
        Found::look(&clear.lists, lights, before(&pixels, &depth).map(in_tile)),
    ];
    (lists, found)
}

#[test]
fn lists_of_tiles_hold_every_light_that_reaches_them() {
    for (scene, texts) in SCENES {
        let mut studio = Studio::new(scene, &settings(texts));
        for tile in [8, 16, 32] {
            let (plain, [solid, clear]) = of_tiles(&mut studio, tile, &[], None);
            let (masked, [masked_solid, _]) = of_tiles(&mut studio, tile, &["depth_mask=on"], None);
            solid.print(&format!("{scene} {texts:?}, tiles of {tile}"));
            masked_solid.print("    with depth masks");
            clear.print("    for what is transparent");
            assert_eq!([solid.missing, masked_solid.missing, clear.missing], [0; 3]);
            // A sphere is tested against a tile's planes, not against its pixels: measured 1 to 32 %.
            assert!(masked_solid.in_vain <= solid.in_vain);
            assert!(solid.in_vain * 5 < solid.listed * 2);
            let [solid, clear] = plain;
            let [masked, masked_clear] = masked;
            for tile in 0..solid.lists.len() {
                let within = |few: &[u32], many: &[u32]| {
                    few.iter().all(|light| many.binary_search(light).is_ok())
                };
                assert!(solid.lists[tile].is_sorted() && clear.lists[tile].is_sorted());
                assert!(within(&solid.lists[tile], &clear.lists[tile]));
                assert!(within(&masked.lists[tile], &solid.lists[tile]));
                // Depth masks say nothing of what is transparent.
                assert_eq!(masked_clear.lists[tile], clear.lists[tile]);
            }
            let listed: usize = solid.lists.iter().map(Vec::len).sum();
            assert_eq!(solid.counts.of("tile_lights") as usize, listed);
            let longest = clear.lists.iter().map(Vec::len).max().unwrap();
            assert_eq!(clear.counts.of("most_tile_lights") as usize, longest);
            // Tiled deferred shading makes the same lists, and keeps their lengths.
            studio.files = Files::shipped();
            let size = format!("tile_size={tile}");
            let (deferred, _) = studio.draw_whole("tiled_deferred", &settings(&[&size]), SIZE);
            let lengths = studio
                .renderer
                .read_target(&deferred, "tile_light_count")
                .unwrap();
            for (tile, length) in lengths.texels.iter().enumerate() {
                assert_eq!(length[0] as usize, solid.lists[tile].len(), "tile {tile}");
            }
        }
    }
}

/// The picture of a size that no tile divides is that of brute force.
#[test]
fn tiles_that_the_picture_cuts_are_shaded_as_without_tiles() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=100"]));
    let full = "accumulation=rgba32float";
    for (reference, tiled, clustered) in [
        ("forward_single_pass", "tiled_forward", "clustered_forward"),
        ("deferred_shading", "tiled_deferred", "clustered_deferred"),
    ] {
        let expected = studio.hdr(reference, &settings(&[full]), SIZE);
        for (pipeline, tiles) in [(tiled, ["8", "16", "32"]), (clustered, ["32", "64", "128"])] {
            for tile in tiles {
                let texts = settings(&[full, &format!("tile_size={tile}")]);
                let found = studio.hdr(pipeline, &texts, SIZE);
                close(&expected, &found, &format!("{pipeline}, tiles of {tile}"));
            }
        }
    }
}

/// Must-fail twins: lists that miss lights, and lists that hold too many.
#[test]
fn mistakes_of_tiles_are_caught() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=200", "range=2"]));
    let (_, [right, _]) = of_tiles(&mut studio, 16, &["depth_mask=on"], None);
    for (path, from, to) in [
        (
            "shaders/lib/culling.wgsl",
            "reach = -ball.radius",
            "reach = -0.8 * ball.radius",
        ),
        (
            "shaders/lib/culling.wgsl",
            "from_pixel.x, to_pixel.y",
            "from_pixel.x, from_pixel.y",
        ),
        (
            "shaders/lib/tile_lights.wgsl",
            "0xffffffffu >> (31u",
            "0x7fffffffu >> (31u",
        ),
        (
            "shaders/tiled/cull.wgsl",
            "first + thread * 32u",
            "first + thread * 31u",
        ),
        (
            "shaders/tiled/cull.wgsl",
            "word < thread; word++",
            "word + 1u < thread; word++",
        ),
    ] {
        let (_, [found, _]) = of_tiles(&mut studio, 16, &["depth_mask=on"], Some((path, from, to)));
        println!("`{to}`: {found:?}");
        assert!(found.missing > 0, "`{to}` went unnoticed");
    }
    // Without bounds on depth lists grow.
    let mistake = (
        "shaders/lib/tile_lights.wgsl",
        "sides_box(sides, range.nearest, range.farthest)",
        "sides_box(sides, 0.01, range.farthest)",
    );
    let (_, [found, _]) = of_tiles(&mut studio, 16, &[], Some(mistake));
    println!("right: {right:?}, without: {found:?}");
    assert!(found.in_vain * 5 > found.listed * 2);
}

/// A lamp before a pane, both far before a wall.
const LAMP_BEFORE_WALL: &str = "
// The root of its colour is a whole 255th, which a G-buffer keeps as it is.
let root = 180 / 255.0;
let grey = material(\"grey\").color(rgb(root * root, root * root, root * root)).specular(0);
spawn(\"wall\").mesh(plane(80, 80)).material(grey).turn(90, 0, 0).at(0, 0, -20);
let glass = material(\"glass\").color(rgb(0.6, 0.7, 0.8)).specular(0.2).power(40).opacity(0.5);
spawn(\"pane\").mesh(plane(3, 3)).material(glass).turn(90, 0, 0);
point_light(\"lamp\").at(0.4, 0.3, 1).range(3).intensity(5);
ambient_light(\"sky\").intensity(0.05);
camera(\"eye\").at(0, 0, 6).look_at(0, 0, 0).fov(50).near(0.1).far(60);
";

/// The brightest pixel of a picture.
fn brightest(image: &TargetImage) -> f32 {
    image
        .texels
        .iter()
        .map(|texel| texel[0])
        .fold(0.0, f32::max)
}

#[test]
fn a_pane_before_a_wall_is_lit_by_a_lamp_before_the_wall() {
    let scene = [("scripts/scenes/pane.rhai", LAMP_BEFORE_WALL)];
    let (_folder, files) = project(&scene);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files.clone(), "pane");
    let lamp = |lists: &Lists| lists.lists.iter().filter(|list| list.contains(&0)).count();
    let (_, [solid, clear]) = tile_lists(&mut studio, 16, &[], None);
    assert_eq!(lamp(&solid), 0, "the lamp reaches no opaque surface");
    assert!(lamp(&clear) > 20);
    studio.files = files;
    let full = "accumulation=rgba32float";
    let expected = studio.hdr("forward_single_pass", &settings(&[full]), SIZE);
    assert!(brightest(&expected) > 0.1);
    for entry in list_pipelines(&Files::shipped()).unwrap() {
        // Stippled layers lose some of their detail, which is tested elsewhere.
        let texts: &[&str] = match entry.name.as_str() {
            "inferred_lighting" => &[full, "transparency=forward", "scale=1"],
            _ => &[full],
        };
        let found = studio.hdr(&entry.name, &settings(texts), SIZE);
        close(&expected, &found, &entry.name);
    }
    // Must-fail twin: transparent surfaces beyond the nearest opaque one.
    let mistake = (
        "shaders/lib/tile_lights.wgsl",
        "meets_range(ball, 0.0, farthest)",
        "meets_range(ball, range.nearest, farthest)",
    );
    let (_folder, files) = project_with_mistake(&scene, mistake);
    studio.show(files, "pane");
    let dark = studio.hdr("tiled_forward", &settings(&[full]), SIZE);
    assert!(brightest(&dark) < 0.5 * brightest(&expected));
}
