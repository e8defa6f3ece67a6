// Calls `sum` for a fragment that emits 16 in blue.
//
// In:  a fragment; the list of its object; `called`: the whole list, the same again, or the first two lights of
//      it and then the rest.
// Out: what `sum` gives.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import own_sum

struct Parameters {
    called: u32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    var point = surface::fragment_surface(in, front_facing);
    point.emissive = vec3f(0.0, 0.0, 16.0);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);
    let object = scene::drawn_objects[in.drawn];
    let first = object.first_light;
    let count = object.light_count;
    switch parameters.called {
        case 0u: { return own_sum::sum(point, to_viewer, first, count, false); }
        case 1u: { return own_sum::sum(point, to_viewer, first, count, true); }
        default: {
            let some = min(count, 2u);
            return own_sum::sum(point, to_viewer, first, some, false)
                + own_sum::sum(point, to_viewer, first + some, count - some, true);
        }
    }
}
