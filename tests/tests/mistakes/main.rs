//! Mistakes that are planted into a good pipeline, and what must be said of each: exactly that, at
//! exactly that place, before anything is drawn.
//!
//! `table.txt` lists them, each as an edit of the project in `lab/` and the report that it must
//! cause. The way is that of the program: files in a project folder, `load_pipeline`,
//! `Compiler::compile`.
#![allow(clippy::unwrap_used)]

mod table;
mod workshop;

use table::Mistake;
use workshop::Workshop;

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mistakes/table.txt");

#[test]
fn every_mistake_of_the_table_is_told_exactly() {
    let mistakes = table::read(&std::fs::read_to_string(TABLE).unwrap());
    assert!(
        mistakes.len() >= 60,
        "the table has {} mistakes",
        mistakes.len()
    );
    let mut workshop = Workshop::new();
    assert_eq!(workshop.report(false), "", "the lab itself must be good");
    let mut wrong = Vec::new();
    for mistake in &mistakes {
        let found = report(&mut workshop, mistake);
        if found != mistake.expected {
            wrong.push(format!(
                "line {}: {}\n--- expected\n{}--- found\n{found}",
                mistake.line, mistake.title, mistake.expected
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(workshop.report(false), "", "the lab is good again");
}

fn report(workshop: &mut Workshop, mistake: &Mistake) -> String {
    for edit in &mistake.edits {
        workshop.edit(edit);
    }
    let report = workshop.report(mistake.portable);
    workshop.restore();
    report
}
