//! Strangers' scripts, drawn by lot: shipped scripts with random edits, and every function with
//! arguments that nobody expects. Each works or is refused with a place and in plain words; none
//! panics, and none runs beyond its limits.
//!
//! Every run takes fresh seeds. A failure names its seed; `LIGHTBENCH_SEED` begins with one of choice.
//! `LIGHTBENCH_SOAK` tries as many as `./x soak` does.
#![allow(clippy::unwrap_used)]

mod calls;

use std::hash::{BuildHasher as _, RandomState};
use std::time::{Duration, Instant};

use lightbench::assets::Progress;
use lightbench::assets::cache::Cache;
use lightbench::assets::files::Files;
use lightbench::render::Problem;
use lightbench::script::{CountingAllocator, Limits, SCENES, Settings, load_scene_within};
use lightbench_tests::Numbers;
use lightbench_tests::mutation::mutate;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// How many edits and calls are tried, in a usual run and in a long one.
const EDITS: (u64, u64) = (150, 20_000);
const CALLS: (u64, u64) = (1_500, 80_000);

/// The longest that a case may take: its limits, what is made for it free of charge, and a machine with
/// other work.
const PATIENCE: Duration = Duration::from_secs(20);

/// Words that belong to the program and not to scripts.
const OURS: [&str; 11] = [
    "core::",
    "alloc::",
    "rhai::",
    "glam::",
    "i64",
    "f64",
    "usize",
    "Dynamic",
    "ImmutableString",
    "unwrap",
    "lightbench_",
];

fn limits() -> Limits {
    Limits {
        operations: 3_000_000,
        load_time: Duration::from_millis(1500),
        update_time: Duration::from_millis(500),
        memory_bytes: 64 << 20,
        entities: 3_000,
        triangles: 500_000,
        ..Limits::default()
    }
}

/// This run's seeds: one after the other.
fn seeds((usual, soak): (u64, u64)) -> impl Iterator<Item = u64> {
    let count = match std::env::var("LIGHTBENCH_SOAK") {
        Ok(_) => soak,
        Err(_) => usual,
    };
    let first = match std::env::var("LIGHTBENCH_SEED") {
        Ok(seed) => seed.parse().unwrap(),
        // Small enough to be typed.
        Err(_) => RandomState::new().hash_one(0) >> 24,
    };
    println!("LIGHTBENCH_SEED={first}, {count} cases");
    first..first + count
}

/// A project whose scripts change from case to case.
struct Place {
    folder: tempfile::TempDir,
    cache: Cache,
}

/// The scene of a case.
const SCENE: &str = "scripts/scenes/case.rhai";

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(folder.path().join("scripts/scenes")).unwrap();
        let cache = Cache::default();
        Self { folder, cache }
    }

    /// Runs a scene and some steps of it. Whether all went well; what must not happen is the error.
    fn run(&self, text: &str) -> Result<bool, String> {
        std::fs::write(self.folder.path().join(SCENE), text).unwrap();
        let files = Files::with_project(self.folder.path()).unwrap();
        let (settings, progress) = (Settings::new(), Progress::new());
        let begun = Instant::now();
        let loaded = load_scene_within(&files, SCENE, &settings, &progress, &self.cache, &limits());
        let problems = match loaded {
            Ok(mut scene) => {
                let mut problems = Vec::new();
                for step in 1..=2 {
                    let time = f64::from(step) / 60.0;
                    problems.extend(scene.update(time, 1.0 / 60.0).err());
                }
                std::hint::black_box(scene.kept());
                problems
            }
            Err(problems) if problems.0.is_empty() => {
                return Err("it was refused without a word".to_owned());
            }
            Err(problems) => problems.0,
        };
        if begun.elapsed() > PATIENCE {
            return Err(format!("it takes {:?}", begun.elapsed()));
        }
        problems.iter().try_for_each(check)?;
        Ok(problems.is_empty())
    }
}

/// Whether a problem has a place and is told in the words of scripts.
fn check(problem: &Problem) -> Result<(), String> {
    if problem.place.file.is_empty() {
        return Err(format!("a problem without a place: {problem}"));
    }
    let told = format!(
        "{} {}",
        problem.message,
        problem.hint.as_deref().unwrap_or_default()
    );
    // What the script itself has written may be repeated.
    let source = problem.source_line.as_deref().unwrap_or_default();
    let ours = |word: &&&str| told.contains(**word) && !source.contains(**word);
    match OURS.iter().find(ours) {
        Some(word) => Err(format!("`{word}` is no word of scripts: {problem}")),
        None => Ok(()),
    }
}

/// Runs one case a seed, and tells of all that went wrong. Gives the share that went well.
fn run_all(cases: (u64, u64), case: impl Fn(&mut Numbers) -> String) -> f64 {
    let place = Place::new();
    let (mut wrong, mut good, mut count) = (Vec::new(), 0_u32, 0_u32);
    for seed in seeds(cases) {
        let text = case(&mut Numbers(seed));
        count += 1;
        match place.run(&text) {
            Ok(well) => good += u32::from(well),
            Err(complaint) => {
                let report = format!("seed {seed}: {complaint}\n{text}\n");
                println!("{report}");
                wrong.push(report);
            }
        }
        assert!(wrong.len() < 20, "{}", wrong.join("\n"));
    }
    println!("{good} of {count} went well");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    f64::from(good) / f64::from(count)
}

/// Scenes that take long to make, or need a file.
const LEFT_OUT: [&str; 2] = ["atrium", "showroom"];

/// The texts of the shipped scenes.
fn shipped() -> Vec<String> {
    let files = Files::shipped();
    let listed = files.list(SCENES, "rhai").unwrap();
    let scenes = listed.iter().filter(|file| {
        let stem = file.path.rsplit('/').next().unwrap_or_default();
        let left_out = LEFT_OUT.iter().any(|name| stem.starts_with(name));
        !left_out && !file.path.contains("/parts/")
    });
    let texts = scenes.map(|file| files.read_text(&file.path).unwrap().to_string());
    texts.collect()
}

#[test]
fn edited_scripts_work_or_are_refused_with_a_place() {
    let scripts = shipped();
    let share = run_all(EDITS, |numbers| {
        let script = numbers.pick(&scripts);
        mutate(script, &scripts, numbers)
    });
    assert!((0.02..0.98).contains(&share), "{share}");
}

#[test]
fn functions_take_or_refuse_whatever_they_are_given() {
    let functions = calls::functions();
    let share = run_all(CALLS, |numbers| calls::call(&functions, numbers));
    assert!((0.02..0.98).contains(&share), "{share}");
}
