//! Reads what a pipeline keeps in its buffers.

use lightbench::render::{Pipeline, Renderer};

/// Words in a row of a target that shows a buffer.
const WIDTH: u32 = 1024;

/// The name of the pipeline that [`opened`] writes.
pub const OPENED: &str = "opened";

/// Copies a buffer to a target, word by word.
const COPY: &str = "@group(1) @binding(0) var<storage, read> words: array<u32>;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4u {
    let index = u32(pixel.y) * 1024u + u32(pixel.x);
    if index >= arrayLength(&words) {
        return vec4u(0u);
    }
    return vec4u(words[index], 0u, 0u, 0u);
}";

/// The files of a project whose pipeline [`OPENED`] is another one that also shows some of its buffers,
/// so many words of each. The words must be below 2²⁴, which is what single floats can count.
pub fn opened(pipeline: &str, buffers: &[(&str, u32)]) -> [(&'static str, String); 2] {
    let mut text = format!("import \"{pipeline}\" as base;\nlet p = derive(\"Opened\");\n");
    for (buffer, words) in buffers {
        let rows = words.div_ceil(WIDTH);
        text += &format!(
            "p.target(\"words_of_{buffer}\", \"r32uint\").size({WIDTH}, {rows});
            p.fullscreen(\"show_{buffer}\").shader(\"shaders/copy_words.wgsl\")
                .reads(\"{buffer}\", \"words\").writes(\"words_of_{buffer}\");\n"
        );
    }
    text += "p";
    [
        ("scripts/pipelines/opened.rhai", text),
        ("shaders/copy_words.wgsl", COPY.to_owned()),
    ]
}

/// The words of a buffer after the last frame of the pipeline [`OPENED`].
pub fn words(renderer: &Renderer, pipeline: &Pipeline, buffer: &str) -> Vec<u32> {
    let target = format!("words_of_{buffer}");
    let image = renderer.read_target(pipeline, &target).unwrap();
    image.texels.iter().map(|texel| texel[0] as u32).collect()
}
