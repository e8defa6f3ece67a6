//! The notebook's folder: a file and a picture for each entry.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use lightbench::assets::files::write_atomic;
use lightbench::lab::{LdrImage, Picture};

use super::Kept;
use super::entry::Entry;
use crate::ui::messages::say;

/// The longest side of a small picture.
const SMALL: u32 = 160;

/// All entries of a folder, and what can't be read, in a sentence each. A folder that is not there has
/// none.
pub(super) fn read(folder: &Path) -> (Vec<Kept>, Vec<String>) {
    let (mut entries, mut problems) = (Vec::new(), Vec::new());
    let Ok(listed) = fs::read_dir(folder) else {
        return (entries, problems);
    };
    for path in listed.flatten().map(|file| file.path()) {
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let is_entry = path.extension().is_some_and(|end| end == "json");
        let Some(name) = stem.filter(|_| is_entry) else {
            continue;
        };
        let text = fs::read_to_string(&path).map_err(|error| error.to_string());
        match text.and_then(|text| Entry::from_json(name, &text)) {
            Ok(entry) => {
                let picture = Picture::open(&folder.join(entry.picture()));
                let thumbnail = match &picture {
                    Ok(Picture::Ldr(picture)) => Some(Arc::new(thumbnail(picture))),
                    _ => None,
                };
                entries.push(Kept {
                    entry,
                    thumbnail,
                    png: None,
                    unsaved: None,
                });
            }
            Err(error) => problems.push(say!(
                "notebook.is_left_out_of_the_notebook",
                path = path.display(),
                error = error
            )),
        }
    }
    (entries, problems)
}

/// Writes an entry: its picture first, because the other file is what makes it one.
pub(super) fn write(folder: &Path, entry: &Entry, png: Option<&[u8]>) -> Result<(), String> {
    if let Some(png) = png {
        write_file(&folder.join(entry.picture()), png)?;
    }
    let path = folder.join(format!("{}.json", entry.name));
    write_file(&path, entry.to_json().as_bytes())
}

/// Writes a file, whole or not at all, with the folder that it needs.
pub(super) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|error| {
            say!(
                "notebook.cant_make_the_folder",
                folder = folder.display(),
                error = error
            )
        })?;
    }
    write_atomic(path, bytes).map_err(|error| error.to_string())
}

/// The files of an entry, byte for byte.
#[derive(Clone, Debug)]
pub(super) struct Files {
    json: Vec<u8>,
    /// Its picture, where there is one.
    pub(super) png: Option<Vec<u8>>,
}

/// The files of an entry, where it is on the disk.
pub(super) fn files(folder: &Path, name: &str) -> Option<Files> {
    Some(Files {
        json: fs::read(folder.join(format!("{name}.json"))).ok()?,
        png: fs::read(folder.join(format!("{name}.png"))).ok(),
    })
}

/// Writes the files of an entry that was deleted: its picture first.
pub(super) fn bring_back(folder: &Path, name: &str, files: &Files) -> Result<(), String> {
    if let Some(png) = &files.png {
        write_file(&folder.join(format!("{name}.png")), png)?;
    }
    write_file(&folder.join(format!("{name}.json")), &files.json)
}

/// Deletes an entry: the file that makes it one first.
pub(super) fn delete(folder: &Path, name: &str) -> Result<(), String> {
    let file = folder.join(format!("{name}.json"));
    fs::remove_file(&file).map_err(|error| format!("{}: {error}", file.display()))?;
    let picture = folder.join(format!("{name}.png"));
    match fs::remove_file(&picture) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(format!("{}: {error}", picture.display()))
        }
        _ => Ok(()),
    }
}

/// A picture made small, each pixel the mean of those that it stands for.
pub(super) fn thumbnail(picture: &LdrImage) -> LdrImage {
    let longest = picture.width.max(picture.height);
    let by = longest.div_ceil(SMALL).max(1);
    let (width, height) = (picture.width.div_ceil(by), picture.height.div_ceil(by));
    LdrImage::from_fn(width, height, |x, y| {
        let mut sums = [0_u32; 4];
        let mut count = 0;
        for row in (y * by..(y + 1) * by).take_while(|row| *row < picture.height) {
            for column in (x * by..(x + 1) * by).take_while(|column| *column < picture.width) {
                let pixel = picture.pixels[(row * picture.width + column) as usize];
                for (sum, value) in sums.iter_mut().zip(pixel) {
                    *sum += u32::from(value);
                }
                count += 1;
            }
        }
        sums.map(|sum| ((sum + count / 2) / count.max(1)) as u8)
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::entry::tests::entry;
    use super::*;

    #[test]
    fn entries_come_and_go_with_their_pictures() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("new/notebook");
        assert!(read(&folder).0.is_empty());
        let picture = LdrImage::from_fn(400, 200, |x, _| [(x / 2) as u8, 40, 0, 255]);
        let entry = entry();
        write(&folder, &entry, Some(&picture.to_png().unwrap())).unwrap();
        fs::write(folder.join("broken.json"), "{").unwrap();
        fs::write(folder.join("notebook.md"), "text").unwrap();
        let (entries, problems) = read(&folder);
        assert_eq!(entries.len(), 1);
        assert_eq!(entries[0].entry, entry);
        let small = entries[0].thumbnail.as_ref().unwrap();
        assert_eq!((small.width, small.height), (134, 67));
        assert_eq!(small.pixels[1], [2, 40, 0, 255]);
        assert_eq!(problems.len(), 1);
        assert!(problems[0].contains("broken.json"));
        delete(&folder, &entry.name).unwrap();
        assert!(read(&folder).0.is_empty());
        assert!(!folder.join(entry.picture()).exists());
        assert!(delete(&folder, &entry.name).is_err());
    }

    #[test]
    fn a_file_in_the_way_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("notebook");
        fs::write(&file, "").unwrap();
        let error = write(&file, &entry(), None).unwrap_err();
        assert!(error.contains("notebook"), "{error}");
    }
}
