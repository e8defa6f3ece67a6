//! The notebook as a page of Markdown.

use std::fmt::Write as _;

use super::entry::Entry;
use crate::ui::workbench::comparing::{Cost, Costs};

/// All entries, one after another, with links to the pictures beside the page.
pub(super) fn page<'a>(entries: impl Iterator<Item = &'a Entry>) -> String {
    let mut text = "# Notebook\n".to_owned();
    for entry in entries {
        // Writing to a text does not fail.
        let _ = write_entry(&mut text, entry);
    }
    text
}

fn write_entry(text: &mut String, entry: &Entry) -> std::fmt::Result {
    writeln!(text, "\n## {}\n", entry.time)?;
    if !entry.note.trim().is_empty() {
        writeln!(text, "{}\n", entry.note.trim())?;
    }
    writeln!(
        text,
        "![{}: {}]({})\n",
        entry.time,
        entry.shown,
        entry.picture()
    )?;
    let sides = ["A", "B"].into_iter().zip(&entry.costs);
    let titles: Vec<String> = sides
        .map(|(side, costs)| format!("{side}: {}", cell(&costs.title)))
        .collect();
    writeln!(text, "| | {} |", titles.join(" | "))?;
    writeln!(text, "| --- |{}", " --- |".repeat(titles.len()))?;
    type Row<'a> = (&'a str, &'a dyn Fn(&Costs) -> String);
    let rows: [Row<'_>; 7] = [
        ("parameters", &|c| cell(&c.settings.join(", "))),
        ("GPU time", &|c| time(c.gpu)),
        ("CPU time", &|c| time(c.cpu)),
        ("draws and dispatches", &|c| c.calls.to_string()),
        ("bytes moved, modelled", &|c| c.moved_bytes.to_string()),
        ("bytes of targets", &|c| c.target_bytes.to_string()),
        ("lights in view", &|c| c.lights.to_string()),
    ];
    for (what, of) in rows {
        let cells: Vec<String> = entry.costs.iter().map(of).collect();
        writeln!(text, "| {what} | {} |", cells.join(" | "))?;
    }
    for (side, costs) in ["A", "B"].into_iter().zip(&entry.costs) {
        for (what, value) in &costs.counters {
            writeln!(text, "\n{side}, {what}: {value}")?;
        }
    }
    if let Some(d) = entry.difference {
        let psnr = if d.psnr_db.is_finite() {
            format!("{:.2} dB", d.psnr_db)
        } else {
            "infinite, the pictures are equal".to_owned()
        };
        writeln!(
            text,
            "\nB against A, 8 bits, sRGB: FLIP {:.5} in the mean, {:.5} at most; MSE {:.3e}; PSNR {psnr}; \
             largest difference {} of 255.",
            d.flip_mean, d.flip_max, d.mse, d.max_steps
        )?;
    }
    let adapter = &entry.adapter;
    let machine = entry
        .machine
        .as_ref()
        .map(|machine| format!("{}, {} cores, {}; ", machine.cpu, machine.cores, machine.os));
    writeln!(
        text,
        "\n{}{}, {} {}, {}.",
        machine.unwrap_or_default(),
        adapter.name,
        adapter.driver,
        adapter.driver_info,
        adapter.backend
    )?;
    writeln!(text, "\n```text\n{}", entry.view)?;
    if let Some(view) = &entry.view_b {
        writeln!(text, "{view}")?;
    }
    writeln!(text, "```")
}

fn time(cost: Cost) -> String {
    match cost.median_ms {
        Some(ms) => format!("{ms:.3} ms, median of {}", cost.frames),
        None => "not measured".to_owned(),
    }
}

/// Text that does not end the cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace(['\n', '\r'], " ")
}

#[cfg(test)]
mod tests {
    use super::super::entry::tests::entry;
    use super::*;

    #[test]
    fn a_page_has_note_numbers_and_a_picture_beside_it() {
        let mut entry = entry();
        entry.costs[0].title = "a | b".to_owned();
        let text = page([&entry].into_iter());
        for words in [
            "![2026-01-02T03:04:05Z: Split](2026-01-02T03-04-05Z.png)",
            "why | is it\n\"slower\"?",
            "| | A: a \\| b |\n| --- | --- |\n",
            "| GPU time | 1.250 ms, median of 7 |",
            "| CPU time | not measured |",
            "A, pixels over: 3",
            "FLIP 0.10000 in the mean",
            "infinite, the pictures are equal",
            "scene=a pipeline=q",
        ] {
            assert!(text.contains(words), "{words}\n{text}");
        }
    }
}
