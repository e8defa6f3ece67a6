//! `inspect`: targets after passes, the story of a pixel, the first bad value.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;

use cli_support::Project;

/// Two passes: the second adds to what the first wrote, and can spoil it.
const PIPELINE: &str = r#"
let p = pipeline("Steps");
p.target("sum", "rgba32float");
p.target("output", "rgba8unorm");
p.fullscreen("first").shader("shaders/first.wgsl").writes("sum");
p.fullscreen("second").shader("shaders/second.wgsl").writes("sum").blend("add");
p.fullscreen("show").shader("shaders/show.wgsl").reads("sum").writes("output");
p.show("output");
p
"#;
const FIRST: &str =
    "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return vec4f(floor(pixel.x), floor(pixel.y), 0.25, 1.0);
}";
const SECOND: &str =
    "@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    // Not a number in one pixel, where it is asked for.
    let spoilt = floor(pixel.x) == 5.0 && floor(pixel.y) == 2.0;
    let zero = min(pixel.x, 0.0);
    return vec4f(select(2.0, zero / zero, spoilt), 0.0, 0.0, 0.0);
}";
const SHOW: &str = "@group(1) @binding(0) var sum: texture_2d<f32>;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return textureLoad(sum, vec2u(pixel.xy), 0) / 255.0;
}";

fn project() -> Project {
    let project = Project::new();
    project.write("scripts/pipelines/steps.rhai", PIPELINE);
    project.write("shaders/first.wgsl", FIRST);
    project.write("shaders/second.wgsl", SECOND);
    project.write("shaders/show.wgsl", SHOW);
    project
}

const STEPS: [&str; 6] = ["inspect", "tiny", "--pipeline", "steps", "--size", "8x4"];

#[test]
fn a_target_is_written_as_a_pass_leaves_it() {
    let project = project();
    let red_of = |pass: &str, out: &str| {
        let more = ["--target", "sum", "--pass", pass, "--out", out];
        project.run(&[&STEPS[..], &more].concat()).succeeded();
        let picture = image::ImageReader::open(project.file(out)).unwrap();
        let picture = picture.decode().unwrap().to_rgb32f();
        picture.get_pixel(6, 3).0
    };
    assert_eq!(red_of("first", "first.exr"), [6.0, 3.0, 0.25]);
    assert_eq!(red_of("1", "second.exr"), [8.0, 3.0, 0.25]);

    let more = [
        "--target",
        "sum",
        "--channel",
        "r",
        "--range",
        "0,16",
        "--out",
        "red.png",
    ];
    project.run(&[&STEPS[..], &more].concat()).succeeded();
    let picture = image::ImageReader::open(project.file("red.png")).unwrap();
    let picture = picture.decode().unwrap().to_rgb8();
    assert_eq!(picture.get_pixel(6, 3).0, [128; 3]);
}

#[test]
fn a_pixel_tells_what_each_pass_did_to_it() {
    let told = project().run(&[&STEPS[..], &["--pixel", "6,3"]].concat());
    let told = told.succeeded().all();
    for line in [
        "first   sum     6.000000 3.000000 0.250000 1.000000",
        "second  sum     6.000000 3.000000 0.250000 1.000000  ->  8.000000 3.000000 0.250000 1.000000",
        "show    output  0.031373 0.011765 0.000000 0.003922",
    ] {
        assert!(told.contains(line), "{told}");
    }
}

#[test]
fn the_first_pass_that_makes_no_number_is_named() {
    let project = project();
    let find = || {
        project
            .run(&[&STEPS[..], &["--find-nan"]].concat())
            .succeeded()
            .all()
    };
    let told = find();
    assert!(told.contains("the pass `second` leaves"), "{told}");
    assert!(told.contains("in `sum` at 5,2; 1 texels"), "{told}");

    let good = SECOND.replace("zero / zero", "2.0");
    project.write("shaders/second.wgsl", good);
    let told = find();
    assert!(
        told.contains("every value that a pass writes is a finite number"),
        "{told}"
    );
}

#[test]
fn what_is_not_there_is_said_with_the_way_out() {
    let project = project();
    for (more, parts) in [
        (
            &["--target", "sun", "--out", "x.png"][..],
            &["no target `sun`", "did you mean `sum`?"][..],
        ),
        (
            &["--target", "sum", "--pass", "secnd", "--out", "x.png"],
            &["no pass `secnd`", "did you mean `second`?"],
        ),
        (&["--pixel", "8,0"], &["outside the picture of 8 x 4"]),
        (&["--pixel", "a"], &["write two numbers with a comma"]),
        (&[], &["say what to look at"]),
    ] {
        project.run(&[&STEPS[..], more].concat()).failed(2, parts);
    }
    let more = ["--target", "sum", "--mip", "3", "--out", "x.png"];
    let parts = ["`sum` has 1 mip level and 1 layer"];
    project.run(&[&STEPS[..], &more].concat()).failed(1, &parts);
    assert!(fs::metadata(project.file("x.png")).is_err());
}

#[test]
fn a_heat_map_has_a_legend_and_tells_its_mean() {
    let project = Project::new();
    let heat = |out: &str, more: &[&str]| {
        let arguments = [
            "inspect",
            "many_lights",
            "--size",
            "80x48",
            "--set",
            "lights=9",
        ];
        let map = [
            "--pipeline",
            "forward_single_pass",
            "--heat-map",
            "lights_evaluated",
        ];
        project.run(&[&arguments[..], &map, &["--out", out], more].concat())
    };
    let said = heat("heat.exr", &[]).succeeded().stdout;
    assert!(said.contains("Lights evaluated: "), "{said}");
    let values = image::ImageReader::open(project.file("heat.exr")).unwrap();
    let values = values.decode().unwrap().to_rgb32f();
    assert_eq!((values.width(), values.height()), (80, 48));
    let whole = values.pixels().all(|pixel| pixel.0[0].fract() == 0.0);
    let largest = values.pixels().map(|pixel| pixel.0[0]).fold(0.0, f32::max);
    // Nine lights, and the two that reach everything.
    assert!(whole && largest > 1.0 && largest <= 11.0, "{largest}");

    heat("heat.png", &["--range", "0,8"]).succeeded();
    let picture = image::ImageReader::open(project.file("heat.png")).unwrap();
    assert!(
        picture.decode().unwrap().height() > 48,
        "the legend is below"
    );
    heat("heat.png", &["--target", "hdr"]).failed(2, &["--heat-map", "--target"]);
    let wrong = ["inspect", "tiny", "--heat-map", "warm", "--out", "heat.png"];
    let mistake = "`heat_map` takes one of `off`, `overdraw`";
    project.run(&wrong).failed(1, &[mistake]);
}
