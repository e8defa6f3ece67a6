//! The arguments of a call, and what is said of those that do not fit.

use lightbench_render::Place;
use lightbench_render::problem::suggestion;
use rhai::{Dynamic, Engine, Map, NativeCallContext, Position};

use crate::api::{Mistake, ScriptType};
use crate::names::{Entry, list};
use crate::settings::{SettingValue, Settings};
use crate::spelling::spell;

/// The arguments of one call, with what is needed to speak about them.
///
/// Indices count the arguments in parentheses, from 0.
pub(crate) struct Arguments<'a, 'c, 'v, 'd> {
    pub(crate) context: &'a NativeCallContext<'c>,
    pub(crate) values: &'v mut [&'d mut Dynamic],
    pub(crate) entry: &'a Entry,
    pub(crate) skip: usize,
}

impl Arguments<'_, '_, '_, '_> {
    /// Where the call was written.
    pub(crate) fn place(&self) -> Place {
        place(self.context.call_source(), self.context.call_position())
    }

    /// How many arguments there are.
    pub(crate) fn len(&self) -> usize {
        self.values.len() - self.skip
    }

    /// The value itself.
    pub(crate) fn value(&self, index: usize) -> &Dynamic {
        self.values[index + self.skip]
    }

    /// The call as a script would write it, with the values in place of what was written.
    pub(crate) fn spelled(&self) -> Option<String> {
        let values = self.values[self.skip..].iter();
        let values: Option<Vec<String>> = values.map(|value| spell(value)).collect();
        Some(format!("{}({})", self.entry.name, values?.join(", ")))
    }

    pub(crate) fn receiver<T: ScriptType>(&self) -> Result<T, Mistake> {
        self.values[0]
            .read_lock::<T>()
            .map(|object| object.clone())
            .ok_or_else(|| Mistake::new(format!("this is no {}", T::NAME)))
    }

    /// A finite number.
    pub(crate) fn number(&self, index: usize) -> Result<f64, Mistake> {
        let value = self.value(index);
        let number = as_number(value).ok_or_else(|| self.wrong(index, "a number"))?;
        if number.is_finite() {
            Ok(number)
        } else {
            let what = format!("`{}` of `{}`", self.name(index), self.entry.name);
            Err(not_finite(&what, number))
        }
    }

    /// Whether an argument is a number.
    pub(crate) fn is_number(&self, index: usize) -> bool {
        as_number(self.value(index)).is_some()
    }

    /// A finite number as `f32`.
    pub(crate) fn float(&self, index: usize) -> Result<f32, Mistake> {
        self.number(index).map(|number| number as f32)
    }

    /// A number inside a range.
    pub(crate) fn number_in(&self, index: usize, min: f64, max: f64) -> Result<f64, Mistake> {
        let number = self.number(index)?;
        if (min..=max).contains(&number) {
            Ok(number)
        } else {
            let range = if max == f64::INFINITY {
                format!("at least {min}")
            } else {
                format!("from {min} to {max}")
            };
            Err(Mistake::new(format!(
                "`{}` of `{}` must be {range}, not {number}",
                self.name(index),
                self.entry.name
            )))
        }
    }

    /// A whole number inside a range. `3.0` is whole, `3.5` is not.
    pub(crate) fn whole(&self, index: usize, min: i64, max: i64) -> Result<i64, Mistake> {
        let number = self.number(index)?;
        if number.fract() != 0.0 {
            return Err(Mistake::new(format!(
                "`{}` of `{}` must be a whole number, not {number}",
                self.name(index),
                self.entry.name
            )));
        }
        let number = self.number_in(index, min as f64, max as f64)?;
        Ok(number as i64)
    }

    /// A text.
    pub(crate) fn text(&self, index: usize) -> Result<String, Mistake> {
        self.value(index)
            .clone()
            .into_string()
            .map_err(|_| self.wrong(index, "a text in quotes"))
    }

    /// `true` or `false`.
    pub(crate) fn switch(&self, index: usize) -> Result<bool, Mistake> {
        self.value(index)
            .as_bool()
            .map_err(|_| self.wrong(index, "`true` or `false`"))
    }

    /// An object of a type.
    pub(crate) fn object<T: ScriptType>(&self, index: usize) -> Result<T, Mistake> {
        self.try_object(index)
            .ok_or_else(|| self.wrong(index, &a(T::NAME)))
    }

    /// An object of a type, if the argument is one.
    pub(crate) fn try_object<T: ScriptType>(&self, index: usize) -> Option<T> {
        self.value(index)
            .read_lock::<T>()
            .map(|object| object.clone())
    }

    /// An array.
    pub(crate) fn array(&self, index: usize) -> Result<rhai::Array, Mistake> {
        self.value(index)
            .clone()
            .into_array()
            .map_err(|_| self.wrong(index, "an array"))
    }

    /// Values for parameters: a map of numbers, texts and switches. `whose` names it in messages.
    pub(crate) fn settings(&self, map: &Map, whose: &str) -> Result<Settings, Mistake> {
        let mut settings = Settings::new();
        for (parameter, value) in map {
            let number = as_number(value).map(SettingValue::Number);
            let switch = || value.as_bool().ok().map(SettingValue::Switch);
            let text = || value.clone().into_string().ok().map(SettingValue::Text);
            let read = number.or_else(switch).or_else(text).ok_or_else(|| {
                Mistake::new(format!(
                    "`{parameter}` in {whose} must be a number, `true` or `false`, or a text, not {}",
                    self.describe(value)
                ))
            })?;
            settings.set(parameter.as_str(), read);
        }
        Ok(settings)
    }

    /// One of some names.
    pub(crate) fn choice<T: Copy>(
        &self,
        index: usize,
        choices: &[(&'static str, T)],
    ) -> Result<T, Mistake> {
        let text = self.text(index)?;
        choices
            .iter()
            .find(|(name, _)| *name == text)
            .map(|(_, choice)| *choice)
            .ok_or_else(|| {
                let names = || choices.iter().map(|(name, _)| *name);
                let mistake = Mistake::new(format!(
                    "`{}` of `{}` must be {}, not `{text}`",
                    self.name(index),
                    self.entry.name,
                    list(names(), "or")
                ));
                match suggestion(&text, names()) {
                    Some(hint) => mistake.with_hint(hint),
                    None => mistake,
                }
            })
    }

    /// The mistake of an argument of the wrong kind.
    pub(crate) fn wrong(&self, index: usize, wanted: &str) -> Mistake {
        let dot = if self.entry.receiver.is_some() {
            "."
        } else {
            ""
        };
        Mistake::new(format!(
            "`{}` of `{}` must be {wanted}, not {}",
            self.name(index),
            self.entry.name,
            describe(self.context.engine(), self.value(index))
        ))
        .with_hint(format!(
            "it is written `{dot}{}({})`",
            self.entry.name,
            self.entry.arguments.join(", ")
        ))
    }

    /// A value in plain words.
    pub(crate) fn describe(&self, value: &Dynamic) -> String {
        describe(self.context.engine(), value)
    }

    fn name(&self, index: usize) -> &str {
        // A property is written without arguments: what is assigned bears the property's name.
        self.entry
            .arguments
            .get(index)
            .map_or(self.entry.name.as_str(), String::as_str)
    }
}

/// The mistake of a number that is none, or infinite.
pub(crate) fn not_finite(what: &str, number: f64) -> Mistake {
    Mistake::new(format!(
        "{what} is {}: did something divide by zero?",
        if number.is_nan() {
            "not a number"
        } else {
            "infinite"
        },
    ))
}

/// A number, whether written `1` or `1.0`.
pub(crate) fn as_number(value: &Dynamic) -> Option<f64> {
    value
        .as_float()
        .ok()
        .or_else(|| value.as_int().ok().map(|whole| whole as f64))
}

/// The place of a position in a script.
pub(crate) fn place(source: Option<&str>, position: Position) -> Place {
    Place::new(
        source.unwrap_or_default(),
        position.line().unwrap_or(0) as u32,
        position.position().unwrap_or(0) as u32,
    )
}

/// A value in plain words, as in "the text `six`".
pub(crate) fn describe(engine: &Engine, value: &Dynamic) -> String {
    if let Some(number) = as_number(value) {
        return format!("the number {number}");
    }
    if let Ok(on) = value.as_bool() {
        return format!("`{on}`");
    }
    if let Ok(text) = value.clone().into_string() {
        let short: String = text.chars().take(40).collect();
        return if short.is_empty() {
            "an empty text".to_owned()
        } else if short == text {
            format!("the text `{text}`")
        } else {
            format!("the text `{short}…`")
        };
    }
    kind(engine.map_type_name(value.type_name()))
}

/// A type in plain words, from Rhai's name for it.
pub(crate) fn kind(name: &str) -> String {
    match name.trim() {
        "i64" | "f64" | "INT" | "FLOAT" => "a number".to_owned(),
        "bool" => "`true` or `false`".to_owned(),
        "string" | "&str | ImmutableString | String" => "a text".to_owned(),
        "char" => "a character".to_owned(),
        "()" => "nothing".to_owned(),
        "Fn" => "a function".to_owned(),
        name if name.starts_with("range") => "a range".to_owned(),
        name if name.contains("::") => "a value".to_owned(),
        name => a(name),
    }
}

/// The name with its article.
fn a(name: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {name}")
}
