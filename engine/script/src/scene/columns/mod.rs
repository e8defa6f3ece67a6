//! Columns: one value for each entity of a selection, or for whatever else is counted.
//!
//! A script's loop costs an interpreted step for each operation on each entity. On columns it takes
//! one step for each operation, and the loop over the values is compiled code over contiguous memory
//! (Iverson, "A Programming Language", 1962, has whole arrays as operands for the sake of the
//! notation; here it is for speed too).

mod functions;
mod making;
mod members;
mod operators;
mod parts;

use std::sync::Arc;

use lightbench_world::glam::DVec3;

use super::data::Stage;
use crate::api::{Api, Mistake, ScriptType};
use crate::limits::{Limits, Stop, Watch, sentence};

/// Numbers or vectors. Copies in a script share them until one of the copies changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Column {
    Numbers(Arc<Vec<f64>>),
    Vectors(Arc<Vec<DVec3>>),
}

impl ScriptType for Column {
    const NAME: &'static str = "column";
}

impl Column {
    pub(super) fn numbers(numbers: Vec<f64>) -> Self {
        Self::Numbers(Arc::new(numbers))
    }

    pub(super) fn vectors(vectors: Vec<DVec3>) -> Self {
        Self::Vectors(Arc::new(vectors))
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Vectors(vectors) => vectors.len(),
        }
    }

    /// What it holds, in words.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Numbers(_) => "numbers",
            Self::Vectors(_) => "vec3",
        }
    }
}

/// Ends a script whose time is over. One call may work on a million values, and Rhai looks at the
/// clock only between calls.
#[derive(Clone)]
struct Meter {
    watch: Arc<Watch>,
    limits: Limits,
}

impl Meter {
    fn check(&self) -> Result<(), Mistake> {
        if self.watch.is_late() {
            return Err(Mistake::new(sentence(Stop::Time, &self.limits)));
        }
        Ok(())
    }
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    let meter = {
        let data = stage.lock();
        Meter {
            watch: Arc::clone(&data.watch),
            limits: data.limits.clone(),
        }
    };
    api.section("Columns: arithmetic on many values at once");
    api.object::<Column>();
    making::register(api, &meter);
    members::register(api);
    operators::register(api, &meter);
    functions::register(api, &meter);
}
