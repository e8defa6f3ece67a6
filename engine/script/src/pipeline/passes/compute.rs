//! How often a compute shader runs.

use lightbench_render::description::{Amount, Dispatch, PassKind};

use super::{Open, method, only_for};
use crate::api::{Api, Mistake};

/// Workgroups along an axis that every adapter can do.
const MOST: i64 = 65535;

pub(super) fn register(api: &mut Api) {
    method(
        api,
        "threads(x, y, z)",
        "Runs so many invocations along x, y and z; the last workgroups may have some over.",
        |open, arguments| {
            let amount = fixed(arguments, MOST * 64)?;
            dispatch(open, "threads", Dispatch::Threads(amount))
        },
    );
    method(
        api,
        "threads_of(target)",
        "Runs one invocation for each texel of a target, and for each of its layers along z; the last \
         workgroups may have some over.",
        |open, arguments| {
            let target = arguments.text(0)?;
            let amount = Amount::Texels { target, mip: 0 };
            dispatch(open, "threads_of", Dispatch::Threads(amount))
        },
    );
    method(
        api,
        "threads_of(target, mip)",
        "Runs one invocation for each texel of a mip level of a target; 0 is the largest.",
        |open, arguments| {
            let target = arguments.text(0)?;
            let mip = arguments.whole(1, 0, 15)? as u32;
            let amount = Amount::Texels { target, mip };
            dispatch(open, "threads_of", Dispatch::Threads(amount))
        },
    );
    method(
        api,
        "threads_per_tile(size)",
        "Runs one invocation for each tile of that many by that many pixels.",
        |open, arguments| {
            let tile = arguments.whole(0, 1, 1024)? as u32;
            let amount = Amount::Tiles { tile, depth: 1 };
            dispatch(open, "threads_per_tile", Dispatch::Threads(amount))
        },
    );
    method(
        api,
        "threads_per_tile(size, depth)",
        "Runs one invocation for each tile and each of so many slices behind it.",
        |open, arguments| {
            let tile = arguments.whole(0, 1, 1024)? as u32;
            let depth = arguments.whole(1, 1, 1024)? as u32;
            let amount = Amount::Tiles { tile, depth };
            dispatch(open, "threads_per_tile", Dispatch::Threads(amount))
        },
    );
    method(
        api,
        "threads_per_light()",
        "Runs one invocation for each light, and some over: check `frame.light_count`.",
        |open, _| dispatch(open, "threads_per_light", Dispatch::Threads(Amount::Lights)),
    );
    method(
        api,
        "groups(x, y, z)",
        "Runs so many workgroups along x, y and z. Default: `1, 1, 1`.",
        |open, arguments| {
            let amount = fixed(arguments, MOST)?;
            dispatch(open, "groups", Dispatch::Groups(amount))
        },
    );
    method(
        api,
        "groups_per_tile(size)",
        "Runs one workgroup for each tile of that many by that many pixels.",
        |open, arguments| {
            let tile = arguments.whole(0, 1, 1024)? as u32;
            let amount = Amount::Tiles { tile, depth: 1 };
            dispatch(open, "groups_per_tile", Dispatch::Groups(amount))
        },
    );
    method(
        api,
        "groups_per_tile(size, depth)",
        "Runs one workgroup for each tile and each of so many slices behind it.",
        |open, arguments| {
            let tile = arguments.whole(0, 1, 1024)? as u32;
            let depth = arguments.whole(1, 1, 1024)? as u32;
            let amount = Amount::Tiles { tile, depth };
            dispatch(open, "groups_per_tile", Dispatch::Groups(amount))
        },
    );
    method(
        api,
        "groups_from(buffer, word)",
        "Runs as many workgroups along x, y and z as three words of a buffer say, beginning with that \
         word, counted from 0.",
        |open, arguments| {
            let buffer = arguments.text(0)?;
            let word = arguments.whole(1, 0, i64::from(u32::MAX / 4) - 3)? as u32;
            dispatch(open, "groups_from", Dispatch::Indirect { buffer, word })
        },
    );
}

fn fixed(arguments: &crate::api::Arguments, most: i64) -> Result<Amount, Mistake> {
    let side = |index| Ok::<_, Mistake>(arguments.whole(index, 1, most)? as u32);
    Ok(Amount::Fixed(side(0)?, side(1)?, side(2)?))
}

fn dispatch(open: Open, method: &str, wanted: Dispatch) -> Result<(), Mistake> {
    match &mut open.pass.kind {
        PassKind::Compute(dispatch) => {
            *dispatch = wanted;
            Ok(())
        }
        other => Err(only_for(method, "compute", other)),
    }
}
