// Colours for numbers.
//
// In:  a number from 0 to 1.
// Out: a display-ready colour whose lightness grows with the number, so that the order survives print
//      in grey and every kind of colour blindness.
#define_import_path lightbench::color_map

// Viridis by N. Smith and S. van der Walt 2015, as a polynomial (M. Zucker, published under CC0).
fn viridis(t: f32) -> vec3f {
    let c0 = vec3f(0.27772733, 0.00540734, 0.33409981);
    let c1 = vec3f(0.10509304, 1.40461353, 1.38459016);
    let c2 = vec3f(-0.33086183, 0.21484756, 0.09509516);
    let c3 = vec3f(-4.63423050, -5.79910097, -19.33244096);
    let c4 = vec3f(6.22826994, 14.17993337, 56.69055260);
    let c5 = vec3f(4.77638500, -13.74514538, -65.35303263);
    let c6 = vec3f(-5.43545586, 4.64585261, 26.31243525);
    return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
}
