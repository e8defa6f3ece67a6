//! Each pipeline's picture, where it differs, and the metrics.

use super::At;
use super::table::{numbers, table, words};
use super::writer::{Writer, data_uri};
use crate::colormap::ColorMap;
use crate::diff::{ldr_lines, linear_lines, number};
use crate::report::images::{Encoded, Form, base};
use crate::report::model::{Comparison, PipelineResult};

/// Pictures and metrics of a point.
pub fn section(w: &mut Writer, at: &At) {
    let c = at.comparison;
    let compared = c.pipelines.iter().any(|p| p.difference.is_some());
    let heading = if compared {
        "Where the pictures differ"
    } else {
        "Pictures"
    };
    let (id, heading_id) = (at.id("pictures"), at.id("pictures-h"));
    w.element(
        "section",
        &[("id", &id), ("aria-labelledby", &heading_id)],
        |w| {
            w.leaf("h2", &[("id", &heading_id)], &at.heading(heading));
            for (number, (pipeline, image)) in c.pipelines.iter().zip(at.images).enumerate() {
                pair(w, at, pipeline, image, number);
            }
            if at.images.iter().any(|i| i.heat_map.is_some()) {
                legend(w, c.heat_map_scale);
            }
            metrics_table(w, c);
        },
    );
}

/// A pipeline's picture and, beside it, its heat map and views.
fn pair(w: &mut Writer, at: &At, p: &PipelineResult, image: &Encoded, index: usize) {
    let c = at.comparison;
    let is_reference = p.name == c.reference;
    let label = p.label();
    let several = c.pipelines.len() > 1;
    w.element("article", &[("class", "pair")], |w| {
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
            match &p.picture {
                Some(picture) => shot(
                    w,
                    &Shot {
                        id: &at.id(&format!("picture-{index}")),
                        kind: "picture",
                        label,
                        alt: &format!("Picture of {label}"),
                        caption: "Picture, 8-bit sRGB after the tone curve",
                        size: [picture.width, picture.height],
                        file: p.picture_file.as_deref(),
                        point: at.number,
                        reference: base(c).is_some_and(|base| base.name == p.name),
                    },
                    image.held.picture,
                    match image.held.picture {
                        Form::Delta => image.delta.as_deref(),
                        _ => image.picture.as_deref(),
                    },
                ),
                None => w.leaf("p", &[("class", "aside")], "No picture was kept."),
            }
            match &p.heat_map {
                Some(map) => shot(
                    w,
                    &Shot {
                        id: &at.id(&format!("difference-{index}")),
                        kind: "flip",
                        label: &format!("{label} – FLIP"),
                        alt: &format!("Heat map of the FLIP difference of {label}"),
                        caption: &difference_caption(p),
                        size: [map.width, map.height],
                        file: p.heat_map_file.as_deref(),
                        point: at.number,
                        reference: false,
                    },
                    if image.held.heat_map {
                        Form::Whole
                    } else {
                        Form::Absent
                    },
                    image.heat_map.as_deref(),
                ),
                None if !several => {}
                None if is_reference => {
                    let text = "All other pictures are compared with this one.";
                    w.leaf("p", &[("class", "aside")], text);
                }
                None => w.leaf("p", &[("class", "aside")], "This picture was not compared."),
            }
            for (view_number, (view, png)) in p.views.iter().zip(&image.views).enumerate() {
                let Some(picture) = &view.picture else {
                    continue;
                };
                shot(
                    w,
                    &Shot {
                        id: &at.id(&format!("view-{index}-{view_number}")),
                        kind: "view",
                        label: &format!("{label} – {}", view.name),
                        alt: &format!("{} in {label}", view.name),
                        caption: &format!("{}: {}", view.name, view.description),
                        size: [picture.width, picture.height],
                        file: view.file.as_deref(),
                        point: at.number,
                        reference: false,
                    },
                    if image.held.views {
                        Form::Whole
                    } else {
                        Form::Absent
                    },
                    png.as_deref(),
                );
            }
        });
        linear(w, at, p, image, index);
    });
}

/// The picture in linear light for the viewer, or why it is not there.
fn linear(w: &mut Writer, at: &At, p: &PipelineResult, image: &Encoded, index: usize) {
    let Some(picture) = &p.linear else {
        return;
    };
    let Some(png) = image.linear.as_ref().filter(|_| image.held.linear) else {
        let text = "The picture in linear light is not in this page, which would be too large with \
                    it; the viewer shows no exposure of it.";
        w.leaf("p", &[("class", "note exposure")], text);
        return;
    };
    let [width, height] = [picture.width, picture.height * 2].map(|s| s.to_string());
    let attributes = [
        ("id", at.id(&format!("linear-{index}"))),
        ("class", "linear".into()),
        ("hidden", String::new()),
        ("alt", String::new()),
        ("data-of", at.id(&format!("picture-{index}"))),
        ("src", data_uri(png)),
        ("width", width),
        ("height", height),
    ];
    let attributes: Vec<(&str, &str)> = attributes.iter().map(|(n, v)| (*n, v.as_str())).collect();
    w.void("img", &attributes);
}

/// A picture of the page that the viewer can show too.
struct Shot<'a> {
    id: &'a str,
    kind: &'a str,
    label: &'a str,
    alt: &'a str,
    caption: &'a str,
    size: [u32; 2],
    file: Option<&'a str>,
    point: usize,
    reference: bool,
}

fn shot(w: &mut Writer, shot: &Shot, form: Form, png: Option<&[u8]>) {
    let [width, height] = shot.size.map(|s| s.to_string());
    let point = shot.point.to_string();
    let file = shot.file.unwrap_or_default();
    w.element("figure", &[], |w| {
        let uri = png.filter(|_| form != Form::Absent).map(data_uri);
        let mut attributes = vec![
            ("id", shot.id),
            ("data-label", shot.label),
            ("data-kind", shot.kind),
            ("data-point", &point),
            ("width", &width),
            ("height", &height),
        ];
        if shot.reference {
            attributes.push(("data-reference", "true"));
        }
        match (form, &uri) {
            (Form::Whole, Some(uri)) => {
                attributes.extend([("class", "shot"), ("src", uri), ("alt", shot.alt)]);
                w.void("img", &attributes);
            }
            (Form::Delta, Some(uri)) => {
                // A canvas that the script fills: the reference's picture plus this difference.
                attributes.extend([
                    ("class", "shot"),
                    ("data-delta", uri),
                    ("role", "img"),
                    ("aria-label", shot.alt),
                ]);
                w.element("canvas", &attributes, |_| {});
                w.element("noscript", &[], |w| {
                    w.element("p", &[("class", "note")], |w| {
                        w.text(
                            "This picture is held as its difference to another, which the \
                                script adds. As a file: ",
                        );
                        w.leaf("a", &[("href", file)], file);
                    });
                });
            }
            _ => {
                w.element("p", &[("class", "aside")], |w| {
                    w.text(
                        "This page would be too large with this picture. It is beside the page: ",
                    );
                    w.leaf("a", &[("href", file)], file);
                });
            }
        }
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

/// The colours of all heat maps.
pub fn gradient(w: &mut Writer) {
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

/// Pipelines that a table of metrics has beside each other.
const ON_PAPER: usize = 4;

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
    // Side by side they would not fit on paper.
    for some in compared.chunks(ON_PAPER) {
        let mut columns = vec![words("Against the reference")];
        columns.extend(some.iter().map(|p| numbers(p.label())));
        let rows: Vec<Vec<String>> = lines(longest)
            .into_iter()
            .enumerate()
            .map(|(row, (name, _))| {
                let mut cells = vec![name];
                cells.extend(some.iter().map(|p| {
                    lines(p)
                        .get(row)
                        .map_or_else(|| "–".into(), |(_, value)| value.clone())
                }));
                cells
            })
            .collect();
        let caption = "Picture metrics. Formulas, spaces and constants are at the end.";
        table(w, caption, &columns, &rows);
    }
}
