//! Reflection models as they were first written, to see what their normalised successors mend.
//!
//! Lobes are functions of the unit vectors to the light and to the viewer in the surface's own frame:
//! the normal along +z. No shader uses them. Shares that they reflect are in the tests.

use std::f64::consts::PI;

use glam::DVec3;

/// Phong 1975: (R·V)^n / N·L. Not reciprocal, since the division by N·L treats light and viewer
/// differently, and without bound at grazing angles.
pub fn phong(to_light: DVec3, to_viewer: DVec3, power: f64) -> f64 {
    let mirrored = DVec3::new(-to_light.x, -to_light.y, to_light.z);
    mirrored.dot(to_viewer).max(0.0).powf(power) / to_light.z
}

/// Blinn 1977: (N·H)^n / N·L. Not reciprocal either.
pub fn blinn_phong(to_light: DVec3, to_viewer: DVec3, power: f64) -> f64 {
    modified_blinn_phong(to_light, to_viewer, power) / to_light.z
}

/// (N·H)^n: reciprocal, but it reflects more than it receives for small powers, and ever less for
/// large ones.
pub fn modified_blinn_phong(to_light: DVec3, to_viewer: DVec3, power: f64) -> f64 {
    (to_light + to_viewer).normalize().z.max(0.0).powf(power)
}

/// Cook and Torrance 1982 with F = 1: D G / (π N·L N·V), where D lacks its 1/π. Four times too
/// bright: π stands where 4 π must, as the transformation from facet normals to directions of
/// reflection demands.
pub fn cook_torrance(to_light: DVec3, to_viewer: DVec3, m: f64) -> f64 {
    let half_vector = (to_light + to_viewer).normalize();
    let (n_dot_h, v_dot_h) = (half_vector.z, half_vector.dot(to_viewer));
    let tan_squared = 1.0 / (n_dot_h * n_dot_h) - 1.0;
    let distribution = (-tan_squared / (m * m)).exp() / (m * m * n_dot_h.powi(4));
    let masking = 2.0 * n_dot_h * to_viewer.z / v_dot_h;
    let shadowing = 2.0 * n_dot_h * to_light.z / v_dot_h;
    let geometry = masking.min(shadowing).min(1.0);
    distribution * geometry / (PI * to_light.z * to_viewer.z)
}

/// Ward 1992, isotropic: exp(−tan²θ/α²) / (4 π α² √(N·L N·V)). Reciprocal; it loses most of the light
/// at grazing angles.
pub fn ward(to_light: DVec3, to_viewer: DVec3, alpha: f64) -> f64 {
    let cosine = (to_light + to_viewer).normalize().z;
    let tan_squared = 1.0 / (cosine * cosine) - 1.0;
    let scale = 4.0 * PI * alpha * alpha * (to_light.z * to_viewer.z).sqrt();
    (-tan_squared / (alpha * alpha)).exp() / scale
}
