//! Numbers of parameters are told exactly, and menus fit into small windows and open by keys.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use lightbench_editor::ui::actions::{Action, entries};
use lightbench_editor::ui::layout::Panel;

use ui_support::Bench;

/// Parameters with more digits than sliders would show.
const NUMBERS: &str = r#"
let far = param("far", 0.12345, 0, 1);
let fine = param("fine", 0.1000003, 0, 10);
spawn("box").mesh(box(1)).at(far, fine, 0);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

fn open(script: &str) -> Bench {
    let mut bench = Bench::open();
    bench.save("scripts/scenes/numbers.rhai", script);
    bench.harness.state_mut().workbench.select_scene("numbers");
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        let scenes = &editor.workbench.scenes;
        scenes.shown() == Some("numbers") && !scenes.is_busy()
    });
    // A file that was just written is told of once more.
    for _ in 0..40 {
        bench.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    bench.until("the scene", |editor| !editor.workbench.scenes.is_busy());
    bench.show(Panel::Scene);
    bench
}

fn place(bench: &Bench) -> [f32; 3] {
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let thing = scene.world.find("box").unwrap();
    let transform = scene.world.get::<lightbench::world::Transform>(thing);
    transform.unwrap().translation.to_array()
}

fn changed(bench: &Bench) -> usize {
    let settings = bench.harness.state().workbench.scenes.settings();
    settings.map_or(0, |settings| settings.iter().count())
}

/// Where a number stands, as it is shown; nothing where none is shown so.
fn shown(bench: &Bench, text: &str) -> Option<egui::Rect> {
    let root = bench.harness.root();
    let mut all = root.children_recursive();
    all.find(|node| {
        let own = node.accesskit_node();
        own.role() == Role::SpinButton && own.value().as_deref() == Some(text)
    })
    .map(|node| node.rect())
}

#[test]
fn a_slider_shows_all_digits_and_leaves_them() {
    let mut bench = open(NUMBERS);
    assert!(shown(&bench, "0.1000003").is_some());
    // Into the number and out again: nothing has changed.
    let at = shown(&bench, "0.12345").unwrap().center();
    bench.click_at(at);
    bench.harness.run_steps(3);
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(3);
    assert_eq!(changed(&bench), 0);
    assert_eq!(place(&bench), [0.12345, 0.100_000_3, 0.0]);

    // What is typed is taken and shown as it is.
    bench.click_at(at);
    bench.harness.run_steps(2);
    bench.key(ui_support::CTRL, Key::A);
    bench.type_text("0.98765432");
    bench.harness.key_press(Key::Enter);
    bench.until("the new value", |editor| {
        let scenes = &editor.workbench.scenes;
        !scenes.is_busy()
            && scenes.scene().is_some_and(|scene| {
                let thing = scene.world.find("box");
                let place: Option<lightbench::world::Transform> =
                    thing.and_then(|thing| scene.world.get(thing));
                place.is_some_and(|place| place.translation.x == 0.987_654_3)
            })
    });
    bench.harness.run_steps(3);
    assert!(shown(&bench, "0.98765432").is_some());
    assert_eq!(changed(&bench), 1);
    bench.key(Modifiers::NONE, Key::Escape);
    bench.key(ui_support::CTRL, Key::Z);
    bench.until("the old value", |editor| !editor.workbench.scenes.is_busy());
    bench.harness.run_steps(3);
    assert_eq!(changed(&bench), 0);
    assert!(shown(&bench, "0.12345").is_some());
}

/// The names of all buttons, with where their lower ends are, and whether they have the keys.
fn buttons(bench: &Bench) -> Vec<(String, f32, bool)> {
    let all = bench.harness.query_all_by_role(Role::Button);
    all.map(|node| {
        let own = node.accesskit_node();
        let name = own.label().unwrap_or_default();
        (name, node.rect().bottom(), own.is_focused())
    })
    .collect()
}

/// The lower end of the lowest of the buttons of a name; 0 where there is none.
fn lowest(bench: &Bench, start: &str) -> f32 {
    let all = buttons(bench).into_iter();
    let own = all.filter(|(name, ..)| name.starts_with(start));
    own.map(|(_, bottom, _)| bottom).fold(0.0, f32::max)
}

/// How many buttons are called so.
fn called(bench: &Bench, title: &str) -> usize {
    let all = buttons(bench).into_iter();
    all.filter(|(name, ..)| name == title).count()
}

/// Tab, until a button of that name has the keys.
fn tab_to(bench: &mut Bench, start: &str) {
    for _ in 0..90 {
        let all = buttons(bench);
        if all
            .iter()
            .any(|(name, _, focused)| *focused && name.starts_with(start))
        {
            return;
        }
        bench.harness.key_press(Key::Tab);
        bench.harness.run_steps(2);
    }
    panic!("Tab does not come to {start}");
}

fn enter(bench: &mut Bench) {
    bench.harness.key_press(Key::Enter);
    bench.harness.run_steps(4);
}

#[test]
fn the_menu_view_fits_700_points_and_its_panels_open_by_keys() {
    let mut bench = Bench::open();
    bench.harness.set_size(vec2(1000.0, 700.0));
    bench.harness.run_steps(4);
    tab_to(&mut bench, "View");
    enter(&mut bench);
    let end = lowest(&bench, "Text and widgets of the usual size");
    assert!(end > 300.0 && end < 690.0, "{end}");
    let titles = Panel::ALL.map(|panel| {
        let mut known = entries();
        let entry = known.find(|entry| entry.action == Action::Toggle(panel));
        entry.map_or("", |entry| entry.title())
    });
    // Some are called as the tabs of their panels are.
    let before = titles.map(|title| called(&bench, title));
    tab_to(&mut bench, "Panels");
    enter(&mut bench);
    // All panels but the viewports are there.
    for ((panel, title), before) in Panel::ALL.into_iter().zip(titles).zip(before) {
        if matches!(panel, Panel::Viewport | Panel::Second) {
            continue;
        }
        assert_eq!(called(&bench, title), before + 1, "{title}");
        let bottom = lowest(&bench, title);
        assert!(bottom < 700.0, "{title}: {bottom}");
    }
    assert!(bench.harness.state().rect_of(Panel::Passes).is_some());
    tab_to(&mut bench, "Passes");
    enter(&mut bench);
    assert!(bench.harness.state().rect_of(Panel::Passes).is_none());
    assert!(
        buttons(&bench)
            .iter()
            .all(|(name, ..)| !name.starts_with("Panels"))
    );
}
