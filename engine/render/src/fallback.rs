//! Formats that an adapter can do, in place of those that it can't.

use crate::description::{Blend, PipelineDesc, TargetDesc};
use crate::format::Format;
use crate::validate::FormatSupport;

/// Gives each target the first of its formats that the adapter can do, and says in a sentence each
/// where that is not the first of all.
pub fn settle_formats(desc: &mut PipelineDesc, support: &impl FormatSupport) -> Vec<String> {
    let mut notes = Vec::new();
    for index in 0..desc.targets.len() {
        let target = &desc.targets[index];
        if can(desc, target, target.format, support) {
            continue;
        }
        let mut fallbacks = target.fallbacks.iter().copied();
        // Without a format that works, validation names the first one.
        if let Some(format) = fallbacks.find(|format| can(desc, target, *format, support)) {
            notes.push(format!(
                "`{}` is {format}, since this adapter can't use {} for it",
                target.name, target.format
            ));
            desc.targets[index].format = format;
        }
    }
    notes
}

/// Whether the adapter can do with the format what the passes do with the target.
fn can(
    desc: &PipelineDesc,
    target: &TargetDesc,
    format: Format,
    support: &impl FormatSupport,
) -> bool {
    let colors = desc.passes.iter().flat_map(|pass| &pass.colors);
    let mut colors = colors.filter(|color| color.target == target.name);
    let blended = colors.clone().any(|color| color.blend != Blend::Replace);
    let depth = desc.passes.iter().flat_map(|pass| &pass.depth);
    let drawn = colors.next().is_some() || depth.clone().any(|d| d.target == target.name);
    let updates = desc.passes.iter().flat_map(|pass| &pass.updates);
    let stored = updates.clone().any(|update| update.target == target.name);
    (!drawn || support.renderable(format))
        && (!blended || support.blendable(format))
        && (!stored || support.storable(format))
        && (target.samples == 1 || support.multisampled(format))
}
