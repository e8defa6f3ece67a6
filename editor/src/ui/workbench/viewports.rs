//! The two viewports, and which of them has the focus.
//!
//! The first one is always there; what looks into frames (comparison, walk through the passes, probed
//! pixels, targets) looks into its picture. The second is another look at the same world: see
//! [`super::second`].

use lightbench::render::series::FIRST_SERIES;

use super::Workbench;
use super::camera::CameraRig;
use super::canvas::Canvas;
use crate::ui::messages::say;

/// One of the two viewports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Viewport {
    /// The one that is always there.
    #[default]
    First,
    /// The one that can be opened beside it.
    Second,
}

impl Viewport {
    /// Both.
    pub const ALL: [Self; 2] = [Self::First, Self::Second];

    /// The words for people.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::First => say!("viewports.first"),
            Self::Second => say!("viewports.second"),
        }
    }

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
        }
    }

    /// Its pictures follow each other: see [`lightbench::render::series`].
    pub(super) fn series(self) -> usize {
        match self {
            Self::First => FIRST_SERIES,
            Self::Second => FIRST_SERIES + 1,
        }
    }
}

impl Workbench {
    /// Which viewport keys and menus mean.
    pub fn focus(&self) -> Viewport {
        self.focus
    }

    /// Gives a viewport the focus, if it is there.
    pub fn set_focus(&mut self, viewport: Viewport) {
        if viewport == Viewport::First || self.second.is_open() {
            self.focus = viewport;
        }
    }

    /// How many pictures a viewport has drawn; the second one since it was opened.
    pub fn frames_of(&self, viewport: Viewport) -> u64 {
        self.canvas_of(viewport).frames
    }

    /// How many times as wide as high a viewport is; 1 until it was seen.
    pub(super) fn aspect_of(&self, viewport: Viewport) -> f32 {
        let size = self.canvas_of(viewport).size;
        size.map_or(1.0, |(width, height)| width as f32 / height as f32)
    }

    /// Where a viewport is seen from.
    pub fn camera_of(&self, viewport: Viewport) -> &CameraRig {
        match viewport {
            Viewport::First => &self.camera,
            Viewport::Second => &self.second.camera,
        }
    }

    /// The same, to be moved.
    pub fn camera_of_mut(&mut self, viewport: Viewport) -> &mut CameraRig {
        match viewport {
            Viewport::First => &mut self.camera,
            Viewport::Second => &mut self.second.camera,
        }
    }

    /// The camera of the scene through which a person wants to look in a viewport, by its name.
    pub(super) fn watched_camera_of(&self, viewport: Viewport) -> &Option<String> {
        match viewport {
            Viewport::First => &self.watched_camera,
            Viewport::Second => &self.second.watched_camera,
        }
    }

    pub(super) fn watch_camera(&mut self, viewport: Viewport, name: Option<String>) {
        match viewport {
            Viewport::First => self.watched_camera = name,
            Viewport::Second => self.second.watched_camera = name,
        }
    }

    pub(super) fn canvas_of(&self, viewport: Viewport) -> &Canvas {
        match viewport {
            Viewport::First => &self.canvas,
            Viewport::Second => &self.second.canvas,
        }
    }

    pub(super) fn canvas_of_mut(&mut self, viewport: Viewport) -> &mut Canvas {
        match viewport {
            Viewport::First => &mut self.canvas,
            Viewport::Second => &mut self.second.canvas,
        }
    }
}
