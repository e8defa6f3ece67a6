//! The structures that the GPU reads, twins of those in `shaders/lib/scene.wgsl`.
//!
//! A test compares size and offset of every member with what naga computes for the WGSL.

use bytemuck::{Pod, Zeroable};
use glam::{Affine3A, Mat4, Vec3};

/// Camera and picture of a frame; `Frame` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct FrameData {
    /// World to view.
    pub view: Mat4,
    /// View to clip, reversed depth.
    pub projection: Mat4,
    /// World to clip.
    pub view_projection: Mat4,
    /// Clip to world.
    pub inverse_view_projection: Mat4,
    /// World, metres.
    pub camera_position: Vec3,
    /// Seconds since the scene began.
    pub time: f32,
    /// Output size, pixels.
    pub resolution: [f32; 2],
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres.
    pub far: f32,
    /// Lights in the light buffer.
    pub light_count: u32,
    /// Frames since the renderer began.
    pub frame_index: u32,
    /// Frames whose results `history` targets hold; 0: they hold zeros.
    pub history_frames: u32,
    /// Fills the structure to 16 bytes.
    pub padding: u32,
    /// World to clip in the frame before.
    pub previous_view_projection: Mat4,
    /// Radiance of all ambient lights together.
    pub sky: Vec3,
    /// Fills the structure to 16 bytes.
    pub reserved: u32,
}

/// One object; `Instance` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct InstanceData {
    /// Rows of the world matrix.
    pub world_rows: [[f32; 4]; 3],
    /// Index in the material buffer.
    pub material: u32,
    /// Where the indices of its mesh begin among those of all meshes.
    pub first_index: u32,
    /// What is added to each of these indices.
    pub base_vertex: u32,
    /// Fills the structure to 16 bytes.
    pub reserved: u32,
}

/// One object that a frame draws; `DrawnObject` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct DrawnObject {
    /// Index in the instance buffer.
    pub instance: u32,
    /// First entry of its list in the object-light buffer.
    pub first_light: u32,
    /// Length of that list.
    pub light_count: u32,
    /// Which of its pass's layers it is in.
    pub layer: u32,
}

/// One material; `Material` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MaterialData {
    /// Linear reflectance.
    pub base_color: Vec3,
    /// Number of the reflection model.
    pub model: u32,
    /// Specular reflectance.
    pub specular: Vec3,
    /// Alpha below which fragments are discarded.
    pub alpha_cutoff: f32,
    /// Radiance.
    pub emissive: Vec3,
    /// The share of what lies behind that it hides.
    pub opacity: f32,
    /// The model's parameters: exponent; or roughness along the tangent and across it.
    pub lobe: [f32; 2],
    /// Bucket and layer, or [`NO_TEXTURE`].
    pub base_color_texture: u32,
    /// Bucket and layer, or [`NO_TEXTURE`].
    pub normal_texture: u32,
}

/// One light; `Light` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightData {
    /// World, metres.
    pub position: Vec3,
    /// Metres.
    pub range: f32,
    /// Unit vector along which it shines.
    pub direction: Vec3,
    /// 0 point, 1 spot, 2 directional, 3 ambient.
    pub kind: u32,
    /// Colour times intensity.
    pub intensity: Vec3,
    /// 1 / (cos inner/2 − cos outer/2).
    pub angle_scale: f32,
    /// −cos(outer/2) · `angle_scale`.
    pub angle_offset: f32,
    /// Fills the structure to 16 bytes.
    pub reserved: [u32; 3],
}

/// One light volume to draw; `LightVolume` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightVolumeData {
    /// Rows of the matrix that carries the unit shape to the world.
    pub rows: [[f32; 4]; 3],
    /// Index in the light buffer.
    pub light: u32,
    /// Fills the structure to 16 bytes.
    pub reserved: [u32; 3],
}

/// A view of a `shadow` pass; `ShadowView` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShadowViewData {
    /// World to clip.
    pub view_projection: Mat4,
    /// Index of the light whose view it is; the largest number for none.
    pub light: u32,
    /// Layer of the depth target.
    pub layer: u32,
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres.
    pub far: f32,
}

/// "This material has no such texture."
pub const NO_TEXTURE: u32 = u32::MAX;

/// How many texture arrays a frame binds.
pub const TEXTURE_BUCKETS: usize = 6;

/// The rows of an affine matrix, as the shaders keep it.
pub fn matrix_rows(matrix: &Affine3A) -> [[f32; 4]; 3] {
    let m = matrix.matrix3;
    let t = matrix.translation;
    [
        [m.x_axis.x, m.y_axis.x, m.z_axis.x, t.x],
        [m.x_axis.y, m.y_axis.y, m.z_axis.y, t.y],
        [m.x_axis.z, m.y_axis.z, m.z_axis.z, t.z],
    ]
}

/// The texels of the second vertex stream.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct VertexAttributes {
    /// Object space.
    pub normal: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Object space; w is the bitangent's handedness.
    pub tangent: [f32; 4],
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::mem::{offset_of, size_of};

    /// Size and member offsets of a WGSL structure, by naga.
    fn layout(file: &str, name: &str) -> (u32, Vec<(String, u32)>) {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders/lib/");
        let text = std::fs::read_to_string(format!("{folder}{file}")).unwrap();
        let text = text
            .lines()
            .filter(|line| !line.starts_with('#'))
            .collect::<Vec<_>>()
            .join("\n");
        let module = naga::front::wgsl::parse_str(&text).unwrap();
        let (_, found) = module
            .types
            .iter()
            .find(|(_, t)| t.name.as_deref() == Some(name))
            .unwrap();
        let naga::TypeInner::Struct { members, span } = &found.inner else {
            panic!("no struct")
        };
        (
            *span,
            members
                .iter()
                .map(|m| (m.name.clone().unwrap(), m.offset))
                .collect(),
        )
    }

    fn check<T>(name: &str, offsets: &[(&str, usize)]) {
        check_in::<T>("scene.wgsl", name, offsets);
    }

    fn check_in<T>(file: &str, name: &str, offsets: &[(&str, usize)]) {
        let (span, members) = layout(file, name);
        assert_eq!(span as usize, size_of::<T>(), "size of {name}");
        for (member, offset) in offsets {
            let (_, found) = members.iter().find(|(m, _)| m == member).unwrap();
            assert_eq!(*found as usize, *offset, "{name}.{member}");
        }
    }

    #[test]
    fn rust_and_wgsl_agree_on_every_layout() {
        check::<FrameData>(
            "Frame",
            &[
                ("projection", offset_of!(FrameData, projection)),
                ("view_projection", offset_of!(FrameData, view_projection)),
                (
                    "inverse_view_projection",
                    offset_of!(FrameData, inverse_view_projection),
                ),
                ("camera_position", offset_of!(FrameData, camera_position)),
                ("time", offset_of!(FrameData, time)),
                ("resolution", offset_of!(FrameData, resolution)),
                ("near", offset_of!(FrameData, near)),
                ("far", offset_of!(FrameData, far)),
                ("light_count", offset_of!(FrameData, light_count)),
                ("frame_index", offset_of!(FrameData, frame_index)),
                ("history_frames", offset_of!(FrameData, history_frames)),
                (
                    "previous_view_projection",
                    offset_of!(FrameData, previous_view_projection),
                ),
                ("sky", offset_of!(FrameData, sky)),
            ],
        );
        check::<InstanceData>(
            "Instance",
            &[
                ("world_row_y", 16),
                ("material", offset_of!(InstanceData, material)),
                ("first_index", offset_of!(InstanceData, first_index)),
                ("base_vertex", offset_of!(InstanceData, base_vertex)),
            ],
        );
        check::<DrawnObject>(
            "DrawnObject",
            &[
                ("first_light", offset_of!(DrawnObject, first_light)),
                ("light_count", offset_of!(DrawnObject, light_count)),
                ("layer", offset_of!(DrawnObject, layer)),
            ],
        );
        check::<MaterialData>(
            "Material",
            &[
                ("model", offset_of!(MaterialData, model)),
                ("specular", offset_of!(MaterialData, specular)),
                ("alpha_cutoff", offset_of!(MaterialData, alpha_cutoff)),
                ("emissive", offset_of!(MaterialData, emissive)),
                ("opacity", offset_of!(MaterialData, opacity)),
                ("lobe", offset_of!(MaterialData, lobe)),
                (
                    "base_color_texture",
                    offset_of!(MaterialData, base_color_texture),
                ),
                ("normal_texture", offset_of!(MaterialData, normal_texture)),
            ],
        );
        check::<LightData>(
            "Light",
            &[
                ("range", offset_of!(LightData, range)),
                ("direction", offset_of!(LightData, direction)),
                ("kind", offset_of!(LightData, kind)),
                ("intensity", offset_of!(LightData, intensity)),
                ("angle_scale", offset_of!(LightData, angle_scale)),
                ("angle_offset", offset_of!(LightData, angle_offset)),
            ],
        );
        check::<LightVolumeData>(
            "LightVolume",
            &[("row_z", 32), ("light", offset_of!(LightVolumeData, light))],
        );
        check_in::<ShadowViewData>(
            "shadow.wgsl",
            "ShadowView",
            &[
                ("light", offset_of!(ShadowViewData, light)),
                ("layer", offset_of!(ShadowViewData, layer)),
                ("near", offset_of!(ShadowViewData, near)),
                ("far", offset_of!(ShadowViewData, far)),
            ],
        );
    }
}
