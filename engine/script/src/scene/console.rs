//! Lines of a console: scene script, run against a scene that is there.

use std::sync::Arc;

use lightbench_render::Problem;
use rhai::{AST, Dynamic, ImmutableString, Scope};

use super::Scene;
use crate::api::kind;
use crate::host::Host;
use crate::spelling::spell;

/// What stands for the file of a line in messages.
pub const CONSOLE: &str = "console";

impl Scene {
    /// Runs a line as if the scene's script went on with it, within the limits of an update, and gives
    /// its value as text; `None` where it has none. Variables that it declares are there for the next
    /// line.
    ///
    /// # Errors
    /// What is wrong with the line. Then nothing has changed: the scene is as it was before.
    pub fn evaluate(&mut self, line: &str) -> Result<Option<String>, Problem> {
        let ast = self.host.compile_line(line, &self.console)?;
        let before = self.snapshot();
        let mut scope = std::mem::take(&mut self.console);
        self.swap();
        self.host.watch.start(self.host.compiler.limits.update_time);
        let result = self
            .host
            .engine
            .eval_ast_with_scope::<Dynamic>(&mut scope, &ast);
        self.swap();
        self.console = scope;
        match result {
            Ok(value) => {
                self.refresh();
                Ok(self.shown(&value))
            }
            Err(error) => {
                self.restore(&before);
                self.refresh();
                Err(self.host.compiler.explain(&error, CONSOLE))
            }
        }
    }

    /// The names of the variables that lines have declared, and of those that every script has.
    #[must_use]
    pub fn console_variables(&self) -> Vec<String> {
        let own = self.console.iter().map(|(name, _, _)| name.to_owned());
        let globals = self.host.compiler.globals.iter();
        // `me` belongs to behaviours.
        let globals = globals.filter(|name| **name != "me");
        let mut all: Vec<String> = own.chain(globals.map(|name| (*name).to_owned())).collect();
        all.sort();
        all.dedup();
        all
    }

    /// The type of a variable, as scripts name it.
    pub(crate) fn console_type(&self, name: &str) -> Option<&'static str> {
        let value = self.console.get(name)?;
        let named = self.host.engine.map_type_name(value.type_name()).to_owned();
        self.names().types().find(|known| *known == named)
    }

    fn shown(&self, value: &Dynamic) -> Option<String> {
        if value.is_unit() {
            return None;
        }
        Some(spell(value).unwrap_or_else(|| {
            let engine = &self.host.engine;
            let mut scope = Scope::new();
            scope.push_dynamic("value", value.clone());
            let text = engine
                .eval_expression_with_scope::<ImmutableString>(&mut scope, "value.to_string()");
            text.map_or_else(
                |_| kind(engine.map_type_name(value.type_name())),
                |text| text.to_string(),
            )
        }))
    }
}

impl Host {
    /// Compiles a line that sees the variables of a scope.
    fn compile_line(&self, line: &str, scope: &Scope) -> Result<Arc<AST>, Problem> {
        self.begin(CONSOLE);
        let compiled = self
            .compiler
            .compile_line(&self.engine, CONSOLE, line, scope);
        compiled.map_err(|error| self.compiler.explain(&error, CONSOLE))
    }
}
