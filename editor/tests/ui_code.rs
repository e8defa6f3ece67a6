//! Scripts and shaders that are read, changed and saved in the window.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable as _;
use lightbench_editor::ui::actions::Action;
use lightbench_editor::ui::code::document::Outside;
use lightbench_editor::ui::layout::Panel;

use ui_support::{Bench, CTRL};

const SCENE: &str = "scripts/scenes/cornell_box.rhai";
const SHADER: &str = "shaders/output.wgsl";

/// Opens a file of the project through the list of files.
fn open(bench: &mut Bench, path: &str) {
    bench.show(Panel::Code);
    bench.press("Open file");
    bench.type_text(path);
    bench.key(Modifiers::NONE, Key::Enter);
    let shown = bench.harness.state().code.shown().unwrap();
    assert_eq!(shown.path, path);
}

fn text(bench: &Bench) -> String {
    bench.harness.state().code.shown().unwrap().text.clone()
}

/// Puts the caret at the end of the text and goes on typing there.
fn to_the_end(bench: &mut Bench) {
    bench.harness.get_by_role(Role::MultilineTextInput).focus();
    bench.harness.run_steps(3);
    bench.key(CTRL, Key::End);
}

fn save(bench: &mut Bench) {
    bench.key(CTRL, Key::S);
}

#[test]
fn a_script_that_is_typed_and_saved_changes_file_and_picture() {
    let mut bench = Bench::open();
    bench.key(CTRL, Key::E);
    let shipped = text(&bench);
    assert_eq!(bench.count("is part of the program"), 1);
    // It can be read and not be changed.
    to_the_end(&mut bench);
    bench.type_text("oops");
    assert_eq!(text(&bench), shipped);
    bench.press("Copy into the project to edit");
    assert_eq!(bench.count("is part of the program"), 0);
    let on_disk = bench.files.project().unwrap().join(SCENE);
    assert_eq!(std::fs::read_to_string(&on_disk).unwrap(), shipped);

    let first = bench.picture();
    to_the_end(&mut bench);
    let line = "point_light(\"extra\").at(2.7, 1, 1).intensity(60).range(20);";
    bench.key(Modifiers::NONE, Key::Enter);
    bench.type_text(line);
    assert_eq!(text(&bench), format!("{shipped}\n{line}"));
    assert_eq!(bench.count("• cornell_box.rhai"), 1);
    assert!(bench.picture() == first, "nothing is saved yet");
    assert_eq!(std::fs::read_to_string(&on_disk).unwrap(), shipped);
    save(&mut bench);
    assert_eq!(bench.count("• cornell_box.rhai"), 0);
    bench.until_picture_is_not(&first);
    assert_eq!(std::fs::read_to_string(&on_disk).unwrap(), text(&bench));
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    assert!(scene.world.find("extra").is_some());

    // What an outside editor saves is there at once, while nothing is unsaved here.
    std::fs::write(&on_disk, &shipped).unwrap();
    bench.until("the text from outside", |editor| {
        editor.code.shown().unwrap().text == shipped
    });
    bench.until("the first picture", |editor| {
        !editor.workbench.scenes.is_busy()
    });
    assert!(bench.picture() == first);
}

#[test]
fn a_wrong_line_shows_its_mistake_at_the_line_and_clicks_lead_there() {
    let mut bench = Bench::open();
    bench.own(SCENE);
    open(&mut bench, SCENE);
    let good = text(&bench);
    let line = good.lines().count() + 1;
    to_the_end(&mut bench);
    bench.type_text("let wrong = ;");
    save(&mut bench);
    bench.until("the mistake", |editor| Bench::has_problems(editor));
    bench.harness.run_steps(2);
    assert_eq!(bench.count(&format!("line {line}: ")), 1);

    // Lines above move the mark with the text.
    bench.key(CTRL, Key::Home);
    bench.key(Modifiers::NONE, Key::Enter);
    assert_eq!(bench.count(&format!("line {}: ", line + 1)), 1);
    bench.key(Modifiers::NONE, Key::Backspace);
    assert_eq!(text(&bench), format!("{good}let wrong = ;"));
    assert_eq!(bench.count(&format!("line {line}, column ")), 0);

    // The place over the picture, in the log and in the status bar leads to the line.
    let place = format!("{SCENE}:{line}:");
    let places = |bench: &Bench| -> Vec<Pos2> {
        let all = bench.harness.query_all_by_label_contains(&place);
        all.map(|node| node.rect().center()).collect()
    };
    assert_eq!(places(&bench).len(), 3);
    for at in places(&bench) {
        bench.key(CTRL, Key::Home);
        assert_eq!(bench.count("line 1, column 1"), 1, "before {at}");
        bench.click_at(at);
        bench.harness.run_steps(3);
        let column = format!("line {line}, column ");
        assert_eq!(bench.count(&column), 1, "after {at}");
    }

    // The caret is at the mistake: there the missing value is typed.
    bench.key(Modifiers::NONE, Key::End);
    bench.key(Modifiers::NONE, Key::ArrowLeft);
    bench.type_text("1");
    save(&mut bench);
    bench.until("the mended file", |editor| !Bench::has_problems(editor));
    bench.harness.run_steps(2);
    assert_eq!(text(&bench), format!("{good}let wrong = 1;"));
    assert_eq!(bench.count(&format!("line {line}: ")), 0);
}

#[test]
fn a_mistake_in_a_shader_opens_the_shader() {
    let mut bench = Bench::open();
    let (path, good) = bench.own(SHADER);
    let broken = good.replace("let exposed =", "let exposed: u32 =");
    let line = broken.lines().position(|l| l.contains(": u32 =")).unwrap() + 1;
    std::fs::write(&path, &broken).unwrap();
    bench.until("the mistake", |editor| Bench::has_problems(editor));
    bench.harness.run_steps(2);
    let place = format!("{SHADER}:{line}");
    // From each of the three places, also while the panel is hidden.
    for nth in 0..3 {
        let mut all = bench.harness.query_all_by_label_contains(&place);
        let at = all.nth(nth).unwrap().rect().center();
        drop(all);
        bench.click_at(at);
        bench.harness.run_steps(3);
        assert_eq!(bench.harness.state().code.shown().unwrap().path, SHADER);
        assert_eq!(bench.count(&format!("line {line}: ")), 1, "at {at}");
        assert_eq!(bench.count(&format!("line {line}, column ")), 1, "at {at}");
        let ctx = bench.harness.ctx.clone();
        let editor = bench.harness.state_mut();
        editor.perform(Action::Toggle(Panel::Code), &ctx);
        bench.harness.run_steps(3);
        assert_eq!(bench.count(&format!("line {line}: ")), 0);
    }
}

/// A scene outside the project is named by its path, and belongs to whoever opened it.
#[test]
fn a_script_outside_the_project_is_saved_where_it_is() {
    let mut bench = Bench::open();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("outside.rhai");
    let scene = "spawn(\"box\").mesh(box(1)); ambient_light(\"sky\");\n\
                 camera(\"eye\").at(0, 1, 4).look_at(0, 0, 0);";
    std::fs::write(&file, scene).unwrap();
    bench.key(CTRL, Key::O);
    bench.type_text(file.to_str().unwrap());
    bench.key(Modifiers::NONE, Key::Enter);
    bench.until("the scene", |editor| {
        editor.workbench.scenes.shown() == Some("@0/outside.rhai")
    });
    let first = bench.picture();
    bench.key(CTRL, Key::E);
    assert_eq!(text(&bench), scene);
    to_the_end(&mut bench);
    bench.type_text("\nspawn(\"more\").mesh(box(1)).at(1, 1, 0);");
    save(&mut bench);
    bench.until_picture_is_not(&first);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text(&bench));
}

#[test]
fn a_change_outside_while_there_is_unsaved_text_is_a_choice() {
    let mut bench = Bench::open();
    let (path, good) = bench.own(SHADER);
    open(&mut bench, SHADER);
    let theirs = format!("{good}// theirs\n");
    let conflict = |bench: &mut Bench| {
        to_the_end(bench);
        bench.type_text("// mine");
        std::fs::write(&path, &theirs).unwrap();
        bench.until("the conflict", |editor| {
            editor.code.shown().unwrap().outside == Some(Outside::Changed(theirs.clone()))
        });
        bench.harness.run_steps(2);
    };
    conflict(&mut bench);
    // Saving overwrites nothing.
    save(&mut bench);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), theirs);
    assert!(text(&bench).ends_with("// mine"));
    bench.press("See both");
    assert_eq!(bench.count("- // theirs"), 1);
    assert_eq!(bench.count("+ // mine"), 1);
    bench.press("Take theirs");
    assert_eq!(text(&bench), theirs);
    assert_eq!(bench.count("Nothing was overwritten"), 0);

    std::fs::write(&path, &good).unwrap();
    bench.until("the first text", |editor| {
        editor.code.shown().unwrap().text == good
    });
    conflict(&mut bench);
    bench.press("Keep mine");
    assert_eq!(
        std::fs::read_to_string(&path).unwrap(),
        theirs,
        "not saved yet"
    );
    save(&mut bench);
    let mine = format!("{good}// mine");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), mine);
    assert_eq!(text(&bench), mine);

    // A file that is gone is not written again by itself.
    std::fs::remove_file(&path).unwrap();
    bench.until("the shipped text", |editor| {
        editor.code.shown().unwrap().text == good
    });
    assert!(!path.exists());
}

#[test]
fn a_file_that_cannot_be_written_keeps_the_text_and_says_why() {
    let mut bench = Bench::open();
    let (path, good) = bench.own(SHADER);
    let mut permissions = std::fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).unwrap();
    open(&mut bench, SHADER);
    to_the_end(&mut bench);
    bench.type_text("// more");
    save(&mut bench);
    assert!(bench.count("is read-only; change its permissions") >= 1);
    assert_eq!(text(&bench), format!("{good}// more"));
    assert_eq!(bench.count("• output.wgsl"), 1);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), good);
}

#[test]
fn closing_a_file_or_the_window_with_unsaved_text_asks() {
    let mut bench = Bench::open();
    let (path, good) = bench.own(SHADER);
    open(&mut bench, SHADER);
    to_the_end(&mut bench);
    bench.type_text("// a");
    bench.press("Close output.wgsl");
    assert_eq!(bench.count("Save the text first?"), 1);
    bench.press("Go on editing");
    assert_eq!(text(&bench), format!("{good}// a"));

    bench.harness.state_mut().ask_to_quit();
    bench.harness.run_steps(3);
    assert!(!bench.harness.state().wants_to_quit());
    assert_eq!(bench.count("Save the text first?"), 1);
    bench.key(Modifiers::NONE, Key::Escape);
    assert_eq!(bench.count("Save the text first?"), 0);
    assert!(!bench.harness.state().wants_to_quit());

    bench.press("Close output.wgsl");
    bench.press("Save and close");
    assert!(bench.harness.state().code.shown().is_none());
    assert_eq!(
        std::fs::read_to_string(&path).unwrap(),
        format!("{good}// a")
    );

    open(&mut bench, SHADER);
    to_the_end(&mut bench);
    bench.type_text("// b");
    bench.harness.state_mut().ask_to_quit();
    bench.harness.run_steps(3);
    bench.press("Don't save");
    assert!(bench.harness.state().wants_to_quit());
    assert_eq!(
        std::fs::read_to_string(&path).unwrap(),
        format!("{good}// a")
    );
}

#[test]
fn words_are_found_and_lines_gone_to() {
    let mut bench = Bench::open();
    let lines: String = (1..=300).map(|n| format!("// line {n}\n")).collect();
    bench.save("scripts/scenes/long.rhai", &lines);
    open(&mut bench, "scripts/scenes/long.rhai");
    to_the_end(&mut bench);
    bench.key(CTRL, Key::G);
    bench.type_text("250");
    bench.key(Modifiers::NONE, Key::Enter);
    bench.harness.run_steps(2);
    assert_eq!(bench.count("line 250, column 1"), 1);
    bench.type_text("X");
    assert!(
        text(&bench).contains("\nX// line 250\n"),
        "the text has the keys"
    );

    bench.key(CTRL, Key::F);
    bench.type_text("LINE 29");
    // 29, and 290 to 299, of which the one behind the caret is the second.
    assert_eq!(bench.count("2 of 11"), 1);
    bench.press("Next");
    assert_eq!(bench.count("3 of 11"), 1);
    assert_eq!(bench.count("line 291, column 11"), 1);
    bench.press("Previous");
    bench.press("Previous");
    assert_eq!(bench.count("1 of 11"), 1);
    assert_eq!(bench.count("line 29, column 11"), 1);
    bench
        .harness
        .get_by_role_and_label(Role::CheckBox, "Case")
        .click();
    bench.harness.run_steps(3);
    assert_eq!(bench.count("not found"), 1);
}

#[test]
fn keys_indent_lines_and_can_be_taken_back() {
    let mut bench = Bench::open();
    bench.save("scripts/scenes/short.rhai", "if true {");
    open(&mut bench, "scripts/scenes/short.rhai");
    to_the_end(&mut bench);
    bench.key(Modifiers::NONE, Key::Enter);
    bench.type_text("let a = 1;");
    assert_eq!(text(&bench), "if true {\n    let a = 1;");
    bench.key(CTRL, Key::Slash);
    assert_eq!(text(&bench), "if true {\n    // let a = 1;");
    bench.key(Modifiers::SHIFT, Key::Tab);
    assert_eq!(text(&bench), "if true {\n// let a = 1;");
    for _ in 0..4 {
        if text(&bench) != "if true {\n    let a = 1;" {
            bench.key(CTRL, Key::Z);
        }
    }
    assert_eq!(text(&bench), "if true {\n    let a = 1;");
}

/// One frame with several events, as when somebody types faster than frames are drawn. Returns how
/// long it took, without the descriptions for screen readers, which hold every letter and which the
/// tests alone ask for.
fn frame(bench: &mut Bench, events: Vec<Event>) -> Duration {
    let ctx = bench.harness.ctx.clone();
    let input = egui::RawInput {
        events,
        focused: true,
        screen_rect: Some(ctx.content_rect()),
        ..Default::default()
    };
    ctx.disable_accesskit();
    let began = Instant::now();
    let editor = bench.harness.state_mut();
    let output = ctx.run_ui(input, |ui| editor.ui(ui));
    let took = began.elapsed();
    drop(output);
    took
}

fn pressed(modifiers: Modifiers, key: Key) -> Event {
    Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers,
    }
}

#[test]
fn what_is_typed_in_one_frame_is_taken_once_and_in_order() {
    let mut bench = Bench::open();
    let lines: String = (1..=300).map(|n| format!("// line {n}\n")).collect();
    bench.save("scripts/scenes/long.rhai", &lines);
    open(&mut bench, "scripts/scenes/long.rhai");
    let letters = |text: &str| Event::Text(text.to_owned());
    let enter = || pressed(Modifiers::NONE, Key::Enter);
    let rest = |bench: &mut Bench| (0..3).for_each(|_| _ = frame(bench, Vec::new()));
    frame(&mut bench, vec![pressed(CTRL, Key::G)]);
    rest(&mut bench);
    frame(&mut bench, vec![letters("25"), letters("0"), enter()]);
    rest(&mut bench);
    let is_same = text(&bench) == lines;
    assert!(is_same, "the line's number was for the bar alone");
    let block = vec![
        letters("if a {"),
        enter(),
        letters("b();"),
        enter(),
        pressed(Modifiers::NONE, Key::Tab),
        letters("c"),
    ];
    frame(&mut bench, block);
    let expected = lines.replace("// line 250\n", "if a {\n    b();\n        c// line 250\n");
    assert!(text(&bench) == expected, "{}", &text(&bench)[2800..3100]);
    frame(&mut bench, vec![letters("d"), pressed(CTRL, Key::S)]);
    let file = bench
        .files
        .project()
        .unwrap()
        .join("scripts/scenes/long.rhai");
    let saved = std::fs::read_to_string(file).unwrap();
    assert!(saved == text(&bench) && saved.contains("cd// line 250"));
}

/// A frame has 16 ms on a screen of 60 Hz. What the picture costs is apart: it does not change.
#[test]
fn typing_in_two_thousand_lines_is_quick() {
    let mut bench = Bench::open();
    let shipped = bench.files.read_text(SCENE).unwrap();
    let mut long = String::new();
    while long.lines().count() < 2000 {
        long.push_str(&shipped);
    }
    bench.save("scripts/scenes/long.rhai", &long);
    open(&mut bench, "scripts/scenes/long.rhai");
    to_the_end(&mut bench);
    bench.key(CTRL, Key::G);
    bench.type_text("1000");
    bench.key(Modifiers::NONE, Key::Enter);
    bench.harness.run_steps(5);
    let mut took = Vec::new();
    for round in 0..24 {
        let letter = char::from(b'a' + round % 26).to_string();
        took.push(frame(&mut bench, vec![Event::Text(letter)]));
    }
    assert!(text(&bench).contains("abcdefghijklmnopqrstuvwx"));
    took.sort();
    let median = took[took.len() / 2];
    eprintln!(
        "a letter takes {median:?} with all panels; the longest {:?}",
        took.last()
    );
    assert!(median < Duration::from_millis(16), "{took:?}");
}
