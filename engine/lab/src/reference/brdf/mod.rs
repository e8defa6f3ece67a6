//! Reflectance models, as functions of directions in the surface's own frame (normal along +z).

use std::f64::consts::PI;

use glam::DVec3;

/// Blinn's lobe (N·H)^n with the factor that makes it reflect all energy at normal incidence:
/// (n + 2)(n + 4) / (8π (2^(−n/2) + n)) (Giesen 2009). Twin of `normalized_blinn_phong`.
pub fn normalized_blinn_phong(n_dot_h: f64, power: f64) -> f64 {
    let scale = (power + 2.0) * (power + 4.0) / (8.0 * PI * ((-0.5 * power).exp2() + power));
    scale * n_dot_h.max(0.0).powf(power)
}

/// The default surface's specular lobe for two unit directions.
pub fn blinn_phong_lobe(to_light: DVec3, to_viewer: DVec3, power: f64) -> f64 {
    let half_vector = (to_light + to_viewer).normalize_or_zero();
    normalized_blinn_phong(half_vector.z, power)
}

/// The share of light from `to_light` that a lobe reflects into the hemisphere:
/// a(Ψ) = ∫ f(Ψ→Θ)(N·Θ) dω, by stratified cosine-weighted quadrature with `cells`² cells.
pub fn albedo(lobe: impl Fn(DVec3, DVec3) -> f64, to_light: DVec3, cells: u32) -> f64 {
    let mut sum = 0.0;
    for i in 0..cells {
        for j in 0..cells {
            let u = (f64::from(i) + 0.5) / f64::from(cells);
            let angle = (f64::from(j) + 0.5) / f64::from(cells) * 2.0 * PI;
            // Malley's method: uniform on the disc is cosine-weighted on the hemisphere.
            let radius = u.sqrt();
            let out = DVec3::new(radius * angle.cos(), radius * angle.sin(), (1.0 - u).sqrt());
            sum += lobe(to_light, out);
        }
    }
    sum * PI / f64::from(cells * cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(degrees: f64) -> DVec3 {
        let angle = degrees.to_radians();
        DVec3::new(angle.sin(), 0.0, angle.cos())
    }

    #[test]
    fn reflected_energy_at_power_10() {
        // 160 × 160 cells; the figures belong to the normalised lobe with power 10 and colour 1.
        let expected = [
            (0.0, 1.000),
            (30.0, 0.805),
            (60.0, 0.400),
            (75.0, 0.224),
            (85.0, 0.135),
        ];
        for (degrees, wanted) in expected {
            let found = albedo(|i, o| blinn_phong_lobe(i, o, 10.0), direction(degrees), 160);
            assert!(
                (found - wanted).abs() < 1e-3,
                "{degrees}°: {found} instead of {wanted}"
            );
        }
    }

    #[test]
    fn no_power_reflects_more_than_it_receives() {
        for power in [1.0, 2.0, 10.0, 100.0, 1448.0] {
            for degrees in [0.0, 30.0, 60.0, 75.0, 85.0] {
                let found = albedo(
                    |i, o| blinn_phong_lobe(i, o, power),
                    direction(degrees),
                    400,
                );
                assert!(found < 1.0 + 2e-3, "power {power}, {degrees}°: {found}");
            }
        }
    }

    #[test]
    fn light_and_viewer_may_change_places() {
        for step in 0..200 {
            let turn = |k: f64| {
                let u = (f64::from(step) * k).fract();
                let angle = (f64::from(step) * k * 7.3).fract() * 2.0 * PI;
                let radius = u.sqrt();
                DVec3::new(radius * angle.cos(), radius * angle.sin(), (1.0 - u).sqrt())
            };
            let (a, b) = (turn(0.618_034), turn(0.754_878));
            let (there, back) = (blinn_phong_lobe(a, b, 37.0), blinn_phong_lobe(b, a, 37.0));
            assert!((there - back).abs() <= 1e-5 * there);
        }
    }
}
