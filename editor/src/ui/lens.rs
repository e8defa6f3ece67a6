//! From the world to the places of the viewport and back.

use egui::{Pos2, Rect, pos2};
use lightbench::render::View;
use lightbench::script::Ray;
use lightbench::world::glam::{Mat4, Vec3, Vec4};

use super::workbench::picking::line_of_sight;

/// Projects onto a rectangle of the window as the picture in it is projected.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// Where the picture is.
    pub rect: Rect,
    /// What it shows.
    pub view: View,
    to_clip: Mat4,
}

impl Lens {
    /// The lens of a picture.
    pub fn new(rect: Rect, view: View) -> Self {
        let aspect = rect.aspect_ratio();
        Self {
            rect,
            view,
            to_clip: view.projection(aspect) * view.view,
        }
    }

    fn clip(&self, at: Vec3) -> Vec4 {
        self.to_clip * at.extend(1.0)
    }

    fn place(&self, clip: Vec4) -> Pos2 {
        let (x, y) = (clip.x / clip.w, clip.y / clip.w);
        pos2(
            self.rect.left() + (0.5 + 0.5 * x) * self.rect.width(),
            self.rect.top() + (0.5 - 0.5 * y) * self.rect.height(),
        )
    }

    /// Where a point of the world is; `None` for one before the near plane.
    pub fn point(&self, at: Vec3) -> Option<Pos2> {
        let clip = self.clip(at);
        (clip.w >= self.view.near).then(|| self.place(clip))
    }

    /// The part of a line that is behind the near plane.
    pub fn line(&self, from: Vec3, to: Vec3) -> Option<[Pos2; 2]> {
        let (mut a, mut b) = (self.clip(from), self.clip(to));
        let near = self.view.near;
        if a.w < near && b.w < near {
            return None;
        }
        let cut = |before: Vec4, behind: Vec4| {
            before + (behind - before) * ((near - before.w) / (behind.w - before.w))
        };
        if a.w < near {
            a = cut(a, b);
        } else if b.w < near {
            b = cut(b, a);
        }
        Some([self.place(a), self.place(b)])
    }

    /// The line of sight through a place.
    pub fn ray(&self, at: Pos2) -> Ray {
        let share = (at - self.rect.min) / self.rect.size();
        line_of_sight(&self.view, [share.x, share.y], self.rect.aspect_ratio())
    }

    /// How much of the world a point of the screen covers at a place.
    pub fn metres_per_point(&self, at: Vec3) -> f32 {
        let ahead = self.clip(at).w.max(self.view.near);
        2.0 * ahead * (self.view.fov_y * 0.5).tan() / self.rect.height().max(1.0)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn places_and_lines_of_sight_are_each_others_reverse() {
        let rect = Rect::from_min_max(pos2(10.0, 20.0), pos2(410.0, 220.0));
        let eye = Vec3::new(1.0, 2.0, 6.0);
        let lens = Lens::new(rect, View::look_at(eye, Vec3::ZERO, 1.0, 0.1, 50.0));
        let center = lens.point(Vec3::ZERO).unwrap();
        assert!(center.distance(rect.center()) < 1e-3);
        let at = Vec3::new(0.5, -0.25, 1.0);
        let ray = lens.ray(lens.point(at).unwrap());
        let beside = (at - ray.origin).cross(ray.direction.normalize());
        assert!(beside.length() < 1e-4);
        // A point to the right by what a hundred points of the screen cover.
        let right = lens.view.view.inverse().x_axis.truncate();
        let aside = lens.point(right * 100.0 * lens.metres_per_point(Vec3::ZERO));
        assert!((aside.unwrap().x - center.x - 100.0).abs() < 1e-2);
        // What is behind the eye has no place, and its line ends at the near plane.
        let behind = eye * 2.0;
        assert_eq!(lens.point(behind), None);
        assert!(lens.line(behind, behind * 1.1).is_none());
        let [from, to] = lens.line(behind + Vec3::X, Vec3::ZERO).unwrap();
        assert!(from.x.is_finite() && to.distance(center) < 1e-3);
    }
}
