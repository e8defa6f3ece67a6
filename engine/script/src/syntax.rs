//! Explains mistakes of writing: a missing bracket, a reserved word, an unknown name.

use lightbench_render::{Place, Problem};
use rhai::{LexError, ParseErrorType};

use crate::api::Mistake;
use crate::errors::Explainer;
use crate::names::list;

/// Explains an error of the parser.
pub(crate) fn explain(explainer: &Explainer, cause: &ParseErrorType, at: Place) -> Problem {
    use ParseErrorType as P;
    let file = at.file.to_string();
    let mistake = match cause {
        P::UnexpectedEOF => Mistake::new("the file ends in the middle of a sentence")
            .with_hint("a `}`, `)` or `]` is missing somewhere above"),
        P::BadInput(cause) => lexical(explainer, cause),
        P::UnknownOperator(symbol) => symbol_of_other_language(symbol),
        P::MissingToken(token, purpose) => {
            let purpose = purpose.replace(
                "to terminate this statement",
                "at the end of this statement",
            );
            let mut mistake = Mistake::new(format!("a `{token}` is missing {purpose}"));
            let line = at.line;
            let at = if matches!(token.as_str(), ";" | ")" | "]" | ",") {
                end_of_previous_line(explainer, at)
            } else {
                at
            };
            if token == ";" && at.line == line {
                mistake = mistake.with_hint("or a `.`, if what follows belongs to it");
            }
            return problem(at, mistake);
        }
        P::VariableUndefined(name) => explainer.no_variable(name, &file),
        P::ModuleUndefined(name) => Mistake::new(format!("there is no module `{name}`")).with_hint(
            format!("import it first, as in `import \"parts/{name}\" as {name};`"),
        ),
        P::Reserved(word) => Mistake::new(format!("`{word}` is a word of the language"))
            .with_hint("choose another name"),
        P::VariableExpected => Mistake::new("a name is missing here"),
        P::PropertyExpected => {
            Mistake::new("the name of a property or method is missing after the dot")
        }
        P::DuplicatedProperty(name) => Mistake::new(format!("the map has two entries `{name}`")),
        P::DuplicatedVariable(name) => Mistake::new(format!("there are two variables `{name}`")),
        P::ForbiddenVariable(name) => {
            Mistake::new(format!("`{name}` can't be the name of a variable"))
        }
        P::MismatchedType(wanted, found) => Mistake::new(format!(
            "this must be {}, but is {}",
            crate::api::kind(wanted),
            crate::api::kind(found)
        )),
        P::ExprExpected(what) => Mistake::new(format!("a value is missing here ({what})")),
        P::WrongDocComment => Mistake::new("a comment with `///` belongs in front of a function")
            .with_hint("write `//`"),
        P::WrongFnDefinition => {
            Mistake::new("a function can't be defined inside a block or another function")
                .with_hint("move it out; if it is outside, a `}` is missing above")
        }
        P::FnDuplicatedDefinition(name, count) => Mistake::new(format!(
            "there are two functions `{name}` with {count} arguments"
        )),
        P::FnMissingName => Mistake::new("the function's name is missing after `fn`"),
        P::FnMissingParams(name) => Mistake::new(format!("the arguments of `{name}` are missing"))
            .with_hint(format!("write `fn {name}() {{ … }}`")),
        P::FnDuplicatedParam(name, argument) => {
            Mistake::new(format!("`{name}` has two arguments `{argument}`"))
        }
        P::FnMissingBody(name) => Mistake::new(format!("the body of `{name}` is missing"))
            .with_hint("it stands in braces: `{ … }`"),
        P::WrongExport => Mistake::new("`export` belongs outside of functions and blocks"),
        P::AssignmentToConstant(name) => {
            Mistake::new(format!("`{name}` is a constant and can't be changed"))
                .with_hint("declare it with `let` in place of `const`")
        }
        P::AssignmentToInvalidLHS(_) => {
            Mistake::new("what stands left of the `=` can't be changed").with_hint(
                "two values are compared with `==`; what a function gives is named first: \
                 `let lamp = entity(\"lamp\"); lamp.intensity = 2;`",
            )
        }
        P::ExprTooDeep => Mistake::new(format!(
            "the nesting is deeper than {} levels",
            explainer.limits.nesting
        )),
        P::TooManyFunctions => Mistake::new(format!(
            "the file has more than {} functions",
            explainer.limits.functions
        )),
        P::LiteralTooLarge(what, _) => explainer.too_large(what),
        P::LoopBreak => Mistake::new("`break` and `continue` belong inside a loop"),
        other => Mistake::new(lower_first(&other.to_string())),
    };
    problem(at, mistake)
}

fn problem(at: Place, mistake: Mistake) -> Problem {
    let mut problem = Problem::new(at, mistake.message);
    problem.hint = mistake.hint;
    problem
}

fn lexical(explainer: &Explainer, cause: &LexError) -> Mistake {
    match cause {
        LexError::UnexpectedInput(text) if matches!(text.as_str(), "}" | ")" | "]" | ";" | ",") => {
            Mistake::new(format!("a value is missing in front of `{text}`"))
        }
        LexError::UnexpectedInput(text) => Mistake::new(format!("`{text}` has no meaning here")),
        LexError::UnterminatedString => Mistake::new("the text has no closing quote")
            .with_hint("a text stands in \"double quotes\" on one line"),
        LexError::StringTooLong(_) => explainer.too_large("string"),
        LexError::MalformedEscapeSequence(text) => {
            Mistake::new(format!("`{text}` is no character"))
                .with_hint("a backslash in a text is written twice; paths take forward slashes")
        }
        LexError::MalformedNumber(text) => Mistake::new(format!("`{text}` is no number")),
        LexError::MalformedChar(text) => Mistake::new(format!("`'{text}'` is not one character"))
            .with_hint("a text stands in \"double quotes\""),
        LexError::MalformedIdentifier(text) => Mistake::new(format!("`{text}` is no name")),
        LexError::ImproperSymbol(symbol, _) => symbol_of_other_language(symbol),
        other => Mistake::new(lower_first(&other.to_string())),
    }
}

fn symbol_of_other_language(symbol: &str) -> Mistake {
    let meant = match symbol {
        "===" => "==",
        "!==" => "!=",
        ":=" => "=",
        "<-" => "<=",
        ":;" | "::<" => "::",
        "# {" => "#{",
        "++" => "+= 1",
        "--" => "-= 1",
        "(*" | "*)" => "//",
        _ => {
            return Mistake::new(format!("`{symbol}` has no meaning here"));
        }
    };
    Mistake::new(format!("`{symbol}` has no meaning here"))
        .with_hint(format!("did you mean {}?", list([meant], "or")))
}

/// A missing `;` is noticed at the next word. Where that begins a line, the mistake is at the end of
/// the last line with something on it.
fn end_of_previous_line(explainer: &Explainer, at: Place) -> Place {
    let Some(text) = explainer.sources.text(&at.file) else {
        return at;
    };
    let lines: Vec<&str> = text.lines().collect();
    let line = (at.line as usize).min(lines.len() + 1);
    let before = |line: &str| {
        line.chars()
            .take(at.column.saturating_sub(1) as usize)
            .collect::<String>()
    };
    let begins_line = lines
        .get(line.wrapping_sub(1))
        .is_none_or(|line| before(line).trim().is_empty());
    if !begins_line {
        return at;
    }
    let previous = lines
        .iter()
        .take(line.saturating_sub(1))
        .enumerate()
        .rev()
        .map(|(index, line)| (index, code(line)))
        .find(|(_, code)| !code.is_empty());
    match previous {
        Some((index, code)) => {
            Place::new(at.file, index as u32 + 1, code.chars().count() as u32 + 1)
        }
        None => at,
    }
}

/// A line without its comment and the blanks before it.
fn code(line: &str) -> &str {
    line.split("//").next().unwrap_or_default().trim_end()
}

fn lower_first(text: &str) -> String {
    let text = crate::errors::without_position(text);
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_lowercase().chain(letters).collect(),
        None => text,
    }
}
