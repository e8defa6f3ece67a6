//! The four buffers of meshes: positions, other attributes, smooth groups, indices.
//!
//! Passes that need depth alone read positions alone, at a quarter of the memory traffic. Smooth
//! groups take one byte a vertex.

use lightbench_assets::Mesh;

use crate::gpu::Gpu;
use crate::gpu_data::VertexAttributes;

/// Spans of vertices begin at multiples of this, so that a copy of their smooth groups, of one byte
/// each, begins and ends where copies between buffers may.
const VERTEX_ALIGNMENT: u32 = wgpu::COPY_BUFFER_ALIGNMENT as u32;

const COPIES: wgpu::BufferUsages = wgpu::BufferUsages::COPY_SRC.union(wgpu::BufferUsages::COPY_DST);
const VERTICES: wgpu::BufferUsages = wgpu::BufferUsages::VERTEX
    .union(wgpu::BufferUsages::STORAGE)
    .union(COPIES);
const GROUPS: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE.union(COPIES);
const INDICES: wgpu::BufferUsages = wgpu::BufferUsages::INDEX
    .union(wgpu::BufferUsages::STORAGE)
    .union(COPIES);

/// A number of vertices and indices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    /// Vertices, a multiple of four.
    pub vertices: u32,
    /// Indices.
    pub indices: u32,
}

impl Extent {
    /// Both numbers together with those of another.
    pub fn and(self, other: Self) -> Self {
        Self {
            vertices: self.vertices.saturating_add(other.vertices),
            indices: self.indices.saturating_add(other.indices),
        }
    }

    /// Whether it has room for another.
    pub fn holds(self, other: Self) -> bool {
        other.vertices <= self.vertices && other.indices <= self.indices
    }

    /// A quarter more.
    pub fn with_spare(self) -> Self {
        let more = |count: u32| count.saturating_add(count / 4);
        Self {
            vertices: more(self.vertices) / VERTEX_ALIGNMENT * VERTEX_ALIGNMENT,
            indices: more(self.indices),
        }
    }

    /// The bytes of its longest buffer.
    pub fn largest_bytes(self) -> u64 {
        let attributes = u64::from(self.vertices) * size_of::<VertexAttributes>() as u64;
        attributes.max(u64::from(self.indices) * size_of::<u32>() as u64)
    }
}

/// A mesh's place in the buffers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// What lies before it.
    pub start: Extent,
    /// Its own length.
    pub length: Extent,
}

impl Span {
    /// The same, so far behind.
    pub fn behind(self, offset: Extent) -> Self {
        Self {
            start: offset.and(self.start),
            ..self
        }
    }
}

/// The buffers of all meshes, for passes that bind them.
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

/// The buffers with all that is done to them.
#[derive(Debug)]
pub struct MeshStorage {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    groups: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// What they have room for.
    pub capacity: Extent,
}

impl MeshStorage {
    /// The buffers.
    pub fn buffers(&self) -> MeshBuffers<'_> {
        MeshBuffers {
            positions: &self.positions,
            attributes: &self.attributes,
            groups: &self.groups,
            indices: &self.indices,
        }
    }

    /// Buffers with room for so much.
    pub fn new(gpu: &Gpu, capacity: Extent) -> Self {
        let buffer = |label, count: u32, size: usize, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                // The GPU can't bind nothing.
                size: u64::from(count.max(VERTEX_ALIGNMENT)) * size as u64,
                usage,
                mapped_at_creation: false,
            })
        };
        let Extent { vertices, indices } = capacity;
        Self {
            positions: buffer("positions", vertices, size_of::<[f32; 3]>(), VERTICES),
            attributes: buffer(
                "attributes",
                vertices,
                size_of::<VertexAttributes>(),
                VERTICES,
            ),
            groups: buffer("smooth groups", vertices, size_of::<u8>(), GROUPS),
            indices: buffer("indices", indices, size_of::<u32>(), INDICES),
            capacity,
        }
    }

    /// Each buffer, with the bytes of one of its elements and the part of a span that lies in it.
    fn parts(&self, span: Span) -> [(&wgpu::Buffer, std::ops::Range<u64>); 4] {
        let part = |start: u32, count: u32, size: usize| {
            let size = size as u64;
            u64::from(start) * size..(u64::from(start) + u64::from(count)) * size
        };
        let vertices = |size| part(span.start.vertices, span.length.vertices, size);
        let indices = part(span.start.indices, span.length.indices, size_of::<u32>());
        [
            (&self.positions, vertices(size_of::<[f32; 3]>())),
            (&self.attributes, vertices(size_of::<VertexAttributes>())),
            (&self.groups, vertices(size_of::<u8>())),
            (&self.indices, indices),
        ]
    }

    /// Writes meshes from a place on, and gives the bytes that travel.
    pub fn write(&self, gpu: &Gpu, start: Extent, meshes: &PackedMeshes) -> u64 {
        let span = Span {
            start,
            length: meshes.length(),
        };
        let contents: [&[u8]; 4] = [
            bytemuck::cast_slice(&meshes.positions),
            bytemuck::cast_slice(&meshes.attributes),
            &meshes.groups,
            bytemuck::cast_slice(&meshes.indices),
        ];
        for ((buffer, part), bytes) in self.parts(span).into_iter().zip(contents) {
            gpu.queue.write_buffer(buffer, part.start, bytes);
        }
        contents.iter().map(|bytes| bytes.len() as u64).sum()
    }

    /// Copies a mesh from other buffers.
    pub fn copy(&self, encoder: &mut wgpu::CommandEncoder, to: Span, other: &Self, from: Span) {
        let (targets, sources) = (self.parts(to), other.parts(from));
        for ((target, to), (source, from)) in targets.into_iter().zip(sources) {
            if from.end > from.start {
                let length = from.end - from.start;
                encoder.copy_buffer_to_buffer(source, from.start, target, to.start, length);
            }
        }
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.positions.size() + self.attributes.size() + self.groups.size() + self.indices.size()
    }
}

/// Meshes one after the other, as the buffers hold them.
#[derive(Debug, Default)]
pub struct PackedMeshes {
    positions: Vec<[f32; 3]>,
    attributes: Vec<VertexAttributes>,
    groups: Vec<u8>,
    indices: Vec<u32>,
}

impl PackedMeshes {
    /// Adds a mesh, with its smooth groups.
    pub fn mesh(&mut self, mesh: &Mesh) -> Span {
        let start = self.length();
        self.positions
            .extend(mesh.positions.iter().map(|p| p.to_array()));
        self.attributes
            .extend((0..mesh.positions.len()).map(|i| VertexAttributes {
                normal: mesh.normals[i].to_array(),
                uv: mesh.uvs[i].to_array(),
                tangent: mesh.tangents[i].to_array(),
            }));
        // A byte each: beyond 256, groups share numbers.
        self.groups
            .extend(mesh.smooth_groups().iter().map(|group| *group as u8));
        self.end(start, &mesh.indices)
    }

    /// Adds a shape, which has positions only; its attributes are padding that nothing reads.
    pub fn shape(&mut self, (positions, indices): &(Vec<glam::Vec3>, Vec<u32>)) -> Span {
        let start = self.length();
        self.positions
            .extend(positions.iter().map(|p| p.to_array()));
        self.end(start, indices)
    }

    fn end(&mut self, start: Extent, indices: &[u32]) -> Span {
        let vertices = self.positions.len();
        let vertices = vertices.next_multiple_of(VERTEX_ALIGNMENT as usize);
        self.positions.resize(vertices, [0.0; 3]);
        self.attributes
            .resize(vertices, bytemuck::Zeroable::zeroed());
        self.groups.resize(vertices, 0);
        self.indices.extend_from_slice(indices);
        let end = self.length();
        Span {
            start,
            length: Extent {
                vertices: end.vertices - start.vertices,
                indices: end.indices - start.indices,
            },
        }
    }

    /// How much they are together.
    pub fn length(&self) -> Extent {
        Extent {
            vertices: self.positions.len() as u32,
            indices: self.indices.len() as u32,
        }
    }
}
