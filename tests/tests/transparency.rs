//! Glass blends in the order of its distance, and holes are the same holes, in every pipeline.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench::assets::files::Files;
use lightbench::render::TargetImage;
use lightbench::script::list_pipelines;
use lightbench::world::WorldMatrix;
use lightbench_tests::panes::{composite, middle, panes};
use lightbench_tests::pixels::Pixels;
use lightbench_tests::{Mistake, Studio, hard_shapes, project, project_with_mistake, settings};

const SIZE: (u32, u32) = (320, 180);

/// Every shipped pipeline, so set that transparent objects are sorted and nothing is lost to small
/// buffers.
fn pipelines() -> Vec<(String, Vec<&'static str>)> {
    let exact = |name: &str| match name {
        "inferred_lighting" => vec!["scale=1", "transparency=forward"],
        _ => vec![],
    };
    let listed = list_pipelines(&Files::shipped()).unwrap();
    let named = listed.into_iter().map(|entry| entry.name);
    named.map(|name| (name.clone(), exact(&name))).collect()
}

// --- Glass -----------------------------------------------------------------------------------------

/// Of the middle of the picture, the largest distance from three panes over a wall.
fn off_the_composite(picture: &TargetImage) -> f64 {
    let expected = composite(3);
    let off = |texel: &[f32; 4]| {
        let channels = (0..3).map(|c| (f64::from(texel[c]) / expected[c] - 1.0).abs());
        channels.fold(0.0, f64::max)
    };
    middle(picture).map(off).fold(0.0, f64::max)
}

#[test]
fn three_panes_blend_over_one_another_as_by_hand_in_every_pipeline() {
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
        let scene = panes(&order);
        let (_folder, files) = project(&[("scripts/scenes/panes.rhai", &scene)]);
        studio.show(files, "panes");
        for (name, mut texts) in pipelines() {
            texts.push("accumulation=rgba32float");
            let picture = studio.hdr(&name, &settings(&texts), SIZE);
            let off = off_the_composite(&picture);
            println!("{order:?} {name}: {off:.1e}");
            assert!(off < 1e-5, "{order:?} {name}: {off}");
        }
    }
}

/// Must-fail twins.
#[test]
fn panes_in_the_wrong_order_and_light_that_shines_through_twice_are_caught() {
    let scene = panes(&[0, 1, 2]);
    let scene = [("scripts/scenes/panes.rhai", scene.as_str())];
    let mistakes: [Mistake<'_>; 3] = [
        (
            "scripts/pipelines/parts/transparent.rhai",
            "back_to_front",
            "front_to_back",
        ),
        (
            "scripts/pipelines/parts/transparent.rhai",
            "blend(\"over\")",
            "blend(\"add\")",
        ),
        (
            "shaders/forward/single_pass.wgsl",
            "(radiance, fragment.opacity)",
            "(radiance, 0.5)",
        ),
    ];
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    for mistake in mistakes {
        let (_folder, files) = project_with_mistake(&scene, mistake);
        studio.show(files, "panes");
        let picture = studio.hdr("forward_single_pass", &settings(&[]), SIZE);
        let off = off_the_composite(&picture);
        assert!(off > 0.05, "`{}` went unnoticed: {off}", mistake.2);
    }
}

// --- Holes -----------------------------------------------------------------------------------------

/// What depth says of a pipeline's opaque surfaces.
fn depth(studio: &mut Studio, name: &str, texts: &[&str]) -> Vec<u32> {
    let (pipeline, _) = studio.draw_whole(name, &settings(texts), SIZE);
    let depth = studio.renderer.read_target(&pipeline, "depth").unwrap();
    depth
        .texels
        .iter()
        .map(|texel| texel[0].to_bits())
        .collect()
}

#[test]
fn holes_are_the_same_pixels_in_every_pipeline() {
    let (_folder, files) = hard_shapes();
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "shapes");
    let expected = depth(&mut studio, "forward_single_pass", &[]);
    let mut ways = pipelines();
    ways.push(("forward_single_pass".to_owned(), vec!["depth_prepass=on"]));
    ways.push(("clustered_forward".to_owned(), vec!["depth_prepass=off"]));
    for (name, texts) in &ways {
        let found = depth(&mut studio, name, texts);
        let differing = expected.iter().zip(&found).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "{name} {texts:?}");
    }
    // Small buffers of full size have the same holes too.
    let texts = settings(&["scale=1", "transparency=forward"]);
    let (pipeline, _) = studio.draw_whole("inferred_lighting", &texts, SIZE);
    let small = studio
        .renderer
        .read_target(&pipeline, "small_depth")
        .unwrap();
    assert!(
        small
            .texels
            .iter()
            .zip(&expected)
            .all(|(a, b)| a[0].to_bits() == *b)
    );
}

/// Pixels of the leaf that are filled where it has a hole, or missing where it has none; and how many
/// pixels of holes were looked at.
fn off_the_leaf(studio: &mut Studio, name: &str, texts: &[&str]) -> (usize, usize) {
    let found = depth(studio, name, texts);
    let pixels = Pixels::of(&studio.renderer);
    let world = &studio.scene.world;
    let leaf = world
        .get::<WorldMatrix>(world.find("leaf").unwrap())
        .unwrap();
    let to_leaf = leaf.matrix.inverse();
    let local = |point: DVec3| to_leaf.transform_point3(point.as_vec3()).as_dvec3();
    let (mut wrong, mut holes) = (0, 0);
    for (index, bits) in found.iter().enumerate() {
        // Where the line of sight meets the plane of the leaf; its picture repeats every metre.
        let eye = local(pixels.eye);
        let sight = local(pixels.at(index, 0.5)) - eye;
        let at = eye - sight * (eye.y / sight.y);
        let texel = (at + 0.75) * 64.0;
        if !(0.0..96.0).contains(&texel.x) || !(0.0..96.0).contains(&texel.z) {
            continue;
        }
        let shown = local(pixels.at(index, f32::from_bits(*bits)));
        if (shown - eye).length() < 0.99 * (at - eye).length() {
            // Something stands before it.
            continue;
        }
        // Texels whose distance from the middle of their sixteenth is below the root of 30 are
        // holes; near that filters decide.
        let away = |texel: f64| texel.rem_euclid(16.0) - 8.5;
        let radius = away(texel.x).hypot(away(texel.z));
        let solid = shown.y.abs() < 1e-3;
        if radius < 3.0 {
            holes += 1;
            wrong += usize::from(solid);
        } else if radius > 8.5 {
            wrong += usize::from(!solid);
        }
    }
    (wrong, holes)
}

/// Once as it is, once with mistakes: depth that is drawn first without holes, and a test that goes by
/// another bound.
#[test]
fn holes_lie_where_the_picture_of_the_leaf_has_them() {
    let (_folder, files) = hard_shapes();
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files.clone(), "shapes");
    for (name, texts) in pipelines() {
        let (wrong, holes) = off_the_leaf(&mut studio, &name, &texts);
        println!("{name}: {holes} pixels of holes");
        assert_eq!(wrong, 0, "{name}");
        assert!(holes > 200, "{name}: {holes}");
    }
    let mistakes: [Mistake<'_>; 2] = [
        (
            "shaders/forward/depth_only.wgsl",
            "_ = surface::fragment_surface(in, front_facing);",
            "",
        ),
        (
            "shaders/lib/surface.wgsl",
            "color.a < material_of(point).alpha_cutoff",
            "color.a + 0.6 < material_of(point).alpha_cutoff",
        ),
    ];
    for mistake in mistakes {
        let (_folder, files) = project_with_mistake(&[], mistake);
        studio.files = files;
        let (wrong, _) = off_the_leaf(&mut studio, "forward_multi_pass", &[]);
        assert!(wrong > 200, "`{}` went unnoticed: {wrong}", mistake.2);
    }
}
