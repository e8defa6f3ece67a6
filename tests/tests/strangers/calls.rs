//! Every function and property, with arguments by lot.

use lightbench::script::{Entry, scene_names};
use lightbench_tests::Numbers;

/// What stands before the call, so that there is something to give to it.
const BEFORE: &str = "let ball = mesh(sphere(1).segments(6, 4));
let clay = material(\"clay\");
let lamp = point_light(\"lamp\");
let cup = spawn(\"cup\").mesh(ball).material(clay).tag(\"old\");
let saucer = spawn(\"saucer\").parent(cup);
let gone = spawn(\"gone\"); gone.remove();
let eye = camera(\"eye\");
let paint = checker_texture(4).size(4);
let way = curve([[0, 1], [2, 5]]);
let column = indices(3);
let points = column_of([vec3(1, 0, 0), vec3(0, 3, 4)]);
let chance = random(1);
";

/// What is given. Most functions want something else.
const VALUES: &[&str] = &[
    "0",
    "1",
    "-1",
    "2",
    "7",
    "2.5",
    "-0.0",
    "0.5",
    "1e308",
    "-1e308",
    "1e-320",
    "0.0 / 0.0",
    "1.0 / 0.0",
    "-1.0 / 0.0",
    "9223372036854775807",
    "-9223372036854775807",
    "1000000000",
    "65536",
    "4294967296",
    "\"\"",
    "\"lamp\"",
    "\"nothing\"",
    "\"light\"",
    "\"light.range\"",
    "\"transform.translation\"",
    "\"spin\"",
    "\"a\\x00b\"",
    "\"../../etc/passwd\"",
    "\"/etc/passwd\"",
    "\"é\\n\\t\"",
    "\"linear\"",
    "\"%s{}\"",
    "'c'",
    "true",
    "false",
    "()",
    "[]",
    "[1, [2, \"x\"]]",
    "[[0, 1], [1, 2]]",
    "[[0, vec3(0, 0, 0)]]",
    "[vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)]",
    "#{}",
    "#{ a: 1 }",
    "#{ range: \"x\" }",
    "gone",
    "lamp",
    "cup",
    "saucer",
    "eye",
    "vec3(0, 0, 0)",
    "vec3(1, 2, 3)",
    "vec3(1e308, 1e308, 1e308)",
    "vec3(1, 0, 0) / 0.0",
    "turn(0, 90, 0)",
    "rgb(1, 0.5, 0)",
    "rgb(0, 0, 0)",
    "chance",
    "sphere(1)",
    "box(1, 1, 1)",
    "ball",
    "clay",
    "paint",
    "entities()",
    "entities().named(\"nobody\")",
    "column",
    "points",
    "indices(0)",
    "|x| x",
    "|u, v| rgb(u, v, 0)",
    "|| throw 1",
    "|u, v| u",
    "0..10",
    "matrix()",
    "scaling(0)",
    "way",
    "state",
];

/// Names of things by the type that a method belongs to.
const RECEIVERS: &[(&str, &[&str])] = &[
    (
        "entity",
        &["cup", "lamp", "saucer", "eye", "gone", "spawn()"],
    ),
    ("mesh", &["ball"]),
    (
        "shape",
        &[
            "sphere(1)",
            "box(1, 2, 3)",
            "cloth(1, 1)",
            "column(1, 3)",
            "arch(1, 2, 1)",
        ],
    ),
    (
        "texture",
        &[
            "paint",
            "stone_texture().size(4)",
            "brick_texture().size(4)",
        ],
    ),
    ("material", &["clay"]),
    (
        "selection",
        &[
            "entities()",
            "entities().with(\"light\")",
            "entities().named(\"nobody\")",
        ],
    ),
    ("column", &["column", "points", "indices(0)"]),
    ("random", &["chance"]),
    ("vec3", &["vec3(1, 2, 3)", "vec3(0, 0, 0)"]),
    ("quat", &["turn(0, 90, 0)"]),
    (
        "matrix",
        &["matrix()", "scaling(0)", "translation(1, 2, 3)"],
    ),
    ("color", &["rgb(1, 0.5, 0)"]),
    ("curve", &["way"]),
    ("state", &["state"]),
];

/// Everything that a scene script can call.
pub fn functions() -> Vec<Entry> {
    let functions = scene_names().entries().to_vec();
    for entry in &functions {
        if let Some(receiver) = entry.receiver {
            let known = RECEIVERS.iter().any(|(name, _)| *name == receiver);
            assert!(known, "there is no {receiver} to call `{}` of", entry.name);
        }
    }
    functions
}

/// A script with one call, here or in its `update`, and something done with what it gives.
pub fn call(functions: &[Entry], numbers: &mut Numbers) -> String {
    let entry = numbers.pick(functions);
    let values = |numbers: &mut Numbers, count: usize| {
        let values: Vec<&str> = (0..count).map(|_| *numbers.pick(VALUES)).collect();
        values.join(", ")
    };
    let receiver = entry.receiver.map(|name| {
        let things = RECEIVERS.iter().find(|(known, _)| *known == name);
        let things = things.map_or(&["cup"][..], |(_, things)| *things);
        match numbers.below(20) {
            0 => *numbers.pick(VALUES),
            _ => *numbers.pick(things),
        }
    });
    let dot = receiver.map_or(String::new(), |receiver| format!("({receiver})."));
    let call = if entry.property {
        match numbers.below(2) {
            0 => format!("{dot}{}", entry.name),
            _ => format!(
                "let it = {receiver}; it.{} = {}",
                entry.name,
                values(numbers, 1),
                receiver = receiver.unwrap_or("cup")
            ),
        }
    } else {
        // Now and then one too many or too few.
        let count = match numbers.below(12) {
            0 => entry.arguments.len() + 1,
            1 => entry.arguments.len().saturating_sub(1),
            _ => entry.arguments.len(),
        };
        format!("{dot}{}({})", entry.name, values(numbers, count))
    };
    let use_of_it = match numbers.below(6) {
        0 => "print(it);",
        1 => "let other = it + it;",
        2 => "spawn(\"user\").mesh(mesh(it));",
        3 => "clay.surface(it);",
        4 => "for part in it { print(part); }",
        _ => "state.it = it;",
    };
    let text = match call.strip_prefix("let it = ") {
        Some(_) => format!("{call};"),
        None => format!("let it = {call}; {use_of_it}"),
    };
    match numbers.below(5) {
        0 => format!("fn update(time, dt) {{\n{BEFORE}{text}\n}}"),
        _ => format!("{BEFORE}{text}"),
    }
}
