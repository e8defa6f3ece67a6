//! The page of a student: that student's results, and nobody else's.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use lightbench_lab::lesson::{CriterionOutcome, Finding, Language, Outcome, State, TaskOutcome};

use super::{escaped, refused, text_of_hidden};
use crate::grading::Record;

const CSS: &str = include_str!("page.css");

/// A whole page of HTML around a body, without anything to be loaded.
pub(super) fn document(title: &str, language: Language, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"{}\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n\
         <style>\n{CSS}</style>\n{body}</html>\n",
        language.code(),
        escaped(title)
    )
}

/// What a page is made from.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// The record of the student.
    pub record: &'a Record,
    /// The title of the lesson.
    pub title: &'a str,
    /// The points that there are.
    pub of: u32,
    /// The folder with the pictures of the check.
    pub pictures: &'a Path,
    /// In which language.
    pub language: Language,
}

/// The page as HTML, with its pictures in it, so that it can be sent as one file.
#[must_use]
pub fn student_page(page: &Page<'_>) -> String {
    let record = page.record;
    let mut body = format!(
        "<h1>{}</h1>\n<p>{}{}</p>\n",
        escaped(page.title),
        escaped(&record.name),
        match &record.id {
            Some(id) if *id != record.name => format!(" ({})", escaped(id)),
            _ => String::new(),
        }
    );
    if record.late {
        body += &note(page.say("Handed in late.", "Entregado con retraso."));
    }
    let points = match record.points() {
        Some(points) => format!("{points} {} {}", page.say("of", "de"), page.of),
        None => page.say("not judged yet", "aún sin evaluar").to_owned(),
    };
    let word = page.say("Points", "Puntos");
    let _ = writeln!(
        body,
        "<p class=\"sum\"><strong>{word}: {points}</strong></p>"
    );
    if record.needs_a_person() {
        body += &note(page.say(
            "A person will look at this before it counts.",
            "Una persona lo revisará antes de que cuente.",
        ));
    }
    if let Some(problem) = record.problem() {
        body += &note(problem);
    }
    if let Some(archive) = &record.archive {
        let word = page.say("File", "Archivo");
        let _ = writeln!(body, "<p>{word}: {}</p>", escaped(archive));
    }
    if let Some(outcome) = record.outcome() {
        body += &page.outcome(outcome);
    }
    let title = format!("{}: {}", page.title, record.name);
    document(&title, page.language, &body)
}

/// A sentence, or the lines of a mistake in a file, in which spaces matter.
fn note(text: &str) -> String {
    let tag = if text.contains('\n') { "pre" } else { "p" };
    format!("<{tag} class=\"note\">{}</{tag}>\n", escaped(text))
}

impl Page<'_> {
    fn say(&self, en: &'static str, es: &'static str) -> &'static str {
        match self.language {
            Language::English => en,
            Language::Spanish => es,
        }
    }

    fn outcome(&self, outcome: &Outcome) -> String {
        let tasks = outcome.tasks.iter();
        tasks.map(|task| self.task(outcome, task)).collect()
    }

    fn task(&self, outcome: &Outcome, task: &TaskOutcome) -> String {
        let title = escaped(task.title.in_language(self.language));
        let of = self.say("of", "de");
        let mut text = format!("<h2>{title} — {} {of} {}</h2>\n", task.points, task.of);
        if let Some(why) = refused(task, self.language) {
            text += &note(why);
        }
        let criteria = task.criteria.iter();
        text += &criteria
            .map(|criterion| self.criterion(outcome, task, criterion))
            .collect::<String>();
        text
    }

    fn criterion(
        &self,
        outcome: &Outcome,
        task: &TaskOutcome,
        criterion: &CriterionOutcome,
    ) -> String {
        let (class, word) = match criterion.state {
            State::Passed => ("passed", self.say("holds", "se cumple")),
            State::Failed => ("failed", self.say("does not hold", "no se cumple")),
            State::NotReached => ("", self.say("not judged", "sin evaluar")),
        };
        // A question is its own criterion, and its text stands above.
        let says = match criterion.says == task.title {
            true => String::new(),
            false => format!("{} · ", escaped(criterion.says.in_language(self.language))),
        };
        let mut text = format!(
            "<div class=\"criterion {class}\"><span class=\"state\">{word}</span> · {says}{} {} {}\n",
            criterion.points,
            self.say("of", "de"),
            criterion.of
        );
        let findings = criterion.findings.iter().filter(|finding| !finding.holds);
        text += &findings
            .map(|finding| self.finding(outcome, finding))
            .collect::<String>();
        text + "</div>\n"
    }

    fn finding(&self, outcome: &Outcome, finding: &Finding) -> String {
        let words =
            |words: &lightbench_lab::lesson::Words| escaped(words.in_language(self.language));
        let mut text = format!(
            "<p>{}: {}<br>{}: {}",
            self.say("Expected", "Se esperaba"),
            words(&finding.expected),
            self.say("Found", "Se encontró"),
            words(&finding.found)
        );
        if let Some(place) = &finding.place {
            let _ = write!(text, "<br>{}: {}", self.say("Where", "Dónde"), words(place));
        }
        if finding.hidden {
            let _ = write!(text, "<br><em>({})</em>", text_of_hidden(self.language));
        }
        text += "</p>\n";
        if let Some(cause) = &finding.cause {
            let _ = writeln!(text, "<p><strong>{}</strong></p>", words(cause));
        }
        if let Some(read) = &finding.read {
            let word = self.say("Read again", "Vuelve a leer");
            let title = escaped(outcome.title_of(read, self.language));
            let _ = writeln!(text, "<p>{word}: <em>{title}</em></p>");
        }
        for (file, caption) in &finding.pictures {
            text += &self.picture(file, &words(caption));
        }
        text
    }

    fn picture(&self, file: &str, caption: &str) -> String {
        // A name, and no way out of the folder.
        let name = Path::new(file).file_name().unwrap_or_default();
        let Ok(bytes) = fs::read(self.pictures.join(name)) else {
            return String::new();
        };
        let data = STANDARD.encode(bytes);
        format!(
            "<figure><img alt=\"{caption}\" src=\"data:image/png;base64,{data}\">\
             <figcaption>{caption}</figcaption></figure>\n"
        )
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::samples;
    use super::*;

    fn page(record: &Record, pictures: &Path, language: Language) -> String {
        student_page(&Page {
            record,
            title: "Linear light",
            of: 10,
            pictures,
            language,
        })
    }

    #[test]
    fn a_page_says_what_was_found_and_holds_its_pictures() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("curve-yours.png"), b"png").unwrap();
        let text = page(&samples::checked(), folder.path(), Language::English);
        for part in [
            "<html lang=\"en\">",
            "Ada &quot;the&quot; &lt;first&gt;, Lovelace",
            "Points: 6 of 10",
            "<h2>A curve — 4 of 8</h2>",
            "Expected: 0.5 &lt; x<br>Found: &quot;0.25&quot;<br>Where: pixel 3, 4",
            "<strong>gamma &amp; twice</strong>",
            "Read again: <em>Gamma, twice</em>",
            "found by a check that only whoever grades has",
            "<h2>How many? — 2 of 2</h2>",
            "src=\"data:image/png;base64,cG5n\"",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
        let text = page(&samples::checked(), folder.path(), Language::Spanish);
        assert!(text.contains("Puntos: 6 de 10") && text.contains("es gamma &amp; twice"));
    }

    #[test]
    fn what_was_not_judged_is_no_zero() {
        let folder = Path::new("nowhere");
        let text = page(&samples::failed(), folder, Language::English);
        assert!(text.contains("not judged yet") && text.contains("no device"));
        let text = page(&samples::stopped(), folder, Language::English);
        assert!(text.contains("Points: 0 of 10") && text.contains("Handed in late"));
    }
}
