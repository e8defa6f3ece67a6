//! Smooth noise: hills and flickering that look natural and are the same in every run.

use crate::api::Api;

pub(crate) fn register(api: &mut Api) {
    for form in ["noise(x)", "noise(x, y)", "noise(x, y, z)"] {
        api.function(
            form,
            "Smooth noise of about -1 to 1, with one hill or valley to a unit of length.",
            |a| {
                let mut at = [0.0; 3];
                for (index, coordinate) in at.iter_mut().take(a.len()).enumerate() {
                    *coordinate = a.number(index)?;
                }
                Ok(noise_along(&at[..a.len()]))
            },
        );
    }
    api.function(
        "fractal_noise(x, y, z, octaves)",
        "A sum of noises, each half as large and half as strong as the one before; about -1 to 1.",
        |a| {
            let at = [a.number(0)?, a.number(1)?, a.number(2)?];
            let octaves = a.whole(3, 1, 16)?;
            Ok(fractal_noise(at, octaves as u32))
        },
    );
}

/// Noise along one axis, in a plane or in space. At whole numbers gradient noise is 0; off them in the
/// missing directions, it is not 0 along a whole line.
pub(crate) fn noise_along(coordinates: &[f64]) -> f64 {
    let mut at = [0.37; 3];
    for (coordinate, given) in at.iter_mut().zip(coordinates) {
        *coordinate = *given;
    }
    noise(at)
}

/// A sum of noises, each half as large and half as strong as the one before. At most 32 of them.
pub(crate) fn fractal_noise(at: [f64; 3], octaves: u32) -> f64 {
    let (mut sum, mut total, mut weight) = (0.0, 0.0, 1.0);
    for octave in 0..octaves {
        let scale = f64::from(1_u32 << octave);
        sum += weight * noise(at.map(|coordinate| coordinate * scale + f64::from(octave) * 17.3));
        total += weight;
        weight *= 0.5;
    }
    sum / total
}

/// Gradient noise (Perlin, "Improving noise", SIGGRAPH 2002), with lattice gradients from a hash in
/// place of the table.
fn noise(at: [f64; 3]) -> f64 {
    let cell = at.map(f64::floor);
    let inside = [at[0] - cell[0], at[1] - cell[1], at[2] - cell[2]];
    let fade = inside.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    // Casts to integers saturate; far from the origin the noise is flat.
    let lattice = cell.map(|coordinate| coordinate as i64 as u32);
    let corner = |x: u32, y: u32, z: u32| {
        let hash = pcg(lattice[0].wrapping_add(x).wrapping_add(pcg(lattice[1]
            .wrapping_add(y)
            .wrapping_add(pcg(lattice[2].wrapping_add(z))))));
        slope(
            hash,
            [
                inside[0] - f64::from(x),
                inside[1] - f64::from(y),
                inside[2] - f64::from(z),
            ],
        )
    };
    let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let along_x = |y, z| lerp(corner(0, y, z), corner(1, y, z), fade[0]);
    let plane = |z| lerp(along_x(0, z), along_x(1, z), fade[1]);
    lerp(plane(0), plane(1), fade[2])
}

/// The product with one of the twelve edges of a cube.
fn slope(hash: u32, [x, y, z]: [f64; 3]) -> f64 {
    let (u, v) = match (hash >> 8) % 3 {
        0 => (x, y),
        1 => (x, z),
        _ => (y, z),
    };
    let sign = |bit: u32, value: f64| if hash >> bit & 1 == 1 { -value } else { value };
    sign(0, u) + sign(1, v)
}

/// PCG as a hash (Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 2020).
fn pcg(input: u32) -> u32 {
    let state = input.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_smooth_bounded_and_centred() {
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
        let step = 1e-4;
        for i in 0..40_000 {
            let t = f64::from(i);
            let at = [t * 0.137, t * 0.071 - 900.0, t * 0.0313];
            let value = noise(at);
            let beside = noise([at[0] + step, at[1], at[2]]);
            assert!(value.abs() <= 1.05, "{value}");
            assert!((value - beside).abs() < 5.0 * step, "a jump at {at:?}");
            sum += value;
            squares += value * value;
            count += 1.0;
        }
        assert!((sum / count).abs() < 0.01);
        assert!(squares / count > 0.05);
        assert_eq!(noise([3.0, -7.0, 12.0]), 0.0);
    }
}
