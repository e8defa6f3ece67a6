//! What a swap between pipelines costs: the first visit, and the way back.

use std::time::{Duration, Instant};

use lightbench::assets::files::Files;

use super::{BenchOptions, PAUSE, Session, percentile};

/// Frames whose median is a pipeline's time.
const FRAMES: usize = 9;

/// One pipeline.
#[derive(Clone, Debug, PartialEq)]
pub struct Visit {
    /// Its name.
    pub pipeline: String,
    /// Milliseconds from choosing it to its picture, the first time. The one before goes on
    /// meanwhile.
    pub first_ms: f64,
    /// The longest time in which no widget could answer during that visit, milliseconds.
    pub longest_pause_ms: f64,
    /// Median of its frames, milliseconds.
    pub frame_ms: f64,
    /// Milliseconds of the first frame after a swap back to it from the pipeline before it.
    pub back_ms: f64,
    /// The same in medians of the slower of the two pipelines.
    pub back_ratio: f64,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SwapTimes {
    /// The adapter's name.
    pub adapter: String,
    /// In the order of the visits.
    pub visits: Vec<Visit>,
}

impl std::fmt::Display for SwapTimes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(
            f,
            "swaps between pipelines, {}; milliseconds\n{:24} {:>11} {:>13} {:>8} {:>10} {:>16}",
            self.adapter,
            "pipeline",
            "first visit",
            "longest pause",
            "a frame",
            "swap back",
            "in slower frames"
        )?;
        for visit in &self.visits {
            writeln!(
                f,
                "{:24} {:11.0} {:13.0} {:8.1} {:10.1} {:16.2}",
                visit.pipeline,
                visit.first_ms,
                visit.longest_pause_ms,
                visit.frame_ms,
                visit.back_ms,
                visit.back_ratio,
            )?;
        }
        let worst = self.visits.iter().map(|visit| visit.back_ratio);
        write!(
            f,
            "the longest frame after a swap back takes {:.2} times the slower pipeline's median",
            worst.fold(0.0, f64::max)
        )
    }
}

/// Visits pipelines one after the other and swaps back and forth between neighbours.
///
/// # Errors
/// Without a driver, or for a pipeline with mistakes.
pub fn swap(
    options: &BenchOptions,
    files: Files,
    pipelines: &[String],
    mut on_visit: impl FnMut(usize),
) -> anyhow::Result<SwapTimes> {
    let mut session = Session::open(options, files)?;
    let mut visits: Vec<Visit> = Vec::with_capacity(pipelines.len());
    for (index, pipeline) in pipelines.iter().enumerate() {
        session.longest_pause = Duration::ZERO;
        let began = Instant::now();
        session.workbench.select_pipeline(pipeline);
        session.until(|w| w.pipelines.shown() == Some(pipeline) && w.picture_is_current())?;
        session.finish()?;
        let first_ms = began.elapsed().as_secs_f64() * 1e3;
        let longest_pause_ms = session.longest_pause.as_secs_f64() * 1e3;
        let frames: Vec<f64> = (0..FRAMES)
            .map(|_| frame(&mut session))
            .collect::<Result<_, _>>()?;
        let mut visit = Visit {
            pipeline: pipeline.clone(),
            first_ms,
            longest_pause_ms,
            frame_ms: percentile(&frames, 0.5),
            back_ms: f64::NAN,
            back_ratio: f64::NAN,
        };
        if let Some(before) = visits.last() {
            let slower = visit.frame_ms.max(before.frame_ms);
            let mut longest = 0.0_f64;
            for _ in 0..FRAMES {
                session.workbench.select_pipeline(&before.pipeline);
                frame(&mut session)?;
                session.workbench.select_pipeline(pipeline);
                longest = longest.max(frame(&mut session)?);
            }
            (visit.back_ms, visit.back_ratio) = (longest, longest / slower);
        }
        visits.push(visit);
        on_visit(index + 1);
    }
    Ok(SwapTimes {
        adapter: session.adapter,
        visits,
    })
}

/// Draws one frame on an idle device and gives its milliseconds.
fn frame(session: &mut Session) -> anyhow::Result<f64> {
    session.finish()?;
    // Results of earlier frames are taken in before, as between two frames of a window.
    session.workbench.tick(Instant::now());
    let began = Instant::now();
    session.workbench.redraw_now(session.size);
    session.finish()?;
    let ms = began.elapsed().as_secs_f64() * 1e3;
    std::thread::sleep(PAUSE / 10);
    Ok(ms)
}
