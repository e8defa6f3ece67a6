//! On what it was measured.

use lightbench_render::gpu::AdapterSummary;
use sysinfo::System;

use crate::report::{Adapter, Machine};

impl Machine {
    /// This computer.
    pub fn this() -> Self {
        let mut system = System::new();
        system.refresh_memory();
        system.refresh_cpu_list(sysinfo::CpuRefreshKind::nothing());
        let cpu = system.cpus().first().map(|cpu| cpu.brand().trim());
        let os = System::long_os_version().unwrap_or_else(|| std::env::consts::OS.to_owned());
        let kernel = System::kernel_version().map_or_else(String::new, |v| format!(", kernel {v}"));
        Self {
            cpu: match cpu {
                None | Some("") => format!("unknown ({})", std::env::consts::ARCH),
                Some(name) => name.to_owned(),
            },
            cores: std::thread::available_parallelism().map_or(1, |n| n.get() as u32),
            memory_bytes: system.total_memory(),
            os: format!("{}{kernel}", os.trim()),
        }
    }
}

/// Bytes of memory that this process has at the moment; `None` where the system does not tell.
pub fn resident_bytes() -> Option<u64> {
    let this = sysinfo::get_current_pid().ok()?;
    let mut system = System::new();
    system.refresh_processes_specifics(
        sysinfo::ProcessesToUpdate::Some(&[this]),
        false,
        sysinfo::ProcessRefreshKind::nothing().with_memory(),
    );
    system.process(this).map(sysinfo::Process::memory)
}

/// How many programs wanted a core at a time, on average over the last minute; `None` where the
/// system does not tell.
pub fn load_average() -> Option<f64> {
    let average = System::load_average().one;
    (average > 0.0).then_some(average)
}

/// The clock of the processor's cores in the mean, in MHz; `None` where the system does not tell.
pub fn processor_mhz() -> Option<f64> {
    let mut system = System::new();
    system.refresh_cpu_list(sysinfo::CpuRefreshKind::nothing().with_frequency());
    let clocks: Vec<f64> = system
        .cpus()
        .iter()
        .map(|cpu| cpu.frequency() as f64)
        .filter(|mhz| *mhz > 0.0)
        .collect();
    (!clocks.is_empty()).then(|| clocks.iter().sum::<f64>() / clocks.len() as f64)
}

impl From<&AdapterSummary> for Adapter {
    fn from(summary: &AdapterSummary) -> Self {
        Self {
            name: summary.name.clone(),
            driver: summary.driver.clone(),
            driver_info: summary.driver_info.clone(),
            backend: summary.backend.clone(),
            kind: summary.kind.to_owned(),
            software: summary.software,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_computer_has_a_name_and_memory() {
        let machine = Machine::this();
        assert!(!machine.cpu.is_empty() && !machine.os.is_empty());
        assert!(machine.cores >= 1);
        assert!(machine.memory_bytes > 64 << 20, "{machine:?}");
    }

    #[test]
    fn memory_that_is_taken_is_seen() {
        let before = resident_bytes().unwrap_or(0);
        let taken = std::hint::black_box(vec![1_u8; 64 << 20]);
        let after = resident_bytes().unwrap_or(0);
        assert!(after > before + (48 << 20), "{before} {after}");
        assert_eq!(taken[taken.len() / 2], 1);
    }
}
