//! What a ray meets: the surface there, and whether a hole lets the ray through.

use glam::{DVec2, DVec3, DVec4};
use obvhs::ray::Ray;

use super::geometry::Traits;
use super::scene::{TracedMaterial, TracedScene};
use super::texture::Footprint;
use crate::reference::Surface;
use crate::reference::surface::{bent_normal, opacity, surface_tangent};
use crate::reference::triangle::{Hit, Triangle};

/// A point where a line of sight meets a triangle.
pub struct Point {
    /// As shaders see it; its emission is that of the side that is met.
    pub surface: Surface,
    /// The share of what lies behind that it hides.
    pub opacity: f64,
    /// The triangle's own unit normal, on the side from which the ray came.
    pub geometric: DVec3,
    /// Which triangle.
    pub triangle: u32,
    /// Whether the ray came from its front.
    pub front: bool,
}

/// A line of sight in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Where it begins.
    pub origin: DVec3,
    /// Its direction, of any length.
    pub direction: DVec3,
    /// The change of the direction to the next pixel on the right and to the one below, for lines
    /// through the middles of pixels.
    pub pixel: Option<[DVec3; 2]>,
}

impl TracedScene {
    /// The surface where a line of sight meets a triangle.
    pub(super) fn point(&self, line: &Line, triangle: u32) -> Point {
        let [corner, edge_b, edge_c] = self.geometry.edges(triangle);
        let (uv, footprint, met) = self.place(line, triangle);
        let weights = met.weights;
        let front = met.counter_clockwise;
        let normal = edge_b.cross(edge_c).normalize_or(DVec3::Y);

        let traced = self.material(triangle);
        let material = &traced.material;
        let (color, encoded) = color_and_normal(traced, uv, footprint);
        let vertex = self.geometry.interpolate(triangle, weights);
        let bent = bent_normal(vertex.normal, vertex.tangent, front, encoded);
        let seen = front || material.two_sided;
        Point {
            surface: Surface {
                position: corner + edge_b * weights.y + edge_c * weights.z,
                normal: bent,
                base_color: color.truncate(),
                specular: material.specular.as_dvec3(),
                reflection: material.reflection,
                tangent: surface_tangent(vertex.tangent.truncate(), bent),
                emissive: if seen {
                    material.emissive.as_dvec3()
                } else {
                    DVec3::ZERO
                },
            },
            opacity: opacity(material.opacity.into(), color.w),
            geometric: if front { normal } else { -normal },
            triangle,
            front,
        }
    }

    /// The alpha of a triangle's base colour where a ray meets it.
    fn alpha(&self, ray: &Ray, triangle: u32) -> f64 {
        let weights = self.geometry.weights(triangle, ray).to_array();
        let uvs = self.geometry.uvs(triangle);
        let uv = uvs.into_iter().zip(weights).map(|(uv, weight)| uv * weight);
        base_color(self.material(triangle), uv.sum(), Footprint::Point).w
    }

    /// Whether a ray meets a triangle in a hole of its texture.
    pub(super) fn is_hole(&self, ray: &Ray, triangle: u32) -> bool {
        self.geometry.traits(triangle).any(Traits::HOLES)
            && self.is_below_cutoff(triangle, self.alpha(ray, triangle))
    }

    /// The same for a line of sight, whose pixel decides how fine the texture is seen.
    pub(super) fn is_hole_of_pixel(&self, line: &Line, triangle: u32) -> bool {
        self.geometry.traits(triangle).any(Traits::HOLES) && {
            let (uv, footprint, _) = self.place(line, triangle);
            let alpha = base_color(self.material(triangle), uv, footprint).w;
            self.is_below_cutoff(triangle, alpha)
        }
    }

    fn is_below_cutoff(&self, triangle: u32, alpha: f64) -> bool {
        let cutoff = self.material(triangle).material.alpha_cutoff;
        cutoff.is_some_and(|cutoff| alpha < cutoff.into())
    }

    /// Where in its texture a line of sight meets a triangle, what part of it a pixel sees, and the
    /// weights of the corners there.
    fn place(&self, line: &Line, triangle: u32) -> (DVec2, Footprint, Hit) {
        let [corner, edge_b, edge_c] = self.geometry.edges(triangle);
        let sides = Triangle {
            corner: corner - line.origin,
            edge_b,
            edge_c,
        };
        let [right, below] = line.pixel.unwrap_or_default();
        let met = sides.meet(line.direction, right);
        let uvs = self.geometry.uvs(triangle);
        let uv_of = |weights: DVec3| uvs[0] * weights.x + uvs[1] * weights.y + uvs[2] * weights.z;
        let footprint = match line.pixel {
            None => Footprint::Point,
            Some(_) => {
                let below = sides.meet(line.direction, below);
                Footprint::Pixel(uv_of(met.change), uv_of(below.change))
            }
        };
        (uv_of(met.weights), footprint, met)
    }

    /// The share of a ray's light that a triangle lets through.
    pub(super) fn let_through(&self, ray: &Ray, triangle: u32) -> f64 {
        let material = &self.material(triangle).material;
        1.0 - opacity(material.opacity.into(), self.alpha(ray, triangle))
    }
}

/// The base colour, and what the normal map holds.
fn color_and_normal(
    traced: &TracedMaterial,
    uv: DVec2,
    footprint: Footprint,
) -> (DVec4, Option<DVec3>) {
    if let (Some(joined), Footprint::Point) = (&traced.joined, footprint) {
        let (color, encoded) = joined.sample(uv);
        let base = traced.material.base_color.as_dvec3().extend(1.0);
        return (base * color, Some(encoded));
    }
    let normals = traced.normals.as_ref();
    let encoded = normals.map(|texture| texture.sample(uv, footprint).truncate());
    (base_color(traced, uv, footprint), encoded)
}

fn base_color(traced: &TracedMaterial, uv: DVec2, footprint: Footprint) -> DVec4 {
    let color = traced.material.base_color.as_dvec3().extend(1.0);
    match &traced.base_color {
        Some(texture) => color * texture.sample(uv, footprint),
        None => color,
    }
}
