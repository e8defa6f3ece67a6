//! Curves: what a frame costs as a parameter of the scene grows, for each pipeline.
//!
//! [`sweep`] measures; [`table`] and [`plot`] write what it found as CSV and SVG. A curve ends where
//! its pipeline reports that it lost something, and the limit is sought between the last value at
//! which it lost nothing and the first at which it did: see [`losses`].

mod chart;
mod drawing;
mod linear_scale;
pub mod losses;
mod plot;
mod scale;
mod style;
mod sweep;
mod table;

pub use chart::chart;
pub use plot::plot;
pub use sweep::{Sweep, SweepError, Swept, sweep};
pub use table::table;

use crate::report::{Adapter, Machine};
use crate::statistics::Summary;

/// Curves of several pipelines over one parameter of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// On what and how they were measured.
    pub head: Head,
    /// One a pipeline, in the order given.
    pub curves: Vec<Curve>,
}

/// What has to be known to read or repeat a measurement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Head {
    /// The scene's name.
    pub scene: String,
    /// Values of the scene's other parameters that were set, as `name=value`.
    pub settings: Vec<String>,
    /// The parameter along the horizontal axis.
    pub parameter: String,
    /// What the parameter means.
    pub about: String,
    /// The computer.
    pub machine: Machine,
    /// The graphics adapter.
    pub adapter: Adapter,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Frames measured at each point.
    pub frames: u32,
    /// Version of Lightbench.
    pub version: String,
    /// The command that measures again.
    pub command: String,
    /// When it was measured, RFC 3339.
    pub created: String,
}

impl Head {
    /// Which times the curves show.
    pub fn clock(&self) -> &'static str {
        match self.adapter.software {
            true => "GPU time of a frame on a software driver: processor time",
            false => "GPU time of a frame",
        }
    }
}

/// The curve of one pipeline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// The pipeline's name.
    pub pipeline: String,
    /// Its name for people.
    pub title: String,
    /// In ascending order of the parameter.
    pub points: Vec<Point>,
    /// Why it ends before the last value; `None` where it does not.
    pub end: Option<End>,
}

/// What was measured at one value of the parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// The value.
    pub at: u32,
    /// GPU time of a frame, milliseconds; absent where the adapter has no timestamps.
    pub gpu: Option<Summary>,
    /// CPU time for extraction and recording, milliseconds.
    pub cpu: Option<Summary>,
    /// Lights evaluated for a pixel, in the mean over the picture.
    pub lights_evaluated: Option<f64>,
    /// Those of them that reach what the pixel shows.
    pub lights_reaching: Option<f64>,
    /// Fragments that geometry passes shade and keep, for a pixel.
    pub overdraw: Option<f64>,
    /// Invocations of all fragment shaders, for a pixel, where the adapter counts them.
    pub fragments: Option<f64>,
    /// Draw calls.
    pub draws: u64,
}

/// Why a curve ends.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// The pipeline lost something.
    Limit {
        /// The largest value at which it lost nothing; 0 where it did at the first.
        last: u32,
        /// The smallest value tried at which it did.
        beyond: u32,
        /// The counter that said so.
        counter: String,
        /// What the counter counts.
        about: String,
        /// What it said there.
        count: f64,
    },
    /// A frame took longer than whoever measured wanted to wait.
    Slow {
        /// The value at which it did; the point is part of the curve.
        last: u32,
        /// Seconds.
        seconds: f64,
    },
}

impl End {
    /// In words.
    pub fn in_words(&self) -> String {
        match self {
            Self::Limit {
                last,
                beyond,
                about,
                count,
                ..
            } => format!("limit {last}; at {beyond}: {count} × {about}"),
            Self::Slow { last, seconds } => {
                format!("not measured beyond {last}: a frame takes {seconds:.0} s")
            }
        }
    }
}

#[cfg(test)]
pub(crate) mod sample {
    use super::*;

    /// A curve whose times follow a function.
    pub fn curve(
        pipeline: &str,
        values: &[u32],
        time: impl Fn(f64) -> f64,
        end: Option<End>,
    ) -> Curve {
        let point = |at: &u32| {
            let ms = time(f64::from(*at));
            Point {
                at: *at,
                gpu: Summary::of(&[0.9, 1.0, 1.0, 1.0, 1.0, 1.0, 1.1].map(|share| share * ms)),
                cpu: Summary::of(&[1.0; 6]),
                lights_evaluated: Some(f64::from(*at) / 2.0),
                ..Point::default()
            }
        };
        Curve {
            pipeline: pipeline.to_owned(),
            title: pipeline.to_owned(),
            points: values.iter().map(point).collect(),
            end,
        }
    }

    /// Two curves with made-up numbers, the second of which ends at a limit.
    pub fn curves() -> Curves {
        let limit = End::Limit {
            last: 37,
            beyond: 38,
            counter: "pixels_over_capacity".into(),
            about: "Pixels that lost lights".into(),
            count: 12.0,
        };
        Curves {
            head: Head {
                scene: "many_lights".into(),
                parameter: "lights".into(),
                about: "How many lights".into(),
                adapter: Adapter {
                    name: "llvmpipe, \"soft\"".into(),
                    software: true,
                    ..Adapter::default()
                },
                size: (640, 360),
                frames: 7,
                version: "0.1.0".into(),
                ..Head::default()
            },
            curves: vec![
                curve("linear", &[4, 16, 64, 256], |x| 2.0 + 0.5 * x, None),
                curve("short", &[4, 16, 37], |_| 9.0, Some(limit)),
            ],
        }
    }
}
