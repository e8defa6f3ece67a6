//! A small study, and what is fixed in its results.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

/// Two points of two pipelines, each measured by two processes.
pub const STUDY: [&str; 14] = [
    "compare",
    "tiny",
    "--pipelines",
    "forward_single_pass,clustered_deferred",
    "--sweep",
    "light=2,8",
    "--size",
    "48x27",
    "--frames",
    "2",
    "--processes",
    "2",
    "--warmup",
    "1",
];

pub fn study<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&STUDY[..], &["--out", out], more].concat()
}

pub fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// What must be the same however a study was measured: of each pipeline at each point the bytes of its
/// picture, and every count of its first frame.
pub fn fixed(out: &Path) -> BTreeMap<String, String> {
    let report = json(&out.join("report.json"));
    let mut found = BTreeMap::new();
    for point in report["points"].as_array().unwrap() {
        for pipeline in point["comparison"]["pipelines"].as_array().unwrap() {
            let picture = fs::read(out.join(pipeline["picture_file"].as_str().unwrap())).unwrap();
            let passes: Vec<String> = pipeline["passes"]
                .as_array()
                .unwrap()
                .iter()
                .map(|pass| {
                    format!(
                        "{} {} {}",
                        pass["draws"], pass["triangles"], pass["bytes_written"]
                    )
                })
                .collect();
            let counters: Vec<String> = pipeline["counters"]
                .as_array()
                .unwrap()
                .iter()
                .map(|counter| format!("{} {}", counter["name"], counter["values"][0]))
                .collect();
            found.insert(
                format!("{} {}", point["key"], pipeline["name"]),
                format!(
                    "{picture:?} {passes:?} {counters:?} {}",
                    pipeline["difference"]
                ),
            );
        }
    }
    found
}
