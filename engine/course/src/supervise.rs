//! A process that may hang, crash, or take all there is, and its end.

use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How often a process is looked after.
const LOOK: Duration = Duration::from_millis(20);

/// What a process may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Time by the clock on the wall: what hangs takes no time of the processor.
    pub time: Duration,
    /// Bytes of memory that it really uses.
    pub memory: u64,
    /// Bytes that it may print.
    pub output: u64,
}

/// How a process came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// By itself, with this exit status.
    Exited(i32),
    /// It crashed; on Unix with this signal.
    Crashed(Option<i32>),
    /// It was stopped when its time was up.
    Time,
    /// It was stopped when it had taken too much memory.
    Memory,
    /// It was stopped when it had printed too much.
    Output,
    /// Whoever waited for it did not want to any more.
    Cancelled,
}

/// A process that has ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// How.
    pub end: End,
    /// What it printed, up to the bound.
    pub output: Vec<u8>,
    /// What it printed as errors, up to the bound.
    pub errors: Vec<u8>,
    /// Seconds from its start.
    pub seconds: f64,
    /// The most memory that it was seen to use, in bytes; `None` where the system does not tell.
    pub memory: Option<u64>,
}

/// Runs a process to its end, which comes when a bound is reached at the latest. All processes that it
/// has started end with it, where the system has groups of processes.
///
/// # Errors
/// When it can't be started.
pub fn supervise(
    mut command: Command,
    bounds: &Bounds,
    cancelled: &dyn Fn() -> bool,
) -> io::Result<Ended> {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let began = Instant::now();
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let printed = Arc::new(AtomicU64::new(0));
    let output = listen(child.stdout.take(), bounds.output, &printed);
    let errors = listen(child.stderr.take(), bounds.output, &printed);
    let mut memory = None;
    let end = loop {
        if let Some(status) = child.try_wait()? {
            break ended(status);
        }
        memory = memory.max(resident_memory(child.id()));
        if began.elapsed() >= bounds.time {
            break End::Time;
        }
        if memory.is_some_and(|bytes| bytes > bounds.memory) {
            break End::Memory;
        }
        if printed.load(Ordering::Relaxed) > bounds.output {
            break End::Output;
        }
        if cancelled() {
            break End::Cancelled;
        }
        thread::sleep(LOOK);
    };
    stop(&mut child);
    let seconds = began.elapsed().as_secs_f64();
    let end = match end {
        End::Exited(_) if printed.load(Ordering::Relaxed) > bounds.output => End::Output,
        end => end,
    };
    Ok(Ended {
        end,
        output: output.join().unwrap_or_default(),
        errors: errors.join().unwrap_or_default(),
        seconds,
        memory,
    })
}

/// Reads all that comes, keeps what is allowed, and counts.
fn listen(
    pipe: Option<impl Read + Send + 'static>,
    bound: u64,
    printed: &Arc<AtomicU64>,
) -> JoinHandle<Vec<u8>> {
    let printed = Arc::clone(printed);
    thread::spawn(move || {
        let mut kept = Vec::new();
        let mut buffer = [0; 1 << 14];
        let Some(mut pipe) = pipe else { return kept };
        // A pipe that breaks has no more to tell.
        while let Ok(count @ 1..) = pipe.read(&mut buffer) {
            let before = printed.fetch_add(count as u64, Ordering::Relaxed);
            let room = bound.saturating_sub(before).min(count as u64) as usize;
            kept.extend_from_slice(&buffer[..room]);
        }
        kept
    })
}

fn ended(status: ExitStatus) -> End {
    #[cfg(unix)]
    let signal = std::os::unix::process::ExitStatusExt::signal(&status);
    #[cfg(not(unix))]
    let signal = None;
    match status.code() {
        // How Windows tells of a crash: the status of an exception.
        Some(code) if cfg!(windows) && code < 0 => End::Crashed(None),
        Some(code) => End::Exited(code),
        None => End::Crashed(signal),
    }
}

/// Ends a process with all that it started.
fn stop(child: &mut Child) {
    #[cfg(unix)]
    if let Ok(id) = i32::try_from(child.id()) {
        use nix::sys::signal::{Signal, killpg};
        // None of them may be left.
        let _ = killpg(nix::unistd::Pid::from_raw(id), Signal::SIGKILL);
    }
    // It may have ended by itself.
    let _ = child.kill();
    let _ = child.wait();
}

/// Bytes of memory that a process uses now.
fn resident_memory(process: u32) -> Option<u64> {
    if !cfg!(target_os = "linux") {
        return None;
    }
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kibibytes << 10)
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const BOUNDS: Bounds = Bounds {
        time: Duration::from_secs(20),
        memory: 200 << 20,
        output: 10_000,
    };

    fn run(script: &str, bounds: Bounds) -> Ended {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        supervise(command, &bounds, &|| false).unwrap()
    }

    #[test]
    fn what_ends_by_itself_is_told_with_all_that_it_printed() {
        let ended = run("echo out; echo err >&2; exit 3", BOUNDS);
        assert_eq!(ended.end, End::Exited(3));
        assert_eq!(
            (&ended.output[..], &ended.errors[..]),
            (&b"out\n"[..], &b"err\n"[..])
        );
    }

    #[test]
    fn what_hangs_is_stopped_with_its_children() {
        let folder = tempfile::tempdir().unwrap();
        let mark = folder.path().join("mark");
        let time = Duration::from_millis(300);
        let script = format!("(sleep 2; touch {}) & sleep 100", mark.display());
        let ended = run(&script, Bounds { time, ..BOUNDS });
        assert_eq!(ended.end, End::Time);
        assert!((0.3..2.0).contains(&ended.seconds), "{}", ended.seconds);
        thread::sleep(Duration::from_millis(2500));
        assert!(!mark.exists(), "a child lived on");
    }

    #[test]
    fn what_crashes_or_prints_without_end_is_told() {
        assert_eq!(run("kill -SEGV $$", BOUNDS).end, End::Crashed(Some(11)));
        let ended = run("yes", BOUNDS);
        assert_eq!(ended.end, End::Output);
        assert_eq!(ended.output.len() as u64, BOUNDS.output);
        // Also where it ends before anybody looks.
        assert_eq!(run("head -c 20000 /dev/zero", BOUNDS).end, End::Output);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_eats_memory_is_stopped() {
        let ended = run("x=1; while :; do x=$x$x; done", BOUNDS);
        assert_eq!(ended.end, End::Memory);
        assert!(ended.memory.unwrap() > BOUNDS.memory);
    }

    #[test]
    fn who_waits_may_give_up() {
        let mut command = Command::new("sleep");
        command.arg("100");
        let began = Instant::now();
        let given_up = || began.elapsed() > Duration::from_millis(100);
        let ended = supervise(command, &BOUNDS, &given_up).unwrap();
        assert_eq!(ended.end, End::Cancelled);
    }
}
