//! A closed curve given by an equation `f(x, y) = 0`.
mod alone;
mod followed;

use alone::alone;
use followed::is_followed;

use super::{ArcLength, Graph, Interval, Parametric, Smooth, first_rise, rough_graphs};
use crate::{
    Error, ImplicitRule,
    crossing::Crossing,
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{once_around, slack},
};
use core::fmt::Debug;
use nalgebra::Vector2;
use std::sync::OnceLock;

/// A function `f` of the plane, twice differentiable, negative inside one smooth closed curve and positive outside it.
///
/// The functions without a body are required. `hessian_over` is what makes the first hit certain: write the same formulas as in `hessian`
/// with [`Interval`]s. If only a bound `|f_xx|, |f_xy|, |f_yy| ≤ c` is known, return `[Interval::new(-c, c); 3]`.
///
/// ```
/// use geometry::{Extent, Line, Piece, Vector2, shapes::curve::{Implicit, ImplicitFormula, Interval}};
///
/// /// `x⁴ + y⁴ = 1`
/// #[derive(Debug)]
/// struct Fermat;
/// impl ImplicitFormula for Fermat {
///     fn value(&self, [x, y]: [f64; 2]) -> f64 {
///         x * x * x * x + y * y * y * y - 1.0
///     }
///     fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
///         [4.0 * x * x * x, 4.0 * y * y * y]
///     }
///     fn hessian(&self, [x, y]: [f64; 2]) -> [f64; 3] {
///         [12.0 * x * x, 0.0, 12.0 * y * y]
///     }
///     fn hessian_over(&self, [x, y]: [Interval; 2]) -> [Interval; 3] {
///         [x.square() * 12.0, Interval::from(0.0), y.square() * 12.0]
///     }
///     fn extent(&self) -> Extent {
///         Extent { min: Vector2::new(-1.0, -1.0), max: Vector2::new(1.0, 1.0) }
///     }
/// }
/// let table = Implicit::new(Fermat, true)?;
/// let diagonal = Line { point: Vector2::zeros(), velocity: Vector2::new(1.0, 1.0) };
/// assert!((table.crossing(&diagonal).time() - libm::pow(0.5, 0.25)).abs() < 2.0 * f64::EPSILON);
/// # Ok::<(), geometry::Error>(())
/// ```
pub trait ImplicitFormula: Debug + Send + Sync {
    /// `f` at a point.
    fn value(&self, point: [f64; 2]) -> f64;

    /// `[f_x, f_y]`; not zero on the curve.
    fn gradient(&self, point: [f64; 2]) -> [f64; 2];

    /// `[f_xx, f_xy, f_yy]`
    fn hessian(&self, point: [f64; 2]) -> [f64; 3];

    /// Intervals that contain `f_xx`, `f_xy` and `f_yy` everywhere in a box; the narrower, the faster.
    fn hessian_over(&self, region: [Interval; 2]) -> [Interval; 3];

    /// Intervals that contain `f_x` and `f_y` everywhere in a box. It is asked for only where the second derivatives have no bound, so it
    /// need not be implemented if they are bounded everywhere.
    fn gradient_over(&self, _region: [Interval; 2]) -> [Interval; 2] {
        [Interval::ENTIRE; 2]
    }

    /// An interval that contains `f` everywhere in a box. It need not be implemented if the derivatives are bounded wherever `f` is; where
    /// they are not, as those of the polar angle at the origin, it tells that the curve does not pass.
    fn value_over(&self, _region: [Interval; 2]) -> Interval {
        Interval::ENTIRE
    }

    /// A box that contains the curve, not very much larger than it.
    fn extent(&self) -> Extent;
}

/// A formula times a power of two that brings its gradient near 1: the curve is the same to the last bit, and squares of `f` and its
/// derivatives neither over- nor underflow.
#[derive(Clone, Debug)]
struct Levelled<F> {
    formula: F,
    factor: f64,
}

impl<F: ImplicitFormula> Levelled<F> {
    /// Scales a formula by its gradient at a point near the curve.
    fn at(formula: F, point: Vector2<f64>) -> Levelled<F> {
        let gradient = Vector2::from(formula.gradient(point.into())).amax();
        let (_, exponent) = libm::frexp(gradient);
        let is_some = gradient > 0.0 && gradient.is_finite();
        Levelled { formula, factor: if is_some { libm::ldexp(1.0, (-exponent).min(1023)) } else { 1.0 } }
    }

    /// An interval times the factor.
    fn level(&self, over: Interval) -> Interval {
        Interval { low: over.low * self.factor, high: over.high * self.factor }
    }
}

impl<F: ImplicitFormula> ImplicitFormula for Levelled<F> {
    fn value(&self, point: [f64; 2]) -> f64 {
        self.formula.value(point) * self.factor
    }
    fn gradient(&self, point: [f64; 2]) -> [f64; 2] {
        self.formula.gradient(point).map(|x| x * self.factor)
    }
    fn hessian(&self, point: [f64; 2]) -> [f64; 3] {
        self.formula.hessian(point).map(|x| x * self.factor)
    }
    fn hessian_over(&self, region: [Interval; 2]) -> [Interval; 3] {
        self.formula.hessian_over(region).map(|x| self.level(x))
    }
    fn gradient_over(&self, region: [Interval; 2]) -> [Interval; 2] {
        self.formula.gradient_over(region).map(|x| self.level(x))
    }
    fn value_over(&self, region: [Interval; 2]) -> Interval {
        self.level(self.formula.value_over(region))
    }
    fn extent(&self) -> Extent {
        self.formula.extent()
    }
}

/// The closed curve `f = 0`, with the table inside or outside.
///
/// Along a path `f` is a function of time; [`first_rise`] finds where it first changes sign in the right sense.
///
/// Traversed counter-clockwise with the table inside, clockwise with it outside, from the rightmost point on the
/// horizontal line through the middle of [`ImplicitFormula::extent`], if that line meets the curve.
#[derive(Clone, Debug)]
pub struct Implicit<F> {
    formula: Levelled<F>,
    inside: bool,
    /// The formula's box, a little larger.
    region: Extent,
    /// The values that `f` may have on the curve.
    noise: f64,
    /// Points of the curve, so close to each other that it is a graph over each chord; the last is the first.
    vertices: Vec<Vector2<f64>>,
    table: ArcLength,
    area: f64,
    extent: Extent,
    /// Computed when first needed.
    graphs: OnceLock<Option<Vec<Graph>>>,
}

/// Cosine of the greatest angle between a chord and the curve at its ends: 0.15.
const STRAIGHT: f64 = 0.988_77;
/// Most chords; a curve that needs more is not smooth, or not closed.
const CHORDS: usize = 100_000;

impl<F: ImplicitFormula> Implicit<F> {
    /// The curve `f = 0`, with the table inside (`inside`) or outside.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the box is empty or infinite; [`Error::NoCurve`] if no curve is found in it; [`Error::Inverted`] if `f` is positive inside;
    /// [`Error::Curve`] if the box cuts the curve or holds another zero of `f`, or if the curve is not smooth. (A zero that is as near to
    /// the curve as the points tabulated for its length are to each other there is not detected; nor is one as near as they are anywhere,
    /// if `f` has the wrong sign in no square of 10⁻⁵ of the box.)
    pub fn new(formula: F, inside: bool) -> Result<Implicit<F>, Error> {
        let given = formula.extent();
        let size = (given.max - given.min).amax();
        if !(given.is_finite() && given.min.x < given.max.x && given.min.y < given.max.y && size.is_finite()) {
            return Err(Error::Parameter { name: "extent", must: "a finite box that is not empty", value: size });
        }
        // a curve may touch the given box
        let room = Vector2::repeat(size / 1_048_576.0);
        let region = Extent { min: given.min - room, max: given.max + room };
        let middle = (given.min + given.max) * 0.5;
        let start = seed(&formula, &region).ok_or_else(|| Error::NoCurve { value: formula.value(middle.into()) })?;
        let formula = Levelled::at(formula, start);
        let vertices = trace(&formula, &region, start)?;
        let chords = Chords { formula: &formula, vertices: &vertices };
        let count = u32::try_from(vertices.len()).unwrap_or(u32::MAX);
        let table = ArcLength::new(&chords, (0..count).map(f64::from));
        let area = table.refined_area(&chords, vertices[0]);
        if area <= 0.0 || area.is_nan() {
            return Err(Error::Inverted);
        }
        alone(&formula, &region, &table)?;
        let extent = table.extent(&chords);
        let position = slack([region.min.x, region.min.y, region.max.x, region.max.y]);
        let noise = vertices.iter().fold(0.0_f64, |noise, p| {
            let [fx, fy] = formula.gradient((*p).into());
            noise.max(4.0 * formula.value((*p).into()).abs()).max(position * libm::hypot(fx, fy))
        });
        Ok(Implicit { formula, inside, region, noise, vertices, table, area, extent, graphs: OnceLock::new() })
    }

    /// The formula.
    pub fn formula(&self) -> &F {
        &self.formula.formula
    }

    fn chords(&self) -> Chords<'_, Levelled<F>> {
        Chords { formula: &self.formula, vertices: &self.vertices }
    }

    fn side(&self) -> f64 {
        if self.inside { 1.0 } else { -1.0 }
    }

    /// A point within rounding of the curve, projected onto it, and the normal there.
    fn project(&self, point: Vector2<f64>) -> Landing {
        let (mut p, mut gradient) = (point, Vector2::from(self.formula.gradient(point.into())));
        for _ in 0..2 {
            let step = gradient * (self.formula.value(p.into()) / gradient.norm_squared());
            if step.x.is_finite() && step.y.is_finite() {
                p -= step;
                gradient = self.formula.gradient(p.into()).into();
            }
        }
        Landing { point: p, normal: gradient * (-self.side() / libm::hypot(gradient.x, gradient.y)) }
    }

    /// Whether nothing can hide between points of the curve: around none of its graphs can the second derivatives be far greater than at
    /// points of the curve.
    fn is_calm(&self, graphs: &[Graph]) -> bool {
        let bend = self.vertices.iter().fold(0.0_f64, |m, p| {
            let [fx, fy] = self.formula.gradient((*p).into());
            let most = self.formula.hessian((*p).into()).into_iter().fold(0.0_f64, |m, a| m.max(a.abs()));
            m.max(most).max(libm::hypot(fx, fy) / self.extent.size())
        });
        graphs.iter().all(|graph| {
            let Extent { min, max } = graph.extent();
            let around = [0, 1].map(|i| Interval::new(min[i], max[i]));
            self.formula.hessian_over(around).iter().all(|a| a.magnitude() <= 4.0 * bend)
        })
    }

    /// From arc length counter-clockwise to arc length in the sense of traversal, and back.
    fn traversed(&self, s: f64) -> f64 {
        if self.inside || s == 0.0 { s } else { self.table.length() - s }
    }

    /// The times between which a path is in the region; `None` if it never is.
    fn stay(&self, path: &Line<2>) -> Option<[f64; 2]> {
        let [mut enter, mut leave] = [0.0_f64, f64::INFINITY];
        for i in 0..2 {
            let (x, v) = (path.point[i], path.velocity[i]);
            let (low, high) = (self.region.min[i], self.region.max[i]);
            if v == 0.0 {
                if x < low || x > high {
                    return None;
                }
            } else {
                let (a, b) = ((low - x) / v, (high - x) / v);
                enter = enter.max(a.min(b));
                leave = leave.min(a.max(b));
            }
        }
        (enter < leave && leave.is_finite()).then_some([enter, leave])
    }
}

/// A point of the curve: the rightmost zero on the horizontal line through the middle of the box, or on another one.
fn seed<F: ImplicitFormula>(formula: &F, region: &Extent) -> Option<Vector2<f64>> {
    let at = |x: f64, y: f64| region.min + (region.max - region.min).component_mul(&Vector2::new(x, y));
    let negative = |x: f64, y: f64| formula.value(at(x, y).into()) < 0.0;
    let columns = 512;
    // 1/2, 1/4, 3/4, 1/8, 3/8, …
    let rows = (1..=8).flat_map(|level: u32| {
        let parts = 1_u32 << level;
        (1..parts).step_by(2).map(move |k| f64::from(k) / f64::from(parts))
    });
    for y in rows {
        let column = |k: u32| f64::from(k) / f64::from(columns);
        let Some(k) = (0..columns).rev().find(|&k| negative(column(k), y) != negative(column(k + 1), y)) else {
            continue;
        };
        let (mut low, mut high) = (column(k), column(k + 1));
        let left = negative(low, y);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if negative(middle, y) == left {
                low = middle;
            } else {
                high = middle;
            }
        }
        return Some(at(high, y));
    }
    None
}

/// The last step of Newton's method onto a curve, in units of the box: the next one would be below rounding. Where steps stop becoming
/// shorter before that, as from far beside the tip of a flat curve, they do not lead to the curve.
const LAST: f64 = 1e-8;

/// Newton's method along the gradient in a box of some size: the point, and the unit tangent there with `f < 0` on its left.
fn onto<F: ImplicitFormula>(formula: &F, mut p: Vector2<f64>, size: f64) -> Option<[Vector2<f64>; 2]> {
    let mut last = f64::INFINITY;
    for _ in 0..16 {
        let gradient = Vector2::from(formula.gradient(p.into()));
        let step = gradient * (formula.value(p.into()) / gradient.norm_squared());
        let length = libm::hypot(step.x, step.y);
        if !length.is_finite() {
            return None;
        }
        if length >= 0.5 * last {
            break;
        }
        p -= step;
        last = length;
    }
    Some([p, tangent(formula, p)?]).filter(|_| last <= LAST * size)
}

/// The unit tangent at a point, with `f < 0` on its left.
fn tangent<F: ImplicitFormula>(formula: &F, p: Vector2<f64>) -> Option<Vector2<f64>> {
    let [x, y] = formula.gradient(p.into());
    let slope = libm::hypot(x, y);
    (slope > 0.0 && slope.is_finite()).then(|| Vector2::new(-y, x) / slope)
}

/// Whether a chord makes small angles with the curve at its ends, given as points and unit tangents.
fn is_straight([p, t]: [Vector2<f64>; 2], [q, u]: [Vector2<f64>; 2]) -> bool {
    let chord = q - p;
    let least = STRAIGHT * chord.norm();
    chord.dot(&t) >= least && chord.dot(&u) >= least && t.dot(&u) > 0.0
}

/// Where a curve has a radius of curvature of this many steps or less, chords of two steps turn by more than [`STRAIGHT`] allows.
const NARROW: f64 = 8.0;

/// The radius of curvature of the level curve through a point \[L\].
fn bend_radius<F: ImplicitFormula>(formula: &F, p: Vector2<f64>) -> f64 {
    let (gradient, [xx, xy, yy]) = (Vector2::from(formula.gradient(p.into())), formula.hessian(p.into()));
    let slope = libm::hypot(gradient.x, gradient.y);
    let [x, y] = [gradient.x / slope, gradient.y / slope];
    slope / (xx * y * y - 2.0 * xy * x * y + yy * x * x).abs()
}

/// Vertices along the curve, counter-clockwise, the last equal to the first.
fn trace<F: ImplicitFormula>(formula: &F, region: &Extent, start: Vector2<f64>) -> Result<Vec<Vector2<f64>>, Error> {
    let size = (region.max - region.min).amax();
    let least = size / 1_073_741_824.0;
    let rough = |p: Vector2<f64>| {
        let is_narrow = bend_radius(formula, p) <= NARROW * least;
        Error::Curve { must: if is_narrow { ImplicitRule::Wide } else { ImplicitRule::Smooth }, at: p.into() }
    };
    // the curve may come back close to itself
    let follows = |p: [Vector2<f64>; 2], q: [Vector2<f64>; 2]| is_straight(p, q) && is_followed(formula, [p[0], q[0]]);
    let first = onto(formula, start, size).ok_or_else(|| rough(start))?;
    let mut here = first;
    let mut vertices = vec![first[0]];
    let mut step = size / 64.0;
    while vertices.len() < CHORDS {
        let home = first[0] - here[0];
        if vertices.len() > 2 && home.norm() <= 2.0 * step && follows(here, first) {
            vertices.push(first[0]);
            return Ok(vertices);
        }
        match onto(formula, here[0] + here[1] * step, size) {
            // at a kink a step may lead back to where it began
            Some(next) if (0.5 * step..=2.0 * step).contains(&(next[0] - here[0]).norm()) && follows(here, next) => {
                let [p, _] = next;
                let inside = |i: usize| region.min[i] <= p[i] && p[i] <= region.max[i];
                if !(inside(0) && inside(1)) {
                    return Err(Error::Curve { must: ImplicitRule::InItsBox, at: p.into() });
                }
                here = next;
                vertices.push(p);
                step = (1.5 * step).min(size / 16.0);
            }
            _ => step *= 0.5,
        }
        if step < least {
            return Err(rough(here[0]));
        }
    }
    Err(rough(here[0]))
}

/// The curve as a graph over each chord; the parameter counts chords.
struct Chords<'a, F> {
    formula: &'a F,
    vertices: &'a [Vector2<f64>],
}

impl<F: ImplicitFormula> Parametric for Chords<'_, F> {
    fn at(&self, u: f64) -> [Vector2<f64>; 2] {
        let last = self.vertices.len() - 2;
        // u is not negative and far below 2⁵³
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked by min and max")]
        let chord = (u.max(0.0) as usize).min(last);
        let (a, b) = (self.vertices[chord], self.vertices[chord + 1]);
        let along = b - a;
        let across = Vector2::new(-along.y, along.x);
        let base = a + along * (u - chord as f64);
        let (mut height, mut last) = (0.0, f64::INFINITY);
        let mut slope = 0.0;
        for _ in 0..16 {
            let p = base + across * height;
            let gradient = Vector2::from(self.formula.gradient(p.into()));
            let rate = gradient.dot(&across);
            slope = -gradient.dot(&along) / rate;
            let step = -self.formula.value(p.into()) / rate;
            if step.abs() >= 0.5 * last || step.is_nan() {
                break;
            }
            height += step;
            last = step.abs();
        }
        [base + across * height, along + across * slope]
    }
}

/// `±f` along a path.
struct Along<'a, F> {
    formula: &'a F,
    path: Line<2>,
    side: f64,
}

impl<F: ImplicitFormula> Smooth for Along<'_, F> {
    fn jet(&self, t: f64) -> [f64; 2] {
        let p = self.path.at(t);
        let gradient = Vector2::from(self.formula.gradient(p.into()));
        [self.side * self.formula.value(p.into()), self.side * gradient.dot(&self.path.velocity)]
    }

    fn first_derivative(&self, over: Interval) -> Interval {
        let (x, v) = (self.path.point, self.path.velocity);
        let [along, across] = self.formula.gradient_over([over * v.x + x.x, over * v.y + x.y]);
        (along * v.x + across * v.y) * self.side
    }

    fn second_derivative(&self, over: Interval) -> Interval {
        let (x, v) = (self.path.point, self.path.velocity);
        let [xx, xy, yy] = self.formula.hessian_over([over * v.x + x.x, over * v.y + x.y]);
        (xx * (v.x * v.x) + xy * (2.0 * v.x * v.y) + yy * (v.y * v.y)) * self.side
    }
}

impl<F: ImplicitFormula> Piece for Implicit<F> {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let Some([enter, leave]) = self.stay(path) else { return Crossing::NEVER };
        let start = Line { point: path.at(enter), velocity: path.velocity };
        let along = Along { formula: &self.formula, path: start, side: self.side() };
        match first_rise(&along, Interval { low: 0.0, high: leave - enter }, self.noise) {
            Some(time) => Crossing { num: enter + time, den: 1.0 },
            None => Crossing::NEVER,
        }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.project(path.at(time))
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        let [fx, fy] = self.formula.gradient((*point).into());
        let [fxx, fxy, fyy] = self.formula.hessian((*point).into());
        let size = libm::hypot(fx, fy);
        let (nx, ny) = (fx / size, fy / size);
        self.side() * (fxx * ny * ny - 2.0 * fxy * nx * ny + fyy * nx * nx) / size
    }
    fn length(&self) -> f64 {
        self.table.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        let s = once_around(s, self.length());
        self.chords().at(self.table.parameter(&self.chords(), self.traversed(s)))[0]
    }
    fn landing_at(&self, s: f64) -> Landing {
        self.project(self.point_at(s))
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let u = self.table.closest(&self.chords(), point);
        self.traversed(self.table.at_parameter(&self.chords(), u))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let u = self.table.closest(&self.chords(), point);
        self.project(self.chords().at(u)[0])
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }
    fn extent(&self) -> Extent {
        self.extent
    }
    fn graphs(&self) -> Option<Vec<Graph>> {
        let cut = || {
            let count = (self.vertices.len() - 1) as f64;
            let range = if self.inside { [0.0, count] } else { [count, 0.0] };
            let graphs = rough_graphs(&self.chords(), range, [self.vertices[0]; 2], self.extent.size())?;
            self.is_calm(&graphs).then_some(graphs)
        };
        self.graphs.get_or_init(cut).clone()
    }
    fn area(&self) -> f64 {
        self.side() * self.area
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of some radius, in a box of some size.
    #[derive(Debug)]
    struct Round {
        radius: f64,
        size: f64,
    }
    impl ImplicitFormula for Round {
        fn value(&self, [x, y]: [f64; 2]) -> f64 {
            x * x + y * y - self.radius * self.radius
        }
        fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
            [2.0 * x, 2.0 * y]
        }
        fn hessian(&self, _: [f64; 2]) -> [f64; 3] {
            [2.0, 0.0, 2.0]
        }
        fn hessian_over(&self, _: [Interval; 2]) -> [Interval; 3] {
            [2.0, 0.0, 2.0].map(Interval::from)
        }
        fn extent(&self) -> Extent {
            Extent { min: Vector2::repeat(-self.size), max: Vector2::repeat(self.size) }
        }
    }

    #[test]
    fn a_circle_far_smaller_than_its_box_is_said_to_be_so() {
        for radius in [1e-10, 3e-15] {
            let found = Implicit::new(Round { radius, size: 0.5 }, true).map(|_| ());
            let Err(Error::Curve { must: ImplicitRule::Wide, at }) = found else { panic!("{radius}: {found:?}") };
            assert!((libm::hypot(at[0], at[1]) / radius - 1.0).abs() < 1e-6, "{radius}: {at:?}");
            // the box made smaller, as the message says
            let found = Implicit::new(Round { radius, size: 2.0 * radius }, true).unwrap();
            assert!((found.length() / (core::f64::consts::TAU * radius) - 1.0).abs() < 1e-14, "{radius}");
        }
        assert!(Implicit::new(Round { radius: 1e-8, size: 0.5 }, true).is_ok());
    }
}
