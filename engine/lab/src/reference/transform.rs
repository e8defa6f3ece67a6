//! The twin of the transforms in `shaders/lib/scene.wgsl`: from an object's space to the world's.

use glam::DVec3;

/// The rows of an object's affine world matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows {
    /// The linear part, row by row.
    rows: [DVec3; 3],
    /// Cross products of the rows, with the sign of the determinant: what turns normals.
    cofactors: [DVec3; 3],
    translation: DVec3,
}

impl Rows {
    /// From rows as the GPU has them.
    pub fn new(rows: [[f32; 4]; 3]) -> Self {
        let linear = rows.map(|row| DVec3::new(row[0].into(), row[1].into(), row[2].into()));
        let [x, y, z] = linear;
        let side = if x.dot(y.cross(z)) >= 0.0 { 1.0 } else { -1.0 };
        Self {
            rows: linear,
            cofactors: [y.cross(z) * side, z.cross(x) * side, x.cross(y) * side],
            translation: DVec3::from_array(rows.map(|row| row[3].into())),
        }
    }

    /// Whether it turns left into right.
    pub fn is_mirrored(&self) -> bool {
        let [x, y, z] = self.rows;
        x.dot(y.cross(z)) < 0.0
    }

    /// A position.
    pub fn position(&self, position: DVec3) -> DVec3 {
        self.tangent(position) + self.translation
    }

    /// A direction along the surface; not normalised.
    pub fn tangent(&self, tangent: DVec3) -> DVec3 {
        DVec3::from_array(self.rows.map(|row| row.dot(tangent)))
    }

    /// A normal; not normalised. It stays at right angles to the surface under any scale, and
    /// outside when mirrored.
    pub fn normal(&self, normal: DVec3) -> DVec3 {
        DVec3::from_array(self.cofactors.map(|row| row.dot(normal)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Affine3A, Quat, Vec3};
    use lightbench_render::gpu_data::matrix_rows;

    #[test]
    fn normals_stay_upright_under_uneven_scales_and_mirrors() {
        for scale in [Vec3::new(2.0, 0.5, 1.0), Vec3::new(-1.0, 3.0, 0.2)] {
            let rotation = Quat::from_rotation_x(0.7) * Quat::from_rotation_y(1.1);
            let matrix = Affine3A::from_scale_rotation_translation(scale, rotation, Vec3::ONE);
            let rows = Rows::new(matrix_rows(&matrix));
            assert_eq!(rows.is_mirrored(), scale.x < 0.0);
            let (along, across) = (DVec3::new(1.0, 0.4, 0.0), DVec3::new(0.0, 1.0, 2.0));
            let normal = along.cross(across);
            let turned = rows.normal(normal);
            for edge in [along, across] {
                assert!(turned.dot(rows.tangent(edge)).abs() < 1e-6);
            }
            // Out of the object: a step along the normal moves the point to the same side.
            assert!(turned.dot(rows.tangent(normal)) > 0.0);
            let expected = matrix.transform_point3(Vec3::new(1.0, 2.0, 3.0)).as_dvec3();
            assert!((rows.position(DVec3::new(1.0, 2.0, 3.0)) - expected).length() < 1e-5);
        }
    }
}
