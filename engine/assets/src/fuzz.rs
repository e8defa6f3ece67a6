//! Random tests: a fresh seed each time, printed so that a failure can be
//! repeated with `LIGHTBENCH_SEED`, and many more rounds with
//! `LIGHTBENCH_SOAK=1`.
#![allow(clippy::unwrap_used)]

use rand::SeedableRng;
use rand_pcg::Pcg64;

/// A generator for one test. Seeds that once found a fault stand in the test.
pub(crate) fn random() -> Pcg64 {
    let seed = match std::env::var("LIGHTBENCH_SEED") {
        Ok(seed) => seed.parse().unwrap(),
        Err(_) => rand::random(),
    };
    println!("LIGHTBENCH_SEED={seed}");
    Pcg64::seed_from_u64(seed)
}

/// How many rounds to try.
pub(crate) fn rounds(usual: usize, soak: usize) -> usize {
    match std::env::var("LIGHTBENCH_SOAK") {
        Ok(_) => soak,
        Err(_) => usual,
    }
}
