// Light indexing, first pass: lights get numbers of 8 bits.
//
// In:  the lights.
// Out: for each light its number, from 1 to 255 in the order of the lights, or 0: lights without a
//      range and those out of view need none, and those beyond 255 get none; the light of each
//      number; how many lights have a number and how many went without.
// One workgroup goes through the lights, as many at a time as it has invocations, and each light
// looks how many before it are in view.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::scene
#import lightbench::culling

@group(1) @binding(0) var<storage, read_write> light_numbers: array<u32>;
@group(1) @binding(1) var<storage, read_write> numbered_lights: array<u32>;
@group(1) @binding(2) var<storage, read_write> index_totals: array<u32>;

const THREADS: u32 = 64u;
const MOST: u32 = 255u;

var<workgroup> in_view: array<atomic<u32>, 2>;

@compute @workgroup_size(THREADS)
fn compute_main(@builtin(local_invocation_index) thread: u32) {
    let size = scene::frame.resolution;
    let sides = culling::rectangle_sides(vec2f(0.0), size, size);
    let word = thread / 32u;
    let bit = 1u << (thread % 32u);
    var before = 0u;
    for (var first = 0u; first < scene::frame.light_count; first += THREADS) {
        let light = first + thread;
        var wanted = false;
        if light < scene::frame.light_count && scene::lights[light].kind < scene::LIGHT_DIRECTIONAL {
            var ball = culling::light_sphere(scene::lights[light]);
            // Rounding must leave none out that is drawn.
            ball.radius *= 1.001;
            wanted = culling::meets_sides(ball, sides)
                && culling::meets_range(ball, 0.0, scene::frame.far);
        }
        if wanted {
            atomicOr(&in_view[word], bit);
        }
        workgroupBarrier();
        var masks = array<u32, 2>(atomicLoad(&in_view[0]), atomicLoad(&in_view[1]));
        workgroupBarrier();
        if thread < 2u {
            atomicStore(&in_view[thread], 0u);
        }
        workgroupBarrier();
        if light < scene::frame.light_count {
            var number = before + 1u + countOneBits(masks[word] & (bit - 1u));
            if word == 1u {
                number += countOneBits(masks[0]);
            }
            if !wanted || number > MOST {
                number = 0u;
            }
            light_numbers[light] = number;
            if number != 0u {
                numbered_lights[number] = light;
            }
        }
        before += countOneBits(masks[0]) + countOneBits(masks[1]);
    }
    if thread == 0u {
        index_totals[0] = min(before, MOST);
        index_totals[1] = before - min(before, MOST);
    }
}
