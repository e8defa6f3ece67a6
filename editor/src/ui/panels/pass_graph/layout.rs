//! Where the boxes and lines of a graph of passes lie: numbers in, numbers out.
//!
//! Passes stand in a row at the top, in their order. Each target or buffer has a lane below them, from
//! the first pass that uses it to the last; a line goes down from each pass to each lane that it uses.
//! A line crosses a lane where it goes on to a lower one while the upper one goes past its pass. How
//! often that happens depends on nothing but which of two lanes is the upper one, so that the order of
//! lanes with the fewest crossings is a linear ordering problem. It is solved by taking the cheapest lane
//! next, which finds an order without a crossing wherever there is one, and then by moving single lanes
//! while that helps.

use std::ops::RangeInclusive;

/// Which way data goes between a pass and what it uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The pass reads.
    Read,
    /// The pass writes.
    Write,
    /// Both.
    Both,
}

/// One target or buffer, as the layout needs it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Resource {
    /// The passes that use it, in their order, and how. Never empty.
    pub uses: Vec<(usize, Way)>,
}

impl Resource {
    fn span(&self) -> (usize, usize) {
        let first = self.uses.first().map_or(0, |(pass, _)| *pass);
        let last = self.uses.last().map_or(first, |(pass, _)| *pass);
        (first, last)
    }

    /// How often lines to this lane cross another lane that lies above it.
    fn crossings_of(&self, upper: &Self) -> usize {
        let (first, last) = upper.span();
        let inside = |(pass, _): &&(usize, Way)| first < *pass && *pass < last;
        self.uses.iter().filter(inside).count()
    }
}

/// Sizes in points at a zoom of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// Width and height of a pass.
    pub pass: [f32; 2],
    /// Between two passes.
    pub gap: f32,
    /// Between the passes and the first lane, and from one lane to the next.
    pub lane: f32,
    /// The height of a lane's box.
    pub label: f32,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Left and upper edge.
    pub min: [f32; 2],
    /// Right and lower edge.
    pub max: [f32; 2],
}

/// The lane of a resource.
#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    /// Which row below the passes, from 0.
    pub row: usize,
    /// The box with its name, where it begins.
    pub label: Area,
    /// The height at which it runs.
    pub y: f32,
    /// From where to where.
    pub x: [f32; 2],
    /// The lines to the passes.
    pub lines: Vec<Line>,
}

/// A line from a pass down to a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Which pass.
    pub pass: usize,
    /// Which way data goes.
    pub way: Way,
    /// Where it runs.
    pub x: f32,
}

/// Where everything lies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// In the order of the passes.
    pub passes: Vec<Area>,
    /// In the order of the resources.
    pub lanes: Vec<Lane>,
    /// Lines that cross lanes.
    pub crossings: usize,
    /// Width and height of all.
    pub size: [f32; 2],
}

/// Lays out a graph. `widths` are those of the resources' names.
pub fn lay_out(passes: usize, resources: &[Resource], widths: &[f32], sizes: &Sizes) -> Layout {
    let order = order(resources);
    let left_of = |pass: usize| pass as f32 * (sizes.pass[0] + sizes.gap);
    let boxes: Vec<Area> = (0..passes)
        .map(|pass| Area {
            min: [left_of(pass), 0.0],
            max: [left_of(pass) + sizes.pass[0], sizes.pass[1]],
        })
        .collect();
    let mut lines: Vec<Vec<Line>> = resources.iter().map(|_| Vec::new()).collect();
    for pass in 0..passes {
        let ports = ports(pass, resources, &order);
        for (place, (resource, way)) in ports.iter().enumerate() {
            let share = (place + 1) as f32 / (ports.len() + 1) as f32;
            lines[*resource].push(Line {
                pass,
                way: *way,
                x: left_of(pass) + share * sizes.pass[0],
            });
        }
    }
    // From top to bottom, each as high as what overlaps it allows.
    let mut rows: Vec<Vec<RangeInclusive<f32>>> = Vec::new();
    let mut lanes: Vec<Option<Lane>> = resources.iter().map(|_| None).collect();
    for &index in &order {
        let lines = std::mem::take(&mut lines[index]);
        let first = lines.first().map_or(0.0, |line| line.x);
        let last = lines.last().map_or(first, |line| line.x);
        let label = (first - 6.0)..=(first - 6.0 + widths.get(index).copied().unwrap_or(60.0));
        let taken = *label.start()..=label.end().max(last + 6.0);
        let meets = |other: &RangeInclusive<f32>| {
            other.start() <= taken.end() && taken.start() <= other.end()
        };
        let row = rows.iter().rposition(|row| row.iter().any(meets));
        let row = row.map_or(0, |row| row + 1);
        if row == rows.len() {
            rows.push(Vec::new());
        }
        rows[row].push(taken);
        let y = sizes.pass[1] + (row + 1) as f32 * sizes.lane;
        lanes[index] = Some(Lane {
            row,
            label: Area {
                min: [*label.start(), y - sizes.label * 0.5],
                max: [*label.end(), y + sizes.label * 0.5],
            },
            y,
            x: [first, last],
            lines,
        });
    }
    let lanes: Vec<Lane> = lanes.into_iter().flatten().collect();
    let right = lanes.iter().map(|lane| lane.label.max[0].max(lane.x[1]));
    let right = right.chain(boxes.last().map(|last| last.max[0]));
    Layout {
        crossings: crossings(resources, &order),
        size: [
            right.fold(0.0, f32::max),
            sizes.pass[1] + (rows.len() as f32 + 0.5) * sizes.lane,
        ],
        passes: boxes,
        lanes,
    }
}

/// What a pass uses, from left to right: first the lanes that end there, upper ones first, then those
/// that go on, then those that begin, lower ones first. So no line crosses a lane that ends or begins at
/// its own pass.
fn ports(pass: usize, resources: &[Resource], order: &[usize]) -> Vec<(usize, Way)> {
    let mut ports: Vec<(i32, i64, usize, Way)> = Vec::new();
    for (place, &index) in order.iter().enumerate() {
        let resource = &resources[index];
        let used = resource.uses.iter().find(|(used, _)| *used == pass);
        let Some((_, way)) = used else {
            continue;
        };
        let place = place as i64;
        let (first, last) = resource.span();
        let (part, place) = match (first == pass, last == pass) {
            (false, true) => (0, place),
            (true, false) => (2, -place),
            _ => (1, place),
        };
        ports.push((part, place, index, *way));
    }
    ports.sort_by_key(|(part, place, ..)| (*part, *place));
    ports
        .into_iter()
        .map(|(_, _, index, way)| (index, way))
        .collect()
}

/// The lanes from top to bottom.
fn order(resources: &[Resource]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..resources.len()).collect();
    // Short lanes first where the cost is the same: they leave room for others beside them.
    left.sort_by_key(|&index| {
        let (first, last) = resources[index].span();
        (last - first, first, index)
    });
    let mut order = Vec::with_capacity(left.len());
    while !left.is_empty() {
        let cost = |upper: usize| -> usize {
            let lower = left.iter().filter(|lower| **lower != upper);
            lower
                .map(|lower| resources[*lower].crossings_of(&resources[upper]))
                .sum()
        };
        let cheapest = (0..left.len()).min_by_key(|place| (cost(left[*place]), *place));
        order.push(left.remove(cheapest.unwrap_or(0)));
    }
    improve(resources, &mut order);
    order
}

/// Moves one lane after the other to where it costs least, until none would gain.
fn improve(resources: &[Resource], order: &mut Vec<usize>) {
    let mut fewest = crossings(resources, order);
    let mut gained = fewest > 0;
    while gained {
        gained = false;
        for from in 0..order.len() {
            for to in 0..order.len() {
                let mut other = order.clone();
                let lane = other.remove(from);
                other.insert(to, lane);
                let count = crossings(resources, &other);
                if count < fewest {
                    (fewest, gained) = (count, true);
                    *order = other;
                }
            }
        }
    }
}

fn crossings(resources: &[Resource], order: &[usize]) -> usize {
    let mut count = 0;
    for (place, &upper) in order.iter().enumerate() {
        for &lower in &order[place + 1..] {
            count += resources[lower].crossings_of(&resources[upper]);
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: Sizes = Sizes {
        pass: [100.0, 50.0],
        gap: 20.0,
        lane: 30.0,
        label: 16.0,
    };

    fn resource(uses: &[usize]) -> Resource {
        let uses = uses.iter().map(|pass| (*pass, Way::Both)).collect();
        Resource { uses }
    }

    fn laid_out(passes: usize, resources: &[Resource]) -> Layout {
        lay_out(passes, resources, &vec![60.0; resources.len()], &SIZES)
    }

    /// Crossings counted from the lines as they are drawn.
    fn drawn_crossings(layout: &Layout) -> usize {
        let mut count = 0;
        for (index, lane) in layout.lanes.iter().enumerate() {
            for line in &lane.lines {
                let others = layout.lanes.iter().enumerate();
                count += others
                    .filter(|(other, upper)| {
                        let passes = upper.x[0] < line.x && line.x < upper.x[1];
                        *other != index && upper.y < lane.y && passes
                    })
                    .count();
            }
        }
        count
    }

    /// Rows of numbers without a generator to depend on (Marsaglia 2003, "Xorshift RNGs").
    struct Random(u64);

    impl Random {
        fn below(&mut self, most: usize) -> usize {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 % most as u64) as usize
        }
    }

    fn random(random: &mut Random, passes: usize, count: usize) -> Vec<Resource> {
        (0..count)
            .map(|_| {
                let mut uses: Vec<usize> = (0..=random.below(3))
                    .map(|_| random.below(passes))
                    .collect();
                uses.sort_unstable();
                uses.dedup();
                resource(&uses)
            })
            .collect()
    }

    /// The fewest crossings of all orders.
    fn fewest(resources: &[Resource], order: &mut Vec<usize>, rest: &mut Vec<usize>) -> usize {
        if rest.is_empty() {
            return crossings(resources, order);
        }
        let mut best = usize::MAX;
        for place in 0..rest.len() {
            let lane = rest.remove(place);
            order.push(lane);
            best = best.min(fewest(resources, order, rest));
            order.pop();
            rest.insert(place, lane);
        }
        best
    }

    #[test]
    fn a_deferred_frame_has_no_crossing_but_where_depth_goes_past_the_lights() {
        // G-buffer; lights; output.
        let mut resources = vec![
            resource(&[0, 1]),
            resource(&[0, 1]),
            resource(&[0, 1]),
            resource(&[1, 2]),
            resource(&[2]),
        ];
        let layout = laid_out(3, &resources);
        assert_eq!((layout.crossings, drawn_crossings(&layout)), (0, 0));
        // A pass behind the lights adds to their light and tests depth: whichever of the two lanes is
        // the upper one, a line to the other crosses it.
        resources[2] = resource(&[0, 1, 2]);
        resources[3] = resource(&[1, 2, 3]);
        resources[4] = resource(&[3]);
        let layout = laid_out(4, &resources);
        assert_eq!((layout.crossings, drawn_crossings(&layout)), (1, 1));
        // The depth that goes past the lights lies below what ends there.
        assert!(layout.lanes[2].row > layout.lanes[0].row);
        // What begins when all else has ended is high up again.
        assert_eq!(layout.lanes[4].row, 0);
    }

    #[test]
    fn counted_crossings_are_those_that_are_drawn() {
        let mut numbers = Random(0x9e37_79b9_7f4a_7c15);
        for round in 0..200 {
            let passes = 2 + numbers.below(9);
            let count = 1 + numbers.below(9);
            let resources = random(&mut numbers, passes, count);
            let layout = laid_out(passes, &resources);
            assert_eq!(layout, laid_out(passes, &resources), "the same each time");
            assert_eq!(
                layout.crossings,
                drawn_crossings(&layout),
                "{round}: {resources:?}"
            );
        }
    }

    #[test]
    fn an_order_without_a_crossing_is_found_and_others_are_near_the_best() {
        let mut numbers = Random(0x1234_5678_9abc_def1);
        let (mut found, mut best) = (0, 0);
        for _ in 0..150 {
            let passes = 2 + numbers.below(7);
            let count = 2 + numbers.below(5);
            let resources = random(&mut numbers, passes, count);
            let count = laid_out(passes, &resources).crossings;
            let mut all = (0..resources.len()).collect();
            let fewest = fewest(&resources, &mut Vec::new(), &mut all);
            assert!(fewest > 0 || count == 0, "{resources:?}");
            found += count;
            best += fewest;
        }
        assert!(best > 0, "no round had to have a crossing");
        assert!(
            found * 20 <= best * 21,
            "{found} crossings instead of {best}"
        );
    }

    #[test]
    fn lanes_that_share_a_row_do_not_touch_and_lines_stay_below_their_pass() {
        let mut numbers = Random(77);
        for _ in 0..100 {
            let passes = 2 + numbers.below(9);
            let resources = random(&mut numbers, passes, 8);
            let layout = laid_out(passes, &resources);
            for (index, lane) in layout.lanes.iter().enumerate() {
                for other in &layout.lanes[index + 1..] {
                    let right = |lane: &Lane| lane.label.max[0].max(lane.x[1]);
                    let apart =
                        right(lane) < other.label.min[0] || right(other) < lane.label.min[0];
                    assert!(apart || lane.row != other.row);
                }
                for line in &lane.lines {
                    let pass = layout.passes[line.pass];
                    assert!(pass.min[0] < line.x && line.x < pass.max[0]);
                }
                assert_eq!(lane.lines.len(), resources[index].uses.len());
            }
        }
    }

    #[test]
    fn nothing_is_laid_out_as_nothing() {
        let layout = laid_out(0, &[]);
        assert!(layout.passes.is_empty() && layout.lanes.is_empty());
    }
}
