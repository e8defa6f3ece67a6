//! The reflection models on the GPU against their twins on the CPU.
#![allow(clippy::unwrap_used)]

use glam::{DVec3, Vec3};
use lightbench::assets::Reflection;
use lightbench::assets::files::Files;
use lightbench::lab::reference::{Surface, evaluate_light};
use lightbench::render::gpu_data::LightData;
use lightbench::script::list_pipelines;
use lightbench_tests::{Studio, settings};

/// Directions along each side of the grid, and pixels along each side of the picture: a pixel is a
/// pair of a direction to the light and one to the viewer.
const SIDE: u32 = 16;
const PIXELS: u32 = SIDE * SIDE;

const PIPELINE: &str = r#"
    let p = pipeline("Grid");
    p.target("hdr", "rgba32float");
    p.target("output", "rgba8unorm");
    p.fullscreen("grid")
        .shader("shaders/grid.wgsl")
        .define("REFLECTION_MODELS")
        .define("MODEL", MODEL).define("LOBE_X", LOBE_X).define("LOBE_Y", LOBE_Y)
        .writes("hdr");
    p.fullscreen("output").shader("shaders/black.wgsl").reads("hdr").writes("output");
    p.hdr("hdr");
    p.show("output");
    p
"#;

const BLACK: &str = "
@group(1) @binding(0) var hdr: texture_2d<f32>;
@fragment
fn fragment_main() -> @location(0) vec4f { return vec4f(0.0) * textureLoad(hdr, vec2i(0), 0); }
";

/// One directional light on one surface. Directions have rational coordinates, so that both sides
/// round them alike.
const GRID: &str = "
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting

const NORMAL = vec3f(0.6, 0.0, 0.8);
const TANGENT = vec3f(0.48, 0.8, -0.36);

// The stereographic projection of a grid; its corners lie below the surface.
fn direction(cell: u32) -> vec3f {
    let x = (f32(cell % 16u) - 7.5) / 8.0;
    let y = (f32(cell / 16u) - 7.5) / 8.0;
    let squared = x * x + y * y;
    let local = vec3f(2.0 * x, 2.0 * y, 1.0 - squared) / (1.0 + squared);
    return local.x * TANGENT + local.y * cross(NORMAL, TANGENT) + local.z * NORMAL;
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    var point: surface::Surface;
    point.normal = NORMAL;
    point.tangent = TANGENT;
    point.base_color = vec3f(0.2, 0.1, 0.0);
    point.specular = vec3f(1.0, 0.5, 0.04);
    point.model = #{MODEL}u;
    point.lobe = vec2f(f32(#{LOBE_X}), f32(#{LOBE_Y})) / 10000.0;
    var light: scene::Light;
    light.kind = scene::LIGHT_DIRECTIONAL;
    light.direction = -direction(u32(pixel.x));
    light.intensity = vec3f(1.0);
    let radiance = lighting::evaluate_light(light, point, direction(u32(pixel.y)));
    return vec4f(radiance, 1.0);
}
";

/// Every combination of eight awkward directions for light, viewer, normal and tangent.
const EDGES: &str = "
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting

fn awkward(index: u32) -> vec3f {
    switch index % 8u {
        case 0u: { return vec3f(0.0); }
        case 1u: { return vec3f(0.0, 0.0, 1.0); }
        case 2u: { return vec3f(0.0, 0.0, -1.0); }
        case 3u: { return vec3f(1.0, 0.0, 0.0); }
        case 4u: { return vec3f(-1.0, 0.0, 0.0); }
        case 5u: { return vec3f(0.0, 1.0, 0.0); }
        case 6u: { return vec3f(1.0, 0.0, 1e-8); }
        default: { return normalize(vec3f(-1.0, 1e-4, 1e-4)); }
    }
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let x = u32(pixel.x);
    let y = u32(pixel.y);
    var point: surface::Surface;
    point.normal = awkward(x);
    point.tangent = surface::surface_tangent(awkward(x / 8u), point.normal);
    point.base_color = vec3f(0.5);
    point.specular = vec3f(1.0, 0.5, 0.0);
    point.model = #{MODEL}u;
    point.lobe = vec2f(f32(#{LOBE_X}), f32(#{LOBE_Y})) / 10000.0;
    var light: scene::Light;
    light.kind = scene::LIGHT_DIRECTIONAL;
    light.direction = -awkward(y);
    light.intensity = vec3f(1.0);
    return vec4f(lighting::evaluate_light(light, point, awkward(y / 8u)), 1.0);
}
";

/// Draws a shader's grid for a model with parameters in ten-thousandths.
struct Grid {
    studio: Studio,
    folder: tempfile::TempDir,
}

impl Grid {
    fn new(shader: &str) -> Self {
        let grid = Self {
            studio: Studio::new("hard_cases", &settings(&["case=no_objects"])),
            folder: tempfile::tempdir().unwrap(),
        };
        grid.write("shaders/grid.wgsl", shader);
        grid.write("shaders/black.wgsl", BLACK);
        grid
    }

    fn write(&self, path: &str, text: &str) {
        let file = self.folder.path().join(path);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, text).unwrap();
    }

    fn draw(&mut self, model: u32, lobe: [u32; 2], size: u32) -> Vec<[f32; 4]> {
        let pipeline = PIPELINE
            .replace(", MODEL", &format!(", {model}"))
            .replace(", LOBE_X", &format!(", {}", lobe[0]))
            .replace(", LOBE_Y", &format!(", {}", lobe[1]));
        self.write("scripts/pipelines/grid.rhai", &pipeline);
        self.studio.files = Files::with_project(self.folder.path()).unwrap();
        let image = self.studio.hdr("grid", &settings(&[]), (size, size));
        image.texels
    }
}

fn direction(cell: u32) -> DVec3 {
    let coordinate = |index: u32| (f64::from(index) - 7.5) / 8.0;
    let (x, y) = (coordinate(cell % SIDE), coordinate(cell / SIDE));
    let squared = x * x + y * y;
    let local = DVec3::new(2.0 * x, 2.0 * y, 1.0 - squared) / (1.0 + squared);
    let (normal, tangent) = frame();
    local.x * tangent + local.y * normal.cross(tangent) + local.z * normal
}

fn frame() -> (DVec3, DVec3) {
    (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.48, 0.8, -0.36))
}

fn reflection(model: u32, lobe: [u32; 2]) -> Reflection {
    let [x, y] = lobe.map(|parameter| parameter as f32 / 10_000.0);
    match model {
        0 => Reflection::BlinnPhong { power: x },
        1 => Reflection::Phong { power: x },
        2 => Reflection::Beckmann { roughness: x },
        3 => Reflection::Ggx { roughness: x },
        _ => Reflection::Ward {
            along: x,
            across: y,
        },
    }
}

/// Each model with a few parameters, in ten-thousandths.
fn cases() -> Vec<(u32, [u32; 2])> {
    let mut cases = Vec::new();
    for model in [0, 1] {
        for power in [1, 8, 100, 1448] {
            cases.push((model, [10_000 * power; 2]));
        }
    }
    for roughness in [263, 1000, 3000, 10_000] {
        for model in [2, 3, 4] {
            cases.push((model, [roughness; 2]));
        }
    }
    cases.extend([(4, [4000, 1000]), (4, [263, 10_000])]);
    cases
}

/// The largest error of the grid of a case, relative to the light that the CPU expects, or to a
/// thousandth of the brightest in the grid where less is expected.
fn worst_error(grid: &mut Grid, model: u32, lobe: [u32; 2]) -> f64 {
    let texels = grid.draw(model, lobe, PIXELS);
    let (normal, tangent) = frame();
    let surface = Surface {
        position: DVec3::ZERO,
        normal,
        base_color: DVec3::new(0.2, 0.1, 0.0),
        specular: DVec3::new(1.0, 0.5, 0.04),
        reflection: reflection(model, lobe),
        tangent,
        emissive: DVec3::ZERO,
    };
    let expected: Vec<[f64; 3]> = (0..PIXELS * PIXELS)
        .map(|pixel| {
            let light = LightData {
                kind: 2,
                direction: -direction(pixel % PIXELS).as_vec3(),
                intensity: Vec3::ONE,
                ..no_light()
            };
            evaluate_light(&light, &surface, direction(pixel / PIXELS)).to_array()
        })
        .collect();
    let brightest = expected.iter().flatten().copied().fold(0.0, f64::max);
    assert!(brightest > 0.1, "{model} {lobe:?} is dark");
    let pairs = texels.iter().zip(&expected);
    pairs
        .flat_map(|(found, expected)| (0..3).map(|c| (f64::from(found[c]), expected[c])))
        .map(|(found, expected)| (found - expected).abs() / expected.max(1e-3 * brightest))
        .fold(0.0, f64::max)
}

fn no_light() -> LightData {
    LightData {
        position: Vec3::ZERO,
        range: 0.0,
        direction: Vec3::ZERO,
        kind: 0,
        intensity: Vec3::ZERO,
        angle_scale: 0.0,
        angle_offset: 0.0,
        reserved: [0; 3],
    }
}

/// What single precision costs: cosines near 1 are known to 10⁻⁷, and the slope that the narrowest
/// lobes take from them, divided by a roughness squared of 7 · 10⁻⁴, to less than 10⁻³. As much goes
/// where light comes from almost opposite the viewer, and H is the direction of a small difference.
const PRECISION: f64 = 1e-3;

#[test]
fn every_model_equals_its_twin_on_a_grid_of_directions() {
    let mut grid = Grid::new(GRID);
    for (model, lobe) in cases() {
        let worst = worst_error(&mut grid, model, lobe);
        println!("{:?}: {worst:.2e}", reflection(model, lobe));
        assert!(worst < PRECISION, "{:?}: {worst}", reflection(model, lobe));
    }
}

/// Must-fail twins: one wrong character in each model is outside the bound.
#[test]
fn a_wrong_formula_is_noticed() {
    let mistakes = [
        (0, [80_000; 2], "(power + 4.0)", "(power + 4.1)"),
        (1, [80_000; 2], "(2.0 * PI) * exp2", "(2.01 * PI) * exp2"),
        (2, [3000; 2], "(2.0 * v_dot_h", "(2.1 * v_dot_h"),
        (
            3,
            [3000; 2],
            "return 0.5 / (shadowing",
            "return 0.51 / (shadowing",
        ),
        (
            4,
            [4000, 1000],
            "vec2f(h_dot_t, h_dot_b)",
            "vec2f(h_dot_b, h_dot_t)",
        ),
        (
            2,
            [3000; 2],
            "rest * rest * rest * rest * rest",
            "rest * rest * rest * rest",
        ),
    ];
    let path = "shaders/lib/brdf.wgsl";
    let shipped = Files::shipped().read_text(path).unwrap();
    for (model, lobe, from, to) in mistakes {
        assert!(shipped.contains(from), "{path} has no `{from}`");
        let mut grid = Grid::new(GRID);
        grid.write(path, &shipped.replace(from, to));
        let worst = worst_error(&mut grid, model, lobe);
        assert!(worst > PRECISION, "`{to}` went unnoticed: {worst}");
    }
}

/// Grazing light and viewers, viewers behind the surface, no direction at all, tangents along the
/// normal, roughness and powers of zero.
#[test]
fn no_model_breaks_at_the_edges() {
    let mut grid = Grid::new(EDGES);
    for model in 0..5 {
        for lobe in [[0; 2], [1; 2], [10_000; 2], [0, 10_000], [14_480_000; 2]] {
            for texel in grid.draw(model, lobe, 64) {
                assert!(
                    texel.iter().all(|value| value.is_finite() && *value >= 0.0),
                    "{:?}: {texel:?}",
                    reflection(model, lobe)
                );
            }
        }
    }
}

/// Heat maps count lights on white, matt surfaces, whatever the material: models must not show.
#[test]
fn heat_maps_of_lights_do_not_see_the_model() {
    let count = |model: &str, pipeline: &str, map: &str| {
        let mut studio = Studio::new("brdf_spheres", &settings(&["surface=gold", model]));
        studio.hdr(pipeline, &settings(&[map]), (96, 60)).texels
    };
    for pipeline in list_pipelines(&Files::shipped()).unwrap() {
        let name = &pipeline.name;
        for map in ["heat_map=lights_evaluated", "heat_map=lights_reaching"] {
            let all = count("model=all", name, map);
            assert!(
                all == count("model=blinn_phong", name, map),
                "{name} {map}: the models differ"
            );
            // The scene has five lights.
            let most = all.iter().map(|texel| texel[0]).fold(0.0, f32::max);
            assert_eq!(most, 5.0, "{name} {map}");
        }
    }
}
