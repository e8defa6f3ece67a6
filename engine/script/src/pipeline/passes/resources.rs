//! What a pass's shader reads and writes besides its attachments.

use lightbench_render::description::{PassDesc, PassKind, Read, Slice, Update};

use super::{Open, method, takes_targets};
use crate::api::{Api, Mistake};
use crate::pipeline::builder::shader_name;

pub(super) fn register(api: &mut Api) {
    api.section("What the shader reads and updates");
    for form in ["reads(target)", "reads(target, variable)"] {
        method(
            api,
            form,
            "Lets the shader read a target or buffer, under its name or that of another variable. \
             `.mip` and `.layer` after it choose a part; without them the shader sees all of it.",
            |open, arguments| {
                let target = arguments.text(0)?;
                let variable = match arguments.len() {
                    2 => arguments.text(1)?,
                    _ => target.clone(),
                };
                free(open.pass, &variable)?;
                if open.pass.kind == PassKind::Clear {
                    return Err(Mistake::new(
                        "a `clear` pass has no shader that could read something",
                    ));
                }
                open.pass.reads.push(Read {
                    variable,
                    ..Read::new(target, open.at)
                });
                *open.last = super::Last::Read;
                Ok(())
            },
        );
    }
    for form in ["updates(target)", "updates(target, variable)"] {
        method(
            api,
            form,
            "Lets the shader write a buffer or storage texture wherever it likes, and read what it \
             wrote. `.mip` and `.layer` after it choose a part; without them it is the largest \
             level, with all layers.",
            |open, arguments| {
                let target = arguments.text(0)?;
                let variable = match arguments.len() {
                    2 => arguments.text(1)?,
                    _ => target.clone(),
                };
                free(open.pass, &variable)?;
                open.pass.updates.push(Update {
                    target,
                    variable,
                    at: open.at,
                    slice: Slice::default(),
                    one_layer: false,
                });
                *open.last = super::Last::Update;
                Ok(())
            },
        );
    }
    method(
        api,
        "mip(level)",
        "Chooses a mip level of what was named last by `.reads`, `.updates`, `.writes` or `.depth`; 0 \
         is the largest. Without it, a pass writes level 0, and reads all.",
        |open, arguments| {
            let mip = arguments.whole(0, 0, 15)? as u32;
            slice(
                open,
                "mip",
                |read| read.mip = Some(mip),
                |slice| slice.mip = mip,
            )
        },
    );
    method(
        api,
        "layer(index)",
        "Chooses a layer of an array, a side of a cube or a slice of a volume of what was named \
         last. Without it, a pass draws to layer 0, and reads all.",
        |open, arguments| {
            let layer = arguments.whole(0, 0, 2047)? as u32;
            if *open.last == super::Last::Update
                && let Some(update) = open.pass.updates.last_mut()
            {
                update.one_layer = true;
            }
            slice(
                open,
                "layer",
                |read| read.layer = Some(layer),
                |slice| slice.layer = layer,
            )
        },
    );
}

/// A variable can stand for one thing only.
fn free(pass: &PassDesc, variable: &str) -> Result<(), Mistake> {
    shader_name(variable, "a variable")?;
    takes_targets(pass)?;
    let mut taken = pass
        .reads
        .iter()
        .map(|read| &read.variable)
        .chain(pass.updates.iter().map(|update| &update.variable));
    if taken.any(|other| other == variable) {
        return Err(Mistake::new(format!(
            "the pass has something by the name of `{variable}` already"
        )));
    }
    Ok(())
}

fn slice(
    open: Open,
    method: &str,
    of_read: impl FnOnce(&mut Read),
    of_slice: impl FnOnce(&mut Slice),
) -> Result<(), Mistake> {
    let pass = open.pass;
    match open.last {
        super::Last::Read => pass.reads.last_mut().map(of_read),
        super::Last::Update => pass.updates.last_mut().map(|u| of_slice(&mut u.slice)),
        super::Last::Color => pass.colors.last_mut().map(|c| of_slice(&mut c.slice)),
        super::Last::Depth => pass.depth.as_mut().map(|d| of_slice(&mut d.slice)),
        super::Last::Nothing => None,
    }
    .ok_or_else(|| {
        Mistake::new(format!(
            "`.{method}` comes after the `.reads`, `.updates`, `.writes` or `.depth` that it \
             applies to"
        ))
    })
}
