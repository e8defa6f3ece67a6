use lightbench_world::Transform;

use super::{good, prints, refused};

/// Every function on columns against its plain form, value by value.
#[test]
fn columns_give_what_plain_forms_give() {
    let mut checks = String::new();
    let unary = crate::math::UNARY.iter();
    let unary = unary.map(|(form, ..)| form.split('(').next().unwrap());
    for name in unary.chain(["abs", "noise"]) {
        // Inside the domains of all of them.
        checks += &format!("check(\"{name}\", {name}(a), |i| {name}(a[i]));\n");
    }
    for (column, plain) in [
        ("a + b", "a[i] + b[i]"),
        ("a - b", "a[i] - b[i]"),
        ("a * b", "a[i] * b[i]"),
        ("a / b", "a[i] / b[i]"),
        ("-a", "-a[i]"),
        ("2 - a", "2 - a[i]"),
        ("a / 2.5", "a[i] / 2.5"),
        ("1 / a", "1 / a[i]"),
        ("3 * u", "3 * u[i]"),
        ("u * a", "u[i] * a[i]"),
        ("a * u", "a[i] * u[i]"),
        ("u / a", "u[i] / a[i]"),
        ("u / 2", "u[i] / 2"),
        ("u + v", "u[i] + v[i]"),
        ("u - v", "u[i] - v[i]"),
        ("u * v", "u[i] * v[i]"),
        ("u / v", "u[i] / v[i]"),
        ("-u", "-u[i]"),
        ("u + vec3(1, 2, 3)", "u[i] + vec3(1, 2, 3)"),
        ("vec3(1, 2, 3) - u", "vec3(1, 2, 3) - u[i]"),
        ("a * vec3(1, 2, 3)", "a[i] * vec3(1, 2, 3)"),
        ("u.y", "u[i].y"),
        ("vec3(a, 1, b)", "vec3(a[i], 1, b[i])"),
        ("atan(a, b)", "atan(a[i], b[i])"),
        ("atan(2, b)", "atan(2, b[i])"),
        ("atan(2.5, b)", "atan(2.5, b[i])"),
        ("hypot(a, 3)", "hypot(a[i], 3)"),
        ("pow(a, b)", "pow(a[i], b[i])"),
        ("modulo(a, 0.3)", "modulo(a[i], 0.3)"),
        ("min(a, b)", "min(a[i], b[i])"),
        ("max(a, 0.5)", "max(a[i], 0.5)"),
        ("min(0.5, a)", "min(0.5, a[i])"),
        ("min(u, v)", "min(u[i], v[i])"),
        ("max(u, v)", "max(u[i], v[i])"),
        ("clamp(a, 0.2, b)", "clamp(a[i], 0.2, b[i])"),
        ("lerp(a, b, 0.25)", "lerp(a[i], b[i], 0.25)"),
        ("lerp(1, 2, a)", "lerp(1, 2, a[i])"),
        ("lerp(u, v, a)", "lerp(u[i], v[i], a[i])"),
        (
            "lerp(vec3(1, 2, 3), v, 0.5)",
            "lerp(vec3(1, 2, 3), v[i], 0.5)",
        ),
        ("smoothstep(0.1, 0.8, a)", "smoothstep(0.1, 0.8, a[i])"),
        ("length(u)", "u[i].length()"),
        ("normalize(u)", "u[i].normalize()"),
        ("abs(u)", "u[i].abs()"),
        ("dot(u, v)", "u[i].dot(v[i])"),
        ("u.dot(vec3(1, 2, 3))", "u[i].dot(vec3(1, 2, 3))"),
        ("dot(vec3(1, 2, 3), u)", "vec3(1, 2, 3).dot(u[i])"),
        ("cross(u, v)", "u[i].cross(v[i])"),
        ("distance(u, v)", "u[i].distance(v[i])"),
        ("noise(a, b)", "noise(a[i], b[i])"),
        ("noise(a, 0.5, b)", "noise(a[i], 0.5, b[i])"),
        (
            "fractal_noise(a, b, 1, 3)",
            "fractal_noise(a[i], b[i], 1, 3)",
        ),
        (
            "hsv(a * 360, b / 2, 0.5)",
            "{ let c = hsv(a[i] * 360, b[i] / 2, 0.5); vec3(c.r, c.g, c.b) }",
        ),
    ] {
        checks += &format!("check(\"{column}\", {column}, |i| {plain});\n");
    }
    // Named functions see no variables; closures do.
    let text = format!(
        "let r = random(5);
        let a = r.floats(7, 0.01, 0.99);
        let b = r.floats(7, 1, 2);
        let u = r.directions(7) * 3;
        let v = r.directions(7) + vec3(0, 2, 0);
        fn check(name, column, plain) {{
            if column.count != 7 {{ throw name + \" has \" + column.count + \" values\"; }}
            for i in 0..7 {{
                let expected = plain.call(i);
                if column[i] != expected {{ throw `${{name}}: ${{column[i]}}, not ${{expected}}`; }}
            }}
        }}
        {checks}"
    );
    good(&text);
}

#[test]
fn columns_tell_of_themselves() {
    prints(
        r#"
        let c = indices(6);
        print(c);
        print(c.sum());
        print(c.average());
        print(c.smallest() + c.largest());
        print(indices(0).sum());
        c[1] = 7;
        print(c.to_array());
        let u = vec3(indices(2), 1, 2);
        u.y = 5;
        u.z += u.x;
        u[0].x = 9;
        print(u);
        print(u.sum());
        print(u.largest());
        print(column_of([1, 2.5]));
        print(column_of([vec3(1, 2, 3), rgb(0, 1, 0)]).y);
        // Copies are copies.
        let d = c;
        d[0] = 100;
        c += 1;
        print(c[0]);
        let r = random(3);
        let s = random(3);
        let four = r.floats(4);
        for i in 0..4 { if four[i] != s.float() { throw "float"; } }
        let four = r.floats(4, 2, 3);
        for i in 0..4 { if four[i] != s.range(2, 3) { throw "range"; } }
        let four = r.normals(4, 1, 2);
        for i in 0..4 { if four[i] != s.normal(1, 2) { throw "normal"; } }
        let four = r.directions(4);
        for i in 0..4 { if four[i] != s.direction() { throw "direction"; } }
        "#,
        &[
            "column of 6 numbers: 0, 1, 2, 3, …",
            "15.0",
            "2.5",
            "5.0",
            "0.0",
            "[0.0, 7.0, 2.0, 3.0, 4.0, 5.0]",
            "column of 2 vec3: (9, 5, 2), (1, 5, 3)",
            "(10, 10, 5)",
            "(9, 5, 3)",
            "column of 2 numbers: 1, 2.5",
            "column of 2 numbers: 2, 1",
            "1.0",
        ],
    );
}

#[test]
fn mistakes_about_columns_are_told() {
    for (text, message, hint) in [
        (
            "indices(3) + indices(4)",
            "`+` can't combine a column of 3 values with one of 4",
            None,
        ),
        (
            "lerp(indices(3), 1, indices(4))",
            "`lerp` can't combine a column of 3 values with one of 4",
            None,
        ),
        (
            "let a = indices(3); let b = a; a + indices(4)",
            "`+` can't combine a column of 3 values with one of 4",
            None,
        ),
        (
            "indices(3) + vec3(1, 2, 3)",
            "`+` can't combine a column of numbers and a vec3",
            None,
        ),
        (
            "1 / vec3(indices(3), 0, 0)",
            "`/` can't combine a number and a column of vec3",
            None,
        ),
        (
            "indices(3) - \"x\"",
            "`-` can't combine a column and a text",
            None,
        ),
        (
            "length(indices(3))",
            "`column` of `length` must be a vec3 or a column of vec3, not a column",
            Some("it is written `length(column)`"),
        ),
        (
            "sin(vec3(indices(3), 0, 0))",
            "`column` of `sin` must be a number or a column of numbers, not a column",
            Some("it is written `sin(column)`"),
        ),
        (
            "max(indices(3), \"x\")",
            "`b` of `max` must be a number, a vec3 or a column, not the text `x`",
            Some("it is written `max(a, b)`"),
        ),
        (
            "clamp(indices(3), 2, indices(3))",
            "`min` (2) is larger than `max` (0)",
            None,
        ),
        (
            "modulo(indices(3), 0)",
            "`period` of `modulo` must be above 0, not 0",
            None,
        ),
        (
            "hsv(indices(3), indices(3), 1)",
            "`saturation` of `hsv` must be from 0 to 1, not 2",
            None,
        ),
        (
            "indices(2000000)",
            "`count` of `indices` must be from 0 to 1000000, not 2000000",
            None,
        ),
        (
            "indices(3)[3]",
            "`[3]` is outside of the column: it has 3 values, `[0]` to `[2]`",
            None,
        ),
        (
            "indices(3).x",
            "a column of numbers has no `x`",
            Some("only columns of vec3 have parts"),
        ),
        (
            "let u = vec3(indices(3), 0, 0); u.x = indices(2);",
            "`x` can't combine a column of 3 values with one of 2",
            None,
        ),
        (
            "column_of([1, \"x\"])",
            "element `[1]` of the array must be a number, not the text `x`",
            None,
        ),
        (
            "column_of([vec3(0, 0, 0), 1])",
            "element `[1]` of the array must be a vec3, as the first is, not the number 1",
            None,
        ),
        (
            "indices(0).average()",
            "an empty column has no average",
            None,
        ),
    ] {
        refused(text, message, hint);
    }
}

#[test]
fn moving_by_columns_is_the_same_as_moving_one_by_one_and_repeats() {
    let scene = |update: &str| {
        let mut scene = good(&format!(
            "for i in 0..100 {{ spawn(\"mote \" + i).at(i, 0, 0); }}
            state.motes = entities().named(\"mote *\");
            state.phase = random(1).floats(100, 0, 6);
            fn update(time, dt) {{ {update} }}"
        ));
        for frame in 1..=5 {
            scene.update(f64::from(frame) / 60.0, 1.0 / 60.0).unwrap();
        }
        scene.world.columns::<Transform>().translation().to_vec()
    };
    let columns = "let p = state.motes.get(\"transform.translation\");
        let angle = state.phase + time;
        p += vec3(cos(angle), 0, sin(angle)) * dt;
        p.y = noise(p.x, time);
        state.motes.set(\"transform.translation\", p);";
    let one_by_one = "let i = 0;
        for mote in state.motes {
            let p = mote.position;
            let angle = state.phase[i] + time;
            p += vec3(cos(angle), 0, sin(angle)) * dt;
            p.y = noise(p.x, time);
            mote.at(p);
            i += 1;
        }";
    let moved = scene(columns);
    assert!(moved[3].y != 0.0);
    assert_eq!(moved, scene(one_by_one));
    assert_eq!(moved, scene(columns));
}
