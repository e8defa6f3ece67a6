//! The format of a view as a line of text.
//!
//! Words between spaces. The first is `lightbench-view-1`, where 1 is the version of the format. Each other
//! one is `name=value`:
//!
//! | word | means |
//! | --- | --- |
//! | `scene=NAME` | the scene: a name, or a path in the project |
//! | `scene.NAME=VALUE` | a value of one of its parameters |
//! | `pipeline=NAME` | the pipeline |
//! | `pipeline.NAME=VALUE` | a value of one of its parameters |
//! | `camera=scene` | the scene's first active camera |
//! | `camera=named camera.name=NAME` | another camera of the scene |
//! | `camera=free camera.eye=X,Y,Z camera.turn=YAW,PITCH camera.orbit=D camera.lens=FOV,NEAR,FAR` | a camera that was moved; metres and radians |
//! | `camera=top`, `camera=front`, `camera=side`, each with `camera.center=X,Y,Z camera.height=H camera.reach=R` | without perspective; metres |
//! | `time=SECONDS` | since the scene began |
//! | `size=WxH` | pixels |
//!
//! `scene` and `pipeline` must be there. Without the others the view is through the scene's camera, at its
//! beginning, at 640x360. In names and values `%20` stands for a space, as in addresses: `%` and two digits
//! of a hexadecimal number stand for a byte of UTF-8. What is written so: `%`, spaces and control
//! characters, and `=` in names. Numbers are decimal and have as many digits as it takes to read the same
//! number again.

use std::fmt;
use std::str::FromStr;

use lightbench::script::Settings;
use lightbench::world::glam::Vec3;

use super::{Eye, Free, Viewpoint};
use crate::ui::workbench::flat::{Flat, Side};

/// What a view begins with, before the number of its format.
pub const MARK: &str = "lightbench-view-";

/// The version of the format.
pub const VERSION: u32 = 1;

/// Characters that a view has at most.
const LONGEST: usize = 64 * 1024;

/// The longest side of a picture.
const MOST_PIXELS: u32 = 16_384;

/// The latest moment, seconds: a day.
const LATEST: f64 = 86_400.0;

/// Why a text is no view, in a sentence that says what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ViewpointError(String);

fn wrong<T>(text: impl Into<String>) -> Result<T, ViewpointError> {
    Err(ViewpointError(text.into()))
}

impl fmt::Display for Viewpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{MARK}{VERSION} scene={}", coded(&self.scene, false))?;
        let settings = |f: &mut fmt::Formatter<'_>, owner: &str, settings: &Settings| {
            settings.iter().try_for_each(|(name, value)| {
                let value = value.to_string();
                write!(f, " {owner}.{}={}", coded(name, true), coded(&value, false))
            })
        };
        settings(f, "scene", &self.scene_settings)?;
        write!(f, " pipeline={}", coded(&self.pipeline, false))?;
        settings(f, "pipeline", &self.pipeline_settings)?;
        match &self.camera {
            Eye::Scene => write!(f, " camera=scene")?,
            Eye::Named(name) => write!(f, " camera=named camera.name={}", coded(name, false))?,
            Eye::Free(free) => {
                let Free {
                    eye,
                    yaw,
                    pitch,
                    orbit,
                    fov_y,
                    near,
                    far,
                } = free;
                write!(
                    f,
                    " camera=free camera.eye={},{},{} camera.turn={yaw},{pitch} camera.orbit={orbit} \
                     camera.lens={fov_y},{near},{far}",
                    eye.x, eye.y, eye.z
                )?;
            }
            Eye::Side(flat) => {
                let Vec3 { x, y, z } = flat.center;
                write!(
                    f,
                    " camera={} camera.center={x},{y},{z} camera.height={} camera.reach={}",
                    side_name(flat.side),
                    flat.height,
                    flat.reach
                )?;
            }
        }
        let (width, height) = self.size;
        write!(f, " time={} size={width}x{height}", self.time)
    }
}

fn side_name(side: Side) -> &'static str {
    match side {
        Side::Top => "top",
        Side::Front => "front",
        Side::Right => "side",
    }
}

impl FromStr for Viewpoint {
    type Err = ViewpointError;

    fn from_str(text: &str) -> Result<Self, ViewpointError> {
        if text.len() > LONGEST {
            return wrong(format!(
                "this is too long for a view: {} characters, and {LONGEST} are the most",
                text.len()
            ));
        }
        let mut words = text.split_whitespace();
        check_version(words.next().unwrap_or_default())?;
        let mut read = Words::default();
        for word in words {
            read.take(word)?;
        }
        read.finish()
    }
}

fn check_version(first: &str) -> Result<(), ViewpointError> {
    let Some(version) = first.strip_prefix(MARK) else {
        return wrong(format!(
            "this is no view: a view begins with `{MARK}{VERSION}`. Copy one in the editor with Compare, \
             Copy view"
        ));
    };
    match version.parse::<u32>() {
        Ok(VERSION) => Ok(()),
        Ok(newer) if newer > VERSION => wrong(format!(
            "this view has version {newer} of its format, and this program knows {VERSION}: use a newer \
             Lightbench, or copy the view again with this one"
        )),
        _ => wrong(format!(
            "`{first}` is no version of a view that there ever was: a view begins with `{MARK}{VERSION}`"
        )),
    }
}

/// The words of a view as far as they were read.
#[derive(Default)]
struct Words {
    all: Vec<(String, String)>,
    scene_settings: Settings,
    pipeline_settings: Settings,
}

/// Names that stand alone.
const NAMES: [&str; 13] = [
    "scene",
    "pipeline",
    "camera",
    "camera.name",
    "camera.eye",
    "camera.turn",
    "camera.orbit",
    "camera.lens",
    "camera.center",
    "camera.height",
    "camera.reach",
    "time",
    "size",
];

impl Words {
    fn take(&mut self, word: &str) -> Result<(), ViewpointError> {
        let Some((name, value)) = word.split_once('=') else {
            return wrong(format!(
                "`{word}` is no part of a view: each part is name=value, as in scene=atrium"
            ));
        };
        let (name, value) = (decoded(name)?, decoded(value)?);
        let settings = match name.split_once('.') {
            Some(("scene", parameter)) => Some((&mut self.scene_settings, parameter)),
            Some(("pipeline", parameter)) => Some((&mut self.pipeline_settings, parameter)),
            _ => None,
        };
        if let Some((settings, parameter)) = settings {
            if parameter.is_empty() {
                return wrong(format!("`{word}`: no parameter is named before the `=`"));
            }
            if settings.get(parameter).is_some() {
                return wrong(format!("`{name}` is there twice; leave one out"));
            }
            settings.set(parameter, value);
            return Ok(());
        }
        if !NAMES.contains(&name.as_str()) {
            return wrong(format!(
                "`{word}`: a view has no `{name}`; parameters are written scene.NAME=VALUE and \
                 pipeline.NAME=VALUE"
            ));
        }
        if self.get(&name).is_some() {
            return wrong(format!("`{name}` is there twice; leave one out"));
        }
        self.all.push((name, value));
        Ok(())
    }

    fn get(&self, name: &str) -> Option<&str> {
        let found = self.all.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }

    fn needed(&self, name: &str) -> Result<&str, ViewpointError> {
        match self.get(name).filter(|value| !value.is_empty()) {
            Some(value) => Ok(value),
            None => wrong(format!(
                "the view does not say its `{name}`: write {name}=…"
            )),
        }
    }

    fn numbers<const N: usize>(&self, name: &str) -> Result<[f32; N], ViewpointError> {
        let text = self.needed(name)?;
        let bad = || {
            ViewpointError(format!(
                "`{name}={text}`: {N} number{} should stand there, with commas between",
                if N == 1 { "" } else { "s" }
            ))
        };
        let mut numbers = [0.0_f32; N];
        let mut parts = text.split(',');
        for number in &mut numbers {
            let part = parts.next().ok_or_else(bad)?;
            *number = part.parse().map_err(|_| bad())?;
            if number.is_nan() {
                return Err(bad());
            }
        }
        match parts.next() {
            None => Ok(numbers),
            Some(_) => Err(bad()),
        }
    }

    /// As [`Words::numbers`], none of them infinite.
    fn finite<const N: usize>(&self, name: &str) -> Result<[f32; N], ViewpointError> {
        let numbers = self.numbers(name)?;
        if numbers.iter().all(|number| number.is_finite()) {
            return Ok(numbers);
        }
        wrong(format!("`{name}={}` is not finite", self.needed(name)?))
    }

    fn camera(&self) -> Result<Eye, ViewpointError> {
        let kind = self.get("camera").unwrap_or("scene");
        let sides = [Side::Top, Side::Front, Side::Right];
        let side = sides.into_iter().find(|side| side_name(*side) == kind);
        let parts: &[&str] = match kind {
            "scene" => &[],
            "named" => &["camera.name"],
            "free" => &["camera.eye", "camera.turn", "camera.orbit", "camera.lens"],
            _ if side.is_some() => &["camera.center", "camera.height", "camera.reach"],
            _ => {
                return wrong(format!(
                    "`camera={kind}`: it is one of scene, named, free, top, front and side"
                ));
            }
        };
        let given = self.all.iter().map(|(name, _)| name.as_str());
        let mut given = given.filter(|name| name.starts_with("camera."));
        if let Some(other) = given.find(|name| !parts.contains(name)) {
            return wrong(format!(
                "`{other}` means nothing with camera={kind}; leave it out"
            ));
        }
        if let Some(side) = side {
            let [height] = self.finite("camera.height")?;
            let [reach] = self.finite("camera.reach")?;
            if height <= 0.0 || reach <= 0.0 {
                return wrong("`camera.height` and `camera.reach` must be above 0");
            }
            return Ok(Eye::Side(Flat {
                side,
                center: Vec3::from(self.finite::<3>("camera.center")?),
                height,
                reach,
            }));
        }
        match kind {
            "named" => Ok(Eye::Named(self.needed("camera.name")?.to_owned())),
            "free" => self.free().map(Eye::Free),
            _ => Ok(Eye::Scene),
        }
    }

    fn free(&self) -> Result<Free, ViewpointError> {
        let [yaw, pitch] = self.finite("camera.turn")?;
        let [orbit] = self.finite("camera.orbit")?;
        let [fov_y, near, far] = self.numbers("camera.lens")?;
        if !(fov_y > 0.0 && fov_y < std::f32::consts::PI) {
            return wrong(format!(
                "`camera.lens`: the angle {fov_y} is not between 0 and 3.14 radians"
            ));
        }
        if !(near > 0.0 && near.is_finite() && far > near) {
            return wrong(format!(
                "`camera.lens`: the planes {near} and {far} must be above 0, the nearer one first"
            ));
        }
        if pitch.abs() >= std::f32::consts::FRAC_PI_2 || orbit <= 0.0 {
            return wrong(
                "`camera.turn` looks straight up or down, or beyond, or `camera.orbit` is not above 0",
            );
        }
        Ok(Free {
            eye: Vec3::from(self.finite::<3>("camera.eye")?),
            yaw,
            pitch,
            orbit,
            fov_y,
            near,
            far,
        })
    }

    fn time(&self) -> Result<f64, ViewpointError> {
        let Some(text) = self.get("time") else {
            return Ok(0.0);
        };
        match text.parse() {
            Ok(time) if (0.0..=LATEST).contains(&time) => Ok(time),
            _ => wrong(format!(
                "`time={text}`: it is a number of seconds from 0 to {LATEST}, a day"
            )),
        }
    }

    fn size(&self) -> Result<(u32, u32), ViewpointError> {
        let text = self.get("size").unwrap_or("640x360");
        let side = |side: &str| {
            let side = side.parse().ok();
            side.filter(|side: &u32| (1..=MOST_PIXELS).contains(side))
        };
        let sides = text.split_once('x');
        let read = sides.and_then(|(width, height)| Some((side(width)?, side(height)?)));
        match read {
            Some(size) => Ok(size),
            None => wrong(format!(
                "`size={text}`: it is written as 640x360, and no side is longer than {MOST_PIXELS}"
            )),
        }
    }

    fn finish(self) -> Result<Viewpoint, ViewpointError> {
        Ok(Viewpoint {
            scene: self.needed("scene")?.to_owned(),
            pipeline: self.needed("pipeline")?.to_owned(),
            camera: self.camera()?,
            time: self.time()?,
            size: self.size()?,
            scene_settings: self.scene_settings,
            pipeline_settings: self.pipeline_settings,
        })
    }
}

/// A name or a value as it stands in a word.
fn coded(text: &str, is_name: bool) -> String {
    let mut coded = String::with_capacity(text.len());
    for c in text.chars() {
        if c == '%' || c.is_whitespace() || c.is_control() || (is_name && c == '=') {
            let mut bytes = [0; 4];
            for byte in c.encode_utf8(&mut bytes).bytes() {
                coded.push_str(&format!("%{byte:02X}"));
            }
        } else {
            coded.push(c);
        }
    }
    coded
}

fn decoded(text: &str) -> Result<String, ViewpointError> {
    let bad = || {
        ViewpointError(format!(
            "`{text}`: after `%` stand two digits of a hexadecimal number, and `%` itself is written %25"
        ))
    };
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let mut digit = || {
            let digit = char::from(rest.next()?).to_digit(16)?;
            u8::try_from(digit).ok()
        };
        let (Some(high), Some(low)) = (digit(), digit()) else {
            return Err(bad());
        };
        bytes.push(high * 16 + low);
    }
    String::from_utf8(bytes).map_err(|_| bad())
}

#[cfg(test)]
mod tests;
