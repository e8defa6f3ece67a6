//! Running the program as a user does, from a folder of its own.
#![allow(clippy::unwrap_used, dead_code)] // Each test file uses a part of this.

pub mod studies;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A small scene: a lit floor that a box moves over, with a parameter.
pub const SCENE: &str = r#"
const LIGHT = param("light", 4.0, 0, 100, "Strength of the lamp");
const SHIFT = param("shift", 0.0, -2, 2, "Where the box stands");
let paint = material("paint").color(0.8, 0.5, 0.3).specular(0.04).power(40);
spawn("floor").mesh(plane(6, 6)).material(paint);
spawn("box").mesh(sphere(0.6)).material(paint).at(SHIFT, 0.6, 0);
point_light("lamp").at(1, 2.5, 2).color(1, 0.9, 0.8).intensity(LIGHT).range(8);
ambient_light("sky").color(0.4, 0.5, 0.7).intensity(0.2);
camera("main").at(0, 2, 5).look_at(0, 0.5, 0).fov(50);
fn update(time, dt) {
    entity("box").at(SHIFT + time, 0.6, 0);
}
"#;

/// What the program did.
pub struct Outcome {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Outcome {
    /// Both streams, for messages.
    pub fn all(&self) -> String {
        format!(
            "status {}\n--- stdout\n{}--- stderr\n{}",
            self.status, self.stdout, self.stderr
        )
    }

    /// It went well and had nothing to complain of.
    pub fn succeeded(self) -> Self {
        assert!(self.status == 0, "{}", self.all());
        assert!(!self.stderr.contains("error"), "{}", self.all());
        self
    }

    /// It failed with that status, in words that hold all of `parts`, and without a fault.
    pub fn failed(self, status: i32, parts: &[&str]) -> Self {
        assert_eq!(self.status, status, "{}", self.all());
        for part in parts {
            assert!(
                self.stderr.contains(part),
                "no `{part}` in:\n{}",
                self.all()
            );
        }
        for fault in ["panicked", "fault of the program", "RUST_BACKTRACE"] {
            assert!(!self.stderr.contains(fault), "{}", self.all());
        }
        self
    }
}

/// A project with the small scene, in a folder whose name is not plain ASCII.
pub struct Project {
    folder: TempDir,
}

impl Project {
    pub fn new() -> Self {
        let folder = tempfile::Builder::new()
            .prefix("práctica 1 ñ ")
            .tempdir()
            .unwrap();
        let project = Self { folder };
        project.write("lightbench.toml", "");
        project.write("scripts/scenes/tiny.rhai", SCENE);
        project
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn file(&self, path: &str) -> PathBuf {
        self.path().join(path)
    }

    pub fn write(&self, path: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let file = self.file(path);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(&file, content).unwrap();
        file
    }

    /// Runs the program in the project's folder.
    pub fn run(&self, arguments: &[&str]) -> Outcome {
        run_in(self.path(), arguments, &[])
    }

    /// Renders 64 × 36 pixels to `out`, with more arguments.
    pub fn render(&self, scene: &str, out: &str, more: &[&str]) -> Outcome {
        let mut arguments = vec!["render", scene, "--size", "64x36", "--out", out];
        arguments.extend(more);
        self.run(&arguments)
    }
}

/// Runs the program in a folder, with more of an environment.
pub fn run_in(folder: &Path, arguments: &[&str], environment: &[(&str, &str)]) -> Outcome {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lightbench"));
    command
        .current_dir(folder)
        .args(arguments)
        .stdin(Stdio::null());
    command.env_remove("LIGHTBENCH_LOG");
    for (name, value) in environment {
        command.env(name, value);
    }
    let started = Instant::now();
    let output = command.output().unwrap();
    // Nothing that these tests do may hang, whatever the input.
    assert!(
        started.elapsed() < Duration::from_secs(60),
        "{arguments:?} took too long"
    );
    Outcome {
        status: output.status.code().unwrap_or(-1),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}
