//! What submitted files import, against what a lesson allows.

use super::tokens::{Kind, Token, tokens};

/// Something that a file imports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Import {
    /// The line that names it, from 1.
    pub line: u32,
    /// A module of shaders as `lightbench::scene`, or a script or a shader by its path. Empty where a
    /// script computes it.
    pub what: String,
}

/// What a file imports: the directives and paths of a shader; the imports of a script, and the files
/// that it names.
#[must_use]
pub fn imports(path: &str, code: &str) -> Vec<Import> {
    match path.ends_with(".wgsl") {
        true => of_shader(code),
        false => of_script(code),
    }
}

/// The first import that is not allowed.
#[must_use]
pub fn forbidden(path: &str, code: &str, allowed: &[String]) -> Option<Import> {
    imports(path, code)
        .into_iter()
        .find(|import| !is_allowed(&import.what, allowed))
}

fn is_allowed(what: &str, allowed: &[String]) -> bool {
    allowed.iter().any(|allowed| {
        let inside = || {
            what.strip_prefix(allowed.as_str())
                .is_some_and(|rest| rest.starts_with("::"))
        };
        what == allowed || inside()
    })
}

fn of_shader(code: &str) -> Vec<Import> {
    let tokens = tokens(code, false);
    let mut found = Vec::new();
    let mut aliases: Vec<String> = Vec::new();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let directive = |name: &str| {
            token.is("#")
                && tokens
                    .get(at + 1)
                    .is_some_and(|next| next.is(name) && next.line == token.line)
        };
        if directive("import") {
            at += 2;
            at += tree(&tokens[at..], token.line, &mut found, &mut aliases);
        } else if directive("define_import_path") {
            // Names the file itself.
            let line = token.line;
            while tokens.get(at).is_some_and(|token| token.line == line) {
                at += 1;
            }
        } else if token.kind == Kind::Name && tokens.get(at + 1).is_some_and(|next| next.is("::")) {
            // A path in the code means a module, unless it begins with what was imported.
            let length = path_length(&tokens[at..]);
            if !aliases.iter().any(|alias| alias == token.text) {
                found.push(Import {
                    line: token.line,
                    what: joined(&tokens[at..at + length]),
                });
            }
            at += length;
        } else {
            at += 1;
        }
    }
    found
}

/// Reads what follows `#import`, with its braces, and gives how many tokens that takes.
fn tree(tokens: &[Token], line: u32, found: &mut Vec<Import>, aliases: &mut Vec<String>) -> usize {
    let mut prefixes: Vec<String> = Vec::new();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        if prefixes.is_empty() && (token.line != line || token.is(";")) {
            break;
        }
        if token.is("as") {
            aliases.pop();
            aliases.extend(tokens.get(at + 1).map(|alias| alias.text.to_owned()));
            at += 2;
        } else if token.is("}") {
            prefixes.pop();
            at += 1;
        } else if token.kind == Kind::Name {
            let length = path_length(&tokens[at..]);
            let prefix = prefixes.last().map_or("", String::as_str);
            let path = format!("{prefix}{}", joined(&tokens[at..at + length]));
            at += length;
            if tokens.get(at).is_some_and(|next| next.is("{")) {
                prefixes.push(path);
                at += 1;
            } else {
                let path = path.trim_end_matches("::").to_owned();
                aliases.extend(path.rsplit("::").next().map(str::to_owned));
                found.push(Import {
                    line: token.line,
                    what: path,
                });
            }
        } else {
            at += 1;
        }
    }
    at
}

/// How many tokens a path takes: names with `::` between, and maybe one behind.
fn path_length(tokens: &[Token]) -> usize {
    let mut at = 0;
    while tokens.get(at).is_some_and(|token| token.kind == Kind::Name) {
        at += 1;
        match tokens.get(at) {
            Some(token) if token.is("::") => at += 1,
            _ => break,
        }
    }
    at
}

fn joined(tokens: &[Token]) -> String {
    tokens.iter().map(|token| token.text).collect()
}

fn of_script(code: &str) -> Vec<Import> {
    let tokens = tokens(code, true);
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let next = tokens.get(at + 1);
        if token.is("import") {
            // What comes behind tells whether the text is all of it.
            let whole = tokens
                .get(at + 2)
                .is_none_or(|after| after.is("as") || after.is(";"));
            let what = next.filter(|next| next.kind == Kind::Text && whole);
            let what = what.map_or("", |what| what.text.trim_end_matches(".rhai"));
            found.push(Import {
                line: token.line,
                what: what.to_owned(),
            });
        } else if token.kind == Kind::Text {
            let is_file = [".wgsl", ".rhai"]
                .iter()
                .any(|ending| token.text.ends_with(ending));
            let imported = at > 0 && tokens[at - 1].is("import");
            if is_file && !imported {
                found.push(Import {
                    line: token.line,
                    what: token.text.to_owned(),
                });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, code: &str) -> Vec<(u32, String)> {
        imports(path, code)
            .into_iter()
            .map(|import| (import.line, import.what))
            .collect()
    }

    #[test]
    fn all_ways_to_import_are_seen() {
        let shader = "\
#define_import_path my::module
#import lightbench::scene // lightbench::no
#import lightbench::{brdf, surface::{Surface, safe_normalize}}
#import lightbench::lighting as light
fn f() { let a = scene::frame; let b = light::x(); return lightbench::color::y(); }
";
        let expected = [
            (2, "lightbench::scene"),
            (3, "lightbench::brdf"),
            (3, "lightbench::surface::Surface"),
            (3, "lightbench::surface::safe_normalize"),
            (4, "lightbench::lighting"),
            (5, "lightbench::color::y"),
        ];
        let expected: Vec<_> = expected
            .iter()
            .map(|(line, what)| (*line, (*what).to_owned()))
            .collect();
        assert_eq!(found("a.wgsl", shader), expected);

        let script = "import \"parts/output\" as output;\nimport \"a\" + \"b\" as c;\n// import \"no\" as no;\np.shader(\"shaders/x.wgsl\");";
        let expected = [(1, "parts/output"), (2, ""), (4, "shaders/x.wgsl")];
        let expected: Vec<_> = expected
            .iter()
            .map(|(line, what)| (*line, (*what).to_owned()))
            .collect();
        assert_eq!(found("a.rhai", script), expected);
    }

    #[test]
    fn modules_allow_what_is_in_them() {
        let allowed = ["lightbench::scene".to_owned(), "parts/output".to_owned()];
        let fine = "#import lightbench::scene::{frame, lights}";
        assert_eq!(forbidden("a.wgsl", fine, &allowed), None);
        let wrong = forbidden("a.wgsl", "#import lightbench::scenery", &allowed);
        assert_eq!(
            wrong.map(|import| import.what),
            Some("lightbench::scenery".to_owned())
        );
        assert!(forbidden("a.rhai", "import \"parts/output\" as o;", &allowed).is_none());
        assert!(forbidden("a.rhai", "import `parts/${x}` as o;", &allowed).is_some());
    }
}
