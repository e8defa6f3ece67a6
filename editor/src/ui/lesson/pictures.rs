//! The pictures of lessons as textures: figures, formulas, and what checks drew.

use std::collections::HashMap;
use std::path::Path;
use std::time::SystemTime;

use egui::{ColorImage, Context, TextureHandle, TextureOptions, Vec2};
use lightbench::lab::lesson::{FORMULAS, Lesson, formula_without_paper};
use lightbench::lab::{LdrImage, Picture, svg};

use crate::ui::messages::say;

/// Pixels for a unit of a drawing, so that it stays sharp on screens with small pixels.
const SHARPNESS: f32 = 3.0;

/// A picture with its size in points.
#[derive(Clone)]
pub struct Shown {
    /// The pixels.
    pub texture: TextureHandle,
    /// Points.
    pub size: Vec2,
    /// Whether it has one colour, which the text around it gives.
    pub is_formula: bool,
}

/// A picture, or why there is none, with the time at which its file was written.
type Kept = (Option<SystemTime>, Result<Shown, String>);

/// Pictures that were shown.
#[derive(Default)]
pub struct Pictures {
    known: HashMap<String, Kept>,
}

impl Pictures {
    /// Forgets all: files may be others.
    pub fn forget(&mut self) {
        self.known.clear();
    }

    /// A picture of a lesson, by its path there.
    pub fn of_lesson(
        &mut self,
        ctx: &Context,
        lesson: &Lesson,
        path: &str,
    ) -> Result<Shown, String> {
        let key = lesson.source.shown(path);
        let (_, shown) = self.known.entry(key.clone()).or_insert_with(|| {
            let bytes = lesson.source.read(path).map_err(|error| error.to_string());
            let shown = bytes.and_then(|bytes| {
                let is_formula = path.starts_with(FORMULAS);
                decode(path, &bytes, is_formula).map(|(image, scale)| Shown {
                    size: egui::vec2(image.width as f32, image.height as f32) / scale,
                    texture: load(ctx, &key, &image),
                    is_formula,
                })
            });
            (None, shown)
        });
        shown.clone()
    }

    /// A picture file, read again where it was written anew.
    pub fn of_file(&mut self, ctx: &Context, file: &Path) -> Result<Shown, String> {
        let written = std::fs::metadata(file)
            .and_then(|about| about.modified())
            .ok();
        let key = file.to_string_lossy().into_owned();
        if let Some((at, shown)) = self.known.get(&key)
            && *at == written
        {
            return shown.clone();
        }
        let shown = Picture::open(file)
            .map_err(|error| error.to_string())
            .and_then(eight_bits)
            .map(|image| Shown {
                size: egui::vec2(image.width as f32, image.height as f32),
                texture: load(ctx, &key, &image),
                is_formula: false,
            });
        self.known.insert(key, (written, shown.clone()));
        shown
    }
}

/// The pixels of a file, and how many of them there are for a point.
fn decode(path: &str, bytes: &[u8], is_formula: bool) -> Result<(LdrImage, f32), String> {
    if !path.ends_with(".svg") {
        let picture = Picture::read(Path::new(path), bytes).map_err(|error| error.to_string())?;
        return Ok((eight_bits(picture)?, 1.0));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| format!("{path}: {error}"))?;
    // White is what takes any tint.
    let text = match is_formula {
        true => formula_without_paper(text, "#ffffff"),
        false => text.to_owned(),
    };
    let image = svg::draw(&text, SHARPNESS).map_err(|error| format!("{path}: {error}"))?;
    Ok((image, SHARPNESS))
}

fn eight_bits(picture: Picture) -> Result<LdrImage, String> {
    match picture {
        Picture::Ldr(image) => Ok(image),
        Picture::Hdr(_) => Err(say!("lesson.eight_bits").to_owned()),
    }
}

fn load(ctx: &Context, name: &str, image: &LdrImage) -> TextureHandle {
    let size = [image.width as usize, image.height as usize];
    let image = ColorImage::from_rgba_unmultiplied(size, image.pixels.as_flattened());
    ctx.load_texture(name, image, TextureOptions::LINEAR)
}
