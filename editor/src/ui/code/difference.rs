//! Which lines two texts have in common.

/// What a line is in the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// In both texts.
    Both,
    /// In the first one alone.
    First,
    /// In the second one alone.
    Second,
}

/// Edits above which what lies between common beginnings and ends counts as changed altogether: the
/// search takes their square in time and memory.
const MOST_EDITS: usize = 1500;

/// The lines of both texts in order, each with where it belongs.
///
/// The fewest lines are called different that can be, by the greedy search of Myers 1986 ("An
/// O(ND) difference algorithm and its variations", section 3).
pub fn compare<'a>(first: &'a str, second: &'a str) -> Vec<(Side, &'a str)> {
    let a: Vec<&str> = first.lines().collect();
    let b: Vec<&str> = second.lines().collect();
    let head = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let ends = a[head..].iter().rev().zip(b[head..].iter().rev());
    let tail = ends.take_while(|(a, b)| a == b).count();
    let (middle_a, middle_b) = (&a[head..a.len() - tail], &b[head..b.len() - tail]);

    let mut lines: Vec<(Side, &str)> = a[..head].iter().map(|line| (Side::Both, *line)).collect();
    match trace(middle_a, middle_b) {
        Some(trace) => lines.extend(walk(&trace, middle_a, middle_b)),
        None => {
            lines.extend(middle_a.iter().map(|line| (Side::First, *line)));
            lines.extend(middle_b.iter().map(|line| (Side::Second, *line)));
        }
    }
    lines.extend(a[a.len() - tail..].iter().map(|line| (Side::Both, *line)));
    lines
}

/// For each number of edits, how far the first text is used up on each diagonal.
fn trace(a: &[&str], b: &[&str]) -> Option<Vec<Vec<usize>>> {
    let most = (a.len() + b.len()).min(MOST_EDITS);
    // Diagonal k is at k + most + 1.
    let middle = most + 1;
    let mut furthest = vec![0_usize; 2 * most + 3];
    let mut trace = Vec::new();
    for edits in 0..=most {
        trace.push(furthest[middle - edits..=middle + edits].to_vec());
        for k in (-(edits as isize)..=edits as isize).step_by(2) {
            let at = middle.wrapping_add_signed(k);
            let down = k == -(edits as isize)
                || k != edits as isize && furthest[at - 1] < furthest[at + 1];
            let mut x = if down {
                furthest[at + 1]
            } else {
                furthest[at - 1] + 1
            };
            let mut y = x.wrapping_add_signed(-k);
            while x < a.len() && y < b.len() && a[x] == b[y] {
                x += 1;
                y += 1;
            }
            furthest[at] = x;
            if x >= a.len() && y >= b.len() {
                return Some(trace);
            }
        }
    }
    None
}

/// The way back from the ends of both texts.
fn walk<'a>(trace: &[Vec<usize>], a: &[&'a str], b: &[&'a str]) -> Vec<(Side, &'a str)> {
    let (mut x, mut y) = (a.len(), b.len());
    let mut back = Vec::new();
    for (edits, row) in trace.iter().enumerate().rev() {
        // The row holds the diagonals from -edits to edits, as they were before this edit.
        let of = |k: isize| row[(k + edits as isize) as usize];
        let k = x as isize - y as isize;
        let (before_x, before_y) = if edits == 0 {
            (0, 0)
        } else {
            let last = edits as isize;
            let down = k == -last || k != last && of(k - 1) < of(k + 1);
            let from = if down { k + 1 } else { k - 1 };
            let from_x = of(from);
            (from_x, from_x.wrapping_add_signed(-from))
        };
        while x > before_x && y > before_y {
            x -= 1;
            y -= 1;
            back.push((Side::Both, a[x]));
        }
        if x > before_x {
            x -= 1;
            back.push((Side::First, a[x]));
        } else if y > before_y {
            y -= 1;
            back.push((Side::Second, b[y]));
        }
    }
    back.reverse();
    back
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts_of(lines: &[(Side, &str)]) -> (Vec<String>, Vec<String>, usize) {
        let of = |left_out: Side| {
            let kept = lines.iter().filter(|(side, _)| *side != left_out);
            kept.map(|(_, line)| (*line).to_owned()).collect()
        };
        let changed = lines.iter().filter(|(side, _)| *side != Side::Both);
        (of(Side::Second), of(Side::First), changed.count())
    }

    /// The least number of lines that must go or come, by the longest common subsequence.
    fn least_changes(a: &[&str], b: &[&str]) -> usize {
        let mut above = vec![0; b.len() + 1];
        for line in a {
            let mut row = vec![0; b.len() + 1];
            for j in 1..=b.len() {
                row[j] = if *line == b[j - 1] {
                    above[j - 1] + 1
                } else {
                    above[j].max(row[j - 1])
                };
            }
            above = row;
        }
        a.len() + b.len() - 2 * above[b.len()]
    }

    #[test]
    fn both_texts_are_in_the_comparison_and_the_fewest_lines_differ() {
        let mut state = 7_u64;
        let mut next = |below: u64| {
            // The multiplier is that of Knuth's MMIX.
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) % below
        };
        for round in 0..300 {
            let mut text = || -> String {
                let count = next(if round < 150 { 9 } else { 40 });
                (0..count).map(|_| format!("{}\n", next(5))).collect()
            };
            let (first, second) = (text(), text());
            let lines = compare(&first, &second);
            let (a, b, changed) = texts_of(&lines);
            let (first, second): (Vec<&str>, Vec<&str>) =
                (first.lines().collect(), second.lines().collect());
            assert_eq!(a, first);
            assert_eq!(b, second);
            assert_eq!(
                changed,
                least_changes(&first, &second),
                "{first:?} {second:?}"
            );
        }
    }

    #[test]
    fn a_line_between_others_is_told_alone() {
        let lines = compare("a\nb\nc\n", "a\nx\nc\n");
        let expected = [
            (Side::Both, "a"),
            (Side::First, "b"),
            (Side::Second, "x"),
            (Side::Both, "c"),
        ];
        assert_eq!(lines, expected);
    }

    #[test]
    fn texts_without_a_common_line_are_told_one_after_the_other() {
        let text = |from: usize| -> String {
            (from..from + 2000)
                .map(|line| format!("{line}\n"))
                .collect()
        };
        let (first, second) = (text(0), text(5000));
        let lines = compare(&first, &second);
        let (_, _, changed) = texts_of(&lines);
        assert_eq!(changed, 4000);
    }
}
