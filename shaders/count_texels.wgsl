// Counts texels of a target, for pipelines that tell where something did not fit.
//
// In:  `counted`. A texel counts if its red, green or blue is more than ABOVE 255ths, or, with
//      BELOW instead, if its red is less than BELOW 255ths.
// Out: the number, added to word WORD of `totals`.
// Each workgroup counts its own texels first, so that few of them meet at the total.

@group(1) @binding(0) var counted: texture_2d<f32>;
@group(1) @binding(1) var<storage, read_write> totals: array<atomic<u32>>;

var<workgroup> found: atomic<u32>;

@compute @workgroup_size(8, 8)
fn compute_main(
    @builtin(global_invocation_id) thread: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    if all(thread.xy < textureDimensions(counted)) {
        let texel = textureLoad(counted, thread.xy, 0) * 255.0;
#ifdef BELOW
        let counts = texel.r < f32(#{BELOW});
#else
        let counts = any(texel.rgb > vec3f(f32(#{ABOVE}) + 0.5));
#endif
        if counts {
            atomicAdd(&found, 1u);
        }
    }
    workgroupBarrier();
    if local == 0u {
        let count = atomicLoad(&found);
        if count > 0u {
            atomicAdd(&totals[#{WORD}], count);
        }
    }
}
