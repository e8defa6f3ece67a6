//! A browser without a window.

use std::path::Path;
use std::process::Command;

/// Names under which it is installed.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// Opens a page and gives the document as it is in the end, and what the browser wrote of errors;
/// `None` where no browser is installed.
pub fn open(page: &Path) -> Option<(String, String)> {
    let profile = tempfile::tempdir().unwrap();
    for name in NAMES {
        let output = Command::new(name)
            .args([
                "--headless",
                "--disable-gpu",
                "--no-sandbox",
                "--no-first-run",
                "--enable-logging=stderr",
                "--virtual-time-budget=600000",
                "--window-size=1280,900",
            ])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("--dump-dom")
            .arg(format!("file://{}", page.display()))
            .output();
        let Ok(output) = output else { continue };
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        return Some((text(output.stdout), text(output.stderr)));
    }
    None
}
