//! Colours: linear Rec. 709 inside, with the usual ways of naming one.

use lightbench_assets::color::srgb_to_linear;
use lightbench_world::glam::{DMat3, DVec3};

use crate::api::{Api, Arguments, Mistake, ScriptType};
use crate::math::{scaling, text};

/// A linear Rec. 709 colour. Channels may be above 1, as those of lights are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Color(pub(crate) DVec3);

impl ScriptType for Color {
    const NAME: &'static str = "color";
}

impl Color {
    pub(crate) fn lerp(self, other: Self, t: f64) -> Self {
        Self(self.0.lerp(other.0, t))
    }
}

impl Arguments<'_, '_, '_, '_> {
    /// A colour from the arguments at `index`: one colour, or linear red, green and blue.
    pub(crate) fn color(&self, index: usize) -> Result<DVec3, Mistake> {
        let color = if self.len() >= index + 3 {
            self.vector(index)?
        } else if let Some(color) = self.try_object::<Color>(index) {
            color.0
        } else {
            return Err(self.wrong(index, "a color"));
        };
        if color.is_finite() && color.min_element() >= 0.0 {
            Ok(color)
        } else {
            Err(Mistake::new(format!(
                "a colour has no negative channels, but this is {}",
                show(&Color(color))
            )))
        }
    }
}

pub(crate) fn register(api: &mut Api) {
    api.object::<Color>();
    api.function(
        "rgb(red, green, blue)",
        "A colour from linear Rec. 709 channels, 0 to 1 (lights may go higher).",
        |a| a.color(0).map(Color),
    );
    api.function(
        "srgb(red, green, blue)",
        "A colour from sRGB channels, 0 to 1, as colour pickers show them.",
        |a| {
            let channel = |index| a.number_in(index, 0.0, 1.0);
            Ok(decode(DVec3::new(channel(0)?, channel(1)?, channel(2)?)))
        },
    );
    api.function(
        "srgb(hex)",
        "A colour from its sRGB code, as in \"#ff8000\".",
        |a| {
            let code = a.text(0)?;
            from_hex(&code).ok_or_else(|| {
                Mistake::new(format!("`{code}` is no colour")).with_hint("write it as \"#ff8000\"")
            })
        },
    );
    api.function(
        "hsv(hue, saturation, value)",
        "A colour from its hue in degrees (0 red, 120 green, 240 blue), its saturation and its \
         value, both 0 to 1, as colour pickers show them.",
        |a| {
            let (hue, saturation, value) = (
                a.number(0)?,
                a.number_in(1, 0.0, 1.0)?,
                a.number_in(2, 0.0, 1.0)?,
            );
            Ok(hsv(hue, saturation, value))
        },
    );
    api.function(
        "kelvin(temperature)",
        "The colour of a glowing body, 1667 to 25000 K, its largest channel 1. A candle has 1900, \
         a light bulb 2700, the sun 5800.",
        |a| Ok(Color(from_kelvin(a.number_in(0, 1667.0, 25_000.0)?))),
    );
    for (index, name) in ["r", "g", "b"].into_iter().enumerate() {
        api.getter(name, "A linear channel.", move |color: Color, _| {
            Ok(color.0[index])
        });
        api.setter(name, move |color: &mut Color, a| {
            color.0[index] = a.number(0)?;
            Ok(())
        });
    }
    api.getter(
        "luminance",
        "The luminance of the colour.",
        |color: Color, _| Ok(color.0.dot(LUMINANCE)),
    );
    let engine = api.engine();
    engine
        .register_fn("+", |a: Color, b: Color| Color(a.0 + b.0))
        .register_fn("-", |a: Color, b: Color| Color(a.0 - b.0))
        .register_fn("*", |a: Color, b: Color| Color(a.0 * b.0))
        .register_fn("==", |a: Color, b: Color| a == b)
        .register_fn("!=", |a: Color, b: Color| a != b);
    scaling(engine, |color: Color, factor| Color(color.0 * factor));
    text(engine, show);
}

/// Luminance weights of Rec. 709 (ITU-R BT.709-6, 2015).
const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

fn show(color: &Color) -> String {
    format!("rgb({}, {}, {})", color.0.x, color.0.y, color.0.z)
}

fn decode(srgb: DVec3) -> Color {
    let channel = |encoded: f64| f64::from(srgb_to_linear(encoded as f32));
    Color(DVec3::new(
        channel(srgb.x),
        channel(srgb.y),
        channel(srgb.z),
    ))
}

fn from_hex(code: &str) -> Option<Color> {
    let digits = code.strip_prefix('#').unwrap_or(code);
    if digits.len() != 6 || !digits.is_ascii() {
        return None;
    }
    let channel = |at: usize| u8::from_str_radix(&digits[at..at + 2], 16).ok();
    let byte = |at: usize| channel(at).map(|byte| f64::from(byte) / 255.0);
    Some(decode(DVec3::new(byte(0)?, byte(2)?, byte(4)?)))
}

/// The colour of a hue in degrees, a saturation and a value.
pub(crate) fn hsv(hue: f64, saturation: f64, value: f64) -> Color {
    decode(from_hsv(hue, saturation, value))
}

/// Smith, "Color gamut transform pairs", SIGGRAPH 1978.
fn from_hsv(hue: f64, saturation: f64, value: f64) -> DVec3 {
    let channel = |shift: f64| {
        let k = (shift + hue / 60.0).rem_euclid(6.0);
        value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    DVec3::new(channel(5.0), channel(3.0), channel(1.0))
}

/// The Planckian locus by the cubic splines of Kim et al., "Design of advanced color temperature
/// control system for HDTV applications", J. Korean Phys. Soc. 41 (2002).
fn from_kelvin(temperature: f64) -> DVec3 {
    let t = 1e3 / temperature;
    let cubic = |a: f64, b: f64, c: f64, d: f64, x: f64| ((a * x + b) * x + c) * x + d;
    let x = if temperature <= 4000.0 {
        cubic(-0.266_123_9, -0.234_358_9, 0.877_695_6, 0.179_910, t)
    } else {
        cubic(-3.025_846_9, 2.107_037_9, 0.222_634_7, 0.240_390, t)
    };
    let y = if temperature <= 2222.0 {
        cubic(-1.106_381_4, -1.348_110_20, 2.185_558_32, -0.202_196_83, x)
    } else if temperature <= 4000.0 {
        cubic(-0.954_947_6, -1.374_185_93, 2.091_370_15, -0.167_488_67, x)
    } else {
        cubic(3.081_758_0, -5.873_386_70, 3.751_129_97, -0.370_014_83, x)
    };
    let xyz = DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let rgb = (xyz_to_rec709() * xyz).max(DVec3::ZERO);
    rgb / rgb.max_element()
}

/// From CIE XYZ to linear Rec. 709 with white D65 (IEC 61966-2-1, 1999).
fn xyz_to_rec709() -> DMat3 {
    DMat3::from_cols_array(&[
        3.240_625_5,
        -0.968_930_7,
        0.055_710_1,
        -1.537_208_0,
        1.875_756_1,
        -0.204_021_1,
        -0.498_628_6,
        0.041_517_5,
        1.056_995_9,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_of_the_six_corners() {
        let corners = [
            (0.0, DVec3::X),
            (60.0, DVec3::new(1.0, 1.0, 0.0)),
            (120.0, DVec3::Y),
            (180.0, DVec3::new(0.0, 1.0, 1.0)),
            (240.0, DVec3::Z),
            (-60.0, DVec3::new(1.0, 0.0, 1.0)),
        ];
        for (hue, expected) in corners {
            assert!(from_hsv(hue, 1.0, 1.0).distance(expected) < 1e-12, "{hue}");
        }
        assert_eq!(from_hsv(77.0, 0.0, 0.5), DVec3::splat(0.5));
    }

    #[test]
    fn glowing_bodies() {
        // Illuminant D65 is near 6504 K, and its white is (1, 1, 1); the locus runs a little beside.
        let day = from_kelvin(6504.0);
        assert!(day.distance(DVec3::ONE) < 0.08, "{day}");
        // Illuminant A, 2856 K, has the chromaticity (0.44757, 0.40745) (CIE S 014-2).
        let xyz = DVec3::new(0.44757, 0.40745, 1.0 - 0.44757 - 0.40745) / 0.40745;
        let a = xyz_to_rec709() * xyz;
        assert!(from_kelvin(2856.0).distance(a / a.max_element()) < 0.005);
        let candle = from_kelvin(1900.0);
        assert!(candle.x == 1.0 && candle.y > candle.z);
    }

    #[test]
    fn codes() {
        let orange = from_hex("#ff8000");
        assert!(orange.is_some_and(|c| c.0.x == 1.0 && (c.0.y - 0.215_861).abs() < 1e-5));
        for wrong in ["", "#fff", "#gg0000", "#ff80001", "€€"] {
            assert_eq!(from_hex(wrong), None);
        }
    }
}
