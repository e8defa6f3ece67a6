//! The pictures of the editor's chapter: each panel with something in it.
//!
//! `LIGHTBENCH_UPDATE=1` (`./x docs`) draws them anew. Otherwise it is held that each panel has its picture,
//! and that the chapter shows it. They are not compared: times stand in them.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::{Path, PathBuf};

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::world::glam::Vec2;
use lightbench::world::{Entity, Name};
use lightbench_editor::ui::layout::{self, Panel};

use ui_support::{Bench, CTRL};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/panels")
}

fn file_name(panel: Panel) -> String {
    format!("{panel:?}.png").to_lowercase()
}

#[test]
fn every_panel_has_a_picture_that_the_chapter_shows() {
    let chapter = folder().parent().unwrap().join("editor.md");
    let chapter = std::fs::read_to_string(chapter).unwrap();
    if std::env::var_os("LIGHTBENCH_UPDATE").is_some() {
        draw_all();
    }
    for panel in Panel::ALL {
        let name = file_name(panel);
        let picture = image::open(folder().join(&name)).unwrap();
        assert!(picture.width() > 300 && picture.height() > 200, "{name}");
        let shown = format!("](panels/{name})");
        assert!(chapter.contains(&shown), "the chapter has no {shown}");
    }
}

fn draw_all() {
    std::fs::create_dir_all(folder()).unwrap();
    let project = tempfile::tempdir().unwrap();
    let mut bench = Bench::open_project_of("atrium", project, None);
    for panel in Panel::ALL {
        let at_side = match panel {
            Panel::Viewport => Panel::Log,
            other => other,
        };
        bench.harness.state_mut().lay_out(layout::beside(at_side));
        bench.harness.run_steps(3);
        bench.picture();
        fill(&mut bench, panel);
        bench.picture();
        bench.harness.run_steps(8);
        let whole = bench.harness.render().unwrap();
        let rect = bench.harness.state().rect_of(panel).unwrap();
        let part = image::imageops::crop_imm(
            &whole,
            rect.left().round() as u32,
            rect.top().round() as u32,
            rect.width().round() as u32,
            rect.height().round() as u32,
        );
        part.to_image()
            .save(folder().join(file_name(panel)))
            .unwrap();
    }
}

/// Chooses the first entity whose name begins so.
fn choose(bench: &mut Bench, name: &str) {
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let is_called = |entity: &Entity| {
        let found: Option<Name> = scene.world.get(*entity);
        found.is_some_and(|found| found.text.starts_with(name))
    };
    let entity = scene.world.entities().find(is_called).unwrap();
    workbench.selection.set(scene, [entity]);
    bench.harness.run_steps(3);
}

fn middle(bench: &Bench) -> egui::Pos2 {
    let rect = bench.harness.state().rect_of(Panel::Viewport).unwrap();
    rect.lerp_inside([0.4, 0.6])
}

/// Does something that the panel shows.
fn fill(bench: &mut Bench, panel: Panel) {
    match panel {
        Panel::Entities | Panel::Scene | Panel::Viewport => choose(bench, "lamp "),
        Panel::History | Panel::Actions => {
            choose(bench, "lamp ");
            for key in [Key::H, Key::H] {
                bench.key(Modifiers::NONE, key);
            }
            bench.key(CTRL, Key::D);
        }
        Panel::Targets => bench.choose("Target", "g_albedo"),
        Panel::Pixel => {
            let at = middle(bench);
            bench.click_at(at);
            bench.until("the values", |editor| {
                !editor.workbench.probing.is_waiting()
                    && !editor.workbench.probing.values.is_empty()
            });
        }
        Panel::Passes => bench.harness.run_steps(20),
        Panel::Console => {
            let line = bench.harness.get_by_label("Line");
            line.focus();
            bench.harness.run_steps(2);
            bench.type_text("entity(\"lamp 1\").intensity");
        }
        Panel::Plots => {
            bench.harness.get_by_label("Passes, ms").click();
            for _ in 0..30 {
                let workbench = &mut bench.harness.state_mut().workbench;
                workbench.camera.orbit(Vec2::new(0.01, 0.0));
                bench.picture();
            }
        }
        Panel::Notebook => {
            bench.key(CTRL, Key::K);
            bench.until("the entry", |editor| {
                !editor.workbench.notebook.entries().is_empty()
            });
        }
        Panel::Compare => {
            bench.key(Modifiers::NONE, Key::C);
            bench.until("the difference", |editor| {
                editor.workbench.judgement().is_some()
            });
        }
        Panel::Materials => {
            bench.harness.get_by_label("red plaster").click();
            bench.harness.run_steps(20);
        }
        Panel::Code => bench.key(CTRL, Key::E),
        Panel::Lesson => bench.harness.state_mut().open_lesson("1"),
        _ => {}
    }
}
