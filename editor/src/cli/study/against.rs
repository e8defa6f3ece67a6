//! What changed since an earlier report, on the terminal.

use std::path::Path;

use anyhow::Context as _;
use lightbench::lab::report::format::significant;
use lightbench::lab::report::read_json;
use lightbench::lab::statistics::Interval;
use lightbench::lab::study::Study;
use lightbench::lab::study::history::{
    Change, Changes, PictureChange, Reported, TimeChange, changes,
};

use crate::cli::report::{note, say};

/// Compares a study with the one that a JSON file holds, and says what changed. Returns whether
/// somebody has to look at it.
///
/// # Errors
/// A file that can't be read.
pub fn compare(study: &Study, folder: &Path, old: &Path) -> anyhow::Result<bool> {
    let before = read_json(old)?;
    let old_folder = old.parent().context("the old report has no folder")?;
    let found = changes(
        Reported { study, folder },
        Reported {
            study: &before,
            folder: old_folder,
        },
    )?;
    print(&found)?;
    Ok(found.changes.iter().any(Change::is_worse_or_different))
}

/// Says all changes, and counts what stayed.
pub fn print(found: &Changes) -> anyhow::Result<()> {
    let mut equal = 0;
    let mut undecided = 0;
    let mut other_machine = false;
    for change in &found.changes {
        let mut words = Vec::new();
        match change.time {
            TimeChange::Faster(ratio, interval) => {
                words.push(time("faster", 1.0 / ratio, invert(interval)))
            }
            TimeChange::Slower(ratio, interval) => words.push(time("slower", ratio, interval)),
            TimeChange::Same(..) => {}
            TimeChange::Undecided(..) | TimeChange::TooFew => undecided += 1,
            TimeChange::OtherMachine => other_machine = true,
        }
        match change.picture {
            PictureChange::Differs(mean, max) => words.push(format!(
                "another picture (FLIP {} in the mean, {} at most)",
                significant(mean),
                significant(max)
            )),
            PictureChange::WithinBound(mean, _) => words.push(format!(
                "a picture that differs by rounding alone (FLIP {} in the mean)",
                significant(mean)
            )),
            PictureChange::OtherSize => words.push("a picture of another size".to_owned()),
            PictureChange::Equal | PictureChange::Missing => {}
        }
        words.extend(change.counts.iter().cloned());
        if words.is_empty() {
            equal += 1;
        } else {
            say(format!(
                "{}, {}: {}",
                change.key,
                change.pipeline,
                words.join("; ")
            ))?;
        }
    }
    for missing in &found.missing {
        say(missing)?;
    }
    say(format!(
        "{equal} of {} pipelines at points have no change beyond noise.",
        found.changes.len()
    ))?;
    if undecided > 0 {
        note(format!(
            "the times of {undecided} do not decide whether they changed"
        ));
    }
    if other_machine {
        note("the reports are of different machines or drivers: their times are not compared");
    }
    Ok(())
}

fn time(verdict: &str, ratio: f64, interval: Interval) -> String {
    format!(
        "{verdict}, {} times (interval {} to {})",
        significant(ratio),
        significant(interval.low),
        significant(interval.high)
    )
}

fn invert(interval: Interval) -> Interval {
    Interval {
        low: 1.0 / interval.high,
        high: 1.0 / interval.low,
        ..interval
    }
}
