// Numbers of lights in the texels of pictures: a few for each pixel, each of 8 bits.
//
// In:  numbers from 1 to 255; 0 is no light. CAPACITY is how many a pixel has room for: 4 in one
//      picture, 8 in two. With ARRAYS each channel holds one number; without, lights are blended
//      over one another and each number is spread over all channels.
// Out: what a light writes; the numbers in a texel.
// Packing by blending: a light writes its number's bits into the upper end of the channels, 2 bits
// into each of four, or 1 bit into each of eight; blending first moves down what is there, by the
// constant factor 1/4 or 1/2. So the light drawn last is in the uppermost bits.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering". His factor of 0.251 in place of 1/4 is
// 64 of 255: units that keep it in 8 bits, or cut off where they should round, are exact too. A twin
// lies in engine/lab/src/reference/index_packing.rs.
#define_import_path lightbench::index_packing

const CAPACITY: u32 = #{CAPACITY}u;

// The two pictures; the second is black where one is enough.
struct Texels {
    first: vec4f,
    second: vec4f,
}

// What a light writes.
fn pack(number: u32) -> Texels {
#ifdef ARRAYS
    // The pass's arrays choose the channel.
    return Texels(vec4f(f32(number) / 255.0), vec4f(f32(number) / 255.0));
#else
#if CAPACITY == 8
    let low = (vec4u(number) >> vec4u(0u, 1u, 2u, 3u)) & vec4u(1u);
    let high = (vec4u(number) >> vec4u(4u, 5u, 6u, 7u)) & vec4u(1u);
    return Texels(vec4f(low << vec4u(7u)) / 255.0, vec4f(high << vec4u(7u)) / 255.0);
#else
    let bits = (vec4u(number) >> vec4u(0u, 2u, 4u, 6u)) & vec4u(3u);
    return Texels(vec4f(bits << vec4u(6u)) / 255.0, vec4f(0.0));
#endif
#endif
}

// The numbers in a texel, in no order, with 0 where there is no light.
fn unpack(texels: Texels) -> array<u32, CAPACITY> {
    let first = vec4u(round(texels.first * 255.0));
    let second = vec4u(round(texels.second * 255.0));
    var numbers: array<u32, CAPACITY>;
#ifdef ARRAYS
    for (var i = 0u; i < CAPACITY; i++) {
        numbers[i] = select(second[i & 3u], first[i & 3u], i < 4u);
    }
#else
    for (var i = 0u; i < CAPACITY; i++) {
#if CAPACITY == 8
        let low = (first >> vec4u(7u - i)) & vec4u(1u);
        let high = (second >> vec4u(7u - i)) & vec4u(1u);
        numbers[i] = low.x | low.y << 1u | low.z << 2u | low.w << 3u
            | high.x << 4u | high.y << 5u | high.z << 6u | high.w << 7u;
#else
        let bits = (first >> vec4u(6u - 2u * i)) & vec4u(3u);
        numbers[i] = bits.x | bits.y << 2u | bits.z << 4u | bits.w << 6u;
#endif
    }
#endif
    return numbers;
}

// In ascending order, so that light is added in the same order everywhere. By insertion: they are
// few.
fn sort(unsorted: array<u32, CAPACITY>) -> array<u32, CAPACITY> {
    var numbers = unsorted;
    for (var i = 1u; i < CAPACITY; i++) {
        let number = numbers[i];
        var at = i;
        while at > 0u && numbers[max(at, 1u) - 1u] > number {
            numbers[at] = numbers[at - 1u];
            at -= 1u;
        }
        numbers[at] = number;
    }
    return numbers;
}
