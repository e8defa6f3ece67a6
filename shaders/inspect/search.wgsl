// Inspect: looks for values in a slice of a target that are not numbers, or infinite.
//
// In:  the target of `lightbench::inspected`, of floats or depth; which slice and sample.
// Out: how many texels hold one, and the first of them, row by row.
#import lightbench::inspected

struct Request {
    corner: vec3i,      // z is the slice of a volume
    sample: i32,
    size: vec2u,        // columns and rows
    first: u32,         // where the answer goes
    padding: u32,
}

@group(0) @binding(0) var<uniform> request: Request;
@group(0) @binding(2) var<storage, read_write> answers: array<atomic<u32>>;

// Infinities and what is no number have all bits of the exponent set.
const EXPONENT: u32 = 0x7f800000u;

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) at: vec3u) {
    if any(at.xy >= request.size) {
        return;
    }
    let texel = request.corner + vec3i(vec2i(at.xy), 0);
    let bits = inspected::load_bits(texel, request.sample);
    if any((bits & vec4u(EXPONENT)) == vec4u(EXPONENT)) {
        atomicAdd(&answers[request.first], 1u);
        // The largest number stands for the first texel: the buffer begins as zeros.
        atomicMax(&answers[request.first + 1u], 0xffffffffu - (at.y * request.size.x + at.x));
    }
}
