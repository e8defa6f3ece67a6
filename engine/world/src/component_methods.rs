//! Small conveniences on component rows.

use glam::{Affine2, Affine3A, Quat, Vec3};

use crate::columns::Columns;
use crate::components::{Name, Transform, Transform2d, WorldBounds};
use crate::culling::{Boxes, Spheres};

impl Transform {
    /// No rotation, no scale.
    pub fn from_translation(translation: Vec3) -> Self {
        Self {
            translation,
            ..Self::default()
        }
    }

    /// Stands at a point with −z towards another one, as cameras and lights look.
    /// Where `up` gives no direction, because it is parallel to the view, another
    /// one is chosen.
    pub fn looking_at(from: Vec3, at: Vec3, up: Vec3) -> Self {
        let back = (from - at).try_normalize().unwrap_or(Vec3::Z);
        let right = up
            .cross(back)
            .try_normalize()
            .unwrap_or_else(|| back.any_orthonormal_vector());
        let matrix = glam::Mat3::from_cols(right, back.cross(right), back);
        Self {
            translation: from,
            rotation: Quat::from_mat3(&matrix),
            scale: Vec3::ONE,
        }
    }

    /// The map from the entity's own space to its parent's.
    pub fn matrix(&self) -> Affine3A {
        Affine3A::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

impl Transform2d {
    /// The map from the entity's own plane to its parent's.
    pub fn matrix(&self) -> Affine2 {
        Affine2::from_scale_angle_translation(self.scale, self.rotation, self.translation)
    }
}

impl Name {
    /// A name from any kind of text.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into() }
    }
}

impl WorldBounds {
    /// The common centre of sphere and box.
    pub fn center(&self) -> Vec3 {
        Vec3::new(self.x, self.y, self.z)
    }

    /// Half the extents of the box.
    pub fn half_extents(&self) -> Vec3 {
        Vec3::new(self.half_x, self.half_y, self.half_z)
    }
}

impl Columns<WorldBounds> {
    /// The bounding spheres, as culling takes them.
    pub fn spheres(&self) -> Spheres<'_> {
        let slices = self.slices();
        Spheres {
            x: slices.x,
            y: slices.y,
            z: slices.z,
            radius: slices.radius,
        }
    }

    /// The bounding boxes, as culling takes them.
    pub fn boxes(&self) -> Boxes<'_> {
        let slices = self.slices();
        Boxes {
            x: slices.x,
            y: slices.y,
            z: slices.z,
            half_x: slices.half_x,
            half_y: slices.half_y,
            half_z: slices.half_z,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_along_minus_z_with_y_up() {
        let transform = Transform::looking_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y);
        let forward = transform.rotation * Vec3::NEG_Z;
        let expected = -Vec3::new(1.0, 2.0, 3.0).normalize();
        assert!(forward.distance(expected) < 1e-6);
        let right = transform.rotation * Vec3::X;
        assert!(right.y.abs() < 1e-6);
        assert!((transform.rotation * Vec3::Y).y > 0.0);
    }

    #[test]
    fn looking_straight_up_or_nowhere_still_gives_a_rotation() {
        for (from, at) in [
            (Vec3::ZERO, Vec3::Y),
            (Vec3::ZERO, -Vec3::Y),
            (Vec3::ONE, Vec3::ONE),
        ] {
            let transform = Transform::looking_at(from, at, Vec3::Y);
            assert!((transform.rotation.length() - 1.0).abs() < 1e-6);
            if from != at {
                assert!((transform.rotation * Vec3::NEG_Z).distance(at - from) < 1e-6);
            }
        }
    }
}
