// Unit normals in 32 bits, in three ways.
//
// In:  a unit vector, or two 16-bit integers.
// Out: the other. The angle between what goes in and what comes out is, at most and in the mean,
//      0.004 and 0.001 degrees with the octahedral map in two times 16 bits,
//      0.31 and 0.03 degrees with the best fit in three bytes,
//      0.39 and 0.17 degrees with the plain components in three bytes.
// Those that take three bytes leave the fourth free; they are here to be compared.
// Follows Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
// Vectors", JCGT 3(2), section 3.2; Kaplanyan 2010, "CryENGINE 3: Reaching the Speed of Light",
// SIGGRAPH, for the best fit.
#define_import_path lightbench::normals

// --- Octahedral map -------------------------------------------------------------------------------

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

// --- Plain components -----------------------------------------------------------------------------

// Three bytes in two halves: x and y, then z.
fn join(bytes: vec3u) -> vec2u {
    return vec2u(bytes.x | bytes.y << 8u, bytes.z);
}

fn split(halves: vec2u) -> vec3u {
    return vec3u(halves.x & 0xffu, halves.x >> 8u, halves.y & 0xffu);
}

// Each component from -1 to 1 as a number from 0 to 255. Of all the points of that cube, those near
// the sphere alone are used: one in eighty.
fn encode_plain(normal: vec3f) -> vec2u {
    return join(vec3u(round((normal * 0.5 + 0.5) * 255.0)));
}

fn decode_plain(encoded: vec2u) -> vec3f {
    return normalize(vec3f(split(encoded)) / 255.0 * 2.0 - 1.0);
}

// --- Best fit -------------------------------------------------------------------------------------

// The middle of a byte's range, for zero to be exact.
const MIDDLE: f32 = 127.0;

// The point of the cube, however far out, that lies closest to the direction: the length is lost
// anyway. All lengths are tried here, 1 to 127 along the largest component; games look the best one
// up in a cube map of lengths instead.
fn encode_best_fit(normal: vec3f) -> vec2u {
    let largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    let direction = normal / largest;
    var best = vec3f(0.0);
    var least = 2.0;
    for (var length = 1.0; length <= MIDDLE; length += 1.0) {
        let point = round(direction * length);
        // The square of the sine of the angle to the direction: exact where it is small.
        let offset = cross(point, normal);
        let error = dot(offset, offset) / dot(point, point);
        if error < least {
            least = error;
            best = point;
        }
    }
    return join(vec3u(best + MIDDLE));
}

fn decode_best_fit(encoded: vec2u) -> vec3f {
    return normalize(vec3f(split(encoded)) - MIDDLE);
}
