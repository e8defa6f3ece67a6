#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::path::Path;

use lightbench_assets::files::Files;

use super::abilities::{HEADINGS, header};
use super::functions::functions;
use super::pipelines::{EXAMPLES, KINDS};
use super::probe::{Probe, default_said};
use super::*;

/// The committed copy of a page.
fn copy(page: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let text = std::fs::read_to_string(folder.join(page)).unwrap_or_default();
    text.replace("\r\n", "\n")
}

fn same(page: &str, made: &str, command: &str) {
    let copy = copy(page);
    if copy == made {
        return;
    }
    let lines = copy.lines().zip(made.lines());
    let first = lines.take_while(|(copy, made)| copy == made).count();
    panic!(
        "engine/script/docs/{page} is old from line {} on:\n  it has  {}\n  now it is {}\nmake it \
         again with `{command} --out engine/script/docs/{page}`",
        first + 1,
        copy.lines().nth(first).unwrap_or("nothing"),
        made.lines().nth(first).unwrap_or("nothing"),
    );
}

#[test]
fn the_copies_are_what_is_made_now() {
    let files = Files::shipped();
    same(
        "pipelines.md",
        &pipelines(&files).unwrap(),
        "lightbench docs pipelines",
    );
    same("api.md", &api(), "lightbench docs api");
    same(
        "abilities.md",
        &abilities(&files).unwrap(),
        "lightbench docs abilities",
    );
    same(
        "experiments.md",
        &experiments(),
        "lightbench docs experiments",
    );
    same("checks.md", &checks(), "lightbench docs checks");
    same(
        "shaders.md",
        &shaders(&files).unwrap(),
        "lightbench docs shaders",
    );
}

#[test]
fn every_kind_of_pass_is_explained_and_has_an_example() {
    let probe = Probe::new();
    let kinds: BTreeSet<&str> = probe.kinds().collect();
    let told: BTreeSet<&str> = KINDS.iter().map(|(kind, _)| *kind).collect();
    let untold: Vec<_> = kinds.difference(&told).collect();
    assert!(
        untold.is_empty(),
        "write engine/script/src/reference/prose/kinds/KIND.txt for {untold:?}, name it in \
         reference/pipelines.rs, and write {EXAMPLES}/KIND.rhai"
    );
    assert_eq!(kinds, told, "a kind is gone");
    for (kind, prose) in KINDS {
        let example = format!("{EXAMPLES}/{kind}.rhai");
        let text = Files::shipped().read_text(&example).unwrap();
        assert!(
            text.contains(&format!("p.{kind}(")),
            "{example} has no `{kind}` pass"
        );
        let mut parts = vec!["**Needs**", "**May not have**", "**Bytes**"];
        if text.contains(&format!("p.{kind}(\"")) && prose.contains("_main") {
            parts.push("**The shader sees**");
        }
        for part in parts {
            assert!(prose.contains(part), "{kind} does not tell {part}");
        }
    }
}

#[test]
fn every_function_is_documented_and_understood() {
    let probe = Probe::new();
    let names = probe.entries();
    assert!(names.len() > 80, "{} functions", names.len());
    for entry in names {
        let form = entry.form();
        assert!(
            entry.about.ends_with('.') && entry.about.len() > 10,
            "`{form}` has no text"
        );
        let findings = probe.findings(&entry);
        let understood: Vec<&str> = findings
            .arguments
            .iter()
            .filter(|argument| !argument.takes.is_empty())
            .map(|argument| argument.name.as_str())
            .collect();
        assert_eq!(understood, entry.arguments, "the arguments of `{form}`");
        if let Some(said) = default_said(entry.about) {
            assert_eq!(
                findings.default.as_deref(),
                Some(said),
                "`{form}` says that {said} is the default, but calling it so changes something"
            );
        }
        if entry.receiver == Some("pass") {
            assert!(!findings.kinds.is_empty(), "no pass takes `{form}`");
        }
    }
}

/// What a student reads of a function, for one of each sort.
#[test]
fn ranges_choices_defaults_and_messages_are_those_of_the_program() {
    let probe = Probe::new();
    let functions = functions(&probe);
    let text = |name: &str| {
        let found = functions.iter().find(|f| f.short() == name).unwrap();
        found.markdown(&probe)
    };
    for (name, part) in [
        (
            ".threshold",
            "- `share`: a number from 0 to 10\n- default: `0.2`\n",
        ),
        (".arrays", "- `count`: a whole number from 0 to 32\n"),
        (
            ".draws",
            "- `list`: `opaque`, `transparent`, `all` or `casters`\n- default: `\"opaque\"`\n",
        ),
        (".volumes", "- `on`: `true` or `false`\n- default: `true`\n"),
        (
            ".reads",
            "- passes: `geometry`, `lights`, `shadow`, `fullscreen`, `compute`\n",
        ),
        (
            ".updates",
            "- passes: `geometry`, `lights`, `shadow`, `fullscreen`, `compute`, `clear`\n",
        ),
        (".faces", "- passes: `geometry`, `shadow`\n"),
        (
            ".view_from",
            "- `eye`: a vec3\n- `target`: a vec3\n- `degrees`: a number from 1 to 170\n\
             - `near`: a number from 0.0001 to 1000000\n",
        ),
        (
            ".near",
            "- `metres`: a number from 0.0001 to 1000\n- default: `0.05`\n",
        ),
        (
            ".shader",
            "the pass has a shader already, `shaders/output.wgsl`\n",
        ),
        (
            "p.target",
            "there is no format `?`\n    help: there are r8unorm",
        ),
        (
            "p.choice",
            "### `p.choice(name, options)`, `p.choice(name, options, default)`\n",
        ),
    ] {
        assert!(
            text(name).contains(part),
            "{name}: no {part} in {}",
            text(name)
        );
    }
    let kind = |name: &str| {
        let found = functions.iter().find(|f| f.short() == name).unwrap();
        found.only_kind().map(str::to_owned)
    };
    assert_eq!(kind("p.copy_slice").as_deref(), Some("copy"));
    assert_eq!(kind(".draws").as_deref(), Some("geometry"));
    assert_eq!(kind(".box_from").as_deref(), Some("shadow"));
    assert_eq!(kind(".blend"), None);
    assert_eq!(kind("p.target"), None);
}

/// A mistake that the program takes would stand on the page without a message.
#[test]
fn every_mistake_of_the_page_is_one() {
    let page = pipelines(&Files::shipped()).unwrap();
    assert!(page.matches("```text\n").count() > 60);
    assert!(!page.contains("```text\n\n```"), "a mistake has no message");
    assert!(!page.contains("```rhai mistake"), "a block is left over");
}

/// What a script declares with `fn` is on the page, with a comment.
#[test]
fn every_function_of_a_part_is_explained() {
    let files = Files::shipped();
    let page = pipelines(&files).unwrap();
    let listed = files.list(parts::FOLDER, "rhai").unwrap();
    assert!(listed.len() >= 8);
    for file in listed {
        let text = files.read_text(&file.path).unwrap();
        assert!(text.starts_with("// "), "{} has no header", file.path);
        let functions = parts::functions(&text);
        let declared = text.matches("\nfn ").count();
        assert_eq!(functions.len(), declared, "{}", file.path);
        let part = file.path[parts::FOLDER.len() + 1..].trim_end_matches(".rhai");
        for (form, about) in functions {
            assert!(about.ends_with('.'), "{}: `{form}` has no text", file.path);
            let form = format!("`{part}::{form}`");
            let joined = page.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(joined.contains(&format!("- {form}: {about}")), "{form}");
        }
    }
}

#[test]
fn the_readme_names_every_pipeline() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md");
    let readme = std::fs::read_to_string(readme).unwrap();
    let pipelines = Files::shipped().list("scripts/pipelines", "rhai").unwrap();
    let names = pipelines.iter().filter_map(|file| {
        let name = file.path.strip_prefix("scripts/pipelines/")?;
        name.strip_suffix(".rhai")
            .filter(|name| !name.contains('/'))
    });
    let names: Vec<&str> = names.collect();
    assert!(names.len() >= 13);
    for name in names {
        let mut rows = readme.lines().filter(|line| line.starts_with("| `"));
        let quoted = format!("`{name}`");
        assert!(
            rows.any(|row| row
                .split('|')
                .nth(1)
                .is_some_and(|cell| cell.contains(&quoted))),
            "README.md has no line for {name}"
        );
    }
}

/// All that shaders get by declaring it stands in the table, as it is written in WGSL.
#[test]
fn every_sampler_and_engine_buffer_is_explained() {
    let page = pipelines(&Files::shipped()).unwrap();
    for thing in lightbench_render::binding::provided() {
        let row = format!("| `{}` | {} |", thing.declaration, thing.about);
        assert!(page.contains(&row), "{row}");
        assert!(!thing.about.is_empty());
    }
}

#[test]
fn every_format_is_explained() {
    let page = pipelines(&Files::shipped()).unwrap();
    for name in lightbench_render::Format::names() {
        assert!(page.contains(&format!("| `{name}` | ")), "{name}");
    }
}

#[test]
fn modules_are_read_as_they_are_written() {
    let files = Files::shipped();
    let page = shaders(&files).unwrap();
    for file in files.list("shaders/lib", "wgsl").unwrap() {
        let text = files.read_text(&file.path).unwrap();
        let functions = text.lines().filter_map(|line| line.strip_prefix("fn "));
        for function in functions {
            let name = function.split('(').next().unwrap();
            assert!(
                page.contains(&format!("fn {name}(")),
                "{} {name}",
                file.path
            );
        }
        let structures = text.lines().filter(|line| line.starts_with("struct "));
        for line in structures {
            assert!(page.contains(line), "{} {line}", file.path);
        }
    }
    assert!(
        !page.contains("\n    return ") && !page.contains("\n    let "),
        "bodies are left out"
    );
    assert!(
        page.contains("#ifdef DEPTH\n#ifdef SAMPLES\n@group(0)"),
        "what is declared in one variant alone is marked"
    );
    let lines = |start: &str| page.lines().filter(|line| line.starts_with(start)).count();
    assert_eq!(lines("#if"), lines("#endif"));
    let all: Vec<&str> = page.lines().filter(|line| !line.is_empty()).collect();
    let empty = |pair: &&[&str]| pair[0].starts_with("#if") && pair[1].starts_with("#endif");
    assert!(!all.windows(2).any(|pair| empty(&pair)));
}

#[test]
fn every_shipped_pipeline_says_what_it_trades_needs_and_is_for() {
    let files = Files::shipped();
    for pipeline in crate::list_pipelines(&files).unwrap() {
        let script = files.read_text(&pipeline.path).unwrap();
        let header = header(&script);
        let found: Vec<&str> = header
            .headings
            .iter()
            .map(|(heading, _)| *heading)
            .collect();
        assert_eq!(found, HEADINGS, "{}", pipeline.path);
        assert!(!header.paragraphs.is_empty(), "{}", pipeline.path);
        for (heading, said) in &header.headings {
            assert!(said.ends_with('.'), "{} {heading}: {said}", pipeline.path);
        }
        let memory = &header.headings[1].1;
        assert!(memory.contains("bytes a pixel"), "{}", pipeline.path);
    }
}

#[test]
fn every_function_of_scenes_has_a_text_and_an_example() {
    let mut missing = Vec::new();
    let names = crate::scene_names();
    for entry in names.entries() {
        // The files of these are too large for a line; tests of models read some.
        let of_files = ["load_gltf", "model_texture"];
        if of_files.contains(&entry.name.as_str()) || entry.section == "Saved scenes" {
            continue;
        }
        // The writing of a property stands beside its reading.
        if entry.about.is_empty() && !entry.property {
            missing.push(format!("{} has no text", entry.form()));
        }
        if super::api::example(&names, entry).is_none() {
            missing.push(format!(
                "{:?}{} has no example",
                entry.receiver,
                entry.form()
            ));
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn examples_that_need_files_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let shipped = Files::with_project(folder).unwrap();
    let spin = shipped.read_text("scripts/behaviours/spin.rhai").unwrap();
    for call in super::calls::OTHER_CALLS {
        let (before, last) = call.rsplit_once("; ").unwrap_or(("", call));
        let text = format!("{before};\nprint(`${{{last}}}`);");
        let (folder, files) = crate::testing::project(&[
            ("scripts/scenes/test.rhai", &text),
            ("scripts/behaviours/spin.rhai", &spin),
            ("cup.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ]);
        // A picture of one grey pixel, as TGA.
        let mut leaf = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, 0x28];
        leaf.extend([128, 128, 128, 255]);
        std::fs::write(folder.path().join("leaf.tga"), leaf).unwrap();
        let progress = lightbench_assets::Progress::new();
        let loaded = crate::load_scene(&files, "test", &crate::Settings::new(), &progress);
        if let Err(problems) = loaded {
            panic!("{call}\n{problems}");
        }
    }
}
