//! Light indexing: channels hold one light each, and every pixel that lost a light says so.
#![allow(clippy::unwrap_used)]

use lightbench::render::{Pipeline, Renderer, TargetImage};
use lightbench::script::Settings;
use lightbench_tests::pixels::{Pixels, depth_inside};
use lightbench_tests::{Studio, project, project_with_mistake, settings};

const SIZE: (u32, u32) = (320, 180);
const PIPELINES: [&str; 2] = ["light_indexed_forward", "light_indexed_deferred"];
const SPOT: u32 = 1;

// --- What was lost is marked ---------------------------------------------------------------------

/// Lights that reach each pixel, counted here.
struct Exact {
    /// Those that do for certain.
    least: Vec<u32>,
    /// Those that do if rounding has it so.
    most: Vec<u32>,
}

/// How a number of lights is counted.
#[derive(Clone, Copy, PartialEq)]
enum At {
    /// At the surface that the pixel shows.
    Depth,
    /// Anywhere on the line of sight.
    Any,
}

impl Exact {
    fn count(renderer: &Renderer, depth: &TargetImage, at: At) -> Self {
        let pixels = Pixels::of(renderer);
        let mut exact = Self {
            least: Vec::new(),
            most: Vec::new(),
        };
        for (index, texel) in depth.texels.iter().enumerate() {
            let position = pixels.at(index, texel[0]);
            let sight = (pixels.at(index, 0.5) - pixels.eye).normalize();
            let (mut least, mut most) = (0, 0);
            let lights = renderer.lights().iter().filter(|light| light.kind <= SPOT);
            for light in lights {
                let inside = match at {
                    At::Depth => depth_inside(light, position),
                    At::Any => {
                        let away = sight.cross(light.position.as_dvec3() - pixels.eye);
                        1.0 - away.length() / f64::from(light.range)
                    }
                };
                let nothing = at == At::Depth && texel[0] == 0.0;
                least += u32::from(inside > 1e-4 && !nothing);
                most += u32::from(inside > -1e-4 && !nothing);
            }
            exact.least.push(least);
            exact.most.push(most);
        }
        exact
    }

    /// Compares with the pixels that are marked; gives how many are.
    fn check(&self, marked: &TargetImage, capacity: u32, what: &str) -> usize {
        let mut unsure = 0;
        for (index, texel) in marked.texels.iter().enumerate() {
            let (least, most) = (self.least[index], self.most[index]);
            unsure += usize::from((least > capacity) != (most > capacity));
            let right = if texel[0] > 0.0 {
                most > capacity
            } else {
                least <= capacity
            };
            assert!(
                right,
                "{what}, pixel {index}: {least} to {most} lights, marked: {}",
                texel[0]
            );
        }
        let all = marked.texels.len();
        assert!(unsure * 100 < all, "{what}: {unsure} pixels are unsure");
        let found = marked.texels.iter().filter(|texel| texel[0] > 0.0).count();
        println!("{what}: {found} of {all} pixels have more than {capacity}, {unsure} unsure");
        found
    }
}

fn read(studio: &Studio, pipeline: &Pipeline, name: &str) -> TargetImage {
    studio.renderer.read_target(pipeline, name).unwrap()
}

#[test]
fn pixels_are_marked_where_more_lights_reach_them_than_they_have_room_for() {
    for (scene, texts) in [
        ("many_lights", &["lights=64"][..]),
        ("many_lights", &["lights=200"]),
        ("cornell_box", &[]),
        ("hard_cases", &["case=wide_spot"]),
    ] {
        let mut studio = Studio::new(scene, &settings(texts));
        for name in PIPELINES {
            for capacity in [4, 8] {
                let what = format!("{name} on {scene} {texts:?}");
                let room = format!("lights_per_pixel={capacity}");
                let (pipeline, counts) = studio.draw_whole(name, &settings(&[&room]), SIZE);
                let depth = read(&studio, &pipeline, "depth");
                let exact = Exact::count(&studio.renderer, &depth, At::Depth);
                let marked = read(&studio, &pipeline, "over_capacity");
                let found = exact.check(&marked, capacity, &what);
                assert_eq!(counts.of("pixels_over_capacity"), found as u32);
                assert_eq!(counts.of("lights_beyond_numbers"), 0);
            }
        }
    }
}

/// Must-fail twins: one mistake, and pixels are wrong without being marked, or marked without being
/// wrong.
#[test]
fn mistakes_in_numbers_counts_and_reach_are_caught() {
    let full = "accumulation=rgba32float";
    let mut studio = Studio::new("many_lights", &settings(&["lights=90", "range=2"]));
    let forward = studio.hdr("forward_single_pass", &settings(&[full]), SIZE);
    let faults = |studio: &mut Studio| {
        let texts = settings(&[full, "lights_per_pixel=4"]);
        let (pipeline, _) = studio.draw_whole("light_indexed_forward", &texts, SIZE);
        let depth = read(studio, &pipeline, "depth");
        let exact = Exact::count(&studio.renderer, &depth, At::Depth);
        let marked = read(studio, &pipeline, "over_capacity");
        let found = read(studio, &pipeline, "hdr");
        let fault = |index: &usize| {
            let is_marked = marked.texels[*index][0] > 0.0;
            let (expected, found) = (forward.texels[*index], found.texels[*index]);
            let brightest = expected[..3].iter().copied().fold(1e-3, f32::max);
            let wrong = (0..3).any(|c| (expected[c] - found[c]).abs() > 1e-3 * brightest);
            if is_marked {
                exact.most[*index] <= 4
            } else {
                wrong || exact.least[*index] > 4
            }
        };
        (0..marked.texels.len()).filter(fault).count()
    };
    assert_eq!(faults(&mut studio), 0);
    for (path, from, to) in [
        (
            "scripts/pipelines/parts/light_indices.rhai",
            "0.251",
            "0.26",
        ),
        (
            "shaders/lib/index_packing.wgsl",
            "bits.y << 2u",
            "bits.y << 3u",
        ),
        (
            "shaders/lib/culling.wgsl",
            "distance_squared >= light.range",
            "distance_squared >= 0.5 * light.range",
        ),
        (
            "shaders/lib/pixel_lights.wgsl",
            "reaching > found",
            "reaching > found + 1u",
        ),
        (
            "shaders/light_indexed/number_lights.wgsl",
            "& (bit - 1u)",
            "& bit",
        ),
        (
            "shaders/light_indexed/pack_bits.wgsl",
            "out.count = 1.0",
            "out.count = 2.0",
        ),
    ] {
        let (_folder, files) = project_with_mistake(&[], (path, from, to));
        studio.files = files;
        let found = faults(&mut studio);
        println!("`{to}`: {found} pixels");
        assert!(found > 50, "`{to}` went unnoticed");
    }
}

/// A pane of glass before a row of lights, and far behind them a wall that most of them do not
/// reach.
const BEHIND_GLASS: &str = "
let wall = material(\"wall\").color(rgb(0.5, 0.5, 0.5));
spawn(\"wall\").mesh(plane(60, 60)).material(wall).at(0, 0, -30).turn(90, 0, 0);
let glass = material(\"glass\").color(rgb(0.4, 0.5, 0.6)).specular(0.1).power(50).opacity(0.5);
spawn(\"pane\").mesh(plane(4, 8)).material(glass).at(-2.5, 0, 4).turn(90, 0, 0);
for i in 0..12 {
    point_light(\"lamp\").at(-3.2 - 0.6 * i, 0.2 * (i % 3), -1.5 * i).range(1 + 0.1 * i).intensity(2);
}
camera(\"eye\").at(0, 0, 8).look_at(0, 0, 0).fov(40).near(0.1).far(60);
";

#[test]
fn transparent_pixels_are_marked_by_the_lights_along_the_line_of_sight() {
    let (_folder, files) = project(&[("scripts/scenes/behind_glass.rhai", BEHIND_GLASS)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "behind_glass");
    for name in PIPELINES {
        for capacity in [4, 8] {
            let room = format!("lights_per_pixel={capacity}");
            let (pipeline, _) = studio.draw_whole(name, &settings(&[&room]), SIZE);
            let depth = read(&studio, &pipeline, "depth");
            let surface = Exact::count(&studio.renderer, &depth, At::Depth);
            let sight = Exact::count(&studio.renderer, &depth, At::Any);
            // The pane covers the left third of the picture.
            let behind_pane = |index: usize| (index as u32 % SIZE.0) < 100;
            let beside_pane = |index: usize| (index as u32 % SIZE.0) > 220;
            let pick = |of_pane: &[u32], of_wall: &[u32]| -> Vec<u32> {
                (0..of_pane.len())
                    .map(|i| {
                        if behind_pane(i) {
                            of_pane[i]
                        } else {
                            of_wall[i]
                        }
                    })
                    .collect()
            };
            let exact = Exact {
                least: pick(&sight.least, &surface.least),
                most: pick(&sight.most, &surface.most),
            };
            let mut marked = read(&studio, &pipeline, "over_capacity");
            for (index, texel) in marked.texels.iter_mut().enumerate() {
                if !behind_pane(index) && !beside_pane(index) {
                    // The edge of the pane runs somewhere here.
                    texel[0] = if exact.least[index] > capacity {
                        1.0
                    } else {
                        0.0
                    };
                }
            }
            let found = exact.check(&marked, capacity, name);
            assert!(
                found > 0,
                "no line of sight meets more than {capacity} lights"
            );
        }
    }
}

#[test]
fn no_light_is_lost_in_silence() {
    // More lights than numbers, more overlaps than arrays.
    let mut studio = Studio::new("many_lights", &settings(&["lights=400", "range=1.2"]));
    let full = "accumulation=rgba32float";
    let forward = studio.hdr("forward_single_pass", &settings(&[full]), SIZE);
    for packing in ["packing=bits", "packing=arrays"] {
        for room in ["lights_per_pixel=4", "lights_per_pixel=8"] {
            let texts = settings(&[full, packing, room]);
            let (pipeline, counts) = studio.draw_whole("light_indexed_forward", &texts, SIZE);
            assert_eq!(counts.of("numbered_lights"), 255);
            assert!(counts.of("lights_beyond_numbers") > 100);
            let marked = read(&studio, &pipeline, "over_capacity");
            let found = read(&studio, &pipeline, "hdr");
            let mut lost = 0;
            let pixels = forward.texels.iter().zip(&found.texels);
            for (index, (expected, found)) in pixels.enumerate() {
                let brightest = expected[..3].iter().copied().fold(1e-3, f32::max);
                let wrong = (0..3).any(|c| (expected[c] - found[c]).abs() > 1e-3 * brightest);
                lost += usize::from(wrong);
                assert!(
                    !wrong || marked.texels[index][0] > 0.0,
                    "{packing} {room}, pixel {index}: {found:?} instead of {expected:?}"
                );
            }
            println!("{packing} {room}: {lost} pixels lost light, all are marked");
            assert!(lost > 0);
        }
    }
}

#[test]
fn a_channel_holds_one_light_and_it_reaches_the_pixel() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=100", "range=2"]));
    for capacity in [4_usize, 8] {
        let room = format!("lights_per_pixel={capacity}");
        let texts = settings(&["packing=arrays", &room]);
        let (pipeline, counts) = studio.draw_whole("light_indexed_forward", &texts, SIZE);
        assert_eq!(counts.of("lights_beyond_numbers"), 0);
        let depth = read(&studio, &pipeline, "depth");
        let mut channels = vec![read(&studio, &pipeline, "opaque_light_indices")];
        if capacity == 8 {
            channels.push(read(&studio, &pipeline, "opaque_light_indices_more"));
        }
        let renderer = &studio.renderer;
        let pixels = Pixels::of(renderer);
        // In view or not, lights are numbered in the order of their rows; the sky has none.
        let mut of_numbers = vec![None];
        let numbered = counts.of("numbered_lights") as usize;
        let drawn = &renderer.frame().light_lists[0].draws;
        let arrays: Vec<(usize, u32)> = drawn
            .iter()
            .flat_map(|draw| {
                let volumes = draw.volumes.start as usize..draw.volumes.end as usize;
                let volumes = &renderer.frame().volumes[volumes];
                volumes
                    .iter()
                    .map(|volume| (draw.array as usize, volume.light))
            })
            .collect();
        of_numbers.resize(numbered + 1, None);
        for (index, texel) in depth.texels.iter().enumerate() {
            if texel[0] == 0.0 {
                continue;
            }
            let position = pixels.at(index, texel[0]);
            for array in 0..capacity {
                let reaching = arrays
                    .iter()
                    .filter(|(of, _)| *of == array)
                    .filter(|(_, light)| {
                        let light = &renderer.lights()[*light as usize];
                        let away = light.position.as_dvec3().distance(position);
                        away < f64::from(light.range) * 0.9999
                    });
                let reaching: Vec<u32> = reaching.map(|(_, light)| *light).collect();
                assert!(
                    reaching.len() <= 1,
                    "pixel {index}, array {array}: {reaching:?}"
                );
                let number =
                    (channels[array / 4].texels[index][array % 4] * 255.0).round() as usize;
                if let [light] = reaching[..] {
                    assert!(number > 0, "pixel {index} misses light {light}");
                    // A number stands for one light everywhere.
                    let known = of_numbers[number].get_or_insert(light);
                    assert_eq!(*known, light, "number {number}");
                }
            }
        }
        let known = of_numbers.iter().flatten().count();
        assert!(known > 20, "only {known} lights reach a pixel");
        assert!(
            of_numbers.iter().flatten().is_sorted(),
            "numbers follow the order of the lights"
        );
    }
}

// --- Anti-aliasing -------------------------------------------------------------------------------

/// Forward shading with four samples a pixel.
const FORWARD_MSAA: &str = "
let p = pipeline(\"Forward with four samples\");
p.target(\"depth\", \"depth32float\").samples(4);
p.target(\"samples\", \"rgba16float\").samples(4);
p.target(\"hdr\", \"rgba16float\");
p.target(\"output\", \"rgba8unorm\");
p.geometry(\"shade\").shader(\"shaders/forward/single_pass.wgsl\").object_lights(\"all\")
    .writes(\"samples\").clear(0, 0, 0, 0)
    .depth(\"depth\").clear(0.0);
p.fullscreen(\"sky\").shader(\"shaders/sky.wgsl\").writes(\"samples\").depth(\"depth\").read_only();
p.geometry(\"transparent\").shader(\"shaders/forward/single_pass.wgsl\")
    .draws(\"transparent\").order(\"back_to_front\").object_lights(\"all\")
    .writes(\"samples\").blend(\"over\").depth(\"depth\").read_only();
p.resolve(\"resolve\", \"samples\", \"hdr\");
p.fullscreen(\"show\").shader(\"shaders/show.wgsl\").reads(\"hdr\").writes(\"output\");
p.hdr(\"hdr\");
p.show(\"output\");
p";

#[test]
fn four_samples_give_the_picture_of_forward_shading_with_four_samples() {
    let show = "@group(1) @binding(0) var hdr: texture_2d<f32>;
        @fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
            return textureLoad(hdr, vec2u(pixel.xy), 0);
        }";
    for (scene, texts) in [
        ("hard_cases", &["case=panes"][..]),
        ("hard_cases", &["case=wide_spot"]),
        ("many_lights", &["lights=40", "range=1"]),
    ] {
        let mut studio = Studio::new(scene, &settings(texts));
        let msaa = settings(&["antialiasing=msaa"]);
        let (pipeline, counts) = studio.draw_whole("light_indexed_forward", &msaa, SIZE);
        let found = read(&studio, &pipeline, "hdr");
        let texts = settings(&["antialiasing=msaa", "transparency=forward"]);
        let gathered = studio.hdr("light_indexed_forward", &texts, SIZE);
        let marked = read(&studio, &pipeline, "over_capacity");
        let plain = studio.hdr("light_indexed_forward", &Settings::new(), SIZE);
        let (_folder, files) = project(&[
            ("scripts/pipelines/forward_msaa.rhai", FORWARD_MSAA),
            ("shaders/show.wgsl", show),
        ]);
        studio.files = files;
        let expected = studio.hdr("forward_msaa", &Settings::new(), SIZE);
        let mut worst = 0.0_f32;
        let mut smoothed = 0;
        for (index, (a, b)) in expected.texels.iter().zip(&found.texels).enumerate() {
            if marked.texels[index][0] > 0.0 {
                continue;
            }
            smoothed += usize::from((0..3).any(|c| (b[c] - plain.texels[index][c]).abs() > 0.01));
            for b in [b, &gathered.texels[index]] {
                for c in 0..3 {
                    worst = worst.max((a[c] - b[c]).abs() / a[c].abs().max(b[c].abs()).max(1e-3));
                }
            }
        }
        let lost = counts.of("pixels_over_capacity");
        println!("{scene} {texts:?}: {worst:.2e}, {smoothed} pixels smoothed, {lost} masked");
        // Light is added in 32 bits in both, and rounded to 16 once for each sample and their mean.
        assert!(
            worst <= 2.0 * (-10.0_f32).exp2(),
            "{scene} {texts:?}: {worst}"
        );
        assert!(smoothed > 100 && lost * 10 < SIZE.0 * SIZE.1);
    }
}
