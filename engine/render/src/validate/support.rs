//! What the adapter says about formats and sizes; all that validation asks of the device.

use wgpu::{TextureFormatFeatureFlags as Flags, TextureUsages as Usages};

use crate::format::Format;
use crate::gpu::Gpu;

/// What a device can do with formats.
pub trait FormatSupport {
    /// Whether targets of this format can be rendered to.
    fn renderable(&self, format: Format) -> bool;
    /// Whether colour targets of this format can blend.
    fn blendable(&self, format: Format) -> bool;
    /// Whether shaders can write targets of this format without the rasteriser.
    fn storable(&self, format: Format) -> bool;
    /// Whether targets of this format can have several samples a texel.
    fn multisampled(&self, format: Format) -> bool;
    /// Whether the mean of several samples can be taken.
    fn resolvable(&self, format: Format) -> bool;
    /// The most bytes a pixel that the colour targets of one pass may have together.
    fn color_bytes(&self) -> u32;
    /// The most bytes that a buffer may have.
    fn buffer_bytes(&self) -> u64;
}

impl Gpu {
    fn usable(&self, format: Format, usage: Usages) -> bool {
        self.format_features(format.0)
            .is_some_and(|features| features.allowed_usages.contains(usage))
    }

    fn flagged(&self, format: Format, flag: Flags) -> bool {
        self.format_features(format.0)
            .is_some_and(|features| features.flags.contains(flag))
    }
}

impl FormatSupport for Gpu {
    fn renderable(&self, format: Format) -> bool {
        self.usable(format, Usages::RENDER_ATTACHMENT)
    }

    fn blendable(&self, format: Format) -> bool {
        self.flagged(format, Flags::BLENDABLE)
    }

    fn storable(&self, format: Format) -> bool {
        self.usable(format, Usages::STORAGE_BINDING)
    }

    fn multisampled(&self, format: Format) -> bool {
        self.flagged(format, Flags::MULTISAMPLE_X4)
    }

    fn resolvable(&self, format: Format) -> bool {
        self.flagged(format, Flags::MULTISAMPLE_RESOLVE)
    }

    fn color_bytes(&self) -> u32 {
        self.device.limits().max_color_attachment_bytes_per_sample
    }

    fn buffer_bytes(&self) -> u64 {
        let limits = self.device.limits();
        limits
            .max_buffer_size
            .min(limits.max_storage_buffer_binding_size)
    }
}
