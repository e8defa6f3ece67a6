//! `save` and scenes that hold a world; `bench frame`.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;

use cli_support::Project;

/// Something moves without a script.
const MOVING: &str = r#"
spawn("box").mesh(box(1)).material(material("red").color(0.8, 0.1, 0.1)).velocity(0.5, 0, 0);
spawn("moon").mesh(sphere(0.2)).parent(entity("box"))
    .animate_position([[0, vec3(0, 1, 0)], [1, vec3(1, 1, 0)], [2, vec3(0, 1, 0)]], "smooth");
point_light("lamp").at(1, 2.5, 2).intensity(6).range(8);
camera("main").at(0, 2, 5).look_at(0, 0.5, 0);
"#;

#[test]
fn a_saved_scene_gives_the_same_pictures() {
    let project = Project::new();
    project.write("scripts/scenes/moving.rhai", MOVING);
    for (scene, frames) in [("tiny", &["0"][..]), ("moving", &["0", "45"])] {
        let file = format!("{scene}.scene");
        project.run(&["save", scene, "--out", &file]).succeeded();
        for frame in frames {
            let render = |scene: &str, out: &str| {
                let more = ["--frame", frame];
                project.render(scene, out, &more).succeeded();
                fs::read(project.file(out)).unwrap()
            };
            assert_eq!(
                render(scene, "a.png"),
                render(&file, "b.png"),
                "{scene} {frame}"
            );
        }
        // Saved again, it is the same file.
        project
            .run(&["save", &file, "--out", "again.scene"])
            .succeeded();
        let read = |name: &str| fs::read_to_string(project.file(name)).unwrap();
        assert_eq!(read(&file), read("again.scene"));
    }
    project.write("scripts/scenes/kept.scene", "lightbench scene 2\n");
    let listed = project.run(&["list", "scenes"]).succeeded();
    assert!(
        listed.stdout.contains("scripts/scenes/kept.scene"),
        "{}",
        listed.all()
    );
}

#[test]
fn what_cannot_be_saved_or_read_is_explained() {
    let project = Project::new();
    project
        .run(&["save", "tiny", "--out", "x.txt"])
        .failed(2, &["x.txt", "ends in .scene"]);
    project
        .run(&["save", "tin", "--out", "x.scene"])
        .failed(1, &["did you mean `tiny`?"]);
    project.write(
        "bad.scene",
        "lightbench scene 2\n\nmesh \"a\" = sphere(-1)\n",
    );
    project
        .render("bad.scene", "x.png", &[])
        .failed(1, &["bad.scene:3"]);
    project.write("new.scene", "lightbench scene 99\n");
    project
        .render("new.scene", "x.png", &[])
        .failed(1, &["new.scene:1", "newer program"]);
}

#[test]
fn a_saved_scene_is_compared_and_its_systems_are_told() {
    let project = Project::new();
    project.write("scripts/scenes/moving.rhai", MOVING);
    project
        .run(&["save", "moving", "--out", "m.scene"])
        .succeeded();
    let arguments = [
        "compare",
        "m.scene",
        "--pipelines",
        "deferred_shading,forward_single_pass",
        "--size",
        "32x18",
        "--frames",
        "3",
        "--processes",
        "1",
        "--out",
        "r",
    ];
    project.run(&arguments).succeeded();
    let csv = fs::read_to_string(project.file("r/systems.csv")).unwrap();
    let html = fs::read_to_string(project.file("r/report.html")).unwrap();
    let json = fs::read_to_string(project.file("r/report.json")).unwrap();
    for name in [
        "velocity",
        "animation",
        "world matrices",
        "bounds",
        "extraction",
    ] {
        assert!(csv.contains(&format!("deferred_shading,{name},")), "{csv}");
        assert!(html.contains(name) && json.contains(name), "{name}");
    }
}

#[test]
fn a_frame_is_measured_system_by_system() {
    let project = Project::new();
    let bench = project
        .run(&["bench", "frame", "tiny", "--frames", "3"])
        .succeeded();
    for part in [
        "2 objects, 2 lights",
        "script",
        "world matrices",
        "extraction",
        "recording",
        "p95",
    ] {
        assert!(
            bench.stdout.contains(part),
            "no `{part}` in {}",
            bench.all()
        );
    }
}
