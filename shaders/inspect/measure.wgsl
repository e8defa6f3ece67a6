// Inspect: least and greatest values of a slice of a target, and how often values between two ends occur.
//
// In:  the target of `lightbench::inspected`; which slice and sample, and the range.
// Out: for each channel least, greatest and counts; then the texels to which nothing was drawn.
// Depth is measured as a distance in metres.
#import lightbench::inspected

struct Request {
    corner: vec3i,      // z is the slice of a volume
    sample: i32,        // below 0: the mean of all
    size: vec2u,        // columns and rows
    first: u32,         // not used here
    padding: u32,
    low: f32,           // the range over which values are counted
    high: f32,
    near: f32,          // metres; with `far`, turns depth into a distance
    far: f32,           // metres; infinity is sent as 0
}

@group(0) @binding(0) var<uniform> request: Request;
@group(0) @binding(2) var<storage, read_write> answers: array<atomic<u32>>;

// Words of a channel, as in engine/render/src/inspect/measure.rs.
const LEAST: u32 = 0u;      // of keys, turned round so that the greatest is kept
const MOST: u32 = 1u;
const FINITE: u32 = 2u;
const INVALID: u32 = 3u;
const BELOW: u32 = 4u;
const ABOVE: u32 = 5u;
const FIRST_BIN: u32 = 6u;
const BINS: u32 = 64u;
const CHANNEL_WORDS: u32 = 70u;
const EMPTY: u32 = 280u;
const WORDS: u32 = 281u;

const THREADS: u32 = 64u;
const EXPONENT: u32 = 0x7f800000u;

// Counts of one workgroup: memory that all share would be asked for each texel otherwise.
var<workgroup> counted: array<atomic<u32>, WORDS>;

// A number that grows with a float: as floats are ordered, so are these.
fn key(value: f32) -> u32 {
    let bits = bitcast<u32>(value);
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

fn take(channel: u32, value: f32) {
    let first = channel * CHANNEL_WORDS;
    if (bitcast<u32>(value) & EXPONENT) == EXPONENT {
        atomicAdd(&counted[first + INVALID], 1u);
        return;
    }
    atomicAdd(&counted[first + FINITE], 1u);
    atomicMax(&counted[first + LEAST], ~key(value));
    atomicMax(&counted[first + MOST], key(value));
    if value < request.low {
        atomicAdd(&counted[first + BELOW], 1u);
    } else if value > request.high {
        atomicAdd(&counted[first + ABOVE], 1u);
    } else {
        let share = (value - request.low) / max(request.high - request.low, 1e-30);
        let bin = min(u32(share * f32(BINS)), BINS - 1u);
        atomicAdd(&counted[first + FIRST_BIN + bin], 1u);
    }
}

@compute @workgroup_size(8, 8)
fn compute_main(
    @builtin(global_invocation_id) at: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if all(at.xy < request.size) {
        let texel = request.corner + vec3i(vec2i(at.xy), 0);
        let value = inspected::load_value(texel, request.sample);
#ifdef DEPTH
        if value.r <= 0.0 {
            atomicAdd(&counted[EMPTY], 1u);
        } else {
            take(0u, inspected::metres(value.r, request.near, request.far));
        }
#else
        take(0u, value.r);
        take(1u, value.g);
        take(2u, value.b);
        take(3u, value.a);
#endif
    }
    workgroupBarrier();
    for (var word = thread; word < WORDS; word += THREADS) {
        let count = atomicLoad(&counted[word]);
        if count == 0u {
            continue;
        }
        let role = word % CHANNEL_WORDS;
        if word != EMPTY && role <= MOST {
            atomicMax(&answers[word], count);
        } else {
            atomicAdd(&answers[word], count);
        }
    }
}
