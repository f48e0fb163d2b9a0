//! A whole ellipse, with the table inside or outside.
//!
//! The affine map onto the unit circle preserves straight lines, times along them and the sides of the curve, so meeting an ellipse reduces
//! to meeting a circle.
use crate::{
    Error,
    afar::NEWTON,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{along, finite, from, moved, slack},
    shapes::{Circle, Shape, curve::rising_root_near, elliptic_integral::second_kind},
};
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};
use lanes::{Lane, Mask, dot};
use nalgebra::{Vector1, Vector2};

/// The ellipse `|A (x − c)| = 1` with `A = diag(1/a, 1/b) R(−angle)`.
///
/// Traversed from the end of the first semi-axis: counter-clockwise with the table inside, clockwise with it outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    center: [f64; 2],
    semi_axes: [f64; 2],
    /// Unit vector along the first semi-axis.
    axis: [f64; 2],
    /// Rows of `A` \[L⁻¹\].
    to_unit: [[f64; 2]; 2],
    /// Columns of `A⁻¹` \[L\].
    from_unit: [[f64; 2]; 2],
    /// Columns of `w Aᵀ`: from `A (x − c)` to the direction of the inward normal.
    to_normal: [[f64; 2]; 2],
    /// `w`, negative with the table inside: a power of two of about the size of the shorter semi-axis. So the normal is that of the ellipse
    /// that `to_unit` describes, without a rounding that would turn all normals one way.
    width: f64,
    /// Whether one semi-axis is much shorter than the other.
    is_flat: bool,
    /// The image of the ellipse under `A`.
    unit: Circle,
    /// Arc length of a quarter.
    quarter: f64,
}

/// An ellipse whose axes have a smaller ratio is flat: on others, moving straight towards the centre shifts a point sideways by a rounding
/// or two only.
const FLAT: f64 = 0.25;

/// Steps of Newton's method that lead to an ellipse from points off it by up to half its width.
const STEPS: usize = 6;

/// Where one semi-axis is shorter than this fraction of the other, formulas for needles are correct to rounding: what they neglect is the
/// square of the ratio.
const NEEDLE: f64 = 1e-12;

impl Ellipse {
    /// The ellipse with semi-axes `[a, b]` \[L\], the first at `angle` (radians, counter-clockwise) to the x₁ axis, and
    /// the table inside (`inside`) or outside.
    ///
    /// # Errors
    /// [`Error::Radius`] unless both semi-axes are positive and finite, [`Error::Parameter`] for an angle or a centre
    /// that is not finite.
    pub fn new(center: Vector2<f64>, semi_axes: [f64; 2], angle: f64, inside: bool) -> Result<Ellipse, Error> {
        if let Some(&radius) = semi_axes.iter().find(|&&r| !(r > 0.0 && r.is_finite())) {
            return Err(Error::Radius { radius });
        }
        finite("angle", &Vector1::new(angle))?;
        finite("center", &center)?;
        let [a, b] = semi_axes;
        let axis = [libm::cos(angle), libm::sin(angle)];
        let (e1, e2) = (axis, [-axis[1], axis[0]]);
        let unit = Circle::new(Vector2::zeros(), 1.0, inside)?;
        let to_unit = [e1.map(|e| e / a), e2.map(|e| e / b)];
        let width = libm::ldexp(if inside { -1.0 } else { 1.0 }, libm::frexp(a.min(b)).1);
        let mut ellipse = Ellipse {
            center: center.into(),
            semi_axes,
            axis,
            to_unit,
            from_unit: [e1.map(|e| a * e), e2.map(|e| b * e)],
            to_normal: to_unit.map(|row| row.map(|e| width * e)),
            width,
            is_flat: a.min(b) < FLAT * a.max(b),
            unit: unit.with_slack(slack([center.x, center.y, a, b]) / a.min(b)),
            quarter: 0.0,
        };
        ellipse.quarter = ellipse.quarter_to(1.0, 0.0);
        Ok(ellipse)
    }

    /// The semi-axes `[a, b]` \[L\], as given.
    pub fn semi_axes(&self) -> [f64; 2] {
        self.semi_axes
    }

    pub(crate) fn translated(self, by: [f64; 2]) -> Ellipse {
        let center = moved(self.center, by);
        let [a, b] = self.semi_axes;
        let unit = self.unit.with_slack(slack([center[0], center[1], a, b]) / a.min(b));
        Ellipse { center, unit, ..self }
    }

    /// The same as one side of a wall on which the table lies behind, too.
    pub(crate) fn two_sided(self) -> Ellipse {
        Ellipse { unit: self.unit.two_sided(), ..self }
    }

    /// The same as a wall with the table on one side only.
    pub(crate) fn one_sided(self) -> Ellipse {
        Ellipse { unit: self.unit.one_sided(), ..self }
    }

    /// The two foci \[L\].
    pub fn foci(&self) -> [Vector2<f64>; 2] {
        let [a, b] = self.semi_axes;
        let distance = ((a - b).abs() * (a + b)).sqrt();
        let axis = if a < b { [-self.axis[1], self.axis[0]] } else { self.axis };
        [-distance, distance].map(|d| Vector2::from(self.center) + Vector2::from(axis) * d)
    }

    /// The image of the path `(x, v)` under the map of the ellipse to the unit circle.
    #[inline(always)]
    pub(crate) fn affine<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> ([F; 2], [F; 2]) {
        let [d0, d1] = from(x, self.center);
        (rows(self.to_unit, [-d0, -d1]), rows(self.to_unit, v))
    }

    /// The unit circle.
    pub(crate) fn unit(&self) -> &Circle {
        &self.unit
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    #[inline(always)]
    pub fn cross<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Crossing<F> {
        self.meet(x, v).into()
    }

    /// The same, before anything is selected.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Candidate<F> {
        let (y, w) = self.affine(x, v);
        self.unit.meet(y, w)
    }

    /// The landing point and the normal; see [`Piece::landing`].
    ///
    /// The rounding error off the wall is corrected along the line to the centre, as on a circle. On a flat ellipse that would shift the
    /// point too far along the wall, so there it is corrected along the normal `Aᵀ y`, by the step `(1 − |y|²)/2 · Aᵀ y/|Aᵀ y|²` of
    /// Newton's method.
    ///
    /// The point itself is corrected, not its image `y = A (x − c)`: the inverse of a rounded `A`, rounded, would map every point to an
    /// ellipse that is larger or smaller by some 10⁻¹⁷, and orbits would drift.
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        self.land_where(!time.never(), x, v, time)
    }

    /// The same where the paths do land here; those of other lanes, which may be nowhere near, take no time.
    #[inline(always)]
    pub(crate) fn land_where<F: Lane>(&self, here: F::Mask, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        let [d0, d1] = from(x, self.center);
        let p = along([-d0, -d1], v, time);
        let y = rows(self.to_unit, p);
        let off = off(y);
        let way = if self.is_flat { self.step(off, combine(self.to_normal, y)) } else { p.map(|p| p * off) };
        let mut p = [p[0] + way[0], p[1] + way[1]];
        let mut n = combine(self.to_normal, rows(self.to_unit, p));
        let afar = here & off.same(NEWTON).lt(off.abs());
        if afar.any() {
            let (far, normal) = self.far_landing(y, rows(self.to_unit, v));
            (p, n) = ([0, 1].map(|i| afar.select(far[i], p[i])), [0, 1].map(|i| afar.select(normal[i], n[i])));
        }
        let length = dot(&n, &n).sqrt();
        ([p[0] + self.center[0], p[1] + self.center[1]], [n[0] / length, n[1] / length])
    }

    /// The way along the direction `n` of the normal to the wall, for a point that is `off` it.
    #[inline(always)]
    fn step<F: Lane>(&self, off: F, n: [F; 2]) -> [F; 2] {
        let step = off / dot(&n, &n).max(off.same(f64::MIN_POSITIVE)) * self.width;
        n.map(|n| n * step)
    }

    /// The landing, relative to the centre, of a path that is at `y` with velocity `w`, in the picture of the unit circle, so far off the
    /// wall that one step does not lead there; and the direction of the normal. More steps do or, where these fail as well, as for an ellipse
    /// that is tiny compared with the flight, the way straight towards the centre.
    #[cold]
    #[inline(never)]
    fn far_landing<F: Lane>(&self, y: [F; 2], w: [F; 2]) -> ([F; 2], [F; 2]) {
        let (mut z, mut rest) = (y, y[0]);
        for _ in 0..STEPS {
            rest = off(z);
            let way = rows(self.to_unit, self.step(rest, combine(self.to_normal, z)));
            z = [0, 1].map(|i| z[i] + way[i]);
        }
        let there = rest.abs().lt(rest.same(NEWTON));
        let (far, _) = self.unit.land(y, w, y[0].same(0.0));
        let z = [0, 1].map(|i| there.select(z[i], far[i]));
        (combine(self.from_unit, z), combine(self.to_normal, z))
    }

    /// The image of a point in the picture of the unit circle.
    pub(crate) fn eccentric(&self, point: &Vector2<f64>) -> [f64; 2] {
        self.affine((*point).into(), [0.0; 2]).0
    }

    /// The point of the ellipse at `y` on the unit circle, and the normal there.
    pub(crate) fn at(&self, y: [f64; 2]) -> Landing {
        let [n0, n1] = combine(self.to_normal, y);
        let length = (n0 * n0 + n1 * n1).sqrt();
        Landing {
            point: Vector2::from(self.center) + Vector2::from(combine(self.from_unit, y)),
            normal: Vector2::new(n0 / length, n1 / length),
        }
    }

    /// Derivative of the point with respect to the eccentric angle, counter-clockwise.
    pub(crate) fn tangent(&self, y: [f64; 2]) -> Vector2<f64> {
        Vector2::from(combine(self.from_unit, [-y[1], y[0]]))
    }

    /// Arc length from the end of the first semi-axis, counter-clockwise, to `y` on the unit circle, in [0, 4 Q].
    pub(crate) fn arc_length_of(&self, y: [f64; 2]) -> f64 {
        let in_quarter = self.quarter_to(y[1].abs(), y[0].abs());
        match (y[0] > 0.0, y[1] >= 0.0) {
            (true, true) => in_quarter,
            (false, true) => 2.0 * self.quarter - in_quarter,
            (false, false) => 2.0 * self.quarter + in_quarter,
            (true, false) => 4.0 * self.quarter - in_quarter,
        }
    }

    /// The inverse of [`Ellipse::arc_length_of`], for any `s`.
    pub(crate) fn at_arc_length(&self, s: f64) -> [f64; 2] {
        let quarter = self.quarter;
        let count = libm::floor(s / quarter);
        let odd = count - 2.0 * libm::floor(0.5 * count) > 0.0;
        let back = libm::floor(0.5 * count) - 2.0 * libm::floor(0.25 * count) > 0.0;
        let rest = if odd { (count + 1.0) * quarter - s } else { s - count * quarter };
        let angle = self.quarter_angle(rest);
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let y = if odd { [-cos, sin] } else { [cos, sin] };
        if back { y.map(|y| -y) } else { y }
    }

    /// The eccentric angle in the first quarter at this arc length: Halley's method.
    fn quarter_angle(&self, s: f64) -> f64 {
        let [a, b] = self.semi_axes;
        let along = |angle: f64| {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let (off, rate) = (self.quarter_to(sin, cos) - s, libm::hypot(b * cos, a * sin));
            let bend = (a - b) * sin * ((a + b) * cos / rate);
            [off, rate - 0.5 * bend * (off / rate)]
        };
        // the error after a step is at most the third power of the step divided by the square of this ratio
        let enough = 4e-6 * (a / b).min(b / a);
        rising_root_near(self.guess(s), along, [0.0, FRAC_PI_2], enough)
    }

    /// An estimate of the eccentric angle in the first quarter at this arc length, from the first terms of the speed's Fourier series.
    fn guess(&self, s: f64) -> f64 {
        let [a, b] = self.semi_axes;
        let mean = self.quarter / FRAC_PI_2;
        let (second, fourth) =
            (0.25 * (b - a) / mean, (0.0625 * (a + b) - 0.125 * FRAC_1_SQRT_2 * libm::hypot(a, b)) / mean);
        let mut angle = s / mean;
        for _ in 0..2 {
            let (sin, cos) = libm::sincos(2.0 * angle);
            let off = angle + (second + 2.0 * fourth * cos) * sin - s / mean;
            let rate = 1.0 + 2.0 * second * cos + 4.0 * fourth * (2.0 * cos * cos - 1.0);
            angle = (angle - off / rate.max(0.25)).clamp(0.0, FRAC_PI_2);
        }
        angle
    }

    /// Arc length from the end of the first semi-axis to the eccentric angle with this sine and cosine, both ≥ 0.
    fn quarter_to(&self, sin: f64, cos: f64) -> f64 {
        let [a, b] = self.semi_axes;
        if a < NEEDLE * b {
            // √(cos² + q sin²) is |cos| to rounding, except on an interval as small as the ratio
            return b * sin;
        }
        if b < NEEDLE * a {
            // with κ = b/a and s = 2 sin(φ/2): ∫ √(s² + κ²) ds
            let (k, s) = (b / a, sin * (2.0 / (1.0 + cos)).sqrt());
            return a * 0.5 * (s * libm::hypot(s, k) + k * (k * libm::asinh(s / k)));
        }
        b * second_kind(sin, cos, (a / b) * (a / b))
    }

    /// The point of the unit circle that corresponds to the point of the ellipse closest to `point`.
    ///
    /// With `A (point − c) = z` the closest point has `yᵢ = aᵢ² zᵢ / (aᵢ² + u)`, where `u` is the greatest root of
    /// `|y| = 1`. In `t = 1 + u/b²` (`b` the minor semi-axis) that function is convex and falling, and Newton's method
    /// climbs to the root from below without overshooting (after Eberly, *Distance from a point to an ellipse*).
    pub(crate) fn closest_eccentric(&self, point: &Vector2<f64>) -> [f64; 2] {
        let z = self.eccentric(point);
        let [a, b] = self.semi_axes;
        let (major, minor) = if a < b { (1, 0) } else { (0, 1) };
        let (long, short) = (self.semi_axes[major], self.semi_axes[minor]);
        // for needles beyond this ratio the points are those of the long axis, and the squares are still finite
        let ratio = (long / short).min(1e100);
        let (n, m) = (ratio * ratio * z[major].abs(), z[minor].abs());
        let gap = (ratio - 1.0) * (ratio + 1.0); // a²/b² − 1
        let mut t = m.max(n - gap);
        let mut y = [0.0; 2];
        if t > 0.0 {
            // 64 steps are never needed: the convergence is quadratic
            for _ in 0..64 {
                let (p, q) = (n / (t + gap), m / t);
                y = [p, q];
                let step = 0.5 * (p * p + q * q - 1.0) / (p * p / (t + gap) + q * q / t);
                if t + step <= t || step.is_nan() {
                    break;
                }
                t += step;
            }
        } else if gap > 0.0 {
            // on the major axis between the centres of curvature of its ends
            let p = n / gap;
            y = [p, (1.0 - p * p).max(0.0).sqrt()];
        } else {
            y = [1.0, 0.0]; // the centre of a circle
        }
        let norm = libm::hypot(y[0], y[1]);
        let mut closest = [0.0; 2];
        for (i, y) in [(major, y[0]), (minor, y[1])] {
            closest[i] = if z[i] < 0.0 { -y / norm } else { y / norm };
        }
        closest
    }

    /// Curvature at `y` on the unit circle: `a b / (b² y₁² + a² y₂²)^{3/2}` inside.
    pub(crate) fn curvature_at(&self, y: [f64; 2]) -> f64 {
        let [a, b] = self.semi_axes;
        let h = libm::hypot(b * y[0], a * y[1]) / libm::hypot(y[0], y[1]);
        self.unit.turn() * (a / h) * (b / h) / h
    }

    /// Eccentric angle of a point, in (−π, π].
    pub(crate) fn eccentric_angle(&self, point: &Vector2<f64>) -> f64 {
        let y = self.eccentric(point);
        libm::atan2(y[1], y[0])
    }

    pub(crate) fn center(&self) -> [f64; 2] {
        self.center
    }
    /// The greatest `d · (x − c)` of its points.
    pub(crate) fn reach(&self, d: [f64; 2]) -> f64 {
        let [u, w] = self.from_unit;
        libm::hypot(dot(&d, &u), dot(&d, &w))
    }

    /// The points of greatest and least coordinates.
    pub(crate) fn extremes(&self) -> [Vector2<f64>; 4] {
        let [u, w] = self.from_unit;
        let [x, y] = [0, 1].map(|i| {
            let h = libm::hypot(u[i], w[i]);
            [u[i] / h, w[i] / h]
        });
        [x, x.map(|x| -x), y, y.map(|y| -y)].map(|e| self.at(e).point)
    }
}

/// How far a point is off the unit circle, `(1 − |y|²)/2`: not from a sum near 1, as for a circle.
#[inline(always)]
fn off<F: Lane>(y: [F; 2]) -> F {
    ((y[0].same(1.0) - y[0] * y[0]) - y[1] * y[1]) * 0.5
}

/// The products of `y` with the rows of a matrix.
#[inline(always)]
fn rows<F: Lane>([a, b]: [[f64; 2]; 2], y: [F; 2]) -> [F; 2] {
    [y[0] * a[0] + y[1] * a[1], y[0] * b[0] + y[1] * b[1]]
}

/// `y₁ c₁ + y₂ c₂` for the columns `c` of a matrix.
#[inline(always)]
fn combine<F: Lane>(columns: [[f64; 2]; 2], y: [F; 2]) -> [F; 2] {
    [y[0] * columns[0][0] + y[1] * columns[1][0], y[0] * columns[0][1] + y[1] * columns[1][1]]
}

impl Piece for Ellipse {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        self.cross(path.point.into(), path.velocity.into())
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let (point, normal) = self.land(path.point.into(), path.velocity.into(), time);
        Landing { point: point.into(), normal: normal.into() }
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.curvature_at(self.eccentric(point))
    }
    fn length(&self) -> f64 {
        4.0 * self.quarter
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.landing_at(s).point
    }
    fn landing_at(&self, s: f64) -> Landing {
        self.at(self.at_arc_length(self.unit.turn() * s))
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let s = self.arc_length_of(self.closest_eccentric(point));
        if self.unit.inside || s == 0.0 { s } else { self.length() - s }
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.at(self.closest_eccentric(point))
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }
    fn extent(&self) -> Extent {
        Extent::of(self.extremes())
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Ellipse(*self))
    }
    fn area(&self) -> f64 {
        self.unit.turn() * PI * self.semi_axes[0] * self.semi_axes[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(x: f64, y: f64, vx: f64, vy: f64) -> Line<2> {
        Line { point: Vector2::new(x, y), velocity: Vector2::new(vx, vy) }
    }

    #[test]
    fn a_path_lands_on_a_flat_ellipse_where_it_crosses_it() {
        for width in [1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10] {
            for (center, inside) in [([0.3, 0.1], false), ([0.3, 0.1], true), ([-30.0, 7.0], false)] {
                let ellipse = Ellipse::new(center.into(), [1.0, width], 0.3, inside).unwrap();
                let size = 1.0 + center[0].abs();
                let mut hits = 0;
                for k in 0..400 {
                    let (u, angle) = (libm::cos(f64::from(k)), 0.7 * f64::from(k));
                    let aim = Vector2::from(center) + Vector2::from(ellipse.axis) * u;
                    let heading = Vector2::new(libm::cos(angle), libm::sin(angle));
                    let steep = heading.perp(&Vector2::from(ellipse.axis)).abs();
                    let start = if inside { aim } else { aim - heading * 1.75 };
                    let path = Line { point: start, velocity: heading };
                    let time = ellipse.crossing(&path).time();
                    if steep < 0.3 || time.is_infinite() {
                        continue;
                    }
                    hits += 1;
                    let landing = ellipse.landing(&path, time);
                    let [at, rest] = path.at_exactly(time);
                    let off = (landing.point - at) - rest;
                    // within a few roundings of positions from the path, along the wall as well as across it
                    assert!(off.norm() <= 8.0 * f64::EPSILON * size, "{width} {k}: {:e}", off.norm() / f64::EPSILON);
                }
                assert!(hits > 200, "{hits}");
            }
        }
    }

    #[test]
    fn a_needle_is_measured_alike_by_both_formulas() {
        for ratio in [NEEDLE * 0.999, NEEDLE * 1e-3] {
            for k in 0..=60 {
                for angle in [FRAC_PI_2 * f64::from(k) / 60.0, libm::ldexp(1.0, -k)] {
                    let (sin, cos) = if k == 60 { (1.0, 0.0) } else { libm::sincos(angle) };
                    for axes in [[1.0, ratio], [ratio, 1.0]] {
                        let needle = Ellipse::new(Vector2::zeros(), axes, 0.0, true).unwrap();
                        let found = needle.quarter_to(sin, cos);
                        let [a, b] = axes;
                        let expected = b * second_kind(sin, cos, (a / b) * (a / b));
                        assert!((found - expected).abs() <= 16.0 * f64::EPSILON * expected, "{axes:?} {angle}");
                    }
                }
            }
        }
    }

    #[test]
    fn ellipses_as_thin_as_numbers_allow_have_lengths_and_points() {
        for axes in [[1e150, 1e-150], [1e-150, 1e150], [1e5, 1e-150], [1e-150, 1.0], [1e150, 1e-10]] {
            let needle = Ellipse::new(Vector2::zeros(), axes, 0.0, true).unwrap();
            let long = axes[0].max(axes[1]);
            assert!((needle.length() - 4.0 * long).abs() <= 4e-15 * long, "{axes:?}");
            for k in 0..16 {
                let s = needle.length() * f64::from(k) / 16.0;
                let point = needle.point_at(s);
                assert!(point.amax() <= long, "{axes:?} {s:e}: {point:?}");
                let foot = needle.closest(&point).point;
                assert!((foot - point).amax() <= 1e-7 * long, "{axes:?} {s:e}: {point:?} {foot:?}");
            }
        }
    }

    #[test]
    fn points_are_at_their_arc_lengths_to_rounding() {
        for ratio in [1.0, 1.0 + 1e-9, 0.9, 0.5, 2.0, 0.1, 10.0, 1e3, 1e-3, 1e8, 1e-8] {
            let e = Ellipse::new(Vector2::zeros(), [1.0, ratio], 0.0, true).unwrap();
            let size = ratio.max(1.0);
            for k in 0..=400 {
                // also as near to the ends of the axes as possible
                let part = if k % 2 == 0 { f64::from(k) / 400.0 } else { libm::ldexp(1.0, -k / 8) };
                for s in [e.quarter * part, e.quarter * (1.0 - part)] {
                    let angle = e.quarter_angle(s);
                    let (sin, cos) = libm::sincos(angle);
                    let off = e.quarter_to(sin, cos) - s;
                    // the rounding of the angle and of the integral
                    let rounding = 2.0 * libm::hypot(cos * ratio, sin) + 4.0 * s;
                    assert!(off.abs() <= f64::EPSILON * rounding, "{ratio} {s:e}: {off:e} {rounding}");
                    assert!(angle <= FRAC_PI_2 && s <= 2.0 * size);
                }
            }
        }
    }

    #[test]
    fn an_ellipse_is_met_at_the_ends_of_its_axes() {
        let e = Ellipse::new(Vector2::new(1.0, 0.0), [2.0, 0.5], FRAC_PI_2, true).unwrap();
        let up = path(1.0, 0.0, 0.0, 1.0);
        assert_eq!(e.crossing(&up).time(), 2.0);
        let at = e.landing(&up, 2.0);
        // cos(π/2) is 6e-17 in f64, not 0
        assert!((at.point - Vector2::new(1.0, 2.0)).norm() < 2.0 * f64::EPSILON);
        // … which moves the end of the axis sideways, and the curvature there is 8
        assert!((at.normal - Vector2::new(0.0, -1.0)).norm() < 16.0 * f64::EPSILON);
        assert_eq!(e.curvature(&Vector2::new(1.0, 2.0)), 8.0); // a/b²
        assert_eq!(e.curvature(&Vector2::new(1.5, 0.0)), 0.125); // b/a²
    }

    #[test]
    fn an_ellipse_with_equal_axes_is_a_circle_to_the_last_bits() {
        let round = Ellipse::new(Vector2::zeros(), [1.0, 1.0], 0.0, true).unwrap();
        let circle = Circle::new(Vector2::zeros(), 1.0, true).unwrap();
        for k in 0..100 {
            let k = f64::from(k);
            let p = path(0.3, -0.2, libm::cos(k), libm::sin(k));
            let t = circle.crossing(&p).time();
            assert_eq!(round.crossing(&p).time(), t);
            assert_eq!(round.landing(&p, t).point, circle.landing(&p, t).point);
            let q = path(0.0, 0.0, k - 50.0, 50.5 - k).velocity;
            assert!((round.closest(&q).point - circle.closest(&q).point).norm() < 4.0 * f64::EPSILON);
            assert!((round.arc_length_at(&q) - circle.arc_length_at(&q)).abs() < 16.0 * f64::EPSILON);
        }
    }

    #[test]
    fn the_closest_point_is_reached_along_the_normal() {
        for (inside, axes) in [(true, [2.0, 1.0]), (false, [0.01, 3.0])] {
            let e = Ellipse::new(Vector2::new(0.5, -1.0), axes, 0.7, inside).unwrap();
            for k in 0..200 {
                let (u, w) = (libm::sin(f64::from(k) * 1.7), libm::cos(f64::from(k * k) * 0.9));
                let p = Vector2::new(0.5 + 3.0 * u, -1.0 + 3.0 * w);
                let at = e.closest(&p);
                let (off, n) = (p - at.point, at.normal);
                // parallel to the normal, and no sampled point is closer
                assert!((off.x * n.y - off.y * n.x).abs() < 1e-13, "{p} {}", off.x * n.y - off.y * n.x);
                let best = (0..720).map(|i| (e.point_at(e.length() * f64::from(i) / 720.0) - p).norm());
                assert!(best.fold(f64::INFINITY, f64::min) >= off.norm() - 1e-13);
            }
        }
    }

    #[test]
    fn points_on_the_axes_have_closest_points() {
        let e = Ellipse::new(Vector2::zeros(), [2.0, 1.0], 0.0, true).unwrap();
        let closest = |x, y| e.closest(&Vector2::new(x, y)).point;
        assert_eq!(closest(0.0, 0.0), Vector2::new(0.0, 1.0));
        assert_eq!(closest(5.0, 0.0), Vector2::new(2.0, 0.0));
        assert_eq!(closest(0.0, -0.25), Vector2::new(0.0, -1.0));
        assert_eq!(closest(1.5, 0.0), Vector2::new(2.0, 0.0)); // the centre of curvature of the end
        assert!((closest(0.75, 0.0) - Vector2::new(1.0, 0.75_f64.sqrt())).norm() < 2.0 * f64::EPSILON);
    }

    #[test]
    fn axes_must_be_positive() {
        assert_eq!(Ellipse::new(Vector2::zeros(), [1.0, 0.0], 0.0, true), Err(Error::Radius { radius: 0.0 }));
    }
}
