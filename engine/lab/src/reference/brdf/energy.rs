//! How much light a lobe reflects.
//!
//! Lobes are functions of the direction to the light and that to the viewer, both unit vectors in the
//! surface's own frame: the normal along +z, the tangent along +x.

use std::f64::consts::PI;

use glam::DVec3;

/// The share of light from `to_light` that a lobe reflects into the hemisphere:
/// a(Ψ) = ∫ f(Ψ→Θ)(N·Θ) dω, by the midpoint rule with `cells`² cells.
///
/// The cells divide the hemisphere of half vectors H, crowded around the normal where sharp lobes
/// need them. Each H stands for the direction that mirrors `to_light` at it, and a solid angle there
/// is 4 (Ψ·H) times that of H.
pub fn albedo(lobe: impl Fn(DVec3, DVec3) -> f64, to_light: DVec3, cells: u32) -> f64 {
    let mut sum = 0.0;
    for i in 0..cells {
        // tan(θ/2) = s², so that sin θ dθ = 16 s³ / (1 + s⁴)² ds / 2.
        let s = (f64::from(i) + 0.5) / f64::from(cells);
        let fourth = s.powi(4);
        let cosine = (1.0 - fourth) / (1.0 + fourth);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let solid_angle = 16.0 * PI * s.powi(3) / (1.0 + fourth).powi(2);
        for j in 0..cells {
            let (y, x) = ((f64::from(j) + 0.5) / f64::from(cells) * 2.0 * PI).sin_cos();
            let half_vector = DVec3::new(sine * x, sine * y, cosine);
            let along = to_light.dot(half_vector);
            let out = 2.0 * along * half_vector - to_light;
            if along > 0.0 && out.z > 0.0 {
                sum += lobe(to_light, out) * out.z * 4.0 * along * solid_angle;
            }
        }
    }
    sum / f64::from(cells * cells)
}

/// The unit vector at an angle from the normal, towards +x.
pub fn direction(degrees: f64) -> DVec3 {
    let angle = degrees.to_radians();
    DVec3::new(angle.sin(), 0.0, angle.cos())
}
