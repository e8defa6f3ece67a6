//! Pipelines are built for the meshes that a scene has, and warmed up without a trace.
#![allow(clippy::unwrap_used)]

mod support;

use std::time::{Duration, Instant};

use glam::Vec3;
use lightbench_assets::{Material, Reflection, procedural};
use lightbench_render::description::Ability;
use lightbench_render::variant::Variant;
use lightbench_render::{Pipeline, RenderError, Variants, View};
use lightbench_world::Transform;
use support::{Bench, deferred, forward};

const SIZE: (u32, u32) = (33, 17);

fn view() -> View {
    View::look_at(
        Vec3::new(0.0, 2.0, 6.0),
        Vec3::new(0.0, 0.5, 0.0),
        1.0,
        0.1,
        50.0,
    )
}

/// Steps until the pipeline is warm, and how many that took.
fn warm(bench: &mut Bench, pipeline: &mut Pipeline) -> usize {
    let began = Instant::now();
    for steps in 0.. {
        let (world, assets) = (&mut bench.world, &bench.assets);
        let done = bench
            .renderer
            .warm_up(world, assets, pipeline, &view(), SIZE, 0.0)
            .unwrap();
        if done {
            return steps;
        }
        bench.renderer.finish(60).unwrap();
        assert!(began.elapsed() < Duration::from_secs(60), "it never ends");
    }
    unreachable!()
}

fn render(bench: &mut Bench, pipeline: &mut Pipeline) -> Vec<[f32; 4]> {
    let (world, assets) = (&mut bench.world, &bench.assets);
    bench
        .renderer
        .render(world, assets, pipeline, &view(), SIZE, 0.0)
        .unwrap();
    bench.renderer.read_hdr(pipeline).unwrap().unwrap().texels
}

#[test]
fn warming_draws_once_with_each_pipeline_that_the_frame_needs_and_changes_nothing() {
    let mut bench = Bench::new();
    bench.field();
    bench.point(Vec3::new(0.0, 2.0, 1.0), 8.0, 4.0);
    let desc = deferred("rgba16float", true);
    let mut compiler = bench.renderer.compiler();
    let mut pipeline = compiler.compile(&bench.files, &desc).unwrap();
    // The G-buffer's one variant, the light's back faces, the output.
    assert_eq!(warm(&mut bench, &mut pipeline), 3);
    assert_eq!(
        warm(&mut bench, &mut pipeline),
        0,
        "once is enough: nothing is cold any more"
    );
    let zeros = bench.renderer.read_hdr(&pipeline).unwrap().unwrap();
    assert!(zeros.texels.iter().all(|texel| *texel == [0.0; 4]));
    let warmed = render(&mut bench, &mut pipeline);
    assert!(warmed.iter().any(|texel| texel[0] > 0.0));

    let mut other = Bench::new();
    other.field();
    other.point(Vec3::new(0.0, 2.0, 1.0), 8.0, 4.0);
    let mut pipeline = other.renderer.compiler();
    let mut pipeline = pipeline.compile(&other.files, &desc).unwrap();
    assert!(render(&mut other, &mut pipeline) == warmed);

    // What did not change is warm in the next compilation too.
    let mut again = compiler.compile(&bench.files, &desc).unwrap();
    assert_eq!(warm(&mut bench, &mut again), 0);
}

#[test]
fn a_pipeline_is_built_for_the_variants_that_are_asked_for() {
    let mut bench = Bench::new();
    bench.field();
    bench.point(Vec3::new(0.0, 2.0, 1.0), 8.0, 4.0);
    let desc = forward("rgba16float", false);
    let mut compiler = bench.renderer.compiler();
    let mut plain = Variants::default();
    plain.insert(Variant::default());
    let mut pipeline = compiler.compile_for(&bench.files, &desc, plain).unwrap();
    let without_cloth = render(&mut bench, &mut pipeline);

    let cloth = bench.assets.add_material(Material {
        two_sided: true,
        ..Material::default()
    });
    let sheet = bench
        .assets
        .add_mesh(procedural::plane(glam::Vec2::splat(2.0), glam::UVec2::ONE));
    let transform = Transform {
        translation: Vec3::new(0.0, 1.5, 0.0),
        rotation: glam::Quat::from_rotation_x(1.2),
        ..Transform::default()
    };
    bench.object(sheet, cloth, transform);
    let (world, assets) = (&mut bench.world, &bench.assets);
    let result = bench
        .renderer
        .render(world, assets, &mut pipeline, &view(), SIZE, 0.0);
    let Err(RenderError::NotBuilt(missing)) = result else {
        panic!("{result:?}");
    };
    assert_eq!(missing, {
        let mut set = Variants::default();
        set.insert(Variant::new(true, false, false, false));
        set
    });
    let more = plain.or(missing);
    let mut pipeline = compiler.compile_for(&bench.files, &desc, more).unwrap();
    let with_cloth = render(&mut bench, &mut pipeline);
    assert!(with_cloth != without_cloth);
    // The other meshes' pipeline was kept, and is warm.
    let mut all = compiler.compile(&bench.files, &desc).unwrap();
    assert_eq!(warm(&mut bench, &mut all), 0);
    assert!(render(&mut bench, &mut all) == with_cloth);
}

/// Passes that light a G-buffer have a second version for reflection models beside the default one,
/// which is built, warmed and drawn with only where such a surface is drawn.
#[test]
fn other_reflection_models_are_built_for_who_draws_them() {
    let mut bench = Bench::new();
    bench.field();
    bench.point(Vec3::new(0.0, 2.0, 1.0), 8.0, 4.0);
    let mut desc = deferred("rgba16float", true);
    desc.abilities.push(Ability {
        name: "brdf_ggx".to_owned(),
        at: desc.file.clone(),
        supported: true,
        text: String::new(),
    });
    let mut compiler = bench.renderer.compiler();
    let plain = Variants::DEFAULT_MODEL;
    let mut pipeline = compiler.compile_for(&bench.files, &desc, plain).unwrap();
    let before = render(&mut bench, &mut pipeline);

    let shiny = bench.assets.add_material(Material {
        specular: Vec3::ONE,
        reflection: Reflection::Ggx { roughness: 0.2 },
        ..Material::default()
    });
    // Nothing drawn has the material: nothing is missing, and nothing changes.
    assert!(render(&mut bench, &mut pipeline) == before);
    let ball = bench.assets.add_mesh(procedural::uv_sphere(0.4, 24, 12));
    let at = Transform::from_translation(Vec3::new(0.0, 2.0, 0.0));
    bench.object(ball, shiny, at);
    let (world, assets) = (&mut bench.world, &bench.assets);
    let result = bench
        .renderer
        .render(world, assets, &mut pipeline, &view(), SIZE, 0.0);
    let Err(RenderError::NotBuilt(missing)) = result else {
        panic!("{result:?}");
    };
    assert!(missing.has_other_models());

    let more = plain.or(missing);
    let mut pipeline = compiler.compile_for(&bench.files, &desc, more).unwrap();
    // The ball in the G-buffer, and the light on it; the rest was drawn with before.
    assert_eq!(warm(&mut bench, &mut pipeline), 2);
    let with_ball = render(&mut bench, &mut pipeline);
    assert_eq!(bench.renderer.take_warnings(), [] as [&str; 0]);

    // A pipeline that carries no other model needs no other version, and draws something else.
    desc.abilities.clear();
    let mut poor = compiler.compile_for(&bench.files, &desc, plain).unwrap();
    let replaced = render(&mut bench, &mut poor);
    assert!(replaced != with_ball && replaced != before);
    assert_eq!(bench.renderer.take_warnings().len(), 1);
}

#[test]
fn a_pipeline_knows_the_files_that_it_was_made_from() {
    let bench = Bench::new();
    let mut compiler = bench.renderer.compiler();
    let pipeline = compiler
        .compile(&bench.files, &forward("rgba16float", false))
        .unwrap();
    let files = pipeline.files();
    for path in [
        "shaders/forward/single_pass.wgsl",
        "shaders/vertex/geometry.wgsl",
        "shaders/output.wgsl",
        "shaders/lib/lighting.wgsl",
        // Through what the shader imports.
        "shaders/lib/scene.wgsl",
        "shaders/lib/color.wgsl",
    ] {
        assert!(files.contains(path), "no {path} in {files:?}");
    }
    assert!(!files.contains("shaders/lib/tile_lights.wgsl"));
    assert!(!files.contains("shaders/vertex/light_volume.wgsl"));
}
