//! Lines over the picture, favourites, steps of time and curves of frames with the editor's widgets.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use lightbench::render::readback::read_bytes;
use lightbench::world::glam::Vec3;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::lens::Lens;
use lightbench_editor::ui::workbench::trends::Trend;
use lightbench_editor::ui::workbench::viewports::Viewport;

use ui_support::Bench;

/// One box and a wall before part of it, as the camera sees them.
const BOXES: &str = r#"
spawn("box").mesh(box(2)).at(0, 0, 0);
spawn("wall").mesh(box(2)).at(2, 0, 3);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

fn open_boxes(bench: &mut Bench) {
    bench.save("scripts/scenes/boxes.rhai", BOXES);
    bench.harness.state_mut().workbench.select_scene("boxes");
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        editor.workbench.scenes.shown() == Some("boxes") && !editor.workbench.scenes.is_busy()
    });
    bench.harness.run_steps(2);
}

fn menu(bench: &mut Bench, title: &str, entry: &str) {
    let title = bench.harness.get_by_role_and_label(Role::Button, title);
    title.click();
    bench.harness.run_steps(3);
    bench
        .harness
        .get_by(|node| {
            node.role() == Role::Button
                && node.label().is_some_and(|label| label.starts_with(entry))
        })
        .click();
    bench.harness.run_steps(3);
}

/// The lines over the picture: places in pixels and colours, where there are any.
fn lines(bench: &mut Bench) -> Vec<(f32, f32, [u8; 4])> {
    bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    let Some(texture) = workbench.lines_picture(Viewport::First) else {
        return Vec::new();
    };
    let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
    let width = texture.width() as usize;
    let texels = bytes.chunks(4).enumerate();
    texels
        .filter(|(_, texel)| texel[3] > 0)
        .map(|(index, texel)| {
            let (x, y) = (index % width, index / width);
            let color = [texel[0], texel[1], texel[2], texel[3]];
            (x as f32 + 0.5, y as f32 + 0.5, color)
        })
        .collect()
}

fn distance(at: egui::Pos2, [from, to]: [egui::Pos2; 2]) -> f32 {
    let along = to - from;
    let share = ((at - from).dot(along) / along.length_sq().max(1e-9)).clamp(0.0, 1.0);
    at.distance(from + along * share)
}

#[test]
fn edges_are_where_the_lens_puts_them_and_what_is_behind_is_hidden() {
    let mut bench = Bench::open();
    open_boxes(&mut bench);
    let plain = bench.picture();
    assert!(lines(&mut bench).is_empty());
    menu(&mut bench, "View", "Wireframe");
    let all = lines(&mut bench);
    assert!(all.len() > 500, "{} pixels", all.len());
    assert_eq!(
        bench.picture(),
        plain,
        "the pipeline's picture has no lines in it"
    );

    let (size, lens) = {
        let workbench = &bench.harness.state().workbench;
        let (width, height) = workbench.drawn_size().unwrap();
        let size = egui::vec2(width as f32, height as f32);
        let rect = egui::Rect::from_min_size(egui::Pos2::ZERO, size);
        (size, Lens::new(rect, workbench.camera.view()))
    };
    assert!(size.x > 100.0);
    // All edges of both boxes, with the diagonals of their faces, which are cut into two triangles
    // either way.
    let mut edges = Vec::new();
    for center in [Vec3::ZERO, Vec3::new(2.0, 0.0, 3.0)] {
        let corners: Vec<Vec3> = (0..8)
            .map(|bits: u32| {
                let side = |bit: u32| if bits >> bit & 1 == 1 { 1.0 } else { -1.0 };
                center + Vec3::new(side(0), side(1), side(2))
            })
            .collect();
        for (index, a) in corners.iter().enumerate() {
            for b in &corners[index + 1..] {
                let apart = (*a - *b).length_squared();
                if apart < 8.1 {
                    edges.extend(lens.line(*a, *b));
                }
            }
        }
    }
    for (x, y, _) in &all {
        let at = egui::pos2(*x, *y);
        let nearest = edges.iter().map(|edge| distance(at, *edge));
        let nearest = nearest.fold(f32::INFINITY, f32::min);
        assert!(nearest < 1.5, "{at:?} is {nearest} pixels from an edge");
    }

    // Of the box alone there are fewer, and none where the wall is before it.
    menu(&mut bench, "View", "Lines of what is chosen alone");
    assert!(lines(&mut bench).is_empty(), "nothing is chosen");
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let chosen = scene.world.find("box").unwrap();
    workbench.selection.set(scene, [chosen]);
    bench.harness.run_steps(2);
    let of_box = lines(&mut bench);
    assert!(of_box.len() > 100 && of_box.len() < all.len());
    let wall = [(-1.0, -1.0), (1.0, 1.0)].map(|(x, y)| {
        let corner = Vec3::new(2.0 + x, y, 4.0);
        lens.point(corner).unwrap()
    });
    let wall = egui::Rect::from_two_pos(wall[0], wall[1]).shrink(2.0);
    let hidden = of_box
        .iter()
        .filter(|(x, y, _)| wall.contains(egui::pos2(*x, *y)));
    assert_eq!(hidden.count(), 0);

    // Normals have a colour of their own. Those of the front go towards the eye.
    menu(&mut bench, "View", "Wireframe");
    menu(&mut bench, "View", "Vertex normals");
    let normals = lines(&mut bench);
    assert!(!normals.is_empty());
    let edge_color = of_box[0].2;
    assert!(normals.iter().all(|(_, _, color)| *color != edge_color));
    menu(&mut bench, "View", "Vertex normals");
    assert!(lines(&mut bench).is_empty());
}

#[test]
fn number_keys_choose_favourites_that_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("editor.json");
    let mut bench = Bench::open_with(Some(path.clone()));
    bench.show(Panel::Pipelines);
    assert!(
        bench.count("Geometry is drawn once into a G-buffer; then each light adds its share") > 0
    );
    let key = "Key of Forward, single pass";
    let node = bench.harness.get_by_role_and_label(Role::ComboBox, key);
    node.scroll_to_me();
    bench.harness.run_steps(8);
    bench.choose(key, "3");
    bench.harness.hover_at(egui::pos2(3.0, 3.0));
    bench.harness.run_steps(2);
    bench.harness.key_press(Key::Num3);
    bench.until("the favourite", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
    // The key is said where pipelines are chosen, and it has no other one.
    let favourites = bench.harness.state().kept.favourites.clone();
    assert_eq!(
        favourites.into_iter().collect::<Vec<_>>(),
        [(3, "forward_single_pass".to_owned())]
    );
    bench.harness.key_press(Key::Num4);
    bench.until("the fourth of the list", |editor| {
        editor.workbench.pipelines.shown() == Some("deferred_shading")
    });
    bench.harness.key_press(Key::Num6);
    bench.harness.run_steps(3);
    let selected = bench
        .harness
        .state()
        .workbench
        .pipelines
        .selected()
        .to_owned();
    assert_eq!(
        selected, "deferred_shading",
        "the sixth has another key now"
    );

    drop(bench);
    let mut bench = Bench::open_with(Some(path));
    bench.harness.key_press(Key::Num3);
    bench.until("the favourite after a restart", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
}

#[test]
fn the_step_of_time_is_the_chosen_one() {
    let mut bench = Bench::open();
    let before = bench.harness.state().workbench.clock.time();
    bench.choose("Steps", "1/30 s");
    let press = |bench: &mut Bench| {
        bench
            .harness
            .get_by_role_and_label(Role::Button, "Step")
            .click();
        bench.harness.run_steps(2);
    };
    press(&mut bench);
    press(&mut bench);
    let time = bench.harness.state().workbench.clock.time();
    assert!((time - before - 2.0 / 30.0).abs() < 1e-9, "{time}");
    // A scene that moves sees nothing but steps of that length.
    bench.save(
        "scripts/scenes/steps.rhai",
        "state.wrong = 0; state.steps = 0;
        camera(\"eye\").at(0, 1, 5).look_at(0, 0, 0);
        fn update(time, dt) {
            if dt > 0 && abs(dt - 1.0 / 120.0) > 1e-9 { state.wrong += 1; }
            if dt > 0 { state.steps += 1; }
            plot(\"wrong\", state.wrong);
            plot(\"steps\", state.steps);
        }",
    );
    bench.choose("Steps", "1/120 s");
    bench.harness.state_mut().workbench.select_scene("steps");
    bench.until("some steps", |editor| {
        let scenes = &editor.workbench.scenes;
        assert!(
            !Bench::has_problems(editor),
            "{:?}",
            editor.workbench.problems().next()
        );
        let plots = scenes.scene().map_or_else(Vec::new, |scene| scene.plots());
        let has_run = |values: &std::collections::VecDeque<(f64, f64)>| values.len() > 40;
        scenes.shown() == Some("steps") && plots.iter().any(|plot| has_run(&plot.values))
    });
    let workbench = &bench.harness.state().workbench;
    let plots = workbench.scenes.scene().unwrap().plots();
    let values = |name: &str| &plots.iter().find(|plot| plot.name == name).unwrap().values;
    assert_eq!(values("wrong").back().unwrap().1, 0.0);
    // From the first step that the curve has: it begins anew where the file is read again.
    let steps = values("steps");
    let (first, last) = (steps.front().unwrap(), steps.back().unwrap());
    let passed = (last.0 - first.0) * 120.0;
    assert!(passed > 20.0, "{passed}");
    assert!(
        (last.1 - first.1 - passed).abs() < 1e-6,
        "{first:?} {last:?}"
    );
}

#[test]
fn curves_of_frames_are_what_the_frames_cost() {
    let mut bench = Bench::open();
    bench.show(Panel::Plots);
    bench.harness.get_by_label("Lights and objects").click();
    for _ in 0..3 {
        bench.harness.state_mut().workbench.clock.step();
        bench.picture();
    }
    bench.harness.run_steps(3);
    let curves = bench
        .harness
        .query_all_by_role_and_label(Role::Image, "Curves");
    assert_eq!(curves.count(), 1);
    bench.until("the GPU's times", |editor| {
        let curves = editor.workbench.trends.curves(Trend::Passes);
        !curves.is_empty()
    });
    let workbench = &mut bench.harness.state_mut().workbench;
    let last = |workbench: &lightbench_editor::ui::workbench::Workbench, trend, name: &str| {
        let curves = workbench.trends.curves(trend).iter();
        let curve = curves.clone().find(|curve| curve.name == name).unwrap();
        curve.values.back().unwrap().1
    };
    let statistics = workbench.statistics().clone();
    assert!(statistics.lights > 0);
    assert_eq!(
        last(workbench, Trend::Lights, "lights"),
        f64::from(statistics.lights)
    );
    assert_eq!(
        last(workbench, Trend::Lights, "objects"),
        f64::from(statistics.objects)
    );
    let memory = last(workbench, Trend::Memory, "targets and buffers");
    assert_eq!(memory, statistics.target_bytes as f64 / 1e6);
    let names: Vec<String> = {
        let passes = &workbench.pipelines.shown_pipeline().unwrap().desc.passes;
        passes.iter().map(|pass| pass.name.clone()).collect()
    };
    let curves: Vec<String> = workbench
        .trends
        .curves(Trend::Passes)
        .iter()
        .map(|curve| curve.name.clone())
        .collect();
    assert_eq!(curves, names);
    let passes: f64 = names
        .iter()
        .map(|name| last(workbench, Trend::Passes, name))
        .sum();
    let frame = last(workbench, Trend::Frames, "GPU");
    assert!(
        passes > 0.0 && passes <= frame * 1.001 + 0.01,
        "{passes} of {frame}"
    );
    bench.harness.get_by_label("Clear").click();
    bench.harness.run_steps(2);
    assert!(
        bench
            .harness
            .state()
            .workbench
            .trends
            .curves(Trend::Lights)
            .is_empty()
    );
}
