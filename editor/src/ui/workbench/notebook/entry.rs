//! One entry of the notebook and its file.

use lightbench::lab::diff::LdrDifference;
use lightbench::lab::report::{Adapter, Machine};
use serde_json::{Value, json};

use crate::ui::workbench::comparing::{Cost, Costs};

/// The version of the file's format.
const FORMAT: u64 = 1;

/// How far two pictures were apart, A being the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Mean of FLIP.
    pub flip_mean: f64,
    /// Its largest value.
    pub flip_max: f64,
    /// Mean of the squares, of display-ready values from 0 to 1.
    pub mse: f64,
    /// 10 log10 (1 / MSE); infinite for equal pictures.
    pub psnr_db: f64,
    /// The largest difference of a channel, in steps of 8 bits.
    pub max_steps: u8,
}

impl Difference {
    /// What an entry keeps of it.
    pub fn of(difference: &LdrDifference) -> Self {
        Self {
            flip_mean: difference.flip.mean,
            flip_max: difference.flip.max,
            mse: difference.srgb.mse,
            psnr_db: difference.srgb.psnr_db,
            max_steps: difference.srgb.max_steps,
        }
    }
}

/// One entry.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The name of its files, without an ending.
    pub name: String,
    /// When it was kept, RFC 3339.
    pub time: String,
    /// What a person wrote to it.
    pub note: String,
    /// What was on the screen; of two pipelines, with A.
    pub view: String,
    /// The same with B.
    pub view_b: Option<String>,
    /// What the picture shows of both.
    pub shown: String,
    /// What A cost, then B.
    pub costs: Vec<Costs>,
    /// How far the pictures were apart, where that was known.
    pub difference: Option<Difference>,
    /// On what it was measured.
    pub machine: Option<Machine>,
    /// By which driver.
    pub adapter: Adapter,
}

impl Entry {
    /// The name of its picture.
    pub fn picture(&self) -> String {
        format!("{}.png", self.name)
    }

    /// The text of its file.
    pub fn to_json(&self) -> String {
        let costs: Vec<Value> = self.costs.iter().map(cost_value).collect();
        let difference = self.difference.map(|d| {
            json!({
                "flip_mean": d.flip_mean,
                "flip_max": d.flip_max,
                "mse": d.mse,
                // JSON has no word for infinity: equal pictures have none.
                "psnr_db": d.psnr_db.is_finite().then_some(d.psnr_db),
                "max_steps": d.max_steps,
            })
        });
        let all = json!({
            "format": FORMAT,
            "time": self.time,
            "note": self.note,
            "view": self.view,
            "view_b": self.view_b,
            "shown": self.shown,
            "picture": self.picture(),
            "pipelines": costs,
            "difference": difference,
            "machine": self.machine,
            "adapter": self.adapter,
        });
        format!("{all:#}\n")
    }

    /// Reads the text of a file. `name` is that of the file, without its ending.
    ///
    /// # Errors
    /// A sentence that says what is not there.
    pub fn from_json(name: &str, text: &str) -> Result<Self, String> {
        let all: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
        match all["format"].as_u64() {
            Some(FORMAT) => {}
            Some(other) => {
                return Err(format!(
                    "it has version {other} of the format, and this program knows {FORMAT}"
                ));
            }
            None => return Err("it is no entry of a notebook: `format` is not there".to_owned()),
        }
        let text = |field: &str| {
            let text = all[field].as_str().map(str::to_owned);
            text.ok_or_else(|| format!("`{field}` is not there, or no text"))
        };
        let part = |field: &str| all.get(field).filter(|value| !value.is_null());
        let adapter = part("adapter").cloned().unwrap_or_default();
        let pipelines = all["pipelines"].as_array();
        Ok(Self {
            name: name.to_owned(),
            time: text("time")?,
            note: text("note").unwrap_or_default(),
            view: text("view")?,
            view_b: text("view_b").ok(),
            shown: text("shown").unwrap_or_default(),
            costs: pipelines.into_iter().flatten().map(cost_of).collect(),
            difference: part("difference").and_then(difference_of),
            machine: part("machine").and_then(|value| serde_json::from_value(value.clone()).ok()),
            adapter: serde_json::from_value(adapter)
                .map_err(|error| format!("`adapter` can't be read: {error}"))?,
        })
    }
}

fn difference_of(value: &Value) -> Option<Difference> {
    Some(Difference {
        flip_mean: value["flip_mean"].as_f64()?,
        flip_max: value["flip_max"].as_f64()?,
        mse: value["mse"].as_f64()?,
        psnr_db: value["psnr_db"].as_f64().unwrap_or(f64::INFINITY),
        max_steps: u8::try_from(value["max_steps"].as_u64()?).ok()?,
    })
}

fn cost_value(costs: &Costs) -> Value {
    let counters: Vec<Value> = costs
        .counters
        .iter()
        .map(|(what, value)| json!({ "what": what, "value": value }))
        .collect();
    json!({
        "pipeline": costs.pipeline,
        "title": costs.title,
        "settings": costs.settings,
        "gpu_ms": costs.gpu.median_ms,
        "gpu_frames": costs.gpu.frames,
        "cpu_ms": costs.cpu.median_ms,
        "cpu_frames": costs.cpu.frames,
        "calls": costs.calls,
        "moved_bytes": costs.moved_bytes,
        "target_bytes": costs.target_bytes,
        "lights": costs.lights,
        "counters": counters,
    })
}

fn cost_of(value: &Value) -> Costs {
    let text = |field: &str| value[field].as_str().unwrap_or_default().to_owned();
    let number = |field: &str| value[field].as_u64().unwrap_or_default();
    let time = |name: &str| Cost {
        median_ms: value[format!("{name}_ms")].as_f64(),
        frames: number(&format!("{name}_frames")) as usize,
    };
    let list = |field: &str| value[field].as_array().into_iter().flatten();
    Costs {
        pipeline: text("pipeline"),
        title: text("title"),
        settings: list("settings")
            .filter_map(|setting| setting.as_str().map(str::to_owned))
            .collect(),
        gpu: time("gpu"),
        cpu: time("cpu"),
        calls: number("calls"),
        moved_bytes: number("moved_bytes"),
        target_bytes: number("target_bytes"),
        lights: number("lights") as u32,
        counters: list("counters")
            .filter_map(|counter| {
                let what = counter["what"].as_str()?.to_owned();
                Some((what, u32::try_from(counter["value"].as_u64()?).ok()?))
            })
            .collect(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    pub(in crate::ui::workbench::notebook) fn entry() -> Entry {
        let time = Cost {
            median_ms: Some(1.25),
            frames: 7,
        };
        Entry {
            name: "2026-01-02T03-04-05Z".to_owned(),
            time: "2026-01-02T03:04:05Z".to_owned(),
            note: "why | is it\n\"slower\"?".to_owned(),
            view: "lightbench-view-1 scene=a pipeline=p".to_owned(),
            view_b: Some("lightbench-view-1 scene=a pipeline=q".to_owned()),
            shown: "Split".to_owned(),
            costs: vec![Costs {
                pipeline: "p".to_owned(),
                title: "The P".to_owned(),
                settings: vec!["exposure=1".to_owned()],
                gpu: time,
                calls: 12,
                moved_bytes: 5_000_000_000,
                target_bytes: 9,
                lights: 64,
                counters: vec![("pixels over".to_owned(), 3)],
                ..Costs::default()
            }],
            difference: Some(Difference {
                flip_mean: 0.1,
                flip_max: 1.0 / 3.0,
                mse: 1e-7,
                psnr_db: f64::INFINITY,
                max_steps: 255,
            }),
            machine: Some(Machine::default()),
            adapter: Adapter::default(),
        }
    }

    #[test]
    fn an_entry_reads_back() {
        let entry = entry();
        let text = entry.to_json();
        assert_eq!(Entry::from_json(&entry.name, &text).unwrap(), entry);
        let plain = Entry {
            view_b: None,
            difference: None,
            machine: None,
            ..entry
        };
        let read = Entry::from_json(&plain.name, &plain.to_json()).unwrap();
        assert_eq!(read, plain);
    }

    #[test]
    fn damaged_files_are_refused() {
        let text = entry().to_json();
        for (damaged, words) in [
            (String::new(), "EOF"),
            ("[]".to_owned(), "`format` is not there"),
            (text.replace("\"format\": 1", "\"format\": 2"), "version 2"),
            (text.replace("\"view\":", "\"other\":"), "`view`"),
            (text[..text.len() / 2].to_owned(), ""),
        ] {
            let error = Entry::from_json("x", &damaged).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
