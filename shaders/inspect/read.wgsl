// Inspect: copies texels of a slice of any target to a buffer, bit for bit.
//
// In:  the target of `lightbench::inspected`; which texels and which sample.
// Out: four words a texel, row by row.
#import lightbench::inspected

struct Request {
    corner: vec3i,      // the first texel; z is the slice of a volume
    sample: i32,
    size: vec2u,        // columns and rows
    first: u32,         // where the first texel goes
    padding: u32,
}

@group(0) @binding(0) var<uniform> request: Request;
@group(0) @binding(2) var<storage, read_write> texels: array<vec4u>;

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) at: vec3u) {
    if all(at.xy < request.size) {
        let texel = request.corner + vec3i(vec2i(at.xy), 0);
        texels[request.first + at.y * request.size.x + at.x] =
            inspected::load_bits(texel, request.sample);
    }
}
