//! Spheres against one volume.

use std::ops::Range;

use super::compact::{BLOCK, Test, append_passing_with};
use super::{Frustum, InstructionSet, Volume, instruction_set};

/// Bounding spheres as four arrays of the same length, in metres.
#[derive(Clone, Copy, Debug)]
pub struct Spheres<'a> {
    /// Centres, x.
    pub x: &'a [f32],
    /// Centres, y.
    pub y: &'a [f32],
    /// Centres, z.
    pub z: &'a [f32],
    /// Radii.
    pub radius: &'a [f32],
}

impl Spheres<'_> {
    /// Number of spheres: the length of the shortest array.
    pub fn len(&self) -> usize {
        let lengths = [self.y.len(), self.z.len(), self.radius.len()];
        lengths.into_iter().fold(self.x.len(), usize::min)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Fills `visible` with the rows of the spheres that a volume may touch, in
/// ascending order: what a view shows ([`Frustum`]), or what a light reaches
/// ([`Ball`](super::Ball), [`Cone`](super::Cone)). The vector's memory is reused.
pub fn cull_spheres<V: Volume>(volume: &V, spheres: Spheres<'_>, visible: &mut Vec<u32>) {
    cull_spheres_with(instruction_set(), volume, spheres, visible);
}

/// [`cull_spheres`] with instructions of the caller's choice, to compare them. If
/// the processor lacks them, narrower ones are taken.
pub fn cull_spheres_with<V: Volume>(
    instructions: InstructionSet,
    volume: &V,
    spheres: Spheres<'_>,
    visible: &mut Vec<u32>,
) {
    visible.clear();
    let test = SphereTest { volume, spheres };
    append_passing_with(instructions, &test, 0..spheres.len(), visible);
}

impl Frustum {
    /// Whether a sphere may be visible: no plane has it wholly outside. A sphere
    /// with a coordinate that is not a number is not visible.
    #[inline(always)]
    pub fn intersects_sphere(&self, x: f32, y: f32, z: f32, radius: f32) -> bool {
        let [a, b, c, d, e, f] = &self.planes;
        let inside = |plane: &super::Plane| plane.distance_to(x, y, z) >= -radius;
        inside(a) & inside(b) & inside(c) & inside(d) & inside(e) & inside(f)
    }
}

impl Volume for Frustum {
    #[inline(always)]
    fn touches(&self, x: f32, y: f32, z: f32, radius: f32) -> bool {
        self.intersects_sphere(x, y, z, radius)
    }
}

/// All spheres against one volume.
pub(crate) struct SphereTest<'a, V> {
    pub volume: &'a V,
    pub spheres: Spheres<'a>,
}

impl<V: Volume> Test for SphereTest<'_, V> {
    #[inline(always)]
    fn flags(&self, rows: Range<usize>) -> [u8; BLOCK] {
        let mut flags = [0; BLOCK];
        // A copy, of which the compiler knows that nobody else writes it.
        let volume = *self.volume;
        let x = &self.spheres.x[rows.clone()];
        let y = &self.spheres.y[rows.clone()];
        let z = &self.spheres.z[rows.clone()];
        let radius = &self.spheres.radius[rows];
        if let (Some(x), Some(y), Some(z), Some(radius)) = (
            x.first_chunk::<BLOCK>(),
            y.first_chunk::<BLOCK>(),
            z.first_chunk::<BLOCK>(),
            radius.first_chunk::<BLOCK>(),
        ) {
            for i in 0..BLOCK {
                flags[i] = u8::from(volume.touches(x[i], y[i], z[i], radius[i]));
            }
        } else {
            for (flag, (((x, y), z), radius)) in
                flags.iter_mut().zip(x.iter().zip(y).zip(z).zip(radius))
            {
                *flag = u8::from(volume.touches(*x, *y, *z, *radius));
            }
        }
        flags
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::culling::{Ball, Cone, Plane};
    use glam::{Mat4, Vec3, Vec3Swizzles};
    use rand::{Rng, SeedableRng};

    /// Coordinates of every size, and those that make trouble.
    fn coordinate(random: &mut impl Rng) -> f32 {
        match random.random_range(0..24) {
            0 => f32::NAN,
            1 => f32::INFINITY,
            2 => f32::NEG_INFINITY,
            3 => f32::MAX,
            4 => f32::MIN_POSITIVE / 4.0,
            5 => -0.0,
            6 => random.random_range(-1e12..1e12),
            _ => random.random_range(-20.0..20.0),
        }
    }

    fn check<V: Volume>(volume: &V, arrays: &[Vec<f32>; 4]) {
        let [x, y, z, radius] = arrays;
        let spheres = Spheres { x, y, z, radius };
        let expected: Vec<u32> = (0..spheres.len())
            .filter(|&i| volume.touches(x[i], y[i], z[i], radius[i]))
            .map(|i| i as u32)
            .collect();
        let mut visible = vec![7; 3];
        cull_spheres(volume, spheres, &mut visible);
        assert_eq!(visible, expected);
        for instructions in [
            InstructionSet::Baseline,
            InstructionSet::Avx2,
            InstructionSet::Avx512,
        ] {
            cull_spheres_with(instructions, volume, spheres, &mut visible);
            assert_eq!(visible, expected, "{instructions}");
        }
    }

    #[test]
    fn every_instruction_set_finds_the_same_rows() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(1);
        for round in 0..200 {
            let count = random.random_range(0..1500);
            let arrays: [Vec<f32>; 4] =
                std::array::from_fn(|_| (0..count).map(|_| coordinate(&mut random)).collect());
            let matrix = match round % 4 {
                0 => Mat4::from_cols_array(&std::array::from_fn(|_| coordinate(&mut random))),
                1 => Mat4::ZERO,
                _ => {
                    let numbers = std::array::from_fn(|_| random.random_range(-1.0..1.0));
                    Mat4::from_cols_array(&numbers)
                }
            };
            check(&Frustum::from_view_projection(matrix), &arrays);
            let point = Vec3::from_array(std::array::from_fn(|_| coordinate(&mut random)));
            let radius = coordinate(&mut random);
            let center = point;
            check(&Ball { center, radius }, &arrays);
            check(&Cone::new(point, center.yzx(), radius, 1.0), &arrays);
        }
    }

    #[test]
    fn the_frustum_test_is_that_of_its_planes() {
        let plane = |normal, distance| Plane { normal, distance };
        let frustum = Frustum {
            planes: [
                plane(Vec3::X, 1.0),
                plane(Vec3::NEG_X, 1.0),
                plane(Vec3::Y, 1.0),
                plane(Vec3::NEG_Y, 1.0),
                plane(Vec3::Z, 1.0),
                Plane::EVERYTHING,
            ],
        };
        assert!(frustum.touches(1.5, 0.0, 1e30, 0.5));
        assert!(!frustum.touches(1.5, 0.0, 0.0, 0.49));
        let nothing = Frustum {
            planes: [Plane::NOTHING; 6],
        };
        assert!(!nothing.touches(0.0, 0.0, 0.0, 1e30));
    }
}
