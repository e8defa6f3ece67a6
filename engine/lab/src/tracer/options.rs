//! What to trace, and how.

/// What light the picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// What the pipelines draw: the light of all lamps on what is seen, without shadows; ambient light
    /// as an even share of the base colour. One line of sight through the middle of each pixel, and no
    /// chance.
    Direct,
    /// The same with the shadows of points and of directions, sharp and exact.
    Shadowed,
    /// Light along all paths.
    #[default]
    Full,
}

/// What lights surfaces, in [`Mode::Full`]. The viewer sees the sky and what shines in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sources {
    /// Point, spot and directional lights.
    pub lights: bool,
    /// Ambient lights, as a sky of that radiance all around.
    pub sky: bool,
    /// Surfaces that emit.
    pub surfaces: bool,
}

impl Sources {
    /// All of them.
    pub const ALL: Self = Self {
        lights: true,
        sky: true,
        surfaces: true,
    };
    /// None of them.
    pub const NONE: Self = Self {
        lights: false,
        sky: false,
        surfaces: false,
    };
}

/// How paths find the sky and surfaces that shine. All three have the same mean; they differ in noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// They aim, and also meet them by chance; both are weighed by the power heuristic.
    #[default]
    Both,
    /// They aim alone.
    Aim,
    /// They meet them by chance alone.
    Scatter,
}

/// How a scene is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Which light is shown.
    pub mode: Mode,
    /// Paths a pixel in [`Mode::Full`], at least 1. The other modes take one line of sight.
    pub samples: u32,
    /// Reflections that a path has at most; none: as many as chance lets it have.
    pub depth: Option<u32>,
    /// Another number, another noise.
    pub seed: u64,
    /// What lights surfaces.
    pub sources: Sources,
    /// How it is found.
    pub strategy: Strategy,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: (640, 360),
            mode: Mode::default(),
            samples: 64,
            depth: None,
            seed: 0,
            sources: Sources::ALL,
            strategy: Strategy::default(),
        }
    }
}

impl Options {
    /// Samples that a pixel gets.
    pub fn passes(&self) -> u32 {
        match self.mode {
            Mode::Direct | Mode::Shadowed => 1,
            Mode::Full => self.samples.max(1),
        }
    }
}
