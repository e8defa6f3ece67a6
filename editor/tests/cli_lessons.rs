//! `lesson`, `check` and `new lesson`: as a student and as a lecturer use them.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;
use std::path::{Path, PathBuf};

use cli_support::{Project, run_in};
use lightbench::course::archive::{Bounds, unpack};
use lightbench::course::hand_in::HandedIn;
use tempfile::TempDir;

fn lesson() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../lessons/01-first-light")
}

/// A folder with a project that `lesson start` made.
fn started(more: &[&str]) -> (TempDir, PathBuf) {
    let place = tempfile::tempdir().unwrap();
    let mut arguments = vec!["lesson", "start", "1", "--into", "mine"];
    arguments.extend(more);
    run_in(place.path(), &arguments, &[]).succeeded();
    let project = place.path().join("mine");
    (place, project)
}

fn solve(project: &Path, path: &str) {
    fs::copy(lesson().join("solution").join(path), project.join(path)).unwrap();
}

#[test]
fn a_student_begins_checks_and_solves() {
    let (_place, project) = started(&[]);
    let readme = fs::read_to_string(project.join("README.md")).unwrap();
    assert!(
        readme.contains("shaders/lib/by_hand.wgsl") && readme.contains("35 °"),
        "{readme}"
    );
    // The starter draws, and has no points.
    let draw = [
        "render",
        "first_light",
        "--pipeline",
        "by_hand",
        "--size",
        "64x36",
        "--out",
        "out/mine.png",
    ];
    run_in(&project, &draw, &[]).succeeded();
    let none = run_in(&project, &["check"], &[]);
    assert_eq!(none.status, 1, "{}", none.all());
    assert!(none.stdout.contains("Points: 0 of 21"), "{}", none.all());

    solve(&project, "shaders/lib/by_hand.wgsl");
    solve(&project, "scripts/scenes/first_light.rhai");
    let tasks = [
        "check",
        "--task",
        "scene",
        "--task",
        "irradiance",
        "--task",
        "lambert",
        "--task",
        "blinn_phong",
    ];
    let all = run_in(&project, &tasks, &[]).succeeded();
    assert!(all.stdout.contains("Points: 19 of 19"), "{}", all.all());
    run_in(&project, &["check", "--task", "lambrt"], &[])
        .failed(2, &["no task or question `lambrt`"]);
}

#[test]
fn a_mistake_is_explained_with_pictures_and_data() {
    let (_place, project) = started(&["--language", "es"]);
    let shader = project.join("shaders/lib/by_hand.wgsl");
    let solution = fs::read_to_string(lesson().join("solution/shaders/lib/by_hand.wgsl")).unwrap();
    fs::write(&shader, solution.replace(" / PI;", ";")).unwrap();
    let check = [
        "check",
        "--task",
        "lambert",
        "--language",
        "es",
        "--json",
        "out/result.json",
    ];
    let found = run_in(&project, &check, &[]);
    assert_eq!(found.status, 1, "{}", found.all());
    for part in [
        "Falta dividir entre π",
        "esperado",
        "lesson.html#lambert",
        "Puntos: 0 de 5",
    ] {
        assert!(
            found.stdout.contains(part),
            "no `{part}` in {}",
            found.all()
        );
    }
    for picture in ["expected", "yours", "difference"] {
        let file = project.join(format!("out/check/lambert-matt-1-{picture}.png"));
        assert!(file.is_file(), "{}", file.display());
    }
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(project.join("out/result.json")).unwrap()).unwrap();
    assert_eq!(
        (&json["schema"], &json["points"], &json["of"]),
        (&1.into(), &0.into(), &5.into())
    );
    let cause = &json["tasks"][0]["criteria"][0]["findings"][0]["cause"];
    assert!(
        cause["en"].as_str().unwrap().contains("π is missing"),
        "{cause}"
    );
    // Pictures of an earlier check go away.
    fs::write(&shader, solution).unwrap();
    run_in(&project, &check, &[]).succeeded();
    assert_eq!(fs::read_dir(project.join("out/check")).unwrap().count(), 0);
}

#[test]
fn numbers_belong_to_a_student() {
    let (_place, project) = started(&["--id", "ana \"pérez\""]);
    let readme = fs::read_to_string(project.join("README.md")).unwrap();
    let number = |what: &str| {
        let line = readme.lines().find(|line| line.contains(what)).unwrap();
        let text = line.rsplit(": ").next().unwrap().split(' ').next().unwrap();
        text.parse::<f64>().unwrap()
    };
    solve(&project, "scripts/scenes/first_light.rhai");
    run_in(&project, &["check", "--task", "scene"], &[]).failed(1, &[]);
    let scene = project.join("scripts/scenes/first_light.rhai");
    let text = fs::read_to_string(&scene).unwrap();
    let text = text
        .replace(
            "to_radians(35)",
            &format!("to_radians({})", number("Azimuth")),
        )
        .replace(
            "to_radians(40)",
            &format!("to_radians({})", number("Elevation")),
        )
        .replace(
            "IRRADIANCE = 8.0",
            &format!("IRRADIANCE = {:?}", number("Irradiance")),
        );
    fs::write(scene, text).unwrap();
    run_in(&project, &["check", "--task", "scene"], &[]).succeeded();
}

#[test]
fn a_measured_answer_is_computed_from_its_report() {
    let (_place, project) = started(&[]);
    solve(&project, "shaders/lib/by_hand.wgsl");
    solve(&project, "scripts/scenes/first_light.rhai");
    let question = ["check", "--task", "passes"];
    run_in(&project, &question, &[]).failed(1, &[]);
    let compare = [
        "compare",
        "first_light",
        "--pipelines",
        "by_hand,forward_multi_pass",
        "--size",
        "64x36",
        "--processes",
        "1",
        "--frames",
        "1",
        "--out",
        "reports/passes",
    ];
    run_in(&project, &compare, &[]).succeeded();
    let path = project.join("reports/passes/report.json");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    let bytes = |index: usize| -> f64 {
        let pipeline = &report["points"][0]["comparison"]["pipelines"][index];
        let passes = pipeline["passes"].as_array().unwrap().iter();
        passes
            .map(|pass| {
                pass["bytes_read"].as_f64().unwrap() + pass["bytes_written"].as_f64().unwrap()
            })
            .sum()
    };
    let right = bytes(1) / bytes(0);
    assert!(right > 1.0, "{right}");
    let answer = |value: f64| {
        let text =
            format!("[passes]\nvalue = {value:?}\nreport = \"reports/passes/report.json\"\n");
        fs::write(project.join("answers.toml"), text).unwrap();
        run_in(&project, &question, &[])
    };
    answer((right * 100.0).round() / 100.0).succeeded();
    answer(right * 1.2).failed(1, &[]);
    // A report that was tampered with does not fit the files.
    let text = fs::read_to_string(&path).unwrap();
    let first = &report["points"][0]["comparison"]["pipelines"][0]["passes"][0]["bytes_written"];
    fs::write(
        &path,
        text.replace(
            &format!("\"bytes_written\": {first}"),
            "\"bytes_written\": 12",
        ),
    )
    .unwrap();
    let tampered = answer(right);
    assert_eq!(tampered.status, 1, "{}", tampered.all());
    assert!(
        tampered.stdout.contains("not one of your scene"),
        "{}",
        tampered.all()
    );
}

#[test]
fn one_archive_is_handed_in() {
    let (_place, project) = started(&["--id", "ana/../pérez"]);
    solve(&project, "shaders/lib/by_hand.wgsl");
    fs::create_dir_all(project.join("reports")).unwrap();
    fs::write(project.join("reports/a.json"), "{}").unwrap();
    fs::write(
        project.join("answers.toml"),
        "[passes]\nvalue = 1\nreport = \"reports/a.json\"\n",
    )
    .unwrap();
    let handed = run_in(&project, &["hand-in"], &[]).succeeded();
    assert!(
        handed.stdout.contains("Points: 14 of 21"),
        "{}",
        handed.all()
    );
    let archive = project.join("01-first-light-ana_.._pérez.zip");
    let bytes = fs::read(&archive).unwrap();
    let out = tempfile::tempdir().unwrap();
    unpack(&archive, &out.path().join("in"), &Bounds::default()).unwrap();
    let about = HandedIn::of(&out.path().join("in")).unwrap();
    assert_eq!(
        (about.lesson.as_str(), about.points),
        ("01-first-light", 14)
    );
    assert_eq!(about.student.as_deref(), Some("ana/../pérez"));
    for path in [
        "shaders/lib/by_hand.wgsl",
        "scripts/scenes/first_light.rhai",
        "answers.toml",
        "reports/a.json",
    ] {
        assert_eq!(
            fs::read(out.path().join("in").join(path)).unwrap(),
            fs::read(project.join(path)).unwrap()
        );
    }
    assert!(
        !out.path().join("in/README.md").exists(),
        "nothing but what is asked for"
    );
    run_in(&project, &["hand-in", "--out", "again.zip"], &[]).succeeded();
    assert_eq!(fs::read(project.join("again.zip")).unwrap(), bytes);
}

#[test]
fn a_pack_leaves_out_the_answers() {
    let place = tempfile::tempdir().unwrap();
    let lesson = lesson();
    let lesson = lesson.to_str().unwrap();
    run_in(
        place.path(),
        &["lesson", "pack", lesson, "--student", "packs"],
        &[],
    )
    .succeeded();
    let pack = place.path().join("packs/01-first-light");
    assert!(pack.join("checks.rhai").is_file());
    assert!(!pack.join("solution").exists() && !pack.join("hidden").exists());
    run_in(
        place.path(),
        &["lesson", "start", "packs/01-first-light", "--into", "mine"],
        &[],
    )
    .succeeded();
    solve(&place.path().join("mine"), "shaders/lib/by_hand.wgsl");
    let check = [
        "check",
        "packs/01-first-light",
        "--work",
        "mine",
        "--task",
        "irradiance",
    ];
    run_in(place.path(), &check, &[]).succeeded();
    // A project knows the folder of its lesson, also where the program has none of that name.
    let other = place.path().join("packs/70-of-our-own");
    let text = fs::read_to_string(pack.join("lesson.toml")).unwrap();
    fs::rename(&pack, &other).unwrap();
    fs::write(
        other.join("lesson.toml"),
        text.replace("order = 1\n", "order = 70\n"),
    )
    .unwrap();
    let begin = ["lesson", "start", "packs/70-of-our-own", "--into", "ours"];
    run_in(place.path(), &begin, &[]).succeeded();
    let project = place.path().join("ours");
    solve(&project, "shaders/lib/by_hand.wgsl");
    let check = ["check", "--task", "irradiance"];
    run_in(&project, &check, &[]).succeeded();
    fs::remove_dir_all(&other).unwrap();
    run_in(&project, &check, &[]).failed(1, &["there is no lesson `70-of-our-own`"]);
    let listed = run_in(place.path(), &["list", "files"], &[]).succeeded();
    assert!(listed.stdout.contains("lessons/01-first-light/lesson.toml"));
    assert!(
        !listed.stdout.contains("solution"),
        "the program holds no solution"
    );
}

#[test]
fn a_new_lesson_runs_as_it_is() {
    let project = Project::new();
    project.run(&["new", "lesson", "90-night_sky"]).succeeded();
    let lesson = "lessons/90-night_sky";
    let solved = project
        .run(&["check", lesson, "--work", &format!("{lesson}/solution")])
        .succeeded();
    assert!(solved.stdout.contains("Points: 2 of 2"), "{}", solved.all());
    let starter = project.run(&["check", lesson, "--work", &format!("{lesson}/starter")]);
    assert!(
        starter.stdout.contains("Points: 0 of 2"),
        "{}",
        starter.all()
    );
    project
        .run(&["new", "lesson", "90-other"])
        .failed(1, &["the number 90"]);
    project
        .run(&["new", "lesson", "no way"])
        .failed(2, &["lesson's name"]);
    // Without a number it comes after the last one.
    project.run(&["new", "lesson", "dusk"]).succeeded();
    assert!(project.file("lessons/91-dusk/lesson.toml").is_file());
    let listed = project.run(&["lesson", "list"]).succeeded();
    assert!(
        listed.stdout.contains("90-night_sky") && listed.stdout.contains("Night sky"),
        "{}",
        listed.all()
    );

    // What is wrong in it is told with its line.
    let file = format!("{lesson}/lesson.toml");
    let text = fs::read_to_string(project.file(&file)).unwrap();
    for (from, to, parts) in [
        (
            "points = 2",
            "points = 0",
            ["lesson.toml:21", "from 1 to 1000"],
        ),
        (
            "read = \"ramp\"",
            "read = \"rmap\"",
            ["lesson.toml:15", "the place `rmap`"],
        ),
        (
            "[\"shaders/lib/exercise.wgsl\"]     #",
            "[\"shaders/lib/other.wgsl\"] #",
            ["lesson.toml:7", "lacks it"],
        ),
        ("points = 2", "pionts = 2", ["lesson.toml:22", "pionts"]),
    ] {
        assert!(text.contains(from), "{from}");
        project.write(&file, text.replace(from, to));
        project
            .run(&["check", lesson, "--work", "."])
            .failed(1, &parts);
    }
    project.write(&file, &text);
    let checks = format!("{lesson}/checks.rhai");
    let right = fs::read_to_string(project.file(&checks)).unwrap();
    project.write(&checks, right.replace("check_ramp", "check_rmap"));
    project
        .run(&["check", lesson, "--work", "."])
        .failed(1, &["no function `check_ramp(work)`"]);
    project.write(&checks, right.replace("\"even\"", "\"evn\""));
    let broken = project.run(&["check", lesson, "--work", &format!("{lesson}/solution")]);
    assert!(
        broken.stdout.contains("did you mean `even`"),
        "{}",
        broken.all()
    );
}

#[test]
fn a_shipped_pipeline_under_another_name_gets_nothing() {
    let project = Project::new();
    project.run(&["new", "lesson", "90-pipelines"]).succeeded();
    let lesson = "lessons/90-pipelines";
    let file = format!("{lesson}/lesson.toml");
    let text = fs::read_to_string(project.file(&file)).unwrap();
    let text = text
        .replace("shaders/lib/exercise.wgsl", "scripts/pipelines/exercise.rhai")
        .replace(
            "imports = []",
            "imports = [\"parts/output\", \"parts/antialiasing\", \"parts/reflection\", \"parts/transparent\", \
             \"shaders/forward/depth_only.wgsl\", \"shaders/forward/single_pass.wgsl\"]",
        );
    project.write(&file, text);
    let shipped =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../scripts/pipelines/forward_single_pass.rhai");
    let shipped = fs::read_to_string(shipped).unwrap();
    // Other names and texts, other numbers, no comments, one statement a line.
    let disguised: String = shipped
        .lines()
        .map(|line| line.split("//").next().unwrap().trim())
        .map(|line| {
            line.replace("antialiasing.", "smoothing.")
                .replace("let antialiasing", "let smoothing")
        })
        .map(|line| {
            line.replace("gather_lights =", "nearby =")
                .replace("\"hdr\"", "\"sum\"")
                .replace("-10.0", "-8.0")
        })
        .collect::<Vec<_>>()
        .join("\n");
    project.write("scripts/pipelines/exercise.rhai", disguised);
    let outcome = project.run(&["check", lesson, "--work", "."]);
    assert_eq!(outcome.status, 1, "{}", outcome.all());
    for part in [
        "Points: 0 of 2",
        "the shipped file scripts/pipelines/forward_single_pass.rhai with other names",
    ] {
        assert!(
            outcome.stdout.contains(part),
            "no `{part}` in {}",
            outcome.all()
        );
    }
    // What the lesson does not allow is told first.
    project.write(
        "scripts/pipelines/exercise.rhai",
        "import \"parts/g_buffer\" as g;\nlet p = pipeline(\"x\");\np",
    );
    let outcome = project.run(&["check", lesson, "--work", "."]);
    assert!(
        outcome
            .stdout
            .contains("exercise.rhai:1: `parts/g_buffer` may not be used"),
        "{}",
        outcome.all()
    );
}
