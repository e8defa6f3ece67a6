//! What beginners do wrong, and what they are told.
#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_render::Problem;

use crate::reference::calls::CALLS;
use crate::testing::project;
use crate::{Settings, load_scene, scene_names};

fn problem(text: &str) -> Option<Problem> {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
    let loaded = load_scene(&files, "test", &Settings::new(), &Progress::new());
    loaded.err()?.0.into_iter().next()
}

/// A script, the line of its mistake, a part of the message, a part of the help.
type Row = (&'static str, u32, &'static str, &'static str);

const MISTAKES: [Row; 53] = [
    // Writing.
    ("let x = 1\nlet y = 2;", 1, "a `;` is missing", ""),
    (
        "let x = 1 // one\n\n// two\nlet y = 2;",
        1,
        "a `;` is missing",
        "",
    ),
    ("let a = [1, 2;", 1, "is missing", ""),
    ("spawn(\"a\"", 1, "a `)` is missing", ""),
    ("if true {\n  spawn();\n", 3, "missing", ""),
    ("let s = \"open;\n", 1, "no closing quote", "double quotes"),
    ("let s = 'red';", 1, "is not one character", "double quotes"),
    ("if x == 1 { }", 1, "there is no variable `x`", ""),
    (
        "let x = 1; if x === 1 { }",
        1,
        "`===` has no meaning",
        "did you mean `==`?",
    ),
    ("let x = 1;\nx++;", 2, "`++` has no meaning", "+= 1"),
    ("let x = 1; if x = 1 { }", 1, "`=`", ""),
    (
        "let var = 3;",
        1,
        "`var` is a word of the language",
        "choose another name",
    ),
    ("fn f(a { }", 1, "missing", ""),
    ("let f = fn(x) { x };", 1, "", ""),
    ("let x = 12abc;", 1, "", ""),
    // Names.
    (
        "spawnn(\"a\");",
        1,
        "there is no function `spawnn`",
        "did you mean `spawn`?",
    ),
    (
        "let colour = 1;\nlet x = color + 1;",
        2,
        "there is no variable `color`",
        "did you mean `colour`?",
    ),
    (
        "let speed = 2;\nfn update(time, dt) {\n    let x = speed;\n}",
        3,
        "`speed` is not known here",
        "state.speed",
    ),
    (
        "spawn(\"a\").postion(1, 2, 3);",
        1,
        "an entity has no method `postion`",
        "",
    ),
    (
        "let e = spawn();\nlet p = e.postion;",
        2,
        "an entity has no property `postion`",
        "did you mean `position`?",
    ),
    (
        "point_light(\"l\").colour(1, 1, 1);",
        1,
        "an entity has no method `colour`",
        "did you mean `color`?",
    ),
    (
        "spawn().position(1, 2, 3);",
        1,
        "`position` of an entity is no method",
        "",
    ),
    (
        "let e = spawn();\nlet p = e.at;",
        2,
        "an entity has no property `at`",
        "it is a method",
    ),
    (
        "let v = vec3(1, 2, 3); v.w = 1;",
        1,
        "a vec3 has no property `w`",
        "",
    ),
    (
        "let x = Sin(1);",
        1,
        "there is no function `Sin`",
        "did you mean `sin`?",
    ),
    ("entity(\"lamp\");", 1, "there is no entity `lamp`", ""),
    (
        "let m = matrial(\"x\");",
        1,
        "there is no function `matrial`",
        "did you mean `material`?",
    ),
    (
        "spawn().mesh(spere(1));",
        1,
        "there is no function `spere`",
        "did you mean `sphere`?",
    ),
    (
        "let s = spawn;",
        1,
        "there is no variable `spawn`",
        "is a function",
    ),
    (
        "import \"parts/x\" as x;",
        1,
        "there is no script `parts/x`",
        "",
    ),
    ("x::f();", 1, "there is no module `x`", "import"),
    // Arguments.
    (
        "spawn(\"a\")\n    .at(1, 2);",
        2,
        "`.at` can't be called with 2 arguments",
        ".at(x, y, z)",
    ),
    (
        "spawn(\"a\").at(\"left\", 0, 0);",
        1,
        "`x` of `at` must be a number, not the text `left`",
        ".at(x, y, z)",
    ),
    (
        "point_light(\"l\").range(\"six\");",
        1,
        "`metres` of `range` must be a number, not the text `six`",
        ".range(metres)",
    ),
    (
        "point_light(\"l\").intensity(-1);",
        1,
        "must be from 0 to",
        "",
    ),
    (
        "point_light(\"l\").inner(20);",
        1,
        "is a point light, which has no `inner`",
        "",
    ),
    (
        "spawn(\"box\").fov(50);",
        1,
        "the entity `box` is no camera",
        "",
    ),
    ("spawn().at(0.0 / 0.0, 0, 0);", 1, "is not a number", ""),
    (
        "spawn().mesh(material(\"m\"));",
        1,
        "must be a mesh or a shape",
        "",
    ),
    (
        "material(\"m\").color(2, 0, 0);",
        1,
        "can't scatter more light",
        "0 to 1",
    ),
    (
        "material(\"m\").specular(rgb(0, 2, 0));",
        1,
        "can't mirror more light",
        "0 to 1",
    ),
    // A model takes its own parameters, whichever was named first.
    (
        "material(\"m\")\n    .ggx(0.3)\n    .power(40);",
        3,
        "a `ggx` material takes `roughness`, not `power`",
        ".ggx(0.25)",
    ),
    (
        "material(\"m\").power(40)\n    .ward(0.3, 0.1);",
        2,
        "a `ward` material takes a roughness `along` the tangent and one `across` it, not `power`",
        "leave out .power",
    ),
    (
        "material(\"m\").roughness(0.3);",
        1,
        "a `blinn_phong` material takes `power`, not `roughness`",
        ".power(32)",
    ),
    (
        "material(\"m\").ward(0.3);",
        1,
        "`.ward` can't be called with one argument",
        ".ward(along, across)",
    ),
    (
        "material(\"m\").beckmann(0);",
        1,
        "`roughness` of `beckmann` must be from 0.0263 to 1, not 0",
        "",
    ),
    (
        "material(\"m\").ggxx(0.3);",
        1,
        "a material has no method `ggxx`",
        "did you mean `ggx`?",
    ),
    (
        "let n = param(\"n\", 4);",
        1,
        "needs its smallest and its largest",
        "param(",
    ),
    (
        "sphere(1).flutes(3);",
        1,
        "the shape `sphere` has no `flutes`",
        "",
    ),
    ("random(1).pick([]);", 1, "empty array", ""),
    // Running.
    (
        "let a = [1, 2, 3];\nlet x = a[3];",
        2,
        "`[3]` is outside of the array: it has 3 elements",
        "",
    ),
    (
        "let v = vec3(1, 2, 3) + true;",
        1,
        "`+` can't combine a vec3 and `true` or `false`",
        "",
    ),
    ("const X = 1;\nX = 2;", 2, "`X` is a constant", "let"),
];

#[test]
fn forty_mistakes() {
    let mut wrong = String::new();
    for (text, line, message, help) in MISTAKES {
        let Some(problem) = problem(text) else {
            wrong.push_str(&format!("--- {text}\nwas accepted\n"));
            continue;
        };
        let hint = problem.hint.clone().unwrap_or_default();
        let type_names = [
            "i64",
            "f64",
            "INT",
            "FLOAT",
            "Dynamic",
            "ImmutableString",
            "::",
            "glam",
        ];
        let said = format!("{} {hint}", problem.message);
        let plain = !type_names.iter().any(|name| said.contains(name)) || text.contains("::");
        if problem.place.line != line
            || !problem.message.contains(message)
            || !hint.contains(help)
            || !plain
        {
            wrong.push_str(&format!(
                "--- {text}\nwanted {line}: {message} ({help})\ngot {problem}\n"
            ));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

fn printed(call: &str) -> String {
    let (before, last) = call.rsplit_once("; ").unwrap_or(("", call));
    let text = format!("{before};\nprint({last});");
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", &text)]);
    match load_scene(&files, "test", &Settings::new(), &Progress::new()) {
        Ok(mut scene) => scene.take_log().into_iter().map(|line| line.text).collect(),
        Err(problems) => panic!("{problems}"),
    }
}

/// `1` becomes `1.0`, but `[0]` of names and digits inside of words and texts stay.
fn with_points(call: &str) -> String {
    let mut text = String::new();
    let mut in_text = false;
    let mut letters = call.chars().peekable();
    while let Some(letter) = letters.next() {
        text.push(letter);
        in_text ^= letter == '"';
        let ends = letters
            .peek()
            .is_none_or(|next| !next.is_ascii_alphanumeric() && *next != '.');
        let mut in_word = text
            .chars()
            .rev()
            .take_while(|c| c.is_alphanumeric() || *c == '_' || *c == '.');
        let number = letter.is_ascii_digit() && in_word.all(|c| c.is_ascii_digit());
        if number && ends && !in_text {
            text.push_str(".0");
        }
    }
    text
}

#[test]
fn whole_numbers_and_others_are_taken_alike() {
    for call in CALLS {
        let whole: String = printed(call);
        let points = printed(&with_points(call));
        let plain = |text: &str| text.replace(".0", "");
        assert_eq!(plain(&whole), plain(&points), "{call}");
    }
}

#[test]
fn every_function_of_numbers_is_tried_with_both() {
    // What takes no number, or is tried elsewhere.
    let others = [
        "param",
        "entity",
        "has_entity",
        "load_obj",
        "picture",
        "pipeline",
        "material",
        "mesh",
        "texture",
        "normals",
        "surface",
        "two_sided",
        "visible",
        "active",
        "frame",
        "parent",
        "cross",
        "distance",
        "min",
        "max",
        "pick",
        "shuffle",
        "behave",
        "behaving",
        "send",
        "broadcast",
        "key_down",
        "has",
        "has_component",
        "fields",
        "drop",
        "tag",
        "untag",
        "has_tag",
        "tagged",
        "named",
        "without",
        "below",
        "spawn",
        "point_light",
        "spot_light",
        "directional_light",
        "ambient_light",
        "camera",
        "colors",
        "name",
        "animate_position",
        "animate_rotation",
        "animate_scale",
        "animation_repeat",
        "load_gltf",
        "load_model",
        "model_mesh",
        "model_texture",
        "keep",
        "use_pipeline",
    ];
    let all = CALLS.join("\n");
    for entry in scene_names().entries() {
        if entry.property || entry.arguments.is_empty() || others.contains(&entry.name.as_str()) {
            continue;
        }
        let word = format!("{}(", entry.name);
        assert!(all.contains(&word), "`{}` is not tried", entry.form());
    }
}
