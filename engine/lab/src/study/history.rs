//! What changed between two runs of a study: times beyond noise, pictures beyond rounding, counts at all.

use std::path::Path;

use super::model::{Point, Study};
use crate::diff::{DiffOptions, diff_ldr};
use crate::metrics::DEFAULT_BOUND;
use crate::report::analysis::{Clock, MARGIN, samples};
use crate::report::{Comparison, PipelineResult};
use crate::statistics::{CONFIDENCE, Interval, ProcessRatio, holm, median};
use crate::{LabError, LdrImage, Picture};

/// The mean FLIP up to which pictures of different drivers may differ by rounding, where no pixel is
/// above [`DEFAULT_BOUND`] too.
pub const PICTURE_BOUND: f64 = 0.005;

/// What became of a frame time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeChange {
    /// Faster by more than 5 %, and the corrected interval supports it.
    Faster(f64, Interval),
    /// Slower by more than 5 %, and the corrected interval supports it.
    Slower(f64, Interval),
    /// The same within 5 %, and the interval supports it.
    Same(f64, Interval),
    /// The interval reaches over the margin.
    Undecided(f64, Interval),
    /// Fewer than five processes in one of the runs, or no common clock.
    TooFew,
    /// The runs are of different machines or drivers, so that no ratio is formed.
    OtherMachine,
}

/// What became of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PictureChange {
    /// All pixels are equal.
    Equal,
    /// They differ by rounding: mean and largest FLIP.
    WithinBound(f64, f64),
    /// They differ: mean and largest FLIP.
    Differs(f64, f64),
    /// The sizes differ.
    OtherSize,
    /// One of the runs has no picture.
    Missing,
}

/// One pipeline at one point in both runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The point.
    pub key: String,
    /// The pipeline.
    pub pipeline: String,
    /// Its frame time now against then.
    pub time: TimeChange,
    /// Its picture.
    pub picture: PictureChange,
    /// Counts that differ, each in words: draws, triangles, bytes and what shaders counted.
    pub counts: Vec<String>,
}

impl Change {
    /// Whether somebody has to look: slower, another picture, or other counts.
    pub fn is_worse_or_different(&self) -> bool {
        matches!(self.time, TimeChange::Slower(..))
            || matches!(
                self.picture,
                PictureChange::Differs(..) | PictureChange::OtherSize
            )
            || !self.counts.is_empty()
    }
}

/// All that changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Every pipeline at every point that both runs have.
    pub changes: Vec<Change>,
    /// What one of the runs lacks, in words.
    pub missing: Vec<String>,
}

/// A study that was read from its JSON file; its pictures lie beside it.
#[derive(Clone, Copy, Debug)]
pub struct Reported<'a> {
    /// The study.
    pub study: &'a Study,
    /// The folder of the file.
    pub folder: &'a Path,
}

/// Compares a study with an earlier one.
///
/// # Errors
/// Pictures that can't be read.
pub fn changes(new: Reported<'_>, old: Reported<'_>) -> Result<Changes, LabError> {
    let mut found = Changes::default();
    let mut pairs = Vec::new();
    for point in &new.study.points {
        let Some(before) = old.study.points.iter().find(|known| known.key == point.key) else {
            found
                .missing
                .push(format!("{} was not measured before", point.key));
            continue;
        };
        for (now, then) in both(&mut found.missing, point, before) {
            let change = Change {
                key: point.key.clone(),
                pipeline: now.name.clone(),
                time: TimeChange::TooFew,
                picture: picture((now, new.folder), (then, old.folder))?,
                counts: counts(now, then),
            };
            pairs.push(times(&point.comparison, now, &before.comparison, then));
            found.changes.push(change);
        }
    }
    for point in &old.study.points {
        if !new.study.points.iter().any(|known| known.key == point.key) {
            found
                .missing
                .push(format!("{} is not measured any more", point.key));
        }
    }
    decide(&mut found.changes, pairs);
    Ok(found)
}

fn both<'a>(
    missing: &mut Vec<String>,
    now: &'a Point,
    then: &'a Point,
) -> Vec<(&'a PipelineResult, &'a PipelineResult)> {
    let (news, olds) = (&now.comparison.pipelines, &then.comparison.pipelines);
    let of = |all: &'a [PipelineResult], name: &str| all.iter().find(|p| p.name == name);
    for old in olds.iter().filter(|old| of(news, &old.name).is_none()) {
        missing.push(format!(
            "{}: {} is not measured any more",
            now.key, old.name
        ));
    }
    let mut pairs = Vec::new();
    for new in news {
        match of(olds, &new.name) {
            Some(old) => pairs.push((new, old)),
            None => missing.push(format!("{}: {} was not measured before", now.key, new.name)),
        }
    }
    pairs
}

/// The ratio of the times now and then, before it is corrected for all others.
enum Times {
    Known(ProcessRatio),
    TooFew,
    OtherMachine,
}

fn times(now: &Comparison, new: &PipelineResult, then: &Comparison, old: &PipelineResult) -> Times {
    if (&now.machine, &now.adapter) != (&then.machine, &then.adapter) {
        return Times::OtherMachine;
    }
    let clock = match (new.gpu_samples(), old.gpu_samples()) {
        (Some(_), Some(_)) => Clock::Gpu,
        _ => Clock::Cpu,
    };
    let medians = |p: &PipelineResult| -> Vec<f64> {
        let parts = p.by_process(samples(p, clock));
        parts.into_iter().filter_map(median).collect()
    };
    match ProcessRatio::between(&medians(new), &medians(old)) {
        Some(ratio) => Times::Known(ratio),
        None => Times::TooFew,
    }
}

fn decide(changes: &mut [Change], times: Vec<Times>) {
    let known = times.iter().filter_map(|time| match time {
        Times::Known(ratio) => Some(ratio.doubt(MARGIN)),
        _ => None,
    });
    let mut levels = holm(&known.collect::<Vec<_>>(), CONFIDENCE).into_iter();
    for (change, time) in changes.iter_mut().zip(times) {
        change.time = match time {
            Times::OtherMachine => TimeChange::OtherMachine,
            Times::TooFew => TimeChange::TooFew,
            Times::Known(ratio) => {
                let interval = ratio.interval(levels.next().unwrap_or(CONFIDENCE));
                let (slow, fast) = (1.0 + MARGIN, 1.0 / (1.0 + MARGIN));
                let ratio = ratio.ratio();
                if interval.low > slow {
                    TimeChange::Slower(ratio, interval)
                } else if interval.high < fast {
                    TimeChange::Faster(ratio, interval)
                } else if interval.low >= fast && interval.high <= slow {
                    TimeChange::Same(ratio, interval)
                } else {
                    TimeChange::Undecided(ratio, interval)
                }
            }
        };
    }
}

fn picture(
    (new, new_folder): (&PipelineResult, &Path),
    (old, old_folder): (&PipelineResult, &Path),
) -> Result<PictureChange, LabError> {
    let open = |result: &PipelineResult, folder: &Path| -> Result<Option<LdrImage>, LabError> {
        if let Some(picture) = &result.picture {
            return Ok(Some(picture.clone()));
        }
        let Some(file) = &result.picture_file else {
            return Ok(None);
        };
        match Picture::open(&folder.join(file))? {
            Picture::Ldr(picture) => Ok(Some(picture)),
            Picture::Hdr(_) => Ok(None),
        }
    };
    let (Some(new), Some(old)) = (open(new, new_folder)?, open(old, old_folder)?) else {
        return Ok(PictureChange::Missing);
    };
    if (new.width, new.height) != (old.width, old.height) {
        return Ok(PictureChange::OtherSize);
    }
    let found = diff_ldr(&old, &new, DiffOptions::default())?.difference;
    let (mean, max) = (found.flip.mean, found.flip.max);
    Ok(if found.is_identical() {
        PictureChange::Equal
    } else if mean <= PICTURE_BOUND && max <= DEFAULT_BOUND {
        PictureChange::WithinBound(mean, max)
    } else {
        PictureChange::Differs(mean, max)
    })
}

/// Counts that differ. Fragments are left out: drivers count them differently.
fn counts(new: &PipelineResult, old: &PipelineResult) -> Vec<String> {
    let mut words = Vec::new();
    let mut compare = |what: String, new: f64, old: f64| {
        if new != old {
            words.push(format!("{what} {old} → {new}"));
        }
    };
    compare(
        "bytes of targets".to_owned(),
        new.target_bytes_total as f64,
        old.target_bytes_total as f64,
    );
    for pass in &new.passes {
        let Some(before) = old.passes.iter().find(|p| p.name == pass.name) else {
            continue;
        };
        for (what, new, old) in [
            ("draws", pass.draws, before.draws),
            ("instances", pass.instances, before.instances),
            ("triangles", pass.triangles, before.triangles),
            ("dispatches", pass.dispatches, before.dispatches),
            ("bytes read", pass.bytes_read, before.bytes_read),
            ("bytes written", pass.bytes_written, before.bytes_written),
        ] {
            compare(format!("{}: {what}", pass.name), new as f64, old as f64);
        }
    }
    for counter in &new.counters {
        let before = old.counters.iter().find(|known| known.name == counter.name);
        // The first frame is the same in both, however many there was time for.
        let first = (
            counter.values.first(),
            before.and_then(|c| c.values.first()),
        );
        if let (Some(new), Some(old)) = first {
            compare(counter.name.clone(), *new, *old);
        }
    }
    let names = |p: &PipelineResult| -> Vec<String> {
        p.passes.iter().map(|pass| pass.name.clone()).collect()
    };
    if names(new) != names(old) {
        words.push(format!(
            "passes {} → {}",
            names(old).join(", "),
            names(new).join(", ")
        ));
    }
    words
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::sample;
    use crate::study::Plan;

    /// A study of one point with one pipeline, which takes so long in each process.
    fn study(times: &[f64], shift: f64) -> Study {
        let picture = sample::picture(64, 36, shift, 0.5);
        let mut pipeline = sample::pipeline("deferred_shading", "Deferred", 10.0, picture);
        let frames: Vec<f64> = times.iter().flat_map(|ms| [*ms, *ms]).collect();
        pipeline.frame_cpu_ms = frames.clone();
        pipeline.frame_gpu_ms = Some(frames);
        pipeline.process_frames = vec![2; times.len()];
        Study {
            schema: crate::report::SCHEMA,
            plan: Plan::default(),
            points: vec![Point {
                key: "scene=a".into(),
                coordinates: Vec::new(),
                comparison: sample::with(vec![pipeline]),
            }],
            missing: Vec::new(),
        }
    }

    fn compare(new: &Study, old: &Study) -> Changes {
        let folder = Path::new("nowhere");
        changes(
            Reported { study: new, folder },
            Reported { study: old, folder },
        )
        .unwrap()
    }

    const BASE: [f64; 6] = [10.0, 10.1, 9.9, 10.05, 9.95, 10.0];

    #[test]
    fn times_change_beyond_noise_or_not() {
        let old = study(&BASE, 0.0);
        let time =
            |factor: f64| compare(&study(&BASE.map(|t| t * factor), 0.0), &old).changes[0].time;
        assert!(matches!(time(1.0), TimeChange::Same(ratio, _) if (ratio - 1.0).abs() < 1e-9));
        assert!(matches!(time(1.3), TimeChange::Slower(ratio, _) if (ratio - 1.3).abs() < 1e-9));
        assert!(matches!(time(0.5), TimeChange::Faster(..)));
        assert!(matches!(time(1.055), TimeChange::Undecided(..)));
        let few = compare(&study(&BASE[..4], 0.0), &old);
        assert_eq!(few.changes[0].time, TimeChange::TooFew);
    }

    #[test]
    fn no_ratio_is_formed_across_machines() {
        let old = study(&BASE, 0.0);
        let mut new = study(&BASE.map(|t| 2.0 * t), 0.0);
        new.points[0].comparison.machine.cpu = "Another".into();
        let change = &compare(&new, &old).changes[0];
        assert_eq!(change.time, TimeChange::OtherMachine);
        assert!(!change.is_worse_or_different());
    }

    #[test]
    fn pictures_are_equal_within_the_bound_or_different() {
        let old = study(&BASE, 0.0);
        assert_eq!(
            compare(&study(&BASE, 0.0), &old).changes[0].picture,
            PictureChange::Equal
        );
        let mut near = study(&BASE, 0.0);
        let picture = near.points[0].comparison.pipelines[0]
            .picture
            .as_mut()
            .unwrap();
        picture.pixels[100][0] ^= 1;
        let change = &compare(&near, &old).changes[0];
        assert!(matches!(change.picture, PictureChange::WithinBound(mean, _) if mean > 0.0));
        assert!(!change.is_worse_or_different());
        let change = &compare(&study(&BASE, 0.05), &old).changes[0];
        assert!(matches!(change.picture, PictureChange::Differs(..)));
        assert!(change.is_worse_or_different());
    }

    #[test]
    fn counts_and_what_is_missing_are_named() {
        let old = study(&BASE, 0.0);
        let mut new = study(&BASE, 0.0);
        new.points[0].comparison.pipelines[0].passes[0].draws += 1;
        new.points[0].comparison.pipelines[0].target_bytes_total += 8;
        let counts = &compare(&new, &old).changes[0].counts;
        assert_eq!(counts.len(), 2);
        assert!(counts[0].starts_with("bytes of targets") && counts[1].contains("draws 84 → 85"));
        new.points[0].key = "scene=b".into();
        let missing = compare(&new, &old).missing;
        assert_eq!(
            missing,
            [
                "scene=b was not measured before",
                "scene=a is not measured any more"
            ]
        );
    }
}
