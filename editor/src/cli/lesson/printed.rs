//! The outcome of a check as a person reads it in a terminal.

use std::fmt;
use std::path::{Path, PathBuf};

use lightbench::lab::lesson::{
    CriterionOutcome, Finding, Language, Lesson, Outcome, State, TaskOutcome, Words, text_file,
};

/// An outcome, to be printed in a language.
pub struct Printed<'a> {
    /// What was found.
    pub outcome: &'a Outcome,
    /// Of which lesson.
    pub lesson: &'a Lesson,
    /// In which language.
    pub language: Language,
    /// Where the pictures lie.
    pub pictures: &'a Path,
    /// The page with the lesson's text, where the work has one.
    pub page: Option<PathBuf>,
}

impl fmt::Display for Printed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.in_words(&self.outcome.title))?;
        for task in &self.outcome.tasks {
            self.task(f, task)?;
        }
        let (points, of) = (self.outcome.points, self.outcome.of);
        let sum = self.say("Points", "Puntos");
        writeln!(f, "\n{sum}: {}", self.points(points, of))?;
        if self.outcome.marked {
            writeln!(
                f,
                "{}",
                self.say(
                    "Something is near its threshold; a person should look at it.",
                    "Algo está cerca de su umbral; debería mirarlo una persona."
                )
            )?;
        }
        Ok(())
    }
}

impl Printed<'_> {
    fn say(&self, en: &'static str, es: &'static str) -> &'static str {
        match self.language {
            Language::English => en,
            Language::Spanish => es,
        }
    }

    fn in_words<'a>(&self, words: &'a Words) -> &'a str {
        words.in_language(self.language)
    }

    fn points(&self, points: u32, of: u32) -> String {
        format!("{points} {} {of}", self.say("of", "de"))
    }

    fn task(&self, f: &mut fmt::Formatter, task: &TaskOutcome) -> fmt::Result {
        writeln!(
            f,
            "\n{} ({})",
            self.in_words(&task.title),
            self.points(task.points, task.of)
        )?;
        if let Some(refusal) = &task.refusal {
            self.line(
                f,
                self.say("refused", "rechazado"),
                self.in_words(&refusal.says),
            )?;
            self.read(f, refusal.read.as_deref())?;
        }
        // What was refused as a whole says nothing of its parts.
        let judged = |criterion: &&CriterionOutcome| {
            task.refusal.is_none() || criterion.state != State::NotReached
        };
        for criterion in task.criteria.iter().filter(judged) {
            self.criterion(f, criterion)?;
        }
        Ok(())
    }

    fn criterion(&self, f: &mut fmt::Formatter, criterion: &CriterionOutcome) -> fmt::Result {
        let state = match (criterion.state, criterion.marked) {
            (State::Passed, false) => self.say("right", "bien"),
            (State::Failed, false) => self.say("wrong", "mal"),
            (State::NotReached, _) => self.say("not judged", "sin juzgar"),
            (State::Passed, true) => self.say(
                "right, but near the threshold",
                "bien, pero cerca del umbral",
            ),
            (State::Failed, true) => self.say(
                "wrong, but near the threshold",
                "mal, pero cerca del umbral",
            ),
        };
        let (says, points) = (
            self.in_words(&criterion.says),
            self.points(criterion.points, criterion.of),
        );
        writeln!(f, "  - {state}: {says} ({points})")?;
        let told = criterion.findings.iter().find(|finding| !finding.holds);
        told.or_else(|| criterion.findings.iter().find(|finding| finding.near))
            .map_or(Ok(()), |finding| self.finding(f, finding))
    }

    fn finding(&self, f: &mut fmt::Formatter, finding: &Finding) -> fmt::Result {
        self.line(
            f,
            self.say("expected", "esperado"),
            self.in_words(&finding.expected),
        )?;
        self.line(
            f,
            self.say("found", "hallado"),
            self.in_words(&finding.found),
        )?;
        if let Some(place) = &finding.place {
            self.line(f, self.say("where", "dónde"), self.in_words(place))?;
        }
        if let Some(cause) = &finding.cause {
            self.line(f, self.say("cause", "causa"), self.in_words(cause))?;
        }
        self.read(f, finding.read.as_deref())?;
        for (file, shows) in &finding.pictures {
            let path = self.pictures.join(file);
            let text = format!("{} ({})", path.display(), self.in_words(shows));
            self.line(f, self.say("picture", "imagen"), &text)?;
        }
        Ok(())
    }

    fn read(&self, f: &mut fmt::Formatter, place: Option<&str>) -> fmt::Result {
        let Some(place) = place else {
            return Ok(());
        };
        let file = match &self.page {
            Some(page) => page.display().to_string(),
            None => self.lesson.source.shown(&text_file(self.language)),
        };
        let title = self.outcome.title_of(place, self.language);
        let text = format!("“{title}”, {file}#{place}");
        self.line(f, self.say("read", "relee"), &text)
    }

    /// A name and a text, whose later lines stand below its first one.
    fn line(&self, f: &mut fmt::Formatter, name: &str, text: &str) -> fmt::Result {
        for (index, line) in text.lines().enumerate() {
            let name = if index == 0 { name } else { "" };
            writeln!(f, "      {name:<10}{line}")?;
        }
        Ok(())
    }
}
