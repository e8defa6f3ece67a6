//! Checks what a pipeline says of reflection models.

use lightbench_assets::ReflectionModel;

use super::{Checker, FormatSupport};
use crate::problem::suggestion;

impl<S: FormatSupport> Checker<'_, S> {
    /// Abilities about reflection models name one, and none takes the default model away.
    pub(super) fn models(&mut self) {
        let desc = self.desc;
        for ability in &desc.abilities {
            let Some(name) = ability.reflection_model() else {
                continue;
            };
            match ReflectionModel::from_name(name) {
                Some(ReflectionModel::BlinnPhong) if !ability.supported => self.report(
                    &ability.at,
                    "every pipeline carries `blinn_phong`: it is what other models give way to"
                        .to_owned(),
                    "take the line out".to_owned(),
                ),
                Some(_) => {}
                None => {
                    let names = ReflectionModel::ALL.map(ReflectionModel::name);
                    let hint = suggestion(name, names)
                        .unwrap_or_else(|| format!("the models are: {}", names.join(", ")));
                    let message = format!("there is no reflection model `{name}`");
                    self.report(&ability.at, message, hint);
                }
            }
        }
    }
}
