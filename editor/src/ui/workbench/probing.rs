//! What the passes did to a pixel, and where values are that are no numbers.

use lightbench::render::inspect::{
    Aspect, Invalid, PixelValue, ProbeRequest, TexelValue, part_in_words,
};

use super::Workbench;
use super::beside::Results;
use crate::ui::messages::say;

/// What one pass did to one part of one target, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The pass.
    pub pass: String,
    /// The target, and which mip level, layer, sample or stencil where it has several.
    pub target: String,
    /// The value before, unless the frame had not written it yet.
    pub before: Option<String>,
    /// The value after.
    pub after: String,
    /// Whether the value after is a finite number.
    pub is_finite: bool,
}

/// What is known of one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Probing {
    /// The pixel that was asked for last, from the upper left corner of the picture.
    pub pixel: Option<(u32, u32)>,
    /// The size of the picture in which it was asked for.
    pub size: Option<(u32, u32)>,
    /// What the passes did to it, in their order.
    pub values: Vec<Written>,
    /// What the pipeline leaves in the pixel.
    pub results: Results,
    /// The result of the last search for values that are no numbers, in words.
    pub invalid: Option<String>,
    /// Of which pipeline all that is.
    pub pipeline: String,
    waiting: bool,
}

impl Probing {
    /// Whether an answer is on its way.
    pub fn is_waiting(&self) -> bool {
        self.waiting
    }
}

impl Workbench {
    /// Asks what the passes of the next frame do to a pixel of the picture. The answer comes some
    /// frames later, in [`Workbench::probing`].
    pub fn probe(&mut self, pixel: (u32, u32)) {
        self.ask(ProbeRequest {
            pixel: Some(pixel),
            search: false,
        });
        self.probing.size = self.drawn_size();
        self.probing.pixel = Some(pixel);
        if self.lighting.on {
            self.light_pixel();
        }
        self.draw_beside();
    }

    /// Asks the same of the place that was asked for last, which is another pixel where the picture
    /// is of another size now.
    pub fn probe_again(&mut self) {
        let probing = &self.probing;
        let (Some(pixel), Some(before), Some(now)) =
            (probing.pixel, probing.size, self.drawn_size())
        else {
            return;
        };
        let scaled = |at: u32, before: u32, now: u32| {
            (u64::from(at) * u64::from(now) / u64::from(before.max(1))) as u32
        };
        self.probe((
            scaled(pixel.0, before.0, now.0),
            scaled(pixel.1, before.1, now.1),
        ));
    }

    /// Asks for the first pass of the next frame that leaves a value that is no number, or infinite.
    pub fn find_invalid(&mut self) {
        self.ask(ProbeRequest {
            pixel: None,
            search: true,
        });
    }

    fn ask(&mut self, request: ProbeRequest) {
        let shown = self.pipelines.shown().unwrap_or_default();
        if self.probing.pipeline != shown {
            self.probing = Probing {
                pipeline: shown.to_owned(),
                ..Probing::default()
            };
        }
        self.probing.waiting = true;
        self.renderer.inspector().probe(&self.files, request);
        self.canvas.repeat();
    }

    /// Takes in an answer.
    pub(super) fn take_probed(&mut self) {
        let Some(probed) = self.renderer.inspector().take_probed() else {
            self.probing.waiting &= self.renderer.inspector().is_probing();
            return;
        };
        if self.renderer.inspector().is_probing() {
            // Something else was asked for meanwhile.
            self.canvas.repeat();
        }
        if self.take_beside(&probed) {
            return;
        }
        let Some(desc) = self.pipelines.shown_pipeline().map(|p| &p.desc) else {
            return;
        };
        let pass_of = |index: usize| {
            let pass = desc.passes.get(index);
            pass.map_or_else(String::new, |pass| pass.name.clone())
        };
        // Somebody may have asked for another pixel meanwhile.
        if probed.pixel.is_some() && probed.pixel == self.probing.pixel {
            self.probing.results = Results::of(desc, &probed.values);
            let values = probed.values.iter();
            self.probing.values = values.map(|value| in_words(value, pass_of)).collect();
        }
        if probed.searched {
            let first = probed.invalid.first();
            let text = match first {
                None => say!("probing.every_value_that_a_pass_writes").to_owned(),
                Some(first) => found(first, &pass_of(first.pass)),
            };
            self.log.info(text.clone());
            self.probing.invalid = Some(text);
        }
        if probed.cut_off {
            self.log
                .warn(say!("probing.the_pipeline_writes_more_parts_of"));
        }
        let inspector = self.renderer.inspector();
        self.probing.waiting = inspector.is_probing() && !self.beside.reads();
    }
}

fn in_words(value: &PixelValue, pass_of: impl Fn(usize) -> String) -> Written {
    let words = |texel: TexelValue| texel.in_words(value.channels);
    let part = part_in_words(value.slice, value.sample, value.aspect);
    let channels = value.channels as usize;
    let numbers = value.after.to_floats();
    Written {
        pass: pass_of(value.pass),
        target: format!("{}{part}", value.target),
        before: value.before.map(words),
        after: words(value.after),
        is_finite: numbers
            .iter()
            .take(channels)
            .all(|number| number.is_finite()),
    }
}

fn found(invalid: &Invalid, pass: &str) -> String {
    let (x, y) = invalid.first;
    say!(
        "probing.the_pass_leaves_values_in_that",
        pass = pass,
        target = invalid.target,
        sample = part_in_words(invalid.slice, invalid.sample, Aspect::Main),
        texels = invalid.texels,
        x = x,
        y = y
    )
}
