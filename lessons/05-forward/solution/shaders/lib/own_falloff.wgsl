// How light gets weaker with the distance.
#define_import_path own_falloff

const SIZE = 0.06;                      // of the lamp, metres
const HALF_WAY = 0.6;                   // the share of the inverse square that is left at half the range

// TASK falloff: the inverse square, with a window that ends at the range. It is a power that is squared, so
// that it ends without a slope; the exponent follows from HALF_WAY. After Karis 2013, "Real Shading in Unreal
// Engine 4", where the exponent is 4.
fn falloff(distance: f32, range: f32) -> f32 {
    let exponent = -log2(1.0 - sqrt(HALF_WAY));
    let rest = max(1.0 - pow(distance / range, exponent), 0.0);
    let nearest = max(distance, SIZE);
    return rest * rest / (nearest * nearest);
}
