//! The points of a plan: all combinations of the values of its axes, each with a name.

use lightbench_assets::Digest;
use lightbench_script::Settings;

use super::model::{Axis, CAMERA, Choice, Plan, SIZE, START};
use crate::report::Parameter;

/// Points that a study has at most. More would take days, and hint at a mistake.
pub const MOST_POINTS: usize = 10_000;

/// Why a plan can't be measured, in a sentence that says what to change.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct PlanError(pub String);

/// A point before it is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// Names it in all runs of the plan.
    pub key: String,
    /// The scene and the values of the axes.
    pub coordinates: Vec<Parameter>,
    /// The scene's place in the plan.
    pub scene: usize,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The frame at which the scene is drawn first.
    pub start: u32,
    /// The camera by its entity's name; the scene's own without.
    pub camera: Option<String>,
}

impl Plan {
    /// All points, the last axis varying fastest.
    ///
    /// # Errors
    /// Values of [`SIZE`] or [`START`] that are none, an axis without values, or too many points.
    pub fn points(&self) -> Result<Vec<Planned>, PlanError> {
        self.check()?;
        let mut points = Vec::new();
        for (index, scene) in self.scenes.iter().enumerate() {
            let mut combinations = vec![vec![Parameter {
                name: "scene".to_owned(),
                value: scene.name(),
            }]];
            for axis in &self.axes {
                combinations = combinations
                    .iter()
                    .flat_map(|before| {
                        axis.values.iter().map(|value| {
                            let mut coordinates = before.clone();
                            coordinates.push(Parameter {
                                name: axis.name.clone(),
                                value: value.clone(),
                            });
                            coordinates
                        })
                    })
                    .collect();
            }
            for coordinates in combinations {
                points.push(self.point(index, coordinates)?);
            }
        }
        Ok(points)
    }

    fn check(&self) -> Result<(), PlanError> {
        let fail = |text: String| Err(PlanError(text));
        if self.scenes.is_empty() || self.pipelines.is_empty() {
            return fail("a study needs a scene and a pipeline at least".to_owned());
        }
        let mut points = self.scenes.len();
        for (index, axis) in self.axes.iter().enumerate() {
            if self.axes[..index]
                .iter()
                .any(|known| known.name == axis.name)
            {
                return fail(format!(
                    "`{}` is swept twice; give all of its values at once",
                    axis.name
                ));
            }
            let Some(first) = axis.values.first() else {
                return fail(format!("`{}` is swept over no values", axis.name));
            };
            let twice = |value: &&String| axis.values.iter().filter(|v| v == value).count() > 1;
            if let Some(value) = axis.values.iter().find(twice) {
                return fail(format!("`{}` is swept over {value} twice", axis.name));
            }
            if first.contains('\n') {
                return fail(format!("a value of `{}` has more than one line", axis.name));
            }
            points = points.saturating_mul(axis.values.len());
        }
        if points > MOST_POINTS {
            return fail(format!(
                "the study has {points} points, and {MOST_POINTS} are the most; sweep over fewer values"
            ));
        }
        let names: Vec<String> = self.scenes.iter().map(Choice::name).collect();
        if let Some(twice) = names
            .iter()
            .enumerate()
            .find(|(i, name)| names[..*i].contains(name))
        {
            return fail(format!("two of the scenes are called `{}`", twice.1));
        }
        Ok(())
    }

    fn point(&self, scene: usize, coordinates: Vec<Parameter>) -> Result<Planned, PlanError> {
        let value = |name: &str| {
            coordinates
                .iter()
                .find(|c| c.name == name)
                .map(|c| &*c.value)
        };
        let size = match value(SIZE) {
            None => (self.size[0], self.size[1]),
            Some(text) => read_size(text)
                .ok_or_else(|| PlanError(format!("`{text}` is no size; write it as 640x360")))?,
        };
        let start = match value(START) {
            None => self.start,
            Some(text) => text
                .parse()
                .map_err(|_| PlanError(format!("`{text}` is no number of a frame, as 0 or 120")))?,
        };
        let words: Vec<String> = coordinates
            .iter()
            .map(|c| format!("{}={}", c.name, c.value))
            .collect();
        Ok(Planned {
            key: words.join(","),
            scene,
            size,
            start,
            camera: value(CAMERA).map(str::to_owned),
            coordinates,
        })
    }

    /// The scene's settings at a point.
    pub fn scene_settings(&self, point: &Planned) -> Settings {
        let mut settings = given(&self.scenes[point.scene]);
        for coordinate in &point.coordinates[1..] {
            let name = coordinate.name.as_str();
            if ![SIZE, START, CAMERA].contains(&name) && !name.contains('.') {
                settings.set(name, coordinate.value.as_str());
            }
        }
        settings
    }

    /// A pipeline's settings at a point. `name` is the pipeline's, and `has` says whether it has a
    /// parameter.
    pub fn pipeline_settings(
        &self,
        point: &Planned,
        pipeline: &Choice,
        name: &str,
        has: impl Fn(&str) -> bool,
    ) -> Settings {
        let tuned = self.tuned.iter();
        let mut tuned = tuned.filter(|tuned| tuned.key == point.key && tuned.pipeline == name);
        let mut settings = match tuned.next() {
            Some(tuned) => settings_of(&tuned.settings),
            None => given(pipeline),
        };
        for coordinate in &point.coordinates[1..] {
            match coordinate.name.rsplit_once('.') {
                Some(("*", parameter)) if has(parameter) => {
                    settings.set(parameter, coordinate.value.as_str());
                }
                Some((owner, parameter)) if owner == name => {
                    settings.set(parameter, coordinate.value.as_str());
                }
                _ => {}
            }
        }
        settings
    }
}

impl Choice {
    /// The label, or the name of the file without its ending.
    pub fn name(&self) -> String {
        self.label.clone().unwrap_or_else(|| {
            let file = self.path.rsplit('/').next().unwrap_or_default();
            let stem = [".rhai", ".scene"]
                .iter()
                .find_map(|end| file.strip_suffix(end));
            stem.unwrap_or(file).to_owned()
        })
    }
}

impl Axis {
    /// Reads `lights=4,16,64`.
    ///
    /// # Errors
    /// Text of another form.
    pub fn read(text: &str) -> Result<Self, PlanError> {
        let form = || {
            PlanError(format!(
                "`{text}` is no sweep; write a name and values, as in lights=4,16,64 or \
                 size=320x180,640x360"
            ))
        };
        let (name, values) = text.split_once('=').ok_or_else(form)?;
        let values: Vec<String> = values.split(',').map(|v| v.trim().to_owned()).collect();
        if name.trim().is_empty() || values.iter().any(String::is_empty) {
            return Err(form());
        }
        Ok(Self {
            name: name.trim().to_owned(),
            values,
        })
    }
}

fn given(choice: &Choice) -> Settings {
    settings_of(&choice.settings)
}

fn settings_of(parameters: &[Parameter]) -> Settings {
    let mut settings = Settings::new();
    for setting in parameters {
        settings.set(setting.name.as_str(), setting.value.as_str());
    }
    settings
}

fn read_size(text: &str) -> Option<(u32, u32)> {
    let (width, height) = text.split_once(['x', 'X', '×'])?;
    let read = |side: &str| side.trim().parse().ok().filter(|&side: &u32| side > 0);
    Some((read(width)?, read(height)?))
}

/// One of several machines' share of a study, written as `3/16`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub index: u32,
    /// Of how many.
    pub count: u32,
}

impl Shard {
    /// The keys of this share, in the order of the plan. Every point is in exactly one share, and
    /// shares differ by one point at the most. Points are dealt in the order of their keys' hashes,
    /// so that neighbours, which take long together, fall to different machines.
    pub fn of<'a>(self, keys: &[&'a str]) -> Vec<&'a str> {
        let mut dealt: Vec<(String, usize)> = keys
            .iter()
            .enumerate()
            .map(|(index, key)| (Digest::of(key.as_bytes()).to_string(), index))
            .collect();
        dealt.sort();
        let mut mine: Vec<usize> = dealt
            .into_iter()
            .enumerate()
            .filter(|(rank, _)| *rank as u32 % self.count == self.index - 1)
            .map(|(_, (_, index))| index)
            .collect();
        mine.sort_unstable();
        mine.into_iter().map(|index| keys[index]).collect()
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let read = || {
            let (index, count) = text.split_once('/')?;
            let (index, count): (u32, u32) =
                (index.trim().parse().ok()?, count.trim().parse().ok()?);
            (1..=count)
                .contains(&index)
                .then_some(Self { index, count })
        };
        read().ok_or_else(|| {
            "a share is written as its number and how many there are, as in 3/16; the first is 1/16"
                .to_owned()
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn plan(axes: &[&str]) -> Plan {
        let choice = |path: &str| Choice {
            path: path.into(),
            ..Choice::default()
        };
        Plan {
            scenes: vec![choice("atrium"), choice("my/room.scene")],
            pipelines: vec![choice("deferred_shading")],
            axes: axes.iter().map(|axis| Axis::read(axis).unwrap()).collect(),
            size: [64, 36],
            ..Plan::default()
        }
    }

    #[test]
    fn points_are_all_combinations() {
        let plan = plan(&["lights=4,16", "size=32x18, 8x8", "start=7"]);
        let points = plan.points().unwrap();
        let keys: Vec<&str> = points.iter().map(|p| p.key.as_str()).collect();
        assert_eq!(points.len(), 8);
        assert_eq!(keys[0], "scene=atrium,lights=4,size=32x18,start=7");
        assert_eq!(keys[1], "scene=atrium,lights=4,size=8x8,start=7");
        assert_eq!(keys[7], "scene=room,lights=16,size=8x8,start=7");
        assert_eq!((points[1].size, points[1].start), ((8, 8), 7));
        let settings = plan.scene_settings(&points[2]);
        let settings: Vec<String> = settings.iter().map(|(n, v)| format!("{n}={v}")).collect();
        assert_eq!(settings, ["lights=16"]);
    }

    #[test]
    fn values_reach_the_pipelines_that_they_are_meant_for() {
        let plan = plan(&["*.tile=8", "b.mode=fast", "lights=4"]);
        let point = &plan.points().unwrap()[0];
        let of = |name: &str, has: bool| {
            let settings = plan.pipeline_settings(point, &plan.pipelines[0], name, |_| has);
            settings
                .iter()
                .map(|(n, v)| format!("{n}={v}"))
                .collect::<Vec<_>>()
                .join(" ")
        };
        assert_eq!(of("a", true), "tile=8");
        assert_eq!(of("b", true), "tile=8 mode=fast");
        assert_eq!(of("b", false), "mode=fast");
    }

    #[test]
    fn mistakes_are_explained() {
        for (axes, word) in [
            (&["lights=4", "lights=8"][..], "swept twice"),
            (&["lights=4,4"], "over 4 twice"),
            (&["size=4"], "no size"),
            (&["start=-1"], "no number of a frame"),
        ] {
            let error = plan(axes).points().unwrap_err().0;
            assert!(error.contains(word), "{error}");
        }
        for text in ["", "lights", "=4", "lights=", "lights=4,,5"] {
            assert!(Axis::read(text).is_err(), "{text}");
        }
        let numbers: Vec<String> = (0..200).map(|i| i.to_string()).collect();
        let large = ["a=", "b="].map(|name| format!("{name}{}", numbers.join(",")));
        let error = plan(&[&large[0], &large[1]]).points().unwrap_err().0;
        assert!(error.contains("80000 points"), "{error}");
    }

    #[test]
    fn shares_hold_every_point_once() {
        let keys: Vec<String> = (0..23).map(|i| format!("scene=a,lights={i}")).collect();
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        for count in [1, 2, 5, 16, 40] {
            let mut all = Vec::new();
            for index in 1..=count {
                let share = Shard { index, count }.of(&keys);
                assert!(share.len().abs_diff(23 / count as usize) <= 1);
                all.extend(share);
            }
            all.sort_unstable();
            let mut expected = keys.clone();
            expected.sort_unstable();
            assert_eq!(all, expected);
        }
        assert_eq!(
            "3/16".parse(),
            Ok(Shard {
                index: 3,
                count: 16
            })
        );
        for text in ["0/4", "5/4", "3", "a/b", "1/0", ""] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }
}
