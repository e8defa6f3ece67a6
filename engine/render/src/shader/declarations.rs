//! Where the names of a composed shader are declared, in which file.
//!
//! The composer renames what modules declare and rewrites their text, so that a position in the
//! composed shader is none in a file. The names lead back: each says which module it comes from, and
//! there its declaration is looked up.

use naga_oil::compose::Composer;

use super::listing::Listing;
use super::tokens::{Token, tokens};
use crate::problem::Place;

/// The files of a composed shader: its own, and those of the modules that it imports.
#[derive(Clone, Debug)]
pub struct Listings {
    shader: Listing,
    modules: Vec<Module>,
}

/// A module that a shader imports.
#[derive(Clone, Debug)]
struct Module {
    name: String,
    /// What the composer adds to the names of the module.
    decoration: String,
    listing: Listing,
}

impl Listings {
    /// The file of a shader and those of modules, by the modules' names.
    pub fn new(shader: Listing, modules: Vec<(String, Listing)>) -> Self {
        let module = |(name, listing): (String, Listing)| Module {
            decoration: Composer::decorated_name(Some(&name), ""),
            name,
            listing,
        };
        Self {
            shader,
            modules: modules.into_iter().map(module).collect(),
        }
    }

    /// The shader's own file.
    pub fn shader(&self) -> &Listing {
        &self.shader
    }

    /// All files.
    pub fn all(&self) -> impl Iterator<Item = &Listing> {
        let modules = self.modules.iter().map(|module| &module.listing);
        std::iter::once(&self.shader).chain(modules)
    }

    /// The modules, by name.
    pub fn modules(&self) -> impl Iterator<Item = (&str, &Listing)> {
        let modules = self.modules.iter();
        modules.map(|module| (module.name.as_str(), &module.listing))
    }

    /// The file of a module.
    pub fn of_module(&self, name: &str) -> Option<&Listing> {
        self.modules()
            .find(|(module, _)| *module == name)
            .map(|(_, listing)| listing)
    }

    /// The file of that path.
    pub fn of_path(&self, path: &str) -> Option<&Listing> {
        self.all().find(|listing| listing.path == path)
    }

    /// The file in which a name of the composed shader is declared, and the name as it is written
    /// there.
    pub fn of_name<'a>(&'a self, name: &'a str) -> (&'a Listing, &'a str) {
        let module = |module: &'a Module| {
            Some((
                &module.listing,
                name.strip_suffix(module.decoration.as_str())?,
            ))
        };
        let modules = self.modules.iter();
        modules
            .filter_map(module)
            .next()
            .unwrap_or((&self.shader, name))
    }

    /// Where a variable of the whole module is declared: its name after `var`.
    pub fn variable(&self, name: &str) -> Place {
        let (listing, name) = self.of_name(name);
        find(listing, |scan| scan.declared(&["var"], name))
    }

    /// Where an override constant is declared.
    pub fn override_constant(&self, name: &str) -> Place {
        let (listing, name) = self.of_name(name);
        find(listing, |scan| scan.declared(&["override"], name))
    }

    /// Where a structure is declared.
    pub fn structure(&self, name: &str) -> Place {
        let (listing, name) = self.of_name(name);
        find(listing, |scan| scan.declared(&["struct"], name))
    }

    /// Where a member of a structure is declared.
    pub fn member(&self, structure: &str, member: &str) -> Place {
        let (listing, structure) = self.of_name(structure);
        find(listing, |scan| {
            let begin = scan.declared(&["struct"], structure)?;
            scan.labelled(begin, ("{", "}"), member)
        })
    }

    /// Where a function or entry point is declared. Entry points are in the shader's own file.
    pub fn function(&self, name: &str) -> Place {
        let (listing, name) = self.of_name(name);
        find(listing, |scan| scan.declared(&["fn"], name))
    }

    /// Where an argument of an entry point is declared.
    pub fn argument(&self, function: &str, argument: &str) -> Place {
        find(&self.shader, |scan| {
            let begin = scan.declared(&["fn"], function)?;
            scan.labelled(begin, ("(", ")"), argument)
        })
    }

    /// Where an entry point says what it returns: the `@location(…)` or type after `->`.
    pub fn result(&self, function: &str) -> Place {
        find(&self.shader, |scan| {
            let begin = scan.declared(&["fn"], function)?;
            let rest = &scan.tokens[begin..];
            let arrow = rest
                .windows(2)
                .position(|w| w[0].text == "-" && w[1].text == ">")?;
            let body = rest.iter().position(|token| token.text == "{")?;
            (arrow < body).then_some(begin + arrow + 2)
        })
    }

    /// Where an entry point says how large its workgroups are.
    pub fn workgroup_size(&self, function: &str) -> Place {
        find(&self.shader, |scan| {
            let end = scan.declared(&["fn"], function)?;
            scan.tokens[..end]
                .iter()
                .rposition(|token| token.text == "workgroup_size")
        })
    }

    /// The bodies of the functions that an entry point calls, itself first, each with its file.
    /// Functions of one name in two files count as one.
    pub fn reached(&self, entry: &str) -> Vec<(&Listing, Vec<Token<'_>>)> {
        let mut waiting: Vec<(&Listing, &str, Vec<Token>)> = Vec::new();
        for listing in self.all() {
            let scan = Scan {
                tokens: tokens(&listing.active),
            };
            waiting.extend(
                scan.bodies()
                    .map(|(name, body)| (listing, name, body.to_vec())),
            );
        }
        let mut reached: Vec<(&Listing, Vec<Token>)> = Vec::new();
        let mut names = vec![entry];
        let mut next = 0;
        while let Some(name) = names.get(next).copied() {
            next += 1;
            for (listing, _, body) in waiting.extract_if(.., |(_, found, _)| *found == name) {
                names.extend(body.iter().map(|token| token.text));
                reached.push((listing, body));
            }
        }
        reached
    }

    /// The names that are declared anywhere in a file, for suggestions.
    pub fn names(listing: &Listing) -> Vec<String> {
        let tokens = tokens(&listing.active);
        let pairs = tokens.windows(2);
        let declared = pairs.filter_map(|pair| {
            let introduces = ["let", "var", "const", "fn", "struct", "alias", "override"];
            match (pair[0].text, pair[1].text) {
                (word, _) if introduces.contains(&word) => Some(pair[1].text),
                // A variable's `<storage, read>` lies between; an argument or member has a colon.
                (_, ":") => Some(pair[0].text),
                _ => None,
            }
        });
        declared
            .filter(|name| *name != ":")
            .map(str::to_owned)
            .collect()
    }

    /// The names of a file that others may use: those that are declared outside of all functions.
    pub fn public_names(listing: &Listing) -> Vec<String> {
        let scan = Scan {
            tokens: tokens(&listing.active),
        };
        let introduces = ["var", "const", "fn", "struct", "alias", "override"];
        let mut names = Vec::new();
        let mut depth = 0_i32;
        for (at, token) in scan.tokens.iter().enumerate() {
            match token.text {
                "{" => depth += 1,
                "}" => depth -= 1,
                word if depth == 0 && introduces.contains(&word) => {
                    let name = scan.tokens.get(scan.after_template(at + 1));
                    names.extend(name.map(|name| name.text.to_owned()));
                }
                _ => {}
            }
        }
        names
    }
}

/// The place of a token that `search` finds, or the file alone.
fn find(listing: &Listing, search: impl FnOnce(&Scan) -> Option<usize>) -> Place {
    let scan = Scan {
        tokens: tokens(&listing.active),
    };
    match search(&scan).and_then(|at| scan.tokens.get(at)) {
        Some(token) => Place::new(listing.path.as_str(), token.line, token.column),
        None => Place::file(listing.path.as_str()),
    }
}

struct Scan<'a> {
    tokens: Vec<Token<'a>>,
}

impl<'a> Scan<'a> {
    /// The functions: name, and all from there to the end of the body.
    fn bodies(&self) -> impl Iterator<Item = (&'a str, &[Token<'a>])> {
        let begins = (1..self.tokens.len()).filter(|at| self.tokens[at - 1].text == "fn");
        begins.map(|begin| {
            let mut depth = 0;
            let rest = &self.tokens[begin..];
            let end = rest.iter().position(|token| {
                depth += i32::from(token.text == "{") - i32::from(token.text == "}");
                depth == 0 && token.text == "}"
            });
            (rest[0].text, &rest[..end.unwrap_or(rest.len())])
        })
    }

    /// The name after one of these keywords, outside of all braces.
    fn declared(&self, keywords: &[&str], name: &str) -> Option<usize> {
        let mut depth = 0_i32;
        for (at, token) in self.tokens.iter().enumerate() {
            match token.text {
                "{" => depth += 1,
                "}" => depth -= 1,
                word if depth == 0 && keywords.contains(&word) => {
                    let named = self.after_template(at + 1);
                    if self.tokens.get(named).is_some_and(|t| t.text == name) {
                        return Some(named);
                    }
                }
                _ => {}
            }
        }
        None
    }

    /// The token after `<storage, read>`, or that token itself.
    fn after_template(&self, at: usize) -> usize {
        if self.tokens.get(at).is_none_or(|token| token.text != "<") {
            return at;
        }
        let end = self.tokens[at..].iter().position(|token| token.text == ">");
        end.map_or(at, |end| at + end + 1)
    }

    /// The name before a colon, directly between the brackets that follow `begin`.
    fn labelled(&self, begin: usize, (open, close): (&str, &str), name: &str) -> Option<usize> {
        let first = self.tokens[begin..].iter().position(|t| t.text == open)? + begin;
        let mut depth = 0;
        for at in first..self.tokens.len() {
            let text = self.tokens[at].text;
            depth += i32::from(text == open) - i32::from(text == close);
            if depth == 0 {
                return None;
            }
            let colon = self.tokens.get(at + 1).is_some_and(|t| t.text == ":");
            if depth == 1 && colon && text == name {
                return Some(at);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::listing::Defines;
    use super::*;

    const SHADER: &str = "struct In {\n  @location(0) @interpolate(flat) light: u32,\n\
        \x20 @builtin(position) at: vec4f,\n}\n#ifdef A\n@group(1) @binding(0) var depth: f32;\n#else\n\
        @group(1) @binding(0) var depth: u32; // depth\n#endif\nvar<workgroup> sums: array<u32, 4>;\n\
        fn helper(light: u32) { var depth = 1; }\n@compute @workgroup_size(8)\n\
        fn compute_main(@builtin(local_invocation_index) thread: u32) {}\n\
        @fragment\nfn fragment_main(in: In, @location(3) uv: vec2f) -> @location(0) vec4f { }\n";

    #[test]
    fn only_what_an_entry_point_calls_is_reached() {
        let listing = |path: &str, text: &str| Listing {
            path: path.into(),
            ..Listing::new("", text, &Defines::new(), false).unwrap()
        };
        let shader = "fn a() { if b { c::d(); } }\nfn unused() {}\nfn main() { a(); main(); }";
        let module = "fn d() { e(); }\nfn e() {}\nfn f() { unused(); }";
        let modules = vec![("c".to_owned(), listing("c.wgsl", module))];
        let listings = Listings::new(listing("a.wgsl", shader), modules);
        let found = listings.reached("main");
        let found: Vec<_> = found
            .iter()
            .map(|(listing, body)| (listing.path.as_str(), body[0].text))
            .collect();
        let expected = [
            ("a.wgsl", "main"),
            ("a.wgsl", "a"),
            ("c.wgsl", "d"),
            ("c.wgsl", "e"),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn declarations_are_found_where_they_are_written() {
        let listing = |text: &str| Listing::new("a.wgsl", text, &Defines::new(), false).unwrap();
        let module = Listing {
            path: "lib.wgsl".into(),
            ..listing("\nvar<private> depth: f32;\nstruct In {\n  wide: array<In>,\n}")
        };
        let listings = Listings::new(listing(SHADER), vec![("x::lib".into(), module)]);
        let of_lib = |name: &str| Composer::decorated_name(Some("x::lib"), name);
        for (found, expected) in [
            (listings.variable("depth"), "a.wgsl:8:27"),
            (listings.variable("sums"), "a.wgsl:10:16"),
            (listings.variable(&of_lib("depth")), "lib.wgsl:2:14"),
            (listings.structure("In"), "a.wgsl:1:8"),
            (listings.member("In", "light"), "a.wgsl:2:35"),
            (listings.member("In", "at"), "a.wgsl:3:22"),
            (listings.member(&of_lib("In"), "wide"), "lib.wgsl:4:3"),
            (listings.function("compute_main"), "a.wgsl:13:4"),
            (listings.argument("compute_main", "thread"), "a.wgsl:13:50"),
            (listings.argument("fragment_main", "uv"), "a.wgsl:15:39"),
            (listings.argument("helper", "light"), "a.wgsl:11:11"),
            (listings.result("fragment_main"), "a.wgsl:15:53"),
            (listings.result("compute_main"), "a.wgsl"),
            (listings.workgroup_size("compute_main"), "a.wgsl:12:11"),
            (listings.variable("nothing"), "a.wgsl"),
        ] {
            assert_eq!(found.to_string(), expected);
        }
    }
}
