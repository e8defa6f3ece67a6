// One slice of a target that is looked at, whatever its texels are.
//
// In:  group 0, binding 1: the target. One of FLOAT, UNSIGNED, SIGNED and DEPTH says what its texels
//      are. VOLUME says that it is 3D, SAMPLES that each texel has several.
// Out: texels as numbers for people, or as bits for exact copies.
// For the program's own look into targets. Passes of a pipeline have the scene in group 0.
#define_import_path lightbench::inspected

#ifdef DEPTH
#ifdef SAMPLES
@group(0) @binding(1) var inspected_target: texture_depth_multisampled_2d;
#else
@group(0) @binding(1) var inspected_target: texture_depth_2d;
#endif
#endif
#ifdef UNSIGNED
#ifdef SAMPLES
@group(0) @binding(1) var inspected_target: texture_multisampled_2d<u32>;
#else
#ifdef VOLUME
@group(0) @binding(1) var inspected_target: texture_3d<u32>;
#else
@group(0) @binding(1) var inspected_target: texture_2d<u32>;
#endif
#endif
#endif
#ifdef SIGNED
#ifdef SAMPLES
@group(0) @binding(1) var inspected_target: texture_multisampled_2d<i32>;
#else
#ifdef VOLUME
@group(0) @binding(1) var inspected_target: texture_3d<i32>;
#else
@group(0) @binding(1) var inspected_target: texture_2d<i32>;
#endif
#endif
#endif
#ifdef FLOAT
#ifdef SAMPLES
@group(0) @binding(1) var inspected_target: texture_multisampled_2d<f32>;
#else
#ifdef VOLUME
@group(0) @binding(1) var inspected_target: texture_3d<f32>;
#else
@group(0) @binding(1) var inspected_target: texture_2d<f32>;
#endif
#endif
#endif

// The bits of a texel: x, y, and z for the slice of a volume. Depth is in the first word. Channels
// that a format lacks are 0, alpha 1.
fn load_bits(texel: vec3i, sample: i32) -> vec4u {
#ifdef SAMPLES
    let loaded = textureLoad(inspected_target, texel.xy, sample);
#else
#ifdef VOLUME
    let loaded = textureLoad(inspected_target, texel, 0);
#else
    let loaded = textureLoad(inspected_target, texel.xy, 0);
#endif
#endif
#ifdef DEPTH
    return bitcast<vec4u>(vec4f(loaded, 0.0, 0.0, 1.0));
#else
    return bitcast<vec4u>(loaded);
#endif
}

// The numbers of one sample of a texel.
fn load_sample(texel: vec3i, sample: i32) -> vec4f {
    let bits = load_bits(texel, sample);
#ifdef UNSIGNED
    return vec4f(bits);
#else
#ifdef SIGNED
    return vec4f(bitcast<vec4i>(bits));
#else
    return bitcast<vec4f>(bits);
#endif
#endif
}

// The numbers of a texel: of one sample, or for a negative number the mean of all.
fn load_value(texel: vec3i, sample: i32) -> vec4f {
#ifdef SAMPLES
    if sample < 0 {
        let count = i32(textureNumSamples(inspected_target));
        var sum = vec4f(0.0);
        for (var i = 0; i < count; i++) {
            sum += load_sample(texel, i);
        }
        return sum / f32(count);
    }
#endif
    return load_sample(texel, max(sample, 0));
}

// The distance along the view of a depth, which is reversed: 1 at the near plane, 0 at the far one. A
// far plane at infinity is given as 0.
fn metres(depth: f32, near: f32, far: f32) -> f32 {
    var inverse = depth;
    if far > 0.0 {
        let ratio = near / far;
        inverse = ratio + depth * (1.0 - ratio);
    }
    return near / max(inverse, 1e-12);
}

// Width and height of the slice.
fn slice_size() -> vec2u {
    return textureDimensions(inspected_target).xy;
}
