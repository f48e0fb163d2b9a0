//! How pictures show a table: one in the plane straight on, one in space seen from a corner.

use std::cell::Cell;

use billiards::geometry::{Extent, Vector3};

use super::harvest::Seen;
use super::planar::Planar;
use super::spatial::Spatial;
use super::start::Start;
use super::wires::{self, View};
use crate::picture::{Material, Reduced, Window};

/// A table in the plane.
pub(crate) struct Flat<'a> {
    planar: &'a Planar,
    starts: &'a dyn Fn(u64) -> Start<2, 1>,
}

impl<'a> Flat<'a> {
    pub(crate) fn new(planar: &'a Planar, starts: &'a dyn Fn(u64) -> Start<2, 1>) -> Self {
        Flat { planar, starts }
    }
}

impl Seen for Flat<'_> {
    fn start(&self, orbit: u64) -> [f64; 2] {
        self.planar.lifted(&(self.starts)(orbit))
    }

    fn point(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        [x, y]
    }

    fn rest(&self, position: [f64; 3]) -> [f64; 2] {
        self.point(position)
    }

    fn direction(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        [x, y]
    }

    fn reduced(&self) -> Option<Reduced> {
        let (centres, out) = (&self.planar.centres, |s: f64| s / self.planar.drawn.factor);
        Some(Reduced::new(centres.arc_length_offsets().into_iter().map(out).collect(), out(centres.perimeter())))
    }
}

/// Directions on the page of the axes of space: orthographic, seen from far away, 35° round and 20° from above.
const AXES: [[f64; 2]; 3] = [
    [0.819_152_044_288_991_8, -0.196_174_694_969_010_4],
    [0.573_576_436_351_046, 0.280_166_499_592_640_3],
    [0.0, 0.939_692_620_785_908_4],
];
/// How far an infinite table is shown, in units of its height.
const FARTHEST: f64 = 3.0;
/// The same where starts are that far apart.
const FARTHEST_START: f64 = 50.0;
/// How thin the shown part may be, as a fraction of its largest side.
const THINNEST: f64 = 0.5;
/// How many times as large as all else the shown part may become by where the time of an orbit is over that meets no wall any more.
const FARTHEST_REST: f64 = 30.0;
/// The room around what is seen of an infinite table, in units of that and of its height.
const AROUND: f64 = 0.1;

fn projected(p: [f64; 3]) -> [f64; 2] {
    [0, 1].map(|i| AXES[0][i] * p[0] + AXES[1][i] * p[1] + AXES[2][i] * p[2])
}

/// A table in space.
pub(crate) struct Solid<'a> {
    spatial: &'a Spatial,
    starts: &'a dyn Fn(u64) -> Start<3, 3>,
    /// The box of all points seen so far, and that of the starts among them.
    bounds: Cell<Bounds>,
    begins: Cell<Bounds>,
    /// The box of where the time of orbits is over that meet no wall any more.
    rests: Cell<Bounds>,
    /// The first point seen.
    first: Cell<[f64; 3]>,
}

/// Opposite corners of a box.
type Bounds = [[f64; 3]; 2];

/// The box of nothing.
const EMPTY: Bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

/// The smallest box around two.
fn union([low, high]: Bounds, [least, most]: Bounds) -> Bounds {
    [[0, 1, 2].map(|i| low[i].min(least[i])), [0, 1, 2].map(|i| high[i].max(most[i]))]
}

/// A box made larger by another one, unless it became too large.
fn unless_too_large(seen: Bounds, other: Bounds) -> Bounds {
    let size = |[low, high]: Bounds| (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    let (all, before) = (union(seen, other), size(seen));
    if before == 0.0 || size(all) <= FARTHEST_REST * before { all } else { seen }
}

/// A box made larger, so that a point is in it.
fn around(bounds: Bounds, point: [f64; 3]) -> Bounds {
    union(bounds, [point; 2])
}

impl<'a> Solid<'a> {
    pub(crate) fn new(spatial: &'a Spatial, starts: &'a dyn Fn(u64) -> Start<3, 3>) -> Self {
        let [bounds, begins, rests] = [(); 3].map(|()| Cell::new(EMPTY));
        Solid { spatial, starts, bounds, begins, rests, first: Cell::new([0.0; 3]) }
    }

    /// Draws the walls and, for a particle of positive radius, those of its centre; of an infinite table, the part around the orbits.
    pub(crate) fn draw(&self, material: &mut Material) {
        let spatial = self.spatial;
        let radius = spatial.radius;
        let Extent { min: low, max: high } = spatial.extent();
        let shown = self.part(low, high);
        let view = View { place: projected, page: [0, 1].map(|i| Vector3::from_fn(|k, _| AXES[k][i])) };
        let walls = wires::of(&spatial.walls, shown, &view);
        (material.solids, material.outline) = (walls.solids, walls.lines);
        material.radius = radius;
        if radius > 0.0 {
            // these walls exist, since the region of centres is built from them
            let centres: Vec<_> = spatial.walls.iter().filter_map(|wall| wall.of_centres(radius).ok()).collect();
            material.guides = wires::of(&centres, shown, &view).lines;
        }
        if !low.iter().chain(high.iter()).all(|x| x.is_finite()) {
            let corner = |k: usize| projected([0, 1, 2].map(|i| shown[k >> i & 1][i]));
            material.window = Window::around((0..8).map(corner)).map(|window| window.padded(0.01));
        }
    }

    /// Opposite corners of the shown part of a box whose sides may lie at infinity: there it extends as far as orbits and walls go,
    /// but not much farther than the box is high.
    fn part(&self, low: Vector3<f64>, high: Vector3<f64>) -> Bounds {
        let [mut least, mut most] = self.bounds.get();
        for wall in &self.spatial.walls {
            for i in 0..3 {
                let along = Vector3::from_fn(|k, _| if i == k { 1.0 } else { 0.0 });
                // a plane is infinite
                let end = |sign: f64| wall.spec.farthest(&(along * sign)).map(|point| point[i] + wall.center[i]);
                least[i] = end(-1.0).map_or(least[i], |end| least[i].min(end));
                most[i] = end(1.0).map_or(most[i], |end| most[i].max(end));
            }
        }
        let seen = unless_too_large([least, most], self.rests.get());
        shown([low, high].map(Into::into), seen, self.begins.get(), self.first.get())
    }
}

/// Opposite corners of the shown part of a box: where it is infinite, it extends as far as the points seen around the `first` one,
/// and around all starts if they are not too far apart.
fn shown([low, high]: Bounds, [least, most]: Bounds, begins: Bounds, first: [f64; 3]) -> Bounds {
    let size = (0..3).map(|i| high[i] - low[i]).filter(|size| size.is_finite()).fold(0.0, f64::max);
    let reach = if size > 0.0 { FARTHEST * size } else { f64::INFINITY };
    let is_near = (0..3).all(|i| begins[1][i] - begins[0][i] <= FARTHEST_START * size);
    let kept = if is_near { begins } else { [first; 2] };
    let end = |i: usize, given: f64, seen: f64, kept: f64, sign: f64| {
        if given.is_finite() {
            return given;
        }
        let room = AROUND * (most[i] - least[i]) + AROUND * size;
        let near = (seen + sign * room - first[i]).clamp(-reach, reach);
        let beyond = kept + sign * size.min(room) - first[i];
        first[i] + if sign * near < sign * beyond { beyond } else { near }
    };
    let mut sides: [[f64; 2]; 3] = core::array::from_fn(|i| {
        [end(i, low[i], least[i], kept[0][i], -1.0), end(i, high[i], most[i], kept[1][i], 1.0)]
    });
    let largest = sides.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    for (i, side) in sides.iter_mut().enumerate() {
        let open = [low[i], high[i]].map(|end| !end.is_finite());
        let lacks = (THINNEST * largest - (side[1] - side[0])).max(0.0);
        let share = lacks / open.iter().filter(|open| **open).count().max(1) as f64;
        *side = [side[0] - if open[0] { share } else { 0.0 }, side[1] + if open[1] { share } else { 0.0 }];
    }
    [sides.map(|side| side[0]), sides.map(|side| side[1])]
}

impl Seen for Solid<'_> {
    fn start(&self, orbit: u64) -> [f64; 2] {
        let start = (self.starts)(orbit);
        let position = [0, 1, 2].map(|i| start.scale.length_out(start.position[i] + self.spatial.shift[i]));
        self.begins.set(around(self.begins.get(), position));
        self.point(position)
    }

    fn point(&self, position: [f64; 3]) -> [f64; 2] {
        let [low, high] = self.bounds.get();
        if low[0] > high[0] {
            self.first.set(position);
        }
        self.bounds.set(around([low, high], position));
        projected(position)
    }

    fn rest(&self, position: [f64; 3]) -> [f64; 2] {
        self.rests.set(around(self.rests.get(), position));
        projected(position)
    }

    fn direction(&self, velocity: [f64; 3]) -> [f64; 2] {
        projected(velocity)
    }

    fn reduced(&self) -> Option<Reduced> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_table_without_end_no_side_is_thin_and_given_ends_stay() {
        let [free, flat] = [f64::INFINITY, 0.25];
        // a floor, and all points seen in one plane above it
        let first = [0.0, flat, 0.0];
        let sides = shown([[-free, -free, -2.0], [free; 3]], [[-3.0, flat, -2.0], [2.0, flat, 1.0]], [first; 2], first);
        let size = [0, 1, 2].map(|i| sides[1][i] - sides[0][i]);
        assert_eq!((sides[0][2], sides[0][0]), (-2.0, -3.5));
        assert!(size[1] > 0.4 * size[0] && sides[0][1] + sides[1][1] == 2.0 * flat, "{sides:?}");
        // a bounded box is shown completely
        let closed = [[0.0, 0.0, -1.0], [9.0, 0.5, 1.0]];
        assert_eq!(shown(closed, [[1.0; 3], [2.0; 3]], [[1.0; 3]; 2], [1.0; 3]), closed);
    }

    #[test]
    fn of_a_table_without_end_every_start_in_space_is_shown() {
        let slab = [[f64::NEG_INFINITY, f64::NEG_INFINITY, 0.0], [f64::INFINITY, f64::INFINITY, 1.0]];
        let start = |x: f64| [x, 0.0, 0.5];
        for (first, other) in [(0.0, 40.0), (40.0, 0.0), (0.0, -7.0)] {
            let begins = around([start(first); 2], start(other));
            let seen = around(around(begins, start(200.0)), start(-200.0));
            let [low, high] = shown(slab, seen, begins, start(first));
            assert!(low[0] < begins[0][0] && begins[1][0] < high[0], "{low:?} {high:?}");
            assert!(high[0] - low[0] <= 60.0, "{low:?} {high:?}");
        }
        let far = [start(0.0), start(1000.0)];
        assert_eq!(shown(slab, far, far, start(0.0))[1][0], FARTHEST);
    }
}
