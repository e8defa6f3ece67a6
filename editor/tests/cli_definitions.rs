//! `docs definitions`: files for text editors.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;

use cli_support::Project;

#[test]
fn definitions_are_written_into_a_folder_or_printed() {
    let project = Project::new();
    let folder = ".rhai/definitions";
    let written = project
        .run(&["docs", "definitions", "--out", folder])
        .succeeded();
    let mut texts = String::new();
    for file in [
        "scene.d.rhai",
        "behaviour.d.rhai",
        "pipeline.d.rhai",
        "experiment.d.rhai",
    ] {
        assert!(written.stdout.contains(file), "{}", written.all());
        let text = fs::read_to_string(project.file(&format!("{folder}/{file}"))).unwrap();
        assert!(text.contains("module static;"), "{file}");
        texts += &text;
    }
    let printed = project.run(&["docs", "definitions"]).succeeded().stdout;
    assert_eq!(
        texts.lines().filter(|line| line.starts_with("fn ")).count(),
        printed
            .lines()
            .filter(|line| line.starts_with("fn "))
            .count()
    );
    assert!(printed.contains("fn entity(name: String) -> entity;"));
    // A file in the folder's place.
    project
        .run(&["docs", "definitions", "--out", "lightbench.toml"])
        .failed(1, &["--out lightbench.toml"]);
}
