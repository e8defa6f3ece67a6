//! Scripts of strangers: each is stopped with a sentence, in time, without a panic.
#![allow(clippy::unwrap_used)]

use std::time::{Duration, Instant};

use lightbench_assets::Progress;
use lightbench_assets::cache::Cache;
use lightbench_render::{Problem, Problems};

use crate::testing::project;
use crate::{Limits, Scene, Settings, load_pipeline, load_scene, load_scene_within};

fn run(text: &str) -> Result<Scene, Problems> {
    run_files(&[("scripts/scenes/test.rhai", text)])
}

/// Runs the first file, on a thread with the small stack that a worker has.
fn run_files(files: &[(&str, &str)]) -> Result<Scene, Problems> {
    let limits = Limits {
        load_time: Duration::from_secs(2),
        operations: 20_000_000,
        entities: 10_000,
        ..Limits::default()
    };
    let (_folder, store) = project(files);
    let path = files[0].0.to_owned();
    std::thread::scope(|scope| {
        std::thread::Builder::new()
            .stack_size(2 << 20)
            .spawn_scoped(scope, || {
                load_scene_within(
                    &store,
                    &path,
                    &Settings::new(),
                    &Progress::new(),
                    &Cache::default(),
                    &limits,
                )
            })
            .unwrap()
            .join()
            .unwrap()
    })
}

fn refused(text: &str) -> Problem {
    match run(text) {
        Ok(_) => panic!("this was accepted: {}", &text[..text.len().min(200)]),
        Err(problems) => problems.0.into_iter().next().unwrap(),
    }
}

#[track_caller]
fn says(text: &str, expected: &str) {
    let start = Instant::now();
    let problem = refused(text);
    assert!(
        problem.message.contains(expected),
        "expected `{expected}`, got: {problem}"
    );
    assert!(
        start.elapsed() < Duration::from_secs(8),
        "took {:?}: {expected}",
        start.elapsed()
    );
}

#[test]
fn endless_loops() {
    says("loop { }", "a loop that never ends");
    says(
        "let x = 0; while true { x += 1; }",
        "a loop that never ends",
    );
    says(
        "fn ping(n) { pong(n) } fn pong(n) { ping(n) } ping(1);",
        "call each other more than 64 deep",
    );
    says("fn f() { f() } f();", "call each other more than 64 deep");
    says(
        "let f = |f, x| f.call(f, x); f.call(f, 1);",
        "call each other more than 64 deep",
    );
}

#[test]
fn bombs() {
    says("let s = \"x\"; loop { s += s; }", "bytes of text");
    says("let a = [1]; loop { a += a; }", "elements of arrays");
    says("let a = []; a.pad(2000000000, 0);", "elements of arrays");
    // Rhai does not count the entries of a map that is written by index; clock and memory hold.
    says(
        "let m = #{}; let i = 0; loop { m[\"k\" + i] = i; i += 1; }",
        "the script",
    );
    says(
        "let m = #{}; loop { m = #{a: m, b: m}; }",
        "entries of maps",
    );
    // Each value is small enough; only their sum is not.
    says(
        "let s = \"x\"; for i in 0..21 { s += s; } let i = 0; loop { state[\"k\" + i] = s + i; i += 1; }",
        "take more than 256 MiB together",
    );
    says("blob(2000000000)", "elements of arrays");
    says("indices(2000000000)", "must be from 0 to 1000000");
    says("random(1).floats(2000000000)", "must be from 0 to 1000000");
    // A few calls that take as long as many.
    says(
        "let c = indices(1000000); loop { c = noise(c, c, c); }",
        "a loop that never ends",
    );
    says(
        "let i = 0; loop { state[\"k\" + i] = indices(1000000); i += 1; }",
        "take more than 256 MiB together",
    );
    says("loop { spawn(); }", "the scene has 10000 entities");
    says(
        "let s = sphere(1).segments(1024, 1024); loop { mesh(s); s.segments(1024, 1024); }",
        "triangles together",
    );
}

#[test]
fn nesting_that_strains_the_parser() {
    for (open, close) in [
        ("(", ")"),
        ("[", "]"),
        ("{", "}"),
        ("-(", ")"),
        ("#{a:", "}"),
    ] {
        let deep = 100_000;
        let text = format!("let x = {}1{};", open.repeat(deep), close.repeat(deep));
        says(&text, "the nesting is deeper than 64");
        refused(&open.repeat(deep));
    }
    let chain = format!("let x = 1{};", " + 1".repeat(200_000));
    says(&chain, "the nesting is deeper than 64");
    refused(&format!("let x = {}true;", "!".repeat(100_000)));
    refused(&format!("let x = a{};", ".b".repeat(100_000)));
    refused(&"if true { 1 } else ".repeat(20_000));
}

#[test]
fn large_and_odd_files() {
    says(
        &"// filling\n".repeat(1_000_000),
        "a script may have 1024 KiB",
    );
    says("let x = 1;\n\0let y = 2;", "zero byte");
    run(&"\n".repeat(200_000)).unwrap();
    run("").unwrap();
    run("// only a comment").unwrap();
    run("\u{feff}let x = 1;\r\nlet y = 2;\r\n").unwrap();
    let problem = refused("let x = 1;\r\nlet y = z;\r\n");
    assert_eq!((problem.place.line, problem.place.column), (2, 9));
    assert_eq!(problem.source_line.as_deref(), Some("let y = z;"));
    refused("\"");
    refused("`");
    refused("let \u{202e}x = 1;");
    run("let text = \"práctica ñ 🎈\"; print(text);").unwrap();
}

#[test]
fn imports_stay_in_the_project() {
    for path in [
        "../../../etc/passwd",
        "/etc/passwd",
        "C:/windows/x",
        "..\\\\..\\\\x",
        "parts/../../../../x",
        "",
        ".",
        "@0/x",
        "a\\nb",
    ] {
        let problem = refused(&format!("import \"{path}\" as x;"));
        assert_eq!(problem.place.line, 1, "{problem}");
        assert!(problem.message.contains("import"), "{problem}");
    }
    let problem = refused("let a = 1;\nimport \"parts/nothing\" as x;");
    assert_eq!(problem.place.line, 2);
    assert_eq!(
        problem.message,
        "there is no script `parts/nothing` to import"
    );
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out() {
    let outside = tempfile::tempdir().unwrap();
    std::fs::write(outside.path().join("secret.rhai"), "export const X = 1;").unwrap();
    let (folder, store) = project(&[(
        "scripts/scenes/test.rhai",
        "import \"secret\" as s;\nprint(s::X);",
    )]);
    std::os::unix::fs::symlink(
        outside.path().join("secret.rhai"),
        folder.path().join("scripts/secret.rhai"),
    )
    .unwrap();
    let error = load_scene(&store, "test", &Settings::new(), &Progress::new()).unwrap_err();
    assert!(error.to_string().contains("outside the project"), "{error}");
}

#[test]
fn imports_in_a_circle() {
    let error = run_files(&[
        ("scripts/scenes/test.rhai", "import \"parts/a\" as a;"),
        ("scripts/scenes/parts/a.rhai", "import \"parts/b\" as b;"),
        ("scripts/parts/b.rhai", "\nimport \"scenes/parts/a\" as a;"),
    ])
    .unwrap_err();
    let problem = &error.0[0];
    assert_eq!(
        problem.place.to_string().split(':').next(),
        Some("scripts/parts/b.rhai")
    );
    assert_eq!(problem.place.line, 2);
    assert_eq!(
        problem.message,
        "the imports go round in a circle: scripts/scenes/parts/a.rhai imports \
         scripts/parts/b.rhai imports scripts/scenes/parts/a.rhai"
    );
    let error = run("import \"test\" as me;").unwrap_err();
    assert!(error.0[0].message.contains("circle"), "{error}");
}

#[test]
fn too_many_imports() {
    let mut files = vec![(
        "scripts/scenes/test.rhai".to_owned(),
        "import \"m0\" as m;".to_owned(),
    )];
    for i in 0..100 {
        files.push((
            format!("scripts/scenes/m{i}.rhai"),
            format!("import \"m{}\" as m;", i + 1),
        ));
    }
    let files: Vec<(&str, &str)> = files
        .iter()
        .map(|(a, b)| (a.as_str(), b.as_str()))
        .collect();
    let error = run_files(&files).unwrap_err();
    assert!(
        error.0[0].message.contains("imports more than 64 files"),
        "{error}"
    );
}

#[test]
fn mistakes_in_imported_files_name_them() {
    let import = "import \"parts/p\" as p;\np::build(1);";
    for (part, line, message) in [
        (
            "fn build(x) {\n    nothing(x);\n}",
            2,
            "there is no function `nothing`",
        ),
        (
            "fn build(x) {\n    x +\n}",
            3,
            "a value is missing in front of `}`",
        ),
        ("fn build(x) { y }", 1, "there is no variable `y`"),
        ("\n\nthrow \"no\";", 3, "no"),
        ("fn build(x) {\n  spawn().at(x);\n}", 2, "must be a vec3"),
    ] {
        let error = run_files(&[
            ("scripts/scenes/test.rhai", import),
            ("scripts/scenes/parts/p.rhai", part),
        ])
        .unwrap_err();
        let problem = &error.0[0];
        assert_eq!(
            &*problem.place.file, "scripts/scenes/parts/p.rhai",
            "{problem}"
        );
        assert_eq!(problem.place.line, line, "{problem}");
        assert!(problem.message.contains(message), "{problem}");
        assert!(problem.source_line.is_some());
    }
}

#[test]
fn project_paths_may_have_any_letters() {
    let folder = tempfile::tempdir().unwrap();
    let home = folder.path().join("práctica 1 ñ");
    std::fs::create_dir_all(home.join("scripts/scenes/日本")).unwrap();
    std::fs::write(
        home.join("scripts/scenes/été.rhai"),
        "import \"日本/парк\" as park;\npark::build();\r\n",
    )
    .unwrap();
    std::fs::write(
        home.join("scripts/scenes/日本/парк.rhai"),
        "fn build() { spawn(\"ñ\"); }",
    )
    .unwrap();
    let store = lightbench_assets::files::Files::with_project(&home).unwrap();
    let scene = match load_scene(&store, "été", &Settings::new(), &Progress::new()) {
        Ok(scene) => scene,
        Err(problems) => panic!("{problems}"),
    };
    assert!(scene.world.find("ñ").is_some());
    assert_eq!(
        scene.files(),
        ["scripts/scenes/été.rhai", "scripts/scenes/日本/парк.rhai"]
    );
}

#[test]
fn a_cancelled_load_ends() {
    let (_folder, store) = project(&[("scripts/scenes/test.rhai", "loop { }")]);
    let progress = Progress::new();
    std::thread::scope(|scope| {
        let work = scope.spawn(|| load_scene(&store, "test", &Settings::new(), &progress));
        std::thread::sleep(Duration::from_millis(50));
        progress.cancel();
        let error = work.join().unwrap().unwrap_err();
        assert!(
            error.to_string().contains("the script was stopped"),
            "{error}"
        );
    });
}

#[test]
fn an_endless_update_ends() {
    let (_folder, store) = project(&[(
        "scripts/scenes/test.rhai",
        "fn update(time, dt) {\n    loop { }\n}",
    )]);
    let limits = Limits {
        update_time: Duration::from_millis(100),
        ..Limits::default()
    };
    let mut scene = load_scene_within(
        &store,
        "test",
        &Settings::new(),
        &Progress::new(),
        &Cache::default(),
        &limits,
    )
    .unwrap();
    let problem = scene.update(0.0, 0.1).unwrap_err();
    assert_eq!(problem.place.to_string(), "scripts/scenes/test.rhai:1:4");
    assert!(problem.message.contains("a loop that never ends"));
}

#[test]
fn pipelines_are_held_to_the_same_limits() {
    let (_folder, store) = project(&[("scripts/pipelines/test.rhai", "fn f() { f() }\nf();")]);
    let error = load_pipeline(&store, "test", &Settings::new()).unwrap_err();
    assert!(error.to_string().contains("call each other"), "{error}");
}

#[test]
fn there_is_no_way_to_files_or_time() {
    for call in [
        "open(\"x\")",
        "timestamp()",
        "sleep(1)",
        "eval(\"1\")",
        "system(\"ls\")",
    ] {
        refused(&format!("let x = {call};"));
    }
}
