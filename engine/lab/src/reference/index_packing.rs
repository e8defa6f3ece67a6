//! The twin of `shaders/lib/index_packing.wgsl`: numbers of lights that are blended over one
//! another.

/// How many numbers of 8 bits a pixel has room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Capacity {
    /// Four, in four channels: each light writes 2 bits into each.
    Four,
    /// Eight, in eight channels: each light writes 1 bit into each.
    Eight,
}

impl Capacity {
    /// Numbers that there is room for.
    pub fn lights(self) -> usize {
        match self {
            Self::Four => 4,
            Self::Eight => 8,
        }
    }

    /// Bits that a number has in each channel.
    fn bits(self) -> usize {
        8 / self.lights()
    }

    /// What blending multiplies old values by, which moves them down by as many bits.
    pub fn factor(self) -> f64 {
        match self {
            Self::Four => 0.251,
            Self::Eight => 0.5,
        }
    }
}

/// The channels of a pixel; the last four stay 0 where four are enough.
pub type Channels = [u8; 8];

/// What a light writes: its number's bits in the upper end of the channels.
pub fn pack(number: u8, capacity: Capacity) -> Channels {
    let bits = capacity.bits();
    let mut channels = [0; 8];
    for (index, channel) in channels[..capacity.lights()].iter_mut().enumerate() {
        let part = number >> (index * bits) & ((1 << bits) - 1);
        *channel = part << (8 - bits);
    }
    channels
}

/// new · 1 + old · factor, as a blend unit computes it that rounds by `round`.
pub fn blend(
    old: Channels,
    new: Channels,
    capacity: Capacity,
    round: impl Fn(f64) -> f64,
) -> Channels {
    let mut channels = new;
    for (channel, old) in channels.iter_mut().zip(old) {
        let sum = f64::from(*channel) + f64::from(old) * capacity.factor();
        *channel = round(sum).min(255.0) as u8;
    }
    channels
}

/// The numbers in a pixel, the last one first, with 0 where there is none.
pub fn unpack(channels: Channels, capacity: Capacity) -> Vec<u8> {
    let bits = capacity.bits();
    let number = |light: usize| {
        let used = channels[..capacity.lights()].iter().enumerate();
        used.fold(0, |number, (index, channel)| {
            let part = channel >> (8 - bits * (light + 1)) & ((1 << bits) - 1);
            number | part << (index * bits)
        })
    };
    (0..capacity.lights()).map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudo-random numbers (Steele et al. 2014, SplitMix64).
    fn next(state: &mut u64) -> u64 {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn draw(numbers: &[u8], capacity: Capacity, round: impl Fn(f64) -> f64 + Copy) -> Channels {
        numbers.iter().fold([0; 8], |old, &number| {
            blend(old, pack(number, capacity), capacity, round)
        })
    }

    #[test]
    fn twenty_thousand_sequences_decode_exactly_whether_units_round_or_cut_off() {
        let mut state = 2007;
        for capacity in [Capacity::Four, Capacity::Eight] {
            for _ in 0..20_000 {
                let length = next(&mut state) as usize % (capacity.lights() + 1);
                let numbers: Vec<u8> = (0..length)
                    .map(|_| 1 + (next(&mut state) % 255) as u8)
                    .collect();
                let mut expected: Vec<u8> = numbers.iter().rev().copied().collect();
                expected.resize(capacity.lights(), 0);
                for round in [f64::round, f64::floor] {
                    let channels = draw(&numbers, capacity, round);
                    assert_eq!(unpack(channels, capacity), expected, "{numbers:?}");
                }
            }
        }
    }

    #[test]
    fn one_number_more_corrupts() {
        let mut state = 1;
        for capacity in [Capacity::Four, Capacity::Eight] {
            let mut corrupt = 0;
            for _ in 0..1000 {
                let numbers: Vec<u8> = (0..=capacity.lights())
                    .map(|_| 1 + (next(&mut state) % 255) as u8)
                    .collect();
                let last: Vec<u8> = numbers[1..].iter().rev().copied().collect();
                let found = unpack(draw(&numbers, capacity, f64::round), capacity);
                corrupt += i32::from(found != last);
            }
            // The bits that fall off at the lower end round up those above them.
            assert!(corrupt > 500, "{corrupt} of 1000");
        }
    }
}
