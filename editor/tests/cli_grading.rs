//! `grade`: a folder of hand-ins, honest, broken and hostile.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use cli_support::{Outcome, run_in};
use lightbench::course::archive::pack;
use serde_json::Value;
use tempfile::TempDir;
use zip::write::SimpleFileOptions;

const SHADER: &str = "shaders/lib/display.wgsl";

fn lesson() -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lessons/11-linear-light");
    path.canonicalize().unwrap()
}

fn of_lesson(path: &str) -> String {
    fs::read_to_string(lesson().join(path)).unwrap()
}

fn solution() -> String {
    of_lesson(&format!("solution/{SHADER}"))
}

/// A folder with hand-ins, and one for what comes out.
struct Course {
    place: TempDir,
}

impl Course {
    fn new() -> Self {
        let place = tempfile::Builder::new()
            .prefix("curso ñ ")
            .tempdir()
            .unwrap();
        fs::create_dir(place.path().join("in")).unwrap();
        Self { place }
    }

    fn file(&self, path: &str) -> PathBuf {
        self.place.path().join(path)
    }

    /// An archive with files.
    fn hand_in(&self, name: &str, files: &[(&str, &str)]) -> &Self {
        let path = self.file("in").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let files: Vec<_> = files
            .iter()
            .map(|(path, text)| ((*path).to_owned(), text.as_bytes().to_vec()))
            .collect();
        pack(&path, &files).unwrap();
        self
    }

    /// An archive with that shader.
    fn shader(&self, name: &str, text: &str) -> &Self {
        self.hand_in(name, &[(SHADER, text)])
    }

    fn grade(&self, more: &[&str]) -> Outcome {
        let lesson = lesson();
        let lesson = lesson.to_str().unwrap();
        let mut arguments = vec!["grade", lesson, "--submissions", "in", "--out", "out"];
        arguments.extend(more);
        run_in(self.place.path(), &arguments, &[])
    }

    fn record(&self, student: &str) -> Value {
        let path = self.file(&format!("out/students/{student}/record.json"));
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
    }

    /// The points and the state of each student.
    fn points(&self) -> BTreeMap<String, (String, String)> {
        let text = fs::read_to_string(self.file("out/points.csv")).unwrap();
        let lines = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').collect::<Vec<_>>());
        lines
            .map(|cells| {
                (
                    cells[0].to_owned(),
                    (cells[5].to_owned(), cells[3].to_owned()),
                )
            })
            .collect()
    }
}

fn pair(points: &str, state: &str) -> (String, String) {
    (points.to_owned(), state.to_owned())
}

#[test]
fn honest_and_hostile_hand_ins_are_graded_side_by_side() {
    let course = Course::new();
    // It counts rounds, so that no compiler can leave them out. The software driver ends it after some.
    let endless = solution().replace(
        "fn encode(light: f32) -> f32 {",
        "fn encode(light: f32) -> f32 {
    var x = light;
    var rounds = 0.0;
    while x != 12345.0 {
        while x != 12346.0 {
            while x != 12347.0 { x = fract(x * 7.13 + 0.37); rounds += 1.0; }
        }
    }
    if rounds > 0.5 { return rounds; }",
    );
    let missing_root = solution().replace("pow(light, 1.0 / GAMMA)", "light");
    course
        .shader("honest.zip", &solution())
        .shader("mistaken.zip", &missing_root)
        .shader("starter.zip", &of_lesson(&format!("starter/{SHADER}")))
        .shader("endless.zip", &endless)
        .shader("broken.zip", "fn encode(")
        .hand_in("empty.zip", &[("readme.txt", "nothing")])
        .hand_in(
            "wrapped.zip",
            &[(&format!("my homework/{SHADER}"), &solution())],
        );
    fs::write(course.file("in/essay.zip"), "I could not finish it.").unwrap();
    let mut link = zip::ZipWriter::new(File::create(course.file("in/link.zip")).unwrap());
    let options = SimpleFileOptions::default();
    link.add_symlink(SHADER, "/etc/passwd", options).unwrap();
    link.finish().unwrap();

    let graded = course.grade(&["--jobs", "2", "--time", "12"]).succeeded();
    let points = course.points();
    let full = points["honest"].0.clone();
    assert!(full.parse::<u32>().unwrap() > 8, "{points:?}");
    assert_eq!(points["honest"].1, "checked");
    assert_eq!(points["wrapped"], points["honest"]);
    let mistaken: u32 = points["mistaken"].0.parse().unwrap();
    assert!(mistaken < full.parse().unwrap(), "{points:?}");
    for student in ["starter", "broken", "empty"] {
        assert_eq!(points[student], pair("0", "checked"), "{student}");
    }
    // Whether a driver ends the loop or the clock does, the others are not harmed.
    let endless: u32 = points["endless"].0.parse().unwrap();
    assert!(endless < full.parse().unwrap(), "{points:?}");
    for student in ["essay", "link"] {
        assert_eq!(points[student], pair("0", "no submission"), "{student}");
    }
    assert!(graded.stderr.contains("[9/9]"), "{}", graded.all());
    // A student is told what to do, and nothing of where the hand-ins lie.
    let page = fs::read_to_string(course.file("out/students/essay/page.html")).unwrap();
    assert!(
        page.contains("make the archive with `lightbench hand-in`"),
        "{page}"
    );
    assert!(!page.contains("in/essay.zip"), "{page}");
    // The two that handed in the same file.
    let csv = fs::read_to_string(course.file("out/points.csv")).unwrap();
    for (student, other) in [("honest", "wrapped"), ("wrapped", "honest")] {
        let line = csv.lines().find(|line| line.starts_with(student)).unwrap();
        assert!(line.contains(&format!("the same, byte for byte, as that of {other}")));
    }
    // Pages hold one student's data alone, and what is wrong.
    let page = fs::read_to_string(course.file("out/students/mistaken/page.html")).unwrap();
    assert!(page.contains("data:image/png;base64,") && page.contains("does not hold"));
    assert!(!page.contains("honest") && !page.contains("endless"));
    let scores = fs::read_to_string(course.file("out/gradescope/mistaken.json")).unwrap();
    let scores: Value = serde_json::from_str(&scores).unwrap();
    assert_eq!(scores["score"], mistaken);
    let junit = fs::read_to_string(course.file("out/junit.xml")).unwrap();
    assert_eq!(junit.matches("<testsuite ").count(), 9);
    assert!(
        course
            .file("out/jplag/honest/shaders-lib-display.wgsl.txt")
            .is_file()
    );
}

#[test]
fn it_goes_on_where_it_was_and_grades_what_has_changed() {
    let course = Course::new();
    course
        .shader("lovelaceada_123_1_a.zip", &solution())
        .shader(
            "hoppergrace_9_2_a.zip",
            &of_lesson(&format!("starter/{SHADER}")),
        );
    course.grade(&[]).succeeded();
    let first = fs::read(course.file("out/points.csv")).unwrap();
    let again = course.grade(&[]).succeeded();
    assert_eq!(
        again.stderr.matches("as before").count(),
        2,
        "{}",
        again.all()
    );
    assert_eq!(fs::read(course.file("out/points.csv")).unwrap(), first);
    let one = course.grade(&["--student", "123"]).succeeded();
    assert_eq!(one.stderr.matches("as before").count(), 1, "{}", one.all());
    assert_eq!(fs::read(course.file("out/points.csv")).unwrap(), first);
    course
        .grade(&["--student", "124"])
        .failed(2, &["no hand-in is of the student `124`"]);

    // Late, and better.
    course.shader("hoppergrace_LATE_9_3_a-1.zip", &solution());
    let later = course.grade(&[]).succeeded();
    assert_eq!(
        later.stderr.matches("as before").count(),
        1,
        "{}",
        later.all()
    );
    let record = course.record("9");
    assert_eq!(record["late"], true);
    assert_eq!(record["archive"], "hoppergrace_LATE_9_3_a-1.zip");
    assert_eq!(
        record["replaced"],
        serde_json::json!(["hoppergrace_9_2_a.zip"])
    );
    assert_eq!(course.points()["9"].0, course.points()["123"].0);
}

#[test]
fn a_list_of_ids_counts_more_than_what_a_hand_in_says() {
    let course = Course::new();
    let says = |student: &str| {
        format!(
            "{{\"lesson\": \"11-linear-light\", \"student\": \"{student}\", \"program\": \"0\", \"points\": 99, \"of\": 99}}"
        )
    };
    // Numbers of others do not fit a solution.
    course
        .hand_in(
            "1.zip",
            &[(SHADER, &solution()), ("hand-in.json", &says("ada"))],
        )
        .hand_in(
            "2.zip",
            &[(SHADER, &solution()), ("hand-in.json", &says("ada"))],
        )
        .hand_in(
            "3.zip",
            &[(
                "hand-in.json",
                &says("x").replace("11-linear-light", "01-first-light"),
            )],
        );
    fs::write(course.file("ids.csv"), "student,id\n2,grace\n").unwrap();
    course.grade(&["--ids", "ids.csv"]).succeeded();
    assert_eq!(course.record("1")["id"], "ada");
    assert_eq!(course.record("2")["id"], "grace");
    let other = course.record("3");
    let text = other["ending"]["no_submission"].as_str().unwrap();
    assert_eq!(text, "it is a hand-in of the lesson 01-first-light");
    let table = fs::read_to_string(course.file("out/points.csv")).unwrap();
    assert!(table.contains("the list says `grace`"), "{table}");
    assert!(table.contains("the id `ada` is also that of"), "{table}");
    fs::write(course.file("ids.csv"), "student,id\n2;grace\n").unwrap();
    course
        .grade(&["--ids", "ids.csv"])
        .failed(1, &["ids.csv:2", "student,id"]);
}

#[test]
fn a_grading_that_is_stopped_goes_on() {
    let course = Course::new();
    for name in ["a", "b", "c"] {
        course.shader(&format!("{name}.zip"), &solution());
    }
    let mut child = Command::new(env!("CARGO_BIN_EXE_lightbench"))
        .current_dir(course.place.path())
        .arg("grade")
        .arg(lesson())
        .args(["--submissions", "in", "--out", "out", "--jobs", "1"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let began = Instant::now();
    while !course.file("out/students/a/record.json").exists() {
        assert!(began.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let rest = course.grade(&[]).succeeded();
    assert!(rest.stderr.contains("as before"), "{}", rest.all());
    assert_eq!(course.points().len(), 3);
}

#[test]
fn what_can_not_be_graded_is_said() {
    let course = Course::new();
    course.grade(&[]).failed(1, &["holds no hand-in"]);
    let mut stray = File::create(course.file("in/notes.txt")).unwrap();
    stray.write_all(b"x").unwrap();
    course.shader("a.zip", &solution());
    let graded = course.grade(&["--adapter", "no such adapter"]);
    assert_eq!(graded.status, 1, "{}", graded.all());
    assert!(
        graded.stderr.contains("notes.txt is nobody's hand-in"),
        "{}",
        graded.all()
    );
    // No points are no zero.
    assert_eq!(course.points()["a"], pair("", "failed"));
}
