//! Turns what Rhai says into sentences that a student can act on.
//!
//! No message shows a type of the program. Each names the file (of an imported part too), the line
//! and the column, and where there is one the way out: the nearest name, or the accepted forms.

use lightbench_render::problem::suggestion;
use lightbench_render::{Place, Problem};
use rhai::{EvalAltResult, Position};

use crate::api::{Mistake, kind, place};
use crate::limits::{Limits, Stop, sentence};
use crate::names::{Names, list};
use crate::sources::Sources;
use crate::syntax;

/// What is needed to explain an error.
pub(crate) struct Explainer<'a> {
    pub(crate) names: &'a Names,
    pub(crate) sources: &'a Sources,
    pub(crate) limits: &'a Limits,
    /// Names that are variables everywhere, as `state`.
    pub(crate) globals: &'a [&'static str],
}

impl Explainer<'_> {
    /// Explains an error of a run of `file`.
    pub(crate) fn explain(&self, error: &EvalAltResult, file: &str) -> Problem {
        match error {
            // An error that was explained already, where the imported file was known.
            EvalAltResult::ErrorRuntime(value, _) if value.is::<Problem>() => {
                value.clone().cast::<Problem>()
            }
            EvalAltResult::ErrorInFunctionCall(_, source, inner, _) => {
                let file = if source.is_empty() { file } else { source };
                self.explain(inner, file)
            }
            EvalAltResult::ErrorInModule(_, inner, _) => self.explain(inner, file),
            EvalAltResult::ErrorParsing(cause, position) => {
                let at = place(Some(file), *position);
                self.with_source(syntax::explain(self, cause, at))
            }
            _ => {
                let at = place(Some(file), position(error));
                let mistake = self.runtime(error, file);
                self.problem(at, mistake)
            }
        }
    }

    /// A problem with its line.
    pub(crate) fn problem(&self, at: Place, mistake: Mistake) -> Problem {
        let mut problem = Problem::new(at, mistake.message);
        problem.hint = mistake.hint;
        self.with_source(problem)
    }

    pub(crate) fn with_source(&self, problem: Problem) -> Problem {
        match self.sources.text(&problem.place.file) {
            Some(text) => problem.with_source(&text),
            None => problem,
        }
    }

    fn runtime(&self, error: &EvalAltResult, file: &str) -> Mistake {
        use EvalAltResult as E;
        match error {
            E::ErrorRuntime(value, _) => match value.clone().try_cast::<Mistake>() {
                Some(mistake) => mistake,
                None if value.is_unit() => Mistake::new("the script threw an error without a text"),
                None => Mistake::new(value.to_string()),
            },
            E::ErrorTerminated(value, _) => {
                let stop = value.clone().try_cast::<Stop>().unwrap_or(Stop::Cancelled);
                Mistake::new(sentence(stop, self.limits))
            }
            E::ErrorFunctionNotFound(signature, _) => self.no_function(signature),
            E::ErrorVariableNotFound(name, _) => self.no_variable(name, file),
            E::ErrorDotExpr(text, _) => self.no_property(text),
            E::ErrorPropertyNotFound(name, _) => {
                Mistake::new(format!("the map has no entry `{name}`"))
            }
            E::ErrorIndexingType(text, _) => no_index(text),
            E::ErrorIndexNotFound(index, _) => {
                Mistake::new(format!("there is nothing at `[{index}]`"))
            }
            E::ErrorModuleNotFound(name, _) => Mistake::new(format!("there is no module `{name}`"))
                .with_hint("a module is imported first: `import \"parts/output\" as output;`"),
            E::ErrorUnboundThis(_) => {
                Mistake::new("`this` is only known in a function that is called on an object")
            }
            E::ErrorMismatchDataType(wanted, found, _)
            | E::ErrorMismatchOutputType(wanted, found, _) => Mistake::new(format!(
                "this must be {}, but is {}",
                kind(wanted),
                kind(found)
            )),
            E::ErrorArrayBounds(0, index, _) => Mistake::new(format!(
                "`[{index}]` is outside of the array, which is empty"
            )),
            E::ErrorArrayBounds(count, index, _) => Mistake::new(format!(
                "`[{index}]` is outside of the array: it has {count} elements, `[0]` to `[{}]`",
                count - 1
            )),
            E::ErrorStringBounds(count, index, _) => Mistake::new(format!(
                "`[{index}]` is outside of the text, which has {count} characters"
            )),
            E::ErrorBitFieldBounds(count, index, _) => Mistake::new(format!(
                "bit {index} does not exist: a whole number has {count} bits"
            )),
            E::ErrorFor(_) => Mistake::new("`for` can't go through this value")
                .with_hint("it goes through an array or a range: `for i in 0..10 { … }`"),
            E::ErrorAssignmentToConstant(name, _) => constant(name),
            E::ErrorNonPureMethodCallOnConstant(name, _) => {
                constant(name.trim_start_matches("set$").trim_start_matches("get$"))
            }
            E::ErrorVariableExists(name, _) => {
                Mistake::new(format!("there is a variable `{name}` already"))
            }
            E::ErrorForbiddenVariable(name, _) => {
                Mistake::new(format!("`{name}` can't be the name of a variable"))
            }
            E::ErrorDataRace(name, _) => Mistake::new(format!(
                "`{name}` is read and changed in the same expression; use a second variable"
            )),
            E::ErrorArithmetic(text, _) => arithmetic(text),
            E::ErrorTooManyOperations(_) => Mistake::new(format!(
                "the script does more than {} steps: is there a loop that never ends?",
                self.limits.operations
            )),
            E::ErrorTooManyVariables(_) => Mistake::new(format!(
                "the script has more than {} variables at once",
                self.limits.variables
            )),
            E::ErrorTooManyModules(_) => Mistake::new(format!(
                "the script imports more than {} files",
                self.limits.modules
            )),
            E::ErrorStackOverflow(_) => Mistake::new(format!(
                "functions call each other more than {} deep: does one call itself without end?",
                self.limits.call_depth
            )),
            E::ErrorDataTooLarge(what, _) => self.too_large(what),
            E::LoopBreak(..) => Mistake::new("`break` and `continue` belong inside a loop"),
            other => Mistake::new(without_position(&other.to_string())),
        }
    }

    /// Rhai counts everything that a value holds, at any depth.
    pub(crate) fn too_large(&self, what: &str) -> Mistake {
        let what = what.to_lowercase();
        let (limit, unit) = if what.contains("string") {
            (self.limits.text_bytes, "bytes of text")
        } else if what.contains("map") {
            (self.limits.map_entries, "entries of maps")
        } else {
            (self.limits.array_elements, "elements of arrays")
        };
        Mistake::new(format!("one value holds more than {limit} {unit}"))
    }

    /// A name that is neither here nor in the file.
    pub(crate) fn no_variable(&self, name: &str, file: &str) -> Mistake {
        let source = self.sources.get(file).unwrap_or_default();
        if source.variables.iter().any(|known| known == name) {
            let mut hint = format!(
                "a function does not see the variables around it: hand `{name}` over as an \
                 argument, or make it a `const` above"
            );
            if self.globals.contains(&"state") {
                hint += &format!(", or keep it as `state.{name}`");
            }
            return Mistake::new(format!("`{name}` is not known here")).with_hint(hint);
        }
        let mistake = Mistake::new(format!("there is no variable `{name}`"));
        let known = source
            .variables
            .iter()
            .map(String::as_str)
            .chain(self.globals.iter().copied());
        let is_function = !self.names.forms(None, name).is_empty() || self.names.is_builtin(name);
        let declares = |method: &&str| source.text.contains(&format!(".{method}(\"{name}\""));
        if is_function {
            mistake.with_hint(format!(
                "`{name}` is a function: call it, as in `{name}(…)`"
            ))
        } else if let Some(method) = ["number", "switch", "choice"].into_iter().find(declares) {
            mistake.with_hint(format!(
                "`.{method}` gives the value of the parameter: keep it, as in \
                 `let {name} = p.{method}(\"{name}\", …);`"
            ))
        } else if let Some(hint) = suggestion(name, known).filter(|_| name.chars().count() > 1) {
            mistake.with_hint(hint)
        } else if let Some(hint) = self
            .names
            .near_function(name, &self.sources.functions())
            .filter(|_| name.chars().count() > 1)
        {
            mistake.with_hint(hint)
        } else {
            mistake.with_hint(format!(
                "a new variable begins with `let {name} = …;`, a text stands in quotes"
            ))
        }
    }

    /// Explains `name (type, type)`.
    fn no_function(&self, signature: &str) -> Mistake {
        let (name, types) = split_signature(signature);
        let kinds: Vec<String> = types.iter().map(|name| kind(name)).collect();
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            return operator(name, &kinds);
        }
        if let Some((module, name)) = name.rsplit_once("::") {
            let own = self.sources.functions();
            let mistake = Mistake::new(format!(
                "the module `{module}` has no function `{name}` with {}",
                arguments(kinds.len())
            ));
            let forms = self.sources.forms(name).into_iter();
            let forms: Vec<String> = forms.map(|form| format!("{module}::{form}")).collect();
            if !forms.is_empty() {
                return mistake.with_hint(written(&forms));
            }
            return match suggestion(name, own.iter().map(String::as_str)) {
                Some(hint) => mistake.with_hint(hint),
                None => mistake,
            };
        }
        if let Some(receiver) = types.first().filter(|name| self.names.is_type(name)) {
            return self.no_method(receiver, name, &kinds[1..]);
        }
        let forms = self.names.forms(None, name);
        if !forms.is_empty() {
            return Mistake::new(format!("`{name}` can't be called with {}", given(&kinds)))
                .with_hint(written(&forms));
        }
        let own = self.sources.functions();
        if own.iter().any(|function| function == name) {
            return Mistake::new(format!(
                "the function `{name}` of the script does not take {}",
                arguments(kinds.len())
            ));
        }
        if self.names.is_builtin(name) {
            return Mistake::new(format!("`{name}` can't be called with {}", given(&kinds)));
        }
        let mistake = Mistake::new(format!("there is no function `{name}`"));
        match self.names.near_function(name, &own) {
            Some(hint) => mistake.with_hint(hint),
            None if types.first() == Some(&"()") => mistake.with_hint(
                "the value in front of the dot is nothing: is a `;` or a `return` out of place?",
            ),
            None => mistake,
        }
    }

    fn no_method(&self, receiver: &str, name: &str, kinds: &[String]) -> Mistake {
        if self
            .names
            .members(receiver, true)
            .any(|known| known == name)
            && !self
                .names
                .members(receiver, false)
                .any(|known| known == name)
        {
            return Mistake::new(format!("`{name}` of {} is no method", kind(receiver)))
                .with_hint(format!("it is written without parentheses: `.{name}`"));
        }
        let forms = self.names.forms(Some(receiver), name);
        if !forms.is_empty() {
            return Mistake::new(format!("`.{name}` can't be called with {}", given(kinds)))
                .with_hint(written(&forms));
        }
        let forms = self.names.forms(None, name);
        if !forms.is_empty() {
            return Mistake::new(format!("{} has no method `{name}`", kind(receiver)))
                .with_hint(written(&forms));
        }
        let mistake = Mistake::new(format!("{} has no method `{name}`", kind(receiver)));
        if let Some(hint) = self.names.near_method(receiver, name) {
            mistake.with_hint(hint)
        } else {
            let methods = list(self.names.members(receiver, false), "and");
            if methods.is_empty() {
                mistake
            } else {
                mistake.with_hint(format!("it has {methods}"))
            }
        }
    }

    /// Explains "Unknown property 'x' - a getter is not registered for type 'entity'".
    fn no_property(&self, text: &str) -> Mistake {
        let mut quoted = text.split('\'').skip(1).step_by(2);
        let (Some(name), Some(receiver)) = (quoted.next(), quoted.next()) else {
            return Mistake::new("what stands after the dot does not fit what stands before it");
        };
        let writing = text.starts_with("No writable");
        let properties: Vec<&str> = self.names.members(receiver, true).collect();
        if writing && properties.contains(&name) {
            return Mistake::new(format!("`.{name}` of {} can't be set", kind(receiver)));
        }
        let mistake = Mistake::new(format!("{} has no property `{name}`", kind(receiver)));
        let forms = self.names.forms(Some(receiver), name);
        if !forms.is_empty() {
            mistake.with_hint(format!("it is a method, {}", written(&forms)))
        } else if let Some(hint) = self.names.near_property(receiver, name) {
            mistake.with_hint(hint)
        } else if let Some(hint) = self.names.near_method(receiver, name) {
            mistake.with_hint(hint)
        } else if properties.is_empty() {
            mistake
        } else {
            mistake.with_hint(format!("it has {}", list(properties, "and")))
        }
    }
}

/// The innermost position that an error knows.
fn position(error: &EvalAltResult) -> Position {
    match error {
        EvalAltResult::ErrorInFunctionCall(_, _, inner, at) => {
            let inner = position(inner);
            if inner.is_none() { *at } else { inner }
        }
        other => other.position(),
    }
}

fn split_signature(signature: &str) -> (&str, Vec<&str>) {
    let (name, rest) = signature.split_once(" (").unwrap_or((signature, ")"));
    let types = rest.trim_end_matches(')');
    // The empty type `()` loses its parenthesis above; it is the only one with one.
    let types = if rest.ends_with("())") {
        &rest[..rest.len() - 1]
    } else {
        types
    };
    let types = types.split(", ").filter(|name| !name.is_empty()).collect();
    (name.trim(), types)
}

fn operator(name: &str, kinds: &[String]) -> Mistake {
    let name = name.trim();
    match kinds {
        [only] => Mistake::new(format!("`{name}` can't be applied to {only}")),
        [left, right] => Mistake::new(format!("`{name}` can't combine {left} and {right}")),
        _ => Mistake::new(format!("`{name}` can't be used here")),
    }
}

fn no_index(text: &str) -> Mistake {
    let (object, index) = text.split_once(" [").unwrap_or((text, ""));
    let index = index.split(']').next().unwrap_or_default();
    if object.trim() == "array" {
        Mistake::new(format!(
            "an array is indexed by a whole number, not by {}",
            kind(index)
        ))
    } else {
        Mistake::new(format!(
            "{} can't be indexed by {}",
            kind(object),
            kind(index)
        ))
    }
}

fn constant(name: &str) -> Mistake {
    Mistake::new(format!("`{name}` is a constant and can't be changed")).with_hint(
        "declare it with `let` in place of `const`; what changes from frame to frame lives in `state`",
    )
}

fn arithmetic(text: &str) -> Mistake {
    let lower = text.to_lowercase();
    if lower.contains("division by zero") || lower.contains("modulo division") {
        Mistake::new("a whole number is divided by zero")
    } else if lower.contains("overflow") || lower.contains("too large") {
        Mistake::new("the result is too large for a whole number")
            .with_hint("write one of the numbers with a point, as in `2.0`")
    } else {
        Mistake::new(without_position(text))
    }
}

/// Rhai ends its sentences with "(line 3, position 4)"; a problem says that itself.
pub(crate) fn without_position(text: &str) -> String {
    match text.rfind(" (line ") {
        Some(end) => text[..end].to_owned(),
        None => text.to_owned(),
    }
}

pub(crate) fn arguments(count: usize) -> String {
    match count {
        0 => "no argument".to_owned(),
        1 => "one argument".to_owned(),
        count => format!("{count} arguments"),
    }
}

/// What a call was given, as in "2 arguments (a number, a text)".
fn given(kinds: &[String]) -> String {
    if kinds.is_empty() {
        arguments(0)
    } else {
        format!("{} ({})", arguments(kinds.len()), kinds.join(", "))
    }
}

fn written(forms: &[String]) -> String {
    format!(
        "it is written {}",
        list(forms.iter().map(String::as_str), "or")
    )
}
