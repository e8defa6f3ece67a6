//! A measured value beside its bound.

use lightbench::lab::statistics::{Bootstrap, Summary, ratio_of_medians};

use crate::frames::Times;

/// The bars so far.
pub struct Bars {
    /// Whether the driver draws with the processor.
    pub software: bool,
    /// Cores that it may use.
    pub cores: u32,
    met: u32,
    missed: Vec<String>,
}

impl Bars {
    /// None yet.
    pub fn new(software: bool, cores: u32) -> Self {
        Self {
            software,
            cores,
            met: 0,
            missed: Vec::new(),
        }
    }

    /// Says a value and whether it keeps its bound.
    pub fn at_most(&mut self, what: &str, value: f64, bound: f64, remark: &str) {
        let holds = value <= bound;
        let word = if holds { "met" } else { "NOT MET" };
        println!("  {what}: {value:.3}, at most {bound}: {word} {remark}");
        if holds {
            self.met += 1;
        } else {
            self.missed
                .push(format!("{what}: {value:.3} instead of {bound}"));
        }
    }

    /// Says how one side's time stands to another's, with a 95 % interval, and whether the ratio
    /// keeps its bound.
    pub fn ratio(&mut self, what: &str, times: &Times, others: &Times, bound: f64) {
        let (a, b) = (times.judged(self.software), others.judged(self.software));
        let interval = ratio_of_medians(a, b, Bootstrap::default());
        let interval = interval.map_or_else(String::new, |i| {
            format!(", {:.3} to {:.3} in 95 %", i.low, i.high)
        });
        let remark = format!(
            "({:.1} / {:.1} ms{interval}; by the clock {:.3})",
            median(a),
            median(b),
            median(&times.wall) / median(&others.wall)
        );
        self.at_most(what, median(a) / median(b), bound, &remark);
    }

    /// Says how many hold.
    pub fn summarize(&self) {
        let missed = self.missed.len();
        println!("\n{} of {} bars met", self.met, self.met as usize + missed);
        for missed in &self.missed {
            println!("  not met: {missed}");
        }
    }
}

/// The median of times that were taken.
pub fn median(times: &[f64]) -> f64 {
    Summary::of(times).map_or(f64::NAN, |summary| summary.median)
}
