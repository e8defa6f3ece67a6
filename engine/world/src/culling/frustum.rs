//! The view frustum as six planes.

use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};

/// A plane: the points `p` with `normal · p + distance = 0`. The inside is where
/// the sum is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal, towards the inside; zero for a plane that cuts nothing off.
    pub normal: Vec3,
    /// Distance of the origin from the plane, positive inside, in metres.
    pub distance: f32,
}

impl Plane {
    /// Cuts nothing off, as the far plane of a view that reaches to infinity.
    pub const EVERYTHING: Self = Self {
        normal: Vec3::ZERO,
        distance: f32::MAX,
    };

    /// Cuts everything off.
    pub const NOTHING: Self = Self {
        normal: Vec3::ZERO,
        distance: f32::MIN,
    };

    /// The plane whose inside is `coefficients · (p, 1) ≥ 0`.
    fn from_coefficients(coefficients: Vec4) -> Self {
        let length = coefficients.xyz().length();
        // A row without a direction constrains the constant alone. An infinite
        // far plane leaves such a row, with rounding errors in it.
        if length > 1e-6 * coefficients.w.abs() {
            Self {
                normal: coefficients.xyz() / length,
                distance: coefficients.w / length,
            }
        } else if coefficients.w >= 0.0 {
            Self::EVERYTHING
        } else {
            Self::NOTHING
        }
    }

    /// Signed distance of a point, positive inside.
    #[inline]
    pub fn distance_to(&self, x: f32, y: f32, z: f32) -> f32 {
        self.normal.x * x + self.normal.y * y + self.normal.z * z + self.distance
    }
}

/// The part of space that a view shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Left, right, bottom, top, near, far.
    pub planes: [Plane; 6],
}

impl Frustum {
    /// The planes of a view, in the space from which the matrix maps
    /// (Gribb and Hartmann 2001, "Fast extraction of viewing frustum planes").
    ///
    /// The matrix leads to clip space with reverse depth: −w ≤ x, y ≤ w,
    /// z = w on the near plane and z = 0 on the far one, which may be infinite.
    /// Orthographic views have the same form.
    pub fn from_view_projection(matrix: Mat4) -> Self {
        let [x, y, z, w] = [matrix.row(0), matrix.row(1), matrix.row(2), matrix.row(3)];
        Self {
            planes: [w + x, w - x, w + y, w - y, w - z, z].map(Plane::from_coefficients),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::culling::Volume;
    use glam::camera::rh::proj::directx;
    use glam::camera::rh::view::look_at_mat4;

    fn sees(frustum: &Frustum, point: Vec3) -> bool {
        frustum.touches(point.x, point.y, point.z, 0.0)
    }

    /// Swapping near and far reverses the depth.
    fn reverse(fov: f32, aspect: f32, near: f32, far: f32) -> Mat4 {
        directx::perspective(fov, aspect, far, near)
    }

    #[test]
    fn agrees_with_clip_space() {
        let view = look_at_mat4(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y);
        let matrix = reverse(1.0, 1.5, 0.1, 50.0) * view;
        let frustum = Frustum::from_view_projection(matrix);
        let (mut inside, mut outside) = (0, 0);
        for i in 0..20_000 {
            let t = i as f32;
            let point = 20.0 * Vec3::new((t * 0.7).sin(), (t * 1.3).sin(), (t * 2.1).sin());
            let clip = matrix * point.extend(1.0);
            let margins = [
                clip.w + clip.x,
                clip.w - clip.x,
                clip.w + clip.y,
                clip.w - clip.y,
                clip.w - clip.z,
                clip.z,
            ];
            let least = margins.into_iter().fold(f32::INFINITY, f32::min);
            if least.abs() > 1e-3 {
                assert_eq!(sees(&frustum, point), least > 0.0, "{point}");
                if least > 0.0 {
                    inside += 1
                } else {
                    outside += 1
                }
            }
        }
        assert!(inside > 1000 && outside > 1000);
    }

    #[test]
    fn near_and_far_lie_where_they_should() {
        let frustum = Frustum::from_view_projection(reverse(1.0, 1.0, 0.5, 10.0));
        assert!(!sees(&frustum, Vec3::new(0.0, 0.0, -0.49)));
        assert!(sees(&frustum, Vec3::new(0.0, 0.0, -0.51)));
        assert!(sees(&frustum, Vec3::new(0.0, 0.0, -9.9)));
        assert!(!sees(&frustum, Vec3::new(0.0, 0.0, -10.1)));
        assert!(!sees(&frustum, Vec3::new(0.0, 0.0, 1.0)));
        assert!((frustum.planes[4].distance + 0.5).abs() < 1e-4);
        assert!((frustum.planes[5].distance - 10.0).abs() < 1e-3);
    }

    #[test]
    fn an_infinite_far_plane_cuts_nothing_off() {
        let matrix = directx::perspective_infinite_reverse(1.0, 1.0, 0.1);
        let frustum = Frustum::from_view_projection(matrix);
        assert_eq!(frustum.planes[5], Plane::EVERYTHING);
        assert!(sees(&frustum, Vec3::new(0.0, 0.0, -1e9)));
        assert!(!sees(&frustum, Vec3::new(0.0, 0.0, 1.0)));
    }

    #[test]
    fn spheres_count_as_visible_up_to_their_radius() {
        let frustum = Frustum::from_view_projection(reverse(1.0, 1.0, 1.0, 10.0));
        assert!(frustum.touches(0.0, 0.0, -11.9, 2.0));
        assert!(!frustum.touches(0.0, 0.0, -12.1, 2.0));
        assert!(!frustum.touches(f32::NAN, 0.0, -5.0, 1.0));
        assert!(!frustum.touches(0.0, 0.0, -5.0, f32::NAN));
        assert!(frustum.touches(0.0, 0.0, -500.0, f32::INFINITY));
    }
}
