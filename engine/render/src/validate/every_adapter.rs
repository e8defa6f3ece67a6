//! An adapter for checks without one.

use wgpu::StorageTextureAccess;

use super::FormatSupport;
use crate::format::Format;
use crate::reflection::SampleKind;

/// What a description is checked against where no adapter is asked: all formats can be drawn to,
/// and the limits are those of WebGPU ("WebGPU", W3C, section 3.6.2).
pub struct EveryAdapter;

impl FormatSupport for EveryAdapter {
    fn renderable(&self, _: Format) -> bool {
        true
    }

    fn blendable(&self, format: Format) -> bool {
        SampleKind::of_format(format.0) == SampleKind::Float
    }

    fn storable(&self, format: Format) -> bool {
        !format.is_depth()
    }

    fn storable_as(&self, format: Format, _: StorageTextureAccess) -> bool {
        self.storable(format)
    }

    fn filterable(&self, format: Format) -> bool {
        SampleKind::of_format(format.0) == SampleKind::Float
    }

    fn multisampled(&self, format: Format) -> bool {
        matches!(
            SampleKind::of_format(format.0),
            SampleKind::Float | SampleKind::Depth
        )
    }

    fn resolvable(&self, format: Format) -> bool {
        SampleKind::of_format(format.0) == SampleKind::Float
    }

    fn limits(&self) -> wgpu::Limits {
        wgpu::Limits::default()
    }
}
