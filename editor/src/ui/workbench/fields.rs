//! Parameters of pipelines and scenes in one form, for widgets.

use lightbench::render::description::{Parameter, ParameterKind, ParameterValue};
use lightbench::script::{SceneParameter, SceneParameterKind, SettingValue, Settings};

/// What values a field takes.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldKind {
    /// A number in an inclusive range.
    Number {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Only whole numbers.
        whole: bool,
    },
    /// On or off.
    Switch,
    /// One of several names.
    Choice {
        /// The names.
        options: Vec<String>,
    },
    /// Any text.
    Text,
}

/// One parameter and the value that somebody wants for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Name in scripts and on the command line.
    pub name: String,
    /// What it does; may be empty.
    pub description: String,
    /// Unit; may be empty.
    pub unit: String,
    /// What it takes.
    pub kind: FieldKind,
    /// The value wanted: it may be ahead of the value in force by a frame.
    pub value: SettingValue,
    /// The value when nobody sets one.
    pub default: SettingValue,
}

impl Field {
    /// Whether somebody changed it.
    pub fn is_changed(&self) -> bool {
        self.value.to_string() != self.default.to_string()
    }

    /// The parameters of a pipeline with the settings wanted.
    pub fn of_pipeline(parameters: &[Parameter], settings: &Settings) -> Vec<Self> {
        let fields = parameters.iter().map(|parameter| {
            let set = settings.get(&parameter.name);
            let wanted = set.and_then(|value| parameter.parse(&value.to_string()).ok());
            Self {
                name: parameter.name.clone(),
                description: parameter.description.clone(),
                unit: parameter.unit.clone(),
                kind: match &parameter.kind {
                    ParameterKind::Number { min, max } => FieldKind::Number {
                        min: *min,
                        max: *max,
                        whole: false,
                    },
                    ParameterKind::Switch => FieldKind::Switch,
                    ParameterKind::Choice { options } => FieldKind::Choice {
                        options: options.clone(),
                    },
                },
                value: setting(&wanted.unwrap_or_else(|| parameter.default.clone())),
                default: setting(&parameter.default),
            }
        });
        fields.collect()
    }

    /// The parameters of a scene with the settings wanted.
    pub fn of_scene(parameters: &[SceneParameter], settings: &Settings) -> Vec<Self> {
        let fields = parameters.iter().map(|parameter| {
            let set = settings.get(&parameter.name);
            let wanted = set.and_then(|value| parameter.parse(value).ok());
            Self {
                name: parameter.name.clone(),
                description: parameter.description.clone(),
                unit: String::new(),
                kind: match &parameter.kind {
                    SceneParameterKind::Number { min, max, whole } => FieldKind::Number {
                        min: *min,
                        max: *max,
                        whole: *whole,
                    },
                    SceneParameterKind::Switch => FieldKind::Switch,
                    SceneParameterKind::Choice { options } => FieldKind::Choice {
                        options: options.clone(),
                    },
                    SceneParameterKind::Text => FieldKind::Text,
                },
                value: wanted.unwrap_or_else(|| parameter.default.clone()),
                default: parameter.default.clone(),
            }
        });
        fields.collect()
    }
}

fn setting(value: &ParameterValue) -> SettingValue {
    match value {
        ParameterValue::Number(number) => SettingValue::Number(*number),
        ParameterValue::Switch(on) => SettingValue::Switch(*on),
        ParameterValue::Choice(name) => SettingValue::Text(name.clone()),
    }
}
