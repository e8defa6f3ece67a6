// Marks pixels in stencil and nothing else.
//
// In:  the faces of a light's volume, or the whole screen.
// Out: no colour; the stencil test does the work.

@fragment
fn fragment_main() {}
