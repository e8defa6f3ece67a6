//! How the C library's allocator treats memory that was freed: what it keeps, what it gives back.

/// Bytes from which on a piece of memory is a mapping of its own, which is given back when freed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const OWN_MAPPING: libc::c_int = 8 << 20;

/// Bytes that may lie free at the end of a heap before they are given back.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: libc::c_int = 64 << 20;

/// Lets the allocator keep what a software driver frees, since it takes as much again with the next
/// frame. llvmpipe holds the transformed vertices of each draw of an instance in memory of their own,
/// and a page that comes anew from the system must be filled with zeros first. With 256 spheres of 960
/// triangles (`many_lights`, 320 × 180 pixels, two cores) a frame of clustered deferred shading takes
/// 42 ms without this and 23 ms with it, one of deferred lighting 70 and 37 ms: the bench `bars` compares
/// them (`memory`). [`Gpu`](crate::Gpu) calls it when it opens a software adapter.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn keep_freed_memory() {
    // SAFETY: the calls take no pointer, and glibc guards its settings against other threads.
    #[allow(unsafe_code)]
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, OWN_MAPPING);
        libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT);
    }
}

/// Other systems' libraries have no such setting.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn keep_freed_memory() {}

/// Gives pages that hold nothing back to the system, where the C library keeps them. Each compilation
/// takes some megabytes of small pieces in several threads, and what is dropped later leaves holes
/// among what stays: with `lightbench bench reload`, memory grew by up to 5 % from the 50th reload to
/// the 500th without this, and by 0.6 % with it (by -0.9 to 2.7 % beside other work).
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn give_back_holes() {
    // SAFETY: the call takes no pointer, and may come from any thread at any time.
    #[allow(unsafe_code)]
    unsafe {
        libc::malloc_trim(0);
    }
}

/// Other systems' libraries do so themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn give_back_holes() {}
