//! Materials that are made, changed, given to entities and deleted through the widgets, and the ball on
//! which one is seen.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::assets::{Material, Progress, Reflection};
use lightbench::script::overlays::Who;
use lightbench::script::{Scene, Settings, load_scene};
use lightbench::world::glam::Vec3;
use lightbench::world::{Camera, Light, LightKind, MeshRenderer};
use lightbench_editor::ui::layout::Panel;

use ui_support::Bench;

/// Two things of clay and one of steel. It stands still.
const ROOM: &str = r#"
let clay = material("clay").color(0.5, 0.25, 0.125);
spawn("cup").mesh(sphere(1)).material(clay).at(-1.5, 0, 0);
spawn("jug").mesh(sphere(0.8)).material(clay).at(0.5, 0, 0);
spawn("pan").mesh(sphere(0.6)).material(material("steel").color(0.125, 0.125, 0.125).ggx(0.25)).at(2, 0, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

const FILE: &str = "scripts/scenes/room.rhai";

fn open_with(script: &str) -> Bench {
    let mut bench = Bench::open();
    bench.save(FILE, script);
    bench.harness.state_mut().workbench.select_scene("room");
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some("room") && !editor.workbench.scenes.is_busy()
    });
    // High enough for all rows.
    bench.harness.set_size(egui::vec2(1300.0, 1700.0));
    calm(&mut bench);
    bench.show(Panel::Materials);
    bench
}

fn open() -> Bench {
    open_with(ROOM)
}

/// A file that was just written is told of once more.
fn calm(bench: &mut Bench) {
    for _ in 0..50 {
        bench.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    // Words of what is still done move what stands below them.
    bench.until("rest", |editor| {
        !editor.workbench.scenes.is_busy() && !editor.workbench.library.is_busy()
    });
    bench.harness.run_steps(2);
}

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

fn text(bench: &mut Bench) -> String {
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.scenes.scene_mut().unwrap().to_text().unwrap()
}

fn material_of(scene: &Scene, name: &str) -> Option<Material> {
    let who = Who {
        name: name.to_owned(),
        nth: 0,
    };
    let id = scene.find_material(&who)?;
    scene.assets.material(id).cloned()
}

fn material(bench: &Bench, name: &str) -> Material {
    material_of(scene(bench), name).unwrap()
}

/// What an entity is drawn with.
fn worn(bench: &Bench, entity: &str) -> String {
    let scene = scene(bench);
    let entity = scene.world.find(entity).unwrap();
    let renderer: MeshRenderer = scene.world.get(entity).unwrap();
    let material = scene.assets.material(renderer.material).unwrap();
    material.name.clone()
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

/// Clicks with keys held.
fn click_with(bench: &mut Bench, label: &str, modifiers: Modifiers) {
    bench.harness.event(Event::ModifiersChanged(modifiers));
    bench.harness.step();
    let node = bench.harness.get_by_role_and_label(Role::Button, label);
    let at = node.rect().center();
    bench.harness.hover_at(at);
    bench.harness.step();
    for pressed in [true, false] {
        bench.harness.event(Event::PointerButton {
            pos: at,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers,
        });
        bench.harness.step();
    }
    bench
        .harness
        .event(Event::ModifiersChanged(Modifiers::NONE));
    bench.harness.run_steps(3);
}

fn key(bench: &mut Bench, key: Key, modifiers: Modifiers) {
    bench.harness.key_press_modifiers(modifiers, key);
    bench.harness.run_steps(3);
}

/// Types over what stands in one of the fields of a label, counted from 0.
fn type_into(bench: &mut Bench, role: Role, label: &str, nth: usize, typed: &str) {
    let node = bench
        .harness
        .get_all_by_role_and_label(role, label)
        .nth(nth);
    node.unwrap().scroll_to_me();
    // What is far away glides for a while.
    bench.harness.run_steps(40);
    let node = bench
        .harness
        .get_all_by_role_and_label(role, label)
        .nth(nth);
    node.unwrap().click();
    bench.harness.run_steps(2);
    key(bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text(typed.to_owned()));
    bench.harness.run_steps(1);
    key(bench, Key::Enter, Modifiers::NONE);
}

/// Types over the number that stands beside a slider.
fn type_beside(bench: &mut Bench, label: &str, typed: &str) {
    // The panel Pipeline may have the same one, before it.
    let find = |bench: &Bench| {
        let all = bench.harness.get_all_by_role_and_label(Role::Slider, label);
        all.map(|node| node.rect())
            .max_by(|a, b| a.top().total_cmp(&b.top()))
            .unwrap()
    };
    let all = bench.harness.get_all_by_role_and_label(Role::Slider, label);
    all.for_each(|node| node.scroll_to_me());
    bench.harness.run_steps(4);
    let rail = find(bench);
    bench.click_at(egui::pos2(rail.right() + 24.0, rail.center().y));
    bench.harness.run_steps(2);
    key(bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text(typed.to_owned()));
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

/// What can be taken back, but for the first step, which opened the scene.
fn steps(bench: &Bench) -> Vec<String> {
    let undo = &bench.harness.state().workbench.undo;
    let steps = undo.done().iter().skip(1);
    steps.map(|step| step.what.clone()).collect()
}

fn take_all_back(bench: &mut Bench) {
    while !steps(bench).is_empty() && bench.harness.state_mut().workbench.undo() {}
}

#[test]
fn a_material_is_made_named_given_to_what_is_chosen_saved_and_read() {
    let mut bench = open();
    let before = text(&mut bench);
    let first = bench.picture();
    click(&mut bench, "New material");
    back_and_again(&mut bench, &before);
    let made = text(&mut bench);
    assert!(made.contains("material \"material\""), "{made}");
    // What was gone is not chosen when it comes back.
    click(&mut bench, "material");
    type_into(&mut bench, Role::TextInput, "Material's name", 0, "gold");
    back_and_again(&mut bench, &made);
    click(&mut bench, "gold");
    type_into(&mut bench, Role::SpinButton, "Color", 0, "0.75");
    assert_eq!(
        material(&bench, "gold").base_color,
        Vec3::new(0.75, 0.5, 0.5)
    );
    bench.choose_entities(&["cup", "pan"]);
    click(&mut bench, "Give to what is chosen");
    assert_eq!(
        (worn(&bench, "cup"), worn(&bench, "pan")),
        ("gold".into(), "gold".into())
    );
    assert_eq!(worn(&bench, "jug"), "clay");
    bench.until_picture_is_not(&first);
    assert_eq!(
        steps(&bench),
        [
            "Create material material",
            "Rename material material to gold",
            "color of material gold",
            "Material gold for 2 entities",
        ]
    );
    // It lies over the script that was saved anew, and goes into a file.
    let saved = text(&mut bench);
    reload(&mut bench, &ROOM.replace("at(2, 0, 0)", "at(2, 1, 0)"));
    assert_eq!(worn(&bench, "pan"), "gold");
    assert_eq!(material(&bench, "gold").base_color.x, 0.75);
    reload(&mut bench, ROOM);
    assert_eq!(text(&mut bench), saved);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.save_scene("kept").unwrap();
    let (settings, progress) = (Settings::new(), Progress::new());
    let path = "scripts/scenes/kept.scene";
    let mut read = load_scene(&bench.files, path, &settings, &progress).unwrap();
    assert_eq!(read.to_text().unwrap(), saved);
    assert_eq!(material_of(&read, "gold").unwrap().base_color.x, 0.75);
    for _ in 0..4 {
        key(&mut bench, Key::Z, Modifiers::COMMAND);
    }
    assert_eq!(text(&mut bench), before);
}

#[test]
fn every_value_is_changed_marked_and_reset() {
    let mut bench = open();
    let before = text(&mut bench);
    let script = material(&bench, "clay");
    click(&mut bench, "clay");
    type_into(&mut bench, Role::SpinButton, "Specular", 1, "0.5");
    assert_eq!(material(&bench, "clay").specular.y, 0.5);
    type_into(&mut bench, Role::SpinButton, "Emissive", 2, "3");
    assert_eq!(material(&bench, "clay").emissive.z, 3.0);
    type_beside(&mut bench, "Opacity", "0.25");
    assert_eq!(material(&bench, "clay").opacity, 0.25);
    // Beyond the range it is the end of it.
    type_beside(&mut bench, "Power", "5000");
    let sharpest = Reflection::BlinnPhong { power: 1448.0 };
    assert_eq!(material(&bench, "clay").reflection, sharpest);
    bench.choose("Model", "Ward, anisotropic");
    type_beside(&mut bench, "Along", "0.5");
    let Reflection::Ward { along, across } = material(&bench, "clay").reflection else {
        panic!("{:?}", material(&bench, "clay").reflection);
    };
    assert_eq!(along, 0.5);
    assert!(
        (across - (2.0_f32 / 1450.0).sqrt()).abs() < 1e-6,
        "{across}"
    );
    for label in ["Cutoff", "Two-sided"] {
        let node = bench.harness.get_by_role_and_label(Role::CheckBox, label);
        node.click();
        bench.harness.run_steps(3);
    }
    type_beside(&mut bench, "Cutoff", "0.75");
    let clay = material(&bench, "clay");
    assert_eq!((clay.alpha_cutoff, clay.two_sided), (Some(0.75), true));
    assert_eq!(bench.count("Changed by hand. The script's value"), 6);
    let changed = text(&mut bench);
    // All again after a load, and back one by one.
    reload(&mut bench, ROOM);
    assert_eq!(text(&mut bench), changed);
    for field in [
        "Specular",
        "Emissive",
        "Opacity",
        "Model",
        "Cutoff",
        "Two-sided",
    ] {
        click(&mut bench, &format!("Reset {field}"));
    }
    assert_eq!(material(&bench, "clay"), script);
    assert_eq!(text(&mut bench), before);
    assert_eq!(bench.count("Changed by hand. The script's value"), 0);
    // A reset gives way to what the script says then.
    reload(
        &mut bench,
        &ROOM.replace("0.5, 0.25, 0.125", "0.75, 0.25, 0.125"),
    );
    assert_eq!(material(&bench, "clay").base_color.x, 0.75);
    reload(&mut bench, ROOM);
    take_all_back(&mut bench);
    assert_eq!(text(&mut bench), before);
}

#[test]
fn a_drag_over_several_materials_is_one_step_and_leaves_other_channels_alone() {
    let mut bench = open();
    let before = text(&mut bench);
    click(&mut bench, "steel");
    click_with(&mut bench, "clay", Modifiers::COMMAND);
    assert_eq!(bench.count("2 materials are chosen"), 1);
    assert!(bench.count("differs") >= 2, "color and model");
    let field = bench
        .harness
        .get_all_by_role_and_label(Role::SpinButton, "Color");
    let at = field.collect::<Vec<_>>()[1].rect().center();
    bench.harness.hover_at(at);
    bench.harness.step();
    bench.harness.drag_at(at);
    bench.harness.step();
    for step in 1..=8 {
        bench
            .harness
            .hover_at(at + egui::vec2(4.0 * step as f32, 0.0));
        bench.harness.step();
    }
    bench.harness.drop_at(at + egui::vec2(32.0, 0.0));
    bench.harness.run_steps(3);
    let (clay, steel) = (material(&bench, "clay"), material(&bench, "steel"));
    assert!(clay.base_color.y > 0.3, "{:?}", clay.base_color);
    assert_eq!(steel.base_color.y, clay.base_color.y);
    assert_eq!((clay.base_color.x, steel.base_color.x), (0.5, 0.125));
    assert_eq!(steps(&bench), ["color of 2 materials"]);
    let edits = bench.harness.state().workbench.overlays_now().unwrap();
    assert_eq!(edits.edits().len(), 1, "the way of the drag is not kept");
    back_and_again(&mut bench, &before);
}

#[test]
fn a_copy_is_apart_and_what_loses_its_material_gets_the_default_one() {
    let mut bench = open();
    click(&mut bench, "clay");
    click(&mut bench, "Duplicate material");
    type_into(&mut bench, Role::SpinButton, "Color", 0, "1");
    assert_eq!(
        material(&bench, "clay 2").base_color,
        Vec3::new(1.0, 0.25, 0.125)
    );
    assert_eq!(material(&bench, "clay").base_color.x, 0.5);
    let before = text(&mut bench);
    click(&mut bench, "clay");
    click(&mut bench, "Choose its entities");
    assert_eq!(bench.harness.state().workbench.selection.len(), 2);
    click(&mut bench, "Delete material");
    assert_eq!(
        (worn(&bench, "cup"), worn(&bench, "jug")),
        ("default".into(), "default".into())
    );
    assert_eq!(bench.count("Choose a material to change it"), 1);
    back_and_again(&mut bench, &before);
    // A name that another one has is refused, and said.
    click(&mut bench, "steel");
    type_into(&mut bench, Role::TextInput, "Material's name", 0, "clay 2");
    assert_eq!(bench.count("Another material is called `clay 2`"), 1);
    assert_eq!(worn(&bench, "pan"), "steel");
}

#[test]
fn a_picture_of_a_file_becomes_the_texture_and_is_copied_into_the_project() {
    let mut bench = open();
    let before = text(&mut bench);
    let elsewhere = tempfile::tempdir().unwrap();
    let file = elsewhere.path().join("stripes.png");
    let pixels: Vec<u8> = (0..64)
        .flat_map(|i| {
            if i % 8 < 4 {
                [255, 0, 0, 255]
            } else {
                [0, 0, 255, 255]
            }
        })
        .collect();
    let bytes = lightbench::assets::images::encode_png("stripes", 8, 8, &pixels).unwrap();
    std::fs::write(&file, bytes).unwrap();
    let shown = bench.picture();
    click(&mut bench, "clay");
    click(&mut bench, "Texture from a file");
    key(&mut bench, Key::A, Modifiers::COMMAND);
    bench.harness.event(Event::Text(file.display().to_string()));
    bench.harness.run_steps(2);
    key(&mut bench, Key::Enter, Modifiers::NONE);
    assert!(bench.path().join("textures/stripes.png").is_file());
    let id = material(&bench, "clay").base_color_texture.unwrap();
    let texture = scene(&bench).assets.texture(id).unwrap();
    assert_eq!((texture.width, texture.height), (8, 8));
    bench.until_picture_is_not(&shown);
    assert!(text(&mut bench).contains("picture(\"textures/stripes.png\")"));
    back_and_again(&mut bench, &before);
    // The other material can be given it, and this one another.
    click(&mut bench, "steel");
    // What was scrolled to comes to rest.
    bench.harness.run_steps(40);
    bench.choose("Texture", "stripes.png");
    bench.harness.run_steps(3);
    assert_eq!(material(&bench, "steel").base_color_texture, Some(id));
    bench.choose("Texture", "none");
    assert_eq!(material(&bench, "steel").base_color_texture, None);
}

#[test]
fn the_ball_follows_changes_and_pipelines_and_is_not_drawn_for_nothing() {
    let mut bench = open();
    let drawn = |bench: &Bench| bench.harness.state().pictures.drawn();
    let settle = |bench: &mut Bench| {
        bench.until("the ball", |editor| !editor.pictures.is_busy());
        bench.harness.run_steps(3);
    };
    click(&mut bench, "clay");
    settle(&mut bench);
    assert_eq!(drawn(&bench), 1);
    // Nothing changes: nothing is drawn, while frames and time go by.
    for _ in 0..60 {
        bench.harness.step();
    }
    std::thread::sleep(std::time::Duration::from_millis(200));
    settle(&mut bench);
    assert_eq!(drawn(&bench), 1);
    let image = |bench: &mut Bench| {
        let node = bench
            .harness
            .get_by_role_and_label(Role::Image, "Preview of the material");
        let rect = node.rect();
        let picture = bench.harness.render().unwrap();
        let mean = |from: egui::Pos2, side: u32| {
            let mut sum = [0_u32; 3];
            for y in 0..side {
                for x in 0..side {
                    let pixel = picture.get_pixel(from.x as u32 + x, from.y as u32 + y);
                    for (sum, channel) in sum.iter_mut().zip(pixel.0) {
                        *sum += u32::from(channel);
                    }
                }
            }
            sum.map(|sum| sum / (side * side))
        };
        mean(rect.center() - egui::vec2(8.0, 8.0), 16)
    };
    let clay = image(&mut bench);
    assert!(clay[0] > clay[2] + 20, "clay is reddish: {clay:?}");
    type_into(&mut bench, Role::SpinButton, "Color", 2, "1");
    type_into(&mut bench, Role::SpinButton, "Color", 0, "0");
    settle(&mut bench);
    let blue = image(&mut bench);
    assert!(blue[2] > blue[0] + 40, "it is blue now: {blue:?}");
    assert!((2..=3).contains(&drawn(&bench)));
    // A name is not seen.
    let before = drawn(&bench);
    type_into(&mut bench, Role::TextInput, "Material's name", 0, "paint");
    settle(&mut bench);
    assert_eq!(drawn(&bench), before);
    // Other pipelines draw the same ball, those on screen stay.
    let shown = bench.shown();
    for (count, pipeline) in ["Forward, single pass", "Visibility buffer"]
        .into_iter()
        .enumerate()
    {
        bench.choose("Pipeline of the preview", pipeline);
        settle(&mut bench);
        assert_eq!(drawn(&bench), before + 1 + count as u64, "{pipeline}");
        let other = image(&mut bench);
        let far = other.iter().zip(blue).map(|(a, b)| a.abs_diff(b)).max();
        assert!(far < Some(6), "{pipeline}: {other:?} instead of {blue:?}");
    }
    assert_eq!(bench.shown(), shown);
}

#[test]
fn the_inspector_offers_meshes_and_materials_for_all_that_is_chosen() {
    let mut bench = open();
    bench.show(Panel::Entities);
    bench.choose_entities(&["cup", "jug"]);
    let before = text(&mut bench);
    bench.choose("Material", "steel");
    assert_eq!(
        (worn(&bench, "cup"), worn(&bench, "jug")),
        ("steel".into(), "steel".into())
    );
    back_and_again(&mut bench, &before);
    let dressed = text(&mut bench);
    let mesh = |bench: &Bench, name: &str| {
        let scene = scene(bench);
        let entity = scene.world.find(name).unwrap();
        scene.world.get::<MeshRenderer>(entity).unwrap().mesh
    };
    bench.choose("Mesh", "sphere (3)");
    assert_eq!(mesh(&bench, "cup"), mesh(&bench, "pan"));
    assert_eq!(mesh(&bench, "jug"), mesh(&bench, "pan"));
    back_and_again(&mut bench, &dressed);
    click(&mut bench, "Back to the script's mesh");
    click(&mut bench, "Back to the script's material");
    assert_eq!(text(&mut bench), before);
}

#[test]
fn the_environment_is_changed_with_units_reset_and_taken_back() {
    let mut bench = open();
    bench.show(Panel::Environment);
    let before = text(&mut bench);
    let first = bench.picture();
    let camera = |bench: &Bench| {
        let scene = scene(bench);
        let eye = scene.world.find("eye").unwrap();
        scene.world.get::<Camera>(eye).unwrap()
    };
    type_into(&mut bench, Role::SpinButton, "Fov y", 0, "30");
    assert!((camera(&bench).fov_y - 30_f32.to_radians()).abs() < 1e-6);
    let near = bench.until_picture_is_not(&first);
    back_and_again(&mut bench, &before);
    click(&mut bench, "Reset");
    assert_eq!(text(&mut bench), before);
    assert_eq!(bench.until_picture_is_not(&near), first);
    // There is no light from everywhere; one is made.
    assert_eq!(bench.count("the sky is black"), 1);
    click(&mut bench, "Add ambient light");
    let world = &scene(&bench).world;
    let light: Light = world.get(world.find("ambient light").unwrap()).unwrap();
    assert_eq!((light.kind, light.intensity), (LightKind::Ambient, 1.0));
    let lit = bench.until_picture_is_not(&first);
    back_and_again(&mut bench, &before);
    type_into(&mut bench, Role::SpinButton, "Intensity", 0, "0.25");
    let dim = bench.until_picture_is_not(&lit);
    // The pipeline's exposure is a step too.
    type_beside(&mut bench, "Exposure", "2");
    let bright = bench.until_picture_is_not(&dim);
    assert!(
        bright.iter().map(|b| u64::from(*b)).sum::<u64>() > dim.iter().map(|b| u64::from(*b)).sum()
    );
    assert_eq!(steps(&bench).len(), 5);
    take_all_back(&mut bench);
    assert_eq!(text(&mut bench), before);
}

#[test]
fn a_scene_without_a_camera_gets_one_of_its_own() {
    let mut bench = open_with(&ROOM.replace("camera(\"eye\")", "//"));
    bench.show(Panel::Environment);
    assert_eq!(bench.count("The scene's script makes no camera"), 1);
    click(&mut bench, "Make a camera of the view");
    let made = scene(&bench).world.find("camera 2").is_some();
    assert!(made, "{:?}", steps(&bench));
}
