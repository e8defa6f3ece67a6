use lightbench_world::glam::Vec3;
use lightbench_world::reflect::Role;
use lightbench_world::{Light, LightKind, RigidAnimation, Transform, Transform2d, Value};

use super::{good, prints, refused};
use crate::scene::tables::{self, Field};
use crate::scene::{Scene, values};

fn fields() -> impl Iterator<Item = &'static Field> {
    tables::components().iter().flat_map(|component| {
        let fields = component.kind.info().fields.iter();
        fields.map(|info| tables::field_of(component, info.name).unwrap())
    })
}

fn computed(field: &Field) -> bool {
    field.kind.info().role == Role::Computed
}

/// A scene with an entity that has every component that scripts can give it, and in `update` the
/// given text.
fn everything(update: &str) -> Scene {
    let mut text = String::from("let e = spawn(\"all\").parent(spawn(\"above\"));\n");
    for component in tables::components() {
        if component.kind.info().role != Role::Computed {
            text += &format!("e.add(\"{}\");\n", component.name);
        }
    }
    text += "e.name = \"all\";
        e.mesh(sphere(1)).material(material(\"m\").color(0.5, 0.5, 0.5)).clip_volume(sphere(2));
        e.at(1, 2, 3).turn(10, 20, 30).scale(2).color(0.25, 0.5, 0.75).velocity(1, 2, 3);
        e.animate_position([[0, vec3(1, 2, 3)], [1, vec3(0, 4, 0)]], \"smooth\");
        e.animate_rotation([[0, vec3(0, 0, 0)], [1, vec3(0, 90, 0)]], \"step\");\n";
    text += &format!("fn update(time, dt) {{ let e = entity(\"all\");\n{update} }}");
    let mut scene = good(&text);
    let entity = scene.world.find("all").unwrap();
    // Computed matrices of the plane belong to a component that scripts don't give.
    scene.world.insert(entity, Transform2d::default()).unwrap();
    scene
}

/// Calls the scripts' functions, and lets no system compute anything.
fn scripts_alone(scene: &mut crate::Scene, time: f64) {
    scene.swap();
    scene.run_scripts(time, 0.0).unwrap();
    scene.swap();
}

#[test]
fn every_field_of_every_component_is_read_and_written_back() {
    let mut walk = String::new();
    for field in fields() {
        walk += &format!("let v = e.get(\"{0}\"); print(type_of(v));\n", field.path);
        if !computed(field) {
            walk += &format!("e.set(\"{}\", v);\n", field.path);
        }
    }
    let mut scene = everything(&walk);
    let entity = scene.world.find("all").unwrap();
    let values = |scene: &Scene| -> Vec<Value> {
        let value = |field: &Field| scene.world.field_at(entity, field.kind, field.index);
        fields().map(|field| value(field).unwrap()).collect()
    };
    let before = values(&scene);
    // Without a step of time, the systems move nothing.
    scripts_alone(&mut scene, 0.0);
    for ((field, before), after) in fields().zip(&before).zip(&values(&scene)) {
        match (before, after) {
            // Written as a unit quaternion once more.
            (Value::Quat(a), Value::Quat(b)) => {
                assert!(a.angle_between(*b) < 1e-6, "{}", field.path);
            }
            (a, b) => assert_eq!(a, b, "{}", field.path),
        }
    }
    let types: Vec<String> = scene.take_log().into_iter().map(|line| line.text).collect();
    let typed: Vec<(&str, &str)> = fields()
        .map(|field| field.path.as_str())
        .zip(types.iter().map(String::as_str))
        .collect();
    assert!(typed.len() > 40);
    for (path, name) in &typed {
        let none = *name == "()" && path.starts_with("family.");
        let known = [
            "bool", "f64", "string", "vec3", "color", "quat", "mesh", "material", "entity",
            "array", "map",
        ];
        assert!(known.contains(name) || none, "{path}: {name}");
    }
    for expected in [
        ("transform.translation", "vec3"),
        ("transform.rotation", "quat"),
        ("world_matrix.matrix", "array"),
        ("mesh_renderer.mesh", "mesh"),
        ("mesh_renderer.material", "material"),
        ("mesh_renderer.visible", "bool"),
        ("light.kind", "string"),
        ("light.color", "color"),
        ("light.range", "f64"),
        ("family.parent", "entity"),
        ("family.first_child", "()"),
        ("rigid_animation.rotation", "map"),
    ] {
        assert!(typed.contains(&expected), "{expected:?}");
    }
}

/// The must-fail twin of the walk: each field refuses a range, and each computed one everything.
#[test]
fn every_field_refuses_what_it_does_not_take() {
    for field in fields() {
        let set = format!("e.set(\"{}\", 1..2);", field.path);
        let problem = everything(&set).update(0.0, 0.0).unwrap_err();
        let expected = if computed(field) {
            format!(
                "`{}` is computed by the engine: it can be read, but not changed, added or dropped",
                field.component
            )
        } else {
            let wanted = values::expected(field.info);
            format!("`{}` must be {wanted}, not a range", field.path)
        };
        assert_eq!(problem.message, expected);
    }
}

#[test]
fn components_are_added_and_dropped_by_name() {
    let scene = good(
        r#"
        let e = spawn("e").add("velocity").add("light", #{ kind: "spot", range: 4, color: rgb(1, 0, 0) });
        print(e.components);
        e.drop("velocity").drop("camera");
        print(e.has_component("velocity") || !e.has_component("light"));
        print(e.fields("velocity"));
        // What is there keeps its other values.
        e.add("light", #{ intensity: 7 });
        print(e.get("light.range"));
        "#,
    );
    let light: Light = scene.world.get(scene.world.find("e").unwrap()).unwrap();
    assert_eq!(light.kind, LightKind::Spot);
    assert_eq!((light.range, light.intensity), (4.0, 7.0));
    assert_eq!(light.color, Vec3::X);
    let mut scene = scene;
    let log: Vec<String> = scene.take_log().into_iter().map(|line| line.text).collect();
    assert_eq!(
        log,
        [
            r#"["transform", "world_matrix", "light", "name", "velocity"]"#,
            "false",
            r#"["linear", "angular"]"#,
            "4.0",
        ]
    );
}

#[test]
fn mistakes_about_fields_name_the_way_out() {
    let lamp = |call: &str| format!("point_light(\"lamp\").{call};");
    for (call, message, hint) in [
        (
            "set(\"light.range\", -1)",
            "`light.range` must be a number of at least 0, in m, not the number -1",
            None,
        ),
        (
            "set(\"light.range\", \"far\")",
            "`light.range` must be a number of at least 0, in m, not the text `far`",
            None,
        ),
        (
            "set(\"light.outer_angle\", 55)",
            "`light.outer_angle` must be a number from 0 to 6.2831855, in rad, not the number 55",
            Some("`to_radians(…)` makes radians of degrees"),
        ),
        (
            "set(\"light.color\", vec3(1, 0, -1))",
            "`light.color` must be a color whose parts are at least 0, not `vec3(1.0, 0.0, -1.0)`",
            None,
        ),
        (
            "set(\"light.kind\", \"spt\")",
            "`light.kind` must be `point`, `spot`, `directional` or `ambient`, not the text `spt`",
            Some("did you mean `spot`?"),
        ),
        (
            "set(\"transform.translation\", vec3(0, 1, 0) / 0)",
            "`transform.translation` must be a vec3, in m, not `vec3(NaN, inf, NaN)`",
            None,
        ),
        (
            "set(\"transform.rotation\", vec3(0, 90, 0))",
            "`transform.rotation` must be a rotation, not `vec3(0.0, 90.0, 0.0)`",
            Some("a rotation is made by `turn`, as in `turn(0, 90, 0)`"),
        ),
        (
            "get(\"light.rnge\")",
            "`light` has no field `rnge`",
            Some("did you mean `range`?"),
        ),
        (
            "get(\"light.position\")",
            "`light` has no field `position`",
            Some(
                "it has `kind`, `color`, `intensity`, `range`, `inner_angle`, `outer_angle` and `visible`",
            ),
        ),
        (
            "get(\"lihgt.range\")",
            "there is no component `lihgt`",
            Some("did you mean `light`?"),
        ),
        (
            "get(\"Light.range\")",
            "there is no component `Light`",
            Some("did you mean `light`?"),
        ),
        (
            "get(\"range\")",
            "there is no field `range`",
            Some("did you mean `light.range`?"),
        ),
        (
            "get(7)",
            "`field` of `get` must be the name of a field, as in \"light.range\", not the number 7",
            Some("it is written `.get(field)`"),
        ),
        (
            "get(\"camera.near\")",
            "the entity `lamp` has no `camera`",
            Some("`.add(\"camera\")` gives it one"),
        ),
        (
            "add(\"text_renderer\")",
            "there is no component `text_renderer`",
            Some("did you mean `mesh_renderer`?"),
        ),
        (
            "add(\"world_matrix\")",
            "`world_matrix` is computed by the engine: it can be read, but not changed, added or \
             dropped",
            None,
        ),
        (
            "add(\"velocity\", #{ linaer: vec3(0, 0, 0) })",
            "`velocity` has no field `linaer`",
            Some("did you mean `linear`?"),
        ),
    ] {
        refused(&lamp(call), message, hint);
    }
    refused(
        "let e = spawn(\"e\"); e.remove(); e.set(\"transform.scale\", vec3(1, 1, 1));",
        "the entity was removed and can't be used any more",
        None,
    );
}

#[test]
fn a_component_whose_values_make_no_sense_is_not_added() {
    prints(
        r#"
        let e = spawn("e");
        try {
            e.add("rigid_animation", #{ translation: #{ times: [1, 0], values: [vec3(0, 0, 0), vec3(1, 0, 0)] } });
        } catch { print(e.has_component("rigid_animation")); }
        "#,
        &["false"],
    );
}

#[test]
fn curves_are_maps() {
    let scene = good(
        r#"
        let e = spawn("e").add("rigid_animation", #{
            translation: #{ interpolation: "linear", times: [0, 2], values: [vec3(0, 0, 0), vec3(4, 0, 0)] },
            repeat: "once",
        });
        "#,
    );
    let entity = scene.world.find("e").unwrap();
    let animation: RigidAnimation = scene.world.get(entity).unwrap();
    assert_eq!(
        animation.translation.sample(0.5),
        Some(Vec3::new(1.0, 0.0, 0.0))
    );
}

#[test]
fn writing_by_name_marks_rows_as_the_typed_calls_do() {
    let mut scene = good(
        r#"
        for i in 0..5 { spawn("e " + i); }
        fn update(time, dt) {
            if time == 1 { entity("e 1").set("transform.scale", vec3(2, 2, 2)); }
            if time == 2 { entities().named("e 3").set("transform.translation", vec3(1, 0, 0)); }
            if time == 3 { entity("e 4").at(0, 0, 0); }
        }
        "#,
    );
    for (time, name) in [(1.0, "e 1"), (2.0, "e 3"), (3.0, "e 4")] {
        let seen = scene.world.observe();
        scripts_alone(&mut scene, time);
        let columns = scene.world.columns::<Transform>();
        let changed: Vec<_> = columns.changed_since(seen).collect();
        let row = columns.row_of(scene.world.find(name).unwrap()).unwrap();
        assert_eq!(changed, [row], "{name}");
    }
}

#[test]
fn what_is_aimed_stays_aimed_when_it_is_moved_by_name() {
    let scene = good(
        r#"
        camera("a").look_at(0, 0, 0).set("transform.translation", vec3(5, 0, 0));
        camera("b").look_at(0, 0, 0);
        entities().named("b").set("transform.translation", vec3(0, 0, -5));
        camera("c").look_at(0, 0, 0).set("transform.rotation", turn(0, 0, 0)).at(5, 0, 0);
        spawn("d").look_at(1, 0, 0).add("velocity", #{ angular: vec3(0, 1, 0) }).at(0, 0, 5);
        "#,
    );
    let forward = |name: &str| {
        let transform: Transform = scene.world.get(scene.world.find(name).unwrap()).unwrap();
        transform.rotation * Vec3::NEG_Z
    };
    assert!(forward("a").distance(Vec3::NEG_X) < 1e-6);
    assert!(forward("b").distance(Vec3::Z) < 1e-6);
    assert!(forward("c").distance(Vec3::NEG_Z) < 1e-6);
    // One that spins by itself is turned to no point any more.
    assert!(forward("d").distance(Vec3::X) < 1e-6);
}

#[test]
fn a_near_plane_that_is_set_by_name_stays_before_the_far_one() {
    prints(
        r#"
        let c = camera("c").set("camera.far", 10).set("camera.near", 20);
        print(c.get("camera.near") < c.get("camera.far"));
        "#,
        &["true"],
    );
}

#[test]
fn an_entity_is_found_by_the_name_that_it_was_given_later() {
    prints(
        r#"
        let e = spawn();
        e.name = "one";
        print(entity("one") == e);
        e.set("name.text", "two");
        print(entity("two") == e);
        print(has_entity("one"));
        "#,
        &["true", "true", "false"],
    );
}
