//! Triangles that shine, as a source of light that paths can aim at.

use glam::DVec3;

use super::geometry::{Geometry, Traits};
use super::luminance;
use super::scene::TracedMaterial;

/// A point on a triangle that shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// Where it is.
    pub position: DVec3,
    /// The triangle's unit normal, out of its front.
    pub normal: DVec3,
    /// What it sends out.
    pub radiance: DVec3,
    /// Whether it shines from its back too.
    pub two_sided: bool,
    /// How likely it was chosen, 1/m².
    pub density: f64,
    /// The triangle.
    pub triangle: u32,
}

/// All triangles that shine and have neither holes nor let light through. Paths find the others by
/// chance alone.
#[derive(Clone, Debug, Default)]
pub struct Emitters {
    triangles: Vec<u32>,
    /// Sums of the powers up to each of them.
    sums: Vec<f64>,
    /// One over the sum of all powers.
    inverse_total: f64,
    /// Per material of the scene: radiance, and whether both sides have it.
    materials: Vec<(DVec3, bool)>,
}

impl Emitters {
    /// Those of a scene.
    pub fn new(geometry: &Geometry, materials: &[TracedMaterial]) -> Self {
        let unlikely = Traits::HOLES.with(Traits::TRANSPARENT);
        let materials = materials.iter().map(|traced| {
            let material = &traced.material;
            (material.emissive.as_dvec3(), material.two_sided)
        });
        let mut found = Self {
            materials: materials.collect(),
            ..Self::default()
        };
        let mut sum = 0.0;
        for triangle in 0..geometry.len() as u32 {
            let traits = geometry.traits(triangle);
            if !traits.any(Traits::EMISSIVE) || traits.any(unlikely) {
                continue;
            }
            let [_, edge_b, edge_c] = geometry.edges(triangle);
            let area = 0.5 * edge_b.cross(edge_c).length();
            sum += area * found.exitance(geometry.instance(triangle).material);
            found.triangles.push(triangle);
            found.sums.push(sum);
        }
        found.inverse_total = if sum > 0.0 { sum.recip() } else { 0.0 };
        found
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there is nothing to aim at.
    pub fn is_empty(&self) -> bool {
        self.inverse_total == 0.0
    }

    /// What a square metre of a material sends out, but for a factor that all have.
    fn exitance(&self, material: u32) -> f64 {
        let (radiance, two_sided) = self.materials[material as usize];
        luminance(radiance) * if two_sided { 2.0 } else { 1.0 }
    }

    /// How likely [`Emitters::choose`] takes a point of a triangle, 1/m²; 0 for triangles at which it
    /// does not aim.
    pub fn density(&self, geometry: &Geometry, triangle: u32) -> f64 {
        let traits = geometry.traits(triangle);
        if traits.any(Traits::HOLES.with(Traits::TRANSPARENT)) {
            return 0.0;
        }
        self.exitance(geometry.instance(triangle).material) * self.inverse_total
    }

    /// Chooses a triangle by its power, and on it a point, all alike.
    pub fn choose(&self, geometry: &Geometry, which: f64, [u, v]: [f64; 2]) -> Option<Aim> {
        let wanted = which / self.inverse_total;
        let index = self.sums.partition_point(|&sum| sum <= wanted);
        let index = index.min(self.triangles.len().checked_sub(1)?);
        let triangle = self.triangles[index];
        let material = geometry.instance(triangle).material;
        let (radiance, two_sided) = self.materials[material as usize];
        let [corner, edge_b, edge_c] = geometry.edges(triangle);
        // The root spreads points evenly: areas nearer to the corner are smaller.
        let root = u.sqrt();
        let position = corner + edge_b * (root * (1.0 - v)) + edge_c * (root * v);
        Some(Aim {
            position,
            normal: edge_b.cross(edge_c).normalize_or(DVec3::Y),
            radiance,
            two_sided,
            density: self.exitance(material) * self.inverse_total,
            triangle,
        })
    }
}
