// Which lights can reach a part of the view: bounds of lights, tiles of the screen, clusters.
//
// In:  lights of the scene; rectangles of pixels; distances along the view.
// Out: whether they may meet. Every test is conservative: it may say yes for a light that touches
//      nothing, never no for one that does.
#define_import_path lightbench::culling

#import lightbench::scene

// A sphere in view space, or in world space where a function says so.
struct Sphere {
    center: vec3f,
    radius: f32,
}

// The four planes through the eye and the edges of a rectangle of the screen, in view space, their
// normals pointing inward. They hold no offset since they go through the origin.
struct Sides {
    left: vec3f,
    right: vec3f,
    bottom: vec3f,
    top: vec3f,
}

// A box in the space of the sphere that it is tested against.
struct Box {
    low: vec3f,
    high: vec3f,
}

// Distance along the view from reversed depth. From clip = a·z + b with w = -z (a is 0 where the
// far plane is infinite).
fn view_distance(depth: f32) -> f32 {
    return scene::frame.projection[3][2] / (depth + scene::frame.projection[2][2]);
}

// The radius of lights that reach everything.
const EVERYWHERE: f32 = 1.0e30;

// The smallest sphere in world space around what a light can reach. For a spot of half angle a: around apex and rim
// below 45°, around the rim up to 90°, else the whole ball.
fn world_sphere(light: scene::Light) -> Sphere {
    if light.kind >= scene::LIGHT_DIRECTIONAL {
        return Sphere(vec3f(0.0), EVERYWHERE);
    }
    var center = light.position;
    var radius = light.range;
    if light.kind == scene::LIGHT_SPOT {
        let cosine = clamp(-light.angle_offset / light.angle_scale, -1.0, 1.0);
        if cosine > sqrt(0.5) {
            radius = light.range / (2.0 * cosine);
            center += light.direction * radius;
        } else if cosine > 0.0 {
            radius = light.range * sqrt(1.0 - cosine * cosine);
            center += light.direction * (light.range * cosine);
        }
        // Rounding must not make the sphere too small.
        radius *= 1.0001;
    }
    return Sphere(center, radius);
}

// The same in view space.
fn light_sphere(light: scene::Light) -> Sphere {
    let ball = world_sphere(light);
    return Sphere((scene::frame.view * vec4f(ball.center, 1.0)).xyz, ball.radius);
}

// Whether a light with a range may reach a point: within the range, and for spots within the outer
// cone. Where not, it adds nothing there.
fn reaches(light: scene::Light, point: vec3f) -> bool {
    let offset = light.position - point;
    let distance_squared = dot(offset, offset);
    if distance_squared >= light.range * light.range {
        return false;
    }
    if light.kind != scene::LIGHT_SPOT {
        return true;
    }
    // Not divided by the distance, which may vanish.
    let along = -dot(light.direction, offset);
    return along * light.angle_scale + light.angle_offset * sqrt(distance_squared) >= 0.0;
}

// The planes of a rectangle of pixels, `from` inclusive, `to` exclusive.
fn rectangle_sides(from_pixel: vec2f, to_pixel: vec2f, resolution: vec2f) -> Sides {
    let scale = vec2f(1.0 / scene::frame.projection[0][0], 1.0 / scene::frame.projection[1][1]);
    // Slopes x/-z and y/-z of the edges; pixels count downward.
    let low = (vec2f(from_pixel.x, to_pixel.y) / resolution * 2.0 - 1.0) * vec2f(1.0, -1.0) * scale;
    let high = (vec2f(to_pixel.x, from_pixel.y) / resolution * 2.0 - 1.0) * vec2f(1.0, -1.0) * scale;
    return Sides(
        normalize(vec3f(1.0, 0.0, low.x)),
        normalize(vec3f(-1.0, 0.0, -high.x)),
        normalize(vec3f(0.0, 1.0, low.y)),
        normalize(vec3f(0.0, -1.0, -high.y)),
    );
}

// The box in view space around what lies between the four planes and two distances along the view, a
// little larger than it is, since distances come with rounding.
fn sides_box(sides: Sides, nearest: f32, farthest: f32) -> Box {
    // A normal is (±1, 0, ±slope) or (0, ±1, ±slope) times a number.
    let low = vec2f(sides.left.z / sides.left.x, sides.bottom.z / sides.bottom.y);
    let high = vec2f(sides.right.z / sides.right.x, sides.top.z / sides.top.y);
    let front = nearest * 0.9999;
    let back = farthest * 1.0001;
    return Box(
        vec3f(min(low * front, low * back), -back),
        vec3f(max(high * front, high * back), -front),
    );
}

// Whether a ball meets what lies between the four planes.
fn meets_sides(ball: Sphere, sides: Sides) -> bool {
    let reach = -ball.radius;
    return dot(sides.left, ball.center) >= reach
        && dot(sides.right, ball.center) >= reach
        && dot(sides.bottom, ball.center) >= reach
        && dot(sides.top, ball.center) >= reach;
}

// Whether a ball meets what lies between two distances along the view.
fn meets_range(ball: Sphere, nearest: f32, farthest: f32) -> bool {
    return ball.radius - ball.center.z >= nearest && -ball.center.z - ball.radius <= farthest;
}

// Arvo 1990, "A Simple Method for Box-Sphere Intersection Testing", Graphics Gems.
fn meets_box(ball: Sphere, space: Box) -> bool {
    let outside = ball.center - clamp(ball.center, space.low, space.high);
    return length(outside) <= ball.radius;
}
