//! Panes of glass before a wall, and what the middle of their picture shows.

use lightbench::render::TargetImage;

/// Panes that are turned by different angles, one behind the other, before a wall; the sun shines
/// along the view. Each is so large that it fills the middle of the picture. Pane 0 is nearest; they are
/// spawned in the order that is given.
pub fn panes(order: &[usize]) -> String {
    let [r, g, b] = wall();
    let mut scene = format!(
        "directional_light(\"sun\").at(0, 0, 1).look_at(0, 0, 0).color(1, 1, 1).intensity(3);
        camera(\"eye\").at(0.01, 0.02, 9).look_at(0.01, 0.02, 0).fov(30).near(0.1).far(50);
        spawn(\"wall\").mesh(faces([[
            vec3(-9, -9, -9), vec3(9, -9, -9), vec3(9, 9, -9), vec3(-9, 9, -9),
        ]])).material(material(\"wall\").color(rgb({r}, {g}, {b})).specular(0));",
    );
    for &pane in order {
        let (x, z) = (2.0 * angle(pane).cos(), -2.0 * angle(pane).sin());
        let middle = 3.0 - 2.5 * pane as f64;
        let [r, g, b] = color(pane);
        scene += &format!(
            "spawn(\"pane {pane}\").mesh(faces([[
                vec3({}, -2, {}), vec3({x}, -2, {}), vec3({x}, 2, {}), vec3({}, 2, {}),
            ]])).material(material(\"glass {pane}\").color(rgb({r}, {g}, {b})).specular(0)
                .opacity({}));",
            -x,
            middle - z,
            middle + z,
            middle + z,
            -x,
            middle - z,
            opacity(pane),
        );
    }
    scene
}

/// The colour of the wall: roots that are whole 255ths, which a G-buffer keeps as they are.
fn wall() -> [f64; 3] {
    [114.0_f64, 198.0, 161.0].map(|root| (root / 255.0).powi(2))
}

fn angle(pane: usize) -> f64 {
    [0.5, -0.2, 0.35, -0.4][pane]
}

fn color(pane: usize) -> [f64; 3] {
    [
        [0.9, 0.1, 0.1],
        [0.1, 0.8, 0.3],
        [0.2, 0.2, 0.9],
        [0.7, 0.7, 0.1],
    ][pane]
}

fn opacity(pane: usize) -> f64 {
    [0.3, 0.5, 0.4, 0.6][pane]
}

/// What the middle of the picture shows: so many panes over the wall, farthest first.
pub fn composite(count: usize) -> [f64; 3] {
    let lit = |color: f64, cosine: f64| color / std::f64::consts::PI * 3.0 * cosine;
    let mut seen = wall().map(|wall| lit(wall, 1.0));
    for pane in (0..count).rev() {
        for (seen, color) in seen.iter_mut().zip(color(pane)) {
            *seen += (lit(color, angle(pane).cos()) - *seen) * opacity(pane);
        }
    }
    seen
}

/// The middle ninth of a picture.
pub fn middle(image: &TargetImage) -> impl Iterator<Item = &[f32; 4]> {
    let (width, height) = (image.width as usize, image.height as usize);
    let rows = image.texels.chunks_exact(width);
    rows.skip(height / 3)
        .take(height / 3)
        .flat_map(move |row| &row[width / 3..2 * width / 3])
}
