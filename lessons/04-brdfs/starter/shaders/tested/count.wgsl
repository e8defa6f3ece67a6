// Counts at how many angles each BRDF sends away more than arrives.
//
// In:  what was measured: a column for each angle, a row for each BRDF.
// Out: a word for each BRDF. A hundredth more is let pass, for the sake of sums that are not exact.

@group(1) @binding(0) var measured: texture_2d<f32>;
@group(1) @binding(1) var<storage, read_write> failed: array<atomic<u32>>;

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    if any(thread.xy >= textureDimensions(measured)) {
        return;
    }
    if textureLoad(measured, thread.xy, 0).r > 1.01 {
        atomicAdd(&failed[thread.y], 1u);
    }
}
