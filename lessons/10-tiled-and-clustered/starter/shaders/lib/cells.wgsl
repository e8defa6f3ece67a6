// The list of a pixel's cell.
//
// In:  a pixel, and the distance along the view of what it shows.
// Out: where the list of its cell begins. CAPACITY and SLICED as in shaders/binning/assign.wgsl.
#define_import_path cells

#import lightbench::scene
#import binning

fn list_of(pixel: vec2f, distance_ahead: f32) -> u32 {
    let tile = binning::tile_of(pixel, vec2u(scene::frame.resolution));
#ifdef SLICED
    let slice = binning::slice_of(distance_ahead);
#else
    let slice = 0u;
#endif
    let cell = (slice * binning::ROWS + tile.y) * binning::COLUMNS + tile.x;
    return cell * (#{CAPACITY}u + 1u);
}
