#![allow(clippy::unwrap_used)]
use super::*;

/// So many bytes that cost nothing.
#[derive(Clone, Debug, PartialEq)]
struct Weight(usize);

impl Kept for Weight {
    fn bytes(&self) -> usize {
        self.0
    }
}

/// The bytes of a thing of weight 0.
const EMPTY: usize = BYTES_OF_AN_ITEM;

fn weigh(reuse: &Reuse, name: &str, weight: usize) {
    reuse.get("weight", name, || Weight(weight - EMPTY));
}

fn made(cache: &Cache) -> u64 {
    let made = cache.statistics().made;
    made.get("weight").copied().unwrap_or(0)
}

#[test]
fn a_thing_is_made_once_for_each_of_what_it_is_made_of() {
    let cache = Cache::default();
    for _ in 0..5 {
        let reuse = cache.begin();
        for name in ["a", "b", "a"] {
            weigh(&reuse, name, 1000);
        }
        reuse.finish();
    }
    let statistics = cache.statistics();
    assert_eq!((made(&cache), statistics.found["weight"]), (2, 13));
    assert_eq!((statistics.items, statistics.bytes), (2, 2000));
}

#[test]
fn kinds_are_apart_and_failures_are_not_kept() {
    let reuse = Reuse::default();
    reuse.get("one", "a", || Weight(1));
    assert_eq!(reuse.get("other", "a", || Weight(2)), Weight(2));
    let fails: Result<Weight, &str> = reuse.try_get("third", "a", || Err("no"));
    assert_eq!(fails, Err("no"));
    let works: Result<Weight, &str> = reuse.try_get("third", "a", || Ok(Weight(3)));
    assert_eq!(works, Ok(Weight(3)));
}

#[test]
fn what_several_loads_did_not_use_is_dropped() {
    let cache = Cache::default();
    let load = |names: &[&str]| {
        let reuse = cache.begin();
        names.iter().for_each(|name| weigh(&reuse, name, 1000));
        reuse.finish();
    };
    load(&["a", "b"]);
    load(&["b"]);
    load(&["b"]);
    assert_eq!(cache.statistics().items, 2);
    load(&["a", "b"]);
    assert_eq!(made(&cache), 2, "`a` was still there");
    for _ in 0..3 {
        load(&["b"]);
    }
    assert_eq!(cache.statistics().items, 1);
    assert_eq!(cache.statistics().bytes, 1000);
    load(&["a"]);
    assert_eq!(made(&cache), 3);
}

#[test]
fn loads_that_fail_let_nothing_age() {
    let cache = Cache::default();
    let reuse = cache.begin();
    weigh(&reuse, "a", 1000);
    reuse.finish();
    for _ in 0..10 {
        // A script with a mistake in its first line.
        let _ = cache.begin();
    }
    cache.begin().finish();
    assert_eq!(cache.statistics().items, 1);
}

#[test]
fn the_oldest_things_make_room_and_those_of_the_same_load_stay() {
    let cache = Cache::with_limit(10_000);
    let first = cache.begin();
    (0..4).for_each(|n| weigh(&first, &format!("first {n}"), 1000));
    first.finish();
    let second = cache.begin();
    (0..6).for_each(|n| weigh(&second, &format!("second {n}"), 1000));
    second.finish();

    let third = cache.begin();
    weigh(&third, "second 0", 1000);
    // Full: the things of the first load go.
    weigh(&third, "third", 2000);
    assert_eq!(cache.statistics().bytes, 8000);
    assert_eq!(made(&cache), 11);
    // What is larger than the cache drives nothing out.
    weigh(&third, "huge", 20_000);
    assert_eq!(cache.statistics().bytes, 8000);
    // A loop with another parameter each time: the rest of the second load goes, nothing else.
    (0..1000).for_each(|n| weigh(&third, &format!("loop {n}"), 1000));
    assert_eq!(cache.statistics().bytes, 10_000);
    let before = made(&cache);
    for name in ["second 0", "loop 0", "loop 6"] {
        weigh(&third, name, 1000);
    }
    weigh(&third, "third", 2000);
    assert_eq!(made(&cache), before);
    weigh(&third, "loop 7", 1000);
    assert_eq!(made(&cache), before + 1);
}

#[test]
fn a_scene_that_goes_on_keeps_what_it_uses_beside_newer_loads() {
    let cache = Cache::default();
    let playing = cache.begin();
    playing.finish();
    for _ in 0..2 {
        cache.begin().finish();
    }
    weigh(&playing, "late", 1000);
    let newer = cache.begin();
    weigh(&newer, "late", 1000);
    weigh(&playing, "late", 1000);
    newer.finish();
    cache.begin().finish();
    assert_eq!((cache.statistics().items, made(&cache)), (1, 1));
}

#[test]
fn threads_that_make_the_same_go_on_with_one() {
    let reuse = Reuse::default();
    let key = Key::new("mesh", "a");
    let make = || Shared::shared(crate::procedural::cuboid(glam::Vec3::ONE));
    let one = reuse.keep(key, make());
    let other = reuse.keep(key, make());
    assert_eq!(one.revision, other.revision);
    assert!(Arc::ptr_eq(&one.value, &other.value));
}

#[test]
fn a_cache_that_is_cleared_is_empty() {
    let cache = Cache::default();
    weigh(&cache.begin(), "a", 1000);
    cache.clear();
    let statistics = cache.statistics();
    assert_eq!((statistics.items, statistics.bytes), (0, 0));
    assert!(cache.lock().latest.is_empty());
}
