//! What can be set on a pipeline from outside.

use crate::problem::Place;

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterValue {
    /// A number, inside the declared range.
    Number(f64),
    /// A switch.
    Switch(bool),
    /// One of the declared choices, by name.
    Choice(String),
}

impl std::fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Switch(on) => write!(f, "{}", if *on { "on" } else { "off" }),
            Self::Choice(choice) => write!(f, "{choice}"),
        }
    }
}

/// What kind of value a parameter takes.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterKind {
    /// A number in an inclusive range. Reaches shaders as `f32`.
    Number {
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// On or off. Reaches shaders as `u32`, 0 or 1.
    Switch,
    /// One of several names. Reaches shaders as `u32`, the index in this list.
    Choice {
        /// The names, at least one.
        options: Vec<String>,
    },
}

/// Something that the command line, a script or the editor can set on a pipeline.
///
/// A shader sees it as the member of the same name of its `parameters` uniform.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name, as in `exposure`.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// What it does, in a sentence.
    pub description: String,
    /// Unit for people, as in "EV"; empty for none.
    pub unit: String,
    /// What values it takes.
    pub kind: ParameterKind,
    /// The value when nobody sets one.
    pub default: ParameterValue,
    /// The value in force.
    pub value: ParameterValue,
    /// Whether it changes what the pipeline costs and not what it shows, so that measurements may
    /// choose it.
    pub tunable: bool,
}

impl Parameter {
    /// The values that a measurement may choose from, as text: all of a choice, or of a switch. Empty
    /// where it may choose none.
    pub fn tuned_values(&self) -> Vec<String> {
        match &self.kind {
            _ if !self.tunable => Vec::new(),
            ParameterKind::Choice { options } => options.clone(),
            ParameterKind::Switch => vec!["on".to_owned(), "off".to_owned()],
            ParameterKind::Number { .. } => Vec::new(),
        }
    }

    /// Reads a value from text, as the command line gives it, and checks it against the kind.
    ///
    /// # Errors
    /// A sentence that says which values are accepted.
    pub fn parse(&self, text: &str) -> Result<ParameterValue, String> {
        let text = text.trim();
        match &self.kind {
            ParameterKind::Number { min, max } => match text.parse::<f64>() {
                Ok(number) if number >= *min && number <= *max => {
                    Ok(ParameterValue::Number(number))
                }
                _ => Err(format!(
                    "`{}` takes a number from {min} to {max}, not `{text}`",
                    self.name
                )),
            },
            ParameterKind::Switch => match text {
                "on" | "true" | "1" | "yes" => Ok(ParameterValue::Switch(true)),
                "off" | "false" | "0" | "no" => Ok(ParameterValue::Switch(false)),
                _ => Err(format!("`{}` takes `on` or `off`, not `{text}`", self.name)),
            },
            ParameterKind::Choice { options } => {
                if options.iter().any(|option| option == text) {
                    Ok(ParameterValue::Choice(text.to_owned()))
                } else {
                    let list = options
                        .iter()
                        .map(|o| format!("`{o}`"))
                        .collect::<Vec<_>>()
                        .join(", ");
                    Err(format!("`{}` takes one of {list}, not `{text}`", self.name))
                }
            }
        }
    }

    /// The number that shaders see: the number itself, 0 or 1, or the index of the choice.
    pub fn shader_value(&self) -> f64 {
        match (&self.value, &self.kind) {
            (ParameterValue::Number(number), _) => *number,
            (ParameterValue::Switch(on), _) => f64::from(u8::from(*on)),
            (ParameterValue::Choice(choice), ParameterKind::Choice { options }) => options
                .iter()
                .position(|option| option == choice)
                .unwrap_or(0)
                as f64,
            (ParameterValue::Choice(_), _) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_say_what_they_accept() {
        let parameter = Parameter {
            name: "curve".into(),
            at: Place::default(),
            description: String::new(),
            unit: String::new(),
            kind: ParameterKind::Choice {
                options: vec!["hable".into(), "linear".into()],
            },
            default: ParameterValue::Choice("hable".into()),
            value: ParameterValue::Choice("linear".into()),
            tunable: false,
        };
        assert_eq!(parameter.shader_value(), 1.0);
        assert_eq!(
            parameter.parse("aces"),
            Err("`curve` takes one of `hable`, `linear`, not `aces`".into())
        );
    }
}
