// Surfaces that wave, into a G-buffer.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lab

struct Corner {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) tangent: vec4f,
}

struct Texels {
    @location(0) color: vec4f,
    @location(1) normal: vec4f,
}

@vertex
fn vertex_main(corner: Corner, @builtin(instance_index) drawn: u32) -> geometry::VertexOutput {
    let moved = corner.position + lab::wave(corner.position, scene::frame.time);
    let vertex = geometry::Vertex(moved, corner.normal, corner.uv, corner.tangent);
    return geometry::transform_vertex(vertex, drawn);
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> Texels {
    let found = surface::fragment_surface(in, front_facing);
    return Texels(vec4f(found.base_color, found.specular.r), vec4f(found.normal, found.lobe.x));
}
