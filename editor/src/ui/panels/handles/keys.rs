//! The amount of a drag, typed.

use egui::{Event, Key, Ui};

/// What keys do to a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    /// Nothing, or another amount.
    Nothing,
    /// It ends here.
    Enter,
    /// It never was.
    Escape,
}

/// Adds what was typed in this frame to `text`.
pub fn read(ui: &Ui, text: &mut String) -> Pressed {
    ui.input_mut(|input| {
        let mut pressed = Pressed::Nothing;
        for event in &input.events {
            match event {
                Event::Text(typed) => {
                    let fits = |c: &char| c.is_ascii_digit() || matches!(c, '.' | '-');
                    // A comma is a point to many.
                    text.extend(typed.replace(',', ".").chars().filter(fits));
                }
                Event::Key {
                    key, pressed: true, ..
                } => match key {
                    Key::Backspace => {
                        text.pop();
                    }
                    Key::Enter => pressed = Pressed::Enter,
                    Key::Escape => pressed = Pressed::Escape,
                    _ => {}
                },
                _ => {}
            }
        }
        pressed
    })
}
