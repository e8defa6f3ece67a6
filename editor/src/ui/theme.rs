//! Colours, spacing and type of the editor, dark and light.

use egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals};

/// Colours that mean something, for one theme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// What is chosen or active.
    pub accent: Color32,
    /// Time on the GPU.
    pub gpu: Color32,
    /// Time on the CPU.
    pub cpu: Color32,
    /// Text that matters less.
    pub weak: Color32,
    /// Something is not as asked.
    pub warning: Color32,
    /// Something did not work.
    pub error: Color32,
    /// Behind an error over the picture.
    pub error_fill: Color32,
    /// Behind a note over the picture.
    pub note_fill: Color32,
    /// Text of notes over the picture.
    pub note_text: Color32,
}

impl Palette {
    /// The palette of the theme in force.
    pub fn of(ui: &egui::Ui) -> Self {
        if ui.visuals().dark_mode { DARK } else { LIGHT }
    }
}

// Blue and orange are told apart by every kind of colour blindness (Okabe and Ito 2008).
const DARK: Palette = Palette {
    accent: Color32::from_rgb(86, 156, 214),
    gpu: Color32::from_rgb(86, 156, 214),
    cpu: Color32::from_rgb(222, 157, 62),
    weak: Color32::from_gray(140),
    warning: Color32::from_rgb(230, 180, 80),
    error: Color32::from_rgb(244, 112, 103),
    error_fill: Color32::from_rgba_premultiplied(46, 18, 18, 240),
    note_fill: Color32::from_rgba_premultiplied(16, 17, 19, 225),
    note_text: Color32::from_gray(225),
};

const LIGHT: Palette = Palette {
    accent: Color32::from_rgb(0, 98, 166),
    gpu: Color32::from_rgb(0, 98, 166),
    cpu: Color32::from_rgb(138, 80, 0),
    weak: Color32::from_gray(95),
    warning: Color32::from_rgb(148, 96, 0),
    error: Color32::from_rgb(180, 30, 30),
    error_fill: Color32::from_rgba_premultiplied(250, 232, 230, 245),
    note_fill: Color32::from_rgba_premultiplied(244, 244, 244, 235),
    note_text: Color32::from_gray(30),
};

/// Sets both themes of a context.
pub fn apply(ctx: &egui::Context) {
    ctx.set_visuals_of(Theme::Dark, dark());
    ctx.set_visuals_of(Theme::Light, light());
    ctx.all_styles_mut(|style| {
        let sizes = [
            (TextStyle::Small, 11.0, FontFamily::Proportional),
            (TextStyle::Body, 13.0, FontFamily::Proportional),
            (TextStyle::Button, 13.0, FontFamily::Proportional),
            (TextStyle::Monospace, 12.0, FontFamily::Monospace),
            (TextStyle::Heading, 16.0, FontFamily::Proportional),
        ];
        style.text_styles = sizes
            .into_iter()
            .map(|(name, size, family)| (name, FontId::new(size, family)))
            .collect();
        let spacing = &mut style.spacing;
        spacing.item_spacing = egui::vec2(8.0, 5.0);
        spacing.button_padding = egui::vec2(7.0, 3.0);
        spacing.interact_size.y = 22.0;
        spacing.slider_width = 130.0;
        spacing.combo_width = 120.0;
        spacing.combo_height = 420.0;
        // Panels appear and disappear at once: an animation would keep the processor busy.
        style.animation_time = 0.06;
    });
}

fn dark() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = Color32::from_rgb(29, 31, 34);
    visuals.window_fill = Color32::from_rgb(36, 38, 42);
    visuals.extreme_bg_color = Color32::from_rgb(20, 21, 23);
    visuals.faint_bg_color = Color32::from_rgb(34, 36, 40);
    visuals.selection.bg_fill = Color32::from_rgb(38, 79, 120);
    finish(visuals, DARK)
}

fn light() -> Visuals {
    let mut visuals = Visuals::light();
    visuals.panel_fill = Color32::from_rgb(243, 243, 241);
    visuals.window_fill = Color32::from_rgb(250, 250, 249);
    visuals.extreme_bg_color = Color32::WHITE;
    visuals.faint_bg_color = Color32::from_rgb(236, 236, 233);
    visuals.selection.bg_fill = Color32::from_rgb(168, 206, 240);
    finish(visuals, LIGHT)
}

fn finish(mut visuals: Visuals, palette: Palette) -> Visuals {
    visuals.weak_text_color = Some(palette.weak);
    let corner = CornerRadius::same(3);
    for widget in [
        &mut visuals.widgets.noninteractive,
        &mut visuals.widgets.inactive,
        &mut visuals.widgets.hovered,
        &mut visuals.widgets.active,
        &mut visuals.widgets.open,
    ] {
        widget.corner_radius = corner;
        widget.expansion = 0.0;
    }
    let line = if visuals.dark_mode {
        Color32::from_rgb(52, 55, 60)
    } else {
        Color32::from_rgb(210, 210, 206)
    };
    visuals.widgets.noninteractive.bg_stroke = Stroke::new(1.0, line);
    visuals.window_stroke = Stroke::new(1.0, line);
    visuals.window_corner_radius = CornerRadius::same(5);
    visuals.menu_corner_radius = CornerRadius::same(5);
    visuals.hyperlink_color = palette.accent;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.slider_trailing_fill = true;
    visuals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance (WCAG 2.2, section 8, from the curve of sRGB).
    fn luminance(color: Color32) -> f64 {
        let [red, green, blue] = [color.r(), color.g(), color.b()].map(|part| {
            let value = f64::from(part) / 255.0;
            if value <= 0.04045 {
                value / 12.92
            } else {
                ((value + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn contrast_is_that_of_the_guidelines_own_examples() {
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
        // The lightest grey on white that passes: #767676.
        assert!((contrast(Color32::from_gray(0x76), Color32::WHITE) - 4.54).abs() < 0.005);
    }

    /// WCAG 2.2, success criterion 1.4.3: text has a contrast of at least 4.5 to what is behind it.
    #[test]
    fn text_can_be_read_in_both_themes() {
        for (visuals, palette) in [(dark(), DARK), (light(), LIGHT)] {
            let behind = [
                visuals.panel_fill,
                visuals.window_fill,
                visuals.extreme_bg_color,
                visuals.faint_bg_color,
            ];
            let texts = [
                ("text", visuals.text_color()),
                ("weak text", visuals.weak_text_color()),
                ("links", visuals.hyperlink_color),
                ("accent", palette.accent),
                ("GPU", palette.gpu),
                ("CPU", palette.cpu),
                ("warnings", palette.warning),
                ("errors", palette.error),
            ];
            for (what, color) in texts {
                for fill in behind {
                    // Weak text lets some of what is behind it through.
                    let ratio = contrast(fill.blend(color), fill);
                    assert!(ratio >= 4.5, "{what} on {fill:?}: {ratio:.2}");
                }
            }
            assert!(contrast(palette.note_text, palette.note_fill.to_opaque()) >= 4.5);
            assert!(contrast(palette.error, palette.error_fill.to_opaque()) >= 4.5);
            let chosen = visuals.selection;
            assert!(contrast(chosen.stroke.color, chosen.bg_fill) >= 4.5);
        }
    }
}
