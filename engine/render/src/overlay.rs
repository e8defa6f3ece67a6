//! Lines over a picture: the edges of triangles and the normals of vertices, whatever the pipeline is.
//!
//! They are drawn after the passes, into a picture of their own that is clear where no line is, so that
//! no target and no measurement of the pipeline changes. What lies behind something else is hidden. The
//! shader is `shaders/overlay/lines.wgsl`. Holes in textures count as solid.

use lightbench_assets::files::Files;
use lightbench_world::{MeshRenderer, World};

use crate::description::Define;
use crate::gpu::Gpu;
use crate::layout::SceneLayout;
use crate::problem::{Place, Problem};
use crate::reflection::{FRAGMENT_ENTRY, VERTEX_ENTRY};
use crate::scene::{MeshBuffers, MeshPool};
use crate::series::FIRST_SERIES;
use crate::shader::ShaderComposer;

/// The folder of the overlay's shader.
pub const OVERLAY_SHADERS: &str = "shaders/overlay/";
const SHADER: &str = "shaders/overlay/lines.wgsl";

const PICTURE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Lines lie nearer by this share of their distance, so that their own surface does not hide them.
const NEARER: f32 = 1.002;
/// The length of a normal as a share of the distance along the view.
const NORMAL_LENGTH: f32 = 0.03;

/// Of what lines are drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// The edges of triangles.
    pub edges: bool,
    /// The normals of vertices.
    pub normals: bool,
    /// Rows of MeshRenderer; without them all that the camera sees.
    pub rows: Option<Vec<u32>>,
}

/// As the shader has it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct StyleData {
    color: [f32; 4],
    length: f32,
    nearer: f32,
    padding: [f32; 2],
}

/// What the shader draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drawing {
    Depth,
    Edges,
    Normals,
}

const DRAWINGS: [Drawing; 3] = [Drawing::Depth, Drawing::Edges, Drawing::Normals];

impl Drawing {
    fn defines(self) -> Vec<Define> {
        let names: &[&str] = match self {
            Self::Depth => &[],
            Self::Edges => &["LINES", "EDGES"],
            Self::Normals => &["LINES", "NORMALS"],
        };
        names.iter().map(|name| Define::flag(*name)).collect()
    }

    fn style(self) -> StyleData {
        StyleData {
            // Blue and orange are told apart by every kind of colour blindness (Okabe and Ito 2008).
            color: match self {
                Self::Normals => [0.90, 0.62, 0.0, 1.0],
                // Two triangles draw the edge that they share.
                _ => [0.34, 0.71, 0.91, 0.35],
            },
            length: NORMAL_LENGTH,
            nearer: NEARER,
            padding: [0.0; 2],
        }
    }

    /// Ends of lines, or corners, for so many indices of a mesh.
    fn vertices(self, indices: u32) -> u32 {
        match self {
            Self::Depth => indices,
            Self::Edges | Self::Normals => indices.saturating_mul(2),
        }
    }
}

/// What stays as long as the shader does.
struct Built {
    layout: wgpu::BindGroupLayout,
    pipelines: [wgpu::RenderPipeline; 3],
    styles: [wgpu::Buffer; 3],
}

struct Pictures {
    color: wgpu::Texture,
    depth: wgpu::TextureView,
}

/// The lines of one series of pictures.
#[derive(Default)]
struct Course {
    asked: Option<(Files, Lines)>,
    pictures: Option<Pictures>,
}

/// Draws lines over pictures.
pub struct Overlay {
    gpu: Gpu,
    scene: wgpu::BindGroupLayout,
    /// By series; there is always the first.
    courses: Vec<Course>,
    built: Option<Built>,
    /// Rows that hide lines and rows that have them, each with the indices of its mesh.
    solid: Vec<(u32, u32)>,
    lined: Vec<(u32, u32)>,
    problem: Option<Problem>,
}

impl Overlay {
    /// Draws nothing yet.
    pub fn new(gpu: &Gpu, layout: &SceneLayout) -> Self {
        Self {
            gpu: gpu.clone(),
            scene: layout.group.clone(),
            courses: vec![Course::default()],
            built: None,
            solid: Vec::new(),
            lined: Vec::new(),
            problem: None,
        }
    }

    /// Chooses the lines of the next frames; `None` for none. The shader comes from `files`.
    pub fn ask(&mut self, files: &Files, lines: Option<Lines>) {
        self.ask_in(FIRST_SERIES, files, lines);
    }

    /// The same for the frames of another series: see [`crate::series`].
    pub fn ask_in(&mut self, series: usize, files: &Files, lines: Option<Lines>) {
        let lines = lines.filter(|lines| lines.edges || lines.normals);
        if self.courses.len() <= series {
            self.courses.resize_with(series + 1, Course::default);
        }
        let course = &mut self.courses[series];
        if lines.is_none() {
            course.pictures = None;
        }
        course.asked = lines.map(|lines| (files.clone(), lines));
    }

    /// Reads the shader again where it is needed next.
    pub fn forget_shaders(&mut self) {
        self.built = None;
    }

    /// The lines of the last frame, of its size: eight bits a channel, sRGB-coded, colours multiplied by
    /// alpha.
    pub fn picture(&self) -> Option<&wgpu::Texture> {
        self.picture_of(FIRST_SERIES)
    }

    /// The same of the last frame of a series.
    pub fn picture_of(&self, series: usize) -> Option<&wgpu::Texture> {
        let pictures = self.courses.get(series)?.pictures.as_ref();
        pictures.map(|pictures| &pictures.color)
    }

    /// A mistake in the shader, or what the device can't hold, once.
    pub fn take_problem(&mut self) -> Option<Problem> {
        self.problem.take()
    }

    /// Takes note of what the next frame shows: rows that the camera sees.
    pub(crate) fn gather(
        &mut self,
        series: usize,
        world: &World,
        meshes: &MeshPool,
        visible: &[u32],
    ) {
        let asked = self.courses.get(series).and_then(|it| it.asked.as_ref());
        let Some((_, lines)) = asked else {
            return;
        };
        let renderers = world.columns::<MeshRenderer>();
        let known = |row: &u32| {
            let renderer = ((*row as usize) < renderers.len())
                .then(|| renderers.row(*row as usize))
                .filter(|renderer| renderer.visible)?;
            let range = meshes.range(renderer.mesh)?;
            Some((*row, range.indices.len() as u32))
        };
        self.solid.clear();
        self.solid.extend(visible.iter().filter_map(known));
        self.lined.clear();
        match &lines.rows {
            None => self.lined.extend_from_slice(&self.solid),
            Some(rows) => self.lined.extend(rows.iter().filter_map(known)),
        }
    }

    /// Draws the lines of one frame.
    pub(crate) fn draw(
        &mut self,
        series: usize,
        buffers: MeshBuffers<'_>,
        scene: &wgpu::BindGroup,
        size: (u32, u32),
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(course) = self.courses.get_mut(series) else {
            return;
        };
        let Course { asked, pictures } = std::mem::take(course);
        let Some((files, lines)) = asked else {
            return;
        };
        let pictures = match pictures {
            Some(pictures) if pictures.size() == size => pictures,
            _ => Pictures::new(&self.gpu, size),
        };
        match self.try_draw(&files, &lines, &pictures, buffers, scene, encoder) {
            Ok(()) => {
                self.courses[series] = Course {
                    asked: Some((files, lines)),
                    pictures: Some(pictures),
                };
            }
            // What can't be drawn is not asked for again.
            Err(problem) => self.problem = Some(problem),
        }
    }

    fn try_draw(
        &mut self,
        files: &Files,
        lines: &Lines,
        pictures: &Pictures,
        buffers: MeshBuffers<'_>,
        scene: &wgpu::BindGroup,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        let meshes = [buffers.positions, buffers.attributes, buffers.indices];
        let most = self.gpu.device.limits().max_storage_buffer_binding_size;
        if meshes.iter().any(|buffer| buffer.size() > most) {
            return Err(Problem::new(
                Place::file(SHADER),
                "the scene's meshes are more than a shader of this device can fetch by itself, \
                 so that no lines are drawn over the picture",
            ));
        }
        let built = match self.built.take() {
            Some(built) => built,
            None => build(&self.gpu, &self.scene, files)?,
        };
        let built = self.built.insert(built);
        let groups = built.styles.each_ref().map(|style| {
            let [positions, attributes, indices] = meshes;
            let mut binding = 0..;
            let entries =
                [positions, attributes, indices, style].map(|buffer| wgpu::BindGroupEntry {
                    binding: binding.next().unwrap_or_default(),
                    resource: buffer.as_entire_binding(),
                });
            self.gpu
                .device
                .create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("lines"),
                    layout: &built.layout,
                    entries: &entries,
                })
        });
        let view = pictures
            .color
            .create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("lines"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &pictures.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, scene, &[0]);
        for (index, drawing) in DRAWINGS.into_iter().enumerate() {
            let rows = match drawing {
                Drawing::Depth => &self.solid,
                Drawing::Edges if lines.edges => &self.lined,
                Drawing::Normals if lines.normals => &self.lined,
                _ => continue,
            };
            pass.set_pipeline(&built.pipelines[index]);
            pass.set_bind_group(1, &groups[index], &[]);
            for &(row, indices) in rows {
                pass.draw(0..drawing.vertices(indices), row..row + 1);
            }
        }
        Ok(())
    }
}

impl Pictures {
    fn size(&self) -> (u32, u32) {
        (self.color.width(), self.color.height())
    }

    fn new(gpu: &Gpu, (width, height): (u32, u32)) -> Self {
        let texture = |format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("lines"),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let depth = texture(DEPTH, wgpu::TextureUsages::empty());
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        Self {
            color: texture(PICTURE, read),
            depth: depth.create_view(&wgpu::TextureViewDescriptor::default()),
        }
    }
}

fn build(gpu: &Gpu, scene: &wgpu::BindGroupLayout, files: &Files) -> Result<Built, Problem> {
    let mut composer = ShaderComposer::new(files, gpu.capabilities())?;
    let mut modules = Vec::new();
    for drawing in DRAWINGS {
        let shader = composer.compose(files, SHADER, &drawing.defines())?;
        modules.push(wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(
            shader.module,
        )));
    }
    let make = || {
        let buffer = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let mesh = |binding| wgpu::BindGroupLayoutEntry {
            visibility: wgpu::ShaderStages::VERTEX,
            ..buffer(
                binding,
                wgpu::BufferBindingType::Storage { read_only: true },
            )
        };
        let style = buffer(3, wgpu::BufferBindingType::Uniform);
        let device = &gpu.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("lines"),
            entries: &[mesh(0), mesh(1), mesh(2), style],
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("lines"),
            bind_group_layouts: &[Some(scene), Some(&layout)],
            immediate_size: 0,
        });
        let mut sources = modules.into_iter();
        let pipelines = DRAWINGS.map(|drawing| {
            let module = sources.next().map(|source| {
                device.create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(SHADER),
                    source,
                })
            });
            module.map(|module| pipeline(device, &pipeline_layout, &module, drawing))
        });
        let styles = DRAWINGS.map(|drawing| {
            let style = drawing.style();
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("lines"),
                size: size_of::<StyleData>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            gpu.queue
                .write_buffer(&buffer, 0, bytemuck::bytes_of(&style));
            buffer
        });
        (layout, pipelines, styles)
    };
    let failed = |error| Problem::new(Place::file(SHADER), error);
    let (layout, pipelines, styles) = gpu.guarded(make).map_err(failed)?;
    let [Some(depth), Some(edges), Some(normals)] = pipelines else {
        return Err(failed("the shader was not made".to_owned()));
    };
    Ok(Built {
        layout,
        pipelines: [depth, edges, normals],
        styles,
    })
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    drawing: Drawing,
) -> wgpu::RenderPipeline {
    let solid = drawing == Drawing::Depth;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("lines"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(VERTEX_ENTRY),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            topology: match solid {
                true => wgpu::PrimitiveTopology::TriangleList,
                false => wgpu::PrimitiveTopology::LineList,
            },
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(solid),
            depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(FRAGMENT_ENTRY),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: PICTURE,
                blend: (!solid).then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: match solid {
                    true => wgpu::ColorWrites::empty(),
                    false => wgpu::ColorWrites::ALL,
                },
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
