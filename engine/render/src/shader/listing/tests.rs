#![allow(clippy::unwrap_used)]
use super::*;

fn listing(text: &str, defines: &[(&str, Option<i32>)]) -> Result<Listing, Problem> {
    let defines = defines
        .iter()
        .map(|(name, value)| ((*name).to_owned(), *value))
        .collect();
    Listing::new("a.wgsl", text, &defines, false)
}

#[test]
fn only_taken_branches_are_left_in_their_places() {
    let text = "#import lightbench::scene\n#ifdef A // why\nlet a = 1;\n#else ifdef B\nlet b;\n\
                #else\n  let c = #{N}u + 2;\n#endif\nlet d;\n";
    let blank = |count| " ".repeat(count);
    let found = listing(text, &[("N", Some(7))]).unwrap();
    let expected = [
        blank(25),
        blank(15),
        blank(10),
        blank(13),
        blank(6),
        blank(5),
        "  let c =     u + 2;".to_owned(),
        blank(6),
        "let d;".to_owned(),
        String::new(),
    ];
    assert_eq!(found.active.split('\n').collect::<Vec<_>>(), expected);
    assert_eq!(found.mentions.iter().collect::<Vec<_>>(), ["A", "B", "N"]);
    let both = listing(text, &[("A", None), ("B", None)]).unwrap();
    assert!(both.active.contains("let a") && !both.active.contains("let b"));
    let second = listing(text, &[("B", None)]).unwrap();
    assert!(second.active.contains("let b") && !second.active.contains("let c"));
}

#[test]
fn conditions_compare_values() {
    let taken = |line: &str, defines: &[(&str, Option<i32>)]| {
        let found = listing(&format!("{line}\nx\n#endif"), defines).unwrap();
        found.active.contains('x')
    };
    for (sign, results) in [
        ("==", [false, true, false]),
        ("!=", [true, false, true]),
        ("<", [true, false, false]),
        ("<=", [true, true, false]),
        (">", [false, false, true]),
        (">=", [false, true, true]),
    ] {
        for (value, result) in [1, 2, 3].into_iter().zip(results) {
            let line = format!("#if N {sign} 2");
            assert_eq!(
                taken(&line, &[("N", Some(value))]),
                result,
                "{value} {sign} 2"
            );
        }
    }
    assert!(taken("#if N == true", &[("N", None)]));
    assert!(!taken("#if N != true", &[("N", None)]));
}

#[test]
fn mistakes_are_found_at_their_place() {
    for (text, line, column, message) in [
        (
            "a\n #ifdfe A\n#endif",
            2,
            2,
            "there is no directive `#ifdfe`",
        ),
        ("#ifdef A\nb", 1, 1, "this branch never ends"),
        ("a\n#endif", 2, 1, "this `#endif` ends nothing"),
        ("#else\n", 1, 1, "this `#else` belongs to no branch"),
        ("let é = #{B};", 1, 9, "`B` is not defined"),
        (
            "#if B > 2\n#endif",
            1,
            1,
            "`B` is not defined, so it has no value to compare",
        ),
        ("#if B\n#endif", 1, 1, "`#if B` compares nothing"),
        ("#ifdef\n#endif", 1, 1, "`#ifdef` names nothing"),
        ("x # y", 1, 3, "`#` stands for nothing here"),
    ] {
        let problem = listing(text, &[("A", Some(1))]).unwrap_err();
        let place = (problem.place.line, problem.place.column);
        assert_eq!((place, problem.message.as_str()), ((line, column), message));
        assert!(problem.hint.is_some(), "{text}");
    }
    let problem = listing("#ifdfe A\n#endif", &[]).unwrap_err();
    assert_eq!(problem.hint.as_deref(), Some("did you mean `#ifdef`?"));
    let problem = listing("x = #{TILE}", &[("TIEL", None)]).unwrap_err();
    let hint = "the pass defines `TIEL`: did you mean `TILE`?";
    assert_eq!(problem.hint.as_deref(), Some(hint));
    let module = Listing::new("m.wgsl", "#define A 1", &Defines::new(), true);
    assert_eq!(
        module.unwrap_err().message,
        "a module can't define anything"
    );
}
