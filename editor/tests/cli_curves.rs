//! `bench pipelines`: curves over a parameter of a scene.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;

use cli_support::Project;

/// A floor that every lamp reaches everywhere, so that each pixel needs as many numbers as there are
/// lamps.
const LAMPS: &str = r#"
const LAMPS = param("lamps", 1, 0, 400, "How many lamps hang over the floor");
spawn("floor").mesh(plane(40, 40)).material(material("paint").color(0.8, 0.5, 0.3));
for i in 0..LAMPS {
    point_light("lamp " + i).at(0.01 * i, 3, 0).range(100);
}
camera("main").at(0, 4, 5).look_at(0, 0, 0).fov(50);
"#;

/// The cells of a row of the table, by its first two.
fn row<'a>(table: &'a str, pipeline: &str, value: &str) -> Option<Vec<&'a str>> {
    let mut rows = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    rows.find(|cells| cells[0] == pipeline && cells.get(1) == Some(&value))
}

#[test]
fn a_curve_ends_where_its_pipeline_says_that_it_lost_lights() {
    let project = Project::new();
    project.write("scripts/scenes/lamps.rhai", LAMPS);
    let arguments = [
        "bench",
        "pipelines",
        "lamps",
        "--sweep",
        "lamps=2,16",
        "--pipelines",
        "light_indexed_forward,forward_single_pass",
        "--set",
        "lights_per_pixel=4",
        "--size",
        "24x13",
        "--frames",
        "6",
        "--out",
        "curves",
    ];
    let bench = project.run(&arguments).succeeded();
    let table = fs::read_to_string(project.file("curves/lamps.csv")).unwrap();
    // Four numbers a pixel are enough for four lamps, and five are counted in all 24 × 13 pixels.
    let (limited, other) = ("light_indexed_forward", "forward_single_pass");
    let limit = "limit 4; at 5: 312 × Pixels that lost lights";
    assert!(
        table.contains(limit) && bench.stdout.contains(limit),
        "{table}"
    );
    assert!(row(&table, limited, "2").is_some() && row(&table, limited, "4").is_some());
    assert!(
        row(&table, limited, "16").is_none(),
        "it would show a wrong picture\n{table}"
    );
    // The other one evaluates every lamp in every pixel, and goes on to the end.
    for lamps in ["2", "16"] {
        let cells = row(&table, other, lamps).unwrap();
        assert_eq!(cells[6], format!("{lamps}.000"), "{table}");
        assert!(cells[2].parse::<f64>().unwrap() > 0.0, "{table}");
    }
    assert!(row(&table, other, "4").is_none());
    for part in [
        "# machine: ",
        "# resolution: 24 × 13",
        "How many lamps hang",
        "# Lightbench: ",
    ] {
        assert!(table.contains(part), "no `{part}` in {table}");
    }
    let plot = fs::read_to_string(project.file("curves/lamps.svg")).unwrap();
    assert!(plot.starts_with("<svg") && plot.contains(limit));
}

#[test]
fn mistakes_in_a_sweep_are_told() {
    let project = Project::new();
    project.write("scripts/scenes/lamps.rhai", LAMPS);
    let run = |sweep: &str, more: &[&str]| {
        let mut arguments = vec!["bench", "pipelines", "lamps", "--sweep", sweep];
        arguments.extend([
            "--pipelines",
            "forward_single_pass",
            "--size",
            "8x8",
            "--out",
            "c",
        ]);
        arguments.extend(more);
        project.run(&arguments)
    };
    run("lamps=9,4", &[]).failed(2, &["ascending order"]);
    run("lamps=2", &["--set", "lamps=3"]).failed(2, &["`lamps` is swept"]);
    run("lmps=2", &[]).failed(1, &["no parameter `lmps`", "did you mean `lamps`?"]);
    run("lamps=2,900", &[]).failed(1, &["900", "400"]);
    assert!(!project.file("c/lmps.csv").exists());
}
