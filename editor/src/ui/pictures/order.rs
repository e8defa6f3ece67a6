//! What is to be drawn, and how.

use lightbench::assets::{Assets, Material, MaterialId, Mesh, MeshId, Shared, Texture, TextureId};
use lightbench::script::Settings;

/// What a picture shows.
#[derive(Clone)]
pub enum Subject {
    /// A ball of a material, with its textures.
    Material {
        /// The material.
        material: Box<Material>,
        /// The texture of its colours.
        color: Option<Shared<Texture>>,
        /// The texture of its bumps.
        normals: Option<Shared<Texture>>,
    },
    /// A mesh.
    Mesh(Shared<Mesh>),
    /// A texture as it is.
    Texture(Shared<Texture>),
    /// A picture of the project.
    PictureFile(String),
    /// A model of the project.
    ModelFile(String),
}

/// A pipeline with the values of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Through {
    /// The pipeline's name.
    pub pipeline: String,
    /// What is set.
    pub settings: Settings,
}

impl Through {
    /// How small pictures are drawn: every material looks as it should.
    pub fn plain() -> Self {
        Self {
            pipeline: "forward_single_pass".to_owned(),
            settings: Settings::new(),
        }
    }
}

/// A picture that is wanted.
#[derive(Clone)]
pub struct Order {
    /// What it shows.
    pub subject: Subject,
    /// How it is drawn.
    pub through: Through,
    /// Pixels of each side.
    pub side: u32,
}

impl Subject {
    /// A material of a scene.
    pub fn material(assets: &Assets, id: MaterialId) -> Option<Self> {
        let material = assets.material(id)?.clone();
        let texture = |id: Option<TextureId>| {
            let entry = assets.textures().get(id?.0 as usize)?;
            Some(entry.clone())
        };
        Some(Self::Material {
            color: texture(material.base_color_texture),
            normals: texture(material.normal_texture),
            material: Box::new(material),
        })
    }

    /// A mesh of a scene.
    pub fn mesh(assets: &Assets, id: MeshId) -> Option<Self> {
        let entry = assets.meshes().get(id.0 as usize)?;
        Some(Self::Mesh(entry.clone()))
    }

    /// A texture of a scene.
    pub fn texture(assets: &Assets, id: TextureId) -> Option<Self> {
        let entry = assets.textures().get(id.0 as usize)?;
        Some(Self::Texture(entry.clone()))
    }

    /// The same text for the same picture. Revisions are those of equal values, also after a load.
    fn key(&self) -> String {
        let revision = |texture: &Option<Shared<Texture>>| texture.as_ref().map(|t| t.revision);
        match self {
            Self::Material {
                material,
                color,
                normals,
            } => {
                // The name and the places in the table are not seen.
                let seen = Material {
                    name: String::new(),
                    base_color_texture: None,
                    normal_texture: None,
                    ..(**material).clone()
                };
                format!("{seen:?} {:?} {:?}", revision(color), revision(normals))
            }
            Self::Mesh(mesh) => format!("mesh {}", mesh.revision),
            Self::Texture(texture) => format!("texture {}", texture.revision),
            Self::PictureFile(path) => format!("picture {path}"),
            Self::ModelFile(path) => format!("model {path}"),
        }
    }
}

impl Order {
    /// The same text for the same picture, as long as no file has changed.
    pub(super) fn key(&self, version: u64) -> String {
        let subject = self.subject.key();
        let side = self.side;
        match self.subject {
            Subject::Texture(_) => format!("{side} {subject}"),
            Subject::PictureFile(_) => format!("{side} {version} {subject}"),
            _ => format!("{side} {version} {:?} {subject}", self.through),
        }
    }
}
