//! Pieces and tables whose hits are measured.
use super::curve::{Both, Cut, Oval, Truth, truth_of};
use super::curves::{self, Bulge, Offset, Peanut, Quartic};
use super::errors::Subject;
use super::number::vector;
use super::tables::each_table;
use billiards::geometry::{
    Error, Extent, Line, Piece, Vector2, WallHit,
    shapes::{
        Arc, Bump, Circle, Ellipse, EllipticArc, FullLine, Parallel, Ray, Screen, Segment,
        curve::{Implicit, ImplicitFormula, Interval, ParametricCurve, ParametricFormula, Polar, PolarFormula},
    },
};
use core::f64::consts::TAU;
use std::sync::Arc as Shared;

/// Where a subject is and how large.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) name: &'static str,
    pub(crate) scale: f64,
    pub(crate) shift: [f64; 2],
}

/// As it is named; then not by powers of two larger, smaller, and far from the origin.
pub(crate) const FRAMES: [Frame; 4] = [
    Frame { name: "plain", scale: 1.0, shift: [0.0, 0.0] },
    Frame { name: "huge", scale: 1e100, shift: [0.0, 0.0] },
    Frame { name: "tiny", scale: 1e-100, shift: [0.0, 0.0] },
    Frame { name: "far", scale: 1.0, shift: [12_345.678, -4_321.5] },
];

impl Frame {
    pub(crate) fn point(&self, x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x * self.scale + self.shift[0], y * self.scale + self.shift[1])
    }
    pub(crate) fn size(&self, extent: f64) -> f64 {
        (extent * self.scale).max(self.shift[0].abs())
    }
}

#[derive(Debug)]
struct Fermat;

impl ImplicitFormula for Fermat {
    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        x * x * x * x + y * y * y * y - 1.0
    }
    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [4.0 * x * x * x, 4.0 * y * y * y]
    }
    fn hessian(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        [12.0 * x * x, 0.0, 12.0 * y * y]
    }
    fn hessian_over(&self, [x, y]: [Interval; 2]) -> [Interval; 3] {
        [x.square() * 12.0, Interval::from(0.0), y.square() * 12.0]
    }
    fn extent(&self) -> Extent {
        Extent { min: Vector2::new(-1.0, -1.0), max: Vector2::new(1.0, 1.0) }
    }
}

/// `1 + a cos 2φ`
#[derive(Debug)]
struct Waist(f64);

impl PolarFormula for Waist {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(2.0 * angle);
        [1.0 + self.0 * cos, -2.0 * self.0 * sin, -4.0 * self.0 * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let (sin, cos) = ((angle * 2.0).sin(), (angle * 2.0).cos());
        [cos * self.0 + 1.0, sin * (-2.0 * self.0), cos * (-4.0 * self.0)]
    }
}

/// `(cos t + b cos 2t, sin t + b sin 2t)`
#[derive(Debug)]
struct Limacon(f64);

impl ParametricFormula for Limacon {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let ((sin, cos), (wave, crest), b) = (libm::sincos(t), libm::sincos(2.0 * t), self.0);
        [
            [cos + b * crest, sin + b * wave],
            [-sin - 2.0 * b * wave, cos + 2.0 * b * crest],
            [-cos - 4.0 * b * crest, -sin - 4.0 * b * wave],
        ]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let ([sin, cos], [wave, crest], b) = (t.sin_cos(), (t * 2.0).sin_cos(), self.0);
        [
            [cos + crest * b, sin + wave * b],
            [wave * (-2.0 * b) - sin, cos + crest * (2.0 * b)],
            [crest * (-4.0 * b) - cos, wave * (-4.0 * b) - sin],
        ]
    }
}

/// A piece and the truth about it.
type Known = (&'static str, f64, Box<dyn Piece>, Box<dyn Truth>);

/// Every kind of piece; formulas in the plain frame only, by the majorant method, and cut into graphs among the tables.
fn pieces(frame: &Frame) -> Result<Vec<Known>, Error> {
    let at = |x, y| frame.point(x, y);
    let by = |x: f64| x * frame.scale;
    let mut all: Vec<Known> = vec![];
    let figures: Vec<(&'static str, f64, Box<dyn Piece>)> = vec![
        ("segment", 1.1, Box::new(Segment::new(at(0.3, -0.7), at(1.1, 0.9))?)),
        ("ray, table left", 1.0, Box::new(Ray::new(at(0.25, -0.5), Vector2::new(0.8, 0.33), true)?)),
        ("ray, table right", 1.0, Box::new(Ray::new(at(0.25, -0.5), Vector2::new(0.8, 0.33), false)?)),
        ("line", 1.0, Box::new(FullLine::new(at(0.1, 0.2), Vector2::new(-0.3, 1.0))?)),
        ("circle, inside", 1.0, Box::new(Circle::new(at(0.1, -0.2), by(0.9), true)?)),
        ("circle, outside", 1.0, Box::new(Circle::new(at(0.1, -0.2), by(0.25), false)?)),
        ("arc, inside", 1.0, Box::new(Arc::new(at(0.0, 0.0), at(1.0, 0.0), at(-0.6, 0.8), true)?)),
        ("arc, outside", 1.0, Box::new(Arc::new(at(0.0, 0.0), at(0.6, 0.8), at(-0.28, -0.96), false)?)),
    ];
    for (name, extent, piece) in figures {
        let truth = truth_of(&*piece);
        all.push((name, extent, piece, truth));
    }
    let [a, b] = [at(0.3, -0.7), at(1.1, 0.9)];
    all.push(("screen", 1.1, Box::new(Screen::new(a, b)?), Box::new(Both::new(a.into(), b.into()))));
    let center = at(0.3, -0.2);
    let axes = [by(2.0), by(0.75)];
    let oval = |inside, arc| Oval::new(center.into(), axes, 0.7, inside, arc);
    for (name, part, inside) in
        [("ellipse, inside", "elliptic arc, inside", true), ("ellipse, outside", "elliptic arc, outside", false)]
    {
        let ellipse = Ellipse::new(center, axes, 0.7, inside)?;
        let ends = [by(1.0), by(3.75)].map(|s| ellipse.point_at(s));
        let arc = EllipticArc::new(ellipse, ends[0], ends[1])?;
        all.push((name, 2.0, Box::new(ellipse), Box::new(Cut::new(oval(inside, None)))));
        all.push((part, 2.0, Box::new(arc), Box::new(Cut::new(oval(inside, Some(ends.map(Into::into)))))));
    }
    let (a, b, height) = (at(-0.4, 0.1), at(0.8, 0.5), by(0.125));
    let bump = Bump::new(a, b, height)?;
    all.push((
        "bump",
        1.0,
        Box::new(bump.clone()),
        Box::new(Cut::new(Bulge { a: vector(a.into()), b: vector(b.into()), height })),
    ));
    let base = Ellipse::new(center, axes, 0.7, true)?;
    let distance = by(0.125);
    let parallel = Parallel::new(Shared::new(base), distance, [0.0, base.length()], None)?;
    all.push((
        "parallel of an ellipse",
        2.0,
        Box::new(parallel),
        Box::new(Cut::new(Offset { base: oval(true, None), distance })),
    ));
    let moved = Parallel::new(Shared::new(bump.clone()), distance, [0.0, bump.length()], None)?;
    let base = Bulge { a: vector(a.into()), b: vector(b.into()), height };
    all.push(("parallel of a bump", 1.0, Box::new(moved), Box::new(Cut::new(Offset { base, distance }))));
    if frame.name == "plain" {
        let [quartic, peanut, limacon] = formulas()?;
        all.push(("formula x⁴ + y⁴ = 1", 1.0, quartic, Box::new(Cut::new(Quartic))));
        all.push(("formula 1 + ¼ cos 2φ", 1.25, peanut, Box::new(Cut::new(Peanut(0.25)))));
        all.push(("points e(t) + ¼ e(2t)", 1.25, limacon, Box::new(Cut::new(curves::Limacon(0.25)))));
    }
    Ok(all)
}

pub(crate) fn formulas() -> Result<[Box<dyn Piece>; 3], Error> {
    let polar = Polar::new(Vector2::zeros(), Waist(0.25), true)?;
    let points = ParametricCurve::around(Limacon(0.25), [0.0, TAU], true)?.pop().ok_or(Error::Empty)?;
    Ok([Box::new(Implicit::new(Fermat, true)?), Box::new(polar), Box::new(points)])
}

/// A curve with a cusp.
pub(crate) fn cardioid() -> Result<Vec<Box<dyn Piece>>, Error> {
    let halves = ParametricCurve::around(Limacon(0.5), [0.0, TAU], true)?;
    Ok(halves.into_iter().map(|half| Box::new(half) as _).collect())
}

/// Shows every subject in a frame.
///
/// # Errors
/// None, but that the library's constructors may have some.
pub(crate) fn each(frame: &Frame, mut show: impl FnMut(&Subject<'_>)) -> Result<(), Error> {
    for (name, extent, piece, truth) in pieces(frame)? {
        let hit = |path: &Line<2>| {
            let time = piece.crossing(path).time();
            if !(time < f64::INFINITY) {
                return WallHit::never(path.point.into());
            }
            let landing = piece.landing(path, time);
            let mut hit = WallHit::never(landing.point.into());
            hit.time = time;
            hit.normal = landing.normal.into();
            hit
        };
        let size = frame.size(extent);
        let extent = extent * frame.scale;
        // of an open piece any side of its vertices may be in a table
        let inside = |x: &Vector2<f64>| {
            let closest = piece.closest(x);
            let beyond = piece.ends().is_some_and(|ends| ends.contains(&closest.point));
            beyond || (x - closest.point).dot(&closest.normal) > 0.0
        };
        show(&Subject {
            name,
            size,
            extent,
            pieces: vec![&*piece],
            truth: vec![truth],
            inside: &inside,
            reach: f64::INFINITY,
            hit: &hit,
        });
    }
    each_table(frame, show)
}
