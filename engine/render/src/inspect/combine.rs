//! Two pictures in one: side by side, their difference, or a map over a picture.

use std::borrow::Cow;

use lightbench_assets::files::Files;

use crate::gpu::Gpu;
use crate::problem::{Place, Problem};
use crate::reflection::{FRAGMENT_ENTRY, VERTEX_ENTRY};
use crate::shader::ShaderComposer;

/// The format of what comes out: values are coded as sRGB already.
const PICTURE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// How two pictures become one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Combination {
    /// The first at the left of a line, the second at its right.
    Split {
        /// The share of the width at the left of the line, 0 to 1.
        at: f32,
    },
    /// The absolute difference of display-ready values.
    Difference {
        /// What it is multiplied with.
        gain: f32,
        /// Whether the largest of the three channels is shown in the colours of viridis, instead of
        /// each channel on its own.
        map: bool,
    },
    /// The second, a painted map, over the first.
    Overlay {
        /// How much the map covers, 0 to 1.
        opacity: f32,
    },
}

impl Combination {
    fn index(self) -> usize {
        match self {
            Self::Split { .. } => 0,
            Self::Difference { .. } => 1,
            Self::Overlay { .. } => 2,
        }
    }

    fn shader(self) -> &'static str {
        match self {
            Self::Split { .. } => "shaders/inspect/split.wgsl",
            Self::Difference { .. } => "shaders/inspect/difference.wgsl",
            Self::Overlay { .. } => "shaders/inspect/overlay.wgsl",
        }
    }

    /// As the shaders have it.
    fn data(self) -> [f32; 4] {
        let mut data = [0.0; 4];
        match self {
            Self::Split { at } => data[0] = at,
            Self::Difference { gain, map } => {
                data[0] = gain;
                data[1] = if map { 1.0 } else { 0.0 };
            }
            Self::Overlay { opacity } => data[0] = opacity,
        }
        data
    }
}

/// Draws two pictures into one. It holds nothing on the device before it is first used.
pub struct Combiner {
    gpu: Gpu,
    pipelines: [Option<wgpu::RenderPipeline>; 3],
    kit: Option<Kit>,
    picture: Option<wgpu::Texture>,
    drawn: Option<Drawn>,
}

/// What all shaders share.
struct Kit {
    uniforms: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
}

/// The bind group of the last two pictures.
struct Drawn {
    first: wgpu::Texture,
    second: wgpu::Texture,
    group: wgpu::BindGroup,
}

impl Combiner {
    /// Nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            pipelines: [None, None, None],
            kit: None,
            picture: None,
            drawn: None,
        }
    }

    /// Reads the shaders again where they are needed next.
    pub fn forget_shaders(&mut self) {
        self.pipelines = [None, None, None];
    }

    /// Draws two pictures of one size into one, and gives it: eight bits a channel, sRGB-coded. `None`
    /// where the sizes differ.
    ///
    /// # Errors
    /// A mistake in the shader.
    pub fn combine(
        &mut self,
        files: &Files,
        first: &wgpu::Texture,
        second: &wgpu::Texture,
        how: Combination,
    ) -> Result<Option<wgpu::Texture>, Problem> {
        if first.size() != second.size() {
            return Ok(None);
        }
        let kit = self.kit.get_or_insert_with(|| Kit::new(&self.gpu));
        let slot = &mut self.pipelines[how.index()];
        let pipeline = match slot {
            Some(pipeline) => &*pipeline,
            None => slot.insert(build(&self.gpu, files, kit, how.shader())?),
        };
        let picture = match self.picture.take() {
            Some(picture) if picture.size() == first.size() => picture,
            _ => canvas(&self.gpu, first.size()),
        };
        let picture = self.picture.insert(picture);
        let drawn = match self.drawn.take() {
            Some(drawn) if drawn.first == *first && drawn.second == *second => drawn,
            _ => Drawn {
                first: first.clone(),
                second: second.clone(),
                group: kit.group(&self.gpu, first, second),
            },
        };
        let drawn = self.drawn.insert(drawn);
        let queue = &self.gpu.queue;
        queue.write_buffer(&kit.uniforms, 0, bytemuck::cast_slice(&how.data()));
        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("combine"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &drawn.group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        queue.submit([encoder.finish()]);
        Ok(Some(picture.clone()))
    }
}

impl Kit {
    fn new(gpu: &Gpu) -> Self {
        let visibility = wgpu::ShaderStages::FRAGMENT;
        let texture = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        let uniform = wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        Self {
            uniforms: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("combination"),
                size: size_of::<[f32; 4]>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            layout: gpu
                .device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                    label: Some("combine"),
                    entries: &[uniform, texture(1), texture(2)],
                }),
        }
    }

    fn group(&self, gpu: &Gpu, first: &wgpu::Texture, second: &wgpu::Texture) -> wgpu::BindGroup {
        let [first, second] = [first, second]
            .map(|texture| texture.create_view(&wgpu::TextureViewDescriptor::default()));
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("combine"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: self.uniforms.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::TextureView(&first),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: wgpu::BindingResource::TextureView(&second),
                },
            ],
        })
    }
}

fn canvas(gpu: &Gpu, size: wgpu::Extent3d) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("combined picture"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: PICTURE,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

fn build(
    gpu: &Gpu,
    files: &Files,
    kit: &Kit,
    path: &'static str,
) -> Result<wgpu::RenderPipeline, Problem> {
    let mut composer = ShaderComposer::new(files, gpu.capabilities())?;
    let shader = composer.compose(files, path, &[])?;
    let source = wgpu::ShaderSource::Naga(Cow::Owned(shader.module));
    let make = || {
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(path),
                source,
            });
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("combine"),
                bind_group_layouts: &[Some(&kit.layout)],
                immediate_size: 0,
            });
        gpu.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(path),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(VERTEX_ENTRY),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(FRAGMENT_ENTRY),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(PICTURE.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
    };
    gpu.guarded(make)
        .map_err(|error| Problem::new(Place::file(path), error))
}
