// Deferred shading with four samples: finds the pixels whose samples must be lit one by one.
//
// In:  the G-buffer with all its samples; `edge_angle` in degrees; `edge_depth` as a share of the
//      distance.
// Out: a fragment, which marks its pixel in stencil; elsewhere none.
// A pixel is an edge where one of its samples shows another surface than the first: it is farther or
// nearer, turned by more than an angle, or of another material. Samples of one flat surface have equal
// depth here, since all hold that of the pixel's middle; so the slope of a surface makes no edges.
// Follows Thibieroz 2009, "Deferred Shading with Multisampling Anti-Aliasing in DirectX 10",
// ShaderX7.
#import lightbench::culling
#import lightbench::g_buffer
#import lightbench::g_buffer_texels

struct Parameters {
    edge_angle: f32,
    edge_depth: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// Differences of colours below are not seen: 8 of 255 steps of their roots.
const COLOR: f32 = 8.5 / 255.0;

fn differs(texel: vec2u, sample: u32) -> bool {
    let first_depth = g_buffer_texels::depth_at(texel, 0u);
    let depth = g_buffer_texels::depth_at(texel, sample);
    if first_depth == 0.0 || depth == 0.0 {
        return first_depth != depth;
    }
    let first_distance = culling::view_distance(first_depth);
    let distance = culling::view_distance(depth);
    if abs(distance - first_distance) > parameters.edge_depth * first_distance {
        return true;
    }
    let a = g_buffer_texels::surface_at(texel, 0u);
    let b = g_buffer_texels::surface_at(texel, sample);
    let colors = max(
        abs(sqrt(a.base_color) - sqrt(b.base_color)),
        abs(sqrt(a.specular) - sqrt(b.specular)),
    );
    let glosses = abs(g_buffer::pack_gloss(a.model, a.lobe) - g_buffer::pack_gloss(b.model, b.lobe));
    return a.model != b.model
        || dot(a.normal, b.normal) < cos(radians(parameters.edge_angle))
        || any(colors > vec3f(COLOR))
        || any(glosses > vec2f(COLOR));
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) {
    let texel = vec2u(pixel.xy);
    var is_edge = false;
    for (var sample = 1u; sample < 4u; sample++) {
        is_edge = is_edge || differs(texel, sample);
    }
    if !is_edge {
        discard;
    }
}
