//! What people ask of a frame, by the names that they know: passes, targets, parts of them.

use std::fmt;

use super::probe::Invalid;
use super::texels::Aspect;
use crate::description::{PipelineDesc, Slice};
use crate::life::writes;
use crate::problem::suggestion;

/// Which part of a target to read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// Mip level and layer.
    pub slice: Slice,
    /// Which sample; without one the mean of all.
    pub sample: Option<u32>,
    /// Colours or depth, or stencil.
    pub aspect: Aspect,
}

/// The first values that are no numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstInvalid {
    /// The pass that left them.
    pub pass: String,
    /// Where, and how many.
    pub place: Invalid,
    /// The first texel.
    pub value: [f32; 4],
}

/// How a target becomes a picture file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// One channel alone, from 0 for red; without one the colour, or the only channel.
    pub channel: Option<usize>,
    /// What a PNG shows as black and as white. An EXR holds the values as they are.
    pub range: [f32; 2],
    /// Whether a PNG shows the channel, or red, in colours instead of greys.
    pub false_colour: bool,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            channel: None,
            range: [0.0, 1.0],
            false_colour: false,
        }
    }
}

/// A name that a pipeline does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// What is missing.
    pub message: String,
    /// The nearest name, or all of them.
    pub hint: String,
}

impl Unknown {
    fn new<'a>(
        desc: &PipelineDesc,
        (kind, kinds): (&str, &str),
        name: &str,
        known: impl Iterator<Item = &'a str> + Clone,
    ) -> Self {
        let all = || known.clone().collect::<Vec<_>>().join(", ");
        let hint = suggestion(name, known.clone())
            .unwrap_or_else(|| format!("the {kinds} are: {}", all()));
        Self {
            message: format!("`{}` has no {kind} `{name}`", desc.name),
            hint,
        }
    }
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message, self.hint)
    }
}

/// The index of a pass, by its name or by its number from 0.
///
/// # Errors
/// A pass that the pipeline does not have.
pub fn find_pass(desc: &PipelineDesc, wanted: &str) -> Result<usize, Unknown> {
    let names = desc.passes.iter().map(|pass| pass.name.as_str());
    let number = wanted.parse().ok();
    names
        .clone()
        .position(|name| name == wanted)
        .or(number.filter(|number| *number < desc.passes.len()))
        .ok_or_else(|| Unknown::new(desc, ("pass", "passes"), wanted, names))
}

/// The index of the last pass that writes a target.
///
/// # Errors
/// A target that the pipeline does not have.
pub fn last_writer(desc: &PipelineDesc, target: &str) -> Result<usize, Unknown> {
    let writes = |pass| writes(pass).any(|name| name == target);
    // Passes write buffers too, which are no targets.
    let found = desc
        .target(target)
        .and_then(|_| desc.passes.iter().rposition(writes));
    let names = desc.targets.iter().map(|target| target.name.as_str());
    found.ok_or_else(|| Unknown::new(desc, ("target", "targets"), target, names))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::description::{PassDesc, PassKind, TargetDesc};
    use crate::{Format, Place};

    #[test]
    fn names_that_are_not_there_come_with_the_nearest_or_with_all() {
        let mut desc = PipelineDesc {
            name: "mine".to_owned(),
            ..PipelineDesc::default()
        };
        for name in ["g_buffer", "lights"] {
            let pass = PassDesc::new(name, Place::default(), PassKind::Clear);
            desc.passes.push(pass);
        }
        let hdr = TargetDesc::new(
            "hdr",
            Place::default(),
            Format::from_name("rgba16float").unwrap(),
        );
        desc.targets.push(hdr);
        assert_eq!(find_pass(&desc, "lights"), Ok(1));
        assert_eq!(find_pass(&desc, "0"), Ok(0));
        let told = |unknown: Unknown| unknown.to_string();
        assert_eq!(
            told(find_pass(&desc, "light").unwrap_err()),
            "`mine` has no pass `light`: did you mean `lights`?"
        );
        assert_eq!(
            told(find_pass(&desc, "2").unwrap_err()),
            "`mine` has no pass `2`: the passes are: g_buffer, lights"
        );
        assert_eq!(
            told(last_writer(&desc, "sum").unwrap_err()),
            "`mine` has no target `sum`: the targets are: hdr"
        );
    }
}
