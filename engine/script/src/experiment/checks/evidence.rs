//! What a check found, before anybody judges it.

use std::sync::Arc;

use lightbench_render::TargetImage;

use crate::experiment::LaboratoryError;

/// How far apart two values may be: `absolute + relative · |expected|`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// In the unit of the values.
    pub absolute: f64,
    /// As a share of what is expected.
    pub relative: f64,
    /// Of pictures: the share of texels that may be farther apart, as edges may.
    pub share: f64,
}

/// What a picture should hold, texel by texel.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// How many channels are compared, from the first.
    pub channels: usize,
    /// Rows from the top; nothing where a texel is not compared.
    pub texels: Vec<Option<[f32; 4]>>,
}

/// What one check has to say, with the answers that known mistakes would have given.
#[derive(Clone, Debug, PartialEq)]
pub enum Evidence {
    /// A picture, against another or against a closed form.
    Picture {
        /// What was drawn.
        found: Arc<TargetImage>,
        /// What should have been.
        expected: Expected,
        /// The mistakes, by their names in the lesson, and what they would have drawn.
        mistakes: Vec<(String, Expected)>,
        /// How far apart the two may be.
        bound: Bound,
    },
    /// A number.
    Number {
        /// What came out.
        found: f64,
        /// What should have.
        expected: f64,
        /// The mistakes, by their names in the lesson, and what they would have given.
        mistakes: Vec<(String, f64)>,
        /// How far apart the two may be.
        bound: Bound,
        /// Of both; may be empty.
        unit: String,
    },
    /// A number that must not be beyond another.
    Limit {
        /// What came out.
        found: f64,
        /// The last that is right.
        limit: f64,
        /// Whether it is the least, instead of the most.
        at_least: bool,
        /// How far apart drivers may be there, as a share of the limit.
        margin: f64,
        /// Of both; may be empty.
        unit: String,
        /// The mistake that is meant where the limit is passed.
        mistake: Option<String>,
    },
    /// Anything else: names of passes, formats, a statement.
    Statement {
        /// Whether it holds.
        holds: bool,
        /// What was found.
        found: Told,
        /// What should have been.
        expected: Told,
        /// The mistake that is meant where it does not hold.
        mistake: Option<String>,
    },
}

/// What a check says in words, in each language of the lessons.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Told {
    /// In English.
    pub en: String,
    /// In Spanish.
    pub es: String,
}

/// Judges evidence for the criteria of a task, and knows the numbers of a student.
pub trait Examiner: Send {
    /// Whether a criterion holds by this evidence, which is noted.
    ///
    /// # Errors
    /// A criterion or a mistake that the lesson does not have.
    fn judge(&mut self, criterion: &str, evidence: Evidence) -> Result<bool, LaboratoryError>;

    /// A number that is drawn for the student.
    ///
    /// # Errors
    /// A name that the lesson does not have.
    fn constant(&self, name: &str) -> Result<f64, LaboratoryError>;
}

/// A value of a file that a student handed in, as a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// Nothing.
    Nothing,
    /// `true` or `false`.
    Switch(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// Values in order.
    List(Vec<Data>),
    /// Values by name.
    Map(Vec<(String, Data)>),
}
