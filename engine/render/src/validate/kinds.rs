//! What each kind of pass needs and may not have.

use super::{Checker, FormatSupport};
use crate::description::{
    Amount, ColorMask, Dispatch, LightStencil, Lights, Load, PassDesc, PassKind, Shadow,
    ShadowViews, Slice, StencilClear,
};
use crate::problem::suggestion;

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn kind(&mut self, pass: &PassDesc) {
        match &pass.kind {
            PassKind::Geometry(geometry) => {
                if geometry.pull_vertices && pass.shader.is_none() {
                    self.report(
                        &pass.at,
                        format!("`{}` pulls its vertices, but has no shader", pass.name),
                        "add .shader(\"shaders/name.wgsl\") with a vertex stage of its own"
                            .to_owned(),
                    );
                }
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
                self.light_arrays(pass, lights);
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

    /// Array n of the lights has channel n mod 4 of colour target n / 4.
    fn light_arrays(&mut self, pass: &PassDesc, lights: &Lights) {
        let desc = self.desc;
        let mut masked = pass.colors.iter().filter(|c| c.mask != ColorMask::ALL);
        if lights.arrays > 0
            && let Some(color) = masked.next()
        {
            self.report(
                &color.at,
                format!(
                    "the arrays of `{}` choose themselves which channels of `{}` they write",
                    pass.name, color.target
                ),
                "drop .mask, or .arrays".to_owned(),
            );
        }
        let has = |array: u32| {
            let color = pass.colors.get(array as usize / 4)?;
            let target = desc.target(&color.target)?;
            Some(array % 4 < u32::from(target.format.0.components()))
        };
        if (0..lights.arrays).all(|array| has(array) == Some(true)) {
            return;
        }
        let channels = (0..lights.arrays).filter(|array| has(*array) == Some(true));
        self.report(
            &pass.at,
            format!(
                "`{}` has {} arrays of lights, but its targets have room for {}",
                pass.name,
                lights.arrays,
                channels.count()
            ),
            "each array has one channel: write a target of four channels for every four arrays"
                .to_owned(),
        );
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
        if depth.slice != Slice::default() {
            self.report(
                &depth.at,
                format!(
                    "the shadow pass `{}` draws to all layers of `{}`, a view to each",
                    pass.name, depth.target
                ),
                "drop .layer, or draw the one layer to a target of its own".to_owned(),
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
            Dispatch::Indirect { buffer, word } => self.indirect(pass, buffer, *word),
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

    /// The number of workgroups stands in a buffer that the pass itself leaves alone.
    fn indirect(&mut self, pass: &PassDesc, name: &str, word: u32) {
        let desc = self.desc;
        let Some(buffer) = desc.buffer(name) else {
            let names = desc.buffers.iter().map(|buffer| buffer.name.as_str());
            let hint = suggestion(name, names)
                .unwrap_or_else(|| format!("declare it: p.buffer(\"{name}\", 3)"));
            self.report(&pass.at, format!("there is no buffer `{name}`"), hint);
            return;
        };
        let words = buffer.size.least_words();
        if u64::from(word) + 3 > words {
            self.report(
                &pass.at,
                format!(
                    "`{}` takes words {word} to {} of `{name}`, which may have {words} only",
                    pass.name,
                    u64::from(word) + 2
                ),
                "three words say how many groups there are along x, y and z; the first is 0"
                    .to_owned(),
            );
        }
        if let Some(update) = pass.updates.iter().find(|update| update.target == name) {
            self.report(
                &update.at,
                format!(
                    "`{}` updates `{name}`, which says how often it runs",
                    pass.name
                ),
                "let another pass write the number of groups, into another buffer".to_owned(),
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
        if !draws {
            self.nothing_to_draw(pass);
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

    /// A pass that runs no shader reads nothing by itself, and only `clear` has attachments.
    fn nothing_to_draw(&mut self, pass: &PassDesc) {
        let kind = pass.kind.name();
        let clears = pass.kind == PassKind::Clear;
        if let Some(read) = pass.reads.first() {
            self.report(
                &read.at,
                format!("a `{kind}` pass has no shader that could read something"),
                "remove .reads, or use p.fullscreen".to_owned(),
            );
        }
        let colors = pass.colors.iter().map(|color| &color.at);
        let depth = pass.depth.iter().map(|depth| &depth.at);
        let updates = pass.updates.iter().map(|update| &update.at);
        if let Some(at) = colors
            .chain(depth)
            .chain(updates)
            .next()
            .filter(|_| !clears)
        {
            self.report(
                at,
                format!("a `{kind}` pass writes the target that it names first, and no other"),
                "remove this, or use p.fullscreen".to_owned(),
            );
        }
    }
}
