//! The reference of pipeline files, of the shipped pipelines, of the shader library, of experiments
//! and of the checks of lessons, as Markdown.
//!
//! The pages are made from what the program itself knows: the functions that are registered with
//! their texts, what these functions say when they are called wrongly (`probe`), and the files of
//! the shader library. `lightbench docs` prints them; copies lie in the crate's `docs/` folder, and
//! a test holds them to what is made now.

mod abilities;
mod api;
pub(crate) mod calls;
mod completion;
mod definitions;
mod experiments;
mod functions;
mod lookup;
mod parts;
mod pipelines;
mod probe;
mod shaders;
#[cfg(test)]
mod tests;

pub use abilities::abilities_page as abilities;
pub use api::api;
pub use completion::{Candidate, Completions, complete};
pub use definitions::{Definitions, definitions};
pub use experiments::{checks, experiments};
pub use lookup::{Help, help, help_at};
pub use pipelines::pipelines;
pub use shaders::shaders;
