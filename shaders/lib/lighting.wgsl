// One light on one surface: every pipeline calls `arriving_light`, most of them through
// `evaluate_light`, and nothing else lights.
//
// In:  a light, a surface with a unit normal, the unit vector to the viewer.
// Out: reflected radiance towards the viewer, or its parts before the material's colours.
//
// Surface: Lambert diffuse plus the highlights of its reflection model, see brdf.wgsl. Without
// REFLECTION_MODELS all surfaces are normalised Blinn-Phong; the renderer sets it where others are
// drawn, so that only those pay for the choice.
// Falloff: Karis 2013, "Real Shading in Unreal Engine 4", inverse square with a window that
// reaches zero at the light's range. Cone: glTF 2.0, KHR_lights_punctual.
#define_import_path lightbench::lighting

#import lightbench::scene
#import lightbench::surface
#import lightbench::brdf
#ifdef COUNT_LIGHTS
#import lightbench::light_counts
#endif

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

// What a surface mirrors to the viewer for each unit of irradiance, before its specular colour.
struct Mirrored {
    colored: f32,                       // to be multiplied by the specular colour
    white: f32,                         // whatever that is: Fresnel's rise at grazing angles
}

// Schlick's F0 + (1 - F0) w, with the specular colour F0 taken out: F0 (1 - w) + w.
fn with_fresnel(facets: f32, v_dot_h: f32) -> Mirrored {
    let weight = brdf::schlick_weight(v_dot_h);
    return Mirrored(facets * (1.0 - weight), facets * weight);
}

// The surface's reflection model.
fn mirror(point: surface::Surface, to_light: vec3f, to_viewer: vec3f) -> Mirrored {
    let half_vector = surface::safe_normalize(to_light + to_viewer);
    let n_dot_h = saturate(dot(point.normal, half_vector));
#ifdef REFLECTION_MODELS
    let mirrored = reflect(-to_light, point.normal);
    let r_dot_v = saturate(dot(mirrored, to_viewer));
    let n_dot_l = max(dot(point.normal, to_light), brdf::LEAST_COSINE);
    // A bent normal may turn a surface that is seen away from the viewer.
    let n_dot_v = max(dot(point.normal, to_viewer), brdf::LEAST_COSINE);
    let v_dot_h = max(dot(to_viewer, half_vector), brdf::LEAST_COSINE);
    let n_dot_facet = max(n_dot_h, brdf::LEAST_COSINE);
    let h_dot_t = dot(half_vector, point.tangent);
    let h_dot_b = dot(half_vector, cross(point.normal, point.tangent));
    let power = point.lobe.x;
    let alpha = max(point.lobe, vec2f(brdf::LEAST_ROUGHNESS));

    switch point.model {
        case brdf::PHONG: {
            return Mirrored(brdf::normalized_phong(r_dot_v, power), 0.0);
        }
        case brdf::BECKMANN: {
            let distribution = brdf::beckmann_distribution(n_dot_facet, alpha.x);
            let visible = brdf::groove_visibility(n_dot_l, n_dot_v, n_dot_facet, v_dot_h);
            return with_fresnel(distribution * visible, v_dot_h);
        }
        case brdf::GGX: {
            let distribution = brdf::ggx_distribution(n_dot_facet, alpha.x);
            let visible = brdf::ggx_visibility(n_dot_l, n_dot_v, alpha.x);
            return with_fresnel(distribution * visible, v_dot_h);
        }
        case brdf::WARD: {
            return Mirrored(brdf::ward(n_dot_facet, v_dot_h, h_dot_t, h_dot_b, alpha), 0.0);
        }
        default: {
            return Mirrored(brdf::normalized_blinn_phong(n_dot_h, power), 0.0);
        }
    }
#else
    return Mirrored(brdf::normalized_blinn_phong(n_dot_h, point.lobe.x), 0.0);
#endif
}

// What a light does to a surface but for the surface's colours, so that a pipeline may apply those
// later: radiance = base_color · diffuse + specular · highlight + grazing.
struct ArrivingLight {
    diffuse: vec3f,
    highlight: vec3f,
    grazing: vec3f,                     // zero in models without a Fresnel term
}

#ifdef COUNT_LIGHTS
// For heat maps a light is what it counts as.
fn arriving_light(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> ArrivingLight {
    let count = light_counts::count(light, point.position);
    return ArrivingLight(vec3f(count), vec3f(0.0), vec3f(0.0));
}
#else
fn arriving_light(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> ArrivingLight {
    let nothing = ArrivingLight(vec3f(0.0), vec3f(0.0), vec3f(0.0));
    if light.kind == scene::LIGHT_AMBIENT {
        // Constant radiance L from everywhere: E = πL, and Lambert reflects ρ E / π.
        return ArrivingLight(light.intensity, vec3f(0.0), vec3f(0.0));
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
    let received = irradiance * n_dot_l;
    let mirrored = mirror(point, to_light, to_viewer);
    return ArrivingLight(
        received / brdf::PI,
        mirrored.colored * received,
        mirrored.white * received,
    );
}
#endif

fn evaluate_light(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> vec3f {
    let arriving = arriving_light(light, point, to_viewer);
    let radiance = point.base_color * arriving.diffuse + point.specular * arriving.highlight;
#ifdef REFLECTION_MODELS
    return radiance + arriving.grazing;
#else
    return radiance;
#endif
}
