//! The camera that a person moves: orbit, pan, zoom and fly.
//!
//! Until somebody touches it, it follows the scene's own camera.

use lightbench::render::View;
use lightbench::world::glam::{Quat, Vec2, Vec3};

use super::flat::{Flat, Side};
use crate::viewpoint::Free;

/// How near to straight up or down the camera may look, radians.
const MAX_PITCH: f32 = 1.55;

/// A free camera with a point of interest ahead of it. There is no roll: the horizon is level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraRig {
    eye: Vec3,
    /// Turn about y, radians; 0 looks along −z.
    yaw: f32,
    /// Radians above the horizon.
    pitch: f32,
    /// Metres from the eye to the point around which it orbits.
    distance: f32,
    /// Flying speed, metres a second.
    pub speed: f32,
    lens: View,
    /// The scene's camera, which the rig follows until it is moved.
    home: View,
    moved: bool,
    /// The orthographic view that is shown in place of the camera's own.
    flat: Option<Flat>,
}

impl Default for CameraRig {
    fn default() -> Self {
        let mut rig = Self {
            eye: Vec3::ZERO,
            yaw: 0.0,
            pitch: 0.0,
            distance: 5.0,
            speed: 3.0,
            lens: View::default(),
            home: View::default(),
            moved: false,
            flat: None,
        };
        rig.take(View::default());
        rig
    }
}

impl CameraRig {
    /// Tells the rig what the scene's camera sees. It follows, unless somebody moved it.
    pub fn follow(&mut self, home: View) {
        self.home = home;
        if !self.moved {
            self.take(home);
        }
    }

    /// Back to the scene's camera.
    pub fn reset(&mut self) {
        self.moved = false;
        self.flat = None;
        self.take(self.home);
    }

    /// Whether somebody moved it away from the scene's camera.
    pub fn is_moved(&self) -> bool {
        self.moved
    }

    /// The orthographic view that is shown, if one is.
    pub fn flat(&self) -> Option<&Flat> {
        self.flat.as_ref()
    }

    /// Shows all of a box from a side, without perspective, in a picture that is so many times as wide as
    /// high.
    pub fn flatten(&mut self, side: Side, (min, max): (Vec3, Vec3), aspect: f32) {
        self.flat = Some(Flat::of_box(side, min, max, aspect));
    }

    /// A perspective that follows nothing, from where the camera was last.
    pub fn let_go(&mut self) {
        self.flat = None;
        self.moved = true;
    }

    /// The view to draw.
    pub fn view(&self) -> View {
        if let Some(flat) = &self.flat {
            return flat.view();
        }
        if !self.moved {
            // As the scene has it, roll included.
            return self.home;
        }
        self.free().view()
    }

    /// Where it stands, as a view in words has it.
    pub fn free(&self) -> Free {
        Free {
            eye: self.eye,
            yaw: self.yaw,
            pitch: self.pitch,
            orbit: self.distance,
            fov_y: self.lens.fov_y,
            near: self.lens.near,
            far: self.lens.far,
        }
    }

    /// Stands where a view in words says, and follows nothing.
    pub fn stand(&mut self, free: Free) {
        (self.eye, self.yaw, self.pitch) = (free.eye, free.yaw, free.pitch);
        self.distance = free.orbit;
        self.lens = free.view();
        self.moved = true;
        self.flat = None;
    }

    /// Shows a view without perspective.
    pub fn show_flat(&mut self, flat: Flat) {
        self.flat = Some(flat);
    }

    /// Position, metres.
    pub fn position(&self) -> Vec3 {
        self.eye
    }

    /// The point around which it orbits.
    pub fn pivot(&self) -> Vec3 {
        self.eye + self.forward() * self.distance
    }

    /// Turns around the pivot by angles in radians.
    pub fn orbit(&mut self, turn: Vec2) {
        let pivot = self.pivot();
        self.turn(turn);
        self.eye = pivot - self.forward() * self.distance;
    }

    /// Turns on the spot by angles in radians.
    pub fn look(&mut self, turn: Vec2) {
        self.turn(turn);
    }

    /// Moves across the view; `by` is in picture heights at the pivot's distance.
    pub fn pan(&mut self, by: Vec2) {
        if let Some(flat) = &mut self.flat {
            return flat.pan(by);
        }
        let height = 2.0 * self.distance * (self.lens.fov_y * 0.5).tan();
        let rotation = self.rotation();
        self.eye += rotation * Vec3::new(-by.x, by.y, 0.0) * height;
        self.moved = true;
    }

    /// Moves towards the pivot; each unit covers a tenth of the way.
    pub fn zoom(&mut self, amount: f32) {
        if let Some(flat) = &mut self.flat {
            return flat.zoom(amount);
        }
        let pivot = self.pivot();
        self.distance = (self.distance * 0.9_f32.powf(amount)).clamp(0.01, 1e6);
        self.eye = pivot - self.forward() * self.distance;
        self.moved = true;
    }

    /// Flies for `seconds` along the camera's own axes: right, up, back.
    pub fn fly(&mut self, direction: Vec3, seconds: f32) {
        if direction == Vec3::ZERO {
            return;
        }
        let step = direction.normalize() * self.speed * seconds;
        if let Some(flat) = &mut self.flat {
            // There is nowhere to go ahead: what is nearer is not larger.
            flat.pan(Vec2::new(-step.x, step.y) / flat.height);
            return;
        }
        self.eye += self.rotation() * step;
        self.moved = true;
    }

    /// Shows all of a box from the present direction, in a picture that is so many times as wide as high.
    pub fn frame(&mut self, min: Vec3, max: Vec3, aspect: f32) {
        if let Some(flat) = &mut self.flat {
            return flat.frame(min, max, aspect);
        }
        let radius = ((max - min).length() * 0.5).max(1e-3);
        // Half of the smaller of both angles of view.
        let half = ((self.lens.fov_y * 0.5).tan() * aspect.min(1.0)).atan();
        self.distance = radius / half.sin();
        self.eye = (min + max) * 0.5 - self.forward() * self.distance;
        self.moved = true;
    }

    /// Chooses a flying speed and an orbit for a scene whose objects are about that far away,
    /// metres.
    pub fn suit(&mut self, distance: f32) {
        if distance.is_finite() && distance > 0.0 {
            self.speed = (distance * 0.3).clamp(0.01, 1e4);
            self.distance = (distance * 0.7).clamp(0.05, 1e5);
        }
    }

    fn turn(&mut self, turn: Vec2) {
        self.yaw = (self.yaw + turn.x).rem_euclid(std::f32::consts::TAU);
        self.pitch = (self.pitch + turn.y).clamp(-MAX_PITCH, MAX_PITCH);
        self.moved = true;
    }

    fn rotation(&self) -> Quat {
        self.free().rotation()
    }

    fn forward(&self) -> Vec3 {
        self.rotation() * Vec3::NEG_Z
    }

    fn take(&mut self, view: View) {
        self.lens = view;
        self.eye = view.position();
        let forward = -view.view.inverse().z_axis.truncate().normalize_or_zero();
        self.yaw = (-forward.x).atan2(-forward.z);
        self.pitch = forward
            .y
            .clamp(-1.0, 1.0)
            .asin()
            .clamp(-MAX_PITCH, MAX_PITCH);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Vec3, b: Vec3) -> bool {
        (a - b).length() < 1e-4
    }

    fn rig() -> CameraRig {
        let mut rig = CameraRig::default();
        rig.follow(View::look_at(
            Vec3::new(3.0, 4.0, 5.0),
            Vec3::new(0.0, 1.0, 0.0),
            1.0,
            0.1,
            100.0,
        ));
        rig
    }

    #[test]
    fn it_follows_the_scene_until_it_is_moved_and_again_after_a_reset() {
        let mut rig = rig();
        let other = View::look_at(Vec3::X, Vec3::ZERO, 1.0, 0.1, 9.0);
        rig.look(Vec2::new(0.0, 0.0));
        let before = rig.view();
        rig.follow(other);
        assert_eq!(rig.view(), before);
        rig.reset();
        assert_eq!(rig.view(), other);
    }

    #[test]
    fn taking_the_camera_changes_nothing_in_the_picture() {
        let mut rig = rig();
        let before = rig.view().view;
        rig.look(Vec2::ZERO);
        assert!(rig.is_moved());
        assert!(rig.view().view.abs_diff_eq(before, 1e-4));
    }

    #[test]
    fn a_view_in_words_is_the_same_view() {
        let mut rig = rig();
        rig.orbit(Vec2::new(0.7, -0.2));
        rig.pan(Vec2::new(0.3, 0.1));
        let (view, free) = (rig.view(), rig.free());
        let mut other = CameraRig::default();
        other.stand(free);
        assert_eq!(other.view(), view);
        assert_eq!(other.free(), free);
    }

    #[test]
    fn orbiting_keeps_the_pivot_and_the_distance() {
        let mut rig = rig();
        let (pivot, distance) = (rig.pivot(), rig.distance);
        rig.orbit(Vec2::new(1.0, -0.3));
        assert!(near(rig.pivot(), pivot));
        assert!(((rig.eye - pivot).length() - distance).abs() < 1e-4);
        let ahead = rig.view().view.transform_point3(pivot);
        assert!(near(ahead, Vec3::new(0.0, 0.0, -distance)));
    }

    #[test]
    fn flying_moves_along_the_view() {
        let mut rig = rig();
        rig.look(Vec2::ZERO);
        let (eye, view) = (rig.eye, rig.view().view);
        rig.fly(Vec3::NEG_Z, 2.0);
        let moved = view.transform_vector3(rig.eye - eye);
        assert!(near(moved, Vec3::new(0.0, 0.0, -2.0 * rig.speed)));
    }

    #[test]
    fn framing_shows_the_whole_box() {
        let mut rig = rig();
        let (min, max) = (Vec3::new(-7.0, 0.0, 2.0), Vec3::new(1.0, 3.0, 20.0));
        for aspect in [0.4, 1.0, 1.8] {
            rig.frame(min, max, aspect);
            let clip = rig.view().projection(aspect) * rig.view().view;
            for corner in 0..8 {
                let pick = |bit: u32, axis: usize| {
                    if corner >> bit & 1 == 0 {
                        min[axis]
                    } else {
                        max[axis]
                    }
                };
                let at = clip * Vec3::new(pick(0, 0), pick(1, 1), pick(2, 2)).extend(1.0);
                assert!(at.w > 0.0 && at.x.abs() <= at.w && at.y.abs() <= at.w);
            }
        }
    }

    #[test]
    fn looking_straight_up_is_not_reached() {
        let mut rig = rig();
        rig.look(Vec2::new(0.0, 99.0));
        assert!(rig.view().view.is_finite());
        assert!(rig.forward().y < 1.0);
    }
}
