//! Two series of pictures through one pipeline: each looks as if it were alone.
#![allow(clippy::unwrap_used)]

use lightbench::render::readback::read_bytes;
use lightbench::render::{Pipeline, View};
use lightbench::script::{Settings, list_pipelines};
use lightbench::world::glam::Vec3;
use lightbench_tests::{Studio, settings};

/// In which order the series draw: neither evenly nor in turn.
const ORDER: [usize; 7] = [0, 1, 1, 0, 0, 1, 0];

const SIZES: [(u32, u32); 2] = [(61, 37), (40, 48)];

/// The view of a picture: both cameras move from picture to picture.
fn view(series: usize, picture: usize) -> View {
    let along = 0.15 * picture as f32;
    let eye = match series {
        0 => Vec3::new(along, 2.0, 7.0),
        _ => Vec3::new(4.0, 5.0 - along, -3.0),
    };
    View::look_at(eye, Vec3::new(0.0, 0.5, 0.0), 1.0, 0.1, 60.0)
}

/// The output of a series.
fn output(studio: &Studio, pipeline: &Pipeline, series: usize) -> Vec<u8> {
    let name = &pipeline.desc.output.as_ref().unwrap().name;
    let target = pipeline.targets_of(series).unwrap().get(name).unwrap();
    assert_eq!(target.mip_size(0), SIZES[series]);
    read_bytes(studio.renderer.gpu(), &target.texture).unwrap()
}

/// Draws the pictures of some series, as they come in the order, and gives the last of each.
fn draw(studio: &mut Studio, name: &str, wanted: &[usize], as_first: bool) -> Vec<Vec<u8>> {
    studio.renderer.reset_scene();
    studio.renderer.set_frame_index(0);
    let mut pipeline = studio.compile(name, &Settings::new());
    let mut pictures = [0; 2];
    for series in ORDER.into_iter().filter(|series| wanted.contains(series)) {
        let view = view(series, pictures[series]);
        pictures[series] += 1;
        let target = if as_first { 0 } else { series };
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        // Until all lists of lights have room.
        loop {
            studio
                .renderer
                .render_in(
                    target,
                    world,
                    assets,
                    &mut pipeline,
                    &view,
                    SIZES[series],
                    0.0,
                )
                .unwrap();
            let measured = studio.renderer.finish(60).unwrap();
            if !pipeline.grow_in(target, &measured) {
                break;
            }
        }
    }
    wanted
        .iter()
        .map(|series| match as_first {
            true => {
                let (size, _, bytes) = studio.renderer.read_output(&pipeline).unwrap();
                assert_eq!(size, SIZES[*series].0);
                bytes
            }
            false => output(studio, &pipeline, *series),
        })
        .collect()
}

#[test]
fn each_series_has_targets_history_and_views_of_its_own() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=60", "spheres=40"]));
    let shipped = list_pipelines(&studio.files).unwrap();
    let names = shipped.iter().map(|entry| entry.name.as_str());
    for name in names.chain([
        "scripts/pipelines/examples/history.rhai",
        "scripts/pipelines/examples/mips.rhai",
    ]) {
        let together = draw(&mut studio, name, &[0, 1], false);
        let first = draw(&mut studio, name, &[0], true);
        let second = draw(&mut studio, name, &[1], true);
        assert!(together[0] == first[0], "{name}: the first series");
        assert!(together[1] == second[0], "{name}: the second series");
    }
}

/// What the test above looks for is there: history that goes through both shows the other picture.
#[test]
fn history_that_is_mixed_would_be_seen() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=60", "spheres=40"]));
    let size = SIZES[0];
    let mut last = |views: &[View]| {
        studio.renderer.reset_scene();
        studio.renderer.set_frame_index(0);
        let mut pipeline =
            studio.compile("scripts/pipelines/examples/history.rhai", &Settings::new());
        for view in views {
            let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
            studio
                .renderer
                .render(world, assets, &mut pipeline, view, size, 0.0)
                .unwrap();
        }
        studio.renderer.read_output(&pipeline).unwrap().2
    };
    let alone = last(&[view(0, 0), view(0, 1)]);
    let mixed = last(&[view(0, 0), view(1, 0), view(0, 1)]);
    assert!(alone != mixed);
}

#[test]
fn a_series_gives_its_memory_back_alone() {
    let mut studio = Studio::new("cornell_box", &Settings::new());
    let mut pipeline = studio.compile("deferred_shading", &Settings::new());
    let view = studio.view;
    for series in [0, 1] {
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        studio
            .renderer
            .render_in(
                series,
                world,
                assets,
                &mut pipeline,
                &view,
                SIZES[series],
                0.0,
            )
            .unwrap();
    }
    let before = output(&studio, &pipeline, 0);
    pipeline.release_series(1);
    assert!(pipeline.targets_of(1).is_none());
    assert_eq!(output(&studio, &pipeline, 0), before);
    pipeline.release_targets();
    assert!(pipeline.targets_of(0).is_none());
}
