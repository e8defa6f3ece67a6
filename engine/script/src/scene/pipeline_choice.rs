//! The pipeline that a scene's scripts choose to be drawn with.

use lightbench_render::Problems;

use super::data::Stage;
use crate::api::{Api, Mistake};
use crate::pipeline::load_pipeline_within;
use crate::settings::Settings;

/// A pipeline that a script chooses.
#[derive(Clone, Debug, PartialEq)]
pub struct PipelineChoice {
    /// Its name, or the path of its file.
    pub name: String,
    /// Values for its parameters; the others have their defaults.
    pub settings: Settings,
}

/// What scripts have chosen.
#[derive(Debug, Default)]
pub(super) struct Chosen {
    /// Since somebody looked.
    pub(super) new: Option<PipelineChoice>,
    /// The last one, which is known to be good: one that is chosen in each step is read once.
    checked: Option<PipelineChoice>,
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
                let settings = match a.len() {
                    1 => Settings::new(),
                    _ => {
                        let values = a.value(1).read_lock::<rhai::Map>();
                        let wanted = "a map, as in `#{ tile_size: \"16\" }`";
                        let values = values.ok_or_else(|| a.wrong(1, wanted))?;
                        a.settings(&values, "`values` of `use_pipeline`")?
                    }
                };
                let choice = PipelineChoice {
                    name: a.text(0)?,
                    settings,
                };
                let data = &mut *stage.lock();
                if data.chosen.checked.as_ref() != Some(&choice) {
                    let PipelineChoice { name, settings } = &choice;
                    load_pipeline_within(&data.files, name, settings, &data.limits)
                        .map_err(first_mistake)?;
                    data.chosen.checked = Some(choice.clone());
                }
                data.chosen.new = Some(choice);
                Ok(())
            },
        );
    }
}

/// What is wrong with the pipeline or the values, told at the line that chooses it.
fn first_mistake(Problems(problems): Problems) -> Mistake {
    let first = problems.into_iter().next().map(Mistake::from);
    first.unwrap_or_else(|| Mistake::new("the pipeline can't be read"))
}
