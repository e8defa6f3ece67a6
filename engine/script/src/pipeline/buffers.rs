//! Buffers of a pipeline, and the counters in them.

use lightbench_render::description::{BufferDesc, BufferSize, Counter, Named};

use super::builder::{Pipeline, method, not_taken, shader_name};
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// The most words that a buffer of fixed size may have: 256 MiB.
const MAX_WORDS: i64 = 64 << 20;

/// A buffer, as scripts hold it.
#[derive(Clone, Debug)]
struct Buffer {
    pipeline: Pipeline,
    name: String,
}

impl ScriptType for Buffer {
    const NAME: &'static str = "buffer";
}

pub(super) fn register(api: &mut Api) {
    api.object::<Buffer>();
    api.section("Buffers and counters");
    api.method(
        "buffer(name, words)",
        "Declares a buffer of so many 32-bit words. It keeps its contents from frame to frame, and \
         begins as zeros. `.per_pixel`, `.per_tile` and `.per_light` make it grow with the picture \
         or the scene.",
        |pipeline: Pipeline, arguments| {
            let mut name = String::new();
            pipeline.note(arguments, |builder, at| {
                name = arguments.text(0)?;
                shader_name(&name, "a buffer")?;
                not_taken(builder, &name)?;
                let words = arguments.whole(1, 1, MAX_WORDS)? as u32;
                builder.desc.buffers.push(BufferDesc {
                    name: name.clone(),
                    at,
                    size: BufferSize::Words(words),
                    grows_with: None,
                });
                Ok(())
            });
            Ok(Buffer { pipeline, name })
        },
    );
    change(
        api,
        "per_pixel()",
        "Gives the buffer its words for each pixel of the output.",
        |buffer, _| {
            buffer.size = BufferSize::PerPixel(words(buffer));
            Ok(())
        },
    );
    change(
        api,
        "per_tile(size)",
        "Gives the buffer its words for each tile of that many by that many pixels of the output.",
        |buffer, arguments| {
            buffer.size = BufferSize::PerTile {
                tile: arguments.whole(0, 1, 1024)? as u32,
                words: words(buffer),
            };
            Ok(())
        },
    );
    change(
        api,
        "per_light()",
        "Gives the buffer its words for each light of the scene, and for one more.",
        |buffer, _| {
            buffer.size = BufferSize::PerLight(words(buffer));
            Ok(())
        },
    );
    change(
        api,
        "grows_with(counter)",
        "Makes the buffer larger, and draws the frame again, when the counter says that it needed \
         more words than it has. Without it, a buffer of fixed size stays as it is.",
        |buffer, arguments| {
            buffer.grows_with = Some(Named {
                name: arguments.text(0)?,
                at: arguments.place(),
            });
            Ok(())
        },
    );
    method(
        api,
        "counter(name, buffer, word, description)",
        "Reads a word of a buffer back after each frame, counted from 0, as a whole number for \
         reports and the editor. It keeps the passes that write the buffer alive.",
        |builder, arguments, at| {
            let counter = Counter {
                name: arguments.text(0)?,
                at,
                buffer: arguments.text(1)?,
                word: arguments.whole(2, 0, MAX_WORDS)? as u32,
                description: arguments.text(3)?,
            };
            builder.desc.counters.push(counter);
            Ok(())
        },
    );
}

fn words(buffer: &BufferDesc) -> u32 {
    match buffer.size {
        BufferSize::Words(words) | BufferSize::PerPixel(words) | BufferSize::PerLight(words) => {
            words
        }
        BufferSize::PerTile { words, .. } => words,
    }
}

/// Registers a method of a buffer that gives the buffer back.
fn change(
    api: &mut Api,
    form: &str,
    about: &'static str,
    body: impl Fn(&mut BufferDesc, &Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    api.method(form, about, move |buffer: Buffer, arguments| {
        buffer.pipeline.note(arguments, |builder, _| {
            let buffers = builder.desc.buffers.iter_mut();
            // A buffer that could not be declared has its mistake already.
            match buffers.into_iter().find(|b| b.name == buffer.name) {
                Some(found) => body(found, arguments),
                None => Ok(()),
            }
        });
        Ok(buffer)
    });
}
