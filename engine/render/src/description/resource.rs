//! Textures and buffers that passes write.

use super::Named;
use crate::format::Format;
use crate::problem::Place;

/// How large a target is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TargetSize {
    /// A factor of the output's size, rounded to the nearest texel and at least 1 × 1.
    Relative(f32),
    /// A fixed size in texels.
    Absolute(u32, u32),
    /// One texel for each tile of that many by that many pixels of the output; tiles at the edge
    /// may be cut.
    Tiles(u32),
}

impl TargetSize {
    /// The size in texels for an output of `width` × `height`.
    pub fn resolve(self, width: u32, height: u32) -> (u32, u32) {
        let scaled = |length: u32, factor: f32| ((length as f32 * factor).round() as u32).max(1);
        match self {
            Self::Relative(factor) => (scaled(width, factor), scaled(height, factor)),
            Self::Absolute(width, height) => (width.max(1), height.max(1)),
            Self::Tiles(tile) => {
                let tile = tile.max(1);
                (width.max(1).div_ceil(tile), height.max(1).div_ceil(tile))
            }
        }
    }
}

/// What a target is made of besides width and height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shape {
    /// One picture.
    #[default]
    Flat,
    /// That many pictures; shaders read a `texture_2d_array`.
    Array(u32),
    /// The six sides +x, −x, +y, −y, +z, −z of a cube; shaders read a `texture_cube`.
    Cube,
    /// A box of that depth; shaders read a `texture_3d`.
    Volume(u32),
}

impl Shape {
    /// Layers that can be drawn to one by one; slices of a volume.
    pub fn layers(self) -> u32 {
        match self {
            Self::Flat => 1,
            Self::Array(layers) | Self::Volume(layers) => layers.max(1),
            Self::Cube => 6,
        }
    }

    /// For messages: "a 2D texture".
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Flat => "a 2D texture",
            Self::Array(_) => "an array of 2D textures",
            Self::Cube => "a cube texture",
            Self::Volume(_) => "a 3D texture",
        }
    }
}

/// How many mip levels a target has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mips {
    /// That many, at most those down to 1 × 1.
    Count(u32),
    /// All, down to 1 × 1.
    All,
}

impl Mips {
    /// The number of levels for that size.
    pub fn resolve(self, width: u32, height: u32, depth: u32) -> u32 {
        let all = width.max(height).max(depth).max(1).ilog2() + 1;
        match self {
            Self::Count(count) => count.clamp(1, all),
            Self::All => all,
        }
    }
}

/// A texture that passes write and read.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetDesc {
    /// Name, as in `g_normal`; shaders read it by this name.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// Texel format.
    pub format: Format,
    /// Formats to take instead where the adapter can't do [`TargetDesc::format`], best first.
    pub fallbacks: Vec<Format>,
    /// Width and height.
    pub size: TargetSize,
    /// Layers, sides or slices.
    pub shape: Shape,
    /// Mip levels.
    pub mips: Mips,
    /// Samples a texel: 1 or 4.
    pub samples: u32,
}

impl TargetDesc {
    /// A flat target as large as the output, without mips and multisampling.
    pub fn new(name: impl Into<String>, at: Place, format: Format) -> Self {
        Self {
            name: name.into(),
            at,
            format,
            fallbacks: Vec::new(),
            size: TargetSize::Relative(1.0),
            shape: Shape::Flat,
            mips: Mips::Count(1),
            samples: 1,
        }
    }

    /// The most texels that a device with those limits has along its width and height.
    pub fn most_texels_along(&self, limits: &wgpu::Limits) -> u32 {
        match self.shape {
            Shape::Volume(_) => limits.max_texture_dimension_3d,
            _ => limits.max_texture_dimension_2d,
        }
    }

    /// For messages: the format, and what is unusual about its shape.
    pub fn in_words(&self) -> String {
        let samples = match self.samples {
            1 => String::new(),
            samples => format!(" with {samples} samples"),
        };
        match self.shape {
            Shape::Flat => format!("{}{samples}", self.format),
            shape => format!("{} of {}", shape.in_words(), self.format),
        }
    }
}

/// One mip level of one layer of a target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Slice {
    /// Mip level; 0 is the largest.
    pub mip: u32,
    /// Layer of an array, side of a cube or slice of a volume.
    pub layer: u32,
}

/// How many 32-bit words a buffer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BufferSize {
    /// That many.
    Words(u32),
    /// That many for each pixel of the output.
    PerPixel(u32),
    /// So many for each tile of `tile` by `tile` pixels of the output.
    PerTile {
        /// Side of a tile, pixels.
        tile: u32,
        /// Words a tile.
        words: u32,
    },
    /// That many for each light of the scene, and for one more.
    PerLight(u32),
}

impl BufferSize {
    /// Words that it has at least, whatever the output and the scene.
    pub fn least_words(self) -> u64 {
        self.resolve((1, 1), 0)
    }

    /// Words for an output of that size and a scene of that many lights, at least 4.
    pub fn resolve(self, (width, height): (u32, u32), lights: u32) -> u64 {
        let words = match self {
            Self::Words(words) => u64::from(words),
            Self::PerPixel(words) => u64::from(words) * u64::from(width) * u64::from(height),
            Self::PerTile { tile, words } => {
                let (columns, rows) = TargetSize::Tiles(tile).resolve(width, height);
                u64::from(words) * u64::from(columns) * u64::from(rows)
            }
            Self::PerLight(words) => u64::from(words) * (u64::from(lights) + 1),
        };
        words.max(4)
    }
}

/// A buffer of 32-bit words that passes write and read. It keeps its contents from frame to frame;
/// it begins as zeros, and is zeros again after its size changed.
#[derive(Clone, Debug, PartialEq)]
pub struct BufferDesc {
    /// Name; shaders read it by this name.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// Its size.
    pub size: BufferSize,
    /// A counter that says how many words were needed: where it exceeds the size, the buffer grows
    /// and the frame is drawn again.
    pub grows_with: Option<Named>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_sizes_round_and_never_vanish() {
        assert_eq!(TargetSize::Relative(0.5).resolve(637, 359), (319, 180));
        assert_eq!(TargetSize::Relative(0.5).resolve(1, 1), (1, 1));
        assert_eq!(TargetSize::Absolute(0, 7).resolve(9, 9), (1, 7));
    }

    #[test]
    fn tiles_that_do_not_divide_the_output_are_counted_too() {
        assert_eq!(TargetSize::Tiles(16).resolve(637, 359), (40, 23));
        assert_eq!(TargetSize::Tiles(16).resolve(1, 1), (1, 1));
        let size = BufferSize::PerTile { tile: 16, words: 3 };
        assert_eq!(size.resolve((637, 359), 9), 40 * 23 * 3);
        assert_eq!(BufferSize::PerLight(5).resolve((1, 1), 9), 50);
    }

    #[test]
    fn mips_end_at_one_texel() {
        assert_eq!(Mips::All.resolve(637, 359, 1), 10);
        assert_eq!(Mips::All.resolve(1, 1, 1), 1);
        assert_eq!(Mips::Count(20).resolve(4, 2, 1), 3);
    }
}
