//! A WGSL file as the preprocessor leaves it: branches that are not taken, directives and comments
//! are blank, and every line and column is where a person wrote it.
//!
//! The composer has a preprocessor of its own, which loses count of columns. This one finds the
//! mistakes in directives first, each at its place.

use std::collections::{BTreeMap, BTreeSet};

use crate::problem::{Place, Problem, suggestion};

use super::depth::check_depth;
use super::imports::{Import, parse_import};
use super::tokens::{is_word, without_comments};

/// The defines that a file sees: a whole number, or `None` for one that is only there.
pub type Defines = BTreeMap<String, Option<i32>>;

/// One file.
#[derive(Clone, Debug)]
pub struct Listing {
    /// Its path.
    pub path: String,
    /// The text as it was written, with `\n` at the end of each line.
    pub text: String,
    /// What is left of it.
    pub active: String,
    /// What it imports, in branches that are taken and in others.
    pub imports: Vec<Import>,
    /// All defines that it asks for, in any branch.
    pub mentions: BTreeSet<String>,
    /// What it defines itself.
    pub defines: Defines,
}

/// The directives that begin a line.
const DIRECTIVES: [&str; 8] = [
    "#import",
    "#ifdef",
    "#ifndef",
    "#if",
    "#else",
    "#endif",
    "#define",
    "#define_import_path",
];

/// Lines end in `\n`, whatever the editor wrote.
pub fn with_plain_line_ends(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\r', "\n")
}

impl Listing {
    /// Reads a file. `is_module` is whether others import it.
    ///
    /// # Errors
    /// The first mistake in a directive.
    pub fn new(
        path: &str,
        text: &str,
        defines: &Defines,
        is_module: bool,
    ) -> Result<Self, Problem> {
        Self::read(path, text, Some(defines), is_module)
    }

    /// Reads a module that no branch which is taken imports: what it imports and asks for itself.
    ///
    /// # Errors
    /// The first mistake in a directive that is one whatever the defines.
    pub fn outline(path: &str, text: &str) -> Result<Self, Problem> {
        Self::read(path, text, None, true)
    }

    fn read(
        path: &str,
        text: &str,
        defines: Option<&Defines>,
        is_module: bool,
    ) -> Result<Self, Problem> {
        let text = with_plain_line_ends(text);
        let mut reader = Reader {
            path,
            text: &text,
            defines: defines.cloned(),
            is_module,
            branches: Vec::new(),
            imports: Vec::new(),
            mentions: BTreeSet::new(),
            own: Defines::new(),
        };
        let active = reader.read()?;
        check_depth(path, &active)?;
        let (imports, mentions, own) = (reader.imports, reader.mentions, reader.own);
        Ok(Self {
            path: path.to_owned(),
            active,
            imports,
            mentions,
            defines: own,
            text,
        })
    }
}

/// An `#ifdef` or `#if` that waits for its `#endif`.
struct Branch {
    at: Place,
    /// Whether the lines around it are taken.
    around: bool,
    /// Whether one of its branches was taken already.
    decided: bool,
    /// Whether the present one is.
    taken: bool,
}

struct Reader<'a> {
    path: &'a str,
    text: &'a str,
    /// `None` where they are not known: then no value is asked for.
    defines: Option<Defines>,
    is_module: bool,
    branches: Vec<Branch>,
    imports: Vec<Import>,
    mentions: BTreeSet<String>,
    own: Defines,
}

impl Reader<'_> {
    fn read(&mut self) -> Result<String, Problem> {
        let plain = without_comments(self.text);
        let mut active = String::with_capacity(plain.len());
        let mut lines = (1..).zip(plain.split('\n')).peekable();
        while let Some((number, line)) = lines.next() {
            if number > 1 {
                active.push('\n');
            }
            let Some((name, rest, column)) = directive(line) else {
                self.text_line(number, line, &mut active)?;
                continue;
            };
            let at = self.place(number, column);
            blank(line, &mut active);
            if name == "import" {
                // Braces may go on over several lines.
                let mut joined = line.to_owned();
                while open_braces(&joined) {
                    let Some((_, next)) = lines.next() else {
                        break;
                    };
                    joined.push('\n');
                    joined.push_str(next);
                    active.push('\n');
                    blank(next, &mut active);
                }
                let taken = self.taken();
                let found = parse_import(self.path, number, &joined, taken);
                self.imports
                    .extend(found.map_err(|problem| problem.with_source(self.text))?);
            } else {
                self.directive(name, rest, at)?;
            }
        }
        match self.branches.pop() {
            None => Ok(active),
            Some(open) => Err(self.problem(
                open.at,
                "this branch never ends".to_owned(),
                "write `#endif` after its last line",
            )),
        }
    }

    fn taken(&self) -> bool {
        self.branches.last().is_none_or(|branch| branch.taken)
    }

    fn place(&self, line: u32, column: u32) -> Place {
        Place::new(self.path, line, column)
    }

    fn problem(&self, at: Place, message: String, hint: impl Into<String>) -> Problem {
        Problem::new(at, message)
            .with_source(self.text)
            .with_hint(hint)
    }

    fn directive(&mut self, name: &str, rest: &str, at: Place) -> Result<(), Problem> {
        let taken = self.taken();
        match name {
            "ifdef" | "ifndef" | "if" => {
                let holds = self.condition(name, rest, &at, taken)?;
                self.branches.push(Branch {
                    at,
                    around: taken,
                    decided: taken && holds,
                    taken: taken && holds,
                });
            }
            "else" => self.otherwise(rest, at)?,
            "endif" => {
                if self.branches.pop().is_none() {
                    return Err(self.problem(
                        at,
                        "this `#endif` ends nothing".to_owned(),
                        "remove it, or write `#ifdef NAME` where its branch begins",
                    ));
                }
            }
            "define" if self.is_module => {
                return Err(self.problem(
                    at,
                    "a module can't define anything".to_owned(),
                    "write the `#define` into the shader that imports it, or `.define` into the \
                     pipeline",
                ));
            }
            "define" => {
                let mut words = rest.split_whitespace();
                let Some(defined) = words.next().filter(|word| word.chars().all(is_word)) else {
                    return Err(self.problem(
                        at,
                        "this `#define` names nothing".to_owned(),
                        "write `#define NAME`, or `#define NAME 16`",
                    ));
                };
                let value = words.next().and_then(|value| value.parse().ok());
                self.own.insert(defined.to_owned(), value);
                if let Some(defines) = &mut self.defines {
                    defines.insert(defined.to_owned(), value);
                }
            }
            "define_import_path" => {}
            unknown => {
                let unknown = format!("#{unknown}");
                let hint = suggestion(&unknown, DIRECTIVES)
                    .unwrap_or_else(|| format!("the directives are {}", DIRECTIVES.join(", ")));
                let message = format!("there is no directive `{unknown}`");
                return Err(self.problem(at, message, hint));
            }
        }
        Ok(())
    }

    fn otherwise(&mut self, rest: &str, at: Place) -> Result<(), Problem> {
        let Some(open) = self.branches.last() else {
            return Err(self.problem(
                at,
                "this `#else` belongs to no branch".to_owned(),
                "write `#ifdef NAME` where its branch begins",
            ));
        };
        let (around, decided) = (open.around, open.decided);
        let holds = match rest.split_whitespace().next() {
            None => true,
            Some(name @ ("ifdef" | "ifndef" | "if")) => {
                let rest = rest.trim_start()[name.len()..].to_owned();
                self.condition(name, &rest, &at, around && !decided)?
            }
            Some(_) => {
                return Err(self.problem(
                    at,
                    "`#else` stands alone in its line".to_owned(),
                    "to ask for more, write `#else ifdef NAME`",
                ));
            }
        };
        if let Some(open) = self.branches.last_mut() {
            open.taken = around && !decided && holds;
            open.decided |= open.taken;
        }
        Ok(())
    }

    /// Whether `#ifdef NAME`, `#ifndef NAME` or `#if NAME == 3` holds.
    fn condition(
        &mut self,
        directive: &str,
        rest: &str,
        at: &Place,
        asked: bool,
    ) -> Result<bool, Problem> {
        let rest = rest.trim();
        let end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
        let (name, compared) = rest.split_at(end);
        let compared = compared.trim();
        if name.is_empty() {
            let message = format!("`#{directive}` names nothing");
            return Err(self.problem(at.clone(), message, "name a define, as in `#ifdef NAME`"));
        }
        self.mentions.insert(name.to_owned());
        if directive != "if" {
            if !compared.is_empty() {
                let message = format!("`#{directive}` asks for one name alone");
                let hint = format!("to compare values, write `#if {name} == 1`");
                return Err(self.problem(at.clone(), message, hint));
            }
            let defined = self.defines.as_ref().is_some_and(|d| d.contains_key(name));
            return Ok(defined == (directive == "ifdef"));
        }
        let signs = compared
            .find(|c: char| !"=!<>".contains(c))
            .unwrap_or(compared.len());
        let (sign, value) = compared.split_at(signs);
        let value = value.trim();
        if !["==", "!=", "<", "<=", ">", ">="].contains(&sign) || value.is_empty() {
            return Err(self.problem(
                at.clone(),
                format!("`#if {name}` compares nothing"),
                format!("write `#if {name} == 1`, or `#ifdef {name}` to ask whether it is there"),
            ));
        }
        let Some(defines) = self.defines.as_ref().filter(|_| asked) else {
            return Ok(false);
        };
        let Some(defined) = defines.get(name).copied() else {
            let hint = self.how_to_define(name);
            let message = format!("`{name}` is not defined, so it has no value to compare");
            return Err(self.problem(at.clone(), message, hint));
        };
        match (defined, value.parse::<i32>(), value) {
            (Some(defined), Ok(value), _) => Ok(compare(defined, sign, value)),
            (None, _, "true" | "false") => Ok(compare(1, sign, i32::from(value == "true"))),
            (Some(_), ..) => Err(self.problem(
                at.clone(),
                format!("`{value}` is not a whole number to compare `{name}` with"),
                format!("write `#if {name} == 1`"),
            )),
            (None, ..) => Err(self.problem(
                at.clone(),
                format!("`{name}` is defined without a value"),
                format!("write `#ifdef {name}`, or give it one: .define(\"{name}\", 1)"),
            )),
        }
    }

    /// The way out where a define is missing.
    fn how_to_define(&self, name: &str) -> String {
        let known = self.defines.iter().flat_map(|defines| defines.keys());
        let known = known.map(String::as_str);
        match suggestion(name, known.clone()) {
            Some(_) => {
                let near = known
                    .clone()
                    .find(|known| suggestion(name, [*known]).is_some())
                    .unwrap_or_default();
                format!("the pass defines `{near}`: did you mean `{name}`?")
            }
            None => format!("add .define(\"{name}\", 1) to the pass, after .shader"),
        }
    }

    /// A line of WGSL: `#{NAME}` in it stands for the value of a define.
    fn text_line(&mut self, number: u32, line: &str, active: &mut String) -> Result<(), Problem> {
        let taken = self.taken();
        let mut rest = line.chars().zip(1..).peekable();
        while let Some((c, column)) = rest.next() {
            if c != '#' {
                active.push(if taken { c } else { ' ' });
                continue;
            }
            active.push(' ');
            let mut name = String::new();
            let braces = rest.next_if(|(c, _)| *c == '{').is_some();
            while let Some((c, _)) = rest.next_if(|(c, _)| is_word(*c)) {
                name.push(c);
            }
            let closed = !braces || rest.next_if(|(c, _)| *c == '}').is_some();
            let skipped = name.chars().count() + 2 * usize::from(braces);
            active.extend(std::iter::repeat_n(' ', skipped));
            let at = self.place(number, column);
            if name.is_empty() || !closed {
                return Err(self.problem(
                    at,
                    "`#` stands for nothing here".to_owned(),
                    "the value of a define is written `#{NAME}`",
                ));
            }
            self.mentions.insert(name.clone());
            let missing = self
                .defines
                .as_ref()
                .is_some_and(|d| !d.contains_key(&name));
            if taken && missing {
                let hint = self.how_to_define(&name);
                return Err(self.problem(at, format!("`{name}` is not defined"), hint));
            }
        }
        Ok(())
    }
}

fn compare(a: i32, sign: &str, b: i32) -> bool {
    match sign {
        "==" => a == b,
        "!=" => a != b,
        "<" => a < b,
        "<=" => a <= b,
        ">" => a > b,
        _ => a >= b,
    }
}

/// The directive of a line, what follows it, and its column.
fn directive(line: &str) -> Option<(&str, &str, u32)> {
    let begin = line.len() - line.trim_start().len();
    let rest = line[begin..].strip_prefix('#')?;
    // `#{NAME}` at the beginning of a line is a value.
    let rest = rest.trim_start();
    let end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
    let column = line[..begin].chars().count() as u32 + 1;
    (end > 0).then(|| (&rest[..end], &rest[end..], column))
}

fn blank(line: &str, active: &mut String) {
    active.extend(line.chars().map(|_| ' '));
}

fn open_braces(text: &str) -> bool {
    text.matches('{').count() > text.matches('}').count()
}

#[cfg(test)]
mod tests;
