//! Models from OBJ files with their MTL materials.
//!
//! What is carried: positions, texture coordinates, normals, faces of any
//! number of corners, negative (relative) indices, and of a material
//!
//! | in the file | becomes |
//! | --- | --- |
//! | `Kd` | base colour, taken as linear |
//! | `Ks` | specular: its colour where `Kd` is black, as that of metals; else its luminance, but at most 0.08, for only metals reflect more; many files were written for models without units, and say 0.5 or 1 |
//! | `Ns` | Blinn-Phong exponent, clamped to 1..1448 |
//! | `Pr`, `Pm` | roughness and share of metal, as glTF has them: the GGX model; then `Ks` and `Ns` do not count |
//! | `Ke` | emissive |
//! | `map_Kd` | base colour texture, sRGB |
//! | `norm`, `map_Bump`, `bump` | normal texture; a grey picture is a height map, made into normals with the strength `-bm` |
//! | `map_d` | a mask: alpha of the base colour texture, cut at 0.5, seen from both sides |
//!
//! What is not carried: transparency without a mask (`d`, `Tr`, `Tf`), ambient
//! and reflection parameters (`Ka`, `Ni`, `illum`, `refl`), the maps `map_Ka`,
//! `map_Ks`, `map_Ns` and `map_Ke`, texture options other than `-bm`, vertex
//! colours, smoothing groups, lines, points, curves, and the names of objects
//! and groups: the model comes as one mesh per material.
//!
//! Missing normals are smoothed up to a crease angle. Missing texture
//! coordinates are a projection along the nearest axis, on which the picture
//! covers the model's longest side once.

mod build;
mod clean;
mod materials;
mod mtl;
mod normals;
mod textures;
mod triangulate;

use std::sync::Arc;

use lightbench_world::{MaterialId, MeshBounds, MeshId};
use thiserror::Error;

use crate::cache::{Kept, Reuse};
use crate::files::{FileError, Files, with_plain_line_ends};
use crate::{Assets, Cancelled, Digest, Material, Mesh, Progress, Shared, Texture, TextureId};

/// How a model is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Faces that meet at more than this angle (radians) keep an edge where
    /// the file has no normals. 60 degrees unless told.
    pub crease_angle: f32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            crease_angle: 60_f32.to_radians(),
        }
    }
}

/// Something that is wrong in a file, and the way out.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub struct Problem {
    /// The file, as the user knows it.
    pub path: String,
    /// From 1, where there is one.
    pub line: Option<usize>,
    /// What is wrong.
    pub message: String,
}

impl std::fmt::Display for Problem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}, line {line}: {}", self.path, self.message),
            None => write!(f, "{}: {}", self.path, self.message),
        }
    }
}

/// A problem that was passed over.
pub type Warning = Problem;

/// Why there is no model.
#[derive(Debug, Error)]
pub enum ModelError {
    /// The file itself.
    #[error(transparent)]
    File(#[from] FileError),
    /// What is in it.
    #[error(transparent)]
    Content(#[from] Problem),
    /// The user stopped it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A model that was read, not yet part of a scene.
///
/// Its ids are its own: [`MaterialId`]`(0)` and [`TextureId::PLACEHOLDER`] are
/// the stand-ins, as in [`Assets`]; material n is `materials[n - 1]`, and
/// texture n is `textures[n - 1]`.
#[derive(Clone, Debug)]
pub struct Model {
    /// One mesh for each material.
    pub meshes: Vec<(Shared<Mesh>, MaterialId)>,
    /// The materials that are used.
    pub materials: Vec<Material>,
    /// The pictures that are used.
    pub textures: Vec<Shared<Texture>>,
    /// Around all meshes.
    pub bounds: MeshBounds,
    /// Whether some texture coordinates were missing and had to be made.
    pub made_uvs: bool,
    /// What was passed over, one line for each cause.
    pub warnings: Vec<Warning>,
}

impl Model {
    /// Adds everything to a scene. Returns what to draw.
    pub fn add_to(self, assets: &mut Assets) -> Vec<(MeshId, MaterialId)> {
        let mut textures = vec![TextureId::PLACEHOLDER];
        textures.extend(
            self.textures
                .into_iter()
                .map(|texture| assets.add_shared_texture(texture)),
        );
        let texture_id = |id: TextureId| textures[id.0 as usize];
        let mut materials = vec![MaterialId(0)];
        for mut material in self.materials {
            material.base_color_texture = material.base_color_texture.map(texture_id);
            material.normal_texture = material.normal_texture.map(texture_id);
            materials.push(assets.add_material(material));
        }
        let meshes = self.meshes.into_iter();
        meshes
            .map(|(mesh, material)| (assets.add_shared_mesh(mesh), materials[material.0 as usize]))
            .collect()
    }

    /// Number of triangles of all meshes.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.meshes
            .iter()
            .map(|(mesh, _)| mesh.triangle_count())
            .sum()
    }
}

/// An OBJ file as it was read, before anything is known of its materials.
struct Parsed {
    /// What the file names. The text itself is not kept.
    clean: clean::Clean,
    soup: build::Soup,
    warnings: Vec<Warning>,
}

impl Kept for Arc<Parsed> {
    fn bytes(&self) -> usize {
        self.soup.byte_count()
    }
}

/// Reads a model with its materials and pictures. What an earlier load has made
/// of the same bytes is taken from there: of the OBJ file, of each material
/// library and of each picture.
///
/// # Errors
/// A file that can't be read, that is no OBJ, or that contradicts itself: with
/// its path, the line where there is one, and the way out. What can be passed
/// over becomes a warning of the model.
pub fn load(
    files: &Files,
    reuse: &Reuse,
    path: &str,
    options: &Options,
    progress: &Progress,
) -> Result<Model, ModelError> {
    let shown = files.display(path);
    progress.begin(format!("Reading {shown}"), 0.0)?;
    let bytes = files.read(path)?;
    let content = (&shown, Digest::of(&bytes));
    let parsed = reuse.try_get("obj", &content, || {
        progress.begin(format!("Checking {shown}"), 0.1)?;
        parse(&shown, bytes).map(Arc::new)
    })?;
    let mut warnings = Warnings {
        path: shown.clone(),
        list: parsed.warnings.clone(),
    };

    progress.begin("Reading materials", 0.4)?;
    let clean = &parsed.clean;
    let library = mtl::load_libraries(files, reuse, path, &clean.libraries, &mut warnings);
    let mut materials = materials::Materials::new(files, &library, clean, &mut warnings);

    progress.begin("Reading pictures", 0.5)?;
    let textures = textures::load(files, reuse, &mut materials, &mut warnings, &|share| {
        progress.report(0.5 + 0.2 * share)
    })?;

    progress.begin("Building meshes", 0.7)?;
    let name = path.rsplit('/').next().unwrap_or(path);
    let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    // What the meshes take from the materials, beside the file itself.
    let names = materials.materials.iter().map(|material| &material.name);
    let names: Vec<&String> = names.collect();
    let made_of = (&content, name, options, &materials.numbers, names);
    let built = reuse.get("meshes of an obj", &made_of, || {
        let crease = options.crease_angle;
        parsed.soup.build(reuse, name, crease, &materials)
    });
    built.meshes.touch(reuse);
    progress.report(1.0)?;
    Ok(Model {
        meshes: built.meshes.list,
        materials: materials.materials,
        textures,
        bounds: built.bounds,
        made_uvs: built.made_uvs,
        warnings: warnings.list,
    })
}

fn parse(shown: &str, bytes: Vec<u8>) -> Result<Parsed, ModelError> {
    let text = text_of(shown, bytes)?;
    let mut warnings = Warnings::new(shown);
    let mut clean = clean::clean(shown, &text, &mut warnings)?;
    drop(text);
    let soup = build::parse(shown, &clean)?;
    clean.text = String::new();
    Ok(Parsed {
        clean,
        soup,
        warnings: warnings.list,
    })
}

/// The text of an OBJ or MTL file. Old ones that are not UTF-8 are taken as
/// Latin-1, in which every byte is a letter.
fn text_of(shown: &str, bytes: Vec<u8>) -> Result<String, Problem> {
    let problem = |message: &str| Problem {
        path: shown.to_owned(),
        line: None,
        message: message.to_owned(),
    };
    if bytes.is_empty() {
        return Err(problem("the file is empty; save or copy it again"));
    }
    if bytes.contains(&0) {
        return Err(problem(
            "this is a binary file, no OBJ or MTL text; export the model as OBJ",
        ));
    }
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => error.into_bytes().into_iter().map(char::from).collect(),
    };
    let text = match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    };
    Ok(with_plain_line_ends(text))
}

/// Warnings of one model, one for each cause in each file.
struct Warnings {
    path: String,
    list: Vec<Warning>,
}

impl Warnings {
    fn new(path: &str) -> Self {
        Self {
            path: path.to_owned(),
            list: Vec::new(),
        }
    }

    /// Warns of what was found before.
    fn add_all(&mut self, warnings: &[Warning]) {
        for warning in warnings {
            self.add_in(&warning.path, warning.line, &warning.message);
        }
    }

    /// Warns once for each message, at the line where it came first.
    fn add(&mut self, line: usize, message: &str) {
        let path = self.path.clone();
        self.add_in(&path, Some(line), message);
    }

    fn add_in(&mut self, path: &str, line: Option<usize>, message: &str) {
        let known = |warning: &Warning| warning.path == path && warning.message == message;
        if !self.list.iter().any(known) {
            self.list.push(Warning {
                path: path.to_owned(),
                line,
                message: message.to_owned(),
            });
        }
    }
}

#[cfg(test)]
mod tests;
