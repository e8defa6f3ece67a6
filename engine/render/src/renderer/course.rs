//! What a renderer remembers of the frames before.

use glam::Mat4;

/// What goes from one frame of a series to the next.
#[derive(Default)]
pub(super) struct Course {
    /// What shaders see as `frame_index`.
    pub index: u32,
    pub views: Views,
}

/// World to clip of the last two frames.
#[derive(Default)]
pub(super) struct Views {
    last: Option<(u32, Mat4)>,
    before: Option<Mat4>,
}

impl Views {
    /// That of the frame before the one of this index, which may be drawn again.
    pub fn before(&self, index: u32) -> Option<Mat4> {
        match self.last {
            Some((last, _)) if last == index => self.before,
            last => last.map(|(_, matrix)| matrix),
        }
    }

    /// Takes note of a frame that is drawn.
    pub fn draw(&mut self, index: u32, view_projection: Mat4) {
        self.before = self.before(index);
        self.last = Some((index, view_projection));
    }
}
