//! Texts: every link leads somewhere, every named place is there, and listings are what the files hold.

use std::path::Path;

use lightbench::assets::files::Files;
use lightbench::lab::lesson::{Language, Lesson, Link, has_place};

use super::all;

/// The file that a link means: one of the lesson, or a shipped one.
fn read(folder: &Path, path: &str) -> Option<Vec<u8>> {
    let own = std::fs::read(folder.join(path)).ok();
    own.or_else(|| Files::shipped().read(path).ok())
}

fn is_elsewhere(target: &str) -> bool {
    target.starts_with("https://")
}

fn check_link(folder: &Path, file: &str, places: &[&str], link: &Link) {
    let Link { line, target } = link;
    if is_elsewhere(target) {
        return;
    }
    let (path, place) = target.split_once('#').unwrap_or((target, ""));
    if path.is_empty() {
        assert!(places.contains(&place), "{file}:{line}: no place `{place}`");
        return;
    }
    let bytes = read(folder, path).unwrap_or_else(|| panic!("{file}:{line}: no file `{path}`"));
    if !place.is_empty() {
        let code = String::from_utf8(bytes).unwrap();
        assert!(
            has_place(&code, place),
            "{file}:{line}: {path} has no `{place}`"
        );
    }
}

#[test]
fn links_and_listings_are_alive() {
    for (folder, lesson) in all() {
        for (_, language) in Language::ALL {
            let text = lesson.text(language).unwrap();
            let file = format!("{}/{}", lesson.name, text.file);
            let places: Vec<&str> = text.places().into_iter().collect();
            for link in text.links() {
                check_link(&folder, &file, &places, &link);
            }
            for listing in text.listings() {
                let link = Link {
                    line: listing.line,
                    target: listing.target.clone(),
                };
                check_link(&folder, &file, &places, &link);
                let path = listing.target.split('#').next().unwrap();
                let code = String::from_utf8(read(&folder, path).unwrap()).unwrap();
                assert!(
                    code.contains(&listing.code),
                    "{file}:{}: this is not in {path}:\n{}",
                    listing.line,
                    listing.code
                );
            }
        }
    }
}

/// What a text is made of, whatever its language.
fn shape(lesson: &Lesson, language: Language) -> (Vec<String>, Vec<String>, Vec<String>) {
    let text = lesson.text(language).unwrap();
    let headings = text.markdown.lines().filter(|line| line.starts_with('#'));
    let levels = headings.map(|line| line.chars().take_while(|c| *c == '#').collect());
    // Formulas with words are drawn once for each language.
    let ending = format!(".{}.svg", language.code());
    let links = text.links().into_iter();
    let links = links.map(|link| link.target.replace(&ending, ".svg"));
    let listings = text.listings().into_iter().map(|listing| listing.code);
    (levels.collect(), links.collect(), listings.collect())
}

#[test]
fn both_languages_have_the_same_parts() {
    for (_, lesson) in all() {
        let [english, spanish] = Language::ALL.map(|(_, language)| shape(&lesson, language));
        assert_eq!(english, spanish, "{}", lesson.name);
    }
}

#[test]
fn tasks_go_from_theory_to_validation() {
    let parts = ["Theory", "Equation", "Listing", "Picture", "Validation"];
    for (_, lesson) in all() {
        let text = lesson.text(Language::English).unwrap();
        for task in &lesson.about.tasks {
            let after = text
                .markdown
                .split(&format!("<a id=\"{}\"></a>", task.read))
                .nth(1)
                .unwrap();
            let section = after.split("<a id=").next().unwrap();
            let headings: Vec<&str> = section
                .lines()
                .filter_map(|line| line.strip_prefix("### "))
                .collect();
            assert_eq!(headings, parts, "{}: {}", lesson.name, task.id);
        }
    }
}

#[test]
fn no_answer_is_shipped() {
    let files = Files::shipped();
    let listed = files.list("lessons", "").unwrap();
    assert!(listed.iter().any(|file| file.path.ends_with("lesson.toml")));
    for file in listed {
        let kept_back = ["/solution/", "/hidden/"];
        assert!(
            !kept_back.iter().any(|part| file.path.contains(part)),
            "{}",
            file.path
        );
    }
}
