//! The ways in which a mesh can be drawn, apart from its shader.

/// Which of a geometry pass's pipelines draws an object: a set of three bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Variant(u8);

impl Variant {
    /// How many variants there are.
    pub const COUNT: usize = 8;
    const TWO_SIDED: u8 = 1;
    const ALPHA_TEST: u8 = 2;
    const MIRRORED: u8 = 4;

    /// The variant of a material on an object. `mirrored` is whether the object's world matrix
    /// has a negative determinant, which turns the winding of its triangles round.
    pub fn new(two_sided: bool, alpha_test: bool, mirrored: bool) -> Self {
        let bit = |set: bool, bit: u8| if set { bit } else { 0 };
        Self(
            bit(two_sided, Self::TWO_SIDED)
                | bit(alpha_test, Self::ALPHA_TEST)
                | bit(mirrored, Self::MIRRORED),
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

    /// Front faces wind clockwise.
    pub fn mirrored(self) -> bool {
        self.0 & Self::MIRRORED != 0
    }

    /// The shader defines of the variant.
    pub fn defines(self) -> &'static [&'static str] {
        if self.alpha_test() {
            &["ALPHA_TEST"]
        } else {
            &[]
        }
    }
}
