// The lights of a pixel, from the numbers that are kept for it.
//
// In:  the pictures of numbers and the count of lights; the light of each number; the lights
//      without a range. CAPACITY and ARRAYS as in shaders/lib/index_packing.wgsl.
// Out: what all these lights make a surface send to the viewer; whether lights were lost.
#define_import_path lightbench::pixel_lights

#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::index_packing

// For each pixel the lights that reach it, as 255ths.
@group(1) @binding(0) var light_count: texture_2d<f32>;
@group(1) @binding(1) var light_indices: texture_2d<f32>;
#if CAPACITY == 8
@group(1) @binding(2) var light_indices_more: texture_2d<f32>;
#endif
// The light that has each number.
@group(1) @binding(3) var<storage, read> numbered_lights: array<u32>;
// How many, then which.
@group(1) @binding(4) var<storage, read> unbounded_lights: array<u32>;

struct PixelLights {
    radiance: vec3f,                    // towards the viewer
    lost: bool,                         // whether more lights reach the pixel than it has numbers
}

fn sum(texel: vec2i, point: surface::Surface) -> PixelLights {
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);
    var radiance = vec3f(0.0);
    for (var i = 1u; i <= unbounded_lights[0]; i++) {
        let light = scene::lights[unbounded_lights[i]];
        radiance += lighting::evaluate_light(light, point, to_viewer);
    }
    var texels = index_packing::Texels(textureLoad(light_indices, texel, 0), vec4f(0.0));
#if CAPACITY == 8
    texels.second = textureLoad(light_indices_more, texel, 0);
#endif
    var numbers = index_packing::sort(index_packing::unpack(texels));
    var found = 0u;
    for (var i = 0u; i < index_packing::CAPACITY; i++) {
        if numbers[i] != 0u {
            found += 1u;
            let light = scene::lights[numbered_lights[numbers[i]]];
            radiance += lighting::evaluate_light(light, point, to_viewer);
        }
    }
    let reaching = u32(round(textureLoad(light_count, texel, 0).r * 255.0));
    return PixelLights(radiance, reaching > found);
}
