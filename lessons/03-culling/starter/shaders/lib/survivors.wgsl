// Which objects are in view.
//
// In:  the scene's instances, and the functions of bounds.wgsl.
// Out: yes or no for each object, by its number.
#define_import_path survivors
#import lightbench::scene
#import bounds

struct Parameters {
    bound: u32,
    window: f32,
    objects: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

fn object_count() -> u32 {
    return u32(parameters.objects);
}

// The box of an object: what its matrix makes of the cube from -1 to 1.
fn middle(object: u32) -> vec3f {
    let instance = scene::instances[object];
    return vec3f(instance.world_row_x.w, instance.world_row_y.w, instance.world_row_z.w);
}

fn halves(object: u32) -> mat3x3f {
    let instance = scene::instances[object];
    return transpose(mat3x3f(instance.world_row_x.xyz, instance.world_row_y.xyz, instance.world_row_z.xyz));
}

// The six planes of the part of the picture that counts as the view.
fn planes() -> array<vec4f, 6> {
    let closer = 1.0 / parameters.window;
    let narrow = mat4x4f(
        vec4f(closer, 0.0, 0.0, 0.0),
        vec4f(0.0, closer, 0.0, 0.0),
        vec4f(0.0, 0.0, 1.0, 0.0),
        vec4f(0.0, 0.0, 0.0, 1.0),
    );
    let to_clip = narrow * scene::frame.view_projection;
    var planes: array<vec4f, 6>;
    for (var number = 0u; number < 6u; number++) {
        planes[number] = bounds::plane(to_clip, number);
    }
    return planes;
}

fn is_in_view(object: u32) -> bool {
    if parameters.bound == 0u {
        return bounds::sphere_meets(planes(), middle(object), bounds::radius_around(halves(object)));
    }
    return bounds::box_meets(planes(), middle(object), halves(object));
}
