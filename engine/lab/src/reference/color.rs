//! The twin of `shaders/lib/color.wgsl`: tone curves and sRGB.

/// Linear light to its sRGB code, both 0…1 (IEC 61966-2-1).
pub fn encode_srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The sRGB code to linear light, both 0…1.
pub fn decode_srgb(coded: f64) -> f64 {
    if coded <= 0.040_45 {
        coded / 12.92
    } else {
        ((coded + 0.055) / 1.055).powf(2.4)
    }
}

/// Reinhard et al. 2002, equation 3.
pub fn tone_reinhard(x: f64) -> f64 {
    x / (1.0 + x)
}

/// Hable 2010 with the talk's constants, white at 11.2.
pub fn tone_hable(x: f64) -> f64 {
    let curve = |x: f64| {
        let (a, b, c, d, e, f) = (0.22, 0.30, 0.10, 0.20, 0.01, 0.30);
        (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f
    };
    curve(x) / curve(11.2)
}

/// Hejl and Burgess-Dawson 2010, with the display's gamma that the fit contains.
pub fn tone_hejl_coded(x: f64) -> f64 {
    let x = (x - 0.004).max(0.0);
    x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06)
}

/// The same, ending linear as the other curves do.
pub fn tone_hejl(x: f64) -> f64 {
    tone_hejl_coded(x).powf(2.2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_round_trips_on_all_256_codes() {
        for code in 0..=255u32 {
            let coded = f64::from(code) / 255.0;
            assert_eq!(
                (encode_srgb(decode_srgb(coded)) * 255.0).round() as u32,
                code
            );
        }
        assert_eq!((encode_srgb(0.5) * 255.0).round(), 188.0);
    }

    #[test]
    fn tone_curves_give_the_published_values() {
        assert!((tone_hable(1.0) - 0.4625).abs() < 5e-5);
        assert!((tone_hable(11.2) - 1.0).abs() < 1e-12 && tone_hable(0.0).abs() < 1e-12);
        for (x, coded) in [(0.18, 0.508), (1.0, 0.8412), (4.0, 0.954)] {
            assert!((tone_hejl_coded(x) - coded).abs() < 5e-4, "{x}");
        }
        assert_eq!(tone_reinhard(1.0), 0.5);
    }
}
