//! All triangles of a scene in the world's space, and the tree over them.

use std::time::Duration;

use glam::{DVec2, DVec3, DVec4, Vec3, Vec3A, Vec4};
use lightbench_render::gpu_data::VertexAttributes;
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;

use crate::reference::transform::Rows;

/// What a ray must know of a triangle that it meets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traits(u8);

impl Traits {
    /// The viewer sees its front alone.
    pub const ONE_SIDED: Self = Self(1);
    /// Its texture's alpha leaves holes.
    pub const HOLES: Self = Self(2);
    /// It lets a share of the light through.
    pub const TRANSPARENT: Self = Self(4);
    /// It shines.
    pub const EMISSIVE: Self = Self(8);

    /// Those of both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether it has one of them.
    pub fn any(self, others: Self) -> bool {
        self.0 & others.0 != 0
    }
}

/// An object as its triangles refer to it.
#[derive(Clone, Copy, Debug)]
pub struct Instance {
    /// From its space to the world's.
    pub rows: Rows,
    /// Its row in the table of materials.
    pub material: u32,
}

/// What the corners of a triangle have beside their position, in one piece: rays jump about, and each
/// piece of memory that they touch has to be fetched.
#[derive(Clone, Copy, Debug)]
pub struct Corners {
    /// Its object.
    pub instance: u32,
    /// In the object's space.
    pub vertices: [VertexAttributes; 3],
}

/// A triangle before it has its place in the tree.
#[derive(Clone, Copy, Debug)]
pub struct Loose {
    /// World positions, counter-clockwise as seen from the front.
    pub positions: [Vec3A; 3],
    /// The rest of its corners.
    pub corners: Corners,
    /// What rays must know of it.
    pub traits: Traits,
}

/// All triangles, in the order of the tree.
pub struct Geometry {
    bvh: CwBvh,
    triangles: Vec<RtTriangle>,
    traits: Vec<Traits>,
    corners: Vec<Corners>,
    /// The objects.
    pub instances: Vec<Instance>,
}

/// What a triangle's corners have at a point of it.
#[derive(Clone, Copy, Debug)]
pub struct Interpolated {
    /// World, not unit length.
    pub normal: DVec3,
    /// World, not unit length; w is the bitangent's handedness.
    pub tangent: DVec4,
}

impl Geometry {
    /// Builds the tree.
    pub fn new(loose: &[Loose], instances: Vec<Instance>) -> Self {
        let bvh = build(loose);
        let order = || {
            bvh.primitive_indices
                .iter()
                .map(|&index| &loose[index as usize])
        };
        let triangles = order().map(|triangle| {
            let [a, b, c] = triangle.positions;
            RtTriangle::new(a, b, c)
        });
        Self {
            triangles: triangles.collect(),
            traits: order().map(|triangle| triangle.traits).collect(),
            corners: order().map(|triangle| triangle.corners).collect(),
            bvh,
            instances,
        }
    }

    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// What rays must know of a triangle.
    pub fn traits(&self, triangle: u32) -> Traits {
        self.traits[triangle as usize]
    }

    /// The object of a triangle.
    pub fn instance(&self, triangle: u32) -> &Instance {
        &self.instances[self.corners[triangle as usize].instance as usize]
    }

    /// A corner of a triangle, and the edges from there to the other two.
    pub fn edges(&self, triangle: u32) -> [DVec3; 3] {
        let triangle = &self.triangles[triangle as usize];
        [
            triangle.v0.as_dvec3(),
            -triangle.e1.as_dvec3(),
            triangle.e2.as_dvec3(),
        ]
    }

    /// Texture coordinates of the three corners.
    pub fn uvs(&self, triangle: u32) -> [DVec2; 3] {
        let corners = &self.corners[triangle as usize];
        let uv = |[u, v]: [f32; 2]| DVec2::new(u.into(), v.into());
        let [a, b, c] = &corners.vertices;
        [uv(a.uv), uv(b.uv), uv(c.uv)]
    }

    /// Normal and tangent at a point of a triangle, given by the weights of the corners.
    pub fn interpolate(&self, triangle: u32, weights: DVec3) -> Interpolated {
        let corners = &self.corners[triangle as usize];
        let mut normal = DVec3::ZERO;
        let mut tangent = DVec4::ZERO;
        for (vertex, weight) in corners.vertices.iter().zip(weights.to_array()) {
            normal += Vec3::from_array(vertex.normal).as_dvec3() * weight;
            tangent += Vec4::from_array(vertex.tangent).as_dvec4() * weight;
        }
        let rows = &self.instances[corners.instance as usize].rows;
        Interpolated {
            normal: rows.normal(normal),
            tangent: rows.tangent(tangent.truncate()).extend(tangent.w),
        }
    }

    /// The weights of the corners where a ray meets a triangle.
    pub fn weights(&self, triangle: u32, ray: &Ray) -> DVec3 {
        let found = self.triangles[triangle as usize]
            .compute_barycentric(ray)
            .as_dvec2();
        DVec3::new(1.0 - found.x - found.y, found.x, found.y)
    }

    /// Whether a ray comes from the front of a triangle.
    pub fn shows_front(&self, triangle: u32, ray: &Ray) -> bool {
        // The tree's normals point inwards.
        self.triangles[triangle as usize].ng.dot(ray.direction) > 0.0
    }

    /// The nearest triangle that a ray meets, of those that `counts` accepts; it is only asked about
    /// triangles with one of some traits. With the ray's parameter there.
    pub fn nearest(
        &self,
        ray: Ray,
        doubtful: Traits,
        counts: impl Fn(&Ray, u32) -> bool,
    ) -> Option<(u32, f32)> {
        let mut hit = RayHit::none();
        let found = self.bvh.ray_traverse(ray, &mut hit, |ray, index| {
            let t = self.triangles[index].intersect(ray);
            let met = t < ray.tmax;
            if met && self.traits[index].any(doubtful) && !counts(ray, index as u32) {
                return f32::INFINITY;
            }
            t
        });
        found.then_some((hit.primitive_id, hit.t))
    }

    /// Whether a ray meets nothing, but for triangles with one of some traits that `counts` does not
    /// accept.
    pub fn is_clear(
        &self,
        ray: Ray,
        doubtful: Traits,
        mut counts: impl FnMut(&Ray, u32) -> bool,
    ) -> bool {
        self.bvh.ray_traverse_miss(ray, |ray, index| {
            let t = self.triangles[index].intersect(ray);
            let met = t < ray.tmax;
            if met && self.traits[index].any(doubtful) && !counts(ray, index as u32) {
                return f32::INFINITY;
            }
            t
        })
    }

    /// Whether a ray meets anything, by its nearest triangle: the tree's own traversal.
    pub fn bare_nearest(&self, ray: Ray) -> bool {
        let mut hit = RayHit::none();
        self.bvh.ray_traverse(ray, &mut hit, |ray, index| {
            self.triangles[index].intersect(ray)
        })
    }

    /// Whether a ray meets nothing, by the tree's own traversal.
    pub fn bare_clear(&self, ray: Ray) -> bool {
        self.bvh
            .ray_traverse_miss(ray, |ray, index| self.triangles[index].intersect(ray))
    }
}

/// The tree. Its triangles are not split, so that a ray meets each of them once.
fn build(loose: &[Loose]) -> CwBvh {
    if loose.is_empty() {
        return CwBvh::default();
    }
    let triangles: Vec<Triangle> = loose
        .iter()
        .map(|triangle| {
            let [v0, v1, v2] = triangle.positions;
            Triangle { v0, v1, v2 }
        })
        .collect();
    let parameters = BvhBuildParams {
        pre_split: false,
        ..BvhBuildParams::slow_build()
    };
    build_cwbvh_from_tris(&triangles, parameters, &mut Duration::default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tracer::random::Random;

    fn geometry(triangles: &[[Vec3A; 3]]) -> Geometry {
        let identity = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
        let vertex = |u: f32, v: f32| VertexAttributes {
            normal: [0.0, 0.0, 1.0],
            uv: [u, v],
            tangent: [1.0, 0.0, 0.0, 1.0],
        };
        let loose: Vec<Loose> = triangles
            .iter()
            .map(|&positions| Loose {
                positions,
                corners: Corners {
                    instance: 0,
                    vertices: [vertex(0.0, 0.0), vertex(1.0, 0.0), vertex(0.0, 1.0)],
                },
                traits: Traits::default(),
            })
            .collect();
        let instance = Instance {
            rows: Rows::new(identity),
            material: 0,
        };
        Geometry::new(&loose, vec![instance])
    }

    fn direction(random: &mut Random) -> Vec3A {
        let mut number = || random.number() as f32 * 2.0 - 1.0;
        Vec3A::new(number(), number(), number()).normalize_or(Vec3A::X)
    }

    /// Of each ray, what the tree finds and what a look at every triangle finds.
    fn agree(triangles: &[[Vec3A; 3]], reach: f32) {
        let geometry = geometry(triangles);
        assert_eq!(geometry.len(), triangles.len());
        let mut random = Random::of_sample(3, 0, 0);
        let mut hits = 0;
        for _ in 0..2000 {
            let origin = direction(&mut random) * reach;
            let target = direction(&mut random) * reach * 0.3;
            let ray = Ray::new(origin, (target - origin).normalize(), 0.0, f32::INFINITY);
            let every = geometry.triangles.iter().map(|t| t.intersect(&ray));
            let nearest = every.fold(f32::INFINITY, f32::min);
            let found = geometry.nearest(ray, Traits::default(), |_, _| true);
            let at = found.map_or(f32::INFINITY, |(_, at)| at);
            assert!(
                at == nearest || (at - nearest).abs() < 1e-4 * nearest,
                "{at} instead of {nearest}"
            );
            let clear = geometry.is_clear(ray, Traits::default(), |_, _| true);
            assert_eq!(clear, found.is_none());
            if let Some((triangle, at)) = found {
                hits += 1;
                // The weights give the point back, and the side is that of the corners' order.
                let weights = geometry.weights(triangle, &ray);
                let [corner, b, c] = geometry.edges(triangle);
                let point = corner + b * weights.y + c * weights.z;
                let expected = (ray.origin + ray.direction * at).as_dvec3();
                assert!((point - expected).length() < 1e-3 * f64::from(reach));
                let facing = b.cross(c).dot(ray.direction.as_dvec3()) < 0.0;
                assert_eq!(geometry.shows_front(triangle, &ray), facing);
            }
        }
        assert!(hits > 20, "{hits} rays meet something");
    }

    #[test]
    fn the_tree_finds_what_a_look_at_every_triangle_finds() {
        let mut random = Random::of_sample(1, 0, 0);
        let triangles: Vec<_> = (0..3000)
            .map(|_| {
                let corner = direction(&mut random) * 4.0;
                [
                    corner,
                    corner + direction(&mut random),
                    corner + direction(&mut random),
                ]
            })
            .collect();
        agree(&triangles, 10.0);
    }

    /// One on top of the other, and each twice as large as the one before.
    #[test]
    fn heaps_and_towers_of_triangles_are_traversed() {
        let triangle = |size: f32, at: Vec3A| [at, at + Vec3A::X * size, at + Vec3A::Y * size];
        let heap: Vec<_> = (0..5000)
            .map(|_| triangle(3.0, Vec3A::new(-1.0, -1.0, 0.0)))
            .collect();
        agree(&heap, 5.0);
        let tower: Vec<_> = (0..100)
            .map(|level| {
                let size = 1.2_f32.powi(level - 80);
                triangle(size, Vec3A::new(-0.3 * size, -0.3 * size, size))
            })
            .collect();
        agree(&tower, 40.0);
        assert_eq!(geometry(&[]).len(), 0);
        let ray = Ray::new_inf(Vec3A::ZERO, Vec3A::X);
        assert!(!geometry(&[]).bare_nearest(ray) && geometry(&[]).bare_clear(ray));
    }
}
