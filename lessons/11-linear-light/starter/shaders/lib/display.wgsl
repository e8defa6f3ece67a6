// From light to a display and back.
//
// These functions run and give nothing. Fill them in one after the other; the text says how. Your numbers
// are in README.md.
#define_import_path display

// TASK encode: the value from 0 to 1 that makes your display show the light from 0 to 1.
fn encode(light: f32) -> f32 {
    return 0.0;
}

// TASK encode: the light from 0 to 1 that your display shows for the value from 0 to 1.
fn decode(value: f32) -> f32 {
    return 0.0;
}

// TASK average: the value that shows the mixture of what two values show. A share of 0 is the first of them
// alone, a share of 1 the second.
fn average(first: f32, second: f32, share: f32) -> f32 {
    return 0.0;
}

// TASK tone: light of any strength to light from 0 to 1.
fn tone(light: vec3f) -> vec3f {
    return vec3f(0.0);
}
