//! Each pipeline's picture, where it differs, and the metrics.

use super::table::{numbers, table, words};
use super::writer::{Writer, data_uri};
use crate::colormap::ColorMap;
use crate::diff::{ldr_lines, linear_lines, number};
use crate::report::images::Encoded;
use crate::report::model::{Comparison, PipelineResult};

/// Viewer, pictures and metrics.
pub fn section(w: &mut Writer, c: &Comparison, images: &[Encoded]) {
    let compared = c.pipelines.iter().any(|p| p.difference.is_some());
    let heading = if compared {
        "Where the pictures differ"
    } else {
        "Pictures"
    };
    w.element(
        "section",
        &[("id", "pictures"), ("aria-labelledby", "pictures-h")],
        |w| {
            w.leaf("h2", &[("id", "pictures-h")], heading);
            if images.iter().filter(|i| i.picture.is_some()).count() > 1 {
                viewer(w);
            }
            for (number, (pipeline, image)) in c.pipelines.iter().zip(images).enumerate() {
                pair(w, c, pipeline, image, number);
            }
            if images.iter().any(|i| i.heat_map.is_some()) {
                legend(w, c.heat_map_scale);
            }
            metrics_table(w, c);
        },
    );
}

/// Controls that the script fills in and shows; without the script the pictures below suffice.
fn viewer(w: &mut Writer) {
    let attributes = [
        ("class", "viewer"),
        ("id", "viewer"),
        ("hidden", ""),
        ("aria-label", "Picture viewer"),
    ];
    w.element("div", &attributes, |w| {
        w.element("div", &[("class", "controls")], |w| {
            w.element("label", &[], |w| {
                w.text("Left (A) ");
                w.element("select", &[("id", "view-a")], |_| {});
            });
            w.element("label", &[], |w| {
                w.text("Right (B) ");
                w.element("select", &[("id", "view-b")], |_| {});
            });
            w.element("label", &[("class", "grow")], |w| {
                w.text("Divider ");
                w.void(
                    "input",
                    &[
                        ("type", "range"),
                        ("id", "view-x"),
                        ("min", "0"),
                        ("max", "100"),
                        ("value", "50"),
                    ],
                );
            });
            let flip = [
                ("type", "button"),
                ("id", "view-flip"),
                ("aria-pressed", "false"),
            ];
            w.leaf("button", &flip, "Flip A/B (F)");
            w.leaf(
                "button",
                &[("type", "button"), ("id", "view-zoom")],
                "Zoom to fit (Z)",
            );
        });
        w.element(
            "div",
            &[("class", "stage"), ("id", "view-stage"), ("tabindex", "0")],
            |w| {
                w.element("div", &[("class", "layers"), ("id", "view-layers")], |_| {});
            },
        );
        w.leaf(
            "p",
            &[
                ("class", "status"),
                ("id", "view-status"),
                ("aria-live", "polite"),
            ],
            "",
        );
    });
}

/// A pipeline's picture and, beside it, its heat map.
fn pair(w: &mut Writer, c: &Comparison, p: &PipelineResult, image: &Encoded, index: usize) {
    let is_reference = p.name == c.reference;
    let label = p.label();
    w.element("article", &[("class", "pair")], |w| {
        let several = c.pipelines.len() > 1;
        let role = if is_reference && several {
            " (reference)"
        } else {
            ""
        };
        w.leaf("h3", &[], &format!("{label}{role}"));
        if !p.description.is_empty() {
            w.leaf("p", &[("class", "about")], &p.description);
        }
        w.element("div", &[("class", "figures")], |w| {
            match (&image.picture, &p.picture) {
                (Some(png), Some(picture)) => shot(
                    w,
                    &Shot {
                        id: &format!("picture-{index}"),
                        label,
                        alt: &format!("Picture of {label}"),
                        caption: "Picture, 8-bit sRGB after the tone curve",
                        size: [picture.width, picture.height],
                    },
                    png,
                ),
                _ => w.leaf("p", &[("class", "aside")], "No picture was kept."),
            }
            match (&image.heat_map, &p.heat_map) {
                (Some(png), Some(map)) => shot(
                    w,
                    &Shot {
                        id: &format!("difference-{index}"),
                        label: &format!("{label} – FLIP"),
                        alt: &format!("Heat map of the FLIP difference of {label}"),
                        caption: &difference_caption(p),
                        size: [map.width, map.height],
                    },
                    png,
                ),
                _ if !several => {}
                _ if is_reference => {
                    let text = "All other pictures are compared with this one.";
                    w.leaf("p", &[("class", "aside")], text);
                }
                _ => w.leaf("p", &[("class", "aside")], "This picture was not compared."),
            }
        });
    });
}

/// A picture of the page that the viewer can show too.
struct Shot<'a> {
    id: &'a str,
    label: &'a str,
    alt: &'a str,
    caption: &'a str,
    size: [u32; 2],
}

fn shot(w: &mut Writer, shot: &Shot, png: &[u8]) {
    let [width, height] = shot.size.map(|s| s.to_string());
    w.element("figure", &[], |w| {
        let attributes = [
            ("id", shot.id),
            ("class", "shot"),
            ("data-label", shot.label),
            ("src", &data_uri(png)),
            ("alt", shot.alt),
            ("width", &width),
            ("height", &height),
        ];
        w.void("img", &attributes);
        w.leaf("figcaption", &[], shot.caption);
    });
}

fn difference_caption(p: &PipelineResult) -> String {
    match &p.difference {
        None => "FLIP difference".into(),
        Some(d) if d.is_identical() => "FLIP difference: none, every pixel is equal".into(),
        Some(d) => format!(
            "FLIP difference: mean {}, 99th percentile {}, maximum {}",
            number(d.flip.mean),
            number(d.flip.p99),
            number(d.flip.max)
        ),
    }
}

/// The colours of the heat maps with their values.
fn legend(w: &mut Writer, scale: f32) {
    let label =
        format!("Colours of the heat maps: black is a FLIP of 0, pale yellow a FLIP of {scale}");
    let svg = [
        ("class", "legend"),
        ("viewBox", "0 0 420 44"),
        ("role", "img"),
        ("aria-label", &label),
    ];
    w.element("svg", &svg, |w| {
        w.element("defs", &[], |w| {
            w.element("linearGradient", &[("id", "magma")], |w| {
                for i in 0..=16 {
                    let at = i as f32 / 16.0;
                    let [r, g, b] = ColorMap::Magma.color(at);
                    let colour = format!("rgb({r},{g},{b})");
                    w.element(
                        "stop",
                        &[("offset", &at.to_string()), ("stop-color", &colour)],
                        |_| {},
                    );
                }
            });
        });
        w.element(
            "rect",
            &[
                ("x", "20"),
                ("y", "2"),
                ("width", "380"),
                ("height", "14"),
                ("fill", "url(#magma)"),
                ("class", "frame"),
            ],
            |_| {},
        );
        for i in 0..=4_u8 {
            let x = (20 + 95 * u32::from(i)).to_string();
            w.element(
                "path",
                &[("class", "axis"), ("d", &format!("M{x} 16v4"))],
                |_| {},
            );
            let value = f64::from(scale) * f64::from(i) / 4.0;
            let text = format!("{:.4}", value);
            let text = text.trim_end_matches('0').trim_end_matches('.');
            w.leaf(
                "text",
                &[("x", &x), ("y", "33"), ("text-anchor", "middle")],
                text,
            );
        }
    });
    w.leaf("p", &[("class", "note")], &format!("FLIP of each pixel, painted with the map magma from 0, no visible difference, to {scale}; the largest that FLIP can be is 1."));
}

fn metrics_table(w: &mut Writer, c: &Comparison) {
    let compared: Vec<&PipelineResult> = c
        .pipelines
        .iter()
        .filter(|p| p.difference.is_some())
        .collect();
    let Some(first) = compared.first() else {
        return;
    };
    let lines = |p: &PipelineResult| -> Vec<(String, String)> {
        let mut lines: Vec<_> = p.difference.as_ref().map(ldr_lines).unwrap_or_default();
        lines.extend(
            p.linear_difference
                .as_ref()
                .map(linear_lines)
                .unwrap_or_default(),
        );
        lines.into_iter().map(|l| (l.name, l.value)).collect()
    };
    let longest = compared
        .iter()
        .copied()
        .max_by_key(|p| lines(p).len())
        .unwrap_or(first);
    let mut columns = vec![words("Against the reference")];
    columns.extend(compared.iter().map(|p| numbers(p.label())));
    let rows: Vec<Vec<String>> = lines(longest)
        .into_iter()
        .enumerate()
        .map(|(row, (name, _))| {
            let mut cells = vec![name];
            cells.extend(compared.iter().map(|p| {
                lines(p)
                    .get(row)
                    .map_or_else(|| "–".into(), |(_, value)| value.clone())
            }));
            cells
        })
        .collect();
    table(
        w,
        "Picture metrics. Formulas, spaces and constants are at the end.",
        &columns,
        &rows,
    );
}
