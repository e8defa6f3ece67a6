//! The text of a lesson as blocks, for whoever shows it: the editor, and the page that is printed.

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag};

/// The folder of formulas: drawings of one colour on paper, each beside the TeX that it is made from.
pub const FORMULAS: &str = "figures/formulas/";
/// The colour of formulas in their files.
pub const FORMULA_INK: &str = "#1f2328";

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// A place that links and messages name.
    Place(String),
    /// A heading.
    Heading {
        /// From 1, the title.
        level: u8,
        /// Its words.
        content: Vec<Piece>,
    },
    /// A paragraph.
    Paragraph(Vec<Piece>),
    /// A list.
    List {
        /// The first number, where items are counted.
        first: Option<u64>,
        /// The items.
        items: Vec<Vec<Block>>,
    },
    /// Code, or lines to type.
    Code {
        /// The language, as `wgsl`; may be empty.
        language: String,
        /// Where the code is from: a file, and after `#` a place in it.
        target: Option<String>,
        /// The lines.
        text: String,
    },
    /// A picture that stands alone.
    Figure {
        /// Its file, in the lesson's folder.
        path: String,
        /// What it shows.
        alt: String,
    },
    /// Something that is quoted.
    Quote(Vec<Block>),
    /// A table.
    Table(Vec<Vec<Vec<Piece>>>),
    /// A line between parts.
    Rule,
}

/// A part of a paragraph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Words that look alike.
    Run(Run),
    /// A picture between words.
    Picture {
        /// Its file, in the lesson's folder.
        path: String,
        /// What it shows.
        alt: String,
    },
    /// A new line.
    Break,
}

/// Words that look alike.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// The words.
    pub text: String,
    /// In bold type.
    pub strong: bool,
    /// In italics.
    pub emphasis: bool,
    /// As code.
    pub code: bool,
    /// What the words lead to, as it is written.
    pub link: Option<String>,
}

/// Reads a text in Markdown.
#[must_use]
pub fn read_document(markdown: &str) -> Vec<Block> {
    let options = Options::ENABLE_TABLES;
    let events = Parser::new_ext(markdown, options);
    Reader { events }.blocks()
}

/// A formula without the paper that it lies on, in another ink: any colour of SVG.
#[must_use]
pub fn formula_without_paper(svg: &str, ink: &str) -> String {
    let lines = svg.lines().filter(|line| !line.contains("class=\"paper\""));
    let lines: Vec<&str> = lines.collect();
    lines.join("\n").replace(FORMULA_INK, ink)
}

/// Whether a formula is drawn with outlines alone, and so looks alike everywhere.
#[must_use]
pub fn has_glyphs_only(svg: &str) -> bool {
    !svg.contains("<text") && !svg.contains("<image")
}

/// Pieces of a paragraph, and the places that stand in it.
#[derive(Default)]
struct Line {
    places: Vec<String>,
    pieces: Vec<Piece>,
}

impl Line {
    fn text(&mut self, style: &Run, text: &str) {
        if let Some(Piece::Run(last)) = self.pieces.last_mut() {
            let same = Run {
                text: last.text.clone(),
                ..style.clone()
            };
            if *last == same {
                last.text.push_str(text);
                return;
            }
        }
        self.pieces.push(Piece::Run(Run {
            text: text.to_owned(),
            ..style.clone()
        }));
    }

    /// Gives up what it holds, as blocks.
    fn end(&mut self, found: &mut Vec<Block>, block: impl FnOnce(Vec<Piece>) -> Block) {
        found.extend(self.places.drain(..).map(Block::Place));
        let pieces = std::mem::take(&mut self.pieces);
        let is_blank =
            |piece: &Piece| matches!(piece, Piece::Run(run) if run.text.trim().is_empty());
        if !pieces.iter().all(is_blank) {
            found.push(block(pieces));
        }
    }
}

/// A paragraph, or the picture that it consists of.
fn paragraph(pieces: Vec<Piece>) -> Block {
    match pieces.as_slice() {
        [Piece::Picture { path, alt }] => Block::Figure {
            path: path.clone(),
            alt: alt.clone(),
        },
        _ => Block::Paragraph(pieces),
    }
}

struct Reader<'a> {
    events: Parser<'a>,
}

impl Reader<'_> {
    /// All blocks up to the end of what contains them.
    fn blocks(&mut self) -> Vec<Block> {
        let mut found = Vec::new();
        // Items of lists may hold words without a paragraph.
        let mut loose = Line::default();
        while let Some(event) = self.events.next() {
            match event {
                Event::End(_) => break,
                Event::Rule => found.push(Block::Rule),
                Event::Start(tag) if is_of_lines(&tag) => {
                    self.inline(tag, &Run::default(), &mut loose);
                }
                Event::Start(tag) => {
                    loose.end(&mut found, paragraph);
                    self.block(tag, &mut found);
                }
                other => piece(&other, &Run::default(), &mut loose),
            }
        }
        loose.end(&mut found, paragraph);
        found
    }

    fn block(&mut self, tag: Tag, found: &mut Vec<Block>) {
        match tag {
            Tag::Paragraph => self.line().end(found, paragraph),
            Tag::Heading { level, .. } => {
                let level = level as u8;
                let heading = |content| Block::Heading { level, content };
                self.line().end(found, heading);
            }
            Tag::List(first) => {
                let mut items = Vec::new();
                while let Some(Event::Start(_)) = self.events.next() {
                    items.push(self.blocks());
                }
                found.push(Block::List { first, items });
            }
            Tag::CodeBlock(kind) => {
                let about = match kind {
                    CodeBlockKind::Fenced(about) => about.to_string(),
                    CodeBlockKind::Indented => String::new(),
                };
                let mut words = about.split_whitespace().map(str::to_owned);
                let (language, target) = (words.next().unwrap_or_default(), words.next());
                let text = self.raw();
                found.push(Block::Code {
                    language,
                    target,
                    text,
                });
            }
            Tag::BlockQuote(_) => {
                let quoted = self.blocks();
                found.push(Block::Quote(quoted));
            }
            Tag::Table(_) => {
                let mut rows = Vec::new();
                while let Some(Event::Start(_)) = self.events.next() {
                    let mut row = Vec::new();
                    while let Some(Event::Start(_)) = self.events.next() {
                        row.push(self.line().pieces);
                    }
                    rows.push(row);
                }
                found.push(Block::Table(rows));
            }
            Tag::HtmlBlock => {
                let html = self.raw();
                found.extend(place(&html).map(Block::Place));
            }
            _ => found.extend(self.blocks()),
        }
    }

    /// The pieces up to the end of what contains them.
    fn line(&mut self) -> Line {
        let mut line = Line::default();
        self.pieces(&Run::default(), &mut line);
        line
    }

    fn pieces(&mut self, style: &Run, line: &mut Line) {
        while let Some(event) = self.events.next() {
            match event {
                Event::End(_) => break,
                Event::Start(tag) => self.inline(tag, style, line),
                other => piece(&other, style, line),
            }
        }
    }

    fn inline(&mut self, tag: Tag, style: &Run, line: &mut Line) {
        let mut style = style.clone();
        match tag {
            Tag::Image { dest_url, .. } => {
                let alt = self.raw();
                let path = dest_url.to_string();
                line.pieces.push(Piece::Picture { path, alt });
                return;
            }
            Tag::Emphasis => style.emphasis = true,
            Tag::Strong => style.strong = true,
            Tag::Link { dest_url, .. } => style.link = Some(dest_url.to_string()),
            _ => {}
        }
        self.pieces(&style, line);
    }

    /// The text up to the end of what contains it, without its looks.
    fn raw(&mut self) -> String {
        let mut text = String::new();
        let mut depth = 0;
        for event in self.events.by_ref() {
            match event {
                Event::Start(_) => depth += 1,
                Event::End(_) if depth == 0 => break,
                Event::End(_) => depth -= 1,
                Event::Text(part) | Event::Code(part) | Event::Html(part) => text.push_str(&part),
                Event::SoftBreak | Event::HardBreak => text.push(' '),
                _ => {}
            }
        }
        text
    }
}

fn is_of_lines(tag: &Tag) -> bool {
    matches!(
        tag,
        Tag::Emphasis | Tag::Strong | Tag::Link { .. } | Tag::Image { .. }
    )
}

fn piece(event: &Event, style: &Run, line: &mut Line) {
    match event {
        Event::Text(text) => line.text(style, text),
        Event::Code(text) => {
            let code = Run {
                code: true,
                ..style.clone()
            };
            line.text(&code, text);
        }
        Event::SoftBreak => line.text(style, " "),
        Event::HardBreak => line.pieces.push(Piece::Break),
        Event::InlineHtml(html) | Event::Html(html) => line.places.extend(place(html)),
        _ => {}
    }
}

/// The place that `<a id="…">` makes.
fn place(html: &str) -> Option<String> {
    let rest = html.split("<a id=\"").nth(1)?;
    rest.split('"').next().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(text: &str) -> Piece {
        Piece::Run(Run {
            text: text.to_owned(),
            ..Run::default()
        })
    }

    #[test]
    fn a_text_is_read_into_blocks() {
        let text = "\
<a id=\"one\"></a>
# One *two*
A line
goes on with `code`, [a **link**](a.wgsl#f) and ![E](figures/formulas/e.svg).

![A ball](figures/a.png)

```wgsl a.wgsl#f
fn f() {}
```

1. first
2. second

   more

- tight `x`

| a | b |
| --- | --- |
| 1 | 2 |
";
        let blocks = read_document(text);
        assert_eq!(blocks[0], Block::Place("one".to_owned()));
        let emphasis = Piece::Run(Run {
            text: "two".to_owned(),
            emphasis: true,
            ..Run::default()
        });
        let title = Block::Heading {
            level: 1,
            content: vec![run("One "), emphasis],
        };
        assert_eq!(blocks[1], title);
        let Block::Paragraph(pieces) = &blocks[2] else {
            panic!("{blocks:?}");
        };
        assert_eq!(pieces[0], run("A line goes on with "));
        let link = Piece::Run(Run {
            text: "link".to_owned(),
            strong: true,
            link: Some("a.wgsl#f".to_owned()),
            ..Run::default()
        });
        assert_eq!(pieces[4], link);
        let formula = Piece::Picture {
            path: "figures/formulas/e.svg".to_owned(),
            alt: "E".to_owned(),
        };
        assert_eq!(pieces[6], formula);
        let figure = Block::Figure {
            path: "figures/a.png".to_owned(),
            alt: "A ball".to_owned(),
        };
        assert_eq!(blocks[3], figure);
        let code = Block::Code {
            language: "wgsl".to_owned(),
            target: Some("a.wgsl#f".to_owned()),
            text: "fn f() {}\n".to_owned(),
        };
        assert_eq!(blocks[4], code);
        let Block::List { first, items } = &blocks[5] else {
            panic!("{blocks:?}");
        };
        assert_eq!((*first, items.len()), (Some(1), 2));
        assert_eq!(items[1][1], Block::Paragraph(vec![run("more")]));
        let Block::List { first, items } = &blocks[6] else {
            panic!("{blocks:?}");
        };
        assert_eq!((*first, items[0].len()), (None, 1));
        let row = |a: &str, b: &str| vec![vec![run(a)], vec![run(b)]];
        assert_eq!(blocks[7], Block::Table(vec![row("a", "b"), row("1", "2")]));
        assert_eq!(blocks.len(), 8);
    }

    #[test]
    fn a_formula_loses_its_paper_and_takes_another_ink() {
        let svg = "<svg>\n<rect class=\"paper\" fill=\"#fff\"/>\n<g fill=\"#1f2328\"></g>\n</svg>";
        assert_eq!(
            formula_without_paper(svg, "currentColor"),
            "<svg>\n<g fill=\"currentColor\"></g>\n</svg>"
        );
    }
}
