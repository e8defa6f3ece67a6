//! Two pipelines in one viewport: what is shown of both, and what is said of them.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Key, Modifiers, pos2};
use egui_kittest::kittest::Queryable as _;
use lightbench::render::readback::read_bytes;
use lightbench_editor::ui::workbench::comparing::Mode;

use ui_support::Bench;

fn press(bench: &mut Bench, modifiers: Modifiers, key: Key) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(2);
}

fn click(bench: &mut Bench, label: &str) {
    bench
        .harness
        .get_by_role_and_label(Role::Button, label)
        .click();
    bench.harness.run_steps(2);
}

/// What the viewport shows, once both pictures are those of the present state.
fn shown(bench: &mut Bench) -> Vec<u8> {
    bench.until("both pictures", |editor| {
        let workbench = &editor.workbench;
        let ready = workbench.comparing.side().is_some_and(|side| {
            let pipelines = &side.pipelines;
            pipelines.shown() == Some(pipelines.selected())
                && !pipelines.is_busy()
                && !pipelines.is_warming()
        });
        ready
            && workbench.picture_is_current()
            && !workbench.comparing.is_waiting()
            && !workbench.pipelines.is_busy()
            && workbench.comparing.pairs() > 0
    });
    bench.harness.run_steps(2);
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.shown_picture().unwrap();
    read_bytes(workbench.gpu(), &texture).unwrap()
}

/// Compares deferred shading with itself, two stops brighter. Gives both pictures.
fn brighter(bench: &mut Bench) -> (Vec<u8>, Vec<u8>) {
    let first = bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_pipeline_parameter("exposure", Some(2.0.into()));
    let second = bench.until_picture_is_not(&first);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_pipeline_parameter("exposure", None);
    assert_eq!(bench.until_picture_is_not(&second), first);

    press(bench, Modifiers::NONE, Key::C);
    assert!(bench.harness.state().workbench.comparing.is_on());
    click(bench, "Give B what A has");
    shown(bench);
    let before = bench.harness.state().workbench.comparing.pairs();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_other_parameter("exposure", Some(2.0.into()));
    bench.until("the brighter picture", |editor| {
        let comparing = &editor.workbench.comparing;
        comparing.pairs() > before && !comparing.is_waiting()
    });
    (first, second)
}

/// Pixels of a row of the picture.
fn columns(bench: &Bench) -> usize {
    bench.harness.state().workbench.drawn_size().unwrap().0 as usize
}

#[test]
fn the_split_shows_one_picture_at_each_side_of_the_line() {
    let mut bench = Bench::open();
    let (first, second) = brighter(&mut bench);
    assert_ne!(first, second);
    let width = columns(&bench);
    let half = shown(&mut bench);
    for (index, pixel) in half.chunks(4).enumerate() {
        let at = index * 4..index * 4 + 4;
        let x = index % width;
        let of = if (x as f32 + 0.5) < 0.5 * width as f32 {
            &first
        } else {
            &second
        };
        assert_eq!(pixel, &of[at], "the pixel {index}");
    }

    // Dragged to the edges of the picture.
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let rect = viewport.rect();
    let drag = |bench: &mut Bench, from: f32, to: f32| {
        let y = rect.center().y;
        bench.harness.hover_at(pos2(from, y));
        bench.harness.step();
        bench.harness.drag_at(pos2(from, y));
        bench.harness.step();
        bench.harness.hover_at(pos2((from + to) * 0.5, y));
        bench.harness.step();
        bench.harness.hover_at(pos2(to, y));
        bench.harness.step();
        bench.harness.drop_at(pos2(to, y));
        bench.harness.run_steps(2);
    };
    let view = bench.harness.state().workbench.camera.view();
    drag(&mut bench, rect.center().x, rect.left() - 20.0);
    assert_eq!(bench.harness.state().workbench.comparing.split, 0.0);
    assert_eq!(shown(&mut bench), second);
    drag(&mut bench, rect.left() + 1.0, rect.right() + 20.0);
    assert_eq!(bench.harness.state().workbench.comparing.split, 1.0);
    assert_eq!(shown(&mut bench), first);
    let now = bench.harness.state().workbench.camera.view();
    assert_eq!(now, view, "the line was dragged, not the camera");

    // By keys, too.
    press(&mut bench, Modifiers::SHIFT, Key::ArrowLeft);
    let split = bench.harness.state().workbench.comparing.split;
    assert!((split - 0.98).abs() < 1e-6);
    press(&mut bench, Modifiers::SHIFT, Key::ArrowRight);
    assert_eq!(bench.harness.state().workbench.comparing.split, 1.0);
    bench
        .harness
        .get_by_role_and_label(Role::Slider, "Split")
        .focus();
    bench.harness.run_steps(2);
    press(&mut bench, Modifiers::NONE, Key::ArrowLeft);
    let split = bench.harness.state().workbench.comparing.split;
    assert!((split - 0.99).abs() < 1e-6, "{split}");
    assert_eq!(
        bench.count("A: Deferred shading"),
        1,
        "in the table of costs"
    );
}

#[test]
fn flicker_shows_both_in_turn() {
    let mut bench = Bench::open();
    let (first, second) = brighter(&mut bench);
    press(&mut bench, Modifiers::NONE, Key::B);
    assert_eq!(
        bench.harness.state().workbench.comparing.mode,
        Mode::Flicker
    );
    assert_eq!(shown(&mut bench), second);
    press(&mut bench, Modifiers::NONE, Key::B);
    assert_eq!(shown(&mut bench), first);
    bench.harness.get_by_label("By itself").click();
    bench.harness.state_mut().workbench.comparing.flicker.rate = 3.0;
    let mut seen = Vec::new();
    for _ in 0..2 {
        let now = bench.harness.state().workbench.comparing.flicker.shows_b;
        bench.until("the other picture", |editor| {
            editor.workbench.comparing.flicker.shows_b != now
        });
        let workbench = &mut bench.harness.state_mut().workbench;
        let texture = workbench.shown_picture().unwrap();
        seen.push(read_bytes(workbench.gpu(), &texture).unwrap());
    }
    seen.sort();
    let mut both = [first, second];
    both.sort();
    assert_eq!(seen, both);
}

#[test]
fn the_difference_is_that_of_the_pixels_and_none_of_a_pipeline_with_itself() {
    let mut bench = Bench::open();
    press(&mut bench, Modifiers::NONE, Key::C);
    click(&mut bench, "Give B what A has");
    click(&mut bench, "Difference");
    let same = shown(&mut bench);
    assert!(same.chunks(4).all(|pixel| pixel == [0, 0, 0, 255]));
    press(&mut bench, Modifiers::NONE, Key::C);
    assert!(!bench.harness.state().workbench.comparing.is_on());

    let (first, second) = brighter(&mut bench);
    click(&mut bench, "Difference");
    for gain in [1_u16, 3] {
        bench.harness.state_mut().workbench.comparing.gain = f32::from(gain);
        let found = shown(&mut bench);
        let expected: Vec<u8> = first
            .iter()
            .zip(&second)
            .enumerate()
            .map(|(index, (a, b))| match index % 4 {
                3 => 255,
                _ => (gain * u16::from(a.abs_diff(*b))).min(255) as u8,
            })
            .collect();
        assert_eq!(found, expected, "with gain {gain}");
    }
    // False colours have no grey, and their least is the map's, not black.
    bench.harness.get_by_label("False colours").click();
    let mapped = shown(&mut bench);
    assert!(
        mapped
            .chunks(4)
            .all(|pixel| pixel[0] != pixel[1] || pixel[1] != pixel[2])
    );
}

#[test]
fn a_mistake_in_one_side_leaves_the_other() {
    let mut bench = Bench::open();
    let (first, second) = brighter(&mut bench);
    bench.harness.state_mut().workbench.comparing.split = 0.0;
    assert_eq!(shown(&mut bench), second);
    // A file of the project hides the shipped one, for both sides.
    bench.save("scripts/pipelines/broken.rhai", "pipeline(");
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.select_other("broken");
    bench.until("the mistake", |editor| {
        editor.workbench.problems().next().is_some()
    });
    bench.harness.run_steps(3);
    assert!(bench.count("broken.rhai") > 0, "it is over the picture");
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.shown_picture().unwrap();
    let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
    assert_eq!(bytes, second, "the last good picture of B stays");
    assert_eq!(bench.picture(), first, "A goes on");
    // What is chosen then works again, and nothing of the mistake is left.
    bench.choose("Pipeline B", "Forward, multi-pass");
    shown(&mut bench);
    assert!(!Bench::has_problems(bench.harness.state_mut()));
    let workbench = &bench.harness.state().workbench;
    let side = workbench.comparing.side().unwrap();
    assert_eq!(side.pipelines.shown(), Some("forward_multi_pass"));
}

#[test]
fn swapping_keeps_both_and_ending_gives_everything_back() {
    let mut bench = Bench::open();
    let (first, second) = brighter(&mut bench);
    press(&mut bench, Modifiers::SHIFT, Key::C);
    bench.harness.state_mut().workbench.comparing.split = 0.0;
    assert_eq!(shown(&mut bench), first);
    assert_eq!(bench.picture(), second, "A is what B was");
    let swaps = bench.harness.state().workbench.pipelines.swaps();
    press(&mut bench, Modifiers::SHIFT, Key::C);
    assert_eq!(shown(&mut bench), second);
    let workbench = &bench.harness.state().workbench;
    assert!(workbench.pipelines.swaps() <= swaps, "nothing was built");

    press(&mut bench, Modifiers::NONE, Key::C);
    bench.harness.run_steps(4);
    let pairs = bench.harness.state().workbench.comparing.pairs();
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.set_pipeline_parameter("exposure", Some(1.0.into()));
    let alone = bench.until_picture_is_not(&first);
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.shown_picture().unwrap();
    assert_eq!(read_bytes(workbench.gpu(), &texture).unwrap(), alone);
    assert_eq!(workbench.comparing.pairs(), pairs, "B is not drawn");
    let side = workbench.comparing.side().unwrap();
    let slot = side.pipelines.slot("deferred_shading").unwrap();
    assert!(slot.pipeline.as_ref().unwrap().targets().is_none());
}

#[test]
fn what_is_looked_into_is_the_first_side() {
    let mut bench = Bench::open();
    let (first, _) = brighter(&mut bench);
    bench.choose("Target", "output");
    bench.until("the target", |editor| {
        editor.workbench.inspected().is_some() && !editor.workbench.comparing.is_waiting()
    });
    bench.harness.run_steps(3);
    bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.inspected().unwrap();
    let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
    assert!(bytes == first, "the target is that of A");
    // So is a pixel, also where B is shown: the last value is what A has there.
    let viewport = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
    let at = viewport.rect().center() + egui::vec2(80.0, 40.0);
    bench.click_at(at);
    bench.until("the values", |editor| {
        !editor.workbench.probing.is_waiting() && !editor.workbench.probing.values.is_empty()
    });
    let probing = bench.harness.state().workbench.probing.clone();
    let (x, y) = probing.pixel.unwrap();
    let texel = &first[(y as usize * columns(&bench) + x as usize) * 4..][..3];
    let said = probing.values.last().unwrap().after.clone();
    let said: Vec<f32> = said.split(' ').map(|word| word.parse().unwrap()).collect();
    for (byte, value) in texel.iter().zip(&said) {
        assert!(
            (f32::from(*byte) - value * 255.0).abs() < 0.51,
            "{texel:?} and {said:?}"
        );
    }
}
