// One light on one surface: every pipeline calls `arriving_light`, most of them through
// `evaluate_light`, and nothing else lights.
//
// In:  a light, a surface with a unit normal, the unit vector to the viewer.
// Out: reflected radiance towards the viewer, or its two parts before the material's colours.
//
// Surface: Lambert diffuse plus normalised Blinn-Phong specular. The normalisation
// (n + 2)(n + 4) / (8π (2^(-n/2) + n)) makes the reflected energy 1 at normal incidence
// (Giesen 2009, "Phong and Blinn-Phong normalization factors").
// Falloff: Karis 2013, "Real Shading in Unreal Engine 4", inverse square with a window that
// reaches zero at the light's range. Cone: glTF 2.0, KHR_lights_punctual.
#define_import_path lightbench::lighting

#import lightbench::scene
#import lightbench::surface
#ifdef COUNT_LIGHTS
#import lightbench::light_counts
#endif

const PI: f32 = 3.14159265;

// (N·H)^n scaled so that the lobe reflects its `specular` share at normal incidence.
fn normalized_blinn_phong(n_dot_h: f32, power: f32) -> f32 {
    let scale = (power + 2.0) * (power + 4.0) / (8.0 * PI * (exp2(-0.5 * power) + power));
    // The maximum keeps the logarithm finite; so far off the highlight the lobe is nothing anyway.
    return scale * exp2(power * log2(max(n_dot_h, 1e-6)));
}

// Share of the intensity that arrives per square metre from distance d: window / d².
fn distance_falloff(distance_squared: f32, range: f32) -> f32 {
    let ratio = distance_squared / (range * range);
    let window = saturate(1.0 - ratio * ratio);
    return window * window / max(distance_squared, 0.01 * 0.01);
}

// 1 inside the inner cone, 0 outside the outer one, squared for a soft edge.
fn cone_falloff(light: scene::Light, to_light: vec3f) -> f32 {
    let edge = saturate(dot(light.direction, -to_light) * light.angle_scale + light.angle_offset);
    return edge * edge;
}

// What a light does to a surface but for the surface's colours, so that a pipeline may apply those
// later: radiance = base_color · diffuse + specular · highlight.
struct ArrivingLight {
    diffuse: vec3f,
    highlight: vec3f,
}

#ifdef COUNT_LIGHTS
// For heat maps a light is what it counts as.
fn arriving_light(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> ArrivingLight {
    return ArrivingLight(vec3f(light_counts::count(light, point.position)), vec3f(0.0));
}
#else
fn arriving_light(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> ArrivingLight {
    let nothing = ArrivingLight(vec3f(0.0), vec3f(0.0));
    if light.kind == scene::LIGHT_AMBIENT {
        // Constant radiance L from everywhere: E = πL, and Lambert reflects ρ E / π.
        return ArrivingLight(light.intensity, vec3f(0.0));
    }

    var to_light = -light.direction;
    var irradiance = light.intensity;
    if light.kind != scene::LIGHT_DIRECTIONAL {
        let offset = light.position - point.position;
        let distance_squared = dot(offset, offset);
        if distance_squared >= light.range * light.range {
            return nothing;
        }
        to_light = surface::safe_normalize(offset);
        irradiance *= distance_falloff(distance_squared, light.range);
        if light.kind == scene::LIGHT_SPOT {
            irradiance *= cone_falloff(light, to_light);
        }
    }

    let n_dot_l = dot(point.normal, to_light);
    if n_dot_l <= 0.0 {
        return nothing;
    }
    let half_vector = surface::safe_normalize(to_light + to_viewer);
    let n_dot_h = saturate(dot(point.normal, half_vector));
    let reflected = irradiance * n_dot_l;
    return ArrivingLight(reflected / PI, normalized_blinn_phong(n_dot_h, point.power) * reflected);
}
#endif

fn evaluate_light(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> vec3f {
    let arriving = arriving_light(light, point, to_viewer);
    return point.base_color * arriving.diffuse + point.specular * arriving.highlight;
}
