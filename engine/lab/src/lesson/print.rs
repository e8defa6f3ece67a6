//! A lesson as one page in HTML that needs nothing else: to be printed, or read in a browser.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use lightbench_assets::files::FileError;

use super::Lesson;
use super::document::{Block, FORMULAS, Piece, Run, formula_without_paper, read_document};
use super::words::{Language, Words, number};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PrintError {
    /// A file can't be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A picture of a kind that a page can't hold.
    #[error("{0}: a page holds pictures in PNG, JPEG and SVG files")]
    Picture(String),
}

/// The looks of the page, on the screen and on paper.
const STYLE: &str = include_str!("print.css");

/// The page of a lesson in a language: its text with all pictures, what is judged, and the student's
/// numbers.
///
/// # Errors
/// A text or a picture that can't be read.
pub fn print(
    lesson: &Lesson,
    language: Language,
    student: Option<&str>,
) -> Result<String, PrintError> {
    let text = lesson.text(language)?;
    let mut page = Page {
        lesson,
        language,
        html: String::new(),
    };
    page.blocks(&read_document(&text.markdown))?;
    page.numbers(student);
    page.tasks();
    let title = escaped(page.words(&lesson.about.title));
    let licence = escaped(&lesson.about.licence);
    let licensed = page.say("The text is under", "El texto está bajo la licencia");
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{}</main>\n<footer><p>Lightbench, \
         {title}. {licensed} <a href=\"https://spdx.org/licenses/{licence}.html\">{licence}</a>.</p>\
         </footer>\n</body>\n</html>\n",
        language.code(),
        page.html
    ))
}

struct Page<'a> {
    lesson: &'a Lesson,
    language: Language,
    html: String,
}

impl Page<'_> {
    fn say(&self, en: &'static str, es: &'static str) -> &'static str {
        match self.language {
            Language::English => en,
            Language::Spanish => es,
        }
    }

    fn words<'a>(&self, words: &'a Words) -> &'a str {
        words.in_language(self.language)
    }

    fn put(&mut self, arguments: std::fmt::Arguments) {
        // Texts in memory take all that is written.
        let _ = self.html.write_fmt(arguments);
    }

    fn blocks(&mut self, blocks: &[Block]) -> Result<(), PrintError> {
        blocks.iter().try_for_each(|block| self.block(block))
    }

    fn block(&mut self, block: &Block) -> Result<(), PrintError> {
        match block {
            Block::Place(name) => self.put(format_args!("<a id=\"{}\"></a>\n", escaped(name))),
            Block::Heading { level, content } => {
                self.put(format_args!("<h{level}>"));
                self.pieces(content)?;
                self.put(format_args!("</h{level}>\n"));
            }
            Block::Paragraph(pieces) => {
                self.html += "<p>";
                self.pieces(pieces)?;
                self.html += "</p>\n";
            }
            Block::List { first, items } => {
                let tag = if first.is_some() { "ol" } else { "ul" };
                let first = first.filter(|first| *first != 1);
                let start = first.map_or(String::new(), |first| format!(" start=\"{first}\""));
                self.put(format_args!("<{tag}{start}>\n"));
                for item in items {
                    self.html += "<li>";
                    self.blocks(item)?;
                    self.html += "</li>\n";
                }
                self.put(format_args!("</{tag}>\n"));
            }
            Block::Code { target, text, .. } => {
                self.html += "<figure class=\"code\">";
                if let Some(target) = target {
                    self.put(format_args!("<figcaption>{}</figcaption>", escaped(target)));
                }
                self.put(format_args!(
                    "<pre><code>{}</code></pre></figure>\n",
                    escaped(text.trim_end())
                ));
            }
            Block::Figure { path, alt } => {
                let is_formula = path.starts_with(FORMULAS);
                let class = if is_formula { "formula" } else { "picture" };
                self.put(format_args!("<figure class=\"{class}\">"));
                self.picture(path, alt)?;
                if !is_formula {
                    self.put(format_args!("<figcaption>{}</figcaption>", escaped(alt)));
                }
                self.html += "</figure>\n";
            }
            Block::Quote(blocks) => {
                self.html += "<blockquote>\n";
                self.blocks(blocks)?;
                self.html += "</blockquote>\n";
            }
            Block::Table(rows) => {
                self.html += "<table>\n";
                for (index, row) in rows.iter().enumerate() {
                    let tag = if index == 0 { "th" } else { "td" };
                    self.html += "<tr>";
                    for cell in row {
                        self.put(format_args!("<{tag}>"));
                        self.pieces(cell)?;
                        self.put(format_args!("</{tag}>"));
                    }
                    self.html += "</tr>\n";
                }
                self.html += "</table>\n";
            }
            Block::Rule => self.html += "<hr>\n",
        }
        Ok(())
    }

    fn pieces(&mut self, pieces: &[Piece]) -> Result<(), PrintError> {
        for piece in pieces {
            match piece {
                Piece::Run(run) => self.run(run),
                Piece::Picture { path, alt } => self.picture(path, alt)?,
                Piece::Break => self.html += "<br>",
            }
        }
        Ok(())
    }

    fn run(&mut self, run: &Run) {
        let mut html = escaped(&run.text);
        for (is, tag) in [
            (run.code, "code"),
            (run.emphasis, "em"),
            (run.strong, "strong"),
        ] {
            if is {
                html = format!("<{tag}>{html}</{tag}>");
            }
        }
        match run.link.as_deref() {
            // A page has places and addresses; files lie elsewhere.
            Some(link) if link.starts_with('#') || link.starts_with("https://") => {
                self.put(format_args!("<a href=\"{}\">{html}</a>", escaped(link)));
            }
            Some(link) => {
                self.put(format_args!(
                    "<span class=\"file\" title=\"{}\">{html}</span>",
                    escaped(link)
                ));
            }
            None => self.html += &html,
        }
    }

    fn picture(&mut self, path: &str, alt: &str) -> Result<(), PrintError> {
        let alt = escaped(alt);
        let source = &self.lesson.source;
        if path.starts_with(FORMULAS) && path.ends_with(".svg") {
            let svg = formula_without_paper(&source.read_text(path)?, "currentColor");
            let svg = svg.replacen(
                "<svg ",
                &format!("<svg role=\"img\" aria-label=\"{alt}\" "),
                1,
            );
            self.html += svg.trim();
            return Ok(());
        }
        let kind = match path.rsplit('.').next() {
            Some("png") => "png",
            Some("jpg" | "jpeg") => "jpeg",
            Some("svg") => "svg+xml",
            _ => return Err(PrintError::Picture(source.shown(path))),
        };
        let data = STANDARD.encode(source.read(path)?);
        self.put(format_args!(
            "<img alt=\"{alt}\" src=\"data:image/{kind};base64,{data}\">"
        ));
        Ok(())
    }

    /// The numbers that are drawn for the student; without one, those of nobody.
    fn numbers(&mut self, student: Option<&str>) {
        let about = &self.lesson.about;
        if about.constants.is_empty() {
            return;
        }
        let title = match student {
            Some(student) => format!(
                "{} {}",
                self.say("The numbers of", "Los números de"),
                escaped(student)
            ),
            None => self
                .say(
                    "Numbers where no student is named",
                    "Números si no se indica un estudiante",
                )
                .to_owned(),
        };
        self.put(format_args!("<section>\n<h2>{title}</h2>\n<table>\n"));
        for constant in &about.constants {
            let value = number(constant.value(&self.lesson.name, student));
            let name = escaped(self.words(&constant.title));
            let unit = escaped(&constant.unit);
            self.put(format_args!(
                "<tr><td>{name}</td><td class=\"number\">{value} {unit}</td></tr>\n"
            ));
        }
        self.html += "</table>\n</section>\n";
    }

    /// The tasks and questions with what each gives.
    fn tasks(&mut self) {
        let about = &self.lesson.about;
        let title = self.say("What gives points", "Qué da puntos");
        self.put(format_args!(
            "<section>\n<h2>{title}</h2>\n<table class=\"points\">\n"
        ));
        let row = |title: &str, points: u32, class: &str| {
            let title = escaped(title);
            format!(
                "<tr class=\"{class}\"><td>{title}</td><td class=\"number\">{points}</td></tr>\n"
            )
        };
        for task in &about.tasks {
            self.html += &row(self.words(&task.title), task.points(), "task");
            for criterion in &task.criteria {
                self.html += &row(self.words(&criterion.says), criterion.points, "criterion");
            }
        }
        for question in &about.questions {
            self.html += &row(self.words(&question.asks), question.points, "task");
        }
        let all = self.say("All together", "En total");
        self.html += &row(all, about.points(), "sum");
        self.html += "</table>\n</section>\n";
    }
}

/// A text for HTML, also between quotes.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}
