//! From the text of a script to something that runs, with its names known to the messages.

use std::sync::Arc;

use lightbench_assets::Digest;
use lightbench_assets::cache::{Kept, Reuse};
use lightbench_render::Problem;
use rhai::{AST, Engine, EvalAltResult, Position, Scope};

use crate::api::Mistake;
use crate::errors::Explainer;
use crate::limits::Limits;
use crate::names::Names;
use crate::sources::{Source, Sources};

/// Compiles scripts and explains their errors.
#[derive(Debug)]
pub(crate) struct Compiler {
    pub(crate) names: Names,
    pub(crate) sources: Sources,
    pub(crate) limits: Limits,
    /// Variables that every script has, as `state`.
    pub(crate) globals: Vec<&'static str>,
    /// What earlier runs have compiled.
    pub(crate) reuse: Reuse,
}

/// A file as it is after compiling.
#[derive(Clone)]
struct Compiled {
    ast: Arc<AST>,
    source: Source,
}

impl Kept for Compiled {
    fn bytes(&self) -> usize {
        // A node of the tree takes some dozen times the letters that it is written in.
        32 * self.source.text.len()
    }
}

impl Compiler {
    /// Compiles the text of a file, unless an earlier run has.
    pub(crate) fn compile(
        &self,
        engine: &Engine,
        path: &str,
        text: &str,
    ) -> Result<Arc<AST>, Box<EvalAltResult>> {
        let made_of = (
            path,
            Digest::of(text.as_bytes()),
            &self.globals,
            &self.limits,
        );
        let compiled = self
            .reuse
            .try_get("script", &made_of, || self.compile_anew(engine, path, text))?;
        self.sources.add(path, compiled.source);
        Ok(compiled.ast)
    }

    /// Compiles a text that sees the variables of a scope, and keeps nothing of it for later.
    pub(crate) fn compile_line(
        &self,
        engine: &Engine,
        path: &str,
        text: &str,
        scope: &Scope,
    ) -> Result<Arc<AST>, Box<EvalAltResult>> {
        let compiled = self.compile_with(engine, path, text, scope.clone())?;
        Ok(compiled.ast)
    }

    fn compile_anew(
        &self,
        engine: &Engine,
        path: &str,
        text: &str,
    ) -> Result<Compiled, Box<EvalAltResult>> {
        self.compile_with(engine, path, text, Scope::new())
    }

    fn compile_with(
        &self,
        engine: &Engine,
        path: &str,
        text: &str,
        mut known: Scope,
    ) -> Result<Compiled, Box<EvalAltResult>> {
        if text.len() > self.limits.file_bytes {
            return Err(Mistake::new(format!(
                "the file has {} KiB; a script may have {} KiB",
                text.len() >> 10,
                self.limits.file_bytes >> 10
            ))
            .into());
        }
        if let Some(line) = text.lines().position(|line| line.contains('\0')) {
            return Err(EvalAltResult::ErrorRuntime(
                rhai::Dynamic::from(Mistake::new("the file holds a zero byte: is it a text?")),
                Position::new(u16::try_from(line + 1).unwrap_or(u16::MAX), 0),
            )
            .into());
        }
        let source = Source::new(engine, text);
        // Strict mode refuses unknown names when a file is read, not when a line happens to run.
        // It has to be told of the names that are resolved later: the host's, and constants of the
        // file, which its functions see.
        for name in &self.globals {
            known.push(*name, ());
        }
        for name in &source.constants {
            known.push(name.as_str(), ());
        }
        self.sources.add(path, source.clone());
        let mut ast = engine
            .compile_with_scope(&known, text)
            .map_err(|error| EvalAltResult::ErrorParsing(*error.0, error.1))?;
        ast.set_source(path);
        Ok(Compiled {
            ast: Arc::new(ast),
            source,
        })
    }

    /// Explains an error of a file.
    pub(crate) fn explain(&self, error: &EvalAltResult, path: &str) -> Problem {
        self.explainer().explain(error, path)
    }

    pub(crate) fn explainer(&self) -> Explainer<'_> {
        Explainer {
            names: &self.names,
            sources: &self.sources,
            limits: &self.limits,
            globals: &self.globals,
        }
    }

    pub(crate) fn shared(self) -> Arc<Self> {
        Arc::new(self)
    }
}
