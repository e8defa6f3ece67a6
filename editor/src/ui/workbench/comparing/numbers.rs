//! What the frames of each side cost.

use lightbench::render::{FrameStatistics, PipelineDesc};

use crate::ui::workbench::Workbench;
use crate::ui::workbench::timing::{Series, Timings};

/// A time as it was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// The median, milliseconds; `None` where nothing was measured.
    pub median_ms: Option<f64>,
    /// Of how many frames.
    pub frames: usize,
}

impl Cost {
    fn of(series: &Series) -> Self {
        Self {
            median_ms: series.median(),
            frames: series.values().len(),
        }
    }
}

/// What the frames of one side cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Costs {
    /// The pipeline's name.
    pub pipeline: String,
    /// Its title.
    pub title: String,
    /// The values that somebody gave to its parameters, as `name=value`.
    pub settings: Vec<String>,
    /// Extracting and recording a frame, on the CPU.
    pub cpu: Cost,
    /// From the first pass's beginning to the last one's end, on the GPU.
    pub gpu: Cost,
    /// Draw calls and dispatches of the last frame.
    pub calls: u64,
    /// Modelled bytes that move between shaders and targets in a frame.
    pub moved_bytes: u64,
    /// Memory of all targets and buffers.
    pub target_bytes: u64,
    /// Lights in view.
    pub lights: u32,
    /// What the pipeline's own counters say, each with its description.
    pub counters: Vec<(String, u32)>,
}

impl Costs {
    fn of(desc: &PipelineDesc, statistics: &FrameStatistics, timings: &Timings) -> Self {
        let passes = || statistics.passes.iter().filter(|pass| !pass.dropped);
        let counters = desc.counters.iter().zip(&timings.counters);
        Self {
            pipeline: desc.name.clone(),
            cpu: Cost::of(&timings.cpu_ms),
            gpu: Cost::of(&timings.gpu_ms),
            calls: passes()
                .map(|pass| u64::from(pass.draws) + u64::from(pass.dispatches))
                .sum(),
            moved_bytes: passes()
                .map(|pass| pass.traffic.read + pass.traffic.written)
                .sum(),
            target_bytes: statistics.target_bytes,
            lights: statistics.lights,
            counters: counters
                .map(|(counter, value)| (counter.description.clone(), *value))
                .collect(),
            ..Self::default()
        }
    }
}

impl Workbench {
    /// What the frames of A and of B cost. B is missing while nothing is compared.
    pub fn costs(&self) -> [Option<Costs>; 2] {
        let named = |mut costs: Costs, name: &str, settings: &lightbench::script::Settings| {
            self.library
                .pipeline_title(name)
                .clone_into(&mut costs.title);
            costs.settings = settings.iter().map(|(n, v)| format!("{n}={v}")).collect();
            costs
        };
        let first = self.pipelines.shown().and_then(|name| {
            let slot = self.pipelines.slot(name)?;
            let desc = &slot.pipeline.as_ref()?.desc;
            let costs = Costs::of(desc, self.statistics(), &self.timings);
            Some(named(costs, name, &slot.settings))
        });
        let side = self.comparing.side().filter(|_| self.comparing.is_on());
        let second = side.and_then(|side| {
            let name = side.pipelines.shown()?;
            let slot = side.pipelines.slot(name)?;
            let desc = &slot.pipeline.as_ref()?.desc;
            let costs = Costs::of(desc, &side.statistics, &side.timings);
            Some(named(costs, name, &slot.settings))
        });
        [first, second]
    }
}
