//! Short names for long contents.

use std::fmt::{self, Write as _};

use sha2::{Digest as _, Sha256};

/// The SHA-256 hash (FIPS 180-4) of some content. Nobody has ever found two contents of one hash,
/// so that equal digests mean equal contents. Shown as hexadecimal digits.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Digest([u8; 32]);

impl Digest {
    /// Of bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// Of a value, by what its `Debug` writes.
    ///
    /// That is exact for types that derive it: it names every field, the fields that somebody adds
    /// later too, and each number has as many digits as it takes to tell it from all others (every
    /// NaN is one number).
    #[must_use]
    pub fn of_value(value: &(impl fmt::Debug + ?Sized)) -> Self {
        let mut hasher = Hasher::default();
        // The hasher takes everything.
        let _ = write!(hasher, "{value:?}");
        hasher.finish()
    }
}

/// Takes in a content piece by piece.
#[derive(Default)]
pub(crate) struct Hasher(Sha256);

impl Hasher {
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    pub(crate) fn finish(self) -> Digest {
        Digest(self.0.finalize().into())
    }
}

impl fmt::Write for Hasher {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.add(text.as_bytes());
        Ok(())
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn digests_are_those_of_the_standard() {
        // The test vectors of FIPS 180-4 for "abc" and the empty message.
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(Digest::of(b"abc").to_string(), expected);
        let mut hasher = Hasher::default();
        hasher.add(b"a");
        hasher.add(b"bc");
        assert_eq!(hasher.finish().to_string(), expected);
        let expected = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(Digest::of(b"").to_string(), expected);
    }

    #[test]
    fn values_that_differ_in_one_bit_differ() {
        let next = f32::from_bits(0.1_f32.to_bits() + 1);
        let of = |x: f32| Digest::of_value(&("stone", Vec3::new(x, 1.0, 2.0)));
        assert_eq!(of(0.1), of(0.1));
        assert_ne!(of(0.1), of(next));
        assert_ne!(of(0.0), of(-0.0));
        assert_ne!(of(1e30), of(f32::from_bits(1e30_f32.to_bits() + 1)));
        // Texts can't imitate what follows them.
        assert_ne!(
            Digest::of_value(&("a", "b")),
            Digest::of_value(&("a\", \"b", ""))
        );
    }
}
