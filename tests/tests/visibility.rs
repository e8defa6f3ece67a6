//! The visibility buffer: the triangle that a pixel names is the one that it shows, and the point that
//! is found on it is the one that the rasteriser would have interpolated.
#![allow(clippy::unwrap_used)]

use glam::{DMat4, DVec3, DVec4};
use lightbench::lab::reference::triangle::Triangle;
use lightbench::render::TargetImage;
use lightbench::script::Settings;
use lightbench_tests::{Studio, gpu, project, settings};

const SIZE: (u32, u32) = (320, 180);
const FULL: &str = "accumulation=rgba32float";

/// The mean of the differences, relative to the mean of the light.
fn mean_difference(a: &TargetImage, b: &TargetImage) -> f64 {
    let values = |image: &TargetImage| -> Vec<f64> {
        let texels = image.texels.iter().flat_map(|texel| &texel[..3]);
        texels.map(|value| f64::from(*value)).collect()
    };
    let (a, b) = (values(a), values(b));
    let differences = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    differences.sum::<f64>() / a.iter().sum::<f64>()
}

#[test]
fn pixels_name_the_triangle_that_they_show() {
    let mut studio = Studio::new("many_lights", &Settings::new());
    let (pipeline, _) = studio.draw_whole("visibility_buffer", &Settings::new(), SIZE);
    let read = |name| studio.renderer.read_target(&pipeline, name).unwrap();
    let (ids, depth) = (read("ids"), read("depth"));
    let data = studio.renderer.frame().data;
    let view = data.view.as_dmat4();
    let to_world = (data.projection.as_dmat4() * view).inverse();
    let world = &studio.scene.world;
    let renderers = world.columns::<lightbench::world::MeshRenderer>();
    let mut shown = 0;
    for (index, texel) in ids.texels.iter().enumerate() {
        let reversed = f64::from(depth.texels[index][0]);
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
        let point = position(&to_world, index, reversed);
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

fn position(to_world: &DMat4, index: usize, depth: f64) -> DVec3 {
    let (x, y) = (index as u32 % SIZE.0, index as u32 / SIZE.0);
    let ndc_x = (f64::from(x) + 0.5) / f64::from(SIZE.0) * 2.0 - 1.0;
    let ndc_y = 1.0 - (f64::from(y) + 0.5) / f64::from(SIZE.1) * 2.0;
    let world = *to_world * DVec4::new(ndc_x, ndc_y, depth, 1.0);
    world.truncate() / world.w
}

/// Shapes whose points are hard to find: mirrored, scaled unevenly, seen from behind, full of holes,
/// cut by the near plane, normal-mapped, with large and small triangles.
const SHAPES: &str = "
let cloth = material(\"cloth\").surface(weave_texture()).specular(0.1).power(60).two_sided();
let stone = material(\"stone\").surface(tiles_texture().pieces(3)).specular(0.2).power(90);
let leaf = material(\"leaf\").texture(picture(\"leaf.tga\")).cutoff(0.5).two_sided().specular(0.1);
spawn(\"floor\").mesh(plane(200, 200)).material(stone).at(0, -1, 0);
spawn(\"near\").mesh(plane(3, 3)).material(stone).at(0, -0.2, 4.9);
spawn(\"mirrored\").mesh(torus(0.6, 0.25)).material(stone).at(-2.2, 0.2, 0).scale(-1, 1.4, 0.7);
spawn(\"cloth\").mesh(plane(2, 2)).material(cloth).at(0, 0.4, -1).turn(-70, 20, 0);
spawn(\"behind\").mesh(plane(2, 2)).material(cloth).at(2.2, 0.4, -1).turn(80, 190, 10);
spawn(\"leaf\").mesh(plane(1.5, 1.5)).material(leaf).at(1.2, 0.3, 1.5).turn(75, 0, 0);
spawn(\"ball\").mesh(sphere(0.5).segments(96, 48)).material(stone).at(-0.9, -0.2, 1.6);
point_light(\"lamp\").at(1, 2, 3).range(12).intensity(9);
point_light(\"other\").at(-3, 1, 1).range(9).intensity(6).color(0.4, 0.6, 1);
ambient_light(\"sky\").color(0.6, 0.7, 1).intensity(0.1);
camera(\"eye\").at(0, 0.8, 5).look_at(0, 0, 0).fov(55).near(0.1).far(90);
";

/// A green picture full of round holes, as a TGA file of 32 bits a pixel.
fn leaf() -> Vec<u8> {
    let mut bytes = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 64, 0, 64, 0, 32, 0x28];
    for pixel in 0..64 * 64_i32 {
        let (x, y) = (pixel % 64 % 16 - 8, pixel / 64 % 16 - 8);
        let alpha = if x * x + y * y < 30 { 0 } else { 255 };
        bytes.extend([40, 160, 60, alpha]);
    }
    bytes
}

#[test]
fn hard_shapes_look_as_in_forward_shading() {
    let (folder, files) = project(&[("scripts/scenes/shapes.rhai", SHAPES)]);
    std::fs::write(folder.path().join("leaf.tga"), leaf()).unwrap();
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
    let files = lightbench::assets::files::Files::shipped();
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
        let text = files.read_text(path).unwrap();
        assert!(text.contains(from), "{path} has no `{from}`");
        let (_folder, project) = project(&[(path, &text.replace(from, to))]);
        studio.files = project;
        let wrong = mean_difference(&forward, &studio.hdr("visibility_buffer", &full, SIZE));
        println!("`{to}`: {wrong:.2e}");
        assert!(
            wrong > 2.0 * right,
            "`{to}` went unnoticed: {wrong} and {right}"
        );
    }
}
