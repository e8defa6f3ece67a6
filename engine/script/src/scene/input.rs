//! What happens outside of a scene: keys, the pointer, clicks.

use std::collections::BTreeSet;

use rhai::{Array, Dynamic};

use super::data::{Data, Stage};
use super::handlers::Event;
use super::picking::{Ray, pick};
use lightbench_render::problem::suggestion;

use crate::api::{Api, Arguments, Mistake};
use crate::names::list;

/// Something that happens outside of a scene, for [`Scene::happen`](super::Scene::happen).
#[derive(Clone, Debug, PartialEq)]
pub enum SceneEvent {
    /// A key went down; its name in lower case, as in `a`, `7`, `space`, `left`, `enter`.
    KeyDown(String),
    /// A key went up.
    KeyUp(String),
    /// Where the pointer is: shares of the picture's width and height, from the upper left. `None`
    /// where it has left the picture.
    Pointer(Option<[f32; 2]>),
    /// A click into the picture, as the line of sight that it is on.
    Click(Ray),
    /// The scene is looked at no more: all keys are up.
    Leave,
}

/// What scripts are told of.
#[derive(Clone, Debug)]
pub(super) enum Happened {
    Key(String),
    Click(Ray),
}

impl Happened {
    /// As scripts are told of it; nothing where a click hit nothing.
    pub(super) fn in_scene(self, data: &Data) -> Option<Event> {
        match self {
            Self::Key(key) => Some(Event::Key(key)),
            Self::Click(ray) => pick(&data.world, &data.assets, ray, |_| true)
                .map(|hit| Event::Click(hit.entity, hit.point)),
        }
    }
}

/// The keys that are down, the pointer, and what nobody was told yet.
#[derive(Debug, Default)]
pub(super) struct Input {
    down: BTreeSet<String>,
    pointer: Option<[f32; 2]>,
    happened: Vec<Happened>,
    /// Whether a script has asked which keys are down.
    pub(super) was_asked: bool,
}

/// The names of keys, beside letters, digits and `f1` to `f35`.
const NAMED: [&str; 50] = [
    "space",
    "enter",
    "tab",
    "escape",
    "left",
    "right",
    "up",
    "down",
    "backspace",
    "delete",
    "insert",
    "home",
    "end",
    "pageup",
    "pagedown",
    "comma",
    "period",
    "colon",
    "semicolon",
    "minus",
    "plus",
    "equals",
    "slash",
    "backslash",
    "pipe",
    "quote",
    "backtick",
    "questionmark",
    "exclamationmark",
    "openbracket",
    "closebracket",
    "opencurlybracket",
    "closecurlybracket",
    "shiftleft",
    "shiftright",
    "controlleft",
    "controlright",
    "altleft",
    "altright",
    "superleft",
    "superright",
    "intlbackslash",
    "capslock",
    "numlock",
    "scrolllock",
    "printscreen",
    "pause",
    "menu",
    "help",
    "clear",
];

/// The name of a key in lower case.
fn key_name(a: &Arguments) -> Result<String, Mistake> {
    let key = a.text(0)?.to_lowercase();
    let mut letters = key.chars();
    let single = letters.next().is_some_and(char::is_alphanumeric) && letters.next().is_none();
    let function = key.strip_prefix('f').and_then(|number| number.parse().ok());
    if single
        || NAMED.contains(&key.as_str())
        || function.is_some_and(|n: u8| (1..=35).contains(&n))
    {
        return Ok(key);
    }
    let mistake = Mistake::new(format!("there is no key `{key}`"));
    // As browsers name the arrows.
    let known = NAMED
        .into_iter()
        .chain(["arrowleft", "arrowright", "arrowup", "arrowdown"]);
    let near = suggestion(&key, known).map(|hint| hint.replace("`arrow", "`"));
    Err(mistake.with_hint(near.unwrap_or_else(|| {
        format!(
            "keys are letters and digits, and {}",
            list(NAMED.into_iter(), "and")
        )
    })))
}

/// More are dropped: nobody types so fast, and a scene that stands still would collect them.
const MOST: usize = 256;

impl Input {
    pub(super) fn happen(&mut self, event: SceneEvent) {
        match event {
            SceneEvent::KeyDown(key) => {
                if self.down.insert(key.clone()) && self.happened.len() < MOST {
                    self.happened.push(Happened::Key(key));
                }
            }
            SceneEvent::KeyUp(key) => {
                self.down.remove(&key);
            }
            SceneEvent::Pointer(at) => self.pointer = at,
            SceneEvent::Click(ray) => {
                if self.happened.len() < MOST {
                    self.happened.push(Happened::Click(ray));
                }
            }
            SceneEvent::Leave => {
                self.down.clear();
                self.pointer = None;
            }
        }
    }

    pub(super) fn take(&mut self) -> Vec<Happened> {
        std::mem::take(&mut self.happened)
    }
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.section("Keyboard and mouse");
    let asked = stage.clone();
    api.function(
        "key_down(key)",
        "Whether a key is down: a letter or digit as in `\"a\"`, or `space`, `enter`, `tab`, `escape`, \
         `backspace`, `home`, `end`, `left`, `right`, `up` or `down`. No key is where no window is. In the \
         editor, keys are the scene's while the pointer is over the picture, time runs and a script hears \
         them; elsewhere they are the editor's.",
        move |a| {
            let key = key_name(a)?;
            let input = &mut asked.lock().input;
            input.was_asked = true;
            Ok(input.down.contains(&key))
        },
    );
    let asked = stage.clone();
    api.function(
        "keys_down()",
        "The names of all keys that are down, in the order of the alphabet.",
        move |_| {
            let mut data = asked.lock();
            data.input.was_asked = true;
            let keys = data.input.down.iter().cloned().map(Dynamic::from);
            Ok(keys.collect::<Array>())
        },
    );
    let asked = stage.clone();
    api.function(
        "pointer()",
        "Where the mouse is in the picture: an array of two numbers from 0 to 1, from the left and \
         from the top; `()` where it is elsewhere.",
        move |_| {
            let pointer = asked.lock().input.pointer;
            Ok(pointer.map_or(Dynamic::UNIT, |at| {
                Dynamic::from_array(at.map(|v| Dynamic::from(f64::from(v))).to_vec())
            }))
        },
    );
}
