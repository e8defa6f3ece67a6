//! What a study has measured so far, on disk: one file for each point and process.
//!
//! A file is there when it is complete, so that a study that was killed goes on where it was. Each has
//! the hashes of everything that was read for it: what was measured with other files is measured again.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::model::Plan;
use super::points::Planned;
use crate::files::write_atomically;
use crate::report::{Comparison, SCHEMA};
use crate::{HdrImage, LabError, LdrImage, Picture};

/// The file that names the plan.
const PLAN_FILE: &str = "study.json";
/// The folder of what was measured.
const PARTS: &str = "parts";

/// A folder that a study is measured into.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
}

/// Why a folder can't be used for a study.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// It has another study.
    #[error(
        "{} holds another study; name another folder with --out, or give --restart to replace it",
        .0.display()
    )]
    Other(PathBuf),
    /// It has none.
    #[error("{} holds no study: there is no {PLAN_FILE}", .0.display())]
    None(PathBuf),
    /// A file can't be read or written.
    #[error(transparent)]
    Lab(#[from] LabError),
}

#[derive(Serialize, Deserialize)]
struct Header {
    schema: u32,
    program_version: String,
    plan: Plan,
}

/// What one process measured at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// The point.
    pub key: String,
    /// The process, from 0.
    pub process: u32,
    /// All pipelines; the first process has the pictures too.
    pub comparison: Comparison,
}

impl Store {
    /// Opens a folder for a plan, and makes it where it is not there. With `restart`, what another
    /// plan has measured there goes away.
    ///
    /// # Errors
    /// [`StoreError::Other`] where it holds another plan and `restart` is false; a disk that can't be
    /// written.
    pub fn open(
        folder: &Path,
        plan: &Plan,
        program_version: &str,
        restart: bool,
    ) -> Result<Self, StoreError> {
        let store = Self {
            folder: folder.to_owned(),
        };
        let header = Header {
            schema: SCHEMA,
            program_version: program_version.to_owned(),
            plan: plan.clone(),
        };
        if !restart && store.path(PLAN_FILE).exists() {
            let known = store.header()?;
            let same = known.plan == *plan && known.program_version == program_version;
            return if same {
                Ok(store)
            } else {
                Err(StoreError::Other(folder.to_owned()))
            };
        }
        // The plan goes first, so that no part of the old one is ever taken for the new one's.
        absent(
            fs::remove_file(store.path(PLAN_FILE)),
            &store.path(PLAN_FILE),
        )?;
        absent(fs::remove_dir_all(store.path(PARTS)), &store.path(PARTS))?;
        write_json(&store.path(PLAN_FILE), &header)?;
        Ok(store)
    }

    /// A folder that holds a study, with its plan.
    ///
    /// # Errors
    /// [`StoreError::None`], or a file that can't be read.
    pub fn existing(folder: &Path) -> Result<(Self, Plan), StoreError> {
        let store = Self {
            folder: folder.to_owned(),
        };
        if !store.path(PLAN_FILE).exists() {
            return Err(StoreError::None(folder.to_owned()));
        }
        let plan = store.header()?.plan;
        Ok((store, plan))
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    fn header(&self) -> Result<Header, LabError> {
        read_json(&self.path(PLAN_FILE))
    }

    /// The file name of a part without its ending. Keys may have any letters, so they are hashed.
    fn stem(point: &Planned, process: u32) -> String {
        let hash = lightbench_assets::Digest::of(point.key.as_bytes()).to_string();
        format!("{PARTS}/{}-{process}", &hash[..16])
    }

    /// Whether a part is there.
    pub fn has(&self, point: &Planned, process: u32) -> bool {
        self.path(&format!("{}.json", Self::stem(point, process)))
            .exists()
    }

    /// Writes a part; its pictures first, so that it is there when they are.
    ///
    /// # Errors
    /// A disk that can't be written.
    pub fn write(
        &self,
        point: &Planned,
        process: u32,
        mut comparison: Comparison,
    ) -> Result<(), LabError> {
        let stem = Self::stem(point, process);
        for (index, pipeline) in comparison.pipelines.iter_mut().enumerate() {
            let png = |picture: &Option<LdrImage>, name: String| -> Result<_, LabError> {
                let Some(picture) = picture else {
                    return Ok(None);
                };
                write_atomically(&self.path(&name), &picture.to_png()?)?;
                Ok(Some(name))
            };
            pipeline.picture_file = png(&pipeline.picture, format!("{stem}-{index}.png"))?;
            pipeline.heat_map_file = png(&pipeline.heat_map, format!("{stem}-{index}-flip.png"))?;
            for (number, view) in pipeline.views.iter_mut().enumerate() {
                view.file = png(&view.picture, format!("{stem}-{index}-view{number}.png"))?;
            }
            if let Some(picture) = &pipeline.linear {
                save_linear(&self.path(&format!("{stem}-{index}.exr")), picture)?;
            }
        }
        let part = Part {
            key: point.key.clone(),
            process,
            comparison,
        };
        write_json(&self.path(&format!("{stem}.json")), &part)
    }

    /// Reads a part without its pictures; `None` where it is not there.
    ///
    /// # Errors
    /// A file that can't be read.
    pub fn read(&self, point: &Planned, process: u32) -> Result<Option<Part>, LabError> {
        if !self.has(point, process) {
            return Ok(None);
        }
        let stem = Self::stem(point, process);
        read_json(&self.path(&format!("{stem}.json"))).map(Some)
    }

    /// Reads the pictures that a part names.
    ///
    /// # Errors
    /// Files that can't be read.
    pub fn load_pictures(&self, point: &Planned, part: &mut Part) -> Result<(), LabError> {
        let stem = Self::stem(point, part.process);
        for (index, pipeline) in part.comparison.pipelines.iter_mut().enumerate() {
            pipeline.picture = self.picture(pipeline.picture_file.take())?;
            pipeline.heat_map = self.picture(pipeline.heat_map_file.take())?;
            for view in &mut pipeline.views {
                view.picture = self.picture(view.file.take())?;
            }
            let linear = self.path(&format!("{stem}-{index}.exr"));
            if linear.exists()
                && let Picture::Hdr(picture) = Picture::open(&linear)?
            {
                pipeline.linear = Some(picture);
            }
        }
        Ok(())
    }

    fn picture(&self, file: Option<String>) -> Result<Option<LdrImage>, LabError> {
        let Some(file) = file else { return Ok(None) };
        match Picture::open(&self.path(&file))? {
            Picture::Ldr(picture) => Ok(Some(picture)),
            Picture::Hdr(_) => Ok(None),
        }
    }

    /// Removes a part, so that it is measured again.
    ///
    /// # Errors
    /// A disk that can't be written.
    pub fn remove(&self, point: &Planned, process: u32) -> Result<(), LabError> {
        let path = self.path(&format!("{}.json", Self::stem(point, process)));
        absent(fs::remove_file(&path), &path)
    }

    /// Copies a part with its pictures from another folder of the same plan.
    ///
    /// # Errors
    /// A disk that can't be read or written.
    pub fn take(&self, from: &Self, point: &Planned, process: u32) -> Result<(), LabError> {
        let stem = Self::stem(point, process);
        let name = stem.rsplit('/').next().unwrap_or_default();
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |source| LabError::Write { path, source }
        };
        let folder = from.path(PARTS);
        let entries = fs::read_dir(&folder).map_err(failed(&folder))?;
        let mut files: Vec<PathBuf> = entries
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| {
                let file = path.file_name().and_then(|file| file.to_str());
                let rest = file.and_then(|file| file.strip_prefix(name));
                rest.is_some_and(|rest| rest.starts_with(['-', '.']))
            })
            .collect();
        // The part itself goes last.
        files.sort_by_key(|path| path.extension().is_some_and(|end| end == "json"));
        for file in files {
            let bytes = fs::read(&file).map_err(failed(&file))?;
            let to = self.path(PARTS).join(file.file_name().unwrap_or_default());
            write_atomically(&to, &bytes)?;
        }
        Ok(())
    }
}

fn save_linear(path: &Path, picture: &HdrImage) -> Result<(), LabError> {
    let pixels = picture.pixels.as_flattened();
    lightbench_assets::images::save_exr(path, picture.width, picture.height, pixels).map_err(
        |error| LabError::Encode {
            format: "EXR",
            reason: error.to_string(),
        },
    )
}

/// What was to be removed may have been absent already.
fn absent(removed: std::io::Result<()>, path: &Path) -> Result<(), LabError> {
    match removed {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => Err(LabError::Write {
            path: path.to_owned(),
            source,
        }),
        _ => Ok(()),
    }
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<(), LabError> {
    let text = serde_json::to_string(value).map_err(|error| LabError::Encode {
        format: "JSON",
        reason: error.to_string(),
    })?;
    write_atomically(path, text.as_bytes())
}

fn read_json<T: for<'a> Deserialize<'a>>(path: &Path) -> Result<T, LabError> {
    let fail = |reason: String| LabError::ReportData {
        path: path.to_owned(),
        reason,
    };
    let text = fs::read_to_string(path).map_err(|error| fail(error.to_string()))?;
    serde_json::from_str(&text).map_err(|error| fail(error.to_string()))
}
