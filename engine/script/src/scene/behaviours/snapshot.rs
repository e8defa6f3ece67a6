//! The behaviours of a scene as they are at one moment, to go back to.

use lightbench_render::Problem;
use rhai::Map;

use super::{Behaviours, Instance, module_of};
use crate::host::Host;
use crate::scene::state::State;

/// Behaviours at one moment.
pub(in crate::scene) struct BehavioursSnapshot {
    /// Each with what it remembered.
    instances: Vec<(Instance, Map)>,
    free: Vec<usize>,
    slots: usize,
    problems: Vec<Problem>,
}

impl Behaviours {
    /// Takes note of everything.
    pub(in crate::scene) fn keep(&self) -> BehavioursSnapshot {
        let kept = |instance: &Instance| (instance.clone(), instance.state.contents());
        BehavioursSnapshot {
            instances: self.instances.iter().map(kept).collect(),
            free: self.free.clone(),
            slots: self.slots,
            problems: self.problems.clone(),
        }
    }

    /// Makes everything as it was.
    pub(in crate::scene) fn restore(&mut self, host: &mut Host, kept: &BehavioursSnapshot) {
        self.instances.clear();
        self.places.clear();
        for (instance, contents) in &kept.instances {
            // What was kept may be wanted once more, so it shares nothing with what goes on.
            let state = State::default();
            state.replace(contents.clone());
            // Another behaviour may have had the slot since.
            if let Some(module) = &instance.module {
                let name = module_of(instance.slot);
                host.engine.register_static_module(name, module.clone());
            }
            self.places.insert(instance.entity, self.instances.len());
            self.instances.push(Instance {
                state,
                ..instance.clone()
            });
        }
        self.free.clone_from(&kept.free);
        self.slots = kept.slots;
        self.problems.clone_from(&kept.problems);
    }
}
