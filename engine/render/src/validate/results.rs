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
                "end with p.show(\"output\"), naming an `rgba8unorm` target".to_owned(),
            ),
            Some(output) => self.result(output, "rgba8unorm", |f| {
                f.0 == wgpu::TextureFormat::Rgba8Unorm
            }),
        }
        if let Some(hdr) = &desc.hdr {
            self.result(hdr, "rgba16float or rgba32float", |f| {
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
                format!("`{}` must be flat, with one sample a texel", result.name),
                None,
            );
        }
        if !fits(format) {
            self.report(
                &result.at,
                format!("`{}` is {format}; here it must be {wanted}", result.name),
                None,
            );
        }
        if size != TargetSize::Relative(1.0) {
            self.report(
                &result.at,
                format!("`{}` must have the output's size", result.name),
                None,
            );
        }
        if !self
            .desc
            .passes
            .iter()
            .any(|pass| life::writes(pass).any(|name| name == result.name))
        {
            self.report(
                &result.at,
                format!("no pass writes `{}`", result.name),
                None,
            );
        }
    }
}
