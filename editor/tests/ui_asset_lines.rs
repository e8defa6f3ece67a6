//! Changes of materials and meshes by hand as lines of scene scripts, which make the same world.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::assets::{Material, Mesh};
use lightbench::script::Scene;
use lightbench::script::overlays::Who;
use lightbench::world::{MeshRenderer, Name};
use lightbench_editor::ui::Editor;
use lightbench_editor::ui::layout::Panel;

use ui_support::Bench;

const ROOM: &str = r#"
let clay = material("clay").color(0.5, 0.25, 0.125);
spawn("cup").mesh(sphere(1)).material(clay).at(-1.5, 0, 0);
spawn("jug").mesh(sphere(0.8)).material(clay).at(0.5, 0, 0);
spawn("pan").mesh(sphere(0.6)).material(material("steel").color(0.125, 0.125, 0.125).ggx(0.25)).at(2, 0, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

fn open_scene(bench: &mut Bench, name: &str, script: &str) {
    bench.save(&format!("scripts/scenes/{name}.rhai"), script);
    bench.harness.state_mut().workbench.select_scene(name);
    bench.until("the scene", |editor| {
        assert!(
            !Bench::has_problems(editor),
            "{:?}",
            editor.workbench.problems().next()
        );
        editor.workbench.scenes.shown() == Some(name) && !editor.workbench.scenes.is_busy()
    });
    // A file that was just written is told of once more.
    for _ in 0..50 {
        bench.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    bench.until("the scene", |editor| !editor.workbench.scenes.is_busy());
    bench.harness.run_steps(2);
}

fn scene(bench: &Bench) -> &Scene {
    bench.harness.state().workbench.scenes.scene().unwrap()
}

/// An entity's name and what it is drawn with.
type Drawn = (String, Option<(Material, Arc<Mesh>)>);

/// What each entity that has a name is drawn with.
fn drawn(bench: &Bench) -> Vec<Drawn> {
    let scene = scene(bench);
    let names = scene.world.columns::<Name>();
    let each = names.text().iter().zip(names.entities());
    let mut all: Vec<_> = each
        .map(|(name, entity)| {
            let renderer: Option<MeshRenderer> = scene.world.get(*entity);
            let drawn = renderer.map(|renderer| {
                let material = scene.assets.material(renderer.material).unwrap().clone();
                (material, scene.assets.mesh(renderer.mesh).unwrap().clone())
            });
            (name.clone(), drawn)
        })
        .collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

/// The picture once all models of reflection have their shaders: until then the one before stays.
fn settled(bench: &mut Bench) -> Vec<u8> {
    loop {
        let picture = bench.picture();
        let waits = |editor: &Editor| {
            let pipelines = &editor.workbench.pipelines;
            pipelines.is_busy() || pipelines.is_warming()
        };
        if !waits(bench.harness.state()) {
            return picture;
        }
        bench.until("the shaders", |editor| !waits(editor));
    }
}

fn click(bench: &mut Bench, label: &str) {
    let node = bench.harness.get_by_role_and_label(Role::Button, label);
    node.scroll_to_me();
    bench.harness.run_steps(3);
    bench.press(label);
}

fn type_into(bench: &mut Bench, role: Role, label: &str, typed: &str) {
    let find = |bench: &Bench| {
        let mut all = bench.harness.get_all_by_role_and_label(role, label);
        all.next().unwrap().rect().center()
    };
    let all = bench.harness.get_all_by_role_and_label(role, label);
    all.for_each(|node| node.scroll_to_me());
    bench.harness.run_steps(40);
    let at = find(bench);
    bench.click_at(at);
    bench.harness.run_steps(2);
    bench.key(Modifiers::COMMAND, Key::A);
    bench.harness.event(Event::Text(typed.to_owned()));
    bench.harness.run_steps(1);
    bench.key(Modifiers::NONE, Key::Enter);
}

/// The lines of all that was done to the scene.
fn lines(bench: &Bench) -> Vec<String> {
    let deeds = bench.harness.state().workbench.history.deeds();
    let of_scene = deeds.filter(|deed| deed.script.name() == "scene script");
    of_scene.map(|deed| deed.line.clone()).collect()
}

#[test]
fn lines_of_changed_materials_and_meshes_make_the_same_world_in_a_script() {
    let mut bench = Bench::open();
    open_scene(&mut bench, "room", ROOM);
    // High enough for all rows.
    bench.harness.set_size(egui::vec2(1300.0, 1700.0));
    bench.harness.state_mut().workbench.history.clear();
    bench.show(Panel::Materials);
    click(&mut bench, "New material");
    click(&mut bench, "material");
    type_into(&mut bench, Role::TextInput, "Material's name", "gold");
    click(&mut bench, "gold");
    type_into(&mut bench, Role::SpinButton, "Color", "0.7512345");
    bench.choose_entities(&["cup", "pan"]);
    click(&mut bench, "Give to what is chosen");
    click(&mut bench, "clay");
    type_into(&mut bench, Role::SpinButton, "Emissive", "0.25");
    click(&mut bench, "Duplicate material");
    bench.choose("Model", "Ward, anisotropic");
    bench.choose_entities(&["pan"]);
    click(&mut bench, "Give to what is chosen");
    click(&mut bench, "gold");
    let node = bench
        .harness
        .get_by_role_and_label(Role::CheckBox, "Two-sided");
    node.click();
    bench.harness.run_steps(3);
    let workbench = &mut bench.harness.state_mut().workbench;
    let torus = lightbench::script::overlays::AssetEdit::NewMesh {
        recipe: "torus(1, 0.25)".to_owned(),
    };
    workbench.change_assets(torus).unwrap();
    bench.choose_entities(&["jug"]);
    let workbench = &mut bench.harness.state_mut().workbench;
    let torus = Who {
        name: "torus".to_owned(),
        nth: 0,
    };
    workbench.reshape_chosen(Some(torus)).unwrap();
    bench.harness.run_steps(3);
    let (wanted, picture) = (drawn(&bench), settled(&mut bench));
    let done = lines(&bench);
    assert!(done.iter().all(|line| !line.starts_with("//")), "{done:#?}");
    assert_eq!(
        done[0],
        "material(\"material\").color(0.5, 0.5, 0.5).specular(0.04).power(32.0);"
    );
    // In the panel Actions they stand with a button that copies them.
    bench.show(Panel::Actions);
    assert!(
        bench.count("entity(\"jug\").mesh(torus(1.0, 0.25));") == 1
            || bench.count("entity(\"jug\").mesh(torus(1, 0.25));") == 1
    );
    let script = format!("{ROOM}\n{}", done.join("\n"));
    let all_at_once = bench.harness.state().workbench.overlay_lines();
    open_scene(&mut bench, "again", &script);
    assert_eq!(drawn(&bench), wanted, "{script}");
    assert!(settled(&mut bench) == picture, "{script}");
    // And so do the lines of all that lies over the script.
    open_scene(&mut bench, "once_more", &format!("{ROOM}\n{all_at_once}"));
    assert_eq!(drawn(&bench), wanted, "{all_at_once}");

    // A slider's way is one line; what scripts have no words for is said.
    open_scene(&mut bench, "room_again", ROOM);
    bench.harness.state_mut().workbench.history.clear();
    bench.show(Panel::Materials);
    click(&mut bench, "New material");
    click(&mut bench, "material");
    click(&mut bench, "Delete material");
    click(&mut bench, "clay");
    click(&mut bench, "Delete material");
    let done = lines(&bench);
    assert_eq!(done.len(), 3);
    assert_eq!(
        done[1],
        "// nothing is drawn with it: leave out the call that makes it"
    );
    assert!(done[2].ends_with(" entity(\"cup\").material(it); entity(\"jug\").material(it); }"));
    let wanted = drawn(&bench);
    open_scene(
        &mut bench,
        "deleted",
        &format!("{ROOM}\n{}", done.join("\n")),
    );
    assert_eq!(drawn(&bench), wanted);
}
