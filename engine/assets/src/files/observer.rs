//! Those who want to know which files were read.

use std::fmt;
use std::sync::Arc;

type Observe = dyn Fn(&str, &[u8]) + Send + Sync;

/// Functions that are told of every file that was read.
#[derive(Clone, Default)]
pub(super) struct Observers(Vec<Arc<Observe>>);

impl Observers {
    /// The same ones and another.
    pub(super) fn and(&self, observe: impl Fn(&str, &[u8]) + Send + Sync + 'static) -> Self {
        let mut all = self.clone();
        all.0.push(Arc::new(observe));
        all
    }

    pub(super) fn tell(&self, path: &str, bytes: &[u8]) {
        for observe in &self.0 {
            observe(path, bytes);
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
