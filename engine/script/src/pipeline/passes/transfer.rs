//! Passes that move what targets hold: copy, resolve, mips, history.

use lightbench_render::description::{PassKind, Read, Reduction};

use super::begin;
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api) {
    begin(
        api,
        "copy(name, from, to)",
        "Adds a pass that copies a target or buffer to another of the same format and size.",
        |arguments| {
            let (from, to) = pair(arguments)?;
            Ok(PassKind::Copy { from, to })
        },
    );
    begin(
        api,
        "copy_slice(name, from, from_mip, from_layer, to, to_mip, to_layer)",
        "Adds a pass that copies one mip level of one layer to one of another target.",
        |arguments| {
            let read = |index: usize| {
                let mut read = Read::new(arguments.text(index)?, arguments.place());
                read.mip = Some(arguments.whole(index + 1, 0, 15)? as u32);
                read.layer = Some(arguments.whole(index + 2, 0, 2047)? as u32);
                Ok::<_, Mistake>(read)
            };
            Ok(PassKind::Copy {
                from: read(1)?,
                to: read(4)?,
            })
        },
    );
    begin(
        api,
        "resolve(name, from, to)",
        "Adds a pass that takes the mean of each texel's samples.",
        |arguments| {
            let (from, to) = pair(arguments)?;
            Ok(PassKind::Resolve { from, to })
        },
    );
    begin(
        api,
        "mips(name, target, reduction)",
        "Adds a pass that fills the smaller mip levels of a target: four texels make one by their \
         `average`, `min` or `max`.",
        |arguments| {
            Ok(PassKind::Mips {
                target: Read::new(arguments.text(1)?, arguments.place()),
                reduction: arguments.choice(2, &Reduction::NAMES)?,
            })
        },
    );
    begin(
        api,
        "history(name, from, to)",
        "Adds a pass that keeps a target for the next frame, which reads it as the target `to`. In \
         the first frame, and after a change of size, that one is black and \
         `frame.history_frames` is 0.",
        |arguments| {
            let (from, to) = pair(arguments)?;
            Ok(PassKind::History { from, to })
        },
    );
}

fn pair(arguments: &Arguments) -> Result<(Read, Read), Mistake> {
    Ok((
        Read::new(arguments.text(1)?, arguments.place()),
        Read::new(arguments.text(2)?, arguments.place()),
    ))
}
