//! Passes that move what targets hold: copy, history, resolve, mips.

use super::{Checker, FormatSupport};
use crate::description::{
    Mips, PassDesc, PassKind, Read, Reduction, Shape, TargetDesc, TargetSize,
};
use crate::reflection::SampleKind;

/// The largest output for which it is tried whether copies fit.
const LARGEST: u32 = 8192;

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn copy(&mut self, pass: &PassDesc, from: &Read, to: &Read) {
        let desc = self.desc;
        if !self.known(&from.target, &from.at) || !self.known(&to.target, &to.at) {
            return;
        }
        if from.target == to.target && (from.mip, from.layer) == (to.mip, to.layer) {
            self.report(
                &from.at,
                format!("`{}` copies `{}` to itself", pass.name, from.target),
                "name another target".to_owned(),
            );
            return;
        }
        let slices = from.mip.is_some() || to.mip.is_some();
        if let (Some(a), Some(b)) = (desc.buffer(&from.target), desc.buffer(&to.target)) {
            if slices {
                self.report(
                    &from.at,
                    format!(
                        "the buffers `{}` and `{}` have no mip levels",
                        a.name, b.name
                    ),
                    "copy them as a whole: p.copy(name, from, to)".to_owned(),
                );
            } else if a.size != b.size {
                let message = format!("`{}` and `{}` differ in size", a.name, b.name);
                self.report(&from.at, message, "give them the same words".to_owned());
            }
            return;
        }
        let (Some(a), Some(b)) = (desc.target(&from.target), desc.target(&to.target)) else {
            self.report(
                &from.at,
                format!(
                    "of `{}` and `{}` one is a target, one a buffer",
                    from.target, to.target
                ),
                "copy between two targets or two buffers".to_owned(),
            );
            return;
        };
        let difference = if a.format != b.format {
            Some(format!("{} is not {}", a.format, b.format))
        } else if a.samples != b.samples {
            Some("they differ in samples".to_owned())
        } else if !slices && a.size != b.size {
            Some("they differ in size".to_owned())
        } else if !slices && a.shape != b.shape {
            Some(format!(
                "{} is not {}",
                a.shape.in_words(),
                b.shape.in_words()
            ))
        } else {
            None
        };
        if let Some(difference) = difference {
            self.report(
                &from.at,
                format!("`{}` can't be copied to `{}`: {difference}", a.name, b.name),
                "give them the same format, size, shape and samples, or use a fullscreen pass"
                    .to_owned(),
            );
            return;
        }
        if a.samples > 1 {
            self.report(
                &from.at,
                format!(
                    "`{}` has several samples a texel, which can't be copied",
                    a.name
                ),
                "take their mean first: p.resolve(name, from, to)".to_owned(),
            );
            return;
        }
        for read in [from, to] {
            let (mip, layer) = (read.mip.unwrap_or(0), read.layer.unwrap_or(0));
            self.in_range(&read.target, &read.at, mip, layer);
        }
        if slices && !slice_fits((a, from.mip.unwrap_or(0)), (b, to.mip.unwrap_or(0))) {
            self.report(
                &from.at,
                format!(
                    "mip level {} of `{}` does not always fit into level {} of `{}`",
                    from.mip.unwrap_or(0),
                    a.name,
                    to.mip.unwrap_or(0),
                    b.name
                ),
                "choose levels of the same size".to_owned(),
            );
        }
        let history = matches!(pass.kind, PassKind::History { .. });
        let written = desc.passes.iter().any(|other| {
            other.name != pass.name && crate::life::writes(other).any(|name| name == to.target)
        });
        if history && written {
            self.report(
                &to.at,
                format!(
                    "`{}` holds the last frame, but another pass writes it too",
                    to.target
                ),
                "let the other pass write another target".to_owned(),
            );
        }
    }

    pub(super) fn resolve(&mut self, from: &Read, to: &Read) {
        let (a, b) = (
            self.target(&from.target, &from.at),
            self.target(&to.target, &to.at),
        );
        if let (Some(a), Some(b)) = (a, b) {
            self.mean(
                a,
                &from.at,
                b,
                &to.at,
                "declare it with .samples(4), or use p.copy",
            );
        }
    }

    /// One target takes the mean of another's samples.
    pub(super) fn mean(
        &mut self,
        from: &TargetDesc,
        from_at: &crate::Place,
        to: &TargetDesc,
        to_at: &crate::Place,
        without_samples: &str,
    ) {
        if from.samples == 1 {
            self.report(
                from_at,
                format!(
                    "`{}` has one sample a texel: there is nothing to resolve",
                    from.name
                ),
                without_samples.to_owned(),
            );
        } else if to.samples != 1
            || to.format != from.format
            || to.size != from.size
            || to.shape != Shape::Flat
        {
            self.report(
                to_at,
                format!(
                    "`{}` can't take the mean of `{}`: they are not alike",
                    to.name, from.name
                ),
                "give it the same format and size, and one sample a texel".to_owned(),
            );
        } else if !self.support.resolvable(from.format) {
            self.report(
                from_at,
                format!("samples of {} have no mean on this adapter", from.format),
                "read the samples in a shader, with textureLoad".to_owned(),
            );
        }
    }

    pub(super) fn mips(&mut self, read: &Read, reduction: Reduction) {
        let Some(target) = self.target(&read.target, &read.at) else {
            return;
        };
        let name = &target.name;
        let kind = SampleKind::of_format(target.format.0);
        if target.mips == Mips::Count(1) {
            self.report(
                &read.at,
                format!("`{name}` has one mip level only"),
                "declare it with .mips()".to_owned(),
            );
        }
        if kind == SampleKind::Depth || matches!(target.shape, Shape::Volume(_)) {
            self.report(
                &read.at,
                format!("a `mips` pass can't fill `{name}`, which is depth or 3D"),
                "copy depth to an `r32float` target in a fullscreen pass first".to_owned(),
            );
        }
        if reduction == Reduction::Average && matches!(kind, SampleKind::Uint | SampleKind::Sint) {
            self.report(
                &read.at,
                format!("`{name}` is {}: integers have no average", target.format),
                "use `min` or `max`".to_owned(),
            );
        }
    }
}

/// Whether a mip level is never larger than another, whatever the output. Depth is copied as a
/// whole, so there it must be as large.
fn slice_fits((from, from_mip): (&TargetDesc, u32), (to, to_mip): (&TargetDesc, u32)) -> bool {
    if (from.size, from_mip) == (to.size, to_mip) {
        return true;
    }
    // Of a fixed size and one that follows the output, `room` looks when it knows the output.
    let is_fixed = |size: TargetSize| matches!(size, TargetSize::Absolute(..));
    if is_fixed(from.size) != is_fixed(to.size) {
        return true;
    }
    let fits = |length: u32| {
        let side = |size: TargetSize, mip: u32| {
            let (width, height) = size.resolve(length, length);
            [(width >> mip).max(1), (height >> mip).max(1)]
        };
        let (from_sides, to_sides) = (side(from.size, from_mip), side(to.size, to_mip));
        let whole = from.format.is_depth();
        let mut pairs = from_sides.into_iter().zip(to_sides);
        pairs.all(|(from, to)| if whole { from == to } else { from <= to })
    };
    (1..=LARGEST).all(fits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, Place};

    #[test]
    fn slices_fit_for_every_output_or_not() {
        let target = |size| TargetDesc {
            size,
            ..TargetDesc::new(
                "x",
                Place::default(),
                Format(wgpu::TextureFormat::Rgba16Float),
            )
        };
        let fits = |from: TargetSize, from_mip, to: TargetSize, to_mip| {
            slice_fits((&target(from), from_mip), (&target(to), to_mip))
        };
        use TargetSize::{Absolute, Relative};
        assert!(fits(Relative(1.0), 2, Relative(1.0), 2));
        // 319 texels do not fit into 318.
        assert!(fits(Relative(1.0), 1, Relative(0.5), 0));
        assert!(!fits(Relative(0.5), 0, Relative(1.0), 1));
        assert!(!fits(Relative(1.0), 0, Relative(1.0), 1));
        assert!(fits(Absolute(64, 32), 1, Absolute(32, 16), 0));
        assert!(!fits(Absolute(64, 32), 0, Absolute(32, 16), 0));
        assert!(fits(Relative(1.0), 0, Absolute(4096, 4096), 0));
    }
}
