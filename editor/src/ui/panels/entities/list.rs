//! The list of entities. Only the rows in sight are drawn, so that it may be long.

use egui::{RichText, ScrollArea, TextEdit, Ui};
use lightbench::script::Scene;
use lightbench::world::{Entity, Name, RowOrder, Tick, Transform, World};

/// The entities whose names fit the filter.
#[derive(Default)]
pub struct Rows {
    filter: String,
    rows: Vec<Entity>,
    made: Option<Made>,
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

    /// Draws filter and list. Returns the entity that was clicked.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        scene: &Scene,
        selected: Option<Entity>,
        height: f32,
    ) -> Option<Entity> {
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
                    let label = ui.selectable_label(selected == Some(entity), text);
                    if label.clicked() {
                        clicked = Some(entity);
                    }
                });
            }
        });
        ui.spacing_mut().item_spacing.y = 5.0;
        clicked
    }
}
