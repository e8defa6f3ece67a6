//! The twin of `shaders/lib/lighting.wgsl`: one light on one surface.

use glam::{DVec3, Vec3};
use lightbench_assets::Reflection;
use lightbench_render::gpu_data::LightData;

use super::brdf::{self, LEAST_COSINE, LEAST_ROUGHNESS};

/// The numbers of kinds of light; see `LIGHT_…` in `shaders/lib/scene.wgsl`.
/// The number of spots.
pub const SPOT: u32 = 1;
const DIRECTIONAL: u32 = 2;
/// The number of ambient lights.
pub const AMBIENT: u32 = 3;

/// What light falls on; see `Surface` in `shaders/lib/surface.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// World position, metres.
    pub position: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Diffuse reflectance, linear Rec. 709.
    pub base_color: DVec3,
    /// Specular reflectance at normal incidence.
    pub specular: DVec3,
    /// Reflection model.
    pub reflection: Reflection,
    /// Unit vector in the surface, from which Ward's model measures.
    pub tangent: DVec3,
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

/// What a surface mirrors to the viewer for each unit of irradiance, before its specular colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirrored {
    /// To be multiplied by the specular colour.
    pub colored: f64,
    /// Whatever that is: Fresnel's rise at grazing angles.
    pub white: f64,
}

impl Mirrored {
    fn plain(colored: f64) -> Self {
        Self {
            colored,
            white: 0.0,
        }
    }

    fn with_fresnel(facets: f64, v_dot_h: f64) -> Self {
        let weight = brdf::schlick_weight(v_dot_h);
        Self {
            colored: facets * (1.0 - weight),
            white: facets * weight,
        }
    }
}

/// The surface's reflection model.
pub fn mirror(surface: &Surface, to_light: DVec3, to_viewer: DVec3) -> Mirrored {
    let normal = surface.normal;
    let half_vector = (to_light + to_viewer).try_normalize().unwrap_or(DVec3::Y);
    let cosine = |a: DVec3, b: DVec3| a.dot(b).max(LEAST_COSINE);
    let (n_dot_l, n_dot_v) = (cosine(normal, to_light), cosine(normal, to_viewer));
    let (n_dot_h, v_dot_h) = (cosine(normal, half_vector), cosine(to_viewer, half_vector));
    let width = |roughness: f32| f64::from(roughness).max(LEAST_ROUGHNESS);
    match surface.reflection {
        Reflection::BlinnPhong { power } => {
            let n_dot_h = normal.dot(half_vector);
            Mirrored::plain(brdf::normalized_blinn_phong(n_dot_h, power.into()))
        }
        Reflection::Phong { power } => {
            let mirrored = 2.0 * normal.dot(to_light) * normal - to_light;
            let r_dot_v = mirrored.dot(to_viewer);
            Mirrored::plain(brdf::normalized_phong(r_dot_v, power.into()))
        }
        Reflection::Beckmann { roughness } => {
            let distribution = brdf::beckmann_distribution(n_dot_h, width(roughness));
            let visible = brdf::groove_visibility(n_dot_l, n_dot_v, n_dot_h, v_dot_h);
            Mirrored::with_fresnel(distribution * visible, v_dot_h)
        }
        Reflection::Ggx { roughness } => {
            let distribution = brdf::ggx_distribution(n_dot_h, width(roughness));
            let visible = brdf::ggx_visibility(n_dot_l, n_dot_v, width(roughness));
            Mirrored::with_fresnel(distribution * visible, v_dot_h)
        }
        Reflection::Ward { along, across } => {
            let h_dot_t = half_vector.dot(surface.tangent);
            let h_dot_b = half_vector.dot(normal.cross(surface.tangent));
            let alpha = [width(along), width(across)];
            Mirrored::plain(brdf::ward(n_dot_h, v_dot_h, h_dot_t, h_dot_b, alpha))
        }
    }
}

/// The specular part of a BRDF, 1/sr, as a function of the unit vectors to the light and to the
/// viewer in the surface's own frame: the normal along +z, the tangent along +x.
pub fn specular_lobe(
    reflection: Reflection,
    reflectance: f64,
) -> impl Fn(DVec3, DVec3) -> f64 + Copy {
    let surface = Surface {
        position: DVec3::ZERO,
        normal: DVec3::Z,
        base_color: DVec3::ZERO,
        specular: DVec3::splat(reflectance),
        reflection,
        tangent: DVec3::X,
        emissive: DVec3::ZERO,
    };
    move |to_light, to_viewer| {
        let mirrored = mirror(&surface, to_light, to_viewer);
        reflectance * mirrored.colored + mirrored.white
    }
}

/// What a light sends to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Unit vector to the light.
    pub to_light: DVec3,
    /// Irradiance of a surface that faces the light, before any shadow.
    pub irradiance: DVec3,
    /// How far off the light is, metres; infinite for directional lights.
    pub distance: f64,
}

/// What a light that shines from somewhere sends to a point; none for ambient lights, and beyond a
/// light's range.
pub fn arriving(light: &LightData, position: DVec3) -> Option<Arrival> {
    let intensity = double(light.intensity);
    match light.kind {
        AMBIENT => return None,
        DIRECTIONAL => {
            return Some(Arrival {
                to_light: -double(light.direction),
                irradiance: intensity,
                distance: f64::INFINITY,
            });
        }
        _ => {}
    }
    let range = f64::from(light.range);
    let offset = double(light.position) - position;
    let distance_squared = offset.length_squared();
    if distance_squared >= range * range {
        return None;
    }
    let to_light = offset.try_normalize().unwrap_or(DVec3::Y);
    let mut irradiance = intensity * distance_falloff(distance_squared, range);
    if light.kind == SPOT {
        irradiance *= cone_falloff(light, to_light);
    }
    Some(Arrival {
        to_light,
        irradiance,
        distance: distance_squared.sqrt(),
    })
}

/// 1 inside a spot's inner cone, 0 outside its outer one, squared for a soft edge.
pub fn cone_falloff(light: &LightData, to_light: DVec3) -> f64 {
    let cosine = double(light.direction).dot(-to_light);
    let edge = cosine * f64::from(light.angle_scale) + f64::from(light.angle_offset);
    edge.clamp(0.0, 1.0).powi(2)
}

/// Radiance that one light makes the surface send to the viewer.
pub fn evaluate_light(light: &LightData, surface: &Surface, to_viewer: DVec3) -> DVec3 {
    if light.kind == AMBIENT {
        return surface.base_color * double(light.intensity);
    }
    arriving(light, surface.position).map_or(DVec3::ZERO, |arrival| {
        reflected(surface, arrival.to_light, to_viewer) * arrival.irradiance
    })
}

/// What the surface sends to the viewer for each unit of irradiance that would fall on it if it faced
/// the light: the BRDF times the cosine. Zero for light from behind.
pub fn reflected(surface: &Surface, to_light: DVec3, to_viewer: DVec3) -> DVec3 {
    let n_dot_l = surface.normal.dot(to_light);
    if n_dot_l <= 0.0 {
        return DVec3::ZERO;
    }
    let mirrored = mirror(surface, to_light, to_viewer);
    let specular = surface.specular * mirrored.colored + mirrored.white;
    (surface.base_color / std::f64::consts::PI + specular) * n_dot_l
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
            specular: DVec3::ZERO,
            reflection: Reflection::BlinnPhong { power: 1.0 },
            tangent: DVec3::X,
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
