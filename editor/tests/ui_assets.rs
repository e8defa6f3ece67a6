//! The browser of assets: pictures, who uses what, meshes and textures that come and go, models of files.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use lightbench::assets::Progress;
use lightbench::assets::images::encode_png;
use lightbench::script::{Scene, Settings, load_scene};
use lightbench::world::{MeshRenderer, Name};
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::log::Level;

use ui_support::Bench;

/// Things of two meshes and two materials, one with a texture. It stands still.
const ROOM: &str = r#"
let clay = material("clay").color(0.75, 0.25, 0.125);
spawn("cup").mesh(sphere(1)).material(clay).at(-1.5, 0, 0);
spawn("jug").mesh(box(1)).material(clay).at(0.5, 0, 0);
spawn("tile").mesh(box(1.5)).material(material("tiled").texture(checker_texture(4))).at(2.5, 0, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

const MODEL: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

const FILE: &str = "scripts/scenes/room.rhai";

fn open() -> Bench {
    let mut bench = Bench::open();
    bench.save("models/leaf.obj", MODEL);
    let green: Vec<u8> = [0, 200, 0, 255].repeat(16);
    let green = encode_png("green", 4, 4, &green).unwrap();
    std::fs::create_dir_all(bench.path().join("textures")).unwrap();
    std::fs::write(bench.path().join("textures/green.png"), green).unwrap();
    bench.save(FILE, ROOM);
    bench.harness.state_mut().workbench.select_scene("room");
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some("room") && !editor.workbench.scenes.is_busy()
    });
    bench.harness.set_size(egui::vec2(1300.0, 1500.0));
    for _ in 0..50 {
        bench.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    bench.until("the scene", |editor| !editor.workbench.scenes.is_busy());
    bench.show(Panel::Assets);
    bench
}

fn scene(bench: &Bench) -> &Scene {
    bench.harness.state().workbench.scenes.scene().unwrap()
}

fn text(bench: &mut Bench) -> String {
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.scenes.scene_mut().unwrap().to_text().unwrap()
}

fn click(bench: &mut Bench, label: &str) {
    bench
        .harness
        .get_by_role_and_label(Role::Button, label)
        .click();
    bench.harness.run_steps(4);
}

/// Clicks a card, which may be called as a button is.
fn card(bench: &mut Bench, label: &str) {
    let all = bench.harness.get_all_by_role_and_label(Role::Button, label);
    all.last().unwrap().click();
    bench.harness.run_steps(4);
}

fn key(bench: &mut Bench, key: Key, modifiers: Modifiers) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(3);
}

fn type_into(bench: &mut Bench, label: &str, typed: &str) {
    bench
        .harness
        .get_by_role_and_label(Role::TextInput, label)
        .click();
    bench.harness.run_steps(2);
    key(bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text(typed.to_owned()));
    bench.harness.run_steps(3);
}

const SHIFTED: Modifiers = Modifiers {
    shift: true,
    ..Modifiers::COMMAND
};

fn back_and_again(bench: &mut Bench, before: &str) {
    let after = text(bench);
    assert_ne!(after, before);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.undo();
    bench.harness.run_steps(2);
    assert_eq!(text(bench), before);
    key(bench, Key::Z, SHIFTED);
    assert_eq!(text(bench), after);
}

fn chosen(bench: &Bench) -> Vec<String> {
    let workbench = &bench.harness.state().workbench;
    let world = &scene(bench).world;
    let name = |entity| world.get::<Name>(entity).unwrap().text;
    workbench.selection.entities().map(name).collect()
}

fn mesh_of(bench: &Bench, name: &str) -> String {
    let scene = scene(bench);
    let entity = scene.world.find(name).unwrap();
    let renderer: MeshRenderer = scene.world.get(entity).unwrap();
    scene.assets.mesh(renderer.mesh).unwrap().name.to_string()
}

/// The mean colour in the middle of a card's picture.
fn color_of(bench: &mut Bench, label: &str) -> [u32; 3] {
    bench.until("the pictures", |editor| !editor.pictures.is_busy());
    bench.harness.run_steps(3);
    let all = bench.harness.get_all_by_role_and_label(Role::Button, label);
    let rect = all.last().unwrap().rect();
    let picture = bench.harness.render().unwrap();
    let from = rect.min + egui::vec2(4.0 + 42.0 - 6.0, 2.0 + 42.0 - 6.0);
    let mut sum = [0_u32; 3];
    for y in 0..12 {
        for x in 0..12 {
            let pixel = picture.get_pixel(from.x as u32 + x, from.y as u32 + y);
            for (sum, channel) in sum.iter_mut().zip(pixel.0) {
                *sum += u32::from(channel);
            }
        }
    }
    sum.map(|sum| sum / 144)
}

#[test]
fn cards_have_pictures_of_materials_meshes_textures_and_models() {
    let mut bench = open();
    let clay = color_of(&mut bench, "clay");
    assert!(clay[0] > clay[2] + 40, "{clay:?}");
    let tiled = color_of(&mut bench, "tiled");
    assert!(tiled[0].abs_diff(tiled[2]) < 40, "{tiled:?}");
    click(&mut bench, "Textures");
    let green = color_of(&mut bench, "green.png");
    assert!(
        green[1] > 150 && green[0] < 30 && green[2] < 30,
        "{green:?}"
    );
    click(&mut bench, "Meshes");
    let sphere = color_of(&mut bench, "sphere");
    assert!(sphere[0] > 40, "{sphere:?}");
    // A mesh that is edge on has nothing in the middle; this model faces the viewer.
    click(&mut bench, "Models");
    let leaf = color_of(&mut bench, "leaf.obj");
    assert!(leaf[0] > 40, "{leaf:?}");
    // Words find cards.
    click(&mut bench, "Meshes");
    type_into(&mut bench, "Search assets", "BOX 1.5");
    assert!(bench.harness.query_by_label("sphere").is_none());
    assert_eq!(bench.harness.query_all_by_label("box").count(), 0);
    assert!(bench.count("box (2)") > 0);
}

#[test]
fn who_uses_what_is_said_and_chosen() {
    let mut bench = open();
    card(&mut bench, "clay");
    assert_eq!(bench.count("Entities that use it: 2"), 1);
    click(&mut bench, "Choose them");
    assert_eq!(chosen(&bench), ["cup", "jug"]);
    click(&mut bench, "Textures");
    card(&mut bench, "checker");
    assert_eq!(bench.count("In materials: tiled"), 1);
    assert_eq!(bench.count("Entities that use it: 1"), 1);
    click(&mut bench, "Choose them");
    assert_eq!(chosen(&bench), ["tile"]);
}

#[test]
fn a_mesh_is_made_of_a_shape_given_to_entities_saved_and_deleted() {
    let mut bench = open();
    let before = text(&mut bench);
    let first = bench.picture();
    click(&mut bench, "Meshes");
    type_into(&mut bench, "Shapes", "torus(1, 0.25).segments(24, 12)");
    click(&mut bench, "Create mesh");
    let made = text(&mut bench);
    assert!(made.contains("= torus(1, 0.25).segments(24, 12)"), "{made}");
    back_and_again(&mut bench, &before);
    card(&mut bench, "torus");
    assert_eq!(bench.count("Nothing uses it."), 1);
    bench.choose_entities(&["cup", "jug"]);
    click(&mut bench, "Give to chosen entities");
    assert_eq!(
        (mesh_of(&bench, "cup"), mesh_of(&bench, "jug")),
        ("torus".into(), "torus".into())
    );
    bench.until_picture_is_not(&first);
    back_and_again(&mut bench, &made);
    // What is used is not deleted.
    click(&mut bench, "Delete asset");
    assert_eq!(bench.count("2 entities are drawn with torus"), 1);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&mut bench), made);
    let saved = load_saved(&mut bench);
    assert_eq!(saved, made, "a mesh that nothing uses is in the file");
    click(&mut bench, "Delete asset");
    assert_eq!(text(&mut bench), before);
    assert!(bench.harness.query_by_label("torus").is_none());
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&mut bench), made);
    // What makes no mesh is said.
    type_into(&mut bench, "Shapes", "brick_texture()");
    click(&mut bench, "Create mesh");
    assert_eq!(bench.count("makes no mesh"), 1);
}

fn load_saved(bench: &mut Bench) -> String {
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.save_scene("kept").unwrap();
    let (settings, progress) = (Settings::new(), Progress::new());
    let path = "scripts/scenes/kept.scene";
    let read = load_scene(&bench.files, path, &settings, &progress);
    read.unwrap().to_text().unwrap()
}

#[test]
fn textures_of_files_and_calls_go_into_materials() {
    let mut bench = open();
    let before = text(&mut bench);
    let shown = bench.picture();
    bench.show(Panel::Materials);
    card(&mut bench, "clay");
    bench.show(Panel::Assets);
    click(&mut bench, "Textures");
    card(&mut bench, "green.png");
    click(&mut bench, "Use as texture");
    bench.until_picture_is_not(&shown);
    assert!(text(&mut bench).contains("picture(\"textures/green.png\")"));
    back_and_again(&mut bench, &before);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    // Made by calls, kept though nothing uses it, and deleted.
    type_into(&mut bench, "Painted textures", "marble_texture().seed(3)");
    click(&mut bench, "Create texture");
    let made = text(&mut bench);
    assert!(made.contains("= marble_texture().seed(3)"), "{made}");
    assert_eq!(load_saved(&mut bench), made);
    card(&mut bench, "marble");
    click(&mut bench, "Delete asset");
    assert_eq!(text(&mut bench), before);
    // The script's own can't be deleted.
    card(&mut bench, "checker");
    let delete = bench
        .harness
        .get_by_role_and_label(Role::Button, "Delete asset");
    assert!(delete.accesskit_node().is_disabled());
}

#[test]
fn models_of_the_project_and_from_elsewhere_are_added_and_taken_back() {
    let mut bench = open();
    let before = text(&mut bench);
    let first = bench.picture();
    click(&mut bench, "Models");
    card(&mut bench, "leaf.obj");
    click(&mut bench, "Add to the scene");
    assert_eq!(chosen(&bench), ["leaf"]);
    bench.until_picture_is_not(&first);
    back_and_again(&mut bench, &before);
    click(&mut bench, "Add to the scene");
    assert_eq!(chosen(&bench), ["leaf 2"]);
    let two = text(&mut bench);
    assert_eq!(load_saved(&mut bench), two);
    // One from another folder.
    let elsewhere = tempfile::tempdir().unwrap();
    let file = elsewhere.path().join("petal.obj");
    std::fs::write(&file, MODEL).unwrap();
    click(&mut bench, "Model from a file");
    key(&mut bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text(file.display().to_string()));
    bench.harness.run_steps(2);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    assert_eq!(chosen(&bench), ["petal"]);
    let three = text(&mut bench);
    // The script is loaded anew, and all are there again.
    let swaps = bench.harness.state().workbench.scenes.swaps();
    bench.harness.state_mut().workbench.scenes.reload();
    bench.until("the scene anew", |editor| {
        editor.workbench.scenes.swaps() > swaps && !editor.workbench.scenes.is_busy()
    });
    assert_eq!(text(&mut bench), three);
    while bench.harness.state_mut().workbench.undo() {}
    assert_eq!(text(&mut bench), before);
}

#[test]
fn who_saves_a_scene_with_a_model_from_elsewhere_is_told_what_the_file_needs() {
    let elsewhere = tempfile::tempdir().unwrap();
    let file = elsewhere.path().canonicalize().unwrap().join("my leaf.obj");
    std::fs::write(&file, MODEL).unwrap();
    let mut bench = open();
    let complaints = |bench: &Bench| {
        let log = &bench.harness.state().workbench.log;
        let warnings = log.lines().filter(|line| line.level == Level::Warning);
        let needs = warnings.filter(|line| line.text.contains("needs"));
        needs.map(|line| line.text.clone()).collect::<Vec<_>>()
    };
    bench
        .harness
        .state_mut()
        .workbench
        .save_scene("kept")
        .unwrap();
    assert_eq!(complaints(&bench), Vec::<String>::new());
    bench
        .harness
        .state_mut()
        .workbench
        .open_file(&file)
        .unwrap();
    bench.until("the model", |editor| {
        let scenes = &editor.workbench.scenes;
        scenes.shown() == Some("showroom") && !scenes.is_busy() && !editor.workbench.is_arriving()
    });
    bench
        .harness
        .state_mut()
        .workbench
        .save_scene("leaf")
        .unwrap();
    let told = complaints(&bench);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains(file.to_str().unwrap()), "{told:?}");
}
