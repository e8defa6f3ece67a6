//! What the last frames cost, pass by pass.

use std::collections::VecDeque;

use lightbench::render::FrameStatistics;
use lightbench::render::queries::Measured;
use lightbench::world::SystemTime;

/// Frames kept for medians and graphs.
pub const WINDOW: usize = 120;

/// Frames whose GPU times may still be on their way.
const IN_FLIGHT: usize = 16;

/// The last values of one quantity, oldest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series(VecDeque<f64>);

impl Series {
    /// Adds a value and drops the oldest beyond [`WINDOW`].
    pub fn push(&mut self, value: f64) {
        if self.0.len() == WINDOW {
            self.0.pop_front();
        }
        self.0.push_back(value);
    }

    /// Oldest first.
    pub fn values(&self) -> impl ExactSizeIterator<Item = f64> {
        self.0.iter().copied()
    }

    /// The median, which single slow frames don't move.
    pub fn median(&self) -> Option<f64> {
        let mut sorted: Vec<f64> = self.0.iter().copied().collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let middle = sorted.len() / 2;
        match sorted.len() {
            0 => None,
            n if n % 2 == 1 => Some(sorted[middle]),
            _ => Some((sorted[middle - 1] + sorted[middle]) * 0.5),
        }
    }
}

/// The history of one pass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassTimes {
    /// Milliseconds on the GPU.
    pub gpu_ms: Series,
    /// Milliseconds to record it.
    pub cpu_ms: Series,
    /// Fragments in the last frame that counted them.
    pub fragments: Option<u64>,
    /// Vertices in the same frame.
    pub vertices: Option<u64>,
}

/// The history of one system of the world.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemTimes {
    /// Its name.
    pub name: &'static str,
    /// Milliseconds of the thread that ran it.
    pub thread_ms: Series,
}

/// The history of the pipeline on screen.
#[derive(Debug, Default)]
pub struct Timings {
    /// The script and the systems, in the order in which they run, then the extraction.
    pub systems: Vec<SystemTimes>,
    /// In the order of the passes.
    pub passes: Vec<PassTimes>,
    /// The whole frame on the GPU, milliseconds.
    pub gpu_ms: Series,
    /// Extracting, uploading and recording a frame, milliseconds.
    pub cpu_ms: Series,
    /// What the pipeline's shaders counted in the last frame that came back.
    pub counters: Vec<u32>,
    /// The frames of this pipeline and size that were submitted and not yet measured.
    expected: VecDeque<u32>,
}

impl Timings {
    /// Forgets everything: another pipeline, another size or another scene comes. What the last
    /// step took stays, because a scene at rest takes no other.
    pub fn reset(&mut self) {
        let last = std::mem::take(&mut self.systems);
        *self = Self::default();
        for system in last {
            if let Some(ms) = system.thread_ms.values().last() {
                self.add_system(system.name, ms);
            }
        }
    }

    /// Takes note of what the script and the systems took in a step of the scene.
    pub fn stepped(&mut self, times: impl IntoIterator<Item = SystemTime>) {
        for time in times {
            self.add_system(time.name, time.thread_ms());
        }
    }

    fn add_system(&mut self, name: &'static str, ms: f64) {
        let at = self.systems.iter().position(|known| known.name == name);
        let at = at.unwrap_or_else(|| {
            self.systems.push(SystemTimes {
                name,
                thread_ms: Series::default(),
            });
            self.systems.len() - 1
        });
        self.systems[at].thread_ms.push(ms);
    }

    /// Takes note of a submitted frame.
    pub fn submitted(&mut self, frame: u32, statistics: &FrameStatistics) {
        if self.passes.len() != statistics.passes.len() {
            self.reset();
            self.passes
                .resize_with(statistics.passes.len(), Default::default);
        }
        self.stepped(statistics.systems.iter().cloned());
        self.cpu_ms
            .push(statistics.extract_ms + statistics.record_ms);
        for (times, pass) in self.passes.iter_mut().zip(&statistics.passes) {
            times.cpu_ms.push(pass.cpu_ms);
        }
        if self.expected.len() == IN_FLIGHT {
            self.expected.pop_front();
        }
        self.expected.push_back(frame);
    }

    /// Takes in what came back from the GPU; frames from before the last reset don't count. Says whether
    /// this one did.
    pub fn measured(&mut self, measured: &Measured) -> bool {
        let Some(at) = self
            .expected
            .iter()
            .position(|frame| *frame == measured.frame)
        else {
            return false;
        };
        // Results come in order: what was submitted before will not come any more.
        self.expected.drain(..=at);
        if let Some(total) = measured.total_ms {
            self.gpu_ms.push(total);
        }
        self.counters.clone_from(&measured.counters);
        for (times, ms) in self.passes.iter_mut().zip(&measured.gpu_ms) {
            times.gpu_ms.push(*ms);
        }
        for (times, count) in self.passes.iter_mut().zip(&measured.fragments) {
            times.fragments = Some(*count);
        }
        for (times, count) in self.passes.iter_mut().zip(&measured.vertices) {
            times.vertices = Some(*count);
        }
        true
    }

    /// Whether results are still to come.
    pub fn is_waiting(&self) -> bool {
        !self.expected.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbench::render::PassStatistics;

    #[test]
    fn the_median_is_the_middle_one_of_the_last_values() {
        let mut series = Series::default();
        assert_eq!(series.median(), None);
        for value in [9.0, 1.0, 5.0] {
            series.push(value);
        }
        assert_eq!(series.median(), Some(5.0));
        series.push(6.0);
        assert_eq!(series.median(), Some(5.5));
        for _ in 0..WINDOW {
            series.push(2.0);
        }
        assert_eq!(series.median(), Some(2.0));
        assert_eq!(series.values().len(), WINDOW);
    }

    #[test]
    fn systems_keep_their_order_and_the_last_step_survives_a_reset() {
        let time = |name, ms| SystemTime {
            name,
            stage: 0,
            thread: std::time::Duration::from_micros(ms),
        };
        let mut timings = Timings::default();
        for ms in [100, 300, 200] {
            timings.stepped([time("script", ms), time("bounds", 2 * ms)]);
        }
        let names: Vec<_> = timings.systems.iter().map(|system| system.name).collect();
        assert_eq!(names, ["script", "bounds"]);
        assert_eq!(timings.systems[1].thread_ms.median(), Some(0.4));
        timings.reset();
        assert_eq!(timings.systems[0].thread_ms.median(), Some(0.2));
        assert_eq!(timings.systems[0].thread_ms.values().len(), 1);
    }

    #[test]
    fn results_of_an_earlier_pipeline_are_left_out() {
        let statistics = FrameStatistics {
            passes: vec![PassStatistics::default()],
            ..FrameStatistics::default()
        };
        let result = |frame, ms| Measured {
            frame,
            gpu_ms: vec![ms],
            total_ms: Some(ms),
            fragments: Vec::new(),
            ..Measured::default()
        };
        let mut timings = Timings::default();
        timings.submitted(1, &statistics);
        timings.reset();
        timings.submitted(2, &statistics);
        timings.measured(&result(1, 50.0));
        assert!(timings.is_waiting());
        timings.measured(&result(2, 3.0));
        assert_eq!(timings.gpu_ms.median(), Some(3.0));
        assert_eq!(timings.passes[0].gpu_ms.median(), Some(3.0));
        assert!(!timings.is_waiting());
    }
}
