// From light to a display and back.
#define_import_path display

const GAMMA = 2.2;
const OFFSET = 0.08;
const WHITE = 6.0;

// TASK encode: where the line touches the curve. Both have the same value and the same slope there.
fn joint() -> f32 {
    return pow(OFFSET * GAMMA / ((1.0 + OFFSET) * (GAMMA - 1.0)), GAMMA);
}

fn curve(light: f32) -> f32 {
    return (1.0 + OFFSET) * pow(light, 1.0 / GAMMA) - OFFSET;
}

fn encode(light: f32) -> f32 {
    let joined = joint();
    if light < joined {
        return light * curve(joined) / joined;
    }
    return curve(light);
}

fn decode(value: f32) -> f32 {
    let joined = joint();
    if value < curve(joined) {
        return value * joined / curve(joined);
    }
    return pow((value + OFFSET) / (1.0 + OFFSET), GAMMA);
}

// TASK average: light is mixed, not values.
fn average(first: f32, second: f32, share: f32) -> f32 {
    return encode(mix(decode(first), decode(second), share));
}

// TASK tone: Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", equation 4, on the
// luminance of Rec. 709.
fn tone(light: vec3f) -> vec3f {
    let luminance = dot(light, vec3f(0.2126, 0.7152, 0.0722));
    return light * (1.0 + luminance / (WHITE * WHITE)) / (1.0 + luminance);
}
