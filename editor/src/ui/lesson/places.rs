//! What links of a lesson's text lead to.

use lightbench::assets::files::Files;
use lightbench::lab::lesson::{Lesson, STARTER, place_line};

use crate::ui::messages::say;

/// What a link leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leads {
    /// A place in the text.
    Place(String),
    /// A file, with a line from 1.
    File(String, Option<usize>),
    /// An address.
    Address(String),
    /// Nothing that is there; says so.
    Nowhere(String),
}

/// Finds what a link leads to. A file of the starter is the project's own, where `begun` says that the
/// project was begun from the lesson.
pub fn follow(link: &str, lesson: &Lesson, begun: bool, files: &Files) -> Leads {
    if link.starts_with("https://") {
        return Leads::Address(link.to_owned());
    }
    let (path, place) = link.split_once('#').unwrap_or((link, ""));
    if path.is_empty() {
        return Leads::Place(place.to_owned());
    }
    let own = path
        .strip_prefix(STARTER)
        .and_then(|rest| rest.strip_prefix('/'));
    let candidates = [
        own.filter(|_| begun).map(str::to_owned),
        lesson.source.has(path).then(|| lesson.source.shown(path)),
        Some(path.to_owned()),
    ];
    let Some(file) = candidates
        .into_iter()
        .flatten()
        .find(|path| files.exists(path))
    else {
        return Leads::Nowhere(say!("lesson.no_file", file = path));
    };
    let line = match place {
        "" => None,
        place => files
            .read_text(&file)
            .ok()
            .and_then(|code| place_line(&code, place)),
    };
    Leads::File(file, line)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use lightbench::lab::lesson::find_lesson;

    #[test]
    fn links_lead_to_files_places_and_addresses() {
        let project = tempfile::tempdir().unwrap();
        let files = Files::with_project(project.path()).unwrap();
        let lesson = find_lesson(&files, "1").unwrap();
        let starter = "starter/shaders/lib/by_hand.wgsl#lambert";
        let code = lesson
            .source
            .read_text("starter/shaders/lib/by_hand.wgsl")
            .unwrap();
        let line = code
            .lines()
            .position(|line| line.contains("TASK lambert"))
            .unwrap()
            + 1;
        let shipped = "lessons/01-first-light/starter/shaders/lib/by_hand.wgsl".to_owned();
        let leads = follow(starter, &lesson, false, &files);
        assert_eq!(leads, Leads::File(shipped, Some(line)));

        let own = "shaders/lib/by_hand.wgsl";
        files
            .write(own, format!("// one line more\n{code}").as_bytes())
            .unwrap();
        let leads = follow(starter, &lesson, true, &files);
        assert_eq!(leads, Leads::File(own.to_owned(), Some(line + 1)));

        let shader = "shaders/lib/lighting.wgsl";
        let link = format!("{shader}#distance_falloff");
        let Leads::File(path, Some(line)) = follow(&link, &lesson, true, &files) else {
            panic!("{link}");
        };
        let text = files.read_text(&path).unwrap();
        assert!(
            text.lines()
                .nth(line - 1)
                .unwrap()
                .contains("fn distance_falloff")
        );
        let place = Leads::Place("lamp".to_owned());
        assert_eq!(follow("#lamp", &lesson, true, &files), place);
        assert!(matches!(
            follow("shaders/none.wgsl", &lesson, true, &files),
            Leads::Nowhere(why) if why.contains("shaders/none.wgsl")
        ));
    }
}
