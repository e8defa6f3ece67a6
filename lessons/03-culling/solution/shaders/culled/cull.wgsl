// Lists the objects that are in view: a thread for each object, and 64 threads a group.
#import survivors
#import list

// How many objects of the group are in view, and where its places begin.
var<workgroup> found: atomic<u32>;
var<workgroup> first: u32;

// TASK batches: count within the group, reserve once, then write.
@compute @workgroup_size(64)
fn compute_main(
    @builtin(global_invocation_id) thread: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let object = thread.x;
    var is_kept = false;
    if object < survivors::object_count() {
        is_kept = survivors::is_in_view(object);
    }
    var place = 0u;
    if is_kept {
        place = atomicAdd(&found, 1u);
    }
    workgroupBarrier();
    if lane == 0u && atomicLoad(&found) > 0u {
        first = list::reserve(atomicLoad(&found));
    }
    workgroupBarrier();
    if is_kept {
        list::put(first + place, object);
    }
}
