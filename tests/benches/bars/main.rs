//! What the project promises about speed: each bar with what was measured, and whether it holds.
//!
//! `cargo bench --locked --workspace --bench bars` runs all; with names behind `--` those alone. Both
//! sides of a ratio run in one process and in turn, so that a machine that is busy slows both alike.
//! Nothing here fails: whoever runs it judges whether the machine was quiet enough.
#![warn(missing_docs)]
// A measurement stops where something is wrong; there is nobody to hand an error to.
#![allow(clippy::unwrap_used)]

mod bar;
mod by_hand;
mod culling;
mod frames;
mod memory;
mod peer;
mod processor;
mod sums;
mod tracer;

use bar::Bars;
use lightbench::lab::measure::load_average;
use lightbench::lab::report::Machine;

/// Width and height of all pictures.
const SIZE: (u32, u32) = (1280, 720);

/// Measures, and says what it found.
type Measurement = fn(&mut Bars);

/// The measurements by name.
const ALL: [(&str, Measurement); 7] = [
    ("by_hand", by_hand::run),
    ("sums", sums::run),
    ("culling", culling::run),
    ("processor", processor::run),
    ("peer", peer::run),
    ("memory", memory::run),
    ("tracer", tracer::run),
];

fn main() {
    // Cargo adds options of its own.
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with("--"))
        .collect();
    let known = |word: &String| ALL.iter().any(|(name, _)| name == word);
    if let Some(unknown) = wanted.iter().find(|word| !known(word)) {
        let names: Vec<&str> = ALL.iter().map(|(name, _)| *name).collect();
        println!("there is no `{unknown}`; there are {}", names.join(", "));
        return;
    }
    let machine = Machine::this();
    let gpu = lightbench_tests::gpu(false).summary;
    let software = if gpu.software {
        "; a software driver, so times are processor time of the whole process"
    } else {
        ""
    };
    println!(
        "{}, {} cores, {}, {} {}{software}",
        machine.cpu, machine.cores, gpu.name, gpu.driver, gpu.driver_info
    );
    let mut bars = Bars::new(gpu.software, machine.cores);
    for (name, run) in ALL {
        if wanted.is_empty() || wanted.iter().any(|word| word == name) {
            println!("\n{name}");
            run(&mut bars);
            if let Some(load) = load_average() {
                println!("  programs that wanted a core at a time: {load:.1}");
            }
        }
    }
    bars.summarize();
}
