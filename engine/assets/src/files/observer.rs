//! Those who want to know which files were read, or looked for.

use std::fmt;
use std::sync::Arc;

/// What came of asking for a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access<'a> {
    /// It was read: its bytes, as they are on the disk.
    Read(&'a [u8]),
    /// It is in no layer.
    Missing,
}

type Observe = dyn Fn(&str, Access) + Send + Sync;

/// Functions that are told of every file that was asked for.
#[derive(Clone, Default)]
pub(super) struct Observers(Vec<Arc<Observe>>);

impl Observers {
    /// The same ones and another.
    pub(super) fn and(&self, observe: impl Fn(&str, Access) + Send + Sync + 'static) -> Self {
        let mut all = self.clone();
        all.0.push(Arc::new(observe));
        all
    }

    pub(super) fn tell(&self, path: &str, access: Access) {
        for observe in &self.0 {
            observe(path, access);
        }
    }
}

impl fmt::Debug for Observers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} observers", self.0.len())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::sync::Mutex;

    use super::super::Files;
    use super::*;

    #[test]
    fn every_read_is_told_and_no_other_store_is() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.txt"), "one\r\ntwo").unwrap();
        let plain = Files::with_project(folder.path()).unwrap();
        let told = Arc::new(Mutex::new(Vec::new()));
        let seen = Arc::clone(&told);
        let files = plain.observed(move |path, bytes| {
            seen.lock().unwrap().push((path.to_owned(), bytes.to_vec()));
        });

        plain.read("a.txt").unwrap();
        assert!(files.read("b.txt").is_err());
        assert_eq!(files.clone().read_text("a.txt").unwrap(), "one\ntwo");
        let told = told.lock().unwrap();
        assert_eq!(*told, [("a.txt".to_owned(), b"one\r\ntwo".to_vec())]);
    }

    #[test]
    fn files_that_are_missing_are_told_to_those_who_ask_for_it() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.txt"), "one").unwrap();
        let told = Arc::new(Mutex::new(Vec::new()));
        let seen = Arc::clone(&told);
        let files = Files::with_project(folder.path()).unwrap();
        let files = files.observed_with_missing(move |path, access| {
            let found = matches!(access, Access::Read(_));
            seen.lock().unwrap().push((path.to_owned(), found));
        });
        files.read("a.txt").unwrap();
        files.read("b.txt").unwrap_err();
        assert!(!files.exists("c.txt"));
        let told = told.lock().unwrap();
        let expected = [("a.txt", true), ("b.txt", false), ("c.txt", false)];
        assert_eq!(
            *told,
            expected.map(|(path, found)| (path.to_owned(), found))
        );
    }

    #[test]
    fn whoever_observes_an_observed_store_does_not_displace_the_other() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.txt"), "one").unwrap();
        let count = |files: &Files| {
            let count = Arc::new(Mutex::new(0));
            let counted = Arc::clone(&count);
            let files = files.observed(move |_, _| *counted.lock().unwrap() += 1);
            (files, count)
        };
        let (outer, by_outer) = count(&Files::with_project(folder.path()).unwrap());
        let (inner, by_inner) = count(&outer);
        inner.read("a.txt").unwrap();
        outer.read("a.txt").unwrap();
        assert_eq!(*by_outer.lock().unwrap(), 2);
        assert_eq!(*by_inner.lock().unwrap(), 1);
    }
}
