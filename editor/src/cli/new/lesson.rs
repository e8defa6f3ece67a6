//! `lightbench new lesson`: a lesson that runs, for a lecturer to change.

use anyhow::bail;
use lightbench::assets::files::{FileError, Files};
use lightbench::lab::lesson::{LESSON_FILE, LESSONS, list_lessons};

use super::name;
use crate::cli::report::{Usage, note, say};

/// The files of a new lesson, by their paths in its folder. In all of them `ORDER` stands for its
/// number and `TITLE` for its title.
const FILES: [(&str, &str); 8] = [
    ("checks.rhai", include_str!("template/lesson/checks.rhai")),
    ("text.en.md", include_str!("template/lesson/text.en.md")),
    ("text.es.md", include_str!("template/lesson/text.es.md")),
    (
        "starter/scripts/pipelines/exercise.rhai",
        include_str!("template/lesson/pipeline.rhai"),
    ),
    (
        "starter/shaders/exercise/fill.wgsl",
        include_str!("template/lesson/fill.wgsl"),
    ),
    (
        "starter/shaders/lib/exercise.wgsl",
        include_str!("template/lesson/starter.wgsl"),
    ),
    (
        "solution/shaders/lib/exercise.wgsl",
        include_str!("template/lesson/solution.wgsl"),
    ),
    // Last, because it says that the lesson is whole.
    (LESSON_FILE, include_str!("template/lesson/lesson.toml")),
];

/// Makes the lesson in the project, after those that there are, and says what to do with it.
///
/// # Errors
/// No project, a name that is taken or can't be a folder's, or a folder that can't be written.
pub fn make(name: &str, files: &Files) -> anyhow::Result<()> {
    name::check(name, "lesson").map_err(Usage)?;
    let folder = format!("{LESSONS}/{name}");
    if files.project().is_none() {
        return Err(FileError::NoProject { path: folder }.into());
    }
    let known = list_lessons(files)?;
    let number = |name: &str| {
        name.split('-')
            .next()
            .and_then(|number| number.parse::<u32>().ok())
    };
    let (order, name) = match number(name) {
        Some(order) => (order, name.to_owned()),
        None => {
            let last = known.iter().filter_map(|name| number(name)).max();
            let order = last.unwrap_or(0) + 1;
            (order, format!("{order:02}-{name}"))
        }
    };
    if known.iter().any(|known| number(known) == Some(order)) {
        bail!("there is a lesson with the number {order} already; choose another one");
    }
    let title = super::title(name.split_once('-').map_or(name.as_str(), |(_, rest)| rest));
    let mut made = None;
    for (path, template) in FILES {
        let text = template
            .replace("ORDER", &order.to_string())
            .replace("TITLE", &title);
        made = Some(files.create(&format!("{LESSONS}/{name}/{path}"), text.as_bytes())?);
    }
    let Some(folder) = made.as_deref().and_then(std::path::Path::parent) else {
        bail!("the lesson has no files");
    };
    say(folder.display().to_string())?;
    let folder = format!("{LESSONS}/{name}");
    note(format!(
        "It runs as it is. In the project's folder:\n  \
         lightbench check {folder} --work {folder}/solution     all points\n  \
         lightbench check {folder} --work {folder}/starter      none\n  \
         lightbench lesson start {folder} --into ../try-it       as a student begins\n\
         What checks can say: lightbench docs checks"
    ));
    Ok(())
}
