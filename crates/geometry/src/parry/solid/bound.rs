//! Balls around things.
use crate::{Extent, Line, parry::distance::to_unit, plane::slack};
use nalgebra::Vector3;

/// A ball \[L\].
#[derive(Clone, Copy, Debug)]
pub(in crate::parry) struct Bound {
    pub(in crate::parry) center: Vector3<f64>,
    pub(in crate::parry) radius: f64,
}

impl Bound {
    /// A ball around a box, if that is finite.
    pub(in crate::parry) fn of(Extent { min, max }: Extent<3>) -> Option<Bound> {
        let (center, half) = (min * 0.5 + max * 0.5, max * 0.5 - min * 0.5);
        let radius = libm::hypot(libm::hypot(half.x, half.y), half.z) + slack([min.amax(), max.amax()]);
        Some(Bound { center, radius }).filter(|ball| ball.radius.is_finite())
    }

    /// A ball around all that is within a margin of some points.
    pub(super) fn around<const K: usize>(points: [Vector3<f64>; K], margin: f64) -> Bound {
        let Extent { min, max } = Extent::of(points);
        let center = min * 0.5 + max * 0.5;
        let reach = points.iter().map(|p| (p - center).norm()).fold(0.0, f64::max);
        Bound { center, radius: reach + margin + slack([min.amax(), max.amax(), margin]) }
    }
}

/// A path prepared for tests against balls.
pub(super) struct Aim {
    point: Vector3<f64>,
    /// The velocity in a unit in which its square neither over- nor underflows.
    velocity: Vector3<f64>,
    square: f64,
    /// The inverses of the units of length and time.
    per_length: f64,
    per_time: f64,
}

impl Aim {
    /// A path among things of about this size \[L\].
    pub(super) fn new(path: &Line<3>, size: f64) -> Aim {
        let (per_length, per_speed) = (to_unit(size), to_unit(path.velocity.amax()));
        let velocity = path.velocity * per_speed;
        let square = velocity.norm_squared();
        Aim { point: path.point, velocity, square, per_length, per_time: per_length / per_speed }
    }

    /// Whether the path enters a ball only after this time, or never. Where rounding leaves this open, the answer is no.
    pub(super) fn misses(&self, ball: &Bound, until: f64) -> bool {
        /// Fraction of a squared distance that exceeds all roundings in it.
        const LITTLE: f64 = 32.0 * f64::EPSILON;
        let way = (ball.center - self.point) * self.per_length;
        let radius = ball.radius * self.per_length;
        let nearer = way.norm_squared() * (1.0 - LITTLE) - radius * radius;
        let towards = way.dot(&self.velocity);
        let inner = towards * towards - self.square * nearer;
        if !(nearer > 0.0) {
            return false;
        }
        towards <= 0.0 || inner < 0.0 || nearer > (towards + inner.sqrt()) * (until * self.per_time * (1.0 + LITTLE))
    }
}
