//! Counts the memory that each thread holds, so that a script can be stopped before it takes all.
//!
//! Rhai bounds single values, never their sum: a thousand arrays of a thousand texts pass every one
//! of its limits. Only the allocator sees the sum.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    // Constant initialisation and no destructor: reading it never allocates, at any time of a
    // thread's life.
    static LIVE: Cell<i64> = const { Cell::new(0) };
}

/// The system's allocator, with a count of live bytes for each thread.
///
/// A program that runs strangers' scripts installs it once:
///
/// ```
/// #[global_allocator]
/// static ALLOCATOR: lightbench_script::CountingAllocator = lightbench_script::CountingAllocator;
/// # fn main() {}
/// ```
///
/// Without it [`Limits::memory_bytes`](crate::Limits::memory_bytes) has no effect. The cost is one
/// addition to a thread-local number an allocation.
#[derive(Clone, Copy, Debug, Default)]
pub struct CountingAllocator;

/// Bytes that the calling thread took and nobody has given back on it. Negative on a thread that
/// frees what others took; always 0 where [`CountingAllocator`] is not installed.
pub(crate) fn live_bytes() -> i64 {
    LIVE.get()
}

fn count(bytes: usize, sign: i64) {
    LIVE.set(LIVE.get().wrapping_add(sign * bytes as i64));
}

// SAFETY: every call goes unchanged to `System`, which keeps the contract; counting neither
// allocates nor unwinds.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the contract of `GlobalAlloc::alloc`.
        let memory = unsafe { System.alloc(layout) };
        if !memory.is_null() {
            count(layout.size(), 1);
        }
        memory
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `GlobalAlloc::dealloc`.
        unsafe { System.dealloc(memory, layout) };
        count(layout.size(), -1);
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the contract of `GlobalAlloc::alloc_zeroed`.
        let memory = unsafe { System.alloc_zeroed(layout) };
        if !memory.is_null() {
            count(layout.size(), 1);
        }
        memory
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller keeps the contract of `GlobalAlloc::realloc`.
        let moved = unsafe { System.realloc(memory, layout, size) };
        if !moved.is_null() {
            count(layout.size(), -1);
            count(size, 1);
        }
        moved
    }
}
