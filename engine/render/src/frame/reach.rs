//! Which lights reach an object, without a test of every light.
//!
//! Lights are sorted by where they begin along an axis; for a box only those are tested that begin
//! before its end and may end behind its beginning (sweep and prune: Cohen, Lin, Manocha and Ponamgi
//! 1995, "I-COLLIDE"). With 10,000 objects and 1,024 lights that is a twentieth of all pairs.

use glam::Vec3;
use lightbench_world::WorldBounds;

use super::objects::Objects;
use crate::gpu_data::LightData;
use crate::volumes;

/// The box around an object.
pub(super) struct Space {
    center: Vec3,
    half: Vec3,
}

impl Space {
    pub fn of(objects: &Objects<'_>, row: u32) -> Self {
        let bounds = objects.world.columns::<WorldBounds>();
        let b = bounds.slices();
        let row = row as usize;
        Self {
            center: Vec3::new(b.x[row], b.y[row], b.z[row]),
            half: Vec3::new(b.half_x[row], b.half_y[row], b.half_z[row]),
        }
    }

    /// Distance from the light to the box, by clamping (Arvo 1990, Graphics Gems).
    fn is_reached(&self, span: &Span) -> bool {
        let outside = ((span.position - self.center).abs() - self.half).max(Vec3::ZERO);
        outside.length_squared() < span.range_squared
    }
}

/// A light with a range: what the test of a box needs of it, side by side.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// Where it begins along the axis.
    begin: f32,
    light: u32,
    position: Vec3,
    range_squared: f32,
}

/// Lights in the order in which they begin along an axis. Keeps its memory.
#[derive(Default)]
pub(super) struct Reach {
    axis: usize,
    spans: Vec<Span>,
    /// From the beginning of the longest to its end.
    longest: f32,
    /// Lights without a range.
    everywhere: Vec<u32>,
}

impl Reach {
    /// Takes those of the lights whose index is wanted.
    pub fn fill(&mut self, lights: &[LightData], wanted: impl Fn(u32) -> bool) {
        self.spans.clear();
        self.everywhere.clear();
        self.longest = 0.0;
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for light in lights.iter().filter(|light| volumes::is_bounded(light)) {
            low = low.min(light.position);
            high = high.max(light.position);
        }
        // The axis along which they are spread most.
        self.axis = (high - low).max_position();
        for (index, light) in (0_u32..).zip(lights).filter(|(index, _)| wanted(*index)) {
            if volumes::is_bounded(light) {
                // A little longer than it is, so that rounding loses none.
                let at = light.position[self.axis];
                let half = light.range * 1.001 + at.abs() * 1e-6;
                self.spans.push(Span {
                    begin: at - half,
                    light: index,
                    position: light.position,
                    range_squared: light.range * light.range,
                });
                self.longest = self.longest.max(2.0 * half);
            } else {
                self.everywhere.push(index);
            }
        }
        self.spans
            .sort_unstable_by(|a, b| a.begin.total_cmp(&b.begin));
    }

    /// Adds the indices of the lights that reach a box, in ascending order.
    pub fn find(&self, space: &Space, found: &mut Vec<u32>) {
        let first = found.len();
        found.extend(&self.everywhere);
        let (at, half) = (space.center[self.axis], space.half[self.axis]);
        // The longest is added with its rounding.
        let low = (at - half) - self.longest * 1.001;
        let begin = self.spans.partition_point(|span| span.begin < low);
        let candidates = self.spans[begin..]
            .iter()
            .take_while(|span| span.begin <= at + half);
        let reaching = candidates.filter(|span| space.is_reached(span));
        found.extend(reaching.map(|span| span.light));
        found[first..].sort_unstable();
    }
}

/// A light that reaches an object.
#[derive(Clone, Copy, Default)]
pub(super) struct Pair {
    /// Its place in the order of drawing.
    pub object: u32,
    pub light: u32,
}

/// Pairs of objects and lights, sorted into groups of lights. Keeps its memory.
#[derive(Default)]
pub(super) struct Pairs {
    /// The lights of all groups, in ascending order.
    shown: Vec<u32>,
    /// Of each light its group, or [`NO_GROUP`].
    group_of: Vec<u32>,
    lights_a_group: usize,
    unsorted: Vec<Pair>,
    sorted: Vec<Pair>,
    /// Where the pairs of each group end.
    ends: Vec<usize>,
}

const NO_GROUP: u32 = u32::MAX;

impl Pairs {
    /// Forms groups of so many of the lights that are shown.
    pub fn begin(
        &mut self,
        lights: &[LightData],
        lights_a_group: usize,
        shown: impl Fn(&LightData) -> bool,
    ) {
        self.lights_a_group = lights_a_group.max(1);
        self.unsorted.clear();
        self.shown.clear();
        self.group_of.clear();
        for (index, light) in (0_u32..).zip(lights) {
            if shown(light) {
                let group = self.shown.len() / self.lights_a_group;
                self.group_of.push(group as u32);
                self.shown.push(index);
            } else {
                self.group_of.push(NO_GROUP);
            }
        }
    }

    /// Whether a light is in a group.
    pub fn is_shown(&self, light: u32) -> bool {
        self.group_of[light as usize] != NO_GROUP
    }

    /// Adds the lights that reach an object; objects come in the order of drawing.
    pub fn add(&mut self, object: u32, lights: &[u32]) {
        let pairs = lights.iter().map(|light| Pair {
            object,
            light: *light,
        });
        self.unsorted.extend(pairs);
    }

    /// Sorts by group, and leaves the pairs of each in the order in which they came: a counting sort.
    pub fn sort(&mut self) {
        self.ends.clear();
        self.ends.resize(self.groups(), 0);
        let group = |pair: &Pair| self.group_of[pair.light as usize] as usize;
        for pair in &self.unsorted {
            self.ends[group(pair)] += 1;
        }
        let mut sum = 0;
        for end in &mut self.ends {
            let count = *end;
            // Where the group begins, until its pairs are there.
            *end = sum;
            sum += count;
        }
        self.sorted.clear();
        self.sorted.resize(self.unsorted.len(), Pair::default());
        for pair in &self.unsorted {
            let next = &mut self.ends[group(pair)];
            self.sorted[*next] = *pair;
            *next += 1;
        }
    }

    /// How many groups there are.
    pub fn groups(&self) -> usize {
        self.shown.len().div_ceil(self.lights_a_group.max(1))
    }

    /// The lights of a group.
    pub fn members(&self, group: usize) -> &[u32] {
        let first = group * self.lights_a_group;
        let end = (first + self.lights_a_group).min(self.shown.len());
        &self.shown[first..end]
    }

    /// The pairs of a group, object by object.
    pub fn of_group(&self, group: usize) -> &[Pair] {
        let begin = group.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.sorted[begin..self.ends[group]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;

    /// Numbers from 0 to 1 that look random (Numerical Recipes' quick generator).
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 7_u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        }
    }

    fn lights(count: usize) -> Vec<LightData> {
        let mut next = numbers();
        let mut lights: Vec<LightData> = (0..count)
            .map(|_| LightData {
                position: 40.0 * Vec3::new(next(), 0.1 * next(), next()) - 1000.0,
                range: 0.5 + 6.0 * next() * next(),
                ..LightData::zeroed()
            })
            .collect();
        lights[3].kind = volumes::DIRECTIONAL;
        lights[count - 1].kind = volumes::AMBIENT;
        lights
    }

    fn spaces(count: usize) -> Vec<Space> {
        let mut next = numbers();
        (0..count)
            .map(|_| Space {
                center: 40.0 * Vec3::new(next(), 0.1 * next(), next()) - 1000.0,
                half: 4.0 * Vec3::new(next(), next(), next()),
            })
            .collect()
    }

    #[test]
    fn the_lights_found_are_those_of_a_test_of_all() {
        let lights = lights(300);
        let mut reach = Reach::default();
        for wanted in [|_| true, |index: u32| index.is_multiple_of(3)] {
            reach.fill(&lights, wanted);
            let mut total = 0;
            for space in spaces(500) {
                let all = (0_u32..).zip(&lights);
                let reached = |light: &LightData| {
                    let outside = (light.position - space.center).abs() - space.half;
                    let outside = outside.max(Vec3::ZERO).length_squared();
                    !volumes::is_bounded(light) || outside < light.range * light.range
                };
                let expected: Vec<u32> = all
                    .filter(|(index, light)| wanted(*index) && reached(light))
                    .map(|(index, _)| index)
                    .collect();
                let mut found = vec![9];
                reach.find(&space, &mut found);
                assert_eq!(found[0], 9, "what was there stays");
                assert_eq!(found[1..], expected);
                total += expected.len();
            }
            // Neither none nor all: the test means something.
            assert!(total > 1500 && total < 500 * 150, "{total}");
        }
        reach.fill(&[], |_| true);
        let mut found = Vec::new();
        reach.find(&spaces(1)[0], &mut found);
        assert!(found.is_empty());
    }

    #[test]
    fn pairs_come_group_by_group_and_object_by_object() {
        let lights = lights(7);
        let mut pairs = Pairs::default();
        // Lights 0, 1, 2, 4, 5 in groups of two: (0, 1), (2, 4), (5).
        pairs.begin(&lights, 2, volumes::is_bounded);
        assert!(!pairs.is_shown(3) && pairs.is_shown(5));
        pairs.add(0, &[1, 4, 5]);
        pairs.add(1, &[0, 1, 2]);
        pairs.sort();
        let found: Vec<Vec<(u32, u32)>> = (0..pairs.groups())
            .map(|group| {
                let pairs = pairs.of_group(group).iter();
                pairs.map(|pair| (pair.object, pair.light)).collect()
            })
            .collect();
        assert_eq!(
            found,
            [
                vec![(0, 1), (1, 0), (1, 1)],
                vec![(0, 4), (1, 2)],
                vec![(0, 5)]
            ]
        );
        assert_eq!(pairs.members(1), [2, 4]);
        assert_eq!(pairs.members(2), [5]);
    }
}
