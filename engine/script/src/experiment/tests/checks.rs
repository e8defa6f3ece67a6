//! What the functions of checks hand to the examiner, and what they refuse.

use std::sync::{Arc, Mutex};

use lightbench_assets::Progress;

use super::numbers::Numbers;
use crate::experiment::checks::Bound;
use crate::experiment::{
    CheckFault, CheckScript, Data, Evidence, Examiner, Given, LaboratoryError, Told,
};
use crate::testing::project;

/// Notes all evidence, and finds all of it right but for what is called `wrong`.
#[derive(Clone, Default)]
struct Notes(Arc<Mutex<Vec<(String, Evidence)>>>);

impl Examiner for Notes {
    fn judge(&mut self, criterion: &str, evidence: Evidence) -> Result<bool, LaboratoryError> {
        if criterion == "unknown" {
            return Err(LaboratoryError::Other("no such criterion".to_owned()));
        }
        self.0
            .lock()
            .unwrap()
            .push((criterion.to_owned(), evidence));
        Ok(criterion != "wrong")
    }

    fn constant(&self, name: &str) -> Result<f64, LaboratoryError> {
        match name {
            "angle" => Ok(35.0),
            _ => Err(LaboratoryError::Other("no such constant".to_owned())),
        }
    }
}

/// Runs the body of a check, whose frame of the work has 8 x 4 pixels.
fn run(body: &str, report: Option<&Data>) -> (Result<Given, CheckFault>, Vec<(String, Evidence)>) {
    let arguments = if report.is_some() {
        "work, report"
    } else {
        "work"
    };
    let text = format!(
        "const SIZE = [8, 4];\nfn check({arguments}) {{\nlet frame = work.draw(\"s\", \"p\", #{{ size: SIZE }});\n{body}\n}}"
    );
    let (_folder, files) = project(&[("checks.rhai", &text)]);
    let notes = Notes::default();
    let laboratory = || Box::<Numbers>::default() as Box<_>;
    let loaded = CheckScript::load(
        &files,
        "checks.rhai",
        [laboratory(), laboratory()],
        Box::new(notes.clone()),
        |_| {},
        &Progress::new(),
    );
    let mut script = loaded.map_err(|problems| problems.to_string()).unwrap();
    let count = usize::from(report.is_some()) + 1;
    assert_eq!(script.functions(), [("check".to_owned(), count)]);
    let given = script.run("check", report);
    let evidence = std::mem::take(&mut *notes.0.lock().unwrap());
    (given, evidence)
}

fn evidence(body: &str) -> Vec<Evidence> {
    let (given, evidence) = run(body, None);
    given.map_err(|fault| format!("{fault:?}")).unwrap();
    evidence.into_iter().map(|(_, evidence)| evidence).collect()
}

/// What is told of a body, and the line.
fn told(body: &str) -> String {
    match run(body, None).0 {
        Err(CheckFault::Check(problem)) => problem.to_string(),
        other => panic!("{body}: {other:?}"),
    }
}

#[test]
fn pictures_are_compared_where_and_as_was_asked() {
    let found = evidence(
        "let image = frame.target(\"hdr\");
        let right = draw(\"s\", \"p\", #{ size: SIZE }).target(\"hdr\");
        work.same_picture(\"a\", image, right, #{
            absolute: 0.5, share: 0.1, within: [[2, 1], [3, 2]], mistakes: #{ swapped: image },
        });
        work.same_picture(\"a\", frame.target(\"ids\"), frame.target(\"ids\"));",
    );
    let Evidence::Picture {
        found: image,
        expected,
        mistakes,
        bound,
    } = &found[0]
    else {
        panic!("{found:?}");
    };
    assert_eq!((image.width, expected.channels), (8, 3));
    let compared = expected
        .texels
        .iter()
        .zip(0..)
        .filter(|(texel, _)| texel.is_some());
    let compared: Vec<i32> = compared.map(|(_, index)| index).collect();
    assert_eq!(compared, [10, 11, 12, 18, 19, 20]);
    assert_eq!(expected.texels[10], Some([2.0, 1.0, 1.0, 0.0]));
    assert_eq!(
        *bound,
        Bound {
            absolute: 0.5,
            relative: 0.0,
            share: 0.1
        }
    );
    assert_eq!((mistakes.len(), mistakes[0].0.as_str()), (1, "swapped"));
    let Evidence::Picture {
        expected, bound, ..
    } = &found[1]
    else {
        panic!("{found:?}");
    };
    assert_eq!((expected.channels, bound.relative), (1, 0.002));
}

#[test]
fn closed_forms_are_asked_on_a_grid() {
    let found = evidence(
        "let twice = 2;
        work.same_values(\"a\", frame.target(\"hdr\"), |x, y| if x == 1 { () } else { [twice * x, y] }, #{
            every: 2, mistakes: #{ other: |x, y| [y, x] },
        });",
    );
    let Evidence::Picture {
        expected, mistakes, ..
    } = &found[0]
    else {
        panic!("{found:?}");
    };
    assert_eq!(expected.channels, 2);
    let at = |expected: &crate::experiment::Expected| -> Vec<(usize, [f32; 2])> {
        let texels = expected.texels.iter().enumerate();
        texels
            .filter_map(|(index, texel)| texel.map(|t| (index, [t[0], t[1]])))
            .collect()
    };
    // Columns 1, 3, 5 and 7 of rows 1 and 3, of which nothing is expected in the first.
    let row = |y: usize| [3, 5, 7].map(|x| (8 * y + x, [2.0 * x as f32, y as f32]));
    assert_eq!(at(expected), [row(1), row(3)].concat());
    assert_eq!(at(&mistakes[0].1).len(), 8);
}

/// An area that is narrower than half a step has a point too.
#[test]
fn a_single_row_is_looked_at() {
    let found = evidence(
        "work.same_values(\"a\", frame.target(\"hdr\"), |x, y| [x, y], #{
            every: 4, within: [[0, 3], [8, 1]],
        });",
    );
    let Evidence::Picture { expected, .. } = &found[0] else {
        panic!("{found:?}");
    };
    let texels = expected.texels.iter().enumerate();
    let looked: Vec<usize> = texels.filter_map(|(at, texel)| texel.map(|_| at)).collect();
    // Columns 2 and 6 of row 3.
    assert_eq!(looked, [8 * 3 + 2, 8 * 3 + 6]);
}

#[test]
fn numbers_limits_and_statements_are_handed_on() {
    let found = evidence(
        "let held = work.same_number(\"wrong\", work.constant(\"angle\"), 3, #{
            relative: 0.1, unit: \"m\", mistakes: #{ twice: 6 },
        });
        work.at_most(\"a\", 0.0 / 0.0, 1);
        work.at_least(\"a\", 2, 1.5, #{ margin: 0.1, mistake: \"low\" });
        work.same(\"a\", frame.passes, [\"g_buffer\", \"lights\"]);
        work.same(\"a\", frame.formats.hdr, \"rgba32float\");
        work.holds(\"a\", held, #{ en: \"yes\", es: \"sí\" }, frame.pixel_bytes(\"hdr\"));
        work.same(\"a\", frame.kinds, [\"clear\", \"clear\"]);",
    );
    let bound = Bound {
        absolute: 0.0,
        relative: 0.1,
        share: 0.0,
    };
    assert_eq!(
        found[0],
        Evidence::Number {
            found: 35.0,
            expected: 3.0,
            mistakes: vec![("twice".to_owned(), 6.0)],
            bound,
            unit: "m".to_owned(),
        }
    );
    assert!(matches!(&found[1], Evidence::Limit { found, at_least: false, .. } if found.is_nan()));
    assert!(
        matches!(&found[2], Evidence::Limit { at_least: true, margin: 0.1, mistake: Some(m), .. } if m == "low")
    );
    assert!(matches!(&found[3], Evidence::Statement { holds: true, .. }));
    let words = |en: &str, es: &str| Told {
        en: en.to_owned(),
        es: es.to_owned(),
    };
    let statement = |holds, found, expected| Evidence::Statement {
        holds,
        found,
        expected,
        mistake: None,
    };
    let formats = [
        words("rgba16float", "rgba16float"),
        words("rgba32float", "rgba32float"),
    ];
    assert_eq!(
        found[4],
        statement(false, formats[0].clone(), formats[1].clone())
    );
    // What was judged wrong is known to the check.
    assert_eq!(
        found[5],
        statement(false, words("yes", "sí"), words("8", "8"))
    );
    assert!(matches!(&found[6], Evidence::Statement { holds: true, .. }));
}

#[test]
fn answers_see_their_report() {
    let entry = |name: &str, value| (name.to_owned(), value);
    let report = Data::Map(vec![
        entry(
            "bytes",
            Data::List(vec![Data::Number(3.0), Data::Number(4.5)]),
        ),
        entry("name", Data::Text("x".to_owned())),
        entry("none", Data::Nothing),
    ]);
    let given = |body| run(body, Some(&report)).0.unwrap();
    assert_eq!(
        given("report.bytes[0] + report.bytes[1]"),
        Given::Number(7.5)
    );
    assert_eq!(
        given("if report.none == () { report.name }"),
        Given::Text("x".to_owned())
    );
    assert_eq!(given("()"), Given::Nothing);
}

#[test]
fn faults_of_the_work_are_told_from_those_of_the_check() {
    let (given, _) = run("frame.target(\"hdr\", #{ mip: 9 });", None);
    assert!(matches!(given, Err(CheckFault::Work(_))), "{given:?}");
    let (given, _) = run("draw(\"s\", \"p\").target(\"hdr\", #{ mip: 9 });", None);
    assert!(matches!(given, Err(CheckFault::Check(_))), "{given:?}");
}

#[test]
fn wrong_calls_are_told_at_their_line() {
    for (body, parts) in [
        (
            "work.same_number(\"unknown\", 1, 1);",
            ["checks.rhai:4:", "no such criterion"],
        ),
        (
            "work.constant(\"angel\");",
            ["checks.rhai:4:", "no such constant"],
        ),
        (
            "work.same_number(\"a\", \"x\", 1);",
            [
                "checks.rhai:4:",
                "`found` of `same_number` must be a number",
            ],
        ),
        (
            "work.same_values(\"a\", frame.target(\"hdr\"), 3);",
            ["checks.rhai:4:", "a function of x and y"],
        ),
        (
            "work.same_values(\"a\", frame.target(\"hdr\"), |x, y| \"red\");",
            ["checks.rhai:4:", "must give a number"],
        ),
        (
            "work.same_picture(\"a\", frame.target(\"hdr\"), draw(\"s\", \"p\", #{ size: [4, 4] }).target(\"hdr\"));",
            ["checks.rhai:4:", "can't be compared"],
        ),
        (
            "work.same_picture(\"a\", frame.target(\"hdr\"), frame.target(\"hdr\"), #{ within: [[0, 0], [9, 1]] });",
            ["checks.rhai:4:", "inside of the image"],
        ),
        (
            "work.same_picture(\"a\", frame.target(\"hdr\"), frame.target(\"hdr\"), #{ tolerance: 1 });",
            ["checks.rhai:4:", "no option `tolerance`"],
        ),
        (
            "work.same_number(\"a\", 1, 1, #{ mistakes: #{ twice: \"2\" } });",
            ["checks.rhai:4:", "a map from names of mistakes to numbers"],
        ),
        (
            "frame.pixel_bytes(\"hdrr\");",
            ["checks.rhai:4:", "did you mean `hdr`"],
        ),
    ] {
        let told = told(body);
        for part in parts {
            assert!(told.contains(part), "no `{part}` in {told}");
        }
    }
}
