//! How far a buffer is on its way to the CPU.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

const IDLE: u8 = 0;
const COPIED: u8 = 1;
const MAPPING: u8 = 2;
const MAPPED: u8 = 3;
const FAILED: u8 = 4;

/// The state of a buffer that frames copy results into and the CPU reads some frames later: idle, copied
/// to, being mapped, mapped, idle again. The device must be polled for it, and nothing waits.
#[derive(Clone, Debug, Default)]
pub(crate) struct WayBack(Arc<AtomicU8>);

impl WayBack {
    fn is(&self, state: u8) -> bool {
        self.0.load(Ordering::Acquire) == state
    }

    /// Whether a frame may copy to the buffer.
    pub(crate) fn is_idle(&self) -> bool {
        self.is(IDLE)
    }

    /// A copy to the buffer was recorded.
    pub(crate) fn copied(&self) {
        self.0.store(COPIED, Ordering::Release);
    }

    /// The frame was submitted: if it copies to the buffer, that is mapped.
    pub(crate) fn submitted(&self, buffer: &wgpu::Buffer) {
        if !self.is(COPIED) {
            return;
        }
        self.0.store(MAPPING, Ordering::Release);
        let state = Arc::clone(&self.0);
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            let reached = if result.is_ok() { MAPPED } else { FAILED };
            state.store(reached, Ordering::Release);
        });
    }

    /// What the buffer holds, once, if it has come; `None` in it where the device failed.
    pub(crate) fn take<T>(
        &self,
        buffer: &wgpu::Buffer,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Option<Option<T>> {
        let mapped = self.is(MAPPED);
        if !mapped && !self.is(FAILED) {
            return None;
        }
        let mut taken = None;
        if mapped {
            taken = buffer.get_mapped_range(..).ok().map(|view| read(&view));
            buffer.unmap();
        }
        self.0.store(IDLE, Ordering::Release);
        Some(taken)
    }
}
