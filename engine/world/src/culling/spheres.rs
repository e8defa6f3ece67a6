//! Spheres against one frustum.

use super::Frustum;

/// Bounding spheres as four arrays of the same length, in metres.
#[derive(Clone, Copy, Debug)]
pub struct Spheres<'a> {
    /// Centres, x.
    pub x: &'a [f32],
    /// Centres, y.
    pub y: &'a [f32],
    /// Centres, z.
    pub z: &'a [f32],
    /// Radii.
    pub radius: &'a [f32],
}

impl Spheres<'_> {
    /// Number of spheres.
    pub fn len(&self) -> usize {
        self.x
            .len()
            .min(self.y.len())
            .min(self.z.len())
            .min(self.radius.len())
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Fills `visible` with the rows of the spheres that a frustum may show, in
/// ascending order. The vector's memory is reused.
pub fn cull_spheres(frustum: &Frustum, spheres: Spheres<'_>, visible: &mut Vec<u32>) {
    visible.clear();
    let rows = spheres
        .x
        .iter()
        .zip(spheres.y)
        .zip(spheres.z)
        .zip(spheres.radius);
    visible.extend(
        rows.enumerate()
            .filter(|(_, (((x, y), z), radius))| frustum.intersects_sphere(**x, **y, **z, **radius))
            .map(|(row, _)| row as u32),
    );
}
