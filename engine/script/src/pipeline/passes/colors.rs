//! Colour targets: clearing, blending, masks.

use lightbench_render::description::{
    Blend, BlendFactor, BlendOperation, BlendPart, ColorAttachment, ColorMask, Load, Named,
    PassDesc, PassKind,
};

use super::super::builder::Last;
use super::{Open, draws, method, takes_targets};
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api) {
    api.section("Colour targets");
    method(
        api,
        "writes(target)",
        "Adds a colour target, in the order of the shader's outputs: the first takes \
         `@location(0)`. `.clear`, `.blend`, `.mask`, `.resolves_to` and `.drop_samples` after it \
         apply to it. A pass has at most eight.",
        |open, arguments| {
            let target = arguments.text(0)?;
            colors(open.pass).map_err(|mistake| match open.pass.kind {
                PassKind::Compute(_) => {
                    mistake.with_hint(format!("write `.updates(\"{target}\")`"))
                }
                _ => mistake,
            })?;
            open.pass.colors.push(ColorAttachment::new(target, open.at));
            *open.last = Last::Color;
            Ok(())
        },
    );
    method(
        api,
        "clear(red, green, blue, alpha)",
        "Fills the last `.writes` target with a constant before the pass, in the target's own \
         numbers: linear light, or whole numbers for integer formats. Without it, what earlier \
         passes left is kept.",
        |open, arguments| {
            let mut color = [0.0; 4];
            for (index, channel) in color.iter_mut().enumerate() {
                *channel = arguments.number(index)?;
            }
            if *open.last == Last::Depth {
                return Err(Mistake::new("depth is cleared to one number")
                    .with_hint("write `.clear(0.0)`; depth is reversed, 0 is the far plane"));
            }
            attached(open, "clear", |attachment| {
                attachment.load = Load::Clear(color);
            })
        },
    );
    blending(api);
    method(
        api,
        "mask(channels)",
        "Writes only some channels of the last `.writes` target, as in `rgb`. Default: `\"rgba\"`.",
        |open, arguments| {
            let letters = arguments.text(0)?;
            let mask = ColorMask::from_letters(&letters).ok_or_else(|| {
                Mistake::new(format!("`{letters}` names no channels"))
                    .with_hint("write some of the letters `rgba`, each once")
            })?;
            attached(open, "mask", |attachment| attachment.mask = mask)
        },
    );
    method(
        api,
        "resolves_to(target)",
        "At the end of the pass, another target takes the mean of the samples of the last \
         `.writes` target, which has 4 samples a texel.",
        |open, arguments| {
            let name = arguments.text(0)?;
            let at = open.at.clone();
            attached(open, "resolves_to", |attachment| {
                attachment.resolve = Some(Named { name, at });
            })
        },
    );
    method(
        api,
        "drop_samples()",
        "Does not keep what the pass drew to the last `.writes` target, when only what it resolves \
         to is wanted.",
        |open, _| attached(open, "drop_samples", |attachment| attachment.store = false),
    );
    method(
        api,
        "blend_constant(red, green, blue, alpha)",
        "Sets what the blend factors `constant` and `one_minus_constant` stand for. Default: `0, 0, \
         0, 0`.",
        |open, arguments| {
            colors(open.pass)?;
            draws(open.pass, "blend_constant")?;
            for index in 0..4 {
                open.pass.blend_constant[index] = arguments.number(index)?;
            }
            Ok(())
        },
    );
}

fn blending(api: &mut Api) {
    method(
        api,
        "blend(mode)",
        "How new values combine with what the last `.writes` target holds. With s the new value, d \
         the old one and α the new alpha: `replace` s, `add` s + d, `over` α s + (1 − α) d, \
         `premultiplied` s + (1 − α) d, `min` and `max` the smaller and the larger, channel by \
         channel.",
        |open, arguments| {
            let blend = arguments.choice(0, &Blend::NAMES)?;
            if *open.last == Last::Depth {
                return Err(Mistake::new("depth does not blend")
                    .with_hint("`.blend` comes after the `.writes` that it applies to"));
            }
            attached(open, "blend", |attachment| attachment.blend = blend)
        },
    );
    method(
        api,
        "blend(source, operation, destination)",
        "Blends in any way: the new value times the factor `source`, combined by `operation` with \
         the old value times the factor `destination`.",
        |open, arguments| {
            let part = part(arguments)?;
            attached(open, "blend", |attachment| {
                attachment.blend = Blend::Custom {
                    color: part,
                    alpha: part,
                };
            })
        },
    );
    method(
        api,
        "blend_alpha(source, operation, destination)",
        "Blends alpha in another way than colour. Comes after `.blend`.",
        |open, arguments| {
            let part = part(arguments)?;
            attached(open, "blend_alpha", |attachment| {
                let replace = BlendPart {
                    source: BlendFactor::One,
                    operation: BlendOperation::Add,
                    destination: BlendFactor::Zero,
                };
                let (color, _) = attachment.blend.parts().unwrap_or((replace, replace));
                attachment.blend = Blend::Custom { color, alpha: part };
            })
        },
    );
}

fn part(arguments: &Arguments) -> Result<BlendPart, Mistake> {
    Ok(BlendPart {
        source: arguments.choice(0, &BlendFactor::NAMES)?,
        operation: arguments.choice(1, &BlendOperation::NAMES)?,
        destination: arguments.choice(2, &BlendFactor::NAMES)?,
    })
}

/// Whether the pass can have colour targets.
fn colors(pass: &PassDesc) -> Result<(), Mistake> {
    takes_targets(pass)?;
    match pass.kind {
        PassKind::Compute(_) => Err(Mistake::new("a compute pass has no colour targets")),
        PassKind::Shadow(_) => Err(Mistake::new(
            "a shadow pass draws depth alone and has no colour targets",
        )),
        _ => Ok(()),
    }
}

fn attached(
    open: Open,
    method: &str,
    change: impl FnOnce(&mut ColorAttachment),
) -> Result<(), Mistake> {
    if method != "clear" {
        draws(open.pass, method)?;
    }
    match (*open.last, open.pass.colors.last_mut()) {
        (Last::Color, Some(attachment)) => {
            change(attachment);
            Ok(())
        }
        _ => Err(Mistake::new(format!(
            "`.{method}` comes after the `.writes` that it applies to"
        ))),
    }
}
