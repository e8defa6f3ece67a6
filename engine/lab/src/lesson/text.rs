//! The text of a lesson: its places, its links and its listings.

use std::collections::BTreeSet;

use super::words::Language;

/// The file that holds a lesson's text.
#[must_use]
pub fn text_file(language: Language) -> String {
    format!("text.{}.md", language.code())
}

/// A text in Markdown.
#[derive(Clone, Debug)]
pub struct Text {
    /// The file's name.
    pub file: String,
    /// What it holds.
    pub markdown: String,
}

/// Something that a text points to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// The line that it stands in, from 1.
    pub line: u32,
    /// As it is written, as `starter/shaders/a.wgsl#lambert`.
    pub target: String,
}

/// Code that a text shows, and says where it is from: a block whose language is followed by a file
/// and, after `#`, a place in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listing {
    /// The line that it begins in, from 1.
    pub line: u32,
    /// The file, as in a link.
    pub target: String,
    /// What is shown.
    pub code: String,
}

impl Text {
    /// A text of a file.
    #[must_use]
    pub fn new(file: &str, markdown: String) -> Self {
        Self {
            file: file.to_owned(),
            markdown,
        }
    }

    /// The places that can be named: what stands in `<a id="…"></a>`.
    #[must_use]
    pub fn places(&self) -> BTreeSet<&str> {
        let parts = self.markdown.split("<a id=\"").skip(1);
        parts.filter_map(|rest| rest.split('"').next()).collect()
    }

    /// The heading that a place stands before, without its marks.
    #[must_use]
    pub fn title_of(&self, place: &str) -> Option<&str> {
        let anchor = format!("<a id=\"{place}\">");
        let (_, rest) = self.markdown.split_once(&anchor)?;
        let heading = rest.lines().skip(1).find(|line| !line.trim().is_empty())?;
        let title = heading.strip_prefix('#')?.trim_start_matches('#');
        Some(title.trim())
    }

    /// All links and pictures outside of code.
    #[must_use]
    pub fn links(&self) -> Vec<Link> {
        let mut found = Vec::new();
        let mut in_code = false;
        for (line, text) in (1..).zip(self.markdown.lines()) {
            if text.trim_start().starts_with("```") {
                in_code = !in_code;
                continue;
            }
            if in_code {
                continue;
            }
            let mut rest = text;
            while let Some(at) = rest.find("](") {
                rest = &rest[at + 2..];
                let Some(end) = rest.find(')') else {
                    break;
                };
                found.push(Link {
                    line,
                    target: rest[..end].to_owned(),
                });
                rest = &rest[end..];
            }
        }
        found
    }

    /// All listings that say where they are from.
    #[must_use]
    pub fn listings(&self) -> Vec<Listing> {
        let mut found: Vec<Listing> = Vec::new();
        let mut open: Option<Option<Listing>> = None;
        for (line, text) in (1..).zip(self.markdown.lines()) {
            let fence = text.trim_start().strip_prefix("```");
            match (fence, &mut open) {
                (Some(_), Some(listing)) => {
                    found.extend(listing.take());
                    open = None;
                }
                (Some(about), None) => {
                    let target = about.split_whitespace().nth(1);
                    open = Some(target.map(|target| Listing {
                        line,
                        target: target.to_owned(),
                        code: String::new(),
                    }));
                }
                (None, Some(Some(listing))) => {
                    listing.code += text;
                    listing.code.push('\n');
                }
                (None, _) => {}
            }
        }
        found
    }
}

/// Whether a file has a place of that name: something that it declares (`fn`, `const`, `let`, `struct`,
/// `var`), or a line with `TASK` and the name.
#[must_use]
pub fn has_place(code: &str, name: &str) -> bool {
    place_line(code, name).is_some()
}

/// The line of such a place, from 1. A line with `TASK` comes before a declaration of the same name.
#[must_use]
pub fn place_line(code: &str, name: &str) -> Option<usize> {
    let first = |declares: &[&str]| {
        let mut lines = code.lines();
        let at = lines.position(|line| {
            let words: Vec<&str> = line
                .split(|c: char| !c.is_alphanumeric() && c != '_')
                .collect();
            let mut pairs = words.windows(2);
            pairs.any(|pair| declares.contains(&pair[0]) && pair[1] == name)
        });
        at.map(|index| index + 1)
    };
    first(&["TASK"]).or_else(|| first(&["fn", "const", "let", "struct", "var", "alias"]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
<a id=\"one\"></a>
# One
See [the code](shaders/a.wgsl#f) and ![a picture](figures/a.png).

```wgsl shaders/a.wgsl#f
fn f() {
}
```

```sh
echo [no](link)
```
";

    #[test]
    fn a_place_has_the_title_of_its_heading() {
        let text = Text::new("text.en.md", TEXT.to_owned());
        assert_eq!(text.title_of("one"), Some("One"));
        assert_eq!(text.title_of("none"), None);
        let bare = Text::new("a.md", "<a id=\"x\"></a>\nNo heading.\n# Later".to_owned());
        assert_eq!(bare.title_of("x"), None);
    }

    #[test]
    fn a_text_knows_its_places_links_and_listings() {
        let text = Text::new("text.en.md", TEXT.to_owned());
        assert_eq!(text.places(), BTreeSet::from(["one"]));
        let links: Vec<_> = text
            .links()
            .into_iter()
            .map(|l| (l.line, l.target))
            .collect();
        assert_eq!(
            links,
            [
                (3, "shaders/a.wgsl#f".to_owned()),
                (3, "figures/a.png".to_owned())
            ]
        );
        let listing = Listing {
            line: 5,
            target: "shaders/a.wgsl#f".to_owned(),
            code: "fn f() {\n}\n".to_owned(),
        };
        assert_eq!(text.listings(), [listing]);
    }

    #[test]
    fn places_are_declarations_and_tasks() {
        let code = "// TASK lambert: write it\nfn diffuse(a: f32) -> f32 {\nlet b = a;";
        for name in ["lambert", "diffuse", "b"] {
            assert!(has_place(code, name), "{name}");
        }
        assert!(!has_place(code, "a"));
        assert_eq!(place_line(code, "diffuse"), Some(2));
        let code = "fn lambert() {}\n// TASK lambert";
        assert_eq!(place_line(code, "lambert"), Some(2));
    }
}
