//! Each kind of pass, and what passes can do with targets, by numbers computed here.
#![allow(clippy::unwrap_used)]

use lightbench::render::{Pipeline, PipelineDesc, Renderer, View};
use lightbench::script::{Scene, Settings, load_pipeline};
use lightbench_tests::{Workshop, gpu};

/// A project with one pipeline, and a scene with six lights that hang over one another.
struct Bench {
    renderer: Renderer,
    workshop: Workshop,
    desc: PipelineDesc,
    scene: Scene,
    frame: u32,
}

/// Every texel is its column plus a thousand times its row.
const PATTERN: &str =
    "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = floor(pixel.xy);
    return vec4f(texel.x + 1000.0 * texel.y, 0.0, 0.0, 1.0);
}";

impl Bench {
    fn new(body: &str, shaders: &[(&str, &str)]) -> Self {
        Self::on(false, body, shaders)
    }

    /// `body` declares a float target `result` and fills it.
    fn on(portable: bool, body: &str, shaders: &[(&str, &str)]) -> Self {
        let workshop = Workshop::new();
        workshop.write("shaders/pattern.wgsl", PATTERN);
        let settings = Settings::new().with("lights", "6").with("range", 2.5);
        Self {
            renderer: Renderer::new(gpu(portable)),
            scene: workshop.load("many_lights", &settings),
            desc: workshop.pipeline(body, shaders),
            workshop,
            frame: 0,
        }
    }

    fn pipeline(&self) -> Pipeline {
        self.workshop.compile(&self.renderer, &self.desc)
    }

    /// Draws the next frame, and gives the first channel of `result` and the counters.
    fn draw(&mut self, pipeline: &mut Pipeline, size: (u32, u32)) -> (Vec<f32>, Vec<u32>) {
        let serial = self.renderer.next_frame();
        self.renderer.set_frame_index(self.frame);
        self.frame += 1;
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        let view = View::default();
        self.renderer
            .render(world, assets, pipeline, &view, size, 0.0)
            .unwrap();
        let measured = self.renderer.finish(60).unwrap();
        let counters = measured.into_iter().find(|m| m.frame == serial);
        let result = self.renderer.read_target(pipeline, "result").unwrap();
        let values = result.texels.iter().map(|texel| texel[0]).collect();
        (values, counters.map(|m| m.counters).unwrap_or_default())
    }

    /// The first frame through the scene's camera: all channels of `result`.
    fn lit(&mut self, size: (u32, u32)) -> Vec<[f32; 4]> {
        let mut pipeline = self.pipeline();
        let view = View::from_world(&self.scene.world).unwrap();
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        self.renderer
            .render(world, assets, &mut pipeline, &view, size, 0.0)
            .unwrap();
        let result = self.renderer.read_target(&pipeline, "result").unwrap();
        result.texels
    }

    /// The first frame.
    fn result(&mut self, size: (u32, u32)) -> Vec<f32> {
        let mut pipeline = self.pipeline();
        self.draw(&mut pipeline, size).0
    }
}

fn pattern(x: u32, y: u32) -> f32 {
    x as f32 + 1000.0 * y as f32
}

#[test]
fn mip_levels_are_means_and_extremes_of_all_texels_above() {
    // 5 × 3 shrinks to 2 × 1: the last texel takes three columns and all three rows.
    let all =
        |columns: std::ops::Range<u32>| columns.flat_map(|x| (0..3).map(move |y| pattern(x, y)));
    let mean = |columns: std::ops::Range<u32>| {
        let count = all(columns.clone()).count() as f32;
        all(columns).sum::<f32>() / count
    };
    let least = |columns| all(columns).fold(f32::INFINITY, f32::min);
    let most = |columns| all(columns).fold(0.0, f32::max);
    for (reduction, expected) in [
        ("average", [mean(0..2), mean(2..5)]),
        ("min", [least(0..2), least(2..5)]),
        ("max", [most(0..2), most(2..5)]),
    ] {
        let body = format!(
            "p.target(\"pyramid\", \"r32float\").mips();
            p.target(\"result\", \"r32float\").size(2, 1);
            p.fullscreen(\"draw\").shader(\"shaders/pattern.wgsl\").writes(\"pyramid\");
            p.mips(\"shrink\", \"pyramid\", \"{reduction}\");
            p.copy_slice(\"take\", \"pyramid\", 1, 0, \"result\", 0, 0);"
        );
        let found = Bench::new(&body, &[]).result((5, 3));
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 0.01,
                "{reduction}: {found}, not {expected}"
            );
        }
    }
}

#[test]
fn history_is_zeros_first_then_the_frame_before() {
    let body = "
        p.target(\"now\", \"r32float\");
        p.target(\"before\", \"r32float\");
        p.target(\"result\", \"r32float\");
        p.fullscreen(\"count\").shader(\"shaders/count.wgsl\").reads(\"before\").writes(\"now\");
        p.copy(\"take\", \"now\", \"result\");
        p.history(\"keep\", \"now\", \"before\");";
    // One more than the frame before; a hundred more for each frame that history says it holds.
    let count = "#import lightbench::scene
        @group(1) @binding(0) var before: texture_2d<f32>;
        @fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            let last = textureLoad(before, vec2u(pixel.xy), 0).r;
            return vec4f(last % 100.0 + 1.0 + 100.0 * f32(scene::frame.history_frames), 0.0, 0.0, 1.0);
        }";
    let mut bench = Bench::new(body, &[("count", count)]);
    let mut pipeline = bench.pipeline();
    for expected in [1.0, 102.0, 203.0] {
        let (values, _) = bench.draw(&mut pipeline, (7, 5));
        assert_eq!(values, vec![expected; 35]);
    }
    // Another size begins anew.
    let (values, _) = bench.draw(&mut pipeline, (1, 1));
    assert_eq!(values, [1.0]);
    // So does a frame that does not follow the last one.
    bench.frame += 5;
    let (values, _) = bench.draw(&mut pipeline, (1, 1));
    assert_eq!(values, [1.0 + 1.0], "the target itself keeps its value");
}

#[test]
fn samples_resolve_to_their_mean() {
    let body = "
        p.target(\"samples\", \"r16float\").samples(4);
        p.target(\"result\", \"r16float\");
        p.fullscreen(\"draw\").shader(\"shaders/samples.wgsl\").writes(\"samples\");
        p.resolve(\"mean\", \"samples\", \"result\");";
    let each =
        "@fragment fn fragment_main(@builtin(sample_index) index: u32) -> @location(0) vec4f {
        return vec4f(f32(index * index), 0.0, 0.0, 1.0);
    }";
    // The mean of 0, 1, 4 and 9.
    let found = Bench::new(body, &[("samples", each)]).result((3, 2));
    assert_eq!(found, [3.5; 6]);
}

#[test]
fn a_compute_pass_covers_sizes_that_do_not_divide() {
    let body = "
        p.target(\"result\", \"r32float\");
        p.buffer(\"totals\", 8);
        p.clear(\"begin\").updates(\"totals\");
        p.compute(\"fill\").shader(\"shaders/fill.wgsl\").threads_of(\"result\")
            .updates(\"result\").updates(\"totals\");
        p.compute(\"again\").shader(\"shaders/again.wgsl\").groups_from(\"totals\", 4)
            .updates(\"totals_copy\");
        p.buffer(\"totals_copy\", 4);
        p.counter(\"texels\", \"totals\", 0, \"Texels that were filled\");
        p.counter(\"groups\", \"totals_copy\", 0, \"Workgroups of the second pass\");";
    let fill = "
        @group(1) @binding(0) var result: texture_storage_2d<r32float, write>;
        @group(1) @binding(1) var<storage, read_write> totals: array<atomic<u32>>;
        @compute @workgroup_size(8, 4)
        fn compute_main(@builtin(global_invocation_id) id: vec3u) {
            if all(id.xy < textureDimensions(result)) {
                textureStore(result, id.xy, vec4f(f32(id.x) + 1000.0 * f32(id.y), 0.0, 0.0, 1.0));
                atomicAdd(&totals[0], 1u);
                // What the second pass is dispatched with: 3 × 2 × 1.
                atomicStore(&totals[4], 3u);
                atomicStore(&totals[5], 2u);
                atomicStore(&totals[6], 1u);
            }
        }";
    let again = "
        @group(1) @binding(0) var<storage, read_write> totals_copy: array<atomic<u32>>;
        @compute @workgroup_size(1)
        fn compute_main() { atomicAdd(&totals_copy[0], 1u); }";
    let mut bench = Bench::new(body, &[("fill", fill), ("again", again)]);
    let mut pipeline = bench.pipeline();
    let (values, counters) = bench.draw(&mut pipeline, (637, 359));
    let expected: Vec<f32> = (0..359)
        .flat_map(|y| (0..637).map(move |x| pattern(x, y)))
        .collect();
    assert!(values == expected);
    assert_eq!(counters, [637 * 359, 6]);
    // The first buffer is cleared in each frame, the second keeps what it holds.
    let (_, counters) = bench.draw(&mut pipeline, (637, 359));
    assert_eq!(counters, [637 * 359, 12]);
}

#[test]
fn stencil_limits_what_a_later_pass_draws() {
    let body = "
        p.target(\"depth\", \"depth32float-stencil8\");
        p.target(\"result\", \"r32float\");
        p.fullscreen(\"mark\").shader(\"shaders/left.wgsl\").writes(\"result\").clear(0, 0, 0, 0)
            .depth(\"depth\").clear(0.0).test(\"always\")
            .stencil(\"always\", 7).stencil_write(\"replace\").clear_stencil(1);
        p.fullscreen(\"draw\").shader(\"shaders/pattern.wgsl\").writes(\"result\")
            .depth(\"depth\").test(\"always\").read_only().stencil(\"equal\", 7);";
    let left = "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
        if pixel.x >= 2.0 { discard; }
        return vec4f(-1.0, 0.0, 0.0, 1.0);
    }";
    let found = Bench::new(body, &[("left", left)]).result((4, 2));
    let row = |y| [pattern(0, y), pattern(1, y), 0.0, 0.0];
    assert_eq!(found, [row(0), row(1)].concat());
}

#[test]
fn blending_takes_any_factors_and_masks_leave_channels_alone() {
    let body = "
        p.target(\"result\", \"rgba16float\");
        p.fullscreen(\"first\").shader(\"shaders/value.wgsl\").define(\"VALUE\", 8)
            .writes(\"result\").clear(0, 0, 0, 0);
        p.fullscreen(\"second\").shader(\"shaders/value.wgsl\").define(\"VALUE\", 4)
            .writes(\"result\").blend(\"one\", \"add\", \"constant\")
            .blend_constant(0.25, 0.25, 0.25, 0.25);
        p.fullscreen(\"third\").shader(\"shaders/value.wgsl\").define(\"VALUE\", 99)
            .writes(\"result\").mask(\"gba\");
        p.fullscreen(\"fourth\").shader(\"shaders/value.wgsl\").define(\"VALUE\", 5)
            .writes(\"result\").blend(\"min\");";
    let value = "@fragment fn fragment_main() -> @location(0) vec4f { return vec4f(#{VALUE}.0); }";
    // 4 + 8/4 = 6, then the smaller of 6 and 5.
    let found = Bench::new(body, &[("value", value)]).result((2, 2));
    assert_eq!(found, [5.0; 4]);
    let three = body.split("p.fullscreen(\"fourth\")").next().unwrap();
    assert_eq!(Bench::new(three, &[("value", value)]).result((1, 1)), [6.0]);
}

#[test]
fn layers_sides_and_slices_are_drawn_and_read_one_by_one() {
    for (kind, texture, load, layers) in [
        (".array(3)", "texture_2d_array<f32>", "vec2u(0), {}, 0", 3),
        (
            ".size(2, 2).cube()",
            "texture_2d_array<f32>",
            "vec2u(0), {}, 0",
            6,
        ),
        (".volume(4)", "texture_3d<f32>", "vec3u(0, 0, {}), 0", 4),
    ] {
        let mut body = format!("p.target(\"deep\", \"r32float\"){kind};");
        for layer in 0..layers {
            body += &format!(
                "p.fullscreen(\"draw {layer}\").shader(\"shaders/value.wgsl\")
                    .define(\"VALUE\", {}).writes(\"deep\").layer({layer});",
                10_i32.pow(layer)
            );
        }
        body += "p.target(\"result\", \"r32float\");
            p.fullscreen(\"sum\").shader(\"shaders/sum.wgsl\").reads(\"deep\").writes(\"result\");";
        let terms: Vec<String> = (0..layers)
            .map(|layer| {
                format!(
                    "textureLoad(deep, {}).r",
                    load.replace("{}", &layer.to_string())
                )
            })
            .collect();
        let sum = format!(
            "@group(1) @binding(0) var deep: {texture};
            @fragment fn fragment_main() -> @location(0) vec4f {{
                return vec4f({}, 0.0, 0.0, 1.0);
            }}",
            terms.join(" + ")
        );
        let value =
            "@fragment fn fragment_main() -> @location(0) vec4f { return vec4f(#{VALUE}.0); }";
        let found = Bench::new(&body, &[("value", value), ("sum", &sum)]).result((2, 2));
        let expected = (0..layers)
            .map(|layer| 10_f32.powi(layer as i32))
            .sum::<f32>();
        assert_eq!(found, [expected; 4], "{kind}");
    }
}

#[test]
fn a_clear_pass_fills_all_mips_and_layers() {
    let body = "
        p.target(\"deep\", \"r32float\").size(4, 4).array(2).mips();
        p.target(\"result\", \"r32float\").size(1, 1);
        p.clear(\"fill\").writes(\"deep\").clear(42, 0, 0, 0);
        p.copy_slice(\"take\", \"deep\", 2, 1, \"result\", 0, 0);";
    assert_eq!(Bench::new(body, &[]).result((9, 9)), [42.0]);
}

#[test]
fn targets_share_textures_and_unused_passes_do_not_run() {
    let body = "
        p.target(\"a\", \"r32float\");
        p.target(\"b\", \"r32float\");
        p.target(\"c\", \"r32float\");
        p.target(\"result\", \"r32float\");
        p.target(\"nowhere\", \"r32float\");
        p.fullscreen(\"draw\").shader(\"shaders/pattern.wgsl\").writes(\"a\");
        p.fullscreen(\"lost\").shader(\"shaders/pattern.wgsl\").writes(\"nowhere\");
        p.fullscreen(\"one\").shader(\"shaders/add.wgsl\").reads(\"a\", \"from\").writes(\"b\");
        p.fullscreen(\"two\").shader(\"shaders/add.wgsl\").reads(\"b\", \"from\").writes(\"c\");
        p.fullscreen(\"three\").shader(\"shaders/add.wgsl\").reads(\"c\", \"from\").writes(\"result\");";
    let add = "@group(1) @binding(0) var from: texture_2d<f32>;
        @fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            return vec4f(textureLoad(from, vec2u(pixel.xy), 0).r + 1.0, 0.0, 0.0, 1.0);
        }";
    let add = &add.replace("from", "source");
    let body = &body.replace("\"from\"", "\"source\"");
    let mut bench = Bench::new(body, &[("add", add)]);
    let mut pipeline = bench.pipeline();
    let size = (16, 9);
    let (kept, _) = bench.draw(&mut pipeline, size);
    assert_eq!(kept[17], pattern(1, 1) + 3.0);
    let alone = pipeline.targets().unwrap().bytes();
    assert_eq!(pipeline.targets().unwrap().saved_bytes, 0);
    let dropped: Vec<_> = pipeline.lives().dropped(&pipeline.desc).collect();
    assert_eq!(dropped, ["lost"]);

    pipeline.keep_all_targets(false);
    let (world, assets) = (&mut bench.scene.world, &bench.scene.assets);
    let view = View::default();
    bench
        .renderer
        .render(world, assets, &mut pipeline, &view, size, 0.0)
        .unwrap();
    // `a` is dead when `c` begins, and `b` when `result` does.
    let targets = pipeline.targets().unwrap();
    let texture = 16 * 9 * 4;
    assert_eq!(targets.saved_bytes, 2 * texture);
    assert_eq!(targets.bytes(), alone - 2 * texture);
    let shared = bench.renderer.read_target(&pipeline, "result").unwrap();
    let shared: Vec<f32> = shared.texels.iter().map(|texel| texel[0]).collect();
    assert_eq!(shared, kept);
}

#[test]
fn a_format_that_the_adapter_lacks_falls_back_and_says_so() {
    let body = "
        p.target(\"result\", \"rgba32float\").fallback(\"rgba16float\");
        p.fullscreen(\"draw\").shader(\"shaders/pattern.wgsl\")
            .writes(\"result\").clear(0, 0, 0, 0).blend(\"add\");";
    let bench = Bench::on(true, body, &[]);
    let pipeline = bench.pipeline();
    assert_eq!(
        pipeline.notes,
        ["`result` is rgba16float, since this adapter can't use rgba32float for it"]
    );
    let full = Bench::new(body, &[]).pipeline();
    assert_eq!(full.notes, [] as [&str; 0]);
}

#[test]
fn a_derived_pipeline_changes_another() {
    let base = "p.target(\"result\", \"r32float\");
        p.fullscreen(\"draw\").shader(\"shaders/pattern.wgsl\").writes(\"result\");
        p.fullscreen(\"spoil\").shader(\"shaders/value.wgsl\").writes(\"result\");";
    let value = "@fragment fn fragment_main() -> @location(0) vec4f { return vec4f(3.0); }";
    let bench = Bench::new(base, &[("value", value)]);
    bench.workshop.write(
        "scripts/pipelines/derived.rhai",
        "import \"test\" as base;
        let p = derive(\"Derived\");
        p.remove_pass(\"spoil\");
        p.insert_before(\"show\");
        p.fullscreen(\"add\").shader(\"shaders/value.wgsl\").writes(\"result\").blend(\"add\");
        p.insert_last();
        p",
    );
    let desc = load_pipeline(&bench.workshop.files, "derived", &Settings::new());
    let desc = desc.unwrap_or_else(|problems| panic!("{problems}"));
    let passes: Vec<&str> = desc.passes.iter().map(|pass| pass.name.as_str()).collect();
    assert_eq!(passes, ["draw", "add", "show"]);
    assert_eq!(
        (desc.name.as_str(), desc.title.as_str()),
        ("derived", "Derived")
    );
}

/// Adds 1 where the surface lies inside the light's range.
const INSIDE: &str = "#import lightbench::scene
@group(1) @binding(0) var depth: texture_depth_2d;
@fragment fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) index: u32,
) -> @location(0) vec4f {
    let resolution = vec2f(textureDimensions(depth));
    let texel_depth = textureLoad(depth, vec2u(pixel.xy), 0);
    let position = scene::position_from_depth(pixel.xy, resolution, texel_depth);
    let light = scene::lights[index];
    return vec4f(select(0.0, 1.0, distance(position, light.position) < light.range));
}";

/// Draws depth, then each bounded light where it is.
fn lights_body(more: &str) -> String {
    format!(
        "p.target(\"depth\", \"depth32float\");
        p.target(\"result\", \"rgba16float\");
        p.geometry(\"prepass\").depth(\"depth\").clear(0.0);
        p.lights(\"lights\").shader(\"shaders/inside.wgsl\").bounded_only(true){more}
            .reads(\"depth\").writes(\"result\").clear(0, 0, 0, 0).blend(\"add\")
            .depth(\"depth\").read_only();"
    )
}

#[test]
fn no_channel_of_the_arrays_holds_two_lights() {
    let size = (160, 90);
    let all = Bench::new(&lights_body(""), &[("inside", INSIDE)]).lit(size);
    let spread = lights_body(".arrays(4)");
    let spread = Bench::new(&spread, &[("inside", INSIDE)]).lit(size);
    assert!(
        all.iter().any(|texel| texel[0] >= 2.0),
        "the lights overlap"
    );
    for (all, channels) in all.iter().zip(&spread) {
        assert!(channels.iter().all(|&count| count <= 1.0), "{channels:?}");
        assert_eq!(channels.iter().sum::<f32>(), all[0], "no light is lost");
    }
}

#[test]
fn any_depth_covers_what_lies_before_and_behind_the_surface() {
    // Without reading depth: 1 for every light whose volume covers the pixel.
    let covers = "@fragment fn fragment_main(
            @location(0) @interpolate(flat) index: u32,
        ) -> @location(0) vec4f { return vec4f(f32(min(index, 0u)) + 1.0); }";
    let body = |more: &str| lights_body(more).replace(".reads(\"depth\")", "");
    let size = (160, 90);
    let draw = |more: &str| Bench::new(&body(more), &[("inside", covers)]).lit(size);
    let (tested, any) = (draw(""), draw(".any_depth(true)"));
    // What the surface hides or ends is covered too; nothing that was covered is lost.
    assert!(
        tested
            .iter()
            .zip(&any)
            .all(|(tested, any)| any[0] >= tested[0])
    );
    let sum = |texels: &[[f32; 4]]| texels.iter().map(|texel| texel[0]).sum::<f32>();
    assert!(
        sum(&any) > 1.05 * sum(&tested),
        "{} {}",
        sum(&any),
        sum(&tested)
    );
}
