//! Directions in the lobes of the reflection models, and their densities.
//!
//! All vectors are in the surface's own frame. Microfacet lobes choose the half vector and mirror the
//! viewer at it; the density of the mirrored direction is that of the half vector over 4 V·H (Walter et
//! al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equation 14).

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use lightbench_assets::Reflection;

use crate::reference::brdf::{LEAST_ROUGHNESS, beckmann_distribution, ggx_distribution};

/// A direction above the surface, with Lambert's cosine over π as density.
pub fn cosine([u, v]: [f64; 2]) -> DVec3 {
    let (sine, cosine) = (TAU * v).sin_cos();
    let radius = u.sqrt();
    DVec3::new(radius * cosine, radius * sine, (1.0 - u).max(0.0).sqrt())
}

/// The lobe of a reflection model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe {
    /// Around the normal: (N·H)^n.
    BlinnPhong(f64),
    /// Around the mirrored viewer: (R·V)^n.
    Phong(f64),
    /// Beckmann's distribution of slopes.
    Beckmann(f64),
    /// That of Trowbridge and Reitz, of the facets that the viewer sees.
    Ggx(f64),
    /// A Gaussian of slopes along the tangent and across it.
    Ward([f64; 2]),
}

impl Lobe {
    /// That of a model.
    pub fn new(reflection: Reflection) -> Self {
        let width = |roughness: f32| f64::from(roughness).max(LEAST_ROUGHNESS);
        match reflection {
            Reflection::BlinnPhong { power } => Self::BlinnPhong(power.into()),
            Reflection::Phong { power } => Self::Phong(power.into()),
            Reflection::Beckmann { roughness } => Self::Beckmann(width(roughness)),
            Reflection::Ggx { roughness } => Self::Ggx(width(roughness)),
            Reflection::Ward { along, across } => Self::Ward([width(along), width(across)]),
        }
    }

    /// A direction to the light; it may point into the surface. None where the half vector faces away
    /// from the viewer.
    pub fn choose(&self, to_viewer: DVec3, numbers: [f64; 2]) -> Option<DVec3> {
        let half_vector = match *self {
            Self::Phong(power) => return Some(around_mirrored(to_viewer, power, numbers)),
            Self::BlinnPhong(power) => around_normal(power, numbers),
            Self::Beckmann(width) => from_slopes([width, width], numbers),
            Self::Ward(widths) => from_slopes(widths, numbers),
            Self::Ggx(width) => visible_facet(to_viewer, width, numbers),
        };
        let along = to_viewer.dot(half_vector);
        (along > 0.0).then(|| half_vector * (2.0 * along) - to_viewer)
    }

    /// How likely [`Lobe::choose`] takes a direction, 1/sr.
    pub fn density(&self, to_viewer: DVec3, to_light: DVec3) -> f64 {
        if let Self::Phong(power) = *self {
            let mirrored = DVec3::new(-to_viewer.x, -to_viewer.y, to_viewer.z);
            let cosine = mirrored.dot(to_light).max(0.0);
            return (power + 1.0) / TAU * cosine.powf(power);
        }
        let Some(half_vector) = (to_light + to_viewer).try_normalize() else {
            return 0.0;
        };
        let along = to_viewer.dot(half_vector);
        if along <= 0.0 || half_vector.z <= 0.0 {
            return 0.0;
        }
        let cosine = half_vector.z;
        let of_half_vector = match *self {
            Self::Phong(_) => return 0.0,
            Self::BlinnPhong(power) => (power + 1.0) / TAU * cosine.powf(power),
            Self::Beckmann(width) => beckmann_distribution(cosine, width) * cosine,
            Self::Ward([across_x, across_y]) => {
                let slope = [
                    half_vector.x / (across_x * cosine),
                    half_vector.y / (across_y * cosine),
                ];
                let gauss = (-slope[0] * slope[0] - slope[1] * slope[1]).exp();
                gauss / (PI * across_x * across_y * cosine.powi(3))
            }
            // Heitz 2018, equation 3: G1(V) D(H) V·H / V·N. G1 after Smith, with V·N taken in.
            Self::Ggx(width) => {
                let squared = width * width;
                let viewer = to_viewer.z;
                let seen = viewer + (squared + (1.0 - squared) * viewer * viewer).sqrt();
                2.0 * ggx_distribution(cosine, width) * along / seen
            }
        };
        of_half_vector / (4.0 * along)
    }
}

/// A half vector with the density (n + 1)/2π (N·H)^n.
fn around_normal(power: f64, [u, v]: [f64; 2]) -> DVec3 {
    let cosine = (1.0 - u).powf((power + 1.0).recip());
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (y, x) = (TAU * v).sin_cos();
    DVec3::new(sine * x, sine * y, cosine)
}

/// A direction with the density (n + 1)/2π (R·L)^n, where R is the viewer mirrored at the normal.
fn around_mirrored(to_viewer: DVec3, power: f64, numbers: [f64; 2]) -> DVec3 {
    let axis = DVec3::new(-to_viewer.x, -to_viewer.y, to_viewer.z);
    let (x, y) = axis.any_orthonormal_pair();
    let local = around_normal(power, numbers);
    x * local.x + y * local.y + axis * local.z
}

/// A half vector whose slopes are spread as in a Gaussian (Walter et al. 2007, equations 28 and 29; Ward
/// 1992, equations 6 and 7, where two widths differ). Its density is D(H) N·H.
fn from_slopes([along, across]: [f64; 2], [u, v]: [f64; 2]) -> DVec3 {
    let radius = (-(1.0 - u).ln()).sqrt();
    let (sine, cosine) = (TAU * v).sin_cos();
    DVec3::new(along * radius * cosine, across * radius * sine, 1.0).normalize()
}

/// A facet that the viewer sees (Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT
/// 7(4), listing 1).
fn visible_facet(to_viewer: DVec3, width: f64, [u, v]: [f64; 2]) -> DVec3 {
    // Where facets are stretched to a hemisphere.
    let view = DVec3::new(width * to_viewer.x, width * to_viewer.y, to_viewer.z).normalize();
    let flat = view.x * view.x + view.y * view.y;
    let first = if flat > 0.0 {
        DVec3::new(-view.y, view.x, 0.0) / flat.sqrt()
    } else {
        DVec3::X
    };
    let second = view.cross(first);
    // A point of the hemisphere as the viewer sees it: a half disc and a half ellipse.
    let radius = u.sqrt();
    let (sine, cosine) = (TAU * v).sin_cos();
    let (x, y) = (radius * cosine, radius * sine);
    let share = 0.5 * (1.0 + view.z);
    let y = (1.0 - share) * (1.0 - x * x).max(0.0).sqrt() + share * y;
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    let facet = first * x + second * y + view * z;
    DVec3::new(width * facet.x, width * facet.y, facet.z.max(0.0)).normalize_or(DVec3::Z)
}
