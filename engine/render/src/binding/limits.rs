//! What a device allows of a shader: workgroups, memory, bindings, values between stages.

use wgpu::ShaderStages as Stages;

use super::{Binder, Source, layout};
use crate::description::{Amount, Dispatch, PassKind};
use crate::layout::scene_entries;
use crate::problem::Problem;
use crate::reflection::{EntryPoint, Reflection};
use crate::validate::FormatSupport;

/// Checks what does not depend on the pass, before the shader goes to the device.
///
/// # Errors
/// The first thing that no pass could do with the shader.
pub fn check_shader(reflection: &Reflection, limits: &wgpu::Limits) -> Result<(), Problem> {
    for variable in &reflection.variables {
        let (name, group) = (&variable.name, variable.group);
        if group > 2 {
            return Err(Problem::new(
                variable.at.clone(),
                format!("`{name}` is in group {group}, which nobody fills"),
            )
            .with_hint("group 0 is the scene, group 1 targets and buffers, group 2 parameters"));
        }
        if variable.binding >= limits.max_bindings_per_bind_group {
            return Err(Problem::new(
                variable.at.clone(),
                format!("`{name}` has the binding {}", variable.binding),
            )
            .with_hint(format!(
                "bindings are numbered from 0 to {}",
                limits.max_bindings_per_bind_group - 1
            )));
        }
    }
    for pair in reflection.variables.windows(2) {
        let (first, second) = (&pair[0], &pair[1]);
        if (first.group, first.binding) == (second.group, second.binding) {
            let group = second.group;
            return Err(Problem::new(
                second.at.clone(),
                format!(
                    "`{}` has @group({group}) @binding({}), as `{}` has",
                    second.name, second.binding, first.name
                ),
            )
            .with_hint(free_binding(reflection, group)));
        }
    }
    for constant in &reflection.overrides {
        if !constant.has_value {
            return Err(Problem::new(
                constant.at.clone(),
                format!(
                    "nothing gives the override constant `{}` a value",
                    constant.name
                ),
            )
            .with_hint(format!(
                "write `const {0} = #{{{1}}};` and let the pass say .define(\"{1}\", 16)",
                constant.name,
                constant.name.to_uppercase()
            )));
        }
    }
    for entry in &reflection.entry_points {
        check_entry(entry, limits)?;
    }
    Ok(())
}

/// "the next free number is 3", for messages.
pub fn free_binding(reflection: &Reflection, group: u32) -> String {
    let taken = |number: &u32| reflection.variable(group, *number).is_some();
    let free = (0..).find(|number| !taken(number)).unwrap_or_default();
    format!("the next free number is {free}")
}

fn check_entry(entry: &EntryPoint, limits: &wgpu::Limits) -> Result<(), Problem> {
    let name = &entry.name;
    if entry.stage == naga::ShaderStage::Compute {
        let [x, y, z] = entry.workgroup_size;
        let most = [
            limits.max_compute_workgroup_size_x,
            limits.max_compute_workgroup_size_y,
            limits.max_compute_workgroup_size_z,
        ];
        let at = entry.workgroup_at.clone();
        if let Some(axis) = (0..3).find(|axis| entry.workgroup_size[*axis] > most[*axis]) {
            return Err(Problem::new(
                at,
                format!(
                    "a workgroup of `{name}` is {x} × {y} × {z}; this adapter allows {} along {}",
                    most[axis],
                    ["x", "y", "z"][axis]
                ),
            )
            .with_hint("make the workgroup smaller, and dispatch more of them"));
        }
        let invocations = u64::from(x) * u64::from(y) * u64::from(z);
        let most = limits.max_compute_invocations_per_workgroup;
        if invocations > u64::from(most) {
            return Err(Problem::new(
                at,
                format!(
                    "a workgroup of `{name}` has {x} × {y} × {z} = {invocations} invocations; this \
                     adapter allows {most}"
                ),
            )
            .with_hint("make the workgroup smaller, and dispatch more of them"));
        }
        let most = limits.max_compute_workgroup_storage_size;
        if entry.workgroup_bytes > u64::from(most) {
            return Err(Problem::new(
                entry.at.clone(),
                format!(
                    "`{name}` uses {} bytes of workgroup memory; this adapter has {most}",
                    entry.workgroup_bytes
                ),
            )
            .with_hint("make the arrays in `var<workgroup>` shorter"));
        }
        return Ok(());
    }
    let between = match entry.stage {
        naga::ShaderStage::Vertex => &entry.outputs,
        _ => &entry.inputs,
    };
    let most = limits.max_inter_stage_shader_variables;
    if let Some(varying) = between.iter().find(|varying| varying.location >= most) {
        return Err(Problem::new(
            varying.at.clone(),
            format!("there is no @location({}) between stages", varying.location),
        )
        .with_hint(format!("locations go from 0 to {}", most - 1)));
    }
    let count = between.len() as u32 + entry.builtin_inputs;
    if entry.stage == naga::ShaderStage::Fragment && count > most {
        return Err(Problem::new(
            entry.at.clone(),
            format!(
                "`{name}` takes {count} values from the vertex stage, builtins counted; this \
                 adapter allows {most}"
            ),
        )
        .with_hint("put several numbers into one vector"));
    }
    let most = limits.max_color_attachments;
    let mut outputs = entry.outputs.iter();
    if entry.stage == naga::ShaderStage::Fragment
        && let Some(output) = outputs.find(|output| output.location >= most)
    {
        return Err(Problem::new(
            output.at.clone(),
            format!("there is no colour target @location({})", output.location),
        )
        .with_hint(format!("a pass has at most {most}, counted from 0")));
    }
    Ok(())
}

impl<S: FormatSupport> Binder<'_, S> {
    /// No stage binds more than the device allows, the scene's bindings counted.
    pub(super) fn counts(&mut self, sources: &[(u32, Source)]) {
        let compute = matches!(self.pass.kind, PassKind::Compute(_));
        let limits = self.support.limits();
        let stages: &[(Stages, &str)] = if compute {
            &[(Stages::COMPUTE, "the compute shader")]
        } else {
            &[
                (Stages::VERTEX, "the vertex stage"),
                (Stages::FRAGMENT, "the fragment stage"),
            ]
        };
        let scene = scene_entries();
        for (stage, name) in stages {
            for (kind, what, most) in [
                (
                    Kind::Buffer,
                    "storage buffers",
                    limits.max_storage_buffers_per_shader_stage,
                ),
                (
                    Kind::Texture,
                    "textures",
                    limits.max_sampled_textures_per_shader_stage,
                ),
                (
                    Kind::Sampler,
                    "samplers",
                    limits.max_samplers_per_shader_stage,
                ),
                (
                    Kind::StorageTexture,
                    "storage textures",
                    limits.max_storage_textures_per_shader_stage,
                ),
            ] {
                let of_scene = scene
                    .iter()
                    .filter(|entry| entry.visibility.contains(*stage))
                    .filter(|entry| Kind::of_type(&entry.ty) == Some(kind))
                    .count();
                let own = sources
                    .iter()
                    .filter(|(_, source)| layout::visibility(source, compute).contains(*stage))
                    .filter(|(_, source)| Kind::of_source(source) == kind)
                    .count();
                if own > 0 && of_scene + own > most as usize {
                    let at = self.pass.shader.as_ref().map_or(&self.pass.at, |s| &s.at);
                    self.report(
                        at,
                        format!(
                            "`{}` binds {own} {what} to {name}, and the scene {of_scene}; this \
                             adapter allows {most} together",
                            self.pass.name
                        ),
                        "keep several things in one buffer or array, or use two passes",
                    );
                }
            }
        }
    }
}

impl<S: FormatSupport> Binder<'_, S> {
    /// A fixed number of threads does not take more workgroups than a device dispatches.
    pub(super) fn dispatch(&mut self) {
        let PassKind::Compute(Dispatch::Threads(Amount::Fixed(x, y, z))) = self.pass.kind else {
            return;
        };
        let workgroup = self.reflection.workgroup_size.unwrap_or([1; 3]);
        let most = self.support.limits().max_compute_workgroups_per_dimension;
        for ((axis, threads), size) in ["x", "y", "z"].into_iter().zip([x, y, z]).zip(workgroup) {
            let groups = threads.div_ceil(size.max(1));
            if groups > most {
                self.report(
                    &self.pass.at.clone(),
                    format!(
                        "`{}` runs {threads} threads along {axis} in {groups} workgroups of {size}; \
                         this adapter allows {most}",
                        self.pass.name
                    ),
                    "make the workgroups larger, or spread the threads over x and y",
                );
            }
        }
    }
}

/// What is counted together.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Buffer,
    Texture,
    Sampler,
    StorageTexture,
}

impl Kind {
    fn of_type(ty: &wgpu::BindingType) -> Option<Self> {
        match ty {
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { .. },
                ..
            } => Some(Self::Buffer),
            wgpu::BindingType::Texture { .. } => Some(Self::Texture),
            wgpu::BindingType::Sampler(_) => Some(Self::Sampler),
            wgpu::BindingType::StorageTexture { .. } => Some(Self::StorageTexture),
            _ => None,
        }
    }

    fn of_source(source: &Source) -> Self {
        match source {
            Source::Buffer { .. } | Source::Engine(_) => Self::Buffer,
            Source::Target { .. } => Self::Texture,
            Source::StorageTexture { .. } => Self::StorageTexture,
            Source::LinearSampler | Source::NearestSampler | Source::DepthSampler => Self::Sampler,
        }
    }
}
