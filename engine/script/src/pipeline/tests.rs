#![allow(clippy::unwrap_used)]

use super::*;
use crate::testing::project;

fn load(text: &str) -> Result<PipelineDesc, Problems> {
    let (_folder, files) = project(&[("scripts/pipelines/test.rhai", text)]);
    load_pipeline(&files, "test", &Settings::new())
}

const DEFERRED: &str = r#"
import "parts/out" as out;

let p = pipeline("Deferred");
p.describe("Lights later.");
p.target("depth", "depth32float");
p.target("g_albedo", "rgba8unorm-srgb").scale(0.5);
p.target("hdr", "rgba16float").size(512, 256);

if p.switch("prepass", true) {
    p.geometry("early")
        .shader("shaders/depth.wgsl")
        .depth("depth").clear(0);
}
p.geometry("g_buffer")
    .shader("shaders/g.wgsl").define("FANCY")
    .draws("opaque")
    .writes("hdr").clear(0, 0, 0, 1.0)
    .writes("g_albedo").clear(0, 0, 0, 0)
    .depth("depth").test("equal").read_only();

p.lights("lights")
    .shader("shaders/l.wgsl")
    .reads("g_albedo").reads("depth", "scene_depth")
    .writes("hdr").blend("add")
    .depth("depth");
out::add(p, "hdr");
p
"#;

const OUT: &str = r#"
fn add(p, hdr) {
    let exposure = p.number("exposure", 0, -10, 10);
    p.about("exposure", "Brightness in stops", "EV");
    p.choice("curve", ["hable", "linear"]);
    p.target("output", "rgba8unorm");
    p.fullscreen("output").shader("shaders/output.wgsl").reads(hdr).writes("output");
    p.hdr(hdr);
    p.show("output");
}
"#;

#[test]
fn a_whole_pipeline() {
    let (_folder, files) = project(&[
        ("scripts/pipelines/deferred.rhai", DEFERRED),
        ("scripts/pipelines/parts/out.rhai", OUT),
    ]);
    let settings = Settings::new()
        .with("exposure", "1.5")
        .with("curve", "linear");
    let desc = match load_pipeline(&files, "deferred", &settings) {
        Ok(desc) => desc,
        Err(problems) => panic!("{problems}"),
    };
    println!("{desc:#?}");
}
