//! Solutions, starters, mistakes and cheats: who gets how many points.

use std::fs;
use std::path::Path;

use lightbench::assets::Progress;
use lightbench::lab::lesson::{CheckOptions, Lesson, Outcome, RefusalKind, begin, check, pack};
use serde::Deserialize;

use super::{all, checked, copy, solved, told};

/// Changes of a solution.
#[derive(Deserialize)]
struct Variants {
    mistake: Vec<Mistake>,
    right: Vec<Right>,
}

#[derive(Deserialize)]
struct Mistake {
    file: String,
    from: String,
    to: String,
    loses: String,
    says: String,
}

#[derive(Deserialize)]
struct Edit {
    file: String,
    from: String,
    to: String,
}

/// Another right way: one change, and more of them where several tasks are solved otherwise at once.
#[derive(Deserialize)]
struct Right {
    #[serde(flatten)]
    first: Edit,
    #[serde(default)]
    and: Vec<Edit>,
}

fn variants(folder: &Path) -> Variants {
    let text = fs::read_to_string(folder.join("hidden/variants.toml")).unwrap();
    toml::from_str(&text).unwrap()
}

fn edit(work: &Path, file: &str, from: &str, to: &str) {
    let path = work.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{file} has no `{from}`");
    fs::write(path, text.replace(from, to)).unwrap();
}

/// The tasks that a submission of files without a report can solve.
fn task_ids(lesson: &Lesson) -> Vec<&str> {
    lesson
        .about
        .tasks
        .iter()
        .map(|task| task.id.as_str())
        .collect()
}

/// Checks all tasks as a grader does: with the hidden checks too.
fn with_hidden(folder: &Path, lesson: &Lesson, work: &Path) -> Outcome {
    let options = CheckOptions {
        hidden: Some(folder.join("hidden")),
        only: task_ids(lesson).into_iter().map(str::to_owned).collect(),
        ..CheckOptions::default()
    };
    check(lesson, work, &options, &Progress::new(), |_| {}).unwrap()
}

#[test]
fn solutions_get_all_points_twice_and_starters_none() {
    for (folder, lesson) in all() {
        let work = solved(&folder);
        let tasks = task_ids(&lesson);
        let outcome = checked(&lesson, work.path(), &tasks);
        assert_eq!(
            outcome.points,
            outcome.of,
            "{}: {}",
            lesson.name,
            told(&outcome)
        );
        assert!(!outcome.marked, "{}: {}", lesson.name, told(&outcome));
        let again = checked(&lesson, work.path(), &tasks);
        assert_eq!(outcome.to_json().unwrap(), again.to_json().unwrap());

        let starter = checked(&lesson, &folder.join("starter"), &[]);
        assert_eq!(starter.points, 0, "{}: {}", lesson.name, told(&starter));
        for task in &tasks {
            let refusal = starter.task(task).unwrap().refusal.as_ref().unwrap();
            assert_eq!(refusal.kind, RefusalKind::Unchanged);
        }
    }
}

/// The starter runs and solves nothing, also where something else in its files was changed.
#[test]
fn starters_that_were_touched_but_not_solved_get_nothing() {
    for (folder, lesson) in all() {
        let work = tempfile::tempdir().unwrap();
        copy(&folder.join("starter"), work.path());
        for path in &lesson.about.submits {
            let mut text = fs::read_to_string(work.path().join(path)).unwrap();
            text += match path.ends_with(".wgsl") {
                true => "\nconst SOMETHING_ELSE = 1.0;\n",
                false => "\nlet something_else = 1;\n",
            };
            fs::write(work.path().join(path), text).unwrap();
        }
        let outcome = checked(&lesson, work.path(), &task_ids(&lesson));
        assert_eq!(outcome.points, 0, "{}: {}", lesson.name, told(&outcome));
        for task in &outcome.tasks {
            assert_eq!(task.refusal, None, "{}: {}", lesson.name, told(&outcome));
        }
    }
}

#[test]
fn mistakes_lose_points_and_are_named() {
    for (folder, lesson) in all() {
        let variants = variants(&folder);
        for task in task_ids(&lesson) {
            let count = variants
                .mistake
                .iter()
                .filter(|mistake| mistake.loses == task)
                .count();
            assert!(
                count >= 2,
                "{}: only {count} mistakes of `{task}`",
                lesson.name
            );
        }
        for mistake in &variants.mistake {
            let work = solved(&folder);
            edit(work.path(), &mistake.file, &mistake.from, &mistake.to);
            let outcome = checked(&lesson, work.path(), &[&mistake.loses]);
            let all = told(&outcome);
            assert!(outcome.points < outcome.of, "`{}`: {all}", mistake.to);
            let named = outcome.tasks[0]
                .causes()
                .any(|words| words.en.contains(&mistake.says));
            assert!(
                named,
                "`{}` is not told as `{}`: {all}",
                mistake.to, mistake.says
            );
        }
    }
}

/// From the checks that a student has, and from the hidden ones.
#[test]
fn other_right_ways_get_all_points() {
    for (folder, lesson) in all() {
        for right in variants(&folder).right {
            let work = solved(&folder);
            let mut changed = Vec::new();
            for one in std::iter::once(&right.first).chain(&right.and) {
                edit(work.path(), &one.file, &one.from, &one.to);
                changed.push(one.to.as_str());
            }
            let outcome = with_hidden(&folder, &lesson, work.path());
            assert_eq!(
                outcome.points,
                outcome.of,
                "{}: `{}`: {}",
                lesson.name,
                changed.join("` and `"),
                told(&outcome)
            );
        }
    }
}

/// Nothing but the submitted files counts, whatever else lies in the work: shipped files under the names
/// of the lesson's own, the library changed, the checks' files replaced.
#[test]
fn shipped_files_under_other_names_get_nothing() {
    let (folder, lesson) = all().remove(0);
    let work = tempfile::tempdir().unwrap();
    copy(&folder.join("starter"), work.path());
    let root = super::lessons().join("..");
    let take = |from: &str, to: &str| {
        let to = work.path().join(to);
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(root.join(from), to).unwrap();
    };
    take(
        "scripts/pipelines/forward_single_pass.rhai",
        "scripts/pipelines/by_hand.rhai",
    );
    take(
        "shaders/forward/single_pass.wgsl",
        "shaders/by_hand/shade.wgsl",
    );
    take(
        "scripts/pipelines/forward_single_pass.rhai",
        "scripts/pipelines/check_functions.rhai",
    );
    let outcome = checked(&lesson, work.path(), &[]);
    assert_eq!(outcome.points, 0, "{}", told(&outcome));

    // The library's formulas, asked for in the submitted file.
    let wgsl = "shaders/lib/by_hand.wgsl";
    edit(
        work.path(),
        wgsl,
        "#define_import_path by_hand",
        "#define_import_path by_hand\n#import lightbench::brdf",
    );
    let outcome = checked(&lesson, work.path(), &["blinn_phong"]);
    let refusal = outcome.tasks[0].refusal.as_ref().unwrap();
    assert_eq!(refusal.kind, RefusalKind::Import);
    assert!(refusal.says.en.contains("lightbench::brdf"), "{refusal:?}");

    // The library's file itself, without its comments and with another name.
    let library = fs::read_to_string(root.join("shaders/lib/brdf.wgsl")).unwrap();
    let bare: Vec<&str> = library
        .lines()
        .map(|line| line.split("//").next().unwrap())
        .collect();
    let bare = bare
        .join("\n")
        .replace("lightbench::brdf", "by_hand")
        .replace("power", "shininess");
    fs::write(work.path().join(wgsl), bare).unwrap();
    let outcome = checked(&lesson, work.path(), &["blinn_phong"]);
    let refusal = outcome.tasks[0].refusal.as_ref().unwrap();
    assert_eq!((refusal.kind, outcome.points), (RefusalKind::Copy, 0));
    assert!(
        refusal.says.en.contains("shaders/lib/brdf.wgsl"),
        "{refusal:?}"
    );

    // A shipped scene in place of the student's own.
    let scene = fs::read_to_string(root.join("scripts/scenes/brdf_spheres.rhai")).unwrap();
    let scene = scene
        .replace("MODELS", "KINDS")
        .replace("COLUMNS", "ACROSS");
    fs::write(work.path().join("scripts/scenes/first_light.rhai"), scene).unwrap();
    let outcome = checked(&lesson, work.path(), &["scene"]);
    assert_eq!(
        outcome.tasks[0].refusal.as_ref().unwrap().kind,
        RefusalKind::Copy
    );
}

#[test]
fn broken_and_missing_files_are_told_with_their_places() {
    let (folder, lesson) = all().remove(0);
    let work = solved(&folder);
    let wgsl = "shaders/lib/by_hand.wgsl";
    edit(
        work.path(),
        wgsl,
        "max(cosine, 0.0) / squared",
        "max(cosine, 0.0) / sqared",
    );
    let outcome = checked(&lesson, work.path(), &["irradiance"]);
    let refusal = outcome.tasks[0].refusal.as_ref().unwrap();
    assert_eq!(refusal.kind, RefusalKind::Broken);
    assert!(
        refusal.says.en.contains("shaders/lib/by_hand.wgsl:10"),
        "{refusal:?}"
    );

    fs::write(
        work.path().join("scripts/scenes/first_light.rhai"),
        "loop {}",
    )
    .unwrap();
    let outcome = checked(&lesson, work.path(), &["scene"]);
    let refusal = outcome.tasks[0].refusal.as_ref().unwrap();
    assert_eq!(refusal.kind, RefusalKind::Broken);
    assert!(refusal.says.en.contains("first_light.rhai"), "{refusal:?}");

    fs::remove_file(work.path().join(wgsl)).unwrap();
    let outcome = checked(&lesson, work.path(), &["lambert"]);
    let refusal = outcome.tasks[0].refusal.as_ref().unwrap();
    assert_eq!((refusal.kind, outcome.points), (RefusalKind::Missing, 0));
}

/// Hidden checks are passed by the solution, and find what fits the student's checks alone.
#[test]
fn hidden_checks_find_what_was_made_for_the_others() {
    for (folder, lesson) in all() {
        assert!(folder.join("hidden/checks.rhai").is_file());
        let work = solved(&folder);
        let outcome = with_hidden(&folder, &lesson, work.path());
        assert_eq!(outcome.points, outcome.of, "{}", told(&outcome));
        if lesson.name == "01-first-light" {
            // The normal of the student's checks in place of the one that is given.
            edit(
                work.path(),
                "shaders/lib/by_hand.wgsl",
                "dot(normal, to_light)",
                "dot(vec3f(1.0, 2.0, 2.0) / 3.0, to_light)",
            );
            let of_student = super::checked(&lesson, work.path(), &["irradiance"]);
            assert_eq!(of_student.points, of_student.of, "{}", told(&of_student));
            let outcome = with_hidden(&folder, &lesson, work.path());
            let task = outcome.task("irradiance").unwrap();
            assert_eq!(task.points, 0);
            // It is told that a hidden check found it, and what to read again by its title.
            let findings = task.criteria.iter().flat_map(|one| &one.findings);
            let missed: Vec<_> = findings.filter(|finding| !finding.holds).collect();
            assert!(!missed.is_empty() && missed.iter().all(|finding| finding.hidden));
            let places: Vec<&str> = task.places().collect();
            assert!(!places.is_empty());
            for place in places {
                let title = &outcome.places[place];
                assert!(title.en != place && title.es != title.en, "{title:?}");
            }
        }
    }
}

/// A student has the pack, and nothing that was kept back.
#[test]
fn checks_work_from_a_pack() {
    for (folder, lesson) in all() {
        let place = tempfile::tempdir().unwrap();
        let packed = pack(&lesson, place.path()).unwrap();
        for kept_back in ["solution", "hidden"] {
            assert!(!packed.join(kept_back).exists());
        }
        assert!(
            pack(&lesson, place.path()).is_err(),
            "a pack is not written over"
        );
        let source = lightbench::lab::lesson::Source::of_folder(&packed).unwrap();
        let of_pack = Lesson::read(&lesson.name, source).unwrap();
        let project = place.path().join("project");
        begin(&of_pack, None, Default::default(), &project).unwrap();
        copy(&folder.join("solution"), &project);
        let outcome = checked(&of_pack, &project, &task_ids(&of_pack));
        assert_eq!(outcome.points, outcome.of, "{}", told(&outcome));
    }
}
