//! Measuring each pipeline at its best: which values of its tunable parameters are the fastest.
//!
//! A short study tries all values that a pipeline declares with `tunable`, at each point. The fastest
//! whose picture is that of the values given is chosen, and stands in the plan of the study proper.

use lightbench_render::PipelineDesc;

use super::history::PICTURE_BOUND;
use super::model::{Choice, Plan, Study, Tuned};
use crate::report::Parameter;
use crate::statistics::median;

/// The most combinations of one pipeline that are tried.
pub const MOST_CANDIDATES: usize = 24;

/// The plan that tries all values. `descriptions` are those of the plan's pipelines, in its order. The
/// candidates of pipeline 2 are called `2:0`, `2:1` and so on, the first with the values given.
pub fn tuning_plan(plan: &Plan, descriptions: &[PipelineDesc]) -> Plan {
    let mut pipelines = Vec::new();
    for (index, (choice, desc)) in plan.pipelines.iter().zip(descriptions).enumerate() {
        for (number, chosen) in candidates(desc).into_iter().enumerate() {
            let mut settings = choice.settings.clone();
            settings.retain(|known| chosen.iter().all(|new| new.name != known.name));
            settings.extend(chosen);
            pipelines.push(Choice {
                label: Some(format!("{index}:{number}")),
                path: choice.path.clone(),
                settings,
            });
        }
    }
    Plan {
        title: format!("{}: tuning", plan.title),
        reference: "0:0".to_owned(),
        pipelines,
        processes: 1,
        seconds: plan.seconds / 2.0,
        ..plan.clone()
    }
}

/// All combinations of a pipeline's tunable values, the values in force first.
fn candidates(desc: &PipelineDesc) -> Vec<Vec<Parameter>> {
    let mut all: Vec<Vec<Parameter>> = vec![Vec::new()];
    for parameter in &desc.parameters {
        let mut values = parameter.tuned_values();
        if values.is_empty() || values.len() * all.len() > MOST_CANDIDATES {
            continue;
        }
        let in_force = parameter.value.to_string();
        values.sort_by_key(|value| *value != in_force);
        all = values
            .iter()
            .flat_map(|value| {
                all.iter().map(|before| {
                    let mut combination = before.clone();
                    combination.push(Parameter {
                        name: parameter.name.clone(),
                        value: value.clone(),
                    });
                    combination
                })
            })
            .collect();
    }
    // Those that were varied last change fastest, but the values in force stay first.
    all
}

/// Puts the fastest values of each pipeline at each point into the plan.
pub fn choose(plan: &mut Plan, tried: &Study) {
    plan.tuned.clear();
    for point in &tried.points {
        for (index, choice) in plan.pipelines.iter().enumerate() {
            let prefix = format!("{index}:");
            let results = point.comparison.pipelines.iter();
            let mine: Vec<_> = results.filter(|p| p.name.starts_with(&prefix)).collect();
            let Some(given) = mine.first().and_then(|p| p.picture.as_ref()) else {
                continue;
            };
            let time = |p: &crate::report::PipelineResult| {
                let times = p.gpu_samples().unwrap_or(&p.frame_cpu_ms);
                median(times).unwrap_or(f64::INFINITY)
            };
            let shows_the_same = |p: &&&crate::report::PipelineResult| {
                p.picture.as_ref().is_some_and(|picture| {
                    let options = crate::diff::DiffOptions::default();
                    let found = crate::diff::diff_ldr(given, picture, options);
                    found.is_ok_and(|found| found.difference.flip.mean <= PICTURE_BOUND)
                })
            };
            let fastest = mine.iter().filter(shows_the_same);
            let Some(fastest) = fastest.min_by(|a, b| time(a).total_cmp(&time(b))) else {
                continue;
            };
            let of = tried.plan.pipelines.iter();
            let settings = of.filter(|c| c.label.as_deref() == Some(&fastest.name));
            plan.tuned.extend(settings.map(|tuned| Tuned {
                key: point.key.clone(),
                pipeline: choice.name(),
                settings: tuned.settings.clone(),
            }));
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::sample;
    use crate::study::Point;
    use lightbench_render::Place;
    use lightbench_render::description::{self, ParameterKind, ParameterValue};

    fn desc() -> PipelineDesc {
        let choice = |name: &str, options: &[&str], value: &str, tunable| description::Parameter {
            name: name.into(),
            at: Place::default(),
            description: String::new(),
            unit: String::new(),
            kind: ParameterKind::Choice {
                options: options.iter().map(|o| (*o).to_owned()).collect(),
            },
            default: ParameterValue::Choice(value.into()),
            value: ParameterValue::Choice(value.into()),
            tunable,
        };
        PipelineDesc {
            name: "tiled".into(),
            parameters: vec![
                choice("tile", &["8", "16", "32"], "16", true),
                choice("look", &["a", "b"], "a", false),
                choice("mask", &["x", "y"], "x", true),
            ],
            ..PipelineDesc::default()
        }
    }

    #[test]
    fn all_tunable_values_are_tried_the_given_ones_first() {
        let all = candidates(&desc());
        let words: Vec<String> = all
            .iter()
            .map(|c| {
                c.iter()
                    .map(|p| p.value.as_str())
                    .collect::<Vec<_>>()
                    .join(" ")
            })
            .collect();
        assert_eq!(words, ["16 x", "8 x", "32 x", "16 y", "8 y", "32 y"]);
    }

    #[test]
    fn the_fastest_with_the_same_picture_is_chosen() {
        let mut plan = Plan {
            scenes: vec![Choice {
                path: "hall".into(),
                ..Choice::default()
            }],
            pipelines: vec![Choice {
                path: "tiled".into(),
                ..Choice::default()
            }],
            processes: 5,
            seconds: 5.0,
            size: [64, 36],
            ..Plan::default()
        };
        let tuning = tuning_plan(&plan, &[desc()]);
        assert_eq!((tuning.pipelines.len(), tuning.processes), (6, 1));
        let result = |index: usize, time: f64, shift: f64| {
            let name = format!("0:{index}");
            sample::pipeline(&name, "", time, sample::picture(64, 36, shift, 0.5))
        };
        // The fastest shows something else.
        let pipelines = vec![
            result(0, 9.0, 0.0),
            result(1, 1.0, 0.2),
            result(2, 4.0, 0.0),
        ];
        let key = plan.points().unwrap()[0].key.clone();
        let tried = Study {
            schema: crate::report::SCHEMA,
            plan: tuning,
            points: vec![Point {
                key: key.clone(),
                coordinates: Vec::new(),
                comparison: sample::with(pipelines),
            }],
            missing: Vec::new(),
        };
        choose(&mut plan, &tried);
        assert_eq!(plan.tuned.len(), 1);
        assert_eq!(
            (plan.tuned[0].key.as_str(), plan.tuned[0].pipeline.as_str()),
            (key.as_str(), "tiled")
        );
        let point = &plan.points().unwrap()[0];
        let settings = plan.pipeline_settings(point, &plan.pipelines[0], "tiled", |_| true);
        let words: Vec<String> = settings.iter().map(|(n, v)| format!("{n}={v}")).collect();
        assert_eq!(words, ["tile=32", "mask=x"]);
    }
}
