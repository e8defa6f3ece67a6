// Numbers of lights in the four channels of a texel, each of 8 bits, as digits in a base.
#define_import_path indexing

const BASE: u32 = 5u;

// No packing of this lesson has room for more.
const MOST_PLACES: u32 = 8u;

// TASK trade: the most digits whose largest number is still a value of 8 bits.
fn capacity() -> u32 {
    var places = 0u;
    for (var states = BASE; states <= 256u; states *= BASE) {
        places++;
    }
    return places;
}

fn most_lights() -> u32 {
    return BASE * BASE * BASE * BASE - 1u;
}

fn is_over(light_count: u32) -> bool {
    return light_count > capacity();
}

// What a 1 in the uppermost place is worth.
fn uppermost() -> u32 {
    var worth = 1u;
    for (var i = 1u; i < capacity(); i++) {
        worth *= BASE;
    }
    return worth;
}

// What a 1 in each of the four digits of a number is worth.
const DIGITS = vec4u(1u, BASE, BASE * BASE, BASE * BASE * BASE);

// TASK pack: one digit a channel.
fn pack(number: u32) -> vec4f {
    let digits = number / DIGITS % BASE;
    return vec4f(digits * uppermost()) / 255.0;
}

// TASK unpack: the lowest digits of all channels make a number; then the next ones move down.
fn unpack(texel: vec4f) -> array<u32, MOST_PLACES> {
    var numbers: array<u32, MOST_PLACES>;
    var rest = vec4u(round(texel * 255.0));
    for (var i = 0u; i < capacity(); i++) {
        numbers[i] = dot(rest % BASE, DIGITS);
        rest /= BASE;
    }
    return numbers;
}
