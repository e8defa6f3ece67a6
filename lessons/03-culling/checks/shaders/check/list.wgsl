// Shows the first 1024 words of the list, 64 a row; and in the last row what was counted.
@group(1) @binding(0) var<storage, read> counts: array<u32>;
@group(1) @binding(1) var<storage, read> list: array<u32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let column = u32(pixel.x);
    let row = u32(pixel.y);
    if row == 16u {
        return vec4f(f32(counts[min(column, 3u)]));
    }
    return vec4f(f32(list[64u * row + column]));
}
