//! All meshes in four buffers, of which only new meshes travel.
//!
//! New meshes go behind those that are there. Meshes that nobody wants any more leave their place
//! unused, until the buffers are full or for the most part unused: then the device itself copies
//! what is still wanted to new buffers.

use std::collections::{HashMap, HashSet};

use lightbench_assets::Assets;
use lightbench_world::MeshId;

use super::Uploads;
use super::mesh_buffers::{Extent, MeshBuffers, MeshStorage, PackedMeshes, Span};
use crate::gpu::Gpu;
use crate::volumes;

/// Where a mesh lies in the buffers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshRange {
    /// Its indices.
    pub indices: std::ops::Range<u32>,
    /// What is added to each index.
    pub base_vertex: i32,
}

impl From<Span> for MeshRange {
    fn from(span: Span) -> Self {
        let first = span.start.indices;
        Self {
            indices: first..first + span.length.indices,
            base_vertex: span.start.vertices as i32,
        }
    }
}

/// The shapes of light volumes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// A sphere that encloses the unit sphere.
    Sphere,
    /// A cone with its apex at the origin, along −z, of length 1 and base radius 1.
    Cone,
    /// A mesh of the scene.
    Mesh(MeshId),
}

/// Meshes and shapes on the device.
pub struct MeshPool {
    gpu: Gpu,
    storage: MeshStorage,
    /// Where the unused rest of the buffers begins.
    used: Extent,
    /// What lies in the buffers, by the revision of the mesh, with what nobody wants any more.
    spans: HashMap<u64, Span>,
    shapes: [Span; 2],
    /// In the order of the scene's meshes.
    ranges: Vec<MeshRange>,
    shape_ranges: [MeshRange; 2],
    revisions: Vec<u64>,
    /// How often buffers or ranges changed.
    changes: u64,
}

impl MeshPool {
    /// A pool that holds the shapes alone.
    pub fn new(gpu: &Gpu) -> Self {
        let mut packed = PackedMeshes::default();
        let shapes = [
            packed.shape(&volumes::unit_sphere()),
            packed.shape(&volumes::unit_cone()),
        ];
        let storage = MeshStorage::new(gpu, packed.length());
        storage.write(gpu, Extent::default(), &packed);
        Self {
            gpu: gpu.clone(),
            storage,
            used: packed.length(),
            spans: HashMap::new(),
            shapes,
            ranges: Vec::new(),
            shape_ranges: shapes.map(MeshRange::from),
            revisions: Vec::new(),
            changes: 1,
        }
    }

    /// Uploads the meshes that are not on the device yet.
    ///
    /// # Errors
    /// When they are larger than the device's buffers.
    pub fn sync(&mut self, assets: &Assets, uploads: &mut Uploads) -> Result<(), String> {
        let revisions = || assets.meshes().iter().map(|entry| entry.revision);
        if revisions().eq(self.revisions.iter().copied()) {
            return Ok(());
        }
        let mut packed = PackedMeshes::default();
        let mut new: HashMap<u64, Span> = HashMap::new();
        let mut old = Vec::new();
        let mut seen = HashSet::new();
        for entry in assets.meshes() {
            let revision = entry.revision;
            if !seen.insert(revision) {
                continue;
            }
            if self.spans.contains_key(&revision) {
                old.push(revision);
            } else {
                new.insert(revision, packed.mesh(&entry.value));
            }
        }
        let stays = self
            .shapes
            .iter()
            .chain(old.iter().map(|old| &self.spans[old]));
        let stays = stays.fold(Extent::default(), |sum, span| sum.and(span.length));
        let wanted = stays.and(packed.length());
        let fits = self.storage.capacity.holds(self.used.and(packed.length()));
        if !fits || self.is_too_large_for(wanted) {
            self.move_to(self.capacity_for(wanted)?, &old);
        }
        uploads.meshes += new.len() as u64;
        uploads.bytes += self.storage.write(&self.gpu, self.used, &packed);
        for (revision, span) in new {
            self.spans.insert(revision, span.behind(self.used));
        }
        self.used = self.used.and(packed.length());

        self.ranges.clear();
        let spans = &self.spans;
        self.ranges.extend(revisions().map(|revision| {
            spans
                .get(&revision)
                .map(|span| MeshRange::from(*span))
                .unwrap_or_default()
        }));
        self.revisions.clear();
        self.revisions.extend(revisions());
        self.changes += 1;
        Ok(())
    }

    /// The size of new buffers for so much: with room for changes to come, unless these are the first
    /// meshes, of which many never change.
    fn capacity_for(&self, wanted: Extent) -> Result<Extent, String> {
        let largest = self.gpu.device.limits().max_buffer_size;
        let bytes = wanted.largest_bytes();
        if bytes > largest {
            return Err(format!(
                "the scene's {} vertices and {} indices take {} MiB in one buffer; this device allows {} MiB. \
                 Use fewer or smaller meshes",
                wanted.vertices,
                wanted.indices,
                bytes >> 20,
                largest >> 20
            ));
        }
        let spare = wanted.with_spare();
        let first = self.spans.is_empty();
        Ok(match first || spare.largest_bytes() > self.bindable() {
            true => wanted,
            false => spare,
        })
    }

    /// Whether so much should have smaller buffers: most of these is unused, or no shader could bind
    /// them although it could bind the others.
    fn is_too_large_for(&self, wanted: Extent) -> bool {
        let (bytes, now) = (
            wanted.largest_bytes(),
            self.storage.capacity.largest_bytes(),
        );
        bytes < now / 2 || bytes <= self.bindable() && self.bindable() < now
    }

    /// The bytes of one buffer that shaders which fetch vertices themselves can bind.
    fn bindable(&self) -> u64 {
        let limits = self.gpu.device.limits();
        limits
            .max_buffer_size
            .min(limits.max_storage_buffer_binding_size)
    }

    /// Goes on with new buffers, to which the shapes and the meshes of these revisions are copied.
    fn move_to(&mut self, capacity: Extent, revisions: &[u64]) {
        let storage = MeshStorage::new(&self.gpu, capacity);
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut used = Extent::default();
        let mut copy = |from: Span| {
            let to = Span {
                start: used,
                length: from.length,
            };
            storage.copy(&mut encoder, to, &self.storage, from);
            used = used.and(from.length);
            to
        };
        self.shapes = self.shapes.map(&mut copy);
        let spans = revisions.iter().map(|old| (*old, copy(self.spans[old])));
        self.spans = spans.collect();
        self.gpu.queue.submit([encoder.finish()]);
        self.storage = storage;
        self.used = used;
        self.shape_ranges = self.shapes.map(MeshRange::from);
    }

    /// The buffers, for shaders that fetch vertices themselves.
    pub fn buffers(&self) -> MeshBuffers<'_> {
        self.storage.buffers()
    }

    /// A number that differs where the buffers, or the places of meshes in them, are others than
    /// before.
    pub fn revision(&self) -> u64 {
        self.changes
    }

    /// Where a mesh lies; none for an id that no mesh has.
    pub fn range(&self, mesh: MeshId) -> Option<&MeshRange> {
        self.ranges.get(mesh.0 as usize)
    }

    /// Where a shape lies; none for a mesh that is not there.
    pub fn shape(&self, shape: Shape) -> Option<&MeshRange> {
        match shape {
            Shape::Sphere => Some(&self.shape_ranges[0]),
            Shape::Cone => Some(&self.shape_ranges[1]),
            Shape::Mesh(mesh) => self.range(mesh),
        }
    }

    /// Binds the vertex streams and the indices.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, attributes: bool) {
        let buffers = self.buffers();
        pass.set_vertex_buffer(0, buffers.positions.slice(..));
        if attributes {
            pass.set_vertex_buffer(1, buffers.attributes.slice(..));
        }
        pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.storage.bytes()
    }
}
