//! Lights that are confined to meshes light exactly what lies inside.
#![allow(clippy::unwrap_used)]

use lightbench::render::{Gpu, Renderer, View};
use lightbench::script::load_pipeline;
use lightbench::world::glam::{Mat4, Vec3, Vec4};
use lightbench_tests::{Workshop, gpu, settings};

const SIZE: (u32, u32) = (160, 90);

/// What was lit: world position of each pixel, and its light.
struct Lit {
    pixels: Vec<(Vec3, f32)>,
    unconfined: u32,
}

/// Draws a ground with balls on it, lit by `lights` alone.
fn draw(gpu: Gpu, lights: &str, view: &View, scheme: &str) -> Lit {
    let scene = format!(
        "let paint = material(\"white\").color(1, 1, 1).specular(0);
        spawn(\"ground\").mesh(plane(40, 40)).material(paint);
        for x in -4..5 {{
            for z in -4..5 {{
                spawn(`ball ${{x}} ${{z}}`).mesh(sphere(0.35)).material(paint).at(x, 0.5, z);
            }}
        }}
        {lights}"
    );
    let workshop = Workshop::new();
    let mut scene = workshop.scene(&scene);
    let options = settings(&[scheme, "threshold=0"]);
    let desc = load_pipeline(&workshop.files, "deferred_shading", &options).unwrap();
    let mut renderer = Renderer::new(gpu);
    let mut pipeline = workshop.compile(&renderer, &desc);
    let (world, assets) = (&mut scene.world, &scene.assets);
    let statistics = renderer
        .render(world, assets, &mut pipeline, view, SIZE, 0.0)
        .unwrap();
    let unconfined = statistics.unconfined_lights;
    let hdr = renderer.read_hdr(&pipeline).unwrap().unwrap();
    // With stencil the G-buffer has a copy of depth.
    let depth = renderer.read_target(&pipeline, "g_depth").unwrap();
    let to_world = (view.projection(SIZE.0 as f32 / SIZE.1 as f32) * view.view).inverse();
    let pixels = depth.texels.iter().zip(&hdr.texels).enumerate();
    let pixels = pixels.filter(|(_, (depth, _))| depth[0] > 0.0);
    let pixels = pixels.map(|(index, (depth, light))| {
        let (x, y) = (index as u32 % SIZE.0, index as u32 / SIZE.0);
        (position(to_world, x, y, depth[0]), light[0])
    });
    Lit {
        pixels: pixels.collect(),
        unconfined,
    }
}

fn position(to_world: Mat4, x: u32, y: u32, depth: f32) -> Vec3 {
    let ndc = |at: u32, of: u32| (at as f32 + 0.5) / of as f32 * 2.0 - 1.0;
    let clip = Vec4::new(ndc(x, SIZE.0), -ndc(y, SIZE.1), depth, 1.0);
    let world = to_world * clip;
    world.truncate() / world.w
}

/// Every pixel has the light of those volumes that it lies in. `inside` gives the distance from a
/// volume's surface, positive inside.
fn check(lit: &Lit, strengths: &[f32], inside: impl Fn(usize, Vec3) -> f32, what: &str) {
    let (mut compared, mut bright) = (0, 0);
    for (at, light) in &lit.pixels {
        let distances: Vec<f32> = (0..strengths.len()).map(|v| inside(v, *at)).collect();
        // Depth has its resolution.
        if distances.iter().any(|distance| distance.abs() < 0.02) {
            continue;
        }
        let volumes = strengths.iter().zip(&distances);
        let expected: f32 = volumes.filter(|(_, d)| **d > 0.0).map(|(s, _)| s).sum();
        // Sixteen bits a sum, eight a root of base colour.
        assert!(
            (light - expected).abs() <= 0.01 * expected + 1e-4,
            "{what}: {light} instead of {expected} at {at}"
        );
        compared += 1;
        bright += usize::from(expected > 0.0);
    }
    assert!(compared > 1000, "{what}: {compared}");
    assert!(bright > 50, "{what}: only {bright} pixels are lit");
}

/// The distance from the sides of a box.
fn in_box(at: Vec3, center: Vec3, size: Vec3) -> f32 {
    (size * 0.5 - (at - center).abs()).min_element()
}

fn look(eye: Vec3, target: Vec3, far: f32) -> View {
    View::look_at(eye, target, 1.2, 0.1, far)
}

/// From outside, from inside, with the near plane in it, with the far plane in it.
fn views() -> [(&'static str, View); 4] {
    let up = Vec3::new(0.0, 0.5, 0.0);
    [
        ("outside", look(Vec3::new(0.0, 3.0, 7.0), up, 50.0)),
        (
            "inside",
            look(Vec3::new(0.3, 0.8, 0.4), Vec3::new(0.0, 0.2, -2.0), 50.0),
        ),
        (
            "near plane",
            look(Vec3::new(0.3, 0.8, 2.05), Vec3::new(0.0, 0.2, -2.0), 50.0),
        ),
        ("far plane", look(Vec3::new(0.0, 3.0, 7.0), up, 7.5)),
    ]
}

const BOX: &str = "ambient_light(\"a\").intensity(0.5).clip_volume(box(4, 3, 4));";
const SCHEMES: [&str; 2] = ["volume_stencil=two_pass", "volume_stencil=inverse"];

#[test]
fn a_box_confines_light_wherever_the_camera_is() {
    for scheme in SCHEMES {
        for (what, view) in views() {
            let lit = draw(gpu(false), BOX, &view, scheme);
            assert_eq!(lit.unconfined, 0);
            let inside = |_, at| in_box(at, Vec3::ZERO, Vec3::new(4.0, 3.0, 4.0));
            check(&lit, &[0.5], inside, what);
        }
    }
}

#[test]
fn a_ring_confines_light_although_it_has_a_hole() {
    // Seen flat, rays cross the ring twice.
    let lights =
        "ambient_light(\"a\").intensity(0.5).clip_volume(torus(2.2, 0.8).segments(128, 64));";
    let ring = |_, at: Vec3| {
        let around = (at.x * at.x + at.z * at.z).sqrt() - 2.2;
        // Faces of the mesh lie a little inside the round ring.
        0.795 - (around * around + at.y * at.y).sqrt()
    };
    for (what, view) in views() {
        let lit = draw(gpu(false), lights, &view, SCHEMES[0]);
        check(&lit, &[0.5], ring, what);
    }
    let flat = look(Vec3::new(0.0, 0.6, 6.0), Vec3::new(0.0, 0.4, 0.0), 50.0);
    check(
        &draw(gpu(false), lights, &flat, SCHEMES[1]),
        &[0.5],
        ring,
        "flat",
    );
}

#[test]
fn volumes_overlap_and_mix_with_lights_that_mark_stencil() {
    // Between them a lamp of the pass's own scheme, too weak to see, leaves its marks.
    let lights = "ambient_light(\"a\").intensity(0.5).at(-1, 0, 0).clip_volume(box(4, 3, 4));
        point_light(\"lamp\").at(0, 1, 0).intensity(0.00000001).range(5);
        ambient_light(\"b\").intensity(0.25).clip_volume(box(4, 3, 2), vec3(1, 0, 0.5));
        directional_light(\"dark\").intensity(0).clip_volume(box(1, 1, 1));";
    for scheme in SCHEMES {
        for (what, view) in views() {
            let lit = draw(gpu(false), lights, &view, scheme);
            let inside = |volume, at| match volume {
                0 => in_box(at, Vec3::new(-1.0, 0.0, 0.0), Vec3::new(4.0, 3.0, 4.0)),
                _ => in_box(at, Vec3::new(1.0, 0.0, 0.5), Vec3::new(4.0, 3.0, 2.0)),
            };
            check(&lit, &[0.5, 0.25], inside, what);
        }
    }
}

#[test]
fn what_cannot_be_confined_shines_beyond_and_is_counted() {
    let [.., (_, far)] = views();
    // Without clamping of depth the far plane would cut faces off.
    let lit = draw(gpu(true), BOX, &far, SCHEMES[0]);
    assert_eq!(lit.unconfined, 1);
    assert!(lit.pixels.iter().all(|(_, light)| *light > 0.4));
    let [(_, outside), ..] = views();
    assert_eq!(draw(gpu(true), BOX, &outside, SCHEMES[0]).unconfined, 0);
}
