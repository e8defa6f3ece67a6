//! The page that compares the pipelines: what each can do, and what its file says of it.

use std::fmt::Write as _;

use lightbench_assets::files::Files;
use lightbench_render::problem::{Problem, Problems};

use super::functions::wrapped;
use crate::abilities::{ABILITIES, AbilityCell, abilities};
use crate::pipeline::{PipelineEntry, list_pipelines};

/// What the header of a pipeline file says, in this order.
pub(super) const HEADINGS: [&str; 5] = ["Trades", "Memory", "Limits", "Choose", "Source"];

/// The page, as Markdown.
///
/// # Errors
/// A file that can't be read, and mistakes in pipelines.
pub fn abilities_page(files: &Files) -> Result<String, Problems> {
    let unreadable = |error: lightbench_assets::files::FileError| {
        Problems(vec![Problem::new(
            lightbench_render::problem::Place::file(crate::PIPELINES),
            error.to_string(),
        )])
    };
    let pipelines = list_pipelines(files).map_err(unreadable)?;
    let mut text = String::from(
        "# The pipelines: what each can do, and when to choose it\n\n\
         <!-- Written by `lightbench docs abilities`. Change the pipeline files instead. -->\n\n",
    );
    text += include_str!("prose/abilities.txt");
    text += "\n| pipeline |";
    let mut line = String::from("\n| --- |");
    for (_, title) in ABILITIES {
        let _ = write!(text, " {title} |");
        line += " --- |";
    }
    text += &line;
    text.push('\n');
    let mut below = String::new();
    for pipeline in &pipelines {
        let cells = abilities(files, pipeline)?;
        let anchor = pipeline.title.to_lowercase().replace([',', '.'], "");
        let _ = write!(
            text,
            "| [{}](#{}) |",
            pipeline.title,
            anchor.replace(' ', "-")
        );
        for cell in &cells {
            let _ = write!(text, " {} |", word(cell));
        }
        text.push('\n');
        let script = files.read_text(&pipeline.path).map_err(unreadable)?;
        below += &section(pipeline, &header(&script), &cells);
    }
    text += &below;
    Ok(text)
}

fn word(cell: &AbilityCell) -> String {
    match (&cell.setting, cell.supported) {
        (_, false) => "no".to_owned(),
        (None, true) => "yes".to_owned(),
        (Some(setting), true) => format!("`{setting}`"),
    }
}

/// What a pipeline's file says of it, and of its abilities.
fn section(pipeline: &PipelineEntry, header: &Header, cells: &[AbilityCell]) -> String {
    let mut text = format!("\n## {}\n\n`{}`\n\n", pipeline.title, pipeline.path);
    for paragraph in &header.paragraphs {
        text += &wrapped(paragraph);
        text.push('\n');
    }
    for (heading, said) in &header.headings {
        text += &wrapped(&format!("- **{heading}.** {}", sentence(said)));
    }
    text.push('\n');
    for cell in cells {
        let title = ABILITIES.iter().find(|(name, _)| *name == cell.ability);
        let title = title.map_or(cell.ability, |(_, title)| title);
        text += &wrapped(&format!("- {title}: {}. {}", word(cell), cell.text));
    }
    text
}

/// A text with a capital at its beginning.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// The comment at the top of a pipeline file.
#[derive(Default)]
pub(super) struct Header {
    /// What the pipeline does, without the title.
    pub paragraphs: Vec<String>,
    /// What stands behind each of [`HEADINGS`].
    pub headings: Vec<(&'static str, String)>,
}

pub(super) fn header(script: &str) -> Header {
    let mut header = Header::default();
    let lines = script.lines().map_while(|line| line.strip_prefix("//"));
    // The first line is the title.
    for line in lines.skip(1) {
        let line = line.trim();
        let begun = HEADINGS.iter().find_map(|heading| {
            let said = line.strip_prefix(heading)?.strip_prefix(':')?;
            Some((*heading, said.trim().to_owned()))
        });
        match (begun, header.headings.last_mut()) {
            (Some(begun), _) => header.headings.push(begun),
            (None, Some((_, said))) => {
                said.push(' ');
                said.push_str(line);
            }
            (None, None) if line.is_empty() => header.paragraphs.push(String::new()),
            (None, None) => {
                if let Some(paragraph) = header.paragraphs.last_mut() {
                    paragraph.push(' ');
                    paragraph.push_str(line);
                }
            }
        }
    }
    header.paragraphs.retain(|paragraph| !paragraph.is_empty());
    header
}
