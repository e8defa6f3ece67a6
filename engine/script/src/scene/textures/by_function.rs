//! Textures whose colours and heights a function of the script gives, pixel by pixel.

use std::fmt;
use std::sync::Arc;

use lightbench_assets::procedural_texture::{self, Surface};
use lightbench_assets::{Digest, Shared};
use lightbench_world::glam::{Vec2, Vec3};
use rhai::{Dynamic, EvalAltResult, FnPtr};

use super::{Kind, Painted, Pattern};
use crate::api::{Api, Arguments, Mistake, as_number};
use crate::color::Color;

/// The most pixels a side: a script is called for each of them.
const MOST_PIXELS: i64 = 2048;

/// What a function said of each pixel, rows from the top.
#[derive(Clone)]
pub(super) struct Canvas {
    size: u32,
    colors: Arc<Vec<Vec3>>,
    heights: Option<Arc<Vec<f32>>>,
}

/// A picture is known by its content: the same one of an earlier load is found again.
impl fmt::Debug for Canvas {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let colors = self.colors.iter().flat_map(|color| color.to_array());
        let heights = self.heights.iter().flat_map(|heights| heights.iter());
        let numbers = colors.chain(heights.copied());
        let bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
        let rough = self.heights.is_some();
        write!(f, "{} {rough} {:?}", self.size, Digest::of(&bytes))
    }
}

impl Canvas {
    pub(super) fn paint(&self) -> Painted {
        let index = |at: Vec2| {
            let pixel = (at * self.size as f32).as_uvec2();
            (pixel.y * self.size + pixel.x) as usize
        };
        let color = |at: Vec2| self.colors[index(at)];
        let base_color = procedural_texture::paint("painted", self.size, color);
        let Some(heights) = &self.heights else {
            return Painted::Color(Shared::shared(base_color));
        };
        let height = |at: Vec2| heights[index(at)];
        let normal = procedural_texture::normal_map("painted", self.size, height);
        Surface { base_color, normal }.into()
    }
}

pub(super) fn register(api: &mut Api) {
    api.calling_function(
        "painted_texture(pixels, color)",
        "A texture that a function paints: `color` is called for each of `pixels` × `pixels` pixels with \
         its place, u to the right and v down, from 0 to 1, and gives the colour there.",
        |a| {
            let size = a.whole(0, 1, MOST_PIXELS)? as u32;
            let colors = ask(a, 1, size, |a, value| match value.read_lock::<Color>() {
                Some(color) if color.0.is_finite() && color.0.min_element() >= 0.0 => {
                    Ok(color.0.as_vec3())
                }
                Some(_) => Err(Mistake::new("a colour's channels are from 0 up")),
                None => Err(Mistake::new(format!(
                    "the function must give a colour, not {}",
                    a.describe(value)
                ))
                .with_hint("a colour is written `rgb(0.8, 0.2, 0.1)`")),
            })?;
            let canvas = Canvas {
                size,
                colors: Arc::new(colors),
                heights: None,
            };
            Ok(Pattern::new(a, Kind::ByFunction(canvas)))
        },
    );
    api.calling_method(
        "heights(height)",
        "Gives a painted texture normals: `height` is called as its colours' function was, and gives how \
         high the surface is there, as a share of the texture's side.",
        |pattern: Pattern, a| {
            // The function may use the texture, so it must not be locked meanwhile.
            let size = match &pattern.lock().kind {
                Kind::ByFunction(canvas) => canvas.size,
                other => {
                    let message = format!("the texture `{}` has its own heights", other.name());
                    return Err(Mistake::new(message).into());
                }
            };
            let heights = ask(a, 0, size, |a, value| match as_number(value) {
                Some(height) if height.is_finite() => Ok(height as f32),
                _ => Err(Mistake::new(format!(
                    "the function must give a number, not {}",
                    a.describe(value)
                ))),
            })?;
            let mut plan = pattern.lock();
            if let Kind::ByFunction(canvas) = &mut plan.kind {
                canvas.heights = Some(Arc::new(heights));
            }
            (plan.color, plan.normal) = (None, None);
            drop(plan);
            Ok(pattern)
        },
    );
}

/// What the function at `index` gives for each pixel's middle.
fn ask<T>(
    a: &Arguments,
    index: usize,
    size: u32,
    take: impl Fn(&Arguments, &Dynamic) -> Result<T, Mistake>,
) -> Result<Vec<T>, Box<EvalAltResult>> {
    let Some(function) = a.value(index).read_lock::<FnPtr>() else {
        let wanted = "a function of u and v, as in `|u, v| …`";
        return Err(a.wrong(index, wanted).into());
    };
    let function = function.clone();
    let mut values = Vec::with_capacity(size as usize * size as usize);
    for row in 0..size {
        for column in 0..size {
            let place = [column, row].map(|at| (f64::from(at) + 0.5) / f64::from(size));
            let value: Dynamic = function.call_within_context(a.context, (place[0], place[1]))?;
            values.push(take(a, &value)?);
        }
    }
    Ok(values)
}
