//! For everybody: all widgets have names for screen readers, are reached by the keyboard, and text has the
//! size and the colours that somebody chose.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::collections::BTreeSet;

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use lightbench_editor::ui::kept::Kept;
use lightbench_editor::ui::layout::Panel;

use ui_support::{Bench, CTRL};

/// Kinds of widgets that do something.
const ACTING: [Role; 10] = [
    Role::Button,
    Role::CheckBox,
    Role::ComboBox,
    Role::Link,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
    Role::MultilineTextInput,
    Role::ColorWell,
];

/// A widget as a screen reader tells it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Widget {
    role: String,
    name: String,
    id: u64,
}

fn widgets(bench: &Bench) -> Vec<Widget> {
    let root = bench.harness.root();
    let nodes = root.children_recursive().map(|node| node.accesskit_node());
    let acting = nodes.filter(|node| ACTING.contains(&node.role()) && !node.is_disabled());
    acting
        .map(|node| Widget {
            role: format!("{:?}", node.role()),
            name: node.label().unwrap_or_default(),
            id: node.locate().0.0,
        })
        .collect()
}

/// The widget that has the keys.
fn focused(bench: &Bench) -> Option<u64> {
    let root = bench.harness.root();
    let mut nodes = root.children_recursive().map(|node| node.accesskit_node());
    nodes
        .find(|node| node.is_focused())
        .map(|node| node.locate().0.0)
}

/// Shows a panel with something in it.
fn show(bench: &mut Bench, panel: Panel) {
    match panel {
        Panel::Code => bench.key(CTRL, Key::E),
        Panel::Compare => bench.key(egui::Modifiers::NONE, Key::C),
        Panel::Entities => {
            let workbench = &mut bench.harness.state_mut().workbench;
            let scene = workbench.scenes.scene().unwrap();
            let first = scene.world.entities().next().unwrap();
            workbench.selection.set(scene, [first]);
        }
        _ => {}
    }
    bench.show(panel);
    bench.harness.run_steps(4);
}

#[test]
fn every_widget_of_every_panel_has_a_name() {
    let mut bench = Bench::open();
    let mut nameless = BTreeSet::new();
    for panel in Panel::ALL {
        show(&mut bench, panel);
        for widget in widgets(&bench) {
            if widget.name.trim().is_empty() {
                nameless.insert(format!("{panel:?}: a {} without a name", widget.role));
            }
        }
    }
    assert!(nameless.is_empty(), "{nameless:#?}");
}

#[test]
fn tab_reaches_every_widget() {
    let mut bench = Bench::open();
    for panel in [
        Panel::Pipeline,
        Panel::Entities,
        Panel::Targets,
        Panel::Compare,
    ] {
        show(&mut bench, panel);
        // Those in sight: what is scrolled away is reached by scrolling, which follows the focus.
        let mut wanted: BTreeSet<Widget> = widgets(&bench).into_iter().collect();
        let count = wanted.len();
        assert!(count > 20, "{panel:?}: {count}");
        for _ in 0..3 * count {
            bench.harness.key_press(Key::Tab);
            bench.harness.step();
            if let Some(id) = focused(&bench) {
                wanted.retain(|widget| widget.id != id);
            }
            if wanted.is_empty() {
                break;
            }
        }
        assert!(wanted.is_empty(), "{panel:?}: {wanted:#?}");
        bench.key(egui::Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn text_and_theme_are_as_they_were_chosen_after_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("editor.json");
    let mut bench = Bench::open_with(Some(file.clone()));
    let height = |bench: &Bench| {
        let button = bench.harness.get_by_role_and_label(Role::Button, "File");
        button.rect().height() * bench.harness.ctx.zoom_factor()
    };
    let usual = height(&bench);
    for _ in 0..3 {
        bench.key(CTRL, Key::Plus);
    }
    let larger = height(&bench);
    assert!((larger / usual - 1.331).abs() < 0.08, "{usual} {larger}");
    // The key without Shift.
    bench.key(CTRL, Key::Equals);
    bench.key(CTRL, Key::Minus);
    assert!((height(&bench) - larger).abs() < 0.5);

    let dark = bench.harness.ctx.theme() == egui::Theme::Dark;
    bench.key(CTRL, Key::T);
    assert_ne!(bench.harness.ctx.theme() == egui::Theme::Dark, dark);
    drop(bench);

    let kept = Kept::read(Some(file.clone()));
    assert_eq!(kept.dark, Some(!dark));
    let mut again = Bench::open_with(Some(file.clone()));
    assert!((height(&again) - larger).abs() < 0.5);
    assert_ne!(again.harness.ctx.theme() == egui::Theme::Dark, dark);

    let ctx = again.harness.ctx.clone();
    let editor = again.harness.state_mut();
    editor.perform(lightbench_editor::ui::actions::Action::UsualText, &ctx);
    again.harness.run_steps(3);
    assert!((height(&again) - usual).abs() < 0.5);
    assert!((Kept::read(Some(file)).scale - 1.0).abs() < 1e-6);
}
