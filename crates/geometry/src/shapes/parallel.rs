//! The curve at a fixed distance from another one.
//!
//! Between points where its tangent is parallel to a path, a curve crosses the path's line at most once. A table of points so dense
//! that between neighbours the direction turns little, and in one sense, therefore finds every crossing; the closest points of the
//! base curve then give the time to the last bits.
use super::{
    Shape,
    curve::{ArcLength, Blocks, Graph, Parametric, rising_root, rough_graphs},
    kink::{kink, turning},
};
use crate::{
    Error,
    crossing::Crossing,
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{once_around, slack},
};
use nalgebra::Vector2;
use std::sync::Arc;

/// Between neighbouring points of the table the direction turns by less than this (radians).
const TURNING: f64 = 0.125;

/// Number of parts into which the curve is cut at first.
const PARTS: usize = 32;

/// Most halvings of one part; a curve that still turns too much has a kink.
const HALVINGS: u32 = 20;

/// The points at distance `R` from part of a base curve, on its table side: `x(s) + R n(s)`.
///
/// The arc length `s` of the base is the parameter; the parallel's own arc length is `s − R θ(s)`, where `θ` is the angle by which
/// the normal has turned, and its curvature is `κ/(1 − κ R)`. It is regular where the base's radius of curvature `1/κ` is greater
/// than `R`.
#[derive(Clone, Debug)]
pub struct Parallel {
    base: Arc<dyn Piece>,
    distance: f64,
    nodes: Vec<Node>,
    blocks: Blocks,
    ends: Option<[Vector2<f64>; 2]>,
    extent: Extent,
    slack: f64,
}

/// A point of the table.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Arc length of the base.
    s: f64,
    /// Arc length of the parallel curve.
    along: f64,
    point: Vector2<f64>,
    normal: Vector2<f64>,
    /// `1 − κ R`
    stretch: f64,
}

impl Parallel {
    /// The curve at `distance` \[L\] from the part of `base` between two arc lengths \[L\]. Its ends are set to `ends` if these are
    /// given and agree to rounding; a whole closed base has a closed parallel.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] for an empty or infinite range or where the parallel has no length, [`Error::Length`] where `distance`
    /// is not positive and finite, [`Error::Bend`] where it reaches beyond a centre of curvature of the base, and [`Error::Kink`]
    /// where the base has a kink that points to its table side, or the tip of a cusp.
    pub fn new(
        base: Arc<dyn Piece>,
        distance: f64,
        range: [f64; 2],
        ends: Option<[Vector2<f64>; 2]>,
    ) -> Result<Parallel, Error> {
        if !(range[0] < range[1] && range.iter().all(|s| s.is_finite())) {
            return Err(Error::ZeroLength);
        }
        if !(distance > 0.0 && distance.is_finite()) {
            return Err(Error::Length { name: "distance", must: "positive and finite", value: distance });
        }
        let node = |s: f64| Node::new(&*base, distance, s);
        let mut nodes = vec![node(range[0])];
        for k in 1..=PARTS {
            let next = node(range[0] + (range[1] - range[0]) * (k as f64 / PARTS as f64));
            extend(&*base, distance, &mut nodes, next, HALVINGS);
        }
        // the ends may be cusps
        if let Some(n) = nodes[1..nodes.len() - 1].iter().find(|n| n.stretch <= 0.0) {
            return Err(Error::Bend { distance, at: base.point_at(n.s).into() });
        }
        if let Some(s) = kink(&*base, nodes.windows(2).map(|w| [w[0].s, w[1].s])) {
            return Err(Error::Kink { at: base.point_at(s).into() });
        }
        let mut along = 0.0;
        for k in 1..nodes.len() {
            along += (nodes[k].s - nodes[k - 1].s) - distance * turning(&nodes[k - 1].normal, &nodes[k].normal);
            nodes[k].along = along;
        }
        if along.is_nan() || along <= 0.0 {
            return Err(Error::ZeroLength);
        }
        let closed = base.ends().is_none() && ends.is_none() && range == [0.0, base.length()];
        let last = nodes.len() - 1;
        let ends = if closed {
            nodes[last].point = nodes[0].point;
            None
        } else {
            let ends = ends.unwrap_or([nodes[0].point, nodes[last].point]);
            (nodes[0].point, nodes[last].point) = (ends[0], ends[1]);
            Some(ends)
        };
        let blocks = Blocks::new(nodes.iter().map(|node| node.point));
        let mut parallel = Parallel { base, distance, nodes, blocks, ends, extent: Extent::EMPTY, slack: 0.0 };
        parallel.extent = parallel.bounds();
        parallel.slack = slack([parallel.extent.size(), distance]);
        Ok(parallel)
    }

    /// The curve that this one is parallel to.
    pub fn base(&self) -> &Arc<dyn Piece> {
        &self.base
    }

    /// The distance from the base \[L\].
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// The arc lengths of the base between which this curve is parallel to it.
    pub(crate) fn base_range(&self) -> [f64; 2] {
        [self.nodes[0].s, self.nodes[self.nodes.len() - 1].s]
    }

    fn node(&self, s: f64) -> Node {
        Node::new(&*self.base, self.distance, s)
    }

    /// The arc length of the base where this curve has the arc length `along`.
    pub(crate) fn base_parameter(&self, along: f64) -> f64 {
        let above = self.nodes.partition_point(|n| n.along <= along).clamp(1, self.nodes.len() - 1);
        let [a, b] = [&self.nodes[above - 1], &self.nodes[above]];
        if along <= a.along {
            return a.s;
        }
        if along >= b.along {
            return b.s;
        }
        let rest = |s: f64| {
            let n = self.node(s);
            [self.along(a, &n) - along, n.stretch]
        };
        rising_root(rest, [a.s, b.s])
    }

    /// Arc length of a point after a node, less than a table step away.
    fn along(&self, before: &Node, n: &Node) -> f64 {
        before.along + ((n.s - before.s) - self.distance * turning(&before.normal, &n.normal))
    }

    /// The base's arc length at the closest point of this curve.
    fn closest_parameter(&self, point: &Vector2<f64>) -> f64 {
        // in most cases the closest point of the whole base will do
        let landing = self.base.closest(point);
        let s = self.base.arc_length_at(&landing.point);
        let [first, last] = [self.nodes[0].s, self.nodes[self.nodes.len() - 1].s];
        let off = point - landing.point;
        let along_normal = off.dot(&landing.normal);
        if first < s && s < last && along_normal > 0.0 && (off - landing.normal * along_normal).norm() <= self.slack {
            return s;
        }
        let tangent = |n: &Node| Vector2::new(n.normal.y, -n.normal.x) * n.stretch;
        let known = |k: usize| (self.nodes[k].s, [self.nodes[k].point, tangent(&self.nodes[k])]);
        self.blocks.closest(self, known, point)
    }

    fn bounds(&self) -> Extent {
        let mut extent = Extent::of(self.nodes.iter().map(|n| n.point));
        for w in self.nodes.windows(2) {
            for i in 0..2 {
                if w[0].normal[1 - i] * w[1].normal[1 - i] < 0.0 {
                    let sign = w[1].normal[1 - i].signum();
                    let turned = |s: f64| [sign * self.node(s).normal[1 - i], 0.0];
                    extent = extent.union(Extent::of([self.node(rising_root(turned, [w[0].s, w[1].s])).point]));
                }
            }
        }
        extent
    }

    /// When the path crosses the curve outwards between two of its points, which lie on the right and on the left of the path.
    fn time_between(&self, path: &Line<2>, a: &Node, b: &Node) -> f64 {
        let v = path.velocity;
        let square = v.norm_squared();
        let height = |p: &Vector2<f64>| v.perp(&(p - path.point));
        let (ga, gb) = (height(&a.point), height(&b.point));
        let guess = a.point + (b.point - a.point) * (ga / (ga - gb));
        let mut t = v.dot(&(guess - path.point)) / square;
        let chord = libm::hypot(b.point.x - a.point.x, b.point.y - a.point.y);
        let mut last = f64::INFINITY;
        for _ in 0..24 {
            let [p, rest] = path.at_exactly(t);
            let landing = self.base.closest(&p);
            let slope = v.dot(&landing.normal);
            let height = (p - landing.point).dot(&landing.normal) - self.distance + rest.dot(&landing.normal);
            let step = height / -slope;
            let strayed = libm::hypot(p.x - guess.x, p.y - guess.y) > chord;
            if strayed || !(slope < 0.0 && step.abs() < 0.5 * last) {
                break;
            }
            t += step;
            last = step.abs();
            if last <= f64::EPSILON * t.abs() {
                return t;
            }
        }
        if last * square.sqrt() <= self.slack {
            return t;
        }
        // nearly tangential: bisect along the curve
        let root = rising_root(
            |s| {
                let n = self.node(s);
                [height(&n.point), v.perp(&Vector2::new(n.normal.y, -n.normal.x)) * n.stretch]
            },
            [a.s, b.s],
        );
        v.dot(&(self.node(root).point - path.point)) / square
    }
}

impl Node {
    fn new(base: &dyn Piece, distance: f64, s: f64) -> Node {
        let Landing { point: foot, normal } = base.landing_at(s);
        let stretch = 1.0 - base.curvature(&foot) * distance;
        Node { s, along: 0.0, point: foot + normal * distance, normal, stretch }
    }
}

/// Adds nodes up to `next`, halving until the direction turns little, and in one sense, from each to the next.
fn extend(base: &dyn Piece, distance: f64, nodes: &mut Vec<Node>, next: Node, halvings: u32) {
    let Some(last) = nodes.last().copied() else { return };
    let middle = || Node::new(base, distance, 0.5 * (last.s + next.s));
    if turning(&last.normal, &next.normal).abs() > TURNING && halvings > 0 {
        let middle = middle();
        extend(base, distance, nodes, middle, halvings - 1);
        extend(base, distance, nodes, next, halvings - 1);
        return;
    }
    // stretch − 1 has the sign of the curvature: split at an inflection
    let (before, after) = (1.0 - last.stretch, 1.0 - next.stretch);
    if before * after < 0.0 {
        let bend = |s: f64| [(1.0 - Node::new(base, distance, s).stretch) * after.signum(), 0.0];
        let s = rising_root(bend, [last.s, next.s]);
        if last.s < s && s < next.s {
            nodes.push(Node::new(base, distance, s));
        }
    }
    nodes.push(next);
}

impl Parametric for Parallel {
    fn at(&self, s: f64) -> [Vector2<f64>; 2] {
        let n = self.node(s);
        [n.point, Vector2::new(n.normal.y, -n.normal.x) * n.stretch]
    }
    /// Point and derivative do so on ellipses, where it matters: near the tip of a flat one the parameter loses most digits.
    fn is_consistent(&self) -> bool {
        matches!(self.base.shape(), Some(Shape::Ellipse(_) | Shape::EllipticArc(_)))
    }
}

/// The base curve parametrised by its arc length.
struct Base<'a>(&'a dyn Piece);

impl Parametric for Base<'_> {
    fn at(&self, s: f64) -> [Vector2<f64>; 2] {
        let Landing { point, normal: n } = self.0.landing_at(s);
        [point, Vector2::new(n.y, -n.x)]
    }
}

impl Piece for Parallel {
    fn graphs(&self) -> Option<Vec<Graph>> {
        let ends = [self.nodes[0], self.nodes[self.nodes.len() - 1]];
        let (range, vertices) = (ends.map(|n| n.s), ends.map(|n| n.point));
        rough_graphs(self, range, vertices, self.extent.size())
    }
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let v = path.velocity;
        let left = |p: &Vector2<f64>| 0.0 < v.perp(&(p - path.point));
        let mut best = f64::INFINITY;
        let mut take = |t: f64| {
            if t >= 0.0 {
                best = best.min(t);
                return;
            }
            // a crossing behind the start counts only if the start lies outside by no more than rounding, and the path goes on
            // outwards
            let slope = v.dot(&self.base.closest(&path.point).normal);
            if slope < 0.0 && t * slope <= self.slack {
                best = 0.0;
            }
        };
        for w in self.nodes.windows(2) {
            let (a, b) = (&w[0], &w[1]);
            match (left(&a.point), left(&b.point)) {
                (false, true) => take(self.time_between(path, a, b)),
                (true, false) => {}
                (side, _) => {
                    // the path's line may still cut off a cap, if the tangent is parallel to it in between
                    let slopes = [v.dot(&a.normal), v.dot(&b.normal)];
                    let chord = b.point - a.point;
                    let cap = v.norm() * chord.norm() * TURNING;
                    let near = [a, b].iter().any(|n| v.perp(&(n.point - path.point)).abs() <= cap);
                    if slopes[0] * slopes[1] < 0.0 && near {
                        let sign = slopes[1].signum();
                        let root = rising_root(|s| [sign * v.dot(&self.node(s).normal), 0.0], [a.s, b.s]);
                        let top = self.node(root);
                        if left(&top.point) != side {
                            take(if side {
                                self.time_between(path, &top, b)
                            } else {
                                self.time_between(path, a, &top)
                            });
                        }
                    }
                }
            }
        }
        if best < f64::INFINITY { Crossing { num: best, den: 1.0 } } else { Crossing::NEVER }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let Landing { point, normal } = self.base.closest(&path.at(time));
        Landing { point: point + normal * self.distance, normal }
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        let curvature = self.base.curvature(&self.base.closest(point).point);
        curvature / (1.0 - curvature * self.distance)
    }
    fn length(&self) -> f64 {
        self.nodes[self.nodes.len() - 1].along
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.landing_at(s).point
    }
    fn landing_at(&self, s: f64) -> Landing {
        let length = self.length();
        let along = if self.ends.is_some() { s } else { once_around(s, length) };
        let Node { point, normal, .. } = self.node(self.base_parameter(along));
        let point = match self.ends {
            Some([a, _]) if s <= 0.0 => a,
            Some([_, b]) if s >= length => b,
            _ => point,
        };
        Landing { point, normal }
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let s = self.closest_parameter(point);
        let below = self.nodes.partition_point(|n| n.s <= s).clamp(1, self.nodes.len() - 1) - 1;
        self.along(&self.nodes[below], &self.node(s))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let s = self.closest_parameter(point);
        let n = self.node(s);
        let [first, last] = [self.nodes[0], self.nodes[self.nodes.len() - 1]];
        let vertex = if s <= first.s { first.point } else { last.point };
        let inner = first.s < s && s < last.s;
        Landing { point: if inner { n.point } else { vertex }, normal: n.normal }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        self.ends
    }
    fn extent(&self) -> Extent {
        self.extent
    }
    fn area(&self) -> f64 {
        // ½∫(x + R n) × d(x + R n) = ½∫x × dx + ½ R [x × n] − R Δs + ½ R² Δθ, with x from the start of the curve: over its chord
        let [first, last] = [&self.nodes[0], &self.nodes[self.nodes.len() - 1]];
        let span = last.s - first.s;
        let turned = (span - last.along) / self.distance;
        // not from the given ends, whose rounding is not that of the arc lengths
        let [from, to] = [first, last].map(|n| self.base.point_at(n.s));
        let feet = [Vector2::zeros(), to - from].map(|x| x - first.normal * self.distance);
        let base = if self.ends.is_none() {
            self.base.area()
        } else {
            let curve = Base(&*self.base);
            let table = ArcLength::new(&curve, self.nodes.iter().map(|n| n.s));
            table.enclosed_area(&curve, from) + 0.5 * feet[0].perp(&feet[1])
        };
        let r = self.distance;
        base + 0.5 * r * (feet[1].perp(&last.normal) - feet[0].perp(&first.normal)) - r * span + 0.5 * r * r * turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{
        Circle, Ellipse, EllipticArc,
        curve::{self, Interval, Polar, PolarFormula},
    };

    fn ellipse(inside: bool) -> Ellipse {
        Ellipse::new(Vector2::new(0.3, -0.2), [2.0, 1.0], 0.5, inside).unwrap()
    }
    fn whole(base: impl Piece + 'static, distance: f64) -> Parallel {
        let length = base.length();
        Parallel::new(Arc::new(base), distance, [0.0, length], None).unwrap()
    }

    #[test]
    fn the_parallel_of_a_circle_is_a_circle() {
        let base = Ellipse::new(Vector2::new(0.5, 0.25), [1.0, 1.0], 0.0, true).unwrap();
        let parallel = whole(base, 0.25);
        let circle = Circle::new(Vector2::new(0.5, 0.25), 0.75, true).unwrap();
        assert!((parallel.length() - circle.length()).abs() < 1e-14);
        assert!((parallel.area() - circle.area()).abs() < 1e-14);
        for k in 0..200 {
            let (t, u) = (f64::from(k), 0.7 * libm::sin(f64::from(k * k)));
            let start = Vector2::new(0.5 + u * libm::cos(3.0 * t), 0.25 + u * libm::sin(3.0 * t));
            let path = Line { point: start, velocity: Vector2::new(libm::cos(t), libm::sin(t)) };
            let times = [parallel.crossing(&path).time(), circle.crossing(&path).time()];
            assert!((times[0] - times[1]).abs() < 1e-14, "{k} {times:?}");
            let landings = [parallel.landing(&path, times[0]), circle.landing(&path, times[0])];
            assert!((landings[0].point - landings[1].point).norm() < 1e-14);
            let arc_lengths = [parallel.arc_length_at(&landings[1].point), circle.arc_length_at(&landings[1].point)];
            // the ends of the seam are one point
            let apart = (arc_lengths[0] - arc_lengths[1]) / circle.length();
            assert!((apart - libm::round(apart)).abs() < 1e-13);
        }
    }

    #[test]
    fn ends_that_are_off_by_little_change_the_area_by_little() {
        // from what lies between the chords, and not as a strip as wide as the distance
        let base: Arc<dyn Piece> = Arc::new(ellipse(true));
        for length in [1e-6, 1e-3, 1.0] {
            let range = [0.7, 0.7 + length];
            let exact = Parallel::new(Arc::clone(&base), 0.4, range, None).unwrap();
            let [from, to] = exact.ends().unwrap();
            for off in [Vector2::new(1e-11, 0.0), Vector2::new(0.0, -1e-11)] {
                let other = Parallel::new(Arc::clone(&base), 0.4, range, Some([from, to + off])).unwrap();
                let change = (other.area() - exact.area()).abs();
                assert!(change <= 1e-11 * length + 1e-16, "{length} {off}: {change:e}");
            }
        }
    }

    #[test]
    fn length_and_area_follow_steiner() {
        // L − 2πR and A − R L + π R², with the signs of the side
        for (inside, turn) in [(true, 1.0), (false, -1.0)] {
            let base = ellipse(inside);
            let r = 0.3;
            let parallel = whole(base, r);
            let pi = core::f64::consts::PI;
            assert!((parallel.length() - (base.length() - turn * 2.0 * pi * r)).abs() < 1e-13);
            let area = base.area() - r * base.length() + turn * pi * r * r;
            assert!((parallel.area() - area).abs() < 1e-13);
            // the parts add up to the whole
            let middle = parallel.point_at(2.5);
            let start = parallel.point_at(0.0);
            let s = parallel.base_parameter(2.5);
            let part = |range, ends| Parallel::new(Arc::new(base), r, range, Some(ends)).unwrap();
            let parts = [part([0.0, s], [start, middle]), part([s, base.length()], [middle, start])];
            assert!((parts[0].length() - 2.5).abs() < 1e-13);
            assert!((parts[0].area() + parts[1].area() - parallel.area()).abs() < 1e-13);
        }
    }

    #[test]
    fn a_path_meets_the_parallel_at_its_distance_from_the_base() {
        for inside in [true, false] {
            let base = ellipse(inside);
            let parallel = whole(base, 0.375);
            let mut hits = 0;
            for k in 0..500 {
                let (t, u) = (f64::from(k), f64::from(k * k % 101));
                let reach = if inside { 0.6 } else { 4.0 };
                let start = Vector2::new(0.3 + reach * libm::cos(u), -0.2 + reach * libm::sin(u));
                let path = Line { point: start, velocity: Vector2::new(libm::cos(t), libm::sin(t)) * 1.5 };
                let time = parallel.crossing(&path).time();
                // march: the distance from the base changes by at most the length of the step
                let mut marched = 0.0;
                for _ in 0..2000 {
                    let p = path.at(marched);
                    let l = base.closest(&p);
                    let gap = (p - l.point).dot(&l.normal) - 0.375;
                    if gap < 1e-13 || marched > 10.0 {
                        break;
                    }
                    marched += gap / 1.5;
                }
                if marched > 10.0 {
                    assert!(time.is_infinite() || time > 8.0, "{k}: {time}");
                } else if time.is_finite() {
                    hits += 1;
                    // marching slows down where the path grazes
                    assert!((time - marched).abs() < 1e-6, "{k}: {time} {marched}");
                    let at = parallel.landing(&path, time);
                    assert!((at.point - path.at(time)).norm() < 1e-14);
                    assert!(at.normal.dot(&path.velocity) < 0.0);
                    assert!(((base.closest(&at.point).point - at.point).norm() - 0.375).abs() < 1e-15);
                }
            }
            assert!(hits > 20);
        }
    }

    #[test]
    fn parts_share_every_path_between_them() {
        let parallel = whole(ellipse(true), 0.25);
        let [a, b] = [parallel.point_at(1.0), parallel.point_at(4.0)];
        let base = Arc::new(ellipse(true));
        let [s, t] = [a, b].map(|p| base.arc_length_at(&p));
        let first = Parallel::new(base.clone(), 0.25, [s, t], Some([a, b])).unwrap();
        let (p, q) = (base.point_at(t), base.point_at(s));
        let rest = EllipticArc::new(*base, p, q).unwrap();
        let length = rest.length();
        let second = Parallel::new(Arc::new(rest), 0.25, [0.0, length], Some([b, a])).unwrap();
        for k in 0..300 {
            let start = Vector2::new(0.3 + 0.5 * libm::cos(f64::from(k * k)), -0.2);
            let angle = f64::from(k) * 0.7;
            let aimed = [a - start, b - start, Vector2::new(libm::cos(angle), libm::sin(angle))];
            for velocity in aimed {
                let path = Line { point: start, velocity };
                let hits = [&first, &second].map(|c| c.crossing(&path).time().is_finite());
                assert!(hits[0] != hits[1], "{k} {hits:?}");
            }
        }
    }

    #[test]
    fn graphs_of_the_parallel_of_a_flat_ellipse_have_its_normals() {
        for width in [0.3, 0.1, 0.03, 0.01, 0.003] {
            let base = Ellipse::new(Vector2::new(0.3, 0.1), [1.0, width], 0.3, false).unwrap();
            let parallel = whole(base, 0.05);
            for graph in parallel.graphs().expect("a smooth curve") {
                let [p, q] = graph.ends.map(Vector2::from);
                let off = Vector2::new(p.y - q.y, q.x - p.x) * (0.01 / (q - p).norm());
                for k in 1..10 {
                    let path = Line { point: p + (q - p) * (0.1 * f64::from(k)) + off, velocity: -off };
                    let aimed = curve::Aimed::new(path.point.into(), path.velocity.into());
                    let meeting = graph.local.meet(&aimed, true, true, 0.0);
                    let (point, normal) = (Vector2::from(meeting.point), Vector2::from(meeting.unit_normal()));
                    let turned = turning(&normal, &base.closest(&point).normal).abs();
                    // the angle for a position known to a few roundings, on an arc of radius 0.05
                    assert!(turned < 1e-13, "{width} {turned:e}");
                }
            }
        }
    }

    #[test]
    fn beyond_a_centre_of_curvature_there_is_no_parallel() {
        let base = ellipse(true); // least radius of curvature 1/2
        let far = Parallel::new(Arc::new(base), 0.6, [0.0, base.length()], None);
        assert!(matches!(far, Err(Error::Bend { distance: 0.6, .. })));
    }

    /// `r = 2 + 0.1 arcsin(sin φ)`, with kinks that its second derivative does not show.
    #[derive(Clone, Debug)]
    struct Sawtooth;

    impl PolarFormula for Sawtooth {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(angle);
            [2.0 + 0.1 * libm::asin(sin), libm::copysign(0.1, cos), 0.0]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let [sin, _] = angle.sin_cos();
            [sin.asin() * 0.1 + 2.0, Interval::new(-0.1, 0.1), Interval::from(0.0)]
        }
    }

    #[test]
    fn a_base_with_a_kink_has_no_parallel_across_it() {
        let base: Arc<dyn Piece> = Arc::new(Polar::new(Vector2::zeros(), Sawtooth, true).unwrap());
        let whole = Parallel::new(base.clone(), 0.2, [0.0, base.length()], None);
        let Err(Error::Kink { at: [x, y] }) = whole else { panic!("{:?}", whole.err()) };
        // at the angle 3π/2, where it points into the table
        assert!(x.abs() < 1e-5 && (y + 2.0 - 0.05 * core::f64::consts::PI).abs() < 1e-5, "{x} {y}");
        assert!(Parallel::new(base, 0.2, [0.0, 6.0], None).is_ok());
    }
}
