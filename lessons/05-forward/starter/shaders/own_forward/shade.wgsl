// Forward shading: a fragment is lit as it is drawn.
//
// In:  a fragment; the list of lights that the pass gives to its object. With AGAIN an earlier pass has drawn
//      what the surface emits.
// Out: linear radiance; in alpha the number of lights evaluated.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import own_sum

#ifdef AGAIN
const AGAIN = true;
#else
const AGAIN = false;
#endif

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);
    let object = scene::drawn_objects[in.drawn];
    return own_sum::sum(point, to_viewer, object.first_light, object.light_count, AGAIN);
}
