//! A storage buffer with a copy on the CPU, of which only changed rows travel.

use bytemuck::Pod;

use crate::gpu::Gpu;

/// Rows of `T` in a storage buffer.
pub struct RowBuffer<T> {
    label: &'static str,
    buffer: wgpu::Buffer,
    rows: Vec<T>,
    /// Runs of rows that the device does not have yet, in ascending order.
    dirty: Vec<std::ops::Range<usize>>,
    uploaded: u64,
}

impl<T: Pod + PartialEq> RowBuffer<T> {
    /// An empty buffer with room for one row: the GPU can't bind nothing.
    pub fn new(gpu: &Gpu, label: &'static str) -> Self {
        Self {
            label,
            buffer: allocate::<T>(gpu, label, 1),
            rows: Vec::new(),
            dirty: Vec::new(),
            uploaded: 0,
        }
    }

    /// The buffer.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// The rows.
    pub fn rows(&self) -> &[T] {
        &self.rows
    }

    /// Sets the number of rows; new ones are zero and count as changed.
    pub fn resize(&mut self, len: usize) {
        let old = self.rows.len();
        self.rows.resize(len, T::zeroed());
        for run in &mut self.dirty {
            run.end = run.end.min(len);
        }
        self.dirty.retain(|run| run.start < run.end);
        if len > old {
            self.mark(old..len);
        }
    }

    /// Sets a row; nothing travels if it has that value already.
    pub fn set(&mut self, row: usize, value: T) {
        if let Some(place) = self.rows.get_mut(row)
            && *place != value
        {
            *place = value;
            self.mark(row..row + 1);
        }
    }

    /// Replaces all rows.
    pub fn replace(&mut self, rows: impl Iterator<Item = T>) {
        self.rows.clear();
        self.rows.extend(rows);
        self.dirty.clear();
        self.mark(0..self.rows.len());
    }

    /// Replaces all rows unless they are the same.
    pub fn replace_if_changed(&mut self, rows: &[T]) {
        if self.rows != rows {
            self.replace(rows.iter().copied());
        }
    }

    fn mark(&mut self, run: std::ops::Range<usize>) {
        if run.is_empty() {
            return;
        }
        // Rows mostly come in order: then the last run grows.
        match self.dirty.last_mut() {
            Some(last) if last.start <= run.start && run.start <= last.end => {
                last.end = last.end.max(run.end)
            }
            _ => self.dirty.push(run),
        }
    }

    /// Writes the changed rows. Returns whether the buffer had to be replaced by a larger one.
    pub fn flush(&mut self, gpu: &Gpu) -> bool {
        let needed = self.rows.len().max(1);
        let capacity = self.buffer.size() as usize / size_of::<T>();
        let grown = needed > capacity;
        if grown {
            self.buffer = allocate::<T>(gpu, self.label, needed.next_power_of_two());
            self.dirty.clear();
            self.dirty.push(0..self.rows.len());
        }
        for run in self.dirty.drain(..) {
            let bytes: &[u8] = bytemuck::cast_slice(&self.rows[run.clone()]);
            gpu.queue
                .write_buffer(&self.buffer, (run.start * size_of::<T>()) as u64, bytes);
            self.uploaded += bytes.len() as u64;
        }
        grown
    }

    /// Bytes written since the last call.
    pub fn take_uploaded(&mut self) -> u64 {
        std::mem::take(&mut self.uploaded)
    }
}

fn allocate<T>(gpu: &Gpu, label: &str, rows: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: (rows * size_of::<T>()) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
