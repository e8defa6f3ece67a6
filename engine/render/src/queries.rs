//! GPU time and fragments per pass, read back without waiting.
//!
//! Timestamps and statistics of a frame are resolved into one buffer, and a ring of buffers is
//! mapped in the background, so that reading never stalls drawing. When all buffers of the ring
//! are in flight, the frame is drawn without queries.

use std::mem;

use wgpu::{Features, PipelineStatisticsTypes, QueryType};

use crate::gpu::Gpu;
use crate::way_back::WayBack;

/// Passes that can be measured in one frame: what two timestamps each allow in a query set.
const MAX_PASSES: u32 = 256;
/// Frames in flight.
const RING: usize = 4;
/// Bytes of one query result; resolves must be aligned to 256.
const RESULT: u64 = 8;
const STATISTICS_AT: u64 = MAX_PASSES as u64 * 2 * RESULT;
/// Results of one statistics query: vertex and fragment invocations.
const STATISTICS: u64 = 2;
const COUNTERS_AT: u64 = STATISTICS_AT + MAX_PASSES as u64 * STATISTICS * RESULT;
/// Counters that a pipeline may have.
pub const MAX_COUNTERS: usize = 16;
const BYTES: u64 = COUNTERS_AT + MAX_COUNTERS as u64 * 4;

/// What can be measured of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Nothing: the pass does not run, or only copies.
    Nothing,
    /// Its time.
    Time,
    /// Its time, vertices and fragments.
    TimeAndInvocations,
}

/// What the queries of one frame measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// The frame that it belongs to.
    pub frame: u32,
    /// Milliseconds per pass, 0 for passes without a time; empty without timestamps.
    pub gpu_ms: Vec<f64>,
    /// Milliseconds from the first pass's beginning to the last one's end.
    pub total_ms: Option<f64>,
    /// Fragments per pass; empty without pipeline statistics.
    pub fragments: Vec<u64>,
    /// Vertices that vertex stages ran for, per pass; empty without pipeline statistics.
    pub vertices: Vec<u64>,
    /// The pipeline's counters, in the order of their declarations.
    pub counters: Vec<u32>,
}

impl Measured {
    /// Nothing yet, with memory for all that a frame can measure: when results come back is the
    /// driver's choice, and none of them should make a frame allocate.
    fn with_room() -> Self {
        let passes = MAX_PASSES as usize;
        Self {
            gpu_ms: Vec::with_capacity(passes),
            fragments: Vec::with_capacity(passes),
            vertices: Vec::with_capacity(passes),
            counters: Vec::with_capacity(MAX_COUNTERS),
            ..Self::default()
        }
    }
}

/// Where the results of a pass lie in the query sets. Only queries that are written may be
/// resolved, so passes that are not measured have none.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    time: Option<u32>,
    invocations: Option<u32>,
}

/// What one frame measures.
#[derive(Clone, Debug, Default)]
struct Plan {
    places: Vec<Place>,
    times: u32,
    invocations: u32,
    counters: usize,
}

impl Plan {
    /// Takes the memory of an older plan.
    fn set(&mut self, passes: impl Iterator<Item = Measure>, counters: usize) {
        self.places.clear();
        (self.times, self.invocations) = (0, 0);
        self.counters = counters.min(MAX_COUNTERS);
        for measure in passes {
            let next = |count: &mut u32, wanted: bool| {
                (wanted && *count < MAX_PASSES).then(|| {
                    *count += 1;
                    *count - 1
                })
            };
            let place = Place {
                time: next(&mut self.times, measure != Measure::Nothing),
                invocations: next(
                    &mut self.invocations,
                    measure == Measure::TimeAndInvocations,
                ),
            };
            self.places.push(place);
        }
    }
}

struct Slot {
    buffer: wgpu::Buffer,
    back: WayBack,
    frame: u32,
    plan: Plan,
}

/// The query sets of a device.
pub struct Queries {
    timestamps: Option<wgpu::QuerySet>,
    statistics: Option<wgpu::QuerySet>,
    resolve: wgpu::Buffer,
    ring: Vec<Slot>,
    current: Option<usize>,
    /// Whether frames are measured.
    enabled: bool,
    period_ns: f64,
    /// What came back last, and the memory of what came before.
    found: Vec<Measured>,
    spare: Vec<Measured>,
}

impl Queries {
    /// Query sets for what the device can measure.
    pub fn new(gpu: &Gpu) -> Self {
        let features = gpu.device.features();
        let set = |ty, count| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("passes"),
                ty,
                count,
            })
        };
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("queries"),
                size: BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        let invocations = PipelineStatisticsTypes::VERTEX_SHADER_INVOCATIONS
            | PipelineStatisticsTypes::FRAGMENT_SHADER_INVOCATIONS;
        Self {
            timestamps: features
                .contains(Features::TIMESTAMP_QUERY)
                .then(|| set(QueryType::Timestamp, MAX_PASSES * 2)),
            statistics: features
                .contains(Features::PIPELINE_STATISTICS_QUERY)
                .then(|| set(QueryType::PipelineStatistics(invocations), MAX_PASSES)),
            resolve: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            ring: (0..RING)
                .map(|_| Slot {
                    buffer: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
                    back: WayBack::default(),
                    frame: 0,
                    plan: Plan::default(),
                })
                .collect(),
            current: None,
            enabled: true,
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
            found: Vec::with_capacity(RING),
            spare: (0..RING).map(|_| Measured::with_room()).collect(),
        }
    }

    /// Whether the frames that begin from now on are measured.
    pub fn enable(&mut self, enabled: bool) {
        self.enabled = enabled;
    }

    /// Begins a frame. Without a free buffer the frame is not measured.
    pub fn begin(&mut self, frame: u32, passes: impl Iterator<Item = Measure>, counters: usize) {
        let available = self.timestamps.is_some() || self.statistics.is_some() || counters > 0;
        let measurable = self.enabled && available;
        let free = self.ring.iter().position(|slot| slot.back.is_idle());
        self.current = free.filter(|_| measurable);
        if let Some(slot) = self.current.and_then(|index| self.ring.get_mut(index)) {
            slot.frame = frame;
            slot.plan.set(passes, counters);
        }
    }

    fn place(&self, pass: usize) -> Option<Place> {
        let slot = self.ring.get(self.current?)?;
        slot.plan.places.get(pass).copied()
    }

    /// Where a compute pass writes its two timestamps.
    pub fn compute_timestamps(&self, pass: usize) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        self.timestamps(pass)
            .map(|writes| wgpu::ComputePassTimestampWrites {
                query_set: writes.query_set,
                beginning_of_pass_write_index: writes.beginning_of_pass_write_index,
                end_of_pass_write_index: writes.end_of_pass_write_index,
            })
    }

    /// As [`Queries::timestamps`] for a pass that consists of several render passes: the first one
    /// writes the beginning, the last one the end.
    pub fn span(
        &self,
        pass: usize,
        part: usize,
        parts: usize,
    ) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let mut writes = self.timestamps(pass)?;
        writes.beginning_of_pass_write_index =
            writes.beginning_of_pass_write_index.filter(|_| part == 0);
        writes.end_of_pass_write_index =
            writes.end_of_pass_write_index.filter(|_| part + 1 == parts);
        let some = writes.beginning_of_pass_write_index.is_some()
            || writes.end_of_pass_write_index.is_some();
        some.then_some(writes)
    }

    /// Where a pass writes its two timestamps.
    pub fn timestamps(&self, pass: usize) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let at = self.place(pass)?.time?;
        self.timestamps
            .as_ref()
            .map(|query_set| wgpu::RenderPassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(at * 2),
                end_of_pass_write_index: Some(at * 2 + 1),
            })
    }

    /// Begins counting a pass's vertices and fragments.
    pub fn begin_statistics(&self, pass: usize, render_pass: &mut wgpu::RenderPass<'_>) {
        let at = self.place(pass).and_then(|place| place.invocations);
        if let (Some(set), Some(at)) = (&self.statistics, at) {
            render_pass.begin_pipeline_statistics_query(set, at);
        }
    }

    /// Ends counting.
    pub fn end_statistics(&self, pass: usize, render_pass: &mut wgpu::RenderPass<'_>) {
        let at = self.place(pass).and_then(|place| place.invocations);
        if self.statistics.is_some() && at.is_some() {
            render_pass.end_pipeline_statistics_query();
        }
    }

    /// Copies one counter's word to the frame's results.
    pub fn counter(
        &self,
        counter: usize,
        buffer: &wgpu::Buffer,
        word: u32,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let at = u64::from(word) * 4;
        let slot = self.current.and_then(|index| self.ring.get(index));
        let fits = |slot: &&Slot| counter < slot.plan.counters && at + 4 <= buffer.size();
        if let Some(slot) = slot.filter(fits) {
            let to = COUNTERS_AT + counter as u64 * 4;
            encoder.copy_buffer_to_buffer(buffer, at, &slot.buffer, to, 4);
        }
    }

    /// Ends the frame: copies the results to the frame's buffer.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let Some(slot) = self.current.and_then(|index| self.ring.get(index)) else {
            return;
        };
        let Plan {
            times,
            invocations,
            counters,
            ..
        } = slot.plan;
        if times == 0 && counters == 0 {
            self.current = None;
            return;
        }
        if let Some(set) = self.timestamps.as_ref().filter(|_| times > 0) {
            encoder.resolve_query_set(set, 0..times * 2, &self.resolve, 0);
        }
        if let Some(set) = self.statistics.as_ref().filter(|_| invocations > 0) {
            encoder.resolve_query_set(set, 0..invocations, &self.resolve, STATISTICS_AT);
        }
        encoder.copy_buffer_to_buffer(&self.resolve, 0, &slot.buffer, 0, COUNTERS_AT);
    }

    /// Asks for the results; call it after the frame was submitted.
    pub fn submitted(&mut self) {
        let Some(slot) = self.current.take().and_then(|index| self.ring.get(index)) else {
            return;
        };
        slot.back.copied();
        slot.back.submitted(&slot.buffer);
    }

    /// Results that have come back, oldest frame first, until the next call. The device must be polled
    /// for them.
    pub fn collect(&mut self) -> &[Measured] {
        let (mut spare, mut found) = (mem::take(&mut self.spare), mem::take(&mut self.found));
        spare.append(&mut found);
        for slot in &self.ring {
            slot.back.take(&slot.buffer, |bytes| {
                let mut measured = spare.pop().unwrap_or_default();
                self.read(slot, bytes, &mut measured);
                found.push(measured);
            });
        }
        (self.spare, self.found) = (spare, found);
        self.found.sort_unstable_by_key(|measured| measured.frame);
        &self.found
    }

    /// Fills `out`, whose memory it takes.
    fn read(&self, slot: &Slot, bytes: &[u8], out: &mut Measured) {
        let long = |at: u64| {
            let at = at as usize;
            let bytes = bytes
                .get(at..at + 8)
                .and_then(|bytes| bytes.try_into().ok());
            bytes.map_or(0, u64::from_le_bytes)
        };
        let word = |at: u64| {
            let at = at as usize;
            let bytes = bytes
                .get(at..at + 4)
                .and_then(|bytes| bytes.try_into().ok());
            bytes.map_or(0, u32::from_le_bytes)
        };
        let stamp = |index: u32| long(u64::from(index) * RESULT);
        let ms = |from: u64, to: u64| to.saturating_sub(from) as f64 * self.period_ns * 1e-6;
        let plan = &slot.plan;
        let timed = self.timestamps.is_some();
        out.frame = slot.frame;
        out.total_ms = (timed && plan.times > 0).then(|| ms(stamp(0), stamp(plan.times * 2 - 1)));
        out.gpu_ms.clear();
        if timed {
            out.gpu_ms.extend(plan.places.iter().map(|place| {
                let time = place.time;
                time.map_or(0.0, |at| ms(stamp(at * 2), stamp(at * 2 + 1)))
            }));
        }
        for (which, values) in [(0, &mut out.vertices), (1, &mut out.fragments)] {
            values.clear();
            if self.statistics.is_some() {
                values.extend(plan.places.iter().map(|place| {
                    let at =
                        |at: u32| STATISTICS_AT + (u64::from(at) * STATISTICS + which) * RESULT;
                    place.invocations.map_or(0, |index| long(at(index)))
                }));
            }
        }
        out.counters.clear();
        let counters = 0..plan.counters as u64;
        out.counters
            .extend(counters.map(|counter| word(COUNTERS_AT + counter * 4)));
    }
}
