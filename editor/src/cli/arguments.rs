//! Arguments that several commands share.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use lightbench::render::GpuOptions;

/// The size of a picture, written as `640x360`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let read = |side: &str| side.trim().parse().ok().filter(|&side: &u32| side > 0);
        text.split_once(['x', 'X', '×'])
            .and_then(|(width, height)| {
                Some(Self {
                    width: read(width)?,
                    height: read(height)?,
                })
            })
            .ok_or_else(|| {
                "a size is written as width x height in pixels, both at least 1, as in 640x360"
                    .to_owned()
            })
    }
}

impl From<Size> for (u32, u32) {
    fn from(size: Size) -> Self {
        (size.width, size.height)
    }
}

/// Which adapter draws.
#[derive(Args, Clone, Debug, Default)]
pub struct GpuArguments {
    /// The graphics adapter: a part of its name, or its number in `lightbench list adapters`
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Use only what every adapter offers, to see whether a pipeline runs everywhere
    #[arg(long)]
    portable: bool,
}

impl GpuArguments {
    /// As the renderer takes them.
    pub fn options(&self) -> GpuOptions {
        GpuOptions {
            adapter: self.adapter.clone(),
            portable: self.portable,
        }
    }

    /// The same arguments for another process.
    pub fn again(&self) -> Vec<std::ffi::OsString> {
        let mut again = Vec::new();
        if let Some(adapter) = &self.adapter {
            again.extend(["--adapter".into(), adapter.into()]);
        }
        if self.portable {
            again.push("--portable".into());
        }
        again
    }
}

/// What a scene is filled with.
#[derive(Args, Clone, Debug)]
pub struct SceneArguments {
    /// The OBJ or glTF file that the scene `showroom` shows; it may lie anywhere
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// A value for a parameter, as in `--set lights=256`; may be given again. Write `scene.NAME`,
    /// `pipeline.NAME` or a pipeline's name before the dot to say whose parameter is meant
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_positive_numbers() {
        for (text, width, height) in [
            ("640x360", 640, 360),
            (" 1 X 1 ", 1, 1),
            ("637×359", 637, 359),
        ] {
            assert_eq!(text.parse(), Ok(Size { width, height }), "{text}");
        }
        for text in [
            "",
            "640",
            "0x0",
            "640x0",
            "-1x5",
            "640x360x2",
            "axb",
            "5000000000x1",
        ] {
            assert!(text.parse::<Size>().is_err(), "{text}");
        }
    }
}
