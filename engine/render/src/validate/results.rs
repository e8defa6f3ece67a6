//! The pipeline ends in a picture.

use super::{Checker, FormatSupport};
use crate::description::{Named, Shape, TargetSize};
use crate::format::Format;
use crate::life;

impl<S: FormatSupport> Checker<'_, S> {
    /// The pipeline ends in a picture.
    pub(super) fn results(&mut self) {
        let desc = self.desc;
        match &desc.output {
            None => self.report(
                &desc.file,
                "the pipeline shows nothing".to_owned(),
                "end with `output::add(p, \"hdr\")` of parts/output, or with p.show(\"output\"), \
                 naming an `rgba8unorm` target"
                    .to_owned(),
            ),
            Some(output) => self.result(output, "`rgba8unorm`", |f| {
                f.0 == wgpu::TextureFormat::Rgba8Unorm
            }),
        }
        if let Some(hdr) = &desc.hdr {
            self.result(hdr, "`rgba16float` or `rgba32float`", |f| {
                matches!(
                    f.0,
                    wgpu::TextureFormat::Rgba16Float | wgpu::TextureFormat::Rgba32Float
                )
            });
        }
    }

    fn result(&mut self, result: &Named, wanted: &str, fits: impl Fn(Format) -> bool) {
        let Some(target) = self.target(&result.name, &result.at) else {
            return;
        };
        let (format, size) = (target.format, target.size);
        if target.shape != Shape::Flat || target.samples != 1 {
            self.report(
                &result.at,
                format!(
                    "`{}` is {}: what is shown is flat, with one sample a texel",
                    result.name,
                    target.in_words()
                ),
                "copy or resolve it to a flat target first".to_owned(),
            );
        }
        if !fits(format) {
            self.report(
                &result.at,
                format!("`{}` is {format}; here it must be {wanted}", result.name),
                format!("draw it to a target of the format {wanted} in a last pass"),
            );
        }
        if size != TargetSize::Relative(1.0) {
            self.report(
                &result.at,
                format!("`{}` must have the output's size", result.name),
                "drop .size, .scale or .per_tile, or draw it to a target without them".to_owned(),
            );
        }
        let mut passes = self.desc.passes.iter();
        let written = passes.any(|pass| life::writes(pass).any(|name| name == result.name));
        let told = self.unwritten.contains(target.name.as_str());
        if !written && !told && !self.meant.contains(target.name.as_str()) {
            self.report(
                &result.at,
                format!("no pass writes `{}`", result.name),
                format!("add .writes(\"{}\") to the pass that makes it", result.name),
            );
        }
    }
}
