//! How deep a text goes. The reader of WGSL takes a step of its stack for each operator of an expression, for
//! each `else if`, and for each declaration that another one needs, so that some thousands of them end the
//! program, which nothing can catch. Such a text is refused before it is read.

use crate::problem::{Place, Problem};

use super::tokens::{Token, tokens};

/// Operators that may stand in one expression, with those of the expressions around it. What people write
/// has some dozens; a thread with 2 MiB of stack takes a few thousand.
const MOST: usize = 500;

/// Functions, constants, structures and so on that a file may declare: each may need the one after it.
const MOST_DECLARED: usize = 1000;

/// The words that declare something.
const DECLARE: [&str; 6] = ["fn", "const", "override", "var", "struct", "alias"];

/// Looks for what goes too deep, in a text without comments and directives.
///
/// # Errors
/// The place where it does.
pub fn check_depth(path: &str, active: &str) -> Result<(), Problem> {
    let mut depth = Depth {
        levels: vec![0],
        sum: 0,
    };
    let tokens = tokens(active);
    let mut declared = 0;
    for (index, token) in tokens.iter().enumerate() {
        depth.take(token, tokens.get(index + 1));
        if depth.levels.len() == 1 && DECLARE.contains(&token.text) {
            declared += 1;
        }
        let (message, hint) = if depth.sum > MOST {
            (
                format!("an expression has more than {MOST} operators"),
                "give its parts names with `let`, or write what repeats as a loop or a function",
            )
        } else if declared > MOST_DECLARED {
            (
                format!("a file has more than {MOST_DECLARED} declarations"),
                "put some of them into a module of their own",
            )
        } else {
            continue;
        };
        let place = Place::new(path, token.line, token.column);
        return Err(Problem::new(place, message).with_hint(hint));
    }
    Ok(())
}

/// Operators of the expressions that are open: one number for each bracket, and their sum.
struct Depth {
    levels: Vec<usize>,
    sum: usize,
}

impl Depth {
    fn take(&mut self, token: &Token<'_>, next: Option<&Token<'_>>) {
        match token.text {
            "(" | "[" | "{" => {
                self.more();
                self.levels.push(0);
            }
            ")" | "]" | "}" => {
                self.end();
                // What closes nothing is a mistake that the reader tells.
                if self.levels.len() > 1 {
                    self.levels.pop();
                }
                let goes_on = next.is_some_and(|next| next.text == "else");
                if token.text == "}" && !goes_on {
                    self.end();
                }
            }
            "," | ";" => self.end(),
            "+" | "-" | "*" | "/" | "%" | "&" | "|" | "^" | "!" | "~" | "<" | ">" | "=" | "."
            | "else" => self.more(),
            _ => {}
        }
    }

    fn more(&mut self) {
        self.sum += 1;
        if let Some(level) = self.levels.last_mut() {
            *level += 1;
        }
    }

    /// The present expression ends.
    fn end(&mut self) {
        if let Some(level) = self.levels.last_mut() {
            self.sum -= *level;
            *level = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use lightbench_assets::files::Files;
    use naga::valid::Capabilities;

    use super::super::ShaderComposer;
    use super::*;

    #[test]
    fn operators_of_one_expression_count_together_and_of_several_do_not() {
        let sum = |count: usize| {
            format!(
                "fn f(x: f32) -> f32 {{\n  return x{};\n}}",
                "+x".repeat(count)
            )
        };
        check_depth("a.wgsl", &sum(MOST - 20)).unwrap();
        let problem = check_depth("a.wgsl", &sum(MOST + 1)).unwrap_err();
        assert_eq!(problem.place.line, 2);
        assert!(problem.to_string().contains("more than 500 operators"));
        // The elements of an array, statements and functions are expressions of their own.
        let numbers = format!("const A = array({});", "-1.0, ".repeat(4 * MOST));
        let lines = format!("fn f() {{ {} }}", "x = x + f(1.0) * y[2]; ".repeat(MOST));
        let branches = format!("fn f() {{ {} }}", "if x < 1.0 { y = 1.0; } ".repeat(MOST));
        let functions = "fn f() { x = 1.0; } ".repeat(MOST_DECLARED);
        let problem = check_depth("a.wgsl", &format!("{functions}\nfn g() {{}}")).unwrap_err();
        assert!(
            problem
                .to_string()
                .contains("a.wgsl:2:1: a file has more than 1000")
        );
        for fine in [numbers, lines, branches, functions] {
            check_depth("a.wgsl", &fine).unwrap();
        }
    }

    /// The deepest that is let through, on half of the stack that a thread has.
    #[test]
    fn the_deepest_expressions_are_read_without_a_fault() {
        let deep = MOST - 40;
        let chain = |links: usize| {
            let links = "else if x < 1.0 { y = 2.0; } ".repeat(links);
            format!("if x < 0.0 {{ y = 1.0; }} {links}")
        };
        let bodies = [
            format!("y = x{};", "+x".repeat(deep)),
            format!("y = x{};", "*x".repeat(deep)),
            format!("let b = x < 1.0{};", " && x < 1.0".repeat(deep / 4)),
            format!("y = {}x;", "- ".repeat(deep)),
            format!("let b = {}(x < 1.0);", "!".repeat(deep)),
            format!("let v = vec4f(x){};", ".xyzw".repeat(deep)),
            format!("y = {}x{};", "sin(".repeat(100), ")".repeat(100)),
            format!("y = {}x{};", "(".repeat(100), ")".repeat(100)),
            format!("const C = 1.0{}; y = C;", "+1.0".repeat(deep / 2)),
            chain(deep / 4),
        ];
        let chain = |name: &str| {
            let one = |n: usize| format!("fn {name}{n}_() {{ {name}{}_(); }}\n", n + 1);
            let all: String = (0..MOST_DECLARED - 3).map(one).collect();
            format!("{all}fn {name}{}_() {{}}", MOST_DECLARED - 3)
        };
        let mut texts: Vec<String> = bodies.map(|body| {
            format!(
                "@compute @workgroup_size(1) fn main() {{ var x = 1.0; var y = 0.0; {body} x = y; }}"
            )
        }).into();
        texts.push(format!(
            "@compute @workgroup_size(1) fn main() {{ f0_(); }}\n{}",
            chain("f")
        ));
        for text in texts {
            let folder = tempfile::tempdir().unwrap();
            std::fs::create_dir_all(folder.path().join("shaders")).unwrap();
            std::fs::write(folder.path().join("shaders/deep.wgsl"), &text).unwrap();
            let files = Files::with_project(folder.path()).unwrap();
            let work = move || {
                let mut composer = ShaderComposer::new(&files, Capabilities::empty()).unwrap();
                let made = composer.compose(&files, "shaders/deep.wgsl", &[]);
                made.map(|_| ()).map_err(|problem| problem.to_string())
            };
            let thread = std::thread::Builder::new().stack_size(1 << 20);
            let result = thread.spawn(work).unwrap().join().unwrap();
            let begin: String = text.chars().take(120).collect();
            assert_eq!(result, Ok(()), "{begin}");
        }
    }

    #[test]
    fn what_is_nested_counts_with_what_is_around_it() {
        let links = "if x < 1 {} ".to_owned() + &"else if x < 1 {} ".repeat(MOST / 2);
        for deep in [
            format!("const A = {}1.0;", "-".repeat(MOST + 1)),
            format!(
                "const A = {}1{};",
                "(".repeat(MOST + 1),
                ")".repeat(MOST + 1)
            ),
            format!("const A = a{};", ".xy".repeat(MOST + 1)),
            format!("const A = a{};", "[0]".repeat(MOST + 1)),
            format!("const A = {}", "f(1, ".repeat(MOST + 1)),
            format!("const A = a{};", "+f(1, 2)".repeat(MOST)),
            format!("fn f() {{ {links} }}"),
            "{".repeat(MOST + 1),
        ] {
            check_depth("a.wgsl", &deep).unwrap_err();
        }
        // Brackets that close nothing are the reader's matter.
        check_depth("a.wgsl", ")))}}]]").unwrap();
    }
}
