//! A hundred hand-ins of the lesson on deferred shading, graded two at a time: right ones, each typical
//! mistake of the lesson, and five that do harm. Prints how long that takes, and ends with a message where
//! one was not graded as it should be.
//!
//! ```sh
//! cargo bench --workspace --bench grade_hundred
//! ```

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use lightbench::course::archive::pack;

const LESSON: &str = "06-deferred-shading";
const SCRIPT: &str = "scripts/pipelines/parts/own_volumes.rhai";
const SHADER: &str = "shaders/lib/own_layout.wgsl";
const ALL: usize = 100;

type Files = BTreeMap<String, String>;

fn lesson() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lessons");
    root.canonicalize().expect("the lessons").join(LESSON)
}

fn table(path: &str) -> toml::Table {
    let text = fs::read_to_string(lesson().join(path)).expect(path);
    toml::from_str(&text).expect(path)
}

/// The solution, as somebody wrote it.
fn solution(name: &str) -> Files {
    let about = table("lesson.toml");
    let submits = about["submits"].as_array().expect("what is handed in");
    let files = submits.iter().map(|path| {
        let path = path.as_str().expect("a path").to_owned();
        let text = fs::read_to_string(lesson().join("solution").join(&path)).expect("a file");
        (path, format!("// {name} wrote this.\n{text}"))
    });
    files.collect()
}

/// Makes the changes of a variant.
fn changed(mut files: Files, variant: &toml::Value) -> Files {
    let more = variant.get("and").and_then(toml::Value::as_array);
    for edit in std::iter::once(variant).chain(more.into_iter().flatten()) {
        let part = |name: &str| edit[name].as_str().expect(name);
        let text = files
            .get_mut(part("file"))
            .expect("a file that is handed in");
        assert!(text.contains(part("from")), "no `{}`", part("from"));
        *text = text.replace(part("from"), part("to"));
    }
    files
}

/// Those that do harm: their names, and their files or the bytes in an archive's place.
fn hostile() -> Vec<(&'static str, Files)> {
    let with = |path: &str, text: String| {
        let mut files = solution("Somebody");
        files.insert(path.to_owned(), text);
        files
    };
    let shader = solution("Somebody")[SHADER].clone();
    let first = shader.find("\nfn ").expect("a function");
    let endless = format!(
        "{}\nfn endless(start: f32) -> f32 {{
    var x = start;
    while x != 12345.0 {{ while x != 12346.0 {{ x = fract(x * 7.13 + 0.37); }} }}
    return x;
}}
{}",
        &shader[..first],
        shader[first..].replace(
            "return select(vec2f(-1.0)",
            "return endless(v.x) * select(vec2f(-1.0)"
        )
    );
    let deep = format!(
        "const X = {}1.0{};\n",
        "(".repeat(200_000),
        ")".repeat(200_000)
    );
    vec![
        ("loops-in-a-script", with(SCRIPT, "loop {}".to_owned())),
        ("loops-in-a-shader", with(SHADER, endless)),
        ("eats-memory", with(SCRIPT, "let all = []; loop { all.push(\"x\".repeat(100000)); }\nfn repeat(s, n) { let t = s; while t.len < n { t += t; } t }".to_owned())),
        ("too-deep", with(SHADER, deep)),
    ]
}

fn main() {
    let place = tempfile::tempdir().expect("a folder");
    let folder = place.path().join("in");
    fs::create_dir(&folder).expect("a folder");
    let hand_in = |name: &str, files: &Files| {
        let files: Vec<_> = files
            .iter()
            .map(|(path, text)| (path.clone(), text.clone().into_bytes()))
            .collect();
        pack(&folder.join(format!("{name}.zip")), &files).expect("an archive");
    };
    let variants = table("hidden/variants.toml");
    let of = |kind: &str| variants[kind].as_array().expect(kind).clone();
    let (rights, mistakes) = (of("right"), of("mistake"));
    let hostile = hostile();
    for (name, files) in &hostile {
        hand_in(name, files);
    }
    fs::write(folder.join("essay.zip"), "I could not finish it.").expect("a file");
    let (mut right, mut wrong) = (Vec::new(), Vec::new());
    for number in 0..ALL - hostile.len() - 1 {
        let name = format!("student{number:03}");
        let files = solution(&name);
        if number % 2 == 0 {
            // Every sixth way is the solution itself.
            let files = match rights.get(number / 2 % (rights.len() + 1)) {
                Some(variant) => changed(files, variant),
                None => files,
            };
            hand_in(&name, &files);
            right.push(name);
        } else {
            hand_in(
                &name,
                &changed(files, &mistakes[number / 2 % mistakes.len()]),
            );
            wrong.push(name);
        }
    }

    let began = Instant::now();
    let graded = Command::new(env!("CARGO_BIN_EXE_lightbench"))
        .current_dir(place.path())
        .arg("grade")
        .arg(lesson())
        .args(["--submissions", "in", "--out", "out", "--jobs", "2"])
        .output()
        .expect("the program");
    let took = began.elapsed().as_secs_f64();
    assert!(
        graded.status.success(),
        "{}",
        String::from_utf8_lossy(&graded.stderr)
    );
    let text = fs::read_to_string(place.path().join("out/points.csv")).expect("the table");
    let points: BTreeMap<&str, (&str, Option<u32>)> = text
        .lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            (cells[0], (cells[3], cells[5].parse().ok()))
        })
        .collect();
    assert_eq!(points.len(), ALL);
    let full = points[right[0].as_str()].1.expect("points");
    assert!(full > 10, "{full}");
    for name in &right {
        // One that is right, but near a threshold, has its points too, and a person looks at it.
        let (state, of) = points[name.as_str()];
        let is_judged = state == "checked" || state == "near a threshold";
        assert!(is_judged && of == Some(full), "{name}: {state} {of:?}");
    }
    for name in &wrong {
        let (state, of) = points[name.as_str()];
        assert!(
            state == "checked" && of.is_some_and(|of| of < full),
            "{name}: {state} {of:?}"
        );
    }
    for name in hostile.iter().map(|(name, _)| *name).chain(["essay"]) {
        let (state, of) = points[name];
        assert!(of.is_none_or(|of| of < full), "{name}: {state} {of:?}");
        println!("{name:>20}: {state}, {of:?} points");
    }
    println!(
        "{ALL} hand-ins in {:.0} min {:02.0} s, two at a time: {} right, {} mistaken, {} hostile",
        (took / 60.0).floor(),
        took % 60.0,
        right.len(),
        wrong.len(),
        hostile.len() + 1
    );
}
