// The list of objects that are in view.
//
// A thread first reserves places, which is told to all threads of the GPU one after the other, and then puts
// objects there.
#define_import_path list

// The words of `counts`.
const KEPT: u32 = 0u;
const RESERVATIONS: u32 = 1u;
const PAIRS_TESTED: u32 = 2u;
const PAIRS_KEPT: u32 = 3u;

@group(1) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;
@group(1) @binding(1) var<storage, read_write> list: array<u32>;

// Reserves so many places, one after the other, and gives the first of them.
fn reserve(count: u32) -> u32 {
    atomicAdd(&counts[RESERVATIONS], 1u);
    return atomicAdd(&counts[KEPT], count);
}

// Puts the number of an object into a place.
fn put(place: u32, object: u32) {
    list[place] = object;
}
