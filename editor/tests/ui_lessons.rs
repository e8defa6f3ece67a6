//! Lessons in the window: they are begun, read, worked on and checked there.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::fs;
use std::path::{Path, PathBuf};

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::lab::lesson::{Language, Outcome, find_lesson, lesson_of, read_answers};
use lightbench_editor::ui::actions::Action;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::lesson::Page;
use tempfile::TempDir;

use ui_support::{Bench, CTRL};

const FORMULAS: &str = "shaders/lib/by_hand.wgsl";

/// The lesson's folder in the repository, with what students do not get.
fn lesson() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../lessons/01-first-light")
}

/// Puts the solution into a student's project.
fn solve(project: &Path) {
    for path in ["scripts/scenes/first_light.rhai", FORMULAS] {
        let text = fs::read_to_string(lesson().join("solution").join(path)).unwrap();
        fs::write(project.join(path), text).unwrap();
    }
}

/// Clicks the first widget of a role with that name, after scrolling to it.
fn click(bench: &mut Bench, role: Role, label: &str) {
    let first = |bench: &Bench, act: fn(&egui_kittest::Node)| {
        let mut all = bench.harness.query_all_by_role_and_label(role, label);
        let node = all.next();
        act(&node.unwrap_or_else(|| panic!("nothing is called {label}")));
    };
    first(bench, |node| node.scroll_to_me());
    // A text that is far away glides for a while.
    bench.harness.run_steps(60);
    let link = bench
        .harness
        .query_all_by_role_and_label(role, label)
        .next();
    let rect = link.unwrap().rect();
    if role == Role::Link && rect.height() > 25.0 {
        // In two lines: between them is nothing, and the second one begins at the left.
        bench.click_at(rect.left_bottom() + egui::vec2(8.0, -8.0));
    } else {
        first(bench, |node| node.click());
    }
    bench.harness.run_steps(3);
}

/// Gives a text field another text.
fn fill(bench: &mut Bench, label: &str, text: &str) {
    bench
        .harness
        .get_by_role_and_label(Role::TextInput, label)
        .focus();
    bench.harness.run_steps(2);
    bench.key(CTRL, Key::A);
    bench.type_text(text);
}

/// The editor in a project that was begun from the first lesson.
fn begun(student: Option<&str>, kept: Option<PathBuf>) -> Bench {
    let folder = tempfile::tempdir().unwrap();
    let files = lightbench::assets::files::Files::shipped();
    let lesson = find_lesson(&files, "1").unwrap();
    lightbench::lab::lesson::begin(&lesson, student, Language::English, folder.path()).unwrap();
    Bench::open_project_of("first_light", folder, kept)
}

fn outcome(bench: &Bench) -> Outcome {
    let open = bench.harness.state().lessons.open.as_ref().unwrap();
    open.outcome.as_ref().unwrap().0.clone()
}

/// Presses Check and waits for what comes of it.
fn check(bench: &mut Bench) -> Outcome {
    bench.press("Check");
    assert!(bench.harness.state().lessons.checking.progress().is_some());
    bench.until("the check", |editor| {
        editor.lessons.checking.progress().is_none()
    });
    bench.harness.run_steps(3);
    assert_eq!(bench.harness.state().lessons.checking.why_not, None);
    outcome(bench)
}

#[test]
fn a_lesson_is_begun_checked_solved_and_checked_again() {
    let settings = TempDir::new().unwrap();
    let kept = settings.path().join("editor.json");
    let mut bench = Bench::open_with(Some(kept.clone()));
    bench.harness.state_mut().welcome = false;
    bench.key(CTRL, Key::P);
    bench.type_text("first light lesson");
    bench.key(Modifiers::NONE, Key::Enter);
    assert_eq!(bench.count("To work on this lesson, begin it"), 1);
    assert_eq!(
        bench
            .harness
            .query_all_by_role_and_label(Role::Button, "Check")
            .count(),
        0
    );

    // A folder with something in it is refused, and told.
    let place = TempDir::new().unwrap();
    fs::write(place.path().join("mine.txt"), "mine").unwrap();
    fill(&mut bench, "Folder", place.path().to_str().unwrap());
    bench.press("Begin this lesson");
    assert_eq!(bench.count("mine.txt"), 1);
    let project = place.path().join("first");
    fill(&mut bench, "Folder", project.to_str().unwrap());
    fill(&mut bench, "Student", "ana.perez");
    bench.press("Begin this lesson");
    let begun = lesson_of(&project).unwrap();
    assert_eq!(begun.id.as_deref(), Some("ana.perez"));
    let now = bench
        .harness
        .state()
        .workbench
        .files()
        .project()
        .unwrap()
        .to_owned();
    assert_eq!(now, project.canonicalize().unwrap());
    bench.until("the lesson's scene and pipeline", |editor| {
        editor.workbench.scenes.shown() == Some("first_light")
            && editor.workbench.pipelines.shown() == Some("by_hand")
    });
    assert_eq!(bench.count("To work on this lesson, begin it"), 0);

    let first = check(&mut bench);
    assert_eq!(
        (first.points, first.student.as_deref()),
        (0, Some("ana.perez"))
    );
    assert_eq!(bench.count(&format!("0 of {} points", first.of)), 1);
    let refusal = first.tasks[0].refusal.as_ref().unwrap();
    assert!(bench.count(&refusal.says.en) >= 1);

    // The solution has the numbers of who has no name.
    fs::remove_dir_all(&project).unwrap();
    fill_again(&mut bench, &project);
    solve(&project);
    bench.harness.run_steps(2);
    let second = check(&mut bench);
    let lesson = find_lesson(bench.harness.state().workbench.files(), "1").unwrap();
    let tasks: u32 = lesson.about.tasks.iter().map(|task| task.points()).sum();
    assert_eq!(second.points, tasks, "{}", second.to_json().unwrap());
    assert!(
        tasks > 10 && tasks < second.of,
        "the question has no answer yet"
    );
    assert_eq!(bench.count(&format!("{tasks} of {} points", second.of)), 1);

    // All is there again after a restart: the lesson, and what was found.
    drop(bench);
    let settings = fs::read_to_string(&kept).unwrap();
    assert!(settings.contains("01-first-light"), "{settings}");
}

/// Begins the lesson anew without a student's name, where a project is open already.
fn fill_again(bench: &mut Bench, folder: &Path) {
    let files = bench.harness.state().workbench.files().clone();
    let lesson = find_lesson(&files, "1").unwrap();
    lightbench::lab::lesson::begin(&lesson, None, Language::English, folder).unwrap();
}

#[test]
fn a_project_of_a_lesson_opens_it_and_keeps_what_was_found() {
    let mut bench = begun(None, None);
    assert!(bench.count("First light") > 0);
    solve(bench.path());
    // One factor is missing: the highlight is drawn without the light that arrives.
    let path = bench.path().join(FORMULAS);
    let right = fs::read_to_string(&path).unwrap();
    let wrong = right.replace(" / PI", "").replace("/ math::PI", "");
    assert_ne!(right, wrong);
    fs::write(&path, wrong).unwrap();
    let found = check(&mut bench);
    let matt = found.criterion("matt").unwrap().clone();
    assert_eq!(matt.points, 0);
    let finding = matt.findings.iter().find(|finding| !finding.holds).unwrap();
    assert_eq!(finding.pictures.len(), 3, "expected, yours, difference");
    // All is explained: the cause, the numbers, three pictures beside each other.
    let cause = &finding.cause.as_ref().unwrap().en;
    assert!(bench.count(cause) >= 1, "{cause}");
    assert!(bench.count(&finding.expected.en) >= 1);
    let pictures: Vec<egui::Rect> = finding
        .pictures
        .iter()
        .map(|(_, shows)| {
            let mut all = bench
                .harness
                .query_all_by_role_and_label(Role::Button, &shows.en);
            all.next().unwrap().rect()
        })
        .collect();
    assert!(
        pictures
            .iter()
            .all(|rect| rect.width() > 50.0 && rect.top() == pictures[0].top())
    );
    assert!(pictures[0].right() <= pictures[1].left() && pictures[1].right() <= pictures[2].left());

    // A click shows one large, and the place to read is gone to.
    let larger = |bench: &Bench| {
        bench
            .harness
            .query_by_role_and_label(Role::Button, "Close")
            .is_some()
    };
    click(&mut bench, Role::Button, &finding.pictures[1].1.en);
    assert!(larger(&bench));
    bench.press("Close");
    assert!(!larger(&bench));
    click(&mut bench, Role::Link, "Read: A matt surface");
    assert_eq!(bench.harness.state().lessons.page, Page::Text);
    // The text glides there.
    bench.harness.run_steps(8);
    let heading = bench
        .harness
        .get_by_role_and_label(Role::Label, "A matt surface")
        .rect();
    let panel = bench
        .harness
        .get_by_role_and_label(Role::Button, "Check")
        .rect();
    assert!(
        heading.top() > panel.bottom() && heading.top() < panel.bottom() + 120.0,
        "{heading}"
    );

    // In Spanish too.
    bench.press("Español");
    let heading = bench.harness.query_all_by_label("Primera luz").count();
    assert!(heading >= 1);
    bench.press("Tareas");
    assert!(bench.count(&finding.cause.as_ref().unwrap().es) >= 1);
    bench.press("English");

    // The outcome lies in the project, and a change of a file makes it old.
    assert_eq!(bench.count("Files have changed since this check."), 0);
    std::thread::sleep(std::time::Duration::from_millis(20));
    fs::write(&path, right).unwrap();
    bench.press("Tasks");
    assert_eq!(bench.count("Files have changed since this check."), 1);
    let project = bench.close();
    let mut bench = Bench::open_project_of("first_light", project, None);
    assert_eq!(outcome(&bench), found);
    bench.press("Tasks");
    assert!(bench.count(cause) >= 1);
}

#[test]
fn a_check_can_be_stopped() {
    let mut bench = begun(None, None);
    solve(bench.path());
    bench.press("Check");
    bench.until("the first task", |editor| {
        let progress = editor.lessons.checking.progress();
        progress.is_some_and(|(_, title)| !title.is_empty())
    });
    bench.press("Stop the check");
    bench.until("the end", |editor| {
        editor.lessons.checking.progress().is_none()
    });
    bench.harness.run_steps(2);
    let lessons = &bench.harness.state().lessons;
    assert!(lessons.open.as_ref().unwrap().outcome.is_none());
    assert_eq!(lessons.checking.why_not, None);
    let checked = bench.path().join("out/check");
    assert_eq!(fs::read_dir(checked).unwrap().count(), 0);
}

#[test]
fn links_open_files_at_their_places() {
    let mut bench = begun(None, None);
    let line = |path: &Path, words: &str| {
        let text = fs::read_to_string(path).unwrap();
        text.lines().position(|line| line.contains(words)).unwrap() + 1
    };
    click(&mut bench, Role::Link, "blinn_phong");
    let shown = bench.harness.state().code.shown().unwrap();
    assert_eq!(shown.path, FORMULAS);
    let at = line(&bench.path().join(FORMULAS), "TASK blinn_phong");
    assert_eq!(bench.count(&format!("line {at}, column 1")), 1);

    click(&mut bench, Role::Link, "distance_falloff");
    let shown = bench.harness.state().code.shown().unwrap();
    assert_eq!(shown.path, "shaders/lib/lighting.wgsl");
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders/lib/lighting.wgsl");
    let at = line(&shipped, "fn distance_falloff");
    assert_eq!(bench.count(&format!("line {at}, column 1")), 1);
}

#[test]
fn answers_are_typed_and_written() {
    let mut bench = begun(None, None);
    bench.save("reports/passes/report.json", "{}");
    bench.save("reports/other/report.json", "{}");
    bench.harness.state_mut().lessons.page = Page::Tasks;
    bench.until("the reports", |editor| {
        editor.lessons.open.as_ref().unwrap().reports.len() == 2
    });
    let scroll = bench
        .harness
        .get_by_role_and_label(Role::TextInput, "Answer");
    scroll.scroll_to_me();
    bench.harness.run_steps(4);
    fill(&mut bench, "Answer", "two");
    fill(&mut bench, "Report", "reports/passes/report.json");
    bench.press("Write the answer");
    assert_eq!(bench.count("`two` is no number"), 1);
    fill(&mut bench, "Answer", "2,75");
    bench.press("Write the answer");
    assert_eq!(bench.count("`two` is no number"), 0);
    let answers = read_answers(&bench.files).unwrap();
    assert_eq!(answers["passes"].value, 2.75);
    assert_eq!(answers["passes"].report, "reports/passes/report.json");

    // What is written there with another program comes in.
    let text = "[passes]\nvalue = 3.5\nreport = \"reports/other/report.json\"\n";
    bench.save("answers.toml", text);
    bench.until("the answer from outside", |editor| {
        let open = editor.lessons.open.as_ref().unwrap();
        open.typed["passes"].value == "3.5"
    });
}

#[test]
fn the_gallery_and_the_menu_open_lessons() {
    let mut bench = Bench::open();
    let ctx = bench.harness.ctx.clone();
    bench.harness.state_mut().perform(Action::Gallery, &ctx);
    bench.harness.run_steps(3);
    bench.press("Lessons");
    click(&mut bench, Role::Button, "Linear light");
    let name = |bench: &Bench| {
        let open = bench.harness.state().lessons.open.as_ref();
        open.map(|open| open.lesson.name.clone())
    };
    assert_eq!(name(&bench).as_deref(), Some("11-linear-light"));
    assert!(!bench.harness.state().gallery.is_open);
    bench.press("All lessons");
    assert_eq!(name(&bench), None);
    bench.harness.state_mut().perform(Action::CheckLesson, &ctx);
    bench.harness.run_steps(3);
    assert_eq!(bench.count("open a lesson and begin it first"), 1);
}

/// A letter that the fonts do not have would end the test.
#[test]
fn all_lessons_can_be_shown_in_both_languages() {
    let mut bench = Bench::open();
    bench.show(Panel::Lesson);
    let files = bench.files.clone();
    let lessons = lightbench::lab::lesson::list_lessons(&files).unwrap();
    assert!(lessons.len() >= 2);
    for name in lessons {
        for (_, language) in Language::ALL {
            for page in [Page::Text, Page::Tasks, Page::Parameters] {
                let editor = bench.harness.state_mut();
                editor.lessons.speak(language);
                editor.open_lesson(&name);
                editor.lessons.page = page;
                bench.harness.run_steps(2);
                let open = bench.harness.state().lessons.open.as_ref();
                let open = open.unwrap_or_else(|| panic!("{name} does not open"));
                let title = open.lesson.about.title.in_language(language).to_owned();
                assert!(bench.count(&title) >= 1, "{title}");
            }
        }
    }
}

#[test]
fn a_lesson_that_is_read_stays_open_over_restarts() {
    let settings = TempDir::new().unwrap();
    let kept = settings.path().join("editor.json");
    fs::write(&kept, "{}").unwrap();
    let mut bench = Bench::open_with(Some(kept.clone()));
    bench.show(Panel::Lesson);
    bench.press("Español");
    click(&mut bench, Role::Link, "11  Luz lineal");
    let open = |bench: &Bench| {
        let open = bench.harness.state().lessons.open.as_ref();
        open.map(|open| open.lesson.name.clone())
    };
    assert_eq!(open(&bench).as_deref(), Some("11-linear-light"));
    let project = bench.close();
    let mut bench = Bench::open_project(project, Some(kept.clone()));
    assert_eq!(open(&bench).as_deref(), Some("11-linear-light"));
    assert!(bench.count("Empezar esta lección") == 1);
    bench.press("Todas las lecciones");
    let project = bench.close();
    let bench = Bench::open_project(project, Some(kept));
    assert_eq!(open(&bench), None);
    let language = bench.harness.state().lessons.language;
    assert_eq!(language, Language::Spanish);
}
