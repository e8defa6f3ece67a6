//! The values of a pipeline's parameters on the device: group 2.

use crate::description::PipelineDesc;
use crate::gpu::Gpu;
use crate::reflection::{ParameterMember, SampleKind};

/// The uniform buffer behind a shader's `parameters`.
#[derive(Debug)]
pub struct ParameterBlock {
    /// The layout of group 2.
    pub layout: wgpu::BindGroupLayout,
    /// Group 2.
    pub group: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    members: Vec<ParameterMember>,
    bytes: Vec<u8>,
    uploaded: bool,
}

impl ParameterBlock {
    /// A block of `size` bytes.
    pub fn new(gpu: &Gpu, members: Vec<ParameterMember>, size: u32) -> Self {
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("parameters"),
                entries: &[wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                }],
            });
        let size = size.next_multiple_of(16);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("parameters"),
            size: u64::from(size),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("parameters"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            }],
        });
        Self {
            layout,
            group,
            buffer,
            members,
            bytes: vec![0; size as usize],
            uploaded: false,
        }
    }

    /// Writes the values in force, if they differ from those on the device.
    pub fn upload(&mut self, gpu: &Gpu, desc: &PipelineDesc) {
        let mut changed = !self.uploaded;
        for member in &self.members {
            let Some(parameter) = desc.parameter(&member.name) else {
                continue;
            };
            let value = parameter.shader_value();
            let bytes = match member.kind {
                Some(SampleKind::Float) => (value as f32).to_le_bytes(),
                _ => (value as u32).to_le_bytes(),
            };
            let at = member.offset as usize;
            if let Some(place) = self.bytes.get_mut(at..at + 4)
                && *place != bytes
            {
                place.copy_from_slice(&bytes);
                changed = true;
            }
        }
        if changed {
            gpu.queue.write_buffer(&self.buffer, 0, &self.bytes);
            self.uploaded = true;
        }
    }
}
