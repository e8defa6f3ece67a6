// Transparent objects in one colour, striped along their texture coordinates.
#import lightbench::lab

struct Fragment {
    @builtin(position) pixel: vec4f,
    @location(3) uv: vec2f,
    @location(4) @interpolate(flat) drawn: u32,
}

@fragment
fn fragment_main(in: Fragment) -> @location(0) vec4f {
#ifdef ALPHA_TEST
    if fract(in.uv.x * 8.0) < 0.5 {
        discard;
    }
#endif
    let color = lab::stripes(in.uv, f32(in.drawn));
    return vec4f(color, 0.5);
}
