//! Lines of sight: the twin of `view_direction` in `shaders/lib/scene.wgsl`.

use glam::{DVec2, DVec3};
use lightbench_render::View;

/// A view as rays see it. Their directions have a length of 1 along the view, so that a ray's parameter
/// is the distance along the view, as near and far planes have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Position of the camera.
    pub eye: DVec3,
    /// The direction of the picture's upper left corner.
    corner: DVec3,
    /// Its change from pixel to pixel, to the right.
    pub across: DVec3,
    /// And down.
    pub down: DVec3,
    /// Distance of the near plane along the view, metres.
    pub near: f32,
    /// Distance of the far plane.
    pub far: f32,
}

impl Sight {
    /// The lines of sight of a picture.
    pub fn new(view: &View, size: (u32, u32)) -> Self {
        let to_world = view.view.as_dmat4().inverse();
        let axis = |axis: glam::DVec4| axis.truncate();
        let [width, height] = [size.0.max(1), size.1.max(1)].map(f64::from);
        let projection = view.projection((width / height) as f32);
        let right = axis(to_world.x_axis) / f64::from(projection.x_axis.x);
        let up = axis(to_world.y_axis) / f64::from(projection.y_axis.y);
        Self {
            eye: axis(to_world.w_axis),
            corner: -axis(to_world.z_axis) - right + up,
            across: right * (2.0 / width),
            down: -up * (2.0 / height),
            near: view.near,
            far: view.far,
        }
    }

    /// The direction through a place of the picture, in pixels from the upper left corner.
    pub fn direction(&self, place: DVec2) -> DVec3 {
        self.corner + self.across * place.x + self.down * place.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_place_of_the_picture_is_where_the_projection_puts_it() {
        let eye = Vec3::new(1.0, 2.0, 3.0);
        let view = View::look_at(eye, Vec3::new(-2.0, 0.5, 0.0), 0.9, 0.1, 50.0);
        let size = (320, 180);
        let sight = Sight::new(&view, size);
        let clip = view.projection(320.0 / 180.0).as_dmat4() * view.view.as_dmat4();
        for place in [
            DVec2::new(0.5, 0.5),
            DVec2::new(100.0, 33.0),
            DVec2::new(320.0, 180.0),
        ] {
            let point = sight.eye + sight.direction(place) * 7.0;
            let seen = clip * point.extend(1.0);
            // The parameter of the ray is the distance along the view.
            assert!((seen.w - 7.0).abs() < 1e-5, "{}", seen.w);
            let x = (seen.x / seen.w + 1.0) * 160.0;
            let y = (1.0 - seen.y / seen.w) * 90.0;
            assert!((DVec2::new(x, y) - place).length() < 1e-3, "{x} {y}");
        }
    }
}
