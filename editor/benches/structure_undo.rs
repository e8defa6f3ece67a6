//! A hundred thousand random changes of a scene by hand, taken back and done again: says how long that
//! takes. It ends with a message where anything is not as it was.

#[path = "../tests/random_edits/mod.rs"]
mod random_edits;

use std::time::Instant;

/// Things that are done.
const OPERATIONS: usize = 100_000;

/// After so many the script is loaded anew.
const LOAD_EVERY: usize = 5_000;

fn main() {
    let began = Instant::now();
    let counts = random_edits::run(7, OPERATIONS, LOAD_EVERY);
    let took = began.elapsed();
    println!("{OPERATIONS} random things in {took:.1?}: {counts:?}");
    println!("all taken back and done again, byte for byte");
}
