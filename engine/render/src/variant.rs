//! The ways in which a mesh can be drawn, apart from its shader.

/// The define with which shaders can draw all reflection models, and without which they draw the
/// default one alone. Drivers that run both sides of a branch would let every surface pay for all.
pub const REFLECTION_MODELS: &str = "REFLECTION_MODELS";

/// Which of a geometry pass's pipelines draws an object: a set of four bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Variant(u8);

impl Variant {
    /// How many variants there are.
    pub const COUNT: usize = 16;
    const TWO_SIDED: u8 = 1;
    const ALPHA_TEST: u8 = 2;
    const MIRRORED: u8 = 4;
    const OTHER_MODEL: u8 = 8;

    /// The variant of a material on an object. `mirrored` is whether the object's world matrix
    /// has a negative determinant, which turns the winding of its triangles round; `other_model`
    /// whether the material is drawn with another reflection model than the default one.
    pub fn new(two_sided: bool, alpha_test: bool, mirrored: bool, other_model: bool) -> Self {
        let bit = |set: bool, bit: u8| if set { bit } else { 0 };
        Self(
            bit(two_sided, Self::TWO_SIDED)
                | bit(alpha_test, Self::ALPHA_TEST)
                | bit(mirrored, Self::MIRRORED)
                | bit(other_model, Self::OTHER_MODEL),
        )
    }

    /// All variants, in the order of [`Variant::index`].
    pub fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT as u8).map(Self)
    }

    /// Position in a table of variants.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// Both sides are drawn.
    pub fn two_sided(self) -> bool {
        self.0 & Self::TWO_SIDED != 0
    }

    /// Fragments below the material's alpha cutoff are discarded.
    pub fn alpha_test(self) -> bool {
        self.0 & Self::ALPHA_TEST != 0
    }

    /// The same in a view that swaps left and right.
    #[must_use]
    pub fn turned(self) -> Self {
        Self(self.0 ^ Self::MIRRORED)
    }

    /// Front faces wind clockwise.
    pub fn mirrored(self) -> bool {
        self.0 & Self::MIRRORED != 0
    }

    /// The reflection model is not the default one.
    pub fn other_model(self) -> bool {
        self.0 & Self::OTHER_MODEL != 0
    }

    /// The same with the default reflection model.
    #[must_use]
    pub fn with_default_model(self) -> Self {
        Self(self.0 & !Self::OTHER_MODEL)
    }

    /// The shader defines of the variant.
    pub fn defines(self) -> &'static [&'static str] {
        match (self.alpha_test(), self.other_model()) {
            (false, false) => &[],
            (true, false) => &["ALPHA_TEST"],
            (false, true) => &[REFLECTION_MODELS],
            (true, true) => &["ALPHA_TEST", REFLECTION_MODELS],
        }
    }
}

/// A set of variants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Variants(u16);

impl Variants {
    /// All of them.
    pub const ALL: Self = Self(u16::MAX);
    /// All that draw the default reflection model.
    pub const DEFAULT_MODEL: Self = Self((1 << Variant::OTHER_MODEL) - 1);

    /// Whether a variant is in the set.
    pub fn contains(self, variant: Variant) -> bool {
        self.0 & (1 << variant.index()) != 0
    }

    /// Puts a variant into the set.
    pub fn insert(&mut self, variant: Variant) {
        self.0 |= 1 << variant.index();
    }

    /// Those in either of the sets.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those that the other set does not have.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether one of them draws another reflection model than the default one.
    pub fn has_other_models(self) -> bool {
        Variant::all().any(|variant| variant.other_model() && self.contains(variant))
    }

    /// Whether there are none.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_hold_what_was_put_into_them() {
        let cloth = Variant::new(true, true, false, false);
        let mirror = Variant::new(false, false, true, true);
        let mut set = Variants::default();
        assert!(set.is_empty());
        set.insert(cloth);
        assert!(set.contains(cloth) && !set.contains(mirror));
        assert!(!set.has_other_models() && Variants::ALL.has_other_models());
        for variant in Variant::all() {
            let plain = Variants::DEFAULT_MODEL.contains(variant);
            assert_eq!(plain, !variant.other_model());
        }
        assert!(Variant::all().all(|variant| Variants::ALL.contains(variant)));
        assert!(!Variants::ALL.without(set).contains(cloth));
        assert_eq!(Variants::ALL.without(set).or(set), Variants::ALL);
    }
}
