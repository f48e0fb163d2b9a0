//! Smooth curves of any form, cut into short graphs.
use super::{
    ByLane, CORNER, WallHit, Walls,
    corners::Corners,
    lines::{Cell, LONG_RUN, Lines, SHORT_RUN},
};
use crate::{
    Boundary, Hit, Line,
    plane::slack,
    shapes::curve::{Aimed, Graph, Local, Meeting, Row, at_least, grazes, turn},
};
use core::hint::select_unpredictable;
use lanes::{Kernel, Lane, MOST_LANES, Mask, Twin, stored};
use nalgebra::Vector2;

/// Pieces of a boundary as polynomial graphs over short chords.
///
/// A table by the position and direction of the path's line tells which graphs it may cross outwards: mostly one of a few; otherwise
/// they are found from the sides on which the line passes their ends, eight graphs at a time. The equation is solved for the graph that
/// is likely to be first, for many paths side by side, and for others only where they might come before it.
#[derive(Clone, Debug)]
pub struct Graphs(ByLane<All>);

/// Number of graphs tested at a time.
const WIDTH: usize = 8;

/// Farther from a vertex than this many times the corner tolerance no hit is a corner, except on paths that come from this many table
/// sizes away.
const ROOM: f64 = 1_048_576.0; // 2²⁰

#[derive(Clone, Debug, Default)]
struct All {
    /// The ends of the graphs, coordinate by coordinate: graph `k` runs from entry `k` to entry `k + 1`. A dummy graph follows the last
    /// graph of a closed curve, and every graph that the next one does not continue; the list is padded with more of these so that eight
    /// may be read anywhere.
    ends: [Vec<f64>; 2],
    /// [`Graph::near`]
    near: Vec<f64>,
    /// A graph is left out as lying behind a path only if it does so by more than its length: no point of it is farther from its start
    /// than this less the length. −∞ for dummy graphs.
    reach: Vec<f64>,
    rows: Vec<Row>,
    /// The piece number of each graph.
    numbers: Vec<u32>,
    /// Whether there are corners at the start and at the end of each; empty where there are none at all.
    corners: Vec<[bool; 2]>,
    /// Which graphs a path can cross.
    lines: Lines,
    /// Size of the coordinates.
    size: f64,
    slack: f64,
}

impl Graphs {
    /// Graphs with the numbers of their pieces, in the order of traversal, and the corners of the boundary.
    pub fn new(graphs: &[(usize, Graph)], corners: &[Vector2<f64>]) -> Graphs {
        let known = Corners::new(corners);
        let mut places = vec![];
        let mut all =
            All { size: graphs.iter().map(|(_, graph)| graph.extent().size()).fold(0.0, f64::max), ..All::default() };
        for (i, (number, graph)) in graphs.iter().enumerate() {
            let goes_on = graphs.get(i + 1).is_some_and(|(_, next)| next.ends[0] == graph.ends[1]);
            places.push((all.rows.len(), graph));
            let flags = graph.ends.map(|end| known.contains(&end.into()));
            all.add(graph.ends[0], [graph.near, graph.near + 2.0 * graph.length()], (*number, graph, flags));
            if !goes_on {
                all.add(graph.ends[1], [0.0, f64::NEG_INFINITY], (*number, graph, [false; 2]));
            }
        }
        if all.corners.iter().all(|flags| *flags == [false; 2]) {
            all.corners.clear();
        }
        all.slack = slack([all.size]);
        all.lines = Lines::new(&places, WIDTH);
        // a run may be read beyond its end; where rounding decides everything, even a graph
        let (last, number) = (all.rows.last().copied(), all.numbers.last().copied());
        all.rows.extend(core::iter::repeat_n(last, LONG_RUN).flatten());
        all.numbers.extend(core::iter::repeat_n(number, LONG_RUN).flatten());
        for _ in 0..=LONG_RUN {
            all.ends.iter_mut().for_each(|ends| ends.push(0.0));
            all.near.push(0.0);
            all.reach.push(f64::NEG_INFINITY);
        }
        Graphs(ByLane(all))
    }
}

impl All {
    /// Whether a point on a graph is a corner.
    fn is_corner(&self, graph: usize, x: [f64; 2], point: [f64; 2]) -> bool {
        let Some(flags) = self.corners.get(graph) else { return false };
        // a path may come from far beyond the vertices
        let near = CORNER * self.size.max(x[0].abs()).max(x[1].abs());
        let at = |k: usize| (0..2).all(|i| (point[i] - self.ends[i][k]).abs() <= near);
        (flags[0] && at(graph)) || (flags[1] && at(graph + 1))
    }

    /// Moves the points from which paths of some lanes come from far away nearer; returns when they are there.
    #[cold]
    #[inline(never)]
    fn approach(&self, mut far: u64, x: &mut [[f64; MOST_LANES]; 2], v: &[[f64; MOST_LANES]; 2]) -> [f64; MOST_LANES] {
        let mut later = [0.0; MOST_LANES];
        while far != 0 {
            let lane = far.trailing_zeros() as usize;
            far &= far - 1;
            let (near, time) = self.lines.nearer([x[0][lane], x[1][lane]], [v[0][lane], v[1][lane]]);
            later[lane] = time;
            // where it passes by, any path that hits something will do
            [x[0][lane], x[1][lane]] = if time < f64::INFINITY { near } else { self.lines.middle };
        }
        later
    }

    /// A graph in its own coordinates.
    #[inline(always)]
    fn local(&self, graph: usize) -> Local<f64> {
        Local::of(0.0, |_| &self.rows[graph]).0
    }

    /// Adds a graph, or a dummy.
    fn add(&mut self, start: [f64; 2], [near, reach]: [f64; 2], (number, graph, corners): (usize, &Graph, [bool; 2])) {
        for (ends, coordinate) in self.ends.iter_mut().zip(start) {
            ends.push(coordinate);
        }
        self.near.push(near);
        self.reach.push(reach);
        // between these places there is no corner
        let near = 4.0 * (ROOM * CORNER) * self.size / graph.length();
        let [low, high] = corners.map(|corner| if corner { 1.0 - near } else { f64::INFINITY });
        self.rows.push(graph.local.row([-low, high]));
        #[allow(clippy::cast_possible_truncation, reason = "pieces are numbered by 32 bits in all trees")]
        self.numbers.push(number as u32);
        self.corners.push(corners);
    }

    /// Of eight consecutive graphs, without those that lie far behind the start of a path: bit masks of those that it certainly crosses
    /// outwards and of those that it may cross outwards; `ways` gets lower bounds of the distances to them times `|v|`.
    #[inline(always)]
    fn eight<F: Lane>(&self, x: [F; 2], v: [F; 2], group: u32, ways: &mut [f64]) -> [u64; 2] {
        let zero = x[0].same(0.0);
        let speed = at_least(v);
        let first = group as usize;
        let [ends_x, ends_y] = self.ends.each_ref().map(|ends| &ends[first..=first + WIDTH]);
        let [nears, reaches] = [&self.near, &self.reach].map(|all| &all[first..first + WIDTH]);
        let (mut starts, mut ends, mut grazed, mut behind) = (0, 0, 0, 0);
        let mut k = 0;
        while k < WIDTH {
            let from = [x[0] - zero.load(&ends_x[k..]), x[1] - zero.load(&ends_y[k..])];
            let start = v[1] * from[0] - v[0] * from[1];
            let end = turn(x, v, [zero.load(&ends_x[k + 1..]), zero.load(&ends_y[k + 1..])]);
            let (back, reach) = (from[0] * v[0] + from[1] * v[1], zero.load(&reaches[k..]) * speed);
            starts |= zero.lt(start).bits() << k;
            ends |= zero.lt(end).bits() << k;
            grazed |= grazes([start, end], zero.load(&nears[k..]), speed).bits() << k;
            behind |= reach.lt(back).bits() << k;
            (-back - reach).store(&mut ways[k..]);
            k += F::LANES;
        }
        let through = !starts & ends & !behind;
        [through, through | (grazed & !(starts & !ends) & !behind)]
    }

    /// The graph that a path crosses among at most `MOST` consecutive ones of which it crosses exactly one: the first that ends to its
    /// left.
    #[inline(always)]
    fn of_run<const MOST: usize, F: Lane>(&self, zero: F, x: [f64; 2], v: [f64; 2], first: usize) -> usize {
        let (x, v) = ([zero.same(x[0]), zero.same(x[1])], [zero.same(v[0]), zero.same(v[1])]);
        let [ends_x, ends_y] = self.ends.each_ref().map(|ends| &ends[first + 1..first + 1 + MOST]);
        // the last one certainly does
        let (mut left, mut k) = (1 << (MOST - 1), 0);
        while k < MOST {
            left |= zero.lt(turn(x, v, [zero.load(&ends_x[k..]), zero.load(&ends_y[k..])])).bits() << k;
            k += F::LANES;
        }
        // without a branch, which would be unpredictable
        first + left.trailing_zeros() as usize
    }

    /// The graph that a path is likely to cross first.
    #[inline(always)]
    fn pick<F: Lane>(&self, zero: F, x: [f64; 2], v: [f64; 2], groups: &[u32]) -> Pick {
        let (x, v) = ([zero.same(x[0]), zero.same(x[1])], [zero.same(v[0]), zero.same(v[1])]);
        let mut pick = Pick { graph: 0, through: false, way: f64::INFINITY, others: f64::INFINITY };
        // the bits of eight groups fit in one number, so what a path may cross in them is examined in one loop, whose end is predicted
        // more often than the ends of eight loops
        for groups in groups.chunks(WIDTH) {
            let (mut through, mut maybe, mut ways) = (0, 0, [0.0; WIDTH * WIDTH]);
            for (g, group) in groups.iter().enumerate() {
                let masks = self.eight(x, v, *group, &mut ways[WIDTH * g..][..WIDTH]);
                through |= masks[0] << (WIDTH * g);
                maybe |= masks[1] << (WIDTH * g);
            }
            // mostly one or two, between which nothing branches
            while maybe != 0 {
                let k = maybe.trailing_zeros() as usize;
                let rest = maybe & (maybe - 1);
                let alone = rest == 0;
                let l = select_unpredictable(alone, k, rest.trailing_zeros() as usize % ways.len());
                maybe = rest & rest.wrapping_sub(1);
                let [a, b] = [ways[k], select_unpredictable(alone, f64::INFINITY, ways[l])];
                let other = b < a;
                let (k, near, far) = (select_unpredictable(other, l, k), b.min(a), b.max(a));
                if near < pick.way {
                    let others = pick.way.min(far);
                    let graph = groups[k / WIDTH] as usize + k % WIDTH;
                    pick = Pick { graph, through: through >> k & 1 == 1, way: near, others };
                } else {
                    pick.others = pick.others.min(near);
                }
            }
        }
        pick
    }

    /// The graph that a path crosses before the given time, at which it crosses another one, and where; `None` if there is no such
    /// graph.
    #[inline(always)]
    fn before<F: Lane>(
        &self,
        zero: F,
        aimed: &Aimed<f64>,
        groups: &[u32],
        (mut time, another): (f64, usize),
    ) -> Option<(Meeting<f64>, usize)> {
        let (x, v) = ([zero.same(aimed.x[0]), zero.same(aimed.x[1])], [zero.same(aimed.v[0]), zero.same(aimed.v[1])]);
        let mut best = None;
        for group in groups {
            let first = *group as usize;
            let mut ways = [0.0; WIDTH];
            let [through, mut maybe] = self.eight(x, v, *group, &mut ways);
            while maybe != 0 {
                let k = maybe.trailing_zeros() as usize;
                maybe &= maybe - 1;
                if first + k == another || time < ways[k] * aimed.inverse {
                    continue;
                }
                let meeting = self.local(first + k).meet(aimed, through >> k & 1 == 1, true, self.slack);
                if meeting.time < time {
                    time = meeting.time;
                    best = Some((meeting, first + k));
                }
            }
        }
        best
    }
}

/// The graph that is likely to be crossed first.
struct Pick {
    graph: usize,
    through: bool,
    /// A lower bound of the distance to it times `|v|`; infinite where there is none.
    way: f64,
    /// The same for all others that may be crossed.
    others: f64,
}

/// Whether another graph may be crossed before this time.
#[inline(always)]
fn is_doubtful<F: Lane>(aimed: &Aimed<F>, time: F, others: F) -> F::Mask {
    others.lt(others.same(f64::INFINITY)) & !time.lt(others * aimed.inverse)
}

/// The search for the first graph that one path crosses.
struct Search<'a> {
    all: &'a All,
    aimed: Aimed<f64>,
}

impl Kernel for Search<'_> {
    type Output = (Meeting<f64>, usize);
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) -> Self::Output {
        let Search { all, aimed } = self;
        let cell = all.lines.cell(all.lines.number(aimed.x, aimed.v));
        if !cell.is_open() {
            let first = cell.first();
            let graph = if cell.is_long() {
                all.of_run::<LONG_RUN, _>(zero, aimed.x, aimed.v, first)
            } else {
                all.of_run::<SHORT_RUN, _>(zero, aimed.x, aimed.v, first)
            };
            return (all.local(graph).meet(&aimed, true, true, all.slack), graph);
        }
        let groups = all.lines.groups(cell);
        let pick = all.pick(zero, aimed.x, aimed.v, groups);
        let meeting = all.local(pick.graph).meet(&aimed, pick.through, pick.way < f64::INFINITY, all.slack);
        let sooner = if is_doubtful(&aimed, meeting.time, pick.others) {
            all.before(zero, &aimed, groups, (meeting.time, pick.graph))
        } else {
            None
        };
        sooner.unwrap_or((meeting, pick.graph))
    }
}

impl Boundary<2> for All {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let (x, v) = (path.point.into(), path.velocity.into());
        let (x, later) = if self.lines.is_far(x) { self.lines.nearer(x, v) } else { (x, 0.0) };
        if later == f64::INFINITY {
            return None;
        }
        let aimed = Aimed::new(x, v);
        let (best, graph) = lanes::dispatch(Search { all: self, aimed });
        (best.time < f64::INFINITY).then(|| Hit {
            time: later + best.time,
            point: best.point.into(),
            normal: best.unit_normal().into(),
            piece: self.numbers[graph] as usize,
            corner: self.is_corner(graph, aimed.x, best.point),
        })
    }
}

/// First hits of several paths.
struct SideBySide<'a> {
    all: &'a All,
    lanes: usize,
    x: &'a [[f64; MOST_LANES]; 2],
    v: &'a [[f64; MOST_LANES]; 2],
    hits: &'a mut Hits,
}

struct Hits {
    time: [f64; MOST_LANES],
    point: [[f64; MOST_LANES]; 2],
    normal: [[f64; MOST_LANES]; 2],
    graph: [usize; MOST_LANES],
    /// Those that may be corners, as bits.
    doubtful: u64,
}

impl Kernel for SideBySide<'_> {
    type Output = ();
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) {
        if self.lanes == 2 * F::LANES {
            self.all.first(zero, Twin::of(zero), 0, self.x, self.v, self.hits);
        } else {
            let mut lane = 0;
            while lane < self.lanes {
                self.all.first(zero, zero, lane, self.x, self.v, self.hits);
                lane += F::LANES;
            }
        }
    }
}

impl All {
    /// The first crossings of paths in lanes of `F`, from some lane on; graphs are tested in lanes of `G`.
    #[inline(always)]
    fn first<G: Lane, F: Lane>(
        &self,
        narrow: G,
        zero: F,
        from: usize,
        x: &[[f64; MOST_LANES]; 2],
        v: &[[f64; MOST_LANES]; 2],
        hits: &mut Hits,
    ) {
        let aimed = Aimed::new(
            [zero.load(&x[0][from..]), zero.load(&x[1][from..])],
            [zero.load(&v[0][from..]), zero.load(&v[1][from..])],
        );
        let mut numbers = [0.0; MOST_LANES];
        self.lines.number(aimed.x, aimed.v).store(&mut numbers);
        let mut cells = [Cell::NONE; MOST_LANES];
        let mut graph = [0; MOST_LANES];
        let (mut open, mut long) = (0_u64, 0_u64);
        // in a loop of its own: cells are in the second cache, and more of them are under way if nothing else comes between
        for lane in 0..F::LANES {
            let cell = self.lines.cell(numbers[lane]);
            cells[lane] = cell;
            open |= u64::from(cell.is_open()) << lane;
            long |= u64::from(cell.is_long()) << lane;
        }
        for lane in 0..F::LANES {
            let (first, at) = (cells[lane].first(), from + lane);
            graph[lane] = self.of_run::<SHORT_RUN, _>(narrow, [x[0][at], x[1][at]], [v[0][at], v[1][at]], first);
        }
        long &= !open;
        while long != 0 {
            let lane = long.trailing_zeros() as usize;
            long &= long - 1;
            let (first, at) = (cells[lane].first(), from + lane);
            graph[lane] = self.of_run::<LONG_RUN, _>(narrow, [x[0][at], x[1][at]], [v[0][at], v[1][at]], first);
        }
        let (mut through, mut ways, mut others) = ([1.0; MOST_LANES], [0.0; MOST_LANES], [f64::INFINITY; MOST_LANES]);
        while open != 0 {
            let lane = open.trailing_zeros() as usize;
            open &= open - 1;
            let at = from + lane;
            let pick = self.pick(narrow, [x[0][at], x[1][at]], [v[0][at], v[1][at]], self.lines.groups(cells[lane]));
            graph[lane] = pick.graph;
            through[lane] = if pick.through { 1.0 } else { 0.0 };
            (ways[lane], others[lane]) = (pick.way, pick.others);
        }
        let (local, [low, high]) = Local::of(zero, |lane| &self.rows[graph[lane]]);
        let wanted = zero.load(&ways).lt(zero.same(f64::INFINITY));
        let best = local.meet(&aimed, zero.lt(zero.load(&through)), wanted, self.slack);
        let doubtful = is_doubtful(&aimed, best.time, zero.load(&others));
        best.time.store(&mut hits.time[from..]);
        let normal = best.unit_normal();
        for i in 0..2 {
            best.point[i].store(&mut hits.point[i][from..]);
            normal[i].store(&mut hits.normal[i][from..]);
        }
        hits.graph[from..from + F::LANES].copy_from_slice(&graph[..F::LANES]);
        let far = zero.same(ROOM * self.size).lt(aimed.x[0].abs().max(aimed.x[1].abs()));
        let mut doubtful = doubtful.bits();
        hits.doubtful |= ((best.place.lt(low) | high.lt(best.place) | far).bits() | doubtful) << from;
        while doubtful != 0 {
            let lane = doubtful.trailing_zeros() as usize;
            doubtful &= doubtful - 1;
            let at = from + lane;
            let aimed = Aimed::new([x[0][at], x[1][at]], [v[0][at], v[1][at]]);
            let groups = self.lines.groups(cells[lane]);
            let Some((best, graph)) = self.before(narrow, &aimed, groups, (hits.time[at], hits.graph[at])) else {
                continue;
            };
            let normal = best.unit_normal();
            hits.time[at] = best.time;
            for i in 0..2 {
                (hits.point[i][at], hits.normal[i][at]) = (best.point[i], normal[i]);
            }
            hits.graph[at] = graph;
        }
    }
}

impl Walls<2> for Graphs {
    fn rounds_normals(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let all = &self.0.0;
        if all.rows.is_empty() {
            return WallHit::never(*x);
        }
        if F::LANES == 1 {
            return self.0.first_hit(x, v);
        }
        let (none, v) = ([0.0; MOST_LANES], stored(v));
        let (mut from, far) = (stored(x), all.lines.is_far(*x));
        let later = far.any().then(|| all.approach(far.bits(), &mut from, &v));
        let mut hits = Hits { time: none, point: [none; 2], normal: [none; 2], graph: [0; MOST_LANES], doubtful: 0 };
        // in a function of its own, which is compiled once and not for every engine
        lanes::dispatch(SideBySide { all, lanes: F::LANES, x: &from, v: &v, hits: &mut hits });
        let zero = x[0].same(0.0);
        let mut time = zero.load(&hits.time);
        if let Some(later) = later {
            time = zero.load(&later) + time;
        }
        let [point, normal] = [&hits.point, &hits.normal].map(|a| [zero.load(&a[0]), zero.load(&a[1])]);
        let piece = zero.each(|lane| f64::from(all.numbers[hits.graph[lane]]));
        let mut corner = zero.never();
        if !all.corners.is_empty() && hits.doubtful != 0 {
            let (mut doubtful, mut corners) = (hits.doubtful, [0.0; MOST_LANES]);
            while doubtful != 0 {
                let lane = doubtful.trailing_zeros() as usize;
                doubtful &= doubtful - 1;
                let from = [from[0][lane], from[1][lane]];
                if all.is_corner(hits.graph[lane], from, point.map(|x| x.lane(lane))) {
                    corners[lane] = 1.0;
                }
            }
            corner = zero.lt(zero.load(&corners));
        }
        WallHit { time, point, normal, inverse: zero.same(1.0), piece, corner }
    }
}
