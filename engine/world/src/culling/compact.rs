//! From a test of each row to the list of the rows that pass.
//!
//! Rows are taken in blocks. The first loop writes a flag for each row of a block
//! and has no branches, so that the compiler makes vector instructions of it. The
//! second one turns eight flags at once into the list of their positions, with a
//! table instead of branches: a processor guesses wrong where every other object
//! is visible, and each wrong guess costs as much as testing ten.

use std::fmt;
use std::ops::Range;

/// Rows of a block. Its flags and its list stay in the fastest cache.
pub(crate) const BLOCK: usize = 1024;

/// Room after the list of a block, because whole vectors are written.
const SPARE: usize = 16;

/// The positions of a block's rows that pass.
type Positions = [u32; BLOCK + SPARE];

/// A test of rows.
pub(crate) trait Test: Sync {
    /// 1 for each row of the range that passes and 0 for the others, and for what
    /// follows if the range is shorter than a block.
    ///
    /// Implementations are `#[inline(always)]`, so that they are compiled with
    /// the instructions of their caller. They have a loop of its own for whole
    /// blocks: where the compiler does not know the length, it tests the last
    /// rows one by one, which takes as long as all others together.
    fn flags(&self, rows: Range<usize>) -> [u8; BLOCK];
}

/// Vector instructions that a processor may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// What every processor of its kind has: 4 numbers at once on x86-64 and ARM.
    Baseline,
    /// AVX2: 8 numbers at once.
    Avx2,
    /// AVX-512: 16 numbers at once.
    Avx512,
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        })
    }
}

/// The widest instructions that culling uses on this processor.
pub fn instruction_set() -> InstructionSet {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
        {
            return InstructionSet::Avx512;
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("popcnt") {
            return InstructionSet::Avx2;
        }
    }
    InstructionSet::Baseline
}

/// Adds the rows of a range that pass to a list, in ascending order, with the
/// widest instructions that there are.
pub(crate) fn append_passing(test: &impl Test, rows: Range<usize>, list: &mut Vec<u32>) {
    append_passing_with(instruction_set(), test, rows, list);
}

/// [`append_passing`] with instructions of the caller's choice, but never wider
/// than this processor's.
pub(crate) fn append_passing_with(
    instructions: InstructionSet,
    test: &impl Test,
    rows: Range<usize>,
    list: &mut Vec<u32>,
) {
    match instructions.min(instruction_set()) {
        // Twice as fast as the baseline, measured, and the only way to ship one
        // program for all processors.
        // SAFETY: the processor has the instructions: `instruction_set` asked it.
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        InstructionSet::Avx512 => unsafe { append_avx512(test, rows, list) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        InstructionSet::Avx2 => unsafe { append_avx2(test, rows, list) },
        _ => append(test, rows, list, positions),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,popcnt")]
fn append_avx512(test: &impl Test, rows: Range<usize>, list: &mut Vec<u32>) {
    append(test, rows, list, |flags, first, list| {
        positions_avx512(flags, first, list)
    });
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,popcnt")]
fn append_avx2(test: &impl Test, rows: Range<usize>, list: &mut Vec<u32>) {
    append(test, rows, list, positions);
}

#[inline(always)]
fn append(
    test: &impl Test,
    rows: Range<usize>,
    list: &mut Vec<u32>,
    positions: impl Fn(&[u8; BLOCK], u32, &mut Positions) -> usize,
) {
    let mut passing = [0; BLOCK + SPARE];
    let mut first = rows.start;
    while first < rows.end {
        let end = rows.end.min(first + BLOCK);
        let flags = test.flags(first..end);
        let count = positions(&flags, first as u32, &mut passing);
        list.extend_from_slice(&passing[..count]);
        first = end;
    }
}

/// The positions of the bits of a byte, lowest first; the rest is of no account.
static BIT_POSITIONS: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut bit, mut count) = (0, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                table[byte][count] = bit as u8;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    table
};

/// Writes `first` plus the position of each flag that is set, and returns how many
/// those are. Eight positions are written for every eight flags, and the next
/// eight overwrite those that do not count.
#[inline(always)]
fn positions(flags: &[u8; BLOCK], first: u32, list: &mut Positions) -> usize {
    let (groups, _) = flags.as_chunks::<8>();
    let mut count = 0;
    for (group, flags) in groups.iter().enumerate() {
        // Gathers the lowest bits of eight bytes into one: the product adds each
        // of them, shifted, to a different bit of the highest byte.
        let bits = u64::from_le_bytes(*flags).wrapping_mul(0x0102_0408_1020_4080) >> 56;
        let start = first + 8 * group as u32;
        let places = &mut list[count..count + 8];
        for (place, position) in places.iter_mut().zip(BIT_POSITIONS[bits as usize]) {
            *place = start + u32::from(position);
        }
        count += bits.count_ones() as usize;
    }
    count
}

/// [`positions`] for sixteen flags at once, with the instruction that packs the
/// chosen numbers of a vector. It halves the time of the whole test, measured.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512vl,popcnt")]
#[allow(unsafe_code)]
fn positions_avx512(flags: &[u8; BLOCK], first: u32, list: &mut Positions) -> usize {
    use std::arch::x86_64::*;
    let sixteen = _mm512_set1_epi32(16);
    let mut rows = _mm512_add_epi32(
        _mm512_set1_epi32(first as i32),
        _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),
    );
    let (groups, _) = flags.as_chunks::<16>();
    let mut count = 0;
    for group in groups {
        // SAFETY: a group is sixteen bytes long.
        let flags = unsafe { _mm_loadu_si128(group.as_ptr().cast()) };
        let chosen = _mm_test_epi8_mask(flags, flags);
        let places: &mut [u32] = &mut list[count..count + 16];
        // SAFETY: there are sixteen places of four bytes.
        unsafe {
            _mm512_storeu_si512(
                places.as_mut_ptr().cast(),
                _mm512_maskz_compress_epi32(chosen, rows),
            );
        }
        rows = _mm512_add_epi32(rows, sixteen);
        count += chosen.count_ones() as usize;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Passing(Vec<bool>);

    impl Test for Passing {
        fn flags(&self, rows: Range<usize>) -> [u8; BLOCK] {
            let mut flags = [0; BLOCK];
            for (flag, passes) in flags.iter_mut().zip(&self.0[rows]) {
                *flag = u8::from(*passes);
            }
            flags
        }
    }

    #[test]
    fn lists_exactly_the_rows_that_pass() {
        for len in [0, 1, 7, 8, 1023, 1024, 1025, 5000] {
            for pattern in [1, 2, 3, 7, 64, 10_000] {
                let test = Passing((0..len).map(|i| (i * i) % pattern == 0).collect());
                let passes = |&row: &u32| test.0[row as usize];
                let expected: Vec<u32> = (0..len as u32).filter(passes).collect();
                let mut list = Vec::new();
                append_passing(&test, 0..len, &mut list);
                assert_eq!(list, expected, "{len} {pattern}");
                if len > 300 {
                    list.clear();
                    append_passing(&test, 100..300, &mut list);
                    let inside: Vec<u32> = (100..300).filter(passes).collect();
                    assert_eq!(list, inside);
                }
            }
        }
    }
}
