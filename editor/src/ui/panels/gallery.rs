//! The window with scenes, pipelines and examples.

use egui::{
    Align, Align2, Color32, Context, CornerRadius, FontId, Layout, Pos2, Rect, RichText,
    ScrollArea, Sense, Stroke, StrokeKind, TextEdit, TextWrapMode, Ui, Window, vec2,
};

use crate::ui::editor::Editor;
use crate::ui::gallery::cards::{Card, Opens, Shelf};
use crate::ui::gallery::thumbnails::State;
use crate::ui::messages::say;

/// Points of a picture.
const PICTURE: egui::Vec2 = vec2(224.0, 126.0);

/// Points of a card.
const CARD: egui::Vec2 = vec2(PICTURE.x + 12.0, PICTURE.y + 92.0);

/// What somebody wants of a card.
enum Wish {
    Open(Card),
    Edit(Card),
    Lesson(String),
}

/// Draws the window while it is open, and does what was chosen.
pub fn show(editor: &mut Editor, ctx: &Context) {
    editor.tend_gallery(ctx);
    if !editor.gallery.is_open {
        return;
    }
    let mut open = true;
    let mut wish = None;
    Window::new(say!("gallery.gallery"))
        .open(&mut open)
        .collapsible(false)
        .default_size([780.0, 560.0])
        .pivot(Align2::CENTER_CENTER)
        .default_pos(ctx.content_rect().center())
        .show(ctx, |ui| wish = contents(editor, ui));
    editor.gallery.is_open = open;
    match wish {
        Some(Wish::Open(card)) => {
            editor.gallery.is_open = false;
            open_card(editor, &card);
        }
        Some(Wish::Edit(card)) => edit_card(editor, &card),
        Some(Wish::Lesson(name)) => {
            editor.gallery.is_open = false;
            editor.open_lesson(&name);
        }
        None => {}
    }
}

fn open_card(editor: &mut Editor, card: &Card) {
    match card.opens {
        Opens::Scene => editor.open_scene(&card.name),
        Opens::Pipeline => editor.workbench.select_pipeline(&card.name),
        Opens::Script => editor.open_code(&card.path, None),
    }
}

/// Opens a card with its text; one that is shipped is copied first.
fn edit_card(editor: &mut Editor, card: &Card) {
    if card.is_own || editor.copy_into_project(&card.path) {
        editor.gallery.is_open = false;
        open_card(editor, card);
        editor.open_code(&card.path, None);
    }
}

fn contents(editor: &mut Editor, ui: &mut Ui) -> Option<Wish> {
    ui.horizontal(|ui| {
        for shelf in Shelf::ALL {
            let chosen = editor.gallery.shelf == shelf;
            if ui.selectable_label(chosen, shelf.title()).clicked() {
                editor.gallery.shelf = shelf;
            }
        }
        ui.separator();
        let label = ui.label(say!("gallery.search"));
        let field = TextEdit::singleline(&mut editor.gallery.filter).desired_width(160.0);
        ui.add(field).labelled_by(label.id);
    });
    if editor.gallery.shelf == Shelf::Pipelines {
        ui.weak(say!("gallery.all_draw_the_same_picture_these"));
    }
    ui.separator();
    if editor.gallery.shelf == Shelf::Lessons {
        return super::lesson::shelf::show(editor, ui).map(Wish::Lesson);
    }
    let cards = editor.gallery.shown();
    if cards.is_empty() {
        ui.weak(say!("gallery.nothing_is_called_so"));
    }
    let has_project = editor.workbench.files().project().is_some();
    let columns = (ui.available_width() / (CARD.x + 8.0)).floor().max(1.0) as usize;
    let rows = cards.len().div_ceil(columns);
    let mut wish = None;
    ScrollArea::vertical()
        .auto_shrink(false)
        .show_rows(ui, CARD.y, rows, |ui, range| {
            for row in range {
                ui.horizontal(|ui| {
                    for card in cards.iter().skip(row * columns).take(columns) {
                        ui.push_id(&card.path, |ui| {
                            wish = wish.take().or(one(editor, ui, card, has_project));
                        });
                    }
                });
            }
        });
    wish
}

fn one(editor: &mut Editor, ui: &mut Ui, card: &Card, has_project: bool) -> Option<Wish> {
    let mut wish = None;
    let (rect, _) = ui.allocate_exact_size(CARD, Sense::hover());
    let below = Layout::top_down(Align::Min);
    let card_area = egui::UiBuilder::new().max_rect(rect).layout(below);
    let mut ui = ui.new_child(card_area.id_salt("card"));
    ui.set_clip_rect(rect.intersect(ui.clip_rect()));
    ui.spacing_mut().item_spacing.y = 3.0;
    let (place, picture) = ui.allocate_exact_size(PICTURE, Sense::click());
    picture.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &card.title));
    paint(editor, &ui, card, place);
    if picture.hovered() {
        let line = Stroke::new(2.0, ui.visuals().hyperlink_color);
        ui.painter()
            .rect_stroke(place, CornerRadius::same(3), line, StrokeKind::Inside);
    }
    if picture.on_hover_text(&card.path).clicked() {
        wish = Some(Wish::Open(card.clone()));
    }
    ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
    ui.label(RichText::new(&card.title).strong());
    ui.style_mut().wrap_mode = Some(TextWrapMode::Wrap);
    let about = egui::Rect::from_min_size(ui.cursor().min, vec2(PICTURE.x, 44.0));
    let mut text = ui.new_child(egui::UiBuilder::new().max_rect(about).id_salt("about"));
    text.set_clip_rect(about.intersect(ui.clip_rect()));
    text.label(RichText::new(&card.about).small().weak())
        .on_hover_text(&card.about);
    ui.advance_cursor_after_rect(about);
    let button = if card.is_own {
        ui.small_button(say!("gallery.edit"))
    } else {
        let button = egui::Button::new(say!("gallery.copy_into_the_project")).small();
        let about = say!("gallery.open_a_project_first_file_open");
        ui.add_enabled(has_project, button)
            .on_disabled_hover_text(about)
    };
    if button.clicked() {
        wish = Some(Wish::Edit(card.clone()));
    }
    wish
}

/// The picture, or what stands in its place.
fn paint(editor: &mut Editor, ui: &Ui, card: &Card, place: Rect) {
    let painter = ui.painter();
    painter.rect_filled(place, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    let note = |text: &str| {
        let color = ui.visuals().weak_text_color();
        let font = FontId::proportional(12.0);
        let galley = painter.layout(text.to_owned(), font, color, place.width() - 16.0);
        let at = Align2::CENTER_CENTER.anchor_size(place.center(), galley.size());
        painter.with_clip_rect(place).galley(at.min, galley, color);
    };
    match editor.gallery.thumbnails.of(ui.ctx(), card) {
        State::There(texture) => {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            painter.image(texture.id(), place, whole, Color32::WHITE);
        }
        State::None(why) => note(why.lines().next().unwrap_or_default()),
        State::Waiting | State::Drawn(_) => note(say!("gallery.is_being_drawn")),
    }
}
