// What the shaders of the lab share.
//
// In:  positions in metres, colours in linear Rec. 709.
// Out: the same, changed.
#define_import_path lightbench::lab

// A wave that runs along x, a centimetre high.
fn wave(position: vec3f, time: f32) -> vec3f {
    return vec3f(0.0, 0.01 * sin(4.0 * position.x + time), 0.0);
}

fn stripes(uv: vec2f, seed: f32) -> vec3f {
    let share = fract(uv.x * 8.0 + seed * 0.25);
    return mix(vec3f(1.0, 0.2, 0.1), vec3f(0.1, 0.3, 1.0), share);
}

// Lifts a colour that is darker than what is around it.
fn lift(color: vec3f, around: vec3f, strength: f32) -> vec3f {
    let darkness = saturate(around - color);
    return color * (1.0 + strength * darkness);
}
