//! Models and scenes from glTF 2.0 files: `.gltf` with what it names, and `.glb`.
//!
//! What is carried: the nodes of the default scene with their places, triangles (lists, strips and
//! fans) with positions, normals, tangents and the first texture coordinates, and
//!
//! | in the file | becomes |
//! | --- | --- |
//! | `baseColorFactor`, `baseColorTexture` | base colour, its factor times 1 − metallic: a metal scatters nothing |
//! | `metallicFactor`, `roughnessFactor` | the GGX model: specular 0.04 for what is no metal, the base colour for metal, in between evenly; α = roughness² (appendix B.2), not below 0.0263 |
//! | `baseColorTexture` of a metal | times the factor, its mean is the specular colour |
//! | `metallicRoughnessTexture` | its mean, times the factors |
//! | `normalTexture` | normal texture |
//! | `emissiveFactor`, `KHR_materials_emissive_strength` | emissive, in W/(m² sr) |
//! | `alphaMode` `MASK` | alpha cutoff |
//! | `doubleSided` | seen from both sides |
//! | `KHR_lights_punctual` | lights: candela and lux over 683 lm/W; a light without a range reaches to where it lays 0.001 W/m², 1000 m at most; half angles of a cone become full ones |
//! | perspective cameras | cameras that are not active |
//! | channels of translation, rotation and scale | rigid animation, all animations at once; `STEP`, `LINEAR` and `CUBICSPLINE` |
//!
//! What is not carried, each with a warning: skins, morph targets, transparency without a mask
//! (drawn opaque), textures of emission and occlusion, vertex colours, second texture coordinates,
//! texture transforms, the scale of normal textures, orthographic cameras, lines and points. A
//! file that requires another extension is refused.
//!
//! Missing normals are those of the flat triangles, as the specification (3.7.2.1) asks. Missing
//! tangents are computed. Colours of factors are linear in the file already.

mod accessors;
mod animation;
mod buffers;
mod materials;
mod meshes;
mod nodes;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::sync::Arc;

use glam::Vec3;
use lightbench_world::{Camera, Light, MeshBounds, RigidAnimation, Transform};

use crate::cache::{Kept, Reuse};
use crate::files::Files;
use crate::model_meshes::ModelMeshes;
use crate::obj::{Model, ModelError, Problem, Warning};
use crate::{Digest, Progress};

/// A scene that was read, not yet part of a world.
#[derive(Clone, Debug)]
pub struct GltfScene {
    /// Meshes with their materials, and the pictures. A mesh of several materials comes as one for
    /// each, in the order of the file.
    pub model: Model,
    /// Parents before their children.
    pub nodes: Vec<Node>,
}

/// One node of a scene.
#[derive(Clone, Debug, Default)]
pub struct Node {
    /// Its name, or `node` and its number in the file.
    pub name: String,
    /// The place of its parent in the list of nodes.
    pub parent: Option<usize>,
    /// Where it stands in its parent's space.
    pub transform: Transform,
    /// Places in the list of the model's meshes.
    pub meshes: std::ops::Range<usize>,
    /// What shines from it.
    pub light: Option<Light>,
    /// What looks from it. Not active.
    pub camera: Option<Camera>,
    /// What moves it.
    pub animation: Option<RigidAnimation>,
}

/// A file while it is read.
struct Document {
    /// The file as the user knows it.
    path: String,
    gltf: Arc<::gltf::Document>,
    buffers: Arc<Vec<Vec<u8>>>,
    warnings: Vec<Warning>,
}

/// What a file holds beside materials and pictures.
#[derive(Clone)]
struct Geometry(Arc<(ModelMeshes, Vec<Node>, Vec<Warning>)>);

impl Kept for Geometry {
    fn bytes(&self) -> usize {
        let (meshes, nodes, _) = &*self.0;
        let curve = |node: &Node| node.animation.as_ref().map_or(0, animation::byte_count);
        let nodes = nodes.iter().map(|node| size_of::<Node>() + curve(node));
        meshes.byte_count() + nodes.sum::<usize>()
    }
}

/// The text of a file, understood.
#[derive(Clone)]
struct Parsed {
    document: Arc<::gltf::Document>,
    text_bytes: usize,
}

impl Kept for Parsed {
    fn bytes(&self) -> usize {
        // Numbers and names take about the room that they take as text.
        self.text_bytes
    }
}

impl Document {
    fn problem(&self, message: impl Into<String>) -> Problem {
        Problem {
            path: self.path.clone(),
            line: None,
            message: message.into(),
        }
    }

    /// Warns once for each message.
    fn warn(&mut self, message: impl Into<String>) {
        let warning = self.problem(message);
        add(&mut self.warnings, warning);
    }
}

/// Adds a warning that is not there.
fn add(warnings: &mut Vec<Warning>, warning: Warning) {
    if !warnings.contains(&warning) {
        warnings.push(warning);
    }
}

/// Reads a scene with its materials and pictures. What an earlier load has made of the same bytes is
/// taken from there: of the file, of its buffers and of each picture.
///
/// # Errors
/// A file that can't be read, that is no glTF, or that contradicts itself: with its path, what is
/// wrong where, and the way out where there is one. What can be passed over becomes a warning of
/// the model.
pub fn load(
    files: &Files,
    reuse: &Reuse,
    path: &str,
    progress: &Progress,
) -> Result<GltfScene, ModelError> {
    let shown = files.display(path);
    progress.begin(format!("Reading {shown}"), 0.0)?;
    let bytes = files.read(path)?;
    let problem = |message: String| Problem {
        path: shown.clone(),
        line: None,
        message,
    };
    if bytes.is_empty() {
        return Err(problem("the file is empty; save or copy it again".to_owned()).into());
    }
    let not_understood = |error: String| {
        problem(format!(
            "the file can't be understood as glTF 2.0 ({error})"
        ))
    };
    let (text, blob) = parts(bytes).map_err(not_understood)?;
    let digest = Digest::of(&text);
    let parsed = reuse.try_get("gltf", &digest, || parse(&text));
    let parsed = parsed.map_err(not_understood)?;
    let buffers = buffers::load(files, path, &parsed.document, blob).map_err(problem)?;
    let digests: Vec<Digest> = buffers.iter().map(|buffer| Digest::of(buffer)).collect();
    let mut document = Document {
        path: shown,
        gltf: parsed.document,
        buffers: Arc::new(buffers),
        warnings: Vec::new(),
    };

    progress.begin("Reading pictures", 0.3)?;
    let (materials, textures) = materials::load(&mut document, files, reuse, path, progress)?;

    let made_of = (&document.path, digest, digests);
    let geometry = reuse.try_get("geometry of a gltf", &made_of, || {
        geometry(&document, reuse, progress)
    })?;
    let (meshes, nodes, warnings) = &*geometry.0;
    meshes.touch(reuse);
    for warning in warnings {
        add(&mut document.warnings, warning.clone());
    }
    progress.report(1.0)?;
    Ok(GltfScene {
        model: Model {
            bounds: bounds(meshes),
            meshes: meshes.list.clone(),
            materials,
            textures,
            made_uvs: false,
            warnings: document.warnings,
        },
        nodes: nodes.clone(),
    })
}

/// Meshes and nodes, with warnings of their own: they must come again when pictures change and these
/// do not.
fn geometry(
    document: &Document,
    reuse: &Reuse,
    progress: &Progress,
) -> Result<Geometry, ModelError> {
    let mut document = Document {
        path: document.path.clone(),
        gltf: Arc::clone(&document.gltf),
        buffers: Arc::clone(&document.buffers),
        warnings: Vec::new(),
    };
    progress.begin("Building meshes", 0.7)?;
    let (meshes, ranges) = meshes::load(&mut document, progress)?;

    progress.begin("Building nodes", 0.9)?;
    let mut nodes = nodes::load(&mut document, &ranges)?;
    animation::load(&mut document, &mut nodes)?;
    Ok(Geometry(Arc::new((
        ModelMeshes::share(reuse, meshes),
        nodes.into_iter().map(|(_, node)| node).collect(),
        document.warnings,
    ))))
}

/// The text and the binary part of a file.
fn parts(bytes: Vec<u8>) -> Result<(Vec<u8>, Option<Vec<u8>>), String> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let glb = ::gltf::binary::Glb::from_slice(&bytes).map_err(|error| error.to_string())?;
    Ok((glb.json.into_owned(), glb.bin.map(Cow::into_owned)))
}

/// Understands the text of a file, whose numbers of items must all exist.
fn parse(text: &[u8]) -> Result<Parsed, String> {
    let gltf = ::gltf::Gltf::from_slice_without_validation(text);
    let document = gltf.map_err(|error| error.to_string())?.document;
    // The crate's own check looks up positions before it has checked their number.
    let root = document.as_json();
    for primitive in root.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        for accessor in primitive.attributes.values() {
            if accessor.value() >= root.accessors.len() {
                return Err(format!("there is no accessor {}", accessor.value()));
            }
        }
    }
    let document = ::gltf::Document::from_json(document.into_json());
    Ok(Parsed {
        document: Arc::new(document.map_err(|error| error.to_string())?),
        text_bytes: text.len(),
    })
}

/// Around all meshes as they stand in the file, without their nodes' places.
fn bounds(meshes: &ModelMeshes) -> MeshBounds {
    let corners = meshes.list.iter().flat_map(|(mesh, _)| {
        let bounds = mesh.bounds();
        let (center, half) = (bounds.center, bounds.half_extents);
        [center - half, center + half]
    });
    let positions: Vec<Vec3> = corners.collect();
    let whole = crate::Mesh {
        positions,
        ..crate::Mesh::default()
    };
    whole.bounds()
}
