//! The picture of B, and what both pictures become.

use std::time::Instant;

use lightbench::render::inspect::{Attention, Combination, Combiner};
use lightbench::render::{Place, Problem, RenderError, View};

use super::{Made, Mode, Waiting};
use crate::ui::workbench::Workbench;

impl Workbench {
    /// Goes one step on with a pipeline of B that is not warm yet.
    pub(in crate::ui::workbench) fn warm_up_other(&mut self, view: &View, size: (u32, u32)) {
        if !self.comparing.is_on {
            return;
        }
        let time = self.clock.time();
        let (Some(side), Some(scene)) = (&mut self.comparing.side, self.scenes.scene_mut()) else {
            return;
        };
        let Some(pipeline) = side.pipelines.cold() else {
            return;
        };
        let (world, assets) = (&mut scene.world, &scene.assets);
        let result = self
            .renderer
            .warm_up(world, assets, pipeline, view, size, time);
        match result {
            Ok(false) => {}
            Err(RenderError::NotBuilt(variants)) => side.pipelines.need(variants),
            Err(RenderError::Gpu(error)) => self.device_failed(error),
            // What keeps it from drawing is said when it draws.
            Ok(true) | Err(_) => {
                side.pipelines.warmed();
                side.timings.reset();
                self.canvas.invalidate();
            }
        }
    }

    /// A was to draw a moment, at which its shaders saw `index` as `frame_index`: B draws the same one, as
    /// soon as the device has room for it.
    pub(in crate::ui::workbench) fn redraw_other(
        &mut self,
        view: View,
        size: (u32, u32),
        index: u32,
    ) {
        if !self.comparing.is_on {
            return;
        }
        self.comparing.waiting = Some(Waiting {
            view,
            size,
            index,
            // A that failed has drawn nothing of this moment.
            is_whole: self.renderer.frame_index() != index,
        });
        self.go_on_with_other();
    }

    /// Draws B where it waits and the device has room.
    pub(in crate::ui::workbench) fn go_on_with_other(&mut self) {
        if !self.has_room() {
            return;
        }
        if let Some(waiting) = self.comparing.waiting.take() {
            self.draw_other(&waiting);
        }
    }

    fn draw_other(&mut self, waiting: &Waiting) {
        let Waiting {
            view, size, index, ..
        } = *waiting;
        let time = self.clock.time();
        let comparing = &mut self.comparing;
        let (Some(side), Some(scene)) = (&mut comparing.side, self.scenes.scene_mut()) else {
            return;
        };
        if side.size != Some(size) {
            side.timings.reset();
            side.pipelines.release_hidden();
        }
        let Some(pipeline) = side.pipelines.shown_pipeline() else {
            return;
        };
        let frame = self.renderer.next_frame();
        self.renderer.set_frame_index(index);
        // What is looked into is A.
        self.renderer.inspector().attend(Attention::Nothing);
        let (world, assets) = (&mut scene.world, &scene.assets);
        let result = self
            .renderer
            .render(world, assets, pipeline, &view, size, time);
        let failed = match result {
            Ok(statistics) => {
                side.timings.submitted(frame, statistics);
                side.statistics.clone_from(statistics);
                side.size = Some(size);
                side.problem = None;
                comparing.frames.push_back(frame);
                if comparing.frames.len() > 16 {
                    comparing.frames.pop_front();
                }
                comparing.pairs += 1;
                comparing.is_whole = waiting.is_whole;
                None
            }
            Err(RenderError::Gpu(error)) => Some(error),
            // The last picture stays until that is built.
            Err(RenderError::NotBuilt(variants)) => {
                side.pipelines.need(variants);
                None
            }
            Err(error) => {
                let problem = Problem::new(Place::file("viewport, B"), error.to_string());
                if side.problem.as_ref() != Some(&problem) {
                    self.log.problem(&problem);
                }
                side.problem = Some(problem);
                None
            }
        };
        self.renderer.inspector().attend(Attention::Whole);
        self.renderer.set_frame_index(index.wrapping_add(1));
        if let Some(error) = failed {
            self.device_failed(error);
        }
    }

    /// What the viewport shows in place of the picture of A; `None` where it shows that.
    pub(in crate::ui::workbench) fn compared_picture(
        &mut self,
        first: &wgpu::Texture,
        now: Instant,
    ) -> Option<wgpu::Texture> {
        let comparing = &mut self.comparing;
        let side = comparing.side.as_mut().filter(|_| comparing.is_on)?;
        let second = side.picture()?;
        let how = match comparing.mode {
            Mode::Flicker => {
                comparing.flicker.advance(now);
                comparing.shown = None;
                return comparing.flicker.shows_b.then_some(second);
            }
            Mode::Split => Combination::Split {
                at: comparing.split,
            },
            Mode::Difference => Combination::Difference {
                gain: comparing.gain,
                map: comparing.false_colors,
            },
            Mode::Flip => Combination::Overlay {
                opacity: comparing.opacity,
            },
        };
        let second = match comparing.mode {
            Mode::Flip => comparing.judge.painted(self.renderer.gpu())?,
            _ => second,
        };
        let made = Made {
            pair: comparing.pairs,
            how,
            judged: comparing.judge.last().map(|judged| judged.pair),
        };
        // The picture of A may be another texture though no pair was drawn since, as after a failure.
        let same_size = comparing
            .shown
            .as_ref()
            .is_some_and(|shown| shown.size() == first.size());
        if same_size && comparing.made_from.as_ref() == Some(&made) {
            return comparing.shown.clone();
        }
        let gpu = self.renderer.gpu();
        let combiner = comparing.combiner.get_or_insert_with(|| Combiner::new(gpu));
        match combiner.combine(&self.files, first, &second, how) {
            Ok(picture) => {
                comparing.problem = None;
                comparing.shown.clone_from(&picture);
                comparing.made_from = Some(made);
                picture
            }
            Err(problem) => {
                if comparing.problem.as_ref() != Some(&problem) {
                    self.log.problem(&problem);
                }
                comparing.problem = Some(problem);
                None
            }
        }
    }
}
