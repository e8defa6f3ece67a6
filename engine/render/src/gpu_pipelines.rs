//! The GPU pipelines of each kind of pass.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::volumes::Case;

/// Whether a GPU pipeline was drawn with before. Many drivers compile it only then, which delays
/// that frame. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Warmth(Arc<AtomicBool>);

impl Warmth {
    /// Whether nobody has drawn with it yet.
    pub fn is_cold(&self) -> bool {
        !self.0.load(Ordering::Relaxed)
    }

    /// Notes that somebody draws with it.
    pub fn warm(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// A render pipeline, and whether it reads the second vertex stream.
#[derive(Clone, Debug)]
pub struct DrawPipeline {
    /// The pipeline.
    pub pipeline: wgpu::RenderPipeline,
    /// Whether normals, texture coordinates and tangents must be bound.
    pub attributes: bool,
    /// Whether it was drawn with.
    pub warmth: Warmth,
}

impl DrawPipeline {
    /// One that was never drawn with.
    pub fn new(pipeline: wgpu::RenderPipeline, attributes: bool) -> Self {
        Self {
            pipeline,
            attributes,
            warmth: Warmth::default(),
        }
    }

    /// Draws with it from here on.
    pub fn set(&self, render_pass: &mut wgpu::RenderPass<'_>) {
        self.warmth.warm();
        render_pass.set_pipeline(&self.pipeline);
    }
}

/// A compute pipeline.
#[derive(Clone, Debug)]
pub struct ComputePipeline {
    /// The pipeline.
    pub pipeline: wgpu::ComputePipeline,
    /// Its workgroup size.
    pub workgroup: [u32; 3],
    /// Whether it was run.
    pub warmth: Warmth,
}

impl ComputePipeline {
    /// Computes with it from here on.
    pub fn set(&self, compute_pass: &mut wgpu::ComputePass<'_>) {
        self.warmth.warm();
        compute_pass.set_pipeline(&self.pipeline);
    }
}

/// The GPU pipelines of a pass.
#[derive(Debug)]
pub enum PassPipelines {
    /// The pass needs none: it clears, copies or resolves.
    None,
    /// Meshes.
    Geometry(GeometryPipelines),
    /// Light volumes.
    Lights(LightsPipelines),
    /// Meshes as lights see them.
    Shadow(GeometryPipelines),
    /// One triangle.
    Fullscreen(DrawPipeline),
    /// A dispatch.
    Compute(ComputePipeline),
    /// One triangle a mip level.
    Mips {
        /// The pipeline.
        pipeline: DrawPipeline,
        /// Layout of the group that holds the larger level.
        layout: wgpu::BindGroupLayout,
    },
}

/// How a `lights` pass draws.
#[derive(Debug)]
pub struct LightsPipelines {
    /// For each array of lights; one where there are no arrays.
    pub arrays: Vec<LightPipelines>,
    /// With a stencil technique: what writes marks.
    pub stencil: Option<StencilPipelines>,
}

/// What writes the marks of light volumes into stencil.
#[derive(Debug)]
pub struct StencilPipelines {
    /// Marks the pixels of a sphere or cone.
    pub mark: DrawPipeline,
    /// Counts the faces of a closed mesh behind the scene: more back faces than front ones mean that
    /// the scene lies inside.
    pub count: DrawPipeline,
    /// Sets all marks to the reference.
    pub wipe: DrawPipeline,
}

/// The ways in which a light's volume is drawn.
#[derive(Debug)]
pub struct LightPipelines {
    /// Back faces, lighting what is nearer: works with the camera inside.
    pub back: DrawPipeline,
    /// Front faces, lighting what is farther: works where the far plane cuts the volume.
    pub front: DrawPipeline,
    /// Every pixel: for lights without a volume, and where neither of the two works.
    pub screen: DrawPipeline,
    /// Pixels that are marked in stencil, or with the inverse scheme those that are not.
    pub marked: Option<DrawPipeline>,
    /// Pixels that are counted to lie inside a closed mesh; each is shaded once and loses its count.
    pub counted: Option<DrawPipeline>,
}

impl LightPipelines {
    /// The one for a case without stencil.
    pub fn of(&self, case: Case) -> &DrawPipeline {
        match case {
            Case::Back => &self.back,
            Case::Front => &self.front,
            Case::Screen => &self.screen,
        }
    }
}

/// How a `geometry` pass draws.
#[derive(Debug)]
pub struct GeometryPipelines {
    /// By [`crate::variant::Variant::index`]; none for variants that nobody asked for yet.
    pub variants: Vec<Option<DrawPipeline>>,
    /// With stencil masks: what marks the pixels inside a light's volume.
    pub mask: Option<MaskPipelines>,
    /// Whether the vertex stage fetches vertices itself: then draws are not indexed.
    pub pull_vertices: bool,
}

/// Marks the pixels whose surface lies inside a volume, in two steps.
#[derive(Debug)]
pub struct MaskPipelines {
    /// Back faces behind the scene mark.
    pub back: DrawPipeline,
    /// Front faces behind the scene take the mark away.
    pub front: DrawPipeline,
    /// The whole screen: marks all, or with the reference 0 wipes all marks.
    pub screen: DrawPipeline,
}
