//! What it saves that a software driver's memory is kept from frame to frame, and not given back.

use lightbench::render::heap::keep_freed_memory;
use lightbench::script::Settings;
use lightbench_tests::Studio;

use crate::bar::Bars;
use crate::frames::{Times, draw_at};

/// Small frames, of which the work for each draw is a large part.
const SIZE: (u32, u32) = (320, 180);
/// Frames of each side in a turn, after one that is not measured.
const FRAMES: usize = 6;
const TURNS: usize = 5;

/// Compares frames of many small draws with and without. Elsewhere both sides are the same.
pub fn run(bars: &mut Bars) {
    if !bars.software {
        println!("  a graphics card has memory of its own: nothing to compare");
        return;
    }
    let mut studio = Studio::new("many_lights", &Settings::new());
    for name in ["clustered_deferred", "deferred_lighting"] {
        let mut pipeline = studio.compile(name, &Settings::new());
        let (mut kept, mut given_back) = (Times::default(), Times::default());
        for _ in 0..TURNS {
            for (set, times) in [
                (keep_freed_memory as fn(), &mut kept),
                (give_back_freed_memory, &mut given_back),
            ] {
                set();
                draw_at(&mut studio, &mut pipeline, SIZE);
                for _ in 0..FRAMES {
                    times.take(|| draw_at(&mut studio, &mut pipeline, SIZE));
                }
            }
        }
        let what = format!("{name}, memory kept to memory given back");
        bars.ratio(&what, &kept, &given_back, 0.75);
    }
    keep_freed_memory();
}

/// The C library's settings as a program begins with them.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn give_back_freed_memory() {
    const AT_FIRST: libc::c_int = 128 << 10;
    // SAFETY: the calls take no pointer, and glibc guards its settings against other threads.
    #[allow(unsafe_code)]
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, AT_FIRST);
        libc::mallopt(libc::M_TRIM_THRESHOLD, AT_FIRST);
    }
}

/// Other systems' libraries have no such setting.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn give_back_freed_memory() {}
