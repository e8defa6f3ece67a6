//! Textures back to the CPU.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use half::f16;
use wgpu::TextureFormat;

use crate::description::Slice;
use crate::gpu::{Gpu, GpuError};

/// The texels of a target, as floats.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetImage {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// The texture's format.
    pub format: crate::Format,
    /// How many channels the format has.
    pub channels: u32,
    /// Rows from the top. Channels that the format lacks are 0, alpha 1. Integers are given as
    /// they are, normalised integers as 0…1, sRGB formats decoded to linear.
    pub texels: Vec<[f32; 4]>,
}

/// Seconds after which a read-back gives up.
const TIMEOUT: u64 = 60;

/// Copies the first layer of a texture to the CPU and waits for it.
///
/// # Errors
/// When the device is lost or does not answer, or can't copy the texture.
pub fn read_bytes(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<u8>, GpuError> {
    read_slice(gpu, texture, Slice::default())
}

/// Copies one mip level of one layer of a texture to the CPU and waits for it.
///
/// # Errors
/// As [`read_bytes`].
pub fn read_slice(gpu: &Gpu, texture: &wgpu::Texture, slice: Slice) -> Result<Vec<u8>, GpuError> {
    let reading = Reading::begin(gpu, texture, slice)?;
    gpu.wait(TIMEOUT)?;
    reading.bytes()
}

/// A copy of a texture that is on its way to the CPU. It comes while the device is polled, as
/// [`Renderer::poll`](crate::Renderer::poll) does, and nothing waits for it.
#[derive(Debug)]
pub struct Reading {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    /// Bytes of a row, and from one row to the next.
    row: u32,
    padded: u32,
    height: u32,
}

const ON_ITS_WAY: u8 = 0;
const THERE: u8 = 1;
const LOST: u8 = 2;

impl Reading {
    /// Begins to copy one mip level of one layer of a texture, as it is now.
    ///
    /// # Errors
    /// When the device can't copy the texture.
    pub fn begin(gpu: &Gpu, texture: &wgpu::Texture, slice: Slice) -> Result<Self, GpuError> {
        if texture.sample_count() > 1 {
            return Err(GpuError::Driver(
                "a target with several samples can't be read; read what it is resolved to"
                    .to_owned(),
            ));
        }
        if matches!(
            texture.format(),
            TextureFormat::Depth24Plus | TextureFormat::Depth24PlusStencil8
        ) {
            return Err(GpuError::Driver(
                "depth of 24 bits can't be read; give the target the format `depth32float`"
                    .to_owned(),
            ));
        }
        let side = |length: u32| (length >> slice.mip).max(1);
        let (width, height) = (side(texture.width()), side(texture.height()));
        let row = width * aspect_bytes(texture.format());
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: u64::from(padded) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: slice.mip,
                origin: wgpu::Origin3d {
                    x: 0,
                    y: 0,
                    z: slice.layer,
                },
                aspect: aspect(texture.format()),
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
        );
        gpu.queue.submit([encoder.finish()]);
        let state = Arc::new(AtomicU8::new(ON_ITS_WAY));
        let told = Arc::clone(&state);
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            let now = if result.is_ok() { THERE } else { LOST };
            told.store(now, Ordering::Release);
        });
        Ok(Self {
            buffer,
            state,
            row,
            padded,
            height,
        })
    }

    /// Whether it has come, or never will: then [`Reading::bytes`] says which.
    pub fn is_over(&self) -> bool {
        self.state.load(Ordering::Acquire) != ON_ITS_WAY
    }

    /// The texels, row by row from the top without gaps.
    ///
    /// # Errors
    /// Before it has come, or when the device failed.
    pub fn bytes(&self) -> Result<Vec<u8>, GpuError> {
        let view = self
            .buffer
            .get_mapped_range(..)
            .map_err(|error| GpuError::Driver(error.to_string()))?;
        let mut bytes = Vec::with_capacity((self.row * self.height) as usize);
        for line in view.chunks_exact(self.padded as usize) {
            bytes.extend_from_slice(&line[..self.row as usize]);
        }
        Ok(bytes)
    }
}

/// Copies a texture to the CPU as floats.
///
/// # Errors
/// As [`read_bytes`].
pub fn read_image(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    slice: Slice,
) -> Result<TargetImage, GpuError> {
    let bytes = read_slice(gpu, texture, slice)?;
    let format = texture.format();
    let size = aspect_bytes(format) as usize;
    let texels = bytes
        .chunks_exact(size)
        .map(|texel| decode(format, texel))
        .collect();
    Ok(TargetImage {
        width: (texture.width() >> slice.mip).max(1),
        height: (texture.height() >> slice.mip).max(1),
        format: crate::Format(format),
        channels: u32::from(format.components()),
        texels,
    })
}

fn aspect(format: TextureFormat) -> wgpu::TextureAspect {
    if format.has_depth_aspect() {
        wgpu::TextureAspect::DepthOnly
    } else {
        wgpu::TextureAspect::All
    }
}

fn aspect_bytes(format: TextureFormat) -> u32 {
    format.block_copy_size(Some(aspect(format))).unwrap_or(4)
}

/// One texel as floats.
fn decode(format: TextureFormat, texel: &[u8]) -> [f32; 4] {
    let u16_at = |i: usize| u16::from_le_bytes([texel[i * 2], texel[i * 2 + 1]]);
    let u32_at = |i: usize| {
        u32::from_le_bytes([
            texel[i * 4],
            texel[i * 4 + 1],
            texel[i * 4 + 2],
            texel[i * 4 + 3],
        ])
    };
    let channels = usize::from(format.components());
    let fill = |value: &dyn Fn(usize) -> f32| {
        let mut out = [0.0, 0.0, 0.0, 1.0];
        for (channel, place) in out.iter_mut().enumerate().take(channels) {
            *place = value(channel);
        }
        out
    };
    match format {
        TextureFormat::R8Unorm | TextureFormat::Rg8Unorm | TextureFormat::Rgba8Unorm => {
            fill(&|i| f32::from(texel[i]) / 255.0)
        }
        TextureFormat::Bgra8Unorm => {
            let channel = |i: usize| f32::from(texel[i]) / 255.0;
            [channel(2), channel(1), channel(0), channel(3)]
        }
        TextureFormat::Rgba8UnormSrgb => fill(&|i| {
            let coded = f32::from(texel[i]) / 255.0;
            if i == 3 { coded } else { decode_srgb(coded) }
        }),
        TextureFormat::R8Snorm | TextureFormat::Rg8Snorm | TextureFormat::Rgba8Snorm => {
            // Both −128 and −127 stand for −1.
            fill(&|i| (f32::from(texel[i] as i8) / 127.0).max(-1.0))
        }
        TextureFormat::R8Sint | TextureFormat::Rg8Sint | TextureFormat::Rgba8Sint => {
            fill(&|i| f32::from(texel[i] as i8))
        }
        TextureFormat::R16Sint | TextureFormat::Rg16Sint | TextureFormat::Rgba16Sint => {
            fill(&|i| f32::from(u16_at(i) as i16))
        }
        TextureFormat::R32Sint | TextureFormat::Rg32Sint | TextureFormat::Rgba32Sint => {
            fill(&|i| u32_at(i) as i32 as f32)
        }
        TextureFormat::R8Uint | TextureFormat::Rg8Uint | TextureFormat::Rgba8Uint => {
            fill(&|i| f32::from(texel[i]))
        }
        TextureFormat::R16Uint | TextureFormat::Rg16Uint | TextureFormat::Rgba16Uint => {
            fill(&|i| f32::from(u16_at(i)))
        }
        TextureFormat::R16Float | TextureFormat::Rg16Float | TextureFormat::Rgba16Float => {
            fill(&|i| f16::from_bits(u16_at(i)).to_f32())
        }
        TextureFormat::R32Uint | TextureFormat::Rg32Uint | TextureFormat::Rgba32Uint => {
            fill(&|i| u32_at(i) as f32)
        }
        TextureFormat::R32Float | TextureFormat::Rg32Float | TextureFormat::Rgba32Float => {
            fill(&|i| f32::from_bits(u32_at(i)))
        }
        TextureFormat::Rgb10a2Unorm | TextureFormat::Rgb10a2Uint => {
            let bits = u32_at(0);
            let scale = |max: u32| {
                if format == TextureFormat::Rgb10a2Unorm {
                    max as f32
                } else {
                    1.0
                }
            };
            let ten = |shift: u32| (bits >> shift & 0x3ff) as f32 / scale(0x3ff);
            [ten(0), ten(10), ten(20), (bits >> 30) as f32 / scale(3)]
        }
        TextureFormat::Rg11b10Ufloat => {
            let bits = u32_at(0);
            [
                small_float(bits & 0x7ff, 6),
                small_float(bits >> 11 & 0x7ff, 6),
                small_float(bits >> 22, 5),
                1.0,
            ]
        }
        TextureFormat::Depth16Unorm => [f32::from(u16_at(0)) / 65535.0, 0.0, 0.0, 1.0],
        _ => [f32::from_bits(u32_at(0)), 0.0, 0.0, 1.0],
    }
}

/// IEC 61966-2-1.
fn decode_srgb(coded: f32) -> f32 {
    if coded <= 0.04045 {
        coded / 12.92
    } else {
        ((coded + 0.055) / 1.055).powf(2.4)
    }
}

/// An unsigned float of 5 exponent bits and the given number of mantissa bits.
fn small_float(bits: u32, mantissa_bits: u32) -> f32 {
    let mantissa = (bits & ((1 << mantissa_bits) - 1)) as f32 / (1u32 << mantissa_bits) as f32;
    match bits >> mantissa_bits {
        0 => mantissa * 2.0_f32.powi(-14),
        31 if mantissa == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        exponent => (1.0 + mantissa) * 2.0_f32.powi(exponent as i32 - 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_decode_to_what_was_stored() {
        assert_eq!(
            decode(TextureFormat::Rgba8Unorm, &[255, 0, 51, 255]),
            [1.0, 0.0, 0.2, 1.0]
        );
        assert_eq!(
            decode(TextureFormat::Rg16Uint, &[1, 2, 255, 255]),
            [513.0, 65535.0, 0.0, 1.0]
        );
        assert_eq!(
            decode(TextureFormat::Rg8Snorm, &[0x81, 127]),
            [-1.0, 1.0, 0.0, 1.0]
        );
        assert_eq!(
            decode(TextureFormat::R8Sint, &[0xfe]),
            [-2.0, 0.0, 0.0, 1.0]
        );
        assert_eq!(
            decode(TextureFormat::R32Sint, &(-3_i32).to_le_bytes()),
            [-3.0, 0.0, 0.0, 1.0]
        );
        let half = f16::from_f32(1.5).to_le_bytes();
        assert_eq!(decode(TextureFormat::R16Float, &half), [1.5, 0.0, 0.0, 1.0]);
        // 188 is the sRGB code of half the light.
        let linear = decode(TextureFormat::Rgba8UnormSrgb, &[188, 0, 0, 0])[0];
        assert!((linear - 0.5).abs() < 0.005, "{linear}");
        // 1.0 in 11 bits: exponent 15, mantissa 0.
        let bits: u32 = 15 << 6 | (15 << 6) << 11 | (16 << 5) << 22;
        assert_eq!(
            decode(TextureFormat::Rg11b10Ufloat, &bits.to_le_bytes()),
            [1.0, 1.0, 2.0, 1.0]
        );
    }
}
