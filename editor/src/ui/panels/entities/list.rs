//! The list of entities as a tree. Only the rows in sight are drawn, so that it may be long.

use std::sync::Arc;

use egui::{Button, DragAndDrop, RichText, ScrollArea, Sense, Stroke, StrokeKind, TextEdit, Ui};
use lightbench::script::Scene;
use lightbench::script::overlays::LOCKED;
use lightbench::world::components::Family;
use lightbench::world::{Entity, Name, RowOrder, Tick, Transform, World};

use super::switches::{eye, padlock};
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::selection::Selection;
use crate::ui::workbench::structure::is_shown;

/// Points by which a row stands further right than that of its parent.
const INDENT: f32 = 14.0;

/// Rows are not indented further than so many steps.
const DEEPEST: u16 = 12;

/// An entity in the list, and how many others it hangs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Row {
    entity: Entity,
    depth: u16,
}

/// The entities whose names fit the filter.
#[derive(Default)]
pub struct Rows {
    filter: String,
    rows: Vec<Row>,
    made: Option<Made>,
}

/// What a click on a row does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Chooses it alone.
    Only,
    /// With Ctrl: chooses it too, or no longer.
    Toggle,
    /// With Shift: chooses all rows up to it too.
    UpTo,
}

/// What somebody did in the list.
pub enum Deed {
    /// Clicked a row.
    Choose(Entity, Choice),
    /// Clicked a row twice.
    Rename(Entity),
    /// Clicked the eye of a row.
    Show(Entity, bool),
    /// Clicked the padlock of a row.
    Lock(Entity, bool),
    /// Dragged rows onto another one, or to where nothing is above.
    Put(Vec<Entity>, Option<Entity>),
}

/// Rows that are being dragged.
struct Carried(Vec<Entity>);

/// What the rows were made from.
struct Made {
    filter: String,
    swaps: u64,
    entities: usize,
    /// Everything that a script makes has a place.
    order: RowOrder,
    seen: Tick,
}

/// An entity's name in a list, or a number where it has none.
pub fn title(name: &str, entity: Entity) -> String {
    if name.is_empty() {
        say!("entities.no_name", index = entity.index())
    } else {
        name.to_owned()
    }
}

impl Rows {
    /// Looks through the world where something has changed.
    pub fn refresh(&mut self, world: &World, swaps: u64) {
        let names = world.columns::<Name>();
        let families = world.columns::<Family>();
        let order = world.columns::<Transform>().layout();
        let is_new = self.made.as_ref().is_none_or(|made| {
            made.filter != self.filter
                || made.swaps != swaps
                || made.entities != world.len()
                || made.order != order
                || names.any_changed_since(made.seen)
                || families.any_changed_since(made.seen)
        });
        if !is_new {
            return;
        }
        let wanted = self.filter.trim().to_lowercase();
        self.rows.clear();
        let fits = |entity: &Entity| {
            names
                .row_of(*entity)
                .is_some_and(|row| names.text()[row].to_lowercase().contains(&wanted))
        };
        let flat = |entity| Row { entity, depth: 0 };
        if !wanted.is_empty() {
            let fitting = world.entities().filter(fits);
            self.rows.extend(fitting.map(flat));
        } else if families.is_empty() {
            self.rows.extend(world.entities().map(flat));
        } else {
            self.grow(world);
        }
        self.made = Some(Made {
            filter: self.filter.clone(),
            swaps,
            entities: world.len(),
            order,
            seen: world.observe(),
        });
    }

    /// The rows of the tree, each before those that hang on it.
    fn grow(&mut self, world: &World) {
        let mut waiting = Vec::new();
        for root in world.entities() {
            if world.parent(root).is_some() {
                continue;
            }
            waiting.push(Row {
                entity: root,
                depth: 0,
            });
            while let Some(row) = waiting.pop() {
                self.rows.push(row);
                let first = waiting.len();
                let depth = row.depth.saturating_add(1);
                let children = world.children(row.entity);
                waiting.extend(children.map(|entity| Row { entity, depth }));
                waiting[first..].reverse();
            }
        }
    }

    /// The rows from one to another, this one last; the other alone where the first is not listed.
    pub fn between(&self, from: Option<Entity>, to: Entity) -> Vec<Entity> {
        let row_of = |entity| self.rows.iter().position(|row| row.entity == entity);
        let ends = from.and_then(row_of).zip(row_of(to));
        let Some((from, to_row)) = ends else {
            return vec![to];
        };
        let rows = self.rows[from.min(to_row)..=from.max(to_row)].iter();
        let mut rows: Vec<Entity> = rows.map(|row| row.entity).collect();
        if to_row < from {
            rows.reverse();
        }
        rows
    }

    /// Draws filter and list. Returns what was done in it.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        scene: &Scene,
        selection: &Selection,
        height: f32,
    ) -> Option<Deed> {
        let mut deed = None;
        ui.horizontal(|ui| {
            let label = ui.label(say!("entities.filter"));
            let field = TextEdit::singleline(&mut self.filter).desired_width(140.0);
            ui.add(field).labelled_by(label.id);
            if DragAndDrop::has_payload_of_type::<Carried>(ui.ctx()) {
                let response = ui.add(Button::new(say!("entities.no_parent")));
                mark_target(ui, &response);
                if let Some(carried) = response.dnd_release_payload::<Carried>() {
                    deed = Some(Deed::Put(carried.0.clone(), None));
                }
                return;
            }
            let (shown, all) = (self.rows.len(), scene.world.len());
            ui.label(RichText::new(say!("entities.of_entities", shown = shown, all = all)).weak());
        });
        let row = ui.spacing().interact_size.y;
        let area = ScrollArea::vertical()
            .id_salt("entities")
            .max_height(height)
            .auto_shrink([false, true]);
        ui.spacing_mut().item_spacing.y = 1.0;
        area.show_rows(ui, row, self.rows.len(), |ui, range| {
            for row in &self.rows[range] {
                let done = ui.push_id(row.entity, |ui| show_row(ui, scene, selection, *row));
                deed = done.inner.or(deed.take());
            }
        });
        ui.spacing_mut().item_spacing.y = 5.0;
        deed
    }
}

fn show_row(ui: &mut Ui, scene: &Scene, selection: &Selection, row: Row) -> Option<Deed> {
    let entity = row.entity;
    let world = &scene.world;
    let names = world.columns::<Name>();
    let name = names.row_of(entity).map_or("", |row| &names.text()[row]);
    let called = match name {
        "" => say!("entities.what_has_no_name"),
        name => name,
    };
    let mut deed = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        let shown = is_shown(world, entity);
        if eye(ui, shown, called) {
            deed = Some(Deed::Show(entity, shown == Some(false)));
        }
        let locked = world.tags().contains(LOCKED, entity);
        if padlock(ui, locked, called) {
            deed = Some(Deed::Lock(entity, !locked));
        }
        ui.add_space(INDENT * f32::from(row.depth.min(DEEPEST)));
        let mut text = RichText::new(title(name, entity));
        if name.is_empty() || shown == Some(false) {
            text = text.weak();
        }
        let label = Button::selectable(selection.contains(entity), text)
            .sense(Sense::click_and_drag())
            .truncate();
        let label = ui.add(label);
        if label.drag_started() {
            let carried = match selection.contains(entity) {
                true => selection.entities().collect(),
                false => vec![entity],
            };
            label.dnd_set_drag_payload(Carried(carried));
        }
        mark_target(ui, &label);
        if let Some(carried) = label.dnd_release_payload::<Carried>() {
            let carried: Arc<Carried> = carried;
            if !carried.0.contains(&entity) {
                deed = Some(Deed::Put(carried.0.clone(), Some(entity)));
            }
        } else if label.double_clicked() {
            deed = Some(Deed::Rename(entity));
        } else if label.clicked() {
            let modifiers = ui.input(|input| input.modifiers);
            let how = match (modifiers.command, modifiers.shift) {
                (true, _) => Choice::Toggle,
                (false, true) => Choice::UpTo,
                (false, false) => Choice::Only,
            };
            deed = Some(Deed::Choose(entity, how));
        }
    });
    deed
}

/// Frames where rows would fall that are dragged.
fn mark_target(ui: &Ui, response: &egui::Response) {
    if response.dnd_hover_payload::<Carried>().is_some() {
        let stroke = Stroke::new(1.5, Palette::of(ui).accent);
        ui.painter()
            .rect_stroke(response.rect, 2.0, stroke, StrokeKind::Inside);
    }
}
