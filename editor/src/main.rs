//! The `lightbench` program.

use std::process::ExitCode;

use lightbench::script::CountingAllocator;

/// Lets a script be stopped before it takes all memory.
#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

fn main() -> ExitCode {
    lightbench_editor::cli::main()
}
