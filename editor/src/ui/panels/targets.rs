//! Any target as it is after any pass.

use std::time::Instant;

use egui::{Color32, DragValue, Rect, RichText, ScrollArea, Sense, TextureOptions, Ui, pos2};
use lightbench::render::PipelineDesc;
use lightbench::render::description::Shape;
use lightbench::render::inspect::{Aspect, Channels, ColorMap, Inspection};
use wgpu::Texture;

use super::histogram::{self, Histogram};
use super::widgets::{bytes, combo};
use crate::ui::editor::Editor;
use crate::ui::messages::{message, say, text};
use crate::ui::screen::Place;
use crate::ui::workbench::Workbench;

/// What was chosen in the panel.
#[derive(Default)]
pub struct TargetsPanel {
    /// How the histogram is drawn.
    pub(super) histogram: Histogram,
    /// After which pass; the last one where none is chosen.
    pass: Option<String>,
    target: Option<String>,
    /// The pipeline whose target is looked at; another pipeline begins with what suits it.
    pipeline: String,
}

/// The least height of the picture, points.
const LEAST_HEIGHT: f32 = 110.0;

const CHANNELS: [(Channels, &str); 5] = [
    (Channels::Color, message!("targets.colour")),
    (Channels::Red, message!("targets.red")),
    (Channels::Green, message!("targets.green")),
    (Channels::Blue, message!("targets.blue")),
    (Channels::Alpha, message!("targets.alpha")),
];

const MAPS: [(ColorMap, &str); 3] = [
    (ColorMap::Light, message!("targets.light")),
    (ColorMap::Data, message!("targets.data")),
    (ColorMap::FalseColor, message!("targets.false_colour")),
];

impl TargetsPanel {
    /// Shows a target as it is after a pass.
    pub(super) fn look(&mut self, workbench: &mut Workbench, pass: usize, target: &str) {
        let far = workbench.far_shown();
        let Some(desc) = workbench.pipelines.shown_pipeline().map(|p| &p.desc) else {
            return;
        };
        let Some(request) = Inspection::suited(desc, pass, target, far) else {
            return;
        };
        self.pass = desc.passes.get(pass).map(|pass| pass.name.clone());
        self.target = Some(target.to_owned());
        self.pipeline.clone_from(&desc.name);
        workbench.inspect(Some(request));
    }
}

/// Draws the target viewer.
pub fn show(editor: &mut Editor, ui: &mut Ui, now: Instant) {
    let workbench = &mut editor.workbench;
    let far = workbench.far_shown();
    let Some(desc) = workbench.pipelines.shown_pipeline().map(|p| p.desc.clone()) else {
        ui.label(RichText::new(say!("targets.no_pipeline_is_ready")).weak());
        return;
    };
    let panel = &mut editor.targets;
    let before = workbench.inspection();
    let known = panel.pipeline == desc.name;
    panel.pipeline.clone_from(&desc.name);
    let mut request = before.clone().filter(|request| {
        known && desc.target(&request.target).is_some() && request.pass < desc.passes.len()
    });
    choose(panel, ui, &desc, &mut request, far);
    if let Some(request) = &mut request {
        let texture = workbench.target_texture(&request.target);
        part(ui, request, &desc, texture.as_ref(), far);
        how(ui, request, &desc, far, &mut workbench.measuring.automatic);
    }
    if request != before {
        workbench.inspect(request.clone());
    }
    if let Some(request) = &request {
        // The picture takes what is left, and is still there where that is little.
        let bottom = ui.max_rect().bottom();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            histogram::show(editor, ui, request, now);
            picture(editor, ui, &desc, request, bottom);
        });
    } else {
        let text = say!("targets.choose_a_target_to_see_it");
        ui.label(RichText::new(text).weak());
    }
}

/// Which target, after which pass.
fn choose(
    panel: &mut TargetsPanel,
    ui: &mut Ui,
    desc: &PipelineDesc,
    request: &mut Option<Inspection>,
    far: f32,
) {
    let last = desc.passes.len().saturating_sub(1);
    let find = |name: &Option<String>| {
        let name = name.as_ref()?;
        desc.passes.iter().position(|pass| pass.name == *name)
    };
    let pass = find(&panel.pass).unwrap_or(last);
    let target = panel
        .target
        .clone()
        .filter(|name| desc.target(name).is_some());
    let (mut new_pass, mut new_target) = (pass, target.clone());
    ui.horizontal_wrapped(|ui| {
        let shown = target.as_deref().unwrap_or(say!("targets.none"));
        combo(ui, say!("targets.target"), shown, 110.0, |ui| {
            ui.selectable_value(&mut new_target, None, say!("targets.none"));
            for entry in &desc.targets {
                ui.selectable_value(&mut new_target, Some(entry.name.clone()), &entry.name)
                    .on_hover_text(entry.format.name());
            }
        });
        let shown = desc.passes.get(pass).map_or("", |pass| pass.name.as_str());
        combo(ui, say!("targets.after_pass"), shown, 110.0, |ui| {
            for (index, entry) in desc.passes.iter().enumerate() {
                ui.selectable_value(&mut new_pass, index, &entry.name);
            }
        });
    });
    let same = new_pass == pass && new_target == target;
    if same && request.is_some() == target.is_some() {
        return;
    }
    if new_pass != pass {
        panel.pass = desc.passes.get(new_pass).map(|pass| pass.name.clone());
    }
    panel.target.clone_from(&new_target);
    let kept = request
        .take()
        .filter(|old| Some(&old.target) == new_target.as_ref());
    *request = match (kept, new_target) {
        (_, None) => None,
        (Some(old), _) => Some(Inspection {
            pass: new_pass,
            ..old
        }),
        (None, Some(target)) => Inspection::suited(desc, new_pass, &target, far),
    };
}

/// Which mip level, layer and sample, and whether stencil, where the target has several.
fn part(
    ui: &mut Ui,
    request: &mut Inspection,
    desc: &PipelineDesc,
    texture: Option<&Texture>,
    far: f32,
) {
    let Some(target) = desc.target(&request.target) else {
        return;
    };
    let levels = match texture {
        Some(texture) => texture.mip_level_count(),
        None => 1,
    };
    let layers = target.shape.layers();
    let stencil = target.format.0.has_stencil_aspect();
    if levels == 1 && layers == 1 && target.samples == 1 && !stencil {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let number = |ui: &mut Ui, name: &str, value: &mut u32, count: u32| {
            if count > 1 {
                let label = ui.label(name);
                let field = DragValue::new(value).range(0..=count - 1).speed(0.05);
                ui.add(field).labelled_by(label.id);
            }
        };
        number(ui, say!("targets.mip"), &mut request.slice.mip, levels);
        let name = match target.shape {
            Shape::Cube => say!("targets.side"),
            Shape::Volume(_) => say!("targets.slice"),
            Shape::Flat | Shape::Array(_) => say!("targets.layer"),
        };
        number(ui, name, &mut request.slice.layer, layers);
        if target.samples > 1 {
            let words = |sample: Option<u32>| match sample {
                None => say!("targets.mean_of_all").to_owned(),
                Some(sample) => sample.to_string(),
            };
            combo(
                ui,
                say!("targets.sample"),
                &words(request.sample),
                80.0,
                |ui| {
                    for sample in std::iter::once(None).chain((0..target.samples).map(Some)) {
                        ui.selectable_value(&mut request.sample, sample, words(sample));
                    }
                },
            );
        }
        if stencil {
            let mut on = request.aspect == Aspect::Stencil;
            if ui.checkbox(&mut on, say!("targets.stencil")).changed() {
                let suited = Inspection::suited(desc, request.pass, &request.target, far);
                *request = match suited {
                    Some(depth) if !on => depth,
                    _ => Inspection {
                        aspect: Aspect::Stencil,
                        map: ColorMap::Data,
                        low: 0.0,
                        high: 255.0,
                        ..request.clone()
                    },
                };
            }
        }
    });
}

/// Channels, map and range.
fn how(ui: &mut Ui, request: &mut Inspection, desc: &PipelineDesc, far: f32, automatic: &mut bool) {
    let Some(target) = desc.target(&request.target) else {
        return;
    };
    let depth = target.format.is_depth() && request.aspect == Aspect::Main;
    let channels = usize::from(target.format.0.components());
    ui.horizontal_wrapped(|ui| {
        if !target.format.is_depth() && channels > 1 {
            let selected = CHANNELS
                .iter()
                .find(|(value, _)| *value == request.channels);
            let selected = selected.map_or("", |(_, name)| text(name));
            combo(ui, say!("targets.channels"), selected, 76.0, |ui| {
                for (value, name) in CHANNELS.iter().take(channels + 1) {
                    ui.selectable_value(&mut request.channels, *value, text(name));
                }
            });
        }
        let selected = MAPS.iter().find(|(value, _)| *value == request.map);
        combo(
            ui,
            say!("targets.map"),
            selected.map_or("", |(_, name)| text(name)),
            90.0,
            |ui| {
                for (value, name) in MAPS {
                    ui.selectable_value(&mut request.map, value, text(name));
                }
            },
        );
        let about = say!("targets.the_range_goes_from_the_least");
        ui.checkbox(automatic, say!("targets.automatic"))
            .on_hover_text(about);
        let label = ui.label(if depth {
            say!("targets.range_m")
        } else {
            say!("targets.range")
        });
        let before = (request.low, request.high);
        let speed = f64::from((request.high - request.low).abs().max(1e-3)) * 0.01;
        let low = DragValue::new(&mut request.low)
            .speed(speed)
            .max_decimals(3);
        ui.add(low).labelled_by(label.id);
        let high = DragValue::new(&mut request.high)
            .speed(speed)
            .max_decimals(3);
        ui.add(high).labelled_by(label.id);
        if before != (request.low, request.high) {
            // Who sets an end does not want it to move.
            *automatic = false;
        }
        if ui
            .button(say!("targets.suit"))
            .on_hover_text(say!("targets.the_range_that_suits_the_format"))
            .clicked()
            && let Some(suited) = Inspection::suited(desc, request.pass, &request.target, far)
        {
            *request = suited;
            *automatic = false;
        }
    });
}

fn picture(
    editor: &mut Editor,
    ui: &mut Ui,
    desc: &PipelineDesc,
    request: &Inspection,
    bottom: f32,
) {
    let Some(texture) = editor.workbench.inspected() else {
        ui.label(RichText::new(say!("targets.the_next_frame_shows_it")).weak());
        return;
    };
    let format = desc.target(&request.target).map(|target| target.format);
    let (width, height) = (texture.width(), texture.height());
    if let Some(format) = format {
        let size = u64::from(width) * u64::from(height) * u64::from(format.bytes_per_texel());
        let text = format!("{width} x {height}  {}  {}", format.name(), bytes(size));
        ui.label(RichText::new(text).monospace().small());
    }
    let left = bottom - ui.cursor().top();
    let available = egui::vec2(ui.available_width(), left.max(LEAST_HEIGHT));
    let aspect = width as f32 / height.max(1) as f32;
    let size = if available.x / available.y.max(1.0) > aspect {
        egui::vec2(available.y * aspect, available.y)
    } else {
        egui::vec2(available.x, available.x / aspect)
    };
    if size.x < 1.0 || size.y < 1.0 {
        return;
    }
    let options = TextureOptions {
        magnification: egui::TextureFilter::Nearest,
        ..TextureOptions::LINEAR
    };
    let id = editor.screen.show(Place::Targets, &texture, options);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter().image(id, rect, whole, Color32::WHITE);
}
