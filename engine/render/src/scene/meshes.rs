//! All meshes in four buffers: positions, other attributes, smooth groups, indices.
//!
//! Passes that need depth alone read positions alone, at a quarter of the memory traffic. Smooth
//! groups take one byte a vertex and are found once for each mesh.

use std::collections::HashMap;

use lightbench_assets::{Assets, Mesh};
use lightbench_world::MeshId;

use crate::gpu::Gpu;
use crate::gpu_data::VertexAttributes;
use crate::volumes;

/// Where a mesh lies in the buffers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshRange {
    /// Its indices.
    pub indices: std::ops::Range<u32>,
    /// What is added to each index.
    pub base_vertex: i32,
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

/// The buffers of all meshes.
#[derive(Clone, Copy, Debug)]
pub struct MeshBuffers<'a> {
    /// Vertex positions.
    pub positions: &'a wgpu::Buffer,
    /// The rest of the vertices.
    pub attributes: &'a wgpu::Buffer,
    /// The smooth group of each vertex.
    pub groups: &'a wgpu::Buffer,
    /// Indices.
    pub indices: &'a wgpu::Buffer,
}

/// Meshes and shapes on the device.
pub struct MeshPool {
    gpu: Gpu,
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    groups: wgpu::Buffer,
    indices: wgpu::Buffer,
    ranges: Vec<MeshRange>,
    shapes: [MeshRange; 2],
    revisions: Option<Vec<u64>>,
    /// The smooth group of each vertex, by the revision of the mesh.
    known_groups: HashMap<u64, Vec<u8>>,
    /// How often the buffers were made.
    buffers: u64,
}

const VERTICES: wgpu::BufferUsages = wgpu::BufferUsages::VERTEX.union(wgpu::BufferUsages::STORAGE);
const INDICES: wgpu::BufferUsages = wgpu::BufferUsages::INDEX.union(wgpu::BufferUsages::STORAGE);

impl MeshPool {
    /// A pool that holds the shapes alone.
    pub fn new(gpu: &Gpu) -> Self {
        let empty = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("no meshes"),
                size: 4,
                usage,
                mapped_at_creation: false,
            })
        };
        Self {
            gpu: gpu.clone(),
            positions: empty(VERTICES),
            attributes: empty(VERTICES),
            groups: empty(wgpu::BufferUsages::STORAGE),
            indices: empty(INDICES),
            buffers: 1,
            ranges: Vec::new(),
            shapes: Default::default(),
            revisions: None,
            known_groups: HashMap::new(),
        }
    }

    /// Uploads all meshes if any of them changed.
    ///
    /// # Errors
    /// When they are larger than the device's buffers.
    pub fn sync(&mut self, assets: &Assets) -> Result<(), String> {
        let revisions: Vec<u64> = assets.meshes().iter().map(|entry| entry.revision).collect();
        if self.revisions.as_ref() == Some(&revisions) {
            return Ok(());
        }
        let mut packed = Packed::default();
        self.shapes = [
            packed.shape(&volumes::unit_sphere()),
            packed.shape(&volumes::unit_cone()),
        ];
        // Groups of meshes that are gone are forgotten.
        let mut known = std::mem::take(&mut self.known_groups);
        self.ranges.clear();
        for entry in assets.meshes() {
            let (mesh, revision) = (&entry.value, entry.revision);
            let groups = known.remove(&revision).unwrap_or_else(|| group_bytes(mesh));
            self.ranges.push(packed.mesh(mesh, &groups));
            self.known_groups.insert(revision, groups);
        }
        packed
            .groups
            .resize(packed.groups.len().next_multiple_of(4), 0);

        let largest = self.gpu.device.limits().max_buffer_size;
        let attribute_bytes = (packed.attributes.len() * size_of::<VertexAttributes>()) as u64;
        if attribute_bytes > largest {
            return Err(format!(
                "the scene's {} vertices take {} MiB in one buffer; this device allows {} MiB. Use fewer or smaller meshes",
                packed.attributes.len(),
                attribute_bytes >> 20,
                largest >> 20
            ));
        }
        use wgpu::util::DeviceExt as _;
        let upload = |label, contents: &[u8], usage| {
            self.gpu
                .device
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(label),
                    contents,
                    usage,
                })
        };
        self.positions = upload(
            "positions",
            bytemuck::cast_slice(&packed.positions),
            VERTICES,
        );
        self.attributes = upload(
            "attributes",
            bytemuck::cast_slice(&packed.attributes),
            VERTICES,
        );
        self.groups = upload("smooth groups", &packed.groups, wgpu::BufferUsages::STORAGE);
        self.indices = upload("indices", bytemuck::cast_slice(&packed.indices), INDICES);
        self.revisions = Some(revisions);
        self.buffers += 1;
        Ok(())
    }

    /// The buffers, for shaders that fetch vertices themselves.
    pub fn buffers(&self) -> MeshBuffers<'_> {
        MeshBuffers {
            positions: &self.positions,
            attributes: &self.attributes,
            groups: &self.groups,
            indices: &self.indices,
        }
    }

    /// A number that differs where the buffers are others than before.
    pub fn revision(&self) -> u64 {
        self.buffers
    }

    /// Uploads again at the next [`MeshPool::sync`].
    pub fn forget(&mut self) {
        self.revisions = None;
    }

    /// Where a mesh lies; none for an id that no mesh has.
    pub fn range(&self, mesh: MeshId) -> Option<&MeshRange> {
        self.ranges.get(mesh.0 as usize)
    }

    /// Where a shape lies; none for a mesh that is not there.
    pub fn shape(&self, shape: Shape) -> Option<&MeshRange> {
        match shape {
            Shape::Sphere => Some(&self.shapes[0]),
            Shape::Cone => Some(&self.shapes[1]),
            Shape::Mesh(mesh) => self.range(mesh),
        }
    }

    /// Binds the vertex streams and the indices.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, attributes: bool) {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        if attributes {
            pass.set_vertex_buffer(1, self.attributes.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.positions.size() + self.attributes.size() + self.groups.size() + self.indices.size()
    }
}

/// Meshes one after the other.
#[derive(Default)]
struct Packed {
    positions: Vec<[f32; 3]>,
    attributes: Vec<VertexAttributes>,
    groups: Vec<u8>,
    indices: Vec<u32>,
}

/// The smooth group of each vertex in a byte: beyond 256, groups share numbers.
fn group_bytes(mesh: &Mesh) -> Vec<u8> {
    let groups = mesh.smooth_groups();
    groups.iter().map(|group| *group as u8).collect()
}

impl Packed {
    fn mesh(&mut self, mesh: &Mesh, groups: &[u8]) -> MeshRange {
        let range = self.range(&mesh.indices);
        self.positions
            .extend(mesh.positions.iter().map(|p| p.to_array()));
        self.attributes
            .extend((0..mesh.positions.len()).map(|i| VertexAttributes {
                normal: mesh.normals[i].to_array(),
                uv: mesh.uvs[i].to_array(),
                tangent: mesh.tangents[i].to_array(),
            }));
        self.groups.extend_from_slice(groups);
        range
    }

    /// A shape has positions only; its attributes are padding that nothing reads.
    fn shape(&mut self, (positions, indices): &(Vec<glam::Vec3>, Vec<u32>)) -> MeshRange {
        let range = self.range(indices);
        self.positions
            .extend(positions.iter().map(|p| p.to_array()));
        self.attributes
            .resize(self.positions.len(), bytemuck::Zeroable::zeroed());
        self.groups.resize(self.positions.len(), 0);
        range
    }

    fn range(&mut self, indices: &[u32]) -> MeshRange {
        let first = self.indices.len() as u32;
        self.indices.extend_from_slice(indices);
        MeshRange {
            indices: first..self.indices.len() as u32,
            base_vertex: self.positions.len() as i32,
        }
    }
}
