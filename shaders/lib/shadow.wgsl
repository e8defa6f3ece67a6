// What `shadow` passes drew, for shaders that look it up.
//
// In:  the buffers `shadow_views`, all views of the frame, and `light_shadows`, of each light the
//      first of them. A shader gets them by declaring them in group 1:
//      `var<storage, read> shadow_views: array<shadow::ShadowView>;` and
//      `var<storage, read> light_shadows: array<u32>;`.
// Out: where a point lies in a view's picture.
// Follows Williams 1978, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 12(3): depth from the
// light decides. How to filter the answer is the shader's business.
// The Rust twin of the structure lies in engine/render/src/gpu_data.rs; a test keeps the two alike.
#define_import_path lightbench::shadow

struct ShadowView {
    view_projection: mat4x4f,           // world to clip, reversed depth
    light: u32,                         // whose view it is, or NO_LIGHT
    layer: u32,                         // of the depth target
    near: f32,                          // metres
    far: f32,                           // metres
}

// In light_shadows: the light has no view.
const NO_VIEW: u32 = 0xffffffffu;
// In ShadowView: it is the view of no light.
const NO_LIGHT: u32 = 0xffffffffu;

// Texture coordinates and reversed depth of a point in a view. Outside of the picture they are not
// from 0 to 1; behind the viewer depth is 2, nearer than everything.
fn project(view: ShadowView, position: vec3f) -> vec3f {
    let clip = view.view_projection * vec4f(position, 1.0);
    if clip.w <= 0.0 {
        return vec3f(-1.0, -1.0, 2.0);
    }
    let ndc = clip.xyz / clip.w;
    return vec3f(ndc.x * 0.5 + 0.5, 0.5 - ndc.y * 0.5, ndc.z);
}

// Which of a point light's six views a direction from it meets.
fn cube_side(direction: vec3f) -> u32 {
    let size = abs(direction);
    if size.x >= size.y && size.x >= size.z {
        return select(1u, 0u, direction.x > 0.0);
    }
    if size.y >= size.z {
        return select(3u, 2u, direction.y > 0.0);
    }
    return select(5u, 4u, direction.z > 0.0);
}
