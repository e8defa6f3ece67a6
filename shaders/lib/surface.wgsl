// The surface under a fragment: the one place that reads materials.
//
// In:  a fragment's interpolated vertex and which side of the triangle it shows.
// Out: `Surface`, with a unit normal that faces the viewer.
// Every pass that draws geometry calls `fragment_surface`, so that all pipelines light the same
// surface and discard the same fragments.
#define_import_path lightbench::surface

#import lightbench::scene
#import lightbench::geometry

struct Surface {
    position: vec3f,                    // world
    normal: vec3f,                      // world, unit length
    base_color: vec3f,                  // diffuse reflectance, linear Rec. 709
    specular: f32,                      // specular reflectance
    power: f32,                         // Blinn-Phong exponent
    emissive: vec3f,                    // radiance
    opacity: f32,                       // share of what lies behind that it hides; 1: opaque
}

// A unit vector, or +y where the length vanishes: degenerate triangles must not make NaN.
fn safe_normalize(v: vec3f) -> vec3f {
    let length_squared = dot(v, v);
    if length_squared < 1e-30 {
        return vec3f(0.0, 1.0, 0.0);
    }
    return v * inverseSqrt(length_squared);
}

fn fragment_surface(in: geometry::VertexOutput, front_facing: bool) -> Surface {
    let ddx = dpdx(in.uv);
    let ddy = dpdy(in.uv);
    let instance = scene::drawn_objects[in.drawn].instance;
    let material = scene::materials[scene::instances[instance].material];

    var base_color = vec4f(material.base_color, 1.0);
    if material.base_color_texture != scene::NO_TEXTURE {
        base_color *= scene::sample_texture(material.base_color_texture, in.uv, ddx, ddy);
    }
#ifdef ALPHA_TEST
    if base_color.a < material.alpha_cutoff {
        discard;
    }
#endif

    // Two-sided surfaces turn the normal towards the viewer.
    let side = select(-1.0, 1.0, front_facing);
    var normal = safe_normalize(in.normal) * side;
    if material.normal_texture != scene::NO_TEXTURE {
        // Tangent-space normal map: x along the tangent, y along the bitangent, z out.
        let encoded = scene::sample_texture(material.normal_texture, in.uv, ddx, ddy).xyz;
        let bent = encoded * 2.0 - 1.0;
        let tangent = safe_normalize(in.tangent.xyz - normal * dot(normal, in.tangent.xyz));
        let bitangent = cross(normal, tangent) * in.tangent.w * side;
        normal = safe_normalize(tangent * bent.x + bitangent * bent.y + normal * bent.z);
    }

    return Surface(
        in.world_position,
        normal,
        base_color.rgb,
        material.specular,
        material.power,
        material.emissive,
        // A texture's alpha thins out only what is transparent as a whole.
        select(material.opacity * base_color.a, 1.0, material.opacity >= 1.0),
    );
}
