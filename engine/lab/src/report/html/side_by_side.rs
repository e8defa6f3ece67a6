//! The pass lists of all pipelines beside the reference's, with what differs marked.

use super::At;
use super::table::{table, words};
use super::writer::Writer;
use crate::report::format::{bytes, count};
use crate::report::model::{PassResult, PipelineResult};

/// What differs is marked with this before it.
const MARK: &str = "≠ ";

/// One row a pass of any pipeline, one column a pipeline.
pub fn section(w: &mut Writer, at: &At) {
    let c = at.comparison;
    if c.pipelines.len() < 2 {
        return;
    }
    let reference = c.reference_result().unwrap_or(&c.pipelines[0]);
    let (id, heading) = (at.id("passes"), at.id("passes-h"));
    w.element(
        "section",
        &[("id", &id), ("aria-labelledby", &heading)],
        |w| {
            w.leaf("h2", &[("id", &heading)], &at.heading("Passes side by side"));
            let text = format!(
                "A cell has the counts and the modelled bytes of a frame. Passes are the same where \
                 name and kind are. {MARK}marks a count that differs from that of {}, + a pass that \
                 it does not have, and − one that is missing.",
                reference.label()
            );
            w.leaf("p", &[("class", "note")], &text);
            let mut columns = vec![words("Pass")];
            columns.extend(c.pipelines.iter().map(|p| words(p.label())));
            let rows: Vec<Vec<String>> = keys(&c.pipelines)
                .into_iter()
                .map(|(name, kind)| {
                    let mut row = vec![format!("{name} ({kind})")];
                    let expected = find(reference, name, kind);
                    row.extend(c.pipelines.iter().map(|p| {
                        cell(find(p, name, kind), expected, p.name == reference.name)
                    }));
                    row
                })
                .collect();
            table(w, "Passes of all pipelines, by name and kind.", &columns, &rows);
        },
    );
}

/// Name and kind of every pass, each once, in the order of the frames.
fn keys(pipelines: &[PipelineResult]) -> Vec<(&str, &str)> {
    let mut keys: Vec<(&str, &str)> = Vec::new();
    for p in pipelines {
        // A new pass goes after the one that it follows.
        let mut after = 0;
        for pass in &p.passes {
            let key = (pass.name.as_str(), pass.kind.as_str());
            match keys.iter().position(|k| *k == key) {
                Some(at) => after = after.max(at + 1),
                None => {
                    keys.insert(after, key);
                    after += 1;
                }
            }
        }
    }
    keys
}

fn find<'a>(p: &'a PipelineResult, name: &str, kind: &str) -> Option<&'a PassResult> {
    p.passes
        .iter()
        .find(|pass| pass.name == name && pass.kind == kind)
}

fn cell(found: Option<&PassResult>, expected: Option<&PassResult>, is_reference: bool) -> String {
    let Some(pass) = found else {
        return match expected {
            Some(_) if !is_reference => "− missing".into(),
            _ => String::new(),
        };
    };
    let values = [
        (
            "draws",
            pass.draws,
            expected.map(|e| e.draws),
            count as fn(u64) -> String,
        ),
        (
            "instances",
            pass.instances,
            expected.map(|e| e.instances),
            count,
        ),
        (
            "triangles",
            pass.triangles,
            expected.map(|e| e.triangles),
            count,
        ),
        (
            "dispatches",
            pass.dispatches,
            expected.map(|e| e.dispatches),
            count,
        ),
        (
            "read",
            pass.bytes_read,
            expected.map(|e| e.bytes_read),
            bytes,
        ),
        (
            "written",
            pass.bytes_written,
            expected.map(|e| e.bytes_written),
            bytes,
        ),
    ];
    let parts: Vec<String> = values
        .into_iter()
        .filter(|(_, value, expected, _)| *value > 0 || expected.is_some_and(|e| e > 0))
        .map(|(name, value, expected, text)| {
            let differs = expected.is_some_and(|e| e != value);
            let mark = if differs { MARK } else { "" };
            format!("{mark}{name} {}", text(value))
        })
        .collect();
    let text = if parts.is_empty() {
        "runs".to_owned()
    } else {
        parts.join(", ")
    };
    let dropped = if pass.dropped { " (left out)" } else { "" };
    match expected {
        None if !is_reference => format!("+ {text}{dropped}"),
        _ => format!("{text}{dropped}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pass(name: &str, draws: u64) -> PassResult {
        PassResult {
            name: name.into(),
            kind: "geometry".into(),
            draws,
            ..PassResult::default()
        }
    }

    #[test]
    fn what_differs_is_marked_in_words() {
        let (same, more) = (pass("a", 3), pass("a", 1200));
        assert_eq!(cell(Some(&same), Some(&same), false), "draws 3");
        assert_eq!(
            cell(Some(&more), Some(&same), false),
            "≠ draws 1\u{202F}200"
        );
        assert_eq!(cell(Some(&same), None, false), "+ draws 3");
        assert_eq!(cell(None, Some(&same), false), "− missing");
        assert_eq!(cell(None, None, false), "");
        assert_eq!(cell(Some(&pass("a", 0)), None, true), "runs");
    }

    #[test]
    fn passes_keep_the_order_of_frames() {
        let pipeline = |names: &[&str]| PipelineResult {
            passes: names.iter().map(|name| pass(name, 1)).collect(),
            ..PipelineResult::default()
        };
        let pipelines = [pipeline(&["a", "d"]), pipeline(&["a", "b", "d", "e"])];
        let names: Vec<&str> = keys(&pipelines).into_iter().map(|k| k.0).collect();
        assert_eq!(names, ["a", "b", "d", "e"]);
    }
}
