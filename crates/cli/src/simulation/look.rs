//! How pictures look at a table: at one in the plane straight, at one in space from a corner.

use std::cell::Cell;

use billiards::geometry::Vector3;

use super::harvest::Seen;
use super::planar::Planar;
use super::spatial::{Space, Spatial};
use super::start::Start;
use crate::picture::{Reduced, Stroke, Window};

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
/// How far a table without end is shown, in units of its height.
const FARTHEST: f64 = 3.0;
/// Points of a circle seen askew.
const POINTS: u32 = 256;

fn projected(p: [f64; 3]) -> [f64; 2] {
    [0, 1].map(|i| AXES[0][i] * p[0] + AXES[1][i] * p[1] + AXES[2][i] * p[2])
}

/// A table in space.
pub(crate) struct Solid<'a> {
    spatial: &'a Spatial,
    starts: &'a dyn Fn(u64) -> Start<3, 3>,
    /// The box of all points seen so far.
    bounds: Cell<[[f64; 3]; 2]>,
    /// The first point seen.
    first: Cell<[f64; 3]>,
}

impl<'a> Solid<'a> {
    pub(crate) fn new(spatial: &'a Spatial, starts: &'a dyn Fn(u64) -> Start<3, 3>) -> Self {
        Solid {
            spatial,
            starts,
            bounds: Cell::new([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]),
            first: Cell::new([0.0; 3]),
        }
    }

    /// The edges of the table; of one without end, those of a part about the orbits, and the window that shows it.
    pub(crate) fn edges(&self) -> (Vec<Stroke>, Option<Window>) {
        let spatial = self.spatial;
        let out = |x: f64| x / spatial.factor;
        if let Space::Named(table) = &spatial.centres
            && table.name() == "ball"
        {
            let [_, high] = table.extent();
            return (ball(out(high.x)), None);
        }
        let [low, high] = spatial.centres.extent().map(|corner| corner + spatial.shift);
        let corners = self.part(low.map(out), high.map(out));
        let corner = |k: usize| projected([0, 1, 2].map(|i| corners[k >> i & 1][i]));
        let mut edges = vec![];
        for axis in 0..3 {
            // the sides of a part of something infinite are no edges
            let is_edge = (0..3).filter(|other| *other != axis).any(|other| low[other].is_finite());
            for k in (0..8).filter(|k| k >> axis & 1 == 0 && is_edge) {
                edges.push(Stroke::Segment(corner(k), corner(k | 1 << axis)));
            }
        }
        let endless = !low.iter().chain(high.iter()).all(|x| x.is_finite());
        (edges, endless.then(|| Window::around((0..8).map(corner))).flatten().map(|window| window.padded(0.01)))
    }

    /// Opposite corners of what is shown of a box whose sides may lie at infinity: there, as far as orbits go, but not
    /// much farther than the box is high.
    fn part(&self, low: Vector3<f64>, high: Vector3<f64>) -> [[f64; 3]; 2] {
        let [least, most] = self.bounds.get();
        let size = (0..3).map(|i| high[i] - low[i]).filter(|size| size.is_finite()).fold(0.0, f64::max);
        let first = self.first.get();
        let end = |i: usize, which: usize| {
            let (given, seen) = if which == 0 { (low[i], least[i]) } else { (high[i], most[i]) };
            let sign = if which == 0 { -1.0 } else { 1.0 };
            let room = 0.1 * (most[i] - least[i]) + 0.1 * size;
            let reach = if size > 0.0 { FARTHEST * size } else { f64::INFINITY };
            if given.is_finite() { given } else { first[i] + (seen + sign * room - first[i]).clamp(-reach, reach) }
        };
        [[0, 1, 2].map(|i| end(i, 0)), [0, 1, 2].map(|i| end(i, 1))]
    }
}

/// A sphere: its outline and its equator.
fn ball(radius: f64) -> Vec<Stroke> {
    let on_equator = |k: u32| {
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * f64::from(k) / f64::from(POINTS));
        projected([radius * cos, radius * sin, 0.0])
    };
    vec![
        Stroke::Circle { center: [0.0, 0.0], radius, solid: false },
        Stroke::Chain { points: (0..=POINTS).map(on_equator).collect(), solid: false },
    ]
}

impl Seen for Solid<'_> {
    fn start(&self, orbit: u64) -> [f64; 2] {
        let start = (self.starts)(orbit);
        self.point([0, 1, 2].map(|i| start.scale.length_out(start.position[i] + self.spatial.shift[i])))
    }

    fn point(&self, position: [f64; 3]) -> [f64; 2] {
        let [low, high] = self.bounds.get();
        if low[0] > high[0] {
            self.first.set(position);
        }
        let bound = |of: [f64; 3], pick: fn(f64, f64) -> f64| [0, 1, 2].map(|i| pick(of[i], position[i]));
        self.bounds.set([bound(low, f64::min), bound(high, f64::max)]);
        projected(position)
    }

    fn direction(&self, velocity: [f64; 3]) -> [f64; 2] {
        projected(velocity)
    }

    fn reduced(&self) -> Option<Reduced> {
        None
    }
}
