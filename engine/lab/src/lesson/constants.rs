//! Numbers that differ from student to student, and are the same each time for one.

use lightbench_assets::Digest;

use super::model::Constant;

impl Constant {
    /// Its value for a student of a lesson; the default without one.
    ///
    /// The hash of the three names chooses one of the steps from `from` to `to`. It is the same on
    /// every machine and in every version.
    #[must_use]
    pub fn value(&self, lesson: &str, student: Option<&str>) -> f64 {
        let Some(student) = student else {
            return self.default;
        };
        // Lengths before the names, so that no two triples make one text.
        let names = [lesson, &self.name, student];
        let text: String = names
            .map(|name| format!("{} {name}\n", name.len()))
            .concat();
        let digest = Digest::of(text.as_bytes()).to_string();
        let random = u64::from_str_radix(&digest[..16], 16).unwrap_or(0);
        let values = self.steps() + 1;
        self.from + (random % values) as f64 * self.step
    }

    /// How many steps lie between the least and the most.
    pub(super) fn steps(&self) -> u64 {
        // What decimal fractions lose in binary must not cost a step.
        ((self.to - self.from) / self.step + 1e-9).floor().max(0.0) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lesson::Words;

    fn constant() -> Constant {
        Constant {
            name: "angle".to_owned(),
            title: Words::same("angle"),
            unit: String::new(),
            from: 20.0,
            to: 70.0,
            step: 5.0,
            default: 35.0,
        }
    }

    #[test]
    fn each_student_has_one_value_and_all_values_occur() {
        let angle = constant();
        assert_eq!(angle.value("01-x", None), 35.0);
        let students: Vec<String> = (0..400).map(|n| format!("student {n}")).collect();
        let value = |student: &String| angle.value("01-x", Some(student));
        let mut counts = [0; 11];
        for student in &students {
            let step = (value(student) - 20.0) / 5.0;
            assert_eq!(step.fract(), 0.0);
            counts[step as usize] += 1;
            assert_eq!(value(student), value(student));
        }
        // 36 of each on average, with a deviation of 6.
        assert!(
            counts.iter().all(|count| (15..=60).contains(count)),
            "{counts:?}"
        );
        let other = |student: &String| angle.value("02-y", Some(student));
        assert!(
            students
                .iter()
                .any(|student| value(student) != other(student))
        );
    }
}
