//! Random edits of the shipped pipelines and shaders: lost lines, swapped words, changed numbers,
//! files cut short or put in each other's place. Whatever is saved, nothing panics or hangs, and what
//! is refused is refused with a place.
//!
//! Every run takes fresh seeds. A failure names its seed; put it into `seeds.txt`, whose edits are
//! tried in every run. `LIGHTBENCH_SEED` begins with a seed of choice, `LIGHTBENCH_SOAK` tries as many
//! as `./x soak` does.
#![allow(clippy::unwrap_used)]

mod bench;
mod children;

use std::hash::{BuildHasher as _, RandomState};

use bench::Bench;
use children::Fate;

/// Seeds of edits that once went wrong.
const PAST: &str = include_str!("seeds.txt");

/// How many edits are tried, in a usual run and in a long one.
const TRIED: (usize, usize) = (150, 20_000);
/// How many accepted edits are drawn.
const DRAWN: (usize, usize) = (6, 200);
/// After so many failures no more are looked for.
const ENOUGH: usize = 20;

fn count((usual, soak): (usize, usize)) -> usize {
    match std::env::var("LIGHTBENCH_SOAK") {
        Ok(_) => soak,
        Err(_) => usual,
    }
}

/// This run's seeds: one after the other.
fn fresh_seeds() -> impl Iterator<Item = u64> {
    let first = match std::env::var("LIGHTBENCH_SEED") {
        Ok(seed) => seed.parse().unwrap(),
        // Small enough to be typed.
        Err(_) => RandomState::new().hash_one(0) >> 24,
    };
    println!("LIGHTBENCH_SEED={first}");
    first..
}

fn past_seeds() -> impl Iterator<Item = u64> {
    let seeds = PAST.lines().filter_map(|line| line.split('#').next());
    let seeds = seeds.map(str::trim).filter(|seed| !seed.is_empty());
    seeds.map(|seed| seed.parse().unwrap())
}

/// Compiles the edits of some seeds, and fails where one does what must never happen. Gives the
/// seeds that were accepted.
fn try_all(seeds: impl Iterator<Item = u64>) -> Vec<u64> {
    let (mut accepted, mut wrong) = (Vec::new(), Vec::new());
    let mut told: Option<Bench> = None;
    children::run(seeds, false, |seed, fate| {
        let complaint = match fate {
            Fate::Good => return accepted.push(seed),
            Fate::Refused => return,
            Fate::Endless => "it takes too long".to_owned(),
            Fate::Crashed => "it ends the program".to_owned(),
            Fate::Wrong(complaint) => complaint,
        };
        let bench = told.get_or_insert_with(Bench::new);
        let report = format!("{}{complaint}\n", bench.describe(&bench.edit(seed)));
        // At once: a long run may be ended before it is through.
        println!("{report}");
        wrong.push(report);
        assert!(
            wrong.len() < ENOUGH,
            "{ENOUGH} edits went wrong:\n{}",
            wrong.join("\n")
        );
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    accepted
}

#[test]
fn random_edits_work_or_are_refused_with_a_place() {
    let count = count(TRIED);
    let accepted = try_all(fresh_seeds().take(count)).len();
    println!("of {count} edits {accepted} were accepted");
    // Most edits break something, but comments, numbers and orders of lines may change.
    assert!(accepted * 50 > count && accepted * 4 < count * 3);
}

#[test]
fn edits_that_once_went_wrong_do_not_any_more() {
    try_all(past_seeds());
}

#[test]
fn accepted_edits_are_drawn_or_end_in_their_own_process() {
    let wanted = count(DRAWN);
    let mut seeds = fresh_seeds();
    let mut accepted = Vec::new();
    while accepted.len() < wanted {
        accepted.extend(try_all(seeds.by_ref().take(30)));
    }
    accepted.truncate(wanted);
    let (mut good, mut refused, mut endless, mut crashed) = (0, 0, 0, 0);
    let mut wrong = Vec::new();
    children::run(accepted, true, |seed, fate| match fate {
        Fate::Good => good += 1,
        Fate::Refused => refused += 1,
        Fate::Endless => endless += 1,
        Fate::Crashed => crashed += 1,
        Fate::Wrong(complaint) => {
            println!("seed {seed}: {complaint}");
            wrong.push(format!("seed {seed}: {complaint}"));
        }
    });
    println!("{good} drawn, {refused} refused, {endless} endless, {crashed} crashed");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(
        good + refused + endless + crashed,
        wanted,
        "every edit is counted"
    );
    assert!(
        good * 2 > wanted,
        "of {wanted} edits only {good} were drawn"
    );
}

/// Not a test by itself: the process in which edits are tried.
#[test]
#[ignore = "the child process of other tests"]
fn child_that_tries_edits() {
    children::work();
}
