//! Scene files: a world as text.
//!
//! ```text
//! lightbench scene 2
//!
//! mesh "vase" = model_mesh("models/vase.obj", 0)
//! material "glaze" = material("glaze").color(0.8, 0.7, 0.6)
//!
//! entity #1
//!   children = [#2]
//!   tags = ["furniture"]
//!   Name
//!     text = "table"
//!
//! entity #2
//!   Transform
//!     translation = (0.0, 0.75, 0.0)
//!     rotation = quat(0.0, 0.0, 0.0, 1.0)
//!     scale = (1.0, 1.0, 1.0)
//!   MeshRenderer
//!     mesh = mesh "vase"
//!     material = material "glaze"
//!     visible = true
//! ```
//!
//! The first line names the format and its version. Lines that begin with `mesh`,
//! `material` or `texture` say how the assets that the entities name are made: what
//! stands behind the `=` belongs to whoever knows assets ([`AssetNames`]), and is a
//! call of the scenes' script language in Lightbench. An entity has a number, which
//! it keeps for ever: a scene that is loaded, changed and saved again differs from
//! its old text only where it was changed. Two spaces deep stand its children in
//! order, its tags, its group and its components in the order of their
//! declaration; four spaces deep the fields of a component. A field that is missing
//! has its default value. A component that this version does not know is kept and
//! written back as it stood.
//!
//! Values: `true`, `12`, `0.5`, `(x, y)`, `(x, y, z)`, `(x, y, z, w)`,
//! `quat(x, y, z, w)`, `"text"`, `#2` or `none` for an entity, `mesh "name"`,
//! `material "name"`, `[a, b]`, `{ "name": a }`. Numbers are written with as many
//! digits as it takes to read back the same bits.
//!
//! Version 1 had no lines for assets; its files are read as they are.

mod read;
mod text;
mod write;

use std::io::Write as _;
use std::path::Path;

use crate::value::{MaterialId, MeshId};
use crate::world::World;

pub use read::read;
pub use write::{number, write};

/// The version that [`write()`] writes and the newest that [`read()`] knows.
pub const VERSION: u32 = 2;

/// What went wrong with a scene file.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The text is not a scene.
    #[error("line {line}: {message}")]
    Text {
        /// The line, counted from 1.
        line: usize,
        /// What was expected and what stands there.
        message: String,
    },
    /// The text of a file is not a scene.
    #[error("{path}, line {line}: {message}")]
    File {
        /// The file.
        path: String,
        /// The line, counted from 1.
        line: usize,
        /// What was expected and what stands there.
        message: String,
    },
    /// The file cannot be read or written.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: String,
        /// What the system says.
        source: std::io::Error,
    },
}

impl SceneError {
    pub(crate) fn at(line: usize, message: impl Into<String>) -> Self {
        Self::Text {
            line,
            message: message.into(),
        }
    }

    fn in_file(self, path: &Path) -> Self {
        match self {
            Self::Text { line, message } => Self::File {
                path: path.display().to_string(),
                line,
                message,
            },
            other => other,
        }
    }
}

/// How one asset is made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// What it is: `mesh`, `material` or `texture`.
    pub kind: &'static str,
    /// Its name, which is the only one of its kind in the file.
    pub name: String,
    /// How it is made, on one line.
    pub recipe: String,
}

/// Knows meshes and materials by name. The world only has their handles.
pub trait AssetNames {
    /// How the assets are made, in the order in which they can be made.
    fn definitions(&self) -> Vec<Definition> {
        Vec::new()
    }
    /// Makes an asset as a file says.
    ///
    /// # Errors
    /// A sentence that says what is wrong with the recipe.
    fn define(&mut self, kind: &str, name: &str, _recipe: &str) -> Result<(), String> {
        Err(format!("the {kind} `{name}` can't be made here"))
    }
    /// The name of a mesh; `None` for a handle that means nothing, which is then
    /// written as a number.
    fn mesh_name(&self, mesh: MeshId) -> Option<String>;
    /// The name of a material; `None` for a handle that means nothing.
    fn material_name(&self, material: MaterialId) -> Option<String>;
    /// The mesh of a name.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    fn mesh(&mut self, name: &str) -> Result<MeshId, String>;
    /// The material of a name.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    fn material(&mut self, name: &str) -> Result<MaterialId, String>;
}

/// Writes a world to a file. The text goes to a file beside it first, which then
/// takes its place, so that a full disk or a power cut leaves the old scene whole.
///
/// # Errors
/// [`SceneError::Io`]
pub fn save(path: &Path, world: &mut World, assets: &dyn AssetNames) -> Result<(), SceneError> {
    let text = write(world, assets);
    let io_error = |source| SceneError::Io {
        path: path.display().to_string(),
        source,
    };
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    let written = (|| {
        let mut file = std::fs::File::create(&temporary)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        drop(file);
        std::fs::rename(&temporary, path)
    })();
    if written.is_err() {
        // Whatever is left of it is of no use; the first error is the one to tell.
        std::fs::remove_file(&temporary).ok();
    }
    written.map_err(io_error)
}

/// Reads a world from a file.
///
/// # Errors
/// [`SceneError::Io`], or [`SceneError::File`] with the line.
pub fn load(path: &Path, assets: &mut dyn AssetNames) -> Result<World, SceneError> {
    let text = std::fs::read_to_string(path).map_err(|source| SceneError::Io {
        path: path.display().to_string(),
        source,
    })?;
    read(&text, assets).map_err(|error| error.in_file(path))
}

#[cfg(test)]
mod tests;
