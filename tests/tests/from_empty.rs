//! The steps of the chapter "Deferred shading from an empty file" draw what the chapter says.
#![allow(clippy::unwrap_used)]

use glam::{DVec3, DVec4};
use lightbench::assets::files::Files;
use lightbench::lab::reference::{color, normals};
use lightbench::render::TargetImage;
use lightbench::render::gpu_data::LightData;
use lightbench::render::volumes::SPHERE_BOUND;
use lightbench::script::{Settings, load_pipeline};
use lightbench::world::Light;
use lightbench_tests::{Studio, settings};

const SIZE: (u32, u32) = (160, 90);
const FOLDER: &str = "scripts/pipelines/from_empty";

/// What a frame left: its picture, and any target.
struct Frame {
    picture: Vec<u8>,
    targets: Vec<(String, TargetImage)>,
}

impl Frame {
    fn target(&self, name: &str) -> &TargetImage {
        let found = self.targets.iter().find(|(known, _)| known == name);
        &found.unwrap_or_else(|| panic!("no target {name}")).1
    }

    /// How many lights were computed for each pixel: the G-buffer pass left 1 in alpha.
    fn lights(&self) -> Vec<f32> {
        let texels = &self.target("hdr").texels;
        texels
            .iter()
            .map(|texel| (texel[3] - 1.0).max(0.0))
            .collect()
    }
}

/// A scene, and the steps with light kept in 32 bits, so that only the order of additions is left of
/// a difference.
struct Lesson {
    studio: Studio,
    _folder: tempfile::TempDir,
}

impl Lesson {
    fn new(scene: &str, texts: &[&str]) -> Self {
        let mut studio = Studio::new(scene, &settings(texts));
        let folder = tempfile::tempdir().unwrap();
        let shipped = Files::shipped();
        for file in shipped.list(FOLDER, "rhai").unwrap() {
            let text = shipped.read_text(&file.path).unwrap();
            let place = folder.path().join(&file.path);
            std::fs::create_dir_all(place.parent().unwrap()).unwrap();
            std::fs::write(place, text.replace("rgba16float", "rgba32float")).unwrap();
        }
        studio.files = Files::with_project(folder.path()).unwrap();
        Self {
            studio,
            _folder: folder,
        }
    }

    fn path(number: usize) -> String {
        let files = Files::shipped();
        let start = format!("{FOLDER}/{number}_");
        let mut listed = files.list(FOLDER, "rhai").unwrap().into_iter();
        listed.find(|f| f.path.starts_with(&start)).unwrap().path
    }

    fn draw(&mut self, number: usize) -> Frame {
        let studio = &mut self.studio;
        let desc = load_pipeline(&studio.files, &Self::path(number), &Settings::new())
            .unwrap_or_else(|e| panic!("{e}"));
        let mut pipeline = studio
            .renderer
            .compiler()
            .compile(&studio.files, &desc)
            .unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(pipeline.lives().dropped(&pipeline.desc).count(), 0);
        pipeline.keep_all_targets(true);
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        studio
            .renderer
            .render_whole(world, assets, &mut pipeline, &studio.view, SIZE, 0.0)
            .unwrap();
        let read = |name: &String| {
            let image = studio.renderer.read_target(&pipeline, name).unwrap();
            (name.clone(), image)
        };
        Frame {
            picture: studio.renderer.read_output(&pipeline).unwrap().2,
            targets: desc
                .targets
                .iter()
                .map(|target| read(&target.name))
                .collect(),
        }
    }
}

/// The largest difference of two linear pictures, relative to the brighter value and to a
/// thousandth of the brightest of all.
fn difference(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let rgb = |texels: &[[f32; 4]]| -> Vec<f32> {
        let texels = texels.iter().flat_map(|texel| &texel[..3]);
        texels.copied().collect()
    };
    let (a, b) = (rgb(a), rgb(b));
    let floor = a.iter().copied().fold(0.0, f32::max) * 1e-3;
    let pairs = a.iter().zip(&b);
    pairs
        .map(|(a, b)| (a - b).abs() / a.abs().max(b.abs()).max(floor).max(1e-9))
        .fold(0.0, f32::max)
}

/// Additions in another order, in 32 bits, as in agreement.rs.
fn order_bound(lights: usize) -> f32 {
    (lights as f32 + 8.0) * (-23.0_f32).exp2()
}

/// Light as the shaders show it: cut off at 1, sRGB, 8 bits.
fn shown(light: f64) -> f64 {
    color::encode_srgb(light.clamp(0.0, 1.0)) * 255.0
}

#[test]
fn step_1_is_one_colour() {
    let frame = Lesson::new("many_lights", &[]).draw(1);
    // 0.1, 0.2 and 0.4 of 255, rounded.
    assert!(
        frame
            .picture
            .chunks(4)
            .all(|pixel| pixel == [26, 51, 102, 255])
    );
}

#[test]
fn step_2_shows_the_base_colours_that_step_3_keeps() {
    let mut lesson = Lesson::new("many_lights", &[]);
    let (surfaces, kept) = (lesson.draw(2), lesson.draw(3));
    let (depth, albedo) = (kept.target("depth"), kept.target("g_albedo"));
    assert_eq!(surfaces.target("depth").texels, depth.texels);
    let mut covered = 0;
    for (index, pixel) in surfaces.picture.chunks(4).enumerate() {
        if depth.texels[index][0] == 0.0 {
            assert_eq!(pixel, [26, 51, 102, 255], "the background");
            continue;
        }
        covered += 1;
        for (channel, found) in pixel[..3].iter().enumerate() {
            let root = f64::from(albedo.texels[index][channel]);
            // The root is rounded to half a step, against which sRGB has a slope of at most 1.45, and
            // the picture is rounded to half a step once more.
            let expected = shown(root * root);
            let found = f64::from(*found);
            assert!(
                (found - expected).abs() <= 1.3,
                "pixel {index}: {found} and {expected}"
            );
        }
    }
    let all = depth.texels.len();
    assert!(covered * 2 > all && covered < all, "{covered} of {all}");
}

#[test]
fn step_3_shows_the_normals_of_the_g_buffer() {
    let frame = Lesson::new("many_lights", &[]).draw(3);
    let (depth, packed) = (frame.target("depth"), frame.target("g_normal"));
    for (index, pixel) in frame.picture.chunks(4).enumerate() {
        if depth.texels[index][0] == 0.0 {
            assert_eq!(pixel, [0, 0, 0, 255]);
            continue;
        }
        let [x, y, ..] = packed.texels[index];
        let normal = normals::decode_octahedral([x as u16, y as u16]);
        let expected = (normal * 0.5 + 0.5) * 255.0;
        let found = DVec3::from([0, 1, 2].map(|channel| f64::from(pixel[channel])));
        assert!(
            (found - expected).abs().max_element() <= 0.51,
            "pixel {index}: {found} and {expected}"
        );
    }
}

#[test]
fn step_4_is_the_sum_of_the_pictures_of_its_lights() {
    let mut lesson = Lesson::new("many_lights", &["lights=12", "spheres=40", "range=6"]);
    let together = lesson.draw(4);
    let world = lesson.studio.scene.world.clone();
    let lights = world.columns::<Light>().entities().to_vec();
    assert_eq!(lights.len(), 13, "twelve, and the ambient one");
    let mut sum = vec![[0.0_f32; 4]; together.target("hdr").texels.len()];
    let mut lit = 0;
    for light in &lights {
        let mut alone = world.clone();
        for other in lights.iter().filter(|other| *other != light) {
            alone.remove::<Light>(*other);
        }
        lesson.studio.scene.world = alone;
        lesson.studio.renderer.reset_scene();
        let frame = lesson.draw(4);
        let texels = &frame.target("hdr").texels;
        lit += usize::from(
            texels
                .iter()
                .any(|texel| texel[..3].iter().any(|v| *v > 0.01)),
        );
        for (sum, texel) in sum.iter_mut().zip(texels) {
            (0..3).for_each(|channel| sum[channel] += texel[channel]);
        }
    }
    assert!(lit > 8, "only {lit} lights show at all");
    let found = difference(&sum, &together.target("hdr").texels);
    assert!(found <= order_bound(lights.len()), "{found}");
    // The picture is that light, encoded.
    for (texel, pixel) in together
        .target("hdr")
        .texels
        .iter()
        .zip(together.picture.chunks(4))
    {
        for channel in 0..3 {
            let expected = shown(f64::from(texel[channel]));
            assert!((f64::from(pixel[channel]) - expected).abs() <= 0.6);
        }
    }
}

/// Volumes and stencil leave out work, and no light.
#[test]
fn steps_5_and_6_are_the_same_light_for_less_work() {
    for (scene, texts) in [
        ("many_lights", &["lights=64"][..]),
        ("hard_cases", &["case=camera_inside"]),
        ("hard_cases", &["case=near_plane"]),
        ("hard_cases", &["case=far_plane"]),
        ("hard_cases", &["case=wide_spot"]),
    ] {
        let mut lesson = Lesson::new(scene, texts);
        let [all, volumes, stencil] = [4, 5, 6].map(|number| lesson.draw(number));
        let lights = lesson.studio.renderer.lights().len();
        let light = |frame: &Frame| frame.target("hdr").texels.clone();
        for (step, frame) in [(5, &volumes), (6, &stencil)] {
            let found = difference(&light(&all), &light(frame));
            assert!(
                found <= order_bound(lights),
                "{texts:?} step {step}: {found}"
            );
        }
        let counts = [&all, &volumes, &stencil].map(Frame::lights);
        let depth = all.target("depth");
        for (index, texel) in depth.texels.iter().enumerate() {
            let [all, volumes, stencil] = [0, 1, 2].map(|step| counts[step][index]);
            let expected = if texel[0] == 0.0 { 0 } else { lights };
            assert_eq!(all, expected as f32, "{texts:?} pixel {index}");
            assert!(
                stencil <= volumes && volumes <= all,
                "{texts:?} pixel {index}: {all}, {volumes}, {stencil}"
            );
        }
        let sums = counts.map(|counts| counts.iter().sum::<f32>());
        if scene == "many_lights" {
            assert!(sums[1] < sums[0] * 0.2, "volumes: {sums:?}");
            assert!(sums[2] < sums[1] * 0.9, "stencil: {sums:?}");
        }
    }
}

/// The stencil marks what is inside a light's sphere, and nothing else: the number of lights that
/// are computed for a pixel lies between those whose range it is in and those whose sphere, as it is
/// made of triangles, may hold it.
#[test]
fn step_6_computes_the_lights_that_reach_a_pixel() {
    let mut lesson = Lesson::new("many_lights", &["lights=64"]);
    let frame = lesson.draw(6);
    let data = lesson.studio.renderer.frame().data;
    let to_world = (data.projection.as_dmat4() * data.view.as_dmat4()).inverse();
    let lights = lesson.studio.renderer.lights().to_vec();
    let ambient = lights.iter().filter(|light| light.kind == 3).count();
    assert_eq!(ambient, 1);
    let counts = frame.lights();
    let mut tight = 0;
    for (index, texel) in frame.target("g_depth").texels.iter().enumerate() {
        let depth = f64::from(texel[0]);
        if depth == 0.0 {
            continue;
        }
        let (x, y) = (index % SIZE.0 as usize, index / SIZE.0 as usize);
        let across = (x as f64 + 0.5) / f64::from(SIZE.0) * 2.0 - 1.0;
        let down = 1.0 - (y as f64 + 0.5) / f64::from(SIZE.1) * 2.0;
        let position = to_world * DVec4::new(across, down, depth, 1.0);
        let position = position.truncate() / position.w;
        let within = |factor: f32| {
            let reach = |light: &&LightData| {
                light.kind != 3
                    && position.distance(light.position.as_dvec3())
                        <= f64::from(light.range * factor)
            };
            lights.iter().filter(reach).count() + ambient
        };
        let count = counts[index] as usize;
        let (least, most) = (within(0.999), within(SPHERE_BOUND * 1.001));
        assert!(
            (least..=most).contains(&count),
            "pixel {index}: {count} lights, from {least} to {most}"
        );
        tight += usize::from(least == most);
    }
    assert!(tight > 5000, "{tight}");
}

#[test]
fn step_7_is_deferred_shading() {
    for (scene, texts) in [
        ("many_lights", &[][..]),
        ("cornell_box", &[]),
        ("hard_cases", &["case=panes"]),
        ("hard_cases", &["case=camera_inside"]),
        ("hard_cases", &["case=no_objects"]),
    ] {
        let mut lesson = Lesson::new(scene, texts);
        let step = lesson.draw(7);
        let bound = order_bound(lesson.studio.renderer.lights().len());
        for scheme in ["volume_stencil=off", "volume_stencil=two_pass"] {
            let texts = ["accumulation=rgba32float", scheme, "threshold=0"];
            let shipped = lesson
                .studio
                .hdr("deferred_shading", &settings(&texts), SIZE);
            let found = difference(&shipped.texels, &step.target("hdr").texels);
            assert!(found <= bound, "{scene} {scheme}: {found}");
        }
        // The file as it stands, with the same scheme: the same picture, bit for bit.
        let mut studio = Studio::new(scene, &settings(texts));
        let shipped = settings(&["volume_stencil=two_pass", "threshold=0"]);
        let shipped = studio.output("deferred_shading", &shipped, SIZE);
        let step = studio.output(&Lesson::path(7), &settings(&[]), SIZE);
        assert_eq!(shipped, step, "{scene} {texts:?}");
    }
}

/// Must-fail twin: a step whose light is wrong by one mistake is outside the bound.
#[test]
fn a_lost_light_is_noticed() {
    let mut lesson = Lesson::new("many_lights", &["lights=64"]);
    let right = lesson.draw(5);
    let folder = lesson.studio.files.project().unwrap().to_owned();
    let path = "shaders/from_empty/light.wgsl";
    let text = Files::shipped().read_text(path).unwrap();
    let wrong = text.replace("== 0.0 {", "== 0.0 || light == 3u {");
    assert_ne!(text, wrong);
    std::fs::create_dir_all(folder.join("shaders/from_empty")).unwrap();
    std::fs::write(folder.join(path), wrong).unwrap();
    let wrong = lesson.draw(5);
    let found = difference(&right.target("hdr").texels, &wrong.target("hdr").texels);
    assert!(found > order_bound(65) * 100.0, "{found}");
}
