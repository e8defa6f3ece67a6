// Bounds of objects against the view, and of lamps against objects.
//
// A box is given by its middle, and by the ways from there to three of its sides. Planes of the view come in
// the order left, right, bottom, top, near, far.
#define_import_path bounds

// TASK planes: Gribb and Hartmann 2001, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection
// Matrix", for depth from 1 at the near plane to 0 at the far one.
fn plane(to_clip: mat4x4f, number: u32) -> vec4f {
    let rows = transpose(to_clip);
    var sum = rows[2];
    switch number {
        case 0u: { sum = rows[3] + rows[0]; }
        case 1u: { sum = rows[3] - rows[0]; }
        case 2u: { sum = rows[3] + rows[1]; }
        case 3u: { sum = rows[3] - rows[1]; }
        case 4u: { sum = rows[3] - rows[2]; }
        default: {}
    }
    return sum / length(sum.xyz);
}

// TASK spheres: half of the box's diagonal.
fn radius_around(halves: mat3x3f) -> f32 {
    return length(halves[0] + halves[1] + halves[2]);
}

// TASK spheres: not if it lies behind a plane as a whole.
fn sphere_meets(planes: array<vec4f, 6>, middle: vec3f, radius: f32) -> bool {
    for (var i = 0u; i < 6u; i++) {
        if dot(planes[i].xyz, middle) + planes[i].w < -radius {
            return false;
        }
    }
    return true;
}

// TASK boxes: a box reaches towards a plane as far as its three halves together.
fn box_meets(planes: array<vec4f, 6>, middle: vec3f, halves: mat3x3f) -> bool {
    for (var i = 0u; i < 6u; i++) {
        let along = abs(planes[i].xyz * halves);
        let reach = along.x + along.y + along.z;
        if dot(planes[i].xyz, middle) + planes[i].w < -reach {
            return false;
        }
    }
    return true;
}

// TASK lights: Arvo 1990, "A Simple Method for Box-Sphere Intersection Testing", in the box's own axes.
fn lamp_reaches(lamp: vec3f, range: f32, middle: vec3f, halves: mat3x3f) -> bool {
    let offset = lamp - middle;
    var nearest = middle;
    for (var i = 0u; i < 3u; i++) {
        let share = dot(offset, halves[i]) / dot(halves[i], halves[i]);
        nearest += clamp(share, -1.0, 1.0) * halves[i];
    }
    return distance(lamp, nearest) <= range;
}
