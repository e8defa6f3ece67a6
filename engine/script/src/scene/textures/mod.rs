//! Painted textures, and pictures from files.

mod by_function;
mod setters;
#[cfg(test)]
mod tests;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::cache::Kept;
use lightbench_assets::images::{Purpose, shared_texture};
use lightbench_assets::procedural_texture::{
    self, Brick, Marble, Plaster, Stone, Surface, Tiles, Weave,
};
use lightbench_assets::{Shared, Texture, TextureId};
use lightbench_world::glam::Vec3;

use super::data::{Data, Stage};
use super::models;
use crate::api::{Api, Arguments, Mistake, ScriptType};
use by_function::Canvas;

/// How a texture is made.
#[derive(Clone, Debug)]
enum Kind {
    Stone(Stone),
    Marble(Marble),
    Plaster(Plaster),
    Brick(Brick),
    Tiles(Tiles),
    Weave(Weave),
    Checker {
        size: u32,
        squares: u32,
        colors: [Vec3; 2],
    },
    Picture {
        path: String,
    },
    /// The picture of this number in a model.
    OfModel {
        path: String,
        number: usize,
    },
    /// Painted by a function of the script.
    ByFunction(Canvas),
}

impl Kind {
    fn name(&self) -> &'static str {
        match self {
            Self::Stone(_) => "stone",
            Self::Marble(_) => "marble",
            Self::Plaster(_) => "plaster",
            Self::Brick(_) => "brick",
            Self::Tiles(_) => "tiles",
            Self::Weave(_) => "weave",
            Self::Checker { .. } => "checker",
            Self::Picture { .. } => "picture",
            Self::OfModel { .. } => "model_texture",
            Self::ByFunction(_) => "painted",
        }
    }
}

/// The pictures of a texture.
#[derive(Clone)]
enum Painted {
    Color(Shared<Texture>),
    Normal(Shared<Texture>),
    Surface {
        color: Shared<Texture>,
        normal: Shared<Texture>,
    },
    /// Colours or normals, whichever it is taken for.
    Either(Shared<Texture>),
}

impl From<Texture> for Painted {
    fn from(color: Texture) -> Self {
        Self::Color(Shared::shared(color))
    }
}

impl From<Surface> for Painted {
    fn from(surface: Surface) -> Self {
        Self::Surface {
            color: Shared::shared(surface.base_color),
            normal: Shared::shared(surface.normal),
        }
    }
}

impl Kept for Painted {
    fn bytes(&self) -> usize {
        match self {
            Self::Color(one) | Self::Normal(one) | Self::Either(one) => one.bytes(),
            Self::Surface { color, normal } => color.bytes() + normal.bytes(),
        }
    }
}

/// A texture, as scripts hold it: numbers first, pixels as soon as a material uses it.
#[derive(Clone, Debug)]
pub(super) struct Pattern(Arc<Mutex<Plan>>);

#[derive(Debug)]
struct Plan {
    kind: Kind,
    color: Option<TextureId>,
    normal: Option<TextureId>,
    /// The calls that made it, for files.
    recipe: Option<String>,
}

impl ScriptType for Pattern {
    const NAME: &'static str = "texture";
}

impl Pattern {
    /// A texture that a call makes.
    fn new(call: &Arguments, kind: Kind) -> Self {
        Self(Arc::new(Mutex::new(Plan {
            kind,
            color: None,
            normal: None,
            recipe: call.spelled(),
        })))
    }

    fn lock(&self) -> MutexGuard<'_, Plan> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether nothing is drawn with it by now.
    pub(super) fn is_unpainted(&self) -> bool {
        let plan = self.lock();
        plan.color.is_none() && plan.normal.is_none()
    }

    /// The calls that made it.
    pub(super) fn recipe(&self) -> Option<String> {
        self.lock().recipe.clone()
    }

    /// The texture of colours.
    pub(super) fn color(&self, data: &mut Data) -> Result<TextureId, Mistake> {
        let mut plan = self.lock();
        if plan.color.is_none() {
            plan.paint(data, Purpose::Color)?;
            plan.note(data);
        }
        plan.color
            .ok_or_else(|| Mistake::new("the texture has no colours"))
    }

    /// The normal map that belongs to the colours, or the picture taken as one.
    pub(super) fn normal(&self, data: &mut Data) -> Result<TextureId, Mistake> {
        let mut plan = self.lock();
        if plan.normal.is_none() {
            plan.paint(data, Purpose::Data)?;
            plan.note(data);
        }
        plan.normal.ok_or_else(|| {
            Mistake::new(format!(
                "the texture `{}` is smooth and has no normals",
                plan.kind.name()
            ))
        })
    }

    /// The normal map, if the texture comes with one.
    pub(super) fn own_normal(&self, data: &mut Data) -> Result<Option<TextureId>, Mistake> {
        self.color(data)?;
        Ok(self.lock().normal)
    }
}

impl Plan {
    /// Notes how the pictures were made.
    fn note(&self, data: &mut Data) {
        if let Some(recipe) = &self.recipe {
            for id in [self.color, self.normal].into_iter().flatten() {
                data.recipes.textures.insert(id, recipe.clone());
            }
            if let Some(normal) = self.normal.filter(|normal| self.color != Some(*normal)) {
                data.recipes.normals.insert(normal);
            }
        }
    }

    fn paint(&mut self, data: &mut Data, purpose: Purpose) -> Result<(), Mistake> {
        if data
            .progress
            .begin(format!("Painting {}", self.kind.name()), 0.0)
            .is_err()
        {
            return Err(Mistake::new("the script was stopped"));
        }
        let watch = Arc::clone(&data.watch);
        let painted = watch.free_of_charge(|| self.kind.paint(data, purpose))?;
        let mut add = |texture| data.assets.add_shared_texture(texture);
        match painted {
            Painted::Color(color) => self.color = Some(add(color)),
            Painted::Normal(normal) => self.normal = Some(add(normal)),
            Painted::Surface { color, normal } => {
                (self.color, self.normal) = (Some(add(color)), Some(add(normal)));
            }
            Painted::Either(texture) => {
                self.color = Some(add(texture));
                self.normal = self.color;
            }
        }
        Ok(())
    }
}

impl Kind {
    /// The pictures, unless an earlier load has made them of the same.
    fn paint(&self, data: &mut Data, purpose: Purpose) -> Result<Painted, Mistake> {
        let reuse = data.reuse.clone();
        let kept = |paint: &dyn Fn() -> Painted| reuse.get("painted texture", self, paint);
        Ok(match self {
            Self::Stone(stone) => kept(&|| stone.paint().into()),
            Self::Plaster(plaster) => kept(&|| plaster.paint().into()),
            Self::Brick(brick) => kept(&|| brick.paint().into()),
            Self::Tiles(tiles) => kept(&|| tiles.paint().into()),
            Self::Weave(weave) => kept(&|| weave.paint().into()),
            Self::Marble(marble) => kept(&|| marble.paint().into()),
            Self::Checker {
                size,
                squares,
                colors,
            } => kept(&|| procedural_texture::checker(*size, *squares, *colors).into()),
            Self::Picture { path } => {
                let picture = read_picture(data, path, purpose)?;
                match purpose {
                    Purpose::Color => Painted::Color(picture),
                    Purpose::Data => Painted::Normal(picture),
                }
            }
            Self::OfModel { path, number } => {
                Painted::Either(models::texture(data, path, *number)?)
            }
            Self::ByFunction(canvas) => kept(&|| canvas.paint()),
        })
    }
}

fn read_picture(data: &Data, path: &str, purpose: Purpose) -> Result<Shared<Texture>, Mistake> {
    let bytes = data
        .files
        .read(path)
        .map_err(|error| Mistake::new(error.to_string()))?;
    shared_texture(&data.reuse, path, &bytes, purpose)
        .map_err(|error| Mistake::new(error.to_string()))
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.object::<Pattern>();
    let mut pattern = |form: &str, about: &'static str, kind: Kind| {
        api.function(form, about, move |a| Ok(Pattern::new(a, kind.clone())));
    };
    pattern(
        "stone_texture()",
        "Cut stone: a fine grain over soft clouds. Two colours.",
        Kind::Stone(Stone::default()),
    );
    pattern(
        "marble_texture()",
        "Polished marble: thin dark veins. Two colours; no normals.",
        Kind::Marble(Marble::default()),
    );
    pattern(
        "plaster_texture()",
        "A plastered wall, a little uneven. One colour.",
        Kind::Plaster(Plaster::default()),
    );
    pattern(
        "brick_texture()",
        "A brick wall. Two colours of bricks and one of mortar.",
        Kind::Brick(Brick::default()),
    );
    pattern(
        "tiles_texture()",
        "A floor of two kinds of tiles. Their two colours and that of the joints.",
        Kind::Tiles(Tiles::default()),
    );
    pattern(
        "weave_texture()",
        "Woven cloth with stripes. Colours of the cloth, its stripes and their borders.",
        Kind::Weave(Weave::default()),
    );
    api.function(
        "checker_texture(squares)",
        "A checkerboard with that many squares along each side. Two colours.",
        |a| {
            let squares = a.whole(0, 2, 512)? as u32;
            let colors = [Vec3::splat(0.7), Vec3::splat(0.1)];
            Ok(Pattern::new(
                a,
                Kind::Checker {
                    size: 512,
                    squares,
                    colors,
                },
            ))
        },
    );
    let asked = stage.clone();
    api.function(
        "picture(path)",
        "A picture of the project: PNG, JPEG, TGA, BMP, HDR or EXR. Reads it when it is used.",
        move |a| {
            let path = a.text(0)?;
            let data = asked.lock();
            data.files
                .origin(&path)
                .map_err(|error| Mistake::new(error.to_string()))?;
            Ok(Pattern::new(a, Kind::Picture { path }))
        },
    );
    api.function(
        "model_texture(path, number)",
        "One of the pictures of a model, as the model uses it, counted from 0.",
        |a| {
            let path = a.text(0)?;
            let number = a.whole(1, 0, i64::from(u32::MAX))? as usize;
            Ok(Pattern::new(a, Kind::OfModel { path, number }))
        },
    );
    by_function::register(api);
    setters::register(api);
}
