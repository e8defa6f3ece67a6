// Calls the student's function for each pixel.
#import lightbench::scene
#import exercise

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return vec4f(vec3f(exercise::ramp(pixel.x / scene::frame.resolution.x)), 1.0);
}
