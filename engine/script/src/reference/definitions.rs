//! Definition files: what text editors that know Rhai read to complete and explain names.
//!
//! The syntax is Rhai's own for such files (The Rhai Book, "Definition Files"): `module static;`,
//! comments with three strokes, and functions without bodies. A method is a function whose first
//! argument is its object; `fn get name(…)` and `fn set name(…)` are a property.

use std::fmt::Write as _;

use lightbench_assets::files::Files;

use super::api::example;
use super::functions::wrapped;
use super::probe::PATH;
use crate::experiment::experiment_names;
use crate::limits::Limits;
use crate::names::{Entry, Names};
use crate::pipeline::Workshop;
use crate::scene::scene_names;
use crate::settings::Settings;

/// The definitions of one kind of script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definitions {
    /// The name of the file.
    pub file: &'static str,
    /// What stands in it.
    pub text: String,
}

/// The definition files of all kinds of scripts.
#[must_use]
pub fn definitions() -> Vec<Definitions> {
    let scenes = scene_names();
    let workshop = Workshop::new(
        &Files::shipped(),
        PATH,
        &Settings::new(),
        &Limits::default(),
    );
    let state = "/// What the script remembers from one call to the next.\nconst state: state;\n";
    let me = "/// The entity that has the behaviour.\nconst me: entity;\n";
    [
        ("scene.d.rhai", "scene scripts", state.to_owned(), &scenes),
        (
            "behaviour.d.rhai",
            "behaviours",
            format!("{me}\n{state}"),
            &scenes,
        ),
        (
            "pipeline.d.rhai",
            "pipeline files",
            String::new(),
            workshop.names(),
        ),
        (
            "experiment.d.rhai",
            "experiments",
            String::new(),
            &experiment_names(),
        ),
    ]
    .into_iter()
    .map(|(file, what, variables, names)| Definitions {
        file,
        text: text(what, &variables, names),
    })
    .collect()
}

fn text(what: &str, variables: &str, names: &Names) -> String {
    let mut text = format!(
        "// What {what} can use, for text editors that know Rhai.\n\
         // Written by `lightbench docs definitions`.\n\nmodule static;\n"
    );
    if !variables.is_empty() {
        text += &format!("\n{variables}");
    }
    let mut written: Vec<String> = Vec::new();
    for entry in names.entries() {
        // Scripts have no files with textures to name.
        if entry.section == "Saved scenes" {
            continue;
        }
        let declared = declaration(names, entry);
        if written.contains(&declared) {
            continue;
        }
        text.push('\n');
        for line in about(names, entry).lines() {
            let line = format!("/// {line}");
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text += &declared;
        text.push('\n');
        written.push(declared);
        if entry.property && names.is_settable(entry) {
            let (name, receiver) = (&entry.name, entry.receiver.unwrap_or_default());
            let kind = names.given_by(entry);
            for line in about(names, entry).lines() {
                let line = format!("/// {line}");
                let _ = writeln!(text, "{}", line.trim_end());
            }
            let _ = writeln!(
                text,
                "fn set {name}({receiver}: {receiver}, value: {kind}) -> ();"
            );
        }
    }
    text
}

/// The text of a function, with a call that shows it.
fn about(names: &Names, entry: &Entry) -> String {
    let mut text = wrapped(entry.about);
    if let Some(example) = example(names, entry) {
        let _ = write!(text, "\n```rhai\n{}\n```\n", example.replace("; ", ";\n"));
    }
    text
}

fn declaration(names: &Names, entry: &Entry) -> String {
    let mut arguments: Vec<String> = Vec::new();
    if let Some(receiver) = entry.receiver {
        arguments.push(format!("{receiver}: {receiver}"));
    }
    for argument in &entry.arguments {
        let kind = takes(entry, argument);
        // Words that Rhai keeps can't name an argument.
        let argument = match argument.as_str() {
            "default" => "default_value",
            name if Some(name) == entry.receiver => "other",
            name => name,
        };
        arguments.push(format!("{argument}: {kind}"));
    }
    let gives = names.given_by(entry);
    let accessor = if entry.property { "get " } else { "" };
    let (name, arguments) = (&entry.name, arguments.join(", "));
    format!("fn {accessor}{name}({arguments}) -> {gives};")
}

/// Arguments whose type their name alone does not tell: with the function that takes them.
const OF_FUNCTIONS: [(&str, &str); 18] = [
    ("fov.degrees", "float"),
    ("order.order", "String"),
    ("view_from.eye", "vec3"),
    ("with.value", "?"),
    ("decimals.value", "float"),
    ("plot.value", "?"),
    ("pick.origin", "vec3"),
    ("turn.axis", "vec3"),
    ("near.point", "vec3"),
    ("near.metres", "float"),
    ("stencil_write.pass", "String"),
    ("material.material", "material"),
    ("mesh.mesh", "?"),
    ("choice.options", "Array"),
    ("faces.faces", "String"),
    ("per_tile.size", "int"),
    ("repeat_for_lights.count", "int"),
    ("array.layers", "int"),
];

/// Arguments by type.
const BY_NAME: [(&str, &[&str]); 8] = [
    (
        "String",
        &[
            "ability",
            "about",
            "buffer",
            "channels",
            "compare",
            "component",
            "counter",
            "depth_fail",
            "description",
            "destination",
            "fail",
            "field",
            "format",
            "from",
            "key",
            "list",
            "message",
            "mode",
            "name",
            "operation",
            "parameter",
            "path",
            "pattern",
            "pipeline",
            "reason",
            "reduction",
            "scene",
            "scheme",
            "source",
            "tag",
            "text",
            "title",
            "to",
            "unit",
            "variable",
            "which",
        ],
    ),
    (
        "float",
        &[
            "across",
            "all",
            "along",
            "alpha",
            "angle",
            "blue",
            "constant",
            "crease",
            "degrees",
            "deviation",
            "exponent",
            "factor",
            "far",
            "green",
            "hue",
            "inner",
            "length",
            "max",
            "mean",
            "metres",
            "min",
            "near",
            "outer",
            "period",
            "power",
            "radians",
            "radius",
            "red",
            "right",
            "down",
            "roughness",
            "saturation",
            "seconds",
            "share",
            "slope",
            "strength",
            "temperature",
            "tube",
            "x",
            "y",
            "z",
        ],
    ),
    (
        "int",
        &[
            "around",
            "count",
            "from_layer",
            "from_mip",
            "hex",
            "index",
            "level",
            "lights",
            "mip",
            "number",
            "octaves",
            "pixels",
            "read",
            "reference",
            "seed",
            "squares",
            "times",
            "to_layer",
            "to_mip",
            "up",
            "word",
            "words",
            "write",
        ],
    ),
    ("bool", &["condition", "on"]),
    ("Array", &["array", "corners", "keys", "points"]),
    ("Map", &["options", "values"]),
    (
        "vec3",
        &["by", "direction", "eye", "offset", "origin", "vector"],
    ),
    ("entity", &["entity"]),
];

/// The type of an argument, as far as its name tells; `?` where several are taken.
fn takes(entry: &Entry, argument: &str) -> &'static str {
    let here = format!("{}.{argument}", entry.name);
    if let Some((_, kind)) = OF_FUNCTIONS.iter().find(|(known, _)| *known == here) {
        return kind;
    }
    // The same words mean numbers where a row of random numbers is meant.
    if entry.receiver == Some("random") && ["from", "to"].contains(&argument) {
        return "float";
    }
    let mut kinds = BY_NAME.iter();
    kinds
        .find(|(_, names)| names.contains(&argument))
        .map_or("?", |(kind, _)| kind)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// One declaration: whether it is a property's, its name, and its arguments with their types.
    fn parse(line: &str) -> (String, Vec<(String, String)>, String) {
        let word = |text: &str| {
            !text.is_empty()
                && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
                && !text.starts_with(|c: char| c.is_ascii_digit())
        };
        let is_type = |text: &str| word(text) || text == "?" || text == "()";
        let rest = line.strip_prefix("fn ").unwrap();
        let (head, rest) = rest.split_once('(').unwrap();
        let (arguments, gives) = rest.rsplit_once(") -> ").unwrap();
        let gives = gives.strip_suffix(';').unwrap();
        assert!(is_type(gives), "{line}");
        let name = head.rsplit(' ').next().unwrap();
        assert!(word(name), "{line}");
        assert!(["", "get ", "set "].contains(&&head[..head.len() - name.len()]));
        let arguments: Vec<(String, String)> = arguments
            .split(", ")
            .filter(|argument| !argument.is_empty())
            .map(|argument| {
                let (name, kind) = argument.split_once(": ").unwrap();
                assert!(word(name) && is_type(kind), "{line}");
                (name.to_owned(), kind.to_owned())
            })
            .collect();
        for (at, (name, _)) in arguments.iter().enumerate() {
            let twice = arguments[..at].iter().any(|(other, _)| other == name);
            assert!(!twice, "two arguments of one name: {line}");
        }
        (head.to_owned(), arguments, gives.to_owned())
    }

    #[test]
    fn every_function_is_declared_with_its_text() {
        let scenes = scene_names();
        let experiments = experiment_names();
        let workshop = Workshop::new(
            &Files::shipped(),
            PATH,
            &Settings::new(),
            &Limits::default(),
        );
        let all = definitions();
        let names = [&scenes, &scenes, workshop.names(), &experiments];
        for (Definitions { file, text }, names) in all.iter().zip(names) {
            assert!(text.contains("\nmodule static;\n"), "{file}");
            let lines: Vec<&str> = text.lines().collect();
            let mut declared = Vec::new();
            for (at, line) in lines.iter().enumerate() {
                if line.starts_with("fn ") {
                    declared.push(parse(line));
                    assert!(
                        lines[at - 1].starts_with("///"),
                        "{file}: {line} has no text"
                    );
                } else {
                    let known = ["///", "//", "const ", "module static;"];
                    let known = line.is_empty() || known.iter().any(|k| line.starts_with(k));
                    assert!(known, "{file}: {line}");
                }
            }
            for entry in names.entries() {
                if entry.section == "Saved scenes" {
                    continue;
                }
                let count = entry.arguments.len() + usize::from(entry.receiver.is_some());
                let fits = |(head, arguments, _): &(String, Vec<(String, String)>, String)| {
                    let name = head.rsplit(' ').next().unwrap();
                    let property = head.contains(' ');
                    let of = arguments.first().map(|(_, kind)| kind.as_str());
                    name == entry.name
                        && property == entry.property
                        && (property || arguments.len() == count)
                        && (entry.receiver.is_none() || of == entry.receiver)
                };
                assert!(declared.iter().any(fits), "{file}: {}", entry.form());
            }
        }
    }

    /// What the types say, for one of each sort.
    #[test]
    fn types_are_those_that_are_taken_and_given() {
        let all = definitions();
        let [scene, behaviour, pipeline, experiment] = all.as_slice() else {
            panic!("{} files", all.len());
        };
        for (file, line) in [
            (scene, "fn entity(name: String) -> entity;"),
            (
                scene,
                "fn at(entity: entity, x: float, y: float, z: float) -> entity;",
            ),
            (scene, "fn get position(entity: entity) -> vec3;"),
            (scene, "fn set position(entity: entity, value: vec3) -> ();"),
            (scene, "fn values(name: String) -> Array;"),
            (scene, "fn float(random: random) -> float;"),
            (scene, "fn has_entity(name: String) -> bool;"),
            (scene, "const state: state;"),
            (behaviour, "const me: entity;"),
            (behaviour, "fn broadcast(name: String, value: ?) -> ();"),
            (pipeline, "fn pipeline(title: String) -> pipeline;"),
            (
                pipeline,
                "fn number(pipeline: pipeline, name: String, default_value: ?, min: float, max: float) -> ?;",
            ),
            (experiment, "fn get width(frame: frame) -> int;"),
            (
                experiment,
                "fn draw(scene: String, pipeline: String, options: Map) -> frame;",
            ),
        ] {
            let known = file.text.lines().any(|known| known == line);
            let name = line.split('(').next().unwrap();
            let near: Vec<&str> = file.text.lines().filter(|l| l.starts_with(name)).collect();
            assert!(known, "{}: {line}\n{near:?}", file.file);
        }
        assert!(!scene.text.contains("const me"));
    }

    /// Names in the tables that no function has any more.
    #[test]
    fn the_tables_name_arguments_that_there_are() {
        let workshop = Workshop::new(
            &Files::shipped(),
            PATH,
            &Settings::new(),
            &Limits::default(),
        );
        let (scenes, experiments) = (scene_names(), experiment_names());
        let entries: Vec<&Entry> = [&scenes, workshop.names(), &experiments]
            .into_iter()
            .flat_map(Names::entries)
            .collect();
        let gone = |known: &str, of_function: bool| {
            !entries.iter().any(|entry| {
                entry.arguments.iter().any(|argument| match of_function {
                    true => format!("{}.{argument}", entry.name) == known,
                    false => argument == known,
                })
            })
        };
        let mut stale: Vec<&str> = Vec::new();
        stale.extend(
            OF_FUNCTIONS
                .iter()
                .map(|(known, _)| *known)
                .filter(|k| gone(k, true)),
        );
        for (_, names) in BY_NAME {
            stale.extend(names.iter().filter(|name| gone(name, false)));
        }
        assert!(stale.is_empty(), "{stale:?}");
    }
}
