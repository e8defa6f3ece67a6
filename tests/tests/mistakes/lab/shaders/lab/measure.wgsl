// The mean of each tile of the picture, and how many pixels are bright.
const SIDE: u32 = #{TILE}u;

@group(1) @binding(0) var hdr: texture_2d<f32>;
@group(1) @binding(1) var small: texture_storage_2d<rgba16float, write>;
@group(1) @binding(2) var<storage, read_write> totals: array<atomic<u32>>;

var<workgroup> sums: array<vec3f, SIDE * SIDE>;

@compute @workgroup_size(SIDE, SIDE)
fn compute_main(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(global_invocation_id) pixel: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let color = textureLoad(hdr, pixel.xy, 0).rgb;
    if max(color.r, max(color.g, color.b)) > 1.0 {
        atomicAdd(&totals[0], 1u);
    }
    sums[thread] = color;
    workgroupBarrier();
    if thread == 0u {
        var mean = vec3f(0.0);
        for (var i = 0u; i < SIDE * SIDE; i++) {
            mean += sums[i] / f32(SIDE * SIDE);
        }
        textureStore(small, tile.xy, vec4f(mean, 1.0));
    }
}
