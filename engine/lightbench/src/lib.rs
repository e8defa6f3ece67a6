//! Lightbench: one door to the whole workbench.
//!
//! Each part is a crate of its own and depends only on those before it:
//!
//! - [`world`]: entities in columns, and the systems over them;
//! - [`assets`]: meshes, materials, textures, and the files that they come from;
//! - [`render`]: a world drawn through a pipeline that is data;
//! - [`script`]: scenes and pipelines from Rhai files;
//! - [`lab`]: pictures, measurements, metrics, reports and lessons;
//! - [`course`]: hand-ins of lessons and their grading.
//!
//! A picture, from names to pixels:
//!
//! ```no_run
//! use lightbench::assets::{Progress, files::Files};
//! use lightbench::lab::capture::{CaptureOptions, capture};
//! use lightbench::render::{Gpu, GpuOptions, Renderer};
//! use lightbench::script::{Settings, load_pipeline, load_scene};
//!
//! let (files, settings, progress) = (Files::shipped(), Settings::new(), Progress::new());
//! let mut scene = load_scene(&files, "cornell_box", &settings, &progress)?;
//! let desc = load_pipeline(&files, "deferred_shading", &settings)?;
//! let mut renderer = Renderer::new(Gpu::open(&GpuOptions::default())?);
//! let mut pipeline = renderer.compiler().compile(&files, &desc)?;
//! let options = CaptureOptions { size: (640, 360), frame: 0 };
//! let picture = capture(&mut renderer, &mut scene, &mut pipeline, options, &progress)?;
//! assert_eq!(picture.output.pixels.len(), 640 * 360);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![warn(missing_docs)]

pub use lightbench_assets as assets;
pub use lightbench_course as course;
pub use lightbench_lab as lab;
pub use lightbench_render as render;
pub use lightbench_script as script;
pub use lightbench_world as world;
