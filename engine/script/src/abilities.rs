//! What each pipeline can do, from what the pipelines themselves declare: one table for documents and
//! for the tests that hold each of its cells.

use lightbench_assets::files::Files;
use lightbench_render::PipelineDesc;
use lightbench_render::description::{Ability, ParameterKind};
use lightbench_render::problem::Problems;

use crate::pipeline::{PipelineEntry, load_pipeline};
use crate::settings::Settings;

/// The abilities that every pipeline tells of: the name in `p.supports` and `p.lacks`, and what a table
/// calls it.
pub const ABILITIES: [(&str, &str); 9] = [
    ("ambient", "ambient light"),
    ("transparency", "transparency"),
    ("msaa", "four samples"),
    ("clip_volumes", "clip volumes"),
    ("brdf_blinn_phong", "Blinn-Phong"),
    ("brdf_phong", "Phong"),
    ("brdf_beckmann", "Beckmann"),
    ("brdf_ggx", "GGX"),
    ("brdf_ward", "Ward"),
];

/// What a pipeline says of an ability.
#[derive(Clone, Debug, PartialEq)]
pub struct AbilityCell {
    /// The ability's name, as in [`ABILITIES`].
    pub ability: &'static str,
    /// Whether the pipeline can do it, if only with a setting.
    pub supported: bool,
    /// The setting that it takes, as in `volume_stencil=two_pass`; none where the default does.
    pub setting: Option<String>,
    /// By which means; or why not. Empty where the pipeline says nothing.
    pub text: String,
}

/// A pipeline's row: one cell for each of [`ABILITIES`].
///
/// Where the pipeline lacks an ability as it comes, each value of each of its parameters is tried, one
/// at a time, and the first is named with which it has it.
///
/// # Errors
/// Mistakes of the pipeline file.
pub fn abilities(files: &Files, pipeline: &PipelineEntry) -> Result<Vec<AbilityCell>, Problems> {
    let load = |settings: &Settings| load_pipeline(files, &pipeline.path, settings);
    let plain = load(&Settings::new())?;
    let mut variants = Vec::new();
    for text in one_at_a_time(&plain) {
        let mut settings = Settings::new();
        if settings.set_from_text(&text).is_ok()
            && let Ok(desc) = load(&settings)
        {
            variants.push((text, desc));
        }
    }
    let cell = |ability: &'static str| {
        let told = plain.ability(ability);
        let with = variants.iter().find_map(|(text, desc)| {
            let told = desc.ability(ability).filter(|told| told.supported)?;
            Some((text.clone(), told))
        });
        match (told, with) {
            (Some(told), _) if told.supported => supported(ability, None, told),
            (_, Some((setting, told))) => supported(ability, Some(setting), told),
            (told, None) => AbilityCell {
                ability,
                supported: false,
                setting: None,
                text: told.map_or_else(String::new, |told| told.text.clone()),
            },
        }
    };
    Ok(ABILITIES.iter().map(|(ability, _)| cell(ability)).collect())
}

fn supported(ability: &'static str, setting: Option<String>, told: &Ability) -> AbilityCell {
    AbilityCell {
        ability,
        supported: true,
        setting,
        text: told.text.clone(),
    }
}

/// Settings that change one parameter from its default.
fn one_at_a_time(desc: &PipelineDesc) -> Vec<String> {
    let mut texts = Vec::new();
    for parameter in &desc.parameters {
        match &parameter.kind {
            ParameterKind::Choice { options } => {
                let others = options.iter().skip(1);
                texts.extend(others.map(|option| format!("{}={option}", parameter.name)));
            }
            ParameterKind::Switch => {
                texts.extend(["on", "off"].map(|value| format!("{}={value}", parameter.name)));
            }
            ParameterKind::Number { .. } => {}
        }
    }
    texts
}
