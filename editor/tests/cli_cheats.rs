//! Cheats and honest hand-ins, graded side by side: each cheat gets no points for what it did not solve or
//! is marked for a person, and no honest one is.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use cli_support::run_in;
use lightbench::course::archive::pack;
use zip::write::SimpleFileOptions;

const SCENE: &str = "scripts/scenes/first_light.rhai";
const SHADER: &str = "shaders/lib/by_hand.wgsl";

/// Points of the tasks together, without the question that is measured.
const FULL: u32 = 19;

fn root() -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    path.canonicalize().unwrap()
}

fn of_lesson(path: &str) -> String {
    fs::read_to_string(root().join("lessons/01-first-light").join(path)).unwrap()
}

fn shipped(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

type Files = BTreeMap<String, String>;

fn files(scene: &str, shader: &str) -> Files {
    let both = [(SCENE, scene), (SHADER, shader)];
    both.map(|(path, text)| (path.to_owned(), text.to_owned()))
        .into()
}

fn starter() -> Files {
    let [scene, shader] = [SCENE, SHADER].map(|path| of_lesson(&format!("starter/{path}")));
    files(&scene, &shader)
}

fn solution() -> Files {
    let [scene, shader] = [SCENE, SHADER].map(|path| of_lesson(&format!("solution/{path}")));
    files(&scene, &shader)
}

fn with(mut files: Files, more: &[(&str, &str)]) -> Files {
    for (path, text) in more {
        files.insert((*path).to_owned(), (*text).to_owned());
    }
    files
}

/// Replaces a text, which must be there.
fn edited(mut files: Files, path: &str, from: &str, to: &str) -> Files {
    let text = files.get_mut(path).unwrap();
    assert!(text.contains(from), "{path} has no `{from}`");
    *text = text.replace(from, to);
    files
}

/// The same in other words: each file says whose it is, since no two people write the same bytes.
fn signed(files: Files, name: &str) -> Files {
    let lines = files.into_iter();
    lines
        .map(|(path, text)| (path, format!("// {name} wrote this.\n{text}")))
        .collect()
}

fn says(student: &str, points: u32) -> String {
    format!(
        "{{\"lesson\": \"01-first-light\", \"student\": \"{student}\", \"program\": \"0\", \"points\": {points}, \"of\": 21}}"
    )
}

/// Twenty right ways: those of the lesson, several of them at once.
fn honest() -> Vec<Files> {
    let text = of_lesson("hidden/variants.toml");
    let table: toml::Table = toml::from_str(&text).unwrap();
    let rights = table["right"].as_array().unwrap();
    let value = |right: &toml::Value, name: &str| right[name].as_str().unwrap().to_owned();
    let ways = (0..20).map(|number| {
        let mut files = solution();
        // Which of them: all alone at first, then pairs that are farther apart.
        let step = 1 + number / rights.len();
        for at in [number, number * step + step] {
            let right = &rights[at % rights.len()];
            let (path, from) = (value(right, "file"), value(right, "from"));
            // Two that change the same lines can't both be taken.
            if files[&path].contains(&from) {
                files = edited(files, &path, &from, &value(right, "to"));
            }
        }
        signed(files, &format!("Student {number}"))
    });
    ways.collect()
}

/// A report that was measured, with the bytes of the second pipeline changed, and the answer that fits.
fn with_a_changed_report(place: &Path) -> Files {
    let project = place.join("measured");
    let lesson = root().join("lessons/01-first-light");
    let lesson = lesson.to_str().unwrap();
    run_in(
        place,
        &["lesson", "start", lesson, "--into", "measured"],
        &[],
    )
    .succeeded();
    for (path, text) in solution() {
        fs::write(project.join(path), text).unwrap();
    }
    let arguments = [
        "compare",
        "first_light",
        "--pipelines",
        "by_hand,forward_multi_pass",
        "--size",
        "64x36",
        "--frames",
        "1",
        "--processes",
        "1",
        "--out",
        "reports/passes",
    ];
    run_in(&project, &arguments, &[]).succeeded();
    let report = fs::read_to_string(project.join("reports/passes/report.json")).unwrap();
    let mut value: serde_json::Value = serde_json::from_str(&report).unwrap();
    let pipelines = &mut value["points"][0]["comparison"]["pipelines"];
    for pass in pipelines[1]["passes"].as_array_mut().unwrap() {
        for bytes in ["bytes_read", "bytes_written"] {
            pass[bytes] = (pass[bytes].as_u64().unwrap() * 2).into();
        }
    }
    let sum = |pipeline: &serde_json::Value| -> u64 {
        let passes = pipeline["passes"].as_array().unwrap().iter();
        passes
            .map(|pass| {
                pass["bytes_read"].as_u64().unwrap() + pass["bytes_written"].as_u64().unwrap()
            })
            .sum()
    };
    let ratio = sum(&pipelines[1]) as f64 / sum(&pipelines[0]) as f64;
    let answers = format!("[passes]\nvalue = {ratio}\nreport = \"reports/passes/report.json\"\n");
    with(
        starter(),
        &[
            ("answers.toml", &answers),
            ("reports/passes/report.json", &value.to_string()),
        ],
    )
}

/// What is done without solving anything, or with somebody else's work.
fn cheats(place: &Path) -> Vec<(&'static str, Files)> {
    let bare: String = starter()[SHADER]
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .map(|line| format!("  {line}\n"))
        .collect();
    let library = shipped("shaders/lib/brdf.wgsl").replace("lightbench::brdf", "by_hand");
    let shipped_scene = shipped("scripts/scenes/brdf_spheres.rhai").replace("COLUMNS", "ACROSS");
    let wall = "let p = texture(\"figures/first_light.png\");
spawn(\"wall\").mesh(plane(16, 9)).material(material(\"picture\").emissive(1, 1, 1).emissive_map(p));
";
    vec![
        ("the starter, unchanged", starter()),
        (
            "the starter in other words",
            with(
                starter(),
                &[(SHADER, &format!("{bare}const MINE = 1.0;\n"))],
            ),
        ),
        ("shipped files, renamed", files(&shipped_scene, &library)),
        (
            "the library called in place of one's own work",
            edited(
                edited(
                    starter(),
                    SHADER,
                    "#define_import_path by_hand",
                    "#define_import_path by_hand\n#import lightbench::brdf",
                ),
                SHADER,
                "return vec3f(0.0);",
                "return vec3f(brdf::lambert(vec3f(1.0)).r);",
            ),
        ),
        (
            "the expected picture, read",
            with(
                starter(),
                &[
                    (SCENE, &format!("{}{wall}", starter()[SCENE])),
                    ("figures/first_light.png", "a picture"),
                ],
            ),
        ),
        (
            "the values of the checks, by heart",
            edited(
                starter(),
                SHADER,
                "fn irradiance(intensity: vec3f, to_light: vec3f, normal: vec3f) -> vec3f {
    return vec3f(0.0);",
                "fn irradiance(intensity: vec3f, to_light: vec3f, normal: vec3f) -> vec3f {
    let squared = dot(to_light, to_light);
    let cosine = dot(vec3f(1.0, 2.0, 2.0) / 3.0, to_light) * inverseSqrt(squared);
    return intensity * max(cosine, 0.0) / squared;",
            ),
        ),
        (
            "checks of one's own",
            with(
                starter(),
                &[
                    (
                        "checks.rhai",
                        "fn check_scene(work) {} fn check_irradiance(work) {} fn check_lambert(work) {} fn check_blinn_phong(work) {}",
                    ),
                    ("lesson.toml", "order = 1"),
                    (
                        "checks/scripts/pipelines/check_functions.rhai",
                        "pipeline(\"nothing\")",
                    ),
                ],
            ),
        ),
        (
            "a result that was written by hand",
            with(
                starter(),
                &[
                    ("hand-in.json", &says("cheat8", 21)),
                    ("result.json", "{\"points\": 21, \"of\": 21}"),
                ],
            ),
        ),
        ("a report that was changed", with_a_changed_report(place)),
        (
            "the numbers of somebody else",
            with(
                signed(solution(), "Nobody"),
                &[("hand-in.json", &says("zoe.else", 21))],
            ),
        ),
        (
            "the library changed",
            with(
                starter(),
                &[
                    (
                        "shaders/lib/lighting.wgsl",
                        "#define_import_path lightbench::lighting",
                    ),
                    (
                        "scripts/scenes/parts/first_light_stage.rhai",
                        "fn build(shine) { point_light(\"lamp\").intensity(72); }",
                    ),
                ],
            ),
        ),
        (
            "success, printed",
            with(
                starter(),
                &[(
                    SCENE,
                    &format!(
                        "{}\nprint(\"all criteria hold: 21 of 21 points\");\n",
                        starter()[SCENE]
                    ),
                )],
            ),
        ),
    ]
}

/// The lines of the table: student, whether to look at it, points, why.
fn table(text: &str) -> BTreeMap<String, (String, u32, String)> {
    let lines = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let points = cells[5].parse().unwrap_or(0);
        let why = line.to_owned();
        (cells[0].to_owned(), (cells[4].to_owned(), points, why))
    });
    lines.collect()
}

#[test]
fn cheats_are_caught_and_nobody_else() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("in");
    fs::create_dir(&folder).unwrap();
    let hand_in = |name: &str, files: &Files| {
        let files: Vec<_> = files
            .iter()
            .map(|(path, text)| (path.clone(), text.clone().into_bytes()))
            .collect();
        pack(&folder.join(name), &files).unwrap();
    };
    let honest = honest();
    for (number, files) in honest.iter().enumerate() {
        hand_in(&format!("honest{number:02}.zip"), files);
    }
    let cheats = cheats(place.path());
    assert_eq!(cheats.len(), 12);
    for (number, (_, files)) in cheats.iter().enumerate() {
        hand_in(&format!("cheat{number:02}.zip"), files);
    }
    // Those whose points are right, but whose work is not theirs: a person looks at them.
    hand_in("copied.zip", &honest[0]);
    for (name, person) in [("id1.zip", "Somebody"), ("id2.zip", "Else")] {
        let id = says("one.id", FULL);
        hand_in(
            name,
            &with(signed(solution(), person), &[("hand-in.json", &id)]),
        );
    }
    // A way out of the folder, into somebody else's work.
    let mut zip = zip::ZipWriter::new(File::create(folder.join("out.zip")).unwrap());
    let path = format!("../honest00/work/{SHADER}");
    zip.start_file(path, SimpleFileOptions::default()).unwrap();
    zip.write_all(starter()[SHADER].as_bytes()).unwrap();
    zip.finish().unwrap();

    let lesson = root().join("lessons/01-first-light");
    let arguments = [
        "grade",
        lesson.to_str().unwrap(),
        "--submissions",
        "in",
        "--out",
        "out",
        "--jobs",
        "2",
    ];
    // Each hand-in has a limit of its own; all together take a minute or two.
    let graded = Command::new(env!("CARGO_BIN_EXE_lightbench"))
        .current_dir(place.path())
        .args(arguments)
        .output()
        .unwrap();
    assert!(graded.status.success(), "{graded:?}");
    let text = fs::read_to_string(place.path().join("out/points.csv")).unwrap();
    let table = table(&text);

    for number in 1..honest.len() {
        let (look, points, why) = &table[&format!("honest{number:02}")];
        assert_eq!((look.as_str(), *points), ("no", FULL), "{why}");
    }
    for (number, (what, _)) in cheats.iter().enumerate() {
        let (_, points, why) = &table[&format!("cheat{number:02}")];
        match *what {
            // Only the lamp stands at a place of somebody else.
            "the numbers of somebody else" => assert!(*points < FULL, "{what}: {why}"),
            _ => assert_eq!(*points, 0, "{what}: {why}"),
        }
    }
    // Both who hold the same file, since nobody knows who had it first.
    for student in ["honest00", "copied", "id1", "id2"] {
        assert_eq!(table[student].0, "yes", "{}", table[student].2);
    }
    assert_eq!(table["honest00"].1, FULL);
    // Refused, and told why; the work that it aimed at is what it was.
    assert_eq!(table["out"].1, 0);
    assert!(table["out"].2.contains("leads out of the folder"));
}
