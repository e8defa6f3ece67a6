//! What somebody has worked on, as it is written down: a file of JSON.

use std::collections::BTreeMap;
use std::path::PathBuf;

use lightbench::script::overlays::KeptOverlays;
use lightbench::script::{SettingValue, Settings};
use serde_json::{Map, Value, json};

use super::words::{overlays_from, overlays_to};
use crate::ui::workbench::comparing::Mode;
use crate::ui::workbench::typed::Typed;
use crate::ui::workbench::undo::Dials;

/// The version of the format. A file of another one is left alone.
const VERSION: u64 = 1;

/// What somebody has worked on.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// The folder of the project.
    pub project: Option<PathBuf>,
    /// Whether the window was closed and this was to be kept, so that nothing crashed.
    pub on_purpose: bool,
    /// What was on the screen, as a line of text.
    pub view: String,
    /// Whether time ran.
    pub plays: bool,
    /// The same with B, while two pipelines were compared.
    pub view_b: Option<String>,
    /// Settings of the comparison and of time.
    pub dials: Dials,
    /// Values of the scenes' parameters, by their names; files outside the project by their paths.
    pub scenes: BTreeMap<String, Settings>,
    /// Values of the parameters of visited pipelines, by their names.
    pub pipelines: BTreeMap<String, Settings>,
    /// What was changed by hand, by the names of the scenes.
    pub overlays: BTreeMap<String, KeptOverlays>,
    /// Lines of the console that have changed scenes, by the names of the scenes.
    pub typed: BTreeMap<String, Vec<Typed>>,
}

impl Session {
    /// The file's text.
    #[must_use]
    pub fn to_json(&self) -> String {
        let overlays: Option<Map<String, Value>> = self
            .overlays
            .iter()
            .map(|(scene, kept)| Some((scene.clone(), overlays_to(kept)?)))
            .collect();
        let project = self.project.as_ref().map(|path| path.to_string_lossy());
        json!({
            "version": VERSION,
            "project": project,
            "on_purpose": self.on_purpose,
            "view": self.view,
            "plays": self.plays,
            "view_b": self.view_b,
            "dials": dials_to(&self.dials),
            "scenes": all_to(&self.scenes),
            "pipelines": all_to(&self.pipelines),
            "overlays": overlays,
            "typed": typed_to(&self.typed),
        })
        .to_string()
    }

    /// Reads a file; `None` where it is none of this version or is damaged.
    #[must_use]
    pub fn from_json(text: &str) -> Option<Self> {
        let value: Value = serde_json::from_str(text).ok()?;
        if value["version"].as_u64() != Some(VERSION) {
            return None;
        }
        let overlays = value["overlays"].as_object()?;
        let overlays = overlays
            .iter()
            .map(|(scene, kept)| Some((scene.clone(), overlays_from(kept)?)));
        Some(Self {
            project: value["project"].as_str().map(PathBuf::from),
            on_purpose: value["on_purpose"].as_bool()?,
            view: value["view"].as_str()?.to_owned(),
            plays: value["plays"].as_bool()?,
            view_b: value["view_b"].as_str().map(str::to_owned),
            dials: dials_from(&value["dials"])?,
            scenes: all_from(&value["scenes"])?,
            pipelines: all_from(&value["pipelines"])?,
            overlays: overlays.collect::<Option<_>>()?,
            typed: typed_from(&value["typed"])?,
        })
    }
}

fn typed_to(all: &BTreeMap<String, Vec<Typed>>) -> Value {
    let one = |it: &Typed| json!([it.line, it.time, it.edits, it.changes]);
    let all = all.iter();
    let all = all.map(|(name, lines)| (name.clone(), lines.iter().map(one).collect()));
    Value::Object(all.collect())
}

/// Files of before there were such lines have none.
fn typed_from(value: &Value) -> Option<BTreeMap<String, Vec<Typed>>> {
    if value.is_null() {
        return Some(BTreeMap::new());
    }
    let one = |value: &Value| {
        Some(Typed {
            line: value[0].as_str()?.to_owned(),
            time: value[1].as_f64()?,
            edits: usize::try_from(value[2].as_u64()?).ok()?,
            changes: value[3].as_bool()?,
        })
    };
    let lines = |value: &Value| value.as_array()?.iter().map(one).collect::<Option<_>>();
    let all = value.as_object()?.iter();
    all.map(|(name, value)| Some((name.clone(), lines(value)?)))
        .collect()
}

fn all_to(all: &BTreeMap<String, Settings>) -> Value {
    let one = |settings: &Settings| -> Value {
        let pairs = settings.iter().map(|(name, value)| match value {
            SettingValue::Text(text) => json!([name, text]),
            SettingValue::Number(number) => json!([name, number]),
            SettingValue::Switch(on) => json!([name, on]),
        });
        pairs.collect()
    };
    let all = all
        .iter()
        .map(|(name, settings)| (name.clone(), one(settings)));
    Value::Object(all.collect())
}

fn all_from(value: &Value) -> Option<BTreeMap<String, Settings>> {
    let one = |value: &Value| {
        let mut settings = Settings::new();
        for pair in value.as_array()? {
            let name = pair[0].as_str()?;
            let value = match &pair[1] {
                Value::String(text) => SettingValue::Text(text.clone()),
                Value::Number(number) => SettingValue::Number(number.as_f64()?),
                Value::Bool(on) => SettingValue::Switch(*on),
                _ => return None,
            };
            settings.set(name, value);
        }
        Some(settings)
    };
    let all = value.as_object()?.iter();
    all.map(|(name, value)| Some((name.clone(), one(value)?)))
        .collect()
}

/// The name of a way to show both pictures, in files.
fn mode_name(mode: Mode) -> &'static str {
    match mode {
        Mode::Split => "split",
        Mode::Flicker => "flicker",
        Mode::Difference => "difference",
        Mode::Flip => "flip",
    }
}

fn dials_to(dials: &Dials) -> Value {
    json!({
        "mode": mode_name(dials.mode),
        "split": f64::from(dials.split),
        "automatic": dials.automatic,
        "rate": f64::from(dials.rate),
        "gain": f64::from(dials.gain),
        "false_colors": dials.false_colors,
        "opacity": f64::from(dials.opacity),
        "speed": dials.speed,
        "steps": dials.steps,
    })
}

fn dials_from(value: &Value) -> Option<Dials> {
    let number = |name: &str| value[name].as_f64().filter(|number| number.is_finite());
    let single = |name: &str| number(name).map(|number| number as f32);
    let mode = value["mode"].as_str()?;
    let steps = value["steps"].as_u64().and_then(|n| u32::try_from(n).ok());
    Some(Dials {
        mode: Mode::ALL
            .into_iter()
            .find(|known| mode_name(*known) == mode)?,
        split: single("split")?.clamp(0.0, 1.0),
        automatic: value["automatic"].as_bool()?,
        rate: single("rate")?,
        gain: single("gain")?,
        false_colors: value["false_colors"].as_bool()?,
        opacity: single("opacity")?.clamp(0.0, 1.0),
        speed: number("speed")?,
        steps,
    })
}
