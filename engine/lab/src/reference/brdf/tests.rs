//! Values of the models against published ones and closed forms; energy and reciprocity.

use std::f64::consts::PI;

use glam::DVec3;
use lightbench_assets::Reflection;

use super::energy::{albedo, direction};
use super::*;
use crate::reference::lighting::specular_lobe;

/// The angles at which the shares are tabulated.
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 75.0, 85.0];

fn models(power: f32, roughness: f32) -> [Reflection; 6] {
    [
        Reflection::BlinnPhong { power },
        Reflection::Phong { power },
        Reflection::Beckmann { roughness },
        Reflection::Ggx { roughness },
        Reflection::Ward {
            along: roughness,
            across: roughness,
        },
        Reflection::Ward {
            along: (2.0 * roughness).min(1.0),
            across: (0.5 * roughness).max(0.0263),
        },
    ]
}

/// The integral of a function of the angle from the normal over the hemisphere, by the midpoint rule
/// in the tangent of the angle's half, which serves narrow and wide functions alike.
fn over_hemisphere(f: impl Fn(f64) -> f64) -> f64 {
    let steps = 200_000;
    let sum: f64 = (0..steps)
        .map(|step| {
            let s = (f64::from(step) + 0.5) / f64::from(steps);
            // tan(θ/2) = s², so that cos θ = (1 − s⁴)/(1 + s⁴) and dω = 2π sin θ dθ.
            let fourth = s.powi(4);
            let cosine = (1.0 - fourth) / (1.0 + fourth);
            f(cosine) * 16.0 * PI * s.powi(3) / (1.0 + fourth).powi(2)
        })
        .sum();
    sum / f64::from(steps)
}

#[test]
fn historic_and_normalised_forms_reflect_the_published_shares() {
    let normalised = specular_lobe(Reflection::BlinnPhong { power: 10.0 }, 1.0);
    let quarter = |i, o| historic::cook_torrance(i, o, 0.3) / 4.0;
    let beckmann = specular_lobe(Reflection::Beckmann { roughness: 0.3 }, 1.0);
    type Row<'a> = (&'a str, &'a dyn Fn(DVec3, DVec3) -> f64, [f64; 5], f64);
    // Shares at the tabulated angles, and how many digits they were published with. 160 × 160 cells.
    let rows: [Row; 10] = [
        (
            "Phong, n = 10",
            &|i, o| historic::phong(i, o, 10.0),
            [0.523, 0.524, 0.529, 0.591, 1.029],
            1e-3,
        ),
        (
            "Blinn-Phong, n = 10",
            &|i, o| historic::blinn_phong(i, o, 10.0),
            [1.501, 1.394, 1.202, 1.299, 2.322],
            1e-3,
        ),
        (
            "modified Blinn-Phong, n = 1",
            &|i, o| historic::modified_blinn_phong(i, o, 1.0),
            [2.86, 2.73, 2.34, 2.05, 1.81],
            1e-2,
        ),
        (
            "modified Blinn-Phong, n = 10",
            &|i, o| historic::modified_blinn_phong(i, o, 10.0),
            [1.501, 1.207, 0.601, 0.336, 0.202],
            1e-3,
        ),
        (
            "normalised Blinn-Phong, n = 10",
            &normalised,
            [1.000, 0.805, 0.400, 0.224, 0.135],
            1e-3,
        ),
        (
            "Cook-Torrance 1982, m = 0.3",
            &|i, o| historic::cook_torrance(i, o, 0.3),
            [3.98, 3.93, 3.70, 3.71, 3.88],
            1e-2,
        ),
        (
            "Cook-Torrance with 1/4, m = 0.3",
            &quarter,
            [0.996, 0.981, 0.925, 0.927, 0.970],
            1e-3,
        ),
        (
            "Beckmann, m = 0.3",
            &beckmann,
            [0.996, 0.981, 0.925, 0.927, 0.970],
            1e-3,
        ),
        (
            "Ward 1992, α = 0.2",
            &|i, o| historic::ward(i, o, 0.2),
            [0.895, 0.777, 0.459, 0.269, 0.181],
            1e-3,
        ),
        ("Lambert", &|_, _| 1.0 / PI, [1.0; 5], 1e-4),
    ];
    for (name, lobe, expected, digits) in rows {
        let found = ANGLES.map(|degrees| albedo(lobe, direction(degrees), 160));
        println!("{name:32} {found:.3?}");
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (found - expected).abs() <= digits,
                "{name}: {found} instead of {expected}"
            );
        }
    }
}

#[test]
fn distributions_of_facets_cover_the_surface() {
    for width in [0.0263, 0.1, 0.3, 0.6, 1.0] {
        let beckmann = over_hemisphere(|c| beckmann_distribution(c, width) * c);
        let ggx = over_hemisphere(|c| ggx_distribution(c, width) * c);
        assert!((beckmann - 1.0).abs() < 1e-5, "{width}: {beckmann}");
        assert!((ggx - 1.0).abs() < 1e-5, "{width}: {ggx}");
    }
    // Cook and Torrance's own D lacks the 1/π.
    let without = over_hemisphere(|c| PI * beckmann_distribution(c, 0.3) * c);
    assert!((without - PI).abs() < 5e-5, "{without}");
}

#[test]
fn lobes_with_an_exponent_reflect_all_light_at_normal_incidence() {
    for power in [1.0, 2.0, 10.0, 100.0, 1448.0] {
        for reflection in [
            Reflection::BlinnPhong { power },
            Reflection::Phong { power },
        ] {
            let lobe = specular_lobe(reflection, 1.0);
            let found = over_hemisphere(|c| lobe(DVec3::Z, direction(c.acos().to_degrees())) * c);
            assert!((found - 1.0).abs() < 1e-4, "{reflection:?}: {found}");
        }
    }
}

/// At normal incidence the share is ∫ D G / (cos θ) dω over the facets that reflect upwards, those
/// up to 45°, with the factor that each model has there.
#[test]
fn microfacets_reflect_at_normal_incidence_what_the_closed_forms_say() {
    for alpha in [0.05_f64, 0.1, 0.2, 0.3] {
        // Facets up to 30° are hidden by none; slopes beyond are few: tan² 30° = 1/3, and for
        // x = tan²θ up to 1, G = 2 cos 2θ = 2 (1 − x)/(1 + x).
        let gauss = |x: f64| (-x / (alpha * alpha)).exp() / (alpha * alpha);
        let steps = 100_000;
        let rest: f64 = (0..steps)
            .map(|step| {
                let x = 1.0 / 3.0 + (f64::from(step) + 0.5) / f64::from(steps) * 2.0 / 3.0;
                2.0 * (1.0 - x) / (1.0 + x) * gauss(x) * 2.0 / 3.0 / f64::from(steps)
            })
            .sum();
        let beckmann = 1.0 - (-1.0 / (3.0 * alpha * alpha)).exp() + rest;
        // Ward: ∫ (1 − x) exp(−x/α²)/α² dx from 0 to 1.
        let ward = 1.0 - alpha * alpha * (1.0 - (-1.0 / (alpha * alpha)).exp());
        // GGX seen from above hides as much as Smith's G1 (Walter et al. 2007, equation 34) says.
        let ggx = over_hemisphere(|c| {
            let cosine = 2.0 * c * c - 1.0;
            if cosine <= 0.0 {
                return 0.0;
            }
            let tan_squared = 1.0 / (cosine * cosine) - 1.0;
            let smith = 2.0 / (1.0 + (1.0 + alpha * alpha * tan_squared).sqrt());
            ggx_distribution(c, alpha) * smith * c
        });
        let roughness = alpha as f32;
        let (along, across) = (roughness, roughness);
        for (reflection, expected) in [
            (Reflection::Beckmann { roughness }, beckmann),
            (Reflection::Ggx { roughness }, ggx),
            (Reflection::Ward { along, across }, ward),
        ] {
            let found = albedo(specular_lobe(reflection, 1.0), DVec3::Z, 1000);
            assert!(
                (found - expected).abs() < 1e-3,
                "{reflection:?}: {found} instead of {expected}"
            );
        }
    }
    // Anisotropic and narrow: the mean of both squares takes the square's place.
    let (along, across) = (0.3, 0.1);
    let found = albedo(
        specular_lobe(Reflection::Ward { along, across }, 1.0),
        DVec3::Z,
        1000,
    );
    assert!((found - 0.95).abs() < 1e-3, "{found}");
}

#[test]
fn white_lobes_reflect_no_more_than_they_receive() {
    println!("white furnace: the share reflected at {ANGLES:?}°");
    for (power, roughness) in [
        (1448.0, 0.0372),
        (198.0, 0.1),
        (30.0, 0.25),
        (6.0, 0.5),
        (1.0, 1.0),
    ] {
        for reflection in models(power, roughness) {
            let mut shares = [0.0; ANGLES.len()];
            for (share, degrees) in shares.iter_mut().zip(ANGLES) {
                // Anisotropic lobes along the tangent, across it and between.
                for turn in [0.0, 45.0, 90.0_f64] {
                    let (sin, cos) = turn.to_radians().sin_cos();
                    let from = direction(degrees);
                    let from = DVec3::new(from.x * cos, from.x * sin, from.z);
                    let found = albedo(specular_lobe(reflection, 1.0), from, 300);
                    assert!(found > 0.0 && found < 1.0005, "{reflection:?}: {found}");
                    *share = found.max(*share);
                }
            }
            println!("  {reflection:?}: {shares:.3?}");
        }
    }
    // The table in the module's documentation.
    let table = [
        [1.000, 0.767, 0.302, 0.127, 0.056],
        [1.000, 0.866, 0.509, 0.305, 0.188],
        [0.999, 0.993, 0.943, 0.926, 0.966],
        [0.916, 0.904, 0.857, 0.839, 0.901],
        [0.938, 0.926, 0.856, 0.796, 0.810],
        [0.868, 0.839, 0.784, 0.785, 0.851],
    ];
    let mut reflections = models(30.0, 0.25);
    reflections[1] = Reflection::Phong { power: 7.5 };
    for (reflection, expected) in reflections.into_iter().zip(table) {
        let lobe = specular_lobe(reflection, 1.0);
        let found = ANGLES.map(|degrees| albedo(lobe, direction(degrees), 500));
        println!("  {reflection:?}: {found:.3?}");
        for (found_at, expected) in found.into_iter().zip(expected) {
            assert!(
                (found_at - expected).abs() < 1e-3,
                "{reflection:?}: {found:.3?}"
            );
        }
    }
}

/// The largest relative change of a lobe where light and viewer change places, on random pairs.
fn asymmetry(lobe: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    let mut worst: f64 = 0.0;
    for step in 0..2000 {
        // Two sequences of irrational steps cover the hemisphere evenly and do not repeat.
        let turn = |k: f64| {
            let u = (f64::from(step) * k).fract();
            let angle = (f64::from(step) * k * 7.3).fract() * 2.0 * PI;
            let radius = u.sqrt();
            DVec3::new(radius * angle.cos(), radius * angle.sin(), (1.0 - u).sqrt())
        };
        let (a, b) = (turn(0.618_034), turn(0.754_878));
        let (there, back) = (lobe(a, b), lobe(b, a));
        worst = worst.max((there - back).abs() / there.max(back).max(1e-300));
    }
    worst
}

#[test]
fn light_and_viewer_may_change_places_in_all_but_the_divided_forms() {
    for (power, roughness) in [(37.0, 0.2), (1.0, 1.0), (400.0, 0.06)] {
        for reflection in models(power, roughness) {
            for reflectance in [0.0, 0.04, 1.0] {
                let found = asymmetry(specular_lobe(reflection, reflectance));
                assert!(found <= 1e-9, "{reflection:?}: {found}");
            }
        }
    }
    assert!(asymmetry(|i, o| historic::cook_torrance(i, o, 0.3)) < 1e-9);
    assert!(asymmetry(|i, o| historic::ward(i, o, 0.3)) < 1e-9);
    assert!(asymmetry(|i, o| historic::modified_blinn_phong(i, o, 10.0)) < 1e-9);
    // Divided by N·L, these are not reciprocal.
    assert!(asymmetry(|i, o| historic::phong(i, o, 10.0)) > 0.5);
    assert!(asymmetry(|i, o| historic::blinn_phong(i, o, 10.0)) > 0.5);
}

#[test]
fn peaks_are_what_the_formulas_give_head_on() {
    let at_normal =
        |reflection, reflectance| specular_lobe(reflection, reflectance)(DVec3::Z, DVec3::Z);
    let close = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-6, "{found}, {expected}");
    };
    let roughness = 0.25;
    close(
        at_normal(Reflection::Beckmann { roughness }, 0.5),
        0.5 / (4.0 * PI * 0.0625),
    );
    close(
        at_normal(Reflection::Ggx { roughness }, 0.5),
        0.5 / (4.0 * PI * 0.0625),
    );
    let (along, across) = (0.5, 0.125);
    close(
        at_normal(Reflection::Ward { along, across }, 0.5),
        0.5 / (4.0 * PI * 0.0625),
    );
    close(
        at_normal(Reflection::Phong { power: 6.0 }, 0.5),
        0.5 * 8.0 / (2.0 * PI),
    );
    // (6 + 2)(6 + 4) / (8π (1/8 + 6)).
    close(
        at_normal(Reflection::BlinnPhong { power: 6.0 }, 0.5),
        0.5 * 80.0 / (8.0 * PI * 6.125),
    );
}

/// Ward's highlight is longer across the finer direction, and both halves of it are alike.
#[test]
fn ward_follows_the_tangent() {
    let (along, across) = (0.4, 0.1);
    let lobe = specular_lobe(Reflection::Ward { along, across }, 1.0);
    let tilted = |x: f64, y: f64| lobe(DVec3::Z, DVec3::new(x, y, 1.0).normalize());
    assert!(tilted(0.3, 0.0) > 3.0 * tilted(0.0, 0.3));
    assert_eq!(tilted(0.3, 0.1), tilted(-0.3, -0.1));
    // exp(−tan²θ/α²) / (4 π αx αy (V·H)² cos⁴θ), here for facets tilted by 10° along each axis.
    for (alpha, to_viewer) in [
        (0.4_f64, direction(20.0)),
        (
            0.1,
            DVec3::new(0.0, 20_f64.to_radians().sin(), 20_f64.to_radians().cos()),
        ),
    ] {
        let (tan, cos) = (10_f64.to_radians().tan(), 10_f64.to_radians().cos());
        let expected = (-tan * tan / (alpha * alpha)).exp() / (4.0 * PI * 0.4 * 0.1 * cos.powi(6));
        let found = lobe(DVec3::Z, to_viewer);
        assert!((found / expected - 1.0).abs() < 1e-6, "{found}, {expected}");
    }
}

/// Phong's lobe with a quarter of the power falls to a half about where Blinn-Phong's does (Fisher
/// and Woo 1994).
#[test]
fn a_quarter_of_the_power_makes_phong_as_wide_as_blinn_phong() {
    for power in [20.0_f32, 100.0, 1000.0] {
        let half_width = |reflection| {
            let lobe = specular_lobe(reflection, 1.0);
            let half = lobe(DVec3::Z, DVec3::Z) / 2.0;
            let falls = |step: &u32| lobe(DVec3::Z, direction(f64::from(*step) * 0.01)) < half;
            f64::from((0..9000).find(falls).unwrap_or(0))
        };
        let blinn = half_width(Reflection::BlinnPhong { power });
        let phong = half_width(Reflection::Phong { power: power / 4.0 });
        assert!(
            (phong / blinn - 1.0).abs() < 0.05,
            "{power}: {phong} and {blinn}"
        );
    }
}

#[test]
fn nothing_breaks_at_the_edges() {
    let grazing = DVec3::new(1.0, 0.0, 1e-12).normalize();
    let directions = [
        DVec3::Z,
        -DVec3::Z,
        DVec3::X,
        -DVec3::X,
        DVec3::Y,
        grazing,
        -grazing,
        DVec3::ZERO,
    ];
    for reflection in models(1.0, 0.0).into_iter().chain(models(1448.0, 1.0)) {
        for to_light in directions {
            for to_viewer in directions {
                let found = specular_lobe(reflection, 0.5)(to_light, to_viewer);
                assert!(
                    found.is_finite() && found >= 0.0,
                    "{reflection:?} {to_light} {to_viewer}: {found}"
                );
            }
        }
    }
}
