//! Paths find the light that closed forms say is there, whichever way they look for it.
//!
//! Random numbers are the same in every run, so that a test that passes goes on passing. Its bound is
//! four standard errors, which a tracer without a fault exceeds once in 16,000 tries.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench::assets::Reflection;
use lightbench::assets::files::Files;
use lightbench::lab::reference::brdf::energy::{albedo, direction};
use lightbench::lab::reference::lighting::specular_lobe;
use lightbench::lab::tracer::{Mode, Options, Sources, Strategy};
use lightbench_tests::settings;
use lightbench_tests::tracing::{Set, form_factor};

const DEVIATIONS: f64 = 4.0;
const STRATEGIES: [Strategy; 3] = [Strategy::Both, Strategy::Aim, Strategy::Scatter];

fn options(samples: u32) -> Options {
    Options {
        size: (16, 16),
        samples,
        ..Options::default()
    }
}

// --- Furnaces --------------------------------------------------------------------------------------

/// A white convex thing under an even sky can't be seen.
#[test]
fn a_white_cube_vanishes_in_an_even_sky() {
    let set = Set::of(
        "spawn(\"cube\").mesh(box(1, 1, 1)).turn(20, 30, 0)
             .material(material(\"white\").color(1, 1, 1).specular(0));
         ambient_light(\"sky\").intensity(1);
         camera(\"eye\").at(0, 0.5, 3).look_at(0, 0, 0).fov(30);",
    );
    for strategy in STRATEGIES {
        let found = set.estimate(&Options {
            strategy,
            ..options(64)
        });
        println!("{strategy:?}: {found:?}");
        assert!(
            found.deviations(1.0).abs() < DEVIATIONS,
            "{strategy:?}: {found:?}"
        );
    }
    // Chosen by the cosine, each path carries exactly the sky's light.
    let scattered = set.trace(&Options {
        strategy: Strategy::Scatter,
        ..options(4)
    });
    for pixel in &scattered.picture.pixels {
        assert!((pixel[0] - 1.0).abs() < 1e-5, "{pixel:?}");
    }
}

/// In a closed box that emits and reflects evenly, light adds up to Le (1 + ρ + ρ² + …).
#[test]
fn light_adds_up_in_a_closed_box() {
    let set = Set::of(
        "spawn(\"box\").mesh(box(3, 2, 4)).material(material(\"glow\")
             .color(0.5, 0.5, 0.5).specular(0).emissive(1, 1, 1).two_sided());
         camera(\"eye\").at(0.3, 0.2, 1).look_at(-1, -0.5, -1).fov(90).near(0.01);",
    );
    // Aiming alone is of no use here: in a corner the walls that it aims at are infinitely bright.
    for strategy in [Strategy::Both, Strategy::Scatter] {
        for (depth, expected) in [
            (Some(0), 1.0),
            (Some(1), 1.5),
            (Some(2), 1.75),
            (Some(5), 2.0 - 0.5_f64.powi(5)),
            (None, 2.0),
        ] {
            let found = set.estimate(&Options {
                strategy,
                depth,
                ..options(256)
            });
            let off = found.deviations(expected);
            println!("{strategy:?} {depth:?}: {found:?} off {off:.2}");
            assert!(off.abs() < DEVIATIONS, "{strategy:?} {depth:?}: {found:?}");
            assert!(
                found.error < 0.01 * expected,
                "{found:?} is too noisy to tell"
            );
        }
    }
    // Must-fail twin: two per cent would be noticed.
    let found = set.estimate(&options(256));
    assert!(found.deviations(2.04).abs() > 2.0 * DEVIATIONS, "{found:?}");
}

/// Under an even sky a floor shows its albedo, which quadrature finds too.
#[test]
fn every_reflection_model_shows_its_albedo_under_an_even_sky() {
    let models = [
        ("power(30)", Reflection::BlinnPhong { power: 30.0 }),
        ("phong(8)", Reflection::Phong { power: 8.0 }),
        ("beckmann(0.3)", Reflection::Beckmann { roughness: 0.3 }),
        ("ggx(0.25)", Reflection::Ggx { roughness: 0.25 }),
        (
            "ward(0.4, 0.4)",
            Reflection::Ward {
                along: 0.4,
                across: 0.4,
            },
        ),
    ];
    for (call, reflection) in models {
        let degrees = 55.0;
        let to_viewer = direction(degrees);
        let (base, specular) = (0.3, 0.5);
        let lobe = specular_lobe(reflection, specular);
        let expected = base + albedo(|_, out| lobe(out, to_viewer), to_viewer, 600);
        let script = format!(
            "spawn(\"floor\").mesh(plane(50, 50)).material(material(\"m\").color({base}, {base}, {base})
                 .specular({specular}).{call});
             ambient_light(\"sky\").intensity(1);"
        );
        let from = DVec3::new(to_viewer.x, to_viewer.z, to_viewer.y) * 3.0;
        let set = Set::of(&script).seen_at(DVec3::new(0.2, 0.0, 0.3), from);
        for strategy in STRATEGIES {
            let found = set.estimate(&Options {
                strategy,
                ..options(1024)
            });
            let off = found.deviations(expected);
            println!("{call} {strategy:?}: {found:?} instead of {expected} off {off:.2}");
            assert!(
                off.abs() < DEVIATIONS,
                "{call} {strategy:?}: {found:?}, not {expected}"
            );
        }
    }
}

// --- Closed forms ----------------------------------------------------------------------------------

/// A matt floor seen from the side at the origin, below something.
fn floor_below(above: &str) -> Set {
    let script = format!(
        "spawn(\"floor\").mesh(plane(40, 40)).material(material(\"matt\").color(0.5, 0.5, 0.5)
             .specular(0));\n{above}"
    );
    Set::of(&script).seen_at(DVec3::ZERO, DVec3::new(2.0, 0.5, 1.0))
}

#[test]
fn a_point_light_lights_a_floor_by_the_inverse_square_and_the_cosine() {
    let set = floor_below("point_light(\"lamp\").at(0.8, 1.5, -0.4).intensity(7).range(20);");
    let offset = DVec3::new(0.8, 1.5, -0.4);
    let squared = offset.length_squared();
    let window = (1.0 - (squared / 400.0).powi(2)).powi(2);
    let irradiance = 7.0 * offset.normalize().y / squared * window;
    let expected = 0.5 / std::f64::consts::PI * irradiance;
    for mode in [Mode::Direct, Mode::Shadowed, Mode::Full] {
        let found = set.estimate(&Options {
            mode,
            depth: Some(1),
            ..options(4)
        });
        // The pixels are a hair apart.
        assert!(
            (found.mean / expected - 1.0).abs() < 1e-4,
            "{mode:?}: {found:?}, not {expected}"
        );
    }
}

#[test]
fn a_shining_rectangle_lights_the_floor_by_its_form_factor() {
    // Above the floor, facing down, 1.2 by 0.8, 0.7 up.
    let set = floor_below(
        "spawn(\"lamp\").mesh(faces([[vec3(-0.6, 0.7, -0.4), vec3(0.6, 0.7, -0.4),
             vec3(0.6, 0.7, 0.4), vec3(-0.6, 0.7, 0.4)]]))
             .material(material(\"glow\").color(0, 0, 0).specular(0).emissive(3, 3, 3));",
    );
    let expected = 0.5 * 3.0 * form_factor([0.6, 0.4], 0.7);
    let found = STRATEGIES.map(|strategy| {
        let found = set.estimate(&Options {
            strategy,
            ..options(1024)
        });
        println!(
            "{strategy:?}: {found:?}, off {:.2}",
            found.deviations(expected)
        );
        assert!(
            found.deviations(expected).abs() < DEVIATIONS,
            "{strategy:?}: {found:?}"
        );
        found
    });
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let apart = found[a].apart(&found[b]);
        assert!(
            apart.abs() < DEVIATIONS,
            "{:?} and {:?}",
            found[a],
            found[b]
        );
    }
    // A tenth of a per cent is what the best of them can tell.
    assert!(found[0].error < 1e-3 * expected, "{:?}", found[0]);
    // Turned round, it shines upwards and lights nothing.
    let up = floor_below(
        "spawn(\"lamp\").mesh(faces([[vec3(-0.6, 0.7, 0.4), vec3(0.6, 0.7, 0.4),
             vec3(0.6, 0.7, -0.4), vec3(-0.6, 0.7, -0.4)]]))
             .material(material(\"glow\").color(0, 0, 0).specular(0).emissive(3, 3, 3));",
    );
    for strategy in STRATEGIES {
        let found = up.estimate(&Options {
            strategy,
            ..options(64)
        });
        assert_eq!(found.mean, 0.0, "{strategy:?}");
    }
}

/// A rectangle overhead and the sky around it: what one covers the other does not light.
#[test]
fn sky_and_surfaces_share_the_hemisphere() {
    let set = floor_below(
        "spawn(\"lamp\").mesh(faces([[vec3(-0.6, 0.7, -0.4), vec3(0.6, 0.7, -0.4),
             vec3(0.6, 0.7, 0.4), vec3(-0.6, 0.7, 0.4)]]))
             .material(material(\"glow\").color(0, 0, 0).specular(0).emissive(3, 3, 3));
         ambient_light(\"sky\").intensity(0.7);",
    );
    let covered = form_factor([0.6, 0.4], 0.7);
    let only = |surfaces, sky| Sources {
        lights: false,
        surfaces,
        sky,
    };
    for (sources, expected) in [
        (
            only(true, true),
            0.5 * (3.0 * covered + 0.7 * (1.0 - covered)),
        ),
        (only(true, false), 0.5 * 3.0 * covered),
        (only(false, true), 0.5 * 0.7 * (1.0 - covered)),
        (Sources::NONE, 0.0),
    ] {
        for strategy in STRATEGIES {
            let found = set.estimate(&Options {
                strategy,
                sources,
                depth: Some(1),
                ..options(512)
            });
            let off = found.deviations(expected);
            println!("{sources:?} {strategy:?}: {found:?} off {off:.2}");
            assert!(
                off.abs() < DEVIATIONS,
                "{sources:?} {strategy:?}: {found:?}, not {expected}"
            );
        }
    }
}

// --- What light meets on its way -------------------------------------------------------------------

/// The light of one lamp on the floor with something in between, relative to that without it.
fn share_behind(thing: &str, mode: Mode) -> f64 {
    let lamp = "point_light(\"lamp\").at(0, 2, 0).intensity(7).range(20);";
    let light = |scene: &str| {
        let set = floor_below(scene);
        let found = set.estimate(&Options {
            mode,
            depth: Some(1),
            ..options(16)
        });
        found.mean
    };
    light(&format!("{thing}\n{lamp}")) / light(lamp)
}

#[test]
fn lamps_cast_shadows_but_not_behind_their_own_glass() {
    let pane = |material: &str| {
        format!(
            "spawn(\"pane\").mesh(plane(1, 1)).at(0, 1.2, 0).material(material(\"pane\")
                 .color(0, 0, 0).specular(0){material});"
        )
    };
    for mode in [Mode::Shadowed, Mode::Full] {
        // From whichever side the light comes.
        for turned in ["", ".turn(180, 0, 0)"] {
            let share = |material: &str| {
                let pane = pane(material).replace(".material(", &format!("{turned}.material("));
                share_behind(&pane, mode)
            };
            assert_eq!(share(""), 0.0, "{mode:?} {turned}");
            assert_eq!(share(".two_sided()"), 0.0, "{mode:?} {turned}");
            let thin = share(".opacity(0.3)");
            assert!((thin - 0.7).abs() < 1e-5, "{mode:?} {turned}: {thin}");
        }
    }
    // A globe that shines stands around its lamp; with paths of one reflection it adds its own light.
    let globe = "spawn(\"globe\").mesh(sphere(0.2)).at(0, 2, 0).material(material(\"glow\")
        .color(0, 0, 0).specular(0).emissive(1e-9, 1e-9, 1e-9));";
    for mode in [Mode::Shadowed, Mode::Full] {
        let share = share_behind(globe, mode);
        assert!((share - 1.0).abs() < 1e-5, "{mode:?}: {share}");
    }
    // Direct light knows no shadow.
    assert_eq!(share_behind(&pane(""), Mode::Direct), 1.0);
}

/// A red wall tints the floor beside it, and only paths of two reflections show it.
#[test]
fn colours_bleed_with_the_second_reflection() {
    let set = Set::of(
        "let white = material(\"white\").color(0.7, 0.7, 0.7).specular(0);
         let red = material(\"red\").color(0.7, 0.05, 0.05).specular(0);
         spawn(\"floor\").mesh(plane(4, 4)).material(white);
         spawn(\"wall\").mesh(plane(4, 4)).material(red).at(-1, 1, 0).turn(0, 0, -90);
         point_light(\"lamp\").at(1, 2, 0).intensity(5).range(30);
         camera(\"eye\").at(0, 3, 0.01).look_at(-0.7, 0, 0).fov(5);",
    );
    let redness = |depth| {
        let traced = set.trace(&Options {
            depth: Some(depth),
            ..options(256)
        });
        let sum = |channel: usize| -> f64 {
            let pixels = traced.picture.pixels.iter();
            pixels.map(|pixel| f64::from(pixel[channel])).sum()
        };
        sum(0) / sum(1)
    };
    assert!((redness(1) - 1.0).abs() < 1e-6, "{}", redness(1));
    assert!(redness(2) > 1.1, "{}", redness(2));
}

// --- Noise -----------------------------------------------------------------------------------------

fn cornell() -> Set {
    Set::load(
        &Files::shipped(),
        "cornell_box",
        &settings(&["bounces=false"]),
    )
}

/// The ways to find light differ by what their variances allow, over the whole picture and over each of
/// its parts.
#[test]
fn all_ways_agree_on_the_cornell_box() {
    let set = cornell();
    let traced = STRATEGIES.map(|strategy| {
        let traced = set.trace(&Options {
            strategy,
            sources: Sources {
                lights: false,
                sky: false,
                surfaces: true,
            },
            seed: strategy as u64,
            ..options(4096)
        });
        // Sums over 4 by 4 pixels, which chance alone meets often enough to know their variance.
        let mut blocks = [(0.0, 0.0); 16];
        let pixels = traced.picture.pixels.iter().zip(&traced.variance.pixels);
        for (index, (value, variance)) in pixels.enumerate() {
            let block = &mut blocks[index / 64 * 4 + index % 16 / 4];
            block.0 += f64::from(value[1]);
            block.1 += f64::from(variance[1]);
        }
        blocks
    });
    let noise = traced.map(|blocks| blocks.iter().map(|block| block.1).sum::<f64>());
    println!("noise {noise:?}");
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let mut sum = (0.0, 0.0);
        for (one, other) in traced[a].iter().zip(&traced[b]) {
            let (apart, variance) = (one.0 - other.0, one.1 + other.1);
            let z = apart / variance.sqrt().max(1e-12);
            println!("{a} {b}: {z:.2}");
            assert!(z.abs() < DEVIATIONS, "{a} {b}: {z}");
            sum = (sum.0 + apart, sum.1 + variance);
        }
        let z = sum.0 / sum.1.sqrt();
        println!("{a} {b} all: {z:.2}");
        assert!(z.abs() < DEVIATIONS, "{a} {b}: {z}");
    }
    // Weighing both leaves less noise than either alone, or hardly more.
    assert!(
        noise[0] < 0.6 * noise[2] && noise[0] < 1.05 * noise[1],
        "{noise:?}"
    );
}

/// The stated variance is that of many pictures, and falls with the number of samples.
#[test]
fn variances_are_those_of_repeated_pictures() {
    let set = cornell();
    let many = |samples, seed| {
        set.trace(&Options {
            size: (8, 8),
            samples,
            seed,
            depth: Some(3),
            ..Options::default()
        })
    };
    let pictures: Vec<_> = (0..64).map(|seed| many(16, seed)).collect();
    let (mut measured, mut stated) = (0.0, 0.0);
    for pixel in 0..64 {
        let values: Vec<f64> = pictures
            .iter()
            .map(|traced| f64::from(traced.picture.pixels[pixel][0]))
            .collect();
        let mean = values.iter().sum::<f64>() / 64.0;
        measured += values
            .iter()
            .map(|value| (value - mean).powi(2))
            .sum::<f64>()
            / 63.0;
        let variances = pictures
            .iter()
            .map(|traced| f64::from(traced.variance.pixels[pixel][0]));
        stated += variances.sum::<f64>() / 64.0;
    }
    let ratio = measured / stated;
    println!("{ratio}");
    assert!((0.85..1.18).contains(&ratio), "{ratio}");
    let total = |samples| {
        let traced = many(samples, 99);
        let variances = traced.variance.pixels.iter();
        variances
            .map(|variance| f64::from(variance[0]))
            .sum::<f64>()
    };
    let fall = total(256) / total(1024);
    assert!((3.2..5.0).contains(&fall), "{fall}");
}

#[test]
fn threads_change_nothing_and_seeds_change_the_noise() {
    let set = Set::load(&Files::shipped(), "atrium", &settings(&[]));
    let options = Options {
        size: (40, 23),
        samples: 3,
        ..Options::default()
    };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| set.trace(&options))
    };
    let first = on(1);
    assert_eq!(first.unusable, 0);
    for threads in [2, 5] {
        assert_eq!(on(threads), first, "{threads} threads");
    }
    let other = set.trace(&Options { seed: 1, ..options });
    assert_ne!(other.picture, first.picture);
}
