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
    entries: Vec<Entry>,
    /// One over the sum of all powers.
    inverse_total: f64,
    /// Per material of the scene: radiance, and whether both sides have it.
    materials: Vec<(DVec3, bool)>,
}

/// A triangle that shines, in a table that is looked up in one step (Walker 1977, "An Efficient Method
/// for Generating Discrete Random Variables with General Distributions").
#[derive(Clone, Copy, Debug)]
struct Entry {
    triangle: u32,
    material: u32,
    /// The share of this row that means this triangle.
    own: f32,
    /// The row that the rest of it means.
    other: u32,
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
        let mut powers = Vec::new();
        for triangle in 0..geometry.len() as u32 {
            let traits = geometry.traits(triangle);
            if !traits.any(Traits::EMISSIVE) || traits.any(unlikely) {
                continue;
            }
            let material = geometry.instance(triangle).material;
            let [_, edge_b, edge_c] = geometry.edges(triangle);
            let area = 0.5 * edge_b.cross(edge_c).length();
            powers.push(area * found.exitance(material));
            found.entries.push(Entry {
                triangle,
                material,
                own: 1.0,
                other: 0,
            });
        }
        let total: f64 = powers.iter().sum();
        if total > 0.0 {
            found.inverse_total = total.recip();
            found.level(&powers);
        }
        found
    }

    /// Fills each row of the table to the same height: what a triangle has less than the mean, one that
    /// has more gives (Vose 1991, "A Linear Algorithm for Generating Random Numbers with a Given
    /// Distribution").
    fn level(&mut self, powers: &[f64]) {
        let scale = powers.len() as f64 * self.inverse_total;
        let mut heights: Vec<f64> = powers.iter().map(|power| power * scale).collect();
        let (mut low, mut high): (Vec<usize>, Vec<usize>) =
            (0..heights.len()).partition(|&row| heights[row] < 1.0);
        while let (Some(short), Some(&tall)) = (low.pop(), high.last()) {
            self.entries[short].own = heights[short] as f32;
            self.entries[short].other = tall as u32;
            heights[tall] -= 1.0 - heights[short];
            if heights[tall] < 1.0 {
                high.pop();
                low.push(tall);
            }
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.entries.len()
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
        let place = which * self.entries.len() as f64;
        let row = (place as usize).min(self.entries.len().checked_sub(1)?);
        let mut entry = self.entries[row];
        if place - row as f64 >= entry.own.into() {
            entry = self.entries[entry.other as usize];
        }
        let (triangle, material) = (entry.triangle, entry.material);
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::reference::transform::Rows;
    use crate::tracer::geometry::{Corners, Instance, Loose};
    use glam::Vec3A;
    use lightbench_assets::{Assets, Material};
    use lightbench_render::gpu_data::VertexAttributes;

    /// Triangles of several sizes and materials, one of which is dark.
    fn scene() -> (Geometry, Vec<TracedMaterial>) {
        let assets = Assets::new();
        let material = |emissive: f32, two_sided| {
            let material = Material {
                emissive: glam::Vec3::splat(emissive),
                two_sided,
                ..Material::default()
            };
            TracedMaterial::new(&material, &assets)
        };
        let materials = vec![
            material(0.0, false),
            material(2.0, false),
            material(5.0, true),
        ];
        let rows = Rows::new([
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]);
        let instances = (0..3).map(|material| Instance { rows, material }).collect();
        let vertex = VertexAttributes {
            normal: [0.0, 0.0, 1.0],
            uv: [0.0; 2],
            tangent: [1.0, 0.0, 0.0, 1.0],
        };
        let loose: Vec<Loose> = (0..12_u32)
            .map(|number| {
                let (at, size) = (number as f32 * 3.0, 0.2 + 0.3 * number as f32);
                Loose {
                    positions: [
                        Vec3A::new(at, 0.0, 0.0),
                        Vec3A::new(at + size, 0.0, 0.0),
                        Vec3A::new(at, size, 0.0),
                    ],
                    corners: Corners {
                        instance: number % 3,
                        vertices: [vertex; 3],
                    },
                    traits: materials[(number % 3) as usize].traits,
                }
            })
            .collect();
        (Geometry::new(&loose, instances), materials)
    }

    #[test]
    fn triangles_are_chosen_by_their_power_and_points_evenly() {
        let (geometry, materials) = scene();
        let emitters = Emitters::new(&geometry, &materials);
        assert_eq!(emitters.len(), 8);
        let area = |triangle| {
            let [_, b, c] = geometry.edges(triangle);
            0.5 * b.cross(c).length()
        };
        let mut counts = vec![0_u32; geometry.len()];
        let mut middles = vec![DVec3::ZERO; geometry.len()];
        let tries = 200_000_u32;
        for number in 0..tries {
            let which = (f64::from(number) + 0.5) / f64::from(tries);
            // Points of a row that fills the square evenly (Roberts 2018, the R2 sequence).
            let spread = |step: f64| (f64::from(number) * step).fract();
            let numbers = [spread(0.754_877_666_246_693), spread(0.569_840_290_998_053)];
            let aim = emitters.choose(&geometry, which, numbers).unwrap();
            let index = aim.triangle as usize;
            counts[index] += 1;
            middles[index] += aim.position;
            let stated = emitters.density(&geometry, aim.triangle);
            assert!((aim.density / stated - 1.0).abs() < 1e-12);
        }
        let mut sum = 0.0;
        for triangle in 0..geometry.len() as u32 {
            let share = emitters.density(&geometry, triangle) * area(triangle);
            sum += share;
            let found = f64::from(counts[triangle as usize]) / f64::from(tries);
            assert!((found - share).abs() < 1e-4, "{found} instead of {share}");
            if share > 0.0 {
                let [corner, b, c] = geometry.edges(triangle);
                let middle = middles[triangle as usize] / f64::from(counts[triangle as usize]);
                let off = (middle - corner - (b + c) / 3.0).length() / b.length();
                assert!(off < 0.01, "{off}");
            }
        }
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }
}
