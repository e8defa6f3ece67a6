//! What each kind of pass needs and may not have.

use super::{Checker, FormatSupport};
use crate::description::{
    Amount, Dispatch, LightStencil, Load, PassDesc, PassKind, Read, Reduction, Shadow, ShadowViews,
    Shape, StencilClear,
};
use crate::reflection::SampleKind;

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn kind(&mut self, pass: &PassDesc) {
        match &pass.kind {
            PassKind::Geometry(geometry) => {
                if let Some(repeat) = geometry.repeat.filter(|repeat| repeat.stencil) {
                    if repeat.lights != 1 {
                        self.report(
                            &pass.at,
                            format!(
                                "`{}` masks by stencil, which needs one light at a time, not {}",
                                pass.name, repeat.lights
                            ),
                            "write .repeat_for_lights(1), or drop .stencil_mask".to_owned(),
                        );
                    }
                    self.stencil_buffer(pass, "masks by stencil");
                }
            }
            PassKind::Lights(lights) => {
                if lights.stencil != LightStencil::Off {
                    self.stencil_buffer(pass, "marks volumes in stencil");
                }
                let channels = pass.colors.len() as u32 * 4;
                if lights.arrays > channels {
                    self.report(
                        &pass.at,
                        format!(
                            "`{}` has {} arrays of lights, but its targets have {channels} channels",
                            pass.name, lights.arrays
                        ),
                        "add a target of four channels for every four arrays".to_owned(),
                    );
                }
            }
            PassKind::Shadow(shadow) => self.shadow(pass, shadow),
            PassKind::Compute(dispatch) => self.dispatch(pass, dispatch),
            PassKind::Clear => self.clear(pass),
            PassKind::Copy { from, to } | PassKind::History { from, to } => {
                self.copy(pass, from, to);
            }
            PassKind::Resolve { from, to } => self.resolve(from, to),
            PassKind::Mips { target, reduction } => self.mips(target, *reduction),
            PassKind::Fullscreen => {}
        }
    }

    /// The pass has a depth target with stencil, and does not read it.
    fn stencil_buffer(&mut self, pass: &PassDesc, why: &str) {
        let desc = self.desc;
        let Some(depth) = &pass.depth else {
            self.report(
                &pass.at,
                format!("`{}` {why}, but has no depth target", pass.name),
                "add .depth(\"depth\").read_only()".to_owned(),
            );
            return;
        };
        let Some(target) = desc.target(&depth.target) else {
            return;
        };
        if !target.format.has_stencil() {
            self.report(
                &depth.at,
                format!(
                    "`{}` {why}, but `{}` is {}, without stencil",
                    pass.name, target.name, target.format
                ),
                "give it the format `depth32float-stencil8`".to_owned(),
            );
        }
        if let Some(read) = pass.reads.iter().find(|read| read.target == depth.target) {
            self.report(
                &read.at,
                format!(
                    "`{}` {why} in `{}`, so its shader can't read that",
                    pass.name, read.target
                ),
                "write depth to a second target in an earlier pass, and read that".to_owned(),
            );
        }
    }

    fn shadow(&mut self, pass: &PassDesc, shadow: &Shadow) {
        if let Some(color) = pass.colors.first() {
            self.report(
                &color.at,
                format!("the shadow pass `{}` writes colours", pass.name),
                "draw depth alone; a geometry pass draws colours".to_owned(),
            );
        }
        let Some(depth) = &pass.depth else {
            self.report(
                &pass.at,
                format!("the shadow pass `{}` has no depth target", pass.name),
                "add .depth(\"shadow_map\").clear(0.0)".to_owned(),
            );
            return;
        };
        if !depth.write {
            self.report(
                &depth.at,
                format!("the shadow pass `{}` would write nothing", pass.name),
                "drop .read_only()".to_owned(),
            );
        }
        if let Some(stencil) = &depth.stencil {
            self.report(
                &stencil.at,
                format!("the shadow pass `{}` has no use for stencil", pass.name),
                "drop .stencil and what follows it".to_owned(),
            );
        }
        if let ShadowViews::Given(views) = &shadow.views
            && views.is_empty()
        {
            self.report(
                &pass.at,
                format!("the shadow pass `{}` has no views", pass.name),
                "add .views(\"spot\"), or .view_from(eye, target, degrees, near, far)".to_owned(),
            );
        }
        let layers = self.desc.target(&depth.target).map(|t| t.shape.layers());
        let wanted = match shadow.views {
            ShadowViews::Lights(lights) => lights.layers(),
            ShadowViews::Given(_) => 1,
        };
        if let Some(layers) = layers.filter(|layers| *layers < wanted) {
            self.report(
                &depth.at,
                format!(
                    "the views of a point light take six layers; `{}` has {layers}",
                    depth.target
                ),
                "declare it with .array(6), or .cube()".to_owned(),
            );
        }
    }

    fn dispatch(&mut self, pass: &PassDesc, dispatch: &Dispatch) {
        if !pass.colors.is_empty() || pass.depth.is_some() {
            self.report(
                &pass.at,
                format!("the compute pass `{}` draws to targets", pass.name),
                "compute shaders write through .updates".to_owned(),
            );
        }
        match dispatch {
            Dispatch::Threads(Amount::Texels { target, mip })
            | Dispatch::Groups(Amount::Texels { target, mip }) => {
                if let Some(target) = self.target(target, &pass.at) {
                    self.in_range(&target.name, &pass.at, *mip, 0);
                }
            }
            Dispatch::Indirect { buffer, .. } => {
                if self.desc.buffer(buffer).is_none() {
                    self.report(
                        &pass.at,
                        format!("there is no buffer `{buffer}`"),
                        format!("declare it: p.buffer(\"{buffer}\", 3)"),
                    );
                }
            }
            Dispatch::Threads(_) | Dispatch::Groups(_) => {}
        }
        if pass.updates.is_empty() {
            self.report(
                &pass.at,
                format!("the pass `{}` writes nothing", pass.name),
                "add .updates(\"buffer\")".to_owned(),
            );
        }
    }

    fn clear(&mut self, pass: &PassDesc) {
        if pass.colors.is_empty() && pass.depth.is_none() && pass.updates.is_empty() {
            self.report(
                &pass.at,
                format!("the pass `{}` clears nothing", pass.name),
                "add .writes(\"target\").clear(0, 0, 0, 0), or .updates(\"buffer\")".to_owned(),
            );
        }
        for color in &pass.colors {
            if color.load == Load::Keep {
                self.report(
                    &color.at,
                    format!(
                        "`{}` does not say what `{}` is filled with",
                        pass.name, color.target
                    ),
                    "add .clear(red, green, blue, alpha) after it".to_owned(),
                );
            }
        }
        if let Some(depth) = &pass.depth {
            let stencil = depth.stencil.as_ref();
            let filled = stencil.is_some_and(|stencil| stencil.load != StencilClear::Keep);
            if depth.load == Load::Keep && !filled {
                self.report(
                    &depth.at,
                    format!(
                        "`{}` does not say what `{}` is filled with",
                        pass.name, depth.target
                    ),
                    "add .clear(0.0) after it".to_owned(),
                );
            }
        }
        for update in &pass.updates {
            if self.desc.target(&update.target).is_some() {
                self.report(
                    &update.at,
                    format!(
                        "`{}` is a target, which is cleared by .writes",
                        update.target
                    ),
                    format!("write .writes(\"{}\").clear(0, 0, 0, 0)", update.target),
                );
            }
        }
    }

    fn copy(&mut self, pass: &PassDesc, from: &Read, to: &Read) {
        let desc = self.desc;
        if !self.known(&from.target, &from.at) || !self.known(&to.target, &to.at) {
            return;
        }
        if from.target == to.target && (from.mip, from.layer) == (to.mip, to.layer) {
            self.report(
                &from.at,
                format!("`{}` copies `{}` to itself", pass.name, from.target),
                "name another target".to_owned(),
            );
            return;
        }
        if let (Some(a), Some(b)) = (desc.buffer(&from.target), desc.buffer(&to.target)) {
            if a.size != b.size {
                let message = format!("`{}` and `{}` differ in size", a.name, b.name);
                self.report(&from.at, message, "give them the same words".to_owned());
            }
            return;
        }
        let (Some(a), Some(b)) = (desc.target(&from.target), desc.target(&to.target)) else {
            self.report(
                &from.at,
                format!(
                    "of `{}` and `{}` one is a target, one a buffer",
                    from.target, to.target
                ),
                "copy between two targets or two buffers".to_owned(),
            );
            return;
        };
        let slices = from.mip.is_some() || to.mip.is_some();
        let alike = a.format == b.format
            && a.samples == b.samples
            && (slices || (a.size == b.size && a.shape == b.shape));
        if !alike {
            self.report(
                &from.at,
                format!(
                    "`{}` can't be copied to `{}`: they are not alike",
                    a.name, b.name
                ),
                "give them the same format, size, shape and samples".to_owned(),
            );
        }
        for read in [from, to] {
            let (mip, layer) = (read.mip.unwrap_or(0), read.layer.unwrap_or(0));
            self.in_range(&read.target, &read.at, mip, layer);
        }
        let history = matches!(pass.kind, PassKind::History { .. });
        let written = desc.passes.iter().any(|other| {
            other.name != pass.name && crate::life::writes(other).any(|name| name == to.target)
        });
        if history && written {
            self.report(
                &to.at,
                format!(
                    "`{}` holds the last frame, but another pass writes it too",
                    to.target
                ),
                "let the other pass write another target".to_owned(),
            );
        }
    }

    fn resolve(&mut self, from: &Read, to: &Read) {
        let (a, b) = (
            self.target(&from.target, &from.at),
            self.target(&to.target, &to.at),
        );
        let (Some(a), Some(b)) = (a, b) else {
            return;
        };
        if a.samples == 1 {
            self.report(
                &from.at,
                format!(
                    "`{}` has one sample a texel: there is nothing to resolve",
                    a.name
                ),
                "declare it with .samples(4), or use p.copy".to_owned(),
            );
        } else if b.samples != 1 || a.format != b.format || a.size != b.size {
            self.report(
                &to.at,
                format!(
                    "`{}` can't take the mean of `{}`: they are not alike",
                    b.name, a.name
                ),
                "give it the same format and size, and one sample a texel".to_owned(),
            );
        } else if !self.support.resolvable(a.format) {
            self.report(
                &from.at,
                format!("samples of {} have no mean on this adapter", a.format),
                "read the samples in a shader, with textureLoad".to_owned(),
            );
        }
    }

    fn mips(&mut self, read: &Read, reduction: Reduction) {
        let Some(target) = self.target(&read.target, &read.at) else {
            return;
        };
        let name = &target.name;
        let kind = SampleKind::of_format(target.format.0);
        if target.mips == crate::description::Mips::Count(1) {
            self.report(
                &read.at,
                format!("`{name}` has one mip level only"),
                "declare it with .mips()".to_owned(),
            );
        }
        if kind == SampleKind::Depth || matches!(target.shape, Shape::Volume(_)) {
            self.report(
                &read.at,
                format!("a `mips` pass can't fill `{name}`, which is depth or 3D"),
                "copy depth to an `r32float` target in a fullscreen pass first".to_owned(),
            );
        }
        if reduction == Reduction::Average && matches!(kind, SampleKind::Uint | SampleKind::Sint) {
            self.report(
                &read.at,
                format!("`{name}` is {}: integers have no average", target.format),
                "use `min` or `max`".to_owned(),
            );
        }
    }

    /// Passes that draw or compute have a shader, the others have none.
    pub(super) fn shader(&mut self, pass: &PassDesc) {
        let draws = pass.kind.rasterises() || matches!(pass.kind, PassKind::Compute(_));
        let depth_only = match pass.kind {
            PassKind::Shadow(_) => true,
            PassKind::Geometry(_) => pass.colors.is_empty() && pass.updates.is_empty(),
            _ => false,
        };
        match &pass.shader {
            None if draws && !depth_only => self.report(
                &pass.at,
                format!("the pass `{}` has no shader", pass.name),
                "add .shader(\"shaders/name.wgsl\")".to_owned(),
            ),
            Some(shader) if !draws => self.report(
                &shader.at,
                format!("a `{}` pass runs no shader", pass.kind.name()),
                "remove .shader, or use p.fullscreen".to_owned(),
            ),
            _ => {}
        }
        if matches!(pass.kind, PassKind::Lights(_) | PassKind::Fullscreen)
            && pass.colors.is_empty()
            && pass.updates.is_empty()
            && pass.depth.is_some()
        {
            let depth = pass.depth.as_ref();
            let stencil = depth.and_then(|depth| depth.stencil.as_ref());
            let writes_depth = pass.kind == PassKind::Fullscreen
                && (depth.is_some_and(|depth| depth.write) || stencil.is_some_and(|s| s.writes()));
            if !writes_depth {
                self.report(
                    &pass.at,
                    format!(
                        "the pass `{}` has a depth target but writes no colour",
                        pass.name
                    ),
                    "add .writes(\"target\")".to_owned(),
                );
            }
        }
    }
}
