// Tiled forward shading, third pass: each fragment sums the lights of its tile.
//
// In:  a fragment; the lists of `cull.wgsl`. TILE and CAPACITY as there.
// Out: linear radiance, and opacity as alpha.
// Follows Harada, McKee and Yang 2012, "Forward+: Bringing Deferred Lighting to the Next Level".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting

@group(1) @binding(0) var<storage, read> tile_lists: array<u32>;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let fragment = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);

    let columns = (u32(scene::frame.resolution.x) + #{TILE}u - 1u) / #{TILE}u;
    let tile = vec2u(in.clip_position.xy) / #{TILE}u;
    let list = (tile.y * columns + tile.x) * (#{CAPACITY}u + 1u);
    var radiance = fragment.emissive;
    for (var i = 1u; i <= tile_lists[list]; i++) {
        let light = scene::lights[tile_lists[list + i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, fragment.opacity);
}
