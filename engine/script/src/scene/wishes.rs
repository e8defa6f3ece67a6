//! The pipeline that a scene's scripts ask to be drawn with.

use super::data::Stage;
use crate::api::{Api, Mistake, as_number};
use crate::host::find;
use crate::pipeline::PIPELINES;
use crate::settings::{SettingValue, Settings};

/// A pipeline that a script asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct PipelineWish {
    /// Its name, or the path of its file.
    pub name: String,
    /// Values for its parameters; the others keep those that they have.
    pub settings: Settings,
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for form in ["use_pipeline(name)", "use_pipeline(name, values)"] {
        let stage = stage.clone();
        api.function(
            form,
            "Draws the scene with another pipeline from the next frame on, in the editor; commands draw with the \
             pipeline that they are given. `name` is as in `lightbench list pipelines`; `values` are for its \
             parameters.",
            move |a| {
                let name = a.text(0)?;
                let data = &mut *stage.lock();
                find(&data.files, PIPELINES, &name).map_err(|problem| {
                    let mistake = Mistake::new(problem.message);
                    match problem.hint {
                        Some(hint) => mistake.with_hint(hint),
                        None => mistake,
                    }
                })?;
                let mut settings = Settings::new();
                if a.len() > 1 {
                    let values = a.value(1).read_lock::<rhai::Map>();
                    let values =
                        values.ok_or_else(|| a.wrong(1, "a map, as in `#{ tile_size: \"16\" }`"))?;
                    for (name, value) in values.iter() {
                        settings.set(name.as_str(), setting(value).ok_or_else(|| {
                            Mistake::new(format!(
                                "`{name}` must be a number, a text, `true` or `false`, not {}",
                                a.describe(value)
                            ))
                        })?);
                    }
                }
                data.wish = Some(PipelineWish { name, settings });
                Ok(())
            },
        );
    }
}

fn setting(value: &rhai::Dynamic) -> Option<SettingValue> {
    if let Ok(on) = value.as_bool() {
        return Some(SettingValue::Switch(on));
    }
    if let Some(number) = as_number(value) {
        return Some(SettingValue::Number(number));
    }
    value.clone().into_string().ok().map(SettingValue::Text)
}
