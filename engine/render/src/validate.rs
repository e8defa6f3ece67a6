//! Checks a pipeline's description before anything is built from it.
//!
//! Every mistake is reported at once, each with its place and the way to mend it. What only the
//! shaders can tell is checked in [`crate::binding`], after they are composed.

use std::collections::{BTreeMap, BTreeSet};

use crate::description::{Blend, Load, Named, PassDesc, PassKind, PipelineDesc, TargetDesc};
use crate::format::Format;
use crate::problem::{Place, Problem, Problems, suggestion};
use crate::reflection::SampleKind;

/// What the adapter says about formats; the only thing that validation asks of the device.
pub trait FormatSupport {
    /// Whether targets of this format can be rendered to.
    fn renderable(&self, format: Format) -> bool;
    /// Whether colour targets of this format can blend.
    fn blendable(&self, format: Format) -> bool;
}

impl FormatSupport for crate::gpu::Gpu {
    fn renderable(&self, format: Format) -> bool {
        format
            .0
            .required_features()
            .difference(self.device.features())
            .is_empty()
            && self
                .format_usages(format)
                .contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
    }

    fn blendable(&self, format: Format) -> bool {
        format
            .0
            .guaranteed_format_features(self.device.features())
            .flags
            .contains(wgpu::TextureFormatFeatureFlags::BLENDABLE)
    }
}

impl crate::gpu::Gpu {
    fn format_usages(&self, format: Format) -> wgpu::TextureUsages {
        format
            .0
            .guaranteed_format_features(self.device.features())
            .allowed_usages
    }
}

/// Checks the description.
///
/// # Errors
/// Every mistake that was found, in the order of the declarations.
pub fn validate(desc: &PipelineDesc, support: &impl FormatSupport) -> Result<(), Problems> {
    let mut checker = Checker {
        desc,
        support,
        problems: Vec::new(),
    };
    checker.names();
    checker.targets();
    for pass in &desc.passes {
        checker.attachments(pass);
        checker.shader(pass);
    }
    checker.order();
    checker.results();
    if checker.problems.is_empty() {
        return Ok(());
    }
    checker
        .problems
        .sort_by_key(|problem| (problem.place.line, problem.place.column));
    Err(Problems(checker.problems))
}

struct Checker<'a, S> {
    desc: &'a PipelineDesc,
    support: &'a S,
    problems: Vec<Problem>,
}

impl<S: FormatSupport> Checker<'_, S> {
    fn report(&mut self, at: &Place, message: String, hint: impl Into<Option<String>>) {
        let mut problem = Problem::new(at.clone(), message);
        problem.hint = hint.into();
        self.problems.push(problem);
    }

    /// The target of that name, or a report.
    fn target(&mut self, name: &str, at: &Place) -> Option<&TargetDesc> {
        if self.desc.target(name).is_none() {
            let names = || self.desc.targets.iter().map(|target| target.name.as_str());
            let hint = suggestion(name, names()).unwrap_or_else(|| {
                let list = names()
                    .map(|name| format!("`{name}`"))
                    .collect::<Vec<_>>()
                    .join(", ");
                if list.is_empty() {
                    format!("declare it: p.target(\"{name}\", \"rgba16float\")")
                } else {
                    format!("the targets are: {list}")
                }
            });
            self.report(at, format!("there is no target `{name}`"), hint);
        }
        self.desc.target(name)
    }

    fn names(&mut self) {
        let desc = self.desc;
        let groups: [(&str, Vec<(&str, &Place)>); 3] = [
            (
                "target",
                desc.targets
                    .iter()
                    .map(|t| (t.name.as_str(), &t.at))
                    .collect(),
            ),
            (
                "pass",
                desc.passes
                    .iter()
                    .map(|p| (p.name.as_str(), &p.at))
                    .collect(),
            ),
            (
                "parameter",
                desc.parameters
                    .iter()
                    .map(|p| (p.name.as_str(), &p.at))
                    .collect(),
            ),
        ];
        for (what, names) in groups {
            let mut seen: BTreeMap<&str, &Place> = BTreeMap::new();
            for (name, at) in names {
                if let Some(first) = seen.insert(name, at) {
                    let first = first.line;
                    self.report(
                        at,
                        format!("the {what} `{name}` was declared already, in line {first}"),
                        "give one of them another name".to_owned(),
                    );
                }
            }
        }
    }

    fn targets(&mut self) {
        for target in &self.desc.targets {
            if !self.support.renderable(target.format) {
                self.report(
                    &target.at,
                    format!("this adapter can't render to {}", target.format),
                    "choose another format; `rgba16float` and `rgba8unorm` work everywhere"
                        .to_owned(),
                );
            }
            let used = self.desc.passes.iter().any(|pass| {
                pass.colors.iter().any(|color| color.target == target.name)
                    || pass.depth.iter().any(|depth| depth.target == target.name)
                    || pass.reads.iter().any(|read| read.target == target.name)
            });
            if !used {
                self.report(
                    &target.at,
                    format!("no pass uses the target `{}`", target.name),
                    "write it in a pass, or remove it".to_owned(),
                );
            }
        }
    }

    fn attachments(&mut self, pass: &PassDesc) {
        if pass.colors.is_empty() && pass.depth.is_none() {
            self.report(
                &pass.at,
                format!("the pass `{}` writes nothing", pass.name),
                "add .writes(\"target\") or .depth(\"target\")".to_owned(),
            );
        }
        let mut seen = BTreeSet::new();
        for color in &pass.colors {
            let Some(format) = self.target(&color.target, &color.at).map(|t| t.format) else {
                continue;
            };
            if !seen.insert(color.target.as_str()) {
                self.report(
                    &color.at,
                    format!("the pass writes `{}` twice", color.target),
                    None,
                );
            }
            if format.is_depth() {
                self.report(
                    &color.at,
                    format!(
                        "`{}` holds depth ({format}) and can't be a colour target",
                        color.target
                    ),
                    format!("use .depth(\"{}\")", color.target),
                );
            } else if color.blend != Blend::Replace && !self.support.blendable(format) {
                let integer = SampleKind::of_format(format.0) != SampleKind::Float;
                let why = if integer {
                    "integers never blend"
                } else {
                    "not on this adapter"
                };
                self.report(
                    &color.at,
                    format!("`{}` is {format}, which can't blend: {why}", color.target),
                    "choose `rgba16float`, or drop .blend".to_owned(),
                );
            }
        }
        if let Some(depth) = &pass.depth {
            let format = self.target(&depth.target, &depth.at).map(|t| t.format);
            if let Some(format) = format.filter(|format| !format.is_depth()) {
                self.report(
                    &depth.at,
                    format!("`{}` is {format}, which holds no depth", depth.target),
                    "give it the format `depth32float`".to_owned(),
                );
            }
            if !depth.write && matches!(depth.load, Load::Clear(_)) {
                self.report(
                    &depth.at,
                    format!("`{}` is read-only here and can't be cleared", depth.target),
                    "drop .clear, or .read_only()".to_owned(),
                );
            }
        }
        self.sizes(pass);
        self.feedback(pass);
    }

    /// All attachments of a pass have one size.
    fn sizes(&mut self, pass: &PassDesc) {
        let attachments = pass.colors.iter().map(|c| (&c.target, &c.at));
        let attachments = attachments.chain(pass.depth.iter().map(|d| (&d.target, &d.at)));
        let known: Vec<_> = attachments
            .filter_map(|(name, at)| self.desc.target(name).map(|t| (name, at, t.size)))
            .collect();
        if let Some(((first, _, size), rest)) = known.split_first() {
            for (name, at, other) in rest {
                if other != size {
                    self.report(
                        at,
                        format!("`{name}` and `{first}` differ in size, but one pass writes both"),
                        "give them the same .scale or .size, or use two passes".to_owned(),
                    );
                }
            }
        }
    }

    /// No target is read and written by one pass, except depth that is read-only.
    fn feedback(&mut self, pass: &PassDesc) {
        for read in &pass.reads {
            if self.target(&read.target, &read.at).is_none() {
                continue;
            }
            if pass.colors.iter().any(|color| color.target == read.target) {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads `{}` and writes it",
                        pass.name, read.target
                    ),
                    "write to a second target, or use .blend(\"add\")".to_owned(),
                );
            }
            if pass
                .depth
                .as_ref()
                .is_some_and(|depth| depth.target == read.target && depth.write)
            {
                self.report(
                    &read.at,
                    format!(
                        "the pass `{}` reads the depth `{}` that it writes",
                        pass.name, read.target
                    ),
                    "add .read_only() after .depth".to_owned(),
                );
            }
        }
    }

    fn shader(&mut self, pass: &PassDesc) {
        let depth_only = matches!(pass.kind, PassKind::Geometry { .. }) && pass.colors.is_empty();
        if pass.shader.is_none() && !depth_only {
            self.report(
                &pass.at,
                format!("the pass `{}` has no shader", pass.name),
                "add .shader(\"shaders/name.wgsl\")".to_owned(),
            );
        }
        if pass.colors.is_empty()
            && !matches!(pass.kind, PassKind::Geometry { .. })
            && pass.depth.is_some()
        {
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

    /// Nothing is read or kept that no earlier pass wrote.
    fn order(&mut self) {
        let desc = self.desc;
        let mut written: BTreeSet<&str> = BTreeSet::new();
        for pass in &desc.passes {
            let mut wanted: Vec<(&str, &Place, &str)> = Vec::new();
            wanted.extend(
                pass.reads
                    .iter()
                    .map(|read| (read.target.as_str(), &read.at, "reads")),
            );
            for color in &pass.colors {
                if color.load == Load::Keep && !covers(pass) {
                    wanted.push((&color.target, &color.at, "keeps"));
                }
            }
            if let Some(depth) = &pass.depth
                && depth.load == Load::Keep
            {
                wanted.push((&depth.target, &depth.at, "tests against"));
            }
            for (name, at, verb) in wanted {
                if desc.target(name).is_some() && !written.contains(name) {
                    let later = desc
                        .passes
                        .iter()
                        .find(|other| writes(other, name) && other.name != pass.name);
                    let hint = match later {
                        _ if verb == "keeps" => "add .clear after it".to_owned(),
                        Some(later) => {
                            format!("`{}` writes it, but comes later: move it up", later.name)
                        }
                        None if verb == "reads" => "no pass writes it: add one before".to_owned(),
                        None => "add .clear after it".to_owned(),
                    };
                    self.report(
                        at,
                        format!("`{}` {verb} `{name}`, which nobody wrote yet", pass.name),
                        hint,
                    );
                }
            }
            written.extend(pass.colors.iter().map(|color| color.target.as_str()));
            written.extend(
                pass.depth
                    .iter()
                    .filter(|depth| depth.write)
                    .map(|d| d.target.as_str()),
            );
        }
    }

    /// The pipeline ends in a picture.
    fn results(&mut self) {
        let desc = self.desc;
        match &desc.output {
            None => self.report(
                &desc.file,
                "the pipeline shows nothing".to_owned(),
                "end with p.show(\"output\"), naming an `rgba8unorm` target".to_owned(),
            ),
            Some(output) => self.result(output, "rgba8unorm", |f| {
                f.0 == wgpu::TextureFormat::Rgba8Unorm
            }),
        }
        if let Some(hdr) = &desc.hdr {
            self.result(hdr, "rgba16float or rgba32float", |f| {
                matches!(
                    f.0,
                    wgpu::TextureFormat::Rgba16Float | wgpu::TextureFormat::Rgba32Float
                )
            });
        }
    }

    fn result(&mut self, result: &Named, wanted: &str, fits: impl Fn(Format) -> bool) {
        let Some(target) = self.target(&result.name, &result.at) else {
            return;
        };
        let (format, size) = (target.format, target.size);
        if !fits(format) {
            self.report(
                &result.at,
                format!("`{}` is {format}; here it must be {wanted}", result.name),
                None,
            );
        }
        if size != crate::description::TargetSize::Relative(1.0) {
            self.report(
                &result.at,
                format!("`{}` must have the output's size", result.name),
                None,
            );
        }
        if !self
            .desc
            .passes
            .iter()
            .any(|pass| writes(pass, &result.name))
        {
            self.report(
                &result.at,
                format!("no pass writes `{}`", result.name),
                None,
            );
        }
    }
}

/// Whether the pass writes every pixel of its colour targets, so that nothing old is kept.
fn covers(pass: &PassDesc) -> bool {
    pass.kind == PassKind::Fullscreen
        && pass.depth.is_none()
        && pass
            .colors
            .iter()
            .all(|color| color.blend == Blend::Replace)
}

fn writes(pass: &PassDesc, name: &str) -> bool {
    pass.colors.iter().any(|color| color.target == name)
        || pass
            .depth
            .iter()
            .any(|depth| depth.target == name && depth.write)
}
