//! What beginners do wrong, and what they are told.
#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_render::Problem;

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

/// Calls with whole numbers. Each is run with `1` and with `1.0` and must give the same.
const CALLS: &[&str] = &[
    "sin(1) + cos(1) + tan(1) + asin(1) + acos(1) + atan(1) + atan(1, 2) + hypot(3, 4)",
    "sinh(1) + cosh(1) + tanh(1) + sqrt(4) + exp(1) + ln(2) + log(100) + log2(8) + pow(2, 3)",
    "floor(2) + ceiling(2) + round(2) + fraction(2) + to_radians(90) + to_degrees(1)",
    "lerp(1, 3, 1) + clamp(5, 0, 2) + smoothstep(0, 2, 1) + modulo(7, 3)",
    "min(1, 2) + max(1, 2) + abs(-3)",
    "vec3(1, 2, 3) * 2 + vec3(1) / 2 - 2 * vec3(4, 5, 6)",
    "let v = vec3(1, 2, 3); v.x = 4; v.y += 1; v",
    "vec3(1, 2, 3).dot(vec3(3, 2, 1))",
    "turn(10, 20, 30) * vec3(1, 0, 0) + turn(vec3(0, 1, 0), 90).apply(vec3(1, 0, 0))",
    "turn(1, 2, 3).apply(1, 0, 0)",
    "lerp(vec3(0, 0, 0), vec3(2, 2, 2), 1)",
    "rgb(1, 1, 0) * 2 + srgb(1, 0, 1) / 2 + hsv(30, 1, 1) + kelvin(5000)",
    "let c = rgb(1, 0, 0); c.g = 1; c",
    "noise(1) + noise(1, 2) + noise(1, 2, 3) + fractal_noise(1, 2, 3, 4)",
    "let r = random(7); [r.float(), r.range(1, 2), r.int(1, 6), r.normal(0, 1), r.chance(1)]",
    "spawn().at(1, 2, 3).move(1, 0, 0).turn(10, 20, 30).rotate(1, 2, 3).scale(2).position",
    "spawn().scale(1, 2, 3).size",
    "spawn().velocity(1, 2, 3).spin(0, 90, 0).animation_speed(2).animation_start(1).position",
    "let e = spawn(); e.size = 2; e.size",
    "spawn().look_at(1, 2, 3).rotation.angles + spawn().aim(1, 2, 3).rotation.angles",
    "point_light().color(1, 1, 1).intensity(3).range(5).intensity",
    "spot_light().inner(20).outer(40).outer",
    "point_light().clip_volume(mesh(box(1, 2, 3)), vec3(0, 1, 0)).range",
    "let l = point_light(); l.intensity = 2; l.range = 3; l.range",
    "let l = spot_light(); l.inner = 10; l.outer = 20; l.inner",
    "camera().fov(50).near(1).far(100).fov",
    "let c = camera(); c.fov = 60; c.fov",
    "mesh(plane(2, 3).segments(4, 4)).triangles + mesh(box(1, 2, 3)).triangles + mesh(box(2)).triangles",
    "mesh(sphere(1).repeat(2, 3).segments(8)).triangles + mesh(icosphere(1).subdivisions(1)).triangles",
    "mesh(cylinder(1, 2)).triangles + mesh(cone(1, 2)).triangles + mesh(torus(2, 1)).triangles",
    "mesh(lathe([[1, 0], [1, 2]])).triangles + mesh(faces([[vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)]])).triangles",
    "mesh(arched_wall(4, 5, 1, 1)).triangles + mesh(moulding([[0, 0], [1, 1]], 3)).triangles",
    "mesh(column(1, 5).taper(1).flutes(4)).triangles",
    "mesh(arch(1, 2, 1).span(180).voussoirs(5).joint(0)).triangles",
    "mesh(cloth(1, 2).waves(3, 1).sag(1).seed(2)).triangles",
    "material(\"m\").color(1, 1, 1).specular(1).power(32).emissive(1, 2, 3).cutoff(1).opacity(1); 1",
    "material(\"m\").specular(1, 0, 1).blinn_phong(32).phong(8).beckmann(1).ggx(1).roughness(1).ward(1, 1); 1",
    "material(\"m\").surface(stone_texture().size(8).seed(2).clouds(2).depth(1)); 1",
    "material(\"m\").texture(marble_texture().size(8).bands(1, 2)); 1",
    "material(\"m\").surface(brick_texture().size(8).pieces(2, 4).joint(0)); 1",
    "material(\"m\").surface(tiles_texture().size(8).pieces(2).stains(1)); 1",
    "material(\"m\").surface(weave_texture().size(8).stripes(2, 1)); 1",
    "material(\"m\").texture(checker_texture(4).size(8)); 1",
    "spawn().set(\"transform.scale\", vec3(1, 2, 3)).add(\"light\", #{ range: 4 }).get(\"light.range\")",
    "point_light().range(3); entities().with(\"light.range\", 3).near(vec3(0, 3, 0), 1).count",
    "let c = 2 * indices(3) - 1 + indices(3) / 4; c.sum() + max(c, 1).sum() + clamp(c, 0, 2).sum()",
    "let c = vec3(indices(3), 1, 2) * 2; c.x = 3; c.x += 1; c + vec3(1, 2, 3)",
    "let r = random(7); r.floats(2) + r.floats(2, 1, 2) + r.normals(2, 0, 1) + length(r.directions(2))",
    "dot(column_of([vec3(1, 2, 3)]), vec3(3, 2, 1)) + normalize(column_of([vec3(0, 3, 4)])).z",
];

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
