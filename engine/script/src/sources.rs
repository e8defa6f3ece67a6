//! The scripts that a run has read, for messages and for the list of what it depends on.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rhai::{Engine, Token};

/// A function that a script defines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Function {
    pub(crate) name: String,
    /// The names of its arguments.
    pub(crate) arguments: Vec<String>,
    pub(crate) line: u32,
    pub(crate) column: u32,
}

/// One script file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Source {
    pub(crate) text: Arc<str>,
    /// Functions that it defines.
    pub(crate) functions: Vec<Function>,
    /// Every name that it gives to a variable or constant, anywhere.
    pub(crate) variables: Vec<String>,
    /// The constants outside of functions and blocks.
    pub(crate) constants: Vec<String>,
}

impl Source {
    /// Reads the names from the text's tokens. Works on texts with mistakes too.
    pub(crate) fn new(engine: &Engine, text: &str) -> Self {
        let mut source = Self {
            text: text.into(),
            ..Self::default()
        };
        let mut depth = 0_i32;
        let mut before = Token::EOF;
        // Whether the arguments of a function are being read.
        let mut in_arguments = false;
        // The depths of braces at which texts wait for the rest of them: `a ${ … } b`.
        let mut interrupted_texts = Vec::new();
        let texts = [text];
        let (tokens, control) = engine.lex(&texts);
        for (token, position) in tokens {
            if let Token::Identifier(name) = &token {
                match before {
                    Token::Fn => source.functions.push(Function {
                        name: name.to_string(),
                        arguments: Vec::new(),
                        line: position.line().unwrap_or(0) as u32,
                        column: position.position().unwrap_or(0) as u32,
                    }),
                    Token::Let | Token::For => source.variables.push(name.to_string()),
                    Token::Const => {
                        source.variables.push(name.to_string());
                        if depth == 0 {
                            source.constants.push(name.to_string());
                        }
                    }
                    _ if in_arguments => {
                        if let Some(function) = source.functions.last_mut() {
                            function.arguments.push(name.to_string());
                        }
                        source.variables.push(name.to_string());
                    }
                    _ => {}
                }
                in_arguments |= matches!(before, Token::Fn);
            }
            match token {
                Token::LeftBrace | Token::MapStart => depth += 1,
                Token::RightBrace => {
                    depth -= 1;
                    // As the parser does: what follows the brace is text again.
                    if interrupted_texts.last() == Some(&depth) {
                        interrupted_texts.pop();
                        control.borrow_mut().is_within_text = true;
                    }
                }
                Token::InterpolatedString(_) => interrupted_texts.push(depth),
                // `()` without anything in it is one token.
                Token::RightParen | Token::Unit => in_arguments = false,
                Token::EOF => break,
                _ => {}
            }
            before = token;
        }
        source
    }
}

/// All files of a run, by path.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sources(Arc<Mutex<BTreeMap<String, Source>>>);

impl Sources {
    pub(crate) fn add(&self, path: &str, source: Source) {
        self.lock().insert(path.to_owned(), source);
    }

    pub(crate) fn get(&self, path: &str) -> Option<Source> {
        self.lock().get(path).cloned()
    }

    pub(crate) fn text(&self, path: &str) -> Option<Arc<str>> {
        self.lock().get(path).map(|source| Arc::clone(&source.text))
    }

    /// The functions of all files.
    pub(crate) fn functions(&self) -> Vec<String> {
        let files = self.lock();
        files
            .values()
            .flat_map(|source| &source.functions)
            .map(|function| function.name.clone())
            .collect()
    }

    /// How the functions of a name are called, whichever files they are in: `add(p, hdr)`.
    pub(crate) fn forms(&self, name: &str) -> Vec<String> {
        let files = self.lock();
        let functions = files.values().flat_map(|source| &source.functions);
        functions
            .filter(|function| function.name == name)
            .map(|function| format!("{name}({})", function.arguments.join(", ")))
            .collect()
    }

    /// The paths of all files.
    pub(crate) fn paths(&self) -> Vec<String> {
        self.lock().keys().cloned().collect()
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Source>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_after_an_interpolated_text_are_found() {
        let text = "let a = `one ${1 + 2} two ${ if true { `x ${a} y` } else { 3 } } let b`;\n\
                    const C = 1;\nfn update(time, dt) { print(`${time}`); }\nfn last() {}\n";
        let source = Source::new(&Engine::new(), text);
        let functions: Vec<_> = source
            .functions
            .iter()
            .map(|f| (f.name.as_str(), f.arguments.len(), f.line))
            .collect();
        assert_eq!(functions, [("update", 2, 3), ("last", 0, 4)]);
        assert_eq!(source.constants, ["C"]);
        assert!(
            !source.variables.contains(&"b".to_owned()),
            "text is no code"
        );
    }
}
