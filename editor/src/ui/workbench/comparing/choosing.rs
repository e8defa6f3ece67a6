//! Which pipeline B is, and its values.

use lightbench::script::{SettingValue, Settings};

use super::super::Workbench;
use super::super::undo::Chosen;
use crate::ui::messages::say;

impl Workbench {
    /// Chooses the pipeline of B. Begins the comparison where there is none.
    pub fn select_other(&mut self, name: &str) {
        let what = say!("history.other", pipeline = name);
        self.as_place("other", &what, false, |this| {
            this.compare(true);
            if let Some(side) = &mut this.comparing.side {
                side.select(name);
                this.canvas.invalidate();
            }
        });
    }

    /// Gives B a pipeline and values that it had, whether it is shown or not.
    pub(in crate::ui::workbench) fn choose_other(&mut self, chosen: &Chosen) {
        if let Some(side) = &mut self.comparing.side {
            let before = side.pipelines.shown().map(str::to_owned);
            chosen.choose(&mut side.pipelines);
            if side.pipelines.shown() != before.as_deref() {
                side.timings.reset();
            }
        }
    }

    /// Gives B the pipeline and the values of A, to be changed then.
    pub fn other_like_this(&mut self) {
        let name = self.pipelines.selected().to_owned();
        let settings = self.pipelines.slot(&name);
        let settings = settings.map(|slot| slot.settings.clone());
        let what = say!("history.other_like_this");
        self.as_place("like", what, false, |this| {
            this.set_other(&name, settings.unwrap_or_default());
        });
    }

    /// Chooses the pipeline of B with values for its parameters.
    pub fn set_other(&mut self, name: &str, settings: Settings) {
        let what = say!("history.other", pipeline = name);
        self.as_place("other", &what, false, |this| {
            this.compare(true);
            if let Some(side) = &mut this.comparing.side {
                side.pipelines.select_with(name, settings);
                this.canvas.invalidate();
            }
        });
    }

    /// Gives a parameter of B a value, or with `None` its default.
    pub fn set_other_parameter(&mut self, parameter: &str, value: Option<SettingValue>) {
        let what = say!("history.other_parameter", parameter = parameter);
        self.as_place(&what, &what, false, |this| {
            if let Some(side) = &mut this.comparing.side {
                match value {
                    Some(value) => side.pipelines.set(parameter, value),
                    None => side.pipelines.unset(parameter),
                }
            }
        });
    }
}
