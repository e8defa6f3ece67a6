//! The pipeline that a scene's scripts ask to be drawn with.

use lightbench_render::Problems;

use super::data::Stage;
use crate::api::{Api, Mistake, as_number};
use crate::host::find;
use crate::pipeline::{PIPELINES, load_pipeline_within};
use crate::settings::{SettingValue, Settings};

/// A pipeline that a script asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct PipelineWish {
    /// Its name, or the path of its file.
    pub name: String,
    /// Values for its parameters; the others have their defaults.
    pub settings: Settings,
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for form in ["use_pipeline(name)", "use_pipeline(name, values)"] {
        let stage = stage.clone();
        api.function(
            form,
            "Draws the scene with another pipeline from the next frame on, in the editor; commands draw with the \
             pipeline that they are given. `name` is as in `lightbench list pipelines`; `values` are for its \
             parameters, of which the others have their defaults.",
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
                let wish = PipelineWish { name, settings };
                // Asked for in each step it is looked at once.
                if data.wished.as_ref() != Some(&wish) {
                    let (name, settings) = (&wish.name, &wish.settings);
                    let read = load_pipeline_within(&data.files, name, settings, &data.limits);
                    read.map_err(first_mistake)?;
                    data.wished = Some(wish.clone());
                }
                data.wish = Some(wish);
                Ok(())
            },
        );
    }
}

/// What is wrong with the pipeline or the values, in the words of the line that asks for it.
fn first_mistake(Problems(problems): Problems) -> Mistake {
    let Some(first) = problems.into_iter().next() else {
        return Mistake::new("the pipeline can't be read");
    };
    let mistake = Mistake::new(first.message);
    match first.hint {
        Some(hint) => mistake.with_hint(hint),
        None => mistake,
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
