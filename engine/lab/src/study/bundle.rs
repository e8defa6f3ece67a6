//! A study with all that it was made from, as one file that another machine can repeat.
//!
//! The archive is a gzipped tar (POSIX.1-1988 ustar) with `study.json`, what the report wrote, and the
//! inputs: `project/` over the shipped files, `outside/N/` for each folder outside of the project.

use std::fs::{self, File};
use std::io::{self, Read as _, Write as _};
use std::path::{Component, Path, PathBuf};

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use lightbench_assets::Digest;
use lightbench_assets::files::Files;

use super::model::{Plan, Study};
use crate::LabError;
use crate::files::write_atomically;

/// The most bytes that an archive may unpack to: an attacker's few bytes must not fill a disk.
const MOST_BYTES: u64 = 4 << 30;
/// The most files.
const MOST_FILES: usize = 100_000;

/// The plan in an archive.
const PLAN_FILE: &str = "plan.json";
/// Where the report lies in it.
const REPORT: &str = "report";
/// Where the inputs lie.
const PROJECT: &str = "project";
/// Where inputs from other folders lie.
const OUTSIDE: &str = "outside";

/// Why there is no bundle, or none that can be used.
#[derive(Debug, thiserror::Error)]
pub enum BundleError {
    /// An input is not what was measured any more.
    #[error(
        "{0} has changed since it was measured; measure again with the same command, then bundle"
    )]
    Changed(String),
    /// An input lies where no bundle can put it.
    #[error("{0} lies outside of the project and of the folders that the study names")]
    Elsewhere(String),
    /// The archive holds something that is not a plain file in its folder.
    #[error(
        "the bundle holds `{0}`, which is no plain file inside of it; it was not made by Lightbench"
    )]
    Hostile(String),
    /// The archive unpacks to too much.
    #[error("the bundle unpacks to more than {} files or {} GiB", MOST_FILES, MOST_BYTES >> 30)]
    TooLarge,
    /// The archive is none.
    #[error("{} is no bundle of a study: {reason}", path.display())]
    NoBundle {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A file can't be read or written.
    #[error(transparent)]
    Lab(#[from] LabError),
    /// The system said no.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Packs a study, the files of its report and all of its inputs.
///
/// # Errors
/// An input that has changed since, or a disk that can't be read or written.
pub fn pack(study: &Study, report: &Path, files: &Files, out: &Path) -> Result<(), BundleError> {
    let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::default()));
    let mut plan = study.plan.clone();
    // Paths of this machine mean nothing on another.
    plan.outside = (0..plan.outside.len())
        .map(|index| PathBuf::from(format!("{OUTSIDE}/{index}")))
        .collect();
    let text = serde_json::to_vec_pretty(&plan).map_err(|error| LabError::Encode {
        format: "JSON",
        reason: error.to_string(),
    })?;
    add(&mut archive, Path::new(PLAN_FILE), &text)?;
    let mut added: Vec<PathBuf> = Vec::new();
    for input in study
        .points
        .iter()
        .flat_map(|point| &point.comparison.inputs)
    {
        let place = place(&input.path, &study.plan)?;
        if added.contains(&place) {
            continue;
        }
        let bytes = match files.read(&input.path) {
            Ok(bytes) => bytes.to_vec(),
            Err(_) => fs::read(&input.path)?,
        };
        if Digest::of(&bytes).to_string() != input.hash {
            return Err(BundleError::Changed(input.path.clone()));
        }
        add(&mut archive, &place, &bytes)?;
        added.push(place);
    }
    let mut reported = Vec::new();
    list(report, Path::new(""), &mut reported)?;
    for path in reported {
        add(
            &mut archive,
            &Path::new(REPORT).join(&path),
            &fs::read(report.join(&path))?,
        )?;
    }
    let bytes = archive.into_inner()?.finish()?;
    write_atomically(out, &bytes)?;
    Ok(())
}

/// Where an input lies in the archive.
fn place(path: &str, plan: &Plan) -> Result<PathBuf, BundleError> {
    let on_disk = Path::new(path);
    if on_disk.is_relative() {
        return Ok(Path::new(PROJECT).join(on_disk));
    }
    let outside = plan.outside.iter().enumerate().find_map(|(index, folder)| {
        let below = on_disk.strip_prefix(folder).ok()?;
        Some(Path::new(OUTSIDE).join(index.to_string()).join(below))
    });
    outside.ok_or_else(|| BundleError::Elsewhere(path.to_owned()))
}

fn add<W: io::Write>(
    archive: &mut tar::Builder<W>,
    path: &Path,
    bytes: &[u8],
) -> Result<(), BundleError> {
    let mut header = tar::Header::new_gnu();
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    // The same study gives the same archive.
    header.set_mtime(0);
    header.set_entry_type(tar::EntryType::Regular);
    archive.append_data(&mut header, path, bytes)?;
    Ok(())
}

/// The files of a report, without the parts of the measurement, in the order of their names.
fn list(top: &Path, below: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
    let mut entries: Vec<_> = fs::read_dir(top.join(below))?.collect::<io::Result<_>>()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let path = below.join(entry.file_name());
        let kind = entry.file_type()?;
        if kind.is_dir() && path != Path::new("parts") {
            list(top, &path, found)?;
        } else if kind.is_file() && path != Path::new("study.json") {
            found.push(path);
        }
    }
    Ok(())
}

/// An unpacked bundle.
#[derive(Clone, Debug)]
pub struct Unpacked {
    /// The plan, with the folders outside of the project where they lie now.
    pub plan: Plan,
    /// The project's folder.
    pub project: PathBuf,
    /// The folder of the report.
    pub report: PathBuf,
}

/// Unpacks a bundle into a folder.
///
/// # Errors
/// A file that is no bundle, or one that reaches out of its folder or is too large.
pub fn unpack(bundle: &Path, folder: &Path) -> Result<Unpacked, BundleError> {
    let no_bundle = |reason: String| BundleError::NoBundle {
        path: bundle.to_owned(),
        reason,
    };
    let mut archive = tar::Archive::new(GzDecoder::new(File::open(bundle)?));
    let (mut files, mut bytes) = (0, 0);
    for entry in archive.entries().map_err(|e| no_bundle(e.to_string()))? {
        let mut entry = entry.map_err(|e| no_bundle(e.to_string()))?;
        let path = entry
            .path()
            .map_err(|e| no_bundle(e.to_string()))?
            .into_owned();
        let inside = path
            .components()
            .all(|part| matches!(part, Component::Normal(_)));
        if !inside || !entry.header().entry_type().is_file() {
            return Err(BundleError::Hostile(path.display().to_string()));
        }
        files += 1;
        bytes += entry.size();
        if files > MOST_FILES || bytes > MOST_BYTES {
            return Err(BundleError::TooLarge);
        }
        let to = folder.join(&path);
        if let Some(parent) = to.parent() {
            fs::create_dir_all(parent)?;
        }
        let mut content = Vec::new();
        let read = entry.read_to_end(&mut content);
        read.map_err(|e| no_bundle(e.to_string()))?;
        File::create(&to)?.write_all(&content)?;
    }
    let text = fs::read_to_string(folder.join(PLAN_FILE))
        .map_err(|_| no_bundle(format!("it has no {PLAN_FILE}")))?;
    let mut plan: Plan = serde_json::from_str(&text).map_err(|e| no_bundle(e.to_string()))?;
    for (index, outside) in plan.outside.iter_mut().enumerate() {
        *outside = folder.join(OUTSIDE).join(index.to_string());
    }
    let project = folder.join(PROJECT);
    fs::create_dir_all(&project)?;
    Ok(Unpacked {
        plan,
        project,
        report: folder.join(REPORT),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::{Input, sample};
    use crate::study::{Choice, Point};

    fn study(folder: &Path) -> Study {
        fs::create_dir_all(folder.join("scripts")).unwrap();
        fs::write(folder.join("scripts/a.rhai"), "let a = 1;").unwrap();
        let mut comparison = sample::comparison();
        comparison.inputs = vec![Input {
            path: "scripts/a.rhai".into(),
            algorithm: "SHA-256".into(),
            hash: Digest::of(b"let a = 1;").to_string(),
        }];
        let choice = Choice {
            path: "a".into(),
            ..Choice::default()
        };
        Study {
            schema: crate::report::SCHEMA,
            plan: Plan {
                scenes: vec![choice.clone()],
                pipelines: vec![choice],
                ..Plan::default()
            },
            points: vec![Point {
                key: "scene=a".into(),
                coordinates: Vec::new(),
                comparison,
            }],
            missing: Vec::new(),
        }
    }

    #[test]
    fn a_bundle_holds_the_plan_the_report_and_the_inputs() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let study = study(&at("project"));
        fs::create_dir_all(at("report/pictures")).unwrap();
        fs::create_dir_all(at("report/parts")).unwrap();
        fs::write(at("report/report.json"), "{}").unwrap();
        fs::write(at("report/pictures/ñ.png"), "png").unwrap();
        fs::write(at("report/parts/x.json"), "part").unwrap();
        let files = Files::with_project(at("project")).unwrap();
        pack(&study, &at("report"), &files, &at("b.tar.gz")).unwrap();
        let unpacked = unpack(&at("b.tar.gz"), &at("again")).unwrap();
        assert_eq!(unpacked.plan, study.plan);
        let read = |path: PathBuf| fs::read_to_string(path).unwrap();
        assert_eq!(read(unpacked.project.join("scripts/a.rhai")), "let a = 1;");
        assert_eq!(read(unpacked.report.join("report.json")), "{}");
        assert_eq!(read(unpacked.report.join("pictures/ñ.png")), "png");
        assert!(!unpacked.report.join("parts").exists());
        // The same content gives the same bytes.
        pack(&study, &at("report"), &files, &at("c.tar.gz")).unwrap();
        assert_eq!(
            fs::read(at("b.tar.gz")).unwrap(),
            fs::read(at("c.tar.gz")).unwrap()
        );

        fs::write(at("project/scripts/a.rhai"), "let a = 2;").unwrap();
        let files = Files::with_project(at("project")).unwrap();
        let error = pack(&study, &at("report"), &files, &at("d.tar.gz")).unwrap_err();
        assert!(
            error.to_string().contains("scripts/a.rhai has changed"),
            "{error}"
        );
        assert!(!at("d.tar.gz").exists());
    }

    #[test]
    fn hostile_and_broken_archives_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let bundle = folder.path().join("b.tar.gz");
        type Archive = tar::Builder<GzEncoder<Vec<u8>>>;
        let write = |build: &dyn Fn(&mut Archive)| {
            let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::fast()));
            build(&mut archive);
            fs::write(&bundle, archive.into_inner().unwrap().finish().unwrap()).unwrap();
            unpack(&bundle, &folder.path().join("out"))
                .unwrap_err()
                .to_string()
        };
        let entry = |kind: tar::EntryType, name: &[u8]| {
            let mut header = tar::Header::new_old();
            // The crate refuses to write such names, so the bytes are set by hand.
            header.as_old_mut().name[..name.len()].copy_from_slice(name);
            header.set_entry_type(kind);
            header.set_size(0);
            header.set_mode(0o644);
            header.set_cksum();
            header
        };
        for name in [&b"../evil"[..], b"/evil", b"a/../../evil"] {
            let header = entry(tar::EntryType::Regular, name);
            let error = write(&|archive| archive.append(&header, &[][..]).unwrap());
            assert!(error.contains("no plain file"), "{error}");
        }
        let header = entry(tar::EntryType::Symlink, b"link");
        let error = write(&|archive| archive.append(&header, &[][..]).unwrap());
        assert!(error.contains("no plain file"), "{error}");
        assert!(write(&|_| {}).contains("no plan.json"));
        fs::write(&bundle, "no archive").unwrap();
        let error = unpack(&bundle, folder.path()).unwrap_err().to_string();
        assert!(error.contains("no bundle"), "{error}");
        assert!(!folder.path().join("evil").exists());
    }
}
