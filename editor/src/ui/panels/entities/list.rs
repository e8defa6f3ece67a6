//! The list of entities. Only the rows in sight are drawn, so that it may be long.

use egui::{RichText, ScrollArea, TextEdit, Ui};
use lightbench::script::Scene;
use lightbench::world::{Entity, Name, RowOrder, Tick, Transform, World};

use crate::ui::workbench::selection::Selection;

/// The entities whose names fit the filter.
#[derive(Default)]
pub struct Rows {
    filter: String,
    rows: Vec<Entity>,
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

/// What the rows were made from.
struct Made {
    filter: String,
    swaps: u64,
    entities: usize,
    /// Everything that a script makes has a place.
    order: RowOrder,
    named: Tick,
}

/// An entity's name in a list, or a number where it has none.
pub fn title(name: &str, entity: Entity) -> String {
    if name.is_empty() {
        format!("(no name, {})", entity.index())
    } else {
        name.to_owned()
    }
}

impl Rows {
    /// Looks through the world where something has changed.
    pub fn refresh(&mut self, world: &World, swaps: u64) {
        let names = world.columns::<Name>();
        let order = world.columns::<Transform>().layout();
        let is_new = self.made.as_ref().is_none_or(|made| {
            made.filter != self.filter
                || made.swaps != swaps
                || made.entities != world.len()
                || made.order != order
                || names.any_changed_since(made.named)
        });
        if !is_new {
            return;
        }
        let wanted = self.filter.trim().to_lowercase();
        self.rows.clear();
        let fits = |entity: Entity| {
            wanted.is_empty()
                || names
                    .row_of(entity)
                    .is_some_and(|row| names.text()[row].to_lowercase().contains(&wanted))
        };
        self.rows
            .extend(world.entities().filter(|entity| fits(*entity)));
        self.made = Some(Made {
            filter: self.filter.clone(),
            swaps,
            entities: world.len(),
            order,
            named: world.observe(),
        });
    }

    /// The rows from one to another, this one last; the other alone where the first is not listed.
    pub fn between(&self, from: Option<Entity>, to: Entity) -> Vec<Entity> {
        let row_of = |entity| self.rows.iter().position(|row| *row == entity);
        let ends = from.and_then(row_of).zip(row_of(to));
        let Some((from, to_row)) = ends else {
            return vec![to];
        };
        let mut rows = self.rows[from.min(to_row)..=from.max(to_row)].to_vec();
        if to_row < from {
            rows.reverse();
        }
        rows
    }

    /// Draws filter and list. Returns the entity that was clicked, and how.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        scene: &Scene,
        selection: &Selection,
        height: f32,
    ) -> Option<(Entity, Choice)> {
        ui.horizontal(|ui| {
            let label = ui.label("Filter");
            let field = TextEdit::singleline(&mut self.filter).desired_width(140.0);
            ui.add(field).labelled_by(label.id);
            let (shown, all) = (self.rows.len(), scene.world.len());
            ui.label(RichText::new(format!("{shown} of {all} entities")).weak());
        });
        let names = scene.world.columns::<Name>();
        let row = ui.spacing().interact_size.y;
        let mut clicked = None;
        let area = ScrollArea::vertical()
            .id_salt("entities")
            .max_height(height)
            .auto_shrink([false, true]);
        ui.spacing_mut().item_spacing.y = 1.0;
        area.show_rows(ui, row, self.rows.len(), |ui, range| {
            for &entity in &self.rows[range] {
                let name = names.row_of(entity).map_or("", |row| &names.text()[row]);
                let mut text = RichText::new(title(name, entity));
                if name.is_empty() {
                    text = text.weak();
                }
                ui.push_id(entity, |ui| {
                    let label = ui.selectable_label(selection.contains(entity), text);
                    if label.clicked() {
                        let modifiers = ui.input(|input| input.modifiers);
                        let how = match (modifiers.command, modifiers.shift) {
                            (true, _) => Choice::Toggle,
                            (false, true) => Choice::UpTo,
                            (false, false) => Choice::Only,
                        };
                        clicked = Some((entity, how));
                    }
                });
            }
        });
        ui.spacing_mut().item_spacing.y = 5.0;
        clicked
    }
}
