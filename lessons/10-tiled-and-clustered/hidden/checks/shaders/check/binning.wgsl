// Calls one function of shaders/lib/binning.wgsl for each pixel of a picture of 48 × 32.
//
// In:  which function, and its arguments, as far as they do not come from the pixel's place.
// Out: what it gives. Beside the answer for a sphere stands the sphere's centre.
#import binning

struct Parameters {
    function: u32,
    spheres: u32,
    width: f32,
    height: f32,
    spread: f32,
    farthest: f32,
    radius: f32,
    left: f32,
    right: f32,
    bottom: f32,
    top: f32,
    begin: f32,
    end: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// Three numbers from 0 to 1 for each pixel, spread evenly.
fn spread_evenly(pixel: vec2u, first: u32) -> vec3f {
    let n = f32(pixel.y * 48u + pixel.x + first);
    return fract(n * vec3f(0.8191725, 0.6710436, 0.5497005));
}

// A sphere anywhere around, or one that just touches a point of the cluster.
fn center_of(pixel: vec2u, slopes: vec4f) -> vec3f {
    let share = spread_evenly(pixel, 1u);
    let length = parameters.end - parameters.begin;
    if parameters.spheres == 0u {
        let around = vec3f(mix(-1.0, 1.0, share.x), mix(-1.0, 1.0, share.y), 0.0) * parameters.end;
        return around - vec3f(0.0, 0.0, mix(parameters.begin - length, parameters.end + length, share.z));
    }
    let ahead = mix(parameters.begin, parameters.end, share.z);
    let inside = vec3f(mix(slopes.x, slopes.y, share.x), mix(slopes.z, slopes.w, share.y), -1.0) * ahead;
    let away = normalize(spread_evenly(pixel, 5000u) - 0.5);
    return inside + 0.98 * parameters.radius * away;
}

@fragment
fn fragment_main(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let resolution = vec2u(vec2f(parameters.width, parameters.height));
    let slopes = vec4f(parameters.left, parameters.right, parameters.bottom, parameters.top);
    let spread = vec2f(1.5, 1.0) * parameters.spread;
    switch parameters.function {
        case 0u: {
            let size = binning::tile_size(resolution + vec2u(37u, 23u) * pixel);
            return vec4f(vec2f(size), 0.0, 1.0);
        }
        case 1u: {
            let place = vec2f(pixel * (resolution - 1u) / vec2u(47u, 31u)) + 0.5;
            return vec4f(vec2f(binning::tile_of(place, resolution)), 0.0, 1.0);
        }
        case 2u: { return vec4f(binning::tile_slopes(pixel, resolution, spread).xy, 0.0, 1.0); }
        case 3u: { return vec4f(binning::tile_slopes(pixel, resolution, spread).zw, 0.0, 1.0); }
        case 4u: {
            let distance = parameters.farthest * (f32(pixel.x) + 0.5) / 48.0;
            return vec4f(f32(binning::slice_of(distance)), 0.0, 0.0, 1.0);
        }
        case 5u: { return vec4f(binning::slice_range(pixel.x), 0.0, 1.0); }
        case 6u: {
            let center = center_of(pixel, slopes);
            return vec4f(f32(binning::meets_tile(center, parameters.radius, slopes)), center);
        }
        default: {
            let center = center_of(pixel, slopes);
            let range = vec2f(parameters.begin, parameters.end);
            return vec4f(f32(binning::meets_cluster(center, parameters.radius, slopes, range)), center);
        }
    }
}
