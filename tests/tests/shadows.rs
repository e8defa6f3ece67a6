//! What `shadow` passes draw, against distances computed here.
#![allow(clippy::unwrap_used)]

use lightbench::render::description::Slice;
use lightbench::render::{Pipeline, Renderer, TargetImage, View};
use lightbench::script::Scene;
use lightbench::world::glam::Vec3;
use lightbench_tests::{Workshop, gpu};

/// A scene and a pipeline of its own.
struct Stage {
    renderer: Renderer,
    scene: Scene,
    pipeline: Pipeline,
    unplaced: Vec<u32>,
}

impl Stage {
    /// Draws one frame. `body` declares the passes, and a float target `result` that it fills.
    fn draw(scene: &str, body: &str, shaders: &[(&str, &str)], view: &View, size: u32) -> Self {
        let workshop = Workshop::new();
        let mut scene = workshop.scene(scene);
        let desc = workshop.pipeline(body, shaders);
        let mut renderer = Renderer::new(gpu(false));
        let mut pipeline = workshop.compile(&renderer, &desc);
        let (world, assets) = (&mut scene.world, &scene.assets);
        let statistics = renderer
            .render(world, assets, &mut pipeline, view, (size, size), 0.0)
            .unwrap();
        let unplaced = statistics.passes.iter().map(|p| p.unplaced_lights);
        Self {
            unplaced: unplaced.collect(),
            renderer,
            scene,
            pipeline,
        }
    }

    fn layer(&self, target: &str, layer: u32) -> TargetImage {
        let slice = Slice { mip: 0, layer };
        self.renderer
            .read_target_slice(&self.pipeline, target, slice)
            .unwrap()
    }
}

/// Reversed depth in perspective.
fn perspective(distance: f32, near: f32, far: f32) -> f32 {
    near * (far - distance) / (distance * (far - near))
}

/// Fills `result`, so that a pipeline is complete.
const FILL: &str = "p.target(\"result\", \"r32float\");
    p.clear(\"fill\").writes(\"result\").clear(0, 0, 0, 0);";

const TABLE: &str = "let paint = material(\"paint\");
    spawn(\"floor\").mesh(plane(20, 20)).material(paint);
    spawn(\"table\").mesh(box(2, 1, 2)).material(paint).at(0, 0.5, 0);";

fn texel(image: &TargetImage, x: u32, y: u32) -> f32 {
    image.texels[(y * image.width + x) as usize][0]
}

#[test]
fn given_views_fill_one_layer_each() {
    let body = "p.target(\"map\", \"depth32float\").size(32, 32).array(3);
        p.shadow(\"views\")
            .box_from(vec3(0, 6, 0), vec3(0, 0, 0), 8, 1, 7)
            .view_from(vec3(0, 6, 0), vec3(0, 0, 0), 60, 1, 7)
            .box_from(vec3(0, 0.5, 6), vec3(0, 0.5, 0), 8, 1, 11)
            .depth(\"map\").clear(0.0);
        p.fullscreen(\"keep\").shader(\"shaders/keep.wgsl\").reads(\"map\").writes(\"result\");
        p.target(\"result\", \"r32float\");";
    let keep = "@group(1) @binding(0) var map: texture_depth_2d_array;
        @fragment fn fragment_main() -> @location(0) vec4f {
            return vec4f(textureLoad(map, vec2u(0), 0, 0));
        }";
    let stage = Stage::draw(TABLE, body, &[("keep", keep)], &View::default(), 8);
    // Depth of a box is linear: the table's top 5 m away, the floor 6 m, of 1 to 7 m.
    let above = stage.layer("map", 0);
    for (x, y, distance) in [(16, 16, 5.0), (13, 13, 5.0), (18, 18, 5.0), (2, 16, 6.0)] {
        let expected = (7.0 - distance) / 6.0;
        assert!((texel(&above, x, y) - expected).abs() < 1e-5, "{x} {y}");
    }
    // The table's edge lies at 1 m: 4 texels from the middle.
    let row: Vec<bool> = (0..32).map(|x| texel(&above, x, 16) > 0.25).collect();
    assert_eq!(
        row,
        (0..32).map(|x| (12..20).contains(&x)).collect::<Vec<_>>()
    );
    // In perspective depth is that of the distance along the view.
    let above = stage.layer("map", 1);
    assert!((texel(&above, 16, 16) - perspective(5.0, 1.0, 7.0)).abs() < 1e-5);
    assert!((texel(&above, 0, 0) - perspective(6.0, 1.0, 7.0)).abs() < 1e-5);
    // From the front, the floor's edge: the table's face at 5 m, and nothing above it.
    let front = stage.layer("map", 2);
    assert!((texel(&front, 16, 15) - (11.0 - 5.0) / 10.0).abs() < 1e-5);
    assert_eq!(texel(&front, 16, 4), 0.0);
    // Rows run from the top: the table reaches from 0 to 1 m, the picture from −3.5 to 4.5 m.
    assert!(texel(&front, 16, 14) > 0.5 && texel(&front, 16, 13) == 0.0);
}

#[test]
fn spot_lights_look_along_their_cones_and_those_without_a_layer_are_counted() {
    let scene = format!(
        "{TABLE}
        spot_light(\"a\").at(0, 6, 0).aim(0, 0, 0).range(9).inner(30).outer(60);
        spot_light(\"b\").at(5, 4, 0).aim(5, 0, 0).range(8).inner(30).outer(40);
        spot_light(\"c\").at(-5, 4, 0).aim(-5, 0, 0).range(8).inner(30).outer(40);
        point_light(\"d\").at(0, 4, 0).range(8);"
    );
    let body = format!(
        "p.target(\"map\", \"depth32float\").size(32, 32).array(2);
        p.shadow(\"spots\").views(\"spot\").near(0.5).depth(\"map\").clear(0.0);
        {FILL}"
    );
    let stage = Stage::draw(&scene, &body, &[], &View::default(), 8);
    assert_eq!(stage.unplaced[0], 1, "three spots, two layers");
    assert_eq!(
        stage.pipeline.desc.passes[0].unplaced_in_words().as_deref(),
        Some("Lights that `spots` had no layer for")
    );
    let a = stage.layer("map", 0);
    assert!((texel(&a, 16, 16) - perspective(5.0, 0.5, 9.0)).abs() < 1e-5);
    let b = stage.layer("map", 1);
    assert!((texel(&b, 16, 16) - perspective(4.0, 0.5, 8.0)).abs() < 1e-5);
    // A cone of 60° sees the floor's point at 6 · tan 30° at its rim, and the middle of it halfway.
    let half = 6.0 * 15.0_f32.to_radians().tan();
    let at = (half / (6.0 * 30.0_f32.to_radians().tan()) * 0.5 + 0.5) * 32.0;
    assert!((texel(&a, at as u32 + 4, 16) - perspective(6.0, 0.5, 9.0)).abs() < 1e-5);
    let views = &stage.renderer.frame().shadow_views;
    assert_eq!((views[0].light, views[1].light), (0, 1));
    assert_eq!(
        stage.renderer.frame().light_shadows,
        [0, 1, u32::MAX, u32::MAX]
    );
    drop(stage.scene);
}

#[test]
fn a_cube_map_finds_the_walls_of_a_room_in_every_direction() {
    // The lamp hangs off the middle of a closed room of 4 m.
    let scene = "spawn(\"room\").mesh(box(4, 4, 4)).material(material(\"paint\"));
        point_light(\"lamp\").at(0.5, -0.25, 0.75).range(10);";
    let body = "
        p.target(\"map\", \"depth32float\").size(64, 64).cube();
        p.target(\"result\", \"rgba32float\");
        p.shadow(\"lamp\").views(\"point\").faces(\"both\").near(0.1).depth(\"map\").clear(0.0);
        p.fullscreen(\"look\").shader(\"shaders/look.wgsl\").reads(\"map\").writes(\"result\");";
    // Directions on a sphere; what the cube holds there.
    let look = "
        @group(1) @binding(0) var map: texture_depth_cube;
        @group(1) @binding(1) var nearest_sampler: sampler;
        @fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            let around = (pixel.x / 32.0) * 6.2831853;
            let up = pixel.y / 16.0 - 1.0;
            let flat = sqrt(1.0 - up * up);
            let direction = vec3f(flat * cos(around), up, flat * sin(around));
            return vec4f(direction, textureSampleLevel(map, nearest_sampler, direction, 0));
        }";
    let stage = Stage::draw(scene, body, &[("look", look)], &View::default(), 32);
    let lamp = Vec3::new(0.5, -0.25, 0.75);
    let result = stage.layer("result", 0);
    let mut worst = 0.0_f32;
    for found in &result.texels {
        let direction = Vec3::new(found[0], found[1], found[2]);
        // Along each axis the wall is so many times the direction away.
        let walls = (direction.signum() * 2.0 - lamp) / direction;
        let times = walls.min_element();
        let distance = direction.abs().max_element() * times;
        // Texels are 1/32 of the side's half wide, so a direction may miss its wall by as much.
        let expected = perspective(distance, 0.1, 10.0);
        worst = worst.max((found[3] / expected - 1.0).abs());
    }
    assert!(worst < 0.06, "{worst}");
}

#[test]
fn a_slanted_sun_lays_the_shadow_of_a_board_where_geometry_says() {
    // A board of 2 m at a height of 2 m, the sun from (1, 2, 0): its shadow is 1 m further along −x.
    let scene = "let paint = material(\"paint\");
        spawn(\"floor\").mesh(plane(12, 12)).material(paint);
        spawn(\"board\").mesh(box(2, 0.02, 2)).material(paint).at(1, 2, 0);
        directional_light(\"sun\").at(1, 2, 0).aim(0, 0, 0);";
    let body = "
        p.target(\"map\", \"depth32float\").size(512, 512).array(1);
        p.target(\"result\", \"rgba32float\");
        p.target(\"depth\", \"depth32float\");
        p.shadow(\"sun\").views(\"directional\").depth(\"map\").clear(0.0);
        p.geometry(\"floor\").shader(\"shaders/lit.wgsl\").reads(\"map\")
            .writes(\"result\").clear(0, 0, 0, 0).depth(\"depth\").clear(0.0);";
    let lit = "#import lightbench::geometry
        #import lightbench::shadow
        @group(1) @binding(0) var map: texture_depth_2d_array;
        @group(1) @binding(1) var<storage, read> shadow_views: array<shadow::ShadowView>;
        @group(1) @binding(2) var<storage, read> light_shadows: array<u32>;
        @fragment fn fragment_main(in: geometry::VertexOutput) -> @location(0) vec4f {
            let view = shadow_views[light_shadows[0]];
            let place = shadow::project(view, in.world_position);
            let texel = vec2u(place.xy * vec2f(textureDimensions(map)));
            let nearest = textureLoad(map, texel, view.layer, 0);
            return vec4f(in.world_position, select(0.0, 1.0, place.z >= nearest - 1e-3));
        }";
    let above = View::look_at(Vec3::new(0.0, 1.5, 1e-3), Vec3::ZERO, 2.0, 0.1, 10.0);
    let stage = Stage::draw(scene, body, &[("lit", lit)], &above, 64);
    let result = stage.layer("result", 0);
    let (mut wrong, mut dark) = (0, 0);
    for found in &result.texels {
        let (x, z) = (found[0], found[2]);
        // The board reaches from 0 to 2 m along x; its shadow from −1 to 1 m.
        let (from_edge_x, from_edge_z) = (x.abs() - 1.0, z.abs() - 1.0);
        if from_edge_x.abs() < 0.05 || from_edge_z.abs() < 0.05 {
            continue;
        }
        let shaded = from_edge_x < 0.0 && from_edge_z < 0.0;
        dark += usize::from(shaded);
        wrong += usize::from((found[3] == 0.0) != shaded);
    }
    assert!(dark > 300, "{dark}");
    assert_eq!(wrong, 0);
}
