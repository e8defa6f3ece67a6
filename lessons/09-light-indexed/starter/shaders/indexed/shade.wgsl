// Each fragment sums the lights whose numbers its pixel holds, and those without a range.
//
// In:  a fragment; the count of lights and the packed numbers.
// Out: linear radiance; 1 where there are more lights than a pixel has room for.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import indexing

@group(1) @binding(0) var light_count: texture_2d<f32>;
@group(1) @binding(1) var indices: texture_2d<f32>;

struct Shaded {
    @location(0) light: vec4f,
    @location(1) over: f32,
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> Shaded {
    let point = surface::fragment_surface(in, front_facing);
    let to_eye = surface::safe_normalize(scene::frame.camera_position - point.position);
    let texel = vec2i(in.clip_position.xy);

    var radiance = point.emissive;
    for (var i = 0u; i < scene::frame.light_count; i++) {
        let light = scene::lights[i];
        if light.kind >= scene::LIGHT_DIRECTIONAL {
            radiance += lighting::evaluate_light(light, point, to_eye);
        }
    }
    var numbers = indexing::unpack(textureLoad(indices, texel, 0));
    for (var i = 0u; i < indexing::MOST_PLACES; i++) {
        if numbers[i] != 0u && numbers[i] <= scene::frame.light_count {
            radiance += lighting::evaluate_light(scene::lights[numbers[i] - 1u], point, to_eye);
        }
    }
    let count = u32(round(textureLoad(light_count, texel, 0).r * 255.0));
    return Shaded(vec4f(radiance, 1.0), select(0.0, 1.0, indexing::is_over(count)));
}
