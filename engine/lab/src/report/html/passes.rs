//! Times and memory, pass by pass and target by target.

use super::answer::bytes_a_pixel;
use super::table::{numbers, table, table_with_total, words};
use super::writer::Writer;
use super::{At, charts, or_dash, software_note};
use crate::report::analysis::Analysis;
use crate::report::format::{bytes, count, significant};
use crate::report::model::{Comparison, PassResult, PipelineResult};
use crate::report::summary::clock_name;
use crate::report::theory;
use crate::statistics::Summary;

/// Charts of frames and passes, then the table of each pipeline's passes.
pub fn times_section(w: &mut Writer, at: &At, names: &[&str]) {
    let (c, analysis) = (at.comparison, at.analysis);
    let (id, heading) = (at.id("times"), at.id("times-h"));
    w.element(
        "section",
        &[("id", &id), ("aria-labelledby", &heading)],
        |w| {
            w.leaf(
                "h2",
                &[("id", &heading)],
                &at.heading("Where the time goes"),
            );
            if c.adapter.software {
                let text = "All times in this section are those of a software driver.";
                w.element("p", &[("class", "caution")], |w| {
                    w.leaf("strong", &[], "Note. ");
                    w.text(text);
                });
            }
            if !analysis.order.is_empty() {
                charts::frames(w, c, analysis);
            }
            charts::passes(w, c, names);
            system_table(w, c);
            let text = format!(
                "In the tables, times are over {} frames, and counts and bytes are those of one \
                 frame. Bytes are modelled from the declared formats and sizes. The times in the \
                 last row are measured over the whole frame, not summed.",
                c.frames
            );
            w.leaf("p", &[("class", "note")], &text);
            for pipeline in &c.pipelines {
                pass_table(w, c, pipeline);
            }
        },
    );
}

/// What the world's systems cost, before any pass, with the extraction of each pipeline.
fn system_table(w: &mut Writer, c: &Comparison) {
    let mut names: Vec<&str> = Vec::new();
    for system in c.pipelines.iter().flat_map(|p| &p.systems) {
        if !names.contains(&system.name.as_str()) {
            names.push(&system.name);
        }
    }
    if names.is_empty() {
        return;
    }
    w.leaf("h3", &[], "Systems of the world");
    let text = "Before a frame is drawn, the script and the systems move the world, changed rows \
                are copied, and what the camera sees is extracted; then the passes are recorded. Each \
                moment of the scene is reached once and drawn by every pipeline.";
    w.leaf("p", &[("class", "note")], text);
    let mut columns = vec![words("System")];
    for p in &c.pipelines {
        columns.push(numbers(&format!("{}, median", p.label())));
    }
    let rows: Vec<Vec<String>> = names
        .into_iter()
        .map(|name| {
            let median = |p: &PipelineResult| {
                let system = p.systems.iter().find(|system| system.name == name);
                let [median, _] = time_cells(system.map(|system| system.thread_ms.as_slice()));
                median
            };
            let mut row = vec![name.to_owned()];
            row.extend(c.pipelines.iter().map(median));
            row
        })
        .collect();
    // The driver has no part in them, whether it is software or not.
    let caption = "Systems, ms of the CPU thread that ran each, a frame.";
    table(w, caption, &columns, &rows);
}

fn pass_table(w: &mut Writer, c: &Comparison, p: &PipelineResult) {
    w.leaf("h3", &[], &format!("Passes of {}", p.label()));
    if !p.parameters.is_empty() {
        let settings: Vec<String> = p
            .parameters
            .iter()
            .map(|p| format!("{} = {}", p.name, p.value))
            .collect();
        w.leaf(
            "p",
            &[("class", "about")],
            &format!("Parameters: {}.", settings.join(", ")),
        );
    }
    let columns = [
        words("Pass"),
        words("Kind"),
        numbers("GPU median"),
        numbers("GPU p95"),
        numbers("CPU median"),
        numbers("CPU p95"),
        numbers("Draws"),
        numbers("Instances"),
        numbers("Triangles"),
        numbers("Fragments"),
        numbers("Dispatches"),
        numbers("Read"),
        numbers("Written"),
    ];
    let rows: Vec<Vec<String>> = p.passes.iter().map(pass_row).collect();
    let caption = format!("Passes of {}, ms a frame{}.", p.label(), software_note(c));
    table_with_total(w, &caption, &columns, &rows, &total_row(p));
    counted(w, p);
    for (why, what) in reasons(p) {
        let why = why.trim_end_matches('.');
        w.leaf(
            "p",
            &[("class", "note")],
            &format!("Not measured: {} ({why}).", what.join(", ")),
        );
    }
    if let Some(note) = counter_note(c, p) {
        w.leaf("p", &[("class", "note")], note);
    }
}

/// What shaders counted, what did not run, and what the adapter changed.
fn counted(w: &mut Writer, p: &PipelineResult) {
    let mut notes: Vec<String> = p
        .counters
        .iter()
        .filter_map(|counter| {
            let summary = Summary::of(&counter.values)?;
            let median = count(summary.median.round() as u64);
            Some(format!(
                "{} ({}): {median} (median a frame).",
                counter.description, counter.name
            ))
        })
        .collect();
    let dropped: Vec<&str> = p
        .passes
        .iter()
        .filter(|pass| pass.dropped)
        .map(|pass| pass.name.as_str())
        .collect();
    if !dropped.is_empty() {
        notes.push(format!(
            "Left out, since nobody uses what they write: {}.",
            dropped.join(", ")
        ));
    }
    if p.saved_bytes > 0 {
        notes.push(format!(
            "Targets that share a texture with another save {}.",
            bytes(p.saved_bytes)
        ));
    }
    notes.extend(p.notes.iter().map(|note| format!("{note}.")));
    for note in notes {
        w.leaf("p", &[("class", "note")], &note);
    }
    for (supported, title) in [(true, "Can do"), (false, "Can't do")] {
        let found = p.abilities.iter().filter(|a| a.supported == supported);
        let texts: Vec<String> = found.map(|a| format!("{} ({})", a.name, a.text)).collect();
        if !texts.is_empty() {
            let text = format!("{title}: {}.", texts.join("; ").replace(".)", ")"));
            w.leaf("p", &[("class", "about")], &text);
        }
    }
}

/// What must be known of the driver's counters, where there is something.
fn counter_note(c: &Comparison, p: &PipelineResult) -> Option<&'static str> {
    let counted = p.passes.iter().any(|pass| pass.fragments.is_some());
    (counted && c.adapter.software && c.adapter.driver_info.starts_with("Mesa 22")).then_some(
        "Fragments are the driver's count. Mesa 22 counts in blocks and gives more than were shaded, \
         96 for a square of 64 for example; compare them, don't quote them.",
    )
}

/// Each reason for which something was not measured, with what it concerns.
fn reasons(p: &PipelineResult) -> Vec<(&str, Vec<&str>)> {
    let frame = p
        .gpu_why_not
        .as_deref()
        .map(|why| (why, "GPU time of the frame"));
    let passes = p
        .passes
        .iter()
        .filter_map(|pass| Some((pass.why_not.as_deref()?, &*pass.name)));
    let mut grouped: Vec<(&str, Vec<&str>)> = Vec::new();
    for (why, what) in frame.into_iter().chain(passes) {
        match grouped.iter_mut().find(|(known, _)| *known == why) {
            Some((_, all)) => all.push(what),
            None => grouped.push((why, vec![what])),
        }
    }
    grouped
}

fn pass_row(pass: &PassResult) -> Vec<String> {
    let mut row = vec![pass.name.clone(), pass.kind.clone()];
    row.extend(time_cells(pass.gpu_ms.as_deref()));
    row.extend(time_cells(Some(&pass.cpu_ms)));
    row.extend([pass.draws, pass.instances, pass.triangles].map(count));
    row.push(or_dash(pass.fragments.map(count)));
    row.push(count(pass.dispatches));
    row.extend([pass.bytes_read, pass.bytes_written].map(bytes));
    row
}

fn total_row(p: &PipelineResult) -> Vec<String> {
    let sum = |f: fn(&PassResult) -> u64| p.passes.iter().map(f).sum::<u64>();
    let fragments: Option<u64> = p.passes.iter().map(|pass| pass.fragments).sum();
    let mut row = vec!["Whole frame".to_owned(), String::new()];
    row.extend(time_cells(p.frame_gpu_ms.as_deref()));
    row.extend(time_cells(Some(&p.frame_cpu_ms)));
    row.extend([sum(|p| p.draws), sum(|p| p.instances), sum(|p| p.triangles)].map(count));
    row.push(or_dash(fragments.map(count)));
    row.push(count(sum(|p| p.dispatches)));
    row.extend([sum(|p| p.bytes_read), sum(|p| p.bytes_written)].map(bytes));
    row
}

fn time_cells(samples: Option<&[f64]>) -> [String; 2] {
    let summary = samples.and_then(Summary::of);
    let cell = |value: fn(Summary) -> f64| or_dash(summary.map(|s| significant(value(s))));
    [cell(|s| s.median), cell(|s| s.p95)]
}

/// Target memory of each pipeline.
pub fn memory_section(w: &mut Writer, at: &At) {
    let c = at.comparison;
    if c.pipelines.iter().all(|p| p.targets.is_empty()) {
        return;
    }
    let (id, heading) = (at.id("memory"), at.id("memory-h"));
    w.element("section", &[("id", &id), ("aria-labelledby", &heading)], |w| {
        w.leaf("h2", &[("id", &heading)], &at.heading("What the targets take"));
        theory_table(w, c);
        let text = "Bytes follow from the declared formats, sizes and samples; a driver may pad or \
                    compress. Targets that are never alive at the same time may share memory, \
                    which the total counts once.";
        w.leaf("p", &[("class", "note")], text);
        let pixels = f64::from(c.size[0]) * f64::from(c.size[1]);
        let columns = [
            words("Target"),
            words("Format"),
            numbers("Size"),
            numbers("Samples"),
            numbers("Memory, modelled"),
            numbers("Bytes a pixel"),
        ];
        for p in c.pipelines.iter().filter(|p| !p.targets.is_empty()) {
            let rows: Vec<Vec<String>> = p
                .targets
                .iter()
                .map(|t| {
                    vec![
                        t.name.clone(),
                        t.format.clone(),
                        format!("{} × {}", t.size[0], t.size[1]),
                        t.samples.to_string(),
                        bytes(t.bytes),
                        significant(t.bytes as f64 / pixels),
                    ]
                })
                .collect();
            let mut total = vec!["Together".to_owned()];
            total.extend([String::new(), String::new(), String::new()]);
            total.extend([bytes(p.target_bytes_total), significant(bytes_a_pixel(p, c))]);
            table_with_total(w, &format!("Targets of {}.", p.label()), &columns, &rows, &total);
        }
        let reads: Vec<Vec<String>> = c.pipelines.iter().map(|p| traffic(p, pixels)).collect();
        let columns = [
            words("Pipeline"),
            numbers("Read a frame"),
            numbers("Written a frame"),
            numbers("Bytes a pixel and frame"),
            numbers("Stencil"),
            numbers("Overdraw"),
            numbers("Tile loads"),
            numbers("Tile stores"),
        ];
        table(w, "Traffic, modelled from the declared formats and sizes.", &columns, &reads);
        let text = "Read and written count one fragment a covered pixel; blending counts as both. \
                    Apart from them: stencil; overdraw, which is what the fragments beyond that move, \
                    as far as the driver counts them; and what a GPU that works in tiles loads before \
                    passes and stores after them instead.";
        w.leaf("p", &[("class", "note")], text);
    });
}

/// The theory's bytes a pixel against those of the targets.
fn theory_table(w: &mut Writer, c: &Comparison) {
    let rows: Vec<Vec<String>> = c
        .pipelines
        .iter()
        .filter(|p| !p.targets.is_empty())
        .map(|p| {
            let measured = theory::measured(p, c);
            let Some(theory) = theory::of(&p.name) else {
                let mut row = vec![p.label().to_owned(), significant(measured)];
                row.extend(["–", "–", "no formula is known for this name", "–"].map(str::to_owned));
                return row;
            };
            let least = theory.bytes_a_pixel();
            vec![
                p.label().to_owned(),
                significant(measured),
                significant(least),
                format!("{:+.1}", measured - least),
                format!("{} ({})", theory.formula(), theory.layouts()),
                theory.source.to_owned(),
            ]
        })
        .collect();
    let columns = [
        words("Pipeline"),
        numbers("Targets, bytes a pixel"),
        numbers("Theory, bytes a pixel"),
        numbers("More"),
        words("Formula"),
        words("Source"),
    ];
    table(
        w,
        "Bytes a pixel of all targets against the technique's formula.",
        &columns,
        &rows,
    );
    let text = "The formula is the least that the technique needs at one sample a pixel, in the \
                layout of its source. A pipeline has more where it keeps more: the picture after \
                the tone curve, wider formats, more samples, or more kinds of surface.";
    w.leaf("p", &[("class", "note")], text);
}

fn traffic(p: &PipelineResult, pixels: f64) -> Vec<String> {
    let sum = |bytes: fn(&PassResult) -> u64| p.passes.iter().map(bytes).sum::<u64>();
    let (read, written) = (sum(|pass| pass.bytes_read), sum(|pass| pass.bytes_written));
    let each = significant((read + written) as f64 / pixels);
    let counted = p.passes.iter().any(|pass| pass.bytes_overdraw.is_some());
    let overdraw = counted.then(|| bytes(sum(|pass| pass.bytes_overdraw.unwrap_or(0))));
    vec![
        p.label().to_owned(),
        bytes(read),
        bytes(written),
        each,
        bytes(sum(|pass| pass.bytes_stencil)),
        or_dash(overdraw),
        bytes(sum(|pass| pass.bytes_loaded)),
        bytes(sum(|pass| pass.bytes_stored)),
    ]
}

/// The clock in the words of a chart's caption.
pub fn clock_caption(c: &Comparison, analysis: &Analysis) -> String {
    format!("{}, ms a frame", clock_name(c, analysis.clock))
}
