// One lamp adds its share to a pixel of its volume.
//
// In:  a fragment of the volume, whose material emits the number of its lamp; depth; the G-buffer.
// Out: radiance to add.
// Follows Deering et al. 1988, "The Triangle Processor and Normal Vector Shader", section 4.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import own_layout

@group(1) @binding(0) var depth: texture_depth_2d;

@fragment
fn fragment_main(in: geometry::VertexOutput) -> @location(0) vec4f {
    let texel = vec2i(in.clip_position.xy);
    let texel_depth = textureLoad(depth, texel, 0);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return vec4f(0.0);
    }
    let volume = scene::instances[scene::drawn_objects[in.drawn].instance];
    let lamp = u32(scene::materials[volume.material].emissive.r);

    // What was drawn there.
    let kept = own_layout::unpack(texel);
    var point: surface::Surface;
    point.position = scene::position_from_depth(
        in.clip_position.xy, scene::frame.resolution, texel_depth,
    );
    point.normal = kept.normal;
    point.base_color = kept.base_color;
    point.specular = vec3f(kept.specular);
    point.lobe = vec2f(kept.power);
    point.opacity = 1.0;

    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);
    return vec4f(lighting::evaluate_light(scene::lights[lamp], point, to_viewer), 0.0);
}
