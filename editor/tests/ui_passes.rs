//! The frame pass by pass with the editor's widgets: the graph, the walk, targets and their numbers.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::collections::BTreeSet;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::render::readback::read_bytes;
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::workbench::stepping::Stopped;

use ui_support::Bench;

/// Two passes, of which nobody uses what the first writes.
const WITH_A_SPARE: &str = r#"
let p = pipeline("With a spare pass");
p.target("spare", "rgba8unorm");
p.target("shown", "rgba8unorm");
p.clear("unused").writes("spare").clear(1, 0, 0, 1);
p.clear("used").writes("shown").clear(0, 0, 1, 1);
p.show("shown");
p
"#;

fn click(bench: &mut Bench, label: &str) {
    bench.harness.get_by_label(label).click();
    bench.harness.run_steps(3);
}

fn stopped(bench: &mut Bench) -> Option<Stopped> {
    bench.harness.state_mut().workbench.stopped()
}

/// What stands in the picture's place, once it is that of the present state.
fn stopped_bytes(bench: &mut Bench) -> Vec<u8> {
    bench.picture();
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.stopped_picture().unwrap();
    read_bytes(workbench.gpu(), &texture).unwrap()
}

#[test]
fn the_graph_shows_what_is_clicked_in_targets() {
    let mut bench = Bench::open();
    click(&mut bench, "Graph");
    click(&mut bench, "Fit");
    let desc = {
        let workbench = &mut bench.harness.state_mut().workbench;
        workbench.pipelines.shown_pipeline().unwrap().desc.clone()
    };
    for pass in &desc.passes {
        assert!(
            bench.count(&format!("Pass {}", pass.name)) > 0,
            "{}",
            pass.name
        );
    }
    for target in &desc.targets {
        let used = bench.count(&format!("Target {}", target.name));
        assert!(used > 0, "{}", target.name);
    }
    let index = |name: &str| desc.passes.iter().position(|pass| pass.name == name);

    click(&mut bench, "Pass lights");
    let request = bench.harness.state_mut().workbench.inspection().unwrap();
    assert_eq!(
        (Some(request.pass), request.target.as_str()),
        (index("lights"), "hdr")
    );

    // A target is shown as its last writer leaves it, although later passes may use its texture.
    click(&mut bench, "Target g_albedo");
    let request = bench.harness.state_mut().workbench.inspection().unwrap();
    let wanted = (index("g_buffer"), "g_albedo");
    assert_eq!((Some(request.pass), request.target.as_str()), wanted);
    bench.picture();
    bench.harness.run_steps(2);
    let workbench = &mut bench.harness.state_mut().workbench;
    let texture = workbench.inspected().unwrap();
    let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
    // The room's red, green and white paint, and more.
    let colors: BTreeSet<&[u8]> = bytes.chunks(4).collect();
    assert!(colors.len() >= 4);
    // The panel follows: its combo boxes say the same.
    let target = bench
        .harness
        .get_by_role_and_label(Role::ComboBox, "Target");
    assert_eq!(target.value().as_deref(), Some("g_albedo"));
}

#[test]
fn passes_that_nobody_uses_are_shown_as_left_out() {
    let mut bench = Bench::open();
    bench.save("scripts/pipelines/spare.rhai", WITH_A_SPARE);
    bench.harness.state_mut().workbench.select_pipeline("spare");
    bench.until("the pipeline", |editor| {
        assert!(
            !Bench::has_problems(editor),
            "{:?}",
            editor.workbench.problems().next()
        );
        editor.workbench.pipelines.shown() == Some("spare")
    });
    click(&mut bench, "Graph");
    std::thread::sleep(std::time::Duration::from_millis(300));
    bench.picture();
    bench.harness.run_steps(3);
    assert_eq!(bench.count("Pass unused, left out"), 1);
    assert_eq!(bench.count("Pass used, left out"), 0);
    // To be looked at it runs after all, and what it leaves is shown.
    bench.harness.state_mut().workbench.stop_after(Some(0));
    let bytes = stopped_bytes(&mut bench);
    assert!(bytes.chunks(4).all(|texel| texel == [255, 0, 0, 255]));
    assert!(stopped(&mut bench).unwrap().is_left_out);
}

#[test]
fn keys_walk_through_the_frame_and_end_at_the_picture() {
    let mut bench = Bench::open();
    let picture = bench.picture();
    let names: Vec<String> = {
        let workbench = &mut bench.harness.state_mut().workbench;
        let passes = &workbench.pipelines.shown_pipeline().unwrap().desc.passes;
        passes.iter().map(|pass| pass.name.clone()).collect()
    };
    let press = |bench: &mut Bench, key| {
        bench.harness.key_press_modifiers(Modifiers::COMMAND, key);
        bench.harness.run_steps(2);
    };
    let mut pictures: Vec<Vec<u8>> = Vec::new();
    for (index, name) in names.iter().enumerate() {
        press(&mut bench, Key::CloseBracket);
        let stop = stopped(&mut bench).unwrap();
        assert_eq!((stop.index, &stop.pass), (index, name));
        pictures.push(stopped_bytes(&mut bench));
        bench.harness.run_steps(2);
        let title = format!("After pass {} of {}: {name}", index + 1, names.len());
        assert_eq!(bench.count(&title), 1, "{title}");
    }
    // After the last pass it is the picture itself, bit for bit; before it was something else.
    assert_eq!(pictures.last().unwrap(), &picture);
    let at = |name: &str| names.iter().position(|known| known == name).unwrap();
    assert_ne!(pictures[at("g_buffer")], pictures[at("lights")]);
    assert_ne!(pictures[at("lights")], picture);
    // The pipeline itself goes on drawing all of its frame.
    assert_eq!(bench.picture(), picture);

    press(&mut bench, Key::OpenBracket);
    assert_eq!(stopped(&mut bench).unwrap().index, names.len() - 2);
    click(&mut bench, "Whole frame");
    assert_eq!(stopped(&mut bench), None);
    assert_eq!(bench.count("Whole frame"), 0);
    // From the whole frame back to the last pass; Escape ends it too.
    press(&mut bench, Key::OpenBracket);
    assert_eq!(stopped(&mut bench).unwrap().index, names.len() - 1);
    bench.harness.key_press(Key::Escape);
    bench.harness.run_steps(2);
    assert_eq!(stopped(&mut bench), None);
}

#[test]
fn the_walk_shows_each_target_of_a_pass_and_goes_on_in_another_pipeline() {
    let mut bench = Bench::open();
    bench.harness.state_mut().workbench.stop_after(Some(0));
    bench.harness.run_steps(3);
    let first = stopped(&mut bench).unwrap();
    assert_eq!(first.pass, "g_buffer");
    assert!(first.targets.len() > 2);
    let albedo = stopped_bytes(&mut bench);
    let other = first.targets[1].clone();
    bench.choose("Of", &other);
    assert_eq!(stopped(&mut bench).unwrap().shown.unwrap().0, other);
    assert_ne!(stopped_bytes(&mut bench), albedo);

    // The slider goes to any pass.
    let slider = bench.harness.get_by_role_and_label(Role::Slider, "Pass");
    slider.focus();
    bench.harness.run_steps(2);
    bench.harness.key_press(Key::ArrowRight);
    bench.harness.run_steps(3);
    assert_eq!(stopped(&mut bench).unwrap().index, 1);

    // A pass of the same name is the place in another pipeline; without one it is the whole frame.
    bench
        .harness
        .state_mut()
        .workbench
        .stop_after(Some(first.count - 1));
    let last = stopped(&mut bench).unwrap().pass;
    bench.choose("Pipeline", "Forward, single pass");
    bench.until("the other pipeline", |editor| {
        editor.workbench.pipelines.shown() == Some("forward_single_pass")
    });
    bench.picture();
    assert_eq!(stopped(&mut bench).unwrap().pass, last);
    bench.choose("Pipeline", "Deferred shading");
    bench.until("deferred shading", |editor| {
        editor.workbench.pipelines.shown() == Some("deferred_shading")
    });
    bench.harness.state_mut().workbench.stop_after(Some(0));
    bench.harness.run_steps(2);
    bench.choose("Pipeline", "Forward, single pass");
    bench.picture();
    bench.harness.run_steps(2);
    assert_eq!(stopped(&mut bench), None);
}

/// A half float (IEEE 754-2019, binary16) as a number.
fn half(bits: u16) -> f64 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    match exponent {
        0 => sign * fraction * 2_f64.powi(-24),
        31 if fraction == 0.0 => sign * f64::INFINITY,
        31 => f64::NAN,
        _ => sign * (1.0 + fraction / 1024.0) * 2_f64.powi(exponent - 15),
    }
}

/// The range follows the values, and what the GPU counted is what the texels say that are read here.
#[test]
fn the_range_and_the_histogram_are_those_of_the_texels() {
    let mut bench = Bench::open();
    bench.choose("Target", "hdr");
    click(&mut bench, "Automatic");
    click(&mut bench, "Histogram");
    bench.until("the measured range", |editor| {
        let workbench = &mut editor.workbench;
        let settled = !workbench.measuring.is_waiting() && workbench.picture_is_current();
        let now = workbench.inspection();
        let measured = workbench.measured();
        settled && measured.is_some_and(|measured| Some(&measured.request) == now.as_ref())
    });
    let workbench = &mut bench.harness.state_mut().workbench;
    let request = workbench.inspection().unwrap();
    let measured = workbench.measured().unwrap().clone();
    let texture = workbench.target_texture("hdr").unwrap();
    assert_eq!(texture.format(), wgpu::TextureFormat::Rgba16Float);
    let bytes = read_bytes(workbench.gpu(), &texture).unwrap();
    let values: Vec<f64> = bytes
        .chunks(2)
        .map(|pair| half(u16::from_le_bytes([pair[0], pair[1]])))
        .collect();
    let channel = |channel: usize| values.iter().skip(channel).step_by(4).copied();
    let colors = || (0..3).flat_map(channel);
    let least = colors().fold(f64::INFINITY, f64::min);
    let most = colors().fold(f64::NEG_INFINITY, f64::max);
    assert!(most > 1.0, "light is more than a picture shows");
    assert_eq!(f64::from(request.low), least);
    assert_eq!(f64::from(request.high), most);
    for (index, counted) in measured.shown() {
        let texels = channel(index).count() as u32;
        assert_eq!((counted.finite, counted.invalid), (texels, 0));
        assert_eq!((counted.below, counted.above), (0, 0));
        assert_eq!(counted.bins.iter().sum::<u32>(), texels);
        // Values next to an edge between two bins may be rounded to either.
        let mut bins = vec![0_u32; counted.bins.len()];
        for value in channel(index) {
            let place = (value - least) / (most - least) * bins.len() as f64;
            let bin = (place as usize).min(bins.len() - 1);
            bins[bin] += 1;
        }
        let apart: u32 = bins
            .iter()
            .zip(&counted.bins)
            .map(|(a, b)| a.abs_diff(*b))
            .sum();
        assert!(
            apart * 500 < texels,
            "{apart} of {texels} are in another bin"
        );
    }
    bench.harness.run_steps(2);
    assert_eq!(
        bench
            .harness
            .query_all_by_role_and_label(Role::Image, "Histogram")
            .count(),
        1
    );
    let said = format!("least {least:.5}  greatest {most:.5}");
    assert_eq!(bench.count(&said), 1, "{said}");
    // Who sets an end does not want it to move.
    click(&mut bench, "Suit");
    assert!(!bench.harness.state().workbench.measuring.automatic);
    let request = bench.harness.state_mut().workbench.inspection().unwrap();
    assert_eq!((request.low, request.high), (0.0, 1.0));
}

#[test]
fn depth_is_measured_in_metres() {
    let mut bench = Bench::open();
    bench.choose("Target", "depth");
    click(&mut bench, "Automatic");
    bench.until("the measured range", |editor| {
        !editor.workbench.measuring.is_waiting() && editor.workbench.measured().is_some()
    });
    let workbench = &mut bench.harness.state_mut().workbench;
    let [nearest, farthest] = workbench.measured().unwrap().range().unwrap();
    // From the opening of the box, 8 m before the camera, to its back wall, 5.592 m behind that.
    let eye = workbench.camera.view().position();
    let wall = 5.592 - eye.z;
    assert!(
        (farthest - wall).abs() < 2e-3 * wall,
        "{farthest} and {wall}"
    );
    assert!(nearest > -eye.z - 0.1 && nearest < wall, "{nearest}");
    assert!(bench.harness.state().workbench.probing.values.is_empty());
    bench.show(Panel::Targets);
}
