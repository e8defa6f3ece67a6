//! The files that shaders import, in `shaders/lib`.

use lightbench_assets::files::Files;

use super::imports::module_of;
use super::listing::{Listing, with_plain_line_ends};
use crate::problem::{Place, Problem};

/// The folder of modules that shaders import.
pub const MODULES: &str = "shaders/lib";

/// A file of the modules' folder.
pub(super) struct ModuleFile {
    /// What shaders import it by, as in `lightbench::scene`. A file without a name can't be
    /// imported, which concerns those alone who try.
    pub name: Option<String>,
    pub path: String,
    /// The text as it was written; the composer rewrites names in it.
    pub text: String,
    /// The line in which it gives itself the name.
    named_in: u32,
}

/// Reads the files of the modules' folder.
///
/// # Errors
/// A folder or file that can't be read.
pub(super) fn read_modules(files: &Files) -> Result<Vec<ModuleFile>, Problem> {
    let listed = files
        .list(MODULES, "wgsl")
        .map_err(|error| Problem::new(Place::file(MODULES), error.to_string()))?;
    let module = |path: String| {
        let text = read(files, &path)?;
        let (named_in, name) = import_path(&text).unzip();
        Ok(ModuleFile {
            name,
            path,
            text,
            named_in: named_in.unwrap_or(0),
        })
    };
    listed.into_iter().map(|entry| module(entry.path)).collect()
}

/// Reads a shader or module.
///
/// # Errors
/// A file that can't be read.
pub(super) fn read(files: &Files, path: &str) -> Result<String, Problem> {
    let text = files
        .read_text(path)
        .map_err(|error| Problem::new(Place::file(path), error.to_string()))?;
    Ok(with_plain_line_ends(&text))
}

/// Finds imports of a file that is there, but that nobody can import.
///
/// # Errors
/// A module without a name, at the import; a module whose name is another's too, in that module.
pub(super) fn check_imported(listing: &Listing, modules: &[ModuleFile]) -> Result<(), Problem> {
    let names: Vec<&str> = modules.iter().filter_map(|m| m.name.as_deref()).collect();
    for import in &listing.imports {
        let imported = module_of(&import.path, &names);
        let mut twins = modules
            .iter()
            .filter(|module| imported.is_some() && module.name.as_deref() == imported);
        if let (Some(first), Some(second)) = (twins.next(), twins.next()) {
            let name = imported.unwrap_or_default();
            return Err(Problem::new(
                Place::new(second.path.as_str(), second.named_in, 1),
                format!("`{}` calls itself `{name}` too", first.path),
            )
            .with_source(&second.text)
            .with_hint("give one of the modules another name"));
        }
        let is_meant = |module: &&ModuleFile| {
            let file = module.path.rsplit('/').next().unwrap_or_default();
            let mut words = import.path.split("::");
            module.name.is_none() && words.any(|word| file.strip_suffix(".wgsl") == Some(word))
        };
        if imported.is_none()
            && let Some(nameless) = modules.iter().find(is_meant)
        {
            return Err(Problem::new(
                import.at.clone(),
                format!("there is no module `{}`", import.path),
            )
            .with_source(&listing.text)
            .with_hint(format!(
                "`{}` has no name: begin it with `#define_import_path {}`",
                nameless.path, import.path
            )));
        }
    }
    Ok(())
}

/// Modules of which none can be added before the others.
pub(super) fn circle(waiting: &[(&str, &Listing)], names: &[&str]) -> Problem {
    let all: Vec<String> = waiting
        .iter()
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    let (first, listing) = waiting[0];
    let import = listing.imports.iter().find(|import| {
        let imported = module_of(&import.path, names);
        waiting.iter().any(|(other, _)| Some(*other) == imported)
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
            "move what both need into a third module, and let `{first}` import that"
        ))
}

/// The line in which a file gives itself a name for imports, and that name.
fn import_path(text: &str) -> Option<(u32, String)> {
    let named = |line: &str| {
        let name = line.trim().strip_prefix("#define_import_path")?.trim();
        (!name.is_empty()).then(|| name.to_owned())
    };
    (1..)
        .zip(text.lines())
        .find_map(|(number, line)| Some((number, named(line)?)))
}
