// How many groups of 64 threads the next pass needs: one thread for each object of the list.
//
// In:  `counts`, of which the first word is how many objects the list has.
// Out: `groups`, how many there are along x, y and z.

@group(1) @binding(0) var<storage, read> counts: array<u32>;
@group(1) @binding(1) var<storage, read_write> groups: array<u32>;

@compute @workgroup_size(1)
fn compute_main() {
    groups[0] = (counts[0] + 63u) / 64u;
    groups[1] = 1u;
    groups[2] = 1u;
}
