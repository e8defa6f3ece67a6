// Where a line of sight meets a triangle, and how that changes from pixel to pixel.
//
// In:  a corner of the triangle in view space, where the eye is the origin, and the edges from it
//      to the other two; the direction of a pixel's line of sight, and its change to the
//      neighbouring pixels.
// Out: the weights of the three corners, correct in perspective, and their derivatives.
// Follows Möller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection", journal of
// graphics tools 2(1). There each weight is a quotient of products with the direction; the
// direction is linear in the pixel, so the quotient rule gives the derivatives, as Burns and Hunt
// 2013 want them, "The Visibility Buffer", JCGT 2(2). A twin lies in
// engine/lab/src/reference/triangle.rs.
#define_import_path lightbench::triangle

struct Triangle {
    corner: vec3f,                      // view space, metres
    edge_b: vec3f,                      // to the second corner
    edge_c: vec3f,                      // to the third corner
}

struct Sight {
    direction: vec3f,                   // view space, of any length
    ddx: vec3f,                         // its change to the next pixel on the right
    ddy: vec3f,                         // and to the next one below
}

struct Hit {
    weights: vec3f,                     // of the three corners; together 1
    ddx: vec3f,                         // their change to the next pixel on the right
    ddy: vec3f,                         // and to the next one below
    counter_clockwise: bool,            // whether the corners run so as the eye sees them
}

// The change of a quotient of linear functions, from that of its parts.
fn change(weights: vec2f, step: vec3f, b: vec3f, c: vec3f, area: vec3f, inverse: f32) -> vec3f {
    let along = (vec2f(dot(step, b), dot(step, c)) - weights * dot(step, area)) * inverse;
    return vec3f(-along.x - along.y, along);
}

fn meet(triangle: Triangle, sight: Sight) -> Hit {
    let b = cross(triangle.corner, triangle.edge_c);
    let c = cross(triangle.edge_b, triangle.corner);
    let area = cross(triangle.edge_c, triangle.edge_b);
    let facing = dot(sight.direction, area);
    // A triangle that is seen from its edge has no inside: take its first corner.
    let inverse = select(1.0 / facing, 0.0, facing == 0.0);
    let weights = vec2f(dot(sight.direction, b), dot(sight.direction, c)) * inverse;
    return Hit(
        vec3f(1.0 - weights.x - weights.y, weights),
        change(weights, sight.ddx, b, c, area, inverse),
        change(weights, sight.ddy, b, c, area, inverse),
        facing > 0.0,
    );
}
