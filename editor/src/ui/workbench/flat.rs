//! Orthographic views along the world's axes.
//!
//! Pipelines draw through perspective cameras. One that is `HEIGHTS` picture heights away, with a
//! lens as narrow, shows what is a tenth of the picture's height nearer by a ten thousandth larger:
//! less than a tenth of a pixel in a picture of a thousand.

use lightbench::render::View;
use lightbench::world::glam::{Mat4, Vec2, Vec3};

use crate::ui::messages::say;

/// How many picture heights the eye is away.
const HEIGHTS: f32 = 1000.0;

/// How far away the eye is at most where the scene allows it, metres: pipelines that divide depth
/// into slices do so up to 10 km.
const FARTHEST: f32 = 9000.0;

/// The least that is shown in front of and behind the middle, metres.
const LEAST_REACH: f32 = 1.0;

/// From where an orthographic view looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From above: x to the right, z down.
    Top,
    /// From the front, along −z: x to the right, y up.
    Front,
    /// From the right, along −x: z to the left, y up.
    Right,
}

impl Side {
    /// All, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Top, Self::Front, Self::Right];

    /// The words for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Top => say!("flat.top"),
            Self::Front => say!("flat.front"),
            Self::Right => say!("flat.side"),
        }
    }

    /// To the right of the picture, up in it, and towards who looks.
    pub fn axes(self) -> [Vec3; 3] {
        match self {
            Self::Top => [Vec3::X, Vec3::NEG_Z, Vec3::Y],
            Self::Front => [Vec3::X, Vec3::Y, Vec3::Z],
            Self::Right => [Vec3::NEG_Z, Vec3::Y, Vec3::X],
        }
    }
}

/// An orthographic view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flat {
    /// From where it looks.
    pub side: Side,
    /// What is in the middle of the picture.
    pub center: Vec3,
    /// Metres from the lower to the upper edge of the picture.
    pub height: f32,
    /// Metres in front of and behind the middle that are shown.
    pub reach: f32,
}

impl Flat {
    /// A view of all of a box, in a picture that is so many times as wide as high.
    pub fn of_box(side: Side, min: Vec3, max: Vec3, aspect: f32) -> Self {
        let center = (min + max) * 0.5;
        let mut flat = Self {
            side,
            center,
            height: 1.0,
            reach: 0.0,
        };
        flat.frame(min, max, aspect);
        flat
    }

    /// Shows all of a box, in a picture that is so many times as wide as high.
    pub fn frame(&mut self, min: Vec3, max: Vec3, aspect: f32) {
        let half = (max - min).max(Vec3::ZERO) * 0.5;
        let [right, up, ahead] = self.side.axes();
        self.reach += (self.center - (min + max) * 0.5).dot(ahead).abs();
        self.reach = self.reach.max(half.length()).max(LEAST_REACH);
        self.center = (min + max) * 0.5;
        // A wide picture is taken as a square one, so that the same box is as large in it from all sides.
        let extent = (half.dot(right.abs()) / aspect.min(1.0)).max(half.dot(up.abs()));
        self.height = (2.2 * extent).max(1e-3);
    }

    /// Moves across the view; `by` is in picture heights.
    pub fn pan(&mut self, by: Vec2) {
        let [right, up, _] = self.side.axes();
        self.center += (up * by.y - right * by.x) * self.height;
    }

    /// Shows less, in larger; each unit is a tenth.
    pub fn zoom(&mut self, amount: f32) {
        self.height = (self.height * 0.9_f32.powf(amount)).clamp(1e-3, 1e5);
    }

    /// The view to draw.
    pub fn view(&self) -> View {
        let [right, up, ahead] = self.side.axes();
        let distance = (HEIGHTS * self.height).min(FARTHEST).max(2.0 * self.reach);
        let eye = self.center + ahead * distance;
        let to_world = Mat4::from_cols(
            right.extend(0.0),
            up.extend(0.0),
            ahead.extend(0.0),
            eye.extend(1.0),
        );
        View {
            view: to_world.inverse(),
            fov_y: 2.0 * (0.5 * self.height / distance).atan(),
            near: distance - self.reach,
            far: distance + self.reach,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_fills_the_picture_and_depth_does_not_matter() {
        let (min, max) = (Vec3::new(-2.0, 0.0, -4.0), Vec3::new(2.0, 3.0, 4.0));
        for side in Side::ALL {
            let mut flat = Flat::of_box(side, min, max, 1.0);
            let clip = |flat: &Flat| flat.view().projection(1.0) * flat.view().view;
            for corner in 0..8 {
                let part = |bit: u32, axis: usize| {
                    if corner >> bit & 1 == 0 {
                        min[axis]
                    } else {
                        max[axis]
                    }
                };
                let at = Vec3::new(part(0, 0), part(1, 1), part(2, 2));
                let [right, up, _] = side.axes();
                let wanted = Vec2::new((at - flat.center).dot(right), (at - flat.center).dot(up));
                let seen = clip(&flat).project_point3(at);
                let seen = Vec2::new(seen.x, seen.y) * 0.5 * flat.height;
                // Half a pixel of a picture of a thousand.
                let most = 0.0005 * flat.height * 4.0;
                assert!((seen - wanted).length() < most, "{side:?} {seen} {wanted}");
            }
            let before = clip(&flat).project_point3(Vec3::ZERO);
            flat.pan(Vec2::new(0.25, -0.125));
            let after = clip(&flat).project_point3(Vec3::ZERO);
            // A picture is two units high; down on the screen is down in the picture.
            assert!((after.x - before.x - 0.5).abs() < 2e-3, "{side:?}");
            assert!((after.y - before.y - 0.25).abs() < 2e-3, "{side:?}");
            for aspect in [0.4, 0.75, 1.6] {
                let flat = Flat::of_box(side, min, max, aspect);
                let clip = flat.view().projection(aspect) * flat.view().view;
                for at in [min, max] {
                    let seen = clip.project_point3(at);
                    assert!(
                        seen.x.abs() < 1.0 && seen.y.abs() < 1.0,
                        "{side:?} {aspect}"
                    );
                }
            }
            flat.zoom(1.0);
            let height = Flat::of_box(side, min, max, 1.0).height;
            assert!((flat.height - 0.9 * height).abs() < 1e-5 * height);
        }
    }
}
