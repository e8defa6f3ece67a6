//! From shader files to checked modules: imports, defines, validation, reflection.

mod conversion;
mod declarations;
mod depth;
mod explain;
mod imports;
mod listing;
mod modules;
mod narrow;
mod syntax;
mod tokens;
mod validity;

use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use lightbench_assets::files::Files;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, ComposerErrorInner, NagaModuleDescriptor,
    ShaderDefValue,
};

use crate::description::Define;
use crate::guard;
use crate::problem::{Place, Problem};
use explain::Explainer;
use listing::Defines;
use modules::{ModuleFile, check_imported, circle, read, read_modules};

pub use declarations::Listings;
pub use listing::Listing;
pub(crate) use listing::with_plain_line_ends;
pub use modules::MODULES;

/// A shader that parsed and validated, before any pipeline is built from it.
#[derive(Clone, Debug)]
pub struct Shader {
    /// Path of the file.
    pub path: String,
    /// The file's text, for error messages.
    pub text: String,
    /// The composed module.
    pub module: naga::Module,
    /// What validation found out about it.
    pub info: ModuleInfo,
    /// The files that it was composed from, to find where its names are declared.
    pub listings: Listings,
    /// Paths of the modules that it imports, and of those that they import.
    pub modules: Vec<String>,
    /// A number for the text, the defines and all those modules: where anything of it differs, so
    /// does the number.
    pub fingerprint: u64,
}

impl Shader {
    /// Whether its text, or that of a module which it imports, directly or not, has a word.
    pub fn mentions(&self, word: &str) -> bool {
        let mut files = self.listings.all();
        files.any(|listing| listing.text.contains(word))
    }
}

/// Composes shaders from files and remembers the modules that they import.
pub struct ShaderComposer {
    composer: Composer,
    capabilities: Capabilities,
    modules: Vec<ModuleFile>,
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
        Ok(Self {
            composer: Composer::default().with_capabilities(capabilities),
            capabilities,
            modules: read_modules(files)?,
            added: BTreeSet::new(),
        })
    }

    /// Takes in the modules of a shader, each after those that it imports itself.
    fn add_modules(&mut self, listings: &Listings) -> Result<(), Problem> {
        let is_new = |listing: &Listing| !self.added.contains(&listing.path);
        let mut waiting: Vec<(&str, &Listing)> = listings
            .modules()
            .filter(|(_, listing)| is_new(listing))
            .collect();
        let names: Vec<&str> = listings.modules().map(|(name, _)| name).collect();
        while !waiting.is_empty() {
            let waits = |listing: &Listing| {
                listing.imports.iter().any(|import| {
                    let imported = imports::module_of(&import.path, &names);
                    let mut others = waiting.iter();
                    others.any(|(other, _)| Some(*other) == imported)
                })
            };
            let Some(ready) = waiting.iter().position(|(_, listing)| !waits(listing)) else {
                return Err(circle(&waiting, &names));
            };
            let (_, listing) = waiting.remove(ready);
            let descriptor = ComposableModuleDescriptor {
                source: &listing.text,
                file_path: &listing.path,
                ..Default::default()
            };
            let composer = &mut self.composer;
            let added = guard::catch(|| {
                let added = composer.add_composable_module(descriptor);
                added.map(|_| ()).map_err(Box::new)
            });
            match added {
                Ok(Ok(())) => self.added.insert(listing.path.clone()),
                Ok(Err(error)) => return Err(self.explain(&error, listings, None)),
                Err(fault) => {
                    self.begin_again();
                    return Err(unexpected(&listing.path, &fault));
                }
            };
        }
        Ok(())
    }

    /// Forgets a composer that stopped in the middle of something.
    fn begin_again(&mut self) {
        self.composer = Composer::default().with_capabilities(self.capabilities);
        self.added.clear();
    }

    /// The names of all modules.
    fn names(&self) -> Vec<&str> {
        let modules = self.modules.iter();
        modules
            .filter_map(|module| module.name.as_deref())
            .collect()
    }

    /// The file of the module of that name.
    fn named(&self, name: &str) -> Option<&ModuleFile> {
        let mut modules = self.modules.iter();
        modules.find(|module| module.name.as_deref() == Some(name))
    }

    /// A listing of a module; without defines, of one that is not needed.
    fn list_module(
        &self,
        module: &ModuleFile,
        defines: Option<&Defines>,
    ) -> Result<Listing, Problem> {
        let listing = match defines {
            Some(defines) => Listing::new(&module.path, &module.text, defines, true)?,
            None => Listing::outline(&module.path, &module.text)?,
        };
        self.check_names(&listing)?;
        Ok(listing)
    }

    /// Every module that a file imports is there.
    fn check_names(&self, listing: &Listing) -> Result<(), Problem> {
        check_imported(listing, &self.modules)?;
        imports::check_names(listing, &self.names())
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
        let listings = self.list(path, &text, defines)?;
        self.add_modules(&listings)?;
        let composed = self.make(path, &text, defines, true)?;
        let module = match composed {
            Ok(module) => module,
            Err(error) => {
                // What is not valid can be looked at all the same, to say what it is.
                let invalid = matches!(error.inner, ComposerErrorInner::ShaderValidationError(_));
                let module = match invalid {
                    true => self.make(path, &text, defines, false)?.ok(),
                    false => None,
                };
                let explained = guard::catch(|| self.explain(&error, &listings, module.as_ref()));
                let mut problem = explained.unwrap_or_else(|fault| unexpected(path, &fault));
                if problem.place.line == 0 {
                    self.find_line(&error, &mut problem, &listings, defines);
                }
                return Err(problem);
            }
        };
        let mut validator = Validator::new(ValidationFlags::all(), self.capabilities);
        let info = guard::catch(|| validator.validate(&module).map_err(Box::new))
            .map_err(|fault| unexpected(path, &fault))?
            .map_err(|error| unexpected(path, &error.as_inner().to_string()))?;
        let modules = listings.modules().map(|(_, module)| module.path.clone());
        Ok(Shader {
            path: path.to_owned(),
            modules: modules.collect(),
            fingerprint: fingerprint(&listings, defines),
            text,
            module,
            info,
            listings,
        })
    }

    /// The files of a shader, each with the branches that the defines leave.
    fn list(&self, path: &str, text: &str, defines: &[Define]) -> Result<Listings, Problem> {
        let names = self.names();
        let mut values: Defines = defines
            .iter()
            .map(|define| (define.name.clone(), define.value))
            .collect();
        let shader = Listing::new(path, text, &values, false)?;
        self.check_names(&shader)?;
        values.extend(shader.defines.clone());
        let mut wanted = imported(&shader, &names, true);
        let mut others = imported(&shader, &names, false);
        let mut modules: Vec<(String, Listing)> = Vec::new();
        // Those that lie in branches which are not taken come last: others may import them too.
        while let Some((name, taken)) = wanted
            .pop()
            .map(|name| (name, true))
            .or_else(|| Some((others.pop()?, false)))
        {
            if modules.iter().any(|(known, _)| known == name) {
                continue;
            }
            let Some(module) = self.named(name) else {
                continue;
            };
            let listing = self.list_module(module, taken.then_some(&values))?;
            if taken {
                wanted.extend(imported(&listing, &names, true));
            } else {
                others.extend(imported(&listing, &names, true));
            }
            others.extend(imported(&listing, &names, false));
            modules.push((name.to_owned(), listing));
        }
        Ok(Listings::new(shader, modules))
    }

    /// Lets the composer make one module of a shader and what it imports.
    ///
    /// # Errors
    /// A fault of the composer; what it has to say of the shader is the value.
    fn make(
        &mut self,
        path: &str,
        text: &str,
        defines: &[Define],
        validate: bool,
    ) -> Result<Result<naga::Module, Box<ComposerError>>, Problem> {
        let value = |define: &Define| {
            let value = define.value;
            value.map_or(ShaderDefValue::Bool(true), ShaderDefValue::Int)
        };
        let descriptor = NagaModuleDescriptor {
            source: text,
            file_path: path,
            shader_defs: defines.iter().map(|d| (d.name.clone(), value(d))).collect(),
            ..Default::default()
        };
        let composer = &mut self.composer;
        composer.validate = validate;
        let made = guard::catch(|| composer.make_naga_module(descriptor).map_err(Box::new));
        composer.validate = true;
        match made {
            Ok(made) => Ok(made),
            Err(fault) => {
                self.begin_again();
                Err(unexpected(path, &fault))
            }
        }
    }

    /// Finds the line of a complaint of the reader that names none.
    fn find_line(
        &mut self,
        error: &ComposerError,
        problem: &mut Problem,
        listings: &Listings,
        defines: &[Define],
    ) {
        let ComposerErrorInner::WgslParseError(complaint) = &error.inner else {
            return;
        };
        let Some(file) = listings.of_path(&problem.place.file) else {
            return;
        };
        let said = complaint.message();
        if let Some((message, hint)) = narrow::in_words(said) {
            problem.message = message;
            problem.hint = Some(hint.to_owned());
        }
        let same = |text: &str| {
            let error = self.complaint_with(file, text, listings.shader(), defines);
            error.is_some_and(|other| other == said)
        };
        // Where it is in no function, the first line is as good as any.
        let line = narrow::line_of(&file.text, &file.active, same).unwrap_or(1);
        let written = file.text.lines().nth(line as usize - 1).unwrap_or("");
        let indent = written.chars().take_while(|c| c.is_whitespace()).count() as u32;
        problem.place = Place::new(file.path.as_str(), line, indent + 1);
        *problem = problem.clone().with_source(&file.text);
        // Modules may have been taken in with parts left out.
        self.begin_again();
    }

    /// What the reader says of a shader with another text in one of its files.
    fn complaint_with(
        &mut self,
        file: &Listing,
        text: &str,
        shader: &Listing,
        defines: &[Define],
    ) -> Option<String> {
        let text_of_shader = if file.path == shader.path {
            text
        } else {
            let descriptor = ComposableModuleDescriptor {
                source: text,
                file_path: &file.path,
                ..Default::default()
            };
            let composer = &mut self.composer;
            let added = guard::catch(|| composer.add_composable_module(descriptor).is_ok());
            if added != Ok(true) {
                return None;
            }
            shader.text.as_str()
        };
        match self.make(&shader.path, text_of_shader, defines, false) {
            Ok(Err(error)) => match &error.inner {
                ComposerErrorInner::WgslParseError(other) => Some(other.message().to_owned()),
                _ => None,
            },
            _ => None,
        }
    }

    fn explain(
        &self,
        error: &ComposerError,
        listings: &Listings,
        composed: Option<&naga::Module>,
    ) -> Problem {
        let explainer = Explainer {
            composer: &self.composer,
            listings,
            modules: &self.names(),
            composed,
        };
        explainer.with_source(explainer.explain(error))
    }
}

/// The modules that a file imports in branches that are taken, or in those that are not.
fn imported<'a>(listing: &Listing, modules: &[&'a str], taken: bool) -> Vec<&'a str> {
    let imports = listing.imports.iter();
    imports
        .filter(|import| import.taken == taken)
        .filter_map(|import| imports::module_of(&import.path, modules))
        .collect()
}

/// A number for a shader's files with its defines.
fn fingerprint(listings: &Listings, defines: &[Define]) -> u64 {
    let mut hasher = DefaultHasher::new();
    defines.hash(&mut hasher);
    for listing in listings.all() {
        (&listing.path, &listing.text).hash(&mut hasher);
    }
    hasher.finish()
}

/// A fault of the libraries that compose and check shaders.
fn unexpected(path: &str, fault: &str) -> Problem {
    tracing::error!("{path}: {fault}");
    Problem::new(
        Place::file(path),
        "something in this shader is more than the program that reads it can do",
    )
    .with_hint("take back the last change; it may be an unusual one, or half of one")
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

/// `vec3f` for `vec3<f32>`, as the shipped shaders write it.
pub(crate) fn short_types(text: &str) -> String {
    let mut short = text.to_owned();
    for (long, letter) in [("f32", 'f'), ("i32", 'i'), ("u32", 'u'), ("f16", 'h')] {
        for size in ["vec2", "vec3", "vec4"] {
            short = short.replace(&format!("{size}<{long}>"), &format!("{size}{letter}"));
        }
    }
    for columns in 2..=4 {
        for rows in 2..=4 {
            let name = format!("mat{columns}x{rows}");
            short = short.replace(&format!("{name}<f32>"), &format!("{name}f"));
        }
    }
    short
}
