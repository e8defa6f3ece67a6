//! Writes the table of shipped files (shaders, scripts, lessons) that the
//! program carries inside it, so that one executable is a whole installation.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// The folders at the top of the repository that are shipped.
const SHIPPED_FOLDERS: [&str; 3] = ["lessons", "scripts", "shaders"];

fn main() -> io::Result<()> {
    let variable = |name: &str| {
        env::var_os(name)
            .map(PathBuf::from)
            .ok_or_else(|| io::Error::other(format!("cargo did not set {name}")))
    };
    let root = variable("CARGO_MANIFEST_DIR")?
        .join("../..")
        .canonicalize()?;

    println!("cargo::rerun-if-changed=build.rs");
    let mut files = Vec::new();
    for folder in SHIPPED_FOLDERS {
        if root.join(folder).is_dir() {
            // Cargo looks at everything below a folder that is named here, and
            // would run this program every time for one that is not there.
            println!("cargo::rerun-if-changed={}", root.join(folder).display());
            collect(&root, folder, &mut files)?;
        }
    }
    files.sort();

    let mut table = String::from("pub(super) static SHIPPED: &[(&str, &[u8])] = &[\n");
    for path in files {
        let on_disk = root.join(&path);
        let on_disk = on_disk.to_str().ok_or_else(|| not_unicode(&on_disk))?;
        writeln!(table, "    ({path:?}, include_bytes!({on_disk:?})),")
            .map_err(io::Error::other)?;
    }
    table.push_str("];\n");
    fs::write(variable("OUT_DIR")?.join("shipped.rs"), table)
}

/// What a student's program must not hold: the answers of lessons, and the checks
/// that only a lecturer has.
const KEPT_BACK: [&str; 2] = ["solution", "hidden"];

/// Adds every file below `folder` as a path relative to `root`, with forward
/// slashes. Hidden files and the left-overs of editors are not shipped, and
/// neither is what lessons keep back.
fn collect(root: &Path, folder: &str, files: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(root.join(folder))? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_str().ok_or_else(|| not_unicode(&entry.path()))?;
        if name.starts_with('.') || name.ends_with('~') || name.ends_with(".tmp") {
            continue;
        }
        if folder.starts_with("lessons/") && KEPT_BACK.contains(&name) {
            continue;
        }
        let path = format!("{folder}/{name}");
        if entry.file_type()?.is_dir() {
            collect(root, &path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}

fn not_unicode(path: &Path) -> io::Error {
    io::Error::other(format!("the name of {} is not Unicode", path.display()))
}
