//! What scripts say of a texture before it is painted: size, colours, and what its kind has.

use lightbench_assets::MAX_TEXTURE_SIZE;
use lightbench_assets::procedural_texture::{Brick, Marble, Plaster, Stone, Tiles, Weave};
use lightbench_world::glam::Vec3;

use super::super::recipes::then;
use super::{Kind, Pattern};
use crate::api::{Api, Arguments, Mistake};

/// Registers a setter of some kinds of texture. `change` says whether the kind has it.
fn setter(
    api: &mut Api,
    form: &'static str,
    about: &'static str,
    change: impl Fn(&mut Kind, &Arguments) -> Result<bool, Mistake> + Send + Sync + 'static,
) {
    let name = form.split('(').next().unwrap_or(form);
    api.method(form, about, move |pattern: Pattern, a| {
        let mut plan = pattern.lock();
        if !change(&mut plan.kind, a)? {
            return Err(Mistake::new(format!(
                "the texture `{}` has no `{name}` with {} values",
                plan.kind.name(),
                a.len()
            )));
        }
        (plan.color, plan.normal) = (None, None);
        plan.recipe = then(plan.recipe.take(), a);
        drop(plan);
        Ok(pattern)
    });
}

/// Registers what a script can say of a texture before it is painted.
pub(super) fn register(api: &mut Api) {
    setter(
        api,
        "size(pixels)",
        "Pixels a side; 512 unless told. Powers of two are best.",
        |kind, a| {
            let pixels = a.whole(0, 1, i64::from(MAX_TEXTURE_SIZE.min(4096)))? as u32;
            match kind {
                Kind::Stone(Stone { size, .. })
                | Kind::Marble(Marble { size, .. })
                | Kind::Plaster(Plaster { size, .. })
                | Kind::Brick(Brick { size, .. })
                | Kind::Tiles(Tiles { size, .. })
                | Kind::Weave(Weave { size, .. })
                | Kind::Checker { size, .. } => *size = pixels,
                Kind::Picture { .. } | Kind::OfModel { .. } | Kind::ByFunction(_) => {
                    return Ok(false);
                }
            }
            Ok(true)
        },
    );
    setter(
        api,
        "seed(number)",
        "Another piece of the same kind.",
        |kind, a| {
            let number = a.whole(0, 0, i64::from(u32::MAX))? as u32;
            match kind {
                Kind::Stone(Stone { seed, .. })
                | Kind::Marble(Marble { seed, .. })
                | Kind::Plaster(Plaster { seed, .. })
                | Kind::Brick(Brick { seed, .. })
                | Kind::Tiles(Tiles { seed, .. })
                | Kind::Weave(Weave { seed, .. }) => *seed = number,
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    colors(api);
    setter(
        api,
        "pieces(across)",
        "Tiles along a side, made even.",
        |kind, a| {
            let across = a.whole(0, 1, 1024)? as u32;
            let Kind::Tiles(tiles) = kind else {
                return Ok(false);
            };
            tiles.count = across;
            Ok(true)
        },
    );
    setter(
        api,
        "pieces(across, up)",
        "Bricks along a side and courses up.",
        |kind, a| {
            let (across, up) = (a.whole(0, 1, 1024)? as u32, a.whole(1, 1, 1024)? as u32);
            let Kind::Brick(brick) = kind else {
                return Ok(false);
            };
            (brick.columns, brick.courses) = (across, up);
            Ok(true)
        },
    );
    setter(
        api,
        "joint(share)",
        "Width of the joints as a share of a tile, or of a course of bricks, 0 to 0.9.",
        |kind, a| {
            let share = a.number_in(0, 0.0, 0.9)? as f32;
            match kind {
                Kind::Brick(brick) => brick.joint = share,
                Kind::Tiles(tiles) => tiles.joint = share,
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "depth(share)",
        "How deep joints or threads are, as a share of the picture's side.",
        |kind, a| {
            let share = a.number_in(0, 0.0, 1.0)? as f32;
            match kind {
                Kind::Stone(Stone {
                    roughness: depth, ..
                })
                | Kind::Plaster(Plaster {
                    roughness: depth, ..
                })
                | Kind::Brick(Brick { depth, .. })
                | Kind::Tiles(Tiles { depth, .. })
                | Kind::Weave(Weave { depth, .. }) => *depth = share,
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "clouds(count)",
        "Clouds of colour along a side of stone.",
        |kind, a| {
            let count = a.whole(0, 1, 256)? as u32;
            let Kind::Stone(stone) = kind else {
                return Ok(false);
            };
            stone.scale = count;
            Ok(true)
        },
    );
    setter(
        api,
        "bands(right, down)",
        "Bands of marble to the right and down.",
        |kind, a| {
            let bands = [a.whole(0, 0, 256)? as u32, a.whole(1, 0, 256)? as u32];
            let Kind::Marble(marble) = kind else {
                return Ok(false);
            };
            marble.bands = bands;
            Ok(true)
        },
    );
    setter(
        api,
        "stripes(count, width)",
        "Stripe patterns along a side of cloth, and how much of each the stripe takes, 0 to 1.",
        |kind, a| {
            let (count, width) = (a.whole(0, 0, 256)? as u32, a.number_in(1, 0.0, 1.0)? as f32);
            let Kind::Weave(weave) = kind else {
                return Ok(false);
            };
            (weave.stripes, weave.stripe_width) = (count, width);
            Ok(true)
        },
    );
    setter(
        api,
        "stains(share)",
        "How much darker the stains of plaster are, or how much tiles differ, 0 to 1.",
        |kind, a| {
            let share = a.number_in(0, 0.0, 1.0)? as f32;
            match kind {
                Kind::Plaster(plaster) => plaster.stains = share,
                Kind::Tiles(tiles) => tiles.variety = share,
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
}

fn colors(api: &mut Api) {
    let color = |a: &Arguments, index: usize| -> Result<Vec3, Mistake> {
        a.object::<crate::color::Color>(index)
            .map(|color| color.0.as_vec3())
    };
    setter(
        api,
        "colors(only)",
        "The colour of plaster.",
        move |kind, a| {
            let only = color(a, 0)?;
            let Kind::Plaster(plaster) = kind else {
                return Ok(false);
            };
            plaster.color = only;
            Ok(true)
        },
    );
    setter(
        api,
        "colors(first, second)",
        "The two colours of a texture, as its own text says.",
        move |kind, a| {
            let pair = [color(a, 0)?, color(a, 1)?];
            match kind {
                Kind::Stone(Stone { colors, .. })
                | Kind::Marble(Marble { colors, .. })
                | Kind::Brick(Brick { colors, .. })
                | Kind::Tiles(Tiles { colors, .. })
                | Kind::Checker { colors, .. } => *colors = pair,
                Kind::Weave(weave) => {
                    (weave.colors[0], weave.colors[1]) = (pair[0], pair[1]);
                }
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "colors(first, second, third)",
        "The three colours of a texture, as its own text says.",
        move |kind, a| {
            let [first, second, third] = [color(a, 0)?, color(a, 1)?, color(a, 2)?];
            match kind {
                Kind::Brick(brick) => {
                    (brick.colors, brick.mortar) = ([first, second], third);
                }
                Kind::Tiles(tiles) => {
                    (tiles.colors, tiles.grout) = ([first, second], third);
                }
                Kind::Weave(weave) => weave.colors = [first, second, third],
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
}
