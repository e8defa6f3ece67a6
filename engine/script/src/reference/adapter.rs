//! An adapter for checks without one.

use lightbench_render::Format;
use lightbench_render::reflection::SampleKind;
use lightbench_render::validate::FormatSupport;

/// What a description is checked against where no adapter is asked: all formats can be drawn to,
/// and the limits are those of WebGPU ("WebGPU", W3C, section 3.6.2).
pub(super) struct EveryAdapter;

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

    fn multisampled(&self, format: Format) -> bool {
        matches!(
            SampleKind::of_format(format.0),
            SampleKind::Float | SampleKind::Depth
        )
    }

    fn resolvable(&self, format: Format) -> bool {
        SampleKind::of_format(format.0) == SampleKind::Float
    }

    fn color_bytes(&self) -> u32 {
        32
    }

    fn buffer_bytes(&self) -> u64 {
        128 << 20
    }
}
