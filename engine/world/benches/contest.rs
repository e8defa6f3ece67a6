//! Contests: several ways to do one job, measured in one process, and the ratios
//! between them.

use std::hint::black_box;
use std::time::Duration;

use cpu_time::ThreadTime;
use criterion::Criterion;

/// The time that this thread has used, which does not count other programs.
pub fn now() -> ThreadTime {
    ThreadTime::now()
}

/// One job and the best time of each way to do it.
pub struct Contest<'a> {
    criterion: &'a mut Criterion,
    job: &'static str,
    times: Vec<(&'static str, Duration)>,
}

impl<'a> Contest<'a> {
    /// Starts a contest.
    pub fn new(criterion: &'a mut Criterion, job: &'static str) -> Self {
        Self {
            criterion,
            job,
            times: Vec::new(),
        }
    }

    /// Measures one way to do the job.
    pub fn enter<T>(&mut self, way: &'static str, mut work: impl FnMut() -> T) {
        self.enter_timed(way, || {
            let start = now();
            black_box(work());
            start.elapsed()
        });
    }

    /// Measures one way to do the job that takes its own time, because it has
    /// something to prepare.
    pub fn enter_timed(&mut self, way: &'static str, mut work: impl FnMut() -> Duration) {
        let mut best = Duration::MAX;
        let mut group = self.criterion.benchmark_group(self.job);
        group.bench_function(way, |bencher| {
            bencher.iter_custom(|count| {
                let mut total = Duration::ZERO;
                for _ in 0..count {
                    let time = work();
                    best = best.min(time);
                    total += time;
                }
                total
            });
        });
        group.finish();
        // None if the command line chose other contests.
        if best < Duration::MAX {
            self.times.push((way, best));
        }
    }

    fn time(&self, way: &str) -> Option<Duration> {
        let entry = self.times.iter().find(|(name, _)| *name == way);
        entry.map(|(_, time)| *time)
    }

    /// Prints the ratio of two ways and whether it is within a bar.
    pub fn ratio(&self, way: &str, to: &str, bar: f64) {
        let (Some(time), Some(other)) = (self.time(way), self.time(to)) else {
            return;
        };
        let ratio = time.as_secs_f64() / other.as_secs_f64();
        let verdict = if ratio <= bar { "met" } else { "MISSED" };
        println!(
            "RATIO {}: {way} {time:.3?} / {to} {other:.3?} = {ratio:.3} (bar {bar}) {verdict}",
            self.job
        );
    }

    /// Prints a time and whether it is within a bar.
    pub fn within(&self, way: &str, bar: Duration) {
        if let Some(time) = self.time(way) {
            let verdict = if time <= bar { "met" } else { "MISSED" };
            println!(
                "TIME {}: {way} {time:.3?} (bar {bar:?}) {verdict}",
                self.job
            );
        }
    }
}

/// The settings of all contests.
pub fn criterion() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500))
        .without_plots()
        .configure_from_args()
}
