//! How the outputs of a shader combine with what a colour target holds.

/// What an operand of a blend is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BlendFactor {
    /// 0.
    Zero,
    /// 1.
    One,
    /// The new colour.
    Source,
    /// 1 − the new colour.
    OneMinusSource,
    /// The new alpha.
    SourceAlpha,
    /// 1 − the new alpha.
    OneMinusSourceAlpha,
    /// The old colour.
    Destination,
    /// 1 − the old colour.
    OneMinusDestination,
    /// The old alpha.
    DestinationAlpha,
    /// 1 − the old alpha.
    OneMinusDestinationAlpha,
    /// The pass's `.blend_constant`.
    Constant,
    /// 1 − the pass's `.blend_constant`.
    OneMinusConstant,
}

impl BlendFactor {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 12] = [
        ("zero", Self::Zero),
        ("one", Self::One),
        ("source", Self::Source),
        ("one_minus_source", Self::OneMinusSource),
        ("source_alpha", Self::SourceAlpha),
        ("one_minus_source_alpha", Self::OneMinusSourceAlpha),
        ("destination", Self::Destination),
        ("one_minus_destination", Self::OneMinusDestination),
        ("destination_alpha", Self::DestinationAlpha),
        (
            "one_minus_destination_alpha",
            Self::OneMinusDestinationAlpha,
        ),
        ("constant", Self::Constant),
        ("one_minus_constant", Self::OneMinusConstant),
    ];
}

/// How the two products combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BlendOperation {
    /// new + old.
    Add,
    /// new − old.
    Subtract,
    /// old − new.
    ReverseSubtract,
    /// The smaller, whatever the factors.
    Min,
    /// The larger, whatever the factors.
    Max,
}

impl BlendOperation {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("add", Self::Add),
        ("subtract", Self::Subtract),
        ("reverse_subtract", Self::ReverseSubtract),
        ("min", Self::Min),
        ("max", Self::Max),
    ];
}

/// `source · new (operation) destination · old`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlendPart {
    /// Factor of the new value.
    pub source: BlendFactor,
    /// How the products combine.
    pub operation: BlendOperation,
    /// Factor of the old value.
    pub destination: BlendFactor,
}

/// How new values combine with those in a colour target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blend {
    /// New values replace old ones.
    Replace,
    /// New values are added: light accumulation.
    Add,
    /// `source · α + destination · (1 − α)`.
    Over,
    /// `source + destination · (1 − α)`: colour that is multiplied by its alpha already.
    Premultiplied,
    /// Channel by channel the smaller.
    Min,
    /// Channel by channel the larger.
    Max,
    /// Anything else.
    Custom {
        /// Red, green and blue.
        color: BlendPart,
        /// Alpha.
        alpha: BlendPart,
    },
}

impl Blend {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("replace", Self::Replace),
        ("add", Self::Add),
        ("over", Self::Over),
        ("premultiplied", Self::Premultiplied),
        ("min", Self::Min),
        ("max", Self::Max),
    ];

    /// Colour and alpha in full, or none where new values replace old ones.
    pub fn parts(self) -> Option<(BlendPart, BlendPart)> {
        use BlendFactor::{One, OneMinusSourceAlpha, SourceAlpha};
        let part = |source, operation, destination| BlendPart {
            source,
            operation,
            destination,
        };
        let same = |part| Some((part, part));
        match self {
            Self::Replace => None,
            Self::Add => same(part(One, BlendOperation::Add, One)),
            Self::Over => Some((
                part(SourceAlpha, BlendOperation::Add, OneMinusSourceAlpha),
                part(One, BlendOperation::Add, OneMinusSourceAlpha),
            )),
            Self::Premultiplied => same(part(One, BlendOperation::Add, OneMinusSourceAlpha)),
            Self::Min => same(part(One, BlendOperation::Min, One)),
            Self::Max => same(part(One, BlendOperation::Max, One)),
            Self::Custom { color, alpha } => Some((color, alpha)),
        }
    }
}

/// Which channels of a colour target are written: bit 0 red, 1 green, 2 blue, 3 alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ColorMask(pub u8);

impl ColorMask {
    /// All four.
    pub const ALL: Self = Self(0b1111);

    /// Reads channel names, as in `rgb`; none of them, or one twice, is `None`.
    pub fn from_letters(letters: &str) -> Option<Self> {
        let mut mask = 0;
        for letter in letters.chars() {
            let bit = 1 << "rgba".find(letter)?;
            if mask & bit != 0 {
                return None;
            }
            mask |= bit;
        }
        (mask != 0).then_some(Self(mask))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_are_read_from_letters() {
        assert_eq!(ColorMask::from_letters("rgba"), Some(ColorMask::ALL));
        assert_eq!(ColorMask::from_letters("ga"), Some(ColorMask(0b1010)));
        for wrong in ["", "rr", "x", "rgb "] {
            assert_eq!(ColorMask::from_letters(wrong), None, "{wrong}");
        }
    }
}
