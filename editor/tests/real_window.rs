//! The whole program in a window under a virtual display, with a real pointer and real keys: start,
//! choose, move, swap pipelines, edit a shader on disk, undo, save, close, open again; and killed while
//! somebody works.
//!
//! What the program does is seen in the pixels of the screen and in the files that it writes.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

#[path = "real_window/killed.rs"]
mod killed;
#[path = "real_window/program.rs"]
mod program;
#[path = "real_window/screen.rs"]
mod screen;

use std::time::{Duration, Instant};

use program::{
    BLUE, GREEN, MAGENTA, Program, alone, choose, save_as, see, shader, write, write_project,
};
use screen::{Blot, Key, Screen};

/// Handles lie over the ball, and the pointer over them changes their colours.
fn is_near(a: &Blot, b: &Blot) -> bool {
    (a.x - b.x).abs() < 3.0 && (a.y - b.y).abs() < 3.0
}

#[test]
fn a_person_can_work_in_the_window() {
    let _alone = alone();
    let screen = Screen::open(1440, 900);
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let project = root.join("project");
    write_project(root);

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
    choose(&screen, &first, MAGENTA);
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
    let text = save_as(&screen, root, "moved");
    assert!(text.contains("ball"), "{text}");
    // Where the machine has much to do, the picture was coarse until now.
    let moved = see(&screen, "the ball once it is saved", BLUE, |blot| {
        is_near(blot, &moved)
    });
    screen.key(Key::Letter('q'), &[Key::Control]);
    program.ended();

    // The same scene again.
    let again = Program::start(&screen, root, "scripts/scenes/moved.scene");
    see(&screen, "the saved scene", BLUE, |blot| *blot == moved);
    screen.focus("Lightbench");
    screen.key(Key::Letter('q'), &[Key::Control]);
    again.ended();
}
