//! A list of a few shapes, tested in lanes.
use super::{CORNER, WallHit, Walls, first::First};
use crate::{
    afar::{NEWTON, on_circle},
    plane::{along, cross, from},
    shapes::{Ellipse, Ground, Segment, Shape},
};
use lanes::{Lane, MOST_LANES, Mask, Rows, dot};
use nalgebra::Vector2;

/// Shapes that are tested one after another, each for all lanes at once.
///
/// Times are compared as fractions, and the data for the landing on the piece that is hit are looked up at the end, so a hit costs
/// one division and one landing however many pieces there are. A vertex shared by neighbours is tested once, with the same result
/// for both, so no path slips through between them.
#[derive(Clone, Debug)]
pub struct Few {
    entries: Vec<Entry>,
    /// The landing data of each entry, of either face of a screen, and a row for paths that hit nothing.
    grounds: Rows,
    /// The numbers of the pieces, where they are not 0, 1, 2, …
    numbers: Option<Rows>,
    /// The ellipses, on which a landing needs more constants.
    ovals: Vec<Ellipse>,
    /// The corners, with the numbers of the pieces that end there.
    corners: Vec<([f64; 2], f64)>,
    /// Straight walls with two sides, and their numbers.
    edges: Vec<(Segment, f64)>,
    /// Size of their coordinates, of which rounding is a fraction.
    size: f64,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    shape: Shape,
    /// Whether it starts where the one before it ends.
    joined: bool,
    /// Whether its start and its end are corners.
    corners: [bool; 2],
    /// The index of its landing data (for a screen, of its first face); for a part of a circle −1 minus that.
    place: f64,
}

/// Stands in place of a unit normal in the landing data of an ellipse.
const OVAL: [f64; 2] = [2.0, 0.0];

/// A vertex as a path sees it.
#[derive(Clone, Copy)]
struct Seen<F: Lane> {
    /// The vector from the start of the path.
    to: [F; 2],
    /// `v × to`: positive on the left.
    turn: F,
}

/// A path from which vertices are viewed.
struct Eye<F: Lane> {
    x: [F; 2],
    v: [F; 2],
    last: Seen<F>,
    /// The least `|v × (corner − x)|`.
    aside: F,
}

impl<F: Lane> Eye<F> {
    #[inline(always)]
    fn see(&mut self, p: &[f64; 2], corner: bool) -> Seen<F> {
        let to = from(self.x, *p);
        let turn = cross(self.v, to);
        if corner {
            self.aside = self.aside.min(turn.abs());
        }
        Seen { to, turn }
    }

    /// The start and the end of a piece, as seen by the path.
    #[inline(always)]
    fn both(&mut self, entry: &Entry, [a, b]: [&[f64; 2]; 2]) -> [Seen<F>; 2] {
        let start = if entry.joined { self.last } else { self.see(a, entry.corners[0]) };
        self.last = self.see(b, entry.corners[1]);
        [start, self.last]
    }
}

impl<F: Lane> Seen<F> {
    #[inline(always)]
    fn left(&self) -> F::Mask {
        self.turn.same(0.0).lt(self.turn)
    }
}

/// A path that passes a corner within this many times the rounding of its position may end in it.
const NEAR: f64 = 8.0;

impl Few {
    /// The shapes with their numbers, and the corners of the boundary.
    pub fn new(shapes: &[(usize, Shape)], corners: &[Vector2<f64>]) -> Few {
        let is_corner = |p: Option<[f64; 2]>| p.is_some_and(|p| corners.contains(&p.into()));
        let (mut entries, mut grounds, mut ovals, mut own): (Vec<Entry>, Vec<_>, Vec<_>, Vec<_>) = Default::default();
        let (mut numbers, mut edges) = (vec![], vec![]);
        let mut end = None;
        for &(number, shape) in shapes {
            let [a, b] = ends(&shape);
            let (place, piece) = (grounds.len() as f64, number as f64);
            // for a straight piece, a point of it and the unit normal into the table; for a circle, its centre, ±1/r and r²; for
            // an ellipse, its index in `ovals`
            let flat = |[a, b]: [f64; 2], [m, n]: [f64; 2]| [a, b, m, n];
            let (ground, place) = match shape.ground() {
                Ground::Flat { through, normal } => (flat(through, normal), place),
                Ground::Faces([there, back]) => {
                    grounds.push(flat(there.start(), there.inward_normal()));
                    numbers.push(piece);
                    (flat(back.start(), back.inward_normal()), place)
                }
                Ground::Round { center: [a, b], to_normal, square } => ([a, b, to_normal, square], -1.0 - place),
                Ground::Oval(ellipse) => {
                    ovals.push(ellipse);
                    ([(ovals.len() - 1) as f64, 0.0, OVAL[0], OVAL[1]], place)
                }
            };
            grounds.push(ground);
            numbers.push(piece);
            let edge = match shape {
                Shape::Segment(side) if side.is_two_sided() => Some(side),
                Shape::Screen(screen) => Some(screen.faces()[0]),
                _ => None,
            };
            edges.extend(edge.map(|edge| (edge, piece)));
            let corners = [a, b].map(|end| edge.is_some() || is_corner(end));
            entries.push(Entry { shape, joined: a.is_some() && a == end, corners, place });
            own.extend([a, b].into_iter().filter(|p| is_corner(*p)).flatten().map(|p| (p, piece)));
            end = b;
        }
        grounds.push([0.0; 4]);
        let is_counted = numbers.iter().enumerate().all(|(place, number)| place as f64 == *number);
        let numbers = numbers.into_iter().chain([0.0]).map(|number| [number, 0.0, 0.0, 0.0]);
        Few {
            entries,
            grounds: Rows::new(grounds),
            numbers: (!is_counted).then(|| Rows::new(numbers.collect())),
            ovals,
            corners: own,
            edges,
            size: corners.iter().flat_map(|c| c.iter()).fold(0.0, |m: f64, c| m.max(c.abs())),
        }
    }

    /// With this many shapes per lane, testing each is as fast as searching a tree of boxes one lane after another.
    pub(super) const PER_LANE: usize = 12;

    /// How many there are.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    /// The lanes that end in a corner.
    #[cold]
    #[inline(never)]
    fn cornered<F: Lane>(&self, x: &[F; 2], point: &[F; 2], piece: F) -> F::Mask {
        let ends = |lane: usize| {
            let [x, point] = [x, point].map(|p| Vector2::from(p.map(|p| p.lane(lane))));
            // a path may come from far beyond the vertices
            let near = CORNER * self.size.max(x.amax());
            let own = self.corners.iter().filter(|(_, number)| *number == piece.lane(lane));
            own.map(|(corner, _)| (point - Vector2::from(*corner)).amax()).any(|distance| distance <= near)
        };
        piece.same(0.0).lt(piece.each(|lane| if ends(lane) { 1.0 } else { 0.0 }))
    }

    /// The time at which a path that runs along a two-sided wall comes to its edge, and the number of that wall.
    #[cold]
    #[inline(never)]
    fn edge_on<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> [F; 2] {
        let (mut times, mut numbers) = ([f64::INFINITY; MOST_LANES], [0.0; MOST_LANES]);
        for lane in 0..F::LANES {
            let [x, v] = [x, v].map(|p| p.map(|p| p.lane(lane)));
            for (edge, number) in &self.edges {
                let time = edge.edge_on(x, v).map_or(f64::INFINITY, |crossing| crossing.time());
                if time < times[lane] {
                    (times[lane], numbers[lane]) = (time, *number);
                }
            }
        }
        [times, numbers].map(|of_lanes| x[0].load(&of_lanes))
    }
}

/// Start and end of a shape, where it has them.
fn ends(shape: &Shape) -> [Option<[f64; 2]>; 2] {
    match shape {
        Shape::Segment(s) => s.vertices().map(|p| Some(*p)),
        Shape::Screen(s) => s.faces()[0].vertices().map(|p| Some(*p)),
        Shape::Arc(s) => s.vertices().map(|p| Some(*p)),
        Shape::EllipticArc(s) => s.vertices().map(|p| Some(*p)),
        Shape::Ray(s) => [Some(s.start()), None],
        Shape::Line(_) | Shape::Circle(_) | Shape::Ellipse(_) => [None; 2],
    }
}

impl Walls<2> for Few {
    fn rounds_normals(&self) -> bool {
        !self.ovals.is_empty()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let (x, v) = (*x, *v);
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let never = zero.same(f64::INFINITY);
        let mut first = First::none(zero);
        let mut eye = Eye { x, v, last: Seen { to: [zero; 2], turn: zero }, aside: never };
        for entry in &self.entries {
            match &entry.shape {
                Shape::Segment(s) => {
                    let [a, b] = eye.both(entry, s.vertices());
                    first.look(s.meet(v, a.to, !a.left() & b.left()), entry.place);
                }
                Shape::Screen(s) => {
                    let [a, b] = eye.both(entry, s.faces()[0].vertices());
                    let [there, back] = s.meet(v, [a.to, b.to], [a.turn, b.turn]);
                    first.look(there, entry.place);
                    first.look(back, entry.place + 1.0);
                }
                Shape::Arc(s) => {
                    let [a, b] = eye.both(entry, s.vertices());
                    first.look(s.meet(x, v, [a.left(), b.left()]), entry.place);
                }
                Shape::Circle(s) => first.look(s.meet(x, v), entry.place),
                Shape::EllipticArc(s) => {
                    let [a, b] = eye.both(entry, s.vertices());
                    first.look(s.meet(x, v, [a.left(), b.left()]), entry.place);
                }
                Shape::Ellipse(s) => first.look(s.meet(x, v), entry.place),
                Shape::Ray(s) => {
                    let end = eye.see(&s.start(), entry.corners[0]);
                    first.look(s.meet(x, v, end.to, end.left()), entry.place);
                }
                Shape::Line(s) => first.look(s.meet(x, v), entry.place),
            }
        }
        let First { num, den, place } = first;
        let round = place.lt(zero);
        let mut piece = round.select(-place - 1.0, place);
        let [a0, a1, n0, n1] = self.grounds.at(piece);
        if let Some(numbers) = &self.numbers {
            [piece, ..] = numbers.at(piece);
        }
        let (anchor, normal) = ([a0, a1], [n0, n1]);
        let mut time = num / den;
        let p = along(x, v, time);
        let y = [p[0] - anchor[0], p[1] - anchor[1]];
        // projected onto the line; or one Newton step towards the circle, as in the landings of the shapes themselves
        let off = -dot(&y, &normal);
        let change = ((normal[1] - y[0] * y[0]) - y[1] * y[1]) * (normal[0] * normal[0] * 0.5);
        let z = [y[0] + y[0] * change, y[1] + y[1] * change];
        let [mut p1, mut p2, mut n1, mut n2] = round.choose(
            [z[0] + anchor[0], z[1] + anchor[1], z[0] * normal[0], z[1] * normal[0]],
            [p[0] + off * normal[0], p[1] + off * normal[1], normal[0], normal[1]],
        );
        let afar = round & one.same(NEWTON).lt(change.abs());
        if afar.any() {
            let (p, n) = on_circle(&y, &v, anchor, normal);
            [p1, p2, n1, n2] = afar.choose([p[0], p[1], n[0], n[1]], [p1, p2, n1, n2]);
        }
        if !self.ovals.is_empty() {
            let oval = num.lt(never) & !round & one.same(1.5).lt(normal[0]);
            for (k, ellipse) in self.ovals.iter().enumerate() {
                let here = oval & (anchor[0] - k as f64).abs().lt(one);
                if here.any() {
                    let (p, n) = ellipse.land_where(here, x, v, time);
                    [p1, p2, n1, n2] = here.choose([p[0], p[1], n[0], n[1]], [p1, p2, n1, n2]);
                }
            }
        }
        let mut point = [p1, p2];
        let mut corner = zero.never();
        let reach = (x[0].abs() + x[1].abs()) + self.size;
        let clear = (reach * (NEAR * CORNER) * (v[0].abs() + v[1].abs())).lt(eye.aside);
        if (!clear).any() {
            corner = self.cornered(&x, &point, piece);
            if !self.edges.is_empty() {
                let [at, edge] = self.edge_on(x, v);
                let sooner = at.lt(time);
                let place = along(x, v, at);
                [time, point[0], point[1], piece] =
                    sooner.choose([at, place[0], place[1], edge], [time, point[0], point[1], piece]);
                corner = corner | sooner;
            }
        }
        WallHit { time, point, normal: [n1, n2], inverse: one, piece, corner }
    }
}
