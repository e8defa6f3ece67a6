//! The whole program in a window under a virtual display, with a real pointer and real keys: start,
//! choose, move, swap pipelines, edit a shader on disk, undo, save, close, open again.
//!
//! What the program does is seen in the pixels of the screen and in the files that it writes.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

#[path = "real_window/screen.rs"]
mod screen;

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use screen::{Blot, Key, Screen};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(60);

const MAGENTA: [u8; 3] = [255, 0, 255];
const GREEN: [u8; 3] = [0, 255, 0];
const BLUE: [u8; 3] = [0, 0, 255];

const SCENE: &str = r#"// One ball, seen from the front.
spawn("ball").mesh(sphere(0.6)).material(material("plain").color(1, 1, 1)).at(0, 1, 0);
camera("eye").at(0, 1, 6).look_at(0, 1, 0).fov(45);
"#;

/// A pipeline that draws all things in one colour.
fn pipeline(title: &str, shader: &str) -> String {
    format!(
        r#"// Draws all things in one colour.
let p = pipeline("{title}");
p.target("depth", "depth32float");
p.target("output", "rgba8unorm");
p.geometry("draw").shader("{shader}")
    .writes("output").clear(0, 0, 0, 1)
    .depth("depth").clear(0.0);
p.show("output");
p
"#
    )
}

fn shader(color: [u8; 3]) -> String {
    let [red, green, blue] = color.map(|part| f32::from(part) / 255.0);
    format!(
        "@fragment\nfn fragment_main() -> @location(0) vec4f {{\n    return vec4f({red:?}, {green:?}, {blue:?}, 1.0);\n}}\n"
    )
}

fn write(root: &Path, path: &str, text: &str) {
    let path = root.join(path);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

/// The program, which is ended with the test.
struct Program(Child);

impl Program {
    fn start(screen: &Screen, root: &Path, scene: &str) -> Self {
        let child = Command::new(env!("CARGO_BIN_EXE_lightbench"))
            .args(["--project", ".", "edit", scene, "--pipeline", "a_first"])
            .current_dir(root.join("project"))
            .env("DISPLAY", screen.name())
            .env("XDG_CONFIG_HOME", root.join("settings"))
            .env("XDG_CACHE_HOME", root.join("caches"))
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("DBUS_SESSION_BUS_ADDRESS")
            .env_remove("XDG_RUNTIME_DIR")
            .stderr(Stdio::inherit())
            .spawn()
            .unwrap();
        Self(child)
    }

    /// Waits until it has ended by itself.
    fn ended(mut self) {
        let began = Instant::now();
        loop {
            if let Some(status) = self.0.try_wait().unwrap() {
                assert!(status.success(), "{status}");
                return;
            }
            assert!(began.elapsed() < PATIENCE, "the program did not end");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // It has ended already where all went well.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Waits until the screen shows a blot of the colour that fits and stands still.
fn see(screen: &Screen, what: &str, color: [u8; 3], fits: impl Fn(&Blot) -> bool) -> Blot {
    let began = Instant::now();
    loop {
        let before = screen.blot(color);
        std::thread::sleep(Duration::from_millis(150));
        let blot = screen.blot(color).filter(|_| before == screen.blot(color));
        if let Some(blot) = blot
            && blot.count > 500
            && fits(&blot)
        {
            return blot;
        }
        if began.elapsed() > PATIENCE {
            let file = std::env::temp_dir().join("lightbench_real_window.png");
            screen.save(&file);
            panic!(
                "waited in vain for {what}, {blot:?}; the screen is in {}",
                file.display()
            );
        }
    }
}

/// Handles lie over the ball, and the pointer over them changes their colours.
fn is_near(a: &Blot, b: &Blot) -> bool {
    (a.x - b.x).abs() < 3.0 && (a.y - b.y).abs() < 3.0
}

#[test]
fn a_person_can_work_in_the_window() {
    let screen = Screen::open(1440, 900);
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let project = root.join("project");
    write(&project, "scripts/scenes/ball.rhai", SCENE);
    for (name, color) in [("a_first", MAGENTA), ("a_second", GREEN)] {
        let file = format!("shaders/{name}.wgsl");
        write(&project, &file, &shader(color));
        let text = pipeline(name, &file);
        write(&project, &format!("scripts/pipelines/{name}.rhai"), &text);
    }
    // Not the first start, whose welcome lies over the picture.
    write(root, "settings/lightbench/editor.json", "{}");

    // Start.
    let began = Instant::now();
    let program = Program::start(&screen, root, "ball");
    let first = see(&screen, "the ball", MAGENTA, |_| true);
    println!(
        "start to first picture: {:.2} s",
        began.elapsed().as_secs_f64()
    );
    screen.focus("Lightbench");

    // Choose it, and drag the middle of its handles to the right.
    screen.key(Key::Letter('m'), &[]);
    screen.click(first.x, first.y);
    see(&screen, "handles over the ball", MAGENTA, |blot| {
        blot.count + 20 < first.count
    });
    screen.drag((first.x, first.y), (first.x + 100.0, first.y));
    let moved = see(&screen, "the ball at its right", MAGENTA, |blot| {
        // As far as the pointer.
        (blot.x - first.x - 100.0).abs() < 3.0
    });

    // Number keys swap pipelines; the ball stays where it is.
    screen.key(Key::Letter('2'), &[]);
    see(&screen, "the second pipeline", GREEN, |blot| {
        is_near(blot, &moved)
    });
    screen.key(Key::Letter('1'), &[]);
    see(&screen, "the first pipeline", MAGENTA, |blot| {
        is_near(blot, &moved)
    });

    // A shader that is saved by another program changes the picture.
    write(&project, "shaders/a_first.wgsl", &shader(BLUE));
    let moved = see(&screen, "the new shader", BLUE, |blot| {
        is_near(blot, &moved)
    });

    // Undo both swaps and the move, and do them again.
    for _ in 0..3 {
        screen.key(Key::Letter('z'), &[Key::Control]);
        std::thread::sleep(Duration::from_millis(300));
    }
    see(&screen, "the ball in its place", BLUE, |blot| {
        is_near(blot, &first)
    });
    for _ in 0..3 {
        screen.key(Key::Letter('z'), &[Key::Control, Key::Shift]);
        std::thread::sleep(Duration::from_millis(300));
    }
    let moved = see(&screen, "the ball moved again", BLUE, |blot| {
        is_near(blot, &moved)
    });

    // Without the handles, which are no part of the scene.
    screen.key(Key::Escape, &[]);
    let moved = see(&screen, "the ball alone", BLUE, |blot| {
        blot.count > moved.count + 20
    });

    // Save, and close.
    screen.key(Key::Letter('s'), &[Key::Control, Key::Shift]);
    std::thread::sleep(Duration::from_millis(500));
    screen.key(Key::Letter('a'), &[Key::Control]);
    screen.type_text("moved");
    screen.key(Key::Return, &[]);
    let saved = project.join("scripts/scenes/moved.scene");
    let began = Instant::now();
    while !saved.is_file() {
        if began.elapsed() > PATIENCE {
            let file = std::env::temp_dir().join("lightbench_real_window.png");
            screen.save(&file);
            panic!("nothing was saved; the screen is in {}", file.display());
        }
        std::thread::sleep(Duration::from_millis(30));
    }
    let text = fs::read_to_string(&saved).unwrap();
    assert!(text.contains("ball"), "{text}");
    std::thread::sleep(Duration::from_millis(300));
    screen.key(Key::Letter('q'), &[Key::Control]);
    program.ended();

    // The same scene again.
    let again = Program::start(&screen, root, "scripts/scenes/moved.scene");
    see(&screen, "the saved scene", BLUE, |blot| *blot == moved);
    screen.focus("Lightbench");
    screen.key(Key::Letter('q'), &[Key::Control]);
    again.ended();
}
