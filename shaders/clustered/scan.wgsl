// Clustered shading: from the lengths of all lists to where each begins, by adding up.
//
// In:  the length of each cluster's list.
// Out: where it begins: the sum of all lengths before it; the room that all lists need together.
// One workgroup: each invocation adds up a run of clusters, the sums are added up in shared memory,
// then each invocation goes through its run again. See Blelloch 1990, "Prefix Sums and Their
// Applications".
@group(1) @binding(0) var<storage, read_write> cluster_lists: array<vec2u>;
@group(1) @binding(1) var<storage, read_write> cluster_totals: array<u32>;

const THREADS: u32 = 256u;

var<workgroup> sums: array<u32, THREADS>;
var<workgroup> longest: array<u32, THREADS>;

@compute @workgroup_size(THREADS)
fn compute_main(@builtin(local_invocation_index) thread: u32) {
    let clusters = arrayLength(&cluster_lists);
    let run = (clusters + THREADS - 1u) / THREADS;
    let from_cluster = min(thread * run, clusters);
    let to_cluster = min(from_cluster + run, clusters);

    var sum = 0u;
    var most = 0u;
    for (var cluster = from_cluster; cluster < to_cluster; cluster++) {
        sum += cluster_lists[cluster].y;
        most = max(most, cluster_lists[cluster].y);
    }
    sums[thread] = sum;
    longest[thread] = most;
    workgroupBarrier();

    var begin = 0u;
    for (var other = 0u; other < thread; other++) {
        begin += sums[other];
    }
    if thread == THREADS - 1u {
        for (var other = 0u; other < THREADS; other++) {
            most = max(most, longest[other]);
        }
        cluster_totals[0] = begin + sum;
        cluster_totals[1] = most;
    }
    for (var cluster = from_cluster; cluster < to_cluster; cluster++) {
        cluster_lists[cluster].x = begin;
        begin += cluster_lists[cluster].y;
    }
}
