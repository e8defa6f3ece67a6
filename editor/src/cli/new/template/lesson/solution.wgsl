// The function, written.
#define_import_path exercise

// TASK ramp: from dark to light. u goes from 0 at the left to 1 at the right.
fn ramp(u: f32) -> f32 {
    return u;
}
