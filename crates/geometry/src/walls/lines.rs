//! Which of many graphs a line may cross, looked up by its direction and distance.
use crate::{Extent, plane::cross, shapes::curve::Graph};
use lanes::{Double, Lane, Mask, WHOLE, dot};
use std::collections::HashMap;

/// Numbers of cells, by direction in a quadrant and by distance.
const DIRECTIONS: usize = 64;
const DISTANCES: usize = 128;
const CELLS: usize = 4 * DIRECTIONS * DISTANCES;

/// Most graphs of a run, and of a short run, which is searched in one step.
pub(super) const LONG_RUN: usize = 2 * SHORT_RUN;
pub(super) const SHORT_RUN: usize = 8;

/// The fraction of a cell by which neighbouring cells overlap it: more than the rounding error of paths that do not come
/// [from far](Lines::is_far).
const MARGIN: f64 = 1.0 / 256.0;

/// From farther away than this many sizes of all graphs together, a path is followed from a point [nearer by](Lines::nearer): there the
/// distance of a line is rounded by 2⁻²⁰ sizes, where a cell is 2⁻⁶ wide.
const FAR: f64 = 4_294_967_296.0; // 2³²

/// What lines may cross, sorted by their directions and by their distances from a middle `m`.
///
/// The direction of a path is `d = v/(|v₁| + |v₂|)`, which runs along the sides of a square, and its distance `(x − m) × d`.
/// For lines through a point this distance is linear in `d` along each side of the square, so the points and the two ends of the cell
/// decide which lines of a cell pass through the hull of some points.
#[derive(Clone, Debug, Default)]
pub(super) struct Lines {
    pub(super) middle: [f64; 2],
    /// Number of cells by distance per unit of length.
    scale: f64,
    cells: Vec<Cell>,
    /// For cells whose lines may cross several graphs or none: the number of groups of consecutive graphs, then the first graph of each,
    /// in order.
    groups: Vec<u32>,
}

/// What lines of a cell may cross outwards.
///
/// Mostly each line crosses exactly one of some consecutive graphs, a run, and cannot graze them: the cell then holds the number of the
/// first, and the second highest bit is set where the run is longer than [`SHORT_RUN`]. Otherwise the highest bit is set, and the other
/// bits are the index of its groups.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell(u32);

impl Cell {
    const GROUPS: u32 = 1 << 31;
    const LONG: u32 = 1 << 30;

    /// A placeholder that is never used.
    pub(super) const NONE: Cell = Cell(0);

    /// Whether its lines may cross none, several, or one of several graphs.
    #[inline(always)]
    pub(super) fn is_open(self) -> bool {
        self.0 & Cell::GROUPS != 0
    }

    /// Whether its run is a long one, if it is not open.
    #[inline(always)]
    pub(super) fn is_long(self) -> bool {
        self.0 & Cell::LONG != 0
    }

    /// The first graph of its run; arbitrary where it is open.
    #[inline(always)]
    pub(super) fn first(self) -> usize {
        if self.is_open() { 0 } else { (self.0 & !Cell::LONG) as usize }
    }
}

/// Sine of the angle within which a line may graze a graph: more than rounding errors and neglected bends of the other sign.
const FLAT: f64 = 1e-5;

/// What matters of a graph for the lines that may cross it.
struct Stretch {
    place: usize,
    ends: [[f64; 2]; 2],
    hull: [[f64; 2]; 4],
    normals: [[f64; 2]; 2],
}

impl Stretch {
    /// Whether lines with directions between two certainly cross it outwards (`true`) or inwards (`false`).
    fn is_outward(&self, directions: [[f64; 2]; 2]) -> Option<bool> {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for n in self.normals {
            for d in directions {
                let speed = dot(&n, &d);
                range = [range[0].min(speed), range[1].max(speed)];
            }
        }
        if FLAT < range[0] { Some(true) } else { (range[1] < -FLAT).then_some(false) }
    }
}

/// The direction at which a cell begins.
fn direction(cell: usize, part: f64) -> [f64; 2] {
    let within = (cell % DIRECTIONS) as f64 + part;
    let (a, b) = (1.0 - within / DIRECTIONS as f64, within / DIRECTIONS as f64);
    match cell / DIRECTIONS {
        0 => [a, b],
        1 => [-b, a],
        2 => [-a, -b],
        _ => [b, -a],
    }
}

/// The whole number below `a` (or at it, up to rounding), between 0 and the last.
#[inline(always)]
fn floor<F: Lane>(a: F, last: usize) -> F {
    ((a - 0.5) + WHOLE - WHOLE).max(a.same(0.0)).min(a.same(last as f64))
}

impl Lines {
    /// Graphs with their indices, in order; `width` consecutive ones are tested at a time.
    pub(super) fn new(graphs: &[(usize, &Graph)], width: usize) -> Lines {
        let all = graphs.iter().fold(Extent::EMPTY, |all, (_, graph)| all.union(graph.extent()));
        let middle = [0, 1].map(|i| 0.5 * (all.min[i] + all.max[i]));
        let half = (0..2).map(|i| all.max[i] - middle[i]).fold(0.0, f64::max);
        let scale = 0.5 * DISTANCES as f64 / half;
        let stretch = |(place, graph): &(usize, &Graph)| Stretch {
            place: *place,
            ends: graph.ends,
            hull: graph.hull(),
            normals: graph.normals(),
        };
        let stretches: Vec<Stretch> = graphs.iter().map(stretch).collect();
        let mut lines = Lines { middle, scale, cells: vec![], groups: vec![] };
        let mut known = HashMap::new();
        let mut column: Vec<Vec<usize>> = vec![vec![]; DISTANCES];
        for number in 0..4 * DIRECTIONS {
            let directions = [direction(number, -MARGIN), direction(number, 1.0 + MARGIN)];
            for (k, stretch) in stretches.iter().enumerate() {
                if stretch.is_outward(directions) != Some(false) {
                    let [first, last] = lines.distances(stretch, directions);
                    column[first..=last].iter_mut().for_each(|met| met.push(k));
                }
            }
            for (distance, met) in column.iter_mut().enumerate() {
                let met: Vec<&Stretch> = met.drain(..).map(|k| &stretches[k]).collect();
                let run = lines.run(&met, directions, distance);
                let cell = run.unwrap_or_else(|| lines.add_groups(&met, width, &mut known));
                lines.cells.push(cell);
            }
        }
        lines
    }

    /// The first and the last distance at which lines with directions between two may cross a graph.
    fn distances(&self, stretch: &Stretch, directions: [[f64; 2]; 2]) -> [usize; 2] {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for p in stretch.hull {
            for d in directions {
                let distance = self.distance(p, d);
                range = [range[0].min(distance), range[1].max(distance)];
            }
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers")]
        [range[0] - MARGIN, range[1] + MARGIN].map(|distance| floor(distance, DISTANCES - 1) as usize)
    }

    /// The cell of lines each of which crosses exactly one of some consecutive graphs: it passes between the far ends of these, and
    /// crosses them only outwards.
    #[allow(clippy::cast_possible_truncation, reason = "graphs are numbered by 30 bits")]
    fn run(&self, met: &[&Stretch], directions: [[f64; 2]; 2], distance: usize) -> Option<Cell> {
        let (first, last) = (met.first()?, met.last()?);
        let few = met.len() <= LONG_RUN && last.place + 1 == first.place + met.len();
        let outwards = met.iter().all(|stretch| stretch.is_outward(directions) == Some(true));
        let between = directions.iter().all(|d| {
            let [right, left] = [first.ends[0], last.ends[1]].map(|p| self.distance(p, *d));
            left < distance as f64 - MARGIN && (distance + 1) as f64 + MARGIN < right
        });
        let long = if met.len() <= SHORT_RUN { 0 } else { Cell::LONG };
        (few && outwards && between).then_some(Cell(long | first.place as u32))
    }

    /// The cell of all other lines.
    #[allow(clippy::cast_possible_truncation, reason = "graphs are numbered by 32 bits")]
    fn add_groups(&mut self, met: &[&Stretch], width: usize, known: &mut HashMap<Vec<u32>, u32>) -> Cell {
        let mut groups: Vec<u32> = vec![0];
        let mut next = 0;
        for stretch in met {
            if next <= stretch.place {
                groups.push(stretch.place as u32);
                groups[0] += 1;
                next = stretch.place + width;
            }
        }
        // neighbouring cells mostly have the same groups: kept once, they take less of the cache
        let at = known.entry(groups).or_insert_with_key(|groups| {
            let at = self.groups.len() as u32;
            self.groups.extend_from_slice(groups);
            at
        });
        Cell(Cell::GROUPS | *at)
    }

    /// The distance of lines with this direction through a point, in cells.
    fn distance(&self, p: [f64; 2], d: [f64; 2]) -> f64 {
        cross([p[0] - self.middle[0], p[1] - self.middle[1]], d) * self.scale + 0.5 * DISTANCES as f64
    }

    /// The numbers of the cells of lines, to which [`WHOLE`] is added.
    #[inline(always)]
    pub(super) fn number<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> F {
        let [zero, one] = [x[0].same(0.0), x[0].same(1.0)];
        let inverse = one / (v[0].abs() + v[1].abs());
        let across = v[1] * (x[0] - self.middle[0]) - v[0] * (x[1] - self.middle[1]);
        let distance = floor(across * inverse * self.scale + 0.5 * DISTANCES as f64, DISTANCES - 1);
        // runs from 0 to 4 once around
        let along = v[0] * inverse;
        let turned = v[1].lt(zero).select(along + 3.0, one - along);
        floor(turned * DIRECTIONS as f64, 4 * DIRECTIONS - 1) * DISTANCES as f64 + distance + WHOLE
    }

    /// Half the larger side of a box around all graphs.
    fn half(&self) -> f64 {
        0.5 * DISTANCES as f64 / self.scale
    }

    /// Whether points are so far from all graphs that nothing can be told of lines through them.
    #[inline(always)]
    pub(super) fn is_far<F: Lane>(&self, x: [F; 2]) -> F::Mask {
        let away = (x[0] - self.middle[0]).abs().max((x[1] - self.middle[1]).abs());
        away.same(0.5 * FAR * DISTANCES as f64).lt(away * self.scale)
    }

    /// The point that a path from far away reaches shortly before it comes to any graph, and when: never if it passes all of them by.
    ///
    /// `x + t v` is computed in twice the digits.
    #[cold]
    #[inline(never)]
    pub(super) fn nearer(&self, x: [f64; 2], v: [f64; 2]) -> ([f64; 2], f64) {
        let speed = v[0].abs() + v[1].abs();
        let direction = v.map(|v| v / speed);
        let after = |time: Double| [0, 1].map(|i| time.times(Double::new(v[i])).plus(Double::new(x[i])).value());
        // the way from a point to where the path is nearest to the middle
        let way = |from: [f64; 2]| {
            let to = [self.middle[0] - from[0], self.middle[1] - from[1]];
            dot(&to, &direction) / dot(&direction, &direction)
        };
        let time = Double::new(way(x) / speed);
        // that time is rounded, so the path is not quite there
        let half = self.half();
        let time = time.plus(Double::new((way(after(time)) - 4.0 * half) / speed));
        let (near, time) = (after(time), time.value());
        let is_near = (0..2).all(|i| (near[i] - self.middle[i]).abs() <= 8.0 * half);
        if is_near && time > 0.0 { (near, time) } else { (x, f64::INFINITY) }
    }

    /// The cell with a [`number`](Lines::number).
    #[inline(always)]
    pub(super) fn cell(&self, number: f64) -> Cell {
        #[allow(clippy::cast_possible_truncation, reason = "the last bits are meant")]
        let number = number.to_bits() as usize;
        self.cells[number % CELLS]
    }

    /// The groups in an open cell.
    #[inline(always)]
    pub(super) fn groups(&self, cell: Cell) -> &[u32] {
        let at = (cell.0 & !Cell::GROUPS) as usize;
        &self.groups[at + 1..=at + self.groups[at] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Graphs, Walls};
    use crate::random;
    use crate::{
        Piece,
        plane::slack,
        shapes::curve::{Aimed, Interval, Polar, PolarFormula},
    };
    use nalgebra::Vector2;

    /// `r = s + a cos nφ`
    #[derive(Clone, Copy, Debug)]
    struct Clover {
        scale: f64,
        a: f64,
        n: f64,
    }

    impl PolarFormula for Clover {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(self.n * angle);
            [self.scale + self.a * cos, -self.n * self.a * sin, -self.n * self.n * self.a * cos]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let [sin, cos] = (angle * self.n).sin_cos();
            [cos * self.a + self.scale, sin * (-self.n * self.a), cos * (-self.n * self.n * self.a)]
        }
    }

    #[test]
    fn what_is_looked_up_is_what_trying_every_graph_finds() {
        let mut random = random::signed(1);
        let mut cut = vec![];
        // the last one has long runs; its waves are so steep that paths along a chord leave its ends at large angles, where either of two
        // graphs is correct
        for (number, (x, a, n, inside)) in [
            (0.0, 0.1, 3.0, true),
            (0.0, 0.2, 5.0, true),
            (0.0, 0.05, 20.0, true),
            (0.25, 0.15, 4.0, false),
            (0.0, 0.005, 100.0, true),
        ]
        .into_iter()
        .enumerate()
        {
            let scale = if inside { 1.0 } else { 0.25 };
            let curve = Polar::new(Vector2::new(x, 0.0), Clover { scale, a: a * scale, n }, inside).unwrap();
            let mut graphs: Vec<_> = curve.graphs().unwrap().into_iter().map(|graph| (number, graph)).collect();
            if number == 3 {
                // two curves, one of them open
                graphs.extend_from_slice(&cut);
                graphs.pop();
            }
            let walls = Graphs::new(&graphs, &[]);
            let size = graphs.iter().map(|(_, graph)| graph.extent().size()).fold(0.0, f64::max);
            for k in 0..20_000 {
                let mut x = [0.7 * random(), 0.7 * random()];
                let mut v = [random(), random()];
                // from the boundary too, and along it
                if k % 2 == 0 && number < 4 {
                    let (_, graph) = &graphs[(k / 2) % graphs.len()];
                    let [p, q] = graph.ends;
                    x = p;
                    if k % 4 == 0 {
                        v = [q[0] - p[0] + 0.01 * v[0] * (q[1] - p[1]), q[1] - p[1] - 0.01 * v[0] * (q[0] - p[0])];
                    }
                }
                let aimed = Aimed::new(x, v);
                let time =
                    graphs.iter().map(|(_, graph)| graph.time(&aimed, slack([size]))).fold(f64::INFINITY, f64::min);
                let found = walls.first_hit(&x, &v).time;
                assert_eq!(found, time, "{number} {x:?} {v:?}");
            }
            cut = graphs;
        }
    }

    #[test]
    fn paths_that_leave_the_table_at_small_angles_are_looked_up_as_others() {
        let mut random = random::signed(5);
        for (a, n) in [(0.2, 3.0), (0.2, 5.0), (0.5, 2.0), (0.05, 20.0)] {
            let curve = Polar::new(Vector2::zeros(), Clover { scale: 1.0, a, n }, true).unwrap();
            let graphs: Vec<_> = curve.graphs().unwrap().into_iter().map(|graph| (0, graph)).collect();
            let walls = Graphs::new(&graphs, &[]);
            let inside = |[x, y]: [f64; 2]| libm::hypot(x, y) < 1.0 + a * libm::cos(n * libm::atan2(y, x)) - 1e-3;
            let mut looked = 0;
            for k in 0..100_000 {
                let [p, q] = graphs[k % graphs.len()].1.ends;
                let (along, turn, back) = (0.5 + 0.6 * random(), 0.3 * random(), 0.3 + 0.3 * random());
                let (sin, cos) = libm::sincos(turn);
                let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
                let [c, d] = [sign * (q[0] - p[0]), sign * (q[1] - p[1])];
                let length = libm::hypot(c, d);
                let v = [(c * cos - d * sin) / length, (c * sin + d * cos) / length];
                let x = [0, 1].map(|i| p[i] + along * (q[i] - p[i]) - back * v[i]);
                if inside(x) {
                    let aimed = Aimed::new(x, v);
                    let slack = slack([1.0 + a]);
                    let time = graphs.iter().map(|(_, graph)| graph.time(&aimed, slack)).fold(f64::INFINITY, f64::min);
                    assert_eq!(walls.first_hit(&x, &v).time, time, "{a} {n} {x:?} {v:?}");
                    looked += 1;
                }
            }
            assert!(looked > 20_000, "{looked}");
        }
    }
}
