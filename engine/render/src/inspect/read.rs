//! Reads texels of any target: also of several samples, of stencil, and of 24-bit depth, which can't
//! be copied.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use lightbench_assets::files::Files;

use super::probe::TexelValue;
use super::texels::{Aspect, BINDING, Texels};
use crate::description::Slice;
use crate::gpu::Gpu;
use crate::problem::{Place, Problem};
use crate::reflection::{COMPUTE_ENTRY, SampleKind};
use crate::renderer::RenderError;
use crate::targets::Target;
use crate::{Format, TargetImage};

/// Copies texels.
pub(super) const READ: &str = "shaders/inspect/read.wgsl";
/// Looks for values that are no numbers.
pub(super) const SEARCH: &str = "shaders/inspect/search.wgsl";

/// Bytes of one texel in a buffer.
pub(super) const TEXEL_BYTES: u64 = 16;
/// Seconds after which a read-back gives up.
const TIMEOUT: u64 = 60;

/// Takes least, greatest and counts of values.
pub(super) const MEASURE: &str = "shaders/inspect/measure.wgsl";

/// What a shader is asked for, as it has it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct RequestData {
    pub corner: [i32; 3],
    pub sample: i32,
    pub size: [u32; 2],
    pub first: u32,
    pub padding: u32,
}

/// A compute pipeline over texels of one kind.
pub(super) struct Reader {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

/// Compute pipelines by shader and kind of texels.
#[derive(Default)]
pub(super) struct Readers(HashMap<(&'static str, Texels), Reader>);

impl Readers {
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// The one for a shader and a kind of texels, built where it is not known yet.
    pub fn get(
        &mut self,
        gpu: &Gpu,
        files: &Files,
        shader: &'static str,
        texels: Texels,
    ) -> Result<&Reader, Problem> {
        match self.0.entry((shader, texels)) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(empty) => Ok(empty.insert(Reader::new(gpu, files, shader, texels)?)),
        }
    }
}

impl Reader {
    fn new(
        gpu: &Gpu,
        files: &Files,
        shader: &'static str,
        texels: Texels,
    ) -> Result<Self, Problem> {
        let module = texels.module(gpu, files, shader)?;
        let buffer = |binding, ty, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset,
                min_binding_size: None,
            },
            count: None,
        };
        let storage = wgpu::BufferBindingType::Storage { read_only: false };
        let build = || {
            let layout = gpu
                .device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                    label: Some(shader),
                    entries: &[
                        buffer(0, wgpu::BufferBindingType::Uniform, true),
                        texels.layout(wgpu::ShaderStages::COMPUTE),
                        buffer(2, storage, false),
                    ],
                });
            let pipeline_layout =
                gpu.device
                    .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                        label: Some(shader),
                        bind_group_layouts: &[Some(&layout)],
                        immediate_size: 0,
                    });
            let pipeline = gpu
                .device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(shader),
                    layout: Some(&pipeline_layout),
                    module: &module,
                    entry_point: Some(COMPUTE_ENTRY),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                });
            Self { layout, pipeline }
        };
        gpu.guarded(build)
            .map_err(|error| Problem::new(Place::file(shader), error))
    }

    /// Runs over `size` texels of a view. The request, of so many bytes, lies in `requests` at `offset`.
    pub fn run(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        view: &wgpu::TextureView,
        (requests, offset, bytes): (&wgpu::Buffer, u32, usize),
        results: &wgpu::Buffer,
        size: [u32; 2],
    ) {
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("read texels"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: requests,
                        offset: 0,
                        size: std::num::NonZeroU64::new(bytes as u64),
                    }),
                },
                wgpu::BindGroupEntry {
                    binding: BINDING,
                    resource: wgpu::BindingResource::TextureView(view),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: results.as_entire_binding(),
                },
            ],
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("read texels"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[offset]);
        pass.dispatch_workgroups(size[0].div_ceil(8), size[1].div_ceil(8), 1);
    }
}

/// One sample of all texels of a slice, or their stencil. Waits for the device.
///
/// # Errors
/// When the slice is larger than what the device binds at once, the device failed, or a shader of
/// the project has a mistake.
pub fn read_any(
    gpu: &Gpu,
    files: &Files,
    target: &Target,
    slice: Slice,
    sample: u32,
    aspect: Aspect,
) -> Result<TargetImage, RenderError> {
    let texels = Texels::of(target, aspect);
    let (width, height) = target.mip_size(slice.mip);
    let bytes = u64::from(width) * u64::from(height) * TEXEL_BYTES;
    let limit = gpu.device.limits().max_storage_buffer_binding_size;
    if bytes > limit {
        return Err(RenderError::Scene(format!(
            "{width} x {height} texels are more than this device copies at once; use a smaller size"
        )));
    }
    let reader = Reader::new(gpu, files, READ, texels).map_err(RenderError::Shader)?;
    let buffer = |size, usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read texels"),
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    use wgpu::BufferUsages as Usage;
    let request = RequestData {
        corner: [0, 0, slice.layer as i32],
        sample: sample as i32,
        size: [width, height],
        first: 0,
        padding: 0,
    };
    let requests = buffer(
        size_of::<RequestData>() as u64,
        Usage::UNIFORM | Usage::COPY_DST,
    );
    gpu.queue
        .write_buffer(&requests, 0, bytemuck::bytes_of(&request));
    let results = buffer(bytes, Usage::STORAGE | Usage::COPY_SRC);
    let back = buffer(bytes, Usage::COPY_DST | Usage::MAP_READ);
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let view = texels.view(target, slice, aspect);
    let size = [width, height];
    let request = (&requests, 0, size_of::<RequestData>());
    reader.run(gpu, &mut encoder, &view, request, &results, size);
    encoder.copy_buffer_to_buffer(&results, 0, &back, 0, bytes);
    gpu.queue.submit([encoder.finish()]);
    back.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait(TIMEOUT)?;
    let words = back
        .get_mapped_range(..)
        .map_err(|error| crate::GpuError::Driver(error.to_string()))?;
    let values = words.chunks_exact(TEXEL_BYTES as usize).map(|texel| {
        let bits = bytemuck::pod_read_unaligned::<[u32; 4]>(texel);
        TexelValue::new(texels.kind, bits).to_floats()
    });
    let format = Format(target.texture.format());
    let single = aspect == Aspect::Stencil || texels.kind == SampleKind::Depth;
    Ok(TargetImage {
        width,
        height,
        format,
        channels: if single {
            1
        } else {
            u32::from(format.0.components())
        },
        texels: values.collect(),
    })
}
