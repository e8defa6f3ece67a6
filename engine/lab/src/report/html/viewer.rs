//! The picture viewer: controls that the script shows and fills in. Without the script the pictures
//! below them suffice.

use super::At;
use super::writer::Writer;
use crate::report::images::Form;

/// The modes of the viewer with their keys.
const MODES: [(&str, &str); 4] = [
    ("split", "Divider (S)"),
    ("flip", "Flip (F)"),
    ("difference", "Difference (D)"),
    ("grid", "Side by side (G)"),
];

/// The viewer, where there is more than one picture.
pub fn section(w: &mut Writer, points: &[At]) {
    let images = points.iter().flat_map(|at| at.images);
    let pictures = images.filter(|image| image.held.picture != Form::Absent);
    if pictures.count() < 2 {
        return;
    }
    let attributes = [
        ("class", "viewer"),
        ("id", "viewer"),
        ("hidden", ""),
        ("aria-label", "Picture viewer"),
        ("role", "region"),
    ];
    w.element("div", &attributes, |w| {
        pictures_row(w);
        looks_row(w);
        w.element(
            "div",
            &[("class", "stage"), ("id", "view-stage"), ("tabindex", "0"), ("role", "application"),
                ("aria-label", "Pictures: arrow keys move the divider, or the picture where it is zoomed; plus and minus zoom")],
            |w| {
                w.element("canvas", &[("id", "view-canvas"), ("width", "640"), ("height", "360")], |_| {});
            },
        );
        w.leaf("p", &[("class", "status"), ("id", "view-status"), ("aria-live", "polite")], "");
        w.leaf("p", &[("class", "status"), ("id", "view-pixel")], "");
        w.element("details", &[("id", "view-choice"), ("hidden", "")], |w| {
            w.leaf("summary", &[], "Pictures side by side");
            w.element("div", &[("class", "controls"), ("id", "view-boxes")], |_| {});
        });
    });
}

/// Which pictures, and the divider.
fn pictures_row(w: &mut Writer) {
    w.element("div", &[("class", "controls")], |w| {
        for (id, name) in [("view-a", "Left (A) "), ("view-b", "Right (B) ")] {
            w.element("label", &[], |w| {
                w.text(name);
                w.element("select", &[("id", id)], |_| {});
            });
        }
        slider(w, "view-x", "Divider ", ["0", "100", "0.5", "50"]);
    });
}

/// How they are shown.
fn looks_row(w: &mut Writer) {
    w.element("div", &[("class", "controls")], |w| {
        for (mode, name) in MODES {
            let pressed = if mode == "split" { "true" } else { "false" };
            let id = format!("view-{mode}");
            let attributes = [("type", "button"), ("id", &id), ("aria-pressed", pressed)];
            w.leaf("button", &attributes, name);
        }
        w.element("label", &[], |w| {
            w.text("Zoom ");
            w.element("select", &[("id", "view-zoom")], |w| {
                for (value, name) in [
                    ("0", "to fit"),
                    ("1", "1:1"),
                    ("2", "2:1"),
                    ("4", "4:1"),
                    ("8", "8:1"),
                    ("16", "16:1"),
                    ("32", "32:1"),
                ] {
                    w.leaf("option", &[("value", value)], name);
                }
            });
        });
        slider(w, "view-gain", "Difference × ", ["0", "8", "1", "3"]);
        slider(
            w,
            "view-exposure",
            "Exposure, stops ",
            ["-8", "8", "0.5", "0"],
        );
    });
}

fn slider(w: &mut Writer, id: &str, name: &str, [min, max, step, value]: [&str; 4]) {
    let output = format!("{id}-value");
    w.element("label", &[("class", "grow")], |w| {
        w.text(name);
        w.leaf("output", &[("id", &output), ("for", id)], "");
        w.void(
            "input",
            &[
                ("type", "range"),
                ("id", id),
                ("min", min),
                ("max", max),
                ("step", step),
                ("value", value),
            ],
        );
    });
}
