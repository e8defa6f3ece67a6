//! GPU time and fragments per pass, read back without waiting.
//!
//! Timestamps and statistics of a frame are resolved into one buffer, and a ring of buffers is
//! mapped in the background, so that reading never stalls drawing. When all buffers of the ring
//! are in flight, the frame is drawn without queries.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use wgpu::{Features, PipelineStatisticsTypes, QueryType};

use crate::gpu::Gpu;

/// Passes that can be measured in one frame: what two timestamps each allow in a query set.
const MAX_PASSES: u32 = 256;
/// Frames in flight.
const RING: usize = 4;
/// Bytes of one query result; resolves must be aligned to 256.
const RESULT: u64 = 8;
const STATISTICS_AT: u64 = MAX_PASSES as u64 * 2 * RESULT;
const BYTES: u64 = STATISTICS_AT + MAX_PASSES as u64 * RESULT;

const IDLE: u8 = 0;
const IN_FLIGHT: u8 = 1;
const READY: u8 = 2;
const FAILED: u8 = 3;

/// What the queries of one frame measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// The frame that it belongs to.
    pub frame: u32,
    /// Milliseconds per pass; empty without timestamps.
    pub gpu_ms: Vec<f64>,
    /// Milliseconds from the first pass's beginning to the last one's end.
    pub total_ms: Option<f64>,
    /// Fragments per pass; empty without pipeline statistics.
    pub fragments: Vec<u64>,
}

struct Slot {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    frame: u32,
    passes: u32,
}

/// The query sets of a device.
pub struct Queries {
    timestamps: Option<wgpu::QuerySet>,
    statistics: Option<wgpu::QuerySet>,
    resolve: wgpu::Buffer,
    ring: Vec<Slot>,
    current: Option<usize>,
    period_ns: f64,
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
        let invocations = PipelineStatisticsTypes::FRAGMENT_SHADER_INVOCATIONS;
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
                    state: Arc::new(AtomicU8::new(IDLE)),
                    frame: 0,
                    passes: 0,
                })
                .collect(),
            current: None,
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
        }
    }

    /// Begins a frame of `passes` passes. Without a free buffer the frame is not measured.
    pub fn begin(&mut self, frame: u32, passes: usize) {
        let measurable = self.timestamps.is_some() || self.statistics.is_some();
        let free = self
            .ring
            .iter()
            .position(|slot| slot.state.load(Ordering::Acquire) == IDLE);
        self.current = free.filter(|_| measurable && passes <= MAX_PASSES as usize);
        if let Some(slot) = self.current.and_then(|index| self.ring.get_mut(index)) {
            slot.frame = frame;
            slot.passes = passes as u32;
        }
    }

    /// Where a pass writes its two timestamps.
    pub fn timestamps(&self, pass: usize) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        self.current?;
        self.timestamps
            .as_ref()
            .map(|query_set| wgpu::RenderPassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(pass as u32 * 2),
                end_of_pass_write_index: Some(pass as u32 * 2 + 1),
            })
    }

    /// Begins counting a pass's fragments.
    pub fn begin_statistics(&self, pass: usize, render_pass: &mut wgpu::RenderPass<'_>) {
        if let (Some(set), Some(_)) = (&self.statistics, self.current) {
            render_pass.begin_pipeline_statistics_query(set, pass as u32);
        }
    }

    /// Ends counting.
    pub fn end_statistics(&self, render_pass: &mut wgpu::RenderPass<'_>) {
        if self.statistics.is_some() && self.current.is_some() {
            render_pass.end_pipeline_statistics_query();
        }
    }

    /// Ends the frame: copies the results to the frame's buffer.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let Some(slot) = self.current.and_then(|index| self.ring.get(index)) else {
            return;
        };
        if slot.passes == 0 {
            self.current = None;
            return;
        }
        if let Some(set) = &self.timestamps {
            encoder.resolve_query_set(set, 0..slot.passes * 2, &self.resolve, 0);
        }
        if let Some(set) = &self.statistics {
            encoder.resolve_query_set(set, 0..slot.passes, &self.resolve, STATISTICS_AT);
        }
        encoder.copy_buffer_to_buffer(&self.resolve, 0, &slot.buffer, 0, BYTES);
    }

    /// Asks for the results; call it after the frame was submitted.
    pub fn submitted(&mut self) {
        let Some(slot) = self.current.take().and_then(|index| self.ring.get(index)) else {
            return;
        };
        slot.state.store(IN_FLIGHT, Ordering::Release);
        let state = Arc::clone(&slot.state);
        slot.buffer
            .map_async(wgpu::MapMode::Read, .., move |result| {
                state.store(
                    if result.is_ok() { READY } else { FAILED },
                    Ordering::Release,
                );
            });
    }

    /// Results that have come back, oldest frame first. The device must be polled for them.
    pub fn collect(&mut self) -> Vec<Measured> {
        let mut found = Vec::new();
        for slot in &self.ring {
            match slot.state.load(Ordering::Acquire) {
                READY => {
                    if let Ok(view) = slot.buffer.get_mapped_range(..) {
                        found.push(self.read(slot, &view));
                    }
                    slot.buffer.unmap();
                    slot.state.store(IDLE, Ordering::Release);
                }
                FAILED => slot.state.store(IDLE, Ordering::Release),
                _ => {}
            }
        }
        found.sort_by_key(|measured| measured.frame);
        found
    }

    fn read(&self, slot: &Slot, bytes: &[u8]) -> Measured {
        let value = |at: u64| {
            let at = at as usize;
            let bytes = bytes
                .get(at..at + 8)
                .and_then(|bytes| bytes.try_into().ok());
            bytes.map_or(0, u64::from_le_bytes)
        };
        let stamp = |index: u32| value(u64::from(index) * RESULT);
        let ms = |from: u64, to: u64| to.saturating_sub(from) as f64 * self.period_ns * 1e-6;
        let timed = self.timestamps.is_some();
        let passes = 0..slot.passes;
        Measured {
            frame: slot.frame,
            gpu_ms: passes
                .clone()
                .filter(|_| timed)
                .map(|p| ms(stamp(p * 2), stamp(p * 2 + 1)))
                .collect(),
            total_ms: timed.then(|| ms(stamp(0), stamp(slot.passes * 2 - 1))),
            fragments: passes
                .filter(|_| self.statistics.is_some())
                .map(|p| value(STATISTICS_AT + u64::from(p) * RESULT))
                .collect(),
        }
    }
}
