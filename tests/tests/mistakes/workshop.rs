//! The lab's project in a folder, where files are edited and put right again.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lightbench::assets::files::Files;
use lightbench::render::{Compiler, Problem, Problems, Renderer};
use lightbench::script::{Settings, load_pipeline};
use lightbench_tests::gpu;
use tempfile::TempDir;

use crate::table::Edit;

const PIPELINE: &str = "lab";

/// A project folder and compilers that keep what they know from edit to edit, as the editor's does.
pub struct Workshop {
    folder: TempDir,
    files: Files,
    compiler: Compiler,
    /// On a device with the fewest abilities.
    portable: Compiler,
    /// What was edited, with the text before; none where there was no file.
    edited: BTreeMap<String, Option<String>>,
}

impl Workshop {
    /// The lab as it is.
    pub fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let lab = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mistakes/lab");
        copy(&lab, folder.path());
        Self {
            files: Files::with_project(folder.path()).unwrap(),
            folder,
            compiler: Renderer::new(gpu(false)).compiler(),
            portable: Renderer::new(gpu(true)).compiler(),
            edited: BTreeMap::new(),
        }
    }

    fn path(&self, file: &str) -> PathBuf {
        self.folder.path().join(file)
    }

    /// Changes a file. A shipped one is copied into the project first.
    pub fn edit(&mut self, edit: &Edit) {
        let path = self.path(&edit.file);
        let text = self.files.read_text(&edit.file).ok();
        let own = std::fs::read_to_string(&path).ok();
        self.edited.entry(edit.file.clone()).or_insert(own);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        let text = text.unwrap_or_default();
        match edit.whole.as_str() {
            "remove" => std::fs::remove_file(&path).unwrap(),
            "empty" => std::fs::write(&path, "").unwrap(),
            "cut" => std::fs::write(&path, &text[..text.len() / 2]).unwrap(),
            _ => {
                let (from, to) = (edit.from.join("\n"), edit.to.join("\n"));
                let text = if from.is_empty() {
                    assert!(text.is_empty(), "{edit:?}: say which lines go");
                    to + "\n"
                } else {
                    // Whole lines only.
                    let text = format!("\n{text}");
                    let from = format!("\n{from}\n");
                    assert_eq!(text.matches(&from).count(), 1, "{edit:?}");
                    let to = if edit.to.is_empty() {
                        "\n".to_owned()
                    } else {
                        format!("\n{to}\n")
                    };
                    text.replacen(&from, &to, 1)[1..].to_owned()
                };
                std::fs::write(&path, text).unwrap();
            }
        }
        self.forget(&edit.file);
    }

    /// Puts everything right again.
    pub fn restore(&mut self) {
        for (file, text) in std::mem::take(&mut self.edited) {
            let path = self.path(&file);
            match text {
                Some(text) => std::fs::write(path, text).unwrap(),
                None => std::fs::remove_file(path).unwrap(),
            }
            self.forget(&file);
        }
    }

    fn forget(&mut self, file: &str) {
        self.compiler.forget(file);
        self.portable.forget(file);
    }

    /// All problems, each as `PLACE: MESSAGE` with the way out below it.
    pub fn report(&mut self, portable: bool) -> String {
        let problems = match self.compile(portable) {
            Ok(()) => return String::new(),
            Err(problems) => problems.0,
        };
        problems.iter().for_each(|problem| self.check(problem));
        let lines = problems.iter().map(|problem| {
            let help = problem.hint.as_ref();
            let help = help.map_or_else(String::new, |hint| format!("    help: {hint}\n"));
            let mut place = problem.place.to_string();
            // Lines of shipped files come and go.
            if Files::shipped().exists(&problem.place.file) {
                place = place.replacen(&format!(":{}:", problem.place.line), ":*:", 1);
            }
            format!("{place}: {}\n{help}", problem.message)
        });
        lines.collect()
    }

    fn compile(&mut self, portable: bool) -> Result<(), Problems> {
        let desc = load_pipeline(&self.files, PIPELINE, &Settings::new())?;
        let compiler = if portable {
            &mut self.portable
        } else {
            &mut self.compiler
        };
        compiler.compile(&self.files, &desc).map(|_| ())
    }

    /// A problem shows the line that it speaks of.
    fn check(&self, problem: &Problem) {
        let Ok(text) = self.files.read_text(&problem.place.file) else {
            return;
        };
        let line = text
            .lines()
            .nth((problem.place.line as usize).wrapping_sub(1));
        let shown = problem.source_line.as_deref();
        assert_eq!(shown, line.map(str::trim_end), "{problem}");
        if let Some(line) = line {
            let length = line.chars().count() as u32;
            assert!(problem.place.column >= 1, "{problem}");
            assert!(problem.place.column <= length + 1, "{problem}");
        }
    }
}

fn copy(from: &Path, to: &Path) {
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            std::fs::create_dir_all(&target).unwrap();
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}
