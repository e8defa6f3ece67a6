//! The views that a pass draws to, made once for the targets of a size.

use crate::description::{PassDesc, PassKind, Slice};
use crate::targets::Targets;

/// Views of a pass's attachments, in the order of the description.
#[derive(Debug, Default)]
pub struct Attachments {
    /// Each colour target, and what takes the mean of its samples.
    pub colors: Vec<(wgpu::TextureView, Option<wgpu::TextureView>)>,
    /// The depth target.
    pub depth: Option<wgpu::TextureView>,
    /// Every slice of every target that a `clear` pass fills: the index of its declaration, the
    /// view, and for 3D targets which slice of the view.
    pub slices: Vec<(usize, wgpu::TextureView, Option<u32>)>,
    /// The layers of the depth target that a `clear` pass fills and a `shadow` pass draws to.
    pub layers: Vec<wgpu::TextureView>,
    /// For 3D targets, which slice of the view each colour target is.
    pub depth_slices: Vec<Option<u32>>,
}

impl Attachments {
    /// Makes the views.
    pub fn new(pass: &PassDesc, targets: &Targets) -> Self {
        let mut this = Self::default();
        let (from, to) = match &pass.kind {
            PassKind::Resolve { from, to } => (targets.get(&from.target), targets.get(&to.target)),
            _ => (None, None),
        };
        if let (Some(from), Some(to)) = (from, to) {
            let whole = Slice::default();
            this.colors
                .push((from.attachment(whole), Some(to.attachment(whole))));
            this.depth_slices.push(None);
        }
        for (index, color) in pass.colors.iter().enumerate() {
            let Some(target) = targets.get(&color.target) else {
                continue;
            };
            let resolve = color.resolve.as_ref();
            let resolve = resolve.and_then(|named| targets.get(&named.name));
            let volume = target.texture.dimension() == wgpu::TextureDimension::D3;
            this.depth_slices.push(volume.then_some(color.slice.layer));
            this.colors.push((
                target.attachment(color.slice),
                resolve.map(|target| target.attachment(Slice::default())),
            ));
            if pass.kind == PassKind::Clear {
                for mip in 0..target.texture.mip_level_count() {
                    let layers = target.layers_of_mip(mip);
                    this.slices.extend((0..layers).map(|layer| {
                        let view = target.attachment(Slice { mip, layer });
                        (index, view, volume.then_some(layer))
                    }));
                }
            }
        }
        if let Some((depth, target)) = pass
            .depth
            .as_ref()
            .and_then(|depth| Some((depth, targets.get(&depth.target)?)))
        {
            this.depth = Some(target.attachment(depth.slice));
            let layered = matches!(pass.kind, PassKind::Clear | PassKind::Shadow(_));
            let layers = if layered { target.shape.layers() } else { 0 };
            this.layers = (0..layers)
                .map(|layer| target.attachment(Slice { mip: 0, layer }))
                .collect();
        }
        this
    }

    /// Render passes that a `clear` pass takes.
    pub fn clears(&self) -> usize {
        self.slices.len() + self.layers.len()
    }
}
