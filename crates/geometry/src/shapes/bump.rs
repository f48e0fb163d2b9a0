//! A straight side with a smooth bump: the pieces of a C²-perturbed polygon.
use super::curve::{ArcLength, Graph, Interval, Parametric, Smooth, first_rise, graphs};
use crate::{
    Error,
    crossing::Crossing,
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{cross, finite, slack},
};
use nalgebra::Vector2;

/// The side from `a` to `b`, table on its left, displaced outwards by `h(u) = A p(u)` at the fraction `u` of its length.
///
/// `p(u) = 64 u³ (1−u)³` is 1 in the middle and vanishes with its slope and curvature at both vertices. So a polygon
/// whose sides become bumps keeps its vertices, the angles there and zero curvature at the ends of its sides; every
/// piece extends as a C² curve beyond its vertices, and the perturbation is small in C²: `max |h″| = 24 |A| / |b−a|²`.
/// `A > 0` bulges out of the table, which makes the middle focusing; `A < 0` bulges into it.
#[derive(Clone, Debug)]
pub struct Bump {
    a: Vector2<f64>,
    b: Vector2<f64>,
    /// Unit vector out of the table, at right angles to `b − a`.
    outward: Vector2<f64>,
    length: f64,
    height: f64,
    slack: f64,
    table: ArcLength,
    extent: Extent,
}

/// The fraction of the side next to a vertex in which `p` is below rounding (64 · 2⁻⁵⁷): there the wall is straight.
const FLAT: f64 = 1.0 / 524_288.0; // 2⁻¹⁹

impl Bump {
    /// The side from `a` to `b` with a bump of the given height `A` \[L\].
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if the ends coincide, [`Error::Parameter`] for ends or a height that are not finite.
    pub fn new(a: Vector2<f64>, b: Vector2<f64>, height: f64) -> Result<Bump, Error> {
        finite("from", &a)?;
        finite("to", &b)?;
        let d = b - a;
        let length = libm::hypot(d.x, d.y);
        if !(length > 0.0 && length.is_finite()) {
            return Err(Error::ZeroLength);
        }
        if !height.is_finite() {
            return Err(Error::Parameter { name: "height", must: "finite", value: height });
        }
        let outward = Vector2::new(d.y, -d.x) / length;
        let graph = Raised { a, along: d, outward, height };
        let table = ArcLength::new(&graph, (0..=16).map(|k| f64::from(k) / 16.0));
        let extent = table.extent(&graph);
        Ok(Bump { a, b, outward, length, height, slack: slack([a.x, a.y, b.x, b.y, height]), table, extent })
    }

    /// Height of the bump, positive out of the table \[L\].
    pub fn height(&self) -> f64 {
        self.height
    }

    fn graph(&self) -> Raised {
        Raised { a: self.a, along: self.b - self.a, outward: self.outward, height: self.height }
    }

    /// The fraction of the side at the foot of a point.
    fn fraction(&self, point: &Vector2<f64>) -> f64 {
        let along = Vector2::new(-self.outward.y, self.outward.x);
        (point - self.a).dot(&along) / self.length
    }

    /// The landing at a fraction of the side.
    fn at_fraction(&self, u: f64) -> Landing {
        let [point, tangent] = self.graph().at(u);
        Landing { point, normal: Vector2::new(-tangent.y, tangent.x) / libm::hypot(tangent.x, tangent.y) }
    }
}

/// `p`, `p′` and `p″`, continued by 0 beyond the vertices.
fn shape(u: f64) -> [f64; 3] {
    let w = (u * (1.0 - u)).max(0.0);
    [64.0 * w * w * w, 192.0 * w * w * (1.0 - 2.0 * u), second(w)]
}

/// `p″` as a function of `w = u (1 − u)`.
fn second(w: f64) -> f64 {
    384.0 * w * (1.0 - 5.0 * w)
}

/// `p″` over an interval of `u`.
fn second_over(u: Interval) -> Interval {
    let [low, high] = [u.low, u.high].map(|u| (u * (1.0 - u)).max(0.0));
    let least = low.min(high);
    let greatest = if u.contains(0.5) { 0.25 } else { low.max(high) };
    // p″ rises up to w = 1/10 and falls from there
    let peak = if least <= 0.1 && 0.1 <= greatest { 19.2 } else { second(least).max(second(greatest)) };
    Interval { low: second(least).min(second(greatest)), high: peak }
}

/// The bump parametrised by the fraction `u`.
struct Raised {
    a: Vector2<f64>,
    along: Vector2<f64>,
    outward: Vector2<f64>,
    height: f64,
}

impl Parametric for Raised {
    fn at(&self, u: f64) -> [Vector2<f64>; 2] {
        let [value, slope, _] = shape(u);
        [
            self.a + self.along * u + self.outward * (self.height * value),
            self.along + self.outward * (self.height * slope),
        ]
    }
}

/// The height of a path beyond the wall, `η − A p(u)` with `η` and `u` linear in time.
struct Above {
    height: f64,
    fraction: [f64; 2],
    distance: [f64; 2],
}

impl Above {
    fn fraction(&self, t: f64) -> f64 {
        self.fraction[0] + t * self.fraction[1]
    }
}

impl Smooth for Above {
    fn jet(&self, t: f64) -> [f64; 2] {
        let [value, slope, _] = shape(self.fraction(t));
        [
            self.distance[0] + t * self.distance[1] - self.height * value,
            self.distance[1] - self.height * slope * self.fraction[1],
        ]
    }

    fn second_derivative(&self, over: Interval) -> Interval {
        let fractions = Interval::new(self.fraction(over.low), self.fraction(over.high));
        second_over(fractions) * (-self.height * self.fraction[1] * self.fraction[1])
    }
}

impl Piece for Bump {
    fn graphs(&self) -> Option<Vec<Graph>> {
        let size = self.a.amax().max(self.b.amax()).max(self.height.abs());
        graphs(&self.graph(), [0.0, 1.0], [self.a, self.b], size)
    }
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let v = path.velocity;
        let rate = v.dot(&Vector2::new(-self.outward.y, self.outward.x)) / self.length;
        let fraction = self.fraction(&path.point);
        // while the path is over the side, or a little beyond its ends
        let (low, high) = (-0.5 * FLAT, 1.0 + 0.5 * FLAT);
        let rise = v.dot(&self.outward);
        let distance = (path.point - self.a).dot(&self.outward);
        // and not yet farther out or farther in than the wall reaches
        let reach = self.length + distance.abs() + self.height.abs();
        let [enter, leave] = if rate == 0.0 {
            if fraction < low || fraction > high || rise <= 0.0 {
                return Crossing::NEVER;
            }
            [0.0, reach / rise]
        } else {
            let (s, t) = ((low - fraction) / rate, (high - fraction) / rate);
            [s.min(t).max(0.0), s.max(t).min(reach / rise.abs())]
        };
        if enter >= leave || leave.is_nan() {
            return Crossing::NEVER;
        }
        let above = Above {
            height: self.height,
            fraction: [fraction + enter * rate, rate],
            distance: [distance + enter * rise, rise],
        };
        let Some(time) = first_rise(&above, Interval { low: 0.0, high: leave - enter }, self.slack) else {
            return Crossing::NEVER;
        };
        let at = above.fraction(time);
        // next to a vertex the wall is straight, and both neighbours decide by the same sign
        let left = |vertex: Vector2<f64>| cross(v.into(), (vertex - path.point).into()) > 0.0;
        let ours = if at < FLAT {
            !left(self.a)
        } else if at > 1.0 - FLAT {
            left(self.b)
        } else {
            true
        };
        if ours { Crossing { num: enter + time, den: 1.0 } } else { Crossing::NEVER }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.at_fraction(self.fraction(&path.at(time)).clamp(0.0, 1.0))
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        let [_, slope, second] = shape(self.fraction(point).clamp(0.0, 1.0));
        let slope = self.height * slope / self.length;
        let squared = 1.0 + slope * slope;
        -(self.height / self.length) * (second / self.length) / (squared * squared.sqrt())
    }
    fn length(&self) -> f64 {
        self.table.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.graph().at(self.table.parameter(&self.graph(), s))[0]
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.table.at_parameter(&self.graph(), self.table.closest(&self.graph(), point))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.at_fraction(self.table.closest(&self.graph(), point))
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        Some([self.a, self.b])
    }
    fn extent(&self) -> Extent {
        self.extent
    }
    fn area(&self) -> f64 {
        // ∫ p du = 16/35
        16.0 / 35.0 * self.height * self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bump(height: f64) -> Bump {
        Bump::new(Vector2::new(-1.0, 0.0), Vector2::new(1.0, 0.0), height).unwrap()
    }
    fn time(bump: &Bump, x: f64, y: f64, vx: f64, vy: f64) -> f64 {
        bump.crossing(&Line { point: Vector2::new(x, y), velocity: Vector2::new(vx, vy) }).time()
    }

    #[test]
    fn the_middle_is_displaced_by_the_height() {
        assert_eq!(time(&bump(0.25), 0.0, 1.0, 0.0, -1.0), 1.25);
        assert_eq!(time(&bump(-0.25), 0.0, 1.0, 0.0, -1.0), 0.75);
        assert_eq!(bump(0.25).curvature(&Vector2::new(0.0, -0.25)), 0.25 * 24.0 / 4.0);
    }

    #[test]
    fn a_bump_without_height_is_a_segment() {
        let flat = bump(0.0);
        assert_eq!(time(&flat, 0.5, 1.0, -0.5, -2.0), 0.5);
        assert_eq!(time(&flat, 0.5, 0.0, 0.0, 1.0), f64::INFINITY);
        assert!((flat.length() - 2.0).abs() < 4.0 * f64::EPSILON);
        assert!((flat.arc_length_at(&Vector2::new(0.5, 3.0)) - 1.5).abs() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn a_bump_into_the_table_hides_what_lies_behind_it() {
        // from the left foot straight to the right one: the bump is in the way, at its near side
        let bump = bump(-0.5);
        let t = time(&bump, -2.0, 0.25, 1.0, 0.0);
        let at = bump.landing(&Line { point: Vector2::new(-2.0, 0.25), velocity: Vector2::new(1.0, 0.0) }, t);
        assert!(t < 2.0 && (at.point.y - 0.25).abs() < 1e-15);
        assert!(at.normal.x < 0.0);
    }

    #[test]
    fn a_shared_vertex_belongs_to_exactly_one_neighbour() {
        let next = Bump::new(Vector2::new(1.0, 0.0), Vector2::new(2.0, 1.0), 0.1).unwrap();
        for k in -40..40 {
            let x = Vector2::new(0.05 * f64::from(k), 3.0);
            let path = Line { point: x, velocity: Vector2::new(1.0, 0.0) - x };
            let hits = [bump(0.1), next.clone()].iter().filter(|b| b.crossing(&path).num < f64::INFINITY).count();
            assert_eq!(hits, 1, "from {x}");
        }
    }

    #[test]
    fn bumps_of_any_height_are_few_graphs() {
        for height in [0.3, 0.02, -0.02, 1e-5, -1e-9, 0.0] {
            let graphs = bump(height).graphs().unwrap();
            assert!((1..=40).contains(&graphs.len()), "{height}: {}", graphs.len());
        }
    }

    #[test]
    fn the_second_derivative_is_enclosed() {
        for k in 0..1000 {
            let (a, b) = (f64::from(k % 37) / 37.0, f64::from(k % 41) / 41.0);
            let over = second_over(Interval::new(a, b));
            for i in 0..=20 {
                let [_, _, value] = shape(a + (b - a) * f64::from(i) / 20.0);
                assert!(over.low - 1e-13 <= value && value <= over.high + 1e-13);
            }
        }
    }
}
