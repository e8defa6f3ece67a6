//! Pictures that are kept on the disk, each as long as all files that it was made from are the same.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use lightbench::assets::Digest;
use lightbench::assets::files::{Files, write_atomic};
use lightbench::assets::images::{Pixels, decode_picture, encode_png};
use serde_json::{Map, Value, json};

/// Files by their paths, with the digest of their contents; those that were looked for and are not
/// there have none.
pub type Inputs = BTreeMap<String, Option<String>>;

/// What a picture has to be: it changes with the program.
const FORM: &str = concat!("lightbench ", env!("CARGO_PKG_VERSION"), ", gallery 1");

/// A picture as egui takes it: width, height, and RGBA.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Four bytes a pixel, sRGB.
    pub rgba: Vec<u8>,
}

/// The digest of each file as it is now.
pub fn inputs<'a>(files: &Files, paths: impl Iterator<Item = &'a String>) -> Inputs {
    paths
        .map(|path| {
            let bytes = files.read(path).ok();
            let digest = bytes.map(|bytes| Digest::of(&bytes).to_string());
            (path.clone(), digest)
        })
        .collect()
}

fn names(folder: &Path, what: &str) -> (PathBuf, PathBuf) {
    let name = Digest::of(format!("{FORM}, {what}").as_bytes()).to_string();
    let name = &name[..32];
    (
        folder.join(format!("{name}.json")),
        folder.join(format!("{name}.png")),
    )
}

/// The picture that was kept of something, if it is still true.
pub fn find(folder: &Path, files: &Files, what: &str) -> Option<Picture> {
    let (list, picture) = names(folder, what);
    let list: Value = serde_json::from_str(&fs::read_to_string(list).ok()?).ok()?;
    let kept: &Map<String, Value> = list.get("files")?.as_object()?;
    let paths: Vec<String> = kept.keys().cloned().collect();
    let now = inputs(files, paths.iter());
    let same = now
        .iter()
        .all(|(path, digest)| kept.get(path).and_then(Value::as_str) == digest.as_deref());
    if !same {
        return None;
    }
    let bytes = fs::read(&picture).ok()?;
    // List and picture are two files: they belong together by the picture's digest.
    if list.get("picture")?.as_str()? != Digest::of(&bytes).to_string() {
        return None;
    }
    let decoded = decode_picture(&picture.to_string_lossy(), &bytes).ok()?;
    let Pixels::Rgba8(rgba) = decoded.pixels else {
        return None;
    };
    let size = [decoded.width as usize, decoded.height as usize];
    Some(Picture { size, rgba })
}

/// Keeps a picture. One that can't be kept is made again another time.
pub fn keep(folder: &Path, what: &str, inputs: &Inputs, picture: &Picture) {
    let (list, file) = names(folder, what);
    let [width, height] = picture.size;
    let kept = encode_png("picture", width as u32, height as u32, &picture.rgba)
        .map_err(|error| error.to_string())
        .and_then(|bytes| {
            fs::create_dir_all(folder).map_err(|error| error.to_string())?;
            write_atomic(file, &bytes).map_err(|error| error.to_string())?;
            let digest = Digest::of(&bytes).to_string();
            let text = json!({ "picture": digest, "files": inputs }).to_string();
            write_atomic(list, text.as_bytes()).map_err(|error| error.to_string())
        });
    if let Err(error) = kept {
        tracing::warn!("a picture of the gallery is not kept: {error}");
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_picture_is_kept_until_a_file_changes_or_appears() {
        let folder = tempfile::tempdir().unwrap();
        let project = folder.path().join("project");
        let cache = folder.path().join("cache");
        fs::create_dir(&project).unwrap();
        let write = |name: &str, text: &str| fs::write(project.join(name), text).unwrap();
        write("a.rhai", "one");
        let files = Files::with_project(&project).unwrap();
        let paths = ["a.rhai".to_owned(), "missing.rhai".to_owned()];
        let now = || inputs(&files, paths.iter());
        let picture = Picture {
            size: [2, 1],
            rgba: vec![1, 2, 3, 255, 4, 5, 6, 255],
        };
        assert_eq!(find(&cache, &files, "a"), None);
        keep(&cache, "a", &now(), &picture);
        assert_eq!(find(&cache, &files, "a"), Some(picture.clone()));
        assert_eq!(find(&cache, &files, "b"), None);
        write("a.rhai", "two");
        assert_eq!(find(&cache, &files, "a"), None);
        keep(&cache, "a", &now(), &picture);
        write("missing.rhai", "there");
        assert_eq!(find(&cache, &files, "a"), None);
        keep(&cache, "a", &now(), &picture);
        assert!(find(&cache, &files, "a").is_some());
        // A picture that another process was writing.
        for file in fs::read_dir(&cache).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|end| end == "png") {
                fs::write(path, "half").unwrap();
            }
        }
        assert_eq!(find(&cache, &files, "a"), None);
    }
}
