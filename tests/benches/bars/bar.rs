//! A measured value beside its bound.

use lightbench::lab::statistics::{Bootstrap, Summary, ratio_of_medians};

/// The bars so far.
#[derive(Default)]
pub struct Bars {
    met: u32,
    missed: Vec<String>,
}

impl Bars {
    /// Says a value and whether it keeps its bound.
    pub fn at_most(&mut self, what: &str, value: f64, bound: f64, remark: &str) {
        let holds = value <= bound;
        let word = if holds { "met" } else { "NOT MET" };
        println!("  {what}: {value:.3}, at most {bound}: {word}{remark}");
        if holds {
            self.met += 1;
        } else {
            self.missed.push(what.to_owned());
        }
    }

    /// Says how one side's time stands to another's, with a 95 % interval, and whether the ratio
    /// keeps its bound.
    pub fn ratio(&mut self, what: &str, times: &[f64], others: &[f64], bound: f64) {
        let (Some(a), Some(b)) = (Summary::of(times), Summary::of(others)) else {
            println!("  {what}: no times");
            return;
        };
        let interval = ratio_of_medians(times, others, Bootstrap::default());
        let interval = interval.map_or_else(String::new, |i| {
            format!(", from {:.3} to {:.3} in 95 %", i.low, i.high)
        });
        let remark = format!(" ({:.1} ms / {:.1} ms{interval})", a.median, b.median);
        self.at_most(what, a.median / b.median, bound, &remark);
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
