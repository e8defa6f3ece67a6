//! Values that are set from outside, as with `--set lights=256`.

use std::fmt;

/// A value given from outside.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingValue {
    /// As text, the way a command line gives it.
    Text(String),
    /// A number.
    Number(f64),
    /// A switch.
    Switch(bool),
}

impl fmt::Display for SettingValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => f.write_str(text),
            Self::Number(number) => write!(f, "{number}"),
            Self::Switch(on) => f.write_str(if *on { "on" } else { "off" }),
        }
    }
}

impl From<&str> for SettingValue {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for SettingValue {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for SettingValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<bool> for SettingValue {
    fn from(on: bool) -> Self {
        Self::Switch(on)
    }
}

/// Names and values in the order in which they were given; a later value replaces an earlier one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings(Vec<(String, SettingValue)>);

impl Settings {
    /// No settings.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets one value.
    pub fn set(&mut self, name: impl Into<String>, value: impl Into<SettingValue>) {
        let (name, value) = (name.into(), value.into());
        match self.0.iter_mut().find(|(known, _)| *known == name) {
            Some((_, old)) => *old = value,
            None => self.0.push((name, value)),
        }
    }

    /// Sets one value, for chains.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: impl Into<SettingValue>) -> Self {
        self.set(name, value);
        self
    }

    /// Reads one `name=value`.
    ///
    /// # Errors
    /// A sentence, where there is no `=` or no name.
    pub fn set_from_text(&mut self, text: &str) -> Result<(), String> {
        match text.split_once('=') {
            Some((name, value)) if !name.trim().is_empty() => {
                self.set(name.trim(), value.trim());
                Ok(())
            }
            _ => Err(format!(
                "a setting is written `name=value`, as in `lights=256`, not `{text}`"
            )),
        }
    }

    /// The value of that name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&SettingValue> {
        self.0
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, value)| value)
    }

    /// All names and values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &SettingValue)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// Whether nothing is set.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn later_values_replace_earlier_ones_in_place() {
        let mut settings = Settings::new().with("a", 1.0).with("b", true);
        settings.set_from_text(" a = path=with equals ").unwrap();
        let all: Vec<_> = settings.iter().map(|(n, v)| format!("{n}:{v}")).collect();
        assert_eq!(all, ["a:path=with equals", "b:on"]);
        assert!(settings.set_from_text("no value").is_err());
        assert!(settings.set_from_text("=3").is_err());
    }
}
