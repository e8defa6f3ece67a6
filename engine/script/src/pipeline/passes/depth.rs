//! The depth target of a pass, and its stencil.

use lightbench_render::description::{
    Compare, DepthAttachment, Load, PassKind, Stencil, StencilClear, StencilOperation,
};

use super::super::builder::Last;
use super::{Open, draws, method, takes_targets};
use crate::api::{Api, Mistake};

pub(super) fn register(api: &mut Api) {
    api.section("Depth and stencil");
    method(
        api,
        "depth(target)",
        "Sets the depth target. Fragments as near as what is there or nearer pass and are written; \
         a `lights` pass never writes.",
        |open, arguments| {
            let target = arguments.text(0)?;
            takes_targets(open.pass)?;
            if let Some(first) = &open.pass.depth
                && first.at.file == open.at.file
            {
                return Err(Mistake::new(format!(
                    "the pass has a depth target already, `{}`",
                    first.target
                )));
            }
            open.pass.depth = Some(DepthAttachment {
                write: !matches!(open.pass.kind, PassKind::Lights(_)),
                ..DepthAttachment::new(target, open.at)
            });
            *open.last = Last::Depth;
            Ok(())
        },
    );
    method(
        api,
        "clear(depth)",
        "Fills the depth target before the pass. Depth is reversed: 1 is the near plane, 0 the far \
         one. Without it, what earlier passes left is kept.",
        |open, arguments| {
            let depth = arguments.number_in(0, 0.0, 1.0)?;
            match (*open.last, &mut open.pass.depth) {
                (Last::Depth, Some(attachment)) => {
                    attachment.load = Load::Clear([depth, 0.0, 0.0, 0.0]);
                    Ok(())
                }
                (Last::Color, _) => Err(Mistake::new("a colour target is cleared to four numbers")
                    .with_hint("write `.clear(0, 0, 0, 0)`")),
                _ => Err(Mistake::new(
                    "`.clear` comes after the `.writes` or `.depth` that it applies to",
                )),
            }
        },
    );
    method(
        api,
        "test(compare)",
        "Which fragments pass the depth test, compared with what is there. `nearer` and `farther` let \
         equal depth pass too.",
        |open, arguments| {
            let compare = arguments.choice(0, &Compare::DEPTH_NAMES)?;
            if matches!(open.pass.kind, PassKind::Lights(_)) {
                return Err(Mistake::new(
                    "a `lights` pass chooses the depth test for each light itself",
                ));
            }
            attached(open, "test", |depth| depth.compare = compare)
        },
    );
    method(
        api,
        "read_only()",
        "Tests depth without writing it, so that the shader may read it too. Without it, fragments \
         write their depth, but for those of a `lights` pass.",
        |open, _| attached(open, "read_only", |depth| depth.write = false),
    );
    method(
        api,
        "bias(constant, slope)",
        "Moves fragments by steps of depth's resolution and by their slope, nearer if positive. \
         Default: `0, 0`.",
        |open, arguments| {
            let constant = arguments.whole(0, -1_000_000, 1_000_000)? as i32;
            let slope = arguments.float(1)?;
            attached(open, "bias", |depth| depth.bias = (constant, slope))
        },
    );
    stencil(api);
}

fn stencil(api: &mut Api) {
    method(
        api,
        "stencil(compare, reference)",
        "Draws only where the reference compares so with the stencil value: `less` where the \
         reference is less. Comes after `.depth`. Default: `\"always\", 0`.",
        |open, arguments| {
            let compare = arguments.choice(0, &Compare::STENCIL_NAMES)?;
            let reference = arguments.whole(1, 0, 255)? as u8;
            stenciled(open, "stencil", |stencil| {
                stencil.compare = compare;
                stencil.reference = reference;
            })
        },
    );
    method(
        api,
        "stencil_write(pass)",
        "What happens to the stencil value where stencil and depth test pass. `replace` writes the \
         reference; `increment` stops at 255 and `decrement` at 0, unless they wrap.",
        |open, arguments| {
            let pass = arguments.choice(0, &StencilOperation::NAMES)?;
            stenciled(open, "stencil_write", |stencil| stencil.pass = pass)
        },
    );
    method(
        api,
        "stencil_write(pass, depth_fail, fail)",
        "The same, and what happens where the depth test fails, and where the stencil test fails.",
        |open, arguments| {
            let pass = arguments.choice(0, &StencilOperation::NAMES)?;
            let depth_fail = arguments.choice(1, &StencilOperation::NAMES)?;
            let fail = arguments.choice(2, &StencilOperation::NAMES)?;
            stenciled(open, "stencil_write", |stencil| {
                stencil.pass = pass;
                stencil.depth_fail = depth_fail;
                stencil.fail = fail;
            })
        },
    );
    method(
        api,
        "stencil_masks(read, write)",
        "Which bits of stencil are compared and which are written. Default: `255, 255`.",
        |open, arguments| {
            let read = arguments.whole(0, 0, 255)? as u8;
            let write = arguments.whole(1, 0, 255)? as u8;
            stenciled(open, "stencil_masks", |stencil| {
                stencil.read_mask = read;
                stencil.write_mask = write;
            })
        },
    );
    method(
        api,
        "clear_stencil(value)",
        "Fills stencil before the pass. Without it, what earlier passes left is kept.",
        |open, arguments| {
            let value = arguments.whole(0, 0, 255)? as u8;
            stenciled(open, "clear_stencil", |stencil| {
                stencil.load = StencilClear::To(value);
            })
        },
    );
}

fn attached(
    open: Open,
    method: &str,
    change: impl FnOnce(&mut DepthAttachment),
) -> Result<(), Mistake> {
    if method != "clear_stencil" {
        draws(open.pass, method)?;
    }
    match &mut open.pass.depth {
        Some(depth) => {
            change(depth);
            Ok(())
        }
        None => Err(Mistake::new(format!("`.{method}` comes after `.depth`"))),
    }
}

fn stenciled(open: Open, method: &str, change: impl FnOnce(&mut Stencil)) -> Result<(), Mistake> {
    let at = open.at.clone();
    attached(open, method, |depth| {
        change(depth.stencil.get_or_insert_with(|| Stencil::new(at)));
    })
}
