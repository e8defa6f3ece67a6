//! Targets and buffers by themselves, and whether passes use them.

use super::{Checker, FormatSupport};
use crate::description::{BufferSize, Mips, PassKind, Shape, TargetDesc, TargetSize};
use crate::life;
use crate::problem::{nearest, suggestion};

/// The most memory that one target of a fixed size may take: as much as small graphics cards have
/// for all.
const MOST_BYTES: u64 = 4 << 30;

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn targets(&mut self) {
        let desc = self.desc;
        for target in &desc.targets {
            self.format(target);
            self.shape(target);
            self.extent(target);
        }
    }

    /// Every target and buffer is there for something.
    pub(super) fn uses(&mut self) {
        let desc = self.desc;
        let passes = || desc.passes.iter();
        for target in &desc.targets {
            let name = target.name.as_str();
            let used = passes().any(|pass| {
                life::writes(pass)
                    .chain(life::reads(pass))
                    .any(|used| used == name)
            });
            if !used && !self.meant.contains(name) {
                self.report(
                    &target.at,
                    format!("no pass uses the target `{name}`"),
                    "write it in a pass, or remove it".to_owned(),
                );
            }
        }
        for buffer in &desc.buffers {
            let name = buffer.name.as_str();
            let written = passes().any(|pass| life::writes(pass).any(|used| used == name));
            let read = passes().any(|pass| life::reads(pass).any(|used| used == name));
            if !written && !self.meant.contains(name) {
                let hint = if read {
                    "add .updates to the pass that fills it"
                } else {
                    "use it in a pass, or remove it"
                };
                let message = format!("no pass writes the buffer `{name}`");
                self.report(&buffer.at, message, hint.to_owned());
            }
        }
    }

    /// The adapter can do with the format what passes do with the target.
    fn format(&mut self, target: &TargetDesc) {
        let desc = self.desc;
        let (name, format) = (&target.name, target.format);
        let stored = desc
            .passes
            .iter()
            .any(|pass| pass.updates.iter().any(|update| update.target == *name));
        let drawn = desc.passes.iter().any(|pass| {
            pass.colors.iter().any(|color| color.target == *name)
                || pass.depth.iter().any(|depth| depth.target == *name)
                || match &pass.kind {
                    PassKind::Mips { target, .. } => target.target == *name,
                    PassKind::Resolve { from, to } => from.target == *name || to.target == *name,
                    _ => false,
                }
        });
        if (drawn || !stored) && !self.support.renderable(format) {
            self.report(
                &target.at,
                format!("this adapter can't render to {format}"),
                "choose another format, or name one with .fallback; `rgba16float` and \
                 `rgba8unorm` work everywhere"
                    .to_owned(),
            );
        }
        if stored && !self.support.storable(format) {
            self.report(
                &target.at,
                format!("shaders can't write {format} as a storage texture on this adapter"),
                "`rgba16float`, `rgba8unorm`, `r32float` and `r32uint` work everywhere".to_owned(),
            );
        }
        if target.samples > 1 && !self.support.multisampled(format) {
            self.report(
                &target.at,
                format!(
                    "this adapter has no {format} with {} samples",
                    target.samples
                ),
                "drop .samples, or choose `rgba16float` or `rgba8unorm`".to_owned(),
            );
        }
    }

    /// Layers, mips and samples go together.
    fn shape(&mut self, target: &TargetDesc) {
        let name = &target.name;
        if target.samples > 1 && (target.shape != Shape::Flat || target.mips != Mips::Count(1)) {
            self.report(
                &target.at,
                format!("`{name}` can't have several samples and layers or mips"),
                "drop .samples, or .array, .cube, .volume and .mips".to_owned(),
            );
        }
        let square = matches!(target.size, TargetSize::Absolute(width, height) if width == height);
        if target.shape == Shape::Cube && !square {
            self.report(
                &target.at,
                format!("the sides of the cube `{name}` are not square"),
                "give it a fixed size, as in .size(512, 512)".to_owned(),
            );
        }
        if matches!(target.shape, Shape::Volume(_)) && target.format.is_depth() {
            self.report(
                &target.at,
                format!(
                    "`{name}` holds depth ({}), which can't be 3D",
                    target.format
                ),
                "use .array(layers)".to_owned(),
            );
        }
    }

    /// The device has textures of that size. What depends on the output is seen when it is known.
    fn extent(&mut self, target: &TargetDesc) {
        let limits = self.support.limits();
        let (layers, what, most_layers) = match target.shape {
            Shape::Volume(slices) => (slices, "slices", limits.max_texture_dimension_3d),
            shape => (shape.layers(), "layers", limits.max_texture_array_layers),
        };
        if layers > most_layers {
            self.report(
                &target.at,
                format!(
                    "`{}` has {layers} {what}; this adapter allows {most_layers}",
                    target.name
                ),
                "use several targets".to_owned(),
            );
        }
        let TargetSize::Absolute(width, height) = target.size else {
            return;
        };
        let most = target.most_texels_along(&limits);
        if width.max(height) > most {
            self.report(
                &target.at,
                format!(
                    "`{}` is {width} × {height} texels; this adapter allows {most} along each axis",
                    target.name
                ),
                "make it smaller".to_owned(),
            );
            return;
        }
        let bytes = u64::from(width)
            * u64::from(height)
            * u64::from(layers)
            * u64::from(target.samples)
            * u64::from(target.format.bytes_per_texel());
        if bytes > MOST_BYTES {
            self.report(
                &target.at,
                format!(
                    "`{}` takes {:.1} GiB",
                    target.name,
                    bytes as f64 / (1_u64 << 30) as f64
                ),
                "make it smaller: a target may take 4 GiB".to_owned(),
            );
        }
    }

    pub(super) fn buffers(&mut self) {
        let desc = self.desc;
        for buffer in &desc.buffers {
            if let BufferSize::Words(words) = buffer.size
                && u64::from(words) * 4 > self.support.buffer_bytes()
            {
                let most = self.support.buffer_bytes() / 4;
                self.report(
                    &buffer.at,
                    format!(
                        "`{}` has {words} words; this adapter binds {most}",
                        buffer.name
                    ),
                    "make it smaller, or use two".to_owned(),
                );
            }
            if let Some(counter) = &buffer.grows_with
                && !desc.counters.iter().any(|c| c.name == counter.name)
            {
                let names = desc.counters.iter().map(|counter| counter.name.as_str());
                let hint = suggestion(&counter.name, names).unwrap_or_else(|| {
                    "declare it: p.counter(name, buffer, word, description)".to_owned()
                });
                let message = format!("there is no counter `{}`", counter.name);
                self.report(&counter.at, message, hint);
            }
        }
        self.counters();
    }

    fn counters(&mut self) {
        let desc = self.desc;
        for counter in &desc.counters {
            let Some(buffer) = desc.buffer(&counter.buffer) else {
                let names = || desc.buffers.iter().map(|buffer| buffer.name.as_str());
                let hint = suggestion(&counter.buffer, names())
                    .unwrap_or_else(|| "declare it: p.buffer(name, words)".to_owned());
                self.meant.extend(nearest(&counter.buffer, names()));
                let message = format!("there is no buffer `{}`", counter.buffer);
                self.report(&counter.at, message, hint);
                continue;
            };
            let words = buffer.size.least_words();
            if u64::from(counter.word) >= words {
                let has = match buffer.size {
                    BufferSize::Words(_) => format!("has {words} words"),
                    _ => format!("may have {words} words only"),
                };
                self.report(
                    &counter.at,
                    format!(
                        "the counter `{}` is word {}, but `{}` {has}",
                        counter.name, counter.word, buffer.name
                    ),
                    "words are counted from 0".to_owned(),
                );
            }
        }
        let most = crate::queries::MAX_COUNTERS;
        if let Some(counter) = desc.counters.get(most) {
            self.report(
                &counter.at,
                format!("a pipeline has at most {most} counters"),
                "remove some".to_owned(),
            );
        }
    }
}
