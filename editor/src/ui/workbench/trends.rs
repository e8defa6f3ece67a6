//! What frames cost, as curves over the time of the program.

use std::collections::VecDeque;
use std::time::Instant;

use lightbench::render::queries::Measured;
use lightbench::render::{FrameStatistics, PassStatistics};
use lightbench::script::plots::Plot;

use crate::ui::messages::{message, say};

/// Moments that a curve keeps.
const MOST: usize = 1200;

/// What is plotted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trend {
    /// The whole frame, milliseconds on GPU and CPU.
    #[default]
    Frames,
    /// Each pass, milliseconds on the GPU.
    Passes,
    /// Lights and objects that the camera sees.
    Lights,
    /// Megabytes of the pipeline's targets and buffers, of meshes and textures, and what was uploaded for
    /// a frame.
    Memory,
}

impl Trend {
    /// All of them, with the messages of their words.
    pub const ALL: [(Self, &'static str); 4] = [
        (Self::Frames, message!("trends.frame_time_ms")),
        (Self::Passes, message!("trends.passes_ms")),
        (Self::Lights, message!("trends.lights_and_objects")),
        (Self::Memory, message!("trends.memory_mb")),
    ];
}

/// The curves of everything.
#[derive(Debug)]
pub struct Trends {
    began: Instant,
    curves: [Vec<Plot>; 4],
    /// The names of the passes of the pipeline on screen.
    passes: Vec<String>,
}

impl Default for Trends {
    fn default() -> Self {
        Self {
            began: Instant::now(),
            curves: Default::default(),
            passes: Vec::new(),
        }
    }
}

impl Trends {
    /// The curves of one kind, in the order in which they began.
    pub fn curves(&self, trend: Trend) -> &[Plot] {
        &self.curves[trend as usize]
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.curves = Default::default();
    }

    /// Takes note of a submitted frame, of the bytes of meshes and textures, and of the pipeline's
    /// passes.
    pub fn submitted<'a>(
        &mut self,
        now: Instant,
        statistics: &FrameStatistics,
        asset_bytes: u64,
        passes: impl Iterator<Item = &'a str> + Clone,
    ) {
        if !passes.clone().eq(self.passes.iter().map(String::as_str)) {
            self.passes = passes.map(str::to_owned).collect();
            // Passes of another pipeline have no common scale, and their names mislead.
            self.curves[Trend::Passes as usize].clear();
        }
        const MEGABYTE: f64 = 1e6;
        let memory = |bytes: u64| bytes as f64 / MEGABYTE;
        let cpu = statistics.extract_ms + statistics.record_ms;
        let draws = |pass: &PassStatistics| f64::from(pass.draws + pass.dispatches);
        self.add(now, Trend::Frames, say!("trends.cpu"), cpu);
        for (name, value) in [
            ("lights", statistics.lights.into()),
            ("objects", statistics.objects.into()),
            ("calls", statistics.passes.iter().map(draws).sum()),
        ] {
            self.add(now, Trend::Lights, name, value);
        }
        for (name, bytes) in [
            (say!("trends.targets_and_buffers"), statistics.target_bytes),
            (say!("trends.meshes_and_textures"), asset_bytes),
            (say!("trends.saved_by_sharing"), statistics.saved_bytes),
            (say!("trends.uploaded_rows"), statistics.uploaded_bytes),
        ] {
            self.add(now, Trend::Memory, name, memory(bytes));
        }
    }

    /// Takes in what came back from the GPU.
    pub fn measured(&mut self, now: Instant, measured: &Measured) {
        if let Some(total) = measured.total_ms {
            self.add(now, Trend::Frames, say!("trends.gpu"), total);
        }
        if measured.gpu_ms.len() == self.passes.len() {
            for (index, ms) in measured.gpu_ms.iter().enumerate() {
                let name = self.passes[index].clone();
                self.add(now, Trend::Passes, &name, *ms);
            }
        }
    }

    fn add(&mut self, now: Instant, trend: Trend, name: &str, value: f64) {
        let time = (now - self.began).as_secs_f64();
        let curves = &mut self.curves[trend as usize];
        let at = curves.iter().position(|curve| curve.name == name);
        let at = at.unwrap_or_else(|| {
            curves.push(Plot {
                name: name.to_owned(),
                values: VecDeque::new(),
            });
            curves.len() - 1
        });
        let values = &mut curves[at].values;
        if values.len() == MOST {
            values.pop_front();
        }
        values.push_back((time, value));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::time::Duration;

    #[test]
    fn curves_keep_their_last_moments_and_passes_those_of_one_pipeline() {
        let mut trends = Trends::default();
        let statistics = FrameStatistics {
            lights: 7,
            target_bytes: 3_000_000,
            record_ms: 2.0,
            extract_ms: 1.0,
            ..FrameStatistics::default()
        };
        let began = trends.began;
        for second in 0..MOST as u64 + 10 {
            let now = began + Duration::from_secs(second);
            trends.submitted(now, &statistics, 4_000_000, ["a", "b"].into_iter());
            let measured = Measured {
                gpu_ms: vec![1.0, second as f64],
                total_ms: Some(5.0),
                ..Measured::default()
            };
            trends.measured(now, &measured);
        }
        let curve = |trends: &Trends, trend, name: &str| {
            let curves = trends.curves(trend).iter();
            curves.clone().find(|curve| curve.name == name).cloned()
        };
        let cpu = curve(&trends, Trend::Frames, "CPU").unwrap();
        assert_eq!(cpu.values.len(), MOST);
        assert_eq!(cpu.values.front(), Some(&(10.0, 3.0)));
        let second = curve(&trends, Trend::Passes, "b").unwrap();
        assert_eq!(second.values.back(), Some(&(1209.0, 1209.0)));
        let memory = curve(&trends, Trend::Memory, "targets and buffers").unwrap();
        assert_eq!(memory.values.back().unwrap().1, 3.0);
        let assets = curve(&trends, Trend::Memory, "meshes and textures").unwrap();
        assert_eq!(assets.values.back().unwrap().1, 4.0);
        assert_eq!(
            curve(&trends, Trend::Lights, "lights").unwrap().values[0].1,
            7.0
        );

        let later = began + Duration::from_secs(5000);
        trends.submitted(later, &statistics, 0, ["c"].into_iter());
        assert!(curve(&trends, Trend::Passes, "a").is_none());
        // What was drawn before the other pipeline came has another number of passes.
        let late = Measured {
            gpu_ms: vec![1.0, 2.0],
            ..Measured::default()
        };
        trends.measured(later, &late);
        assert!(trends.curves(Trend::Passes).is_empty());
    }
}
