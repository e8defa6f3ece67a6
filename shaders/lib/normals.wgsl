// Unit normals in two numbers: the octahedral map.
//
// In:  a unit vector, or two 16-bit integers.
// Out: the other. 16 bits an axis keep the angle within 0.004 degrees.
// Follows Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
// Vectors", JCGT 3(2), section 3.2.
#define_import_path lightbench::normals

// Two whole numbers from 0 to 65535 for a unit vector.
fn encode_octahedral(normal: vec3f) -> vec2u {
    let n = normal / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    var square = n.xy;
    if n.z < 0.0 {
        // The lower half folds over the corners of the square.
        let sign = select(vec2f(-1.0), vec2f(1.0), n.xy >= vec2f(0.0));
        square = (1.0 - abs(n.yx)) * sign;
    }
    return vec2u(round((square * 0.5 + 0.5) * 65535.0));
}

// The unit vector of two such numbers.
fn decode_octahedral(encoded: vec2u) -> vec3f {
    let square = vec2f(encoded) / 65535.0 * 2.0 - 1.0;
    var n = vec3f(square, 1.0 - abs(square.x) - abs(square.y));
    if n.z < 0.0 {
        let sign = select(vec2f(-1.0), vec2f(1.0), n.xy >= vec2f(0.0));
        n = vec3f((1.0 - abs(n.yx)) * sign, n.z);
    }
    return normalize(n);
}
