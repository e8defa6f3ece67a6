#![allow(clippy::unwrap_used)]

use lightbench_render::description::{
    Blend, Compare, Define, Lights, Load, ParameterValue, PassKind, TargetSize,
};

use super::*;
use crate::testing::project;

fn load(text: &str) -> Result<PipelineDesc, Problems> {
    let (_folder, files) = project(&[("scripts/pipelines/test.rhai", text)]);
    load_pipeline(&files, "test", &Settings::new())
}

const DEFERRED: &str = r#"
import "parts/out" as out;

let p = pipeline("Deferred");
p.describe("Lights later.");
p.target("depth", "depth32float");
p.target("g_albedo", "rgba8unorm-srgb").scale(0.5);
p.target("hdr", "rgba16float").size(512, 256);

if p.switch("prepass", true) {
    p.geometry("early")
        .shader("shaders/depth.wgsl")
        .depth("depth").clear(0);
}
p.geometry("g_buffer")
    .shader("shaders/g.wgsl").define("FANCY")
    .draws("opaque")
    .writes("hdr").clear(0, 0, 0, 1.0)
    .writes("g_albedo").clear(0, 0, 0, 0)
    .depth("depth").test("equal").read_only();

p.lights("lights")
    .shader("shaders/l.wgsl")
    .reads("g_albedo").reads("depth", "scene_depth")
    .writes("hdr").blend("add")
    .depth("depth");
out::add(p, "hdr");
p
"#;

const OUT: &str = r#"
fn add(p, hdr) {
    let exposure = p.number("exposure", 0, -10, 10);
    p.about("exposure", "Brightness in stops", "EV");
    p.choice("curve", ["hable", "linear"]);
    p.target("output", "rgba8unorm");
    p.fullscreen("output").shader("shaders/output.wgsl").reads(hdr).writes("output");
    p.hdr(hdr);
    p.show("output");
}
"#;

#[test]
fn a_whole_pipeline() {
    let (_folder, files) = project(&[
        ("scripts/pipelines/deferred.rhai", DEFERRED),
        ("scripts/pipelines/parts/out.rhai", OUT),
    ]);
    let settings = Settings::new()
        .with("exposure", "1.5")
        .with("curve", "linear");
    let desc = match load_pipeline(&files, "deferred", &settings) {
        Ok(desc) => desc,
        Err(problems) => panic!("{problems}"),
    };
    assert_eq!(
        (desc.name.as_str(), desc.title.as_str()),
        ("deferred", "Deferred")
    );
    assert_eq!(desc.description, "Lights later.");
    assert_eq!(&*desc.file.file, "scripts/pipelines/deferred.rhai");
    let names: Vec<&str> = desc.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(
        names,
        ["prepass", "exposure", "curve", "heat_map", "heat_map_most"]
    );
    let exposure = desc.parameter("exposure").unwrap();
    assert_eq!(exposure.value, ParameterValue::Number(1.5));
    assert_eq!(exposure.default, ParameterValue::Number(0.0));
    assert_eq!((exposure.unit.as_str(), exposure.at.line), ("EV", 3));
    assert_eq!(&*exposure.at.file, "scripts/pipelines/parts/out.rhai");
    let curve = desc.parameter("curve").unwrap();
    assert_eq!(curve.value, ParameterValue::Choice("linear".into()));
    assert_eq!(
        desc.target("g_albedo").unwrap().size,
        TargetSize::Relative(0.5)
    );
    assert_eq!(
        desc.target("hdr").unwrap().size,
        TargetSize::Absolute(512, 256)
    );
    let passes: Vec<&str> = desc.passes.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(passes, ["early", "g_buffer", "lights", "output"]);

    let g_buffer = &desc.passes[1];
    assert_eq!(g_buffer.at.line, 15);
    let shader = g_buffer.shader.as_ref().unwrap();
    assert_eq!(
        (shader.path.as_str(), shader.at.line),
        ("shaders/g.wgsl", 16)
    );
    assert_eq!(shader.defines, [Define::flag("FANCY")]);
    assert_eq!(g_buffer.colors[0].load, Load::Clear([0.0, 0.0, 0.0, 1.0]));
    assert_eq!(
        (g_buffer.colors[1].at.line, g_buffer.colors[1].at.column),
        (19, 6)
    );
    let depth = g_buffer.depth.as_ref().unwrap();
    assert_eq!(
        (depth.compare, depth.write, depth.load),
        (Compare::Equal, false, Load::Keep)
    );

    let lights = &desc.passes[2];
    assert_eq!(lights.kind, PassKind::Lights(Lights::default()));
    assert_eq!(lights.reads[1].variable, "scene_depth");
    assert_eq!(lights.colors[0].blend, Blend::Add);
    assert!(
        !lights.depth.as_ref().unwrap().write,
        "lights never write depth"
    );
    assert_eq!(desc.hdr.as_ref().unwrap().name, "hdr");
    assert_eq!(desc.output.as_ref().unwrap().name, "output");

    // Without the pre-pass there is a pass less; another exposure changes no structure.
    let without = Settings::new().with("prepass", false);
    let without = load_pipeline(&files, "deferred", &without).unwrap();
    assert_eq!(without.passes.len(), 3);
    assert!(!desc.same_structure(&without));
    let brighter = Settings::new()
        .with("exposure", 3.0)
        .with("curve", "linear");
    assert!(desc.same_structure(&load_pipeline(&files, "deferred", &brighter).unwrap()));
}

#[test]
fn all_mistakes_are_told_at_once() {
    let text = r#"let p = pipeline("Wrong");
p.target("hdr", "rgba16flaot");
p.target("hdr", "rgba16float");
p.target("g normal", "rgba8unorm");
p.target("small", "rgba8unorm").scale(0);
p.number("exposure", 20, -10, 10);
p.choice("curve", []);
p.about("exposur", "x");
let g = p.geometry("g").clear(0, 0, 0, 0).blend("add");
g.writes("hdr").blend("ad").writes("hdr");
g.depth("hdr").clear(0, 0, 0, 0).test("less");
g.shader("shaders/g.glsl").define("X");
p.fullscreen("g").draws("opaque").read_only();
p.lights("l").draws("all").gather_lights(true).volumes(1);
for i in 0..3 { p.fullscreen("f" + i).shader(i); }
p.show(7);
p.bogus();
"#;
    let problems = load(text).unwrap_err();
    let found: Vec<(u32, &str)> = problems
        .0
        .iter()
        .map(|p| (p.place.line, p.message.as_str()))
        .collect();
    let expected = [
        (2, "there is no format `rgba16flaot`"),
        (
            3,
            "there is a target `hdr` already, in line 2 of scripts/pipelines/test.rhai",
        ),
        (4, "`g normal` can't be the name of a target"),
        (5, "`factor` of `scale` must be from 0.015625 to 4, not 0"),
        (6, "the default, 20, is not from -10 to 10"),
        (7, "a choice needs at least one option"),
        (8, "there is no parameter `exposur`"),
        (9, "`.clear` comes after the `.writes` that it applies to"),
        (9, "`.blend` comes after the `.writes` that it applies to"),
        (
            10,
            "`mode` of `blend` must be `replace`, `add`, `over`, `premultiplied`, `min` or `max`, not `ad`",
        ),
        (11, "depth is cleared to one number"),
        (
            11,
            "`compare` of `test` must be `nearer`, `strictly_nearer`, `farther`, `strictly_farther`, `equal`, `not_equal`, `always` or `never`, not `less`",
        ),
        (12, "`shaders/g.glsl` is no shader"),
        (12, "`.define` comes after `.shader`"),
        (
            13,
            "there is a pass `g` already, in line 9 of scripts/pipelines/test.rhai",
        ),
        (
            13,
            "`.draws` belongs to a `geometry` pass, and this is a `fullscreen` pass",
        ),
        (13, "`.read_only` comes after `.depth`"),
        (
            14,
            "`.draws` belongs to a `geometry` pass, and this is a `lights` pass",
        ),
        (
            14,
            "`.gather_lights` belongs to a `geometry` pass, and this is a `lights` pass",
        ),
        (
            14,
            "`on` of `volumes` must be `true` or `false`, not the number 1",
        ),
        (
            15,
            "`path` of `shader` must be a text in quotes, not the number 0",
        ),
        (
            15,
            "`path` of `shader` must be a text in quotes, not the number 1",
        ),
        (
            15,
            "`path` of `shader` must be a text in quotes, not the number 2",
        ),
        (
            16,
            "`target` of `show` must be a text in quotes, not the number 7",
        ),
        (17, "a pipeline has no method `bogus`"),
    ];
    assert_eq!(found, expected, "{problems}");
    assert_eq!(
        problems.0[0].hint.as_deref(),
        Some("did you mean `rgba16float`?")
    );
    assert_eq!(problems.0[9].hint.as_deref(), Some("did you mean `add`?"));
    assert_eq!(
        problems.0[4].source_line.as_deref(),
        Some("p.number(\"exposure\", 20, -10, 10);")
    );
}

#[test]
fn settings_must_fit() {
    let (_folder, files) = project(&[
        ("scripts/pipelines/deferred.rhai", DEFERRED),
        ("scripts/pipelines/parts/out.rhai", OUT),
    ]);
    for (name, value, message, hint) in [
        (
            "exposure",
            "99",
            "`exposure` takes a number from -10 to 10, not `99`",
            "",
        ),
        (
            "prepass",
            "perhaps",
            "`prepass` takes `on` or `off`, not `perhaps`",
            "",
        ),
        (
            "curve",
            "aces",
            "`curve` takes one of `hable`, `linear`, not `aces`",
            "",
        ),
        (
            "exposur",
            "1",
            "the pipeline `deferred` has no parameter `exposur`",
            "did you mean `exposure`?",
        ),
        (
            "zzz",
            "1",
            "the pipeline `deferred` has no parameter `zzz`",
            "`prepass`, `exposure` and `curve`",
        ),
    ] {
        let error = load_pipeline(&files, "deferred", &Settings::new().with(name, value));
        let problem = error.unwrap_err().0.remove(0);
        assert_eq!(problem.message, message);
        assert!(problem.hint.unwrap_or_default().contains(hint));
    }
}

#[test]
fn files_are_found_and_listed() {
    let (_folder, files) = project(&[
        (
            "scripts/pipelines/mine.rhai",
            "let p = pipeline(\"Mine\");\np.describe(\"My own.\");\np",
        ),
        ("scripts/pipelines/zz_broken.rhai", "let p = "),
        ("scripts/pipelines/zz_nothing.rhai", "let p = 1;"),
        ("scripts/pipelines/parts/out.rhai", OUT),
    ]);
    let entries = list_pipelines(&files).unwrap();
    let of = |name: &str| entries.iter().find(|entry| entry.name == name).unwrap();
    assert_eq!(
        (of("mine").title.as_str(), of("mine").description.as_str()),
        ("Mine", "My own.")
    );
    assert!(matches!(of("mine").origin, Origin::Project(_)));
    assert!(of("zz_broken").problem.is_some());
    let nothing = of("zz_nothing").problem.as_ref().unwrap();
    assert_eq!(nothing.message, "the file makes no pipeline");
    assert!(
        !entries.iter().any(|entry| entry.name == "out"),
        "parts are no pipelines"
    );

    let error = load_pipeline(&files, "mnie", &Settings::new()).unwrap_err();
    assert_eq!(error.0[0].message, "there is no pipeline `mnie`");
    for path in [
        "../x.rhai",
        "/etc/passwd",
        "scripts/pipelines/none.rhai",
        "",
    ] {
        load_pipeline(&files, path, &Settings::new()).unwrap_err();
    }
    assert!(load_pipeline(&files, "scripts/pipelines/mine.rhai", &Settings::new()).is_ok());
}

/// What a pass would do nothing with is a mistake, and not silence.
#[test]
fn a_pass_refuses_what_has_no_meaning_in_it() {
    let text = r#"let p = pipeline("Wrong");
p.target("a", "rgba16float");
p.copy("c", "a", "b").writes("a");
p.resolve("r", "a", "b").depth("a");
p.mips("m", "a", "min").reads("a");
p.history("h", "a", "b").updates("a");
p.clear("f").reads("a");
p.clear("g").writes("a").clear(0, 0, 0, 0).blend("add");
p.clear("i").depth("a").clear(0).test("always");
p.compute("k").blend_constant(0, 0, 0, 0);
p.lights("l").depth("a").test("equal");
p.remove_pass("x");
"#;
    let problems = load(text).unwrap_err();
    let found: Vec<(u32, &str)> = problems
        .0
        .iter()
        .map(|p| (p.place.line, p.message.as_str()))
        .collect();
    let expected = [
        (
            3,
            "a `copy` pass has no targets but those that it begins with",
        ),
        (
            4,
            "a `resolve` pass has no targets but those that it begins with",
        ),
        (
            5,
            "a `mips` pass has no targets but those that it begins with",
        ),
        (
            6,
            "a `history` pass has no targets but those that it begins with",
        ),
        (7, "a `clear` pass has no shader that could read something"),
        (
            8,
            "a `clear` pass fills its targets and draws nothing, so `.blend` has no meaning there",
        ),
        (
            9,
            "a `clear` pass fills its targets and draws nothing, so `.test` has no meaning there",
        ),
        (10, "a compute pass has no colour targets"),
        (
            11,
            "a `lights` pass chooses the depth test for each light itself",
        ),
        (12, "there is no pass `x`"),
    ];
    assert_eq!(found, expected, "{problems}");
    let empty = load("let p = pipeline(\"Empty\");\np.remove_pass(\"x\");").unwrap_err();
    assert_eq!(empty.0[0].hint.as_deref(), Some("there is none yet"));
}

#[test]
fn a_part_that_is_called_wrongly_says_how_it_is_written() {
    let (_folder, files) = project(&[
        (
            "scripts/pipelines/test.rhai",
            "import \"parts/out\" as out;\nlet p = pipeline(\"x\");\nout::add(p);\np",
        ),
        ("scripts/pipelines/parts/out.rhai", OUT),
    ]);
    let problem = load_pipeline(&files, "test", &Settings::new())
        .unwrap_err()
        .0
        .remove(0);
    assert_eq!(
        problem.message,
        "the module `out` has no function `add` with one argument"
    );
    let hint = problem.hint.unwrap();
    assert_eq!(hint, "it is written `out::add(p, hdr)`");
}
