//! The twin of `shaders/output.wgsl`: from linear radiance to what a display shows.

use std::str::FromStr;

use super::color::{encode_srgb, tone_hable, tone_hejl, tone_reinhard};
use crate::{HdrImage, LdrImage};

/// How bright light is bent into what a display can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Hable 2010.
    #[default]
    Hable,
    /// Reinhard et al. 2002.
    Reinhard,
    /// Hejl and Burgess-Dawson 2010.
    Hejl,
    /// Cut off at 1.
    Linear,
}

impl ToneCurve {
    /// All of them with the names that pipelines have for them.
    pub const NAMES: [(&str, Self); 4] = [
        ("hable", Self::Hable),
        ("reinhard", Self::Reinhard),
        ("hejl", Self::Hejl),
        ("linear", Self::Linear),
    ];

    /// A channel after the curve, 0 to 1.
    pub fn apply(self, value: f64) -> f64 {
        let mapped = match self {
            Self::Hable => tone_hable(value),
            Self::Reinhard => tone_reinhard(value),
            Self::Hejl => tone_hejl(value),
            Self::Linear => value,
        };
        mapped.clamp(0.0, 1.0)
    }
}

impl FromStr for ToneCurve {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::NAMES.iter().find(|(known, _)| *known == name);
        found.map(|(_, curve)| *curve).ok_or_else(|| {
            let names = Self::NAMES.map(|(name, _)| name).join(", ");
            format!("there is no tone curve `{name}`; there are {names}")
        })
    }
}

/// A linear picture as the pipelines' output pass shows it; `exposure` in stops.
pub fn shown(picture: &HdrImage, exposure: f64, curve: ToneCurve) -> LdrImage {
    let brightness = exposure.exp2();
    // What is no number becomes black.
    let code = |value: f32| {
        let mapped = curve.apply(f64::from(value).max(0.0) * brightness);
        (encode_srgb(mapped) * 255.0).round() as u8
    };
    let pixels = picture
        .pixels
        .iter()
        .map(|&[red, green, blue, _]| [code(red), code(green), code(blue), 255]);
    LdrImage {
        width: picture.width,
        height: picture.height,
        pixels: pixels.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_curves_are_those_of_the_pipelines() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../");
        let part = std::fs::read_to_string(format!("{folder}scripts/pipelines/parts/output.rhai"));
        let names = ToneCurve::NAMES
            .map(|(name, _)| format!("\"{name}\""))
            .join(", ");
        assert!(part.is_ok_and(|text| text.contains(&format!("[{names}]"))));
        assert_eq!("hejl".parse(), Ok(ToneCurve::Hejl));
        assert!(
            "aces"
                .parse::<ToneCurve>()
                .is_err_and(|message| message.contains("reinhard"))
        );
    }

    #[test]
    fn exposure_doubles_the_light_and_nothing_is_darker_than_black() {
        let picture = HdrImage::from_fn(2, 1, |x, _| match x {
            0 => [0.25, 0.5, 8.0, 1.0],
            _ => [-1.0, f32::NAN, 0.0, 1.0],
        });
        let shown = shown(&picture, 1.0, ToneCurve::Linear);
        assert_eq!(shown.pixels, [[188, 255, 255, 255], [0, 0, 0, 255]]);
    }
}
