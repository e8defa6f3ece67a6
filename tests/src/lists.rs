//! Lists of lights that shaders make, against the lights that reach the points which read them.

use glam::DVec3;
use lightbench::render::TargetImage;
use lightbench::render::gpu_data::LightData;

use crate::buffers::{OPENED, opened, words};
use crate::pixels::{Pixels, depth_inside};
use crate::{Counts, Mistake, Numbers, Studio, project, project_with_mistake, settings};

/// A point that a shader may ask for, and the list that it reads.
pub type Asked = (usize, DVec3);

/// What was found of lists.
#[derive(Debug, Default)]
pub struct Found {
    /// Lights that reach a point and are not on its list.
    pub missing: usize,
    /// Lights on the lists that points read.
    pub listed: usize,
    /// Of these, lights that reach none of the list's points.
    pub in_vain: usize,
    /// Lists that points read.
    pub read: usize,
}

impl Found {
    /// Looks at lists, with the points that ask for them.
    pub fn look(
        lists: &[Vec<u32>],
        lights: &[LightData],
        asked: impl Iterator<Item = Asked>,
    ) -> Self {
        let mut reaching: Vec<Option<Vec<bool>>> = vec![None; lists.len()];
        let mut found = Self::default();
        for (list, point) in asked {
            let reaching = reaching[list].get_or_insert_with(|| vec![false; lights.len()]);
            for (index, light) in lights.iter().enumerate() {
                let inside = depth_inside(light, point);
                if inside > 1e-4 && !lists[list].contains(&(index as u32)) {
                    found.missing += 1;
                }
                reaching[index] |= inside > -1e-4;
            }
        }
        for (list, reaching) in lists.iter().zip(&reaching) {
            let Some(reaching) = reaching else { continue };
            found.read += 1;
            found.listed += list.len();
            found.in_vain += list
                .iter()
                .filter(|light| !reaching[**light as usize])
                .count();
        }
        found
    }

    /// Says it.
    pub fn print(&self, what: &str) {
        let Self {
            missing,
            listed,
            in_vain,
            read,
        } = self;
        let share = 100 * in_vain / listed.max(&1);
        println!(
            "{what}: {listed} lights on {read} lists, {in_vain} ({share} %) reach nothing; {missing} missing"
        );
    }
}

/// Runs a pipeline of a project, and gives its depth, and the words of some buffers.
pub fn run(
    studio: &mut Studio,
    pipeline: &str,
    texts: &[&str],
    size: (u32, u32),
    buffers: &[(&str, u32)],
    mistake: Option<Mistake<'_>>,
) -> (TargetImage, Vec<Vec<u32>>, Counts) {
    let files = opened(pipeline, buffers);
    let files = files.each_ref().map(|(path, text)| (*path, text.as_str()));
    let (_folder, files) = match mistake {
        Some(mistake) => project_with_mistake(&files, mistake),
        None => project(&files),
    };
    studio.files = files;
    let (pipeline, counts) = studio.draw_whole(OPENED, &settings(texts), size);
    let read = |(buffer, _): &(&str, u32)| words(&studio.renderer, &pipeline, buffer);
    let depth = studio.renderer.read_target(&pipeline, "depth").unwrap();
    let found = buffers.iter().map(read).collect();
    (depth, found, counts)
}

/// Lists that follow one another with a fixed room, each with its length first.
pub fn of_fixed_room(words: &[u32], room: usize, count: usize) -> Vec<Vec<u32>> {
    let lists = words.chunks_exact(room + 1).take(count);
    let lists = lists.map(|list| list[1..][..(list[0] as usize).min(room)].to_vec());
    lists.collect()
}

/// The points that the pixels of a picture show.
pub fn shown<'a>(
    pixels: &'a Pixels,
    depth: &'a TargetImage,
) -> impl Iterator<Item = (usize, DVec3)> + 'a {
    let solid = depth
        .texels
        .iter()
        .enumerate()
        .filter(|(_, texel)| texel[0] > 0.0);
    solid.map(|(index, texel)| (index, pixels.at(index, texel[0])))
}

/// For each pixel a point anywhere between the camera and what it shows, where glass may be.
pub fn before<'a>(
    pixels: &'a Pixels,
    depth: &'a TargetImage,
) -> impl Iterator<Item = (usize, DVec3)> + 'a {
    let mut numbers = Numbers(7);
    let [near, far] = pixels.planes;
    depth.texels.iter().enumerate().map(move |(index, texel)| {
        let most = match texel[0] {
            0.0 => far.min(1000.0),
            reversed => pixels.distance(pixels.at(index, reversed)),
        };
        // Nearer ones more often, as lists of clusters are shorter there.
        let share = numbers.below(1_000_000) as f64 * 1e-6;
        (
            index,
            pixels.at_distance(index, near * (most / near).powf(share)),
        )
    })
}
