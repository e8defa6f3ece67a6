//! Triangles of glTF files.

use std::ops::Range;

use ::gltf::Semantic;
use ::gltf::mesh::Mode;
use glam::{Vec2, Vec3, Vec4};
use lightbench_world::MaterialId;

use super::Document;
use crate::obj::{ModelError, Problem};
use crate::{Mesh, Progress};

/// All meshes, one for each primitive, and the range of them that belongs to each mesh of the file.
type Built = (Vec<(Mesh, MaterialId)>, Vec<Range<usize>>);

pub(super) fn load(document: &mut Document, progress: &Progress) -> Result<Built, ModelError> {
    let gltf = document.gltf.clone();
    let mut meshes = Vec::new();
    let mut ranges = Vec::new();
    for mesh in gltf.meshes() {
        progress.report(0.7 + 0.2 * mesh.index() as f32 / gltf.meshes().len() as f32)?;
        let first = meshes.len();
        let several = mesh.primitives().len() > 1;
        let name = match mesh.name() {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ => format!("mesh {}", mesh.index()),
        };
        for primitive in mesh.primitives() {
            let name = match several {
                true => format!("{name} {}", primitive.index() + 1),
                false => name.clone(),
            };
            if let Some(built) = build(document, &primitive, &name)? {
                let material = primitive.material().index();
                let material = material.map_or(0, |index| index as u32 + 1);
                meshes.push((built, MaterialId(material)));
            }
        }
        ranges.push(first..meshes.len());
    }
    Ok((meshes, ranges))
}

fn build(
    document: &mut Document,
    primitive: &::gltf::Primitive,
    name: &str,
) -> Result<Option<Mesh>, Problem> {
    if matches!(
        primitive.mode(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip
    ) {
        document.warn("points and lines are not drawn");
        return Ok(None);
    }
    if primitive.morph_targets().len() > 0 {
        document.warn("morph targets are not supported; the mesh keeps its first shape");
    }
    if primitive.get(&Semantic::Colors(0)).is_some() {
        document.warn("vertex colours are not supported");
    }
    let Some(positions) = primitive.get(&Semantic::Positions) else {
        return Err(document.problem(format!("`{name}` has no positions")));
    };
    let positions = document.floats::<3>(&positions)?;
    let count = positions.len();
    let mut mesh = Mesh {
        name: name.to_owned(),
        positions: positions.into_iter().map(Vec3::from).collect(),
        ..Mesh::default()
    };
    mesh.indices = triangles(document, primitive, count, name)?;
    if mesh.indices.is_empty() {
        document.warn(format!("`{name}` has no triangle"));
        return Ok(None);
    }
    let uvs = primitive.get(&Semantic::TexCoords(0));
    mesh.uvs = match uvs {
        Some(uvs) => document
            .floats::<2>(&uvs)?
            .into_iter()
            .map(Vec2::from)
            .collect(),
        None => vec![Vec2::ZERO; count],
    };
    let normals = primitive.get(&Semantic::Normals);
    let tangents = primitive.get(&Semantic::Tangents);
    let flat = normals.is_none();
    if let Some(normals) = normals {
        let normals = document.floats::<3>(&normals)?.into_iter().map(Vec3::from);
        mesh.normals = normals.collect();
    }
    if let Some(tangents) = &tangents
        && !flat
    {
        let tangents = document.floats::<4>(tangents)?.into_iter().map(Vec4::from);
        mesh.tangents = tangents.collect();
    }
    // What follows makes the vectors right; what is missing must not be.
    let lengths = [mesh.uvs.len(), mesh.normals.len(), mesh.tangents.len()];
    let wanted = [true, !flat, !mesh.tangents.is_empty()];
    if lengths
        .into_iter()
        .zip(wanted)
        .any(|(length, here)| here && length != count)
    {
        let message = format!("the attributes of `{name}` differ in length");
        return Err(document.problem(message));
    }
    let finite = mesh.positions.iter().all(|v| v.is_finite())
        && mesh.normals.iter().all(|v| v.is_finite())
        && mesh.uvs.iter().all(|v| v.is_finite())
        && mesh.tangents.iter().all(|v| v.is_finite());
    if !finite {
        let message = format!("`{name}` has a coordinate that is infinite or not a number");
        return Err(document.problem(message));
    }
    if flat {
        flatten(&mut mesh);
    }
    for normal in &mut mesh.normals {
        *normal = normal.normalize_or(Vec3::Y);
    }
    if mesh.tangents.is_empty() {
        mesh.recompute_tangents();
    } else {
        straighten(&mut mesh);
    }
    let valid = mesh
        .validate()
        .map_err(|error| document.problem(error.to_string()));
    valid.map(|()| Some(mesh))
}

/// The corners of all triangles that have three different ones.
fn triangles(
    document: &Document,
    primitive: &::gltf::Primitive,
    vertices: usize,
    name: &str,
) -> Result<Vec<u32>, Problem> {
    let listed = match primitive.indices() {
        Some(indices) => document.indices(&indices)?,
        None => (0..vertices as u32).collect(),
    };
    if let Some(index) = listed.iter().find(|&&index| index as usize >= vertices) {
        let message = format!("`{name}` names vertex {index} of {vertices}");
        return Err(document.problem(message));
    }
    let corners: Vec<[u32; 3]> = match primitive.mode() {
        // Every second triangle of a strip runs the other way round (section 3.7.2.1).
        Mode::TriangleStrip => listed
            .windows(3)
            .enumerate()
            .map(|(at, c)| match at % 2 {
                0 => [c[0], c[1], c[2]],
                _ => [c[1], c[0], c[2]],
            })
            .collect(),
        Mode::TriangleFan => {
            let first = listed.first().copied().unwrap_or_default();
            let rest = listed.get(1..).unwrap_or_default();
            rest.windows(2).map(|c| [c[0], c[1], first]).collect()
        }
        _ if !listed.len().is_multiple_of(3) => {
            let message = format!(
                "`{name}` has {} corners, no multiple of three",
                listed.len()
            );
            return Err(document.problem(message));
        }
        _ => listed.as_chunks::<3>().0.to_vec(),
    };
    let real = corners
        .into_iter()
        .filter(|[a, b, c]| a != b && b != c && c != a);
    Ok(real.flatten().collect())
}

/// Gives every triangle its own corners and normal.
fn flatten(mesh: &mut Mesh) {
    let corners: Vec<usize> = mesh.indices.iter().map(|&index| index as usize).collect();
    mesh.positions = corners
        .iter()
        .map(|&corner| mesh.positions[corner])
        .collect();
    mesh.uvs = corners.iter().map(|&corner| mesh.uvs[corner]).collect();
    mesh.indices = (0..corners.len() as u32).collect();
    mesh.normals = mesh
        .positions
        .chunks_exact(3)
        .flat_map(|p| {
            let [a, b, c] = [p[0].as_dvec3(), p[1].as_dvec3(), p[2].as_dvec3()];
            let normal = (b - a).cross(c - a).normalize_or(glam::DVec3::Y);
            [normal.as_vec3(); 3]
        })
        .collect();
}

/// Makes tangents unit vectors at right angles to their normals.
fn straighten(mesh: &mut Mesh) {
    for (tangent, normal) in mesh.tangents.iter_mut().zip(&mesh.normals) {
        let direction = tangent.truncate().reject_from_normalized(*normal);
        let direction = direction.normalize_or(normal.any_orthonormal_vector());
        let hand = if tangent.w < 0.0 { -1.0 } else { 1.0 };
        *tangent = direction.extend(hand);
    }
}
