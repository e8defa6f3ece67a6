//! What people ask of a frame, by the names that they know: passes, targets, parts of them.

use std::fmt;

use super::probe::Invalid;
use super::texels::Aspect;
use crate::description::{PassDesc, PipelineDesc, Slice};
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

/// The targets that a pass writes, to be shown as pictures: first the pipeline's output or HDR
/// picture, then colours in the order in which they are declared, then the rest. Empty for passes that
/// write buffers alone.
pub fn pictures_of<'a>(desc: &PipelineDesc, pass: &'a PassDesc) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    let colors = pass.colors.iter().map(|color| color.target.as_str());
    for name in colors.chain(writes(pass)) {
        if desc.target(name).is_some() && !names.contains(&name) {
            names.push(name);
        }
    }
    let is_result = |name: &str| {
        let results = [&desc.output, &desc.hdr].into_iter().flatten();
        results.into_iter().any(|result| result.name == name)
    };
    // A stable sort: the others keep their order.
    names.sort_by_key(|name| !is_result(name));
    names
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::description::{ColorAttachment, Named, PassKind, TargetDesc};
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

    #[test]
    fn a_pass_is_shown_by_its_result_or_its_first_colour() {
        let named = |name: &str| Named {
            name: name.to_owned(),
            at: Place::default(),
        };
        let mut desc = PipelineDesc {
            hdr: Some(named("hdr")),
            output: Some(named("output")),
            ..PipelineDesc::default()
        };
        for name in ["hdr", "output", "a", "b", "copied"] {
            let format = Format::from_name("rgba16float").unwrap();
            desc.targets
                .push(TargetDesc::new(name, Place::default(), format));
        }
        let mut pass = PassDesc::new("pass", Place::default(), PassKind::Fullscreen);
        for name in ["b", "a", "buffer"] {
            pass.colors
                .push(ColorAttachment::new(name, Place::default()));
        }
        assert_eq!(pictures_of(&desc, &pass), ["b", "a"]);
        pass.colors
            .push(ColorAttachment::new("hdr", Place::default()));
        assert_eq!(pictures_of(&desc, &pass), ["hdr", "b", "a"]);
        let nothing = PassDesc::new("nothing", Place::default(), PassKind::Clear);
        assert!(pictures_of(&desc, &nothing).is_empty());
    }
}
