//! What a student's folder may hold: every broken input ends in a clear line, never in a fault.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;

use cli_support::{Project, SCENE, run_in};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// A PNG of one colour.
fn png(width: u32, height: u32) -> Vec<u8> {
    let image = image::RgbaImage::from_pixel(width, height, image::Rgba([200, 30, 30, 255]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// CRC-32 as PNG chunks have it (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            crc >> 1 ^ (0xEDB8_8320 & 0_u32.wrapping_sub(crc & 1))
        })
    })
}

/// A PNG whose header claims 60,000 × 60,000 pixels, with a right checksum.
fn huge_png() -> Vec<u8> {
    let mut bytes = png(4, 4);
    for at in [16, 20] {
        bytes[at..at + 4].copy_from_slice(&60_000_u32.to_be_bytes());
    }
    let sum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&sum.to_be_bytes());
    bytes
}

#[test]
fn models_that_hold_nothing_are_refused_in_one_line() {
    let project = Project::new();
    let show = |model: &str| project.render("showroom", "x.png", &["--model", model]);
    project.write("empty.obj", "");
    project.write("blank.obj", "# nothing but a comment\n\n");
    let noise: Vec<u8> = (0..4096_u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
        .collect();
    project.write("binary.obj", noise);
    project.write("index.obj", format!("{TRIANGLE}f 1 2 9\n"));
    project.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    project.write("pair.obj", format!("{TRIANGLE}f 1 2\n"));
    fs::create_dir(project.file("folder.obj")).unwrap();
    for (model, parts) in [
        ("empty.obj", &["empty.obj"][..]),
        ("blank.obj", &["blank.obj"]),
        ("binary.obj", &["binary.obj"]),
        ("folder.obj", &["folder.obj", "folder"]),
        ("none.obj", &["none.obj"]),
        ("index.obj", &["index.obj, line 4"]),
        ("nan.obj", &["nan.obj, line 1"]),
        ("pair.obj", &["pair.obj", "no faces"]),
    ] {
        let outcome = show(model).failed(1, parts);
        assert!(outcome.stderr.lines().count() <= 6, "{}", outcome.all());
        assert!(!project.file("x.png").exists(), "{model}");
    }
}

#[test]
fn models_with_a_broken_part_are_drawn_with_one_warning() {
    let project = Project::new();
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let faces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    project.write("pair.obj", format!("{TRIANGLE}f 1 2\nf 1 2 3\n"));
    let outcome = project.render("showroom", "pair.png", &["--model", "pair.obj"]);
    assert_eq!(outcome.status, 0, "{}", outcome.all());
    let warning = outcome
        .stderr
        .lines()
        .find(|line| line.contains("pair.obj, line 4"));
    assert!(warning.is_some(), "{}", outcome.all());
    for (name, picture) in [
        ("zero", Vec::new()),
        ("cut", png(64, 64)[..60].to_vec()),
        ("huge", huge_png()),
    ] {
        project.write(&format!("{name}.png"), picture);
        project.write(
            &format!("{name}.mtl"),
            format!("newmtl m\nmap_Kd {name}.png\n"),
        );
        project.write(
            &format!("{name}.obj"),
            format!("mtllib {name}.mtl\n{quad}usemtl m\n{faces}"),
        );
        let (model, out) = (format!("{name}.obj"), format!("out-{name}.png"));
        let outcome = project.render("showroom", &out, &["--model", &model]);
        assert_eq!(outcome.status, 0, "{}", outcome.all());
        let picture = format!("{name}.png");
        let warnings = outcome
            .stderr
            .lines()
            .filter(|line| line.contains(&picture));
        assert_eq!(warnings.count(), 1, "{}", outcome.all());
        assert!(!outcome.stderr.contains("panicked"), "{}", outcome.all());
        assert!(project.file(&out).exists());
    }
}

#[test]
fn scripts_with_mistakes_name_their_line() {
    let project = Project::new();
    for (name, script, parts) in [
        (
            "syntax",
            "let a = 1;\nlet b = = 2;\n",
            &["syntax.rhai:2"][..],
        ),
        (
            "name",
            "let a = 1;\nspwan(\"x\");\n",
            &["name.rhai:2", "did you mean", "spawn"],
        ),
        (
            "endless",
            "let a = 1;\nloop { a += 1; }\n",
            &["endless.rhai", "never ends"],
        ),
        ("deep", "fn f(x) { f(x + 1) }\nf(0);\n", &["deep.rhai"]),
        (
            "grow",
            "let a = [];\nloop { a.push(\"x\" + a.len()); }\n",
            &["grow.rhai"],
        ),
        (
            "file",
            "load_obj(\"../../etc/passwd\");\n",
            &["file.rhai:1"],
        ),
    ] {
        project.write(&format!("scripts/scenes/{name}.rhai"), script);
        project.render(name, "x.png", &[]).failed(1, parts);
    }
    project.write("scripts/scenes/empty.rhai", "");
    project.render("empty", "empty.png", &[]);
    project.write("scripts/scenes/latin.rhai", b"// caf\xe9\nlet a = 1;\n");
    project
        .render("latin", "x.png", &[])
        .failed(1, &["latin.rhai", "UTF-8"]);
    let late = format!("{SCENE}\nfn broken() {{ nothing_there(); }}\n")
        .replace("entity(\"box\").at", "broken(); entity(\"box\").at");
    project.write("scripts/scenes/late.rhai", late);
    project.render("late", "first.png", &[]).succeeded();
    project
        .render("late", "x.png", &["--frame", "2"])
        .failed(1, &["late.rhai:", "nothing_there"]);
    assert!(!project.file("x.png").exists());
}

#[test]
fn shaders_and_pipelines_with_mistakes_name_their_line() {
    let project = Project::new();
    project.run(&["copy", "shaders/output.wgsl"]).succeeded();
    let output = fs::read_to_string(project.file("shaders/output.wgsl")).unwrap();
    let line = 1 + output
        .lines()
        .position(|line| line.contains("let exposed"))
        .unwrap();
    let wrong = output.replace("let exposed = radiance", "let exposed: u32 = radiance");
    assert_ne!(output, wrong);
    project.write("shaders/output.wgsl", &wrong);
    let place = format!("shaders/output.wgsl:{line}");
    project.render("tiny", "x.png", &[]).failed(1, &[&place]);
    project
        .run(&["check-pipeline", "deferred_shading"])
        .failed(1, &[&place]);
    project.write("shaders/output.wgsl", "");
    project
        .render("tiny", "x.png", &[])
        .failed(1, &["shaders/output.wgsl", "empty"]);
    project.write("shaders/output.wgsl", &output);
    project.render("tiny", "mended.png", &[]).succeeded();

    // A target that nobody wrote, and a shader that is not there: both are said, each with its line.
    let pipeline = "import \"parts/output\" as output;\n\
        let p = pipeline(\"Mine\");\n\
        p.target(\"depth\", \"depth32float\");\n\
        p.target(\"hdr\", \"rgba16float\");\n\
        p.target(\"ghost\", \"rgba8unorm\");\n\
        p.geometry(\"shade\").shader(\"shaders/forward/single_pass.wgsl\").draws(\"opaque\")\n\
            .writes(\"hdr\").clear(0, 0, 0, 0)\n\
            .depth(\"depth\").clear(0.0);\n\
        p.fullscreen(\"haunt\").shader(\"shaders/sky.wgsl\")\n\
            .reads(\"ghost\")\n\
            .reads(\"gost\")\n\
            .writes(\"hdr\");\n\
        output::add(p, \"hdr\");\n\
        p\n";
    project.write("scripts/pipelines/mine.rhai", pipeline);
    let outcome = project.run(&["check-pipeline", "mine"]).failed(
        1,
        &[
            "mine.rhai:10",
            "`ghost`",
            "mine.rhai:11",
            "did you mean `ghost`?",
        ],
    );
    assert_eq!(
        outcome.stderr.matches("error:").count(),
        2,
        "{}",
        outcome.all()
    );
    project
        .render("tiny", "x.png", &["--pipeline", "mine"])
        .failed(1, &["mine.rhai:10"]);
    let listed = project.run(&["list", "pipelines"]).succeeded();
    assert!(listed.stdout.contains("mine"), "{}", listed.all());
    assert!(!project.file("x.png").exists());

    project
        .run(&["check-pipeline", "scripts/pipelines/deferred_shading.rhai"])
        .succeeded();
    project
        .run(&["check-pipeline", "forward_single_pass", "--portable"])
        .succeeded();
}

#[test]
fn places_that_cant_be_written_are_named_before_the_work() {
    let project = Project::new();
    project.write("file", "x");
    // A file where a folder is needed fails for every user, root too.
    let outcome = project
        .render("tiny", "file/x.png", &[])
        .failed(1, &["file", "--out"]);
    assert!(!outcome.stderr.contains("tiny"), "{}", outcome.all());
    project
        .run(&["compare", "tiny", "--out", "file"])
        .failed(1, &["file", "--out"]);
    fs::create_dir(project.file("folder.png")).unwrap();
    project
        .render("tiny", "folder.png", &[])
        .failed(1, &["folder.png", "folder"]);
    project
        .render("tiny", "x.gif", &[])
        .failed(2, &["x.gif", ".png", ".exr"]);
    if cfg!(target_os = "linux") {
        project
            .render("tiny", "/proc/x.png", &[])
            .failed(1, &["/proc", "--out"]);
    }
}

#[test]
fn names_that_mean_nothing_are_answered_with_near_ones() {
    let project = Project::new();
    project
        .render("cornel_box", "x.png", &[])
        .failed(1, &["did you mean `cornell_box`?"]);
    project
        .render("xyzzy", "x.png", &[])
        .failed(1, &["no scene `xyzzy`", "cornell_box"]);
    project
        .render("none/there.rhai", "x.png", &[])
        .failed(1, &["none/there.rhai"]);
    project
        .render("tiny", "x.png", &["--pipeline", "foward_single_pass"])
        .failed(1, &["did you mean `forward_single_pass`?"]);
    let set = |text: &str| project.render("tiny", "x.png", &["--set", text]);
    set("ligth=3").failed(1, &["no parameter `ligth`", "did you mean `light`?"]);
    set("exposur=1").failed(1, &["no parameter `exposur`", "did you mean `exposure`?"]);
    set("pipeline.exposur=1").failed(1, &["did you mean `exposure`?"]);
    set("scene.exposure=1").failed(1, &["no parameter `exposure`"]);
    set("pipelin.exposure=1").failed(2, &["did you mean `pipeline`?"]);
    set("light").failed(2, &["NAME=VALUE"]);
    set("light=bright").failed(1, &["`light`", "from 0 to 100", "bright"]);
    set("exposure=11").failed(1, &["`exposure`", "from -10 to 10"]);
    set("tone_curve=aces").failed(1, &["`tone_curve`", "`hable`"]);
    let adapter = ["--adapter", "no such thing"];
    project
        .render("tiny", "x.png", &adapter)
        .failed(1, &["no such thing", "there is"]);
    project.run(&["rendr", "tiny"]).failed(2, &["render"]);
    assert!(!project.file("x.png").exists());
}

#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let project = Project::new();
    // A pipe whose reading end is closed before the program writes.
    let command = format!(
        "\"{}\" list files | true; \"{}\" --help | true",
        env!("CARGO_BIN_EXE_lightbench"),
        env!("CARGO_BIN_EXE_lightbench")
    );
    if cfg!(unix) {
        let shell = std::process::Command::new("sh")
            .args(["-c", &command])
            .current_dir(project.path())
            .output()
            .unwrap();
        assert_eq!(String::from_utf8_lossy(&shell.stderr), "");
    }
}

#[test]
fn a_machine_without_a_driver_is_told_the_way_out() {
    let project = Project::new();
    // Where the loader finds no manifest there is no Vulkan driver, and no OpenGL without EGL's.
    let none = [
        ("VK_DRIVER_FILES", "/nonexistent.json"),
        ("VK_ICD_FILENAMES", "/nonexistent.json"),
        ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json"),
        ("WGPU_BACKEND", "vulkan"),
    ];
    if cfg!(target_os = "linux") {
        let arguments = ["render", "tiny", "--size", "8x8", "--out", "x.png"];
        run_in(project.path(), &arguments, &none).failed(1, &["mesa-vulkan-drivers", "doctor"]);
        let doctor = run_in(project.path(), &["doctor"], &none).failed(1, &[]);
        for part in ["adapter   none", "apt-get install", "Without root"] {
            assert!(doctor.stdout.contains(part), "{}", doctor.all());
        }
        run_in(project.path(), &["list", "adapters"], &none).failed(1, &["mesa-vulkan-drivers"]);
    }
}

#[test]
fn limits_are_set_by_the_project_and_over_it_by_who_runs_it() {
    let project = Project::new();
    project.write(
        "scripts/scenes/crowd.rhai",
        "for i in 0..40 { spawn(); }\nfn update() { }\n",
    );
    let render = |more: &[&str]| project.render("crowd", "x.png", more);
    assert_eq!(render(&[]).status, 0);
    project.write("exam.toml", "[limits]\nentities = 10\n");
    let limited = ["--limits", "exam.toml"];
    let too_many = ["crowd.rhai:1:", "the scene has 10 entities"];
    render(&limited).failed(1, &too_many);
    // A student's own file does not loosen what the command line says.
    project.write("lightbench.toml", "[limits]\nentities = 1000\n");
    render(&limited).failed(1, &too_many);
    assert_eq!(render(&[]).status, 0);
    project.write("lightbench.toml", "[limits]\nentities = 20\n");
    render(&[]).failed(1, &["the scene has 20 entities"]);

    project.write("exam.toml", "[limits]\nloadseconds = 2\n");
    render(&limited).failed(1, &["exam.toml:2:1", "`loadseconds`"]);
    render(&["--limits", "none.toml"]).failed(1, &["none.toml"]);
}
