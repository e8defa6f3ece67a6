//! Sets of small numbers.

/// A set of numbers below a limit, one bit each. It is walked in ascending order,
/// which sorts without comparing.
#[derive(Clone, Debug, Default)]
pub(crate) struct BitSet {
    words: Vec<u64>,
}

impl BitSet {
    /// Empties the set and makes it hold numbers below a limit.
    pub fn reset(&mut self, limit: usize) {
        self.words.clear();
        self.words.resize(limit.div_ceil(64), 0);
    }

    #[inline]
    pub fn insert(&mut self, number: usize) {
        self.words[number / 64] |= 1 << (number % 64);
    }

    #[inline]
    pub fn contains(&self, number: usize) -> bool {
        self.words[number / 64] >> (number % 64) & 1 == 1
    }

    /// All numbers in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().flat_map(|(index, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                let bit = rest.trailing_zeros() as usize;
                // Takes the lowest bit away; wraps harmlessly when none is left.
                rest &= rest.wrapping_sub(1);
                (bit < 64).then_some(index * 64 + bit)
            })
        })
    }
}

/// Memory that a removal of many rows needs, reused from column to column.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    /// Rows to remove.
    pub holes: BitSet,
    /// Rows that move: where to and where from.
    pub moves: Vec<(u32, u32)>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_out_in_order() {
        let mut set = BitSet::default();
        set.reset(200);
        for number in [199, 0, 63, 64, 5, 128, 5] {
            set.insert(number);
        }
        assert_eq!(set.iter().collect::<Vec<_>>(), [0, 5, 63, 64, 128, 199]);
        assert!(set.contains(63) && !set.contains(62));
        set.reset(10);
        assert_eq!(set.iter().count(), 0);
    }
}
