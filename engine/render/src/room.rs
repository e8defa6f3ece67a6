//! Whether a pipeline can be drawn at an output size: what its description alone can't tell.

use crate::description::{Mips, PassDesc, PassKind, PipelineDesc, Slice, TargetDesc};

/// Checks targets and buffers for an output of `size` pixels and a scene of that many lights.
///
/// # Errors
/// A sentence that names what does not fit.
pub fn check_room(
    desc: &PipelineDesc,
    limits: &wgpu::Limits,
    size: (u32, u32),
    lights: u32,
) -> Result<(), String> {
    let output = format!("{} × {} pixels", size.0, size.1);
    for target in &desc.targets {
        let (width, height) = target.size.resolve(size.0, size.1);
        let most = target.most_texels_along(limits);
        if width.max(height) > most {
            return Err(format!(
                "with {output}, the target `{}` ({}) would have {width} × {height} texels; this \
                 adapter allows {most} along each axis",
                target.name, target.at
            ));
        }
    }
    let most = limits
        .max_buffer_size
        .min(limits.max_storage_buffer_binding_size);
    for buffer in &desc.buffers {
        let bytes = buffer.size.resolve(size, lights).saturating_mul(4);
        if bytes > most {
            return Err(format!(
                "with {output} and {lights} lights, the buffer `{}` ({}) would have {} MiB; this \
                 adapter allows {}",
                buffer.name,
                buffer.at,
                bytes >> 20,
                most >> 20
            ));
        }
    }
    for pass in &desc.passes {
        if let PassKind::Copy { from, to } = &pass.kind
            && let (Some(a), Some(b)) = (desc.target(&from.target), desc.target(&to.target))
        {
            let from = level_size(a, from.mip.unwrap_or(0), size);
            let to = level_size(b, to.mip.unwrap_or(0), size);
            let whole = a.format.is_depth() && from != to;
            if from.0 > to.0 || from.1 > to.1 || whole {
                return Err(format!(
                    "with {output}, the pass `{}` ({}) copies {} × {} texels of `{}` to {} × {} of \
                     `{}`, where they do not fit",
                    pass.name, pass.at, from.0, from.1, a.name, to.0, to.1, b.name
                ));
            }
        }
        for (name, mip) in levels(pass) {
            let Some(target) = desc.target(name) else {
                continue;
            };
            let has = mip_levels(target, size);
            if mip >= has {
                return Err(format!(
                    "with {output}, `{name}` has {has} mip levels, and the pass `{}` ({}) uses \
                     level {mip}",
                    pass.name, pass.at
                ));
            }
        }
    }
    Ok(())
}

fn mip_levels(target: &TargetDesc, size: (u32, u32)) -> u32 {
    if target.mips == Mips::Count(1) {
        return 1;
    }
    let (width, height) = target.size.resolve(size.0, size.1);
    let depth = match target.shape {
        crate::description::Shape::Volume(slices) => slices,
        _ => 1,
    };
    target.mips.resolve(width, height, depth)
}

/// Width and height of a mip level.
fn level_size(target: &TargetDesc, mip: u32, output: (u32, u32)) -> (u32, u32) {
    let (width, height) = target.size.resolve(output.0, output.1);
    let side = |side: u32| side.checked_shr(mip).unwrap_or(0).max(1);
    (side(width), side(height))
}

/// The mip levels that a pass names.
fn levels(pass: &PassDesc) -> impl Iterator<Item = (&str, u32)> {
    let slice = |name, slice: Slice| (name, slice.mip);
    let colors = pass.colors.iter();
    let depth = pass.depth.iter();
    let transfers = match &pass.kind {
        PassKind::Copy { from, to } => [Some(from), Some(to)],
        _ => [None, None],
    };
    let reads = pass.reads.iter().chain(transfers.into_iter().flatten());
    colors
        .map(move |color| slice(color.target.as_str(), color.slice))
        .chain(depth.map(move |depth| slice(depth.target.as_str(), depth.slice)))
        .chain(reads.map(|read| (read.target.as_str(), read.mip.unwrap_or(0))))
        .chain(
            pass.updates
                .iter()
                .map(move |update| slice(update.target.as_str(), update.slice)),
        )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::description::{BufferDesc, BufferSize, Read, TargetSize};
    use crate::{Format, Place};

    #[test]
    fn a_slice_fits_where_it_is_copied_to_or_is_refused() {
        let at = Place::new("a.rhai", 3, 1);
        let target = |name: &str, size| TargetDesc {
            mips: Mips::All,
            size,
            ..TargetDesc::new(name, at.clone(), Format(wgpu::TextureFormat::Rgba16Float))
        };
        let copy = PassKind::Copy {
            from: Read {
                mip: Some(1),
                ..Read::new("chain", at.clone())
            },
            to: Read {
                mip: Some(0),
                ..Read::new("small", at.clone())
            },
        };
        let desc = PipelineDesc {
            targets: vec![
                target("chain", TargetSize::Relative(1.0)),
                target("small", TargetSize::Absolute(2, 1)),
            ],
            passes: vec![PassDesc::new("take", at.clone(), copy)],
            ..PipelineDesc::default()
        };
        let check = |size| check_room(&desc, &wgpu::Limits::default(), size, 1);
        assert_eq!(check((5, 3)), Ok(()));
        let error = check((6, 3)).unwrap_err();
        assert!(
            error.contains("3 × 1 texels of `chain` to 2 × 1"),
            "{error}"
        );
    }

    #[test]
    fn what_depends_on_the_output_is_checked_for_it() {
        let at = Place::new("a.rhai", 3, 1);
        let format = Format(wgpu::TextureFormat::Rgba16Float);
        let pass = PassDesc {
            reads: vec![Read {
                mip: Some(2),
                ..Read::new("chain", at.clone())
            }],
            ..PassDesc::new("blur", at.clone(), PassKind::Fullscreen)
        };
        let desc = PipelineDesc {
            targets: vec![
                TargetDesc {
                    mips: Mips::All,
                    ..TargetDesc::new("chain", at.clone(), format)
                },
                TargetDesc {
                    size: TargetSize::Relative(4.0),
                    ..TargetDesc::new("fine", at.clone(), format)
                },
            ],
            buffers: vec![BufferDesc {
                name: "lists".into(),
                at: at.clone(),
                size: BufferSize::PerPixel(64),
                grows_with: None,
            }],
            passes: vec![pass],
            ..PipelineDesc::default()
        };
        let limits = wgpu::Limits::default();
        let check = |size| check_room(&desc, &limits, size, 1);
        assert_eq!(check((640, 360)), Ok(()));
        assert_eq!(check((4, 1)), Ok(()));
        for (size, part) in [
            (
                (3, 3),
                "`chain` has 2 mip levels, and the pass `blur` (a.rhai:3:1) uses level 2",
            ),
            ((2049, 4), "`fine` (a.rhai:3:1) would have 8196 × 16 texels"),
            (
                (1024, 1024),
                "`lists` (a.rhai:3:1) would have 256 MiB; this adapter allows 128",
            ),
        ] {
            let error = check(size).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
    }
}
