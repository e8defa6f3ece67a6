//! The ball of the material that is edited, through any pipeline.

use egui::{Color32, Label, Pos2, Rect, RichText, Sense, Ui, vec2};
use lightbench::assets::MaterialId;
use lightbench::script::Settings;

use super::Wish;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::widgets::combo_of;
use crate::ui::pictures::{Order, Subject, Through};

/// Points of the picture's sides.
pub(super) const SIDE: f32 = 160.0;

/// Draws the ball and the choice of a pipeline.
pub(super) fn show(
    editor: &mut Editor,
    ui: &mut Ui,
    id: Option<MaterialId>,
    wish: &mut Option<Wish>,
) {
    ui.set_width(SIDE);
    let (rect, image) = ui.allocate_exact_size(vec2(SIDE, SIDE), Sense::hover());
    image.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Image, true, say!("materials.preview"))
    });
    ui.painter()
        .rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    let scene = editor.workbench.scenes.scene();
    let subject = match (scene, id) {
        (Some(scene), Some(id)) => Subject::material(&scene.assets, id),
        _ => None,
    };
    if let Some(subject) = subject {
        let scale = ui.pixels_per_point();
        let order = Order {
            subject,
            through: through(editor),
            side: (SIDE * scale).round() as u32,
        };
        let preview = editor.pictures.large(ui.ctx(), order);
        if let Some(texture) = preview.texture {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            // One of the state before is there until the next one is.
            ui.painter()
                .image(texture.id(), rect, whole, Color32::WHITE);
        }
        if let Some(why) = preview.problem {
            let first = why.lines().next().unwrap_or_default().to_owned();
            let color = ui.visuals().error_fg_color;
            ui.label(RichText::new(first).small().color(color))
                .on_hover_text(why);
        } else if !preview.is_current && preview.texture.is_none() {
            // In the picture's place, so that nothing moves when it comes.
            let words = RichText::new(say!("materials.is_being_drawn")).small();
            ui.put(rect, Label::new(words.weak()));
        }
    }
    choice(editor, ui, wish);
}

/// The pipeline of the ball, with the values that its parameters have in the editor.
fn through(editor: &Editor) -> Through {
    let pipelines = &editor.workbench.pipelines;
    let pipeline = match &editor.materials.pipeline {
        Some(name) => name.clone(),
        None => pipelines.selected().to_owned(),
    };
    let slot = pipelines.slot(&pipeline);
    Through {
        settings: slot.map_or_else(Settings::new, |slot| slot.settings.clone()),
        pipeline,
    }
}

fn choice(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let now = &editor.materials.pipeline;
    let library = &editor.workbench.library;
    let on_screen = say!("materials.on_screen");
    let title = match now {
        Some(name) => library.pipeline_title(name),
        None => on_screen,
    };
    let mut wanted = now.clone();
    let label = say!("materials.preview_through");
    combo_of(ui, label, title, SIDE - 10.0, |ui| {
        ui.selectable_value(&mut wanted, None, on_screen);
        for pipeline in &library.pipelines {
            let name = Some(pipeline.name.clone());
            ui.selectable_value(&mut wanted, name, &pipeline.title);
        }
    });
    if wanted != *now {
        *wish = Some(Wish::Through(wanted));
    }
}
