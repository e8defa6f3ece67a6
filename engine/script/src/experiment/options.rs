//! Options: the map at the end of a call, as in `#{ size: [320, 180], frame: 60 }`.

use lightbench_render::problem::suggestion;
use rhai::{Dynamic, Map};

use crate::api::{Arguments, Mistake, as_number};
use crate::names::list;
use crate::settings::Settings;
use crate::spelling::spell;

/// Width and height in pixels, unless told.
const SIZE: [i64; 2] = [640, 360];
/// The largest width and height that are asked of a device, which may refuse less.
const MOST_PIXELS: i64 = 32_768;

/// The options of one call.
pub(super) struct Options<'a, 'b, 'c, 'v, 'd> {
    arguments: &'a Arguments<'b, 'c, 'v, 'd>,
    call: &'static str,
    map: Map,
}

impl<'a, 'b, 'c, 'v, 'd> Options<'a, 'b, 'c, 'v, 'd> {
    /// Reads the argument at `index` of `call`, if there is one.
    pub(super) fn read(
        arguments: &'a Arguments<'b, 'c, 'v, 'd>,
        index: usize,
        call: &'static str,
        known: &[&str],
    ) -> Result<Self, Mistake> {
        let map = if index < arguments.len() {
            let value = arguments.value(index).clone();
            value.try_cast::<Map>().ok_or_else(|| {
                arguments.wrong(index, "a map of options, as in `#{ name: value }`")
            })?
        } else {
            Map::new()
        };
        let unknown = map.keys().find(|name| !known.contains(&name.as_str()));
        if let Some(name) = unknown {
            let names = || known.iter().copied();
            let hint = suggestion(name, names())
                .unwrap_or_else(|| format!("it has {}", list(names(), "and")));
            let message = format!("`{call}` has no option `{name}`");
            return Err(Mistake::new(message).with_hint(hint));
        }
        Ok(Self {
            arguments,
            call,
            map,
        })
    }

    /// Options that are part of an argument.
    pub(super) fn of(
        arguments: &'a Arguments<'b, 'c, 'v, 'd>,
        call: &'static str,
        map: Map,
    ) -> Self {
        Self {
            arguments,
            call,
            map,
        }
    }

    /// A text.
    pub(super) fn text(&self, name: &str) -> Result<Option<String>, Mistake> {
        let Some(value) = self.value(name) else {
            return Ok(None);
        };
        let text = value.clone().into_string();
        text.map(Some)
            .map_err(|_| self.wrong(name, "a text in quotes"))
    }

    /// The value of an option, if it is given.
    pub(super) fn value(&self, name: &str) -> Option<&Dynamic> {
        self.map.get(name).filter(|value| !value.is_unit())
    }

    /// A whole number in a range.
    pub(super) fn whole(&self, name: &str, min: i64, max: i64) -> Result<Option<i64>, Mistake> {
        self.value(name)
            .map(|value| whole(value, min, max).ok_or_else(|| self.wrong_whole(name, min, max)))
            .transpose()
    }

    /// A number in a range.
    pub(super) fn number(&self, name: &str, min: f64, max: f64) -> Result<Option<f64>, Mistake> {
        let Some(value) = self.value(name) else {
            return Ok(None);
        };
        let number = as_number(value).filter(|number| (min..=max).contains(number));
        let wanted = || match max == f64::MAX {
            true => format!("a number of at least {min}"),
            false => format!("a number from {min} to {max}"),
        };
        number.map(Some).ok_or_else(|| self.wrong(name, &wanted()))
    }

    /// Two numbers in an array, each read by `read`.
    pub(super) fn pair<T>(
        &self,
        name: &str,
        wanted: &str,
        read: impl Fn(&Dynamic) -> Option<T>,
    ) -> Result<Option<[T; 2]>, Mistake> {
        let Some(value) = self.value(name) else {
            return Ok(None);
        };
        let pair = value.read_lock::<rhai::Array>().and_then(|items| {
            let [a, b] = items.as_slice() else {
                return None;
            };
            Some([read(a)?, read(b)?])
        });
        pair.map(Some).ok_or_else(|| self.wrong(name, wanted))
    }

    /// The option `size`: width and height in pixels.
    pub(super) fn size(&self) -> Result<(u32, u32), Mistake> {
        let wanted = "width and height in pixels, as in `[320, 180]`";
        let size = self.pair("size", wanted, |value| whole(value, 1, MOST_PIXELS))?;
        let [width, height] = size.unwrap_or(SIZE).map(|side| side as u32);
        Ok((width, height))
    }

    /// `true` or `false`.
    pub(super) fn switch(&self, name: &str) -> Result<bool, Mistake> {
        let Some(value) = self.value(name) else {
            return Ok(false);
        };
        value
            .as_bool()
            .map_err(|_| self.wrong(name, "`true` or `false`"))
    }

    /// A text, or a whole number as one.
    pub(super) fn text_or_number(&self, name: &str) -> Result<Option<String>, Mistake> {
        let Some(value) = self.value(name) else {
            return Ok(None);
        };
        let text = value.clone().into_string().ok();
        let number = || whole(value, 0, i64::MAX).map(|number| number.to_string());
        let read = text.or_else(number);
        read.map(Some)
            .ok_or_else(|| self.wrong(name, "a name in quotes or a number"))
    }

    /// Values for parameters: a map of numbers, texts and switches.
    pub(super) fn settings(&self, name: &str) -> Result<Settings, Mistake> {
        let Some(value) = self.value(name) else {
            return Ok(Settings::new());
        };
        let Some(map) = value.read_lock::<Map>() else {
            return Err(self.wrong(
                name,
                "a map of values for parameters, as in `#{ lights: 64 }`",
            ));
        };
        let whose = format!("`{name}` of `{}`", self.call);
        self.arguments.settings(&map, &whose)
    }

    /// The mistake of an option of the wrong kind.
    pub(super) fn wrong(&self, name: &str, wanted: &str) -> Mistake {
        // An array is of the right kind: what is in it tells what is wrong.
        let given = self.value(name).map(|value| match spell(value) {
            Some(spelled) if value.is_array() => format!("`{spelled}`"),
            _ => self.arguments.describe(value),
        });
        Mistake::new(format!(
            "`{name}` of `{}` must be {wanted}, not {}",
            self.call,
            given.unwrap_or_else(|| "nothing".to_owned())
        ))
    }

    fn wrong_whole(&self, name: &str, min: i64, max: i64) -> Mistake {
        self.wrong(name, &format!("a whole number from {min} to {max}"))
    }
}

/// A whole number in a range, whether written `3` or `3.0`.
pub(super) fn whole(value: &Dynamic, min: i64, max: i64) -> Option<i64> {
    let number = as_number(value).filter(|number| number.fract() == 0.0)?;
    let fits = (min as f64..=max as f64).contains(&number);
    fits.then_some(number as i64)
}
