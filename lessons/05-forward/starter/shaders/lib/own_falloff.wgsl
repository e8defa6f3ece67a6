// How light gets weaker with the distance.
//
// The function runs and gives nothing. Your numbers are in README.md.
#define_import_path own_falloff

// TASK falloff: what arrives on a surface that faces a lamp, for each unit of its intensity, in 1/m².
//
// distance:  from the lamp, in metres, from 0
// range:     where the lamp ends, in metres
fn falloff(distance: f32, range: f32) -> f32 {
    return 0.0;
}
