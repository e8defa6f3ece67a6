//! Processes in which edits are tried: a compiler may hang, a shader may loop without end, a driver may
//! crash or, as the software driver does, keep the memory of every pipeline that it ever built.
//!
//! A child is this test's own program. Its parent names seeds in an environment variable; the child
//! answers one line a seed.

use std::collections::VecDeque;
use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use lightbench::render::{GpuError, RenderError};
use lightbench::script::Settings;
use lightbench_tests::Studio;

use crate::bench::{Bench, Outcome};

/// How long a process may be at one edit.
const PATIENCE: Duration = Duration::from_secs(60);
/// How long a frame may take; then the child gives up by itself.
const FRAME_SECONDS: u64 = 20;
/// Edits that one process tries, so that it ends before memory does.
const BATCH: usize = 50;
const SEEDS: &str = "LIGHTBENCH_EDITS";
const DRAW: &str = "LIGHTBENCH_EDITS_DRAWN";
const ANSWER: &str = "edit: ";
const SIZE: (u32, u32) = (48, 27);

/// What became of an edit.
#[derive(Clone, Debug, PartialEq)]
pub enum Fate {
    /// It was compiled, or drawn.
    Good,
    /// It was refused in the way that it should be.
    Refused,
    /// Its frame or its process did not end in time.
    Endless,
    /// Its process crashed.
    Crashed,
    /// Anything else, in words.
    Wrong(String),
}

/// Compiles the edits of some seeds, or draws them too.
pub fn run(seeds: impl IntoIterator<Item = u64>, draw: bool, mut tell: impl FnMut(u64, Fate)) {
    let mut waiting: VecDeque<u64> = seeds.into_iter().collect();
    while !waiting.is_empty() {
        run_child(&mut waiting, draw, &mut tell);
    }
}

/// Runs one child until its batch is done, or an edit ended it.
fn run_child(waiting: &mut VecDeque<u64>, draw: bool, tell: &mut impl FnMut(u64, Fate)) {
    let list: Vec<String> = waiting.iter().take(BATCH).map(u64::to_string).collect();
    let mut command = Command::new(std::env::current_exe().unwrap());
    command
        .args([
            "--exact",
            "child_that_tries_edits",
            "--ignored",
            "--nocapture",
        ])
        .env(SEEDS, list.join(","))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    if draw {
        command.env(DRAW, "1");
    }
    let mut child = command.spawn().unwrap();
    let output = child.stdout.take().unwrap();
    let (lines, inbox) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            if lines.send(line).is_err() {
                return;
            }
        }
    });
    for _ in 0..list.len() {
        let fate = loop {
            match inbox.recv_timeout(PATIENCE) {
                Ok(line) => {
                    if let Some(answer) = line.strip_prefix(ANSWER) {
                        break read(answer);
                    }
                }
                Err(RecvTimeoutError::Timeout) => break Fate::Endless,
                Err(RecvTimeoutError::Disconnected) => break Fate::Crashed,
            }
        };
        let over = matches!(fate, Fate::Endless | Fate::Crashed);
        if let Some(seed) = waiting.pop_front() {
            tell(seed, fate);
        }
        if over {
            break;
        }
    }
    end(&mut child);
}

fn end(child: &mut Child) {
    // It may have ended by itself.
    let _ = child.kill();
    child.wait().unwrap();
}

fn read(answer: &str) -> Fate {
    match answer {
        "good" => Fate::Good,
        "refused" => Fate::Refused,
        "endless" => Fate::Endless,
        words => Fate::Wrong(words.replace("\\n", "\n")),
    }
}

fn write(fate: &Fate) -> String {
    match fate {
        Fate::Good => "good".to_owned(),
        Fate::Refused => "refused".to_owned(),
        Fate::Endless | Fate::Crashed => "endless".to_owned(),
        Fate::Wrong(words) => words.replace('\n', "\\n"),
    }
}

/// The child: tries the edits that its parent names, and tells of each.
pub fn work() {
    let Ok(seeds) = std::env::var(SEEDS) else {
        return;
    };
    let draw = std::env::var(DRAW).is_ok();
    let mut studio = draw.then(|| Studio::new("hard_cases", &Settings::new()));
    let mut bench = match &studio {
        Some(studio) => Bench::on(&studio.renderer),
        None => Bench::new(),
    };
    for seed in seeds.split(',').map(|seed| seed.parse().unwrap()) {
        let edit = bench.edit(seed);
        let fate = match (bench.outcome(&edit), &mut studio) {
            (Ok(Outcome::Accepted(pipeline)), Some(studio)) => draw_one(studio, pipeline),
            (Ok(Outcome::Accepted(_)), None) => Fate::Good,
            (Ok(Outcome::Refused), _) => Fate::Refused,
            (Err(complaint), _) => Fate::Wrong(complaint),
        };
        println!("{ANSWER}{}", write(&fate));
        std::io::stdout().flush().unwrap();
        if fate == Fate::Endless {
            // The device is still at it.
            return;
        }
    }
}

fn draw_one(studio: &mut Studio, mut pipeline: Box<lightbench::render::Pipeline>) -> Fate {
    let view = studio.view;
    let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
    let renderer = &mut studio.renderer;
    let drawn = renderer
        .render(world, assets, &mut pipeline, &view, SIZE, 0.0)
        .map(|_| ());
    let ended = drawn.and_then(|()| Ok(renderer.finish(FRAME_SECONDS).map(|_| ())?));
    match ended.and_then(|()| renderer.read_output(&pipeline).map(|_| ())) {
        Ok(()) => Fate::Good,
        Err(RenderError::Gpu(GpuError::Timeout(_))) => Fate::Endless,
        Err(RenderError::Gpu(error)) => Fate::Wrong(error.to_string()),
        // The output is too small, or there are too many lights.
        Err(_) => Fate::Refused,
    }
}
