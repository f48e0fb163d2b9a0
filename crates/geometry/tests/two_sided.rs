//! Walls with the table on both sides, the two sides of which are described differently.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

mod random;

use core::f64::consts::TAU;
use geometry::{
    Error, Line, Piece, Table, Vector2, WallHit, Walls, WithWalls,
    shapes::{
        Arc, Circle, Ellipse, EllipticArc, Segment,
        curve::{Interval, ParametricCurve, ParametricFormula, Polar, PolarFormula},
    },
};
use random::Random;

type Pieces = Vec<Box<dyn Piece>>;

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

/// `(x + a cos t, y + b sin t)`
#[derive(Clone, Copy, Debug)]
struct Oval([f64; 2], [f64; 2]);

impl Oval {
    fn at(&self, t: f64) -> Vector2<f64> {
        self.jet(t)[0].into()
    }
    fn arc(self, from: f64, to: f64) -> Pieces {
        let ends = [from, to].map(|t| self.at(t));
        ParametricCurve::along(self, [from, to], ends).unwrap().into_iter().map(|p| Box::new(p) as _).collect()
    }
}

impl ParametricFormula for Oval {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let ((sin, cos), Oval([x, y], [a, b])) = (libm::sincos(t), self);
        [[x + a * cos, y + b * sin], [-a * sin, b * cos], [-a * cos, -b * sin]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let ([sin, cos], Oval([x, y], [a, b])) = (t.sin_cos(), *self);
        [[cos * a + x, sin * b + y], [sin * -a, cos * b], [cos * -a, sin * -b]]
    }
}

/// `p + t d`
#[derive(Clone, Copy, Debug)]
struct Straight([f64; 2], [f64; 2]);

impl Straight {
    fn at(&self, t: f64) -> Vector2<f64> {
        self.jet(t)[0].into()
    }
    fn part(self, from: f64, to: f64) -> Pieces {
        let ends = [from, to].map(|t| self.at(t));
        ParametricCurve::along(self, [from, to], ends).unwrap().into_iter().map(|p| Box::new(p) as _).collect()
    }
}

impl ParametricFormula for Straight {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let Straight(p, d) = self;
        [[p[0] + t * d[0], p[1] + t * d[1]], *d, [0.0; 2]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let Straight(p, d) = self;
        [[t * d[0] + p[0], t * d[1] + p[1]], d.map(Interval::from), [Interval::from(0.0); 2]]
    }
}

/// `r`
#[derive(Clone, Copy, Debug)]
struct Constant(f64);

impl PolarFormula for Constant {
    fn jet(&self, _: f64) -> [f64; 3] {
        [self.0, 0.0, 0.0]
    }
    fn jet_over(&self, _: Interval) -> [Interval; 3] {
        self.jet(0.0).map(Interval::from)
    }
}

fn circle(center: [f64; 2], radius: f64, inside: bool) -> Box<dyn Piece> {
    Box::new(Circle::new(center.into(), radius, inside).unwrap())
}
fn polar(center: [f64; 2], radius: f64, inside: bool) -> Box<dyn Piece> {
    Box::new(Polar::new(center.into(), Constant(radius), inside).unwrap())
}
fn side(a: Vector2<f64>, b: Vector2<f64>) -> Box<dyn Piece> {
    Box::new(Segment::new(a, b).unwrap())
}

/// The first hit of a path.
struct First(Line<2>);

impl WithWalls<2> for First {
    type Output = WallHit<f64, 2>;
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        walls.first_hit(&self.0.point.into(), &self.0.velocity.into())
    }
}

/// The points of the first collisions of a specular orbit, no two of which come at one time.
fn collisions(table: &Table, start: Line<2>, count: usize) -> Vec<Vector2<f64>> {
    let mut path = start;
    let mut found = vec![];
    for k in 0..count {
        let hit = table.with_walls(First(path));
        assert!(hit.time > 1e-9 && hit.time.is_finite() && !hit.corner, "{k}: {path:?} {hit:?}");
        let normal = Vector2::from(hit.normal) * hit.inverse;
        path = Line { point: hit.point.into(), velocity: path.velocity - normal * (2.0 * path.velocity.dot(&normal)) };
        found.push(path.point);
    }
    found
}

/// That both tables are valid and have the same collisions, apart from how rounding grows.
fn have_the_same_collisions(name: &str, one: Pieces, other: Pieces, random: &mut Random) {
    let around = || circle([0.0, 0.0], 3.0, true);
    let [one, other] = [one, other].map(|pieces| Table::new(pieces.into_iter().chain([around()]).collect()).unwrap());
    assert_eq!([one.validate(), other.validate()], [Ok(()), Ok(())], "{name}");
    for k in 0..24 {
        let point = v(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
        let (sin, cos) = libm::sincos(random.between(0.0, TAU));
        let start = Line { point, velocity: v(cos, sin) };
        let [a, b] = [&one, &other].map(|table| collisions(table, start, 60));
        for (p, q) in a.iter().zip(&b).take(6) {
            assert!((p - q).norm() < 1e-9, "{name} {k}: {p} {q}");
        }
    }
}

/// There on one piece and back on several.
fn back(there: Box<dyn Piece>, back: impl IntoIterator<Item = Pieces>) -> Pieces {
    [there].into_iter().chain(back.into_iter().flatten()).collect()
}

#[test]
fn the_sides_of_a_wall_may_be_cut_at_different_places() {
    let mut random = Random(1);
    for _ in 0..4 {
        let oval = Oval([random.between(-0.5, 0.5), 0.1], [1.0, random.between(0.5, 1.2)]);
        let [a, b, c] = [random.between(0.1, 0.4), random.between(1.0, 2.0), random.between(3.0, 4.0)];
        let one = || [oval.arc(a, c), oval.arc(c, b), oval.arc(b, a)].into_iter().flatten().collect();
        let both = [oval.arc(a, b), oval.arc(b, c), oval.arc(c, b), oval.arc(b, a)];
        have_the_same_collisions("cut once", one(), both.into_iter().flatten().collect(), &mut random);
        // whole on the one side, in two on the other
        let whole = ParametricCurve::around(oval, [0.0, TAU], false).unwrap().remove(0);
        let closing = ParametricCurve::along(oval, [b, a + TAU], [oval.at(b), oval.at(a)]).unwrap().remove(0);
        let cut: [Box<dyn Piece>; 2] = [Box::new(closing), Box::new(whole)];
        let cut = oval.arc(a, b).into_iter().chain(cut).collect();
        let alike = [true, false].map(|inside| ParametricCurve::around(oval, [0.0, TAU], inside).unwrap().remove(0));
        have_the_same_collisions("whole", cut, alike.map(|piece| Box::new(piece) as _).into(), &mut random);
    }
}

#[test]
fn the_one_side_of_a_wall_may_be_a_shape_and_the_other_a_formula() {
    let mut random = Random(2);
    for _ in 0..4 {
        let mut any = |low, high| random.between(low, high);
        let (center, radius) = ([any(-0.5, 0.5), any(-0.5, 0.5)], any(0.3, 1.2));
        let [t, u] = [any(0.1, 2.0), any(2.5, 6.0)];
        let (p, q) = ([any(-1.0, 0.0), any(-1.0, 1.0)], [any(0.2, 1.0), any(0.2, 1.0)]);
        let circles = |other| vec![circle(center, radius, true), other];
        for formula in [
            polar(center, radius, false),
            Box::new(ParametricCurve::around(Oval(center, [radius; 2]), [0.0, TAU], false).unwrap().remove(0)),
        ] {
            let same = circles(circle(center, radius, false));
            have_the_same_collisions("circle", circles(formula), same, &mut random);
        }
        let round = Oval(center, [radius; 2]);
        let arc = |from, to, inside| Box::new(Arc::new(center.into(), round.at(from), round.at(to), inside).unwrap());
        let parts = |a: f64| [round.arc(u, a), round.arc(a, t)];
        have_the_same_collisions(
            "arc",
            back(arc(t, u, true), parts(0.5 * (t + u))),
            back(arc(t, u, true), [vec![arc(u, t, false) as _]]),
            &mut random,
        );
        let oval = Oval(center, [radius, 0.75]);
        let of_ellipse = |from, to, inside| -> Box<dyn Piece> {
            let ellipse = Ellipse::new(center.into(), [radius, 0.75], 0.0, inside).unwrap();
            Box::new(EllipticArc::new(ellipse, oval.at(from), oval.at(to)).unwrap())
        };
        have_the_same_collisions(
            "elliptic arc",
            back(of_ellipse(t, u, true), [oval.arc(u, t)]),
            back(of_ellipse(t, u, true), [vec![of_ellipse(u, t, false)]]),
            &mut random,
        );
        let line = Straight(p, q);
        let ends = [0.0, 1.0].map(|t| line.at(t));
        for cuts in [vec![line.part(1.0, 0.0)], vec![line.part(1.0, 0.3), line.part(0.3, 0.0)]] {
            let same = vec![side(ends[0], ends[1]), side(ends[1], ends[0])];
            have_the_same_collisions("line", back(side(ends[0], ends[1]), cuts), same, &mut random);
        }
        let there = line.part(0.0, 1.0).remove(0);
        let same = vec![side(ends[0], ends[1]), side(ends[1], ends[0])];
        have_the_same_collisions("lines", back(there, [line.part(1.0, 0.6), line.part(0.6, 0.0)]), same, &mut random);
    }
}

/// `(t, 0)` and, from `t = 0` on, `(t, t⁴)`.
#[derive(Clone, Copy, Debug)]
struct Lifting;

impl ParametricFormula for Lifting {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let s = t.max(0.0);
        [[t, s * s * s * s], [1.0, 4.0 * s * s * s], [0.0, 12.0 * s * s]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let s = Interval::new(t.low.max(0.0), t.high.max(0.0));
        [[t, s.powi(4)], [Interval::from(1.0), s.powi(3) * 4.0], [Interval::from(0.0), s.square() * 12.0]]
    }
}

#[test]
fn sides_that_nearly_coincide_are_refused() {
    let refused = |pieces: Pieces| {
        let table = Table::new(pieces.into_iter().chain([circle([0.0; 2], 3.0, true)]).collect()).unwrap();
        match table.validate() {
            Err(Error::Faces { first, second, .. }) => Some([first, second]),
            other => {
                assert_eq!(other, Ok(()));
                None
            }
        }
    };
    // by some ten to fifty roundings
    for off in [2e-15, 4e-15, 8e-15] {
        let radius = 0.75 + off;
        let near = vec![circle([0.125, 0.25], radius, true), polar([0.125, 0.25], 0.75, false)];
        assert_eq!(refused(near), Some([0, 1]), "{off}");
    }
    // along a part of a piece that ends at no vertex
    let arcs = |cuts: &[f64]| -> Pieces {
        let of =
            |w: &[f64]| ParametricCurve::along(Lifting, [w[0], w[1]], [w[0], w[1]].map(|t| Lifting.jet(t)[0].into()));
        cuts.windows(2).flat_map(|w| of(w).unwrap()).map(|piece| Box::new(piece) as _).collect()
    };
    let corner = || side(v(1.0, 1.0), v(1.0, 0.0));
    let below = side(v(1.0, 0.0), v(-1.0, 0.0));
    let whole: Pieces = arcs(&[-1.0, 1.0]).into_iter().chain([corner(), below]).collect();
    let [first, second] = refused(whole).unwrap();
    assert_eq!((first, second), (0, 2));
    // until both are cut there
    let below = [side(v(1.0, 0.0), v(0.0, 0.0)), side(v(0.0, 0.0), v(-1.0, 0.0))];
    assert_eq!(refused(arcs(&[-1.0, 0.0, 1.0]).into_iter().chain([corner()]).chain(below).collect()), None);
}
