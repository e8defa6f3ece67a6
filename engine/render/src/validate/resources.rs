//! Targets and buffers by themselves.

use super::{Checker, FormatSupport};
use crate::description::{BufferSize, Mips, Shape, TargetDesc, TargetSize};
use crate::life;
use crate::problem::suggestion;

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn targets(&mut self) {
        let desc = self.desc;
        for target in &desc.targets {
            self.format(target);
            self.shape(target);
            let used = desc.passes.iter().any(|pass| {
                life::writes(pass)
                    .chain(life::reads(pass))
                    .any(|name| name == target.name)
            });
            if !used {
                self.report(
                    &target.at,
                    format!("no pass uses the target `{}`", target.name),
                    "write it in a pass, or remove it".to_owned(),
                );
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

    /// Size, layers, mips and samples go together.
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

    pub(super) fn buffers(&mut self) {
        let desc = self.desc;
        for buffer in &desc.buffers {
            let passes = desc.passes.iter();
            let written = passes
                .clone()
                .any(|pass| life::writes(pass).any(|name| name == buffer.name));
            let read = passes
                .clone()
                .any(|pass| life::reads(pass).any(|name| name == buffer.name));
            if !written {
                let hint = if read {
                    "add .updates to the pass that fills it"
                } else {
                    "use it in a pass, or remove it"
                };
                let message = format!("no pass writes the buffer `{}`", buffer.name);
                self.report(&buffer.at, message, hint.to_owned());
            }
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
                let names = desc.buffers.iter().map(|buffer| buffer.name.as_str());
                let hint = suggestion(&counter.buffer, names)
                    .unwrap_or_else(|| "declare it: p.buffer(name, words)".to_owned());
                let message = format!("there is no buffer `{}`", counter.buffer);
                self.report(&counter.at, message, hint);
                continue;
            };
            if let BufferSize::Words(words) = buffer.size
                && counter.word >= words
            {
                self.report(
                    &counter.at,
                    format!(
                        "the counter `{}` is word {}, but `{}` has {words} words",
                        counter.name, counter.word, buffer.name
                    ),
                    "words are counted from 0".to_owned(),
                );
            }
        }
        if let Some(counter) = desc.counters.get(crate::queries::MAX_COUNTERS) {
            self.report(
                &counter.at,
                format!(
                    "a pipeline has at most {} counters",
                    crate::queries::MAX_COUNTERS
                ),
                None,
            );
        }
    }
}
