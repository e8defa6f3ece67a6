//! Memory that was freed and lies between what is in use.

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
