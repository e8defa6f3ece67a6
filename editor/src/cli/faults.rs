//! The last net: faults of the program itself, and its log.

use std::io::Write as _;
use std::panic;
use std::process::ExitCode;
use std::str::FromStr as _;

use lightbench::render::guard;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::prelude::*;

/// Names what is logged, as in `LIGHTBENCH_LOG=debug` or `LIGHTBENCH_LOG=wgpu_core=info`.
const VARIABLE: &str = "LIGHTBENCH_LOG";

/// Sends the libraries' log to the standard error, if somebody asked for it.
pub fn start_log() {
    // Errors reach the user as errors; the log is for those who look for their causes.
    let Some(wanted) = std::env::var(VARIABLE)
        .ok()
        .filter(|wanted| !wanted.is_empty())
    else {
        return;
    };
    match Targets::from_str(&wanted) {
        Ok(targets) => {
            let lines = tracing_subscriber::fmt::layer().with_writer(std::io::stderr);
            tracing_subscriber::registry()
                .with(lines.with_filter(targets))
                .init();
        }
        Err(error) => {
            super::report::warn(format!("{VARIABLE}={wanted} is not understood: {error}"))
        }
    }
}

/// Runs the program. A fault in it is told in a sentence instead of a trace.
pub fn catch(run: impl FnOnce() -> ExitCode + panic::UnwindSafe) -> ExitCode {
    panic::set_hook(Box::new(|fault| {
        if guard::is_caught() {
            // Who called the library that failed tells it in words of its own.
            return;
        }
        let payload = fault.payload();
        let message = payload
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
            .unwrap_or("no message");
        let place = fault.location().map_or_else(String::new, |place| {
            format!(" ({}:{})", place.file(), place.line())
        });
        let _ = writeln!(
            std::io::stderr(),
            "error: this is a fault of the program, not of yours: {}{place}. Please report it with \
             the command that you typed",
            message.trim_end_matches('.')
        );
    }));
    panic::catch_unwind(run).unwrap_or(ExitCode::FAILURE)
}
