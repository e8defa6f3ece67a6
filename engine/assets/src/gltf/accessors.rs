//! Numbers out of buffers, with every bound checked (glTF 2.0, section 3.6).

use ::gltf::Accessor;
use ::gltf::accessor::{DataType, Dimensions};

use super::Document;
use crate::obj::Problem;

/// More elements than any accessor may have, so that a short file can't ask for endless zeros.
const MAX_COUNT: usize = 1 << 26;

impl Document {
    /// The elements of an accessor as floats, `N` each. Normalised whole numbers become fractions
    /// (section 3.11).
    pub(super) fn floats<const N: usize>(
        &self,
        accessor: &Accessor,
    ) -> Result<Vec<[f32; N]>, Problem> {
        let (kind, normalized) = (accessor.data_type(), accessor.normalized());
        let elements = self.elements::<N>(accessor)?;
        let read = |bytes: &[u8]| number(bytes, kind, normalized) as f32;
        let size = kind.size();
        let element =
            |bytes: &[u8]| std::array::from_fn(|at| read(&bytes[at * size..(at + 1) * size]));
        Ok(elements
            .chunks_exact((size * N).max(1))
            .map(element)
            .collect())
    }

    /// The elements of an accessor of whole numbers.
    pub(super) fn indices(&self, accessor: &Accessor) -> Result<Vec<u32>, Problem> {
        let kind = accessor.data_type();
        if !matches!(kind, DataType::U8 | DataType::U16 | DataType::U32) {
            let number = accessor.index();
            return Err(self.problem(format!("accessor {number} holds no vertex numbers")));
        }
        let elements = self.elements::<1>(accessor)?;
        let read = |bytes: &[u8]| number(bytes, kind, false) as u32;
        Ok(elements.chunks_exact(kind.size()).map(read).collect())
    }

    /// The bytes of an accessor's elements, one behind the other.
    fn elements<const N: usize>(&self, accessor: &Accessor) -> Result<Vec<u8>, Problem> {
        let number = accessor.index();
        let wrong = |what: String| self.problem(format!("accessor {number} {what}"));
        let dimensions = match accessor.dimensions() {
            Dimensions::Scalar => 1,
            Dimensions::Vec2 => 2,
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 => 4,
            _ => 0,
        };
        if dimensions != N {
            return Err(wrong(format!("must hold {N} numbers an element")));
        }
        let count = accessor.count();
        if count > MAX_COUNT {
            return Err(wrong(format!("says {count} elements, over {MAX_COUNT}")));
        }
        let size = accessor.data_type().size() * N;
        let mut elements = Vec::new();
        match accessor.view() {
            Some(view) => {
                let bytes = self.view(&view).map_err(&wrong)?;
                let stride = view.stride().unwrap_or(size).max(size);
                let last = count.saturating_sub(1).checked_mul(stride);
                let end = last
                    .and_then(|last| last.checked_add(accessor.offset())?.checked_add(size))
                    .filter(|&end| end <= bytes.len() || count == 0);
                if end.is_none() {
                    return Err(wrong(format!(
                        "reaches beyond its buffer view: {count} elements of {size} bytes, one \
                         every {stride}, from byte {} of {}",
                        accessor.offset(),
                        bytes.len()
                    )));
                }
                elements.reserve(count * size);
                for element in 0..count {
                    let first = accessor.offset() + element * stride;
                    elements.extend_from_slice(&bytes[first..first + size]);
                }
            }
            None if accessor.sparse().is_none() => {
                return Err(wrong(
                    "has no buffer view, so there is nothing in it".to_owned(),
                ));
            }
            None => elements.resize(count * size, 0),
        }
        self.replace_sparse(accessor, size, &mut elements)
            .map_err(wrong)?;
        Ok(elements)
    }

    /// Overwrites the elements that a sparse accessor lists (section 3.6.2.3).
    fn replace_sparse(
        &self,
        accessor: &Accessor,
        size: usize,
        elements: &mut [u8],
    ) -> Result<(), String> {
        let Some(sparse) = accessor.sparse() else {
            return Ok(());
        };
        let (indices, values) = (sparse.indices(), sparse.values());
        let kind = match indices.index_type() {
            ::gltf::accessor::sparse::IndexType::U8 => DataType::U8,
            ::gltf::accessor::sparse::IndexType::U16 => DataType::U16,
            ::gltf::accessor::sparse::IndexType::U32 => DataType::U32,
        };
        let places = self.view(&indices.view())?;
        let places = places.get(indices.offset()..).unwrap_or_default();
        let new = self.view(&values.view())?;
        let new = new.get(values.offset()..).unwrap_or_default();
        let listed = places.chunks_exact(kind.size()).zip(new.chunks_exact(size));
        if listed.len() < sparse.count() {
            return Err("lists more sparse elements than its buffer views hold".to_owned());
        }
        for (place, value) in listed.take(sparse.count()) {
            let first = (number(place, kind, false) as usize).checked_mul(size);
            let element = first.and_then(|first| elements.get_mut(first..first + size));
            let element = element.ok_or("overwrites an element that it does not have")?;
            element.copy_from_slice(value);
        }
        Ok(())
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, view: &::gltf::buffer::View) -> Result<&[u8], String> {
        let buffer = self.buffers.get(view.buffer().index());
        let end = view.offset().checked_add(view.length());
        buffer
            .and_then(|bytes| bytes.get(view.offset()..end?))
            .ok_or_else(|| format!("uses buffer view {}, which leaves its buffer", view.index()))
    }
}

/// One number. Little-endian, as all of glTF.
fn number(bytes: &[u8], kind: DataType, normalized: bool) -> f64 {
    let at = |index: usize| bytes.get(index).copied().unwrap_or_default();
    let (value, greatest) = match kind {
        DataType::I8 => (f64::from(at(0) as i8), 127.0),
        DataType::U8 => (f64::from(at(0)), 255.0),
        DataType::I16 => (f64::from(i16::from_le_bytes([at(0), at(1)])), 32767.0),
        DataType::U16 => (f64::from(u16::from_le_bytes([at(0), at(1)])), 65535.0),
        DataType::U32 => {
            let value = u32::from_le_bytes([at(0), at(1), at(2), at(3)]);
            (f64::from(value), 4_294_967_295.0)
        }
        DataType::F32 => {
            let value = f32::from_le_bytes([at(0), at(1), at(2), at(3)]);
            return f64::from(value);
        }
    };
    if normalized {
        (value / greatest).max(-1.0)
    } else {
        value
    }
}
