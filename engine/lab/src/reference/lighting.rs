//! The twin of `shaders/lib/lighting.wgsl`: one light on one surface.

use glam::{DVec3, Vec3};
use lightbench_render::gpu_data::LightData;

use super::brdf::normalized_blinn_phong;

/// What light falls on; see `Surface` in `shaders/lib/surface.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// World position, metres.
    pub position: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Diffuse reflectance, linear Rec. 709.
    pub base_color: DVec3,
    /// Specular reflectance.
    pub specular: f64,
    /// Blinn-Phong exponent.
    pub power: f64,
    /// Emitted radiance.
    pub emissive: DVec3,
}

fn double(v: Vec3) -> DVec3 {
    v.as_dvec3()
}

/// Share of the intensity that arrives per square metre from a distance: the inverse square with
/// a window that ends at `range` (Karis 2013).
pub fn distance_falloff(distance_squared: f64, range: f64) -> f64 {
    let ratio = distance_squared / (range * range);
    let window = (1.0 - ratio * ratio).clamp(0.0, 1.0);
    window * window / distance_squared.max(0.01 * 0.01)
}

/// Radiance that one light makes the surface send to the viewer.
pub fn evaluate_light(light: &LightData, surface: &Surface, to_viewer: DVec3) -> DVec3 {
    const SPOT: u32 = 1;
    const DIRECTIONAL: u32 = 2;
    const AMBIENT: u32 = 3;
    let mut irradiance = double(light.intensity);
    if light.kind == AMBIENT {
        return surface.base_color * irradiance;
    }
    let mut to_light = -double(light.direction);
    if light.kind != DIRECTIONAL {
        let range = f64::from(light.range);
        let offset = double(light.position) - surface.position;
        if offset.length_squared() >= range * range {
            return DVec3::ZERO;
        }
        to_light = offset.try_normalize().unwrap_or(DVec3::Y);
        irradiance *= distance_falloff(offset.length_squared(), range);
        if light.kind == SPOT {
            let cosine = double(light.direction).dot(-to_light);
            let edge = cosine * f64::from(light.angle_scale) + f64::from(light.angle_offset);
            irradiance *= edge.clamp(0.0, 1.0).powi(2);
        }
    }
    let n_dot_l = surface.normal.dot(to_light);
    if n_dot_l <= 0.0 {
        return DVec3::ZERO;
    }
    let half_vector = (to_light + to_viewer).try_normalize().unwrap_or(DVec3::Y);
    let specular =
        surface.specular * normalized_blinn_phong(surface.normal.dot(half_vector), surface.power);
    (surface.base_color / std::f64::consts::PI + specular) * irradiance * n_dot_l
}

/// Radiance that all lights together make the surface send to an eye at `eye`.
pub fn outgoing_radiance(lights: &[LightData], surface: &Surface, eye: DVec3) -> DVec3 {
    let to_viewer = (eye - surface.position).try_normalize().unwrap_or(DVec3::Y);
    let direct: DVec3 = lights
        .iter()
        .map(|light| evaluate_light(light, surface, to_viewer))
        .sum();
    surface.emissive + direct
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbench_render::scene::light_data;
    use lightbench_world::{Light, LightKind};

    fn floor() -> Surface {
        Surface {
            position: DVec3::ZERO,
            normal: DVec3::Y,
            base_color: DVec3::splat(0.5),
            specular: 0.0,
            power: 1.0,
            emissive: DVec3::ZERO,
        }
    }

    #[test]
    fn a_point_light_falls_off_with_the_square_and_ends_at_its_range() {
        let light = |height: f32| {
            let light = Light {
                intensity: 10.0,
                range: 4.0,
                ..Light::default()
            };
            light_data(&light, Vec3::new(0.0, height, 0.0), Vec3::NEG_Z)
        };
        let radiance = |height| evaluate_light(&light(height), &floor(), DVec3::Y).x;
        let window = (1.0 - (2.0_f64 / 4.0).powi(4)).powi(2);
        let expected = 0.5 / std::f64::consts::PI * 10.0 / 4.0 * window;
        assert!((radiance(2.0) / expected - 1.0).abs() < 1e-6);
        assert_eq!(radiance(4.0), 0.0);
        assert_eq!(radiance(-1.0), 0.0, "from below");
        assert!(radiance(0.0).is_finite(), "on the surface");
    }

    #[test]
    fn a_spot_light_is_full_inside_dark_outside_and_a_quarter_half_way() {
        let light = Light {
            kind: LightKind::Spot,
            intensity: 1.0,
            range: 1e6,
            inner_angle: 40_f32.to_radians(),
            outer_angle: 80_f32.to_radians(),
            ..Light::default()
        };
        let down = light_data(&light, Vec3::new(0.0, 1.0, 0.0), Vec3::NEG_Y);
        let at = |degrees: f64| {
            let surface = Surface {
                position: DVec3::new(degrees.to_radians().tan(), 0.0, 0.0),
                ..floor()
            };
            let offset = DVec3::Y - surface.position;
            let plain = 0.5 / std::f64::consts::PI * offset.normalize().y / offset.length_squared();
            evaluate_light(&down, &surface, DVec3::Y).x / plain
        };
        assert!((at(19.0) - 1.0).abs() < 1e-5);
        assert_eq!(at(41.0), 0.0);
        let (inner, outer) = (20_f64.to_radians().cos(), 40_f64.to_radians().cos());
        let half_way = ((inner + outer) * 0.5).acos().to_degrees();
        assert!((at(half_way) - 0.25).abs() < 1e-4, "{}", at(half_way));
    }
}
