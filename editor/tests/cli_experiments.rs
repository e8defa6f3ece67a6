//! `run`: experiments that draw frames, look into them and assert what they found.
#![allow(clippy::unwrap_used)]

mod cli_support;

use cli_support::{Project, run_in};

/// Two passes: the second adds to what the first wrote, and spoils one pixel where it is asked to.
const PIPELINE: &str = r#"
let p = pipeline("Steps");
let step = p.number("step", 2, 0, 8);
let spoilt = p.switch("spoilt", false);
p.target("sum", "rgba32float");
p.target("small", "r32uint").scale(0.5);
p.target("output", "rgba8unorm");
p.fullscreen("first").shader("shaders/first.wgsl").writes("sum");
p.fullscreen("second").shader("shaders/second.wgsl").writes("sum").blend("add");
p.clear("count").writes("small").clear(7, 0, 0, 0);
p.fullscreen("show").shader("shaders/show.wgsl").reads("sum").writes("output");
p.show("output");
p.hdr("sum");
p
"#;
const FIRST: &str =
    "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return vec4f(floor(pixel.x), floor(pixel.y), 0.25, 1.0);
}";
const SECOND: &str = "struct Parameters { step: f32, spoilt: u32 }
@group(2) @binding(0) var<uniform> parameters: Parameters;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let here = parameters.spoilt == 1u && floor(pixel.x) == 5.0 && floor(pixel.y) == 2.0;
    let zero = min(pixel.x, 0.0);
    return vec4f(select(parameters.step, zero / zero, here), 0.0, 0.0, 0.0);
}";
const SHOW: &str = "@group(1) @binding(0) var sum: texture_2d<f32>;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return textureLoad(sum, vec2u(pixel.xy), 0) / 255.0;
}";

/// A project with an experiment whose first line draws 8 x 4 pixels of that pipeline.
fn project(experiment: &str) -> Project {
    let project = Project::new();
    project.write("scripts/pipelines/steps.rhai", PIPELINE);
    project.write("shaders/first.wgsl", FIRST);
    project.write("shaders/second.wgsl", SECOND);
    project.write("shaders/show.wgsl", SHOW);
    let draw = "let frame = draw(\"tiny\", \"steps\", #{ size: [8, 4] });\n";
    project.write(
        "scripts/experiments/mine.rhai",
        format!("{draw}{experiment}"),
    );
    project
}

#[test]
fn what_a_script_sees_is_what_the_passes_compute() {
    let project = project(
        r#"
// The first pass writes x, y, 1/4, 1; the second adds 2 to red.
let early = frame.target("sum", #{ after: "first" });
let late = frame.target("sum");
for y in 0..4 {
    for x in 0..8 {
        assert(early.at(x, y) == [1.0 * x, 1.0 * y, 0.25, 1.0], `early ${x} ${y}`);
        assert(late.at(x, y) == [2.0 + x, 1.0 * y, 0.25, 1.0], `late ${x} ${y}`);
    }
}
// The mean of 0 to 7 is 3.5, of 0 to 3 is 1.5.
assert(late.mean == [5.5, 1.5, 0.25, 1.0], "mean");
assert(late.smallest == [2.0, 0.0, 0.25, 1.0], "smallest");
assert(late.largest == [9.0, 3.0, 0.25, 1.0], "largest");
let small = frame.target("small");
assert([small.width, small.height, small.at(3, 1)] == [4, 2, [7]], "small");

let steps = frame.pixel(6, 3).filter(|step| step.target == "sum");
assert(steps.len() == 2, "two passes write the sum");
assert(steps[0].before == () && steps[0].after == [6.0, 3.0, 0.25, 1.0], "first");
assert(steps[1].before == steps[0].after && steps[1].after == [8.0, 3.0, 0.25, 1.0], "second");
assert(frame.hdr == "sum" && frame.output == "output", "names");

// Other values of a parameter, and the first ones again.
let more = draw("tiny", "steps", #{ size: [8, 4], pipeline: #{ step: 5 } });
assert(more.target("sum").at(1, 0)[0] == 6.0, "six");
assert(frame.target("sum").at(1, 0)[0] == 3.0, "three");

assert(frame.first_invalid() == (), "all are numbers");
let spoilt = draw("tiny", "steps", #{ size: [8, 4], pipeline: #{ spoilt: true } });
let found = spoilt.first_invalid();
assert(found.pass == "second" && found.target == "sum", "who");
assert([found.x, found.y, found.texels] == [5, 2, 1], "where");
assert(found.value[0].is_nan() && found.value[1] == 2.0, "what");
print("all of it");
"#,
    );
    let ran = project.run(&["run", "mine"]).succeeded();
    assert_eq!(ran.stdout, "all of it\n");
}

#[test]
fn frames_do_not_depend_on_those_before_them() {
    let project = Project::new();
    project.write(
        "scripts/experiments/moments.rhai",
        r#"
fn at(frame) {
    let drawn = draw("tiny", "forward_single_pass", #{ size: [32, 18], frame: frame });
    drawn.target(drawn.hdr)
}
fn same(a, b) {
    for y in 0..18 { for x in 0..32 { if a.at(x, y) != b.at(x, y) { return false; } } }
    true
}
let first = at(0);
let later = at(30);
draw("cornell_box", "deferred_shading", #{ size: [32, 18] });
assert(!same(first, later), "the sphere moves");
assert(same(first, at(0)), "backwards");
assert(same(later, at(30)), "forwards again");
later.save("out/later.exr");
"#,
    );
    project.run(&["run", "moments"]).succeeded();
    // The moment is that of the other commands.
    let more = [
        "--pipeline",
        "forward_single_pass",
        "--frame",
        "30",
        "--size",
        "32x18",
    ];
    project.render("tiny", "render.exr", &[]).succeeded();
    let arguments = ["render", "tiny", "--out", "render.exr"];
    project.run(&[&arguments[..], &more].concat()).succeeded();
    let read = |path: &str| {
        let picture = image::ImageReader::open(project.file(path)).unwrap();
        picture.decode().unwrap().to_rgb32f()
    };
    assert_eq!(read("out/later.exr"), read("render.exr"));
}

#[test]
fn mistakes_and_assertions_name_their_line() {
    for (line, parts) in [
        (
            "assert(frame.width == 9, \"nine\");",
            &["mine.rhai:2:1: the assertion does not hold: nine"][..],
        ),
        (
            "frame.target(\"sun\");",
            &[
                "mine.rhai:2:",
                "`steps` has no target `sun`",
                "did you mean `sum`?",
            ],
        ),
        (
            "frame.target(\"sum\", #{ mip: 1 });",
            &[
                "mine.rhai:2:",
                "`sum` has 1 mip level",
                "`mip` goes from 0 to 0",
            ],
        ),
        (
            "frame.target(\"sum\", #{ sample: 1 });",
            &["mine.rhai:2:", "`sample` goes from 0 to 0"],
        ),
        (
            "frame.target(\"sum\", #{ stencil: true });",
            &["mine.rhai:2:", "`sum` has no stencil"],
        ),
        (
            "frame.pixel(8, 0);",
            &["mine.rhai:2:", "`x` of `pixel` must be from 0 to 7, not 8"],
        ),
        (
            "draw(\"tinny\", \"steps\");",
            &[
                "mine.rhai:2:1",
                "there is no scene `tinny`",
                "did you mean `tiny`?",
            ],
        ),
        (
            "draw(\"tiny\", \"stepps\");",
            &[
                "mine.rhai:2:1",
                "there is no pipeline `stepps`",
                "did you mean `steps`?",
            ],
        ),
        (
            "draw(\"tiny\", \"steps\", #{ scene: #{ ligt: 1 } });",
            &[
                "mine.rhai:2:1",
                "no parameter `ligt`",
                "did you mean `light`?",
            ],
        ),
        (
            "draw(\"tiny\", \"steps\", #{ pipeline: #{ stp: 1 } });",
            &[
                "mine.rhai:2:1",
                "no parameter `stp`",
                "did you mean `step`?",
            ],
        ),
        (
            "frame.target(\"sum\").save(\"sum.exr\");",
            &[
                "mine.rhai:2:",
                "the project's folder `out`",
                "write `out/sum.exr`",
            ],
        ),
        (
            "frame.target(\"sum\").save(\"out/../../sum.exr\");",
            &["mine.rhai:2:", "`..` would lead out"],
        ),
    ] {
        let project = project(line);
        let ran = project.run(&["run", "mine"]).failed(1, parts);
        assert!(ran.stdout.is_empty(), "{}", ran.all());
        assert!(!project.file("sum.exr").exists());
    }
    let project = project("print(frame.width);");
    project.run(&["run", "mime"]).failed(
        1,
        &["there is no experiment `mime`", "did you mean `mine`?"],
    );
    project
        .run(&["run", "mine", "--set", "lights"])
        .failed(2, &["--set lights", "name=value"]);
    project
        .run(&["run", "mine", "--set", "lights=3"])
        .failed(1, &["the experiment has no parameter `lights`"]);
    project.run(&["run"]).failed(2, &["EXPERIMENT"]);
}

#[test]
fn the_counts_of_a_heat_map_are_those_of_the_command() {
    let project = Project::new();
    project.write(
        "scripts/experiments/heat.rhai",
        r#"
let heat = draw("many_lights", "tiled_forward", #{
    size: [80, 48], scene: #{ lights: 9 }, pipeline: #{ heat_map: "lights_evaluated" },
});
let counts = heat.target(heat.hdr);
print(`${decimals(counts.mean[0], 2)} a pixel in the mean, ${decimals(counts.largest[0], 0)} at most`);
"#,
    );
    let ran = project.run(&["run", "heat"]).succeeded();
    let scene = [
        "inspect",
        "many_lights",
        "--size",
        "80x48",
        "--set",
        "lights=9",
    ];
    let heat = [
        "--pipeline",
        "tiled_forward",
        "--heat-map",
        "lights_evaluated",
    ];
    let told = project.run(&[&scene[..], &heat, &["--out", "heat.exr"]].concat());
    let told = told.succeeded().stdout;
    let line = told.lines().last().unwrap();
    assert_eq!(line, format!("Lights evaluated: {}", ran.stdout.trim_end()));
}

#[test]
fn the_shipped_experiments_run() {
    let project = Project::new();
    let small = ["--set", "width=80", "--set", "lights=16"];
    let pictures = ["run", "compare_culling", "--set", "pictures=true"];
    let ran = project.run(&[&pictures[..], &small].concat()).succeeded();
    // A title, a blank line, a head, a row for each of eight cullings; a blank line, a head, and a
    // picture for each.
    assert_eq!(ran.stdout.lines().count(), 3 + 8 + 2 + 8, "{}", ran.all());
    assert!(project.file("out/culling_light_volumes.png").exists());
    let pictures_of_work = ["run", "see_the_work", "--set", "pictures=true"];
    let ran = project
        .run(&[&pictures_of_work[..], &small].concat())
        .succeeded();
    for answer in [
        "per cluster",
        "in vain per tile",
        "volumes marked inversely",
        "depth first",
    ] {
        assert!(ran.stdout.contains(answer), "{}", ran.all());
        let file = format!("out/work_{}.png", answer.replace(' ', "_"));
        assert!(project.file(&file).exists(), "{file}");
    }
    let quick = ["frames=6", "few=1", "many=24", "width=64", "spheres=9"];
    let quick = quick.map(|value| ["--set", value]).concat();
    let ran = project.run(&[&["run", "break_even"][..], &quick].concat());
    let ran = ran.succeeded();
    assert!(ran.stdout.contains("break-even"), "{}", ran.all());
    let plot = std::fs::read_to_string(project.file("out/break_even.svg")).unwrap();
    assert!(plot.contains("forward_single_pass") && plot.contains("tiled_forward"));
    let short = ["processes=1", "most=16", "width=64"];
    let short = short.map(|value| ["--set", value]).concat();
    let ran = project.run(&[&["run", "when_lists_pay"][..], &short].concat());
    let ran = ran.succeeded();
    // A head, four pipelines at two numbers of lights, and what one process can't tell.
    let rows = ran
        .stdout
        .lines()
        .filter(|line| line.ends_with(" undecided") || line.ends_with(" same"));
    assert_eq!(rows.count(), 8, "{}", ran.all());
    assert!(ran.stdout.contains("None is faster"), "{}", ran.all());
    assert!(project.file("out/when_lists_pay/report.html").exists());
    // Without a project everything runs that writes no picture.
    let folder = tempfile::tempdir().unwrap();
    let ran = run_in(folder.path(), &["run", "follow_a_pixel"], &[]).succeeded();
    for part in [
        "Pixel 160, 90:",
        "g_buffer",
        "Every value that a pass wrote is a finite number.",
    ] {
        assert!(ran.stdout.contains(part), "{}", ran.all());
    }
    let ran = run_in(folder.path(), &[&pictures[..], &small].concat(), &[]);
    ran.failed(1, &["compare_culling.rhai:", "without a project"]);
}
