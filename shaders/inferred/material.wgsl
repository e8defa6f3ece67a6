// Inferred lighting, third pass: full-size materials meet light from small buffers.
//
// In:  a fragment; the small light buffer, and which surface each of its texels shows. Without
//      OBJECT_ID the smooth groups of meshes. With LAYERED the object is transparent and reads the
//      texels of its layer alone, two apart. With UNFILTERED texels of other surfaces count too.
//      With MONOCHROME highlights take their colour from the diffuse light.
// Out: linear radiance, and opacity as alpha; the share of the light, as bilinear filtering weighs
//      it, that came from texels of the surface; 0 where none of the four shows it, so that light
//      of others had to do.
// Follows Kircher and Lawrance 2009, "Inferred Lighting".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer
#import lightbench::discontinuity
#ifndef OBJECT_ID
#import lightbench::smooth_groups
#endif

struct Parameters {
    depth_tolerance: f32,
}

@group(1) @binding(1) var surfaces: texture_2d<u32>;
@group(1) @binding(2) var light_diffuse: texture_2d<f32>;
#ifndef MONOCHROME
@group(1) @binding(3) var light_highlight: texture_2d<f32>;
#endif
@group(2) @binding(0) var<uniform> parameters: Parameters;

#ifndef OBJECT_ID
@vertex
fn vertex_main(
    vertex: geometry::Vertex,
    @builtin(vertex_index) index: u32,
    @builtin(instance_index) drawn: u32,
) -> geometry::MarkedOutput {
    let out = geometry::transform_vertex(vertex, drawn);
    return geometry::with_mark(out, smooth_groups::group_of(index));
}
#endif

// Shares below this say nothing of a surface; it is two steps of the target that keeps them.
const LEAST_SHARE: f32 = 2.0 / 255.0;

struct Gathered {
    diffuse: vec4f,
    highlight: vec3f,
}

struct Shaded {
    @location(0) hdr: vec4f,
    @location(1) acceptance: f32,
}

// Adds a share of a texel's light.
fn add(sum: Gathered, texel: vec2i, share: f32) -> Gathered {
    var out = sum;
    out.diffuse += share * textureLoad(light_diffuse, texel, 0);
#ifndef MONOCHROME
    out.highlight += share * textureLoad(light_highlight, texel, 0).rgb;
#endif
    return out;
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
#ifndef OBJECT_ID
    @location(5) @interpolate(flat) group: u32,
#endif
    @builtin(front_facing) front_facing: bool,
) -> Shaded {
#ifdef OBJECT_ID
    let group = 0u;
#endif
    let distance_ahead = scene::distance_ahead(in.world_position);
    let inverse_distance = 1.0 / distance_ahead;
    let slope = vec2f(dpdx(inverse_distance), dpdy(inverse_distance));
    let fragment = surface::fragment_surface(in, front_facing);
    let object = scene::drawn_objects[in.drawn];
    let seeker = discontinuity::Seeker(
        inverse_distance,
        slope,
        discontinuity::pack(distance_ahead, object.instance, group),
        parameters.depth_tolerance,
    );

    // The four nearest texels, or the four nearest of the layer's.
#ifdef LAYERED
    let spacing = 2;
    let first = vec2i(discontinuity::place_of_layer(object.layer));
#else
    let spacing = 1;
    let first = vec2i(0);
#endif
    let size = vec2i(textureDimensions(surfaces));
    let texels_per_pixel = vec2f(size) / scene::frame.resolution;
    let pixel = in.clip_position.xy;
    let at = (pixel * texels_per_pixel - 0.5 - vec2f(first)) / f32(spacing);
    let corner = vec2i(floor(at));
    let fraction = at - floor(at);
    let last = max((size - 1 - first) / spacing, vec2i(0));
    var own = Gathered(vec4f(0.0), vec3f(0.0));
    var own_mean = own;
    var all = own;
    var kept = 0.0;
    var found = 0.0;
    for (var i = 0; i < 4; i++) {
        let side = vec2i(i & 1, i >> 1u);
        let texel = first + spacing * clamp(corner + side, vec2i(0), last);
        let shares = select(1.0 - fraction, fraction, side == vec2i(1));
        let share = shares.x * shares.y;
        all = add(all, texel, share);
        let offset = (vec2f(texel) + 0.5) / texels_per_pixel - pixel;
        if discontinuity::is_same_surface(textureLoad(surfaces, texel, 0).xy, seeker, offset) {
            own = add(own, texel, share);
            own_mean = add(own_mean, texel, 1.0);
            kept += share;
            found += 1.0;
        }
    }
#ifdef UNFILTERED
    var light = all;
    kept = 1.0;
#else
    var light = Gathered(own.diffuse / kept, own.highlight / kept);
    if kept < LEAST_SHARE {
        // Texels of the surface are there, but only such as bilinear filtering would not look at.
        light = Gathered(own_mean.diffuse / found, own_mean.highlight / found);
        kept = LEAST_SHARE;
    }
    if found == 0.0 {
        light = all;
        kept = 0.0;
    }
#endif

#ifdef MONOCHROME
    let brightness = max(g_buffer::luminance(light.diffuse.rgb), 1e-6);
    light.highlight = light.diffuse.rgb * (light.diffuse.a / brightness);
#endif
    let radiance = fragment.emissive
        + fragment.base_color * light.diffuse.rgb
        + fragment.specular * light.highlight;
    return Shaded(vec4f(radiance, fragment.opacity), kept);
}
