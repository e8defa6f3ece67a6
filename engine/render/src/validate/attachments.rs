//! Colour and depth targets of a pass, and what it reads beside them.

use super::{Checker, FormatSupport};
use crate::description::{
    Blend, BlendFactor, BlendOperation, ColorAttachment, ColorMask, DepthAttachment, Load, Mips,
    PassDesc, PassKind, Shape, Slice, TargetDesc, TargetSize, Update,
};
use crate::problem::Place;
use crate::record::MAX_COLORS;
use crate::reflection::SampleKind;

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn attachments(&mut self, pass: &PassDesc) {
        let writes = !pass.colors.is_empty() || pass.depth.is_some() || !pass.updates.is_empty();
        // What a shadow pass must write is told with its kind.
        let shadow = matches!(pass.kind, PassKind::Shadow(_));
        if pass.kind.rasterises() && !writes && !shadow {
            self.report(
                &pass.at,
                format!("the pass `{}` writes nothing", pass.name),
                "add .writes(\"target\") or .depth(\"target\")".to_owned(),
            );
        }
        let mut seen: Vec<(&str, Slice)> = Vec::new();
        let resolved = pass
            .colors
            .iter()
            .filter_map(|color| color.resolve.as_ref());
        for into in resolved {
            let drawn = pass.colors.iter().any(|color| color.target == into.name);
            let slice = (into.name.as_str(), Slice::default());
            if drawn || seen.contains(&slice) {
                self.report(
                    &into.at,
                    format!("the pass writes `{}` twice", into.name),
                    "resolve to a target of its own".to_owned(),
                );
            }
            seen.push(slice);
        }
        seen.clear();
        for color in &pass.colors {
            let Some(target) = self.target(&color.target, &color.at) else {
                continue;
            };
            let slice = (color.target.as_str(), color.slice);
            if seen.contains(&slice) {
                self.report(
                    &color.at,
                    format!("the pass writes `{}` twice", color.target),
                    "each output of the shader needs a target of its own".to_owned(),
                );
            }
            seen.push(slice);
            self.color(color, target);
        }
        if let Some(depth) = &pass.depth {
            self.depth(pass, depth);
        }
        for read in &pass.reads {
            if self.known(&read.target, &read.at) {
                let (mip, layer) = (read.mip.unwrap_or(0), read.layer.unwrap_or(0));
                self.in_range(&read.target, &read.at, mip, layer);
                self.part(&read.target, &read.at, read.layer.is_some());
            }
        }
        for update in &pass.updates {
            if self.known(&update.target, &update.at) {
                let Slice { mip, layer } = update.slice;
                self.in_range(&update.target, &update.at, mip, layer);
                self.part(&update.target, &update.at, update.one_layer);
                self.updated(update);
            }
        }
        if pass.kind != PassKind::Clear {
            self.sizes(pass);
            self.color_bytes(pass);
        }
    }

    fn color(&mut self, color: &ColorAttachment, target: &TargetDesc) {
        let format = target.format;
        self.in_range(&color.target, &color.at, color.slice.mip, color.slice.layer);
        self.channels(color, target);
        if format.is_depth() {
            self.report(
                &color.at,
                format!(
                    "`{}` holds depth ({format}) and can't be a colour target",
                    color.target
                ),
                format!("use .depth(\"{}\")", color.target),
            );
        } else if color.blend != Blend::Replace && !self.support.blendable(format) {
            let integer = SampleKind::of_format(format.0) != SampleKind::Float;
            let why = if integer {
                "and integers never blend"
            } else {
                "which this adapter can't blend"
            };
            self.report(
                &color.at,
                format!("`{}` is {format}, {why}", color.target),
                "choose `rgba16float`, or drop .blend".to_owned(),
            );
        }
        let Some(resolve) = &color.resolve else {
            if !color.store {
                self.report(
                    &color.at,
                    format!("`{}` is neither kept nor resolved", color.target),
                    "add .resolves_to(\"target\"), or drop .drop_samples()".to_owned(),
                );
            }
            return;
        };
        let Some(into) = self.target(&resolve.name, &resolve.at) else {
            return;
        };
        let at = resolve.at.clone();
        self.mean(target, &at, into, &at, "declare it with .samples(4)");
    }

    /// The channels that are written exist, and blend as the device can.
    fn channels(&mut self, color: &ColorAttachment, target: &TargetDesc) {
        let components = target.format.0.components();
        let missing = (components..4).find(|channel| color.mask.0 & (1 << channel) != 0);
        if let Some(channel) = missing.filter(|_| color.mask != ColorMask::ALL) {
            self.report(
                &color.at,
                format!(
                    "`{}` is {}, which has no channel `{}`",
                    color.target,
                    target.format,
                    ["r", "g", "b", "a"][usize::from(channel)]
                ),
                format!("its channels are `{}`", &"rgba"[..usize::from(components)]),
            );
        }
        let Some((rgb, alpha)) = color.blend.parts() else {
            return;
        };
        for part in [rgb, alpha] {
            let extreme = matches!(part.operation, BlendOperation::Min | BlendOperation::Max);
            let plain = [part.source, part.destination] == [BlendFactor::One; 2];
            if extreme && !plain {
                self.report(
                    &color.at,
                    format!(
                        "`{}` is blended by `min` or `max` with a factor",
                        color.target
                    ),
                    "these take the factor `one` on both sides".to_owned(),
                );
                return;
            }
        }
    }

    /// Shaders see a volume as a whole.
    fn part(&mut self, name: &str, at: &Place, one_layer: bool) {
        let target = self.desc.target(name);
        let volume = target.is_some_and(|t| matches!(t.shape, Shape::Volume(_)));
        if one_layer && volume {
            self.report(
                at,
                format!("`{name}` is a volume: shaders can't have one slice of it"),
                "drop .layer; the shader chooses the slice, as in textureLoad(volume, vec3i(x, y, \
                 z), 0)"
                    .to_owned(),
            );
        }
    }

    /// A target that a shader writes to wherever it likes.
    fn updated(&mut self, update: &Update) {
        let target = self.desc.target(&update.target);
        if target.is_some_and(|target| target.samples > 1) {
            self.report(
                &update.at,
                format!(
                    "`{}` has several samples a texel and can't be updated",
                    update.target
                ),
                "draw to it with .writes, or drop .samples".to_owned(),
            );
        }
    }

    fn depth(&mut self, pass: &PassDesc, depth: &DepthAttachment) {
        let Some(target) = self.target(&depth.target, &depth.at) else {
            return;
        };
        self.in_range(&depth.target, &depth.at, depth.slice.mip, depth.slice.layer);
        if !target.format.is_depth() {
            self.report(
                &depth.at,
                format!(
                    "`{}` is {}, which holds no depth",
                    depth.target, target.format
                ),
                "give it the format `depth32float`".to_owned(),
            );
        }
        if !depth.write && matches!(depth.load, Load::Clear(_)) {
            self.report(
                &depth.at,
                format!("`{}` is read-only here and can't be cleared", depth.target),
                "drop .clear, or .read_only()".to_owned(),
            );
        }
        if matches!(pass.kind, PassKind::Lights(_)) && depth.write {
            self.report(
                &depth.at,
                format!("the lights pass `{}` would write depth", pass.name),
                "add .read_only() after .depth".to_owned(),
            );
        }
        if let Some(stencil) = &depth.stencil
            && !target.format.has_stencil()
            && target.format.is_depth()
        {
            self.report(
                &stencil.at,
                format!("`{}` is {}, without stencil", depth.target, target.format),
                "give it the format `depth32float-stencil8`".to_owned(),
            );
        }
    }

    /// A mip level and a layer that a target does not have.
    pub(super) fn in_range(&mut self, name: &str, at: &Place, mip: u32, layer: u32) {
        let Some(target) = self.desc.target(name) else {
            return;
        };
        let mips = match (target.mips, target.size) {
            (mips, TargetSize::Absolute(width, height)) => mips.resolve(width, height, 1),
            (Mips::Count(count), _) => count,
            // It depends on the output's size.
            (Mips::All, _) => u32::MAX,
        };
        if mip >= mips {
            self.report(
                at,
                format!("`{name}` has no mip level {mip}; it has {mips}, from 0"),
                "declare it with .mips()".to_owned(),
            );
        }
        let layers = match target.shape {
            // A volume's smaller levels have fewer slices.
            Shape::Volume(slices) => (slices >> mip.min(31)).max(1),
            shape => shape.layers(),
        };
        if layer >= layers {
            let hint = if target.shape == Shape::Flat {
                "declare it with .array(layers)"
            } else {
                "layers are counted from 0; smaller mip levels of a volume have fewer"
            };
            self.report(
                at,
                format!("`{name}` has no layer {layer}; it has {layers}"),
                hint.to_owned(),
            );
        }
    }

    /// All attachments of a pass have one size and one number of samples.
    fn sizes(&mut self, pass: &PassDesc) {
        let attachments = pass.colors.iter().map(|c| (&c.target, &c.at, c.slice.mip));
        let depth = pass.depth.iter().map(|d| (&d.target, &d.at, d.slice.mip));
        let known: Vec<_> = attachments
            .chain(depth)
            .filter_map(|(name, at, mip)| self.desc.target(name).map(|t| (t, at, mip)))
            .collect();
        let Some((&(first, _, mip), rest)) = known.split_first() else {
            return;
        };
        for &(target, at, other_mip) in rest {
            let (name, first_name) = (&target.name, &first.name);
            let size = |target: &TargetDesc, mip: u32| match target.size {
                TargetSize::Absolute(width, height) => (
                    TargetSize::Absolute((width >> mip).max(1), (height >> mip).max(1)),
                    0,
                ),
                other => (other, mip),
            };
            if size(target, other_mip) != size(first, mip) {
                self.report(
                    at,
                    format!("`{name}` and `{first_name}` differ in size, but one pass writes both"),
                    "give them the same .scale or .size, or use two passes".to_owned(),
                );
            } else if target.samples != first.samples {
                self.report(
                    at,
                    format!(
                        "`{name}` has {} samples a texel and `{first_name}` {}, but one pass \
                         writes both",
                        target.samples, first.samples
                    ),
                    "give them the same .samples, or use two passes".to_owned(),
                );
            }
        }
    }

    /// The colour targets fit into what a pixel may have.
    fn color_bytes(&mut self, pass: &PassDesc) {
        if let Some(color) = pass.colors.get(MAX_COLORS) {
            self.report(
                &color.at,
                format!("a pass writes at most {MAX_COLORS} colour targets"),
                "use two passes".to_owned(),
            );
        }
        // WebGPU aligns each target's bytes to those of a channel.
        let mut bytes = 0;
        for color in &pass.colors {
            let Some(format) = self.desc.target(&color.target).map(|t| t.format.0) else {
                return;
            };
            let (Some(cost), Some(alignment)) = (
                format.target_pixel_byte_cost(),
                format.target_component_alignment(),
            ) else {
                return;
            };
            bytes = u32::next_multiple_of(bytes, alignment) + cost;
        }
        let most = self.support.limits().max_color_attachment_bytes_per_sample;
        if bytes > most {
            self.report(
                &pass.at,
                format!(
                    "the colour targets of `{}` take {bytes} bytes a pixel; this adapter allows \
                     {most}",
                    pass.name
                ),
                "choose smaller formats, or use two passes".to_owned(),
            );
        }
    }

    /// No part of a target is read and written by one pass, except depth that is read-only.
    pub(super) fn feedback(&mut self, pass: &PassDesc) {
        for read in &pass.reads {
            let clashes = |target: &str, slice: Slice| {
                read.target == target
                    && read.mip.is_none_or(|mip| mip == slice.mip)
                    && read.layer.is_none_or(|layer| layer == slice.layer)
            };
            if pass.colors.iter().any(|c| clashes(&c.target, c.slice)) {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads `{}` and writes it",
                        pass.name, read.target
                    ),
                    "write to a second target, or use .blend(\"add\")".to_owned(),
                );
            }
            if pass.updates.iter().any(|u| clashes(&u.target, u.slice)) {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads `{}` and updates it",
                        pass.name, read.target
                    ),
                    "drop .reads: what is updated can be read too".to_owned(),
                );
            }
            let mut resolved = pass
                .colors
                .iter()
                .filter_map(|color| color.resolve.as_ref());
            if resolved.any(|into| clashes(&into.name, Slice::default())) {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads `{}` and resolves to it",
                        pass.name, read.target
                    ),
                    "resolve to another target".to_owned(),
                );
            }
            let depth = pass.depth.as_ref();
            let marks = depth.is_some_and(|depth| {
                let stencil = depth.stencil.as_ref();
                !depth.write && stencil.is_some_and(|stencil| stencil.writes())
            });
            if marks && depth.is_some_and(|depth| depth.target == read.target) {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads the depth `{}` and writes the stencil beside it",
                        pass.name, read.target
                    ),
                    "write depth to a second target in an earlier pass, and read that".to_owned(),
                );
            }
            if depth.is_some_and(|depth| depth.write && clashes(&depth.target, depth.slice)) {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads the depth `{}` that it writes",
                        pass.name, read.target
                    ),
                    "add .read_only() after .depth".to_owned(),
                );
            }
        }
        for (index, update) in pass.updates.iter().enumerate() {
            let same = |other: &&Update| {
                let layers = other.one_layer && update.one_layer;
                other.target == update.target
                    && other.slice.mip == update.slice.mip
                    && (!layers || other.slice.layer == update.slice.layer)
            };
            if pass.updates[..index].iter().find(same).is_some() {
                self.report(
                    &update.at,
                    format!("the pass `{}` updates `{}` twice", pass.name, update.target),
                    "one variable is enough".to_owned(),
                );
            }
            let drawn = pass.colors.iter().any(|c| c.target == update.target)
                || pass.depth.iter().any(|d| d.target == update.target);
            if drawn {
                self.report(
                    &update.at,
                    format!(
                        "the pass `{}` draws to `{}` and updates it",
                        pass.name, update.target
                    ),
                    "use one of the two".to_owned(),
                );
            }
        }
    }
}
