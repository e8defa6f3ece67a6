//! Texel formats by the names that WebGPU gives them.

use wgpu::TextureFormat;

/// The format of a target. Written in pipeline files by its WebGPU name, as in `rgba16float`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Format(pub TextureFormat);

/// Every format that a target may have.
const FORMATS: [TextureFormat; 47] = [
    TextureFormat::R8Unorm,
    TextureFormat::R8Snorm,
    TextureFormat::R8Uint,
    TextureFormat::R8Sint,
    TextureFormat::Rg8Unorm,
    TextureFormat::Rg8Snorm,
    TextureFormat::Rg8Uint,
    TextureFormat::Rg8Sint,
    TextureFormat::Rgba8Unorm,
    TextureFormat::Rgba8UnormSrgb,
    TextureFormat::Rgba8Snorm,
    TextureFormat::Rgba8Uint,
    TextureFormat::Rgba8Sint,
    TextureFormat::Bgra8Unorm,
    TextureFormat::Bgra8UnormSrgb,
    TextureFormat::Rgb10a2Unorm,
    TextureFormat::Rgb10a2Uint,
    TextureFormat::Rg11b10Ufloat,
    TextureFormat::R16Unorm,
    TextureFormat::R16Snorm,
    TextureFormat::R16Uint,
    TextureFormat::R16Sint,
    TextureFormat::R16Float,
    TextureFormat::Rg16Unorm,
    TextureFormat::Rg16Snorm,
    TextureFormat::Rg16Uint,
    TextureFormat::Rg16Sint,
    TextureFormat::Rg16Float,
    TextureFormat::Rgba16Unorm,
    TextureFormat::Rgba16Snorm,
    TextureFormat::Rgba16Uint,
    TextureFormat::Rgba16Sint,
    TextureFormat::Rgba16Float,
    TextureFormat::R32Uint,
    TextureFormat::R32Float,
    TextureFormat::R32Sint,
    TextureFormat::Rg32Uint,
    TextureFormat::Rg32Sint,
    TextureFormat::Rg32Float,
    TextureFormat::Rgba32Uint,
    TextureFormat::Rgba32Sint,
    TextureFormat::Rgba32Float,
    TextureFormat::Depth16Unorm,
    TextureFormat::Depth24Plus,
    TextureFormat::Depth32Float,
    TextureFormat::Depth24PlusStencil8,
    TextureFormat::Depth32FloatStencil8,
];

impl Format {
    /// The format of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        FORMATS
            .into_iter()
            .map(Self)
            .find(|format| format.name() == name)
    }

    /// The format that Rust calls so, as in `Rgba16Float`.
    pub(crate) fn from_rust_name(name: &str) -> Option<Self> {
        FORMATS
            .into_iter()
            .find(|format| format!("{format:?}") == name)
            .map(Self)
    }

    /// Whether it holds stencil.
    pub fn has_stencil(self) -> bool {
        self.0.has_stencil_aspect()
    }

    /// The names of all formats.
    pub fn names() -> impl Iterator<Item = String> {
        FORMATS.into_iter().map(|format| Self(format).name())
    }

    /// The WebGPU name.
    pub fn name(self) -> String {
        // The WebGPU names are wgpu's in lower case, with a dash before `srgb` and `stencil8`.
        format!("{:?}", self.0)
            .to_lowercase()
            .replace("unormsrgb", "unorm-srgb")
            .replace("floatstencil8", "float-stencil8")
            .replace("plusstencil8", "plus-stencil8")
    }

    /// Whether it holds depth.
    pub fn is_depth(self) -> bool {
        self.0.has_depth_aspect()
    }

    /// Bytes of one texel without its stencil.
    pub fn depth_bytes(self) -> u32 {
        match self.0 {
            TextureFormat::Depth24PlusStencil8 => 3,
            TextureFormat::Depth32FloatStencil8 => 4,
            _ => self.bytes_per_texel(),
        }
    }

    /// Bytes of one texel in memory. Depth with stencil counts 8, as drivers store it.
    pub fn bytes_per_texel(self) -> u32 {
        match self.0 {
            TextureFormat::Depth24Plus => 4,
            TextureFormat::Depth24PlusStencil8 => 4,
            TextureFormat::Depth32FloatStencil8 => 8,
            format => format.block_copy_size(None).unwrap_or(4),
        }
    }
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_webgpu_names_and_round_trip() {
        for name in Format::names() {
            assert_eq!(Format::from_name(&name).map(Format::name), Some(name));
        }
        let name = |format| Format(format).name();
        assert_eq!(name(TextureFormat::Rgba8UnormSrgb), "rgba8unorm-srgb");
        assert_eq!(
            name(TextureFormat::Depth32FloatStencil8),
            "depth32float-stencil8"
        );
        assert_eq!(name(TextureFormat::Rg11b10Ufloat), "rg11b10ufloat");
    }

    #[test]
    fn texel_sizes() {
        let bytes = |name| Format::from_name(name).map(Format::bytes_per_texel);
        assert_eq!(bytes("rgba16float"), Some(8));
        assert_eq!(bytes("rgba8unorm-srgb"), Some(4));
        assert_eq!(bytes("depth32float"), Some(4));
        assert_eq!(bytes("rgba32float"), Some(16));
    }
}
