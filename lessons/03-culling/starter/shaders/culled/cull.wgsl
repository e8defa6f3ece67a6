// Lists the objects that are in view: a thread for each object, and 64 threads a group.
//
// In:  `survivors::is_in_view(object)`, for objects from 0 to below `survivors::object_count()`.
// Out: the list, by `list::reserve` and `list::put`.
#import survivors
#import list

// TASK batches: put each object that is in view into the list once. The threads of a group reserve their places
// together: once for all of them, and not at all where none of their objects is in view. The last group has
// threads for which there is no object.
//
// Now a single thread lists a single object, the ground.
@compute @workgroup_size(64)
fn compute_main(
    @builtin(global_invocation_id) thread: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let object = thread.x;
    if object == 0u && survivors::is_in_view(object) {
        let place = list::reserve(1u);
        list::put(place, object);
    }
}
