//! What rays of each kind meet.
//!
//! - A line of sight passes the backs of one-sided surfaces, as the rasteriser leaves them out.
//! - A scattered ray meets both sides. The back of a one-sided surface is black.
//! - The light of a lamp that shines from a point or from afar passes surfaces that shine: they stand for
//!   the lamp's glass, or for the sky, and would put out the lamp behind them.
//! - Holes let all through; transparent surfaces let their share through, whichever side is met.

use glam::{DVec3, Vec3A};
use obvhs::ray::Ray;

use super::geometry::Traits;
use super::point::{Line, Point};
use super::scene::TracedScene;
use crate::reference::lighting::Arrival;

/// Hears of every ray that is sent through the tree.
pub trait Witness {
    /// One whose nearest triangle is wanted.
    fn nearest(&mut self, ray: &Ray);
    /// One that only asks whether the way is clear.
    fn clear(&mut self, ray: &Ray);
}

/// How many rays there were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count(pub u64);

impl Witness for Count {
    fn nearest(&mut self, _: &Ray) {
        self.0 += 1;
    }

    fn clear(&mut self, _: &Ray) {
        self.0 += 1;
    }
}

/// A triangle that a ray meets, and the ray's parameter there.
pub type Met = Option<(u32, f32)>;

impl TracedScene {
    /// What a viewer sees along a line. `from` and `to` are the line's parameters between which it
    /// looks.
    pub(super) fn look(
        &self,
        line: &Line,
        [from, to]: [f32; 2],
        witness: &mut impl Witness,
    ) -> Met {
        let ray = Ray::new(line.origin.as_vec3a(), line.direction.as_vec3a(), from, to);
        witness.nearest(&ray);
        let doubtful = Traits::ONE_SIDED.with(Traits::HOLES);
        self.geometry.nearest(ray, doubtful, |ray, triangle| {
            let traits = self.geometry.traits(triangle);
            let shows = !traits.any(Traits::ONE_SIDED) || self.geometry.shows_front(triangle, ray);
            shows
                && match line.pixel {
                    Some(_) => !self.is_hole_of_pixel(line, triangle),
                    None => !self.is_hole(ray, triangle),
                }
        })
    }

    /// What a ray from a surface meets.
    pub(super) fn meet(&self, ray: Ray, witness: &mut impl Witness) -> Met {
        witness.nearest(&ray);
        self.geometry.nearest(ray, Traits::HOLES, |ray, triangle| {
            !self.is_hole(ray, triangle)
        })
    }

    /// The share of the light that comes along a ray, past surfaces that have one of some traits.
    pub(super) fn share(&self, ray: Ray, past: Traits, witness: &mut impl Witness) -> f64 {
        witness.clear(&ray);
        let doubtful = past.with(Traits::HOLES).with(Traits::TRANSPARENT);
        let mut share = 1.0;
        let clear = self.geometry.is_clear(ray, doubtful, |ray, triangle| {
            let traits = self.geometry.traits(triangle);
            if traits.any(past) || self.is_hole(ray, triangle) {
                return false;
            }
            if traits.any(Traits::TRANSPARENT) {
                share *= self.let_through(ray, triangle);
                return share <= 0.0;
            }
            true
        });
        if clear { share } else { 0.0 }
    }
}

/// A ray that leaves a surface on the side of a normal; `reach` is how far it looks.
pub fn leave(position: DVec3, normal: DVec3, direction: DVec3, reach: f64) -> Ray {
    Ray::new(
        beside(position, normal),
        direction.as_vec3a(),
        0.0,
        reach as f32,
    )
}

/// A ray from a surface towards a place; it looks so far of the way.
pub fn leave_towards(point: &Point, place: DVec3, share: f64) -> Ray {
    let origin = beside(point.surface.position, point.geometric);
    let offset = place - origin.as_dvec3();
    let distance = offset.length();
    let direction = offset / distance.max(f64::MIN_POSITIVE);
    Ray::new(origin, direction.as_vec3a(), 0.0, (distance * share) as f32)
}

/// The ray from a surface to a lamp.
pub fn to_lamp(point: &Point, arrival: &Arrival) -> Ray {
    let position = point.surface.position;
    let (to_light, distance) = (arrival.to_light, arrival.distance);
    if distance.is_infinite() {
        return leave(position, point.geometric, to_light, distance);
    }
    leave_towards(point, position + to_light * distance, 1.0)
}

/// A point a little off a surface, so far that rounding can't put it on the other side (Wächter and
/// Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6).
fn beside(position: DVec3, normal: DVec3) -> Vec3A {
    const NEAR_ORIGIN: f32 = 1.0 / 32.0;
    const SMALL: f32 = 1.0 / 65_536.0;
    const STEPS: f32 = 256.0;
    let (position, normal) = (position.as_vec3().to_array(), normal.as_vec3().to_array());
    let moved = [0, 1, 2].map(|axis| {
        let (place, along) = (position[axis], normal[axis]);
        if place.abs() < NEAR_ORIGIN {
            return place + SMALL * along;
        }
        let steps = (STEPS * along) as i32;
        let steps = if place < 0.0 { -steps } else { steps };
        f32::from_bits(place.to_bits().wrapping_add_signed(steps))
    });
    Vec3A::from_array(moved)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_move_out_of_the_surface_and_not_far() {
        for position in [
            DVec3::new(0.001, -0.02, 5.0),
            DVec3::new(-300.0, 1.0, 0.0),
            DVec3::new(1e4, -1e4, 0.5),
        ] {
            for normal in [DVec3::Y, DVec3::NEG_X, DVec3::new(0.6, -0.48, 0.64)] {
                let moved = beside(position, normal).as_dvec3() - position;
                let size = position.abs().max_element();
                assert!(moved.dot(normal) > 0.0, "{position} {normal}: {moved}");
                assert!(moved.length() < 1e-4 * size.max(1.0), "{moved}");
            }
        }
    }
}
