//! A place where a curve given by its points turns back.
use super::{Graph, Interval, Parametric, rough_graphs};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// Of the way from the tip on which the points differ from it by rounding, as many times farther formulas are asked again: their points
/// then follow each other also between the samples of a graph.
const NEAR: f64 = 256.0;

/// Step of differences, in units of the same way: the third root of `ε` where that way is its square root.
const STEP: f64 = 512.0;

/// A cusp: `c′ = 0` and `c″ ≠ 0`, as `(t², t³)` at 0.
///
/// Beside it the two terms of a formula's derivative cancel, so that directions have a rounding of `ε/τ` at a distance `τ` of parameters.
/// There the curve is `p + ½aτ² + ⅙bτ³`, whose directions have none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cusp {
    at: f64,
    point: Vector2<f64>,
    second: Vector2<f64>,
    third: Vector2<f64>,
    /// Up to so far from the tip, points are the tip but for rounding.
    tip: f64,
}

impl Cusp {
    /// At a parameter from 0 to 2π at which `c′` vanishes but for rounding, of a curve and bounds on its second derivative; `size` \[L\] is
    /// that of its coordinates. `None` if it is no cusp, or if the bounds do not tell that there is only one here.
    pub(super) fn of(
        jet: impl Fn(f64) -> [Vector2<f64>; 3],
        second_over: impl Fn(Interval) -> [Interval; 2],
        at: f64,
        size: f64,
    ) -> Option<Cusp> {
        // the middle of where it vanishes
        let [_, first, second] = jet(at);
        let at = (at - first.dot(&second) / second.norm_squared()).clamp(0.0, 2.0 * PI);
        let [point, _, second] = jet(at);
        let tip = libm::sqrt(f64::EPSILON * size / second.norm());
        let step = libm::copysign(STEP * tip, PI - at);
        // of a short range bounds tell nothing, and differences leave it
        if !(STEP * tip < 0.25 * PI) {
            return None;
        }
        let third = (4.0 * jet(at + step)[2] - 3.0 * second - jet(at + 2.0 * step)[2]) / (2.0 * step);
        let cusp = Cusp { at, point, second, third, tip };
        let Interval { low, high } = cusp.around();
        let bend = second_over(Interval::new(low.max(0.0), high.min(2.0 * PI)));
        let is_one = !bend.iter().all(|x| x.contains(0.0));
        (is_one && third.iter().all(|x| x.is_finite())).then_some(cusp)
    }

    /// The tip, as the end of what is before it and the start of what comes after it.
    pub(super) fn place(&self) -> Interval {
        Interval::new(self.at - self.tip, self.at + self.tip)
    }

    /// Where formulas are not asked.
    pub(super) fn around(&self) -> Interval {
        Interval::new(self.at - NEAR * self.tip, self.at + NEAR * self.tip)
    }

    /// `c`, `c′` and `c″`; at the tip `c′` has the direction that it comes from.
    pub(super) fn jet(&self, u: f64) -> [Vector2<f64>; 3] {
        let Cusp { at, point, second, third, tip } = *self;
        let tau = u - at;
        if tau.abs() <= tip {
            // c′ × c″ is the same as below
            return [point, second * tau, second + third * (0.5 * tau)];
        }
        [
            point + (second * 0.5 + third * (tau / 6.0)) * (tau * tau),
            (second + third * (0.5 * tau)) * tau,
            second + third * tau,
        ]
    }

    /// The graphs between two parameters where formulas are not asked, and two points there; `size` \[L\] is that of the whole curve.
    pub(super) fn graphs(&self, parameters: [f64; 2], vertices: [Vector2<f64>; 2], size: f64) -> Option<Vec<Graph>> {
        let ends = vertices.map(|vertex| vertex - self.point);
        let graphs = rough_graphs(&FromTip(self), parameters, ends, size)?;
        let mut graphs: Vec<_> = graphs.into_iter().map(|graph| graph.translated(self.point.into())).collect();
        // the same to the last digit
        let last = graphs.len() - 1;
        graphs[0].ends[0] = vertices[0].into();
        graphs[last].ends[1] = vertices[1].into();
        Some(graphs)
    }
}

/// The way from the tip, which has no rounding of the coordinates.
struct FromTip<'a>(&'a Cusp);

impl Parametric for FromTip<'_> {
    fn at(&self, u: f64) -> [Vector2<f64>; 2] {
        let [c, first, _] = Cusp { point: Vector2::zeros(), ..*self.0 }.jet(u);
        [c, first]
    }
}
