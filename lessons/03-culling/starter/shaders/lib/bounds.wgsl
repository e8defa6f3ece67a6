// Bounds of objects against the view, and of lamps against objects.
//
// A box may be turned. It is given by its middle, and by the ways from there to the middles of three of its
// sides, which are at right angles to one another: halves[0], halves[1] and halves[2].
//
// The view is given by six planes, in the order left, right, bottom, top, near, far. dot(plane.xyz, p) + plane.w
// is the distance of a point p from the plane, in metres, above zero on the side where the view is.
//
// These functions run and find nothing. Fill them in one after the other; the text says how.
#define_import_path bounds

// TASK planes: one of the six planes of the view, by its number from 0.
//
// to_clip:  from world space to clip coordinates
fn plane(to_clip: mat4x4f, number: u32) -> vec4f {
    return vec4f(0.0);
}

// TASK spheres: the radius of the smallest sphere around the box's middle that holds all of it.
fn radius_around(halves: mat3x3f) -> f32 {
    return 0.0;
}

// TASK spheres: whether a sphere may be in view.
fn sphere_meets(planes: array<vec4f, 6>, middle: vec3f, radius: f32) -> bool {
    return false;
}

// TASK boxes: whether a box may be in view.
fn box_meets(planes: array<vec4f, 6>, middle: vec3f, halves: mat3x3f) -> bool {
    return false;
}

// TASK lights: whether a lamp that shines so many metres far reaches a box.
fn lamp_reaches(lamp: vec3f, range: f32, middle: vec3f, halves: mat3x3f) -> bool {
    return false;
}
