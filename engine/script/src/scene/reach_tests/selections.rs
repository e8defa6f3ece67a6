use lightbench_world::glam::Vec3;
use lightbench_world::{MeshRenderer, Name, Velocity};

use super::{good, prints, refused};

/// Names of a selection's entities.
const NAMES: &str = "fn names(s) { let all = \"\"; for e in s { all += e.name + \" \"; } all }\n";

#[test]
fn selections_come_in_the_order_of_making() {
    let text = format!(
        r#"{NAMES}
        for name in ["a", "b", "c", "d"] {{ spawn(name); }}
        // The slots of the removed are taken by the next, in the other order.
        entity("b").remove();
        entity("a").remove();
        spawn("e"); spawn("f");
        print(names(entities()));
        print(names(entities().with("name").roots()));
        "#
    );
    prints(&text, &["c d e f ", "c d e f "]);
}

#[test]
fn selections_ask_for_what_entities_have() {
    let text = format!(
        r#"{NAMES}
        let far = spawn("far").at(10, 0, 0);
        spawn("child").parent(far).at(0, 1, 0).add("velocity");
        spawn("grandchild").parent(entity("child")).mesh(sphere(1));
        point_light("lamp 1").at(0, 2, 0);
        spot_light("lamp 2").at(0, 3, 0).tag("warm");
        camera("view").tag("warm").tag("own");
        print(names(entities().with("light")));
        print(names(entities().with("light.kind", "spot")));
        print(names(entities().with("light").without("velocity").named("lamp*")));
        print(names(entities().named("*a*p*")));
        print(names(entities().near(vec3(10, 0.5, 0), 1)));
        print(names(entities().below(far)));
        print(names(far.descendants.with("mesh_renderer")));
        print(names(entities().tagged("warm")));
        print(entity("view").tags);
        print(entity("view").untag("own").has_tag("own"));
        print(names(entities().roots().without("light")));
        let lamps = entities().with("light");
        print(lamps.count);
        print(lamps[1].name);
        print(lamps.to_array().len());
        print(lamps);
        // A selection stays as it is.
        point_light("lamp 3");
        print(lamps.count);
        entities().with("light").tag("lamp").drop("light").add("light", #{{ range: 3 }});
        print(entities().tagged("lamp").get("light.range"));
        entities().named("lamp 1").remove();
        print(entities().tagged("lamp").count);
        "#
    );
    prints(
        &text,
        &[
            "lamp 1 lamp 2 ",
            "lamp 2 ",
            "lamp 1 lamp 2 ",
            "lamp 1 lamp 2 ",
            "far child grandchild ",
            "child grandchild ",
            "grandchild ",
            "lamp 2 view ",
            r#"["own", "warm"]"#,
            "false",
            "far view ",
            "2",
            "lamp 2",
            "2",
            "selection of 2 entities",
            "2",
            "column of 3 numbers: 3, 3, 3",
            "2",
        ],
    );
}

#[test]
fn mistakes_about_selections_are_told() {
    let lamps = "point_light(\"a\"); point_light(\"b\"); let lamps = entities().with(\"light\");\n";
    let with = |text: &str| format!("{lamps}{text}");
    refused(
        "entities().with(\"lihgt\");",
        "there is no component `lihgt`",
        Some("did you mean `light`?"),
    );
    refused(
        "entities().with(\"light.kind\", \"laser\");",
        "`light.kind` must be `point`, `spot`, `directional` or `ambient`, not the text `laser`",
        None,
    );
    refused(
        &with("lamps[2];"),
        "`[2]` is outside of the selection: it has 2 entities, `[0]` to `[1]`",
        None,
    );
    refused(
        &with("lamps.set(\"light.range\", indices(3));"),
        "the column has 3 values, and the selection 2 entities",
        None,
    );
    refused(
        &with("lamps.set(\"light.range\", [1, 2, 3]);"),
        "the array has 3 values, and the selection 2 entities",
        None,
    );
    refused(
        &with("lamps.set(\"light.range\", indices(2) - 1);"),
        "value `[0]`: `light.range` must be a number of at least 0, in m, not the number -1",
        None,
    );
    refused(
        &with("lamps.set(\"light.range\", 1 / indices(2));"),
        "value `[0]` for `light.range` is infinite: did something divide by zero?",
        None,
    );
    refused(
        &with("lamps.set(\"light.color\", column_of([vec3(1, 1, 1), vec3(0, -1, 0)]));"),
        "value `[1]`: `light.color` must be a color whose parts are at least 0, not \
         `vec3(0.0, -1.0, 0.0)`",
        None,
    );
    refused(
        &with("lamps.set(\"light.color\", indices(2));"),
        "`light.color` must be a color whose parts are at least 0, not a column of numbers",
        None,
    );
    refused(
        &with("lamps.set(\"light.kind\", [\"spot\", \"spt\"]);"),
        "value `[1]`: `light.kind` must be `point`, `spot`, `directional` or `ambient`, not the \
         text `spt`",
        Some("did you mean `spot`?"),
    );
    refused(
        &with("lamps.get(\"velocity.linear\");"),
        "the entity `a` has no `velocity`",
        Some("`.with(\"velocity\")` keeps the entities that have one"),
    );
    refused(
        &with("entity(\"b\").remove(); lamps.get(\"light.range\");"),
        "an entity of the selection was removed",
        Some("ask for the selection again where entities come and go"),
    );
    refused(
        &with("lamps.get(\"transform.translation\").set(\"x\", 1);"),
        "a column has no method `set`",
        Some("it has `to_array`, `sum`, `average`, `smallest` and `largest`"),
    );
}

#[test]
fn nothing_is_written_if_one_value_does_not_fit() {
    prints(
        r#"
        point_light("a").range(5); point_light("b").range(6);
        let lamps = entities().with("light");
        for wrong in [indices(2) * -1, [1, -1], [1, "x"]] {
            try { lamps.set("light.range", wrong); } catch { print(lamps.get("light.range")); }
        }
        "#,
        &["column of 2 numbers: 5, 6"; 3],
    );
}

#[test]
fn selections_read_and_write_every_kind_of_field() {
    let scene = good(
        r#"
        for i in 0..3 { spawn("box " + i).mesh(sphere(1)).add("velocity"); }
        let boxes = entities().named("box *");
        boxes.set("velocity.linear", vec3(indices(3), 0, 2));
        boxes.set("transform.rotation", turn(0, 90, 0));
        boxes.set("mesh_renderer.visible", [true, false, true]);
        boxes.set("mesh_renderer.mesh", sphere(1));
        boxes.set("name.text", ["x", "y", "z"]);
        print(entity("y").get("velocity.linear"));
        print(boxes.get("mesh_renderer.visible"));
        print(boxes.get("velocity.linear"));
        "#,
    );
    let mut scene = scene;
    let log: Vec<String> = scene.take_log().into_iter().map(|line| line.text).collect();
    assert_eq!(
        log,
        [
            "(1, 0, 2)",
            "[true, false, true]",
            "column of 3 vec3: (0, 0, 2), (1, 0, 2), (2, 0, 2)",
        ]
    );
    let speeds = scene.world.columns::<Velocity>().linear();
    assert_eq!(speeds[2], Vec3::new(2.0, 0.0, 2.0));
    let meshes = scene.world.columns::<MeshRenderer>().mesh();
    assert!(meshes.iter().all(|mesh| *mesh == meshes[0]));
    assert!(
        scene
            .world
            .columns::<Name>()
            .text()
            .contains(&"z".to_owned())
    );
}
