//! Deferred shading: depth gives positions back, volumes light just what lies in a light's range
//! wherever the camera is, and stencil saves the fragments that lie outside.
#![allow(clippy::unwrap_used)]

use glam::{DVec3, Vec3};
use lightbench::assets::files::Files;
use lightbench::render::View;
use lightbench::render::volumes::SPHERE_BOUND;
use lightbench_tests::flat::{Paint, Rectangle, Seen, script, seen};
use lightbench_tests::pixels::{Pixels, depth_inside};
use lightbench_tests::{Mistake, Studio, Workshop, project, project_with_mistake, settings};

const FULL: &str = "accumulation=rgba32float";

// --- Position from depth ---------------------------------------------------------------------------

const WIDE: (u32, u32) = (160, 90);
/// Panels from the near to the far plane, each eight pixels wide.
const PANELS: usize = 20;
const EYE: DVec3 = DVec3::new(3.0, -2.0, 5.0);
const FOV: f64 = 60.0;

/// What is at a share of the picture's width, from the left: how far to the side for each metre ahead.
fn slope(share: f64) -> f64 {
    let aspect = f64::from(WIDE.0) / f64::from(WIDE.1);
    (share * 2.0 - 1.0) * (FOV.to_radians() * 0.5).tan() * aspect
}

/// The distance at which a panel begins, and the one before it ends.
fn begin(panel: usize, [near, far]: [f64; 2]) -> f64 {
    let (near, far) = (near * 1.001, far * 0.999);
    near * (far / near).powf(panel as f64 / PANELS as f64)
}

/// Panels side by side that fill the picture. Each leads from the distance at which the one on its left
/// ends to the next, the last one to the far plane.
fn panels(planes: [f64; 2]) -> String {
    let mut scene = format!(
        "camera(\"eye\").at({:?}, {:?}, {:?}).look_at({:?}, {:?}, {:?}).fov({FOV:?}).near({:?}).far({:?});",
        EYE.x,
        EYE.y,
        EYE.z,
        EYE.x,
        EYE.y,
        EYE.z - 1.0,
        planes[0],
        planes[1],
    );
    for panel in 0..PANELS {
        let corner = |edge: usize, upward: f64| {
            let ahead = begin(edge, planes);
            let side = slope(edge as f64 / PANELS as f64) * ahead;
            let at = EYE + DVec3::new(side, upward * ahead, -ahead);
            format!("vec3({:?}, {:?}, {:?})", at.x, at.y, at.z)
        };
        scene += &format!(
            "spawn().mesh(faces([[{}, {}, {}, {}]])).material(material(\"two-sided\").two_sided());",
            corner(panel, -1.0),
            corner(panel + 1, -1.0),
            corner(panel + 1, 1.0),
            corner(panel, 1.0),
        );
    }
    scene
}

/// Where the line of sight of a pixel meets its panel.
fn on_panel(x: u32, y: u32, planes: [f64; 2]) -> DVec3 {
    let panel = x as usize / (WIDE.0 as usize / PANELS);
    let side = slope((f64::from(x) + 0.5) / f64::from(WIDE.0));
    let upward =
        (1.0 - (f64::from(y) + 0.5) / f64::from(WIDE.1) * 2.0) * (FOV.to_radians() * 0.5).tan();
    let [(a_side, a), (b_side, b)] = [panel, panel + 1].map(|edge| {
        let ahead = begin(edge, planes);
        (slope(edge as f64 / PANELS as f64) * ahead, ahead)
    });
    // a_side + t (b_side - a_side) = side (a + t (b - a))
    let t = (side * a - a_side) / (b_side - a_side - side * (b - a));
    let ahead = a + t * (b - a);
    EYE + DVec3::new(side * ahead, upward * ahead, -ahead)
}

const FIND: &str = "#import lightbench::scene
@group(1) @binding(0) var depth: texture_depth_2d;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let reversed = textureLoad(depth, vec2u(pixel.xy), 0);
    let resolution = vec2f(textureDimensions(depth));
    return vec4f(scene::position_from_depth(pixel.xy, resolution, reversed), reversed);
}";

/// How far positions from depth are off at most: as a share of the far plane's distance, and of their
/// own.
fn off_the_panels(files: &Workshop, planes: [f64; 2], format: &str) -> (f64, f64) {
    files.write("scripts/scenes/panels.rhai", &panels(planes));
    let body = format!(
        "p.target(\"depth\", \"{format}\");
        p.target(\"result\", \"rgba32float\");
        p.geometry(\"draw\").shader(\"shaders/forward/depth_only.wgsl\").depth(\"depth\").clear(0.0);
        p.fullscreen(\"find\").shader(\"shaders/find.wgsl\").reads(\"depth\").writes(\"result\");"
    );
    files.pipeline(&body, &[("find", FIND)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files.files.clone(), "panels");
    let (pipeline, _) = studio.draw_whole("test", &settings(&[]), WIDE);
    let found = studio.renderer.read_target(&pipeline, "result").unwrap();
    let (mut of_far, mut of_own) = (0.0_f64, 0.0_f64);
    for (index, [x, y, z, reversed]) in found.texels.iter().enumerate() {
        assert!(*reversed > 0.0, "{planes:?}: pixel {index} shows no panel");
        let found = DVec3::new(f64::from(*x), f64::from(*y), f64::from(*z));
        let (column, row) = (index as u32 % WIDE.0, index as u32 / WIDE.0);
        let expected = on_panel(column, row, planes);
        let off = found.distance(expected);
        of_far = of_far.max(off / planes[1]);
        of_own = of_own.max(off / expected.distance(EYE));
    }
    println!("{planes:?} {format}: off by {of_far:.1e} of far, {of_own:.1e} of the distance");
    (of_far, of_own)
}

#[test]
fn depth_gives_positions_back_from_the_near_to_the_far_plane() {
    let files = Workshop::new();
    for planes in [[0.1, 24.0], [0.1, 1000.0], [0.5, 100_000.0]] {
        let (of_far, of_own) = off_the_panels(&files, planes, "depth32float");
        assert!(of_far < 1e-3);
        // Reversed depth in floats loses no more far away than near.
        assert!(of_own < 1e-3, "{of_own}");
    }
    // 24 bits in equal steps do near the far plane what they can: far / near / 2²⁵ of it.
    assert!(off_the_panels(&files, [0.1, 1000.0], "depth24plus").0 < 1e-3);
}

/// Must-fail twins.
#[test]
fn half_a_pixel_and_another_depth_are_caught() {
    for (from, to) in [
        ("vec2f(pixel.x / ", "vec2f((pixel.x - 0.5) / "),
        ("vec4f(ndc, depth, 1.0)", "vec4f(ndc, depth * 1.01, 1.0)"),
        ("world.xyz / world.w", "world.xyz"),
    ] {
        let files = Workshop::new();
        let path = "shaders/lib/scene.wgsl";
        let text = Files::shipped().read_text(path).unwrap();
        assert!(text.contains(from), "{path} has no `{from}`");
        files.write(path, &text.replace(from, to));
        let (of_far, _) = off_the_panels(&files, [0.1, 1000.0], "depth32float");
        assert!(of_far > 1e-3, "`{to}` went unnoticed");
    }
}

// --- Volumes of lights -----------------------------------------------------------------------------

const SIZE: (u32, u32) = (240, 135);
const SCHEMES: [&str; 3] = [
    "volume_stencil=off",
    "volume_stencil=two_pass",
    "volume_stencil=inverse",
];
const LAMP: DVec3 = DVec3::new(0.5, 1.8, -10.0);
const RANGE: f64 = 5.0;

const fn wall(corner: DVec3, along: DVec3, up: DVec3) -> Rectangle {
    let paint = Paint {
        color: [0.5; 3],
        specular: 0.0,
        power: 1.0,
        emissive: 0.0,
    };
    Rectangle {
        corner,
        along,
        up,
        paint,
    }
}

/// A corridor, with panels before the lamp, in its light and behind it.
const CORRIDOR: [Rectangle; 8] = [
    wall(
        DVec3::new(-4.0, 0.0, 6.0),
        DVec3::new(8.0, 0.0, 0.0),
        DVec3::new(0.0, 0.0, -36.0),
    ),
    wall(
        DVec3::new(-4.0, 4.0, -30.0),
        DVec3::new(8.0, 0.0, 0.0),
        DVec3::new(0.0, 0.0, 36.0),
    ),
    wall(
        DVec3::new(-4.0, 0.0, 6.0),
        DVec3::new(0.0, 0.0, -36.0),
        DVec3::new(0.0, 4.0, 0.0),
    ),
    wall(
        DVec3::new(4.0, 0.0, -30.0),
        DVec3::new(0.0, 0.0, 36.0),
        DVec3::new(0.0, 4.0, 0.0),
    ),
    wall(
        DVec3::new(-4.0, 0.0, -30.0),
        DVec3::new(8.0, 0.0, 0.0),
        DVec3::new(0.0, 4.0, 0.0),
    ),
    wall(
        DVec3::new(-1.5, 0.5, -4.0),
        DVec3::new(0.8, 0.0, 0.0),
        DVec3::new(0.0, 2.0, 0.0),
    ),
    wall(
        DVec3::new(-2.5, 0.2, -12.0),
        DVec3::new(2.0, 0.0, -1.0),
        DVec3::new(0.0, 2.0, 0.5),
    ),
    wall(
        DVec3::new(1.2, 0.5, -16.5),
        DVec3::new(2.0, 0.0, 0.0),
        DVec3::new(0.0, 2.0, 0.0),
    ),
];

fn corridor() -> Studio {
    let scene = format!(
        "{}point_light(\"lamp\").at({:?}, {:?}, {:?}).range({RANGE:?}).intensity(50);",
        script(&CORRIDOR),
        LAMP.x,
        LAMP.y,
        LAMP.z
    );
    let (_folder, files) = project(&[("scripts/scenes/corridor.rhai", &scene)]);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    studio.show(files, "corridor");
    studio
}

/// Where the camera stands to the light's volume.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Outside,
    Inside,
    /// Outside, but the near plane cuts the volume.
    Near,
    /// Outside, and the far plane cuts the volume.
    Far,
    /// Inside, and the far plane cuts the volume.
    InsideAndFar,
}

const PLACES: [Place; 5] = [
    Place::Outside,
    Place::Inside,
    Place::Near,
    Place::Far,
    Place::InsideAndFar,
];

impl Place {
    fn view(self) -> View {
        let (eye, far) = match self {
            Self::Outside => (Vec3::new(0.0, 2.2, 5.0), 60.0),
            Self::Inside => (Vec3::new(0.3, 1.5, -7.0), 60.0),
            Self::Near => (Vec3::new(0.5, 1.8, -4.95), 60.0),
            Self::Far => (Vec3::new(0.0, 2.2, 5.0), 16.5),
            Self::InsideAndFar => (Vec3::new(0.3, 1.5, -7.0), 6.0),
        };
        View::look_at(eye, eye + Vec3::new(0.05, -0.05, -1.0), 1.0, 0.1, far)
    }
}

/// Pixels that are lit though they should not be or the other way round; and how many are lit.
fn off_the_light(studio: &mut Studio, texts: &[&str]) -> (usize, usize) {
    let texts = settings(&[&[FULL, "threshold=0"], texts].concat());
    let picture = studio.hdr("deferred_shading", &texts, SIZE);
    let pixels = Pixels::of(&studio.renderer);
    let lamp = studio.renderer.lights()[0];
    let (mut wrong, mut bright, mut unsure) = (0, 0, 0);
    for (index, texel) in picture.texels.iter().enumerate() {
        let expected = match seen(&CORRIDOR, &pixels, index) {
            Seen::Sky => Some(false),
            Seen::Edge => None,
            Seen::Surface(_, surface) => {
                let inside = depth_inside(&lamp, surface.position);
                let toward = surface.normal.dot((LAMP - surface.position).normalize());
                let sure = inside.abs() > 1e-4 && toward.abs() > 1e-3;
                sure.then_some(inside > 0.0 && toward > 0.0)
            }
        };
        unsure += usize::from(expected.is_none());
        wrong += usize::from(expected.is_some_and(|lit| lit != (texel[0] > 0.0)));
        bright += usize::from(texel[0] > 0.0);
    }
    assert!(unsure * 50 < pixels.count(), "{unsure} pixels are unsure");
    (wrong, bright)
}

#[test]
fn a_lamp_lights_what_lies_in_its_range_wherever_the_camera_is() {
    let mut studio = corridor();
    for place in PLACES {
        studio.view = place.view();
        for scheme in SCHEMES.into_iter().chain(["light_volumes=off"]) {
            let (wrong, lit) = off_the_light(&mut studio, &[scheme]);
            println!("{place:?} {scheme}: {lit} pixels are lit");
            assert_eq!(wrong, 0, "{place:?} {scheme}");
            assert!(lit > 1000, "{place:?} {scheme}: {lit}");
        }
    }
}

/// Must-fail twins: volumes that are too small, and a range that is cut.
#[test]
fn a_shrunken_volume_and_a_shorter_range_are_caught() {
    let mistakes: [Mistake<'_>; 2] = [
        (
            "shaders/vertex/light_volume.wgsl",
            "vec4f(position, 1.0)",
            "vec4f(0.95 * position, 1.0)",
        ),
        (
            "shaders/lib/lighting.wgsl",
            "distance_squared >= light.range * light.range",
            "distance_squared >= 0.98 * light.range * light.range",
        ),
    ];
    let mut studio = corridor();
    studio.view = Place::Outside.view();
    for mistake in mistakes {
        let (_folder, files) = project_with_mistake(&[], mistake);
        studio.files = files;
        for scheme in SCHEMES {
            let (wrong, _) = off_the_light(&mut studio, &[scheme]);
            assert!(
                wrong > 50,
                "`{}` went unnoticed with {scheme}: {wrong}",
                mistake.2
            );
        }
    }
}

// --- Fragments -------------------------------------------------------------------------------------

/// How many pixels a light is evaluated for; and of these, how many more than lie in its volume, and
/// how many fewer than lie in its range.
fn evaluated(studio: &mut Studio, texts: &[&str]) -> (usize, usize, usize) {
    let texts = settings(&[texts, &["heat_map=lights_evaluated"]].concat());
    let counts = studio.hdr("deferred_shading", &texts, SIZE);
    let pixels = Pixels::of(&studio.renderer);
    let lamp = studio.renderer.lights()[0];
    let (mut all, mut in_vain, mut missed) = (0, 0, 0);
    for (index, texel) in counts.texels.iter().enumerate() {
        let found = texel[0] > 0.0;
        all += usize::from(found);
        if let Seen::Surface(_, surface) = seen(&CORRIDOR, &pixels, index) {
            let inside = depth_inside(&lamp, surface.position);
            in_vain += usize::from(found && inside < 1.0 - f64::from(SPHERE_BOUND));
            missed += usize::from(!found && inside > 1e-4);
        }
    }
    (all, in_vain, missed)
}

#[test]
fn stencil_shades_fewer_fragments_and_only_those_inside() {
    let mut studio = corridor();
    for place in PLACES {
        studio.view = place.view();
        let [off, two_pass, inverse] =
            SCHEMES.map(|scheme| evaluated(&mut studio, &[scheme, "threshold=0"]));
        println!("{place:?}: off {off:?}, two-pass {two_pass:?}, inverse {inverse:?}");
        assert_eq!([off.2, two_pass.2, inverse.2], [0; 3], "{place:?}");
        if place == Place::Outside {
            assert!(off.1 > 1000);
            assert_eq!((two_pass.1, inverse.1), (0, 0));
            assert_eq!(two_pass.0, inverse.0);
            assert!(two_pass.0 < off.0);
        } else {
            assert!(two_pass.0 <= off.0 && inverse.0 <= off.0);
        }
    }
}

/// A light takes two passes where 2 atan(r / d) is more than the threshold's share of the view.
#[test]
fn lights_that_look_small_do_without_stencil() {
    let mut studio = corridor();
    studio.view = Place::Outside.view();
    let away = studio.view.position().as_dvec3().distance(LAMP);
    let share = 2.0 * (RANGE / away).atan() / f64::from(studio.view.fov_y);
    for scheme in &SCHEMES[1..] {
        let mut with =
            |threshold: f64| evaluated(&mut studio, &[scheme, &format!("threshold={threshold}")]).0;
        let (marked, unmarked) = (with(0.0), with(4.0));
        assert!(marked < unmarked);
        assert_eq!(with(share * 0.999), marked, "{scheme}");
        assert_eq!(with(share * 1.001), unmarked, "{scheme}");
    }
}
