//! Volumes that spheres are tested against, beside the view frustum: what a light
//! reaches.

use std::f32::consts::FRAC_PI_2;

use glam::Vec3;

/// A volume that can say whether a sphere may touch it.
pub trait Volume: Copy + Sync {
    /// Whether a sphere may touch the volume. Never false for one that does; may
    /// be true for one that passes close by. False if the sphere has a coordinate
    /// that is not a number.
    ///
    /// Implementations have no branches and are `#[inline(always)]`, so that the
    /// compiler can test many spheres at once.
    fn touches(&self, x: f32, y: f32, z: f32, radius: f32) -> bool;
}

/// What a point light reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre, in metres.
    pub center: Vec3,
    /// Radius, in metres.
    pub radius: f32,
}

impl Volume for Ball {
    #[inline(always)]
    fn touches(&self, x: f32, y: f32, z: f32, radius: f32) -> bool {
        let (dx, dy, dz) = (x - self.center.x, y - self.center.y, z - self.center.z);
        let reach = self.radius + radius;
        (reach >= 0.0) & (dx * dx + dy * dy + dz * dz <= reach * reach)
    }
}

/// What a spot light reaches: a cone with a rounded end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    ball: Ball,
    direction: Vec3,
    sine: f32,
    cosine: f32,
    /// No cone: half the angle is a right angle or more, or there is no
    /// direction or angle. The whole ball counts then.
    wide: bool,
}

impl Cone {
    /// A cone from its apex along a direction of any length. `range` is in metres,
    /// `angle` is the full angle in radians.
    pub fn new(apex: Vec3, direction: Vec3, range: f32, angle: f32) -> Self {
        // Written so that NaN stays NaN.
        let half = 0.5 * if angle < 0.0 { 0.0 } else { angle };
        let unit = direction.try_normalize();
        let too_wide = half.is_nan() || half >= FRAC_PI_2;
        Self {
            ball: Ball {
                center: apex,
                radius: range,
            },
            direction: unit.unwrap_or(Vec3::ZERO),
            sine: half.sin(),
            cosine: half.cos(),
            wide: unit.is_none() || too_wide,
        }
    }
}

impl Volume for Cone {
    /// The signed distance of the sphere's centre from the line in which the cone
    /// is cut by the plane through its axis and the centre (Wronski 2017, "Cull
    /// that cone"). Half a per mille of the distance is added to the radius for
    /// the rounding errors.
    #[inline(always)]
    fn touches(&self, x: f32, y: f32, z: f32, radius: f32) -> bool {
        let apex = self.ball.center;
        let (dx, dy, dz) = (x - apex.x, y - apex.y, z - apex.z);
        let along = dx * self.direction.x + dy * self.direction.y + dz * self.direction.z;
        let square = dx * dx + dy * dy + dz * dz;
        let aside = square - along * along;
        let aside = if aside > 0.0 { aside } else { 0.0 }.sqrt();
        let reach = radius + 5e-4 * square.sqrt();
        let beside = self.cosine * aside - self.sine * along <= reach;
        let ahead = along >= -reach;
        self.ball.touches(x, y, z, radius) & (self.wide | (beside & ahead))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};

    fn random_vector(random: &mut impl Rng, size: f32) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| random.random_range(-size..size)))
    }

    #[test]
    fn a_ball_touches_up_to_the_sum_of_the_radii() {
        let ball = Ball {
            center: Vec3::X,
            radius: 2.0,
        };
        assert!(ball.touches(4.9, 0.0, 0.0, 2.0));
        assert!(!ball.touches(5.1, 0.0, 0.0, 2.0));
        assert!(!ball.touches(1.0, 0.0, 0.0, -3.0));
        assert!(!ball.touches(f32::NAN, 0.0, 0.0, 1.0));
        assert!(!ball.touches(1.0, 0.0, 0.0, f32::NAN));
        assert!(ball.touches(1e6, 0.0, 0.0, f32::INFINITY));
    }

    /// Points of the cone, found by drawing, against spheres that hold them.
    #[test]
    fn a_cone_never_misses_a_sphere_that_it_touches() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(5);
        for _ in 0..2_000 {
            let apex = random_vector(&mut random, 10.0);
            let axis = random_vector(&mut random, 1.0);
            let angle = random.random_range(0.01..3.5);
            let range = random.random_range(0.1..20.0);
            let cone = Cone::new(apex, axis, range, angle);
            for _ in 0..50 {
                let point = random_vector(&mut random, range);
                let inside = point.length() <= range && point.angle_between(axis) <= 0.5 * angle;
                if inside {
                    let center = apex + point + random_vector(&mut random, 3.0);
                    let radius = center.distance(apex + point) * 1.0001;
                    assert!(cone.touches(center.x, center.y, center.z, radius));
                }
            }
        }
    }

    #[test]
    fn a_cone_leaves_out_what_lies_beside_behind_and_beyond() {
        let cone = Cone::new(Vec3::ZERO, Vec3::NEG_Z * 3.0, 10.0, 1.0);
        assert!(cone.touches(0.0, 0.0, -5.0, 0.1));
        assert!(!cone.touches(4.0, 0.0, -5.0, 0.5));
        assert!(!cone.touches(0.0, 0.0, 2.0, 1.0));
        assert!(!cone.touches(0.0, 0.0, -12.0, 1.0));
        assert!(cone.touches(0.0, 0.0, 0.5, 1.0));
        assert!(!cone.touches(0.0, f32::NAN, -5.0, 0.1));
        for (direction, angle) in [(Vec3::ZERO, 1.0), (Vec3::X, 4.0), (Vec3::X, f32::NAN)] {
            let ball = Cone::new(Vec3::ZERO, direction, 10.0, angle);
            assert!(ball.touches(-9.0, 0.0, 0.0, 0.1));
        }
    }

    #[test]
    fn few_spheres_beside_a_cone_are_kept() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(6);
        let (mut kept, mut touching) = (0, 0);
        let cone = Cone::new(Vec3::ZERO, Vec3::NEG_Z, 10.0, 0.8);
        for _ in 0..20_000 {
            let center = random_vector(&mut random, 12.0);
            kept += i32::from(cone.touches(center.x, center.y, center.z, 0.01));
            let inside = center.length() < 10.02 && center.angle_between(Vec3::NEG_Z) < 0.404;
            touching += i32::from(inside);
        }
        assert!(
            touching > 100 && kept < touching * 12 / 10,
            "{kept} {touching}"
        );
    }
}
