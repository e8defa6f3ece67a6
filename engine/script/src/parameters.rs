//! `param(…)`: what can be set from outside, as with `--set lights=256`.

use lightbench_render::problem::suggestion;
use lightbench_render::{Place, Problem};
use rhai::Dynamic;

use crate::api::{Api, Arguments, Mistake, as_number};
use crate::names::list;
use crate::settings::{SettingValue, Settings};

/// What values a parameter of a scene or an experiment takes.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneParameterKind {
    /// A number in an inclusive range.
    Number {
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
        /// Whether only whole numbers are allowed.
        whole: bool,
    },
    /// On or off.
    Switch,
    /// One of some names.
    Choice {
        /// The names.
        options: Vec<String>,
    },
    /// Any text, such as the path of a model.
    Text,
}

/// A parameter that a script declares with `param`.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneParameter {
    /// Name.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// What it does, for people; may be empty.
    pub description: String,
    /// What values it takes.
    pub kind: SceneParameterKind,
    /// The value when nobody sets one.
    pub default: SettingValue,
    /// The value in force.
    pub value: SettingValue,
}

impl SceneParameter {
    /// Reads a value that was given from outside.
    ///
    /// # Errors
    /// A sentence that says which values are accepted.
    pub fn parse(&self, given: &SettingValue) -> Result<SettingValue, String> {
        let text = given.to_string();
        let text = text.trim();
        let name = &self.name;
        match &self.kind {
            SceneParameterKind::Number { min, max, whole } => {
                let number = text.parse::<f64>().ok();
                let fits = |n: &f64| (*min..=*max).contains(n) && !(*whole && n.fract() != 0.0);
                number
                    .filter(fits)
                    .map(SettingValue::Number)
                    .ok_or_else(|| {
                        let kind = if *whole { "a whole number" } else { "a number" };
                        format!("`{name}` takes {kind} from {min} to {max}, not `{text}`")
                    })
            }
            SceneParameterKind::Switch => match text {
                "on" | "true" | "1" | "yes" => Ok(SettingValue::Switch(true)),
                "off" | "false" | "0" | "no" => Ok(SettingValue::Switch(false)),
                _ => Err(format!("`{name}` takes `on` or `off`, not `{text}`")),
            },
            SceneParameterKind::Choice { options } => {
                if options.iter().any(|option| option == text) {
                    Ok(SettingValue::Text(text.to_owned()))
                } else {
                    let options = list(options.iter().map(String::as_str), "or");
                    Err(format!("`{name}` takes {options}, not `{text}`"))
                }
            }
            SceneParameterKind::Text => Ok(SettingValue::Text(text.to_owned())),
        }
    }

    /// The value in force as scripts see it: whole numbers as such, for loops and indices.
    fn script_value(&self) -> Dynamic {
        match &self.value {
            SettingValue::Number(number) => match self.kind {
                SceneParameterKind::Number { whole: true, .. } => Dynamic::from(*number as i64),
                _ => Dynamic::from(*number),
            },
            SettingValue::Switch(on) => Dynamic::from(*on),
            SettingValue::Text(text) => Dynamic::from(text.clone()),
        }
    }
}

/// Registers `param` in all its forms. `declare` hands each call to [`declare`].
pub(crate) fn register(
    api: &mut Api,
    declare: impl Fn(&Arguments) -> Result<Dynamic, Mistake> + Clone + Send + Sync + 'static,
) {
    let about = "Declares a value that can be set from outside and gives the one in force: a \
                 number in a range (whole if the default is written without a point), `true` or \
                 `false`, one of an array of names, or a text. The last text says what it does.";
    for form in [
        "param(name, default)",
        "param(name, default, about)",
        "param(name, default, min, max)",
        "param(name, default, min, max, about)",
    ] {
        let declare = declare.clone();
        api.function(form, about, move |arguments| declare(arguments));
    }
}

/// Declares a parameter, and gives the value in force.
pub(crate) fn declare(
    parameters: &mut Vec<SceneParameter>,
    settings: &Settings,
    arguments: &Arguments,
) -> Result<Dynamic, Mistake> {
    let name = arguments.text(0)?;
    if let Some(first) = parameters.iter().find(|known| known.name == name) {
        return Err(Mistake::new(format!(
            "there is a parameter `{name}` already, in line {} of {}",
            first.at.line, first.at.file
        )));
    }
    let (kind, default) = kind(arguments)?;
    let description = match arguments.len() {
        3 => arguments.text(2)?,
        5 => arguments.text(4)?,
        _ => String::new(),
    };
    let mut parameter = SceneParameter {
        name,
        at: arguments.place(),
        description,
        kind,
        value: default.clone(),
        default,
    };
    if let Some(given) = settings.get(&parameter.name) {
        parameter.value = parameter.parse(given).map_err(Mistake::new)?;
    }
    let value = parameter.script_value();
    parameters.push(parameter);
    Ok(value)
}

/// A problem for each setting that the script, a `what`, did not declare.
pub(crate) fn undeclared(
    what: &str,
    path: &str,
    parameters: &[SceneParameter],
    settings: &Settings,
) -> Vec<Problem> {
    let names = || parameters.iter().map(|parameter| parameter.name.as_str());
    let unknown = settings
        .iter()
        .filter(|(name, _)| !names().any(|known| known == *name));
    unknown
        .map(|(name, _)| {
            let message = format!("the {what} has no parameter `{name}`");
            Problem::new(Place::file(path), message).with_hint(match suggestion(name, names()) {
                Some(hint) => hint,
                None if parameters.is_empty() => "it has no parameters".to_owned(),
                None => format!("it has {}", list(names(), "and")),
            })
        })
        .collect()
}

fn kind(arguments: &Arguments) -> Result<(SceneParameterKind, SettingValue), Mistake> {
    let default = arguments.value(1);
    if let Some(number) = as_number(default) {
        if arguments.len() < 4 {
            return Err(
                Mistake::new("a number needs its smallest and its largest value")
                    .with_hint("it is written `param(\"lights\", 64, 0, 4096)`"),
            );
        }
        let (min, max) = (arguments.number(2)?, arguments.number(3)?);
        if !(min..=max).contains(&number) {
            return Err(Mistake::new(format!(
                "the default, {number}, is not from {min} to {max}"
            )));
        }
        let whole = default.is_int();
        return Ok((
            SceneParameterKind::Number { min, max, whole },
            SettingValue::Number(number),
        ));
    }
    if arguments.len() > 3 {
        return Err(Mistake::new(
            "only a number has a smallest and a largest value",
        ));
    }
    if let Ok(on) = default.as_bool() {
        return Ok((SceneParameterKind::Switch, SettingValue::Switch(on)));
    }
    if default.is_array() {
        let mut options = Vec::new();
        for option in arguments.array(1)? {
            let option = option.into_string();
            options.push(option.map_err(|_| arguments.wrong(1, "an array of texts"))?);
        }
        let Some(first) = options.first().cloned() else {
            return Err(Mistake::new("a choice needs at least one name"));
        };
        return Ok((
            SceneParameterKind::Choice { options },
            SettingValue::Text(first),
        ));
    }
    let text = arguments.text(1).map_err(|_| {
        arguments.wrong(
            1,
            "a number, `true` or `false`, an array of names or a text",
        )
    })?;
    Ok((SceneParameterKind::Text, SettingValue::Text(text)))
}
