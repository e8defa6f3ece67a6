//! Least and greatest values of a part of a target, and how often values between them occur.
//!
//! The GPU counts; what comes back is a few words a channel, some frames later, so that nothing waits.

use lightbench_assets::files::Files;

use super::Between;
use super::read::{MEASURE, Readers, RequestData};
use super::show::{Inspection, planes};
use super::texels::{Aspect, Texels};
use crate::Format;
use crate::gpu::Gpu;
use crate::problem::Problem;
use crate::reflection::SampleKind;
use crate::way_back::WayBack;

/// Equal parts of the range in which values are counted. Also in `shaders/inspect/measure.wgsl`.
pub const BINS: usize = 64;

/// Words of a channel: least, greatest, finite, not finite, below and above the range, then the bins.
const CHANNEL_WORDS: usize = 6 + BINS;
/// All channels, then the texels to which nothing was drawn.
const WORDS: usize = 4 * CHANNEL_WORDS + 1;
const BYTES: u64 = (WORDS * size_of::<u32>()) as u64;

/// The values of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelMeasure {
    /// The least finite value and the greatest; none where no value is finite.
    pub range: Option<[f32; 2]>,
    /// Finite values.
    pub finite: u32,
    /// Values that are no numbers, or infinite.
    pub invalid: u32,
    /// Finite values below the range of the request.
    pub below: u32,
    /// Finite values above it.
    pub above: u32,
    /// Values in each of [`BINS`] equal parts of the range. The last part holds the upper end too.
    pub bins: Vec<u32>,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Of which target, after which pass, over which range.
    pub request: Inspection,
    /// One entry for each channel that the target has. Depth is a distance in metres.
    pub channels: Vec<ChannelMeasure>,
    /// Texels of a depth target to which nothing was drawn; they count nowhere else.
    pub empty: u32,
}

impl Measured {
    /// The least and the greatest value of the channels that the request shows.
    pub fn range(&self) -> Option<[f32; 2]> {
        let shown = self.shown().filter_map(|(_, channel)| channel.range);
        shown.reduce(|[low, high], [least, most]| [low.min(least), high.max(most)])
    }

    /// The channels that the request shows, with their numbers from 0 for red. Alpha is no colour.
    pub fn shown(&self) -> impl Iterator<Item = (usize, &ChannelMeasure)> {
        use super::Channels;
        let only = match self.request.channels {
            Channels::Color => None,
            Channels::Red => Some(0),
            Channels::Green => Some(1),
            Channels::Blue => Some(2),
            Channels::Alpha => Some(3),
        };
        let channels = self.channels.iter().enumerate();
        channels.filter(move |(index, _)| only.map_or(*index < 3, |only| only == *index))
    }
}

/// As the shader has it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct MeasureData {
    request: RequestData,
    low: f32,
    high: f32,
    near: f32,
    far: f32,
}

struct Buffers {
    requests: wgpu::Buffer,
    results: wgpu::Buffer,
    back: wgpu::Buffer,
}

/// Measures targets between the passes of a frame.
pub(super) struct Measurer {
    gpu: Gpu,
    readers: Readers,
    request: Option<Inspection>,
    /// What is on its way, and how many channels it has.
    recorded: Option<(Inspection, usize)>,
    buffers: Option<Buffers>,
    back: WayBack,
}

impl Measurer {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            readers: Readers::default(),
            request: None,
            recorded: None,
            buffers: None,
            back: WayBack::default(),
        }
    }

    pub fn ask(&mut self, request: Inspection) {
        self.request = Some(request);
    }

    pub fn give_up(&mut self) {
        self.request = None;
    }

    pub fn forget_shaders(&mut self) {
        self.readers.clear();
    }

    pub fn is_busy(&self) -> bool {
        self.request.is_some() || self.recorded.is_some()
    }

    pub fn wants(&self, pass: usize) -> bool {
        let request = self.request.as_ref();
        request.is_some_and(|request| request.pass == pass)
    }

    pub fn after_pass(
        &mut self,
        at: &Between<'_>,
        files: &Files,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), Problem> {
        if self.recorded.is_some() {
            return Ok(());
        }
        let Some(request) = self.request.take_if(|request| request.pass == at.index) else {
            return Ok(());
        };
        // A target, level or layer that is not there is not measured.
        let Some(target) = at.targets.get(&request.target) else {
            return Ok(());
        };
        let slice = request.slice;
        if slice.mip >= target.texture.mip_level_count()
            || slice.layer >= target.layers_of_mip(slice.mip)
        {
            return Ok(());
        }
        let texels = Texels::of(target, request.aspect);
        let (width, height) = target.mip_size(slice.mip);
        let (near, far) = planes(at);
        let data = MeasureData {
            request: RequestData {
                corner: [0, 0, slice.layer as i32],
                sample: request.sample.map_or(-1, |sample| sample as i32),
                size: [width, height],
                first: 0,
                padding: 0,
            },
            low: request.low,
            high: request.high,
            near,
            far,
        };
        let gpu = self.gpu.clone();
        let buffers = self.buffers.get_or_insert_with(|| Buffers::new(&gpu));
        gpu.queue
            .write_buffer(&buffers.requests, 0, bytemuck::bytes_of(&data));
        encoder.clear_buffer(&buffers.results, 0, None);
        let reader = self.readers.get(&gpu, files, MEASURE, texels)?;
        let view = texels.view(target, slice, request.aspect);
        let asked = (&buffers.requests, 0, size_of::<MeasureData>());
        reader.run(
            &gpu,
            encoder,
            &view,
            asked,
            &buffers.results,
            [width, height],
        );
        let single = request.aspect == Aspect::Stencil || texels.kind == SampleKind::Depth;
        let channels = match single {
            true => 1,
            false => usize::from(Format(target.texture.format()).0.components()),
        };
        self.recorded = Some((request, channels.min(4)));
        Ok(())
    }

    pub fn end_frame(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(buffers) = &self.buffers
            && self.recorded.is_some()
            && self.back.is_idle()
        {
            encoder.copy_buffer_to_buffer(&buffers.results, 0, &buffers.back, 0, BYTES);
            self.back.copied();
        }
    }

    pub fn submitted(&mut self) {
        if let Some(buffers) = &self.buffers {
            self.back.submitted(&buffers.back);
        }
    }

    /// The answer, once.
    pub fn take(&mut self) -> Option<Measured> {
        let buffers = self.buffers.as_ref()?;
        let words = self.back.take(&buffers.back, |bytes| {
            let words = bytes.chunks_exact(size_of::<u32>());
            words.map(bytemuck::pod_read_unaligned).collect()
        })?;
        let (request, channels) = self.recorded.take()?;
        let words: Vec<u32> = words?;
        Some(Measured {
            channels: words
                .chunks_exact(CHANNEL_WORDS)
                .take(channels)
                .map(channel)
                .collect(),
            empty: words.last().copied().unwrap_or_default(),
            request,
        })
    }
}

impl Buffers {
    fn new(gpu: &Gpu) -> Self {
        use wgpu::BufferUsages as Usage;
        let buffer = |size, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("measure"),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let request = size_of::<MeasureData>() as u64;
        Self {
            requests: buffer(request, Usage::UNIFORM | Usage::COPY_DST),
            results: buffer(BYTES, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST),
            back: buffer(BYTES, Usage::COPY_DST | Usage::MAP_READ),
        }
    }
}

fn channel(words: &[u32]) -> ChannelMeasure {
    let finite = words[2];
    ChannelMeasure {
        // The shader keeps the greatest of the keys turned round for the least value.
        range: (finite > 0).then(|| [value_of(!words[0]), value_of(words[1])]),
        finite,
        invalid: words[3],
        below: words[4],
        above: words[5],
        bins: words[6..].to_vec(),
    }
}

/// The float of a key: the twin of `key` in `shaders/inspect/measure.wgsl`, turned round.
fn value_of(key: u32) -> f32 {
    let bits = if key & 0x8000_0000 == 0 {
        !key
    } else {
        key & 0x7fff_ffff
    };
    f32::from_bits(bits)
}
