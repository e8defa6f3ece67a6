//! Random numbers that are the same on every machine and in every run.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use lightbench_world::glam::DVec3;
use rand::RngCore;
use rand_pcg::Pcg64;
use rhai::Dynamic;

use crate::api::{Api, Mistake, ScriptType};

/// A row of random numbers. Copies in a script share the row.
#[derive(Clone, Debug)]
pub(crate) struct Random(Arc<Mutex<Pcg64>>);

impl ScriptType for Random {
    const NAME: &'static str = "random";
}

impl Random {
    fn new(seed: i64) -> Self {
        // Any fixed stream will do; the seed chooses the place in it.
        const STREAM: u128 = 0xa02b_dbf7_bb3c_0a7a_c28f_a16a_64ab_f96d;
        Self(Arc::new(Mutex::new(Pcg64::new(
            seed as u64 as u128,
            STREAM,
        ))))
    }

    fn lock(&self) -> MutexGuard<'_, Pcg64> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Evenly from 0 up to, but not including, 1: the upper 53 bits.
    pub(crate) fn float(&self) -> f64 {
        (self.lock().next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly from 0 up to, but not including, `count`. Rejects the part of the range that would
    /// make some numbers likelier.
    fn below(&self, count: u64) -> u64 {
        let zone = u64::MAX - u64::MAX % count;
        loop {
            let number = self.lock().next_u64();
            if number < zone {
                return number % count;
            }
        }
    }

    /// A normal deviate (Box and Muller 1958).
    pub(crate) fn normal(&self) -> f64 {
        let radius = (-2.0 * (1.0 - self.float()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.float()).cos()
    }

    /// A direction. Archimedes: the height of an even point on the sphere is even.
    pub(crate) fn direction(&self) -> DVec3 {
        let y = 2.0 * self.float() - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * self.float()).sin_cos();
        let radius = (1.0 - y * y).sqrt();
        DVec3::new(radius * cos, y, radius * sin)
    }
}

/// All rows that scripts of one engine have begun and still hold.
///
/// A script keeps a row wherever it likes, in a constant too, and each number that it takes moves the
/// row on. Who goes back to an earlier moment has to move the rows back.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows(Arc<Mutex<Vec<Weak<Mutex<Pcg64>>>>>);

impl Rows {
    fn add(&self, random: &Random) {
        let mut rows = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // Scripts that begin rows in each step must not fill the list.
        if rows.len() == rows.capacity() {
            rows.retain(|row| row.strong_count() > 0);
        }
        rows.push(Arc::downgrade(&random.0));
    }

    /// Where each row stands.
    pub(crate) fn places(&self) -> RowPlaces {
        let rows = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let held = rows.iter().filter_map(Weak::upgrade).map(Random);
        RowPlaces(
            held.map(|row| {
                let place = row.lock().clone();
                (row, place)
            })
            .collect(),
        )
    }
}

/// Where rows stood at one moment.
#[derive(Clone, Debug)]
pub(crate) struct RowPlaces(Vec<(Random, Pcg64)>);

impl RowPlaces {
    /// Moves the rows back.
    pub(crate) fn restore(&self) {
        for (row, place) in &self.0 {
            *row.lock() = place.clone();
        }
    }
}

pub(crate) fn register(api: &mut Api) -> Rows {
    api.object::<Random>();
    let rows = Rows::default();
    let begun = rows.clone();
    api.function(
        "random(seed)",
        "Begins a row of random numbers. The same seed gives the same row on every machine.",
        move |a| {
            let random = Random::new(a.whole(0, i64::MIN, i64::MAX)?);
            begun.add(&random);
            Ok(random)
        },
    );
    api.method(
        "float()",
        "Evenly from 0 up to, but not including, 1.",
        |random: Random, _| Ok(random.float()),
    );
    api.method(
        "range(from, to)",
        "Evenly between two numbers.",
        |random: Random, a| {
            let (from, to) = (a.number(0)?, a.number(1)?);
            Ok(from + (to - from) * random.float())
        },
    );
    api.method(
        "int(from, to)",
        "A whole number, both ends included.",
        |random: Random, a| {
            let from = a.whole(0, -(1 << 53), 1 << 53)?;
            let to = a.whole(1, -(1 << 53), 1 << 53)?;
            if from > to {
                return Err(Mistake::new(format!(
                    "`from` ({from}) is larger than `to` ({to})"
                )));
            }
            Ok(from + random.below((to - from) as u64 + 1) as i64)
        },
    );
    api.method(
        "pick(array)",
        "One element of an array.",
        |random: Random, a| {
            let array = a.array(0)?;
            if array.is_empty() {
                return Err(Mistake::new("there is nothing to pick from an empty array"));
            }
            Ok(array[random.below(array.len() as u64) as usize].clone())
        },
    );
    api.method(
        "shuffle(array)",
        "The elements of an array in random order.",
        |random: Random, a| {
            let mut array = a.array(0)?;
            // Fisher and Yates, as in Knuth, The Art of Computer Programming 2, 3.4.2 P.
            for last in (1..array.len()).rev() {
                array.swap(last, random.below(last as u64 + 1) as usize);
            }
            Ok(Dynamic::from_array(array))
        },
    );
    api.method(
        "chance(share)",
        "`true` in that share of the cases, 0 to 1.",
        |random: Random, a| Ok(random.float() < a.number_in(0, 0.0, 1.0)?),
    );
    api.method(
        "normal(mean, deviation)",
        "From the normal distribution.",
        |random: Random, a| Ok(a.number(0)? + a.number(1)? * random.normal()),
    );
    api.method(
        "direction()",
        "A vector of length 1, evenly over the sphere.",
        |random: Random, _| Ok(random.direction()),
    );
    rows
}
