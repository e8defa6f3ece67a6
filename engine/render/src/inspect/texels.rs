//! How a shader sees one slice of a target: what `shaders/lib/inspected.wgsl` must be told.

use lightbench_assets::files::Files;

use super::screen;
use crate::description::{Define, Slice};
use crate::gpu::Gpu;
use crate::problem::Problem;
use crate::reflection::SampleKind;
use crate::targets::Target;

/// The binding of the target.
pub(super) const BINDING: u32 = 1;

/// Which part of a target's texels is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Aspect {
    /// Colours, or depth.
    #[default]
    Main,
    /// The stencil beside depth.
    Stencil,
}

/// Names what is not the first or only one of its kind, as in ` mip 1 layer 2`.
pub fn part_in_words(slice: Slice, sample: Option<u32>, aspect: Aspect) -> String {
    let mut words = String::new();
    for (name, number) in [("mip", slice.mip), ("layer", slice.layer)] {
        if number > 0 {
            words.push_str(&format!(" {name} {number}"));
        }
    }
    if let Some(sample) = sample {
        words.push_str(&format!(" sample {sample}"));
    }
    if aspect == Aspect::Stencil {
        words.push_str(" stencil");
    }
    words
}

/// What the texels of a slice are, and how they are arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Texels {
    pub kind: SampleKind,
    arranged: Arranged,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Arranged {
    Flat,
    Volume,
    Samples,
}

impl Texels {
    pub fn of(target: &Target, aspect: Aspect) -> Self {
        let texture = &target.texture;
        let arranged = if texture.sample_count() > 1 {
            Arranged::Samples
        } else if texture.dimension() == wgpu::TextureDimension::D3 {
            Arranged::Volume
        } else {
            Arranged::Flat
        };
        let kind = match aspect {
            Aspect::Main => SampleKind::of_format(texture.format()),
            Aspect::Stencil => SampleKind::Uint,
        };
        Self { kind, arranged }
    }

    fn defines(self) -> Vec<Define> {
        let kind = match self.kind {
            SampleKind::Float => "FLOAT",
            SampleKind::Uint => "UNSIGNED",
            SampleKind::Sint => "SIGNED",
            SampleKind::Depth => "DEPTH",
        };
        let arranged = match self.arranged {
            Arranged::Flat => None,
            Arranged::Volume => Some("VOLUME"),
            Arranged::Samples => Some("SAMPLES"),
        };
        let names = std::iter::once(kind).chain(arranged);
        names.map(Define::flag).collect()
    }

    /// The entry of the target in a bind group layout.
    pub fn layout(self, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
        wgpu::BindGroupLayoutEntry {
            binding: BINDING,
            visibility,
            ty: wgpu::BindingType::Texture {
                sample_type: match self.kind {
                    SampleKind::Float => wgpu::TextureSampleType::Float { filterable: false },
                    SampleKind::Uint => wgpu::TextureSampleType::Uint,
                    SampleKind::Sint => wgpu::TextureSampleType::Sint,
                    SampleKind::Depth => wgpu::TextureSampleType::Depth,
                },
                view_dimension: match self.arranged {
                    Arranged::Volume => wgpu::TextureViewDimension::D3,
                    _ => wgpu::TextureViewDimension::D2,
                },
                multisampled: self.arranged == Arranged::Samples,
            },
            count: None,
        }
    }

    /// A view of one slice of a target; of a volume, of all slices of the mip level.
    pub fn view(self, target: &Target, slice: Slice, aspect: Aspect) -> wgpu::TextureView {
        let volume = self.arranged == Arranged::Volume;
        let format = target.texture.format();
        target.texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some("inspected"),
            dimension: Some(if volume {
                wgpu::TextureViewDimension::D3
            } else {
                wgpu::TextureViewDimension::D2
            }),
            aspect: match aspect {
                Aspect::Stencil => wgpu::TextureAspect::StencilOnly,
                Aspect::Main if format.has_depth_aspect() => wgpu::TextureAspect::DepthOnly,
                Aspect::Main => wgpu::TextureAspect::All,
            },
            base_mip_level: slice.mip,
            mip_level_count: Some(1),
            base_array_layer: if volume { 0 } else { slice.layer },
            array_layer_count: (!volume).then_some(1),
            ..Default::default()
        })
    }

    /// Composes a shader for such texels.
    pub fn module(
        self,
        gpu: &Gpu,
        files: &Files,
        path: &str,
    ) -> Result<wgpu::ShaderModule, Problem> {
        screen::module(gpu, files, path, &self.defines())
    }
}
