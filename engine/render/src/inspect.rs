//! Looks at a target as it is after a chosen pass.
//!
//! Between two passes the target is drawn into a picture for people, on the GPU: nothing is read
//! back and nothing waits. The shader is `shaders/inspect.wgsl`.

mod display;

use lightbench_assets::files::Files;

use crate::description::PipelineDesc;
use crate::format::Format;
use crate::gpu::Gpu;
use crate::gpu_data::FrameData;
use crate::problem::{Place, Problem};
use crate::reflection::SampleKind;
use crate::shader::ShaderComposer;
use crate::targets::Targets;

use display::{Display, PICTURE, bind, display};

/// The shader that shows targets.
pub const INSPECT_SHADER: &str = "shaders/inspect.wgsl";

/// Which channels are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Channels {
    /// Red, green and blue as a colour.
    #[default]
    Color,
    /// Red, or the only channel.
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Alpha.
    Alpha,
}

/// How values become colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ColorMap {
    /// Values are linear light and are coded as sRGB.
    Light,
    /// Values are data: the low end is black, the high end white, even steps between.
    #[default]
    Data,
    /// Viridis, from dark blue to yellow; of a colour, its luminance.
    FalseColor,
}

/// What to look at, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Index of the pass after which the target is looked at.
    pub pass: usize,
    /// The target's name.
    pub target: String,
    /// Which channels.
    pub channels: Channels,
    /// How values become colours.
    pub map: ColorMap,
    /// The value at the low end. Depth is shown as a distance in metres.
    pub low: f32,
    /// The value at the high end.
    pub high: f32,
}

impl Inspection {
    /// Looks at a target in the way that suits its format; `None` where the pipeline has no such
    /// target. `far` is the distance, in metres, at which depth reaches the high end.
    pub fn suited(desc: &PipelineDesc, pass: usize, target: &str, far: f32) -> Option<Self> {
        let format = desc.target(target)?.format;
        let (map, high) = match SampleKind::of_format(format.0) {
            SampleKind::Depth => (ColorMap::FalseColor, far),
            SampleKind::Uint | SampleKind::Sint => (ColorMap::Data, largest_integer(format)),
            SampleKind::Float if is_light(format) => (ColorMap::Light, 1.0),
            SampleKind::Float => (ColorMap::Data, 1.0),
        };
        let single = format.0.components() == 1 || format.is_depth();
        Some(Self {
            pass,
            target: target.to_owned(),
            channels: if single {
                Channels::Red
            } else {
                Channels::Color
            },
            map,
            low: 0.0,
            high,
        })
    }
}

/// The largest value of a format's integers, at most 65535.
fn largest_integer(format: Format) -> f32 {
    let bits = 8 * format.bytes_per_texel() / u32::from(format.0.components().max(1));
    (f64::from(bits.min(16)).exp2() - 1.0) as f32
}

/// Floats and sRGB formats with colours hold light, as far as a format can tell.
fn is_light(format: Format) -> bool {
    let name = format.name();
    format.0.components() >= 3 && (format.0.is_srgb() || name.ends_with("float"))
}

/// As the shader has it.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
struct InspectionData {
    low: f32,
    high: f32,
    near: f32,
    far: f32,
    channels: u32,
    map: u32,
    padding: [u32; 2],
}

/// The GPU side of inspecting.
pub struct Inspector {
    gpu: Gpu,
    uniforms: wgpu::Buffer,
    /// The text that `displays` were made from.
    text: String,
    /// For floats, integers and depth.
    displays: Vec<Display>,
    request: Option<Inspection>,
    picture: Option<wgpu::Texture>,
    /// The target that the group shows.
    group: Option<(wgpu::Texture, wgpu::BindGroup)>,
}

const KINDS: [(SampleKind, &str); 3] = [
    (SampleKind::Float, "float_main"),
    (SampleKind::Uint, "uint_main"),
    (SampleKind::Depth, "depth_main"),
];

impl Inspector {
    /// Looks at nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        let uniforms = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("inspection"),
            size: size_of::<InspectionData>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            gpu: gpu.clone(),
            uniforms,
            text: String::new(),
            displays: Vec::new(),
            request: None,
            picture: None,
            group: None,
        }
    }

    /// Chooses what the next frames show; `None` for nothing. Reads the shader again if it
    /// changed.
    ///
    /// # Errors
    /// A mistake in the shader; then nothing is shown.
    pub fn look(&mut self, files: &Files, request: Option<Inspection>) -> Result<(), Problem> {
        self.request = None;
        if request.is_none() {
            self.picture = None;
            self.group = None;
            return Ok(());
        }
        let text = files
            .read_text(INSPECT_SHADER)
            .map_err(|error| Problem::new(Place::file(INSPECT_SHADER), error.to_string()))?;
        if self.displays.is_empty() || self.text != text {
            self.group = None;
            self.displays = self.build(files)?;
            self.text = text;
        }
        self.request = request;
        Ok(())
    }

    /// What is looked at.
    pub fn request(&self) -> Option<&Inspection> {
        self.request.as_ref()
    }

    /// The picture of the last frame that had the target and the pass. Eight bits a channel,
    /// sRGB-coded, of the target's size.
    pub fn picture(&self) -> Option<&wgpu::Texture> {
        self.picture.as_ref()
    }

    /// Whether it looks at a target after this pass, which then must run.
    pub fn wants(&self, pass: usize) -> bool {
        self.request
            .as_ref()
            .is_some_and(|request| request.pass == pass)
    }

    /// Draws the picture if `pass` is the one to look at; called between passes.
    pub fn after_pass(
        &mut self,
        pass: usize,
        targets: &Targets,
        frame: &FrameData,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(request) = self.request.as_ref().filter(|request| request.pass == pass) else {
            return;
        };
        let Some(target) = targets.get(&request.target) else {
            return;
        };
        let kind = SampleKind::of_format(target.texture.format());
        let display = KINDS
            .iter()
            .position(|(known, _)| *known == kind)
            .and_then(|index| self.displays.get(index));
        let Some(display) = display else {
            return;
        };

        let data = InspectionData {
            low: request.low,
            high: request.high,
            near: frame.near,
            far: if frame.far.is_finite() {
                frame.far
            } else {
                0.0
            },
            channels: match request.channels {
                Channels::Red => 0,
                Channels::Green => 1,
                Channels::Blue => 2,
                Channels::Alpha => 3,
                Channels::Color => 4,
            },
            map: match request.map {
                ColorMap::Light => 0,
                ColorMap::Data => 1,
                ColorMap::FalseColor => 2,
            },
            padding: [0; 2],
        };
        self.gpu
            .queue
            .write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&data));

        let size = target.texture.size();
        let picture = match self.picture.take() {
            Some(picture) if picture.size() == size => picture,
            _ => self.gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("inspected target"),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: PICTURE,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            }),
        };
        let picture = self.picture.insert(picture);
        let group = match self.group.take() {
            Some((texture, group)) if texture == target.texture => group,
            _ => bind(&self.gpu, &self.uniforms, display, kind, target),
        };
        let (_, group) = self.group.insert((target.texture.clone(), group));

        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut render_pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("inspect"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..Default::default()
        });
        render_pass.set_pipeline(&display.pipeline);
        render_pass.set_bind_group(0, &*group, &[]);
        render_pass.draw(0..3, 0..1);
    }

    fn build(&self, files: &Files) -> Result<Vec<Display>, Problem> {
        let mut composer = ShaderComposer::new(files, self.gpu.capabilities())?;
        let shader = composer.compose(files, INSPECT_SHADER, &[])?;
        let names = shader.module.entry_points.iter().map(|e| e.name.as_str());
        let known: Vec<&str> = names.collect();
        for (_, entry) in KINDS {
            if !known.contains(&entry) {
                let text = format!("the shader has no entry point `{entry}`");
                return Err(Problem::new(Place::file(INSPECT_SHADER), text));
            }
        }
        let source = wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(shader.module));
        let device = &self.gpu.device;
        self.gpu
            .guarded(|| {
                let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(INSPECT_SHADER),
                    source,
                });
                KINDS
                    .iter()
                    .map(|(kind, entry)| display(device, &module, *kind, entry))
                    .collect()
            })
            .map_err(|error| Problem::new(Place::file(INSPECT_SHADER), error))
    }
}
