//! The files of a submission, and why a task of it may be refused before anything is drawn.

use std::path::Path;

use lightbench_assets::files::{FileError, Files, Origin};

use super::model::Task;
use super::outcome::{Refusal, RefusalKind};
use super::read::STARTER;
use super::words::Words;
use super::{Lesson, copies, imports};

/// A reason without a place to read again, which the task gives.
pub(super) fn refusal(kind: RefusalKind, says: Words) -> Refusal {
    Refusal {
        kind,
        says,
        read: None,
    }
}

/// The files of a submission, with those that they begin from.
pub(super) struct Submission {
    /// All that lies in the folder.
    pub(super) work: Files,
    files: Vec<Submitted>,
    allowed: Vec<String>,
}

struct Submitted {
    path: String,
    /// Nothing where it is missing.
    bytes: Result<Vec<u8>, FileError>,
    starter: Vec<u8>,
}

impl Submission {
    pub(super) fn read(lesson: &Lesson, work: &Path) -> Result<Self, FileError> {
        let work = Files::with_project(work)?;
        let mut files = Vec::new();
        for path in &lesson.about.submits {
            // A shipped file of that path is not the student's.
            let own = matches!(work.origin(path), Ok(Origin::Project(_)));
            let read = || work.read(path);
            let missing = || FileError::NotFound {
                path: path.clone(),
                places: "in the work".to_owned(),
            };
            files.push(Submitted {
                path: path.clone(),
                bytes: if own {
                    read()
                } else {
                    Err(work.origin(path).err().unwrap_or_else(missing))
                },
                starter: lesson.source.read(&format!("{STARTER}/{path}"))?,
            });
        }
        Ok(Self {
            work,
            files,
            allowed: lesson.about.imports.clone(),
        })
    }

    /// The submitted files that are there.
    pub(super) fn given(&self) -> Vec<(String, Vec<u8>)> {
        let files = self.files.iter();
        files
            .filter_map(|file| Some((file.path.clone(), file.bytes.as_ref().ok()?.clone())))
            .collect()
    }

    /// Why a task is not judged.
    pub(super) fn refuse(&self, task: &Task) -> Option<Refusal> {
        let files = || {
            self.files
                .iter()
                .filter(|file| task.files.contains(&file.path))
        };
        for file in files() {
            if let Err(error) = &file.bytes {
                return Some(refusal(
                    RefusalKind::Missing,
                    Words::new(
                        error.to_string(),
                        format!("No se puede leer `{}`: {error}", file.path),
                    ),
                ));
            }
        }
        let texts = |file: &Submitted| {
            let given = file
                .bytes
                .as_ref()
                .map(|bytes| String::from_utf8_lossy(bytes).into_owned());
            (
                given.unwrap_or_default(),
                String::from_utf8_lossy(&file.starter).into_owned(),
            )
        };
        let untouched = files().all(|file| {
            let (given, starter) = texts(file);
            copies::says_the_same(&file.path, &given, &starter)
        });
        if untouched {
            let names: Vec<&str> = task.files.iter().map(String::as_str).collect();
            let names = names.join(", ");
            return Some(refusal(
                RefusalKind::Unchanged,
                Words::new(
                    format!("Nothing is changed yet in {names}"),
                    format!("Todavía no hay ningún cambio en {names}"),
                ),
            ));
        }
        files().find_map(|file| {
            let (given, starter) = texts(file);
            self.disallowed(&file.path, &given)
                .or_else(|| copied(&file.path, &given, &starter))
        })
    }

    fn disallowed(&self, path: &str, code: &str) -> Option<Refusal> {
        let import = imports::forbidden(path, code, &self.allowed)?;
        let allowed = match self.allowed.is_empty() {
            true => Words::new("nothing else is needed", "no hace falta nada más"),
            false => {
                let names = self.allowed.join(", ");
                Words::new(
                    format!("you may use {names}"),
                    format!("puedes usar {names}"),
                )
            }
        };
        let (line, what) = (import.line, import.what);
        Some(refusal(
            RefusalKind::Import,
            match what.as_str() {
                "" => Words::new(
                    format!("{path}:{line}: an import must name its file in plain quotes"),
                    format!(
                        "{path}:{line}: una importación debe nombrar su archivo entre comillas, sin más"
                    ),
                ),
                what => Words::new(
                    format!(
                        "{path}:{line}: `{what}` may not be used in this lesson, since it would solve the task; {}",
                        allowed.en
                    ),
                    format!(
                        "{path}:{line}: `{what}` no se puede usar en esta lección, porque resolvería la tarea; {}",
                        allowed.es
                    ),
                ),
            },
        ))
    }
}

fn copied(path: &str, code: &str, starter: &str) -> Option<Refusal> {
    let found = copies::copied_from(path, code, starter)?;
    let (shipped, share) = (found.path, (100.0 * found.share).round());
    Some(refusal(
        RefusalKind::Copy,
        Words::new(
            format!(
                "{path} is the shipped file {shipped} with other names ({share} % of it); the task asks for something of your own"
            ),
            format!(
                "{path} es el archivo incluido {shipped} con otros nombres (un {share} %); la tarea pide algo tuyo"
            ),
        ),
    ))
}
