// Draws the objects: those in the list with the lamps that reach them, the others as dark shapes.
//
// In:  a fragment; `in_view` and `reached`.
// Out: linear radiance.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting

@group(1) @binding(0) var<storage, read> in_view: array<u32>;
@group(1) @binding(1) var<storage, read> reached: array<u32>;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let object = scene::drawn_objects[in.drawn].instance;
    let point = surface::fragment_surface(in, front_facing);
    let to_eye = surface::safe_normalize(scene::frame.camera_position - point.position);
    if in_view[object] == 0u {
        // Not lit: what would not be drawn at all.
        return vec4f(vec3f(0.05, 0.05, 0.12) * (0.3 + 0.7 * dot(point.normal, to_eye)), 1.0);
    }
    var radiance = vec3f(0.0);
    for (var word = 0u; word < 2u; word++) {
        var bits = reached[2u * object + word];
        while bits != 0u {
            let light = scene::lights[32u * word + firstTrailingBit(bits)];
            radiance += lighting::evaluate_light(light, point, to_eye);
            bits &= bits - 1u;
        }
    }
    return vec4f(radiance, 1.0);
}
