// Calls one function of shaders/lib/indexing.wgsl for each pixel of a picture of 48 × 32.
//
// In:  which function; the base, the digits that a channel has room for, and the first number.
// Out: what it gives. Of numbers in a texel their count, their sum and the sum of their squares, so that
//      their order does not matter.
#import indexing

struct Parameters {
    function: u32,
    base: f32,
    capacity: f32,
    first: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// The number that is drawn at a time into a pixel; some pixels have fewer than there is room for.
fn number_at(pixel: vec2u, time: u32) -> u32 {
    let base = u32(parameters.base);
    let most = base * base * base * base - 1u;
    if time >= pixel.x % (u32(parameters.capacity) + 1u) {
        return 0u;
    }
    return 1u + (pixel.x * 37u + pixel.y * 101u + time * 211u + u32(parameters.first)) % most;
}

// The texel that these numbers leave, the last one in the uppermost place. Where a column is odd its values are a
// little too small, as a driver may give them.
fn texel_of(pixel: vec2u) -> vec4f {
    let base = u32(parameters.base);
    let capacity = u32(parameters.capacity);
    let count = pixel.x % (capacity + 1u);
    var channels = vec4u(0u);
    for (var time = 0u; time < count; time++) {
        var worth = 1u;
        for (var i = 0u; i < capacity - count + time; i++) {
            worth *= base;
        }
        let number = number_at(pixel, time);
        let digits = vec4u(number, number / base, number / (base * base), number / (base * base * base)) % base;
        channels += digits * worth;
    }
    return (vec4f(channels) - select(0.0, 0.1, pixel.x % 2u == 1u)) / 255.0;
}

@fragment
fn fragment_main(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    switch parameters.function {
        case 0u: {
            let over = select(0.0, 1.0, indexing::is_over(pixel.x));
            return vec4f(f32(indexing::capacity()), f32(indexing::most_lights()), over, 1.0);
        }
        case 1u: { return indexing::pack(number_of(pixel)); }
        case 2u: { return indexing::pack(number_of(pixel)).aaaa; }
        default: {
            var numbers = indexing::unpack(max(texel_of(pixel), vec4f(0.0)));
            var sums = vec3f(0.0);
            for (var i = 0u; i < indexing::MOST_PLACES; i++) {
                let number = f32(numbers[i]);
                sums += vec3f(min(number, 1.0), number, number * number);
            }
            return vec4f(sums, 1.0);
        }
    }
}

fn number_of(pixel: vec2u) -> u32 {
    let base = u32(parameters.base);
    let most = base * base * base * base - 1u;
    return 1u + (pixel.y * 48u + pixel.x + u32(parameters.first)) % most;
}
