// Full-size materials meet light from small buffers.
//
// In:  a fragment; the small light buffers, and which surface each of their texels shows. With LAYERED the object
//      is transparent and reads the texels of its layer alone.
// Out: linear radiance, and opacity as alpha; 1 where no texel shows the surface.
// Follows Kircher and Lawrance 2009, "Inferred Lighting".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import inference

struct Parameters {
    tolerance: f32,
}

@group(1) @binding(0) var surfaces: texture_2d<u32>;
@group(1) @binding(1) var light_diffuse: texture_2d<f32>;
@group(1) @binding(2) var light_highlight: texture_2d<f32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

struct Shaded {
    @location(0) light: vec4f,
    @location(1) without: f32,
}

// Beyond the edge of the buffer the last texels count, of a layer its own last ones.
fn inside(texel: vec2i, size: vec2i, spacing: i32) -> vec2i {
    let before = select(texel, texel + spacing, texel < vec2i(0));
    return max(select(before, before - spacing, before >= size), vec2i(0));
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> Shaded {
    let distance_ahead = scene::distance_ahead(in.world_position);
    let inverse = 1.0 / distance_ahead;
    let slope = vec2f(dpdx(inverse), dpdy(inverse));
    let point = surface::fragment_surface(in, front_facing);
    let object = scene::drawn_objects[in.drawn];

    let size = vec2i(textureDimensions(surfaces));
    let texels_per_pixel = vec2f(size) / scene::frame.resolution;
    let pixel = in.clip_position.xy;
#ifdef LAYERED
    let around = inference::layer_footprint(pixel * texels_per_pixel, object.layer);
    let spacing = i32(inference::PERIOD);
#else
    let around = inference::footprint(pixel * texels_per_pixel);
    let spacing = 1;
#endif
    var texels: array<vec2i, 4>;
    var same: vec4<bool>;
    for (var i = 0; i < 4; i++) {
        texels[i] = inside(around.corner + spacing * vec2i(i & 1, i >> 1u), size, spacing);
        let offset = (vec2f(texels[i]) + 0.5) / texels_per_pixel - pixel;
        let expected = inference::expected_distance(distance_ahead, slope, offset);
        let key = textureLoad(surfaces, texels[i], 0).x;
        same[i] = inference::is_same(key, object.instance, expected, parameters.tolerance);
    }
    let weights = inference::weights(around.fraction, same);
    var diffuse = vec3f(0.0);
    var highlight = vec3f(0.0);
    for (var i = 0; i < 4; i++) {
        diffuse += weights[i] * textureLoad(light_diffuse, texels[i], 0).rgb;
        highlight += weights[i] * textureLoad(light_highlight, texels[i], 0).rgb;
    }
    let radiance = point.emissive + point.base_color * diffuse + point.specular * highlight;
    return Shaded(vec4f(radiance, point.opacity), select(1.0, 0.0, any(same)));
}
