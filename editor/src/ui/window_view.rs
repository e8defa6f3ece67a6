//! How the window is arranged, as a part of what is looked at: which panels are shown and where, and what is
//! drawn over the pictures.
//!
//! Which of the panels that share a place is before the others is none of it: who goes back to an earlier
//! arrangement from a panel wants to keep that in sight.

use std::collections::HashMap;
use std::sync::Arc;

use egui_tiles::{Container, Tile, TileId, Tree};

use super::actions::{Action, entries};
use super::editor::Editor;
use super::layout::{self, Panel};
use super::messages::say;
use super::panels::marks::{Mark, Marks};
use super::workbench::viewports::Viewport;

/// How the window is arranged.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowView {
    panels: Tree<Panel>,
    marks: [Marks; 2],
}

impl Default for WindowView {
    fn default() -> Self {
        Self::new(layout::first(), [Marks::default(); 2])
    }
}

impl WindowView {
    /// Panels, and what is drawn over the picture of each viewport.
    pub fn new(panels: Tree<Panel>, marks: [Marks; 2]) -> Self {
        Self { panels, marks }
    }

    fn is(&self, panels: &Tree<Panel>, marks: &[Marks; 2]) -> bool {
        self.marks == *marks && lie_alike(&self.panels, panels)
    }

    /// What was done to come here from `before`, in words.
    pub fn words_since(&self, before: &Self) -> String {
        for viewport in [Viewport::First, Viewport::Second] {
            let [now, then] = [self, before].map(|window| window.marks[viewport as usize]);
            let changed = Mark::ALL
                .into_iter()
                .find(|mark| now.has(*mark) != then.has(*mark));
            if let Some(mark) = changed {
                let entry = entries().find(|entry| entry.action == Action::Mark(mark));
                let title = entry.map_or("", |entry| entry.title());
                let place = viewport.title();
                return match now.has(mark) {
                    true => say!("history.mark_shown", mark = title, viewport = place),
                    false => say!("history.mark_hidden", mark = title, viewport = place),
                };
            }
        }
        let is_shown = |window: &Self, panel| layout::is_visible(&window.panels, panel);
        let switched: Vec<Panel> = Panel::ALL
            .into_iter()
            .filter(|panel| is_shown(self, *panel) != is_shown(before, *panel))
            .collect();
        match switched.as_slice() {
            [one] if is_shown(self, *one) => {
                return say!("history.panel_opened", panel = one.title());
            }
            [one] => return say!("history.panel_closed", panel = one.title()),
            _ => {}
        }
        let place = |window: &Self, panel: &Panel| {
            let tiles = &window.panels.tiles;
            tiles.find_pane(panel).map(|id| (id, tiles.parent_of(id)))
        };
        let moved: Vec<Panel> = Panel::ALL
            .into_iter()
            .filter(|panel| place(self, panel) != place(before, panel))
            .collect();
        match moved.as_slice() {
            [one] => say!("history.panel_moved", panel = one.title()),
            [] if switched.is_empty() && children(&self.panels) == children(&before.panels) => {
                say!("history.border_moved").to_owned()
            }
            _ => say!("history.panels_arranged").to_owned(),
        }
    }
}

/// What lies in each container.
fn children(tree: &Tree<Panel>) -> HashMap<TileId, Vec<TileId>> {
    let containers = tree.tiles.iter().filter_map(|(id, tile)| match tile {
        Tile::Container(container) => Some((*id, container.children().copied().collect())),
        Tile::Pane(_) => None,
    });
    containers.collect()
}

/// Whether two trees show the same panels at the same places.
fn lie_alike(a: &Tree<Panel>, b: &Tree<Panel>) -> bool {
    let alike = |(id, tile): (&TileId, &Tile<Panel>)| {
        let same = match (tile, b.tiles.get(*id)) {
            (Tile::Pane(a), Some(Tile::Pane(b))) => a == b,
            (Tile::Container(a), Some(Tile::Container(b))) => match (a, b) {
                (Container::Tabs(a), Container::Tabs(b)) => a.children == b.children,
                (Container::Linear(a), Container::Linear(b)) => {
                    let mut children = a.children.iter();
                    a.dir == b.dir
                        && a.children == b.children
                        && children.all(|child| a.shares[*child] == b.shares[*child])
                }
                (a, b) => a == b,
            },
            _ => false,
        };
        same && a.tiles.is_visible(*id) == b.tiles.is_visible(*id)
    };
    a.root() == b.root() && a.tiles.len() == b.tiles.len() && a.tiles.iter().all(alike)
}

/// `wanted`, with those panels before others of their place that are so now, and before these those that
/// were hidden.
fn kept_in_front(wanted: &Tree<Panel>, now: &Tree<Panel>) -> Tree<Panel> {
    let mut tree = wanted.clone();
    let is_hidden = |panel: &Panel| !layout::is_visible(now, *panel);
    let (opened, others): (Vec<Panel>, Vec<Panel>) = Panel::ALL.into_iter().partition(is_hidden);
    let in_front = others
        .into_iter()
        .filter(|panel| layout::is_in_front(now, *panel));
    for panel in in_front.chain(opened) {
        if layout::is_visible(&tree, panel) {
            layout::set_visible(&mut tree, panel, true);
        }
    }
    tree
}

impl Editor {
    /// Arranges the window as it was in a view that was gone to, and takes note of how it is arranged.
    pub(super) fn tend_window_view(&mut self, ctx: &egui::Context) {
        if let Some(wanted) = self.workbench.views.take_window() {
            if !lie_alike(&wanted.panels, &self.layout) {
                self.layout = kept_in_front(&wanted.panels, &self.layout);
            }
            self.marks = wanted.marks;
            self.window_view = wanted;
            self.window_coming = None;
            ctx.request_repaint();
            return;
        }
        // The way of a border that is dragged is one view.
        let held = ctx.input(|input| input.pointer.any_down());
        if held || self.window_view.is(&self.layout, &self.marks) {
            self.window_coming = None;
            return;
        }
        // A panel that was dropped somewhere takes its place in the frames after that.
        let rests = self.window_coming.take();
        let now = WindowView::new(self.layout.clone(), self.marks);
        if rests.is_some_and(|rests| rests.is(&self.layout, &self.marks)) {
            self.window_view = Arc::new(now);
        } else {
            self.window_coming = Some(now);
            ctx.request_repaint();
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn with(change: impl FnOnce(&mut WindowView)) -> WindowView {
        let mut window = WindowView::default();
        change(&mut window);
        window
    }

    #[test]
    fn words_say_what_was_done() {
        let first = WindowView::default();
        let closed = with(|window| layout::set_visible(&mut window.panels, Panel::Passes, false));
        assert_eq!(closed.words_since(&first), "The panel Passes is closed");
        assert_eq!(first.words_since(&closed), "The panel Passes is opened");
        let grid = with(|window| window.marks[1].toggle(Mark::Grid));
        assert_eq!(
            grid.words_since(&first),
            "Grid and axes: shown in Viewport 2"
        );
        assert_eq!(
            first.words_since(&grid),
            "Grid and axes: hidden in Viewport 2"
        );
        let moved = with(|window| {
            let tiles = &window.panels.tiles;
            let [log, passes] = [Panel::Log, Panel::Passes].map(|it| tiles.find_pane(&it).unwrap());
            let to = tiles.parent_of(passes).unwrap();
            let tree = &mut window.panels;
            tree.move_tile_to_container(log, to, 1, true);
        });
        assert_eq!(moved.words_since(&first), "The panel Log is moved");
        let wider = with(|window| {
            let root = window.panels.root().unwrap();
            let Some(Tile::Container(Container::Linear(root))) = window.panels.tiles.get_mut(root)
            else {
                panic!("the first layout lies in a row");
            };
            let first = root.children[0];
            root.shares.set_share(first, 3.0);
        });
        let border = "A border between panels is moved";
        assert_eq!(wider.words_since(&first), border);
        assert!(!lie_alike(&wider.panels, &first.panels));
        let others = with(|window| window.panels = layout::beside(Panel::Log));
        assert_eq!(others.words_since(&first), "The panels are laid otherwise");
    }

    #[test]
    fn what_is_in_front_stays_and_what_is_opened_comes_there() {
        let mut wanted = layout::first();
        let mut now = layout::first();
        layout::set_visible(&mut wanted, Panel::Pixel, true);
        layout::set_visible(&mut now, Panel::History, true);
        assert!(lie_alike(&wanted, &now));
        layout::set_visible(&mut now, Panel::Pixel, false);
        assert!(!lie_alike(&wanted, &now));
        let tree = kept_in_front(&wanted, &now);
        assert!(layout::is_in_front(&tree, Panel::History));
        assert!(layout::is_in_front(&tree, Panel::Pixel));
        let tree = kept_in_front(&now, &wanted);
        assert!(!layout::is_visible(&tree, Panel::Pixel));
    }
}
