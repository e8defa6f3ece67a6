//! `plot(name, value)`: curves of numbers over the scene's time.

use std::collections::VecDeque;

use rhai::{Array, Dynamic};

use super::Scene;
use super::data::Stage;
use crate::api::{Api, Mistake};

/// Values kept of each curve; older ones are dropped.
pub const MOST_VALUES: usize = 2_000;

/// Curves of one scene.
const MOST_CURVES: usize = 64;

/// One curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// What the script calls it.
    pub name: String,
    /// Seconds of the scene and the value, oldest first. Time goes back where it was rewound.
    pub values: VecDeque<(f64, f64)>,
}

/// The curves of a scene, in the order in which they began.
#[derive(Clone, Debug, Default)]
pub(super) struct Plots {
    curves: Vec<Plot>,
    /// The end of the present step.
    time: f64,
}

impl Plots {
    pub(super) fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn add(&mut self, name: &str, value: f64) -> Result<(), Mistake> {
        let known = self.curves.iter().position(|curve| curve.name == name);
        let at = match known {
            Some(at) => at,
            None if self.curves.len() < MOST_CURVES => {
                self.curves.push(Plot {
                    name: name.to_owned(),
                    values: VecDeque::new(),
                });
                self.curves.len() - 1
            }
            None => {
                return Err(Mistake::new(format!(
                    "there are {MOST_CURVES} curves already, and may not be more"
                ))
                .with_hint("a curve is known by its name: plot one thing under one name"));
            }
        };
        let values = &mut self.curves[at].values;
        // The last value of a step counts, so that a curve has one for each moment.
        match values.back_mut() {
            Some((time, last)) if *time == self.time => *last = value,
            _ => values.push_back((self.time, value)),
        }
        if values.len() > MOST_VALUES {
            values.pop_front();
        }
        Ok(())
    }
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.section("Plots");
    let plotted = stage.clone();
    api.function(
        "plot(name, value)",
        "Adds a value to a curve over the scene's time, which the editor draws in its panel Plots. A \
         curve keeps its last 2000 values, one for each step; where a step plots several under one \
         name, the last one counts. The value is a finite number, or `true` or `false`, drawn as 1 or \
         0. Experiments read it with `frame.values(name)`.",
        move |a| {
            let value = match a.value(1).as_bool() {
                Ok(on) => f64::from(u8::from(on)),
                Err(_) => a.number(1)?,
            };
            plotted.lock().plots.add(&a.text(0)?, value)
        },
    );
    let asked = stage.clone();
    api.function(
        "values(name)",
        "The values of a curve so far, oldest first, as an array of numbers: empty where nothing was \
         plotted under that name.",
        move |a| {
            let name = a.text(0)?;
            let data = asked.lock();
            let curve = data.plots.curves.iter().find(|curve| curve.name == name);
            let values = curve.into_iter().flat_map(|curve| &curve.values);
            Ok(values
                .map(|(_, value)| Dynamic::from(*value))
                .collect::<Array>())
        },
    );
}

impl Scene {
    /// The curves that its scripts have plotted, in the order in which they began.
    #[must_use]
    pub fn plots(&self) -> Vec<Plot> {
        self.stage.lock().plots.curves.clone()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use lightbench_assets::Progress;

    use super::{MOST_VALUES, Plot};
    use crate::testing::project;
    use crate::{Scene, Settings, load_scene};

    fn scene(script: &str) -> Scene {
        let (_folder, files) = project(&[
            ("scripts/scenes/test.rhai", script),
            (
                "scripts/behaviours/height.rhai",
                "fn update(time) { plot(\"height\", 2 * time); }",
            ),
        ]);
        load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap()
    }

    #[test]
    fn scenes_and_behaviours_plot_over_the_time_of_the_scene() {
        let mut scene = scene(
            "plot(\"start\", 3); spawn().behave(\"height\");
             fn update(time, dt) { plot(\"late\", time > 0.6); plot(\"late\", time > 0.4); }",
        );
        scene.update(0.5, 0.5).unwrap();
        scene.update(1.0, 0.5).unwrap();
        let plot = |name: &str, values: &[(f64, f64)]| Plot {
            name: name.to_owned(),
            values: values.iter().copied().collect(),
        };
        assert_eq!(
            scene.plots(),
            [
                plot("start", &[(0.0, 3.0)]),
                plot("late", &[(0.5, 1.0), (1.0, 1.0)]),
                plot("height", &[(0.5, 1.0), (1.0, 2.0)]),
            ]
        );
    }

    #[test]
    fn old_values_are_dropped_and_scripts_read_what_is_left() {
        let mut scene = scene(
            "fn update(time) { plot(\"t\", time); print(`${values(\"t\").len()} ${values(\"no\")}`); }",
        );
        for step in 1..=MOST_VALUES + 5 {
            scene.update(step as f64, 1.0).unwrap();
            if step < MOST_VALUES + 5 {
                scene.take_log();
            }
        }
        let values = &scene.plots()[0].values;
        assert_eq!(values.len(), MOST_VALUES);
        assert_eq!(values[0], (6.0, 6.0));
        assert_eq!(scene.take_log()[0].text, format!("{MOST_VALUES} []"));
    }

    #[test]
    fn what_can_not_be_drawn_is_refused() {
        for (call, expected) in [
            ("plot(\"a\", \"b\")", "`value` of `plot` must be a number"),
            (
                "plot(\"a\", 0.0 / 0.0)",
                "`value` of `plot` is not a number",
            ),
            (
                "for i in 0..65 { plot(`${i}`, i); }",
                "there are 64 curves already",
            ),
        ] {
            let (_folder, files) = project(&[("scripts/scenes/test.rhai", &format!("{call};"))]);
            let loaded = load_scene(&files, "test", &Settings::new(), &Progress::new());
            let problems = loaded.unwrap_err();
            let message = &problems.0[0].message;
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
