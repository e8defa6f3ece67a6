//! A first reading of an OBJ file, line by line.
//!
//! The parser that follows knows no line numbers, stops or even panics on some
//! odd lines, and silently misreads others (faces of which only some corners
//! have texture coordinates, lines, comments behind numbers). So every line is
//! checked here, where its number is known, and handed on in one plain form:
//! all vertices first, then faces whose corners all name a position, a texture
//! coordinate and a normal. What a corner does not have points to an entry
//! that is not a number.

use std::fmt::Write as _;

use super::{Problem, Warnings};

/// The largest coordinate, in the file's unit: beyond it, single precision
/// squares overflow.
const MAX_COORDINATE: f32 = 1e12;

/// What the first reading gives.
pub(super) struct Clean {
    /// The file in plain form, without materials' libraries.
    pub(super) text: String,
    /// Material libraries with the line that names them first.
    pub(super) libraries: Vec<(String, usize)>,
    /// Materials with the line that uses them first.
    pub(super) materials: Vec<(String, usize)>,
}

/// A corner of a face: numbers from 1, 0 where there is none.
type Corner = [u32; 3];

/// One line of faces' part of the file.
enum Item {
    Face {
        line: usize,
        first: usize,
        count: usize,
    },
    Material(usize),
}

/// What the three numbers of a corner count.
const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

#[derive(Default)]
struct Reader {
    /// Positions, texture coordinates and normals in plain form, and counts.
    lines: [String; 3],
    counts: [u32; 3],
    corners: Vec<Corner>,
    items: Vec<Item>,
    libraries: Vec<(String, usize)>,
    materials: Vec<(String, usize)>,
    /// The material that the next face brings into use.
    chosen: Option<(String, usize)>,
}

/// Checks a file and brings it into plain form.
pub(super) fn clean(path: &str, text: &str, warnings: &mut Warnings) -> Result<Clean, Problem> {
    let mut reader = Reader::default();
    let problem = |line: usize, message: String| Problem {
        path: path.to_owned(),
        line: Some(line),
        message,
    };
    for (line, content) in logical_lines(text) {
        reader
            .line(line, &content, warnings)
            .map_err(|message| problem(line, message))?;
    }
    reader
        .check_indices()
        .map_err(|(line, message)| problem(line, message))?;
    let whole_file = |message: &str| Problem {
        path: path.to_owned(),
        line: None,
        message: message.to_owned(),
    };
    if reader.counts[0] == 0 {
        return Err(whole_file(
            "there are no vertices in it; is it an OBJ file, and complete?",
        ));
    }
    if !reader
        .items
        .iter()
        .any(|item| matches!(item, Item::Face { .. }))
    {
        return Err(whole_file(
            "there are no faces in it; export the model with its faces",
        ));
    }
    Ok(reader.finish())
}

/// Lines with their numbers from 1. A backslash at the end joins the next one.
pub(super) fn logical_lines(
    text: &str,
) -> impl Iterator<Item = (usize, std::borrow::Cow<'_, str>)> {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let Some(start) = first.trim_end().strip_suffix('\\') else {
            return Some((number + 1, first.into()));
        };
        let mut joined = start.to_owned();
        for (_, next) in lines.by_ref() {
            joined.push(' ');
            match next.trim_end().strip_suffix('\\') {
                Some(part) => joined.push_str(part),
                None => {
                    joined.push_str(next);
                    break;
                }
            }
        }
        Some((number + 1, joined.into()))
    })
}

/// The first word of a line and what follows.
pub(super) fn keyword(line: &str) -> (&str, &str) {
    let line = line.trim();
    match line.split_once(char::is_whitespace) {
        Some((word, rest)) => (word, rest.trim()),
        None => (line, ""),
    }
}

impl Reader {
    fn line(&mut self, number: usize, line: &str, warnings: &mut Warnings) -> Result<(), String> {
        let (word, rest) = keyword(line);
        let values = rest.split('#').next().unwrap_or("");
        match word {
            "v" => self.position(values)?,
            "vt" => self.optional(1, 2, number, values, warnings),
            "vn" => self.optional(2, 3, number, values, warnings),
            "f" | "fo" => self.face(number, values, warnings)?,
            "l" | "p" => warnings.add(number, "lines and points are not drawn"),
            "mtllib"
                if !rest.is_empty() && !self.libraries.iter().any(|(known, _)| known == rest) =>
            {
                self.libraries.push((rest.to_owned(), number));
            }
            "usemtl" => self.chosen = Some((rest.to_owned(), number)),
            // Names, groups, smoothing groups, curves and comments.
            _ => {}
        }
        Ok(())
    }

    fn position(&mut self, values: &str) -> Result<(), String> {
        let mut words = values.split_whitespace();
        self.lines[0].push('v');
        for _ in 0..3 {
            let Some(word) = words.next() else {
                return Err("a vertex needs three numbers; is the file complete?".to_owned());
            };
            let Ok(value) = word.parse::<f32>() else {
                return Err(format!("`{}` is no number", shortened(word)));
            };
            if !value.is_finite() {
                return Err(format!(
                    "a vertex has the coordinate {word}; export the model again"
                ));
            }
            if value.abs() > MAX_COORDINATE {
                return Err(format!(
                    "the coordinate {word} is too large; scale the model down"
                ));
            }
            self.lines[0].push(' ');
            self.lines[0].push_str(word);
        }
        // A weight or a colour may follow; neither is used.
        self.lines[0].push('\n');
        self.counts[0] += 1;
        Ok(())
    }

    /// A texture coordinate or a normal. Exporters write ones that are not
    /// numbers for faces without area; they count as missing.
    fn optional(
        &mut self,
        kind: usize,
        size: usize,
        number: usize,
        values: &str,
        warnings: &mut Warnings,
    ) {
        let lines = &mut self.lines[kind];
        let start = lines.len();
        lines.push_str(["v", "vt", "vn"][kind]);
        let mut words = values.split_whitespace();
        let valid = (0..size).all(|component| {
            // A texture coordinate may have u alone.
            let word = words
                .next()
                .or((component == 1 && kind == 1).then_some("0"));
            let number = word.filter(|word| {
                word.parse::<f32>()
                    .is_ok_and(|value| value.abs() <= MAX_COORDINATE)
            });
            lines.push(' ');
            lines.push_str(number.unwrap_or(""));
            number.is_some()
        });
        if !valid {
            lines.truncate(start);
            lines.push_str(["v", "vt nan nan", "vn nan nan nan"][kind]);
            warnings.add(
                number,
                &format!("a {} that is no set of numbers was left out", KINDS[kind]),
            );
        }
        lines.push('\n');
        self.counts[kind] += 1;
    }

    fn face(&mut self, number: usize, values: &str, warnings: &mut Warnings) -> Result<(), String> {
        let first = self.corners.len();
        for word in values.split_whitespace() {
            let mut corner = [0; 3];
            for (kind, part) in word.split('/').enumerate() {
                if kind > 2 {
                    return Err(format!("`{}` is no corner of a face", shortened(word)));
                }
                if !part.is_empty() {
                    corner[kind] = self.index(kind, part)?;
                }
            }
            if corner[0] == 0 {
                return Err(format!("`{}` names no vertex", shortened(word)));
            }
            self.corners.push(corner);
        }
        let count = self.corners.len() - first;
        if count < 3 {
            self.corners.truncate(first);
            warnings.add(number, "a face with fewer than three corners was left out");
        } else {
            self.use_material();
            self.items.push(Item::Face {
                line: number,
                first,
                count,
            });
        }
        Ok(())
    }

    /// Brings the material that was chosen last into use.
    fn use_material(&mut self) {
        let Some(chosen) = self.chosen.take() else {
            return;
        };
        let known = self
            .materials
            .iter()
            .position(|(known, _)| *known == chosen.0);
        let material = known.unwrap_or_else(|| {
            self.materials.push(chosen);
            self.materials.len() - 1
        });
        self.items.push(Item::Material(material));
    }

    /// A number from 1; a negative one counts back from the latest.
    fn index(&self, kind: usize, word: &str) -> Result<u32, String> {
        let Ok(given) = word.parse::<i64>() else {
            return Err(format!(
                "`{}` is no number of a {}",
                shortened(word),
                KINDS[kind]
            ));
        };
        let index = if given < 0 {
            i64::from(self.counts[kind]) + 1 + given
        } else {
            given
        };
        match u32::try_from(index) {
            Ok(index) if index > 0 => Ok(index),
            _ => Err(out_of_range(kind, given, self.counts[kind])),
        }
    }

    /// Faces may come before what they name, so ranges are checked at the end.
    fn check_indices(&self) -> Result<(), (usize, String)> {
        for item in &self.items {
            let Item::Face { line, first, count } = *item else {
                continue;
            };
            for corner in &self.corners[first..first + count] {
                for (kind, (&index, &count)) in corner.iter().zip(&self.counts).enumerate() {
                    if index > count {
                        return Err((line, out_of_range(kind, i64::from(index), count)));
                    }
                }
            }
        }
        Ok(())
    }

    fn finish(self) -> Clean {
        let [positions, uvs, normals] = self.lines;
        let mut text = positions;
        text.reserve(uvs.len() + normals.len() + self.corners.len() * 20 + 64);
        text.push_str(&uvs);
        text.push_str("vt nan nan\n");
        text.push_str(&normals);
        text.push_str("vn nan nan nan\n");
        // The parser knows materials only from a library that came before.
        text.push_str("mtllib all\n");
        let missing = self.counts.map(|count| count + 1);
        for item in &self.items {
            match *item {
                // By number, so that no name can be mistaken.
                Item::Material(material) => {
                    let _ = writeln!(text, "usemtl {material}");
                }
                Item::Face { first, count, .. } => {
                    text.push('f');
                    for corner in &self.corners[first..first + count] {
                        let or_missing = |kind: usize| {
                            if corner[kind] == 0 {
                                missing[kind]
                            } else {
                                corner[kind]
                            }
                        };
                        // Writing to a string can't fail.
                        let _ = write!(text, " {}/{}/{}", corner[0], or_missing(1), or_missing(2));
                    }
                    text.push('\n');
                }
            }
        }
        Clean {
            text,
            libraries: self.libraries,
            materials: self.materials,
        }
    }
}

fn out_of_range(kind: usize, given: i64, count: u32) -> String {
    let kind = KINDS[kind];
    format!("a face names {kind} {given}, and the file has {count}; is the file complete?")
}

/// A word of the file, short enough for a message.
pub(super) fn shortened(word: &str) -> String {
    let mut short: String = word.chars().filter(|c| !c.is_control()).take(24).collect();
    if short.len() < word.len() {
        short.push('…');
    }
    short
}
