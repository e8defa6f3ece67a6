//! Whole frames on the device, against closed forms and against each other.
#![allow(clippy::unwrap_used)]

mod support;

use glam::Vec3;
use lightbench_assets::procedural;
use lightbench_render::binding::EngineBuffer;
use lightbench_render::description::{DrawOrder, PassKind};
use lightbench_render::engine_buffers::EngineBuffers;
use lightbench_render::scene::MeshBuffers;
use lightbench_render::{TargetImage, View};
use lightbench_world::{Light, LightKind, Transform};
use support::{Bench, deferred, forward, gpu};

const UP: f32 = std::f32::consts::FRAC_PI_3;

fn texel(image: &TargetImage, x: u32, y: u32) -> [f32; 4] {
    image.texels[(y * image.width + x) as usize]
}

/// Looking straight down at the origin from 4 m.
fn above() -> View {
    View::look_at(Vec3::new(0.0, 4.0, 1e-3), Vec3::ZERO, UP, 0.1, 100.0)
}

#[test]
fn a_lamp_over_a_floor_gives_the_closed_form() {
    let mut bench = Bench::new();
    let floor = bench
        .assets
        .add_mesh(procedural::plane(glam::Vec2::splat(10.0), glam::UVec2::ONE));
    let white = bench.material(Vec3::splat(0.5), 0.0, 1.0);
    bench.object(floor, white, Transform::default());
    bench.point(Vec3::new(0.0, 2.0, 0.0), 8.0, 10.0);
    let image = bench.hdr(&forward("rgba32float", true), &above(), (65, 65));
    // E = I · (1 − (d/r)⁴)² / d², radiance = ρ/π · E, at normal incidence.
    let window = 1.0 - (2.0_f32 / 10.0).powi(4);
    let expected = 0.5 / std::f32::consts::PI * 8.0 / 4.0 * window * window;
    let found = texel(&image, 32, 32)[0];
    assert!(
        (found / expected - 1.0).abs() < 1e-3,
        "{found} instead of {expected}"
    );
    assert!(texel(&image, 0, 0)[0] > 0.0, "the floor fills the picture");
}

#[test]
fn ambient_light_is_the_albedo_and_emission_is_added() {
    let mut bench = Bench::new();
    let floor = bench
        .assets
        .add_mesh(procedural::plane(glam::Vec2::splat(10.0), glam::UVec2::ONE));
    let id = bench.material(Vec3::new(0.25, 0.5, 1.0), 0.0, 1.0);
    let mut material = bench.assets.material(id).unwrap().clone();
    material.emissive = Vec3::new(0.5, 0.0, 0.0);
    bench.assets.replace_material(id, material).unwrap();
    bench.object(floor, id, Transform::default());
    let light = Light {
        kind: LightKind::Ambient,
        intensity: 2.0,
        ..Light::default()
    };
    bench.light(Vec3::ZERO, Vec3::NEG_Z, light);
    for desc in [forward("rgba16float", true), deferred("rgba16float", true)] {
        let image = bench.hdr(&desc, &above(), (8, 8));
        let [r, g, b, _] = texel(&image, 4, 4);
        for (found, expected) in [(r, 1.0), (g, 1.0), (b, 2.0)] {
            assert!(
                (found - expected).abs() < 0.01,
                "{}: {found} instead of {expected}",
                desc.name
            );
        }
    }
}

/// The largest difference relative to the larger value, with an absolute floor.
fn worst(a: &TargetImage, b: &TargetImage, floor: f32) -> (f32, usize) {
    let mut worst = (0.0, 0);
    for (index, (a, b)) in a.texels.iter().zip(&b.texels).enumerate() {
        for channel in 0..3 {
            let (a, b) = (a[channel], b[channel]);
            assert!(a.is_finite() && b.is_finite());
            let error = (a - b).abs() / a.abs().max(b.abs()).max(floor);
            if error > worst.0 {
                worst = (error, index);
            }
        }
    }
    worst
}

/// Lights of every kind in every position that volumes find hard.
fn hard_lights(bench: &mut Bench) {
    let spot = |outer: f32, range: f32| Light {
        kind: LightKind::Spot,
        intensity: 6.0,
        range,
        inner_angle: outer.to_radians() * 0.5,
        outer_angle: outer.to_radians(),
        ..Light::default()
    };
    bench.point(Vec3::new(0.0, 2.0, 7.9), 5.0, 3.0); // around the camera
    bench.point(Vec3::new(0.0, 2.0, 6.9), 5.0, 1.0); // just ahead of it, across the near plane
    bench.point(Vec3::new(3.0, 1.0, -11.0), 5.0, 6.0); // across the far plane
    bench.point(Vec3::new(0.0, 1.0, 2.0), 50.0, 1000.0); // across both
    bench.point(Vec3::new(0.0, 1.0, 30.0), 5.0, 10.0); // behind the camera
    bench.point(Vec3::new(1.0, 0.51, 0.0), 0.01, 0.01); // tiny
    bench.light(
        Vec3::new(-3.0, 3.0, 0.0),
        Vec3::new(0.2, -1.0, 0.1),
        spot(40.0, 6.0),
    );
    bench.light(
        Vec3::new(3.0, 3.0, -2.0),
        Vec3::new(-0.5, -1.0, 0.3),
        spot(119.0, 6.0),
    );
    bench.light(Vec3::new(0.0, 3.0, -4.0), Vec3::NEG_Y, spot(179.0, 6.0));
    bench.light(
        Vec3::new(-2.0, 2.0, 8.0),
        Vec3::new(0.3, -0.2, -1.0),
        spot(60.0, 9.0),
    ); // from behind
    let sun = Light {
        kind: LightKind::Directional,
        intensity: 0.3,
        ..Light::default()
    };
    bench.light(Vec3::ZERO, Vec3::new(0.4, -1.0, -0.3), sun);
    let sky = Light {
        kind: LightKind::Ambient,
        intensity: 0.05,
        ..Light::default()
    };
    bench.light(Vec3::ZERO, Vec3::NEG_Z, sky);
}

fn across() -> View {
    View::look_at(
        Vec3::new(0.0, 2.0, 8.0),
        Vec3::new(0.0, 0.5, 0.0),
        UP,
        0.5,
        20.0,
    )
}

#[test]
fn light_volumes_lose_no_pixel_and_light_none_twice() {
    let mut bench = Bench::new();
    bench.field();
    hard_lights(&mut bench);
    let size = (319, 180);
    let screen = bench.hdr(&deferred("rgba32float", false), &across(), size);
    let volumes = bench.hdr(&deferred("rgba32float", true), &across(), size);
    let (error, at) = worst(&screen, &volumes, 1e-3);
    assert!(error < 1e-5, "{error} at pixel {at}");
}

#[test]
fn forward_with_and_without_gathering_agree() {
    let mut bench = Bench::new();
    bench.field();
    hard_lights(&mut bench);
    let size = (319, 180);
    let all = bench.hdr(&forward("rgba32float", false), &across(), size);
    let gathered = bench.hdr(&forward("rgba32float", true), &across(), size);
    let (error, at) = worst(&all, &gathered, 1e-3);
    assert!(error < 1e-5, "{error} at pixel {at}");
}

#[test]
fn deferred_agrees_with_forward_within_its_quantisation() {
    // Base colour 8 bits sRGB: half a step is at most 1.1 % of the reflectances used here.
    // Power: half a step is 1.45 %, which shifts a highlight by less than 3 %.
    for portable in [false, true] {
        let mut bench = Bench::on(gpu(portable));
        bench.field();
        hard_lights(&mut bench);
        let size = (319, 180);
        let forward = bench.hdr(&forward("rgba16float", true), &across(), size);
        let deferred = bench.hdr(&deferred("rgba16float", true), &across(), size);
        let (error, at) = worst(&forward, &deferred, 0.02);
        assert!(
            error < 0.03,
            "{error} at pixel {at}: {:?} and {:?}",
            forward.texels[at],
            deferred.texels[at]
        );
    }
}

#[test]
fn odd_sizes_and_an_empty_scene_draw() {
    let mut bench = Bench::new();
    for size in [(1, 1), (637, 359), (2, 3)] {
        let image = bench.hdr(&deferred("rgba16float", true), &across(), size);
        assert_eq!((image.width, image.height), size);
        assert!(image.texels.iter().all(|texel| texel[..3] == [0.0; 3]));
    }
}

#[test]
fn a_frame_is_the_same_bit_for_bit() {
    let picture = || {
        let mut bench = Bench::new();
        bench.field();
        hard_lights(&mut bench);
        bench
            .hdr(&deferred("rgba16float", true), &across(), (160, 90))
            .texels
    };
    assert_eq!(picture(), picture());
}

#[test]
fn mirrored_and_two_sided_objects_show_the_right_faces() {
    let mut bench = Bench::new();
    let ball = bench.assets.add_mesh(procedural::uv_sphere(1.0, 32, 16));
    let white = bench.material(Vec3::splat(0.5), 0.0, 1.0);
    bench.point(Vec3::new(0.0, 4.0, 0.0), 20.0, 20.0);
    bench.object(ball, white, Transform::default());
    let plain = bench.hdr(&forward("rgba32float", true), &above(), (33, 33));
    let entity = bench
        .world
        .columns::<lightbench_world::MeshRenderer>()
        .entities()[0];
    let mirrored = Transform {
        scale: Vec3::new(-1.0, 1.0, 1.0),
        ..Transform::default()
    };
    bench.world.set(entity, mirrored).unwrap();
    let flipped = bench.hdr(&forward("rgba32float", true), &above(), (33, 33));
    let center = |image: &TargetImage| texel(image, 16, 16)[0];
    assert!(center(&plain) > 0.1);
    assert!(
        (center(&plain) / center(&flipped) - 1.0).abs() < 1e-3,
        "{} {}",
        center(&plain),
        center(&flipped)
    );
}

#[test]
fn moving_one_object_uploads_one_row() {
    let mut bench = Bench::new();
    bench.field();
    bench.point(Vec3::new(0.0, 3.0, 0.0), 10.0, 10.0);
    let mut pipeline = bench
        .renderer
        .compiler()
        .compile(&bench.files, &forward("rgba16float", true))
        .unwrap();
    let mut frame = |bench: &mut Bench| {
        let view = across();
        bench
            .renderer
            .render(
                &mut bench.world,
                &bench.assets,
                &mut pipeline,
                &view,
                (32, 18),
                0.0,
            )
            .unwrap()
            .uploaded_bytes
    };
    frame(&mut bench);
    assert_eq!(frame(&mut bench), 0, "nothing moved");
    let entity = bench
        .world
        .columns::<lightbench_world::MeshRenderer>()
        .entities()[7];
    let mut transform = bench.world.get::<Transform>(entity).unwrap();
    transform.translation.y += 0.01;
    bench.world.set(entity, transform).unwrap();
    let row = size_of::<lightbench_render::gpu_data::InstanceData>() as u64;
    assert_eq!(frame(&mut bench), row);
}

/// The layer of each object, in the order of the objects.
fn layers(bench: &mut Bench, order: DrawOrder) -> Vec<u32> {
    let mut desc = forward("rgba16float", true);
    let PassKind::Geometry(geometry) = &mut desc.passes[0].kind else {
        panic!("the pass draws objects");
    };
    (geometry.layers, geometry.order) = (3, order);
    bench.draw(&desc, &across(), (64, 36));
    let drawn = bench.renderer.frame().drawn.iter();
    let mut layers: Vec<_> = drawn
        .map(|object| (object.instance, object.layer))
        .collect();
    layers.sort_unstable();
    layers.into_iter().map(|(_, layer)| layer).collect()
}

#[test]
fn objects_that_overlap_on_the_screen_are_in_different_layers() {
    let mut bench = Bench::new();
    let ball = bench.assets.add_mesh(procedural::uv_sphere(0.5, 8, 4));
    let grey = bench.material(Vec3::splat(0.5), 0.0, 1.0);
    // Seen from z = 8: a row of three along the view, then one aside of them, then a fourth in the row.
    for at in [
        Vec3::new(0.0, 0.5, 0.0),
        Vec3::new(0.0, 0.5, 2.0),
        Vec3::new(0.0, 0.5, 1.0),
        Vec3::new(4.0, 0.5, 0.0),
        Vec3::new(0.0, 0.5, -1.0),
    ] {
        bench.object(ball, grey, Transform::from_translation(at));
    }
    // The nearest chooses first; the fourth in the row must share a layer.
    let expected = [2, 0, 1, 0, 0];
    for order in [
        DrawOrder::State,
        DrawOrder::BackToFront,
        DrawOrder::FrontToBack,
    ] {
        assert_eq!(layers(&mut bench, order), expected, "{order:?}");
    }
}

#[test]
fn meshes_that_no_shader_can_bind_at_once_are_refused_in_words() {
    let gpu = gpu(false);
    let buffer = |size| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        })
    };
    let (small, large) = (buffer(4), buffer(3 << 20));
    let engine = EngineBuffers {
        meshes: MeshBuffers {
            positions: &small,
            attributes: &large,
            groups: &small,
            indices: &small,
        },
        shadow_views: &small,
        light_shadows: &small,
        revision: 1,
    };
    use EngineBuffer::{MeshAttributes, MeshIndices, MeshPositions};
    let refused = |wanted: &[EngineBuffer], most| engine.too_large(wanted.iter().copied(), most);
    assert_eq!(refused(&[MeshPositions, MeshAttributes], 3 << 20), None);
    assert_eq!(refused(&[MeshPositions, MeshIndices], 1 << 20), None);
    assert_eq!(refused(&[], 0), None);
    let message = refused(&[MeshPositions, MeshAttributes], 2 << 20).unwrap();
    assert!(
        message.starts_with("the scene has 3 MiB of normals, texture coordinates and tangents")
            && message.contains("binds 2 MiB"),
        "{message}"
    );
}
