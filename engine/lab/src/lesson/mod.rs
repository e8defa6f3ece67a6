//! Lessons with checked exercises.
//!
//! A lesson is a folder: a text, a starter, checks, and a file that says what is asked and what it
//! gives ([`About`]). [`Lesson::read`] reads it and holds its parts together. [`check()`] draws with what
//! a student handed in and judges it by the lesson's checks, which are scripts; the [`Outcome`] is data.
//!
//! `engine/lab/docs/lessons.md` is the chapter for those who write lessons.

mod answers;
mod causes;
mod check;
mod compare;
mod constants;
mod copies;
mod document;
mod examiner;
mod folders;
mod imports;
mod model;
mod outcome;
mod pictures;
mod print;
mod read;
mod source;
mod stage;
mod submission;
mod text;
mod tokens;
mod words;

pub use answers::{ANSWERS, Answer, read_answers, write_answer};
pub use check::{CheckError, CheckEvent, CheckOptions, check};
pub use compare::MARGIN;
pub use copies::{CopiedFrom, copied_from, says_the_same};
pub use document::{
    Block, FORMULA_INK, FORMULAS, Piece, Run, formula_without_paper, has_glyphs_only, read_document,
};
pub use folders::{LESSON_PAGE, LessonOf, begin, lesson_of, pack};
pub use imports::{Import, forbidden, imports};
pub use model::{About, Constant, Criterion, Figure, KnownMistake, LESSON_FILE, Question, Task};
pub use outcome::{
    CriterionOutcome, Finding, OUTCOME_SCHEMA, Outcome, Refusal, RefusalKind, State, TaskOutcome,
};
pub use print::{PrintError, print};
pub use read::{CHECK_FILES, CHECKS, HIDDEN, Lesson, SOLUTION, STARTER};
pub use source::{LESSONS, Source, find_lesson, list_lessons};
pub use text::{Link, Listing, Text, has_place, place_line, text_file};
pub use words::{Language, Words};
