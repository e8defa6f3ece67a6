//! Material libraries: a first reading line by line, for the same reasons as
//! that of the OBJ file, then the parser.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::sync::Arc;

use super::clean::{keyword, logical_lines, shortened};
use super::{Warning, Warnings, text_of};
use crate::Digest;
use crate::cache::{Kept, Reuse};
use crate::files::{Files, join};

/// A material as its library has it.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) material: tobj::Material,
    /// Of the library, for paths of pictures.
    pub(super) library: String,
    /// Where its library names each picture first.
    pub(super) map_lines: Arc<HashMap<String, usize>>,
}

/// What a library holds, and what is wrong with it.
struct Library {
    entries: Vec<Entry>,
    warnings: Vec<Warning>,
    file_bytes: usize,
}

impl Kept for Arc<Library> {
    fn bytes(&self) -> usize {
        // The materials are about as long as their text.
        self.file_bytes
    }
}

/// Reads all libraries that an OBJ file names; what is wrong becomes warnings.
pub(super) fn load_libraries(
    files: &Files,
    reuse: &Reuse,
    obj: &str,
    libraries: &[(String, usize)],
    warnings: &mut Warnings,
) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (names, line) in libraries {
        // One name with spaces, or several names.
        let whole = join(obj, names).ok().filter(|path| files.exists(path));
        let single = [names.as_str()];
        let parts: Vec<&str> = match whole {
            Some(_) => single.to_vec(),
            None => names.split_whitespace().collect(),
        };
        // One warning, and for the whole name where no part of it exists.
        let any = parts.iter().any(|name| find(files, obj, name).is_some());
        for name in if any { parts } else { single.to_vec() } {
            match find(files, obj, name) {
                Some(path) => {
                    let library = read_library(files, reuse, &path);
                    entries.extend(library.entries.iter().cloned());
                    warnings.add_all(&library.warnings);
                }
                None => warnings.add(
                    *line,
                    &format!("the material file `{name}` is not there; put it beside the model"),
                ),
            }
        }
    }
    entries
}

/// Where a file named by another one is: at its path, or else, as for absolute
/// paths of another computer, beside the file that names it; with the letters
/// as given, or else with other capitals.
pub(super) fn find(files: &Files, from: &str, name: &str) -> Option<String> {
    let at_path = join(from, name).ok();
    let base = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let beside = join(from, base).ok();
    let places: Vec<String> = [at_path, beside].into_iter().flatten().collect();
    let exact = places.iter().find(|path| files.exists(path)).cloned();
    exact.or_else(|| {
        places
            .iter()
            .find_map(|path| files.find_ignoring_case(path))
    })
}

fn read_library(files: &Files, reuse: &Reuse, path: &str) -> Arc<Library> {
    let shown = files.display(path);
    match files.read(path) {
        Ok(bytes) => reuse.get("mtl", &(path, &shown, Digest::of(&bytes)), || {
            Arc::new(parse_library(path, &shown, bytes))
        }),
        Err(error) => Arc::new(Library {
            entries: Vec::new(),
            warnings: vec![Warning {
                path: shown,
                line: None,
                message: error.to_string(),
            }],
            file_bytes: 0,
        }),
    }
}

fn parse_library(path: &str, shown: &str, bytes: Vec<u8>) -> Library {
    let mut library = Library {
        entries: Vec::new(),
        warnings: Vec::new(),
        file_bytes: bytes.len(),
    };
    let mut warnings = Warnings::new(shown);
    match text_of(shown, bytes) {
        Ok(text) => {
            let (clean, map_lines) = clean(shown, &text, &mut warnings);
            let map_lines = Arc::new(map_lines);
            match tobj::load_mtl_buf(&mut clean.as_bytes()) {
                Ok((materials, _)) => {
                    library.entries = materials
                        .into_iter()
                        .map(|material| Entry {
                            material,
                            library: path.to_owned(),
                            map_lines: Arc::clone(&map_lines),
                        })
                        .collect();
                }
                Err(error) => {
                    let message = format!("the materials could not be read ({error})");
                    warnings.add_in(shown, None, &message);
                }
            }
        }
        Err(problem) => warnings.add_in(shown, None, &problem.message),
    }
    library.warnings = warnings.list;
    library
}

/// Keeps the lines that are carried, in the form that the parser reads, and
/// notes where pictures are named.
fn clean(path: &str, text: &str, warnings: &mut Warnings) -> (String, HashMap<String, usize>) {
    let mut clean = String::new();
    let mut map_lines = HashMap::new();
    let mut named = false;
    for (line, content) in logical_lines(text) {
        let (word, rest) = keyword(&content);
        let values = rest.split('#').next().unwrap_or("").trim();
        let mut warn = |message: &str| warnings.add_in(path, Some(line), message);
        // Writing to a string can't fail.
        let lower = word.to_ascii_lowercase();
        match lower.as_str() {
            "newmtl" => {
                named = !rest.is_empty();
                if named {
                    let _ = writeln!(clean, "newmtl {rest}");
                } else {
                    warn("a material without a name was left out");
                }
            }
            _ if !named => {}
            "kd" | "ks" | "ke" => match color(values) {
                Some([r, g, b]) => {
                    let _ = writeln!(clean, "K{} {r} {g} {b}", &lower[1..]);
                }
                None => warn(&format!(
                    "`{} {}` is no colour of three numbers",
                    word,
                    shortened(values)
                )),
            },
            "ns" | "d" | "tr" | "pr" | "pm" => {
                match values.split_whitespace().last().and_then(number) {
                    Some(value) if lower == "ns" => {
                        let _ = writeln!(clean, "Ns {value}");
                    }
                    Some(value) if lower.starts_with('p') => {
                        let _ = writeln!(clean, "{lower} {value}");
                    }
                    Some(value) => {
                        let _ = writeln!(
                            clean,
                            "d {}",
                            if lower == "tr" { 1.0 - value } else { value }
                        );
                    }
                    None => warn(&format!("`{} {}` is no number", word, shortened(values))),
                }
            }
            "map_kd" | "map_d" | "map_bump" | "bump" | "norm" => {
                let key = match lower.as_str() {
                    "map_kd" => "map_Kd",
                    "map_d" => "map_d",
                    "norm" => "norm",
                    _ => "map_Bump",
                };
                if rest.is_empty() {
                    warn(&format!("`{word}` names no picture"));
                } else {
                    map_lines.entry(rest.to_owned()).or_insert(line);
                    let _ = writeln!(clean, "{key} {rest}");
                }
            }
            _ => {}
        }
    }
    (clean, map_lines)
}

/// Three numbers; one alone stands for all.
fn color(values: &str) -> Option<[f32; 3]> {
    let values: Option<Vec<f32>> = values.split_whitespace().map(number).collect();
    match values?.as_slice() {
        [grey] => Some([*grey; 3]),
        [r, g, b, ..] => Some([*r, *g, *b]),
        _ => None,
    }
}

fn number(word: &str) -> Option<f32> {
    word.parse().ok().filter(|value: &f32| value.is_finite())
}

/// A picture as a material names it: options, then a path that may have spaces.
#[derive(Debug, PartialEq)]
pub(super) struct Map<'a> {
    pub(super) path: &'a str,
    /// `-bm`: strength of a height map.
    pub(super) bump: f32,
}

pub(super) fn parse_map(value: &str) -> Map<'_> {
    let mut map = Map {
        path: value.trim(),
        bump: 1.0,
    };
    while map.path.starts_with('-') {
        let (option, rest) = keyword(map.path);
        let (least, most) = match option {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-boost" | "-bm" | "-cc" | "-clamp" | "-colorspace"
            | "-imfchan" | "-texres" | "-type" => (1, 1),
            _ => break,
        };
        map.path = rest;
        for at in 0..most {
            let (value, rest) = keyword(map.path);
            if at >= least && number(value).is_none() {
                break;
            }
            if option == "-bm" {
                map.bump = number(value).unwrap_or(1.0);
            }
            map.path = rest;
        }
    }
    map
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_before_a_path_with_spaces() {
        for (value, path, bump) in [
            ("wood.png", "wood.png", 1.0),
            ("my nice wood.png", "my nice wood.png", 1.0),
            ("-bm 0.3 -clamp on my wood.png", "my wood.png", 0.3),
            ("-s 2 2 a.png", "a.png", 1.0),
            ("-s 2 2 2 -o 1 2b.png", "2b.png", 1.0),
            ("-mm 0 1 -type sphere x y.png", "x y.png", 1.0),
            ("-odd.png", "-odd.png", 1.0),
            ("-bm", "", 1.0),
            ("-bm x y", "y", 1.0),
        ] {
            assert_eq!(parse_map(value), Map { path, bump }, "{value}");
        }
    }

    #[test]
    fn only_lines_that_the_parser_survives_are_left() {
        let mut warnings = Warnings::new("x.obj");
        let text = "Kd 1 1 1\nnewmtl a b\n\tKd 0.5\nKs 1 2\nKe spectral x.rfl\nNs\nillum 2.5\nTr 0.25\nmap_Kd\n\
                    MAP_KD x y.png\nd -halo 0.5\nnewmtl\nKd 1 0 0\n";
        let (clean, map_lines) = clean("x.mtl", text, &mut warnings);
        assert_eq!(map_lines, HashMap::from([("x y.png".to_owned(), 10)]));
        assert_eq!(
            clean,
            "newmtl a b\nKd 0.5 0.5 0.5\nd 0.75\nmap_Kd x y.png\nd 0.5\n"
        );
        let lines: Vec<_> = warnings.list.iter().map(|warning| warning.line).collect();
        assert_eq!(lines, [Some(4), Some(5), Some(6), Some(9), Some(12)]);
    }
}
