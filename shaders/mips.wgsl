// One mip level from the next larger one: the mean, the smallest or the largest of its texels.
//
// In:  the larger level. AVERAGE, MIN or MAX; FLOAT, UNSIGNED or SIGNED texels.
// Out: a texel of the smaller level.
// A level has half the size, rounded down. Where that drops a row or column, the last texel of the
// smaller level takes three instead of two of the larger, so that none is lost: a minimum over all
// texels stays one.

#ifdef UNSIGNED
alias Texel = vec4u;
@group(0) @binding(0) var larger: texture_2d<u32>;
#else
#ifdef SIGNED
alias Texel = vec4i;
@group(0) @binding(0) var larger: texture_2d<i32>;
#else
alias Texel = vec4f;
@group(0) @binding(0) var larger: texture_2d<f32>;
#endif
#endif

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) Texel {
    let size = vec2i(textureDimensions(larger));
    let smaller = max(size / 2, vec2i(1));
    let texel = vec2i(pixel.xy);
    let first = texel * 2;
    let last = select(first + 1, size - 1, texel == smaller - 1);

    var result = textureLoad(larger, first, 0);
    var count = 0;
#ifdef AVERAGE
    result = Texel(0);
#endif
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            let value = textureLoad(larger, vec2i(x, y), 0);
#ifdef AVERAGE
            result += value;
#endif
#ifdef MIN
            result = min(result, value);
#endif
#ifdef MAX
            result = max(result, value);
#endif
            count += 1;
        }
    }
#ifdef AVERAGE
    result /= f32(count);
#endif
    return result;
}
