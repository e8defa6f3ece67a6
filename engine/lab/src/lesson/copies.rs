//! Whether a submitted file is a shipped one in disguise.
//!
//! Files are compared by what is left when comments, layout, numbers, texts and the names that a file
//! gives itself are taken away: runs of so many tokens (shingles, Broder 1997, "On the resemblance and
//! containment of documents"). What the starter had already does not count.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::OnceLock;

use lightbench_assets::files::Files;

use super::tokens::{Kind, Token, tokens};

/// Tokens of one run.
const RUN: usize = 10;
/// Files with fewer runs of their own say too little.
const FEWEST: usize = 40;
/// The share of a file's own runs that must be in one shipped file.
const COPIED: f64 = 0.6;

type Runs = HashSet<u64>;

/// A shipped file that another was copied from.
#[derive(Clone, Debug, PartialEq)]
pub struct CopiedFrom {
    /// The shipped file.
    pub path: String,
    /// The share of the other file that it holds.
    pub share: f64,
}

/// The shipped file that a submission was copied from, if it was.
#[must_use]
pub fn copied_from(path: &str, code: &str, starter: &str) -> Option<CopiedFrom> {
    let starter = runs(path, starter);
    let mut own = runs(path, code);
    own.retain(|run| !starter.contains(run));
    if own.len() < FEWEST {
        return None;
    }
    let shares = shipped().iter().map(|(shipped, runs)| {
        let common = own.intersection(runs).count();
        (shipped, common as f64 / own.len() as f64)
    });
    let (path, share) = shares.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    (share >= COPIED).then(|| CopiedFrom {
        path: path.clone(),
        share,
    })
}

/// Whether two files say the same, whatever their comments and layout.
#[must_use]
pub fn says_the_same(path: &str, a: &str, b: &str) -> bool {
    let texts = !path.ends_with(".wgsl");
    let [a, b] = [a, b].map(|code| tokens(code, texts));
    a.iter()
        .map(|token| (token.kind == Kind::Text, token.text))
        .eq(b.iter().map(|token| (token.kind == Kind::Text, token.text)))
}

/// The shipped scripts and shaders with their runs.
fn shipped() -> &'static [(String, Runs)] {
    static SHIPPED: OnceLock<Vec<(String, Runs)>> = OnceLock::new();
    SHIPPED.get_or_init(|| {
        let files = Files::shipped();
        let folders = [("scripts", "rhai"), ("shaders", "wgsl")];
        // What is compiled into the program can be read.
        let listed = folders
            .iter()
            .flat_map(|(folder, ending)| files.list(folder, ending).unwrap_or_default());
        let read = listed.filter_map(|file| {
            let code = files.read_text(&file.path).ok()?;
            let runs = runs(&file.path, &code);
            Some((file.path, runs))
        });
        read.collect()
    })
}

fn runs(path: &str, code: &str) -> Runs {
    let tokens = tokens(code, !path.ends_with(".wgsl"));
    let own = own_names(&tokens);
    let words: Vec<&str> = tokens.iter().map(|token| plain(token, &own)).collect();
    let hash = |run: &[&str]| {
        let mut hasher = DefaultHasher::new();
        run.hash(&mut hasher);
        hasher.finish()
    };
    words.windows(RUN).map(hash).collect()
}

/// The names that a file gives: what it declares, and the parameters of its functions.
fn own_names<'a>(tokens: &[Token<'a>]) -> HashSet<&'a str> {
    let declares = [
        "let", "var", "const", "fn", "struct", "alias", "override", "for", "as",
    ];
    let mut own = HashSet::new();
    for (at, token) in tokens
        .iter()
        .enumerate()
        .filter(|(_, token)| token.kind == Kind::Name)
    {
        let after = at > 0 && declares.contains(&tokens[at - 1].text);
        // `name: type` declares a parameter or a field; in scripts, the key of a map.
        let typed = tokens.get(at + 1).is_some_and(|next| next.is(":"));
        if after || typed {
            own.insert(token.text);
        }
    }
    own
}

fn plain<'a>(token: &Token<'a>, own: &HashSet<&str>) -> &'a str {
    match token.kind {
        Kind::Number => "0",
        Kind::Text => "\"",
        Kind::Name if own.contains(token.text) => "_",
        Kind::Name | Kind::Sign => token.text,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn read(path: &str) -> String {
        Files::shipped().read_text(path).unwrap()
    }

    #[test]
    fn disguises_are_seen_through() {
        for path in [
            "scripts/pipelines/deferred_shading.rhai",
            "shaders/lib/brdf.wgsl",
        ] {
            let code = read(path);
            let disguised: String = code
                .lines()
                .map(|line| line.split("//").next().unwrap_or_default().trim())
                .map(|line| {
                    line.replace("g_normal", "mine")
                        .replace("power", "shininess")
                })
                .collect::<Vec<_>>()
                .join("\n\n");
            let found = copied_from(path, &disguised, "").unwrap();
            assert_eq!(found.path, path);
            // What is left of it differs in names that it does not give itself.
            assert!(found.share > 0.8, "{found:?}");
        }
    }

    #[test]
    fn what_the_starter_had_is_no_copy() {
        let path = "shaders/lib/brdf.wgsl";
        let code = read(path);
        assert_eq!(copied_from(path, &code, &code), None);
    }

    #[test]
    fn comments_and_layout_say_nothing() {
        assert!(says_the_same(
            "a.wgsl",
            "fn a() {}",
            "fn a ( )\n{ /* x */ } // y"
        ));
        assert!(!says_the_same("a.wgsl", "fn a() {}", "fn b() {}"));
        assert!(!says_the_same("a.rhai", "x(\"a\")", "x(a)"));
    }
}
