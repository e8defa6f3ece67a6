//! `work`: what a student handed in, to be drawn and measured.

use std::sync::{Arc, Mutex};

use lightbench_render::Problems;
use rhai::{Array, Dynamic};

use super::evidence::{Evidence, Examiner};
use super::lock;
use crate::api::{Api, Mistake, ScriptType};
use crate::experiment::bench::{Bench, mistake};
use crate::experiment::{frames, measuring};

/// What was handed in, and who judges it.
#[derive(Clone)]
pub(super) struct Work {
    bench: Bench,
    examiner: Arc<Mutex<Box<dyn Examiner>>>,
}

impl ScriptType for Work {
    const NAME: &'static str = "work";
}

impl Work {
    pub(super) fn new(bench: Bench, examiner: Box<dyn Examiner>) -> Self {
        Self {
            bench,
            examiner: Arc::new(Mutex::new(examiner)),
        }
    }

    /// Hands evidence to the examiner.
    pub(super) fn judge(&self, criterion: &str, evidence: Evidence) -> Result<bool, Mistake> {
        let judged = lock(&self.examiner).judge(criterion, evidence);
        judged.map_err(mistake)
    }

    /// Takes what went wrong in the laboratory of the work.
    pub(super) fn fault(&self) -> Option<Problems> {
        self.bench.take_fault()
    }

    /// Forgets what went wrong before.
    pub(super) fn forget(&self) {
        self.bench.take_fault();
    }
}

pub(super) fn register(api: &mut Api) {
    api.section("The work that was handed in");
    api.object::<Work>();
    for form in ["draw(scene, pipeline)", "draw(scene, pipeline, options)"] {
        api.method(
            form,
            "Draws one frame with what was handed in. The files that a lesson lists come from the \
             student, all others from the lesson's starter and its folder `checks`. Options as of \
             `draw`, which draws with the shipped files and the folder `checks` alone.",
            |work: Work, arguments| frames::drawn(&work.bench, arguments),
        );
    }
    for form in [
        "measure(scene, pipelines)",
        "measure(scene, pipelines, options)",
    ] {
        api.method(
            form,
            "Measures frames with what was handed in, as `measure` does. Judge its counters, bytes, \
             draws and triangles alone: times differ from machine to machine.",
            |work: Work, arguments| {
                let measured = measuring::measured(&work.bench, arguments)?;
                Ok(measured.into_iter().map(Dynamic::from).collect::<Array>())
            },
        );
    }
    api.method(
        "constant(name)",
        "A number that the lesson draws for each student; the default of the lesson where no student \
         is named.",
        |work: Work, arguments| {
            let name = arguments.text(0)?;
            let constant = lock(&work.examiner).constant(&name);
            constant.map_err(mistake)
        },
    );
}
