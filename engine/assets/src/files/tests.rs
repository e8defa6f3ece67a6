#![allow(clippy::unwrap_used)]
use tempfile::TempDir;

use super::*;

/// A store with two shipped files over an empty project.
fn project() -> (TempDir, Files) {
    let folder = tempfile::Builder::new()
        .prefix("práctica 1 ñ")
        .tempdir()
        .unwrap();
    let files = Files {
        shipped: &[
            ("scripts/pipelines/forward.rhai", b"// shipped"),
            ("scripts/scenes/atrium.rhai", b"// atrium"),
            ("shaders/lib/surface.wgsl", b"// surface"),
        ],
        ..Files::with_project(folder.path()).unwrap()
    };
    (folder, files)
}

fn put(folder: &TempDir, path: &str, content: impl AsRef<[u8]>) {
    let path = folder.path().join(path);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, content).unwrap();
}

#[test]
fn the_table_of_shipped_files_is_in_order() {
    let table = Files::shipped().shipped;
    assert!(table.windows(2).all(|pair| pair[0].0 < pair[1].0));
    for (path, bytes) in table {
        check(path).unwrap();
        assert_eq!(Files::shipped().read(path).unwrap(), *bytes);
        assert_eq!(Files::shipped().origin(path).unwrap(), Origin::Shipped);
    }
}

#[test]
fn the_project_hides_shipped_files_of_the_same_path() {
    let (folder, files) = project();
    let path = "scripts/pipelines/forward.rhai";
    assert_eq!(files.read_text(path).unwrap(), "// shipped");
    assert_eq!(files.origin(path).unwrap(), Origin::Shipped);
    put(&folder, path, "// mine");
    assert_eq!(files.read_text(path).unwrap(), "// mine");
    let on_disk = fs::canonicalize(folder.path()).unwrap().join(path);
    assert_eq!(files.origin(path).unwrap(), Origin::Project(on_disk));
    fs::remove_file(folder.path().join(path)).unwrap();
    assert_eq!(files.read_text(path).unwrap(), "// shipped");
    assert!(files.exists(path) && !files.exists("scripts/none.rhai"));
    let message = files.read("scripts/none.rhai").unwrap_err().to_string();
    assert!(
        message.starts_with("there is no file `scripts/none.rhai`, neither in "),
        "{message}"
    );
}

#[test]
fn editing_copies_once_and_never_overwrites() {
    let (folder, files) = project();
    let path = "shaders/lib/surface.wgsl";
    let copy = files.copy_to_project(path).unwrap();
    assert_eq!(copy, fs::canonicalize(folder.path()).unwrap().join(path));
    assert_eq!(fs::read_to_string(&copy).unwrap(), "// surface");
    fs::write(&copy, "// edited").unwrap();
    assert_eq!(files.copy_to_project(path).unwrap(), copy);
    assert_eq!(files.read_text(path).unwrap(), "// edited");
    assert!(matches!(
        files.copy_to_project("shaders/none.wgsl"),
        Err(FileError::NotFound { .. })
    ));
    // Not even the folder of a file that is nowhere is made.
    assert!(!folder.path().join("nowhere").exists());
    assert!(files.copy_to_project("nowhere/x.wgsl").is_err());
    assert!(!folder.path().join("nowhere").exists());
    let message = Files::shipped()
        .copy_to_project(path)
        .unwrap_err()
        .to_string();
    assert!(message.contains("lightbench new DIR"), "{message}");
}

#[test]
fn lists_are_merged_sorted_and_know_their_origin() {
    let (folder, files) = project();
    put(&folder, "scripts/pipelines/forward.rhai", "");
    put(&folder, "scripts/pipelines/ñandú/mine.RHAI", "");
    put(&folder, "scripts/pipelines/.hidden.rhai", "");
    put(&folder, "scripts/pipelines/notes.txt", "");
    put(&folder, "scripts/pipelines_old/x.rhai", "");
    let listed = files.list("scripts/pipelines", "rhai").unwrap();
    let paths: Vec<&str> = listed.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "scripts/pipelines/forward.rhai",
            "scripts/pipelines/ñandú/mine.RHAI"
        ]
    );
    assert!(
        listed
            .iter()
            .all(|file| matches!(file.origin, Origin::Project(_)))
    );
    let all = files.list("scripts", "").unwrap();
    let origins: Vec<bool> = all
        .iter()
        .map(|file| file.origin == Origin::Shipped)
        .collect();
    assert_eq!(origins, [false, false, false, false, true]);
    assert_eq!(files.list("lessons", "md").unwrap(), []);
    assert!(files.list("../x", "").is_err());
}

#[test]
fn text_keeps_its_line_numbers() {
    let (folder, files) = project();
    put(&folder, "a.txt", "\u{feff}one\r\ntwo\rthree\n\r\nfive ñ");
    assert_eq!(
        files.read_text("a.txt").unwrap(),
        "one\ntwo\nthree\n\nfive ñ"
    );
    put(&folder, "b.txt", b"one\r\ntwo \xe9\r\n");
    let message = files.read_text("b.txt").unwrap_err().to_string();
    assert_eq!(
        message,
        "b.txt, line 2: this is not UTF-8 text; save the file as UTF-8"
    );
    put(&folder, "empty.txt", "");
    assert_eq!(files.read_text("empty.txt").unwrap(), "");
}

#[test]
fn odd_places_give_clear_errors() {
    let (folder, files) = project();
    fs::create_dir(folder.path().join("shaders")).unwrap();
    let message = files.read("shaders").unwrap_err().to_string();
    assert!(
        message.ends_with("shaders is a folder; name a file in it"),
        "{message}"
    );
    put(&folder, "file", "x");
    assert!(matches!(
        files.read("file/below"),
        Err(FileError::NotFound { .. })
    ));
    let message = files.write("file/below", b"x").unwrap_err().to_string();
    assert!(message.contains("file"), "{message}");
    assert!(matches!(
        files.read("../secret"),
        Err(FileError::BadPath { .. })
    ));
    assert!(matches!(
        files.write("../secret", b""),
        Err(FileError::BadPath { .. })
    ));
    assert!(matches!(
        files.write("/tmp/secret", b""),
        Err(FileError::BadPath { .. })
    ));
    assert!(Files::with_project(folder.path().join("file")).is_err());
    let message = Files::with_project(folder.path().join("no"))
        .unwrap_err()
        .to_string();
    assert!(
        message.ends_with("no: there is no such file or folder"),
        "{message}"
    );
}

#[cfg(unix)]
#[test]
fn no_link_leads_out() {
    use std::os::unix::fs::symlink;
    let (folder, files) = project();
    let outside = tempfile::tempdir().unwrap();
    fs::write(outside.path().join("secret.txt"), "secret").unwrap();
    symlink(
        outside.path().join("secret.txt"),
        folder.path().join("link.txt"),
    )
    .unwrap();
    symlink(outside.path(), folder.path().join("scripts")).unwrap();
    for path in ["link.txt", "scripts/secret.txt"] {
        let error = files.read(path).unwrap_err();
        assert!(matches!(error, FileError::Escapes { .. }), "{error}");
        assert!(!files.exists(path));
    }
    for path in ["link.txt", "scripts/new.txt", "scripts/deep/new.txt"] {
        let error = files.write(path, b"x").unwrap_err();
        assert!(matches!(error, FileError::Escapes { .. }), "{error}");
    }
    assert!(files.copy_to_project("scripts/scenes/atrium.rhai").is_err());
    let listed = files.list("scripts", "").unwrap();
    assert!(listed.iter().all(|file| file.origin == Origin::Shipped));
    assert_eq!(
        fs::read_to_string(outside.path().join("secret.txt")).unwrap(),
        "secret"
    );
    assert_eq!(fs::read_dir(outside.path()).unwrap().count(), 1);
    // A link that stays inside is fine, and one that leads nowhere is no file.
    put(&folder, "real.txt", "inside");
    symlink("real.txt", folder.path().join("near.txt")).unwrap();
    assert_eq!(files.read_text("near.txt").unwrap(), "inside");
    symlink("gone", folder.path().join("dangling.txt")).unwrap();
    assert!(!files.exists("dangling.txt"));
    assert!(files.write("dangling.txt", b"x").is_err());
}

#[test]
fn granted_files_bring_what_lies_beside_them() {
    let (folder, mut files) = project();
    let outside = tempfile::Builder::new()
        .prefix("modelos ñ")
        .tempdir()
        .unwrap();
    put(&outside, "teapot.obj", "v");
    put(&outside, "maps/wood.png", "png");
    put(&outside, "other.obj", "w");
    let path = files.grant(outside.path().join("teapot.obj")).unwrap();
    assert_eq!(path, "@0/teapot.obj");
    assert_eq!(files.read(&path).unwrap(), b"v");
    assert_eq!(
        files.read(&join(&path, "maps/wood.png").unwrap()).unwrap(),
        b"png"
    );
    assert_eq!(
        files.grant(outside.path().join("other.obj")).unwrap(),
        "@0/other.obj"
    );
    assert_eq!(files.find_ignoring_case("@0/MAPS/x.png"), None);
    assert_eq!(
        files.find_ignoring_case("@0/TEAPOT.Obj").as_deref(),
        Some("@0/teapot.obj")
    );
    let message = files.read("@0/gone.mtl").unwrap_err().to_string();
    assert!(
        message.starts_with("there is no file `gone.mtl`, in "),
        "{message}"
    );
    let shown = fs::canonicalize(outside.path()).unwrap().join("teapot.obj");
    assert_eq!(files.display(&path), shown.display().to_string());
    assert!(files.read("@0/../x").is_err() && files.read("@1/x").is_err());
    assert!(files.grant(outside.path().join("gone.obj")).is_err());
    assert!(
        files
            .grant(outside.path())
            .is_ok_and(|path| files.read(&path).is_err())
    );
    assert!(files.write(&path, b"changed").is_err() && !folder.path().join("@0").exists());
    // A file of the project keeps its usual path.
    put(&folder, "models/x.obj", "v");
    assert_eq!(
        files.grant(folder.path().join("models/x.obj")).unwrap(),
        "models/x.obj"
    );
    assert_eq!(files.display("models/x.obj"), "models/x.obj");
}

#[test]
fn a_new_project_is_found_from_below() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("práctica 1 ñ");
    let project = create_project(&path).unwrap();
    assert!(project.join("scripts/scenes").is_dir() && project.join("out").is_dir());
    assert!(
        fs::read_to_string(project.join("README.md"))
            .unwrap()
            .contains("lightbench edit")
    );
    assert_eq!(
        find_project(project.join("scripts/scenes")).unwrap(),
        project
    );
    assert_eq!(find_project(folder.path()), None);
    let message = create_project(&path).unwrap_err().to_string();
    assert!(message.contains("is not empty (it has `"), "{message}");
    fs::write(folder.path().join("file"), "").unwrap();
    assert!(matches!(
        create_project(folder.path().join("file")),
        Err(FileError::NotAFolder { .. })
    ));
    fs::create_dir(folder.path().join("empty")).unwrap();
    create_project(folder.path().join("empty")).unwrap();
}

#[test]
fn writing_is_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ñ.json");
    write_atomic(&path, b"first, and longer").unwrap();
    write_atomic(&path, b"second").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"second");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    assert!(matches!(
        write_atomic(folder.path(), b""),
        Err(FileError::IsAFolder { .. })
    ));
    let message = write_atomic(folder.path().join("no/x"), b"")
        .unwrap_err()
        .to_string();
    assert!(
        message.ends_with("no: there is no such file or folder"),
        "{message}"
    );
    #[cfg(unix)]
    {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        let plain = folder.path().join("plain");
        fs::write(&plain, "").unwrap();
        assert_eq!(mode(&path), mode(&plain), "as any new file");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("ñ.json", folder.path().join("link")).unwrap();
        write_atomic(folder.path().join("link"), b"third").unwrap();
        assert_eq!(
            (fs::read(&path).unwrap().as_slice(), mode(&path)),
            (&b"third"[..], 0o640)
        );
        write_atomic("/dev/null", b"gone").unwrap();
        let message = write_atomic("/proc/none", b"").unwrap_err().to_string();
        assert!(message.starts_with("/proc"), "{message}");
    }
}

#[cfg(unix)]
#[test]
fn a_full_disk_and_a_forbidden_folder_are_told_in_plain_words() {
    let message = write_atomic("/dev/full", b"x").unwrap_err().to_string();
    assert_eq!(
        message,
        "/dev/full: the disk is full; make room or choose another place"
    );
    let folder = tempfile::tempdir().unwrap();
    let error = FileError::io(folder.path(), std::io::ErrorKind::PermissionDenied.into());
    assert!(
        error
            .to_string()
            .ends_with("permission denied; change its permissions or choose another place")
    );
}

#[cfg(unix)]
#[test]
fn pipes_are_refused_before_they_block() {
    let (folder, files) = project();
    let pipe = folder.path().join("pipe.rhai");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(
        made.is_ok_and(|status| status.success()),
        "mkfifo belongs to every Unix"
    );
    assert!(matches!(
        files.read("pipe.rhai"),
        Err(FileError::NotAFile { .. })
    ));
    assert!(matches!(read_path(&pipe), Err(FileError::NotAFile { .. })));
}
