//! The camera of a frame as matrices.

use glam::{Mat4, Vec3, Vec4};
use lightbench_world::{Camera, Entity, World, WorldMatrix};

/// A perspective camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// World to view; view space looks along −z with y up.
    pub view: Mat4,
    /// Full vertical angle, radians.
    pub fov_y: f32,
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres; infinity is allowed.
    pub far: f32,
}

impl View {
    /// A camera at `eye` that looks at `target`, with y up.
    pub fn look_at(eye: Vec3, target: Vec3, fov_y: f32, near: f32, far: f32) -> Self {
        Self {
            view: glam::camera::rh::view::look_at_mat4(eye, target, Vec3::Y),
            fov_y,
            near,
            far,
        }
    }

    /// The first active camera of a world whose matrices are up to date.
    pub fn from_world(world: &World) -> Option<Self> {
        let cameras = world.columns::<Camera>();
        let active = |entity: &&Entity| {
            let camera = cameras.get(**entity);
            camera.is_some_and(|camera| camera.active)
        };
        let mut active = cameras.entities().iter().filter(active);
        active.find_map(|entity| Self::from_camera(world, *entity))
    }

    /// What a camera of a world sees, whether it is active or not; `None` where the entity is none, or
    /// its axes lie in a plane.
    pub fn from_camera(world: &World, entity: Entity) -> Option<Self> {
        let camera: Camera = world.get(entity)?;
        let matrix = world.get::<WorldMatrix>(entity)?.matrix;
        // Scale has no meaning for a camera: only its axes and position count.
        let axis = |axis: glam::Vec3A| Vec3::from(axis).normalize_or_zero();
        let m = matrix.matrix3;
        let (x, y, z) = (axis(m.x_axis), axis(m.y_axis), axis(m.z_axis));
        let t = Vec3::from(matrix.translation);
        let to_world = Mat4::from_cols(x.extend(0.0), y.extend(0.0), z.extend(0.0), t.extend(1.0));
        (to_world.determinant().abs() > 1e-3).then(|| Self {
            view: to_world.inverse(),
            fov_y: camera.fov_y,
            near: camera.near,
            far: camera.far,
        })
    }

    /// View to clip with reversed depth: 1 at `near`, 0 at `far`.
    pub fn projection(&self, aspect: f32) -> Mat4 {
        let focal = 1.0 / (self.fov_y * 0.5).tan();
        // z_clip = a · z + b with w = −z, so that z/w is 1 at −near and 0 at −far.
        let (a, b) = if self.far.is_finite() {
            let depth = self.far - self.near;
            (self.near / depth, self.far * self.near / depth)
        } else {
            (0.0, self.near)
        };
        Mat4::from_cols(
            Vec4::new(focal / aspect, 0.0, 0.0, 0.0),
            Vec4::new(0.0, focal, 0.0, 0.0),
            Vec4::new(0.0, 0.0, a, -1.0),
            Vec4::new(0.0, 0.0, b, 0.0),
        )
    }

    /// Position of the camera in the world.
    pub fn position(&self) -> Vec3 {
        self.view.inverse().w_axis.truncate()
    }
}

impl Default for View {
    /// Two metres up and five back, looking at the origin: for scenes without a camera.
    fn default() -> Self {
        Self::look_at(
            Vec3::new(0.0, 2.0, 5.0),
            Vec3::ZERO,
            std::f32::consts::FRAC_PI_3,
            0.1,
            1000.0,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_is_one_near_and_zero_far() {
        for far in [50.0_f32, f32::INFINITY] {
            let view = View {
                near: 0.5,
                far,
                ..View::default()
            };
            let projection = view.projection(1.5);
            let depth = |z: f32| {
                let clip = projection * Vec4::new(0.0, 0.0, -z, 1.0);
                clip.z / clip.w
            };
            assert!((depth(0.5) - 1.0).abs() < 1e-6);
            assert!(depth(if far.is_finite() { far } else { 1e9 }).abs() < 1e-6);
            assert!(depth(1.0) > depth(2.0));
        }
    }

    #[test]
    fn the_camera_is_where_it_was_put() {
        let eye = Vec3::new(1.0, 2.0, 3.0);
        let view = View::look_at(eye, Vec3::ZERO, 1.0, 0.1, 10.0);
        assert!((view.position() - eye).length() < 1e-5);
        let ahead = view.view.transform_point3(Vec3::ZERO);
        assert!(ahead.x.abs() < 1e-5 && ahead.y.abs() < 1e-5 && ahead.z < 0.0);
    }
}
