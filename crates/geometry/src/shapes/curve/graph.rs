//! A short stretch of a curve as a polynomial over its chord, which answers in lanes.
use super::arc_length::integral;
use crate::{
    piece::{Extent, Landing},
    plane::along,
};
use lanes::{Lane, Mask};
use nalgebra::Vector2;

/// Degree of the polynomials: higher ones make fewer and longer stretches.
pub(super) const DEGREE: usize = 11;

/// A stretch of a curve that bends one way: heights over its chord, given by a polynomial.
///
/// Traversed with the table on its left. A path crosses it outwards at most once. If it crosses twice, the outward crossing is the later
/// one on a stretch that bulges outwards, and the earlier one on a stretch that bulges inwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Graph {
    pub(crate) ends: [[f64; 2]; 2],
    /// The distances of the ends from any line that crosses it twice add up to less than this.
    pub(crate) near: f64,
    pub(crate) local: Local<f64>,
}

/// A graph in its own coordinates, one or one per lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Local<F> {
    /// The middle of the chord.
    pub(super) origin: [F; 2],
    /// The unit normal of the chord away from the table.
    pub(super) outward: [F; 2],
    /// 2/length of the chord.
    pub(super) inverse: F,
    /// Coefficients of the height \[L\] as a polynomial in `u`, which runs from −1 to 1.
    pub(super) heights: [F; DEGREE + 1],
    /// Upper bound of a sixth of the third derivative of the height \[L\].
    pub(super) third: F,
}

/// Where a path crosses a graph outwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting<F: Lane> {
    /// Time of the crossing; infinite where there is none.
    pub(crate) time: F,
    pub(crate) point: [F; 2],
    /// The position along the chord, from −1 to 1.
    pub(crate) place: F,
    /// Into the table, not of unit length.
    pub(crate) normal: [F; 2],
}

impl<F: Lane> Meeting<F> {
    /// The unit normal into the table.
    #[inline(always)]
    pub(crate) fn unit_normal(&self) -> [F; 2] {
        let [a, b] = self.normal;
        let inverse = a.same(1.0) / (a * a + b * b).sqrt();
        [a * inverse, b * inverse]
    }
}

/// A path, prepared for meeting graphs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aimed<F> {
    pub(crate) x: [F; 2],
    pub(crate) v: [F; 2],
    /// `1/|v|²`
    pub(crate) inverse: F,
}

impl<F: Lane> Aimed<F> {
    #[inline(always)]
    pub(crate) fn new(x: [F; 2], v: [F; 2]) -> Self {
        Aimed { x, v, inverse: v[0].same(1.0) / (v[0] * v[0] + v[1] * v[1]) }
    }
}

/// `v × (p − x)`, whose sign tells on which side of a path `p` lies.
#[inline(always)]
pub(crate) fn turn<F: Lane>(x: [F; 2], v: [F; 2], p: [F; 2]) -> F {
    // as cross(v, p − x), arranged for p in memory
    v[1] * (x[0] - p[0]) - v[0] * (x[1] - p[1])
}

/// Whether a path may cross a graph twice, given the turns to the graph's ends; `speed` is at least `|v|`.
#[inline(always)]
pub(crate) fn grazes<F: Lane>(turns: [F; 2], near: F, speed: F) -> F::Mask {
    (turns[0] + turns[1]).abs().lt(near * speed)
}

/// An upper bound of the length of a vector.
#[inline(always)]
pub(crate) fn at_least<F: Lane>(v: [F; 2]) -> F {
    v[0].abs() + v[1].abs()
}

/// The degree that is enough for a first approximation.
const LOW: usize = 5;

/// An error (in half lengths of the chord) that one step with all powers mostly reduces below rounding.
const NEARBY: f64 = 1.0 / 16_384.0;

/// An error below rounding.
const SMALL: f64 = f64::EPSILON / 4.0;

/// A step after which the next one is below rounding, even where there is no crossing.
const STILL: f64 = 1.0 / 33_554_432.0; // 2⁻²⁵

/// Most steps. One or two are typical; a path that is tangent to rounding takes some more.
const STEPS: u32 = 12;

/// How far beyond its ends (in half lengths of the chord) a graph is still evaluated.
pub(super) const BEYOND: f64 = 1.0625;

impl Graph {
    /// Length of the chord.
    pub(crate) fn length(&self) -> f64 {
        2.0 / self.local.inverse
    }

    /// Arc length \[L\], to some digits.
    pub(crate) fn arc_length(&self) -> f64 {
        let speed = |u: f64| {
            let [_, incline, _] = self.local.jet(u, DEGREE);
            libm::hypot(1.0, incline * self.local.inverse)
        };
        0.5 * self.length() * integral(speed, -1.0, 1.0)
    }

    /// A box around it.
    pub(crate) fn extent(&self) -> Extent {
        // the height is at most `near`
        let Extent { min, max } = Extent::of(self.ends.map(Into::into));
        Extent { min: min.add_scalar(-self.near), max: max.add_scalar(self.near) }
    }

    /// The corners of a rectangle that contains it.
    pub(crate) fn hull(&self) -> [[f64; 2]; 4] {
        let ([p, q], [n0, n1]) = (self.ends, self.local.outward);
        let moved = |p: [f64; 2], by: f64| [p[0] + by * n0, p[1] + by * n1];
        [moved(p, -self.near), moved(p, self.near), moved(q, -self.near), moved(q, self.near)]
    }

    /// The outward normals at its ends, not of unit length; those between them point between them.
    pub(crate) fn normals(&self) -> [[f64; 2]; 2] {
        let [n0, n1] = self.local.outward;
        [-1.0, 1.0].map(|u| {
            let [_, incline, _] = self.local.jet(u, DEGREE);
            let incline = incline * self.local.inverse;
            [n0 + n1 * incline, n1 - n0 * incline]
        })
    }

    /// The point at a place along the chord, from −1 to 1, and the unit normal there.
    pub(crate) fn at(&self, place: f64) -> Landing {
        let ([n0, n1], along) = (self.local.outward, place / self.local.inverse);
        let [height, incline, _] = self.local.jet(place, DEGREE);
        let incline = incline * self.local.inverse;
        let point = Vector2::from(self.local.origin) + Vector2::new(n0 * height - n1 * along, n1 * height + n0 * along);
        Landing { point, normal: Vector2::new(-n0 - n1 * incline, n0 * incline - n1).normalize() }
    }

    /// When a path crosses it outwards; infinite if it does not.
    pub(crate) fn time(&self, path: &Aimed<f64>, slack: f64) -> f64 {
        let turns = self.ends.map(|end| turn(path.x, path.v, end));
        let [start, end] = turns.map(|turn| 0.0 < turn);
        let through = !start && end;
        let backwards = start && !end;
        if !through && (backwards || !grazes(turns, self.near, at_least(path.v))) {
            return f64::INFINITY;
        }
        self.local.meet(path, through, true, slack).time
    }

    /// The same moved by a vector \[L\].
    #[must_use]
    pub(crate) fn translated(mut self, by: [f64; 2]) -> Graph {
        for p in self.ends.iter_mut().chain([&mut self.local.origin]) {
            *p = crate::plane::moved(*p, by);
        }
        self
    }
}

/// The numbers of a [`Local`] as they lie in memory, in whole cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Row([[f64; 4]; 5]);

impl Local<f64> {
    /// Its numbers, and two more.
    pub(crate) fn row(&self, [low, high]: [f64; 2]) -> Row {
        let Local { origin: [x, y], outward: [n0, n1], inverse, heights, third } = *self;
        let four = |k: usize| core::array::from_fn(|i| heights[4 * k + i]);
        Row([[x, y, n0, n1], four(0), four(1), four(2), [inverse, third, low, high]])
    }
}

impl<F: Lane> Local<F> {
    /// The graphs of some rows, one per lane, and what else the rows hold.
    #[inline(always)]
    pub(crate) fn of<'a>(zero: F, row: impl Fn(usize) -> &'a Row) -> (Self, [F; 2]) {
        let [x, y, n0, n1] = zero.columns(|lane| &row(lane).0[0]);
        let [a, b, c, d] = zero.columns(|lane| &row(lane).0[1]);
        let [e, f, g, h] = zero.columns(|lane| &row(lane).0[2]);
        let [i, j, k, l] = zero.columns(|lane| &row(lane).0[3]);
        let [inverse, third, low, high] = zero.columns(|lane| &row(lane).0[4]);
        let heights = [a, b, c, d, e, f, g, h, i, j, k, l];
        (Local { origin: [x, y], outward: [n0, n1], inverse, heights, third }, [low, high])
    }

    /// The components of a vector along the chord and across it.
    #[inline(always)]
    fn turned(&self, y: [F; 2]) -> [F; 2] {
        let [n0, n1] = self.outward;
        [n0 * y[1] - n1 * y[0], n0 * y[0] + n1 * y[1]]
    }

    /// Height over the chord and its first two derivatives, with powers up to `degree`, which is odd; the second only to about three
    /// digits, which affects the rate of convergence but not the limit.
    ///
    /// Separating even and odd powers, `p = e(u²) + u o(u²)`, gives two dependency chains of half the length.
    #[inline(always)]
    fn jet(&self, u: F, degree: usize) -> [F; 3] {
        let c = &self.heights;
        let square = u * u;
        let zero = u.same(0.0);
        let (mut even, mut odd) = (c[degree - 1], c[degree]);
        let (mut even_rate, mut odd_rate) = (zero, zero);
        let mut k = degree - 1;
        while k > 0 {
            k -= 2;
            even_rate = even_rate * square + even;
            odd_rate = odd_rate * square + odd;
            even = even * square + c[k];
            odd = odd * square + c[k + 1];
        }
        let rate = even_rate * u + odd_rate * square;
        [even + odd * u, odd + (rate + rate), ((c[5] * (u * 20.0) + c[4] * 12.0) * u + c[3] * 6.0) * u + (c[2] + c[2])]
    }

    /// The step in time from `u` to the rising root of a parabola with this value, slope and second derivative, or to the end of the
    /// graph if that comes first; the square of the slope at the root, negative where there is none; and that slope.
    #[inline(always)]
    fn step(&self, u: F, rate: F, [g, slope, bend]: [F; 3]) -> [F; 3] {
        let [zero, one] = [g.same(0.0), g.same(1.0)];
        let square = slope * slope - (g + g) * bend;
        let root = square.max(zero).sqrt();
        let falls = slope.lt(zero);
        let num = falls.select(root - slope, -(g + g));
        // the sign of the bend is known and not left to rounding
        let den = falls.select(bend.abs().copysign(-self.heights[2]), slope + root);
        let flat = !zero.lt(den.abs());
        let mut dt = flat.select(zero, num / flat.select(one, den));
        let beyond = !(u + dt * rate).abs().lt(one.same(BEYOND));
        if beyond.any() {
            let end = (one.same(BEYOND).copysign(dt * rate) - u) / rate;
            dt = beyond.select(end, dt);
        }
        [dt, square, root]
    }

    /// The position at a time of a path given relative to the middle of the chord: along the chord, the same in half lengths of the
    /// chord, the height over the graph, and the first two derivatives of that height.
    #[inline(always)]
    fn height(&self, [from, v]: [[F; 2]; 2], [rise, rate]: [F; 2], t: F, degree: usize) -> [F; 5] {
        let [a, b] = self.turned(along(from, v, t));
        let u = a * self.inverse;
        let [height, incline, bend] = self.jet(u, degree);
        [a, u, b - height, rise - incline * rate, -bend * (rate * rate)]
    }

    /// Whether what a step of Euler's method neglects, a sixth of the third derivative times the third power of the step divided by the
    /// slope, is less than `error` half lengths of the chord.
    #[inline(always)]
    fn is_near(&self, dt: F, rate: F, slope: F, error: f64) -> F::Mask {
        let step = (dt * rate).abs();
        (self.third * rate.abs() * (step * step * step)).lt(slope * error)
    }

    /// The outward crossing, if there is one: certainly where `through` is set, that is, where the path's line passes between the ends
    /// outwards. Lanes that are not `wanted` are meaningless.
    ///
    /// `g(t)`, the height of the path over the graph, rises through 0 there. Its second derivative has one sign, so of the two roots of
    /// the osculating parabola the one with a slope ≥ 0 is the right one, and the iteration converges cubically, even where a path
    /// nearly grazes (Euler's method). Near a root that is not grazed a step of Chebyshev's method is as good.
    #[inline(always)]
    pub(crate) fn meet(&self, path: &Aimed<F>, through: F::Mask, wanted: F::Mask, slack: f64) -> Meeting<F> {
        let Aimed { x, v, inverse } = *path;
        let [n0, n1] = self.outward;
        let [zero, one] = [v[0].same(0.0), v[0].same(1.0)];
        let from = [x[0] - self.origin[0], x[1] - self.origin[1]];
        let [run, rise] = self.turned(v);
        let rate = run * self.inverse;
        let (path, speeds) = ([from, v], [rise, rate]);
        // start where the path crosses the chord, or else at its point closest to the middle
        let foot = -(from[0] * v[0] + from[1] * v[1]) * inverse;
        let chord = -(n0 * from[0] + n1 * from[1]) / rise;
        let there = through & ((chord - foot) * rate).abs().lt(one + one);
        let mut t = there.select(chord, foot);
        // first towards the root of the lower powers, and on from there
        let mut going = wanted;
        for _ in 0..STEPS {
            let [_, u, g, slope, bend] = self.height(path, speeds, t, LOW);
            let [dt, _, root] = self.step(u, rate, [g, slope, bend]);
            t = going.select(t + dt, t);
            going = going & !(self.is_near(dt, rate, root, NEARBY) | (dt * rate).abs().lt(zero.same(STILL)));
            if !going.any() {
                break;
            }
        }
        let [a, u, g, slope, bend] = self.height(path, speeds, t, DEGREE);
        let steep = one / slope;
        let newton = -g * steep;
        let curved = newton * bend * steep * 0.5;
        let dt = newton - newton * curved;
        // what this step neglects of the second derivative is less than twice the square of `curved`, the relative size of its
        // contribution, times the step
        let near = self.is_near(dt, rate, slope, SMALL) & (curved * curved * (dt * rate).abs()).lt(zero.same(SMALL));
        let mut last = [a, u, slope, bend, dt, slope];
        t = near.select(t + dt, t);
        let mut going = wanted & !near;
        if going.any() {
            // beyond the ends, where the lower powers may have led, the bend may have another sign: back to the middle
            t = (going & one.lt(u.abs())).select(t - u / rate, t);
        }
        for _ in 0..STEPS {
            if !going.any() {
                break;
            }
            let [a, u, g, slope, bend] = self.height(path, speeds, t, DEGREE);
            let [dt, square, root] = self.step(u, rate, [g, slope, bend]);
            // a lane that is done stays as it is, whatever the others need
            last = going.choose([a, u, slope, bend, dt, square], last);
            t = going.select(t + dt, t);
            going = going & !(self.is_near(dt, rate, root, SMALL) | (dt * rate).abs().lt(zero.same(STILL)));
        }
        let [a, u, slope, bend, dt, square] = last;
        let end = u + dt * rate;
        let [height, incline, _] = self.jet(end, DEGREE);
        let incline = incline * self.inverse;
        let reach = a + dt * run;
        // a crossing behind the start counts as one at time 0 where the start lies outside by no more than rounding and moves on
        // outwards
        let slope = slope + bend * dt;
        let back = (-t).max(zero);
        let behind = zero.lt(back);
        let outside = back * (slope + bend * back * 0.5);
        let now = !outside.same(slack).lt(outside) & zero.lt(slope + bend * back);
        let within = !going & !square.lt(zero) & !one.lt(end.abs());
        let really = wanted & (through | within) & (!behind | now);
        Meeting {
            time: really.select(t.max(zero), zero.same(f64::INFINITY)),
            point: [self.origin[0] + (n0 * height - n1 * reach), self.origin[1] + (n1 * height + n0 * reach)],
            place: end,
            normal: [-n0 - n1 * incline, n0 * incline - n1],
        }
    }
}
