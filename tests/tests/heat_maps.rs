//! Heat maps of every pipeline, against counts that are made here.
#![allow(clippy::unwrap_used)]

use lightbench::render::heat_map::HeatMap;
use lightbench::render::{Renderer, TargetImage};
use lightbench::script::{Settings, list_pipelines, load_pipeline};
use lightbench_tests::pixels::{Pixels, depth_inside};
use lightbench_tests::{Studio, Workshop, settings};

const SIZE: (u32, u32) = (120, 72);

fn pipelines(studio: &Studio) -> Vec<String> {
    let listed = list_pipelines(&studio.files).unwrap();
    listed.into_iter().map(|entry| entry.name).collect()
}

/// What makes a pipeline exact: buffers of full size, room for the lights.
fn exact(name: &str) -> Vec<&'static str> {
    match name {
        "inferred_lighting" => vec!["scale=1", "filter=off"],
        _ => vec![],
    }
}

fn counts(studio: &mut Studio, pipeline: &str, map: &str, more: &[&str]) -> TargetImage {
    let map = format!("heat_map={map}");
    let mut texts = exact(pipeline);
    texts.push(&map);
    texts.extend(more);
    studio.hdr(pipeline, &settings(&texts), SIZE)
}

/// For each pixel the fewest and the most lights that reach what it shows, as rounding has it; the
/// sky shows nothing.
fn reaching(renderer: &Renderer, depth: &TargetImage) -> Vec<(u32, u32)> {
    let pixels = Pixels::of(renderer);
    let counts = depth.texels.iter().enumerate().map(|(index, texel)| {
        if texel[0] == 0.0 {
            return (0, 0);
        }
        let position = pixels.at(index, texel[0]);
        let (mut least, mut most) = (0, 0);
        for light in renderer.lights().iter() {
            let inside = depth_inside(light, position);
            least += u32::from(inside > 1e-4);
            most += u32::from(inside > -1e-4);
        }
        (least, most)
    });
    counts.collect()
}

#[test]
fn every_pipeline_evaluates_the_lights_that_reach_a_surface_and_says_which_do_not() {
    for (scene, texts) in [
        ("many_lights", &["lights=14", "range=6"][..]),
        ("hard_cases", &["case=wide_spot"]),
    ] {
        let mut studio = Studio::new(scene, &settings(texts));
        let (pipeline, _) = studio.draw_whole("deferred_shading", &Settings::new(), SIZE);
        let depth = studio.renderer.read_target(&pipeline, "depth").unwrap();
        let expected = reaching(&studio.renderer, &depth);
        let unsure = expected.iter().filter(|(least, most)| least != most);
        assert!(unsure.count() * 100 < expected.len());
        for name in pipelines(&studio) {
            let reach = counts(&mut studio, &name, "lights_reaching", &[]);
            let evaluated = counts(&mut studio, &name, "lights_evaluated", &[]);
            let in_vain = counts(&mut studio, &name, "lights_in_vain", &[]);
            let mut wasted = 0.0;
            for (index, (least, most)) in expected.iter().enumerate() {
                let [found, all, rest] = [&reach, &evaluated, &in_vain].map(|i| i.texels[index][0]);
                assert!(
                    (*least as f32..=*most as f32).contains(&found),
                    "{name} on {scene}, pixel {index}: {found} lights instead of {least} to {most}"
                );
                assert_eq!(found + rest, all, "{name} on {scene}, pixel {index}");
                wasted += rest;
            }
            println!("{name} on {scene}: {wasted} lights in vain");
        }
    }
}

#[test]
fn all_pixels_of_a_tile_evaluate_its_list() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=200"]));
    let (pipeline, _) = studio.draw_whole("deferred_shading", &Settings::new(), SIZE);
    let depth = studio.renderer.read_target(&pipeline, "depth").unwrap();
    for (name, more) in [
        ("tiled_forward", "capacity=256"),
        ("tiled_deferred", "shading=workgroups"),
        ("tiled_deferred", "shading=fragments"),
    ] {
        let texts = ["tile_size=16", more];
        let image = counts(&mut studio, name, "lights_evaluated", &texts);
        let mut lists = std::collections::BTreeMap::new();
        for (index, texel) in image.texels.iter().enumerate() {
            if depth.texels[index][0] == 0.0 {
                assert_eq!(texel[0], 0.0, "{name}: the sky evaluates no light");
                continue;
            }
            let (x, y) = (index as u32 % SIZE.0, index as u32 / SIZE.0);
            let first = *lists.entry((x / 16, y / 16)).or_insert(texel[0]);
            assert_eq!(first, texel[0], "{name}: {x},{y}");
        }
        let lengths: std::collections::BTreeSet<u32> =
            lists.values().map(|length| *length as u32).collect();
        assert!(lengths.len() > 3, "{name}: {lengths:?}");
    }
}

/// Three panes before a wall, each smaller than the one behind it, seen straight on.
const PANES: &str = "
camera().at(0, 0, 10).look_at(0, 0, 0);
spawn().mesh(plane(100, 100)).turn(90, 0, 0);
let glass = material(\"glass\").opacity(0.5).two_sided();
for i in 1..4 { spawn().mesh(plane(7 - 2 * i, 7 - 2 * i)).material(glass).turn(90, 0, 0).at(0, 0, i); }
for i in 0..5 { point_light().at(i, 0, 2).range(100); }
";

#[test]
fn overdraw_counts_each_fragment_that_is_kept() {
    let workshop = Workshop::new();
    workshop.write("scripts/scenes/panes.rhai", PANES);
    let mut studio = Studio::new("many_lights", &Settings::new());
    studio.show(workshop.files.clone(), "panes");
    // Two by two pixels, which stippling shares between layers.
    let block = |image: &TargetImage, x: u32, y: u32| -> f32 {
        let texels = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let texels = texels.map(|(dx, dy)| ((y + dy) * SIZE.0 + x + dx) as usize);
        texels.iter().map(|at| image.texels[*at][0]).sum()
    };
    for name in pipelines(&studio) {
        let image = counts(&mut studio, &name, "overdraw", &[]);
        let found = [block(&image, 0, 0), block(&image, SIZE.0 / 2, SIZE.1 / 2)];
        let expected = match name.as_str() {
            // The wall without light, and once more for each light; then three panes.
            "forward_multi_pass" => [4.0 * 6.0, 4.0 * 9.0],
            // Wall and panes at full size; before that the wall in small, where each layer of panes
            // takes a texel in four, and once more to be counted.
            "inferred_lighting" => [4.0 * 2.0, 4.0 * 5.0 + 3.0 + 3.0],
            // The wall twice, for what light needs to know and for its material.
            "deferred_lighting" => [4.0 * 2.0, 4.0 * 5.0],
            _ => [4.0, 4.0 * 4.0],
        };
        assert_eq!(found, expected, "{name}");
    }
}

#[test]
fn a_pipeline_that_names_no_linear_target_says_what_is_missing() {
    let workshop = Workshop::new();
    let desc = workshop.pipeline("p.target(\"result\", \"rgba16float\"); p.clear(\"c\").writes(\"result\").clear(0, 0, 0, 0);", &[]);
    assert_eq!(HeatMap::of(&desc), None);
    let asked = settings(&["heat_map=lights_evaluated"]);
    let problems = load_pipeline(&workshop.files, "test", &asked).unwrap_err();
    let text = problems.to_string();
    assert!(text.contains("name it with `.hdr(target)`"), "{text}");
    let wrong = settings(&["heat_map=overdrawn"]);
    let text = load_pipeline(&workshop.files, "test", &wrong)
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("`heat_map` takes one of `off`, `overdraw`"),
        "{text}"
    );
}
