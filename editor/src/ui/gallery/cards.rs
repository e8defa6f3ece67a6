//! Scenes, pipelines and examples, each with what its header says.

use lightbench::assets::files::{Files, Origin};

use crate::ui::messages::say;
use crate::ui::workbench::library::Library;

/// A part of the gallery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shelf {
    /// Scenes.
    Scenes,
    /// Pipelines.
    Pipelines,
    /// Small scripts, one idea each.
    Examples,
    /// Lessons, which open in a panel of their own.
    Lessons,
}

impl Shelf {
    /// All, in their order.
    pub const ALL: [Self; 4] = [Self::Scenes, Self::Pipelines, Self::Examples, Self::Lessons];

    /// The word on its tab.
    pub fn title(self) -> &'static str {
        match self {
            Self::Scenes => say!("gallery.scenes"),
            Self::Pipelines => say!("gallery.pipelines"),
            Self::Examples => say!("gallery.examples"),
            Self::Lessons => say!("lesson.shelf"),
        }
    }
}

/// What a click opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opens {
    /// The scene.
    Scene,
    /// The pipeline.
    Pipeline,
    /// The script, which can't be shown as a picture.
    Script,
}

/// One thing to look at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Card {
    /// Where it lies.
    pub shelf: Shelf,
    /// What a click does.
    pub opens: Opens,
    /// What the scene's or the pipeline's loader takes.
    pub name: String,
    /// Its file.
    pub path: String,
    /// In a few words.
    pub title: String,
    /// A sentence.
    pub about: String,
    /// Whether the file is the project's own.
    pub is_own: bool,
}

impl Card {
    /// Whether each word that was typed is in its title or its sentence.
    pub fn fits(&self, typed: &str) -> bool {
        let text = format!("{} {} {}", self.title, self.about, self.path).to_lowercase();
        let mut words = typed.split_whitespace();
        words.all(|word| text.contains(&word.to_lowercase()))
    }
}

/// Those that can be chosen by name.
pub fn of_library(library: &Library) -> Vec<Card> {
    let is_own = |origin: &Origin| matches!(origin, Origin::Project(_));
    let scenes = library.scenes.iter().map(|entry| Card {
        shelf: Shelf::Scenes,
        opens: Opens::Scene,
        name: entry.name.clone(),
        path: entry.path.clone(),
        title: entry.title.clone(),
        about: first_sentence(&entry.description).to_owned(),
        is_own: is_own(&entry.origin),
    });
    let pipelines = library.pipelines.iter().map(|entry| Card {
        shelf: Shelf::Pipelines,
        opens: Opens::Pipeline,
        name: entry.name.clone(),
        path: entry.path.clone(),
        title: entry.title.clone(),
        about: match &entry.problem {
            Some(problem) => problem.message.clone(),
            None => first_sentence(&entry.description).to_owned(),
        },
        is_own: is_own(&entry.origin),
    });
    scenes.chain(pipelines).collect()
}

/// Small scripts, which no list of names has: those about scenes, and one for each kind of pass.
pub fn examples(files: &Files) -> Vec<Card> {
    let mut cards = Vec::new();
    for (folder, opens) in [
        ("scripts/examples", Opens::Scene),
        ("scripts/pipelines/examples", Opens::Pipeline),
    ] {
        // What can't be read can't be shown.
        for file in files.list(folder, "rhai").unwrap_or_default() {
            let text = files.read_text(&file.path).unwrap_or_default();
            let (title, about) = header(&text);
            let experiment = text.contains("lightbench run ");
            cards.push(Card {
                shelf: Shelf::Examples,
                opens: if experiment { Opens::Script } else { opens },
                name: file.path.clone(),
                path: file.path,
                title,
                about,
                is_own: matches!(file.origin, Origin::Project(_)),
            });
        }
    }
    cards
}

/// Title and sentence of a header whose first line has both: `// Title: a sentence.`
fn header(text: &str) -> (String, String) {
    let comment = text
        .lines()
        .map_while(|line| line.trim_start().strip_prefix("//"))
        .map(str::trim)
        .take_while(|line| !line.is_empty());
    let comment = comment.collect::<Vec<_>>().join(" ");
    let (title, about) = comment.split_once(": ").unwrap_or((&comment, ""));
    (title.to_owned(), first_sentence(about).to_owned())
}

/// To the first full stop that a blank or the end follows.
fn first_sentence(text: &str) -> &str {
    text.find(". ").map_or(text, |at| &text[..=at])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_give_title_and_sentence() {
        let text = "// Hello, light: a floor, and\n// a ball. More.\n//\n// Try: x\nlet a = 1;";
        let expected = ("Hello, light".to_owned(), "a floor, and a ball.".to_owned());
        assert_eq!(header(text), expected);
        assert_eq!(header("let a = 1;"), (String::new(), String::new()));
        assert_eq!(first_sentence("About 1.5 m. Then"), "About 1.5 m.");
    }

    #[test]
    fn every_shipped_example_has_a_card_with_title_and_sentence() {
        let cards = examples(&Files::shipped());
        assert!(cards.len() > 25, "{}", cards.len());
        for card in &cards {
            assert!(!card.title.is_empty() && !card.about.is_empty(), "{card:?}");
            assert!(card.title.len() < 40, "{card:?}");
        }
        let scripts = cards.iter().filter(|card| card.opens == Opens::Script);
        assert!(scripts.count() >= 3);
        let typed = cards.iter().filter(|card| card.fits("LIGHT hello"));
        assert_eq!(typed.count(), 1);
    }
}
