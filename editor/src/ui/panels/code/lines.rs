//! A text as it is drawn: each line is laid out once, and again only when it changes.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;

use egui::text::{LayoutJob, LayoutSection, TextFormat, TextWrapping};
use egui::{Color32, FontId, Galley, Ui};

use crate::ui::code::tokens::{self, Kind, Language};
use crate::ui::lesson::letters::{Level, SMALLER, parts};

/// The size of the letters, in points.
const SIZE: f32 = 12.5;

/// The letters of the text.
pub fn font() -> FontId {
    FontId::monospace(SIZE)
}

/// The colour of a part. Those of the dark theme keep a contrast of 4.5 to 1 on the panel, those of
/// the light one on white (WCAG 2.2, 1.4.3).
fn color(kind: Kind, dark: bool) -> Color32 {
    let (on_dark, on_light) = match kind {
        Kind::Plain => ((212, 212, 212), (30, 30, 30)),
        Kind::Keyword => ((112, 170, 232), (0, 70, 170)),
        Kind::Type => ((78, 201, 176), (0, 105, 92)),
        Kind::Call => ((220, 220, 160), (110, 75, 0)),
        Kind::Number => ((181, 206, 168), (25, 105, 45)),
        Kind::Text => ((222, 152, 120), (150, 45, 20)),
        Kind::Comment => ((140, 160, 130), (85, 105, 80)),
        Kind::Directive => ((200, 150, 215), (120, 40, 140)),
    };
    let (r, g, b) = if dark { on_dark } else { on_light };
    Color32::from_rgb(r, g, b)
}

/// A short piece of code with its colours, for elsewhere.
pub fn listing(language: Language, text: &str, dark: bool) -> LayoutJob {
    let mut job = LayoutJob::default();
    tokens::read(language, text, &mut |range, kind| {
        for (part, level) in parts(&text[range]) {
            let mut format = TextFormat::simple(font(), color(kind, dark));
            format.valign = level.align();
            if level != Level::Line {
                format.font_id.size *= SMALLER;
            }
            job.append(&part, 0.0, format);
        }
    });
    job.wrap = TextWrapping::no_max_width();
    job
}

/// What the drawn text was made from.
struct Made {
    text: String,
    language: Language,
    dark: bool,
    scale: f32,
    /// Another one when the fonts' picture was made anew, to which laid-out letters refer.
    fonts: Arc<Galley>,
    whole: Arc<Galley>,
}

/// Lines that are laid out.
#[derive(Default)]
pub struct Lines {
    made: Option<Made>,
    known: HashMap<u64, Arc<Galley>>,
}

impl Lines {
    /// The text laid out, without wrapping: row n is line n.
    pub fn lay_out(&mut self, ui: &Ui, language: Language, text: &str) -> Arc<Galley> {
        let dark = ui.visuals().dark_mode;
        let scale = ui.ctx().pixels_per_point();
        let fonts = ui.fonts_mut(|fonts| {
            fonts.layout_no_wrap("fonts".to_owned(), font(), Color32::PLACEHOLDER)
        });
        if let Some(made) = &self.made {
            let same = made.dark == dark && made.scale == scale && Arc::ptr_eq(&made.fonts, &fonts);
            if same && made.language == language && made.text == text {
                return Arc::clone(&made.whole);
            }
            if !same {
                self.known.clear();
            }
        }
        let whole = self.make(ui, language, text, dark, scale);
        self.made = Some(Made {
            text: text.to_owned(),
            language,
            dark,
            scale,
            fonts,
            whole: Arc::clone(&whole),
        });
        whole
    }

    fn make(
        &mut self,
        ui: &Ui,
        language: Language,
        text: &str,
        dark: bool,
        scale: f32,
    ) -> Arc<Galley> {
        let mut lines = text.split('\n');
        let mut kept = HashMap::with_capacity(self.known.len());
        let mut rows: Vec<Arc<Galley>> = Vec::new();
        // The parts of the line at hand, in bytes from its beginning.
        let mut parts: Vec<(usize, usize, Kind)> = Vec::new();
        let mut start = 0;
        let mut finish = |parts: &mut Vec<(usize, usize, Kind)>| {
            let line = lines.next().unwrap_or_default();
            let mut hasher = DefaultHasher::new();
            (line, &*parts).hash(&mut hasher);
            let key = hasher.finish();
            let known = kept.get(&key).or_else(|| self.known.get(&key)).cloned();
            let row = known.unwrap_or_else(|| lay_out_line(ui, line, parts, dark));
            kept.insert(key, Arc::clone(&row));
            rows.push(row);
            parts.clear();
        };
        tokens::read(language, text, &mut |range, kind| {
            let mut at = range.start;
            // A comment or a text may go over several lines.
            for (index, piece) in text[range].split('\n').enumerate() {
                if index > 0 {
                    finish(&mut parts);
                    at += 1;
                    start = at;
                }
                if !piece.is_empty() {
                    parts.push((at - start, at - start + piece.len(), kind));
                }
                at += piece.len();
            }
        });
        finish(&mut parts);
        self.known = kept;
        // The rows have their colours; a job without a section would count as empty.
        let format = TextFormat::simple(font(), color(Kind::Plain, dark));
        let job = LayoutJob {
            wrap: TextWrapping::no_max_width(),
            ..LayoutJob::single_section(text.to_owned(), format)
        };
        Arc::new(Galley::concat(Arc::new(job), &rows, scale))
    }
}

fn lay_out_line(ui: &Ui, line: &str, parts: &[(usize, usize, Kind)], dark: bool) -> Arc<Galley> {
    let section = |start: usize, end: usize, kind: Kind| LayoutSection {
        leading_space: 0.0,
        byte_range: start.into()..end.into(),
        format: TextFormat::simple(font(), color(kind, dark)),
    };
    let mut sections: Vec<LayoutSection> = parts
        .iter()
        .map(|(start, end, kind)| section(*start, *end, *kind))
        .collect();
    if sections.is_empty() {
        // An empty line is as high as others.
        sections.push(section(0, 0, Kind::Plain));
    }
    let job = LayoutJob {
        text: line.to_owned(),
        sections,
        wrap: TextWrapping::no_max_width(),
        keep_trailing_whitespace: true,
        ..LayoutJob::default()
    };
    ui.fonts_mut(|fonts| fonts.layout_job(job))
}
