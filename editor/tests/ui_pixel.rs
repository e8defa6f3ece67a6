//! One pixel with the editor's widgets: its light, lamp by lamp, and the same under another pipeline.
#![allow(clippy::unwrap_used)]

mod ui_support;

use egui::Pos2;
use egui_kittest::kittest::Queryable as _;
use lightbench::world::Light;
use lightbench::world::glam::DVec3;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::beside::Results;
use lightbench_editor::ui::workbench::lighting::Lit;

use ui_support::Bench;

/// On a wall of the box, and on its floor.
const PLACES: [Pos2; 2] = [Pos2::new(400.0, 270.0), Pos2::new(570.0, 575.0)];

fn probe(bench: &mut Bench, at: Pos2) -> Results {
    bench.click_at(at);
    bench.until("the values", |editor| {
        !editor.workbench.probing.is_waiting() && !editor.workbench.probing.values.is_empty()
    });
    bench.harness.state().workbench.probing.results
}

fn lit(bench: &mut Bench) -> Lit {
    bench.until("the light", |editor| {
        !editor.workbench.lighting.is_waiting() && editor.workbench.lit().is_some()
    });
    bench.harness.state().workbench.lit().unwrap().clone()
}

fn light_of(results: Results) -> DVec3 {
    let [r, g, b, _] = results.hdr.unwrap().map(f64::from);
    DVec3::new(r, g, b)
}

#[test]
fn the_lamps_of_a_pixel_add_up_to_what_the_pipeline_draws() {
    let mut bench = Bench::open();
    bench.choose("Pipeline", "Forward, single pass");
    bench.until("the pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
            && editor.workbench.picture_is_current()
    });
    probe(&mut bench, PLACES[0]);
    bench.show(Panel::Pixel);
    bench.harness.get_by_label("Light by light").click();
    for place in PLACES {
        let drawn = light_of(probe(&mut bench, place));
        let lit = lit(&mut bench);
        assert!(lit.meets && lit.lamps.len() > 2, "{lit:?}");
        let sum: DVec3 = lit.lamps.iter().map(|lamp| lamp.radiance).sum();
        assert!((sum + lit.emitted + lit.sky - lit.sum).abs().max_element() < 1e-9);
        // Half floats keep 11 bits, and the shader adds single floats.
        let apart = (drawn - lit.sum).abs().max_element() / lit.sum.max_element();
        assert!(apart < 1e-3, "{drawn} and {}", lit.sum);
        bench.harness.run_steps(3);
        assert_eq!(bench.count("The pipeline's light is"), 1);
        // The one that adds most is the first.
        let luminance = |lamp: DVec3| lamp.dot(DVec3::new(0.2126, 0.7152, 0.0722));
        let values: Vec<f64> = lit
            .lamps
            .iter()
            .map(|lamp| luminance(lamp.radiance))
            .collect();
        assert!(values.is_sorted_by(|a, b| a >= b));
    }

    // Without its strongest lamp the pixel is darker by that lamp's share.
    let before = lit(&mut bench);
    let strongest = before
        .lamps
        .iter()
        .find(|lamp| lamp.kind != "ambient")
        .unwrap()
        .clone();
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene_mut().unwrap();
    let mut light: Light = scene.world.get(strongest.entity).unwrap();
    light.intensity = 0.0;
    scene.world.set(strongest.entity, light).unwrap();
    workbench.clock.refresh();
    bench.picture();
    let darker = light_of(probe(&mut bench, PLACES[1]));
    let wanted = before.sum - strongest.radiance;
    let apart = (darker - wanted).abs().max_element() / before.sum.max_element();
    assert!(apart < 1e-3, "{darker} and {wanted}");
}

#[test]
fn another_pipeline_is_drawn_once_for_the_pixel_and_not_shown() {
    let mut bench = Bench::open();
    let here = probe(&mut bench, PLACES[0]);
    let picture = bench.picture();
    bench.show(Panel::Pixel);
    bench.choose("Compare with", "Forward, single pass");
    bench.until("the other pipeline", |editor| {
        let workbench = &editor.workbench;
        assert_eq!(workbench.pipelines.shown(), Some("deferred_shading"));
        assert_eq!(workbench.beside.problem, None);
        workbench.pixel_beside().is_some()
    });
    let there = bench.harness.state().workbench.pixel_beside().unwrap();
    assert_eq!(bench.picture(), picture, "the picture on screen stays");
    let now = &bench.harness.state().workbench.probing;
    assert_eq!(now.results, here, "and so does what was read of it");
    bench.harness.run_steps(3);
    assert_eq!(bench.count("Difference"), 1);

    // Each click asks the other pipeline too.
    let here = probe(&mut bench, PLACES[1]);
    bench.until("the other pixel", |editor| {
        editor.workbench.pixel_beside().is_some()
    });
    let second = bench.harness.state().workbench.pixel_beside().unwrap();
    assert_ne!(second, there);
    let apart = (light_of(second) - light_of(here)).abs().max_element();
    assert!(
        apart < 0.02 * light_of(here).max_element(),
        "the same light by another way"
    );

    // It is what that pipeline draws when it is shown.
    bench.harness.state_mut().workbench.put_beside(None);
    bench.choose("Pipeline", "Forward, single pass");
    bench.until("the pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
            && editor.workbench.picture_is_current()
    });
    assert_eq!(probe(&mut bench, PLACES[1]), second);
}

/// The answer to an earlier click, which is on its way, is not taken for that of the last one.
#[test]
fn quick_clicks_are_answered_for_the_last_pixel() {
    let mut bench = Bench::open();
    let picture = bench.picture();
    for round in 0..4 {
        for place in [PLACES[round % 2], PLACES[(round + 1) % 2]] {
            bench.click_at(place);
        }
        bench.until("the values", |editor| {
            !editor.workbench.probing.is_waiting() && !editor.workbench.probing.values.is_empty()
        });
        let workbench = &bench.harness.state().workbench;
        let (x, y) = workbench.probing.pixel.unwrap();
        let (width, _) = workbench.drawn_size().unwrap();
        let texel = &picture[((y * width + x) * 4) as usize..][..4];
        let output = workbench.probing.results.output.unwrap();
        let said = output.map(|value| (value * 255.0).round() as u8);
        assert_eq!(said, texel);
    }
}

/// Lists of lights that grow: what is read is what is drawn with room for all.
#[test]
fn a_pipeline_whose_buffers_grow_is_read_when_they_have() {
    let mut bench = Bench::open();
    bench
        .harness
        .state_mut()
        .workbench
        .select_scene("many_lights");
    bench.until("the scene", |editor| {
        editor.workbench.scenes.shown() == Some("many_lights")
            && editor.workbench.picture_is_current()
    });
    bench.harness.state_mut().workbench.clock.playing = false;
    bench.picture();
    bench.show(Panel::Pixel);
    bench
        .harness
        .state_mut()
        .workbench
        .put_beside(Some("clustered_forward"));
    let here = probe(&mut bench, PLACES[1]);
    bench.until("the other pipeline", |editor| {
        assert_eq!(editor.workbench.beside.problem, None);
        editor.workbench.pixel_beside().is_some()
    });
    let there = bench.harness.state().workbench.pixel_beside().unwrap();
    let apart = (light_of(there) - light_of(here)).abs().max_element();
    assert!(apart < 0.02 * light_of(here).max_element().max(0.01));
}

/// A pipeline with a mistake says so, and the one on screen goes on.
#[test]
fn a_mistake_in_the_other_pipeline_is_told() {
    let mut bench = Bench::open();
    bench.save(
        "scripts/pipelines/broken.rhai",
        "let p = pipeline(\"Broken\");\np.show(\"none\");\np",
    );
    let here = probe(&mut bench, PLACES[0]);
    bench
        .harness
        .state_mut()
        .workbench
        .put_beside(Some("broken"));
    bench.until("the mistake", |editor| {
        editor.workbench.beside.problem.is_some()
    });
    let workbench = &bench.harness.state().workbench;
    let problem = workbench.beside.problem.clone().unwrap();
    assert!(problem.contains("broken.rhai:2"), "{problem}");
    assert!(!workbench.beside.is_waiting());
    assert_eq!(workbench.probing.results, here);
    assert!(!Bench::has_problems(bench.harness.state()));
}
