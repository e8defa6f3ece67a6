//! The question what becomes of work that the last run has left.

use std::time::SystemTime;

use egui::{Context, Id, Key, Modal, Modifiers, RichText};

use crate::ui::editor::Editor;
use crate::ui::messages::say;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    Restore,
    Discard,
    Later,
}

/// Draws the question while there is such work, and does what was answered.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(left) = editor.recovery.left.last() else {
        return;
    };
    let session = &left.session;
    let heading = match session.on_purpose {
        true => say!("recovery.kept_heading"),
        false => say!("recovery.crash_heading"),
    };
    let when = left.written.map_or_else(String::new, ago);
    let mut lines = Vec::new();
    for (scene, kept) in session.overlays.iter().filter(|(_, kept)| !kept.is_empty()) {
        lines.push(say!("recovery.changes", scene = scene, count = kept.len()));
    }
    for (scene, typed) in &session.typed {
        lines.push(say!("recovery.typed", scene = scene, count = typed.len()));
    }
    if lines.is_empty() {
        lines.push(say!("recovery.no_changes").to_owned());
    }
    let mut answer = None;
    let modal = Modal::new(Id::unique("recovery")).show(ctx, |ui| {
        ui.set_max_width(480.0);
        ui.heading(heading);
        ui.label(say!("recovery.about", when = when));
        for line in &lines {
            ui.label(RichText::new(line).strong());
        }
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            for (title, about, of_it) in [
                (
                    say!("recovery.restore"),
                    say!("recovery.restore_about"),
                    Answer::Restore,
                ),
                (
                    say!("recovery.discard"),
                    say!("recovery.discard_about"),
                    Answer::Discard,
                ),
                (
                    say!("recovery.later"),
                    say!("recovery.later_about"),
                    Answer::Later,
                ),
            ] {
                if ui.button(title).on_hover_text(about).clicked() {
                    answer = Some(of_it);
                }
            }
        });
    });
    let escaped = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    if escaped || modal.should_close() {
        answer = answer.or(Some(Answer::Later));
    }
    match answer {
        None => {}
        Some(Answer::Restore) => editor.restore_session(),
        Some(Answer::Discard) => editor.recovery.throw_away(),
        // The next run asks again.
        Some(Answer::Later) => editor.recovery.left.clear(),
    }
}

/// How long ago something was, in words.
fn ago(when: SystemTime) -> String {
    let seconds = when.elapsed().map_or(0, |passed| passed.as_secs());
    match seconds {
        0..120 => say!("recovery.just_now").to_owned(),
        120..7200 => say!("recovery.minutes_ago", count = seconds / 60),
        7200..172_800 => say!("recovery.hours_ago", count = seconds / 3600),
        _ => say!("recovery.days_ago", count = seconds / 86_400),
    }
}
