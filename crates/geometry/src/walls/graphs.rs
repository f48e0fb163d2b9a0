//! Smooth curves of any form, cut into short graphs.
use super::{ByLane, CORNER, WallHit, Walls, corners::Corners};
use crate::{
    Boundary, BoxTree, Extent, Hit, Line,
    boxes::{First, Inside, WIDTH},
    crossing::Crossing,
    plane::slack,
    shapes::curve::{Graph, Local, Meeting, Ray, at_least, grazes, turn},
};
use core::cell::Cell;
use lanes::{Kernel, Lane, MOST_LANES, Mask, stored};
use nalgebra::Vector2;

/// Pieces of a boundary as polynomial graphs over short chords.
///
/// Which of them a path may cross outwards is told by the sides on which it passes their ends, and those are solved, mostly one
/// or two. Of one path eight graphs are looked at in a go, and where there are many only those near it; of many paths side by side
/// one graph for all.
#[derive(Clone, Debug)]
pub struct Graphs(ByLane<All>);

/// From so many blocks of eight on, a tree of boxes is faster than looking at each; see [`Polygon`](super::Polygon), which
/// looks in the same way.
const MANY: usize = 24;

/// So many graphs have a bit each in a number: less than the 52 that it holds.
const PART: usize = 48;

/// Up to so many parts, each graph is looked at for all lanes at once.
const PARTS: usize = 8;

#[derive(Clone, Debug)]
struct All {
    /// The ends of the graphs, coordinate by coordinate: graph `k` runs from `k` to `k + 1`. Behind the last graph of a closed curve,
    /// and wherever the next does not go on where one ends, stands one that does not exist; and in the end there are so many that
    /// eight may be read anywhere.
    ends: [Vec<f64>; 2],
    /// [`Graph::near`]; negative for graphs that do not exist.
    near: Vec<f64>,
    /// For each eight graphs, which of them exist.
    exist: Vec<u8>,
    locals: Vec<Local<f64>>,
    /// The number of the piece of each.
    numbers: Vec<u32>,
    /// Whether there are corners at the start and at the end of each; empty where there are none at all.
    corners: Vec<[bool; 2]>,
    /// Which blocks of eight a path can meet; `None` where it is as well to look at each.
    tree: Option<BoxTree>,
    /// Size of the coordinates.
    size: f64,
    slack: f64,
}

impl Graphs {
    /// Graphs with the numbers of their pieces, in the order of traversal, and the corners of the boundary.
    pub fn new(graphs: &[(usize, Graph)], corners: &[Vector2<f64>]) -> Graphs {
        let known = Corners::new(corners);
        let mut all = All {
            ends: [vec![], vec![]],
            near: vec![],
            exist: vec![],
            locals: vec![],
            numbers: vec![],
            corners: vec![],
            tree: None,
            size: 0.0,
            slack: 0.0,
        };
        let mut boxes: Vec<Extent> = vec![];
        for (i, (number, graph)) in graphs.iter().enumerate() {
            let goes_on = graphs.get(i + 1).is_some_and(|(_, next)| next.ends[0] == graph.ends[1]);
            let flags = graph.ends.map(|end| known.contains(&end.into()));
            all.add(graph.ends[0], graph.near, (*number, graph, flags), &mut boxes);
            if !goes_on {
                all.add(graph.ends[1], -1.0, (*number, graph, [false; 2]), &mut boxes);
            }
        }
        if all.corners.iter().all(|flags| *flags == [false; 2]) {
            all.corners.clear();
        }
        all.size = boxes.iter().map(Extent::size).fold(0.0, f64::max);
        all.slack = slack([all.size]);
        all.tree = (boxes.len() >= MANY).then(|| BoxTree::in_order(&boxes));
        for _ in 0..=WIDTH {
            all.ends.iter_mut().for_each(|ends| ends.push(f64::NAN));
            all.near.push(-1.0);
        }
        Graphs(ByLane(all))
    }
}

/// A whole number below 2⁵².
#[inline(always)]
fn whole(number: f64) -> u64 {
    const UNITS: f64 = 4_503_599_627_370_496.0; // 2⁵²: the last bit is 1
    (number + UNITS).to_bits() ^ UNITS.to_bits()
}

/// Of graphs whose starts and ends lie on the left of a path or not, as bits, those that it passes through outwards; and of
/// those that it `grazes` also those that it does not pass through inwards.
#[inline(always)]
fn crossed(starts: u64, ends: u64, grazed: u64) -> [u64; 2] {
    let through = !starts & ends;
    [through, through | (grazed & !(starts & !ends))]
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

    /// Adds a graph, or one that does not exist, where `near` is negative.
    fn add(
        &mut self,
        start: [f64; 2],
        near: f64,
        (number, graph, corners): (usize, &Graph, [bool; 2]),
        boxes: &mut Vec<Extent>,
    ) {
        let k = self.near.len() % WIDTH;
        if k == 0 {
            self.exist.push(0);
            boxes.push(Extent::EMPTY);
        }
        let last = self.exist.len() - 1;
        if near >= 0.0 {
            self.exist[last] |= 1 << k;
            boxes[last] = boxes[last].union(graph.extent());
        }
        for (ends, coordinate) in self.ends.iter_mut().zip(start) {
            ends.push(coordinate);
        }
        self.near.push(near);
        self.locals.push(graph.local);
        #[allow(clippy::cast_possible_truncation, reason = "pieces are numbered by 32 bits in all trees")]
        self.numbers.push(number as u32);
        self.corners.push(corners);
    }
}

/// The search for the first graph that one path crosses.
struct Search<'a> {
    all: &'a All,
    ray: Ray<f64>,
    path: &'a Line<2>,
    best: Cell<Meeting<f64>>,
}

impl Inside for Search<'_> {
    #[inline(always)]
    fn offer<F: Lane>(&self, zero: F, block: usize, first: &mut First) {
        let (x, v) = (
            [zero.same(self.ray.x[0]), zero.same(self.ray.x[1])],
            [zero.same(self.ray.v[0]), zero.same(self.ray.v[1])],
        );
        let [ends_x, ends_y] = &self.all.ends;
        let (mut starts, mut ends, mut grazed) = (0, 0, 0);
        let mut k = 0;
        while k < WIDTH {
            let at = WIDTH * block + k;
            let start = turn(x, v, [zero.load(&ends_x[at..]), zero.load(&ends_y[at..])]);
            let end = turn(x, v, [zero.load(&ends_x[at + 1..]), zero.load(&ends_y[at + 1..])]);
            starts |= zero.lt(start).bits() << k;
            ends |= zero.lt(end).bits() << k;
            grazed |= grazes([start, end], zero.load(&self.all.near[at..]), at_least(v)).bits() << k;
            k += F::LANES;
        }
        let [between, maybe] = crossed(starts, ends, grazed);
        let mut maybe = maybe & u64::from(self.all.exist[block]);
        while maybe != 0 {
            let k = maybe.trailing_zeros() as usize;
            maybe &= maybe - 1;
            let graph = WIDTH * block + k;
            let meeting = self.all.locals[graph].meet(&self.ray, between >> k & 1 == 1, true, self.all.slack);
            let was = *first;
            first.offer(graph, Crossing { num: meeting.time, den: 1.0 }, |graph| graph);
            if *first != was {
                self.best.set(meeting);
            }
        }
    }
}

impl Kernel for Search<'_> {
    type Output = Option<(usize, Meeting<f64>)>;
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) -> Self::Output {
        let first = if let Some(tree) = &self.all.tree {
            tree.walk(zero, self.path, &self)
        } else {
            let mut first = First::NONE;
            for block in 0..self.all.exist.len() {
                self.offer(zero, block, &mut first);
            }
            first
        };
        first.found().map(|(graph, _)| (graph, self.best.get()))
    }
}

impl Boundary<2> for All {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let ray = Ray::new(path.point.into(), path.velocity.into());
        let none = Meeting { time: f64::INFINITY, point: ray.x, normal: ray.v };
        let (graph, best) = lanes::dispatch(Search { all: self, ray, path, best: Cell::new(none) })?;
        Some(Hit {
            time: best.time,
            point: best.point.into(),
            normal: best.unit_normal().into(),
            piece: self.numbers[graph] as usize,
            corner: self.is_corner(graph, ray.x, best.point),
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
}

impl Kernel for SideBySide<'_> {
    type Output = ();
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) {
        let mut lane = 0;
        while lane < self.lanes {
            let x = [zero.load(&self.x[0][lane..]), zero.load(&self.x[1][lane..])];
            let v = [zero.load(&self.v[0][lane..]), zero.load(&self.v[1][lane..])];
            let (best, graph) = self.all.first(x, v);
            best.time.store(&mut self.hits.time[lane..]);
            let normal = best.unit_normal();
            for i in 0..2 {
                best.point[i].store(&mut self.hits.point[i][lane..]);
                normal[i].store(&mut self.hits.normal[i][lane..]);
            }
            self.hits.graph[lane..lane + F::LANES].copy_from_slice(&graph[..F::LANES]);
            lane += F::LANES;
        }
    }
}

impl All {
    /// Which graphs of a part exist.
    #[inline(always)]
    fn exists(&self, part: usize) -> u64 {
        const BLOCKS: usize = PART / WIDTH;
        let blocks = &self.exist[BLOCKS * part..self.exist.len().min(BLOCKS * (part + 1))];
        blocks.iter().rev().fold(0, |all, eight| all << WIDTH | u64::from(*eight))
    }

    /// The first crossing in every lane, and the graph that is crossed.
    #[inline(always)]
    fn first<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> (Meeting<F>, [usize; MOST_LANES]) {
        let zero = x[0].same(0.0);
        let ray = Ray::new(x, v);
        let speed = at_least(v);
        let mut best = Meeting { time: zero.same(f64::INFINITY), point: x, normal: v };
        let mut found = [0; MOST_LANES];
        // per part of the graphs and lane, a bit for each of them
        let (mut through, mut open) = ([[0; MOST_LANES]; PARTS], [[0; MOST_LANES]; PARTS]);
        let mut counts = [0; MOST_LANES];
        let count = self.numbers.len();
        let parts = count.div_ceil(PART);
        let mut end = turn(x, v, [zero.same(self.ends[0][0]), zero.same(self.ends[1][0])]);
        for part in 0..parts {
            let range = PART * part..count.min(PART * (part + 1));
            // as sums of powers of two
            let (mut starts, mut grazed, mut power) = (zero, zero, 1.0);
            let ends = self.ends[0][range.start + 1..=range.end].iter().zip(&self.ends[1][range.start + 1..=range.end]);
            let last = range.len() - 1;
            for ((end_x, end_y), near) in ends.zip(&self.near[range]) {
                let start = end;
                end = turn(x, v, [zero.same(*end_x), zero.same(*end_y)]);
                starts = zero.lt(start).select(starts + power, starts);
                grazed = grazes([start, end], zero.same(*near), speed).select(grazed + power, grazed);
                power *= 2.0;
            }
            let (after, exist) = (zero.lt(end).bits(), self.exists(part));
            for lane in 0..F::LANES {
                let starts = whole(starts.lane(lane));
                let ends = starts >> 1 | (after >> lane & 1) << last;
                let [between, maybe] = crossed(starts, ends, whole(grazed.lane(lane)));
                (through[part][lane], open[part][lane]) = (between, maybe & exist);
                counts[lane] += (maybe & exist).count_ones();
            }
        }
        let mut part = [0; MOST_LANES];
        for _ in 0..counts.into_iter().fold(0, u32::max) {
            let mut graph = [0; MOST_LANES];
            let mut known = [[0.0; MOST_LANES]; 2];
            for lane in 0..F::LANES {
                while open[part[lane]][lane] == 0 && part[lane] + 1 < parts {
                    part[lane] += 1;
                }
                let part = part[lane];
                let bits = open[part][lane];
                if bits != 0 {
                    let k = bits.trailing_zeros();
                    graph[lane] = PART * part + k as usize;
                    known[0][lane] = 1.0;
                    known[1][lane] = (through[part][lane] >> k & 1) as f64;
                    open[part][lane] = bits & (bits - 1);
                }
            }
            let (wanted, outwards) = (zero.lt(zero.load(&known[0])), zero.lt(zero.load(&known[1])));
            let local = Local::side_by_side(zero, |lane| &self.locals[graph[lane]]);
            let new = local.meet(&ray, outwards, wanted, self.slack);
            let sooner = new.time.lt(best.time);
            let bits = sooner.bits();
            for lane in 0..F::LANES {
                if bits >> lane & 1 == 1 {
                    found[lane] = graph[lane];
                }
            }
            best = best.or(sooner, &new);
        }
        (best, found)
    }
}

impl Walls<2> for Graphs {
    fn is_delicate(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let all = &self.0.0;
        if F::LANES == 1 || all.numbers.len() > PART * PARTS {
            return self.0.first_hit(x, v);
        }
        let none = [0.0; MOST_LANES];
        let mut hits = Hits { time: none, point: [none; 2], normal: [none; 2], graph: [0; MOST_LANES] };
        // in a function of its own, which is compiled once and not for every engine
        lanes::dispatch(SideBySide { all, lanes: F::LANES, x: &stored(x), v: &stored(v), hits: &mut hits });
        let zero = v[0].same(0.0);
        let time = zero.load(&hits.time);
        let [point, normal] = [&hits.point, &hits.normal].map(|a| [zero.load(&a[0]), zero.load(&a[1])]);
        let piece = zero.each(|lane| f64::from(all.numbers[hits.graph[lane]]));
        let mut corner = zero.lt(zero);
        if !all.corners.is_empty() {
            let is = |lane: usize| {
                let at = |a: [F; 2]| a.map(|a| a.lane(lane));
                if all.is_corner(hits.graph[lane], at(*x), at(point)) { 1.0 } else { 0.0 }
            };
            corner = zero.lt(zero.each(is));
        }
        WallHit { time, point, normal, inverse: zero.same(1.0), piece, corner }
    }
}
