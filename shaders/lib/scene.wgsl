// The scene as every shader sees it: camera, instances, materials, lights, textures.
//
// In:  group 0, bound once a frame and the same for every pass of every pipeline.
// Out: the declarations below, for `#import lightbench::scene`.
// The Rust twins of these structures lie in engine/render/src/gpu_data.rs; a test keeps the two alike.
#define_import_path lightbench::scene

// Camera and picture of this frame. View space is right-handed, looking along -z.
// Depth is reversed: 1 on the near plane, 0 on the far plane.
struct Frame {
    view: mat4x4f,                      // world to view
    projection: mat4x4f,                // view to clip
    view_projection: mat4x4f,           // world to clip
    inverse_view_projection: mat4x4f,   // clip to world
    camera_position: vec3f,             // world, metres
    time: f32,                          // seconds since the scene began
    resolution: vec2f,                  // of the output, pixels
    near: f32,                          // metres
    far: f32,                           // metres
    light_count: u32,
    frame_index: u32,
    history_frames: u32,                // frames that history targets hold; 0: they hold zeros
    padding: u32,
    previous_view_projection: mat4x4f,  // world to clip, in the frame before
    sky: vec3f,                         // radiance of all ambient lights together
}

// One object. The rows of its affine world matrix are kept, since 3 × 4 packs without padding.
struct Instance {
    world_row_x: vec4f,
    world_row_y: vec4f,
    world_row_z: vec4f,
    material: u32,
    first_index: u32,                   // of its mesh, in all meshes' indices
    base_vertex: u32,                   // what is added to each of these indices
    reserved: u32,
}

// One object that this frame draws.
struct DrawnObject {
    instance: u32,
    first_light: u32,                   // its list in object_lights
    light_count: u32,
    layer: u32,                         // which of the pass's .layers it is in, from 0
}

struct Material {
    base_color: vec3f,                  // linear Rec. 709 reflectance
    model: u32,                         // reflection model, one of the numbers in brdf.wgsl
    specular: vec3f,                    // specular reflectance at normal incidence, 0 to 1
    alpha_cutoff: f32,                  // fragments below are discarded in ALPHA_TEST variants
    emissive: vec3f,                    // radiance
    opacity: f32,                       // share of what lies behind that it hides
    lobe: vec2f,                        // exponent, 1 to 1448; or roughness along the tangent and across
    base_color_texture: u32,            // bucket << 16 | layer, or NO_TEXTURE
    normal_texture: u32,
}

struct Light {
    position: vec3f,                    // world, metres
    range: f32,                         // metres; nothing beyond
    direction: vec3f,                   // the way it shines, unit length
    kind: u32,                          // one of LIGHT_…
    intensity: vec3f,                   // colour × intensity, linear Rec. 709
    angle_scale: f32,                   // 1 / (cos inner/2 - cos outer/2)
    angle_offset: f32,                  // -cos(outer/2) · angle_scale
    reserved_a: u32,
    reserved_b: u32,
    reserved_c: u32,
}

// One light volume to draw: the affine matrix that carries the unit sphere or cone there.
struct LightVolume {
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
    light: u32,
    reserved_a: u32,
    reserved_b: u32,
    reserved_c: u32,
}

const LIGHT_POINT: u32 = 0u;
const LIGHT_SPOT: u32 = 1u;
const LIGHT_DIRECTIONAL: u32 = 2u;
const LIGHT_AMBIENT: u32 = 3u;
const NO_TEXTURE: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> instances: array<Instance>;
@group(0) @binding(2) var<storage, read> materials: array<Material>;
@group(0) @binding(3) var<storage, read> lights: array<Light>;
// What this frame draws, in drawing order; @builtin(instance_index) counts through it.
@group(0) @binding(4) var<storage, read> drawn_objects: array<DrawnObject>;
// The lists of lights of all objects, one after the other, each in the order of light indices.
@group(0) @binding(5) var<storage, read> object_lights: array<u32>;
@group(0) @binding(6) var<storage, read> light_volumes: array<LightVolume>;
@group(0) @binding(7) var material_sampler: sampler;
// Material textures, bucketed by size and format: a material holds bucket and layer.
@group(0) @binding(8) var textures_a: texture_2d_array<f32>;
@group(0) @binding(9) var textures_b: texture_2d_array<f32>;
@group(0) @binding(10) var textures_c: texture_2d_array<f32>;
@group(0) @binding(11) var textures_d: texture_2d_array<f32>;
@group(0) @binding(12) var textures_e: texture_2d_array<f32>;
@group(0) @binding(13) var textures_f: texture_2d_array<f32>;

// Object to world space. The only place that computes it, so that equal depth tests hold.
fn world_position(instance: Instance, position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    return vec3f(
        dot(instance.world_row_x, p),
        dot(instance.world_row_y, p),
        dot(instance.world_row_z, p),
    );
}

// A direction along the surface (a tangent) from object to world space; not normalised.
fn world_tangent(instance: Instance, tangent: vec3f) -> vec3f {
    return vec3f(
        dot(instance.world_row_x.xyz, tangent),
        dot(instance.world_row_y.xyz, tangent),
        dot(instance.world_row_z.xyz, tangent),
    );
}

// A normal from object to world space; not normalised. The cofactor matrix keeps normals
// perpendicular under any scale, and the sign of the determinant keeps them outward when mirrored.
fn world_normal(instance: Instance, normal: vec3f) -> vec3f {
    let x = instance.world_row_x.xyz;
    let y = instance.world_row_y.xyz;
    let z = instance.world_row_z.xyz;
    let cofactor = vec3f(dot(cross(y, z), normal), dot(cross(z, x), normal), dot(cross(x, y), normal));
    return select(-cofactor, cofactor, dot(x, cross(y, z)) >= 0.0);
}

// World to clip space. The only place that computes it.
fn clip_position(position: vec3f) -> vec4f {
    return frame.view_projection * vec4f(position, 1.0);
}

// Distance along the view, metres.
fn distance_ahead(position: vec3f) -> f32 {
    return -(frame.view * vec4f(position, 1.0)).z;
}

// World position of a pixel from its reversed depth. `pixel` is @builtin(position).xy.
fn position_from_depth(pixel: vec2f, resolution: vec2f, depth: f32) -> vec3f {
    let ndc = vec2f(pixel.x / resolution.x * 2.0 - 1.0, 1.0 - pixel.y / resolution.y * 2.0);
    let world = frame.inverse_view_projection * vec4f(ndc, depth, 1.0);
    return world.xyz / world.w;
}

// The direction of a pixel's line of sight in view space: x and y at a distance of 1 along the view.
fn view_direction(pixel: vec2f, resolution: vec2f) -> vec3f {
    let ndc = vec2f(pixel.x / resolution.x * 2.0 - 1.0, 1.0 - pixel.y / resolution.y * 2.0);
    return vec3f(ndc.x / frame.projection[0][0], ndc.y / frame.projection[1][1], -1.0);
}

// A material texture, with the gradients that the caller took in uniform control flow.
fn sample_texture(texture: u32, uv: vec2f, ddx: vec2f, ddy: vec2f) -> vec4f {
    let layer = texture & 0xffffu;
    switch texture >> 16u {
        case 0u: { return textureSampleGrad(textures_a, material_sampler, uv, layer, ddx, ddy); }
        case 1u: { return textureSampleGrad(textures_b, material_sampler, uv, layer, ddx, ddy); }
        case 2u: { return textureSampleGrad(textures_c, material_sampler, uv, layer, ddx, ddy); }
        case 3u: { return textureSampleGrad(textures_d, material_sampler, uv, layer, ddx, ddy); }
        case 4u: { return textureSampleGrad(textures_e, material_sampler, uv, layer, ddx, ddy); }
        default: { return textureSampleGrad(textures_f, material_sampler, uv, layer, ddx, ddy); }
    }
}
