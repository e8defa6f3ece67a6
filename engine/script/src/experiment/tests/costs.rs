//! Measuring, comparing and plotting.

use super::{printed, run_with, told};
use crate::settings::Settings;

#[test]
fn measurements_ask_for_all_pipelines_at_once_and_give_maps() {
    let ran = run_with(
        r#"
        let costs = measure("hall", ["mine", ["yours", #{ tile_size: "8" }]], #{
            frames: 9, warmup: 1, size: [320, 180], scene: #{ lights: 4 },
        });
        for cost in costs {
            print(`${cost.pipeline} ${cost.gpu} ${cost.gpu_low} ${cost.cpu} ${cost.cpu_high}`);
        }
        let first = costs[0];
        print(first.draws + first.triangles + first.bytes + first.memory);
        print(first.counters.lost);
        measure("hall", ["mine"]);
        "#,
        &Settings::new(),
    );
    ran.result.unwrap();
    assert_eq!(
        ran.asked,
        [
            "hall [lights=4] mine [] yours [tile_size=8] (320, 180) 1+9",
            "hall [] mine [] (640, 360) 2+15",
        ]
    );
    // The laboratory has GPU times of the first alone.
    let expected = ["mine 4.0 3.5 4.0 4.5", "yours   8.0 8.5", "34", "2.0"];
    assert_eq!(ran.printed, expected);
}

#[test]
fn images_are_compared_by_name() {
    let lines = printed(
        r#"
        let frame = draw("s", "p", #{ size: [8, 4] });
        let early = frame.target("hdr", #{ after: 0 });
        print(frame.target("hdr").compare(early).mse);
        "#,
    );
    // Blue is the number of the pass.
    assert_eq!(lines, ["1.0"]);
}

#[test]
fn plots_are_written_below_out() {
    let ran = run_with(
        r#"
        let path = plot("out/cost.svg", #{
            forward: [[4, 1.5, 1, 2], [8, 3.0]],
        }, #{ title: "Cost", x: "lights", y: "ms", logarithmic: true });
        print(path);
        "#,
        &Settings::new(),
    );
    ran.result.unwrap();
    assert_eq!(ran.printed, ["out/cost.svg"]);
    let written = std::fs::read_to_string(ran.folder.path().join("out/cost.svg")).unwrap();
    for part in [
        "title: \"Cost\"",
        "logarithmic: [true, true]",
        "points: [[4.0, 1.5], [8.0, 3.0]]",
        "intervals: [[1.0, 2.0], [3.0, 3.0]]",
    ] {
        assert!(written.contains(part), "no `{part}` in {written}");
    }
}

#[test]
fn mistakes_in_measurements_and_plots_are_told() {
    for (line, parts) in [
        (
            "measure(\"s\", []);",
            &["`pipelines` of `measure` must have 1 to 64 entries, not 0"][..],
        ),
        (
            "measure(\"s\", [3]);",
            &["must be a name, not the number 3", "tiled_forward"],
        ),
        (
            "measure(\"s\", [\"p\"], #{ frame: 3 });",
            &["`measure` has no option `frame`", "did you mean `frames`?"],
        ),
        (
            "measure(\"s\", [\"p\"], #{ frames: 0 });",
            &["must be a whole number from 1"],
        ),
        (
            "plot(\"cost.svg\", #{ a: [[1, 2]] });",
            &["write `out/cost.svg`"],
        ),
        (
            "plot(\"out/cost.png\", #{ a: [[1, 2]] });",
            &["is no plot", "`.svg`"],
        ),
        ("plot(\"out/a.svg\", #{});", &["1 to 64 curves, not 0"]),
        (
            "plot(\"out/a.svg\", #{ a: [[1, 2], [3]] });",
            &["`a`: point 2 is no pair of numbers"],
        ),
        (
            "plot(\"out/a.svg\", #{ a: [[1, 0]] }, #{ logarithmic: true });",
            &["`a`: point 1 is not above 0"],
        ),
        (
            "plot(\"out/a.svg\", #{ a: [[1, 1 / 0.0]] });",
            &["`a`: point 1 is infinite"],
        ),
        (
            "frame.target(\"hdr\").compare(3);",
            &["`reference` of `compare` must be an image"],
        ),
    ] {
        let told = told(line);
        for part in parts {
            assert!(told.contains(part), "no `{part}` in:\n{told}");
        }
    }
}

#[test]
fn studies_ask_for_all_that_they_are_told_and_give_maps() {
    let ran = run_with(
        r#"
        let rows = study("Lights", #{
            scenes: ["hall", ["room", #{ seed: 3 }]],
            pipelines: ["mine", ["yours", #{ tile_size: "8" }]],
            sweep: #{ lights: [4, 16], "yours.fast": [true, false] },
            size: [320, 180], reference: "traced", samples: 8, frames: 9, warmup: 2, start: 30,
            step: 0.5, processes: 7, seconds: 3, out: "out/lights",
        });
        let row = rows[0];
        print(`${row.point.lights} ${row.pipeline} ${row.gpu} ${row.flip} ${row.verdict}`);
        study("Short", #{ scenes: ["hall"], pipelines: ["mine"], out: "out/a/b" });
        "#,
        &Settings::new(),
    );
    ran.result.unwrap();
    assert_eq!(
        ran.asked,
        [
            "Lights: hall [] room [seed=3] | mine [] yours [tile_size=8] | [(\"lights\", [\"4\", \"16\"]), \
             (\"yours.fast\", [\"on\", \"off\"])] | (320, 180) Some(\"traced\") 8 2+9 30 Some(0.5) 7 3 out/lights",
            "Short: hall [] | mine [] | [] | (640, 360) None 0 1+4 0 None 5 5 out/a/b",
        ]
    );
    assert_eq!(ran.printed, ["4 mine 2.0 0.25 faster"]);
}

#[test]
fn mistakes_in_studies_are_told() {
    for (options, words) in [
        (
            "#{ }",
            &["`scenes` of `study` must be an array of names, not nothing"][..],
        ),
        (
            "#{ scenes: [], pipelines: [\"p\"], out: \"out/x\" }",
            &["`scenes` of `study` must have 1 to 64 entries, not 0"],
        ),
        (
            "#{ scenes: [\"s\"], pipelines: [\"p\"], out: \"x\" }",
            &["`out` of `study` must be a folder below `out`"],
        ),
        (
            "#{ scenes: [\"s\"], pipelines: [\"p\"], out: \"out/../x\" }",
            &["`out` of `study` must be a folder below `out`"],
        ),
        (
            "#{ scenes: [\"s\"], pipelines: [\"p\"], out: \"out/x\", sweep: #{ lights: 4 } }",
            &["`sweep` of `study` must be a map from names to arrays"],
        ),
        (
            "#{ scenes: [\"s\"], pipelines: [\"p\"], out: \"out/x\", seconds: 0 }",
            &["`seconds` of `study` must be a number above 0"],
        ),
        (
            "#{ scene: [\"s\"] }",
            &["`study` has no option `scene`", "did you mean `scenes`?"],
        ),
    ] {
        let told = told(&format!("study(\"x\", {options});"));
        for word in words {
            assert!(told.contains(word), "{told}");
        }
    }
}
