//! Everything of the world by name, many entities at once, and columns.
#![allow(clippy::unwrap_used)]

mod columns;
mod fields;
mod selections;

use super::*;
use crate::settings::Settings;
use crate::testing::project;

fn load(text: &str) -> Result<Scene, Problems> {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
    load_scene(&files, "test", &Settings::new(), &Progress::new())
}

#[track_caller]
fn good(text: &str) -> Scene {
    match load(text) {
        Ok(scene) => scene,
        Err(problems) => panic!("{problems}"),
    }
}

/// What a script prints.
#[track_caller]
fn prints(text: &str, expected: &[&str]) {
    let log = good(text).take_log();
    let log: Vec<&str> = log.iter().map(|line| line.text.as_str()).collect();
    assert_eq!(log, expected, "{text}");
}

/// The message and the hint of a script's first mistake.
#[track_caller]
fn refused(text: &str, message: &str, hint: Option<&str>) {
    let problems = load(text).expect_err(text);
    assert_eq!(problems.0[0].message, message, "{text}");
    assert_eq!(problems.0[0].hint.as_deref(), hint, "{text}");
}
