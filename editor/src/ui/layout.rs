//! Which panels there are and how they lie.

use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

use crate::ui::messages::say;

use super::workbench::viewports::Viewport;

/// A panel. Its name in the file of settings is that of the variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Panel {
    /// The picture.
    Viewport,
    /// Another one, of the same world.
    Second,
    /// Any target of any pass.
    Targets,
    /// What each pass does to a pixel.
    Pixel,
    /// The passes and their cost.
    Passes,
    /// Parameters of the pipeline.
    Pipeline,
    /// All pipelines, and the keys of favourites.
    Pipelines,
    /// Parameters of the scene.
    Scene,
    /// The entities, and the fields of one.
    Entities,
    /// The materials, and what one says of a surface.
    Materials,
    /// Materials, meshes and textures with their pictures.
    Assets,
    /// What a scene has beside its things.
    Environment,
    /// What happened.
    Log,
    /// Lines of scene script.
    Console,
    /// What was done, as lines of scripts.
    Actions,
    /// Curves that scripts plot.
    Plots,
    /// What was changed by hand, to be taken back.
    History,
    /// Two pipelines beside each other.
    Compare,
    /// What was measured and kept.
    Notebook,
    /// Scripts and shaders.
    Code,
    /// A lesson: its text, its tasks and what a check found.
    Lesson,
}

impl Panel {
    /// All of them.
    pub const ALL: [Self; 21] = [
        Self::Viewport,
        Self::Second,
        Self::Targets,
        Self::Pixel,
        Self::Passes,
        Self::Pipeline,
        Self::Pipelines,
        Self::Scene,
        Self::Entities,
        Self::Materials,
        Self::Assets,
        Self::Environment,
        Self::Log,
        Self::Console,
        Self::Actions,
        Self::Plots,
        Self::History,
        Self::Compare,
        Self::Notebook,
        Self::Code,
        Self::Lesson,
    ];

    /// The words on its tab.
    pub fn title(self) -> &'static str {
        match self {
            Self::Viewport => Viewport::First.title(),
            Self::Second => Viewport::Second.title(),
            Self::Targets => say!("layout.targets"),
            Self::Pixel => say!("layout.pixel"),
            Self::Passes => say!("layout.passes"),
            Self::Pipeline => say!("layout.pipeline"),
            Self::Pipelines => say!("layout.all_pipelines"),
            Self::Scene => say!("layout.scene"),
            Self::Entities => say!("layout.entities"),
            Self::Materials => say!("materials.title"),
            Self::Assets => say!("assets.title"),
            Self::Environment => say!("environment.title"),
            Self::Log => say!("layout.log"),
            Self::Console => say!("layout.console"),
            Self::Actions => say!("layout.actions"),
            Self::Plots => say!("layout.plots"),
            Self::History => say!("layout.history"),
            Self::Compare => say!("layout.compare"),
            Self::Notebook => say!("layout.notebook"),
            Self::Code => say!("layout.code"),
            Self::Lesson => say!("lesson.panel"),
        }
    }
}

/// The layout of the first start: the picture large, numbers at its right, the log below.
pub fn first() -> Tree<Panel> {
    let mut tiles = Tiles::default();
    let mut tabs = |panels: &[Panel]| {
        let panes = panels
            .iter()
            .map(|panel| tiles.insert_pane(*panel))
            .collect();
        tiles.insert_tab_tile(panes)
    };
    let lesson = tabs(&[Panel::Lesson]);
    let code = tabs(&[Panel::Code]);
    let viewport = tabs(&[Panel::Viewport]);
    let second = tabs(&[Panel::Second]);
    let log = tabs(&[
        Panel::Log,
        Panel::Console,
        Panel::Actions,
        Panel::History,
        Panel::Plots,
        Panel::Notebook,
    ]);
    let parameters = tabs(&[
        Panel::Pipeline,
        Panel::Scene,
        Panel::Pipelines,
        Panel::Compare,
    ]);
    let passes = tabs(&[Panel::Passes]);
    let targets = tabs(&[
        Panel::Targets,
        Panel::Pixel,
        Panel::Entities,
        Panel::Materials,
        Panel::Assets,
        Panel::Environment,
    ]);
    let viewports = split(
        &mut tiles,
        LinearDir::Horizontal,
        &[(viewport, 0.5), (second, 0.5)],
    );
    let left = split(
        &mut tiles,
        LinearDir::Vertical,
        &[(viewports, 0.76), (log, 0.24)],
    );
    let right = split(
        &mut tiles,
        LinearDir::Vertical,
        &[(parameters, 0.3), (passes, 0.33), (targets, 0.37)],
    );
    let root = split(
        &mut tiles,
        LinearDir::Horizontal,
        &[(lesson, 0.5), (code, 0.5), (left, 0.62), (right, 0.38)],
    );
    let mut tree = Tree::new(egui::Id::unique("panels"), root, tiles);
    // They take their places when a lesson or a file is opened.
    set_visible(&mut tree, Panel::Lesson, false);
    set_visible(&mut tree, Panel::Code, false);
    set_visible(&mut tree, Panel::Second, false);
    tree
}

/// All panels at once, beside each other, so that none hides another.
pub fn all() -> Tree<Panel> {
    let mut tiles = Tiles::default();
    let panes = Panel::ALL.map(|panel| tiles.insert_pane(panel));
    let root = tiles.insert_grid_tile(panes.to_vec());
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

/// The picture at the left and one panel at its right.
pub fn beside(panel: Panel) -> Tree<Panel> {
    let mut tiles = Tiles::default();
    let picture = tiles.insert_pane(Panel::Viewport);
    let pane = tiles.insert_pane(panel);
    let root = split(
        &mut tiles,
        LinearDir::Horizontal,
        &[(picture, 0.5), (pane, 0.5)],
    );
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

/// Where a panel was drawn in the last frame, in points.
pub fn rect(tree: &Tree<Panel>, panel: Panel) -> Option<egui::Rect> {
    tree.tiles.rect(tree.tiles.find_pane(&panel)?)
}

fn split(tiles: &mut Tiles<Panel>, dir: LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, parts.iter().map(|(id, _)| *id).collect());
    for (id, share) in parts {
        linear.shares.set_share(*id, *share);
    }
    tiles.insert_new(Tile::Container(Container::Linear(linear)))
}

/// Whether a panel is shown.
pub fn is_visible(tree: &Tree<Panel>, panel: Panel) -> bool {
    tree.tiles
        .find_pane(&panel)
        .is_some_and(|id| tree.tiles.is_visible(id))
}

/// Whether a panel can be seen: it is shown, and before those that share its place.
pub fn is_in_front(tree: &Tree<Panel>, panel: Panel) -> bool {
    let id = tree.tiles.find_pane(&panel);
    id.is_some_and(|id| tree.active_tiles().contains(&id))
}

/// Shows a panel or hides it.
pub fn set_visible(tree: &mut Tree<Panel>, panel: Panel, visible: bool) {
    if let Some(id) = tree.tiles.find_pane(&panel) {
        tree.set_visible(id, visible);
        if visible {
            tree.make_active(|other, _| other == id);
        }
    }
}

/// Puts a panel that is not there into the tree, hidden. `None` where the tree has no place for it.
pub fn add_hidden(tree: &mut Tree<Panel>, panel: Panel) -> Option<()> {
    let root = tree.root()?;
    let pane = tree.tiles.insert_pane(panel);
    let tabs = tree.tiles.insert_tab_tile(vec![pane]);
    match tree.tiles.get_mut(root)? {
        Tile::Container(container) => container.add_child(tabs),
        Tile::Pane(_) => {
            let both = Linear::new(LinearDir::Horizontal, vec![root, tabs]);
            let both = tree
                .tiles
                .insert_new(Tile::Container(Container::Linear(both)));
            tree.root = Some(both);
        }
    }
    set_visible(tree, panel, false);
    Some(())
}
