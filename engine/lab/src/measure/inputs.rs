//! Which files went in, with the hash of what was read.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::Digest;
use lightbench_assets::files::Files;

use crate::report::Input;

/// Hashes every file that is read through its [`Files`].
#[derive(Clone, Debug, Default)]
pub struct Inputs(Arc<Mutex<BTreeMap<String, String>>>);

impl Inputs {
    /// Nothing read yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// A store whose reads are noted here. A file that is read again is noted as it was last.
    pub fn watch(&self, files: &Files) -> Files {
        let noted = self.clone();
        files.observed(move |path, bytes| {
            noted
                .lock()
                .insert(path.to_owned(), Digest::of(bytes).to_string());
        })
    }

    /// What was read so far, sorted by path as people know it.
    pub fn list(&self, files: &Files) -> Vec<Input> {
        let read = self.lock();
        let mut inputs: Vec<Input> = read
            .iter()
            .map(|(path, hash)| Input {
                path: files.display(path),
                algorithm: "SHA-256".to_owned(),
                hash: hash.clone(),
            })
            .collect();
        inputs.sort_by(|a, b| a.path.cmp(&b.path));
        inputs
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, String>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn files_that_were_read_are_listed_with_their_hash() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("b.txt"), "abc").unwrap();
        std::fs::write(folder.path().join("a.txt"), "").unwrap();
        std::fs::write(folder.path().join("unread.txt"), "x").unwrap();
        let inputs = Inputs::new();
        let files = inputs.watch(&Files::with_project(folder.path()).unwrap());
        files.read_text("b.txt").unwrap();
        files.read("a.txt").unwrap();

        // The test vectors of FIPS 180-4 for "abc" and the empty message.
        let listed = inputs.list(&files);
        let found: Vec<_> = listed
            .iter()
            .map(|i| (i.path.as_str(), i.hash.as_str()))
            .collect();
        assert_eq!(
            found,
            [
                (
                    "a.txt",
                    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"
                ),
                (
                    "b.txt",
                    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
                ),
            ]
        );
    }
}
