//! The program in a window, and a project for it whose things are of one colour.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::screen::{Blot, Key, Screen};

/// How long anything may take.
pub const PATIENCE: Duration = Duration::from_secs(60);

pub const MAGENTA: [u8; 3] = [255, 0, 255];
pub const GREEN: [u8; 3] = [0, 255, 0];
pub const BLUE: [u8; 3] = [0, 0, 255];

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

pub fn shader(color: [u8; 3]) -> String {
    let [red, green, blue] = color.map(|part| f32::from(part) / 255.0);
    format!(
        "@fragment\nfn fragment_main() -> @location(0) vec4f {{\n    return vec4f({red:?}, {green:?}, {blue:?}, 1.0);\n}}\n"
    )
}

pub fn write(root: &Path, path: &str, text: &str) {
    let path = root.join(path);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

/// Writes a project with a ball and two pipelines below a folder, and settings with which it is not the
/// first start, whose welcome lies over the picture.
pub fn write_project(root: &Path) {
    let project = root.join("project");
    write(&project, "scripts/scenes/ball.rhai", SCENE);
    for (name, color) in [("a_first", MAGENTA), ("a_second", GREEN)] {
        let file = format!("shaders/{name}.wgsl");
        write(&project, &file, &shader(color));
        let text = pipeline(name, &file);
        write(&project, &format!("scripts/pipelines/{name}.rhai"), &text);
    }
    write(root, "settings/lightbench/editor.json", "{}");
}

/// One test works in a window at a time: each has a display of its own, but what one person would see in
/// time comes late where two programs draw.
pub fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    // A test that failed leaves nothing to others.
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The program, which is ended with the test.
pub struct Program(Child);

impl Program {
    pub fn start(screen: &Screen, root: &Path, scene: &str) -> Self {
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

    /// Ends it with SIGKILL, of which a program learns nothing.
    pub fn kill(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }

    /// Waits until it has ended by itself.
    pub fn ended(mut self) {
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
pub fn see(screen: &Screen, what: &str, color: [u8; 3], fits: impl Fn(&Blot) -> bool) -> Blot {
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
            give_up(screen, &format!("{what}, {blot:?}"));
        }
    }
}

/// Clicks on a ball of that colour until handles lie over it. A click that a slow frame tears apart is held
/// for a long press, so that a person would click again.
pub fn choose(screen: &Screen, ball: &Blot, color: [u8; 3]) {
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        screen.click(ball.x, ball.y);
        let clicked = Instant::now();
        while clicked.elapsed() < Duration::from_secs(3) {
            std::thread::sleep(Duration::from_millis(50));
            if screen
                .blot(color)
                .is_some_and(|it| it.count + 20 < ball.count)
            {
                return;
            }
        }
    }
    give_up(screen, "handles over the ball");
}

/// Saves the scene under another name, and gives the text of the file.
pub fn save_as(screen: &Screen, root: &Path, name: &str) -> String {
    screen.key(Key::Letter('s'), &[Key::Control, Key::Shift]);
    std::thread::sleep(Duration::from_millis(500));
    screen.key(Key::Letter('a'), &[Key::Control]);
    screen.type_text(name);
    screen.key(Key::Return, &[]);
    let scenes = root.join("project/scripts/scenes");
    let saved = scenes.join(format!("{name}.scene"));
    let began = Instant::now();
    while !saved.is_file() {
        if began.elapsed() > PATIENCE {
            give_up(screen, "a file of the scene");
        }
        std::thread::sleep(Duration::from_millis(30));
    }
    fs::read_to_string(&saved).unwrap()
}

/// Fails, and keeps what is on the screen.
pub fn give_up(screen: &Screen, what: &str) -> ! {
    let file = std::env::temp_dir().join("lightbench_real_window.png");
    screen.save(&file);
    let file = file.display();
    panic!("waited in vain for {what}; the screen is in {file}");
}
