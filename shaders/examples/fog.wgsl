// Fog of even density, as bright as the sky.
//
// In:  depth; `density` in 1/m.
// Out: the fog's radiance, and in alpha the share of the surface that it hides.
// The share that comes through falls off as exp(-density · distance) (Bouguer, Lambert, Beer).
#import lightbench::scene

struct Parameters {
    density: f32,
}

@group(1) @binding(0) var depth: texture_depth_2d;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel_depth = textureLoad(depth, vec2i(pixel.xy), 0);
    if texel_depth == 0.0 {
        return vec4f(0.0);              // the sky is its own fog
    }
    let position = scene::position_from_depth(pixel.xy, scene::frame.resolution, texel_depth);
    let metres = distance(position, scene::frame.camera_position);
    return vec4f(scene::frame.sky, 1.0 - exp(-parameters.density * metres));
}
