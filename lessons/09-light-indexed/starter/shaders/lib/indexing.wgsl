// Numbers of lights in the four channels of a texel, each of 8 bits, as digits in a base of your own.
//
// These functions run and pack nothing. Fill them in one after the other; the text says how.
#define_import_path indexing

// Yours is in README.md.
const BASE: u32 = 2u;

// No packing of this lesson has room for more.
const MOST_PLACES: u32 = 8u;

// TASK trade: how many digits a channel has room for, and so how many lights a texel.
fn capacity() -> u32 {
    return 0u;
}

// TASK trade: how many lights can have a number. 0 is no light.
fn most_lights() -> u32 {
    return 0u;
}

// TASK trade: whether a pixel that so many lights reach has no room for all of them.
fn is_over(light_count: u32) -> bool {
    return false;
}

// TASK pack: what a light writes, from 0 to 1 in each channel: the digits of its number, the lowest one in red,
// each in the uppermost place of its channel.
fn pack(number: u32) -> vec4f {
    return vec4f(0.0);
}

// TASK unpack: the numbers in a texel, in any order, with 0 where there is none.
fn unpack(texel: vec4f) -> array<u32, MOST_PLACES> {
    return array<u32, MOST_PLACES>();
}
