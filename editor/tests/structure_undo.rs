//! Ten thousand random changes by hand, taken back and done again. `cargo bench --bench
//! structure_undo` does a hundred thousand.

mod random_edits;

#[test]
fn random_changes_are_taken_back_and_done_again_exactly() {
    let counts = random_edits::run(1, 10_000, 1_000);
    // It has done what it says.
    assert!(counts.changes > 4_000, "{counts:?}");
    assert!(counts.steps > 2_000 && counts.refused > 500, "{counts:?}");
    assert!(counts.undone > 1_000 && counts.redone > 50, "{counts:?}");
    assert!(counts.saved == 10 && counts.loaded == 11, "{counts:?}");
}

#[test]
fn other_seeds_and_many_loads() {
    for seed in 2..10 {
        random_edits::run(seed, 300, 10);
    }
}
