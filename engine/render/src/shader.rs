//! From shader files to checked modules: imports, defines, validation, reflection.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};

use lightbench_assets::files::Files;
use naga::valid::Capabilities;
use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, ComposerErrorInner, NagaModuleDescriptor,
    ShaderDefValue,
};

use crate::description::Define;
use crate::problem::{Place, Problem, suggestion};

/// A shader that parsed and validated, before any pipeline is built from it.
#[derive(Clone, Debug)]
pub struct Shader {
    /// Path of the file.
    pub path: String,
    /// The file's text, for error messages.
    pub text: String,
    /// The composed module.
    pub module: naga::Module,
    /// Paths of the modules that it imports, and of those that they import.
    pub modules: Vec<String>,
    /// A number for the text, the defines and all those modules: where anything of it differs, so
    /// does the number.
    pub fingerprint: u64,
}

/// The folder of modules that shaders import.
pub const MODULES: &str = "shaders/lib";

/// Composes shaders from files and remembers the modules that they import.
pub struct ShaderComposer {
    composer: Composer,
    /// Import path (`lightbench::scene`) to file path.
    module_files: HashMap<String, String>,
    /// File path to the module's text as it was written; the composer rewrites names in it.
    module_texts: BTreeMap<String, String>,
    /// Paths of the modules that the composer has taken in: those that some shader asked for.
    added: BTreeSet<String>,
}

impl ShaderComposer {
    /// Reads every module in `shaders/lib`, and checks none: a mistake in a module concerns those
    /// shaders alone that import it. `capabilities` say which optional parts of WGSL are allowed.
    ///
    /// # Errors
    /// A folder or file that can't be read.
    pub fn new(files: &Files, capabilities: Capabilities) -> Result<Self, Problem> {
        let mut composer = Composer::default().with_capabilities(capabilities);
        composer.validate = true;
        let mut this = Self {
            composer,
            module_files: HashMap::new(),
            module_texts: BTreeMap::new(),
            added: BTreeSet::new(),
        };
        let listed = files
            .list(MODULES, "wgsl")
            .map_err(|error| Problem::new(Place::file(MODULES), error.to_string()))?;
        for entry in listed {
            let text = read(files, &entry.path)?;
            if let Some(name) = import_path(&text) {
                this.module_files.insert(name, entry.path.clone());
            }
            this.module_texts.insert(entry.path, text);
        }
        Ok(this)
    }

    /// Takes in what a text imports, each module after those that it imports itself. `importing`
    /// are the modules whose imports are being followed, outermost first; `needed` gathers paths.
    fn add_imports(
        &mut self,
        text: &str,
        importing: &mut Vec<String>,
        needed: &mut BTreeSet<String>,
    ) -> Result<(), Problem> {
        for path in self.imported_files(text) {
            if let Some(first) = importing.iter().position(|other| *other == path) {
                let mut round: Vec<&str> = importing[first..].iter().map(String::as_str).collect();
                round.push(&path);
                return Err(Problem::new(
                    Place::file(path.as_str()),
                    format!(
                        "the imports go round in a circle: {}",
                        round.join(" imports ")
                    ),
                )
                .with_hint("move what both need into a third module"));
            }
            if !needed.insert(path.clone()) && self.added.contains(&path) {
                continue;
            }
            let text = self.module_texts.get(&path).cloned().unwrap_or_default();
            self.check_imports(&path, &text)?;
            importing.push(path.clone());
            self.add_imports(&text, importing, needed)?;
            importing.pop();
            if self.added.contains(&path) {
                continue;
            }
            let descriptor = ComposableModuleDescriptor {
                source: &text,
                file_path: &path,
                ..Default::default()
            };
            if let Err(error) = self.composer.add_composable_module(descriptor) {
                return Err(self.explain(&error, &path, &text));
            }
            self.added.insert(path);
        }
        Ok(())
    }

    /// The files of the modules that a text imports itself, in the order of its imports.
    fn imported_files(&self, text: &str) -> Vec<String> {
        let mut found = Vec::new();
        for name in imported_names(text).map(|(_, name)| name) {
            let file = self
                .module_of(name)
                .and_then(|name| self.module_files.get(name));
            if let Some(file) = file.filter(|file| !found.contains(*file)) {
                found.push(file.clone());
            }
        }
        found
    }

    /// The module of which an import names something, or all: `lightbench::scene::frame` imports
    /// an item of `lightbench::scene`.
    fn module_of(&self, name: &str) -> Option<&String> {
        self.module_files.keys().find(|module| {
            name.strip_prefix(module.as_str())
                .is_some_and(|item| item.is_empty() || item.starts_with("::"))
        })
    }

    /// Composes and validates the shader in `path` with `defines` set.
    ///
    /// # Errors
    /// The first mistake in the shader or a module that it imports, with its place.
    pub fn compose(
        &mut self,
        files: &Files,
        path: &str,
        defines: &[Define],
    ) -> Result<Shader, Problem> {
        let text = read(files, path)?;
        if text.trim().is_empty() {
            return Err(Problem::new(Place::file(path), "the shader is empty")
                .with_hint("an editor may be half-way through saving it; save it again"));
        }
        self.check_imports(path, &text)?;
        let mut needed = BTreeSet::new();
        self.add_imports(&text, &mut Vec::new(), &mut needed)?;
        let fingerprint = self.fingerprint(&text, defines, &needed);
        let shader_defs = defines
            .iter()
            .map(|define| {
                let value = define
                    .value
                    .map_or(ShaderDefValue::Bool(true), ShaderDefValue::Int);
                (define.name.clone(), value)
            })
            .collect();
        let descriptor = NagaModuleDescriptor {
            source: &text,
            file_path: path,
            shader_defs,
            ..Default::default()
        };
        match self.composer.make_naga_module(descriptor) {
            Ok(module) => Ok(Shader {
                path: path.to_owned(),
                text,
                module,
                modules: needed.into_iter().collect(),
                fingerprint,
            }),
            Err(error) => Err(self.explain(&error, path, &text)),
        }
    }

    fn fingerprint(&self, text: &str, defines: &[Define], modules: &BTreeSet<String>) -> u64 {
        let mut hasher = DefaultHasher::new();
        (text, defines).hash(&mut hasher);
        for path in modules {
            (path, self.module_texts.get(path)).hash(&mut hasher);
        }
        hasher.finish()
    }

    /// Whether a shader's text, or that of a module which it imports, directly or not, has a word.
    pub fn mentions(&self, shader: &Shader, word: &str) -> bool {
        let modules = shader.modules.iter();
        let mut texts = modules.filter_map(|path| self.module_texts.get(path));
        shader.text.contains(word) || texts.any(|text| text.contains(word))
    }

    /// The composer looks for a module only where something of it is used; a misspelt import of an
    /// unused one is a mistake all the same.
    fn check_imports(&self, path: &str, text: &str) -> Result<(), Problem> {
        for (number, name) in imported_names(text) {
            if self.module_of(name).is_none() {
                let line = text.lines().nth(number).unwrap_or("");
                let column = line.find(name).map_or(0, |at| line[..at].chars().count());
                let at = Place::new(path, number as u32 + 1, column as u32 + 1);
                return Err(self.unknown_module(name, at, text));
            }
        }
        Ok(())
    }

    fn unknown_module(&self, name: &str, at: Place, text: &str) -> Problem {
        let mut names: Vec<&str> = self.module_files.keys().map(String::as_str).collect();
        names.sort_unstable();
        let last = name.rsplit("::").next().unwrap_or(name);
        let nameless = self.module_texts.iter().find(|(path, text)| {
            import_path(text).is_none() && path.ends_with(&format!("/{last}.wgsl"))
        });
        let hint = match nameless {
            Some((path, _)) => {
                format!("{path} has no name: begin it with `#define_import_path {name}`")
            }
            None => suggestion(name, names.iter().copied())
                .unwrap_or_else(|| format!("the modules are: {}", names.join(", "))),
        };
        Problem::new(at, format!("there is no module `{name}`"))
            .with_source(text)
            .with_hint(hint)
    }

    /// Says where and what a composer's error is.
    fn explain(&self, error: &ComposerError, path: &str, text: &str) -> Problem {
        // naga_oil numbers bytes in the composed text: the top bits name the module.
        const POSITION_BITS: u32 = 21;
        let source = error.source.source(&self.composer);
        let file = error.source.path(&self.composer);
        let source: &str = if source.is_empty() { text } else { &source };
        let file = if file.is_empty() { path } else { file };
        let offset = error.source.offset();
        let local = |byte: usize| (byte & ((1 << POSITION_BITS) - 1)).saturating_sub(offset);
        // What the person wrote, which is what messages quote.
        let written = if file == path {
            text
        } else {
            self.module_texts.get(file).map_or(source, String::as_str)
        };
        let place = |byte: usize| written_place(file, source, written, byte);
        let start =
            |span: Option<std::ops::Range<usize>>| span.map_or(0, |range| local(range.start));

        match &error.inner {
            ComposerErrorInner::WgslParseError(parse) => {
                // What naga made itself, such as a conversion, has no place in the text.
                let label = parse.labels().find(|(span, _)| span.is_defined());
                let at = start(label.as_ref().and_then(|(span, _)| span.to_range()));
                let detail = label
                    .map(|(_, text)| text.to_owned())
                    .filter(|text| !text.is_empty());
                let message = self.composer_text(parse.message());
                let mut problem = Problem::new(place(at), message.clone()).with_source(written);
                problem.hint = detail
                    .map(|d| self.composer_text(&d))
                    .filter(|d| !message.contains(d.as_str()));
                problem
            }
            ComposerErrorInner::ShaderValidationError(invalid)
            | ComposerErrorInner::HeaderValidationError(invalid) => {
                // The causes go from "entry point is invalid" to the reason: the last is the point.
                let mut message = invalid.as_inner().to_string();
                let mut cause = std::error::Error::source(invalid.as_inner());
                while let Some(next) = cause {
                    message = format!("{message}: {next}");
                    cause = next.source();
                }
                let (span, note) = invalid
                    .spans()
                    .max_by_key(|(span, _)| span.to_range().map_or(0, |range| range.start))
                    .map_or((None, String::new()), |(span, note)| {
                        (span.to_range(), note.clone())
                    });
                let mut problem = Problem::new(place(start(span)), self.composer_text(&message))
                    .with_source(written);
                problem.hint = Some(self.composer_text(&note))
                    .filter(|note| !note.is_empty() && !note.starts_with("naga::"));
                problem
            }
            ComposerErrorInner::ImportNotFound(name, at) => {
                self.unknown_module(name, place(*at), written)
            }
            ComposerErrorInner::ImportParseError(message, at) => {
                Problem::new(place(*at), format!("this import can't be read: {message}"))
                    .with_source(written)
            }
            ComposerErrorInner::NotEnoughEndIfs(at)
            | ComposerErrorInner::TooManyEndIfs(at)
            | ComposerErrorInner::ElseWithoutCondition(at)
            | ComposerErrorInner::UnknownShaderDef { pos: at, .. }
            | ComposerErrorInner::UnknownShaderDefOperator { pos: at, .. }
            | ComposerErrorInner::InvalidShaderDefComparisonValue { pos: at, .. }
            | ComposerErrorInner::DefineInModule(at) => {
                Problem::new(place(*at), error.inner.to_string()).with_source(written)
            }
            ComposerErrorInner::InvalidIdentifier { original, at } => Problem::new(
                place(start(at.to_range())),
                format!("`{original}` can't be a name in a module"),
            )
            .with_source(written)
            .with_hint(
                "names in shaders/lib must not end in a digit or an underscore, nor be WGSL words",
            ),
            other => Problem::new(Place::file(file), self.composer_text(&other.to_string())),
        }
    }

    /// A message without the composer's decorated names.
    fn composer_text(&self, message: &str) -> String {
        undecorate(message)
    }
}

/// Turns naga_oil's decorated names (`positionX_naga_oil_mod_XNRUWO…X`) into plain ones.
pub(crate) fn undecorate(message: &str) -> String {
    const MARK: &str = "X_naga_oil_mod_X";
    let mut plain = String::with_capacity(message.len());
    let mut rest = message;
    while let Some(at) = rest.find(MARK) {
        plain.push_str(&rest[..at]);
        let after = &rest[at + MARK.len()..];
        // The module's name in base 32, which may hold an X itself, and then an X.
        let base_32 = |c: char| c.is_ascii_uppercase() || ('2'..='7').contains(&c);
        let end = after.find(|c| !base_32(c)).unwrap_or(after.len());
        rest = &after[end..];
    }
    plain.push_str(rest);
    plain
}

/// The place in a file of a byte in the composer's version of it, in which lines are the same but
/// names are decorated: the same word of the same line, counted from the line's beginning.
fn written_place(file: &str, composed: &str, written: &str, byte: usize) -> Place {
    let place = place_of(file, composed, byte);
    let line = |text: &'_ str| {
        text.lines()
            .nth(place.line as usize - 1)
            .unwrap_or("")
            .to_owned()
    };
    let (composed, written) = (line(composed), line(written));
    if composed == written {
        return place;
    }
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let before: String = composed.chars().take(place.column as usize - 1).collect();
    let token: String = composed
        .chars()
        .skip(place.column as usize - 1)
        .take_while(|&c| word(c))
        .collect();
    let (before, token) = (undecorate(&before), undecorate(&token));
    let words = |text: &str| -> Vec<usize> {
        text.match_indices(token.as_str())
            .filter(|(at, _)| {
                !text[..*at].ends_with(word) && !text[*at + token.len()..].starts_with(word)
            })
            .map(|(at, _)| at)
            .collect()
    };
    let column = if token.is_empty() {
        before.chars().count().min(written.chars().count())
    } else {
        let at = words(&written).get(words(&before).len()).copied();
        at.map_or(before.chars().count(), |at| written[..at].chars().count())
    };
    Place::new(file, place.line, column as u32 + 1)
}

/// Line and column of a byte.
pub(crate) fn place_of(file: &str, text: &str, byte: usize) -> Place {
    let byte = (0..=byte.min(text.len()))
        .rev()
        .find(|&b| text.is_char_boundary(b))
        .unwrap_or(0);
    let before = &text[..byte];
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    Place::new(file, line as u32, column as u32)
}

fn read(files: &Files, path: &str) -> Result<String, Problem> {
    files
        .read_text(path)
        .map_err(|error| Problem::new(Place::file(path), error.to_string()))
}

/// The module name that a file gives itself.
fn import_path(text: &str) -> Option<String> {
    text.lines()
        .find_map(|line| line.trim().strip_prefix("#define_import_path"))
        .map(|name| name.trim().to_owned())
}

/// The names after `#import`, each with the index of its line.
fn imported_names(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().filter_map(|(number, line)| {
        let rest = line.trim_start().strip_prefix("#import")?;
        let name = rest.trim().split([' ', '{', ';']).next().unwrap_or("");
        let name = name.trim_end_matches(':').trim_matches('"');
        Some((number, name))
    })
}
