// The surface at a point of a mesh: the one place that reads materials.
//
// In:  a fragment's interpolated vertex and which side of the triangle it shows; or a point that a
//      shader interpolated itself.
// Out: `Surface`, with a unit normal that faces the viewer.
// Every pass that draws geometry calls `fragment_surface`, so that all pipelines light the same
// surface and discard the same fragments; shaders that fetch triangles themselves call
// `point_surface`.
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

// A point of a mesh, before its material is read.
struct Point {
    position: vec3f,                    // world
    normal: vec3f,                      // world, not unit length
    tangent: vec4f,                     // world, not unit length; w is the bitangent's handedness
    uv: vec2f,
    uv_ddx: vec2f,                      // change of uv to the next pixel on the right
    uv_ddy: vec2f,                      // and to the next one below
    instance: u32,                      // index in scene::instances
    front_facing: bool,                 // whether the viewer sees the triangle's front
}

fn fragment_point(in: geometry::VertexOutput, front_facing: bool) -> Point {
    return Point(
        in.world_position,
        in.normal,
        in.tangent,
        in.uv,
        dpdx(in.uv),
        dpdy(in.uv),
        scene::drawn_objects[in.drawn].instance,
        front_facing,
    );
}

fn material_of(point: Point) -> scene::Material {
    return scene::materials[scene::instances[point.instance].material];
}

// The material's colour at a point, and its alpha.
fn base_color(point: Point) -> vec4f {
    let material = material_of(point);
    var color = vec4f(material.base_color, 1.0);
    if material.base_color_texture != scene::NO_TEXTURE {
        color *= scene::sample_texture(
            material.base_color_texture, point.uv, point.uv_ddx, point.uv_ddy,
        );
    }
    return color;
}

// The unit normal towards the viewer, bent by the material's normal map.
fn bent_normal(point: Point) -> vec3f {
    // Two-sided surfaces turn the normal towards the viewer.
    let side = select(-1.0, 1.0, point.front_facing);
    let normal = safe_normalize(point.normal) * side;
    let texture = material_of(point).normal_texture;
    if texture == scene::NO_TEXTURE {
        return normal;
    }
    // Tangent-space normal map: x along the tangent, y along the bitangent, z out.
    let encoded = scene::sample_texture(texture, point.uv, point.uv_ddx, point.uv_ddy).xyz;
    let bent = encoded * 2.0 - 1.0;
    let tangent = safe_normalize(point.tangent.xyz - normal * dot(normal, point.tangent.xyz));
    let bitangent = cross(normal, tangent) * point.tangent.w * side;
    return safe_normalize(tangent * bent.x + bitangent * bent.y + normal * bent.z);
}

#ifdef COUNT_LIGHTS
// For heat maps all surfaces are white, matt and dark of their own, so that what arrives is seen.
fn surface_of_color(point: Point, color: vec4f) -> Surface {
    var s: Surface;
    s.position = point.position;
    s.normal = bent_normal(point);
    s.base_color = vec3f(1.0);
    s.opacity = 1.0;
    s.lobe = vec2f(1.0);
    return s;
}
#else
fn surface_of_color(point: Point, color: vec4f) -> Surface {
    let material = material_of(point);
    let normal = bent_normal(point);
    var tangent = vec3f(0.0);
#ifdef REFLECTION_MODELS
    tangent = surface_tangent(point.tangent.xyz, normal);
#endif
    return Surface(
        point.position,
        normal,
        color.rgb,
        material.specular,
        material.emissive,
        // A texture's alpha thins out only what is transparent as a whole.
        select(material.opacity * color.a, 1.0, material.opacity >= 1.0),
        material.model,
        material.lobe,
        tangent,
    );
}
#endif

// The surface at a point that is known not to lie in a hole of an alpha-tested material.
fn point_surface(point: Point) -> Surface {
    return surface_of_color(point, base_color(point));
}

fn fragment_surface(in: geometry::VertexOutput, front_facing: bool) -> Surface {
    let point = fragment_point(in, front_facing);
    let color = base_color(point);
#ifdef ALPHA_TEST
    if color.a < material_of(point).alpha_cutoff {
        discard;
    }
#endif
    return surface_of_color(point, color);
}
