//! What keeps a frame from being drawn or read.

use crate::gpu::GpuError;
use crate::problem::{Problem, counted};
use crate::variant::Variants;

/// Why a frame could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The scene does not fit the device.
    #[error("{0}")]
    Scene(String),
    /// The pipeline can't be drawn at the size.
    #[error("{0}")]
    Room(String),
    /// The scene has meshes that the pipeline was not compiled for.
    #[error("the pipeline is not built yet for all meshes of the scene")]
    NotBuilt(Variants),
    /// A shader that looks into frames has a mistake.
    #[error("{0}")]
    Shader(Problem),
    /// A target was asked for that the pipeline does not have, or before the first frame.
    #[error("the pipeline has no target `{0}` yet")]
    NoTarget(String),
    /// A mip level or layer was asked for that the target does not have.
    #[error(
        "`{target}` has {} and {}, both counted from 0",
        counted(*mips as usize, "mip level"),
        counted(*layers as usize, "layer")
    )]
    NoSlice {
        /// The target.
        target: String,
        /// Its mip levels.
        mips: u32,
        /// Its layers.
        layers: u32,
    },
    /// A sample was asked for that the target does not have.
    #[error("`{target}` has {} a texel, counted from 0", counted(*samples as usize, "sample"))]
    NoSample {
        /// The target.
        target: String,
        /// Its samples.
        samples: u32,
    },
    /// Stencil was asked for of a target that has none.
    #[error("`{0}` has no stencil")]
    NoStencil(String),
    /// The size asked for is beyond the device.
    #[error(
        "{width} × {height} is more than this device draws; its limit is {limit} in each direction"
    )]
    Size {
        /// Asked for.
        width: u32,
        /// Asked for.
        height: u32,
        /// The device's limit.
        limit: u32,
    },
}
