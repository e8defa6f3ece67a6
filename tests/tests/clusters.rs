//! Lists of clusters: every light that reaches a point of the view is on the list of its cluster,
//! whether a surface is there or not; and how many are there in vain.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench_tests::lists::{Asked, Found, before, run, shown};
use lightbench_tests::pixels::Pixels;
use lightbench_tests::{Mistake, Studio, settings};

/// Divided by no tile.
const SIZE: (u32, u32) = (203, 151);

/// The list that a point behind a pixel reads; none where rounding decides between two slices.
fn cluster_of(
    pixels: &Pixels,
    (index, point): (usize, DVec3),
    tile: usize,
    slices: usize,
) -> Option<Asked> {
    let [x, y] = pixels.column_and_row(index);
    let [near, far] = pixels.planes;
    let share = (pixels.distance(point).max(near) / near).ln() / (far.min(10_000.0) / near).ln();
    let slice = share * slices as f64;
    let sure = (slice - slice.round()).abs() > 1e-3 || slice < 0.5;
    let slice = (slice as usize).min(slices - 1);
    let column = y / tile * pixels.size[0].div_ceil(tile) + x / tile;
    sure.then_some((column * slices + slice, point))
}

/// What is found of the clusters that surfaces lie in, and of those at any point of the view.
fn of_clusters(
    studio: &mut Studio,
    tile: usize,
    slices: usize,
    mistake: Option<Mistake<'_>>,
) -> [Found; 2] {
    let clusters = (SIZE.0 as usize).div_ceil(tile) * (SIZE.1 as usize).div_ceil(tile) * slices;
    let buffers = [
        ("cluster_lists", 2 * clusters as u32),
        ("cluster_lights", 1 << 18),
    ];
    let texts = [&format!("tile_size={tile}"), &format!("slices={slices}")];
    let texts = texts.map(String::as_str);
    let (depth, found, counts) = run(studio, "clustered_forward", &texts, SIZE, &buffers, mistake);
    let [begins, lights] = &found[..] else {
        panic!("two buffers were asked for");
    };
    let lists = begins.chunks_exact(2).take(clusters);
    let lists = lists.map(|list| lights[list[0] as usize..][..list[1] as usize].to_vec());
    let lists: Vec<Vec<u32>> = lists.collect();
    if mistake.is_none() {
        assert!(lists.iter().all(|list| list.is_sorted()));
        let listed: usize = lists.iter().map(Vec::len).sum();
        assert_eq!(counts.of("cluster_room") as usize, listed);
        let longest = lists.iter().map(Vec::len).max().unwrap();
        assert_eq!(counts.of("most_cluster_lights") as usize, longest);
    }
    let pixels = Pixels::of(&studio.renderer);
    let lights = studio.renderer.lights();
    let in_cluster = |asked| cluster_of(&pixels, asked, tile, slices);
    [
        Found::look(
            &lists,
            lights,
            shown(&pixels, &depth).filter_map(in_cluster),
        ),
        Found::look(
            &lists,
            lights,
            before(&pixels, &depth).filter_map(in_cluster),
        ),
    ]
}

#[test]
fn lists_of_clusters_hold_every_light_that_reaches_them() {
    for (scene, texts) in [
        ("many_lights", &["lights=200", "range=2"][..]),
        ("atrium", &[]),
        ("hard_cases", &["case=wide_spot"]),
        ("hard_cases", &["case=near_plane"]),
        ("hard_cases", &["case=far_plane"]),
    ] {
        let mut studio = Studio::new(scene, &settings(texts));
        for (tile, slices) in [(64, 24), (32, 64), (128, 16)] {
            let [surfaces, anywhere] = of_clusters(&mut studio, tile, slices, None);
            let what = format!("{scene} {texts:?}, tiles of {tile}, {slices} slices");
            surfaces.print(&what);
            anywhere.print("    before surfaces");
            assert_eq!([surfaces.missing, anywhere.missing], [0; 2], "{what}");
            // Spheres are tested against boxes around the clusters: measured 1 to 31 %.
            assert!(surfaces.in_vain * 5 < surfaces.listed * 2);
        }
    }
}

/// Must-fail twins.
#[test]
fn mistakes_of_clusters_are_caught() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=200", "range=2"]));
    for (path, from, to) in [
        (
            "shaders/lib/clusters.wgsl",
            "slice_start(slice + 1u) * 1.001",
            "slice_start(slice) * 1.1",
        ),
        (
            "shaders/lib/clusters.wgsl",
            "max(high * nearest, high * farthest)",
            "high * nearest",
        ),
        (
            "shaders/lib/culling.wgsl",
            "length(outside) <= ball.radius",
            "length(outside) <= 0.9 * ball.radius",
        ),
        (
            "shaders/clustered/assign.wgsl",
            "word * 32u + firstTrailingBit",
            "word * 16u + firstTrailingBit",
        ),
        (
            "shaders/clustered/scan.wgsl",
            "begin += sums[other];",
            "begin += sums[other] / 2u;",
        ),
    ] {
        let [found, _] = of_clusters(&mut studio, 64, 24, Some((path, from, to)));
        println!("`{to}`: {found:?}");
        assert!(found.missing > 0, "`{to}` went unnoticed");
    }
}
