// Each fragment sums the lights of its cell.
//
// In:  a fragment; the lists.
// Out: linear radiance.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import cells

@group(1) @binding(0) var<storage, read> lists: array<u32>;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let to_eye = surface::safe_normalize(scene::frame.camera_position - point.position);
    let list = cells::list_of(in.clip_position.xy, scene::distance_ahead(point.position));
    var radiance = point.emissive;
    for (var i = 1u; i <= lists[list]; i++) {
        radiance += lighting::evaluate_light(scene::lights[lists[list + i]], point, to_eye);
    }
    return vec4f(radiance, 1.0);
}
