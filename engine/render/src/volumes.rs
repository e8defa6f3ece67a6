//! The volume that a light can reach, and how to draw it without losing a pixel.
//!
//! A volume's back faces light the pixels in front of them, which also works with the camera
//! inside; but the far plane may cut them off. Its front faces light the pixels behind them;
//! but the near plane may cut them off. Where both may happen the light covers the whole screen.
//! Each choice is conservative: it is made for the sphere around the tessellated shape.

use glam::{Affine3A, Mat3A, Vec3, Vec3A};
use lightbench_assets::procedural;

use crate::frame::ViewVolume;
use crate::gpu_data::{LightData, LightVolumeData, matrix_rows};
use crate::scene::Shape;

/// Which of the three pipelines draws a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Case {
    /// Back faces, depth test "behind the scene".
    Back,
    /// Front faces, depth test "before the scene".
    Front,
    /// The whole screen, no depth test.
    Screen,
}

/// How a light is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VolumeKind {
    /// Which faces.
    pub case: Case,
    /// Which shape; a sphere in name only for [`Case::Screen`].
    pub shape: Shape,
}

/// A run of volumes that one draw call shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VolumeDraw {
    /// How.
    pub kind: VolumeKind,
    /// Which entries of the frame's volumes.
    pub volumes: std::ops::Range<u32>,
    /// Which array of lights it belongs to; 0 without arrays.
    pub array: u32,
    /// How pixels inside are found; where it is not by depth, it is one volume.
    pub marking: Marking,
}

/// How the pixels inside a volume are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Marking {
    /// By one depth test.
    Depth,
    /// By counting faces behind the scene in stencil: for closed meshes of any shape (Heidmann 1991,
    /// "Real Shadows, Real Time", counted from behind as Carmack and Bilodeau do).
    Count,
    /// By the pass's stencil scheme.
    Scheme,
}

/// The volume of one light.
#[derive(Clone, Copy, Debug)]
pub struct Volume {
    /// How it is drawn without stencil.
    pub kind: VolumeKind,
    /// For the GPU.
    pub data: LightVolumeData,
    /// Whether the near plane may cut its front faces, or the camera be inside.
    pub crosses_near: bool,
    /// Whether the far plane may cut its back faces.
    pub crosses_far: bool,
}

/// The kind of ambient lights.
pub(crate) const AMBIENT: u32 = 3;
/// The kind of directional lights.
pub(crate) const DIRECTIONAL: u32 = 2;
/// The kind of spot lights.
pub(crate) const SPOT: u32 = 1;
/// The kind of point lights.
pub(crate) const POINT: u32 = 0;

/// Spots wider than this (full angle) are drawn as spheres: their cone would be huge and flat.
const WIDEST_CONE: f32 = 120.0 * std::f32::consts::PI / 180.0;

/// Subdivisions of the sphere: 320 triangles.
const SPHERE_SUBDIVISIONS: u32 = 2;
/// Sides of the cone.
const CONE_SIDES: u32 = 24;

/// The farthest vertex of the tessellated sphere.
pub const SPHERE_BOUND: f32 = 1.07;

/// An icosphere that encloses the unit sphere: the nearest point of every face is at 1 or beyond.
pub fn unit_sphere() -> (Vec<Vec3>, Vec<u32>) {
    let mesh = procedural::icosphere(1.0, SPHERE_SUBDIVISIONS);
    let nearest = mesh
        .indices
        .chunks_exact(3)
        .map(|triangle| {
            let [a, b, c] = [0, 1, 2].map(|corner| mesh.positions[triangle[corner] as usize]);
            (b - a).cross(c - a).normalize_or_zero().dot(a)
        })
        .fold(1.0_f32, f32::min);
    let positions = mesh
        .positions
        .iter()
        .map(|p| *p / (nearest * 0.9999))
        .collect();
    (positions, mesh.indices)
}

/// A cone that encloses the round one with its apex at the origin, along −z, of length 1 and base
/// radius 1.
pub fn unit_cone() -> (Vec<Vec3>, Vec<u32>) {
    let radius = 1.0001 / (std::f32::consts::PI / CONE_SIDES as f32).cos();
    let mut positions = vec![Vec3::ZERO, Vec3::NEG_Z];
    positions.extend((0..CONE_SIDES).map(|side| {
        let angle = side as f32 / CONE_SIDES as f32 * std::f32::consts::TAU;
        Vec3::new(angle.cos() * radius, angle.sin() * radius, -1.0)
    }));
    let mut indices = Vec::new();
    for side in 0..CONE_SIDES {
        let (here, next) = (2 + side, 2 + (side + 1) % CONE_SIDES);
        indices.extend([0, here, next, 1, next, here]);
    }
    (positions, indices)
}

/// Whether a light reaches only part of space.
pub fn is_bounded(light: &LightData) -> bool {
    light.kind < DIRECTIONAL
}

/// The full outer angle of a spot light, from what the shader keeps.
pub(crate) fn outer_angle(light: &LightData) -> f32 {
    (-light.angle_offset / light.angle_scale)
        .clamp(-1.0, 1.0)
        .acos()
        * 2.0
}

/// How a light's volume is drawn, or `None` if the view does not show it.
pub fn volume(light: &LightData, index: u32, view: &ViewVolume, volumes: bool) -> Option<Volume> {
    let screen = VolumeKind {
        case: Case::Screen,
        shape: Shape::Sphere,
    };
    let data = |transform: &Affine3A| LightVolumeData {
        rows: matrix_rows(transform),
        light: index,
        reserved: [0; 3],
    };
    let whole = Volume {
        kind: screen,
        data: data(&Affine3A::IDENTITY),
        crosses_near: true,
        crosses_far: true,
    };
    if !is_bounded(light) {
        return Some(whole);
    }
    let p = light.position;
    if light.range <= 0.0 || !view.frustum.intersects_sphere(p.x, p.y, p.z, light.range) {
        return None;
    }
    if !volumes {
        return Some(whole);
    }
    let angle = outer_angle(light);
    let (shape, transform, bound) = if light.kind == SPOT && angle <= WIDEST_CONE {
        let radius = light.range * (angle * 0.5).tan();
        let transform = cone_transform(light, radius);
        (
            Shape::Cone,
            transform,
            (light.range * light.range + radius * radius).sqrt() * 1.01,
        )
    } else {
        let transform = Affine3A::from_scale_rotation_translation(
            Vec3::splat(light.range),
            glam::Quat::IDENTITY,
            p,
        );
        (Shape::Sphere, transform, light.range * SPHERE_BOUND)
    };
    let distance_ahead = view.forward.dot(p - view.position);
    let crosses_far = distance_ahead + bound >= view.far;
    let crosses_near = (p - view.position).length() <= bound + view.near_corner;
    let case = match (crosses_far, crosses_near) {
        (false, _) => Case::Back,
        (true, false) => Case::Front,
        (true, true) => Case::Screen,
    };
    Some(Volume {
        kind: VolumeKind { case, shape },
        data: data(&transform),
        crosses_near,
        crosses_far,
    })
}

/// The angle under which a light's sphere is seen: 2 atan(r / d), radians.
pub fn angular_diameter(light: &LightData, view: &ViewVolume) -> f32 {
    if !is_bounded(light) {
        return std::f32::consts::TAU;
    }
    2.0 * light.range.atan2((light.position - view.position).length())
}

/// Carries the unit cone to a spot light: −z along its direction.
fn cone_transform(light: &LightData, radius: f32) -> Affine3A {
    let z = -Vec3A::from(light.direction);
    let x = Vec3A::from(Vec3::from(z).any_orthonormal_vector());
    let y = z.cross(x);
    Affine3A::from_mat3_translation(
        Mat3A::from_cols(x * radius, y * radius, z * light.range).into(),
        light.position,
    )
}

/// Share of the picture that a sphere covers at most: its bounding rectangle on the screen, for
/// the byte model of reports. Follows Mara and McGuire 2013, "2D Polyhedral Bounds of a Clipped,
/// Perspective-Projected 3D Sphere", JCGT 2(2), for one axis at a time.
pub fn coverage(light: &LightData, view: &ViewVolume) -> f64 {
    if !is_bounded(light) {
        return 1.0;
    }
    let [left, top, right, bottom] = rectangle(light, view);
    f64::from((right - left).max(0.0)) * f64::from((bottom - top).max(0.0))
}

/// The rectangle around a light's sphere, as shares of the picture from the upper left corner: left,
/// top, right, bottom.
pub fn rectangle(light: &LightData, view: &ViewVolume) -> [f32; 4] {
    if !is_bounded(light) {
        return [0.0, 0.0, 1.0, 1.0];
    }
    sphere_rectangle(light.position, light.range, view)
}

/// The same for a sphere in the world.
pub fn sphere_rectangle(center: Vec3, radius: f32, view: &ViewVolume) -> [f32; 4] {
    let center = view.view.transform_point3(center);
    let share = |at: f32, focal: f32| (at * focal).clamp(-1.0, 1.0) * 0.5 + 0.5;
    let (left, right) = axis_bounds(center.x, center.z, radius, view.near);
    let (low, high) = axis_bounds(center.y, center.z, radius, view.near);
    [
        share(left, view.focal_x),
        1.0 - share(high, view.focal_y),
        share(right, view.focal_x),
        1.0 - share(low, view.focal_y),
    ]
}

/// Whether two rectangles have more than an edge in common.
pub fn overlap(a: &[f32; 4], b: &[f32; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// The extent of a sphere along one axis of the image plane at distance 1. `x` and `z` are the
/// centre in view space (−z ahead).
fn axis_bounds(x: f32, z: f32, radius: f32, near: f32) -> (f32, f32) {
    let ahead = -z;
    let distance_squared = x * x + ahead * ahead;
    let tangent_squared = distance_squared - radius * radius;
    if tangent_squared <= 0.0 || ahead - radius <= near {
        // The eye is inside or the near plane cuts the sphere: all of the axis, to be safe.
        return (f32::NEG_INFINITY, f32::INFINITY);
    }
    // Directions to the two points where lines through the eye touch the circle.
    let cos = tangent_squared.sqrt() / distance_squared.sqrt();
    let sin = radius / distance_squared.sqrt();
    let turn = |s: f32| (x * cos + s * ahead * sin) / (ahead * cos - s * x * sin);
    (turn(-1.0), turn(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_encloses_the_unit_sphere_within_its_bound() {
        let (positions, indices) = unit_sphere();
        for triangle in indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| positions[triangle[corner] as usize]);
            let distance = (b - a).cross(c - a).normalize().dot(a);
            assert!(distance >= 1.0, "a face at {distance} cuts the sphere");
        }
        let farthest = positions.iter().map(|p| p.length()).fold(0.0, f32::max);
        assert!(farthest <= SPHERE_BOUND, "{farthest}");
    }

    #[test]
    fn the_cone_encloses_the_round_cone_and_faces_outward() {
        let (positions, indices) = unit_cone();
        let inside = Vec3::new(0.0, 0.0, -0.7);
        for triangle in indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| positions[triangle[corner] as usize]);
            let normal = (b - a).cross(c - a);
            assert!(normal.dot(inside - a) < 0.0, "a face points inward");
            // Every generator of the round cone lies on the inner side of every face.
            for step in 0..360 {
                let angle = (step as f32).to_radians();
                let rim = Vec3::new(angle.cos(), angle.sin(), -1.0);
                assert!(normal.normalize().dot(rim - a) <= 1e-4);
            }
        }
    }

    #[test]
    fn coverage_of_a_centred_sphere_is_its_projected_square() {
        // A sphere of radius 1 at distance √2: tangent lines at 45°, extent ±1 at distance 1.
        let (low, high) = axis_bounds(0.0, -std::f32::consts::SQRT_2, 1.0, 0.01);
        assert!(
            (low + 1.0).abs() < 1e-5 && (high - 1.0).abs() < 1e-5,
            "{low} {high}"
        );
        let (low, high) = axis_bounds(0.0, -0.5, 1.0, 0.01);
        assert!(low.is_infinite() && high.is_infinite());
    }
}
