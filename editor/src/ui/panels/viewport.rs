//! The picture, the camera's controls, and what stands over the picture.

use std::time::Instant;

use egui::{
    Align2, Color32, CornerRadius, FontId, Id, Key, Margin, PointerButton, Pos2, Rect, Response,
    RichText, Sense, TextureOptions, Ui, vec2,
};
use lightbench::render::Problem;
use lightbench::script::SceneEvent;
use lightbench::world::glam::{Vec2, Vec3};

use super::handles::{self, Handles};
use super::marks::Mark;
use super::{compare, heat_map, marks, select, stepping, widgets};
use crate::ui::editor::Editor;
use crate::ui::layout::Panel;
use crate::ui::lens::Lens;
use crate::ui::messages::say;
use crate::ui::screen::Place;
use crate::ui::theme::Palette;

/// Radians that a drag over one point turns.
const TURN: f32 = 0.006;

/// Problems shown over the picture; all are in the log.
const MOST_PROBLEMS: usize = 4;

/// Draws the viewport.
pub fn show(editor: &mut Editor, ui: &mut Ui, now: Instant) {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Image, true, say!("viewport.viewport"))
    });
    let lens = Lens::new(rect, editor.workbench.camera.view());
    compare::interact(editor, ui, rect);
    let held =
        handles::interact(editor, ui, &response, &lens) || select_box(editor, ui, &response, &lens);
    if !held {
        steer(editor, ui, &response);
    }

    if let Some(at) = response
        .interact_pointer_pos()
        .filter(|_| response.clicked())
    {
        let more = ui.input(|input| input.modifiers.command);
        select::click(editor, &lens, at, more);
        probe(editor, rect, at);
        let share = (at - rect.min) / rect.size();
        editor
            .workbench
            .click([share.x, share.y], rect.aspect_ratio());
    }
    listen(editor, ui, &response);

    let pixels = rect.size() * ui.ctx().pixels_per_point();
    let size = (pixels.x.round() as u32, pixels.y.round() as u32);
    let over = editor.marks;
    let [edges, normals, alone] =
        [Mark::Edges, Mark::Normals, Mark::OfChosen].map(|mark| over.has(mark));
    editor.workbench.draw_lines(edges, normals, alone);
    let picture = editor.workbench.draw(size, now);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, CornerRadius::ZERO, ui.visuals().extreme_bg_color);
    let scale = picture.as_ref().map(|picture| picture.scale);
    if let Some(picture) = picture {
        // A smaller picture is stretched; one of the same size is shown texel for pixel.
        let options = TextureOptions::LINEAR;
        let id = editor
            .screen
            .show(Place::Viewport, &picture.texture, options);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        painter.image(id, rect, whole, Color32::WHITE);
    }
    stepping::show(editor, ui, rect);
    if let Some(lines) = editor.workbench.lines_picture() {
        let options = TextureOptions::LINEAR;
        let id = editor.screen.show(Place::Lines, &lines, options);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        painter.image(id, rect, whole, Color32::WHITE);
    }

    // The camera may have moved since.
    let lens = Lens::new(rect, editor.workbench.camera.view());
    marks::show(editor, ui, &lens);
    handles::show(editor, ui, &lens, response.hover_pos());
    if let Some(area) = editor.viewport.area {
        select::show(ui, &lens, area);
    }
    probed_pixel(editor, ui, rect);
    compare::over(editor, ui, rect);
    if let Some(pipeline) = editor.workbench.pipelines.shown_pipeline() {
        heat_map::legend(ui, rect, &pipeline.desc);
    }
    problems(editor, ui, rect);
    loading(editor, ui, rect, scale.is_some());
    if let Some(scale) = scale.filter(|scale| *scale < 1.0) {
        let text = say!(
            "viewport.resolution_while_moving",
            scale = format_args!("{:.0}", scale * 100.0)
        );
        note(ui, rect, Align2::RIGHT_TOP, &text);
    }
    if editor.hint && !editor.welcome {
        hint(editor, ui, rect);
    }
}

/// What the viewport remembers from frame to frame.
#[derive(Default)]
pub struct ViewportPanel {
    /// The box that is being drawn around what is to be chosen.
    area: Option<Rect>,
    /// The handles of what is chosen.
    pub handles: Handles,
}

/// Draws a box with Shift, and chooses what is in it. Returns whether it has the pointer.
fn select_box(editor: &mut Editor, ui: &Ui, response: &Response, lens: &Lens) -> bool {
    let (modifiers, origin) = ui.input(|input| (input.modifiers, input.pointer.press_origin()));
    if response.drag_started_by(PointerButton::Primary) && modifiers.shift {
        editor.viewport.area = origin.map(|at| Rect::from_two_pos(at, at));
    }
    let Some(area) = editor.viewport.area else {
        return false;
    };
    let corner = ui.input(|input| input.pointer.latest_pos());
    let area = match (origin, corner) {
        (Some(from), Some(to)) => Rect::from_two_pos(from, to),
        _ => area,
    };
    editor.viewport.area = Some(area);
    if !response.dragged_by(PointerButton::Primary) {
        editor.viewport.area = None;
        select::within(editor, lens, area, modifiers.command);
    }
    true
}

/// Asks what the passes do to the pixel under the pointer.
fn probe(editor: &mut Editor, rect: Rect, at: Pos2) {
    let Some((width, height)) = editor.workbench.drawn_size() else {
        return;
    };
    let share = (at - rect.min) / rect.size();
    let texel = |share: f32, length: u32| ((share * length as f32) as u32).min(length - 1);
    editor
        .workbench
        .probe((texel(share.x, width), texel(share.y, height)));
    editor.bring = Some(Panel::Pixel);
}

/// Marks the pixel that was asked for last.
fn probed_pixel(editor: &Editor, ui: &Ui, rect: Rect) {
    let workbench = &editor.workbench;
    let (Some((x, y)), Some((width, height))) = (workbench.probing.pixel, workbench.probing.size)
    else {
        return;
    };
    if workbench.pipelines.shown() != Some(workbench.probing.pipeline.as_str()) {
        return;
    }
    let share = vec2(
        (x as f32 + 0.5) / width as f32,
        (y as f32 + 0.5) / height as f32,
    );
    let center = rect.min + share * rect.size();
    let painter = ui.painter_at(rect);
    for (radius, color) in [(6.0, Color32::BLACK), (5.0, Color32::WHITE)] {
        painter.circle_stroke(center, radius, egui::Stroke::new(1.0, color));
    }
}

/// Keys and pointer to the scene's scripts, while the pointer is over the picture.
fn listen(editor: &mut Editor, ui: &Ui, response: &Response) {
    let workbench = &mut editor.workbench;
    let pointer = response.hover_pos().map(|at| {
        let share = (at - response.rect.min) / response.rect.size();
        [share.x, share.y]
    });
    let typing = ui.ctx().egui_wants_keyboard_input() || editor.viewport.handles.is_dragged();
    let away = pointer.is_none() || typing;
    workbench.scene_has_keys = !away && workbench.scene_wants_keys();
    if away {
        workbench.happen(SceneEvent::Leave);
        return;
    }
    workbench.happen(SceneEvent::Pointer(pointer));
    ui.input(|input| {
        for event in &input.events {
            if let egui::Event::Key {
                key,
                pressed,
                modifiers,
                ..
            } = event
                && !modifiers.command
            {
                let name = key.name().to_lowercase();
                workbench.happen(if *pressed {
                    SceneEvent::KeyDown(name)
                } else {
                    SceneEvent::KeyUp(name)
                });
            }
        }
    });
}

/// Mouse and keys to camera.
fn steer(editor: &mut Editor, ui: &Ui, response: &Response) {
    let camera = &mut editor.workbench.camera;
    let drag = response.drag_delta();
    let drag = Vec2::new(drag.x, drag.y);
    let height = response.rect.height().max(1.0);
    let shift = ui.input(|input| input.modifiers.shift);
    let control = ui.input(|input| input.modifiers.command);
    let by = |button| response.dragged_by(button) && drag != Vec2::ZERO;
    let is_flat = camera.flat().is_some();
    let turns = by(PointerButton::Primary) || by(PointerButton::Secondary);
    if by(PointerButton::Middle) || by(PointerButton::Primary) && control || is_flat && turns {
        camera.pan(drag / height);
    } else if by(PointerButton::Primary) {
        camera.orbit(-drag * TURN);
    } else if by(PointerButton::Secondary) {
        camera.look(-drag * TURN);
    }
    if !response.hovered() && !response.dragged() {
        return;
    }
    let (scroll, elapsed) = ui.input(|input| (input.smooth_scroll_delta().y, input.stable_dt));
    if scroll != 0.0 {
        camera.zoom(scroll / 40.0);
    }
    if ui.ctx().egui_wants_keyboard_input() || editor.workbench.scene_has_keys {
        return;
    }
    let direction = ui.input(|input| {
        if input.modifiers.command || input.modifiers.alt {
            return Vec3::ZERO;
        }
        let axis = |minus, plus| f32::from(input.key_down(plus)) - f32::from(input.key_down(minus));
        Vec3::new(
            axis(Key::A, Key::D),
            axis(Key::Q, Key::E),
            axis(Key::W, Key::S),
        )
    });
    if direction != Vec3::ZERO {
        let faster = if shift { 4.0 } else { 1.0 };
        // A frame that took long must not throw the camera far.
        editor
            .workbench
            .camera
            .fly(direction, elapsed.min(0.1) * faster);
        ui.ctx().request_repaint();
    }
}

/// The mistakes that keep the newest state off the screen, over the last good picture.
fn problems(editor: &mut Editor, ui: &mut Ui, rect: Rect) {
    let workbench = &editor.workbench;
    let count = workbench.problems().count();
    let mut wanted = None;
    if count == 0 {
        return;
    }
    let palette = Palette::of(ui);
    let frame = egui::Frame::new()
        .fill(palette.error_fill)
        .stroke(egui::Stroke::new(1.0, palette.error))
        .corner_radius(CornerRadius::same(4))
        .inner_margin(Margin::same(10));
    let area = Rect::from_min_max(rect.min + vec2(12.0, 12.0), rect.max - vec2(12.0, 12.0));
    let mut child = ui.new_child(egui::UiBuilder::new().max_rect(area).id_salt("problems"));
    child.set_clip_rect(rect);
    frame.show(&mut child, |ui| {
        ui.set_max_width(area.width().min(720.0));
        for (index, problem) in workbench.problems().take(MOST_PROBLEMS).enumerate() {
            if index > 0 {
                ui.separator();
            }
            if one_problem(ui, problem, palette) {
                wanted = Some(problem.place.clone());
            }
        }
        if count > MOST_PROBLEMS {
            ui.label(
                RichText::new(say!(
                    "viewport.more_in_the_log",
                    most_problems = count - MOST_PROBLEMS
                ))
                .weak(),
            );
        }
        if workbench.scenes.shown().is_some() && workbench.pipelines.shown().is_some() {
            ui.add_space(4.0);
            ui.label(RichText::new(say!("viewport.the_last_good_picture_stays_until")).weak());
        }
    });
    if let Some(place) = wanted {
        editor.go_to(&place);
    }
}

/// Returns whether somebody wants to see its place.
fn one_problem(ui: &mut Ui, problem: &Problem, palette: Palette) -> bool {
    let clicked = widgets::place(ui, &problem.place, palette.error);
    ui.label(&problem.message);
    if let Some(line) = &problem.source_line {
        let mut text = line.replace('\t', "    ");
        if problem.place.column > 0 {
            let before = line.chars().take(problem.place.column as usize - 1);
            let indent: usize = before.map(|c| if c == '\t' { 4 } else { 1 }).sum();
            text.push('\n');
            text.push_str(&" ".repeat(indent));
            text.push('^');
        }
        ui.label(RichText::new(text).monospace());
    }
    if let Some(hint) = &problem.hint {
        ui.label(RichText::new(hint).italics());
    }
    clicked
}

/// How far the next scene is, and that the first pipeline is built.
fn loading(editor: &Editor, ui: &mut Ui, rect: Rect, has_picture: bool) {
    let workbench = &editor.workbench;
    if let Some(state) = workbench.scenes.loading() {
        let text = match state.label.as_str() {
            "" => say!("viewport.loading", name = state.name),
            label => say!("viewport.loading_part", name = state.name, label = label),
        };
        let center = if has_picture {
            rect.center_top() + vec2(0.0, 26.0)
        } else {
            rect.center()
        };
        let place = Rect::from_center_size(center, vec2(rect.width().min(360.0), 20.0));
        let bar = egui::ProgressBar::new(state.fraction).text(text);
        ui.put(place, bar);
    } else if !has_picture && workbench.pipelines.is_busy() {
        note(
            ui,
            rect,
            Align2::CENTER_CENTER,
            say!("viewport.building_the_pipeline"),
        );
    }
}

/// A short line in a corner of the picture.
pub(super) fn note(ui: &Ui, rect: Rect, align: Align2, text: &str) {
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    let inner = rect.shrink(10.0);
    let galley = painter.layout_no_wrap(
        text.to_owned(),
        FontId::proportional(12.0),
        palette.note_text,
    );
    let place = align.anchor_size(align.pos_in_rect(&inner), galley.size());
    painter.rect_filled(place.expand2(vec2(7.0, 4.0)), 3.0, palette.note_fill);
    painter.galley(place.min, galley, palette.note_text);
}

/// What to try first.
fn hint(editor: &mut Editor, ui: &mut Ui, rect: Rect) {
    let palette = Palette::of(ui);
    let third = if editor.workbench.files().project().is_some() {
        say!("viewport.ctrl_e_in_a_project")
    } else {
        say!("viewport.ctrl_e_without_a_project")
    };
    let lines = [
        say!("viewport.drag_to_orbit_right_drag_to"),
        say!("viewport.click_to_choose_an_entity_and"),
        say!("viewport.keys_1_to_9_and_swap"),
        third,
    ];
    egui::Area::new(Id::unique("hint"))
        .constrain_to(rect)
        .pivot(Align2::LEFT_BOTTOM)
        .fixed_pos(rect.left_bottom() + vec2(12.0, -12.0))
        .show(ui.ctx(), |ui| {
            egui::Frame::new()
                .fill(palette.note_fill)
                .corner_radius(CornerRadius::same(4))
                .inner_margin(Margin::symmetric(12, 9))
                .show(ui, |ui| {
                    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
                    for line in lines {
                        ui.label(RichText::new(line).color(palette.note_text));
                    }
                    ui.add_space(2.0);
                    if ui.small_button(say!("viewport.got_it")).clicked() {
                        editor.hint = false;
                    }
                });
        });
}
