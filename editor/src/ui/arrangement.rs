//! What is kept over restarts of how the window is arranged: the panels, what is drawn over the
//! pictures, and what the second viewport looks through.

use std::collections::HashSet;

use egui_tiles::{Container, Tile, TileId, Tree};
use serde::{Deserialize, Serialize};

use super::editor::Editor;
use super::layout::{self, Panel};
use super::panels::marks::Marks;
use super::workbench::flat::Side;
use super::workbench::sight::Sight;
use super::workbench::viewports::Viewport;

/// How the window is arranged.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
pub struct Arrangement {
    /// The panels.
    pub panels: Tree<Panel>,
    /// What is drawn over the picture of each viewport.
    #[serde(default)]
    pub marks: [Marks; 2],
    /// What the second viewport looks through, once it was opened.
    #[serde(default)]
    pub second: Option<Look>,
}

/// What a viewport looks through, as it is kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Look {
    /// From above.
    Top,
    /// From the front.
    Front,
    /// From the right.
    Side,
    /// A perspective that a person moves.
    Perspective,
    /// A camera of the scene, by its name.
    Camera(String),
}

impl Look {
    /// Of what a viewport looks through now.
    pub fn of(sight: Sight) -> Self {
        match sight {
            Sight::Perspective => Self::Perspective,
            Sight::Camera(name) => Self::Camera(name),
            Sight::Side(Side::Top) => Self::Top,
            Sight::Side(Side::Front) => Self::Front,
            Sight::Side(Side::Right) => Self::Side,
        }
    }

    /// The same in the words of the workbench.
    pub fn sight(&self) -> Sight {
        match self {
            Self::Top => Sight::Side(Side::Top),
            Self::Front => Sight::Side(Side::Front),
            Self::Side => Sight::Side(Side::Right),
            Self::Perspective => Sight::Perspective,
            Self::Camera(name) => Sight::Camera(name.clone()),
        }
    }
}

impl Default for Arrangement {
    fn default() -> Self {
        Self {
            panels: layout::first(),
            marks: Default::default(),
            second: None,
        }
    }
}

impl Arrangement {
    /// Reads what was kept. What does not fit together gives nothing.
    pub fn read(kept: &serde_json::Value) -> Option<Self> {
        let mut this = Self::deserialize(kept).ok()?;
        if !is_sound(&this.panels) {
            return None;
        }
        // Another version of the program may know fewer panels.
        for panel in Panel::ALL {
            if this.panels.tiles.find_pane(&panel).is_none() {
                layout::add_hidden(&mut this.panels, panel)?;
            }
        }
        Some(this)
    }

    /// As it is kept.
    pub fn to_value(&self) -> Option<serde_json::Value> {
        serde_json::to_value(self).ok()
    }
}

/// Whether all tiles hang together as a tree, each panel is there once, and the picture is.
fn is_sound(tree: &Tree<Panel>) -> bool {
    let Some(root) = tree.root() else {
        return false;
    };
    let (mut open, mut seen) = (vec![root], HashSet::<TileId>::new());
    let mut panels = Vec::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            return false;
        }
        match tree.tiles.get(id) {
            None => return false,
            Some(Tile::Pane(panel)) if panels.contains(panel) => return false,
            Some(Tile::Pane(panel)) => panels.push(*panel),
            Some(Tile::Container(container)) => {
                if !has_sound_shares(container) {
                    return false;
                }
                open.extend(container.children());
            }
        }
    }
    seen.len() == tree.tiles.len() && panels.contains(&Panel::Viewport)
}

fn has_sound_shares(container: &Container) -> bool {
    let is_sound = |share: f32| share.is_finite() && share >= 0.0;
    match container {
        Container::Linear(linear) => linear.shares.iter().all(|(_, share)| is_sound(*share)),
        // Panels can't be laid in a grid here.
        Container::Grid(_) => false,
        Container::Tabs(_) => true,
    }
}

impl Editor {
    /// What is drawn over the picture of a viewport.
    pub(super) fn marks_of(&self, viewport: Viewport) -> Marks {
        self.marks[viewport as usize]
    }

    /// Keeps how the window is arranged, once somebody has changed that.
    pub(super) fn remember_arrangement(&mut self, ctx: &egui::Context) {
        let (is_input, held) =
            ctx.input(|input| (!input.events.is_empty(), input.pointer.any_down()));
        let changes = self.arranged.is_none() || is_input && !held;
        // What a scene is seen through is known with the scene.
        if !changes || self.workbench.scenes.shown().is_none() {
            return;
        }
        let was_opened = !self.workbench.second.is_new();
        let second = was_opened.then(|| Look::of(self.workbench.sight_of(Viewport::Second)));
        let known = self.arranged.as_ref();
        if known.is_some_and(|known| {
            known.panels == self.layout && known.marks == self.marks && known.second == second
        }) {
            return;
        }
        let now = Arrangement {
            panels: self.layout.clone(),
            marks: self.marks,
            second,
        };
        let is_first = self.arranged.replace(now.clone()).is_none();
        if !is_first && let Err(error) = self.kept.arrange(now) {
            self.workbench.log.warn(error);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn first() -> Arrangement {
        Arrangement {
            second: Some(Look::Camera("eye".to_owned())),
            ..Arrangement::default()
        }
    }

    #[test]
    fn what_is_kept_is_read_again() {
        let arrangement = first();
        let text = arrangement.to_value().unwrap().to_string();
        let value = serde_json::from_str(&text).unwrap();
        let again = Arrangement::read(&value).unwrap();
        assert!(again == arrangement);
        for look in [Look::Top, Look::Front, Look::Side, Look::Perspective] {
            assert_eq!(Look::of(look.sight()), look);
        }
    }

    #[test]
    fn panels_that_were_not_known_are_there_hidden() {
        let mut arrangement = first();
        let id = arrangement.panels.tiles.find_pane(&Panel::Plots).unwrap();
        arrangement.panels.remove_recursively(id);
        let value = arrangement.to_value().unwrap();
        let again = Arrangement::read(&value).unwrap();
        assert!(again.panels.tiles.find_pane(&Panel::Plots).is_some());
        assert!(!layout::is_visible(&again.panels, Panel::Plots));
        assert!(layout::is_visible(&again.panels, Panel::Viewport));
    }

    #[test]
    fn what_does_not_fit_together_gives_nothing() {
        let sound = first().to_value().unwrap();
        let text = sound.to_string();
        for (from, to) in [
            // A panel of no version, a panel twice, one that is gone, a tile below itself.
            ("\"log\"", "\"nothing\""),
            ("\"log\"", "\"console\""),
            ("\"viewport\"", "\"log\""),
            ("\"root\":", "\"root\":77,\"was\":"),
            ("\"panels\":", "\"others\":"),
        ] {
            assert!(text.contains(from), "{from}: {text}");
            let broken = text.replacen(from, to, 1);
            let value = serde_json::from_str(&broken).unwrap();
            assert!(Arrangement::read(&value).is_none(), "{broken}");
        }
        assert!(Arrangement::read(&serde_json::json!([])).is_none());
    }
}
