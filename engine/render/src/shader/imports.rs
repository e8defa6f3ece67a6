//! What a WGSL file imports, and whether every name with `::` in it means something.

use crate::problem::{Place, Problem, suggestion};

use super::listing::Listing;
use super::tokens::tokens;

/// One module, or one item of a module, that a file imports.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The whole path, as in `lightbench::scene` or `lightbench::scene::frame`.
    pub path: String,
    /// What the file calls it: the last word, unless it says `as`.
    pub alias: String,
    /// Where it is written.
    pub at: Place,
    /// Whether the import lies in a branch that is taken.
    pub taken: bool,
}

/// Reads `#import a::b`, `#import a::b as c` and `#import a::{b, c::d as e}`.
///
/// # Errors
/// The first thing that can't be read.
pub fn parse_import(
    path: &str,
    first_line: u32,
    text: &str,
    taken: bool,
) -> Result<Vec<Import>, Problem> {
    let mut tokens = paths(text, first_line).into_iter().peekable();
    // `#` and `import`.
    let begin = tokens.next().map(|token| token.place(path));
    tokens.next();
    let wrong = |at: Option<Place>, message: String| {
        let at = at
            .or_else(|| begin.clone())
            .unwrap_or_else(|| Place::file(path));
        Problem::new(at, message).with_hint(
            "an import is written `#import lightbench::scene`, or `#import \
             lightbench::scene::{frame, lights}` for some names of a module",
        )
    };
    let mut found = Vec::new();
    let mut prefixes: Vec<String> = Vec::new();
    let mut last: Option<PathToken> = None;
    let mut ended = false;
    while let Some(token) = tokens.next() {
        let at = token.place(path);
        if ended {
            return Err(wrong(
                Some(at),
                "nothing may follow the `;` of an import".to_owned(),
            ));
        }
        match token.text.as_str() {
            "{" => match last.take() {
                Some(name) if name.text.ends_with("::") => {
                    prefixes.push(format!("{}{}", prefix(&prefixes), name.text));
                }
                _ => return Err(wrong(Some(at), "`{` comes after `::`".to_owned())),
            },
            "," | "}" | ";" => {
                found.extend(last.take().map(|name| import(name, &prefixes, path, taken)));
                if token.text == "}" && prefixes.pop().is_none() {
                    return Err(wrong(Some(at), "this `}` closes nothing".to_owned()));
                }
                ended = token.text == ";";
            }
            "as" if last.is_some() => {
                let Some(alias) = tokens.next().filter(PathToken::is_name) else {
                    return Err(wrong(Some(at), "a name comes after `as`".to_owned()));
                };
                let mut named = last.take().map(|name| import(name, &prefixes, path, taken));
                if let Some(named) = &mut named {
                    named.alias = alias.text;
                }
                found.extend(named);
            }
            _ if token.is_name() && last.is_none() => last = Some(token),
            _ if token.line > first_line && !prefixes.is_empty() => {
                return Err(wrong(None, "a `}` is missing in this import".to_owned()));
            }
            other => {
                return Err(wrong(
                    Some(at),
                    format!("`{other}` has no meaning in an import"),
                ));
            }
        }
    }
    found.extend(last.map(|name| import(name, &prefixes, path, taken)));
    if !prefixes.is_empty() {
        return Err(wrong(None, "a `}` is missing in this import".to_owned()));
    }
    if found.is_empty() {
        return Err(wrong(None, "this imports nothing".to_owned()));
    }
    Ok(found)
}

fn import(name: PathToken, prefixes: &[String], file: &str, taken: bool) -> Import {
    let at = name.place(file);
    let path = format!("{}{}", prefix(prefixes), name.text);
    let alias = path.rsplit("::").next().unwrap_or_default().to_owned();
    Import {
        path,
        alias,
        at,
        taken,
    }
}

/// The innermost prefix, which holds those around it.
fn prefix(prefixes: &[String]) -> &str {
    prefixes.last().map_or("", String::as_str)
}

/// A word, or several joined by `::`, or a sign.
struct PathToken {
    text: String,
    line: u32,
    column: u32,
    /// Whether a dot or `@` stands before it.
    member: bool,
}

impl PathToken {
    fn is_name(&self) -> bool {
        self.text.starts_with(super::tokens::is_word) && self.text != "as"
    }

    fn place(&self, file: &str) -> Place {
        Place::new(file, self.line, self.column)
    }
}

/// The tokens of a text, with `a :: b` as one.
fn paths(text: &str, first_line: u32) -> Vec<PathToken> {
    let tokens = tokens(text);
    let mut found: Vec<PathToken> = Vec::new();
    let mut at = 0;
    let colons = |at: usize| {
        let sign = |at: usize| tokens.get(at).is_some_and(|token| token.text == ":");
        sign(at) && sign(at + 1)
    };
    let mut before = "";
    while let Some(token) = tokens.get(at) {
        let mut text = token.text.to_owned();
        at += 1;
        if token.is_word() {
            while colons(at) {
                text.push_str("::");
                at += 2;
                match tokens.get(at).filter(|next| next.is_word()) {
                    Some(next) => {
                        text.push_str(next.text);
                        at += 1;
                    }
                    None => break,
                }
            }
        }
        found.push(PathToken {
            text,
            line: token.line + first_line - 1,
            column: token.column,
            member: matches!(before, "." | "@"),
        });
        before = tokens[at - 1].text;
    }
    found
}

/// Every module that a file imports, and every name with `::` in it, is known.
///
/// # Errors
/// The first that is not.
pub fn check_names(listing: &Listing, modules: &[&str]) -> Result<(), Problem> {
    for import in &listing.imports {
        if module_of(&import.path, modules).is_none() {
            return Err(
                unknown_module(&import.path, import.at.clone(), modules).with_source(&listing.text)
            );
        }
    }
    let taken = || listing.imports.iter().filter(|import| import.taken);
    for token in paths(&listing.active, 1) {
        let Some((first, rest)) = token.text.split_once("::") else {
            continue;
        };
        if token.member || !token.is_name() {
            continue;
        }
        let known = taken().any(|import| {
            import.alias == first && item_of(&format!("{}::{rest}", import.path), modules)
        });
        if known || item_of(&token.text, modules) {
            continue;
        }
        let at = token.place(&listing.path);
        return Err(not_imported(first, at, listing, modules).with_source(&listing.text));
    }
    Ok(())
}

/// The module that a path names, or of which it names an item.
pub fn module_of<'a>(path: &str, modules: &[&'a str]) -> Option<&'a str> {
    let fits = |module: &&&str| {
        path.strip_prefix(**module)
            .is_some_and(|item| item.is_empty() || item.starts_with("::"))
    };
    modules.iter().filter(fits).max_by_key(|m| m.len()).copied()
}

/// Whether the path without its last word is a module.
fn item_of(path: &str, modules: &[&str]) -> bool {
    path.rsplit_once("::")
        .is_some_and(|(module, item)| !item.is_empty() && modules.contains(&module))
}

fn not_imported(first: &str, at: Place, listing: &Listing, modules: &[&str]) -> Problem {
    let last = |module: &&&str| module.rsplit("::").next() == Some(first);
    if let Some(module) = modules.iter().find(last) {
        return Problem::new(at, format!("`{first}` is not imported"))
            .with_hint(format!("write `#import {module}` at the top of the file"));
    }
    let aliases = listing.imports.iter().map(|import| import.alias.as_str());
    let shipped = modules
        .iter()
        .filter_map(|module| module.rsplit("::").next());
    let hint = suggestion(first, aliases.chain(shipped))
        .unwrap_or_else(|| format!("the modules are: {}", modules.join(", ")));
    Problem::new(at, format!("there is no module `{first}`")).with_hint(hint)
}

/// Says that there is no such module.
pub fn unknown_module(path: &str, at: Place, modules: &[&str]) -> Problem {
    // Of `lightbench::surfce::Surface` the module is what is wrong.
    let item = path.rsplit_once("::").map(|(module, _)| module);
    let hint = suggestion(path, modules.iter().copied())
        .or_else(|| suggestion(item?, modules.iter().copied()))
        .unwrap_or_else(|| format!("the modules are: {}", modules.join(", ")));
    Problem::new(at, format!("there is no module `{path}`")).with_hint(hint)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::listing::Defines;
    use super::*;

    fn imports(text: &str) -> Result<Vec<(String, String, u32, u32)>, Problem> {
        let found = parse_import("a.wgsl", 5, text, true)?;
        let parts = |import: Import| (import.path, import.alias, import.at.line, import.at.column);
        Ok(found.into_iter().map(parts).collect())
    }

    #[test]
    fn all_forms_of_imports_are_read() {
        let one = |path: &str, alias: &str, line, column| {
            (path.to_owned(), alias.to_owned(), line, column)
        };
        assert_eq!(imports("#import a::b;").unwrap(), [one("a::b", "b", 5, 9)]);
        assert_eq!(
            imports("# import a::b as c").unwrap(),
            [one("a::b", "c", 5, 10)]
        );
        assert_eq!(
            imports("#import a::{b, c::{d as e, f},\n g}").unwrap(),
            [
                one("a::b", "b", 5, 13),
                one("a::c::d", "e", 5, 20),
                one("a::c::f", "f", 5, 28),
                one("a::g", "g", 6, 2),
            ]
        );
        assert_eq!(
            imports("#import a::b, c").unwrap(),
            [one("a::b", "b", 5, 9), one("c", "c", 5, 15)]
        );
    }

    #[test]
    fn imports_that_make_no_sense_are_refused() {
        for (text, column, message) in [
            ("#import ", 1, "this imports nothing"),
            ("#import a::{b", 1, "a `}` is missing in this import"),
            ("#import a{b}", 10, "`{` comes after `::`"),
            ("#import a::b}", 13, "this `}` closes nothing"),
            (
                "#import a; b",
                12,
                "nothing may follow the `;` of an import",
            ),
            ("#import a as", 11, "a name comes after `as`"),
            ("#import \"a\"", 9, "`\"` has no meaning in an import"),
            ("#import a b", 11, "`b` has no meaning in an import"),
        ] {
            let problem = imports(text).unwrap_err();
            assert_eq!(
                (problem.place.column, problem.message.as_str()),
                (column, message)
            );
        }
    }

    #[test]
    fn names_of_unknown_modules_are_found() {
        let modules = ["lightbench::scene", "lightbench::lighting"];
        let check = |text: &str| {
            let listing = Listing::new("a.wgsl", text, &Defines::new(), false)?;
            check_names(&listing, &modules)
        };
        for good in [
            "#import lightbench::scene\nlet a = scene::frame.far;",
            "#import lightbench::scene as s\nlet a = s::frame;",
            "#import lightbench::scene::{frame}\nlet a = frame.far;",
            "let a = lightbench::scene::frame;",
        ] {
            assert_eq!(check(good), Ok(()), "{good}");
        }
        for (text, place, message, hint) in [
            (
                "#import lightbench::scenes",
                (1, 9),
                "there is no module `lightbench::scenes`",
                "did you mean `lightbench::scene`?",
            ),
            (
                "\nlet a = lighting::shade();",
                (2, 9),
                "`lighting` is not imported",
                "write `#import lightbench::lighting` at the top of the file",
            ),
            (
                "#import lightbench::scene\nlet a = scnee::frame;",
                (2, 9),
                "there is no module `scnee`",
                "did you mean `scene`?",
            ),
        ] {
            let problem = check(text).unwrap_err();
            assert_eq!((problem.place.line, problem.place.column), place);
            assert_eq!(problem.message, message);
            assert_eq!(problem.hint.as_deref(), Some(hint));
        }
    }
}
