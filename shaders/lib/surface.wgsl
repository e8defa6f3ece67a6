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
    specular: vec3f,                    // specular reflectance at normal incidence
    emissive: vec3f,                    // radiance
    opacity: f32,                       // share of what lies behind that it hides; 1: opaque
    model: u32,                         // one of the numbers in brdf.wgsl
    lobe: vec2f,                        // exponent; or roughness along the tangent and across it
    tangent: vec3f,                     // world, unit length; zero without REFLECTION_MODELS
}

// A unit vector, or +y where the length vanishes: degenerate triangles must not make NaN.
fn safe_normalize(v: vec3f) -> vec3f {
    let length_squared = dot(v, v);
    if length_squared < 1e-30 {
        return vec3f(0.0, 1.0, 0.0);
    }
    return v * inverseSqrt(length_squared);
}

// The part of a tangent that lies in the surface, as a unit vector; where nothing is left of it, any
// unit vector that lies there.
fn surface_tangent(tangent: vec3f, normal: vec3f) -> vec3f {
    var along = safe_normalize(tangent);
    along -= normal * dot(normal, along);
    if dot(along, along) < 1e-6 {
        let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.x) > 0.7);
        along = axis - normal * dot(normal, axis);
    }
    return normalize(along);
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

    var tangent = vec3f(0.0);
#ifdef REFLECTION_MODELS
    tangent = surface_tangent(in.tangent.xyz, normal);
#endif

    return Surface(
        in.world_position,
        normal,
        base_color.rgb,
        material.specular,
        material.emissive,
        // A texture's alpha thins out only what is transparent as a whole.
        select(material.opacity * base_color.a, 1.0, material.opacity >= 1.0),
        material.model,
        material.lobe,
        tangent,
    );
}
