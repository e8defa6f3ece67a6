//! From shader files to checked modules: imports, defines, validation, reflection.

mod conversion;
mod declarations;
mod explain;
mod imports;
mod listing;
mod syntax;
mod tokens;
mod validity;

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

pub use declarations::Listings;
pub use listing::Listing;
pub(crate) use listing::with_plain_line_ends;

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
}

/// The folder of modules that shaders import.
const MODULES: &str = "shaders/lib";

/// A file of the modules' folder.
struct ModuleFile {
    /// What shaders import it by, as in `lightbench::scene`.
    name: String,
    path: String,
    /// The text as it was written; the composer rewrites names in it.
    text: String,
}

/// Composes shaders from files and remembers the modules that they import.
pub struct ShaderComposer {
    composer: Composer,
    capabilities: Capabilities,
    modules: Vec<ModuleFile>,
}

impl ShaderComposer {
    /// Reads every module in `shaders/lib`. `capabilities` say which optional parts of WGSL are
    /// allowed.
    ///
    /// # Errors
    /// The first mistake in a module, with its place.
    pub fn new(files: &Files, capabilities: Capabilities) -> Result<Self, Problem> {
        let modules = read_modules(files)?;
        let mut this = Self {
            composer: Composer::default().with_capabilities(capabilities),
            capabilities,
            modules,
        };
        this.add_modules()?;
        Ok(this)
    }

    /// Adds the modules in an order in which each finds what it imports.
    fn add_modules(&mut self) -> Result<(), Problem> {
        let mut waiting = Vec::new();
        for (index, module) in self.modules.iter().enumerate() {
            let listing = Listing::outline(&module.path, &module.text)?;
            imports::check_names(&listing, &self.names())?;
            waiting.push((index, listing));
        }
        while !waiting.is_empty() {
            let names: Vec<&str> = self.names();
            let waits = |listing: &Listing| {
                listing.imports.iter().any(|import| {
                    let imported = imports::module_of(&import.path, &names);
                    let mut others = waiting.iter();
                    others.any(|(other, _)| Some(names[*other]) == imported)
                })
            };
            let Some(ready) = waiting.iter().position(|(_, listing)| !waits(listing)) else {
                return Err(circle(&waiting, &names));
            };
            let (index, listing) = waiting.swap_remove(ready);
            let module = &self.modules[index];
            let descriptor = ComposableModuleDescriptor {
                source: &module.text,
                file_path: &module.path,
                ..Default::default()
            };
            let composer = &mut self.composer;
            let added = guard::catch(|| composer.add_composable_module(descriptor).map(|_| ()));
            let added = added.map_err(|fault| unexpected(&module.path, &fault))?;
            if let Err(error) = added {
                let listings = Listings::new(listing, Vec::new());
                return Err(self.explain(&error, &listings, None));
            }
        }
        Ok(())
    }

    /// The names of all modules.
    fn names(&self) -> Vec<&str> {
        self.modules
            .iter()
            .map(|module| module.name.as_str())
            .collect()
    }

    /// A listing of a module.
    fn list_module(&self, module: &ModuleFile, defines: &Defines) -> Result<Listing, Problem> {
        let listing = Listing::new(&module.path, &module.text, defines, true)?;
        imports::check_names(&listing, &self.names())?;
        Ok(listing)
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
                return Err(explained.unwrap_or_else(|fault| unexpected(path, &fault)));
            }
        };
        let mut validator = Validator::new(ValidationFlags::all(), self.capabilities);
        let info = guard::catch(|| validator.validate(&module))
            .map_err(|fault| unexpected(path, &fault))?
            .map_err(|error| unexpected(path, &error.as_inner().to_string()))?;
        Ok(Shader {
            path: path.to_owned(),
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
        imports::check_names(&shader, &names)?;
        values.extend(shader.defines.clone());
        let mut wanted: Vec<&str> = imported(&shader, &names);
        let mut modules: Vec<(String, Listing)> = Vec::new();
        while let Some(name) = wanted.pop() {
            if modules.iter().any(|(known, _)| known == name) {
                continue;
            }
            let Some(module) = self.modules.iter().find(|module| module.name == name) else {
                continue;
            };
            let listing = self.list_module(module, &values)?;
            wanted.extend(imported(&listing, &names));
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
                // What the composer was in the middle of is lost.
                self.composer = Composer::default().with_capabilities(self.capabilities);
                self.add_modules()?;
                Err(unexpected(path, &fault))
            }
        }
    }

    /// A number for a shader's text with its defines and all modules: where anything of it differs,
    /// so does the number.
    pub fn fingerprint(&self, text: &str, defines: &[Define]) -> u64 {
        let mut hasher = DefaultHasher::new();
        (text, defines).hash(&mut hasher);
        for module in &self.modules {
            (&module.path, &module.text).hash(&mut hasher);
        }
        hasher.finish()
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

/// The modules that a file imports, whatever the defines.
fn imported<'a>(listing: &Listing, modules: &[&'a str]) -> Vec<&'a str> {
    let imports = listing.imports.iter();
    imports
        .filter_map(|import| imports::module_of(&import.path, modules))
        .collect()
}

/// Reads the files of the modules' folder.
fn read_modules(files: &Files) -> Result<Vec<ModuleFile>, Problem> {
    let mut modules: Vec<ModuleFile> = Vec::new();
    let listed = files
        .list(MODULES, "wgsl")
        .map_err(|error| Problem::new(Place::file(MODULES), error.to_string()))?;
    for entry in listed {
        let text = read(files, &entry.path)?;
        let Some((line, name)) = import_path(&text) else {
            let first = if text.is_empty() { 0 } else { 1 };
            return Err(Problem::new(
                Place::new(entry.path.as_str(), first, first),
                "the module has no name",
            )
            .with_source(&text)
            .with_hint("add a line such as `#define_import_path lightbench::name`"));
        };
        if let Some(other) = modules.iter().find(|module| module.name == name) {
            return Err(Problem::new(
                Place::new(entry.path.as_str(), line, 1),
                format!("`{}` calls itself `{name}` too", other.path),
            )
            .with_source(&text)
            .with_hint("give one of the modules another name"));
        }
        modules.push(ModuleFile {
            name,
            path: entry.path,
            text,
        });
    }
    Ok(modules)
}

/// Modules of which none can be added before the others.
fn circle(waiting: &[(usize, Listing)], names: &[&str]) -> Problem {
    let all: Vec<String> = waiting
        .iter()
        .map(|(index, _)| format!("`{}`", names[*index]))
        .collect();
    let (index, listing) = &waiting[0];
    let import = listing.imports.iter().find(|import| {
        let imported = imports::module_of(&import.path, names);
        waiting
            .iter()
            .any(|(other, _)| Some(names[*other]) == imported)
    });
    let place = import.map_or_else(|| Place::file(listing.path.as_str()), |i| i.at.clone());
    let message = match all.as_slice() {
        [one] => format!("the module {one} imports itself"),
        all => format!(
            "the modules {} import each other in a circle",
            all.join(" and ")
        ),
    };
    Problem::new(place, message)
        .with_source(&listing.text)
        .with_hint(format!(
            "move what both need into a third module, and let `{}` import that",
            names[*index]
        ))
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

fn read(files: &Files, path: &str) -> Result<String, Problem> {
    let text = files
        .read_text(path)
        .map_err(|error| Problem::new(Place::file(path), error.to_string()))?;
    Ok(with_plain_line_ends(&text))
}

/// The module name that a file gives itself, and in which line.
fn import_path(text: &str) -> Option<(u32, String)> {
    let named = |line: &str| {
        let name = line.trim().strip_prefix("#define_import_path")?.trim();
        (!name.is_empty()).then(|| name.to_owned())
    };
    (1..)
        .zip(text.lines())
        .find_map(|(number, line)| Some((number, named(line)?)))
}
