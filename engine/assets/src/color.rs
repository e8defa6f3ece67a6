//! The sRGB transfer function (IEC 61966-2-1:1999), exact in both directions
//! for 8-bit values.

use std::sync::LazyLock;

/// Linear light (0..1) of an sRGB-encoded value (0..1).
#[must_use]
pub fn srgb_to_linear(encoded: f32) -> f32 {
    decode(f64::from(encoded)) as f32
}

/// sRGB encoding (0..1) of linear light (0..1).
#[must_use]
pub fn linear_to_srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// Linear light of an sRGB byte.
#[must_use]
pub fn decode_srgb8(byte: u8) -> f32 {
    DECODED[usize::from(byte)]
}

/// The sRGB byte nearest to some linear light, measured between encoded
/// values. What lies outside 0..1 is clamped, and NaN is black.
#[must_use]
pub fn encode_srgb8(linear: f32) -> u8 {
    // Exact comparisons with the borders between neighbouring bytes, beginning
    // near the right one: several times as fast as a power function. A cast
    // from float to integer saturates, and makes 0 of NaN.
    let bucket = ((linear * BUCKETS as f32) as usize).min(BUCKETS);
    let mut byte = FIRST_BYTES[bucket];
    while byte < 255 && STEPS[usize::from(byte)] <= linear {
        byte += 1;
    }
    byte
}

/// The byte nearest to a value of 0..1. What lies outside is clamped, and NaN
/// is 0.
#[must_use]
pub fn encode_unorm8(value: f32) -> u8 {
    (value * 255.0 + 0.5) as u8
}

fn decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

static DECODED: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| decode(byte as f64 / 255.0) as f32));

/// `STEPS[i]` is the linear light from which byte `i + 1` is nearer than `i`.
static STEPS: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|byte| decode((byte as f64 + 0.5) / 255.0) as f32));

/// Ranges of linear light of equal width, each with at most two borders.
const BUCKETS: usize = 4096;

/// The byte at the lower end of each bucket.
static FIRST_BYTES: LazyLock<[u8; BUCKETS + 1]> = LazyLock::new(|| {
    std::array::from_fn(|bucket| {
        let low = bucket as f32 / BUCKETS as f32;
        STEPS.partition_point(|&step| step <= low) as u8
    })
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        for byte in 0..=255 {
            assert_eq!(encode_srgb8(decode_srgb8(byte)), byte);
            assert_eq!(encode_unorm8(f32::from(byte) / 255.0), byte);
        }
    }

    #[test]
    fn encoding_agrees_with_the_power_function() {
        for step in 0..=100_000 {
            let linear = step as f32 / 100_000.0;
            let exact = linear_to_srgb(linear) * 255.0;
            let byte = f32::from(encode_srgb8(linear));
            assert!((byte - exact).abs() < 0.501, "{linear}: {byte} for {exact}");
        }
    }

    #[test]
    fn known_values() {
        // Half of the light is byte 188; half of the code is 21.4 % of the light.
        assert_eq!(encode_srgb8(0.5), 188);
        assert!((srgb_to_linear(0.5) - 0.214_041_14).abs() < 1e-7);
        assert_eq!(encode_srgb8(f32::NAN), 0);
        assert_eq!(encode_srgb8(-1.0), 0);
        assert_eq!(encode_srgb8(f32::INFINITY), 255);
        assert_eq!(encode_unorm8(f32::NAN), 0);
        assert_eq!(encode_unorm8(2.0), 255);
    }
}
