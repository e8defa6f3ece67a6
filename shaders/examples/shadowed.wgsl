// Forward shading in which lights with a shadow view cast shadows.
//
// In:  a fragment; the object's list of lights; the depth that spot lights see; `offset` in metres.
// Out: linear radiance.
// A point is in shadow where something else is nearer to the light (Williams 1978, "Casting Curved
// Shadows on Curved Surfaces"). The sampler compares with the four texels around it and mixes the
// answers, not the depths (Reeves, Salesin and Cook 1987, "Rendering Antialiased Shadows with Depth
// Maps").
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import lightbench::shadow

struct Parameters {
    offset: f32,
}

@group(1) @binding(0) var spot_depth: texture_depth_2d_array;
@group(1) @binding(1) var depth_sampler: sampler_comparison;
@group(1) @binding(2) var<storage, read> shadow_views: array<shadow::ShadowView>;
@group(1) @binding(3) var<storage, read> light_shadows: array<u32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

// The share of a light that reaches a point: 0 in its shadow, 1 outside of it.
fn lit_share(light: u32, point: surface::Surface) -> f32 {
    let first = light_shadows[light];
    if first == shadow::NO_VIEW {
        return 1.0;
    }
    let view = shadow_views[first];
    let place = shadow::project(view, point.position + parameters.offset * point.normal);
    if any(place.xy < vec2f(0.0)) || any(place.xy > vec2f(1.0)) {
        return 1.0;                     // the light's view does not reach it
    }
    return textureSampleCompareLevel(spot_depth, depth_sampler, place.xy, view.layer, place.z);
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);
    let object = scene::drawn_objects[in.drawn];

    var radiance = point.emissive;
    for (var i = 0u; i < object.light_count; i++) {
        let light = scene::object_lights[object.first_light + i];
        let arriving = lighting::evaluate_light(scene::lights[light], point, to_viewer);
        radiance += lit_share(light, point) * arriving;
    }
    return vec4f(radiance, point.opacity);
}
