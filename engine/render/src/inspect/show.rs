//! A target as a picture for people.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use lightbench_assets::files::Files;

use super::Between;
use super::screen;
use super::texels::{Aspect, BINDING, Texels};
use crate::description::{PipelineDesc, Slice};
use crate::format::Format;
use crate::gpu::Gpu;
use crate::problem::{Place, Problem};
use crate::reflection::SampleKind;

const SHADER: &str = "shaders/inspect/show.wgsl";

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
    /// Which mip level and layer, side or slice.
    pub slice: Slice,
    /// Which sample of texels with several; the mean of all without one.
    pub sample: Option<u32>,
    /// Colours or depth, or stencil.
    pub aspect: Aspect,
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
            slice: Slice::default(),
            sample: None,
            aspect: Aspect::Main,
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

/// Near and far plane as the shaders that show depth have them: 0 for one at infinity.
pub(super) fn planes(at: &Between<'_>) -> (f32, f32) {
    let frame = &at.frame.data;
    let far = if frame.far.is_finite() {
        frame.far
    } else {
        0.0
    };
    (frame.near, far)
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
    slice: i32,
    sample: i32,
}

/// A way to show one kind of texels.
struct Display {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

/// What the picture shows at the moment.
struct Shown {
    texture: wgpu::Texture,
    slice: Slice,
    aspect: Aspect,
    group: wgpu::BindGroup,
}

/// Draws targets into a picture.
pub(super) struct Shower {
    gpu: Gpu,
    uniforms: wgpu::Buffer,
    displays: HashMap<Texels, Display>,
    request: Option<Inspection>,
    picture: Option<wgpu::Texture>,
    shown: Option<Shown>,
}

impl Shower {
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
            displays: HashMap::new(),
            request: None,
            picture: None,
            shown: None,
        }
    }

    pub fn look(&mut self, request: Option<Inspection>) {
        if request.is_none() {
            self.picture = None;
            self.shown = None;
        }
        self.request = request;
    }

    pub fn forget_shaders(&mut self) {
        self.displays.clear();
        self.shown = None;
    }

    pub fn request(&self) -> Option<&Inspection> {
        self.request.as_ref()
    }

    pub fn picture(&self) -> Option<&wgpu::Texture> {
        self.picture.as_ref()
    }

    /// Draws the picture if it is the pass to look at. Nothing is drawn where the target has no such
    /// slice.
    pub fn after_pass(
        &mut self,
        at: &Between<'_>,
        files: &Files,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        let request = self.request.clone();
        let Some(request) = request.filter(|request| request.pass == at.index) else {
            return Ok(());
        };
        let Some(target) = at.targets.get(&request.target) else {
            return Ok(());
        };
        let Slice { mip, layer } = request.slice;
        let format = Format(target.texture.format());
        if mip >= target.texture.mip_level_count()
            || layer >= target.layers_of_mip(mip)
            || (request.aspect == Aspect::Stencil && !format.has_stencil())
        {
            self.picture = None;
            return Ok(());
        }
        let texels = Texels::of(target, request.aspect);
        let display = match self.displays.entry(texels) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(empty) => empty.insert(display(&self.gpu, files, texels)?),
        };

        let (near, far) = planes(at);
        let data = InspectionData {
            low: request.low,
            high: request.high,
            near,
            far,
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
            slice: layer as i32,
            sample: request.sample.map_or(-1, |sample| sample as i32),
        };
        self.gpu
            .queue
            .write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&data));

        let (width, height) = target.mip_size(mip);
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let picture = match self.picture.take() {
            Some(picture) if picture.size() == size => picture,
            _ => screen::canvas(&self.gpu, size),
        };
        let picture = self.picture.insert(picture);
        let shown = match self.shown.take() {
            Some(shown)
                if shown.texture == target.texture
                    && shown.slice == request.slice
                    && shown.aspect == request.aspect =>
            {
                shown
            }
            _ => Shown {
                texture: target.texture.clone(),
                slice: request.slice,
                aspect: request.aspect,
                group: self
                    .gpu
                    .device
                    .create_bind_group(&wgpu::BindGroupDescriptor {
                        label: Some("inspect"),
                        layout: &display.layout,
                        entries: &[
                            wgpu::BindGroupEntry {
                                binding: 0,
                                resource: self.uniforms.as_entire_binding(),
                            },
                            wgpu::BindGroupEntry {
                                binding: BINDING,
                                resource: wgpu::BindingResource::TextureView(&texels.view(
                                    target,
                                    request.slice,
                                    request.aspect,
                                )),
                            },
                        ],
                    }),
            },
        };
        let shown = self.shown.insert(shown);

        screen::paint(encoder, picture, &display.pipeline, &shown.group);
        Ok(())
    }
}

fn display(gpu: &Gpu, files: &Files, texels: Texels) -> Result<Display, Problem> {
    let module = texels.module(gpu, files, SHADER)?;
    let build = || {
        gpu.device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("inspect"),
                entries: &[
                    wgpu::BindGroupLayoutEntry {
                        binding: 0,
                        visibility: wgpu::ShaderStages::FRAGMENT,
                        ty: wgpu::BindingType::Buffer {
                            ty: wgpu::BufferBindingType::Uniform,
                            has_dynamic_offset: false,
                            min_binding_size: None,
                        },
                        count: None,
                    },
                    texels.layout(wgpu::ShaderStages::FRAGMENT),
                ],
            })
    };
    let layout = gpu
        .guarded(build)
        .map_err(|error| Problem::new(Place::file(SHADER), error))?;
    let pipeline = screen::pipeline(gpu, files, SHADER, &module, &layout)?;
    Ok(Display { layout, pipeline })
}
