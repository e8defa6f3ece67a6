// The third pass: a material meets the light that was gathered for its pixel.
//
// In:  a fragment; the light buffer; `through`.
// Out: what `meet` makes of them: linear radiance.
#import lightbench::geometry
#import lightbench::surface
#import own_buffer

struct Parameters {
    through: f32,
}

@group(1) @binding(0) var light_front: texture_2d<f32>;
@group(1) @binding(1) var light_back: texture_2d<f32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let texel = vec2i(in.clip_position.xy);
    let light = own_buffer::Gathered(
        textureLoad(light_front, texel, 0),
        textureLoad(light_back, texel, 0),
    );
    let material = own_buffer::Material(
        point.base_color,
        parameters.through * point.base_color,
        point.specular,
        point.emissive,
    );
    return vec4f(own_buffer::meet(material, light), 1.0);
}
