//! Who a hand-in says it is from.
//!
//! A lesson draws numbers for each student, so that a friend's solution does not fit. That holds only if
//! nobody names the friend: two hand-ins of the same id, one whose id is not the one in the list of the
//! course, and files that are the same byte for byte are marked for a person. None of these takes points
//! away by itself.

use std::collections::BTreeMap;

/// What is known of a hand-in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Marked {
    /// What names the student in the system of the course.
    pub student: String,
    /// For whom the hand-in says that it is.
    pub says: Option<String>,
    /// For whom it is by the list of the course.
    pub listed: Option<String>,
    /// Hashes of the files that were handed in and differ from the starter.
    pub files: Vec<(String, String)>,
}

/// Why a person should look at a hand-in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Others say that they are the same student.
    SameId(String, Vec<String>),
    /// It says another id than the list.
    OtherId {
        /// What it says.
        says: String,
        /// What the list says.
        listed: String,
    },
    /// Others have handed in the same file.
    SameFile(String, Vec<String>),
}

impl std::fmt::Display for Reason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::SameId(id, others) => {
                write!(f, "the id `{id}` is also that of {}", others.join(", "))
            }
            Self::OtherId { says, listed } => write!(
                f,
                "it says that it is from `{says}`; the list says `{listed}`, and it was checked with that"
            ),
            Self::SameFile(path, others) => write!(
                f,
                "{path} is the same, byte for byte, as that of {}",
                others.join(", ")
            ),
        }
    }
}

/// Looks at all hand-ins together. The result has the students who have reasons.
#[must_use]
pub fn mark(all: &[Marked]) -> BTreeMap<String, Vec<Reason>> {
    let mut by_id: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut by_file: BTreeMap<(&str, &str), Vec<&str>> = BTreeMap::new();
    for one in all {
        if let Some(says) = &one.says {
            by_id.entry(says).or_default().push(&one.student);
        }
        for (path, hash) in &one.files {
            by_file.entry((path, hash)).or_default().push(&one.student);
        }
    }
    let mut reasons: BTreeMap<String, Vec<Reason>> = BTreeMap::new();
    let mut others = |students: &[&str], reason: &dyn Fn(Vec<String>) -> Reason| {
        if students.len() < 2 {
            return;
        }
        for student in students {
            let others = students.iter().filter(|other| *other != student);
            let others = others.map(|other| (*other).to_owned()).collect();
            let known = reasons.entry((*student).to_owned()).or_default();
            known.push(reason(others));
        }
    };
    for (id, students) in &by_id {
        others(students, &|others| Reason::SameId((*id).to_owned(), others));
    }
    for ((path, _), students) in &by_file {
        others(students, &|others| {
            Reason::SameFile((*path).to_owned(), others)
        });
    }
    for one in all {
        if let (Some(says), Some(listed)) = (&one.says, &one.listed)
            && says != listed
        {
            let (says, listed) = (says.clone(), listed.clone());
            let known = reasons.entry(one.student.clone()).or_default();
            known.push(Reason::OtherId { says, listed });
        }
    }
    reasons
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(student: &str, says: &str, hash: &str) -> Marked {
        Marked {
            student: student.to_owned(),
            says: Some(says.to_owned()),
            listed: None,
            files: vec![("a.wgsl".to_owned(), hash.to_owned())],
        }
    }

    #[test]
    fn the_same_id_and_the_same_file_are_marked_on_all_sides() {
        let mut liar = one("3", "grace", "h3");
        liar.listed = Some("linus".to_owned());
        let all = [
            one("1", "ada", "h1"),
            one("2", "grace", "h1"),
            liar,
            one("4", "d", "h4"),
        ];
        let found = mark(&all);
        let texts = |student: &str| -> Vec<String> {
            let reasons = found.get(student).into_iter().flatten();
            reasons.map(ToString::to_string).collect()
        };
        assert_eq!(
            texts("1"),
            ["a.wgsl is the same, byte for byte, as that of 2"]
        );
        assert_eq!(
            texts("2"),
            [
                "the id `grace` is also that of 3",
                "a.wgsl is the same, byte for byte, as that of 1"
            ]
        );
        assert_eq!(texts("3").len(), 2);
        assert!(texts("3")[1].contains("the list says `linus`"));
        assert!(texts("4").is_empty());
    }
}
