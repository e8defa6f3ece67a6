//! `lightbench lesson`: what lessons there are, a project to begin one with, and a pack for students.

pub mod check;
pub mod grade;
pub mod hand_in;
mod printed;
pub mod worker;

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use lightbench::assets::files::{Files, write_atomic};
use lightbench::lab::lesson::{self, Lesson, find_lesson, list_lessons};

use super::project;
use super::report::{self, note, say};

/// The language of texts and messages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// English
    #[default]
    En,
    /// Spanish
    Es,
}

impl From<Language> for lesson::Language {
    fn from(language: Language) -> Self {
        match language {
            Language::En => Self::English,
            Language::Es => Self::Spanish,
        }
    }
}

/// Arguments of `lightbench lesson`.
#[derive(Args, Debug)]
#[command(arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Lists the lessons, with their points
    List {
        /// The language of the titles
        #[arg(long, value_enum, default_value_t)]
        language: Language,
    },
    /// Makes a project with the starter of a lesson
    #[command(after_help = "\
Examples:
  lightbench lesson start 1 --into first-light
  lightbench lesson start 01-first-light --into first-light --id ana.perez --language es

README.md in the project tells what to hand in, and the numbers that are yours. `lightbench check`,
started in the project, checks what you have.")]
    Start {
        /// The lesson: its number, its name, or its folder
        #[arg(value_name = "LESSON")]
        lesson: String,
        /// The folder to make; if it exists, it must be empty
        #[arg(long, value_name = "DIR")]
        into: PathBuf,
        /// The student, for whom numbers are drawn
        #[arg(long, value_name = "STUDENT")]
        id: Option<String>,
        /// The language of what is written for the student
        #[arg(long, value_enum, default_value_t)]
        language: Language,
    },
    /// Writes a lesson as one HTML page, to be printed or read offline
    #[command(after_help = "\
Examples:
  lightbench lesson print 1 --out first-light.html
  lightbench lesson print 1 --language es --id ana.perez --out primera-luz.html

The page holds all pictures and formulas, and what gives points. A browser prints it.")]
    Print {
        /// The lesson: its number, its name, or its folder
        #[arg(value_name = "LESSON")]
        lesson: String,
        /// The file to write
        #[arg(long, value_name = "FILE")]
        out: PathBuf,
        /// The language of the page
        #[arg(long, value_enum, default_value_t)]
        language: Language,
        /// The student whose numbers are printed
        #[arg(long, value_name = "STUDENT")]
        id: Option<String>,
    },
    /// Copies a lesson as students get it, without its solution and its hidden checks
    #[command(after_help = "\
Example:
  lightbench lesson pack lessons/01-first-light --student packs

It makes packs/01-first-light, which `lightbench check` takes as a lesson.")]
    Pack {
        /// The lesson: its number, its name, or its folder
        #[arg(value_name = "LESSON")]
        lesson: String,
        /// The folder in which the pack is made
        #[arg(long, value_name = "DIR")]
        student: PathBuf,
    },
}

/// Runs the command.
///
/// # Errors
/// No such lesson, one with mistakes, or a folder that can't be written.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    match &arguments.what {
        What::List { language } => list(files, (*language).into()),
        What::Start {
            lesson,
            into,
            id,
            language,
        } => {
            let lesson = find(files, lesson)?;
            let project = lesson::begin(&lesson, id.as_deref(), (*language).into(), into)?;
            say(project.display().to_string())?;
            note(format!(
                "Start with: cd \"{}\" && lightbench edit {} --pipeline {}",
                into.display(),
                lesson.about.scene,
                lesson.about.pipeline
            ));
            Ok(())
        }
        What::Print {
            lesson,
            out,
            language,
            id,
        } => {
            project::writable(out)?;
            let lesson = find(files, lesson)?;
            let page = lesson::print(&lesson, (*language).into(), id.as_deref())?;
            write_atomic(out, page.as_bytes())?;
            say(out.display().to_string())
        }
        What::Pack { lesson, student } => {
            let lesson = find(files, lesson)?;
            let folder = lesson::pack(&lesson, student)?;
            say(folder.display().to_string())
        }
    }
}

/// The lesson that a person means.
pub fn find(files: &Files, asked: &str) -> anyhow::Result<Lesson> {
    find_lesson(files, asked).map_err(|problems| report::problems(files, problems))
}

fn list(files: &Files, language: lesson::Language) -> anyhow::Result<()> {
    for name in list_lessons(files)? {
        let lesson = find(files, &name)?;
        let title = lesson.about.title.in_language(language);
        let points = lesson.about.points();
        say(format!("{name:<24}  {points:>3}  {title}"))?;
    }
    Ok(())
}
