//! Mutants: the solution with one operator, number or function exchanged, in the lines that the starter
//! does not have. Those that change the picture visibly must lose points, and be told what is wrong.
//!
//! Each run tries some of each lesson, spread over its lines; `LIGHTBENCH_SOAK=1` (`./x soak`) tries all.

use std::fs;
use std::path::Path;

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::LdrImage;
use lightbench::lab::capture::{CaptureOptions, capture};
use lightbench::lab::diff::{DiffOptions, diff_ldr};
use lightbench::lab::lesson::Lesson;
use lightbench::render::{Gpu, GpuOptions, Renderer};
use lightbench::script::{Settings, load_pipeline, load_scene};

use super::{all, checked, solved, told};

/// What is taken for something else.
const EXCHANGES: [(&str, &str); 16] = [
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" < ", " >= "),
    (" > ", " <= "),
    (" >= ", " < "),
    (" <= ", " > "),
    ("max(", "min("),
    ("min(", "max("),
    ("sin(", "cos("),
    ("cos(", "sin("),
    ("0.0", "1.0"),
    ("1.0", "2.0"),
    ("normalize(", "("),
    ("dot(", "length(cross("),
];

/// A picture has changed where FLIP is above this in the mean.
const VISIBLE: f64 = 0.02;

/// Mutants of each lesson that a run tries.
const TRIED: usize = 4;

/// One exchange: the file, and its text with it.
struct Mutant {
    file: String,
    text: String,
    what: String,
}

/// All exchanges in lines of the solution that the starter does not have.
fn mutants(folder: &Path, lesson: &Lesson) -> Vec<Mutant> {
    let mut found = Vec::new();
    for file in &lesson.about.submits {
        let Ok(solution) = fs::read_to_string(folder.join("solution").join(file)) else {
            continue;
        };
        let starter = fs::read_to_string(folder.join("starter").join(file)).unwrap_or_default();
        let lines: Vec<&str> = solution.lines().collect();
        for (number, line) in lines.iter().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            if code.trim().is_empty() || starter.lines().any(|other| other == *line) {
                continue;
            }
            for (from, to) in EXCHANGES {
                for (at, _) in code.match_indices(from) {
                    // `cross` takes one bracket more.
                    let rest = &line[at + from.len()..];
                    let rest = match to {
                        "length(cross(" => rest.replacen(')', "))", 1),
                        _ => rest.to_owned(),
                    };
                    let mutant = format!("{}{to}{rest}", &line[..at]);
                    let mut changed = lines.clone();
                    changed[number] = &mutant;
                    found.push(Mutant {
                        file: file.clone(),
                        text: changed.join("\n") + "\n",
                        what: format!("{file}:{}: {}", number + 1, mutant.trim()),
                    });
                }
            }
        }
    }
    found
}

/// The picture of a work; `None` where its files don't load or draw.
fn picture(lesson: &Lesson, work: &Path, renderer: &mut Renderer) -> Option<LdrImage> {
    let files = Files::with_project(work).ok()?;
    let progress = Progress::new();
    let desc = load_pipeline(&files, &lesson.about.pipeline, &Settings::new()).ok()?;
    let mut pipeline = renderer.compiler().compile(&files, &desc).ok()?;
    let mut scene = load_scene(&files, &lesson.about.scene, &Settings::new(), &progress).ok()?;
    renderer.reset_scene();
    let options = CaptureOptions {
        size: (160, 90),
        frame: 0,
    };
    let picture = capture(renderer, &mut scene, &mut pipeline, options, &progress).ok()?;
    Some(picture.output)
}

#[test]
fn mutants_that_can_be_seen_lose_points() {
    let every = std::env::var_os("LIGHTBENCH_SOAK").is_some();
    let mut renderer = Renderer::new(Gpu::open(&GpuOptions::default()).unwrap());
    let (mut visible, mut survived) = (0, Vec::new());
    for (folder, lesson) in all() {
        let right = solved(&folder);
        let Some(expected) = picture(&lesson, right.path(), &mut renderer) else {
            continue;
        };
        let mutants = mutants(&folder, &lesson);
        let step = match every {
            true => 1,
            false => mutants.len().div_ceil(TRIED).max(1),
        };
        for mutant in mutants.iter().step_by(step) {
            let work = solved(&folder);
            fs::write(work.path().join(&mutant.file), &mutant.text).unwrap();
            let Some(found) = picture(&lesson, work.path(), &mut renderer) else {
                continue;
            };
            let flip = diff_ldr(&expected, &found, DiffOptions::default()).unwrap();
            if flip.difference.flip.mean <= VISIBLE {
                continue;
            }
            visible += 1;
            let tasks: Vec<&str> = lesson.about.tasks.iter().map(|t| t.id.as_str()).collect();
            let outcome = checked(&lesson, work.path(), &tasks);
            if outcome.points == outcome.of {
                survived.push(format!("{}: {}", lesson.name, mutant.what));
            }
            // Whoever lost points is told what is not so and where to read again.
            for task in outcome.tasks.iter().filter(|task| task.points < task.of) {
                assert!(
                    task.refusal.is_some()
                        || task.criteria.iter().any(|one| !one.findings.is_empty()),
                    "{}: {}: {}",
                    lesson.name,
                    mutant.what,
                    told(&outcome)
                );
            }
        }
    }
    println!(
        "{visible} mutants can be seen, {} of them lose no points",
        survived.len()
    );
    // Few would say nothing of the share; one lesson alone has few.
    let least = match std::env::var_os("LIGHTBENCH_LESSON") {
        Some(_) => 1,
        None => 20,
    };
    assert!(visible >= least, "only {visible} mutants can be seen");
    assert!(
        20 * survived.len() <= visible,
        "{} of {visible}:\n{}",
        survived.len(),
        survived.join("\n")
    );
}
