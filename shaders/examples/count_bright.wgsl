// Counts the pixels of which a channel is above 1.
//
// In:  linear radiance.
// Out: one more in the first word of `bright` for each such pixel.

@group(1) @binding(0) var hdr: texture_2d<f32>;
@group(1) @binding(1) var<storage, read_write> bright: array<atomic<u32>>;

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    // Where the picture is no multiple of 8, the last workgroups have threads over.
    if any(thread.xy >= textureDimensions(hdr)) {
        return;
    }
    let radiance = textureLoad(hdr, thread.xy, 0).rgb;
    if max(radiance.r, max(radiance.g, radiance.b)) > 1.0 {
        atomicAdd(&bright[0], 1u);
    }
}
