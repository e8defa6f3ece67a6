//! Random changes of materials, meshes and textures.

use lightbench::assets::Reflection;
use lightbench::script::overlays::{
    AssetEdit, AssetId, Listed, Picture, SurfaceField, SurfaceValue, Who,
};
use lightbench::world::Transform;
use lightbench::world::glam::Vec3;

use super::{Desk, MOST};

/// A model of one triangle.
pub const MODEL: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Calls that make meshes. The first is one that the scene has.
const MESHES: [&str; 4] = ["box(2)", "cone(1, 2)", "torus(1, 0.25)", "box(1)"];

/// Calls that make textures. The first is one that the scene has.
const TEXTURES: [&str; 4] = [
    "tiles_texture()",
    "checker_texture(2)",
    "checker_texture(4)",
    "checker_texture(8)",
];

impl Desk {
    fn listed(&mut self, fits: impl Fn(&Listed) -> bool) -> Option<Who> {
        let scene = self.workbench.scenes.scene().unwrap();
        let listing = scene.listed();
        let all: Vec<&Listed> = listing.all().iter().filter(|one| fits(one)).collect();
        let place = self.random.below(all.len());
        all.get(place).map(|one| one.who.clone())
    }

    fn material(&mut self) -> Option<Who> {
        self.listed(|one| matches!(one.id, AssetId::Material(_)))
    }

    fn materials(&mut self) -> Vec<Who> {
        let count = 1 + self.random.below(3);
        let mut all: Vec<Who> = (0..count).filter_map(|_| self.material()).collect();
        all.dedup();
        all
    }

    fn one_of(&mut self, calls: [&str; 4]) -> String {
        calls[self.random.below(calls.len())].to_owned()
    }

    /// Changes something of the assets.
    pub(super) fn change_assets(&mut self) -> Result<(), String> {
        let none = || "there is none".to_owned();
        let edit = match self.random.below(20) {
            0..2 => AssetEdit::NewMaterial {
                name: String::new(),
                like: match self.random.below(3) {
                    0 => None,
                    _ => self.material(),
                },
            },
            2 => AssetEdit::RenameMaterial {
                of: self.material().ok_or_else(none)?,
                name: format!("material {}", self.random.below(30)),
            },
            3 => AssetEdit::DeleteMaterial {
                of: self.materials(),
            },
            4..9 => return self.paint(),
            9..12 => {
                self.choose();
                let material = match self.random.below(5) {
                    0 => None,
                    _ => Some(self.material().ok_or_else(none)?),
                };
                return self.workbench.dress_chosen(material);
            }
            12..14 => {
                self.choose();
                let mesh = match self.random.below(5) {
                    0 => None,
                    _ => Some(
                        self.listed(|one| matches!(one.id, AssetId::Mesh(_)))
                            .ok_or_else(none)?,
                    ),
                };
                return self.workbench.reshape_chosen(mesh);
            }
            14 => AssetEdit::NewMesh {
                recipe: self.one_of(MESHES),
            },
            15 => AssetEdit::DeleteMesh {
                of: self
                    .listed(|one| matches!(one.id, AssetId::Mesh(_)) && one.is_kept)
                    .ok_or_else(none)?,
            },
            16 => AssetEdit::NewTexture {
                recipe: self.one_of(TEXTURES),
            },
            17 => AssetEdit::DeleteTexture {
                of: self
                    .listed(|one| matches!(one.id, AssetId::Texture(_)) && one.is_kept)
                    .ok_or_else(none)?,
            },
            _ if self.entities().len() < MOST => AssetEdit::AddModel {
                path: "leaf.obj".to_owned(),
                name: String::new(),
                number: 0,
                place: Transform::from_translation(Vec3::splat(self.random.number(-3.0, 3.0))),
            },
            _ => return Err(none()),
        };
        self.workbench.change_assets(edit)
    }

    fn paint(&mut self) -> Result<(), String> {
        let of = self.materials();
        let field = SurfaceField::ALL[self.random.below(SurfaceField::ALL.len())];
        let share = self.random.number(0.0, 1.0);
        let color = Vec3::from_array([0; 3].map(|_| self.random.number(0.0, 1.0)));
        let value = match field {
            SurfaceField::Color | SurfaceField::Specular | SurfaceField::Emissive => {
                SurfaceValue::Color(color)
            }
            SurfaceField::Texture | SurfaceField::Normals => {
                SurfaceValue::Picture(match self.random.below(3) {
                    0 => Picture::None,
                    // A chequered floor has no normals, and is refused as such.
                    _ => Picture::Made(self.one_of(TEXTURES)),
                })
            }
            SurfaceField::Reflection => SurfaceValue::Reflection(match self.random.below(3) {
                0 => Reflection::Phong {
                    power: 1.0 + share * 90.0,
                },
                1 => Reflection::Ggx {
                    roughness: 0.1 + share * 0.9,
                },
                _ => Reflection::Ward {
                    along: 0.1 + share * 0.9,
                    across: 0.5,
                },
            }),
            SurfaceField::Opacity => SurfaceValue::Share(share),
            SurfaceField::Cutoff => SurfaceValue::Cutoff((share > 0.3).then_some(share)),
            SurfaceField::TwoSided => SurfaceValue::Switch(share > 0.5),
        };
        let goes_back = self.random.below(5) == 0;
        let each = |who: Who| (who, (!goes_back).then(|| value.clone()));
        let result = self
            .workbench
            .paint(field, of.into_iter().map(each).collect());
        // Some go on, as while a slider is dragged.
        if self.random.below(3) > 0 {
            self.workbench.undo.seal();
        }
        result
    }
}
