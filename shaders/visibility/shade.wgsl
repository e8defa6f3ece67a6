// Visibility buffer, second pass: each pixel fetches its triangle, makes the surface there and sums
// the lights of its cluster.
//
// In:  the visibility buffer; meshes; the lists of clusters. TILE and SLICES as in
//      shaders/lib/clusters.wgsl. With COMPACT also depth.
// Out: linear radiance, black where there is nothing. With COMPACT 1 where there is something
//      without a number, which is black too. With MULTISAMPLED each pixel has four samples, which
//      are written to a square of four texels: compute shaders can't write samples. What several
//      samples show is shaded once, at the middle of the pixel.
// It is a compute pass since meshes, lists and scene take eight storage buffers, all that every
// adapter binds, and fragment stages see more of the scene than compute shaders do.
// Follows Burns and Hunt 2013, "The Visibility Buffer: A Cache-Friendly Approach to Deferred
// Shading".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import lightbench::mesh
#import lightbench::triangle
#import lightbench::visibility
#import lightbench::clusters

#ifdef MULTISAMPLED
@group(1) @binding(3) var ids: texture_multisampled_2d<u32>;
#else
@group(1) @binding(3) var ids: texture_2d<u32>;
#endif
#ifdef FULL_FLOAT
@group(1) @binding(4) var shaded: texture_storage_2d<rgba32float, write>;
#else
@group(1) @binding(4) var shaded: texture_storage_2d<rgba16float, write>;
#endif
@group(1) @binding(5) var<storage, read> cluster_lists: array<vec2u>;
@group(1) @binding(6) var<storage, read> cluster_lights: array<u32>;
#ifdef COMPACT
#ifdef MULTISAMPLED
@group(1) @binding(7) var depth: texture_depth_multisampled_2d;
#else
@group(1) @binding(7) var depth: texture_depth_2d;
#endif
@group(1) @binding(8) var without_number: texture_storage_2d<r32float, write>;
#endif

#ifdef MULTISAMPLED
// Texels along a side of a pixel's square.
const SIDE: u32 = 2u;
#else
const SIDE: u32 = 1u;
#endif
const SAMPLES: u32 = SIDE * SIDE;

// The point of an object's triangle that a pixel shows.
fn point_at(pixel: vec2f, visible: visibility::Visible) -> surface::Point {
    let instance = scene::instances[visible.instance];
    let first = visible.triangle * 3u;
    let a = mesh::fetch(mesh::vertex_at(instance, first));
    let b = mesh::fetch(mesh::vertex_at(instance, first + 1u));
    let c = mesh::fetch(mesh::vertex_at(instance, first + 2u));

    let corner = scene::world_position(instance, a.position);
    let edge_b = scene::world_tangent(instance, b.position - a.position);
    let edge_c = scene::world_tangent(instance, c.position - a.position);
    let resolution = scene::frame.resolution;
    let direction = scene::view_direction(pixel, resolution);
    let hit = triangle::meet(
        triangle::Triangle(
            (scene::frame.view * vec4f(corner, 1.0)).xyz,
            (scene::frame.view * vec4f(edge_b, 0.0)).xyz,
            (scene::frame.view * vec4f(edge_c, 0.0)).xyz,
        ),
        triangle::Sight(
            direction,
            scene::view_direction(pixel + vec2f(1.0, 0.0), resolution) - direction,
            scene::view_direction(pixel + vec2f(0.0, 1.0), resolution) - direction,
        ),
    );
    let w = hit.weights;
    let uvs = mat3x2f(a.uv, b.uv, c.uv);
    let tangent = a.tangent * w.x + b.tangent * w.y + c.tangent * w.z;
    let x = instance.world_row_x.xyz;
    let y = instance.world_row_y.xyz;
    let z = instance.world_row_z.xyz;
    let is_mirrored = dot(x, cross(y, z)) < 0.0;
    return surface::Point(
        corner + edge_b * w.y + edge_c * w.z,
        scene::world_normal(instance, a.normal * w.x + b.normal * w.y + c.normal * w.z),
        vec4f(scene::world_tangent(instance, tangent.xyz), tangent.w),
        uvs * w,
        uvs * hit.ddx,
        uvs * hit.ddy,
        visible.instance,
        hit.counter_clockwise != is_mirrored,
    );
}

// What a triangle sends to the viewer at the middle of a pixel.
fn shade(texel: vec2u, visible: visibility::Visible) -> vec3f {
    let pixel = vec2f(texel) + 0.5;
    let point = surface::point_surface(point_at(pixel, visible));
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);

    let cluster = clusters::cluster_of(pixel, scene::distance_ahead(point.position));
    let list = cluster_lists[cluster];
    var radiance = point.emissive;
    for (var i = list.x; i < list.x + list.y; i++) {
        let light = scene::lights[cluster_lights[i]];
        radiance += lighting::evaluate_light(light, point, to_viewer);
    }
    return radiance;
}

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    let texel = thread.xy;
    if any(texel >= textureDimensions(ids)) {
        return;
    }
    var seen: array<vec2u, SAMPLES>;
    var colors: array<vec4f, SAMPLES>;
    var lost = false;
    for (var sample = 0u; sample < SAMPLES; sample++) {
        seen[sample] = textureLoad(ids, texel, sample).xy;
        var same = 0u;
        while any(seen[same] != seen[sample]) {
            same++;
        }
        let visible = visibility::decode(seen[sample]);
        if same < sample {
            colors[sample] = colors[same];
        } else if visible.is_nothing {
            colors[sample] = vec4f(0.0);
        } else {
            colors[sample] = vec4f(shade(texel, visible), 1.0);
        }
#ifdef COMPACT
        lost = lost || visible.is_nothing && textureLoad(depth, texel, sample) > 0.0;
#endif
        let corner = vec2u(sample % SIDE, sample / SIDE);
        textureStore(shaded, texel * SIDE + corner, colors[sample]);
    }
#ifdef COMPACT
    textureStore(without_number, texel, vec4f(select(0.0, 1.0, lost)));
#endif
}
