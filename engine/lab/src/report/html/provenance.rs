//! How to run it again, on what it ran, and how to read the numbers.

use lightbench_assets::Digest;

use super::table::{facts, numbers, table, words};
use super::writer::Writer;
use super::{At, or_dash};
use crate::metrics::Metric;
use crate::report::analysis::{Analysis, MARGIN};
use crate::report::format::{bytes, significant};
use crate::report::model::Comparison;
use crate::statistics::CONFIDENCE;
use crate::study::Study;

/// A BibTeX entry of the report. What it was made from is in one number: the SHA-256 of the list of
/// all inputs' hashes, so that two reports with the same inputs have the same.
fn bibtex(study: &Study, c: &Comparison) -> String {
    let mut inputs: Vec<&str> = study
        .points
        .iter()
        .flat_map(|point| &point.comparison.inputs)
        .map(|input| input.hash.as_str())
        .collect();
    inputs.sort_unstable();
    inputs.dedup();
    let digest = Digest::of(inputs.join("\n").as_bytes()).to_string();
    let year = c.created.get(..4).unwrap_or_default();
    // Braces and backslashes mean something to BibTeX.
    let plain = |text: &str| text.replace(['{', '}', '\\'], "");
    format!(
        "@misc{{lightbench-{},\n  title = {{{}}},\n  author = {{{{The Lightbench authors}}}},\n  year = {{{year}}},\n  \
         howpublished = {{Report of Lightbench {}}},\n  note = {{Measured {} on {} with {} {}. Inputs: SHA-256 {digest}}},\n}}",
        &digest[..8],
        plain(if study.plan.title.is_empty() {
            &c.title
        } else {
            &study.plan.title
        }),
        c.program_version,
        c.created,
        plain(&c.machine.cpu),
        plain(&c.adapter.name),
        plain(&c.adapter.driver_info),
    )
}

/// Command, versions, machine, settings and inputs.
pub fn run_again_section(w: &mut Writer, study: &Study, c: &Comparison) {
    w.element("section", &[("id", "again"), ("aria-labelledby", "again-h")], |w| {
        w.leaf("h2", &[("id", "again-h")], "How to run it again");
        let version = &c.program_version;
        w.leaf("p", &[], &format!("With Lightbench {version} and the inputs listed below:"));
        w.element("div", &[("class", "command")], |w| {
            w.element("pre", &[("tabindex", "0"), ("aria-label", "Command line")], |w| {
                w.leaf("code", &[("id", "command")], &c.command_line);
            });
            w.leaf("button", &[("type", "button"), ("id", "copy"), ("hidden", "")], "Copy");
        });
        let text = "Pictures and counts come out the same on the same driver. Times depend on the \
                    machine and its load.";
        w.leaf("p", &[("class", "note")], text);
        w.leaf("h3", &[], "How to cite it");
        w.element("pre", &[("tabindex", "0"), ("aria-label", "BibTeX entry")], |w| {
            w.leaf("code", &[], &bibtex(study, c));
        });
        w.leaf("h3", &[], "Machine");
        let a = &c.adapter;
        let kind = if a.software { format!("{}, a software driver", a.kind) } else { a.kind.clone() };
        facts(w, &[
            ("Processor", format!("{}, {} logical processors", c.machine.cpu, c.machine.cores)),
            ("Memory", bytes(c.machine.memory_bytes)),
            ("System", c.machine.os.clone()),
            ("Adapter", a.name.clone()),
            ("Kind", kind),
            ("Driver", format!("{} {}", a.driver, a.driver_info).trim().to_owned()),
            ("Graphics interface", a.backend.clone()),
        ]);
        w.leaf("h3", &[], "Settings");
        let mut settings = vec![
            ("Scene", c.scene.clone()),
            ("Picture", format!("{} × {} pixels", c.size[0], c.size[1])),
            ("Frames", format!("{} measured after {} of warm-up", c.frames, c.warmup_frames)),
            ("Reference", c.reference.clone()),
        ];
        settings.extend(c.parameters.iter().map(|p| (p.name.as_str(), p.value.clone())));
        for axis in &study.plan.axes {
            settings.push((&axis.name, format!("varied: {}", axis.values.join(", "))));
        }
        let seeds: Vec<String> = c.seeds.iter().map(|s| format!("{} {}", s.name, s.value)).collect();
        if !seeds.is_empty() {
            settings.push(("Seeds", seeds.join(", ")));
        }
        for p in c.pipelines.iter().filter(|p| !p.features_needed.is_empty()) {
            settings.push(("Needs", format!("{}: {}", p.label(), p.features_needed.join(", "))));
        }
        facts(w, &settings);
        processes(w, study);
        if !c.inputs.is_empty() {
            let columns = [words("File"), words("Hash"), words("Value")];
            let rows: Vec<Vec<String>> = c
                .inputs
                .iter()
                .map(|i| vec![i.path.clone(), i.algorithm.clone(), i.hash.clone()])
                .collect();
            table(w, "Inputs and the hashes of their content.", &columns, &rows);
        }
    });
}

/// The processes that measured, point by point.
fn processes(w: &mut Writer, study: &Study) {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for point in &study.points {
        for process in &point.comparison.processes {
            rows.push(vec![
                point.key.clone(),
                (process.index + 1).to_string(),
                process.started.clone(),
                significant(process.seconds),
                or_dash(process.load_average.map(|load| format!("{load:.2}"))),
                or_dash(process.processor_mhz.map(|mhz| format!("{mhz:.0}"))),
            ]);
        }
    }
    if rows.is_empty() {
        return;
    }
    let columns = [
        words("Point"),
        numbers("Process"),
        words("Began"),
        numbers("Seconds"),
        numbers("Load before"),
        numbers("Processor, MHz"),
    ];
    table(
        w,
        "Processes that measured, each started afresh.",
        &columns,
        &rows,
    );
}

/// What the words and numbers mean exactly.
pub fn reading_section(w: &mut Writer, points: &[At], analysis: &Analysis) {
    let pipelines = || points.iter().flat_map(|at| &at.comparison.pipelines);
    w.element("section", &[("id", "reading"), ("aria-labelledby", "reading-h")], |w| {
        w.leaf("h2", &[("id", "reading-h")], "How to read this");
        let level = format!("{:.2}", 100.0 * analysis.ratio_level);
        let confidence = 100.0 * CONFIDENCE;
        let margin = 100.0 * MARGIN;
        let upper = 1.0 + MARGIN;
        let lower = 1.0 / upper;
        for text in [
            format!(
                "Times are medians over the measured frames. The interval of a median holds the \
                 true median with at least {confidence:.0} % confidence (order statistics, no \
                 assumption about the distribution). p95 is the 95th percentile. No frame is left \
                 out as an outlier."
            ),
            format!(
                "Speed is the quotient of two medians: 2 means twice as fast. Each process measures all \
                 pipelines in turn and gives one quotient; their geometric mean is reported. Its interval is \
                 Student's, of their logarithms, at up to {level} %, so that all pairs of pipelines at all \
                 points hold together at {confidence:.0} % (Holm 1979)."
            ),
            format!(
                "A pipeline is called faster or slower only if that interval lies wholly outside \
                 {lower:.3} to {upper:.2}. The same within {margin:.0} % means that the interval lies wholly \
                 inside. All else is undecided, also where fewer than five processes measured."
            ),
            "The intervals cover what changes from one start of the program to the next. They do not cover \
             another machine or driver."
                .to_owned(),
            "GPU time is measured with timestamps around the frame and around each pass; the passes \
             need not add up to the frame. CPU time is the time for recording and submitting. \
             Bytes are modelled, not measured."
                .to_owned(),
        ] {
            w.leaf("p", &[], &text);
        }
        if pipelines().any(|p| p.difference.is_some()) {
            w.leaf("h3", &[], "Picture metrics");
            w.leaf("p", &[("class", "note")], "r is a value of the reference, t of the other picture; alpha is not compared.");
            let linear = pipelines().any(|p| p.linear_difference.is_some());
            let definitions: Vec<(&str, String)> = Metric::ALL
                .into_iter()
                .filter(|m| is_printed(*m, linear))
                .map(|m| (m.name(), m.definition()))
                .collect();
            facts(w, &definitions);
        }
    });
}

/// Whether the report prints a number that this metric defines.
fn is_printed(metric: Metric, linear: bool) -> bool {
    match metric {
        Metric::HdrFlip | Metric::LinearMse => false,
        Metric::LinearRmse
        | Metric::LinearPsnr
        | Metric::RelMse
        | Metric::Smape
        | Metric::EnergyRatio
        | Metric::ShareInvalid => linear,
        _ => true,
    }
}
