// What comes out of the texels of each pixel.
//
// In:  the texels.
// Out: normal and exponent; colour and specular strength.
#import own_layout

struct Surface {
    @location(0) shape: vec4f,
    @location(1) color: vec4f,
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> Surface {
    let kept = own_layout::unpack(vec2i(pixel.xy));
    return Surface(vec4f(kept.normal, kept.power), vec4f(kept.base_color, kept.specular));
}
