//! Directions are spread as their density says, and together they carry the light that the BRDF
//! reflects.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use lightbench_assets::Reflection;

use super::{Lobe, Scatter, cosine};
use crate::reference::brdf::energy::{albedo, direction};
use crate::reference::lighting::specular_lobe;
use crate::reference::{Surface, reflected};
use crate::tracer::random::Random;

/// Samples of each test.
const SAMPLES: u32 = 200_000;
/// Bins of the hemisphere, from the normal down and around.
const RINGS: usize = 12;
const SECTORS: usize = 24;
/// Cells of a bin along each side, for the integral of the density.
const CELLS: usize = 48;
/// How unlikely a sampler without a fault fails, at each of some fifty comparisons.
const SIGNIFICANCE_DEVIATIONS: f64 = 4.0;

const MODELS: [Reflection; 8] = [
    Reflection::BlinnPhong { power: 1.0 },
    Reflection::BlinnPhong { power: 40.0 },
    Reflection::Phong { power: 12.0 },
    Reflection::Beckmann { roughness: 0.3 },
    Reflection::Ggx { roughness: 0.15 },
    Reflection::Ggx { roughness: 0.8 },
    Reflection::Ward {
        along: 0.3,
        across: 0.3,
    },
    Reflection::Ward {
        along: 0.6,
        across: 0.2,
    },
];

/// Which bin a direction falls into; those below the surface have one of their own.
fn bin(direction: Option<DVec3>) -> usize {
    let Some(direction) = direction.filter(|direction| direction.z > 0.0) else {
        return RINGS * SECTORS;
    };
    // cos θ = 1 − s², so that bins are smaller around the normal.
    let ring = (1.0 - direction.z).max(0.0).sqrt() * RINGS as f64;
    let turn = direction.y.atan2(direction.x).rem_euclid(TAU) / TAU * SECTORS as f64;
    (ring as usize).min(RINGS - 1) * SECTORS + (turn as usize).min(SECTORS - 1)
}

/// How likely directions fall into each bin, by the midpoint rule.
fn shares(density: impl Fn(DVec3) -> f64) -> Vec<f64> {
    let mut shares = Vec::with_capacity(RINGS * SECTORS + 1);
    let (ring_step, turn_step) = ((RINGS * CELLS) as f64, (SECTORS * CELLS) as f64);
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let mut sum = 0.0;
            for i in 0..CELLS {
                let s = ((ring * CELLS + i) as f64 + 0.5) / ring_step;
                let cosine = 1.0 - s * s;
                let sine = (1.0 - cosine * cosine).sqrt();
                for j in 0..CELLS {
                    let turn = ((sector * CELLS + j) as f64 + 0.5) / turn_step * TAU;
                    let towards = DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine);
                    sum += density(towards) * 2.0 * s;
                }
            }
            shares.push(sum / ring_step * TAU / turn_step);
        }
    }
    let above: f64 = shares.iter().sum();
    shares.push((1.0 - above).max(0.0));
    shares
}

/// Pearson's χ² of what was chosen against a density, as standard deviations of a normal distribution
/// (Wilson and Hilferty 1931, "The Distribution of Chi-Square").
fn deviation(choose: impl Fn(&mut Random) -> Option<DVec3>, density: impl Fn(DVec3) -> f64) -> f64 {
    let mut counts = vec![0_u32; RINGS * SECTORS + 1];
    for sample in 0..SAMPLES {
        let mut random = Random::of_sample(20, 0, sample.into());
        counts[bin(choose(&mut random))] += 1;
    }
    let (mut statistic, mut freedoms) = (0.0, -1.0_f64);
    let (mut rest, mut rest_expected) = (0.0, 0.0);
    for (count, share) in counts.into_iter().zip(shares(density)) {
        let (found, expected) = (f64::from(count), share * f64::from(SAMPLES));
        if expected < 8.0 {
            rest += found;
            rest_expected += expected;
        } else {
            statistic += (found - expected).powi(2) / expected;
            freedoms += 1.0;
        }
    }
    if rest_expected >= 8.0 {
        statistic += (rest - rest_expected).powi(2) / rest_expected;
        freedoms += 1.0;
    }
    let spread = 2.0 / (9.0 * freedoms);
    ((statistic / freedoms).cbrt() - (1.0 - spread)) / spread.sqrt()
}

fn of_lobe(chosen: Lobe, stated: Lobe, to_viewer: DVec3) -> f64 {
    deviation(
        |random| chosen.choose(to_viewer, random.pair()),
        |to_light| stated.density(to_viewer, to_light),
    )
}

#[test]
fn lobes_choose_directions_as_their_densities_say() {
    for model in MODELS {
        for degrees in [0.0, 35.0, 75.0] {
            let lobe = Lobe::new(model);
            let off = of_lobe(lobe, lobe, turned(degrees));
            println!("{model:?} at {degrees}°: {off:.2}");
            assert!(off < SIGNIFICANCE_DEVIATIONS, "{model:?} {degrees}: {off}");
        }
    }
    let matt = deviation(
        |random| Some(cosine(random.pair())),
        |to_light| to_light.z / PI,
    );
    assert!(matt < SIGNIFICANCE_DEVIATIONS, "{matt}");
}

/// Must-fail twins: lobes that are a twentieth wider or sharper than stated.
#[test]
fn a_density_that_is_slightly_wrong_is_noticed() {
    for (chosen, stated) in [
        (Lobe::BlinnPhong(40.0), Lobe::BlinnPhong(42.0)),
        (Lobe::Phong(12.0), Lobe::Phong(12.6)),
        (Lobe::Beckmann(0.3), Lobe::Beckmann(0.315)),
        (Lobe::Ggx(0.15), Lobe::Ggx(0.1575)),
        (Lobe::Ward([0.6, 0.2]), Lobe::Ward([0.6, 0.21])),
        (Lobe::Ward([0.3, 0.3]), Lobe::Beckmann(0.315)),
    ] {
        let off = of_lobe(chosen, stated, turned(35.0));
        assert!(off > 2.0 * SIGNIFICANCE_DEVIATIONS, "{stated:?}: {off}");
    }
}

/// Off the axes, so that anisotropy shows.
fn turned(degrees: f64) -> DVec3 {
    let flat = direction(degrees);
    let (sine, cosine) = 0.6_f64.sin_cos();
    DVec3::new(flat.x * cosine, flat.x * sine, flat.z)
}

fn surface(reflection: Reflection, base_color: f64, specular: f64) -> Surface {
    let normal = DVec3::new(0.3, 0.8, -0.5).normalize();
    Surface {
        position: DVec3::ZERO,
        normal,
        base_color: DVec3::splat(base_color),
        specular: DVec3::splat(specular),
        reflection,
        tangent: normal.any_orthonormal_vector(),
        emissive: DVec3::ZERO,
    }
}

/// A direction of the surface's own frame in the world.
fn world(surface: &Surface, local: DVec3) -> DVec3 {
    let (normal, tangent) = (surface.normal, surface.tangent);
    tangent * local.x + normal.cross(tangent) * local.y + normal * local.z
}

#[test]
fn mixtures_choose_directions_as_their_densities_say() {
    for model in MODELS {
        let surface = surface(model, 0.4, 0.3);
        let to_viewer = world(&surface, turned(50.0));
        let Some(scatter) = Scatter::new(&surface, to_viewer) else {
            panic!("{model:?} scatters nothing");
        };
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| world(&surface, axis));
        let local = |v: DVec3| DVec3::from_array(axes.map(|axis| v.dot(axis)));
        let off = deviation(
            |random| {
                let which = random.number();
                scatter.choose(which, random.pair()).map(local)
            },
            |to_light| scatter.density(world(&surface, to_light)),
        );
        assert!(off < SIGNIFICANCE_DEVIATIONS, "{model:?}: {off}");
    }
}

/// The mean of BRDF · cosine / density over chosen directions is the albedo, which quadrature finds
/// another way.
#[test]
fn chosen_directions_carry_the_albedo() {
    for model in MODELS {
        for (base_color, specular) in [(0.0, 0.6), (0.5, 0.2), (0.7, 0.0)] {
            for degrees in [10.0, 65.0] {
                let surface = surface(model, base_color, specular);
                let to_viewer = turned(degrees);
                let lobe = specular_lobe(model, specular);
                let expected = base_color + albedo(|_, out| lobe(out, to_viewer), to_viewer, 400);
                let seen = world(&surface, to_viewer);
                let Some(scatter) = Scatter::new(&surface, seen) else {
                    assert_eq!(expected, 0.0);
                    continue;
                };
                let (mut sum, mut squares) = (0.0, 0.0);
                for sample in 0..SAMPLES {
                    let mut random = Random::of_sample(9, 1, sample.into());
                    let which = random.number();
                    let carried = scatter
                        .choose(which, random.pair())
                        .map_or(0.0, |to_light| {
                            reflected(&surface, to_light, seen).x / scatter.density(to_light)
                        });
                    sum += carried;
                    squares += carried * carried;
                }
                let count = f64::from(SAMPLES);
                let mean = sum / count;
                let error = ((squares / count - mean * mean) / count).sqrt();
                assert!(
                    (mean - expected).abs() < 4.0 * error + 2e-4,
                    "{model:?} {base_color} {specular} at {degrees}°: {mean} ± {error} instead of {expected}"
                );
                // A density that fits the BRDF leaves little noise.
                assert!(error < 0.01, "{model:?} at {degrees}°: {error}");
            }
        }
    }
}

#[test]
fn what_reflects_nothing_scatters_nothing_and_backs_of_bent_normals_scatter_by_the_cosine() {
    let black = surface(Reflection::BlinnPhong { power: 9.0 }, 0.0, 0.0);
    assert!(Scatter::new(&black, black.normal).is_none());
    // Fresnel's rise makes even a specular reflectance of nothing mirror at grazing angles.
    let facets = surface(Reflection::Ggx { roughness: 0.3 }, 0.0, 0.0);
    assert!(Scatter::new(&facets, world(&facets, direction(80.0))).is_some());
    let away = world(&facets, DVec3::new(0.8, 0.0, -0.6));
    let plain = surface(Reflection::Ggx { roughness: 0.3 }, 0.5, 0.5);
    let scatter = Scatter::new(&plain, away);
    let density = scatter.map(|scatter| scatter.density(plain.normal));
    assert_eq!(
        density.map(|density| (density * PI - 1.0).abs() < 1e-12),
        Some(true)
    );
}
