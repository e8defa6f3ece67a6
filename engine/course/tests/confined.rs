//! A confined process tries what it must not do.
//!
//! It needs a process with a single thread, so this test has its own `main`: with arguments it is the
//! process that is confined, without it starts such processes and looks at what came out.
#![allow(clippy::unwrap_used)]

use std::env;
use std::fs;
use std::net::{TcpListener, TcpStream, UdpSocket};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use lightbench_course::confine::{Confinement, Enforced};

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match &arguments[..] {
        [word, what, folder] if word == "child" => child(what, Path::new(folder)),
        // How test runners list and choose tests.
        [list, ..] if list == "--list" => {
            let ignored = arguments.iter().any(|argument| argument == "--ignored");
            if !ignored {
                println!("a_confined_process_is_confined: test");
            }
        }
        _ => parent(),
    }
}

fn confinement(folder: &Path) -> Confinement {
    Confinement {
        read: vec![folder.join("given")],
        write: vec![folder.join("own")],
        address_space: Some(4 << 30),
        processor_seconds: 2,
        file_bytes: 1 << 20,
    }
}

/// Is confined, tries one thing, and ends with 0 if it could do it.
fn child(what: &str, folder: &Path) {
    let Enforced { not_enforced, .. } = confinement(folder).enforce();
    for line in not_enforced {
        println!("not enforced: {line}");
    }
    let done = match what {
        "read own" => fs::read(folder.join("given/file")).is_ok(),
        "write own" => fs::write(folder.join("own/new"), "x").is_ok(),
        "read other" => fs::read(folder.join("other/secret")).is_ok(),
        "list other" => fs::read_dir(folder.join("other")).is_ok(),
        "write given" => fs::write(folder.join("given/file"), "x").is_ok(),
        "write other" => fs::write(folder.join("other/new"), "x").is_ok(),
        "link" => {
            let link = folder.join("own/link");
            let made = std::os::unix::fs::symlink(folder.join("other/secret"), &link);
            made.is_ok() && fs::read(link).is_ok()
        }
        "connect" => {
            let port = fs::read_to_string(folder.join("given/port")).unwrap();
            TcpStream::connect(("127.0.0.1", port.parse().unwrap())).is_ok()
        }
        "send" => UdpSocket::bind("0.0.0.0:0")
            .and_then(|socket| socket.send_to(b"x", "192.0.2.1:9"))
            .is_ok(),
        "large file" => fs::write(folder.join("own/large"), vec![0; 2 << 20]).is_ok(),
        "spin" => loop {
            std::hint::spin_loop();
        },
        "allocate" => {
            let mut all: Vec<Vec<u8>> = Vec::new();
            loop {
                let mut more = Vec::new();
                if more.try_reserve_exact(1 << 30).is_err() {
                    // Some of it was there, and no more than the limit.
                    break (1..=4).contains(&all.len());
                }
                all.push(more);
            }
        }
        "nothing" => true,
        other => panic!("{other}"),
    };
    std::process::exit(if done { 0 } else { 1 });
}

fn parent() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    for (name, content) in [
        ("given/file", "g"),
        ("other/secret", "s"),
        ("own/mine", "m"),
    ] {
        fs::create_dir_all(root.join(name).parent().unwrap()).unwrap();
        fs::write(root.join(name), content).unwrap();
    }
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    fs::write(root.join("given/port"), port.to_string()).unwrap();
    let program: PathBuf = env::current_exe().unwrap();
    let run = |what: &str| -> Output {
        let mut command = Command::new(&program);
        command.args(["child", what]).arg(root).output().unwrap()
    };

    let quiet = run("nothing");
    let lacking = String::from_utf8(quiet.stdout).unwrap();
    assert!(quiet.status.success());
    // What this kernel can't enforce it must have said; all the rest has to hold.
    let enforces = |what: &str| cfg!(target_os = "linux") && !lacking.contains(what);
    let check = |what: &str, allowed: bool| {
        let output = run(what);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.success(), allowed, "{what}: {text}");
        println!("{what}: {}", if allowed { "allowed" } else { "refused" });
    };
    check("read own", true);
    check("write own", true);
    if enforces("no files outside of its folders") {
        for what in [
            "read other",
            "list other",
            "write given",
            "write other",
            "link",
        ] {
            check(what, false);
        }
    }
    if enforces("no network") {
        check("connect", false);
        check("send", false);
    }
    if cfg!(unix) {
        check("large file", false);
        check("spin", false);
        check("allocate", true);
    }
    if !lacking.is_empty() {
        println!("{lacking}");
    }
}
