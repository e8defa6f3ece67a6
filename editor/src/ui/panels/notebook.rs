//! The laboratory notebook: what was measured and kept.

use egui::{
    Color32, ColorImage, Id, Image, Modal, RichText, ScrollArea, TextEdit, TextureHandle,
    TextureOptions, Ui, vec2,
};

use super::widgets::ms;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::notebook::{EXPORT, Entry, Kept, NOTEBOOK};

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct NotebookPanel {
    /// The note of the next entry.
    pub note: String,
    /// Notes of entries that are being changed, by their names.
    changing: Option<(String, String)>,
    /// The entry that somebody wants to delete, until it is confirmed.
    deleting: Option<String>,
    pictures: Vec<(String, TextureHandle)>,
}

/// What was asked for in a frame.
enum Wish {
    Keep,
    Export,
    Restore(String),
    Delete(String),
    SaveAgain(String),
    Note(String, String),
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    editor.workbench.open_notebook();
    let mut wish = None;
    top(editor, ui, &mut wish);
    ui.separator();
    let panel = &mut editor.notebook;
    let notebook = &editor.workbench.notebook;
    let is_known = |name: &str| {
        notebook
            .entries()
            .iter()
            .any(|kept| kept.entry.name == name)
    };
    panel.pictures.retain(|(name, _)| is_known(name));
    if notebook.entries().is_empty() {
        let text = say!("notebook.keep_this_measurement_saves_the_picture");
        ui.label(RichText::new(text).weak());
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for kept in notebook.entries() {
            ui.push_id(&kept.entry.name, |ui| one(panel, ui, kept, &mut wish));
            ui.separator();
        }
    });
    confirm(panel, ui, &mut wish);
    if let Some(wish) = wish {
        fulfil(editor, wish);
    }
}

fn top(editor: &mut Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let busy = editor.workbench.notebook.is_busy();
    ui.horizontal_wrapped(|ui| {
        let label = ui.label(say!("notebook.note"));
        let field = TextEdit::singleline(&mut editor.notebook.note)
            .desired_width(240.0)
            .hint_text(say!("notebook.what_it_shows"));
        let field = ui.add(field).labelled_by(label.id);
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        if ui.button(say!("notebook.keep_this_measurement")).clicked() || entered {
            *wish = Some(Wish::Keep);
        }
        let about = say!(
            "notebook.writes_with_links_to_the_pictures",
            notebook = NOTEBOOK,
            export = EXPORT
        );
        if ui
            .button(say!("notebook.export_markdown"))
            .on_hover_text(about)
            .clicked()
        {
            *wish = Some(Wish::Export);
        }
        if busy {
            ui.spinner();
        }
    });
    match &editor.workbench.notebook.said {
        Some(Ok(text)) => _ = ui.label(RichText::new(text).weak()),
        Some(Err(text)) => _ = ui.label(RichText::new(text).color(Palette::of(ui).error)),
        None => {}
    }
}

/// One entry: picture, note, numbers.
fn one(panel: &mut NotebookPanel, ui: &mut Ui, kept: &Kept, wish: &mut Option<Wish>) {
    let entry = &kept.entry;
    let name = &entry.name;
    ui.horizontal_top(|ui| {
        let picture = kept.thumbnail.as_ref().map(|small| {
            let known = panel.pictures.iter().find(|(known, _)| known == name);
            known.map(|(_, handle)| handle.clone()).unwrap_or_else(|| {
                let size = [small.width as usize, small.height as usize];
                let image = ColorImage::from_rgba_unmultiplied(size, small.pixels.as_flattened());
                let handle = ui.ctx().load_texture(name, image, TextureOptions::LINEAR);
                panel.pictures.push((name.clone(), handle.clone()));
                handle
            })
        });
        let title = say!("notebook.go_to_the_view_of", name = name);
        let clicked = match picture {
            Some(handle) => {
                let image = Image::new(&handle)
                    .alt_text(&title)
                    .fit_to_exact_size(vec2(120.0, 90.0));
                let button = ui.add(egui::Button::image(image));
                button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &title));
                button.on_hover_text(&title).clicked()
            }
            None => ui
                .button(say!("notebook.go_to_the_view"))
                .on_hover_text(&title)
                .clicked(),
        };
        if clicked {
            *wish = Some(Wish::Restore(name.clone()));
        }
        ui.vertical(|ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(RichText::new(&entry.time).strong());
                ui.label(RichText::new(&entry.shown).weak());
                if ui.small_button(say!("notebook.copy_view")).clicked() {
                    ui.ctx().copy_text(entry.view.clone());
                }
                if ui.small_button(say!("notebook.delete")).clicked() {
                    panel.deleting = Some(name.clone());
                }
                if kept.unsaved.is_some() && ui.small_button(say!("notebook.save_again")).clicked()
                {
                    *wish = Some(Wish::SaveAgain(name.clone()));
                }
            });
            if let Some(why) = &kept.unsaved {
                let text = say!("notebook.only_in_memory", why = why);
                ui.label(RichText::new(text).color(Palette::of(ui).error));
            }
            note(panel, ui, entry, wish);
            numbers(ui, entry);
        });
    });
}

/// The note, which can be changed; it counts when the field is left.
fn note(panel: &mut NotebookPanel, ui: &mut Ui, entry: &Entry, wish: &mut Option<Wish>) {
    let changing = panel
        .changing
        .as_ref()
        .filter(|(name, _)| *name == entry.name);
    let mut text = changing.map_or_else(|| entry.note.clone(), |(_, text)| text.clone());
    let field = TextEdit::multiline(&mut text)
        .desired_rows(1)
        .desired_width(f32::INFINITY)
        .hint_text(say!("notebook.no_note"));
    let field = ui.add(field);
    field.widget_info(|| {
        let label = say!("notebook.note_of", name = entry.name);
        egui::WidgetInfo::labeled(egui::Role::MultilineTextInput, true, label)
    });
    if field.has_focus() {
        panel.changing = Some((entry.name.clone(), text));
    } else if field.lost_focus() {
        panel.changing = None;
        *wish = Some(Wish::Note(entry.name.clone(), text));
    }
}

fn numbers(ui: &mut Ui, entry: &Entry) {
    for (side, costs) in ["A", "B"].into_iter().zip(&entry.costs) {
        let settings = if costs.settings.is_empty() {
            String::new()
        } else {
            format!(" ({})", costs.settings.join(", "))
        };
        let text = say!(
            "notebook.gpu_ms_cpu_ms",
            side = side,
            title = costs.title,
            settings = settings,
            gpu_ms = ms(costs.gpu.median_ms),
            cpu_ms = ms(costs.cpu.median_ms)
        );
        ui.label(RichText::new(text).small());
    }
    if let Some(difference) = &entry.difference {
        let text = say!(
            "notebook.flip_in_the_mean_largest_difference",
            flip_mean = format_args!("{:.5}", difference.flip_mean),
            max_steps = difference.max_steps
        );
        ui.label(RichText::new(text).small());
    }
    let adapter = &entry.adapter;
    ui.label(
        RichText::new(format!("{}, {}", adapter.name, adapter.driver_info))
            .small()
            .weak(),
    );
}

/// Asks before something is deleted.
fn confirm(panel: &mut NotebookPanel, ui: &Ui, wish: &mut Option<Wish>) {
    let Some(name) = panel.deleting.clone() else {
        return;
    };
    let modal = Modal::new(Id::unique("delete an entry")).show(ui.ctx(), |ui| {
        ui.set_width(360.0);
        ui.label(say!(
            "notebook.delete_and_its_picture_from_the",
            name = name
        ));
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let error = Palette::of(ui).error;
            let delete =
                egui::Button::new(RichText::new(say!("notebook.delete_it")).color(Color32::WHITE))
                    .fill(error);
            if ui.add(delete).clicked() {
                *wish = Some(Wish::Delete(name.clone()));
                panel.deleting = None;
            }
            if ui.button(say!("notebook.keep_it")).clicked() {
                panel.deleting = None;
            }
        });
    });
    if modal.should_close() {
        panel.deleting = None;
    }
}

fn fulfil(editor: &mut Editor, wish: Wish) {
    let said = match wish {
        Wish::Keep => return keep(editor),
        Wish::Export => match editor.workbench.export_notebook() {
            Ok(path) => Ok(say!("notebook.written", path = path.display())),
            Err(error) => Err(error),
        },
        Wish::Restore(name) => match editor.workbench.restore(&name) {
            Ok(()) => Ok(say!("notebook.the_view_of", name = name)),
            Err(error) => Err(error),
        },
        Wish::Delete(name) => return editor.workbench.delete_entry(&name),
        Wish::SaveAgain(name) => return editor.workbench.save_again(&name),
        Wish::Note(name, text) => return editor.workbench.set_note(&name, &text),
    };
    editor.workbench.notebook.said = Some(said);
}

/// Keeps what is on the screen with the note that was typed.
pub fn keep(editor: &mut Editor) {
    match editor.workbench.keep(editor.notebook.note.trim()) {
        Ok(()) => editor.notebook.note.clear(),
        Err(error) => editor.workbench.notebook.said = Some(Err(error)),
    }
}
