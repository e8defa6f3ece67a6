//! What each pass of one frame does to a pixel, and where values are that are no numbers.

use lightbench_assets::files::Files;

use super::Between;
use super::read::{READ, Readers, RequestData, SEARCH, TEXEL_BYTES};
use super::texels::{Aspect, Texels};
use super::written::written;
use crate::Format;
use crate::description::Slice;
use crate::gpu::Gpu;
use crate::problem::Problem;
use crate::reflection::SampleKind;
use crate::targets::Target;
use crate::way_back::WayBack;

/// What to read in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProbeRequest {
    /// A pixel of the output, from the upper left corner: its value before and after each pass, in
    /// each target that the pass writes. Outside of the picture there are none.
    pub pixel: Option<(u32, u32)>,
    /// Whether to look in everything that is written for values that are no numbers, or infinite.
    pub search: bool,
}

/// What came back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Probed {
    /// The pixel that was asked for.
    pub pixel: Option<(u32, u32)>,
    /// In the order of the passes.
    pub values: Vec<PixelValue>,
    /// Whether values were looked for that are no numbers.
    pub searched: bool,
    /// The slices that hold such values, in the order of the passes.
    pub invalid: Vec<Invalid>,
    /// Whether there was more to read than the buffers hold.
    pub cut_off: bool,
}

/// The bits of a texel as what they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TexelValue {
    /// Floats, normalised integers, depth.
    Float([f32; 4]),
    /// Unsigned integers.
    Uint([u32; 4]),
    /// Signed integers.
    Sint([i32; 4]),
}

impl TexelValue {
    pub(super) fn new(kind: SampleKind, bits: [u32; 4]) -> Self {
        match kind {
            SampleKind::Float | SampleKind::Depth => Self::Float(bits.map(f32::from_bits)),
            SampleKind::Uint => Self::Uint(bits),
            SampleKind::Sint => Self::Sint(bits.map(|word| word as i32)),
        }
    }

    /// The numbers as floats; integers above 2²⁴ are rounded.
    pub fn to_floats(self) -> [f32; 4] {
        match self {
            Self::Float(values) => values,
            Self::Uint(values) => values.map(|value| value as f32),
            Self::Sint(values) => values.map(|value| value as f32),
        }
    }

    /// The first so many channels, for people.
    pub fn in_words(self, channels: u32) -> String {
        let texts: Vec<String> = match self {
            Self::Float(values) => values.map(|value| format!("{value:.6}")).to_vec(),
            Self::Uint(values) => values.map(|value| value.to_string()).to_vec(),
            Self::Sint(values) => values.map(|value| value.to_string()).to_vec(),
        };
        texts[..(channels as usize).min(4)].join(" ")
    }
}

/// The value of a target at a pixel around a pass that wrote it. In targets of another size it is the
/// texel at the same place of the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelValue {
    /// The index of the pass.
    pub pass: usize,
    /// The target.
    pub target: String,
    /// Which mip level and layer.
    pub slice: Slice,
    /// Which sample; none for targets with one.
    pub sample: Option<u32>,
    /// Colours or depth, or stencil.
    pub aspect: Aspect,
    /// Channels that it has.
    pub channels: u32,
    /// Before the pass; nothing where the frame had not written it yet.
    pub before: Option<TexelValue>,
    /// After it.
    pub after: TexelValue,
}

/// Values that are no numbers, or infinite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invalid {
    /// The index of the pass that left them.
    pub pass: usize,
    /// The target.
    pub target: String,
    /// Which mip level and layer.
    pub slice: Slice,
    /// Which sample; none for targets with one.
    pub sample: Option<u32>,
    /// How many texels hold one.
    pub texels: u32,
    /// The first of them, from the upper left corner.
    pub first: (u32, u32),
}

/// Readings in one frame.
const CAPACITY: usize = 4096;
/// Bytes from one request to the next: dynamic offsets are aligned so far at most.
const STEP: usize = 256;

/// One reading: where its answer is, and what it is about.
struct Reading {
    what: What,
    pass: usize,
    target: String,
    slice: Slice,
    sample: Option<u32>,
    aspect: Aspect,
    kind: SampleKind,
    format: Format,
    width: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum What {
    Before,
    After,
    Search,
}

/// Reads texels between the passes of a frame.
pub(super) struct Prober {
    gpu: Gpu,
    readers: Readers,
    request: ProbeRequest,
    /// What the readings on their way were asked for.
    recorded: ProbeRequest,
    readings: Vec<Reading>,
    requests: Vec<u8>,
    cut_off: bool,
    buffers: Option<Buffers>,
    back: WayBack,
}

struct Buffers {
    requests: wgpu::Buffer,
    results: wgpu::Buffer,
    back: wgpu::Buffer,
}

impl Prober {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            readers: Readers::default(),
            request: ProbeRequest::default(),
            recorded: ProbeRequest::default(),
            readings: Vec::new(),
            requests: Vec::new(),
            cut_off: false,
            buffers: None,
            back: WayBack::default(),
        }
    }

    pub fn ask(&mut self, request: ProbeRequest) {
        self.request = request;
    }

    pub fn forget_shaders(&mut self) {
        self.readers.clear();
    }

    pub fn give_up(&mut self) {
        self.request = ProbeRequest::default();
        self.readings.clear();
        self.requests.clear();
    }

    fn is_asked(&self) -> bool {
        self.back.is_idle() && self.request != ProbeRequest::default()
    }

    pub fn is_busy(&self) -> bool {
        self.request != ProbeRequest::default() || !self.back.is_idle()
    }

    pub fn before_pass(
        &mut self,
        at: &Between<'_>,
        files: &Files,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        if self.is_asked() && self.request.pixel.is_some() {
            self.read(at, What::Before, files, encoder)?;
        }
        Ok(())
    }

    pub fn after_pass(
        &mut self,
        at: &Between<'_>,
        files: &Files,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        if !self.is_asked() {
            return Ok(());
        }
        if self.request.pixel.is_some() {
            self.read(at, What::After, files, encoder)?;
        }
        if self.request.search {
            self.read(at, What::Search, files, encoder)?;
        }
        Ok(())
    }

    /// Reads in everything that the pass writes.
    fn read(
        &mut self,
        at: &Between<'_>,
        what: What,
        files: &Files,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        let (width, height) = at.targets.size;
        let outside = |(x, y): (u32, u32)| x >= width || y >= height;
        if what != What::Search && self.request.pixel.is_none_or(outside) {
            return Ok(());
        }
        let mut result = Ok(());
        written(at.pass, at.targets, at.frame, at.list, |target, slice| {
            let stencil = Format(target.texture.format()).has_stencil() && what != What::Search;
            let aspects = [Some(Aspect::Main), stencil.then_some(Aspect::Stencil)];
            let samples = target.texture.sample_count();
            for aspect in aspects.into_iter().flatten() {
                for sample in 0..samples {
                    if result.is_ok() {
                        let sample = (samples > 1).then_some(sample);
                        result = self.one(at, what, target, slice, aspect, sample, files, encoder);
                    }
                }
            }
        });
        result
    }

    #[allow(clippy::too_many_arguments)] // Each of them says which texel.
    fn one(
        &mut self,
        at: &Between<'_>,
        what: What,
        target: &Target,
        slice: Slice,
        aspect: Aspect,
        sample: Option<u32>,
        files: &Files,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        let texels = Texels::of(target, aspect);
        let floats = matches!(texels.kind, SampleKind::Float | SampleKind::Depth);
        if what == What::Search && !floats {
            return Ok(());
        }
        if self.readings.len() == CAPACITY {
            self.cut_off = true;
            return Ok(());
        }
        let (width, height) = target.mip_size(slice.mip);
        let (mut corner, mut size) = ([0, 0], [width, height]);
        if what != What::Search {
            let (x, y) = self.request.pixel.unwrap_or_default();
            let scaled = |at: u32, length: u32, of: u32| {
                (u64::from(at) * u64::from(length) / u64::from(of.max(1))) as i32
            };
            let (full_width, full_height) = at.targets.size;
            corner = [scaled(x, width, full_width), scaled(y, height, full_height)];
            size = [1, 1];
        }
        let slot = self.readings.len() as u32;
        // Answers of a search are two words of the slot's four.
        let first = if what == What::Search { slot * 4 } else { slot };
        let data = RequestData {
            corner: [corner[0], corner[1], slice.layer as i32],
            sample: sample.unwrap_or(0) as i32,
            size,
            first,
            padding: 0,
        };
        let offset = slot as usize * STEP;
        self.requests.resize(offset, 0);
        self.requests.extend_from_slice(bytemuck::bytes_of(&data));
        self.readings.push(Reading {
            what,
            pass: at.index,
            target: target.name.clone(),
            slice,
            sample,
            aspect,
            kind: texels.kind,
            format: Format(target.texture.format()),
            width,
        });

        let gpu = self.gpu.clone();
        let buffers = self.buffers.get_or_insert_with(|| Buffers::new(&gpu));
        if slot == 0 {
            encoder.clear_buffer(&buffers.results, 0, None);
        }
        let shader = if what == What::Search { SEARCH } else { READ };
        let view = texels.view(target, slice, aspect);
        let reader = self.readers.get(&gpu, files, shader, texels)?;
        let requests = (&buffers.requests, offset as u32, size_of::<RequestData>());
        reader.run(&gpu, encoder, &view, requests, &buffers.results, size);
        Ok(())
    }

    pub fn end_frame(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let Some(buffers) = self.buffers.as_ref().filter(|_| !self.requests.is_empty()) else {
            return;
        };
        // Written before the commands of the frame run.
        self.gpu
            .queue
            .write_buffer(&buffers.requests, 0, &self.requests);
        self.requests.clear();
        // What is asked for meanwhile is read in a frame of its own.
        self.recorded = std::mem::take(&mut self.request);
        let bytes = buffers.back.size();
        encoder.copy_buffer_to_buffer(&buffers.results, 0, &buffers.back, 0, bytes);
        self.back.copied();
    }

    pub fn submitted(&mut self) {
        if let Some(buffers) = &self.buffers {
            self.back.submitted(&buffers.back);
        }
    }

    /// The answers, once; what was asked for is done then.
    pub fn take(&mut self) -> Option<Probed> {
        let buffers = self.buffers.as_ref()?;
        let (recorded, readings) = (self.recorded, &mut self.readings);
        let cut_off = &mut self.cut_off;
        let mut probed = Probed {
            pixel: recorded.pixel,
            searched: recorded.search,
            ..Probed::default()
        };
        self.back.take(&buffers.back, |bytes| {
            answer(&mut probed, std::mem::take(readings), bytes);
        })?;
        readings.clear();
        probed.cut_off = std::mem::take(cut_off);
        Some(probed)
    }
}

impl Buffers {
    fn new(gpu: &Gpu) -> Self {
        use wgpu::BufferUsages as Usage;
        let buffer = |size, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("probe"),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let bytes = CAPACITY as u64 * TEXEL_BYTES;
        Self {
            requests: buffer((CAPACITY * STEP) as u64, Usage::UNIFORM | Usage::COPY_DST),
            results: buffer(bytes, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST),
            back: buffer(bytes, Usage::COPY_DST | Usage::MAP_READ),
        }
    }
}

/// Joins readings with what came back for them.
fn answer(probed: &mut Probed, readings: Vec<Reading>, bytes: &[u8]) {
    // Values before a pass, until the same texel's value after it comes.
    let mut before: Vec<(Reading, TexelValue)> = Vec::new();
    for (reading, bytes) in readings
        .into_iter()
        .zip(bytes.chunks_exact(TEXEL_BYTES as usize))
    {
        let bits = bytemuck::pod_read_unaligned::<[u32; 4]>(bytes);
        let value = TexelValue::new(reading.kind, bits);
        match reading.what {
            What::Before => before.push((reading, value)),
            What::After => {
                let known = before.iter().position(|(other, _)| reading.is_after(other));
                let was = known.map(|index| before.swap_remove(index).1);
                let written = probed.values.iter().any(|value| {
                    value.target == reading.target
                        && value.slice == reading.slice
                        && value.aspect == reading.aspect
                });
                probed.values.push(PixelValue {
                    pass: reading.pass,
                    channels: reading.channels(),
                    target: reading.target,
                    slice: reading.slice,
                    sample: reading.sample,
                    aspect: reading.aspect,
                    before: was.filter(|_| written),
                    after: value,
                });
            }
            What::Search if bits[0] > 0 => {
                let first = u32::MAX - bits[1];
                probed.invalid.push(Invalid {
                    pass: reading.pass,
                    target: reading.target,
                    slice: reading.slice,
                    sample: reading.sample,
                    texels: bits[0],
                    first: (first % reading.width, first / reading.width),
                });
            }
            What::Search => {}
        }
    }
}

impl Reading {
    fn is_after(&self, before: &Self) -> bool {
        self.pass == before.pass
            && self.target == before.target
            && self.slice == before.slice
            && self.sample == before.sample
            && self.aspect == before.aspect
    }

    fn channels(&self) -> u32 {
        if self.aspect == Aspect::Stencil || self.kind == SampleKind::Depth {
            1
        } else {
            u32::from(self.format.0.components())
        }
    }
}
