#![allow(clippy::unwrap_used)]

mod checks;
mod costs;
mod numbers;

use std::sync::{Arc, Mutex};

use lightbench_render::description::Slice;
use lightbench_render::inspect::Aspect;

use super::*;
use crate::testing::project;
use numbers::Numbers;

struct Ran {
    folder: tempfile::TempDir,
    printed: Vec<String>,
    asked: Vec<String>,
    result: Result<(), Problems>,
}

fn run_with(text: &str, settings: &Settings) -> Ran {
    let (folder, files) = project(&[("scripts/experiments/test.rhai", text)]);
    let (laboratory, printed) = (Numbers::default(), Arc::new(Mutex::new(Vec::new())));
    let lines = Arc::clone(&printed);
    let result = run_experiment(
        &files,
        "test",
        settings,
        Box::new(laboratory.clone()),
        move |line| lines.lock().unwrap().push(line.text),
        &Progress::new(),
    );
    let printed = std::mem::take(&mut *printed.lock().unwrap());
    let asked = std::mem::take(&mut *laboratory.asked.lock().unwrap());
    Ran {
        folder,
        printed,
        asked,
        result,
    }
}

fn printed(text: &str) -> Vec<String> {
    let ran = run_with(text, &Settings::new());
    ran.result.unwrap();
    ran.printed
}

/// What is told of a line, in a script whose frame has 8 x 4 pixels. The line is the second.
fn told(line: &str) -> String {
    let text = format!("let frame = draw(\"s\", \"p\", #{{ size: [8, 4] }});\n{line}");
    let ran = run_with(&text, &Settings::new());
    let problems = ran.result.expect_err(line);
    let problem = problems.0.first().unwrap();
    assert_eq!(problem.place.line, 2, "{problem}");
    assert_eq!(&*problem.place.file, "scripts/experiments/test.rhai");
    problem.to_string()
}

#[test]
fn a_frame_is_asked_for_with_all_that_it_depends_on() {
    let ran = run_with(
        r#"
        draw("atrium", "mine");
        draw("hall", "yours.rhai", #{
            size: [320.0, 180], frame: 60,
            scene: #{ lights: 64, range: 2.5, moving: false },
            pipeline: #{ tile_size: "16" },
        });
        "#,
        &Settings::new(),
    );
    ran.result.unwrap();
    assert_eq!(
        ran.asked,
        [
            "atrium [] mine [] (640, 360) 0",
            "hall [lights=64 moving=off range=2.5] yours.rhai [tile_size=16] (320, 180) 60",
        ]
    );
}

#[test]
fn targets_are_images_with_as_many_numbers_as_channels() {
    let lines = printed(
        r#"
        let frame = draw("s", "p", #{ size: [8, 4] });
        print(frame);
        print([frame.width, frame.height, frame.passes, frame.targets]);
        let image = frame.target("hdr");
        print(image);
        print(image.at(6, 3.0));
        print([image.smallest, image.largest, image.mean]);
        print(frame.target("hdr", #{ after: "g_buffer", mip: 1 }).at(0, 0));
        print(frame.target("hdr", #{ after: 0 }).at(0, 0));
        let ids = frame.target("ids");
        print([ids.channels, ids.at(7, 0), ids.largest, ids.mean]);
        "#,
    );
    assert_eq!(
        lines,
        [
            "frame 0 of s through p, 8 x 4",
            r#"[8, 4, ["g_buffer", "lights"], ["hdr", "ids"]]"#,
            "hdr after lights, 8 x 4",
            "[6.0, 3.0, 1.0, 0.0]",
            "[[0.0, 0.0, 1.0, 0.0], [7.0, 3.0, 1.0, 0.0], [3.5, 1.5, 1.0, 0.0]]",
            "[0.0, 0.0, 0.0, 1.0]",
            "[0.0, 0.0, 0.0, 0.0]",
            "[1, [7], [7], [3.5]]",
        ]
    );
}

#[test]
fn parts_of_targets_reach_the_laboratory() {
    let text = r#"
        let frame = draw("s", "p");
        frame.target("ids", #{ after: "g_buffer", mip: 1, layer: 2, sample: 3, stencil: true });
    "#;
    let asked = run_with(text, &Settings::new()).asked;
    let part = Part {
        slice: Slice { mip: 1, layer: 2 },
        sample: Some(3),
        aspect: Aspect::Stencil,
    };
    assert_eq!(asked[1], format!("ids 0 {part:?}"));
}

#[test]
fn what_a_scene_plotted_is_an_array_of_numbers() {
    let lines =
        printed("let frame = draw(\"s\", \"p\", #{ frame: 3 }); print(frame.values(\"height\"));");
    assert_eq!(lines, ["[1.0, 2.5]"]);
}

#[test]
fn pixels_and_invalid_values_are_maps() {
    let lines = printed(
        r#"
        let frame = draw("s", "p", #{ size: [8, 4] });
        for step in frame.pixel(6, 3) {
            print(`${step.pass} ${step.target} ${step.layer} ${step.sample == ()}: ${step.before} ${step.after}`);
        }
        print(frame.first_invalid() == ());
        let found = draw("s", "p", #{ frame: 1 }).first_invalid();
        print(`${found.pass} ${found.target} ${found.x} ${found.y} ${found.texels} ${found.value}`);
        "#,
    );
    assert_eq!(
        lines,
        [
            "g_buffer ids 3 true:  [6, 3]",
            "lights ids 3 true: [0.5, 0.25] [6, 3]",
            "true",
            "lights hdr 5 2 7 [NaN, 1.0, 2.0, 1.0]",
        ]
    );
}

#[test]
fn mistakes_name_their_line_and_the_way_out() {
    for (line, parts) in [
        (
            "draw(1, \"p\");",
            &["`scene` of `draw` must be a text", "the number 1"][..],
        ),
        ("draw(\"s\", \"p\", 3);", &["must be a map of options"]),
        (
            "draw(\"s\", \"p\", #{ sise: [8, 4] });",
            &["`draw` has no option `sise`", "did you mean `size`?"],
        ),
        (
            "draw(\"s\", \"p\", #{ size: [0, 4] });",
            &["`size` of `draw` must be width and height", "not `[0, 4]`"],
        ),
        (
            "draw(\"s\", \"p\", #{ frame: 1.5 });",
            &["`frame` of `draw` must be a whole number", "the number 1.5"],
        ),
        (
            "draw(\"s\", \"p\", #{ scene: #{ lights: [] } });",
            &[
                "`lights` in `scene` of `draw` must be a number",
                "not an array",
            ],
        ),
        (
            "frame.target(\"hrd\");",
            &["`p` has no target `hrd`", "did you mean `hdr`?"],
        ),
        (
            "frame.target(\"hdr\", #{ after: \"light\" });",
            &["`p` has no pass `light`", "did you mean `lights`?"],
        ),
        (
            "frame.target(\"hdr\", #{ after: 2 });",
            &["`p` has no pass `2`", "the passes are: g_buffer, lights"],
        ),
        (
            "frame.target(\"hdr\", #{ lyer: 2 });",
            &["no option `lyer`", "did you mean `layer`?"],
        ),
        (
            "frame.target(\"hdr\", #{ mip: 3 });",
            &["3 mip levels", "`mip` goes from 0 to 2"],
        ),
        (
            "frame.target(\"hdr\").at(8, 0);",
            &["`x` of `at` must be from 0 to 7, not 8", "8 x 4 pixels"],
        ),
        (
            "frame.pixel(0, 4);",
            &["`y` of `pixel` must be from 0 to 3, not 4", "8 x 4 pixels"],
        ),
        (
            "frame.targt(\"hdr\");",
            &["a frame has no method `targt`", "did you mean `target`?"],
        ),
        (
            "frame.target(\"hdr\").smalest;",
            &[
                "an image has no property `smalest`",
                "did you mean `smallest`?",
            ],
        ),
        (
            "assert(1 == 2, \"they differ\");",
            &["the assertion does not hold: they differ"],
        ),
        (
            "assert(1);",
            &["`condition` of `assert` must be `true` or `false`"],
        ),
        (
            "param(\"late\", 1, 0, 2);",
            &["declared before the first `draw`", "top of the file"],
        ),
    ] {
        let told = told(line);
        for part in parts {
            assert!(told.contains(part), "no `{part}` in:\n{told}");
        }
    }
}

#[test]
fn pictures_are_written_below_out_alone() {
    let text = r#"
        let image = draw("s", "p", #{ size: [8, 4] }).target("hdr");
        print(image.save("out/deep/a.png", #{ channel: "g", range: [0, 4], false_colour: true }));
        print(image.save("out/a.exr"));
    "#;
    let ran = run_with(text, &Settings::new());
    ran.result.unwrap();
    assert_eq!(ran.printed, ["out/deep/a.png", "out/a.exr"]);
    let shown = Shown {
        channel: Some(1),
        range: [0.0, 4.0],
        false_colour: true,
    };
    let read = |path: &str| std::fs::read_to_string(ran.folder.path().join(path)).unwrap();
    assert_eq!(
        read("out/deep/a.png"),
        format!("out/deep/a.png 8 {shown:?}")
    );
    assert_eq!(
        read("out/a.exr"),
        format!("out/a.exr 8 {:?}", Shown::default())
    );

    for (path, parts) in [
        (
            "a.png",
            &[
                "experiments write into the project's folder `out`",
                "write `out/a.png`",
            ][..],
        ),
        ("scripts/a.png", &["write `out/a.png`"]),
        ("out/../scripts/a.png", &["`..` would lead out"]),
        ("/out/a.png", &["write `out/a.png`"]),
        ("out/", &["experiments write into"]),
        ("out/a.txt", &["is no picture", "`.png` or `.exr`"]),
    ] {
        let told = told(&format!("frame.target(\"hdr\").save(\"{path}\");"));
        for part in parts {
            assert!(told.contains(part), "no `{part}` in:\n{told}");
        }
    }
    for (options, part) in [
        (
            "#{ channel: \"x\" }",
            "`channel` of `save` must be `r`, `g`, `b` or `a`",
        ),
        (
            "#{ range: [1, 1] }",
            "`range` of `save` must be two different numbers",
        ),
        ("#{ color: 1 }", "`save` has no option `color`"),
    ] {
        let told = told(&format!(
            "frame.target(\"hdr\").save(\"out/a.png\", {options});"
        ));
        assert!(told.contains(part), "{told}");
    }
}

#[test]
fn parameters_are_set_from_outside_and_misspelt_ones_stop_the_first_frame() {
    let text =
        "const N = param(\"lights\", 64, 0, 99, \"How many\");\nprint(N);\ndraw(\"s\", \"p\");";
    let set = |name: &str| run_with(text, &Settings::new().with(name, "12"));
    let ran = set("lights");
    ran.result.unwrap();
    assert_eq!(ran.printed, ["12"]);
    let ran = set("light");
    let told = ran.result.unwrap_err().to_string();
    assert!(
        told.contains("the experiment has no parameter `light`"),
        "{told}"
    );
    assert!(told.contains("did you mean `lights`?"), "{told}");
    assert!(ran.asked.is_empty(), "{:?}", ran.asked);
    // Also where nothing is drawn.
    let ran = run_with("print(1);", &Settings::new().with("light", "12"));
    let told = ran.result.unwrap_err().to_string();
    assert!(told.contains("it has no parameters"), "{told}");
}

#[test]
fn tables_are_made_of_cells() {
    let lines = printed(
        r#"
        print("|" + left("ab", 5) + "|" + right(1.5, 6) + "|");
        print(decimals(2, 2) + " " + decimals([0.125, 1], 2) + " " + decimals(0.0 / 0.0, 1));
        "#,
    );
    assert_eq!(lines, ["|ab   |   1.5|", "2.00 [0.12, 1.00] NaN"]);
}

#[test]
fn images_count_as_memory_until_they_are_dropped() {
    // 2048 x 1024 texels of 16 bytes are 32 MiB; an experiment may hold 1 GiB.
    let text = |keep: &str| {
        format!(
            "let kept = [];\nlet frame = draw(\"s\", \"p\", #{{ size: [2048, 1024] }});\n\
             for i in 0..40 {{\n  let image = frame.target(\"hdr\");\n  {keep}\n}}"
        )
    };
    assert_eq!(printed(&text("")), Vec::<String>::new());
    let ran = run_with(&text("kept.push(image);"), &Settings::new());
    let told = ran.result.unwrap_err().to_string();
    assert!(told.contains("more than 1024 MiB together"), "{told}");
}

#[test]
fn every_function_is_explained() {
    for entry in experiment_names().entries() {
        let explained = entry.about.ends_with('.');
        assert!(explained || entry.section.is_empty(), "{}", entry.form());
    }
}
