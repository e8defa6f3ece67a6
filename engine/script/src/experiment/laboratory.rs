//! What an experiment needs and this crate can't do: loading, drawing, and reading what was drawn.
//!
//! The crate that has a renderer implements [`Laboratory`]; the functions of the scripts check their
//! arguments and call it.

use std::fmt;

use lightbench_render::inspect::{FirstInvalid, Part, PixelValue, Shown};
use lightbench_render::{PipelineDesc, Problems, RenderError, TargetImage};

use crate::settings::Settings;

/// One frame: a scene at a moment, through a pipeline, at a size.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// A scene's name or path.
    pub scene: String,
    /// Values of its parameters.
    pub scene_settings: Settings,
    /// A pipeline's name or path.
    pub pipeline: String,
    /// Values of its parameters.
    pub pipeline_settings: Settings,
    /// Width and height in pixels, both at least 1.
    pub size: (u32, u32),
    /// Which frame, from 0; the scene takes 60 steps a second.
    pub frame: u32,
}

/// Draws frames and looks into them.
///
/// A shot says all that a frame depends on, so the same one always gives the same values, whatever
/// was asked before. What is made for one call may be kept for the next.
pub trait Laboratory: Send {
    /// Draws a frame, to see that it can be drawn, and gives the pipeline as it was built.
    ///
    /// # Errors
    /// A scene or a pipeline with mistakes, values that they refuse, or a frame that can't be drawn.
    fn draw(&mut self, shot: &Shot) -> Result<PipelineDesc, LaboratoryError>;

    /// A part of a target, as a pass leaves it; passes are counted from 0.
    ///
    /// # Errors
    /// As [`Laboratory::draw`], and a part that the target does not have.
    fn target(
        &mut self,
        shot: &Shot,
        pass: usize,
        target: &str,
        part: Part,
    ) -> Result<TargetImage, LaboratoryError>;

    /// What each pass did to a pixel, in the order of the passes.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn pixel(&mut self, shot: &Shot, pixel: (u32, u32))
    -> Result<Vec<PixelValue>, LaboratoryError>;

    /// The first pass that leaves a value that is no number, or infinite.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn first_invalid(&mut self, shot: &Shot) -> Result<Option<FirstInvalid>, LaboratoryError>;

    /// What the scene's scripts have plotted under a name until this frame, oldest first. Empty where
    /// they plotted nothing.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn values(&mut self, shot: &Shot, name: &str) -> Result<Vec<f64>, LaboratoryError>;

    /// The bytes of a picture file: of an EXR where the path ends so, else of a PNG.
    ///
    /// # Errors
    /// A target without texels.
    fn encode(
        &self,
        path: &str,
        image: &TargetImage,
        shown: Shown,
    ) -> Result<Vec<u8>, LaboratoryError>;
}

/// Why a laboratory could not do what it was asked.
#[derive(Debug)]
pub enum LaboratoryError {
    /// Mistakes in a scene, a pipeline, a shader, or in the values for them.
    Files(Problems),
    /// The frame can't be drawn, or not be read.
    Render(RenderError),
    /// Anything else, in words.
    Other(String),
}

impl fmt::Display for LaboratoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Files(problems) => problems.fmt(f),
            Self::Render(error) => error.fmt(f),
            Self::Other(words) => f.write_str(words),
        }
    }
}

impl std::error::Error for LaboratoryError {}

impl From<Problems> for LaboratoryError {
    fn from(problems: Problems) -> Self {
        Self::Files(problems)
    }
}

impl From<RenderError> for LaboratoryError {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}
