//! Somebody who wants to know which files were read.

use std::fmt;
use std::sync::Arc;

type Observe = dyn Fn(&str, &[u8]) + Send + Sync;

/// Nobody, or a function that is told of every file that was read.
#[derive(Clone, Default)]
pub(super) struct Observer(Option<Arc<Observe>>);

impl Observer {
    pub(super) fn new(observe: impl Fn(&str, &[u8]) + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(observe)))
    }

    pub(super) fn tell(&self, path: &str, bytes: &[u8]) {
        if let Some(observe) = &self.0 {
            observe(path, bytes);
        }
    }
}

impl fmt::Debug for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() {
            "observed"
        } else {
            "not observed"
        })
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
}
