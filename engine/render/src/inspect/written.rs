//! Which slices of which targets a pass writes.

use crate::description::{PassDesc, PassKind, Slice};
use crate::frame::Frame;
use crate::targets::{Target, Targets};

/// Calls `found` for each slice that a pass writes, in the order of its declarations.
pub(super) fn written<'a>(
    pass: &'a PassDesc,
    targets: &'a Targets,
    frame: &Frame,
    list: Option<usize>,
    mut found: impl FnMut(&'a Target, Slice),
) {
    let mut one = |name: &str, slice: Slice| {
        if let Some(target) = targets.get(name) {
            found(target, slice);
        }
    };
    match &pass.kind {
        PassKind::Clear => {
            let colors = pass.colors.iter().map(|color| &color.target);
            let depth = pass.depth.iter().map(|depth| &depth.target);
            for name in colors.chain(depth) {
                slices(targets.get(name), 0).for_each(|slice| one(name, slice));
            }
            return;
        }
        PassKind::Copy { to, .. } | PassKind::History { to, .. } => {
            let mip = to.mip.unwrap_or(0);
            let target = targets.get(&to.target);
            let wanted = |slice: &Slice| {
                (to.mip.is_none() || slice.mip == mip)
                    && to.layer.is_none_or(|layer| slice.layer == layer)
            };
            slices(target, 0)
                .filter(wanted)
                .for_each(|slice| one(&to.target, slice));
        }
        PassKind::Resolve { to, .. } => one(&to.target, Slice::default()),
        PassKind::Mips { target, .. } => {
            slices(targets.get(&target.target), 1).for_each(|slice| one(&target.target, slice));
        }
        PassKind::Shadow(_) => {
            let list = list.and_then(|list| frame.shadow_lists.get(list));
            let views = list.map_or(0, |list| list.views.len() as u32);
            if let Some(depth) = &pass.depth {
                (0..views).for_each(|layer| one(&depth.target, Slice { mip: 0, layer }));
            }
            return;
        }
        _ => {}
    }
    for color in &pass.colors {
        one(&color.target, color.slice);
        if let Some(resolve) = &color.resolve {
            one(&resolve.name, Slice::default());
        }
    }
    if let Some(depth) = &pass.depth
        && crate::life::writes(pass).any(|name| name == depth.target)
    {
        one(&depth.target, depth.slice);
    }
    for update in &pass.updates {
        let wanted = |slice: &Slice| {
            slice.mip == update.slice.mip
                && (!update.one_layer || slice.layer == update.slice.layer)
        };
        slices(targets.get(&update.target), 0)
            .filter(wanted)
            .for_each(|slice| one(&update.target, slice));
    }
}

/// All layers of all mip levels from one on.
fn slices(target: Option<&Target>, first_mip: u32) -> impl Iterator<Item = Slice> + '_ {
    target.into_iter().flat_map(move |target| {
        let mips = first_mip..target.texture.mip_level_count();
        mips.flat_map(|mip| (0..target.layers_of_mip(mip)).map(move |layer| Slice { mip, layer }))
    })
}
