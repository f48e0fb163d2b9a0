//! The first crossing of a path with a surface of which only the distance is known.
//!
//! A ball around any point of the table whose radius is that point's distance to the wall contains no wall. The usual
//! march takes balls around points of the path, and crawls where the path is close to a wall, since its steps are as
//! short as the path's height above it. Here the centres lie off the path, on the side away from the wall: one of
//! radius `h + y` around the point at height `h` above a point of the path which is itself at height `y` frees a
//! stretch of length `√(2hy)` at grazing incidence, and from a start on the wall, `y = 0`, the whole chord `2h sin θ`.
//! Every stretch is certified free, so the crossing found is the first; near a smooth wall the convergence is
//! quadratic.
use super::{Side, convert::Frame};
use crate::{Extent, Line};
use core::fmt::Debug;
use nalgebra::SVector;

/// A shape, known by its projection.
pub(crate) trait Field<const N: usize>: Debug + Send + Sync {
    /// The point of the surface closest to `x`, and whether `x` lies inside of the shape.
    fn project(&self, x: &SVector<f64, N>) -> (SVector<f64, N>, bool);
    /// A box around the shape.
    fn extent(&self) -> Extent<N>;
    /// Whether the shape is convex: then it is queried only from outside.
    fn is_convex(&self) -> bool {
        false
    }
}

/// The distance from a surface, positive in the table.
#[derive(Debug)]
pub(crate) struct Distance<const N: usize> {
    pub(super) field: Box<dyn Field<N>>,
    frame: Frame<N>,
    /// The power of two by which to multiply lengths in space to get the field's unit.
    scale: f64,
    /// +1 where the table is outside.
    sign: f64,
    /// In the field's coordinates: half the diagonal of the box, its sides, and the rounding of a distance.
    pub(super) size: f64,
    extent: Extent<N>,
    pub(super) rounding: f64,
}

/// The result of a distance query for a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe<const N: usize> {
    /// Positive in the table.
    pub(crate) distance: f64,
    /// Closest point of the surface.
    pub(crate) foot: SVector<f64, N>,
}

/// Balls a march may need: some 20 at ordinary incidence, `√(2/θ)` at grazing angles θ; the rest is for cusps.
const MOST_BALLS: usize = 100_000;

/// Halvings of a ball, from a quarter of the size down to 10⁻¹³ of it: a path may leave a wall that close to a corner.
const HALVINGS: usize = 41;

impl<const N: usize> Distance<N> {
    /// `field` holds the shape multiplied by `scale`, a power of two, in its own frame.
    pub(crate) fn new(field: Box<dyn Field<N>>, frame: Frame<N>, scale: f64, side: Side) -> Self {
        let extent = field.extent();
        let size = 0.5 * (extent.max - extent.min).norm();
        // an infinite shape has no scale except its own curvature, which is unknown
        let size = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let far = extent.min.amax().max(extent.max.amax()).min(1e3 * size) + scale * frame.translation.amax();
        Distance {
            field,
            frame,
            scale,
            sign: if side == Side::Outside { 1.0 } else { -1.0 },
            size,
            extent,
            rounding: 8.0 * f64::EPSILON * far,
        }
    }

    /// The power of two that brings a shape of this extent to size 1.
    pub(crate) fn unit(extent: &Extent<N>) -> f64 {
        to_unit(0.5 * (extent.max - extent.min).amax())
    }

    fn inward(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        self.frame.point_back(x) * self.scale
    }
    fn outward(&self, y: &SVector<f64, N>) -> SVector<f64, N> {
        self.frame.point(&(y / self.scale))
    }

    fn probe_local(&self, y: &SVector<f64, N>) -> Probe<N> {
        let (foot, inside) = self.field.project(y);
        let distance = (y - foot).norm();
        Probe { distance: if inside { -self.sign * distance } else { self.sign * distance }, foot }
    }

    /// Distance and closest point, seen from `x`.
    pub(crate) fn probe(&self, x: &SVector<f64, N>) -> Probe<N> {
        let y = self.inward(x);
        let probe = if self.field.is_convex() {
            let (probe, _) = self.outer(&y);
            Probe { distance: probe.distance * self.sign, foot: probe.foot }
        } else {
            self.probe_local(&y)
        };
        Probe { distance: probe.distance / self.scale, foot: self.outward(&probe.foot) }
    }

    /// Closest point and unit normal into the table.
    pub(crate) fn closest(&self, x: &SVector<f64, N>) -> (SVector<f64, N>, SVector<f64, N>, f64) {
        let y = self.inward(x);
        let (probe, normal) = if self.field.is_convex() {
            let (probe, outward) = self.outer(&y);
            (Probe { distance: probe.distance * self.sign, foot: probe.foot }, outward * self.sign)
        } else {
            let probe = self.probe_local(&y);
            (probe, self.normal(&y, &probe))
        };
        (self.outward(&probe.foot), self.frame.direction(&normal), probe.distance / self.scale)
    }

    /// The box around the shape in space, as its corners' bounds.
    pub(crate) fn extent(&self) -> Extent<N> {
        Extent::of(self.extent.corners().map(|corner| self.outward(&corner)))
    }

    /// The unit normal into the table at the closest point of `y`.
    fn normal(&self, y: &SVector<f64, N>, probe: &Probe<N>) -> SVector<f64, N> {
        /// From this distance on the difference of point and foot has lost no more than three digits.
        const CLEAR: f64 = 1e-3;
        let straight = (y - probe.foot) / probe.distance;
        if probe.distance.abs() > CLEAR * self.size {
            return straight;
        }
        self.normal_at(&probe.foot, (probe.distance.abs() > 64.0 * self.rounding).then_some(straight))
    }

    /// A rough normal at a point of the surface: the direction in which the distance grows fastest, over steps of `h`.
    fn any_normal(&self, foot: &SVector<f64, N>, h: f64) -> SVector<f64, N> {
        let mut gradient = SVector::<f64, N>::zeros();
        for i in 0..N {
            let mut step = SVector::zeros();
            step[i] = h;
            gradient[i] = self.probe_local(&(foot + step)).distance - self.probe_local(&(foot - step)).distance;
        }
        let length = gradient.norm();
        if length > 0.0 { gradient / length } else { gradient }
    }

    /// The normal at a point of the surface, improved from a guess.
    ///
    /// Seen from a point at height `h` above the surface the foot is known to `ε·size` and so the normal to `ε·size/h`.
    /// The foot must be the given point: each step brings it nearer by the factor `h·κ` (κ the curvature). At a corner
    /// no height works, and some direction that leads away from the walls is returned.
    fn normal_at(&self, foot: &SVector<f64, N>, guess: Option<SVector<f64, N>>) -> SVector<f64, N> {
        if let Some(normal) = guess.and_then(|guess| self.improved(foot, guess)) {
            return normal;
        }
        let mut rough = SVector::zeros();
        for h in [1.0 / 64.0, 1.0 / 4096.0, 1.0 / 262_144.0] {
            rough = self.any_normal(foot, h * self.size);
            if let Some(normal) = self.improved(foot, rough) {
                return normal;
            }
        }
        rough
    }

    fn improved(&self, foot: &SVector<f64, N>, guess: SVector<f64, N>) -> Option<SVector<f64, N>> {
        /// A foot that is off by this fraction of the height turns the normal by that fraction times h·κ.
        const AT: f64 = 1e-13;
        let mut h = self.size / 8.0;
        // lower down a normal by difference has fewer digits than the guess
        while h > 1e-6 * self.size {
            let mut normal = guess;
            let mut before = f64::INFINITY;
            for _ in 0..40 {
                let above = foot + normal * h;
                let probe = self.probe_local(&above);
                if probe.distance <= 0.5 * h {
                    break; // the guess leads along the wall, or another wall is closer
                }
                let off = (probe.foot - foot).norm();
                normal = (above - probe.foot) / probe.distance;
                if off <= AT * h + 4.0 * self.rounding {
                    return Some(normal);
                }
                if off >= 0.5 * before {
                    break; // too high for the curvature
                }
                before = off;
            }
            h /= 4.0;
        }
        None
    }

    /// The time at which the path first crosses the surface out of the table.
    pub(crate) fn first(&self, path: &Line<N>) -> Option<f64> {
        let start = self.inward(&path.point);
        let velocity = self.frame.direction_back(&path.velocity) * self.scale;
        let speed = velocity.norm();
        if !(speed > 0.0 && speed.is_finite()) {
            return None;
        }
        let along = velocity / speed;
        let [enter, leave] = self.through_box(&start, &along)?;
        let rounding = self.rounding + 4.0 * f64::EPSILON * start.amax().min(1e6 * self.size);
        if self.field.is_convex() {
            let s = if self.sign > 0.0 {
                self.enters(&start, &along, [enter, leave], rounding)
            } else {
                self.leaves(&start, &along, leave)
            };
            return s.map(|s| s / speed);
        }
        let mut s = enter;
        let mut h = 0.25 * self.size;
        // towards the table, from the last ball's foot to its centre
        let mut up: Option<SVector<f64, N>> = None;
        for _ in 0..MOST_BALLS {
            let y = start + along * s;
            let probe = self.probe_local(&y);
            let height = probe.distance;
            if height.is_nan() {
                return None;
            }
            // at this height the difference of point and foot still has ten digits
            if height > 1e-6 * self.size {
                up = Some((y - probe.foot) / height);
            } else if up.is_none() || height <= rounding {
                let normal = self.normal_at(&probe.foot, up);
                if height <= rounding && along.dot(&normal) < 0.0 {
                    return Some(self.polished(&start, &along, &normal, s) / speed);
                }
                up = Some(normal);
            }
            let mut step = height.max(0.0);
            if let Some(normal) = up {
                let mut n = normal;
                for _ in 0..HALVINGS {
                    let center = y + n * h;
                    let ball = self.probe_local(&center);
                    let reach = chord(n.dot(&along) * h, h, ball.distance, rounding);
                    if reach > 0.5 * step || h < 1e-3 * height {
                        step = step.max(reach);
                        if ball.distance > 0.0 {
                            up = Some((center - ball.foot) / ball.distance);
                        }
                        h = if ball.distance >= h { (1.5 * h).min(0.5 * self.size) } else { h };
                        break;
                    }
                    // too high: another wall, or the wall's own curvature, is closer than the one below
                    let same_wall = (ball.foot - y).norm() <= height + 0.5 * h;
                    h *= 0.5;
                    if ball.distance > 0.0 && h < 0.01 * self.size && same_wall {
                        n = (center - ball.foot) / ball.distance;
                    }
                }
            }
            if step <= rounding {
                // wedged in between walls, or sliding along one
                return Some(s / speed);
            }
            s += step;
            if s > leave {
                return None;
            }
            // for smaller balls the height would have only half of its digits
            h = h.max(1e-9 * self.size);
        }
        Some(s / speed)
    }

    /// Newton's steps on the signed distance, as long as they help.
    fn polished(&self, start: &SVector<f64, N>, along: &SVector<f64, N>, normal: &SVector<f64, N>, s: f64) -> f64 {
        let height = |s: f64| self.probe_local(&(start + along * s)).distance;
        let (mut s, mut h) = (s, height(s));
        for _ in 0..4 {
            let next = (s - h / along.dot(normal)).max(0.0);
            let there = height(next);
            if there.abs() >= h.abs() {
                break;
            }
            (s, h) = (next, there);
        }
        s
    }

    /// The stretch of the path inside the box around the shape.
    fn through_box(&self, start: &SVector<f64, N>, along: &SVector<f64, N>) -> Option<[f64; 2]> {
        // more than any rounding of the box, less than would cost a step
        let margin = 1e-6 * self.size;
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for i in 0..N {
            let (low, high) = (self.extent.min[i] - margin - start[i], self.extent.max[i] + margin - start[i]);
            if along[i] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (low / along[i], high / along[i]);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter <= leave).then_some([enter, leave])
    }
}

/// The power of two that brings a length to about 1; 1 for zero and values that are not finite.
///
/// Multiplying by it is exact, so a shape of any size behaves alike to the last bit.
pub(crate) fn to_unit(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { libm::ldexp(1.0, -libm::frexp(size).1) } else { 1.0 }
}

/// How far along the path a ball of radius `radius`, whose centre lies `b` ahead along the path and at the distance
/// `h`, shows it to be free; 0 if the ball does not reach back to the current point of the path.
fn chord(b: f64, h: f64, radius: f64, rounding: f64) -> f64 {
    if radius < h - 2.0 * rounding {
        return 0.0;
    }
    let q = (radius - h) * (radius + h);
    let discriminant = b * b + q;
    if discriminant <= 0.0 { 0.0 } else { (b + libm::sqrt(discriminant)).max(0.0) }
}
