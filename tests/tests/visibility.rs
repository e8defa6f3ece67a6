//! The visibility buffer: the triangle that a pixel names is the one that it shows, and the point
//! that is found on it is the one that the rasteriser would have interpolated.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench::lab::reference::triangle::Triangle;
use lightbench::script::{Settings, load_pipeline};
use lightbench_tests::compare::mean_difference;
use lightbench_tests::pixels::Pixels;
use lightbench_tests::{Studio, gpu, hard_shapes, project, project_with_mistake, settings};

const SIZE: (u32, u32) = (320, 180);
const FULL: &str = "accumulation=rgba32float";

/// Depth by vertex buffers; then a pass that fetches the same vertices and passes where its depth
/// is equal.
const PULLING: &str = "
let p = pipeline(\"Pulling\");
p.target(\"depth\", \"depth32float\");
p.target(\"pulled\", \"r32float\");
p.target(\"output\", \"rgba8unorm\");
p.geometry(\"prepass\").depth(\"depth\").clear(0.0);
p.geometry(\"pull\").shader(\"shaders/pulled.wgsl\").pull_vertices(true)
    .writes(\"pulled\").clear(0, 0, 0, 0)
    .depth(\"depth\").test(\"equal\").read_only();
p.fullscreen(\"show\").shader(\"shaders/show.wgsl\").reads(\"pulled\").writes(\"output\");
p.show(\"output\");
p";
const PULLED: &str = "#import lightbench::scene
#import lightbench::mesh
@vertex fn vertex_main(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) drawn: u32,
) -> @builtin(position) @invariant vec4f {
    let instance = scene::instances[scene::drawn_objects[drawn].instance];
    let position = mesh::position_of(mesh::vertex_at(instance, corner));
    return scene::clip_position(scene::world_position(instance, position));
}
@fragment fn fragment_main() -> @location(0) f32 { return 1.0; }";
const SHOW: &str = "@group(1) @binding(0) var pulled: texture_2d<f32>;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return textureLoad(pulled, vec2u(pixel.xy), 0);
}";

#[test]
fn pulled_vertices_land_where_indexed_ones_do() {
    let mut studio = Studio::new("many_lights", &Settings::new());
    let (_folder, files) = project(&[
        ("scripts/pipelines/pulling.rhai", PULLING),
        ("shaders/pulled.wgsl", PULLED),
        ("shaders/show.wgsl", SHOW),
    ]);
    studio.files = files;
    let (pipeline, _) = studio.draw_whole("pulling", &Settings::new(), SIZE);
    let read = |name| studio.renderer.read_target(&pipeline, name).unwrap().texels;
    let (pulled, depth) = (read("pulled"), read("depth"));
    assert!(depth.iter().any(|texel| texel[0] > 0.0));
    for (index, (pulled, depth)) in pulled.iter().zip(&depth).enumerate() {
        assert_eq!(pulled[0] == 1.0, depth[0] > 0.0, "pixel {index}");
    }
}

#[test]
fn a_pass_that_pulls_vertices_needs_a_vertex_stage_that_fetches_them() {
    let fragment_only = "@fragment fn fragment_main() -> @location(0) f32 { return 1.0; }";
    let (_folder, files) = project(&[
        ("scripts/pipelines/pulling.rhai", PULLING),
        ("shaders/pulled.wgsl", fragment_only),
        ("shaders/show.wgsl", SHOW),
    ]);
    let studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    let desc = load_pipeline(&files, "pulling", &Settings::new()).unwrap();
    let problems = studio
        .renderer
        .compiler()
        .compile(&files, &desc)
        .unwrap_err();
    assert_eq!(
        problems.0[0].message,
        "`pull` pulls its vertices, but `shaders/pulled.wgsl` has no vertex stage that fetches them"
    );
}

#[test]
fn pixels_name_the_triangle_that_they_show() {
    let mut studio = Studio::new("many_lights", &Settings::new());
    let (pipeline, _) = studio.draw_whole("visibility_buffer", &Settings::new(), SIZE);
    let read = |name| studio.renderer.read_target(&pipeline, name).unwrap();
    let (ids, depth) = (read("ids"), read("depth"));
    let pixels = Pixels::of(&studio.renderer);
    let view = pixels.view;
    let world = &studio.scene.world;
    let renderers = world.columns::<lightbench::world::MeshRenderer>();
    let mut shown = 0;
    for (index, texel) in ids.texels.iter().enumerate() {
        let reversed = depth.texels[index][0];
        assert_eq!(texel[0] == 0.0, reversed == 0.0, "pixel {index}");
        if texel[0] == 0.0 {
            continue;
        }
        let (row, number) = (texel[0] as usize - 1, texel[1] as usize);
        let entity = renderers.entities()[row];
        let mesh = studio.scene.assets.mesh(renderers.row(row).mesh).unwrap();
        let matrix = world
            .get::<lightbench::world::WorldMatrix>(entity)
            .unwrap()
            .matrix;
        let corner = |corner: usize| {
            let vertex = mesh.indices[number * 3 + corner] as usize;
            let position = matrix.transform_point3(mesh.positions[vertex]).as_dvec3();
            view.transform_point3(position)
        };
        let [a, b, c] = [0, 1, 2].map(corner);
        let triangle = Triangle {
            corner: a,
            edge_b: b - a,
            edge_c: c - a,
        };
        let point = pixels.at(index, reversed);
        let hit = triangle.meet(view.transform_point3(point), DVec3::X);
        // The pixel's centre lies inside, but for the rasteriser's grid of 1/256 of a pixel.
        let slack = 0.02 + 1e-3 / (b - a).cross(c - a).length();
        assert!(hit.weights.min_element() > -slack, "pixel {index}: {hit:?}");
        assert!(hit.counter_clockwise, "pixel {index} shows a back face");
        let found = a + (b - a) * hit.weights.y + (c - a) * hit.weights.z;
        let off = found.distance(view.transform_point3(point));
        assert!(off < 2e-4 * point.length(), "pixel {index}: {off} m away");
        shown += 1;
    }
    assert!(shown > 10_000, "{shown}");
}

#[test]
fn hard_shapes_look_as_in_forward_shading() {
    let (_folder, files) = hard_shapes();
    for portable in [false, true] {
        let mut studio = Studio::on(gpu(portable), "hard_cases", &settings(&["case=no_objects"]));
        studio.show(files.clone(), "shapes");
        for numbers in ["numbers=full", "numbers=compact"] {
            let float = if portable {
                "accumulation=rgba16float"
            } else {
                FULL
            };
            let forward = studio.hdr("clustered_forward", &settings(&[float]), SIZE);
            let found = studio.hdr("visibility_buffer", &settings(&[float, numbers]), SIZE);
            let mean = mean_difference(&forward, &found);
            let mut worst: Vec<f32> = Vec::new();
            for (a, b) in forward.texels.iter().zip(&found.texels) {
                let brightest = a[..3].iter().copied().fold(1e-3, f32::max);
                worst.push(
                    (0..3)
                        .map(|c| (a[c] - b[c]).abs() / brightest)
                        .fold(0.0, f32::max),
                );
            }
            worst.sort_by(f32::total_cmp);
            let share = worst[worst.len() * 999 / 1000];
            println!(
                "portable={portable} {numbers}: mean {mean:.2e}, all but 1/1000 {share:.2e}, worst {:.2e}",
                worst[worst.len() - 1]
            );
            assert!(mean < 1e-3, "{mean}");
            assert!(share < 0.05, "{share}");
        }
    }
}

#[test]
fn what_has_no_number_is_black_and_counted() {
    // More triangles in one mesh than 16 bits count.
    let scene = "
        let grey = material(\"grey\").color(rgb(0.5, 0.5, 0.5)).specular(0);
        spawn(\"ball\").mesh(sphere(1).segments(400, 200)).material(grey);
        ambient_light(\"sky\").intensity(1);
        camera(\"eye\").at(0, 0, 4).look_at(0, 0, 0).fov(40);";
    let (_folder, files) = project(&[("scripts/scenes/ball.rhai", scene)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "ball");
    let compact = settings(&["numbers=compact"]);
    let (pipeline, counts) = studio.draw_whole("visibility_buffer", &compact, SIZE);
    let marked = studio
        .renderer
        .read_target(&pipeline, "without_number")
        .unwrap();
    let found = studio.renderer.read_hdr(&pipeline).unwrap().unwrap();
    let whole = studio.hdr("visibility_buffer", &settings(&["numbers=full"]), SIZE);
    let mut lost = 0;
    for (index, texel) in found.texels.iter().enumerate() {
        if marked.texels[index][0] > 0.0 {
            lost += 1;
            assert_eq!(texel[..3], [0.0; 3]);
            assert!(whole.texels[index][0] > 0.0);
        } else {
            assert_eq!(texel[..3], whole.texels[index][..3], "pixel {index}");
        }
    }
    println!("{lost} pixels have no number");
    assert!(lost > 100);
    assert_eq!(counts.of("pixels_without_number"), lost);
}

/// Must-fail twins: one mistake in finding the point or its derivatives.
#[test]
fn a_wrong_weight_and_a_wrong_derivative_are_caught() {
    let mut studio = Studio::new("atrium", &Settings::new());
    let full = settings(&[FULL]);
    let forward = studio.hdr("clustered_forward", &full, SIZE);
    let right = mean_difference(&forward, &studio.hdr("visibility_buffer", &full, SIZE));
    println!("right: {right:.2e}");
    for (path, from, to) in [
        ("shaders/visibility/shade.wgsl", "c.uv)", "b.uv)"),
        (
            "shaders/visibility/shade.wgsl",
            "uvs * hit.ddx",
            "uvs * hit.ddx * 2.0",
        ),
        (
            "shaders/visibility/shade.wgsl",
            "uvs * hit.ddy",
            "vec2f(0.0)",
        ),
        (
            "shaders/visibility/shade.wgsl",
            "edge_b * w.y",
            "edge_b * w.z",
        ),
        (
            "shaders/visibility/shade.wgsl",
            "vec2f(texel) + 0.5",
            "vec2f(texel)",
        ),
        (
            "shaders/lib/triangle.wgsl",
            "- weights * dot(step, area)",
            "",
        ),
        ("shaders/lib/mesh.wgsl", "instance.base_vertex +", "0u +"),
    ] {
        let (_folder, files) = project_with_mistake(&[], (path, from, to));
        studio.files = files;
        let wrong = mean_difference(&forward, &studio.hdr("visibility_buffer", &full, SIZE));
        println!("`{to}`: {wrong:.2e}");
        assert!(
            wrong > 2.0 * right,
            "`{to}` went unnoticed: {wrong} and {right}"
        );
    }
}
