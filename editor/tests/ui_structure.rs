//! Entities that come, go, hang elsewhere, are called otherwise, hidden and locked, through the widgets.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::Queryable as _;
use lightbench::assets::Progress;
use lightbench::script::{Scene, Settings, load_scene};
use lightbench::world::glam::Vec3;
use lightbench::world::{Camera, Entity, Light, MeshRenderer, Name, Velocity, WorldMatrix};
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::lens::Lens;
use lightbench_editor::ui::workbench::log::Level;

use ui_support::Bench;

/// Things on a table, lamps, and one without a name. It stands still.
const ROOM: &str = r#"
spawn("table").mesh(box(1)).at(-2, 0, 0).rotate(0, 90, 0).scale(2);
spawn("cup").mesh(box(0.5)).parent(entity("table")).at(0, 1, 0);
spawn("plate").mesh(box(0.5)).at(2, 0, 0);
spawn("bowl").mesh(box(0.5)).at(3.5, 0, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
point_light("bulb").intensity(20).range(9).at(0, 4, 5);
spawn().at(0, 9, 0);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

const FILE: &str = "scripts/scenes/room.rhai";

fn open() -> Bench {
    let mut bench = Bench::open();
    bench.save(FILE, ROOM);
    bench.harness.state_mut().workbench.select_scene("room");
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some("room") && !editor.workbench.scenes.is_busy()
    });
    // The choice of the scene is a step too.
    bench.harness.state_mut().workbench.undo.clear();
    // High enough for all rows.
    bench.harness.set_size(egui::vec2(1100.0, 1500.0));
    bench.show(Panel::Entities);
    calm(&mut bench);
    bench
}

/// A file that was just written is told of once more.
fn calm(bench: &mut Bench) {
    for _ in 0..50 {
        bench.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    bench.until("the scene", |editor| !editor.workbench.scenes.is_busy());
    bench.harness.run_steps(2);
}

/// What was refused.
fn errors(bench: &Bench) -> Vec<String> {
    let lines = bench.harness.state().workbench.log.lines();
    let errors = lines.filter(|line| line.level == Level::Error);
    errors.map(|line| line.text.clone()).collect()
}

/// Saves the script and waits for the scene that it makes.
fn reload(bench: &mut Bench, script: &str) {
    let swaps = bench.harness.state().workbench.scenes.swaps();
    bench.save(FILE, script);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.files_changed(&[FILE.to_owned()]);
    bench.until("the scene anew", |editor| {
        editor.workbench.scenes.swaps() > swaps && !editor.workbench.scenes.is_busy()
    });
    calm(bench);
}

fn scene(bench: &Bench) -> &Scene {
    bench.harness.state().workbench.scenes.scene().unwrap()
}

fn find(bench: &Bench, name: &str) -> Option<Entity> {
    scene(bench).world.find(name)
}

fn text(bench: &mut Bench) -> String {
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.scenes.scene_mut().unwrap().to_text().unwrap()
}

fn place(bench: &Bench, name: &str) -> Vec3 {
    let entity = find(bench, name).unwrap();
    let matrix: WorldMatrix = scene(bench).world.get(entity).unwrap();
    matrix.matrix.translation.into()
}

fn parent(bench: &Bench, name: &str) -> Option<String> {
    let world = &scene(bench).world;
    let parent = world.parent(world.find(name).unwrap())?;
    Some(world.get::<Name>(parent).unwrap().text)
}

fn steps(bench: &Bench) -> Vec<String> {
    let undo = &bench.harness.state().workbench.undo;
    undo.done().iter().map(|step| step.what.clone()).collect()
}

fn hold(bench: &mut Bench, modifiers: Modifiers) {
    bench.harness.event(Event::ModifiersChanged(modifiers));
    bench.harness.step();
}

fn button(bench: &mut Bench, at: Pos2, pressed: bool, modifiers: Modifiers) {
    bench.harness.event(Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers,
    });
    bench.harness.step();
}

fn row(bench: &Bench, name: &str) -> Pos2 {
    let node = bench.harness.get_by_role_and_label(Role::Button, name);
    node.rect().center()
}

/// Clicks rows of the list, the first alone and the others with Ctrl.
fn choose(bench: &mut Bench, names: &[&str]) {
    for (index, name) in names.iter().enumerate() {
        let modifiers = match index {
            0 => Modifiers::NONE,
            _ => Modifiers::COMMAND,
        };
        hold(bench, modifiers);
        // Where the row is once the panel has taken in what was chosen before.
        let node = bench.harness.get_by_role_and_label(Role::Button, name);
        node.scroll_to_me();
        bench.harness.run_steps(3);
        let at = row(bench, name);
        bench.harness.hover_at(at);
        bench.harness.step();
        button(bench, at, true, modifiers);
        button(bench, at, false, modifiers);
        hold(bench, Modifiers::NONE);
    }
    bench.harness.run_steps(2);
}

fn chosen(bench: &Bench) -> Vec<String> {
    let workbench = &bench.harness.state().workbench;
    let world = &scene(bench).world;
    let name = |entity| world.get::<Name>(entity).unwrap().text;
    workbench.selection.entities().map(name).collect()
}

fn click(bench: &mut Bench, label: &str) {
    let node = bench.harness.get_by_role_and_label(Role::Button, label);
    node.scroll_to_me();
    bench.harness.run_steps(3);
    bench
        .harness
        .get_by_role_and_label(Role::Button, label)
        .click();
    bench.harness.run_steps(3);
}

fn menu(bench: &mut Bench, title: &str, entry: &str) {
    click(bench, title);
    bench
        .harness
        .get_by(|node| {
            node.role() == Role::Button
                && node.label().is_some_and(|label| label.starts_with(entry))
        })
        .click();
    bench.harness.run_steps(3);
}

fn key(bench: &mut Bench, key: Key, modifiers: Modifiers) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(3);
}

/// Drags a row onto something.
fn drag(bench: &mut Bench, name: &str, to: impl Fn(&Bench) -> Pos2) {
    let from = row(bench, name);
    bench.harness.hover_at(from);
    bench.harness.step();
    button(bench, from, true, Modifiers::NONE);
    bench.harness.hover_at(from + egui::vec2(4.0, 8.0));
    bench.harness.run_steps(2);
    let to = to(bench);
    for part in 1..=3 {
        bench.harness.hover_at(from.lerp(to, part as f32 / 3.0));
        bench.harness.step();
    }
    button(bench, to, false, Modifiers::NONE);
    bench.harness.run_steps(3);
}

/// Types a text over what stands in a field, and leaves it.
fn type_into(bench: &mut Bench, role: Role, label: &str, text: &str) {
    bench.harness.get_by_role_and_label(role, label).click();
    bench.harness.run_steps(2);
    key(bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text(text.to_owned()));
    bench.harness.run_steps(1);
    key(bench, Key::Enter, Modifiers::NONE);
}

const SHIFTED: Modifiers = Modifiers {
    shift: true,
    ..Modifiers::COMMAND
};

/// Takes the last step back and does it again; each time the scene is as it was.
fn back_and_again(bench: &mut Bench, before: &str) {
    let after = text(bench);
    assert_ne!(after, before);
    key(bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(bench), before);
    key(bench, Key::Z, SHIFTED);
    assert_eq!(text(bench), after);
}

#[test]
fn menus_make_every_kind_of_thing_and_it_is_drawn() {
    let mut bench = open();
    let first = bench.picture();
    let before = text(&mut bench);
    menu(&mut bench, "Entity", "Create sphere");
    assert_eq!(chosen(&bench), ["sphere"]);
    let sphere = find(&bench, "sphere").unwrap();
    assert!(scene(&bench).world.has::<MeshRenderer>(sphere));
    let drawn = bench.until_picture_is_not(&first);
    back_and_again(&mut bench, &before);
    for (entry, name) in [
        ("Create empty", "empty"),
        ("Create box", "box"),
        ("Create cylinder", "cylinder"),
        ("Create cone", "cone"),
        ("Create torus", "torus"),
        ("Create plane", "plane"),
        ("Create point light", "point light"),
        ("Create spot light", "spot light"),
        ("Create directional light", "directional light"),
        ("Create camera", "camera"),
    ] {
        menu(&mut bench, "Entity", entry);
        assert_eq!(chosen(&bench), [name]);
    }
    let world = &scene(&bench).world;
    let has_light = |name: &str| world.has::<Light>(world.find(name).unwrap());
    assert!(has_light("point light") && has_light("spot light") && !has_light("box"));
    assert!(world.has::<Camera>(world.find("camera").unwrap()));
    bench.until_picture_is_not(&drawn);
    assert_eq!(steps(&bench).len(), 11);
    assert_eq!(steps(&bench)[0], "Create sphere");
    for _ in 0..11 {
        key(&mut bench, Key::Z, Modifiers::COMMAND);
    }
    assert_eq!(text(&mut bench), before);
    let now = std::time::Instant::now();
    while bench.picture() != first {
        assert!(
            now.elapsed() < ui_support::PATIENCE,
            "the picture stays another one"
        );
        bench.harness.step();
    }
}

#[test]
fn keys_duplicate_and_delete_all_that_is_chosen_with_what_hangs_on_it() {
    let mut bench = open();
    let before = text(&mut bench);
    choose(&mut bench, &["table", "plate"]);
    key(&mut bench, Key::D, Modifiers::COMMAND);
    assert_eq!(chosen(&bench), ["table 2", "plate 2"]);
    assert_eq!(parent(&bench, "cup 2").as_deref(), Some("table 2"));
    assert_eq!(place(&bench, "cup 2"), place(&bench, "cup"));
    assert_eq!(steps(&bench), ["Duplicate 2 entities"]);
    back_and_again(&mut bench, &before);
    assert_eq!(chosen(&bench), ["table 2", "plate 2"], "again");

    let copied = text(&mut bench);
    choose(&mut bench, &["table", "plate", "lamp"]);
    key(&mut bench, Key::Delete, Modifiers::NONE);
    assert_eq!(chosen(&bench), [""; 0]);
    for gone in ["table", "cup", "plate", "lamp"] {
        assert_eq!(find(&bench, gone), None, "{gone}");
    }
    assert!(find(&bench, "cup 2").is_some());
    assert_eq!(steps(&bench)[1], "Delete 3 entities");
    back_and_again(&mut bench, &copied);

    // It stays so when the script says something else of the others.
    reload(&mut bench, &ROOM.replace("at(3.5, 0, 0)", "at(3.5, 1, 0)"));
    assert_eq!(place(&bench, "bowl").y, 1.0);
    assert!(find(&bench, "cup").is_none() && find(&bench, "cup 2").is_some());
    reload(&mut bench, ROOM);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&mut bench), copied);
    // The panel of the history says it and goes back.
    bench.show(Panel::History);
    assert_eq!(bench.count("Delete 3 entities"), 1);
    click(&mut bench, "As it was at the start");
    assert_eq!(text(&mut bench), before);
    click(&mut bench, "Delete 3 entities");
    assert!(find(&bench, "cup").is_none() && find(&bench, "cup 2").is_some());
}

#[test]
fn a_name_is_typed_for_one_and_for_several_also_for_one_that_had_none() {
    let mut bench = open();
    let before = text(&mut bench);
    choose(&mut bench, &["lamp"]);
    // A change of a field goes along.
    let lamp = find(&bench, "lamp").unwrap();
    let workbench = &mut bench.harness.state_mut().workbench;
    let value = lightbench::world::Value::Float(77.0);
    workbench.set_field(lamp, "light.intensity", value).unwrap();
    bench.harness.run_steps(2);
    let changed = text(&mut bench);
    key(&mut bench, Key::F2, Modifiers::NONE);
    key(&mut bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text("desk lamp".to_owned()));
    bench.harness.run_steps(1);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    assert_eq!(find(&bench, "desk lamp"), Some(lamp));
    assert_eq!(bench.count("Changed by hand. The script's value: 60"), 1);
    back_and_again(&mut bench, &changed);
    reload(&mut bench, ROOM);
    let lamp: Light = {
        let world = &scene(&bench).world;
        world.get(world.find("desk lamp").unwrap()).unwrap()
    };
    assert_eq!(lamp.intensity, 77.0);

    choose(&mut bench, &["plate", "bowl"]);
    type_into(&mut bench, Role::TextInput, "Name", "dish");
    assert_eq!(chosen(&bench), ["dish", "dish 2"]);
    assert_eq!(
        steps(&bench)[1..],
        ["Rename lamp to desk lamp", "Rename 2 entities"]
    );
    // A name that another one has is refused.
    type_into(&mut bench, Role::TextInput, "Name", "cup");
    assert!(bench.count("Another entity is called `cup`") > 0);
    assert_eq!(chosen(&bench), ["dish", "dish 2"]);

    let node = bench.harness.get_by_label_contains("(no name");
    let at = node.rect().center();
    bench.click_at(at);
    bench.harness.run_steps(2);
    type_into(&mut bench, Role::TextInput, "Name", "named");
    assert!(find(&bench, "named").is_some());
    assert_eq!(bench.count("kept by name"), 0);
    reload(&mut bench, ROOM);
    assert!(find(&bench, "named").is_some());
    bench.show(Panel::History);
    click(&mut bench, "As it was at the start");
    assert_eq!(text(&mut bench), before);
}

#[test]
fn rows_are_dragged_below_others_and_below_none_and_stay_where_they_are() {
    let mut bench = open();
    let before = text(&mut bench);
    let (plate, bowl) = (place(&bench, "plate"), place(&bench, "bowl"));
    choose(&mut bench, &["plate", "bowl"]);
    drag(&mut bench, "plate", |bench| row(bench, "cup"));
    assert_eq!(errors(&bench), [""; 0]);
    assert_eq!(parent(&bench, "plate").as_deref(), Some("cup"));
    assert_eq!(parent(&bench, "bowl").as_deref(), Some("cup"));
    assert!(place(&bench, "plate").abs_diff_eq(plate, 1e-4));
    assert!(place(&bench, "bowl").abs_diff_eq(bowl, 1e-4));
    assert_eq!(steps(&bench), ["Put 2 entities below cup"]);
    // Its row stands below that of the cup, further right.
    let (above, below) = (row(&bench, "cup"), row(&bench, "plate"));
    assert!(below.y > above.y && below.y < row(&bench, "lamp").y);
    back_and_again(&mut bench, &before);
    reload(&mut bench, ROOM);
    assert_eq!(parent(&bench, "plate").as_deref(), Some("cup"));
    assert!(place(&bench, "plate").abs_diff_eq(plate, 1e-4));

    // A circle is refused.
    let now = text(&mut bench);
    choose(&mut bench, &["table"]);
    drag(&mut bench, "table", |bench| row(bench, "bowl"));
    assert!(bench.count("Table can't be put below bowl") > 0);
    assert_eq!(text(&mut bench), now);

    choose(&mut bench, &["bowl"]);
    drag(&mut bench, "bowl", |bench| row(bench, "No parent"));
    assert_eq!(parent(&bench, "bowl"), None);
    assert!(place(&bench, "bowl").abs_diff_eq(bowl, 1e-4));
    back_and_again(&mut bench, &now);
}

#[test]
fn the_eye_hides_meshes_and_lights_with_all_below_and_the_picture_shows_it() {
    let mut bench = open();
    let first = bench.picture();
    let before = text(&mut bench);
    click(&mut bench, "Hide table");
    let hidden = bench.until_picture_is_not(&first);
    let shown = |bench: &Bench, name: &str| {
        let world = &scene(bench).world;
        let renderer: MeshRenderer = world.get(world.find(name).unwrap()).unwrap();
        renderer.visible
    };
    assert!(!shown(&bench, "table") && !shown(&bench, "cup") && shown(&bench, "plate"));
    assert_eq!(steps(&bench), ["Hide table"]);
    back_and_again(&mut bench, &before);
    click(&mut bench, "Hide lamp");
    bench.until_picture_is_not(&hidden);
    assert!(text(&mut bench).contains("visible = false\n  Name\n    text = \"lamp\""));
    reload(&mut bench, ROOM);
    assert!(!shown(&bench, "cup"));
    // All that is chosen goes along.
    choose(&mut bench, &["lamp", "table"]);
    click(&mut bench, "Show lamp");
    assert!(shown(&bench, "cup"));
    assert_eq!(text(&mut bench), before);
    assert_eq!(steps(&bench)[2], "Show 2 entities");
}

#[test]
fn what_is_locked_is_neither_picked_nor_moved() {
    let mut bench = open();
    let before = text(&mut bench);
    let pick = |bench: &mut Bench| {
        let node = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
        let view = bench.harness.state().workbench.camera.view();
        let at = Lens::new(node.rect(), view).point(Vec3::new(2.0, 0.0, 0.25));
        bench.click_at(at.unwrap());
        bench.harness.run_steps(2);
        chosen(bench)
    };
    assert_eq!(pick(&mut bench), ["plate"]);
    click(&mut bench, "Lock plate");
    assert_eq!(steps(&bench), ["Lock plate"]);
    back_and_again(&mut bench, &before);
    assert_eq!(pick(&mut bench), [""; 0]);
    reload(&mut bench, ROOM);
    assert_eq!(pick(&mut bench), [""; 0]);
    // Chosen in the list, it does not follow its handles.
    choose(&mut bench, &["plate"]);
    let at = place(&bench, "plate");
    // What is not taken by a handle moves the camera.
    let pull = |bench: &mut Bench| {
        let node = bench.harness.get_by_role_and_label(Role::Image, "Viewport");
        let view = bench.harness.state().workbench.camera.view();
        let lens = Lens::new(node.rect(), view);
        let handle = at + Vec3::X * 40.0 * lens.metres_per_point(at);
        let (from, to) = (
            lens.point(handle).unwrap(),
            lens.point(handle + Vec3::X).unwrap(),
        );
        bench.harness.hover_at(from);
        bench.harness.step();
        button(bench, from, true, Modifiers::NONE);
        for part in 1..=4 {
            bench.harness.hover_at(from.lerp(to, part as f32 / 4.0));
            bench.harness.step();
        }
        button(bench, to, false, Modifiers::NONE);
        bench.harness.run_steps(2);
    };
    pull(&mut bench);
    assert_eq!(place(&bench, "plate"), at);
    click(&mut bench, "Unlock plate");
    choose(&mut bench, &["plate"]);
    pull(&mut bench);
    assert!(place(&bench, "plate").x > at.x + 0.5);
}

#[test]
fn components_are_added_to_and_removed_from_all_that_is_chosen() {
    let mut bench = open();
    let before = text(&mut bench);
    choose(&mut bench, &["plate", "bowl"]);
    menu(&mut bench, "Add component", "Velocity");
    let moves = |bench: &Bench, name: &str| {
        let world = &scene(bench).world;
        world.has::<Velocity>(world.find(name).unwrap())
    };
    assert_eq!(errors(&bench), [""; 0]);
    assert_eq!(chosen(&bench), ["plate", "bowl"]);
    assert!(moves(&bench, "plate") && moves(&bench, "bowl"));
    assert_eq!(steps(&bench), ["Add Velocity to 2 entities"]);
    back_and_again(&mut bench, &before);
    let added = text(&mut bench);
    click(&mut bench, "Remove MeshRenderer");
    let world = &scene(&bench).world;
    let drawn = |name: &str| world.has::<MeshRenderer>(world.find(name).unwrap());
    assert!(!drawn("plate") && !drawn("bowl") && drawn("cup"));
    back_and_again(&mut bench, &added);
    reload(&mut bench, ROOM);
    assert!(moves(&bench, "plate"));
    assert_eq!(steps(&bench)[1], "Remove MeshRenderer from 2 entities");
}

#[test]
fn a_field_that_all_have_is_changed_for_all_as_one_step() {
    let mut bench = open();
    let before = text(&mut bench);
    choose(&mut bench, &["lamp", "bulb"]);
    assert!(bench.count("differs") >= 2, "intensity and range differ");
    let differ = bench.count("differs");
    let field = bench
        .harness
        .get_by_role_and_label(Role::SpinButton, "Intensity");
    field.scroll_to_me();
    bench.harness.run_steps(3);
    type_into(&mut bench, Role::SpinButton, "Intensity", "33");
    let power = |bench: &Bench, name: &str| {
        let world = &scene(bench).world;
        let light: Light = world.get(world.find(name).unwrap()).unwrap();
        light.intensity
    };
    assert_eq!(power(&bench, "lamp"), 33.0);
    assert_eq!(power(&bench, "bulb"), 33.0);
    assert_eq!(bench.count("differs"), differ - 1);
    assert_eq!(steps(&bench), ["light.intensity of 2 entities"]);
    back_and_again(&mut bench, &before);
    // Both are given back at once.
    click(&mut bench, "Reset entity");
    assert_eq!(text(&mut bench), before);

    // Of a place the parts that were not changed stay each one's own.
    choose(&mut bench, &["plate", "bowl"]);
    assert_eq!(bench.count("Intensity"), 0);
    let workbench = &bench.harness.state().workbench;
    assert_eq!(workbench.selection.len(), 2);
    let at = [place(&bench, "plate"), place(&bench, "bowl")];
    let first = bench
        .harness
        .query_all_by_role_and_label(Role::SpinButton, "Translation")
        .next();
    first.unwrap().scroll_to_me();
    bench.harness.run_steps(3);
    let fields = bench
        .harness
        .query_all_by_role_and_label(Role::SpinButton, "Translation");
    let y = fields.map(|node| node.rect()).nth(1).unwrap().center();
    bench.click_at(y);
    bench.harness.run_steps(2);
    key(&mut bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text("2.5".to_owned()));
    bench.harness.run_steps(1);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    let now = [place(&bench, "plate"), place(&bench, "bowl")];
    for (at, now) in at.iter().zip(now) {
        assert_eq!(now, Vec3::new(at.x, 2.5, at.z));
    }
}

#[test]
fn a_saved_scene_has_all_that_was_changed_and_reset_all_takes_it_back() {
    let mut bench = open();
    let before = text(&mut bench);
    menu(&mut bench, "Entity", "Create cone");
    choose(&mut bench, &["cup"]);
    key(&mut bench, Key::Delete, Modifiers::NONE);
    click(&mut bench, "Lock bowl");
    let lines = bench.harness.state().workbench.overlay_lines();
    assert!(lines.contains("entity(\"cup\").remove();"), "{lines}");
    let now = text(&mut bench);

    key(&mut bench, Key::S, Modifiers::COMMAND);
    type_into(&mut bench, Role::TextInput, "Save the scene as", "kept");
    assert_eq!(bench.count("Save the scene as"), 0, "the window is gone");
    let saved = bench.files.read_text("scripts/scenes/kept.scene").unwrap();
    assert_eq!(saved, now);
    let (nothing, progress) = (Settings::new(), Progress::new());
    let path = "scripts/scenes/kept.scene";
    let loaded = load_scene(&bench.files, path, &nothing, &progress).unwrap();
    assert!(loaded.world.find("cone").is_some() && loaded.world.find("cup").is_none());
    let bowl = loaded.world.find("bowl").unwrap();
    assert!(loaded.world.tags().contains("locked", bowl));

    // The lines do the same at the end of the script.
    let (_folder, files) = {
        let folder = tempfile::tempdir().unwrap();
        let scenes = folder.path().join("scripts/scenes");
        std::fs::create_dir_all(&scenes).unwrap();
        std::fs::write(scenes.join("room.rhai"), format!("{ROOM}\n{lines}")).unwrap();
        let files = lightbench::assets::files::Files::with_project(folder.path()).unwrap();
        (folder, files)
    };
    let again = load_scene(&files, "room", &nothing, &progress).unwrap();
    assert!(again.world.find("cone").is_some() && again.world.find("cup").is_none());

    click(&mut bench, "Reset all");
    assert_eq!(text(&mut bench), before);
    assert_eq!(bench.count("No field is changed by hand"), 1);
    key(&mut bench, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&mut bench), now);
}
