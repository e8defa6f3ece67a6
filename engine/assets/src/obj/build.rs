//! From faces to meshes.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};
use lightbench_world::{MaterialId, MeshBounds};

use super::Problem;
use super::clean::Clean;
use super::materials::Materials;
use super::normals::smooth_normals;
use super::triangulate::triangulate;
use crate::Mesh;
use crate::cache::{Kept, Reuse};
use crate::model_meshes::ModelMeshes;

/// All triangles of a file over shared corners. What a corner does not have is
/// not a number.
pub(super) struct Soup {
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// For each triangle, the place of its material's name in the file's list.
    names: Vec<Option<usize>>,
}

/// What [`Soup::build`] gives.
#[derive(Clone)]
pub(super) struct Built {
    pub(super) meshes: ModelMeshes,
    pub(super) bounds: MeshBounds,
    pub(super) made_uvs: bool,
}

impl Kept for Built {
    fn bytes(&self) -> usize {
        self.meshes.byte_count()
    }
}

/// Runs the parser over a file in plain form and cuts its faces into triangles.
pub(super) fn parse(path: &str, clean: &Clean) -> Result<Soup, Problem> {
    let problem = |message: String| Problem {
        path: path.to_owned(),
        line: None,
        message,
    };
    // The parser only numbers the materials.
    let numbered = |_: &std::path::Path| {
        let count = clean.materials.len();
        let names = (0..count)
            .map(|number| (number.to_string(), number))
            .collect();
        Ok((vec![tobj::Material::default(); count], names))
    };
    let options = tobj::LoadOptions {
        single_index: true,
        ..Default::default()
    };
    let (models, _) = tobj::load_obj_buf(&mut clean.text.as_bytes(), &options, numbered)
        .map_err(|error| problem(format!("the file can't be understood ({error})")))?;

    let mut soup = Soup {
        positions: Vec::new(),
        uvs: Vec::new(),
        normals: Vec::new(),
        triangles: Vec::new(),
        names: Vec::new(),
    };
    for model in &models {
        soup.add(&model.mesh);
    }
    let vertices = soup.positions.len();
    if soup.uvs.len() != vertices || soup.normals.len() != vertices {
        return Err(problem(
            "the file can't be understood (uneven corners)".to_owned(),
        ));
    }
    if soup.triangles.is_empty() {
        let message = "no face has an area, so there is nothing to draw; export the model again";
        return Err(problem(message.to_owned()));
    }
    Ok(soup)
}

impl Soup {
    /// Bytes of all arrays.
    pub(super) fn byte_count(&self) -> usize {
        size_of_val(self.positions.as_slice())
            + size_of_val(self.uvs.as_slice())
            + size_of_val(self.normals.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.names.as_slice())
    }

    fn add(&mut self, mesh: &tobj::Mesh) {
        let first = self.positions.len() as u32;
        self.positions
            .extend(mesh.positions.chunks_exact(3).map(Vec3::from_slice));
        self.normals
            .extend(mesh.normals.chunks_exact(3).map(Vec3::from_slice));
        // The file's v runs up the picture.
        let flip = |uv: &[f32]| Vec2::new(uv[0], 1.0 - uv[1]);
        self.uvs.extend(mesh.texcoords.chunks_exact(2).map(flip));

        let mut rest = mesh.indices.as_slice();
        let mut arities = mesh.face_arities.iter();
        let mut cut = Vec::new();
        let mut corners = Vec::new();
        while !rest.is_empty() {
            // No list of arities means triangles throughout.
            let arity = arities
                .next()
                .map_or(3, |&arity| arity as usize)
                .min(rest.len());
            let (face, after) = rest.split_at(arity);
            rest = after;
            let position = |&index: &u32| self.positions[(first + index) as usize].as_dvec3();
            corners.clear();
            corners.extend(face.iter().map(position));
            cut.clear();
            triangulate(&corners, &mut cut);
            for [a, b, c] in &cut {
                let [from, to_b, to_c] = [corners[*a], corners[*b], corners[*c]];
                if (to_b - from).cross(to_c - from) != DVec3::ZERO {
                    self.triangles
                        .push([*a, *b, *c].map(|corner| first + face[corner]));
                    self.names.push(mesh.material_id);
                }
            }
            if arity == 0 {
                break;
            }
        }
    }

    /// Makes one mesh for each material, with all that was missing.
    pub(super) fn build(
        &self,
        reuse: &Reuse,
        name: &str,
        crease_angle: f32,
        materials: &Materials,
    ) -> Built {
        let whole = Mesh {
            positions: self.positions.clone(),
            ..Mesh::default()
        };
        let bounds = whole.bounds();
        let longest = 2.0 * bounds.half_extents.max_element();
        let has_normal = |normal: &Vec3| normal.is_finite() && *normal != Vec3::ZERO;
        let smooth = if self.normals.iter().all(has_normal) {
            Vec::new()
        } else {
            smooth_normals(&self.positions, &self.triangles, crease_angle)
        };
        let mut made_uvs = false;

        // In the order of first use.
        let mut meshes: Vec<(Mesh, MaterialId)> = Vec::new();
        let mut by_material: HashMap<u32, usize> = HashMap::new();
        let mut known: Vec<HashMap<(u32, [u32; 5]), u32>> = Vec::new();
        for (triangle, corners) in self.triangles.iter().enumerate() {
            let number = self.names[triangle].map_or(0, |name| materials.numbers[name]);
            let at = *by_material.entry(number).or_insert_with(|| {
                meshes.push((Mesh::default(), MaterialId(number)));
                known.push(HashMap::new());
                meshes.len() - 1
            });
            let mesh = &mut meshes[at].0;
            let missing_uv = corners
                .iter()
                .any(|&corner| !self.uvs[corner as usize].is_finite());
            made_uvs |= missing_uv;
            for (place, &corner) in corners.iter().enumerate() {
                let position = self.positions[corner as usize];
                let given = self.normals[corner as usize];
                let normal = match given.as_dvec3().try_normalize() {
                    Some(normal) if has_normal(&given) => normal.as_vec3(),
                    _ => smooth
                        .get(triangle)
                        .map_or(Vec3::Y, |normals| normals[place]),
                };
                let uv = if missing_uv {
                    self.box_projection(*corners, position - bounds.center, longest)
                } else {
                    self.uvs[corner as usize]
                };
                let bits = [normal.x, normal.y, normal.z, uv.x, uv.y].map(f32::to_bits);
                let index = *known[at].entry((corner, bits)).or_insert_with(|| {
                    mesh.positions.push(position);
                    mesh.normals.push(normal);
                    mesh.uvs.push(uv);
                    mesh.positions.len() as u32 - 1
                });
                mesh.indices.push(index);
            }
        }
        let several = meshes.len() > 1;
        for (mesh, material) in &mut meshes {
            let material = materials
                .materials
                .get((material.0 as usize).wrapping_sub(1));
            mesh.name = match material {
                Some(material) if several => format!("{name}: {}", material.name),
                _ => name.to_owned(),
            };
            mesh.recompute_tangents();
        }
        Built {
            meshes: ModelMeshes::share(reuse, meshes),
            bounds,
            made_uvs,
        }
    }

    /// Looks along the axis nearest to the triangle's normal.
    fn box_projection(&self, corners: [u32; 3], at: Vec3, longest: f32) -> Vec2 {
        let [a, b, c] = corners.map(|corner| self.positions[corner as usize].as_dvec3());
        let normal = (b - a).cross(c - a);
        let size = normal.abs();
        let (right, up) = if size.x >= size.y && size.x >= size.z {
            (-at.z * normal.x.signum() as f32, at.y)
        } else if size.y >= size.z {
            (at.x, -at.z * normal.y.signum() as f32)
        } else {
            (at.x * normal.z.signum() as f32, at.y)
        };
        // A triangle with area is in a box with a side.
        Vec2::new(right, -up) / longest + 0.5
    }
}
