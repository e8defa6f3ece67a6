// Resolve: four samples of light become one, as a display would show them.
//
// In:  `samples`, linear radiance.
// Out: linear radiance.
// The mean of light lets one bright sample of four outshine the others: seen through a tone curve,
// the edge of a lamp has steps again. Here each sample is bent by a simple tone curve, x / (1 + x)
// of its largest channel, the mean is taken, and the curve is undone.
// Follows Lottes 2016, "Optimized Reversible Tonemapper for Resolve", GPUOpen.

@group(1) @binding(0) var samples: texture_multisampled_2d<f32>;

// The light of a sample, each channel below 1.
fn bend(radiance: vec3f) -> vec3f {
    return radiance / (1.0 + max(radiance.r, max(radiance.g, radiance.b)));
}

// The light again.
fn straighten(bent: vec3f) -> vec3f {
    return bent / max(1.0 - max(bent.r, max(bent.g, bent.b)), 1e-5);
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2u(pixel.xy);
    let count = textureNumSamples(samples);
    var sum = vec3f(0.0);
    for (var s = 0u; s < count; s++) {
        let radiance = max(textureLoad(samples, texel, s).rgb, vec3f(0.0));
#ifdef COUNT_LIGHTS
        // Heat maps count: a number is no light.
        sum += radiance;
#else
        sum += bend(radiance);
#endif
    }
#ifdef COUNT_LIGHTS
    return vec4f(sum / f32(count), 1.0);
#else
    return vec4f(straighten(sum / f32(count)), 1.0);
#endif
}
