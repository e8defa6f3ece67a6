//! Two pictures in one: side by side, their difference, or a map over a picture.

use lightbench_assets::files::Files;

use super::screen;
use crate::gpu::Gpu;
use crate::problem::Problem;

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
            None => {
                let path = how.shader();
                let module = screen::module(&self.gpu, files, path, &[])?;
                slot.insert(screen::pipeline(
                    &self.gpu,
                    files,
                    path,
                    &module,
                    &kit.layout,
                )?)
            }
        };
        let picture = match self.picture.take() {
            Some(picture) if picture.size() == first.size() => picture,
            _ => screen::canvas(&self.gpu, first.size()),
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
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        screen::paint(&mut encoder, picture, pipeline, &drawn.group);
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
